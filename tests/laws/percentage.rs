//! What percentage-closer filtering owes its bias and its culling, and that it is the same in every view of a light.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::reference::{Layer, Layers, Taps, Weights, kernel};
use shadetree::render::{Gpu, LightSpace};
use shadetree::scene::Shape;

use super::lamp::{CLOSED_FORM, sampled};
use super::planar::worst;
use crate::stage::{Item, Stage, View, gpu, grain, light, visibility};

/// The texel of a map of `side` that a point falls into, columns and rows from the upper left.
pub(super) fn texel_of(space: &LightSpace, side: f64, point: DVec3) -> (f64, f64) {
    let seen = space.world_to_light.as_dmat4().transform_point3(point);
    let ray = if space.projection.z > 0.5 { seen / seen.z } else { seen };
    let ndc = (ray.x * f64::from(space.projection.x), ray.y * f64::from(space.projection.y));
    ((0.5 + 0.5 * ndc.0) * side, (0.5 - 0.5 * ndc.1) * side)
}

/// A plate 1 m above the ground that ends at x = `edge`, seen from below it around where its shadow ends.
fn plate(edge: f64, foot: f64, width: f64) -> Stage {
    let plate = Item::plane([8.0, 16.0], DMat4::from_translation(DVec3::new(edge - 4.0, 1.0, 0.0)));
    let ground = Item::plane([16.0, 16.0], DMat4::IDENTITY);
    Stage::new(vec![ground, plate], View::down((foot, 0.0), 0.75, width, (240, 3)))
}

/// The ramp of a straight edge (T4) in one face of a point light and in one part of a split sun, whose texels the edge
/// cuts anywhere: with every weight, width and kind of tap.
#[test]
fn every_view_of_a_light_filters_as_in_float64() {
    let Some(mut gpu) = gpu() else { return };
    let bulb = ("point_light", "\"position\": (0.1, 4, -0.07), \"near\": 1, \"range\": 5", "");
    let sun = ("directional_light", "\"direction\": (0, -1, 0)", "\"splits\": \"3\"");
    for (kind, lamp, options) in [bulb, sun] {
        let (edge, foot, width) = if options.is_empty() { (0.31, 0.38, 0.5) } else { (0.31, 0.31, 0.35) };
        let stage = plate(edge, foot, width);
        for (name, weights) in Weights::ALL {
            for taps in ["nearest", "bilinear", "hardware"] {
                for width in [1, 3, 5, 7, 9] {
                    let shadow = format!(
                        "\"size\": \"256\", \"width\": \"{width}\", \"weights\": \"{name}\", \"taps\": \"{taps}\""
                    );
                    let graph = light(kind, lamp, "pcf_shadow", "", &shadow).replacen(
                        "}), \"shadow\"",
                        &format!("}}, options: {{{options}}}), \"shadow\""),
                        1,
                    );
                    let shader = visibility(&graph);
                    let values = stage.look(&mut gpu, &shader);
                    let (truth, at) = seen_in_float64(&mut gpu, &stage, &shader, edge);
                    let kernel = kernel(weights, width);
                    let (read, bar) = match taps {
                        "nearest" => (Taps::Nearest, grain(&gpu)),
                        "bilinear" => (Taps::Bilinear, CLOSED_FORM),
                        _ => (Taps::Bilinear, sampled(&gpu)),
                    };
                    let (mut judged, mut between) = (0, 0);
                    for (point, lit) in stage.on_ground(&values) {
                        let at = at(point);
                        // Edges and texel boundaries nearer than rasterisers and float32 tell apart fall to either side.
                        let boundary = (at.0 - at.0.round()).abs().min((at.1 - at.1.round()).abs());
                        if truth.margin(at.0, at.1, width as i64 / 2 + 1) < 0.01
                            || (read == Taps::Nearest && boundary < 1e-3)
                        {
                            continue;
                        }
                        let expected = truth.lit(&kernel, read, at);
                        assert!(
                            (lit - expected).abs() < bar,
                            "{kind} {name} {taps} {width} at {at:?}: {lit} is not {expected}"
                        );
                        judged += 1;
                        between += usize::from(expected > 0.0 && expected < 1.0);
                    }
                    let least = if width == 1 && taps == "nearest" { 0 } else { 3 };
                    assert!(judged > 400 && between >= least, "{kind} {name} {taps} {width}: {judged} {between}");
                }
            }
        }
    }
}

