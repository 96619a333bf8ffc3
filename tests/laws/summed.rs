//! Variance shadows from summed-area tables: the same boxes as in float64, tables whose error grows with the map or does
//! not, and boxes of any width for the same reads.

use glam::{DMat4, DVec3};
use shadetree::reference::{
    box_mean, box_ramp, chebyshev, float_mean_bound, table_additions, variance_bound, whole_mean_bound,
};
use shadetree::render::Gpu;

use super::lamp::{CLOSED_FORM, Lamp, Plate, SIDE, STEP, layers, under};
use super::planar::worst;
use crate::stage::{Item, Stage, View, gpu, light, renders, visibility};

/// Sums that a step of the table adds.
const FACTOR: u32 = 4;

const STORAGES: [&str; 3] = ["uint32", "centred", "float32"];

/// Those that the adapter can make: OpenGL may draw whole numbers and no floats of 32 bits.
fn storages(gpu: &Gpu) -> &'static [&'static str] {
    if renders(gpu, "rg32float") { &STORAGES } else { &STORAGES[..1] }
}

/// What moments of 16 bits add to the error where there are none of 32: less than an 8-bit step.
fn coarse(gpu: &Gpu) -> f64 {
    if renders(gpu, "rg32float") { 0.0 } else { STEP }
}

/// What rounding of the table does to the visibility where the occluders lie `gap` above the receiver: the bound
/// v / (v + x^2), with x the distance from the mean to the receiver, changes by 1 / gap^2 with v and by at most 2 / gap
/// with x, for one occluder in any part of the box.
fn rounding(storage: &str, gap: f64, width: f64) -> f64 {
    let (mean, square) = match storage {
        "uint32" => (whole_mean_bound(18), whole_mean_bound(18)),
        "centred" => (float_mean_bound(256, FACTOR, width, 0.5), float_mean_bound(256, FACTOR, width, 0.125)),
        _ => (float_mean_bound(256, FACTOR, width, 1.0), float_mean_bound(256, FACTOR, width, 1.0)),
    };
    let middle = if storage == "centred" { 0.5 } else { 1.0 };
    variance_bound(middle, mean, square) / (gap * gap) + 2.0 * mean / gap
}

fn boxed(lamp: Lamp, storage: &str, width: f64) -> shadetree::compile::Compiled {
    let params = format!("\"bleeding_reduction\": 0, \"minimum_variance\": 0.0000001, \"width\": {width}");
    lamp.shadow("summed_area_shadow", &params, &format!("\"footprint\": \"fixed\", \"storage\": \"{storage}\""))
}

/// Every storage and boxes of any width, in the middle of the map and over its border, against boxes in float64; and
/// against the closed form where one plate covers a half plane.
#[test]
fn boxes_are_those_of_float64_also_at_the_border() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for edge in [4.0, 118.0] {
            let plates = [Plate { height: 1.0, edge, angle: 0.0 }];
            let truth = layers(lamp, &plates);
            let stage = under(lamp, &plates, 19.0, (190, 2));
            let gap = lamp.depth(0.0) - lamp.depth(1.0);
            for storage in storages(&gpu) {
                for width in [1.0, 2.5, 5.0, 11.0, 40.0] {
                    let bound = CLOSED_FORM + coarse(&gpu) + rounding(storage, gap, width);
                    let values = stage.look(&mut gpu, &boxed(lamp, storage, width));
                    for (point, value) in stage.on_ground(&values) {
                        let at = lamp.at(point);
                        if at.0 > SIDE - 0.51 {
                            continue;
                        }
                        let depth = |x: usize, y: usize| truth.depth(x as i64, y as i64);
                        let mean = |power| box_mean(256, |x, y| depth(x, y).powi(power), at, (width, width));
                        let expected = chebyshev(mean(1), mean(2), lamp.depth(0.0), 1e-7);
                        let what = format!("{lamp:?} {storage} {width} at {at:?}");
                        assert!((value - expected).abs() < bound, "{what}: {value} is not {expected} to {bound}");
                        if edge < 10.0 {
                            let ramp = box_ramp(width, at.0 - SIDE / 2.0 - edge);
                            assert!((value - ramp).abs() < bound + 1e-5, "{what}: {value} is off the ramp {ramp}");
                        }
                    }
                }
            }
        }
    }
}

