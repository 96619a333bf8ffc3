//! Tests of the spaces of lights.

use std::collections::BTreeMap;

use super::*;
use crate::plan::Space;
use crate::semantic::Shape;

fn parameter(name: &str, shape: Shape, unit: &str, value: &[f64]) -> Parameter {
    Parameter {
        path: format!("lamp.{name}"),
        name: name.into(),
        shape,
        offset: 0,
        meaning: String::new(),
        unit: unit.into(),
        range: (None, None),
        default: Value::Numbers(value.to_vec()),
        value: Value::Numbers(value.to_vec()),
        doc: String::new(),
    }
}

fn light(projection: &str, inputs: &[&str]) -> Light {
    let inputs = inputs.iter().map(|i| format!("lamp.{i}")).collect();
    let settings = BTreeMap::new();
    Light { name: "lamp".into(), space: Some(Space { projection: projection.into(), inputs, settings, views: 1 }) }
}

fn spot(values: &[(&str, &[f64])]) -> Result<LightSpace, RenderError> {
    let module = Module {
        parameters: vec![
            parameter("position", Shape::F32(3), "m", &[0.0, 5.0, 0.0]),
            parameter("direction", Shape::F32(3), "", &[0.0, -2.0, 0.0]),
            parameter("outer_angle", Shape::F32(1), "deg", &[45.0]),
            parameter("near", Shape::F32(1), "m", &[0.5]),
            parameter("range", Shape::F32(1), "m", &[10.5]),
            parameter("size", Shape::F32(1), "m", &[0.25]),
        ],
        ..Module::default()
    };
    let light = light("perspective", &["position", "direction", "outer_angle", "near", "range", "size"]);
    solve(&light, &module, values, &Bounds::default())
}

fn sun(values: &[(&str, &[f64])], bounds: &Bounds) -> Result<LightSpace, RenderError> {
    let module = Module {
        parameters: vec![
            parameter("direction", Shape::F32(3), "", &[1.0, -2.0, 0.5]),
            parameter("center", Shape::F32(3), "m", &[0.0, 0.0, 0.0]),
            parameter("radius", Shape::F32(1), "m", &[0.0]),
            parameter("angle", Shape::F32(1), "deg", &[0.25]),
        ],
        ..Module::default()
    };
    solve(&light("orthographic", &["direction", "center", "radius", "angle"]), &module, values, bounds)
}

fn solve(
    light: &Light,
    module: &Module,
    values: &[(&str, &[f64])],
    bounds: &Bounds,
) -> Result<LightSpace, RenderError> {
    let values: BTreeMap<String, Value> =
        values.iter().map(|(n, v)| (format!("lamp.{n}"), Value::Numbers(v.to_vec()))).collect();
    let eye = Eye::new(&camera(), (4, 3));
    let around = Surroundings { bounds, eye: &eye, side: 256 };
    light_spaces(light, module, &|p| values.get(&p.path).cloned(), around).map(|views| views[0])
}

fn camera() -> crate::scene::Camera {
    crate::scene::Camera {
        position: Vec3::new(0.0, 1.0, 4.0),
        target: Vec3::ZERO,
        up: Vec3::Y,
        fov_y: 0.8,
        near: 0.1,
        far: 100.0,
    }
}

fn refused(result: &Result<LightSpace, RenderError>) -> &str {
    match result {
        Err(RenderError::Parameter { path, .. }) => path,
        other => panic!("a parameter should be refused, not {other:?}"),
    }
}

/// Corners of the cube from -1 to 1.
fn cube() -> Bounds {
    let mut bounds = Bounds::default();
    bounds.add(&[Vec3::splat(-1.0), Vec3::splat(1.0)], Mat4::IDENTITY);
    bounds
}