/// The plate of [`plate`] as the view that sees the middle of the picture holds it, and how points lie on its map.
fn seen_in_float64(
    gpu: &mut Gpu,
    stage: &Stage,
    shader: &Compiled,
    edge: f64,
) -> (Layers, impl Fn(DVec3) -> (f64, f64) + use<>) {
    let map = gpu.map(&stage.job(shader), "light/lamp", 0).expect("renders");
    let side = f64::from(map.size.0);
    let looks_down = |s: &&LightSpace| s.world_to_light.row(2).y < -0.99 && f64::from(s.depth.w) > 0.75;
    let space = *map.spaces.iter().find(looks_down).expect("a view from above");
    let at = move |point: DVec3| texel_of(&space, side, point);
    let depth = |y: f64| -(y * 1.0);
    let column = at(DVec3::new(edge, 1.0, 0.0)).0;
    let layers = vec![Layer { depth: depth(1.0), sides: vec![[1.0, 0.0, column]] }];
    (Layers { receiver: depth(0.0), layers }, at)
}

const SUN: &str = "\"direction\": (0, -1, 0), \"radius\": 1";

/// The least visibility of a plane that falls away from a sun straight above, by (u, v) metres per metre, under a map of
/// 256 texels of 1/128 m: two by two texels of it, at 64 by 64 places.
fn darkest(gpu: &mut Gpu, shader: &Compiled, (u, v): (f64, f64), bias: f64) -> f64 {
    let normal = DVec3::new(u, 1.0, v).normalize();
    let turn = DMat4::from_quat(glam::DQuat::from_rotation_arc(DVec3::Y, normal));
    let view = View::down((0.013, 0.017), 0.5, 2.0 / 128.0, (64, 64));
    let mut stage = Stage::new(vec![Item::plane([12.0, 12.0], turn)], view);
    stage.set("light/shadow.bias", &[bias]);
    stage.look(gpu, shader).into_iter().fold(1.0, f64::min)
}

/// T8: comparisons with the shaded point darken a plane that falls by (gu, gv) per texel iff the bias is less than
/// (|gu| + |gv|) (R + 1/2), R being the texels of the kernel to each side of the middle one. What is left between the two
/// sides: pixels are 1/32 texel apart along each axis, rasterisers place vertices on a grid of 1/256 texel, and depth is
/// kept to 2e-6 of its range.
#[test]
fn acne_without_a_plane_begins_where_the_law_says() {
    let Some(mut gpu) = gpu() else { return };
    let lit = 1.0 - grain(&gpu);
    for width in [1, 3, 5, 7, 9] {
        let options = |compare: &str| {
            let kernel = format!("\"width\": \"{width}\", \"weights\": \"box\", \"taps\": \"nearest\"");
            visibility(&light(
                "directional_light",
                SUN,
                "pcf_shadow",
                "",
                &format!("\"size\": \"256\", {kernel}, \"compare\": \"{compare}\""),
            ))
        };
        let (by_point, by_plane) = (options("point"), options("plane"));
        for slope in [(0.3_f64, 0.0_f64), (1.0, 0.0), (0.5, -0.8), (-2.0, 1.0)] {
            let per_texel = (slope.0.abs() + slope.1.abs()) / 128.0;
            let bound = per_texel * (width as f64 / 2.0);
            let range = 2.5 * (slope.0.abs() + slope.1.abs());
            let unsure = per_texel / 128.0 + 2e-6 * range;
            let enough = darkest(&mut gpu, &by_point, slope, bound + unsure);
            assert!(enough >= lit, "{width} {slope:?}: {enough} with a bias of {}", bound + unsure);
            let short = bound - unsure - per_texel / 32.0;
            let less = darkest(&mut gpu, &by_point, slope, short);
            assert!(less < 1.0 - 0.5 / (width * width) as f64, "{width} {slope:?}: {less} with a bias of {short}");
            let plane = darkest(&mut gpu, &by_plane, slope, 0.0);
            assert!(plane >= lit, "{width} {slope:?}: {plane} with the receiving plane");
        }
    }
}

