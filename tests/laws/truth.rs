//! The truth of whole pictures: the same eye as the renderer's, the closed forms, and the car.

use std::path::Path;
use std::process::Command;
use std::sync::atomic::AtomicBool;

use exr::prelude::read_first_rgba_layer_from_file;
use glam::{DMat4, DVec3};
use shadetree::compile::Output;
use shadetree::reference::picture::{Method, Watch, eye_ray, points, visibility};
use shadetree::reference::{Filter, Light, Taps, Weights, World, edge_visibility, filter_below, kernel};
use shadetree::scene::Shape;

use super::lamp::{CLOSED_FORM, Lamp, Plate, SIDE, pcf, under};
use crate::stage::{Item, Stage, View, gpu, light, renders, woven};
use crate::support::{root, text};

static GO_ON: AtomicBool = AtomicBool::new(false);
const WATCH: Watch<'static> = Watch { cancel: &GO_ON, done: &|_| {} };

/// Fine texels along a texel.
const FACTOR: u32 = 8;

/// The eye of the truth sees what the renderer draws, at the same distance.
#[test]
fn the_eye_sees_what_is_rendered() {
    let Some(mut gpu) = gpu() else { return };
    if !renders(&gpu, "rgba32float") {
        return crate::stage::skipped("the adapter cannot render single precision");
    }
    let at = |x: f64, y: f64, z: f64| DMat4::from_translation(DVec3::new(x, y, z));
    let view = View {
        position: DVec3::new(1.5, 2.0, 4.0),
        target: DVec3::new(0.2, 0.4, 0.0),
        up: DVec3::new(0.1, 1.0, 0.0),
        half_height: 0.5,
        size: (80, 50),
    };
    let items = vec![
        Item::plane([8.0, 8.0], DMat4::IDENTITY),
        Item::new(&Shape::Sphere { radius: 0.6, segments: 32 }, at(-0.7, 0.6, 0.0)),
        Item::new(&Shape::Box { size: [0.8, 0.8, 0.8], bevel: 0.0 }, at(0.7, 0.4, 0.5) * DMat4::from_rotation_y(0.5)),
        Item::new(&Shape::Torus { major: 0.5, minor: 0.2, segments: 32 }, at(0.0, 0.2, 1.5)),
    ];
    let stage = Stage::new(items, view);
    let lamp = light("spot_light", "", "hard_shadow", "", "");
    let frame = stage.frame(&mut gpu, &woven(&[("light", &lamp)], Output::Depth));
    let (camera, world) = (stage.view.camera(), stage.world());
    let seen = |x: i64, y: i64| world.seen(&eye_ray(&camera, view.size, (x as u32, y as u32))).map(|s| s.0);
    let (mut covered, mut wrong) = (0, 0);
    for (pixel, drawn) in (0_i64..).zip(&frame.pixels) {
        let (x, y) = (pixel % 80, pixel / 80);
        let Some(distance) = seen(x, y) else {
            wrong += usize::from(drawn[3] > 0.0);
            continue;
        };
        covered += 1;
        // Rasterisers place vertices on a grid of 1/256 pixel, which shifts the picture by less than that; float32 leaves
        // some parts in 10^6. Where an outline runs through, what is seen may be on its other side.
        let around = [(1, 0), (-1, 0), (0, 1), (0, -1)].map(|(i, j)| seen((x + i).max(0), (y + j).max(0)));
        let change = around.map(|d| d.map_or(0.0, |d| (d - distance).abs())).into_iter().fold(0.0, f64::max);
        let off = (f64::from(drawn[0]) - distance).abs();
        wrong += usize::from(drawn[3] < 1.0 || off > change / 128.0 + 1e-5 * distance);
    }
    println!("{wrong} of {covered} pixels are not at the distance that the truth sees");
    assert!(covered > 2000 && wrong * 200 < covered, "{wrong} of {covered}");
}

/// The light of a lamp in float64.
fn lamp_light(lamp: Lamp, world: &World) -> Light {
    let (name, inputs) = match lamp {
        Lamp::Sun => ("orthographic", vec![vec![0.0, -1.0, 0.0], vec![0.0; 3], vec![1.0], vec![0.0]]),
        Lamp::Spot => {
            let angle = std::f64::consts::FRAC_PI_4;
            let place = [vec![0.0, 4.0, 0.0], vec![0.0, -1.0, 0.0]];
            ("perspective", place.into_iter().chain([vec![angle], vec![1.0], vec![5.0], vec![0.0]]).collect())
        }
    };
    Light::projected(name, &inputs, world).expect("a light")
}

