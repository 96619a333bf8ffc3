use super::super::{Body, Weights, kernel};
use super::*;
use crate::scene::{Mesh, Shape};
use glam::{Mat4, Vec3};

const SIZE: u32 = 64;
/// Metres on a side of the map; the parallel light covers that much, the other at the ground.
const EXTENT: f64 = 4.0;

/// Straight above the ground, which is 4 m below a light of perspective.
fn views() -> [View; 2] {
    let above = DVec3::Y * 4.0;
    [
        View::parallel(above, DVec3::NEG_Y, EXTENT / 2.0, -1.0),
        View::perspective(above, DVec3::NEG_Y, (EXTENT / 2.0 / 4.0_f64).atan(), 0.1),
    ]
}

fn plate(size: f64) -> Mesh {
    Shape::Plane { size: [size, size], segments: [1, 1] }.mesh().expect("a plane")
}

fn point(x: f64, z: f64, triangle: u32) -> Point {
    Point { position: DVec3::new(x, 0.0, z), normal: DVec3::Y, triangle, receives: true }
}

/// A ground and a plate 2 m above it whose edge, on the map, runs at `angle` to the columns `edge` texels right of the
/// middle; what lies left of it is covered.
fn scene(view: &View, angle: f64, edge: f64) -> World {
    let scale = if view.projection == Projection::Perspective { 0.5 } else { 1.0 };
    let beside = Vec3::new((edge * EXTENT / f64::from(SIZE) * scale - 20.0) as f32, 2.0, 0.0);
    let place = Mat4::from_rotation_y(angle as f32) * Mat4::from_translation(beside);
    let plate = plate(40.0);
    let body = |object_to_world| Body { mesh: &plate, object_to_world, casts: true, receives: true };
    World::new(&[body(Mat4::IDENTITY), body(place)])
}

/// The filter over the half plane where cos x + sin y > edge, x right and y down in texels from the middle: exact along
/// x, by 4000 steps along y.
fn truth(filter: &Filter, angle: f64, edge: f64, (x, y): (f64, f64)) -> f64 {
    let reach = reach(filter.kernel.len(), filter.taps);
    let below = |d: f64| filter_below(&filter.kernel, filter.taps, d);
    let steps = 4000;
    let at = |i: i32| (f64::from(i) / f64::from(steps) * 2.0 - 1.0) * reach;
    let parts = (0..steps).map(|i| {
        let middle = (at(i) + at(i + 1)) / 2.0;
        let crossing = (edge - angle.sin() * (y + middle)) / angle.cos() - x;
        (below(at(i + 1)) - below(at(i))) * (1.0 - below(crossing))
    });
    parts.sum()
}

fn filter(weights: Weights, width: usize, taps: Taps, factor: u32) -> Filter {
    Filter { kernel: kernel(weights, width), taps, size: SIZE, factor }
}

/// Root of the mean square error over edges at many angles and places.
fn error(view: &View, weights: Weights, taps: Taps, factor: u32) -> f64 {
    let filter = filter(weights, 3, taps, factor);
    let (mut sum, mut count) = (0.0, 0.0);
    for i in 0..16 {
        let (angle, edge) = (f64::from(i) * 0.073 - 0.6, 2.0 + f64::from(i) * 0.37);
        let world = scene(view, angle, edge);
        let mut map = FineMap::new(&world, *view, &filter);
        for (x, y) in [(edge, 0.3), (edge + 1.3, -0.4), (edge - 1.8, 0.8)] {
            let texel = EXTENT / f64::from(SIZE);
            let lit = map.lit(&point(x * texel, -y * texel, 0));
            // Positions are float32, which moves edges by parts in 10^7 of 20 m: 1e-4 texel.
            sum += (lit - truth(&filter, angle, edge, (x, y))).powi(2);
            count += 1.0;
        }
    }
    f64::sqrt(sum / count)
}