/// Moving the point along its normal by the square root of two half kernels, times the sine, is as good as the bias of
/// T8 on any slope: d / cos(a) = half sin(a) sqrt(2) / cos(a) = half tan(a) sqrt(2), and |u| + |v| is at most
/// sqrt(2) tan(a). With half of that, slopes along the diagonal are darkened.
#[test]
fn an_offset_along_the_normal_clears_every_slope() {
    let Some(mut gpu) = gpu() else { return };
    let lit = 1.0 - grain(&gpu);
    for (width, taps) in [(1, "nearest"), (3, "nearest"), (5, "bilinear"), (9, "hardware")] {
        let options =
            format!("\"size\": \"256\", \"width\": \"{width}\", \"taps\": \"{taps}\", \"compare\": \"offset\"");
        for (offset, clear) in [(1.5, true), (0.6, false)] {
            let shader =
                visibility(&light("directional_light", SUN, "pcf_shadow", &format!("\"offset\": {offset}"), &options));
            for slope in [(0.7, 0.7), (-1.4, 1.4), (0.2, -0.2)] {
                let least = darkest(&mut gpu, &shader, slope, 0.0);
                assert_eq!(least >= lit, clear, "{width} {taps} {slope:?}, offset {offset}: {least}");
            }
        }
    }
}

/// What stands on the ground behind x = 0, lit from the left at 45 degrees, seen from above where its shadow begins.
fn standing(item: Item) -> Stage {
    let ground = Item::plane([8.0, 8.0], DMat4::IDENTITY);
    Stage::new(vec![ground, item], View::down((0.1, 0.0), 3.0, 0.22, (440, 2)))
}

/// Where the ground begins to be dark.
fn first_dark(gpu: &mut Gpu, stage: &Stage, cull: &str, bias: f64) -> f64 {
    let lamp = "\"direction\": (1, -1, 0), \"radius\": 2";
    let shader = visibility(&light(
        "directional_light",
        lamp,
        "hard_shadow",
        &format!("\"bias\": {bias}"),
        &format!("\"cull\": \"{cull}\""),
    ));
    let values = stage.look(gpu, &shader);
    stage.on_ground(&values).filter(|(p, v)| p.x > 0.002 && *v < 0.5).map(|(p, _)| p.x).fold(f64::INFINITY, f64::min)
}

/// Texels of 4 m / 2048 at a light of 45 degrees: what is stored for a texel is off by up to one of them in depth, and so
/// is the place of an edge.
const TEXEL: f64 = 2.0 * 4.0 / 2048.0;

/// T8, last sentence: behind a thin wall the ground is lit as far as light travels within the bias.
#[test]
fn shadows_detach_by_the_bias_along_the_light() {
    let Some(mut gpu) = gpu() else { return };
    let wall = Item::plane(
        [1.0, 6.0],
        DMat4::from_translation(DVec3::Y * 0.5) * DMat4::from_rotation_z(-std::f64::consts::FRAC_PI_2),
    );
    let stage = standing(wall);
    for bias in [0.0, 0.05, 0.1, 0.2] {
        let gap = first_dark(&mut gpu, &stage, "none", bias);
        let expected = bias / 2.0_f64.sqrt();
        assert!((gap - expected).abs() < TEXEL, "bias {bias}: dark from {gap}, not {expected}");
    }
}

/// Leaving out front faces brings occluders to where light leaves a body: shadows then detach by the whole bias, where
/// otherwise they do by what the bias exceeds the body's thickness. Lit faces cannot shadow themselves then, and sheets
/// that show the light their front cast no shadow; with back faces left out, those that show it their back.
#[test]
fn culling_front_faces_moves_occluders_by_the_thickness() {
    let Some(mut gpu) = gpu() else { return };
    for thickness in [0.1, 0.3] {
        let shape = Shape::Box { size: [thickness, 1.0, 6.0], bevel: 0.0 };
        let stage = standing(Item::new(&shape, DMat4::from_translation(DVec3::new(-thickness / 2.0, 0.5, 0.0))));
        // Along the light a wall is thicker by the square root of two.
        let through = thickness * 2.0_f64.sqrt();
        for (cull, bias, behind) in [
            ("none", 0.1, 0.0),
            ("back", 0.1, 0.0),
            ("front", 0.1, 0.1),
            ("none", through + 0.08, 0.08),
            ("front", 0.2, 0.2),
        ] {
            let gap = first_dark(&mut gpu, &stage, cull, bias);
            let expected = behind / 2.0_f64.sqrt();
            assert!(
                (gap - expected).abs() < TEXEL + 0.002,
                "{cull}, {thickness} thick, bias {bias}: {gap}, not {expected}"
            );
        }
    }
}

