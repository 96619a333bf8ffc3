//! Depths that are not there, or not numbers: empty maps, receivers that do not cast, broken triangles.

use glam::{DMat4, DVec3, Vec2, Vec3, Vec4};
use shadetree::reference::{Weights, chebyshev, edge_visibility, kernel};
use shadetree::render::Gpu;
use shadetree::scene::{Mesh, Shape};

use super::bench::{Numbers, SHADOWS, least, most, shadows, single_precision};
use super::bleeding::WEIGHTS;
use super::table::{Bound, Table};
use crate::laws::lamp::{CLOSED_FORM, Lamp, PLAIN, Plate, SIDE, pcf, under, vsm};
use crate::stage::{Item, Stage, View, gpu, light, skipped, visibility};

/// What a map holds where nothing was drawn is as far as can be.
#[test]
fn empty_maps_hold_the_far_plane() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "far_clear",
        "A ground that receives but does not cast, under nothing, and under the edge of a plate 1 m above it, in a\nspotlight from 4 m that reaches 5 m: beside the plate the map holds the far plane, a quarter of the range behind.\nA map cleared to 0 would darken all of it.",
        WEIGHTS,
        (2e-3, 0.0),
    );
    for lamp in Lamp::BOTH {
        for shadow in shadows(&gpu) {
            let mut ground = Item::plane([16.0, 16.0], DMat4::IDENTITY);
            ground.casts = false;
            let stage = Stage::new(vec![ground], View::down((0.0, 0.0), 0.8, 1.6, (32, 32)));
            let (kind, at) = lamp.kind();
            let values = stage.look(&mut gpu, &visibility(&light(kind, at, shadow, "", "")));
            let what = format!("{lamp:?}, nothing casts, {shadow}: darkest");
            table.row(what, "lit", least(&values), Bound::Least(1.0 - 1e-6));
        }
    }
    let mut stage = under(Lamp::Spot, &[Plate { height: 1.0, edge: 4.0, angle: 0.0 }], 16.0, (320, 2));
    stage.items[0].casts = false;
    let kernel = kernel(Weights::Gaussian, 5);
    let truth = |p: DVec3| edge_visibility(&kernel, Lamp::Spot.at(p).0 - SIDE / 2.0 - 4.0);
    let compared = stage.look(&mut gpu, &pcf(Lamp::Spot, "gaussian", 5, "bilinear"));
    let off: Vec<f64> = stage.on_ground(&compared).map(|(p, v)| (v - truth(p)).abs()).collect();
    table.row("edge, pcf_shadow: largest error", "T4", most(&off), Bound::Most(CLOSED_FORM));
    let (near, receiver, far) = (Lamp::Spot.depth(1.0), Lamp::Spot.depth(0.0), 1.0);
    let bound = |p: f64| chebyshev(p * far + (1.0 - p) * near, p * far * far + (1.0 - p) * near * near, receiver, 1e-6);
    let values = stage.look(&mut gpu, &vsm(Lamp::Spot, "gaussian", 5, PLAIN));
    let pixels: Vec<(f64, f64)> = stage.on_ground(&values).map(|(p, v)| (truth(p), v)).collect();
    let off: Vec<f64> = pixels.iter().map(|(p, v)| (v - bound(*p)).abs()).collect();
    table.wide(
        "edge, variance_shadow: largest distance from p_max",
        "T13: Chebyshev's bound",
        most(&off),
        Bound::Most(CLOSED_FORM),
    );
    let lit = pixels.iter().filter(|(_, v)| *v > 1.0 - 1e-6).map(|(p, _)| *p).fold(1.0, f64::min);
    let law = (receiver - near) / (far - near);
    // 20 pixels a texel, over which the edge rises by at most 0.4 a texel.
    table.row("edge, variance_shadow: least p that is fully lit", "T13: (t - A) / L", lit, Bound::Near(law, 0.02));
    table.check(&gpu);
}