#[test]
fn twice_as_fine_a_map_halves_the_error_at_least() {
    for view in views() {
        for (weights, taps) in
            [(Weights::Box, Taps::Nearest), (Weights::Gaussian, Taps::Bilinear), (Weights::Tent, Taps::Bilinear)]
        {
            let errors = [2, 4, 8, 16].map(|factor| error(&view, weights, taps, factor));
            assert!(errors.windows(2).all(|e| e[1] < e[0] / 2.0), "{weights:?} {taps:?}: {errors:?}");
            // An edge is found to half a fine texel, and no filter of width 3 changes by more than 1/2 in a texel.
            assert!(errors[2] < 0.5 * 0.5 / 8.0, "{weights:?} {taps:?}: {errors:?}");
        }
    }
}

/// An edge on a boundary of fine texels is found exactly: a ramp as wide as the kernel, and the tent's mean of it.
#[test]
fn an_edge_along_fine_texels_is_the_closed_form() {
    for view in views() {
        for (_, weights) in Weights::ALL {
            for (width, taps) in [(1, Taps::Nearest), (3, Taps::Bilinear), (7, Taps::Nearest), (9, Taps::Bilinear)] {
                let filter = filter(weights, width, taps, 8);
                let world = scene(&view, 0.0, 4.0);
                let mut map = FineMap::new(&world, view, &filter);
                for i in -40..=40 {
                    let x = f64::from(i) * 0.13;
                    let lit = map.lit(&point((x + 4.0) * EXTENT / f64::from(SIZE), 0.01, 0));
                    let expected = filter_below(&filter.kernel, taps, x);
                    assert!((lit - expected).abs() < 1e-9, "{weights:?} {width} {taps:?} at {x}: {lit} {expected}");
                }
            }
        }
    }
}

/// However a lit plane lies to the light, no texel of it is nearer than itself; nor is any of a ball or a ring, inside or
/// out, where the light sees it and nothing is in between.
#[test]
fn lit_surfaces_do_not_shadow_themselves() {
    let filter = filter(Weights::Gaussian, 5, Taps::Bilinear, 4);
    let shapes = [
        (Shape::Plane { size: [3.0, 3.0], segments: [7, 5] }, 0.9_f32),
        (Shape::Sphere { radius: 1.0, segments: 24 }, 0.0),
        (Shape::Torus { major: 1.0, minor: 0.5, segments: 24 }, 0.3),
    ];
    for view in views() {
        for (shape, tilt) in &shapes {
            let mesh = shape.mesh().expect("a primitive");
            let place = Mat4::from_translation(Vec3::new(0.1, 0.5, 0.0)) * Mat4::from_rotation_x(*tilt);
            let world = World::new(&[Body { mesh: &mesh, object_to_world: place, casts: true, receives: true }]);
            let mut map = FineMap::new(&world, view, &filter);
            let (mut count, mut worst) = (0, 1.0_f64);
            for i in 0..900 {
                let at = DVec2::new(f64::from(i % 30) + 0.31, f64::from(i / 30) + 0.77) / 30.0;
                let Some((_, point)) = world.seen(&view.ray(at)) else { continue };
                // Beyond the outline of a steep facet the plane runs behind what the light sees next to it.
                let ray = view.ray(at).direction.normalize();
                if point.normal.dot(ray) < -0.5 {
                    count += 1;
                    worst = worst.min(map.lit(&point));
                }
            }
            assert!(count > 100 && worst > 1.0 - 1e-9, "{shape:?} under {view:?}: {count} points, {worst}");
        }
    }
}

#[test]
fn what_is_beside_the_map_or_in_front_of_it_is_lit() {
    let [_, spot] = views();
    let world = scene(&spot, 0.0, 0.0);
    let filter = filter(Weights::Box, 3, Taps::Bilinear, 4);
    let lit = |view: View, x: f64| FineMap::new(&world, view, &filter).lit(&point(x, 0.0, 0));
    assert!(lit(spot, -1.0) < 1e-9 && lit(spot, -2.01) == 1.0);
    assert!(lit(View { near: 2.1, ..spot }, -1.0) > 1.0 - 1e-9, "the plate is in front of the near plane");
    // At the border the map goes on: there is no rim of light.
    assert!(lit(spot, -1.999) < 1e-9);
}