#[test]
fn a_spot_light_looks_along_its_axis() {
    let space = spot(&[]).expect("a sound spot light");
    let below = space.world_to_light.transform_point3(Vec3::new(0.0, 2.0, 0.0));
    assert!((below - Vec3::new(0.0, 0.0, 3.0)).length() < 1e-5, "{below}");
    // 45 degrees: what lies as far beside as ahead is at the edge of the map.
    assert!((space.projection - Vec4::new(1.0, 1.0, 1.0, 0.0)).length() < 1e-5);
    assert_eq!(space.depth, Vec4::new(0.5, 10.5, 0.1, f32::MAX));
}

#[test]
fn frames_are_rigid_for_any_axis() {
    for axis in [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.3, -0.9, 4.0], [1e-3, 1.0, 1e-3]] {
        let matrix = spot(&[("direction", &axis)]).expect("a sound axis").world_to_light;
        assert!((matrix.determinant() - 1.0).abs() < 1e-4, "{axis:?}");
        let ahead = matrix.transform_vector3(Vec3::from_array(axis.map(narrow)).normalize());
        assert!((ahead - Vec3::Z).length() < 1e-4, "{axis:?} {ahead}");
        assert!(matrix.transform_vector3(Vec3::Y).y >= -1e-4, "up stays up for {axis:?}");
    }
}

#[test]
fn values_of_a_draw_take_the_place_of_the_graphs() {
    let space = spot(&[("outer_angle", &[60.0]), ("range", &[2.5])]).expect("a sound spot light");
    assert!((space.projection.x - 60_f32.to_radians().tan().recip()).abs() < 1e-5);
    assert_eq!(space.depth.y, 2.5);
}

#[test]
fn what_no_map_can_show_is_refused_with_its_path() {
    assert_eq!(refused(&spot(&[("direction", &[0.0, 0.0, 0.0])])), "lamp.direction");
    assert_eq!(refused(&spot(&[("position", &[f64::NAN, 0.0, 0.0])])), "lamp.position");
    assert_eq!(refused(&spot(&[("outer_angle", &[90.0])])), "lamp.outer_angle");
    assert_eq!(refused(&spot(&[("near", &[0.0])])), "lamp.near");
    assert_eq!(refused(&spot(&[("range", &[0.1])])), "lamp.range");
    assert_eq!(refused(&sun(&[("radius", &[-1.0])], &cube())), "lamp.radius");
    assert_eq!(refused(&sun(&[("center", &[f64::INFINITY, 0.0, 0.0])], &cube())), "lamp.center");
}

#[test]
fn parallel_light_without_a_radius_holds_the_whole_scene() {
    let mut bounds = cube();
    bounds.add(&[Vec3::ZERO, Vec3::ONE], Mat4::from_translation(Vec3::new(4.0, 0.0, -3.0)));
    let space = sun(&[], &bounds).expect("a sound sun");
    assert_eq!(space.projection.z, 0.0);
    for corner in bounds.corners.iter().flatten() {
        let light = space.world_to_light.transform_point3(*corner);
        let ndc = light.truncate() * space.projection.truncate().truncate();
        assert!(ndc.abs().max_element() <= 1.0 + 1e-5, "{ndc}");
        assert!(light.z >= 0.0 && light.z <= space.depth.y, "{light}");
    }
}

#[test]
fn parallel_light_with_a_radius_fits_only_its_depth() {
    let space = sun(&[("radius", &[0.5]), ("direction", &[0.0, -1.0, 0.0])], &cube()).expect("a sound sun");
    assert_eq!(space.projection.x, 2.0);
    assert!((space.depth.y - 2.0).abs() < 0.01, "the cube is two metres high: {}", space.depth.y);
    let top = space.world_to_light.transform_point3(Vec3::new(0.0, 1.0, 0.0));
    assert!(top.z.abs() < 0.01 && top.truncate().length() < 1e-5, "{top}");
}

#[test]
fn a_scene_without_anything_still_has_a_space() {
    let space = sun(&[], &Bounds::default()).expect("an empty scene is no mistake");
    assert!(space.to_bytes().len() as u64 == LIGHT_SPACE_BYTES && space.depth.is_finite());
}