/// What the exhaustive filter makes of the pixels of a stage that is all ground.
fn exhaustive(lamp: Lamp, stage: &Stage, weights: Weights, width: usize, taps: Taps) -> Vec<f64> {
    let world = stage.world();
    let filter = Filter { kernel: kernel(weights, width), taps, size: SIDE as u32, factor: FACTOR };
    let seen = points(&world, &stage.view.camera(), stage.view.size, WATCH).expect("not cancelled");
    let seen: Vec<_> = seen.into_iter().map(|p| p.expect("ground")).enumerate().collect();
    let light = lamp_light(lamp, &world);
    let found = visibility(&world, &light, Method::Filter(&filter), &seen, stage.view.size.0, WATCH);
    found.expect("not cancelled").into_iter().map(|e| e.mean).collect()
}

#[test]
fn the_exhaustive_filter_of_a_plate_is_the_closed_form() {
    for lamp in Lamp::BOTH {
        for (weights, width) in [(Weights::Box, 1), (Weights::Gaussian, 5), (Weights::Tent, 7)] {
            for taps in [Taps::Nearest, Taps::Bilinear] {
                for edge in [4.0, 4.3] {
                    let stage = under(lamp, &[Plate { height: 1.0, edge, angle: 0.0 }], 16.0, (64, 2));
                    let kernel = kernel(weights, width);
                    // An edge along fine texels is found exactly, others to half a fine texel, over which the filter
                    // changes by at most its greatest weight times that.
                    let on_boundary = edge * f64::from(FACTOR) == (edge * f64::from(FACTOR)).round();
                    let steepest = kernel.iter().copied().fold(0.0, f64::max);
                    let snapped = if on_boundary { 0.0 } else { steepest * 0.5 / f64::from(FACTOR) };
                    let found = exhaustive(lamp, &stage, weights, width, taps);
                    for (point, lit) in stage.on_ground(&found) {
                        let x = lamp.at(point).0 - SIDE / 2.0 - edge;
                        let expected = filter_below(&kernel, taps, x);
                        let what = format!("{lamp:?} {weights:?} {width} {taps:?}, edge {edge}, {x} from it");
                        assert!((lit - expected).abs() < snapped + CLOSED_FORM, "{what}: {lit} is not {expected}");
                        if taps == Taps::Nearest && on_boundary {
                            assert!((lit - edge_visibility(&kernel, x)).abs() < CLOSED_FORM, "{what}: {lit}");
                        }
                    }
                }
            }
        }
    }
}

/// Where an edge runs along texels, the renderer's filter has nothing to lose, and equals the exhaustive one.
#[test]
fn the_renderer_filters_a_plate_as_the_truth_does() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for (name, weights, width) in [("box", Weights::Box, 3), ("gaussian", Weights::Gaussian, 5)] {
            let stage = under(lamp, &[Plate { height: 1.0, edge: 4.0, angle: 0.0 }], 16.0, (64, 2));
            let drawn = stage.look(&mut gpu, &pcf(lamp, name, width, "bilinear"));
            let truth = exhaustive(lamp, &stage, weights, width, Taps::Nearest);
            let off = super::planar::worst(drawn.into_iter().zip(truth));
            assert!(off < 2.0 * CLOSED_FORM, "{lamp:?} {name} {width}: {off}");
        }
    }
}

/// Visibility and coverage of each pixel of a scene, by the program.
fn program(scene: &Path, light: &str, more: &[&str], out: &Path) -> Vec<Option<f64>> {
    let ran = Command::new(env!("CARGO_BIN_EXE_shadetree"))
        .current_dir(root())
        .args(["--quiet", "render", "--size", "96x54", "--samples", "1", "-o"])
        .args([out, scene])
        .args(["--aov", &format!("visibility:{light}")])
        .args(more)
        .output()
        .expect("the program runs");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let image = read_first_rgba_layer_from_file(
        out,
        |size, _| (size.width(), vec![None; size.area()]),
        |(width, pixels), at, (r, _, _, a): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = (a > 0.5).then_some(f64::from(r));
        },
    );
    image.expect("an OpenEXR picture").layer_data.channel_data.pixels.1
}

/// Visibility of a light in an example scene with another light graph, as it is rendered and as it ought to be.
fn drawn_and_true(name: &str, (from, to): (&str, &str), light: &str, asked: &[&str]) -> [Vec<Option<f64>>; 2] {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, out) = (folder.path().join("scene.ron"), folder.path().join("out.exr"));
    let graphs = root().join("graphs").display().to_string();
    let example = text(format!("graphs/scenes/{name}.ron").as_ref()).text.replace("\"../", &format!("\"{graphs}/"));
    std::fs::write(&scene, example.replace(from, to)).expect("written");
    let reference = [asked, &["--reference", "pcf", "--reference-samples", "4"]].concat();
    [asked, &reference].map(|asked| program(&scene, light, asked, &out))
}