/// Depths above 1 must not reach exponentials, and weigh more in means than they should.
#[test]
fn what_lies_beyond_the_far_plane_is_no_number_too_large() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "beyond_far",
        "The same edge over a ground that does not cast, with a floor 20 m below it, almost five ranges beyond the far plane:\nvalues of the map that are no numbers, where all of the filter sees the floor the darkest pixel, and where none does\nthe brightest. Moments keep the depth of what lies beyond, as surfaces that run through the far plane ask; the less of\nit is enough to be falsely lit.",
        WEIGHTS,
        (2e-3, 0.0),
    );
    let mut stage = under(Lamp::Spot, &[Plate { height: 1.0, edge: 4.0, angle: 0.0 }], 16.0, (320, 2));
    stage.items[0].casts = false;
    stage.items.push(Item::plane([60.0, 60.0], DMat4::from_translation(DVec3::NEG_Y * 20.0)));
    for shadow in shadows(&gpu) {
        let shader = Lamp::Spot.shadow(shadow, "", "");
        if let Ok(map) = gpu.map(&stage.job(&shader), "light/lamp", 0) {
            let strange = map.pixels.iter().flatten().filter(|x| !x.is_finite()).count();
            table.row(format!("{shadow}: not a number"), "none", strange as f64, Bound::Most(0.0));
        }
        let values = stage.look(&mut gpu, &shader);
        let side = |right: bool| {
            let far = stage.on_ground(&values).map(|(p, v)| (Lamp::Spot.at(p).0 - SIDE / 2.0 - 4.0, v));
            far.filter(|(x, _)| if right { *x > 3.6 } else { *x < -3.6 }).map(|(_, v)| v).collect::<Vec<_>>()
        };
        table.row(format!("{shadow}: darkest over the floor"), "lit", least(&side(true)), Bound::Least(1.0 - 1e-6));
        // The gap is a quarter of the range.
        table.row(format!("{shadow}: brightest under the plate"), "dark", most(&side(false)), Bound::Most(1e-4));
    }
    if single_precision(&gpu) {
        let kernel = kernel(Weights::Gaussian, 5);
        let values = stage.look(&mut gpu, &vsm(Lamp::Spot, "gaussian", 5, PLAIN));
        let truth = |p: DVec3| edge_visibility(&kernel, Lamp::Spot.at(p).0 - SIDE / 2.0 - 4.0);
        let lit = stage.on_ground(&values).filter(|(_, v)| *v > 1.0 - 1e-6).map(|(p, _)| truth(p)).fold(1.0, f64::min);
        let (near, receiver) = (Lamp::Spot.depth(1.0), Lamp::Spot.depth(0.0));
        let law = (receiver - near) / (Lamp::Spot.depth(-20.0) - near);
        table.row("variance_shadow: least p that is fully lit", "T13: (t - A) / L", lit, Bound::Near(law, 0.02));
    }
    table.check(&gpu);
}

/// Triangles that no one should draw, within the light's view.
fn broken() -> Vec<(&'static str, Mesh)> {
    let mesh = |points: [[f32; 3]; 3]| {
        let positions: Vec<Vec3> = points.into_iter().map(Vec3::from_array).collect();
        let plane = Shape::Plane { size: [1.0, 1.0], segments: [1, 1] }.mesh().expect("a primitive");
        let first = |n: usize| n.min(plane.positions.len() - 1);
        Mesh {
            normals: (0..3).map(|i| plane.normals[first(i)]).collect(),
            texcoords: (0..3).map(|i| plane.texcoords[first(i)]).collect(),
            tangents: (0..3).map(|i| plane.tangents[first(i)]).collect(),
            colors: (0..3).map(|i| plane.colors[first(i)]).collect(),
            indices: vec![0, 1, 2, 0, 2, 1],
            positions,
        }
    };
    let (nan, inf) = (f32::NAN, f32::INFINITY);
    let point = [0.1, 1.0, 0.1];
    vec![
        ("a point", mesh([point, point, point])),
        ("a line", mesh([[-0.5, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 1.0, 0.0]])),
        ("a line along the light", mesh([[0.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 1.5, 0.0]])),
        ("a sliver of 1e-20 m", mesh([[-0.5, 1.0, 0.0], [0.5, 1.0, 0.0], [0.0, 1.0, 1e-20]])),
        ("one NaN", mesh([[-0.5, 1.0, 0.0], [0.5, 1.0, 0.0], [0.0, nan, 0.5]])),
        ("all NaN", mesh([[nan; 3]; 3])),
        ("one infinity", mesh([[-0.5, 1.0, 0.0], [0.5, 1.0, 0.0], [0.0, 1.0, inf]])),
        ("one minus infinity", mesh([[-0.5, 1.0, 0.0], [0.5, 1.0, 0.0], [0.0, -inf, 0.5]])),
    ]
}