#[test]
fn culled_sides_cast_no_shadow_and_take_none() {
    let Some(mut gpu) = gpu() else { return };
    for shadow in ["hard_shadow", "pcf_shadow"] {
        let mut look = |stage: &Stage, cull: &str, rest: &str| {
            let options = format!("\"cull\": \"{cull}\"{rest}");
            let values = stage.look(&mut gpu, &visibility(&light("directional_light", SUN, shadow, "", &options)));
            values.into_iter().fold(1.0, f64::min)
        };
        let sheet = |turn: f64| {
            let roof = Item::plane([4.0, 4.0], DMat4::from_translation(DVec3::Y) * DMat4::from_rotation_x(turn));
            let view = View::down((0.0, 0.0), 0.9, 0.5, (8, 8));
            Stage::new(vec![Item::plane([4.0, 4.0], DMat4::IDENTITY), roof], view)
        };
        let (mut up, down) = (sheet(0.0), sheet(std::f64::consts::PI));
        // A mirrored sheet still faces the light.
        up.items.push(Item::plane(
            [4.0, 4.0],
            DMat4::from_translation(DVec3::Y) * DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)),
        ));
        for (cull, from_up, from_down) in [("none", 0.0, 0.0), ("front", 1.0, 0.0), ("back", 0.0, 1.0)] {
            assert!((look(&up, cull, "") - from_up).abs() < 1e-6, "{shadow} {cull}: front to the light");
            assert!((look(&down, cull, "") - from_down).abs() < 1e-6, "{shadow} {cull}: back to the light");
        }
    }
    // A slab that falls by 45 degrees: its lit face is in the map only if front faces are.
    let slab = Shape::Box { size: [4.0, 0.5, 4.0], bevel: 0.0 };
    let stage =
        Stage::new(vec![Item::new(&slab, DMat4::from_rotation_z(-0.7))], View::down((0.0, 0.0), 1.5, 0.1, (32, 32)));
    let mut least = |cull: &str| {
        let options = format!("\"size\": \"256\", \"width\": \"9\", \"compare\": \"point\", \"cull\": \"{cull}\"");
        let shader = visibility(&light("directional_light", SUN, "pcf_shadow", "\"bias\": 0", &options));
        stage.look(&mut gpu, &shader).into_iter().fold(1.0, f64::min)
    };
    assert!(least("none") < 0.9 && least("back") < 0.9 && least("front") > 1.0 - 1e-6);
}