/// The box that is a blur of odd width, sampled bilinearly, on an edge across the texels.
#[test]
fn a_box_is_the_variance_shadow_blurred_as_widely() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        let plates = [Plate { height: 1.0, edge: 4.3, angle: 0.3 }];
        let stage = under(lamp, &plates, 24.0, (96, 24));
        let gap = lamp.depth(0.0) - lamp.depth(1.0);
        for width in [1_u32, 3, 7, 11] {
            let blurred = super::lamp::vsm(lamp, "box", width as usize, super::lamp::PLAIN);
            let blurred = stage.look(&mut gpu, &blurred);
            for storage in storages(&gpu) {
                let boxed = stage.look(&mut gpu, &boxed(lamp, storage, f64::from(width)));
                let off = worst(boxed.into_iter().zip(blurred.iter().copied()));
                let bound = super::lamp::sampled(&gpu) + coarse(&gpu) + rounding(storage, gap, f64::from(width));
                assert!(off < bound, "{lamp:?} {storage} {width}: {off} is over {bound}");
            }
        }
    }
}

/// On a lit slope, boxes that the border cuts off are compared with the receiver in their own middle.
#[test]
fn lit_slopes_stay_lit_up_to_the_border() {
    let Some(mut gpu) = gpu() else { return };
    let tilt = DMat4::from_rotation_z(0.3);
    let normal = tilt.transform_vector3(DVec3::Y);
    let items = vec![Item::plane([30.0, 30.0], tilt)];
    let view = View { up: DVec3::Z, ..View::down((0.0, 0.0), 2.0, 1.9, (96, 96)) };
    let stage = Stage::new(items, view);
    let shader = boxed(Lamp::Sun, "uint32", 41.0);
    let values = stage.look(&mut gpu, &shader);
    for (point, value) in stage.on_plane(&values, DVec3::ZERO, normal) {
        if point.x.abs() < 0.99 && point.z.abs() < 0.99 {
            assert!(value > 1.0 - 2e-3, "{point}: {value}");
        }
    }
}

/// Depths from 0.8 to 0.9 across the whole map of a spotlight, and that light's shadow.
fn slope(shadow: &str, options: &str, size: u32) -> (Stage, shadetree::compile::Compiled) {
    let (lamp, at) = Lamp::Spot.kind();
    let plane = DMat4::from_translation(DVec3::new(0.0, -0.4, 0.0)) * DMat4::from_rotation_z(0.03);
    let stage = Stage::new(vec![Item::plane([20.0, 20.0], plane)], View::down((0.0, 0.0), 2.0, 1.0, (4, 4)));
    let options = format!("\"slope_variance\": \"off\", \"size\": \"{size}\", {options}");
    (stage, visibility(&light(lamp, at, shadow, "", &options)))
}

/// Boxes of 8 texels all over a map: their lower left corners.
fn boxes(side: usize) -> impl Iterator<Item = (usize, usize)> {
    let step = (side - 8) / 31;
    (0..32).flat_map(move |j| (0..32).map(move |i| (i * step, j * step)))
}

const BOX: usize = 8;

/// Variance of depth in each box, in float64 from the texels themselves.
fn true_variances(side: usize, moments: &[[f64; 2]]) -> Vec<f64> {
    boxes(side)
        .map(|(x, y)| {
            let center = ((x + BOX / 2) as f64, (y + BOX / 2) as f64);
            let mean = |c: usize| box_mean(side, |x, y| moments[y * side + x][c], center, (BOX as f64, BOX as f64));
            mean(1) - mean(0) * mean(0)
        })
        .collect()
}

/// The four corners of a box in a table, those outside of it 0.
fn corners<T: Copy + Default>(side: usize, table: &[T], (x, y): (usize, usize)) -> [T; 4] {
    let before = |x: usize, y: usize| if x == 0 || y == 0 { T::default() } else { table[(y - 1) * side + x - 1] };
    [before(x, y), before(x + BOX, y), before(x, y + BOX), before(x + BOX, y + BOX)]
}

/// The same from a table of floats around `middle` (and `square` for squares of what is around it).
fn float_variances(side: usize, table: &[[f32; 2]], square: f64) -> Vec<f64> {
    boxes(side)
        .map(|at| {
            let [a, b, c, d] = corners(side, table, at);
            let sum = |i: usize| f64::from(d[i]) - f64::from(b[i]) - f64::from(c[i]) + f64::from(a[i]);
            let (mean, mean_square) = (sum(0) / 64.0, sum(1) / 64.0 + square);
            mean_square - mean * mean
        })
        .collect()
}