#[test]
fn the_car_is_shadowed_as_the_truth_says() {
    if gpu().is_none() {
        return;
    }
    let asked = ["--option", "shadow.size=1024"];
    let [drawn, truth] = drawn_and_true("car", ("spot_soft", "spot_pcf"), "spot", &asked);
    let pairs: Vec<(f64, f64)> = drawn.iter().zip(&truth).filter_map(|(a, b)| Some(((*a)?, (*b)?))).collect();
    let differ = drawn.iter().zip(&truth).filter(|(a, b)| a.is_some() != b.is_some()).count();
    // The map knows edges to half a texel, over which the filter changes by at most its greatest weight times that. What
    // is off by more is where the renderer does without a comparison (surfaces that bend up count as one up to 7 degrees,
    // planes that run steeply away are not followed), which makes it lighter; and parts and gaps thinner than a texel,
    // which its map may miss.
    let snapped = kernel(Weights::Gaussian, 5).into_iter().fold(0.0, f64::max) * 0.5;
    let count = |test: &dyn Fn(f64, f64) -> bool| pairs.iter().filter(|(a, b)| test(*a, *b)).count();
    let penumbra = count(&|_, truth| truth > 0.0 && truth < 1.0);
    let rms = (pairs.iter().map(|(a, b)| (a - b).powi(2)).sum::<f64>() / pairs.len() as f64).sqrt();
    let far = count(&|drawn, truth| (drawn - truth).abs() > snapped);
    let dark = count(&|drawn, truth| drawn < truth - snapped);
    let all = pairs.len();
    println!(
        "car at 96 x 54: rms {rms:.4}, {penumbra} of {all} pixels half lit, {} off by more than 1/255, {far} by more than \
         {snapped:.3}, {dark} of them too dark",
        count(&|drawn, truth| (drawn - truth).abs() > 1.0 / 255.0),
    );
    if differ > all / 200
        || far > all / 100
        || dark > all / 1000
        || rms > snapped * (penumbra as f64 / all as f64).sqrt()
    {
        leave(&drawn, &truth);
        panic!("the pictures in target/ are not of one shadow; coverage differs in {differ} pixels");
    }
}

/// A view that is cut into parts, each with a map of its own, against the same parts in float64.
#[test]
fn the_parts_of_a_view_are_filtered_as_the_truth_says() {
    if gpu().is_none() {
        return;
    }
    let snapped = kernel(Weights::Gaussian, 3).into_iter().fold(0.0, f64::max) * 0.5;
    for fit in ["tight", "stable"] {
        let fit = format!("sun.fit={fit}");
        let asked = ["--kind", "shadow=pcf_shadow", "--option", "shadow.width=3", "--option", &fit];
        let [drawn, truth] = drawn_and_true("grazing", ("sun_fine", "sun_splits"), "sun", &asked);
        let pairs: Vec<(f64, f64)> = drawn.iter().zip(&truth).filter_map(|(a, b)| Some(((*a)?, (*b)?))).collect();
        let count = |test: &dyn Fn(f64, f64) -> bool| pairs.iter().filter(|(a, b)| test(*a, *b)).count();
        let shadow = count(&|_, truth| truth < 0.5);
        let far = count(&|drawn, truth| (drawn - truth).abs() > snapped);
        println!("{fit}: {shadow} of {} pixels in shadow, {far} off by more than {snapped:.3}", pairs.len());
        // As on the car: what half a texel may change, and where either does without comparisons.
        if shadow < 40 || far > pairs.len() / 100 {
            leave(&drawn, &truth);
            panic!("the pictures in target/ are not of one shadow");
        }
    }
}

/// Pictures to look at: what is rendered, what it should be, and the difference about grey.
fn leave(drawn: &[Option<f64>], truth: &[Option<f64>]) {
    let save = |name: &str, of: &dyn Fn(f64, f64) -> f64| {
        let value = |i: usize| of(drawn[i].unwrap_or(0.0), truth[i].unwrap_or(0.0)) as f32;
        let pixels: Vec<[f32; 4]> = (0..drawn.len()).map(|i| [value(i), value(i), value(i), 1.0]).collect();
        let png = shadetree::render::image_file::encode_png((96, 54), &pixels, &Default::default(), &[]);
        std::fs::write(root().join("target").join(name), png.expect("a PNG")).expect("written");
    };
    save("car_drawn.png", &|drawn, _| drawn);
    save("car_truth.png", &|_, truth| truth);
    save("car_difference.png", &|drawn, truth| 0.5 + 0.5 * (drawn - truth));
}