/// M17: a comparison does not care how depth is measured. The picture is that of linear depth, on every side of a cube too,
/// and what a map holds is the metric of the plate: z / w, or the distance from the light.
#[test]
fn every_metric_of_depth_gives_the_same_shadow() {
    let Some(mut gpu) = gpu() else { return };
    let spot =
        "\"position\": (0.1, 4, -0.07), \"direction\": (0, -1, 0), \"outer_angle\": 40, \"near\": 1, \"range\": 5";
    let bulb = "\"position\": (0.1, 4, -0.07), \"near\": 1, \"range\": 5";
    let stage = plate(0.31, 0.38, 0.5);
    for (kind, lamp) in [("spot_light", spot), ("point_light", bulb), ("directional_light", SUN)] {
        for (shadow, options) in [
            ("hard_shadow", ""),
            ("pcf_shadow", ", \"width\": \"1\""),
            ("pcf_shadow", ", \"width\": \"9\", \"taps\": \"hardware\""),
            ("pcf_shadow", ", \"width\": \"5\", \"compare\": \"point\""),
        ] {
            let shader = |metric: &str| {
                let options = format!("\"size\": \"256\", \"metric\": \"{metric}\"{options}");
                visibility(&light(kind, lamp, shadow, "", &options))
            };
            let linear = stage.look(&mut gpu, &shader("linear"));
            for metric in ["zw", "radial"] {
                let shader = shader(metric);
                let values = stage.look(&mut gpu, &shader);
                let off = worst(linear.iter().copied().zip(values));
                assert!(off < CLOSED_FORM, "{kind} {shadow} {options} {metric}: {off}");
                let map = gpu.map(&stage.job(&shader), "light/lamp", 0).expect("renders");
                let side = f64::from(map.size.0);
                let down = |s: &&LightSpace| s.world_to_light.row(2).y < -0.99;
                let space = map.spaces.iter().find(down).expect("a view from above");
                // The centre of the texel that sees the plate at (0, 1, 0).
                let (column, row) = texel_of(space, side, DVec3::Y);
                let (column, row) = (column.floor(), row.floor());
                let layer = f64::from(space.projection.w) * side;
                let stored = f64::from(map.pixels[((layer + row) * side + column) as usize][0]);
                let ray = |t: f64, focal: f32| (2.0 * (t + 0.5) / side - 1.0) / f64::from(focal);
                let across = DVec3::new(ray(column, space.projection.x), ray(row, space.projection.y), 1.0).length();
                let expected = match (kind, metric) {
                    ("directional_light", _) => continue,
                    (_, "zw") => 5.0 / 4.0 * (1.0 - 1.0 / 3.0),
                    _ => 3.0 * across / 5.0,
                };
                assert!((stored - expected).abs() < 1e-5, "{kind} {metric}: {stored} is not {expected}");
            }
        }
    }
}

/// Two choices of one kind in one shader are two functions.
#[test]
fn shadows_of_several_metrics_fit_into_one_shader() {
    let shadow = |metric: &str| {
        format!("\"{metric}\": (kind: \"pcf_shadow\", options: {{\"metric\": \"{metric}\", \"width\": \"3\"}})")
    };
    let nodes = ["linear", "zw", "radial"].map(shadow).join(", ");
    let graph = format!(
        "Graph(version: 1, nodes: {{\"lamp\": (kind: \"spot_light\"), {nodes}}}, links: [\"lamp -> linear\", \"linear -> zw\", \"zw -> radial\"])"
    );
    let wgsl = visibility(&graph).module.wgsl;
    assert!(
        wgsl.contains("receiver_depth_zw_less(space") && wgsl.contains("receiver_depth_radial_less(space"),
        "{wgsl}"
    );
}

/// Every way to compare works on a map that its light warps: away from the edge what is lit is lit, and what is dark dark.
#[test]
fn comparisons_work_on_warped_maps() {
    let Some(mut gpu) = gpu() else { return };
    let stage = plate(0.31, 0.31, 0.5);
    for (shadow, options) in [
        ("hard_shadow", ""),
        ("pcf_shadow", ""),
        ("pcf_shadow", "\"compare\": \"point\""),
        ("pcf_shadow", "\"compare\": \"offset\""),
        ("pcf_shadow", "\"metric\": \"radial\", \"taps\": \"hardware\""),
        ("disc_shadow", ""),
        ("disc_shadow", "\"taps\": \"bilinear\""),
        ("adaptive_pcf_shadow", ""),
        ("adaptive_pcf_shadow", "\"taps\": \"hardware\""),
        ("pcss_shadow", ""),
    ] {
        let graph = light("directional_light", "\"direction\": (0, -1, 0), \"angle\": 0.5", shadow, "", options)
            .replacen("}), \"shadow\"", "}, options: {\"warp\": \"perspective\"}), \"shadow\"", 1);
        let shader = visibility(&graph);
        let values = stage.look(&mut gpu, &shader);
        for (point, lit) in stage.on_ground(&values) {
            let beyond = point.x - 0.31;
            if beyond.abs() > 0.12 {
                let expected = if beyond > 0.0 { 1.0 } else { 0.0 };
                assert!((lit - expected).abs() < 1e-3, "{shadow} {options} at {point}: {lit} is not {expected}");
            }
        }
        assert!(shader.module.wgsl.contains(".warp.x"), "the map is warped");
    }
}
