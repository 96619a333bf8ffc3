//! The light of a shining rectangle against its integral over patches in float64.

use glam::{DMat3, DMat4, DVec3};
use shadetree::compile::Output;
use shadetree::reference::rectangle_irradiance;

use crate::stage::{Item, Stage, View, gpu, grain, light, visibility, woven};

/// Position, direction, width and height.
const LIGHTS: [(DVec3, DVec3, f64, f64); 4] = [
    (DVec3::new(0.3, 2.0, -0.2), DVec3::new(-0.2, -1.0, 0.3), 1.2, 0.5),
    (DVec3::new(0.0, 1.2, 0.0), DVec3::new(0.0, -1.0, 0.0), 0.3, 2.0),
    (DVec3::new(0.1, 0.7, 0.4), DVec3::new(0.1, -0.9, -0.6), 0.8, 0.8),
    // Far away, where the edges nearly cancel.
    (DVec3::new(20.0, 60.0, -30.0), DVec3::new(-20.0, -60.0, 30.0), 1.0, 0.5),
];

fn params((position, direction, width, height): (DVec3, DVec3, f64, f64)) -> String {
    format!(
        "\"position\": ({}, {}, {}), \"direction\": ({}, {}, {}), \"width\": {width}, \"height\": {height}, \"inner_angle\": 89, \
         \"outer_angle\": 89, \"intensity\": {}",
        position.x,
        position.y,
        position.z,
        direction.x,
        direction.y,
        direction.z,
        2.0 * width * height
    )
}

/// Columns x, y, z: z along the light, y as near to up as can be, x to the left of who looks along z.
fn axes(direction: DVec3) -> DMat3 {
    let z = direction.normalize();
    let up = if z.y.abs() > 0.9999 { DVec3::new(0.0, 0.0, -z.y.signum()) } else { DVec3::Y };
    let x = up.cross(z).normalize();
    DMat3::from_cols(x, z.cross(x), z)
}

/// With a radiance of 2: the vector's length facing the light, and its part along the normal on matte grey, as long as the
/// ground sees all of the rectangle. float32 knows an edge's share to some 1e-6, of which four are summed; the quadrature of
/// 200 by 200 patches is good to 1e-5 of them.
#[test]
fn irradiance_is_the_integral_over_the_rectangle() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in LIGHTS {
        let (position, direction, width, height) = lamp;
        let graph = format!(
            "Graph(version: 1, nodes: {{\"lamp\": (kind: \"rectangle_light\", params: {{{}}})}})",
            params(lamp)
        );
        let facing = woven(&[("light", &graph)], Output::Irradiance("light".into()));
        let matte = woven(&[("light", &graph)], Output::Radiance);
        let frame = axes(direction);
        let low = [-1.0, 1.0].map(|i| [-1.0, 1.0].map(|j| (frame * DVec3::new(i * width, j * height, 0.0) / 2.0).y));
        let lowest = position.y + low.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        assert!(lowest > 0.0, "all of the rectangle is above the ground");
        let view = View::down((0.05, 0.02), 0.5 * lowest.min(1.0), 1.2, (12, 12));
        let stage = Stage::new(vec![Item::plane([8.0, 8.0], DMat4::IDENTITY)], view);
        let (irradiance, radiance) = (stage.look(&mut gpu, &facing), stage.look(&mut gpu, &matte));
        let mut judged = 0;
        for ((point, irradiance), radiance) in stage.on_ground(&irradiance).zip(radiance) {
            let local = frame.transpose() * (point - position);
            if local.z < 0.05 {
                continue;
            }
            let vector = rectangle_irradiance((width / 2.0, height / 2.0), local.into(), 200);
            let vector = frame * DVec3::from(vector) * 2.0;
            // Toward the light; near the rim of 89 degrees the light is being cut off.
            if local.z < 0.05 * local.length() {
                continue;
            }
            let bar = (1e-4 + 2.0 * grain(&gpu)) * vector.length() + 4e-6;
            assert!((irradiance - vector.length()).abs() < bar, "{lamp:?} {point}: {irradiance} is not {vector}");
            let expected = vector.y * 0.7 / std::f64::consts::PI;
            assert!((radiance - expected).abs() < bar, "{lamp:?} {point}: {radiance} is not {expected}");
            judged += 1;
        }
        assert!(judged > 100, "{judged}");
    }
}

#[test]
fn behind_a_rectangle_it_is_dark_and_in_its_plane_nothing_jumps() {
    let Some(mut gpu) = gpu() else { return };
    let sideways = (DVec3::new(0.0, 0.5, 0.0), DVec3::new(1.0, 0.0, 0.0), 0.6, 0.4);
    let graph = format!(
        "Graph(version: 1, nodes: {{\"lamp\": (kind: \"rectangle_light\", params: {{{}}})}})",
        params(sideways)
    );
    let stage = Stage::new(vec![Item::plane([8.0, 8.0], DMat4::IDENTITY)], View::down((0.0, 0.0), 5.0, 1.0, (400, 1)));
    let values = stage.look(&mut gpu, &woven(&[("light", &graph)], Output::Irradiance("light".into())));
    for (point, value) in stage.on_ground(&values) {
        assert!(value >= 0.0 && (point.x > 0.0 || value == 0.0), "{point}: {value}");
    }
    let most = values.iter().copied().fold(0.0, f64::max);
    let jump = values.windows(2).map(|w| (w[0] - w[1]).abs()).fold(0.0, f64::max);
    assert!(most > 0.1 && jump < 0.05 * most, "{jump} of {most}");
}

/// The light's axes are those of its maps, whichever way it faces.
#[test]
fn a_rectangle_and_its_maps_share_their_axes() {
    let Some(mut gpu) = gpu() else { return };
    for direction in [DVec3::new(-0.2, -1.0, 0.3), DVec3::NEG_Y, DVec3::Y, DVec3::X] {
        let lamp = (DVec3::new(0.0, 3.0, 0.0), direction, 1.2, 0.5);
        let shader = visibility(&light("rectangle_light", &params(lamp), "hard_shadow", "", "\"size\": \"256\""));
        let stage =
            Stage::new(vec![Item::plane([8.0, 8.0], DMat4::IDENTITY)], View::down((0.0, 0.0), 1.0, 1.0, (4, 4)));
        let map = gpu.map(&stage.job(&shader), "light/lamp", 0).expect("renders");
        let space = map.spaces[0];
        let frame = axes(direction);
        for (i, axis) in [frame.x_axis, frame.y_axis, frame.z_axis].into_iter().enumerate() {
            let row = space.world_to_light.row(i).truncate().as_dvec3();
            assert!(row.distance(axis) < 1e-6, "{direction}: axis {i} is {row}, not {axis}");
        }
        assert_eq!(space.source.to_array(), [0.6, 0.25, 0.0, 1.0]);
    }
}