/// The same from a table of whole numbers, with differences that run over as the sums did.
fn whole_variances(side: usize, table: &[[u32; 2]]) -> Vec<f64> {
    boxes(side)
        .map(|at| {
            let [a, b, c, d] = corners(side, table, at);
            let sum = |i: usize| d[i].wrapping_sub(b[i]).wrapping_sub(c[i]).wrapping_add(a[i]);
            let mean = |i: usize| f64::from(sum(i)) / 64.0 / f64::from(1 << 18);
            mean(1) - mean(0) * mean(0)
        })
        .collect()
}

/// What a shadow of this storage makes its table from.
fn summands(storage: &str, [mean, square]: [f32; 2]) -> [f32; 2] {
    if storage != "centred" {
        return [mean, square];
    }
    let centred = mean - 0.5;
    [centred, (square - mean * mean) + centred * centred - 0.125]
}

/// The table in float32 on this machine, step by step as the passes do it.
fn table(side: usize, mut texels: Vec<[f32; 2]>) -> Vec<[f32; 2]> {
    for stride in [1, side] {
        let mut distance = 1;
        while distance < side {
            let before = texels.clone();
            for (index, texel) in texels.iter_mut().enumerate() {
                let place = if stride == 1 { index % side } else { index / side };
                for i in 1..=(place / distance).min(3) {
                    let other = before[index - i * distance * stride];
                    *texel = [texel[0] + other[0], texel[1] + other[1]];
                }
            }
            distance *= FACTOR as usize;
        }
    }
    texels
}

fn map_of(gpu: &mut Gpu, (stage, shader): &(Stage, shadetree::compile::Compiled)) -> shadetree::render::MapPicture {
    gpu.map(&stage.job(shader), &shader.plan.lights[0].name, 0).expect("a map")
}

/// The error of the variance against the side of the map: floats lose four times as much with every doubling, whole
/// numbers nothing. What the adapter stores is, to the bit, what the same additions give here.
#[test]
fn floats_lose_digits_with_the_size_of_the_map_and_whole_numbers_do_not() {
    let Some(mut gpu) = gpu() else { return };
    if !renders(&gpu, "rg32float") {
        return;
    }
    let sides = [256_u32, 512, 1024, 2048];
    let mut errors = [const { Vec::new() }; 3];
    for side in sides {
        let size = side as usize;
        let options = "\"width\": \"1\", \"mips\": \"off\", \"filter\": \"linear\", \"anisotropy\": \"1\", \"format\": \"rg32float\"";
        let moments = map_of(&mut gpu, &slope("variance_shadow", options, side));
        assert!(moments.pixels.iter().all(|p| (0.8..0.9).contains(&p[0])), "the depths of the slope");
        let exact: Vec<[f64; 2]> = moments.pixels.iter().map(|p| [f64::from(p[0]), f64::from(p[1])]).collect();
        let truth = true_variances(size, &exact);
        for (storage, errors) in STORAGES.iter().zip(&mut errors) {
            let map = map_of(&mut gpu, &slope("summed_area_shadow", &format!("\"storage\": \"{storage}\""), side));
            let found = if *storage == "uint32" {
                let table: Vec<[u32; 2]> = map.integers.iter().map(|p| [p[0], p[1]]).collect();
                whole_variances(size, &table)
            } else {
                let stored: Vec<[f32; 2]> = map.pixels.iter().map(|p| [p[0], p[1]]).collect();
                if side <= 512 {
                    let texels = moments.pixels.iter().map(|p| summands(storage, [p[0], p[1]])).collect();
                    let off = stored.iter().zip(&table(size, texels)).filter(|(a, b)| a != b).count();
                    assert_eq!(off, 0, "{storage} {side}: entries that differ from the same additions here");
                }
                float_variances(size, &stored, if *storage == "centred" { 0.125 } else { 0.0 })
            };
            let off = worst(found.into_iter().zip(truth.iter().copied()));
            let float = |largest, square| {
                let mean = float_mean_bound(side, FACTOR, BOX as f64, largest);
                variance_bound(largest, mean, float_mean_bound(side, FACTOR, BOX as f64, square))
            };
            let bound = match *storage {
                "uint32" => variance_bound(0.9, whole_mean_bound(18), whole_mean_bound(18)) + 1e-7,
                "centred" => float(0.4, 0.125),
                _ => float(0.9, 0.81),
            };
            assert!(off <= bound, "{storage} {side}: {off} is over {bound}");
            errors.push(off);
        }
    }
    println!(
        "worst error of the variance in boxes of 8 texels, sides {sides:?} ({} additions at most):",
        table_additions(2048, FACTOR)
    );
    for (storage, errors) in STORAGES.iter().zip(&errors) {
        let errors: Vec<String> = errors.iter().map(|e| format!("{e:.2e}")).collect();
        println!("{storage:>8} {}", errors.join(" "));
    }
    let [whole, centred, plain] = &errors;
    for (storage, errors) in [("centred", centred), ("float32", plain)] {
        // Four times the texels; how the roundings fall moves single doublings by half as much either way.
        let growth = (errors[3] / errors[0]).cbrt();
        assert!((3.0..=6.0).contains(&growth), "{storage}: {growth} per doubling, {errors:?}");
        assert!(errors.windows(2).all(|w| w[1] > 1.5 * w[0]), "{storage}: {errors:?}");
    }
    // More boxes meet the worst rounding, but no more than the worst: within half of each other.
    assert!(whole[3] < 1.5 * whole[0], "{whole:?}");
    assert!(centred[3] < plain[3] && whole[3] < centred[3] / 100.0, "{errors:?}");
}