/// A cube on the ground from above, in a light from above, and a speck at 2 m, so that the light's range stays the same.
fn cube() -> Stage {
    let at = |x: f64, y: f64, z: f64| DMat4::from_translation(DVec3::new(x, y, z));
    let items = vec![
        Item::plane([16.0, 16.0], DMat4::IDENTITY),
        Item::new(&Shape::Box { size: [0.5; 3], bevel: 0.0 }, at(0.6, 0.25, 0.6)),
        Item::plane([0.01, 0.01], at(0.9, 2.0, -0.9)),
    ];
    Stage::new(items, View::down((0.0, 0.0), 1.9, 1.7, (32, 32)))
}

/// Five thousand triangles between 0.6 and 1.4 m above the ground, each a ten thousandth of a metre wide or less.
fn slivers() -> Mesh {
    let mut numbers = Numbers(7);
    let mut mesh = Mesh::default();
    for _ in 0..5000 {
        let mut point = |low: f64, high: f64, y: [f64; 2]| {
            DVec3::new(numbers.within(low, high), numbers.within(y[0], y[1]), numbers.within(low, high))
        };
        let (a, b) = (point(-0.8, 0.8, [0.6, 1.4]), point(-0.8, 0.8, [0.6, 1.4]));
        let aside = point(-1.0, 1.0, [0.0, 0.0]) * 10_f64.powf(numbers.within(-9.0, -4.0));
        let along = numbers.within(0.2, 0.8);
        let first = u32::try_from(mesh.positions.len()).expect("few");
        for p in [a, b, a.lerp(b, along) + aside] {
            mesh.positions.push(p.as_vec3());
            mesh.normals.push(Vec3::Y);
            mesh.texcoords.push(Vec2::ZERO);
            mesh.tangents.push(Vec4::X);
            mesh.colors.push(Vec4::ONE);
        }
        mesh.indices.extend([first, first + 1, first + 2, first, first + 2, first + 1]);
    }
    mesh
}

/// Texels of a map over slivers: at the light, though nothing is; elsewhere nearer than the nearest vertex or farther
/// than the ground, as a share of those that slivers cover.
fn strays(gpu: &mut Gpu, lamp: Lamp, shadow: &str) -> [f64; 2] {
    let (kind, at) = lamp.kind();
    let unblurred = if shadow == "hard_shadow" { "" } else { ", \"width\": \"1\"" };
    let shader = visibility(&light(kind, at, shadow, "", &format!("\"size\": \"512\"{unblurred}")));
    let mut stage = cube();
    stage.items[1] = Item::of(slivers(), DMat4::IDENTITY);
    let map = gpu.map(&stage.job(&shader), "light/lamp", 0).expect("renders");
    let space = map.spaces[0];
    let depth =
        |y: f32| f64::from((space.world_to_light.transform_point3(Vec3::Y * y).z - space.depth.x) * space.depth.z);
    let speck = depth(2.0);
    let (near, far) = (depth(1.4) - 1e-5, depth(0.0) + 1e-5);
    let texels: Vec<f64> = map.pixels.iter().map(|t| f64::from(t[0])).collect();
    let slivers = |z: f64| z < depth(0.5) && (z - speck).abs() > 1e-4;
    let drawn = texels.iter().filter(|z| slivers(**z)).count();
    assert!(drawn > 200, "slivers are hit: {drawn}");
    let at_light = texels.iter().filter(|z| **z < speck - 1e-4).count();
    let off = texels.iter().filter(|z| **z > far || slivers(**z) && **z < near && **z > speck).count();
    [at_light as f64, off as f64 / drawn as f64]
}