#[test]
fn only_what_the_map_covers_counts_for_its_depth() {
    let mut bounds = cube();
    // A floor of a kilometre, seen at a slant, and something high that is far off the column.
    let floor = [Vec3::new(-500.0, -1.5, -500.0), Vec3::new(500.0, -1.0, 500.0)];
    bounds.add(&floor, Mat4::IDENTITY);
    bounds.add(&[Vec3::ZERO, Vec3::ONE], Mat4::from_translation(Vec3::new(0.0, 0.0, 300.0)));
    let slanted: (&str, &[f64]) = ("direction", &[1.0, -1.0, 0.0]);
    let space = sun(&[("radius", &[2.0]), slanted], &bounds).expect("a sound sun");
    assert!(space.depth.y > 4.0 && space.depth.y < 8.0, "{}", space.depth.y);
    // Where the edge of the column meets the floor, both ends of the range are still in front and behind.
    for point in [Vec3::new(0.0, -1.0, 0.0), Vec3::new(1.5, -1.0, 1.0), Vec3::splat(1.0), Vec3::splat(-1.0)] {
        let z = space.world_to_light.transform_point3(point).z;
        assert!((0.0..=space.depth.y).contains(&z), "{point} {z}");
    }
}

fn views(light: &Light, module: &Module, bounds: &Bounds, eye: &Eye) -> Vec<LightSpace> {
    let around = Surroundings { bounds, eye, side: 256 };
    light_spaces(light, module, &|_| None, around).expect("sound")
}

/// Map coordinates of a world point, in ndc.
fn ndc(view: &LightSpace, point: Vec3) -> (f32, f32) {
    let p = view.world_to_light.transform_point3(point);
    let divisor = if view.projection.z > 0.5 { p.z } else { 1.0 };
    (p.x * view.projection.x / divisor, p.y * view.projection.y / divisor)
}

#[test]
fn the_faces_of_a_cube_see_all_directions_with_a_border() {
    let module = Module {
        parameters: vec![
            parameter("position", Shape::F32(3), "m", &[1.0, 2.0, 3.0]),
            parameter("near", Shape::F32(1), "m", &[0.5]),
            parameter("range", Shape::F32(1), "m", &[10.5]),
            parameter("size", Shape::F32(1), "m", &[0.25]),
        ],
        ..Module::default()
    };
    let light = light("cube", &["position", "near", "range", "size"]);
    let faces = views(&light, &module, &Bounds::default(), &Eye::new(&camera(), (4, 3)));
    assert_eq!(faces.len(), 6);
    // The shader finds the face from the first view: its axes are -z, +y and +x of the world.
    let first = faces[0].world_to_light;
    assert!((first.transform_vector3(Vec3::X) - Vec3::Z).length() < 1e-6);
    assert!((first.transform_vector3(Vec3::Y) - Vec3::Y).length() < 1e-6);
    assert!((first.transform_vector3(Vec3::Z) + Vec3::X).length() < 1e-6);
    for (index, axis) in [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z].into_iter().enumerate() {
        let face = faces[index];
        assert_eq!(face.projection.w, index as f32);
        let middle = ndc(&face, Vec3::new(1.0, 2.0, 3.0) + axis * 4.0);
        assert!(middle.0.abs() < 1e-6 && middle.1.abs() < 1e-6, "{index}");
        // A corner of the cube lies inside the face, a sixteenth of half its width from the rim.
        let corner = ndc(&face, Vec3::new(1.0, 2.0, 3.0) + axis + axis.any_orthonormal_vector());
        let edge = corner.0.abs().max(corner.1.abs());
        assert!((edge - 16.0 / 17.0).abs() < 1e-5, "{index} {edge}");
    }
}