/// The width is a value: no loop and no other text depends on it, and sixteen texels are read at every pixel.
#[test]
fn any_width_takes_the_same_reads() {
    let Some(mut gpu) = gpu() else { return };
    let shader = boxed(Lamp::Sun, "uint32", 3.0);
    let text = &shader.module.wgsl;
    let count = |what: &str| text.matches(what).count();
    assert!(!text.contains("for (") && !text.contains("while") && !text.contains("loop"), "{text}");
    // Each name is declared once, and called as often as it is found besides.
    assert_eq!(count("textureLoad("), 1);
    assert_eq!((count("summed_before(") - 1) * (count("summed_run(") - 1) * (count("summed_mean(") - 1), 16);
    let path =
        shader.module.parameters.iter().find(|p| p.path.ends_with("shadow.width")).expect("a width").path.clone();
    let plates = [Plate { height: 1.0, edge: 4.0, angle: 0.0 }];
    let mut stage = under(Lamp::Sun, &plates, 80.0, (160, 1));
    let mut seen = Vec::new();
    let mut built = None;
    for width in [3.0, 9.0, 33.0, 65.0] {
        stage.set(&path, &[width]);
        let values = stage.look(&mut gpu, &shader);
        assert_eq!(
            *built.get_or_insert(gpu.pipelines_built()),
            gpu.pipelines_built(),
            "another width is no other text"
        );
        seen.push(values.iter().filter(|v| (0.02..0.98).contains(*v)).count());
    }
    assert!(seen.windows(2).all(|w| w[1] > w[0] + 5), "wider boxes have wider edges: {seen:?}");
}

/// Drawing the table is another way to the same numbers.
#[test]
fn drawn_and_computed_tables_are_the_same() {
    let Some(mut gpu) = gpu() else { return };
    for storage in storages(&gpu) {
        let by = |build: &str| {
            slope("summed_area_shadow", &format!("\"storage\": \"{storage}\", \"build\": \"{build}\""), 256)
        };
        let (computed, drawn) = (map_of(&mut gpu, &by("compute")), map_of(&mut gpu, &by("image")));
        assert!(computed.pixels == drawn.pixels && computed.integers == drawn.integers, "{storage}");
    }
}

