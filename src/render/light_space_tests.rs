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
    Light { name: "lamp".into(), space: Some(Space { projection: projection.into(), inputs }) }
}

fn spot(values: &[(&str, &[f64])]) -> Result<LightSpace, RenderError> {
    let module = Module {
        parameters: vec![
            parameter("position", Shape::F32(3), "m", &[0.0, 5.0, 0.0]),
            parameter("direction", Shape::F32(3), "", &[0.0, -2.0, 0.0]),
            parameter("outer_angle", Shape::F32(1), "deg", &[45.0]),
            parameter("near", Shape::F32(1), "m", &[0.5]),
            parameter("range", Shape::F32(1), "m", &[10.5]),
        ],
        ..Module::default()
    };
    let light = light("perspective", &["position", "direction", "outer_angle", "near", "range"]);
    solve(&light, &module, values, &Bounds::default())
}

fn sun(values: &[(&str, &[f64])], bounds: &Bounds) -> Result<LightSpace, RenderError> {
    let module = Module {
        parameters: vec![
            parameter("direction", Shape::F32(3), "", &[1.0, -2.0, 0.5]),
            parameter("center", Shape::F32(3), "m", &[0.0, 0.0, 0.0]),
            parameter("radius", Shape::F32(1), "m", &[0.0]),
        ],
        ..Module::default()
    };
    solve(&light("orthographic", &["direction", "center", "radius"]), &module, values, bounds)
}

fn solve(
    light: &Light,
    module: &Module,
    values: &[(&str, &[f64])],
    bounds: &Bounds,
) -> Result<LightSpace, RenderError> {
    let values: BTreeMap<String, Value> =
        values.iter().map(|(n, v)| (format!("lamp.{n}"), Value::Numbers(v.to_vec()))).collect();
    light_space(light, module, &|p| values.get(&p.path).cloned(), bounds)
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
    assert_eq!(space.depth, Vec4::new(0.5, 10.5, 0.1, 0.0));
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