fn split_sun(splits: u32, fit: &str, reach: f64) -> (Light, Module) {
    let module = Module {
        parameters: vec![
            parameter("direction", Shape::F32(3), "", &[1.0, -2.0, 0.5]),
            parameter("center", Shape::F32(3), "m", &[0.0, 0.0, 0.0]),
            parameter("radius", Shape::F32(1), "m", &[0.0]),
            parameter("angle", Shape::F32(1), "deg", &[0.25]),
            parameter("balance", Shape::F32(1), "", &[0.7]),
            parameter("reach", Shape::F32(1), "m", &[reach]),
        ],
        ..Module::default()
    };
    let mut light = light("orthographic", &["direction", "center", "radius", "angle", "balance", "reach"]);
    if let Some(space) = &mut light.space {
        space.views = splits;
        space.settings.insert("fit".into(), fit.into());
    }
    (light, module)
}

/// A ground of 100 m by 100 m.
fn ground() -> Bounds {
    let mut bounds = Bounds::default();
    bounds.add(&[Vec3::new(-50.0, 0.0, -50.0), Vec3::new(50.0, 2.0, 50.0)], Mat4::IDENTITY);
    bounds
}

#[test]
fn every_split_shows_all_that_is_seen_of_it() {
    let eye = Eye::new(&camera(), (16, 9));
    for fit in ["tight", "stable"] {
        let (light, module) = split_sun(4, fit, 30.0);
        let views = views(&light, &module, &ground(), &eye);
        assert!(views.windows(2).all(|w| w[0].depth.w < w[1].depth.w), "{fit}");
        assert!(views.windows(2).all(|w| w[0].projection.x > w[1].projection.x), "{fit}: nearer splits are finer");
        assert!((views[3].source.w - 1.0).abs() < 1e-6 && views[0].source.w > 2.0, "{fit}");
        for i in 0..2_000_u32 {
            let part = |n: u32| (i.wrapping_mul(2_654_435_761).rotate_left(n) % 1000) as f32 / 999.0 * 2.0 - 1.0;
            let distance = 0.5 + 29.0 * (part(9) * 0.5 + 0.5);
            let point = eye.position
                + (eye.forward + eye.right * (part(3) * eye.half.0) + eye.up * (part(17) * eye.half.1)) * distance;
            if point.y < 0.0 || point.y > 2.0 || point.x.abs().max(point.z.abs()) > 50.0 {
                continue;
            }
            let split = views.iter().position(|v| eye.depth(point) <= v.depth.w).expect("the last takes all");
            let (x, y) = ndc(&views[split], point);
            assert!(x.abs() < 1.0 && y.abs() < 1.0, "{fit} split {split}: {point} at {x} {y}");
        }
    }
}

/// Law T17: the texels of a stable split stay where they are in the world while the eye moves and turns.
#[test]
fn stable_splits_move_by_whole_texels_and_keep_their_size() {
    let (light, module) = split_sun(3, "stable", 40.0);
    let mut moved = camera();
    let before = views(&light, &module, &ground(), &Eye::new(&moved, (16, 9)));
    for step in 1..40 {
        let along = Vec3::new(0.013, 0.002, -0.021) * step as f32;
        moved.position = camera().position + along;
        moved.target = camera().target + along + Vec3::new(0.3, 0.1, 0.0) * (step as f32 * 0.11).sin();
        let after = views(&light, &module, &ground(), &Eye::new(&moved, (16, 9)));
        for (a, b) in before.iter().zip(&after) {
            assert_eq!(a.projection, b.projection);
            let texel = |v: &LightSpace| {
                let (x, y) = ndc(v, Vec3::new(0.3, 0.0, 0.7));
                (x * 128.0, y * 128.0)
            };
            let (from, to) = (texel(a), texel(b));
            for change in [to.0 - from.0, to.1 - from.1] {
                assert!((change - change.round()).abs() < 2e-2, "{step}: {change}");
            }
        }
    }
}