/// One plane above another and a light with a size: the penumbra is a ramp as wide as the light appears through the edge.
#[test]
fn penumbrae_are_as_wide_as_similar_triangles_make_them() {
    let Some(mut gpu) = gpu() else { return };
    // A disc counts as the square of equal variance.
    let half = 0.75_f64.sqrt();
    for (lamp, size) in
        [(Lamp::Sun, 4.0_f64), (Lamp::Sun, 8.0), (Lamp::Spot, 0.5), (Lamp::Spot, 1.0), (Lamp::Spot, 2.0)]
    {
        let (kind, at) = lamp.kind();
        let height = if lamp == Lamp::Sun { 0.5 } else { 1.0 };
        let (name, width) = match lamp {
            Lamp::Sun => ("angle", 2.0 * size.to_radians().tan() * height / lamp.texel(0.0)),
            Lamp::Spot => ("radius", 2.0 * size * height / (4.0 - height) / lamp.texel(0.0)),
        };
        let width = half * width;
        assert!(width > 5.0, "{width}");
        let params = "\"bleeding_reduction\": 0, \"minimum_variance\": 0.0000001, \"minimum_width\": 1";
        let at = format!("{at}, \"{name}\": {size}");
        let shader = visibility(&light(kind, &at, "summed_area_soft_shadow", params, "\"size\": \"256\""));
        let mut stage = under(lamp, &[Plate { height, edge: 4.0, angle: 0.0 }], 1.5 * width, (200, 2));
        // Keeps the range of the sun, and its search for occluders wider than the penumbra.
        let speck = Plate { height: 1.0, edge: -120.0, angle: 0.0 };
        stage.items.extend(under(lamp, &[speck], 1.0, (8, 8)).items.into_iter().skip(1));
        let gap = lamp.depth(0.0) - lamp.depth(height);
        // The gap is found from a search that holds at least a sixth of occluder wherever the penumbra is: the error of
        // the variance over gap^2, six times, is the part that its width is off by, and moves the ramp by half of that.
        let found = 6.0 * rounding("uint32", gap, 1.0);
        // Boxes that are cut, from 32 texels on, end at whole texels: each end is off by half a texel at most.
        let ends = if width < 32.0 { 0.0 } else { 0.5 / (width - 1.0) };
        let bound = CLOSED_FORM + rounding("uint32", gap, 1.0) + found + ends;
        let values = stage.look(&mut gpu, &shader);
        for (point, value) in stage.on_ground(&values) {
            let x = lamp.at(point).0 - SIDE / 2.0 - 4.0;
            let expected = box_ramp(width, x);
            assert!((value - expected).abs() < bound, "{lamp:?} {size} at {x}: {value} is not {expected} to {bound}");
        }
        assert!(values.iter().any(|v| (0.4..0.6).contains(v)), "the penumbra is seen");
    }
}

/// Under grazing light the receiver is as deep as the box that looks for occluders is wide, and its mean is far from the shaded
/// point: occluders are where they are all the same, and penumbrae as wide as similar triangles make them.
#[test]
fn penumbrae_keep_their_width_under_grazing_light() {
    let Some(mut gpu) = gpu() else { return };
    // A lamp a metre above the ground, a tall plate a metre away whose edge runs up from z = 0.
    let radius = 0.06;
    let (point, spot) = ("point_light", "spot_light");
    let at = format!("\"position\": (0, 1, 0), \"near\": 0.1, \"range\": 12, \"radius\": {radius}");
    let aimed = format!("{at}, \"direction\": (1, 0, 0), \"outer_angle\": 45, \"inner_angle\": 44");
    let plate =
        DMat4::from_translation(DVec3::new(1.0, 1.0, 2.0)) * DMat4::from_rotation_z(std::f64::consts::FRAC_PI_2);
    for (kind, lamp) in [(point, &at), (spot, &aimed)] {
        let shader = visibility(&light(kind, lamp, "summed_area_soft_shadow", "\"bleeding_reduction\": 0", ""));
        for distance in [3.0, 5.0, 8.0] {
            let half = 0.75_f64.sqrt() * radius * (distance - 1.0);
            let view = View::down((distance, 0.0), 2.0, 4.0 * half, (64, 64));
            let items = vec![Item::plane([40.0, 40.0], DMat4::IDENTITY), Item::plane([2.0, 4.0], plate)];
            let stage = Stage::new(items, view);
            let values = stage.look(&mut gpu, &shader);
            let near = |p: &DVec3| (p.x - distance).abs() < 0.1 * distance;
            for (p, value) in stage.on_ground(&values).filter(|(p, _)| near(p)) {
                let width = 2.0 * 0.75_f64.sqrt() * radius * (p.x - 1.0);
                let expected = box_ramp(width, -p.z);
                // Boxes that are cut end at whole texels: both ends are off by half a texel at most.
                let texels = width / (2.0 * 1.0625 * p.x / 1024.0);
                let bound = 1.0 / (texels - 1.0) + CLOSED_FORM + rounding("uint32", (p.x - 1.0) / 11.9, 1.0);
                let what = format!("{kind} {distance} at {p}: {value} is not {expected} to {bound}");
                assert!((value - expected).abs() < bound, "{what}");
            }
        }
    }
}