/// What broken casters do to a map and to the picture of it: texels that are no numbers, texels outside of [0, 1], and
/// the largest change of a pixel.
fn harm(gpu: &mut Gpu, lamp: Lamp, shadow: &str, mesh: Mesh) -> [f64; 3] {
    let (kind, at) = lamp.kind();
    let shader = visibility(&light(kind, at, shadow, "", "\"size\": \"256\""));
    let mut stage = cube();
    let before = stage.look(gpu, &shader);
    stage.items.push(Item::of(mesh, DMat4::IDENTITY));
    let frame = stage.frame(gpu, &shader);
    let change = frame.pixels.iter().zip(&before).map(|(p, b)| (f64::from(p[0]) - b).abs());
    // A pixel that is no number is as bad as can be.
    let change = change.map(|c| if c.is_nan() { f64::INFINITY } else { c }).fold(0.0, f64::max);
    let map = gpu.map(&stage.job(&shader), "light/lamp", 0).expect("renders");
    let texels = || map.pixels.iter().flat_map(|t| &t[..map.channels]);
    let strange = texels().filter(|x| !x.is_finite()).count();
    let outside = texels().filter(|x| !(-1e-6..=1.0 + 1e-6).contains(*x)).count();
    [strange as f64, outside as f64, change]
}

#[test]
fn broken_triangles_leave_no_mark() {
    let Some(mut gpu) = gpu() else { return };
    let (kind, at) = Lamp::Spot.kind();
    if let Err(why) = gpu.map(&cube().job(&visibility(&light(kind, at, "hard_shadow", "", ""))), "light/lamp", 0) {
        return skipped(&why.to_string());
    }
    let mut table = Table::new(
        "degenerate",
        "A cube on the ground, and above it a triangle without an area or with a vertex that is no number: texels of the\nmap that are no numbers, or outside of [0, 1], and the largest change of a pixel, over both lights. Then slivers that\nare thinner than a texel: texels as near as the near plane, and others whose depth is not between those of vertices.",
        (
            1.0,
            "what becomes of a vertex that is no number, or of a triangle thinner than the grid, is up to the device",
        ),
        (0.0, 0.0),
    );
    for (what, mesh) in broken() {
        for shadow in SHADOWS {
            let [sun, spot] = Lamp::BOTH.map(|lamp| harm(&mut gpu, lamp, shadow, mesh.clone()));
            let worst: [f64; 3] = std::array::from_fn(|i| sun[i].max(spot[i]));
            table.row(format!("{what}, {shadow}: not a number"), "none", worst[0], Bound::Most(0.0));
            table.row(format!("{what}, {shadow}: outside"), "none", worst[1], Bound::Most(0.0));
            table.wide(format!("{what}, {shadow}: change"), "none", worst[2], Bound::Most(0.0));
        }
    }
    for (what, mesh) in broken() {
        for shadow in shadows(&gpu).into_iter().skip(SHADOWS.len()) {
            let [strange, _, change] = harm(&mut gpu, Lamp::Spot, shadow, mesh.clone());
            table.row(format!("{what}, {shadow}: not a number"), "none", strange, Bound::Most(0.0));
            table.wide(format!("{what}, {shadow}: change"), "none", change, Bound::Most(0.0));
        }
    }
    for shadow in SHADOWS {
        for lamp in Lamp::BOTH {
            let [at_light, off] = strays(&mut gpu, lamp, shadow);
            let what = format!("5000 slivers, {lamp:?}, {shadow}");
            table.row(format!("{what}: at the light"), "none", at_light, Bound::Most(0.0));
            table.wide(format!("{what}: share beyond their vertices"), "up to the device", off, Bound::Most(0.01));
        }
    }
    table.check(&gpu);
}
