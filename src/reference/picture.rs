//! Visibility for every pixel of a picture, on all processors.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use glam::DVec2;

use super::eye::Eye;
use super::fine_map::{Filter, FineMap};
use super::light::Light;
use super::ray::Ray;
use super::rays::{self, Estimate};
use super::source::hash;
use super::world::{Point, World};
use crate::scene::Camera;

/// Pixels that are handed out together.
const SHARE: usize = 64;
/// Side of the squares of pixels that follow each other: neighbours look at the same texels.
const SQUARE: usize = 16;

/// How visibility is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method<'a> {
    /// By so many rays to the source.
    Rays(u32),
    /// By exhaustive percentage-closer filtering.
    Filter(&'a Filter),
}

/// How work is watched and stopped.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Set from elsewhere to make the work end soon, without a result.
    pub cancel: &'a AtomicBool,
    /// Told how many more pixels are done, from any thread.
    pub done: &'a (dyn Fn(usize) + Sync),
}

/// The ray from the eye through the centre of a pixel, of pixels in rows from the top; distances along it are along the
/// view axis.
pub fn eye_ray(camera: &Camera, size: (u32, u32), pixel: (u32, u32)) -> Ray {
    let eye = Eye::new(camera, size);
    let across = |i: u32, n: u32| (2.0 * f64::from(i) + 1.0) / f64::from(n) - 1.0;
    let place = DVec2::new(across(pixel.0, size.0), -across(pixel.1, size.1));
    Ray { origin: eye.position, direction: eye.towards(place), near: eye.range.0, far: eye.range.1 }
}

/// What is seen through the centre of each pixel, rows from the top; none where it is nothing. None at all if cancelled.
pub fn points(world: &World, camera: &Camera, size: (u32, u32), watch: Watch<'_>) -> Option<Vec<Option<Point>>> {
    let pixels: Vec<usize> = (0..size.0 as usize * size.1 as usize).collect();
    each(
        &pixels,
        watch,
        || (),
        |(), index| {
            let pixel = ((index % size.0 as usize) as u32, (index / size.0 as usize) as u32);
            world.seen(&eye_ray(camera, size, pixel)).map(|(_, point)| point)
        },
    )
}

/// Visibility of a light at points of a picture `width` pixels wide, in their order; 1 where no shadow falls on the body.
/// None at all if cancelled.
pub fn visibility(
    world: &World,
    light: &Light,
    method: Method<'_>,
    points: &[(usize, Point)],
    width: u32,
    watch: Watch<'_>,
) -> Option<Vec<Estimate>> {
    // Pixels in squares: the order of the work, not of the result.
    let square = |index: usize| {
        let (x, y) = (index % width.max(1) as usize, index / width.max(1) as usize);
        (y / SQUARE, x / SQUARE, y, x)
    };
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|i| square(points[*i].0));
    let maps = || match method {
        Method::Filter(filter) => light.views.iter().map(|v| FineMap::new(world, *v, filter)).collect(),
        Method::Rays(_) => Vec::new(),
    };
    let at = |maps: &mut Vec<FineMap<'_>>, index: usize| {
        let (pixel, point) = &points[index];
        let view = light.view_of(point.position);
        if !point.receives || (light.bounded && view.is_none()) {
            return Estimate::exact(1.0);
        }
        match method {
            Method::Rays(samples) => {
                let view = view.map(|v| &light.views[v]);
                rays::visibility(world, &light.source, view, point, samples, hash(*pixel as u64, 0))
            }
            Method::Filter(_) => Estimate::exact(view.map_or(1.0, |v| maps[v].lit(point))),
        }
    };
    let found = each(&order, watch, maps, at)?;
    let mut sorted = vec![Estimate::default(); points.len()];
    for (index, estimate) in order.into_iter().zip(found) {
        sorted[index] = estimate;
    }
    Some(sorted)
}

/// What `work` makes of each item, in their order, on all processors; each thread has a state of its own. The result does
/// not depend on which thread does what as long as the state is only a memory of what was computed.
fn each<S, T: Send>(
    items: &[usize],
    watch: Watch<'_>,
    state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize) -> T + Sync,
) -> Option<Vec<T>> {
    let next = AtomicUsize::new(0);
    let finished: Mutex<Vec<(usize, Vec<T>)>> = Mutex::new(Vec::new());
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let mut state = state();
                loop {
                    let share = next.fetch_add(1, Ordering::Relaxed);
                    let Some(own) = items.chunks(SHARE).nth(share) else { break };
                    let mut results = Vec::with_capacity(own.len());
                    for item in own {
                        if watch.cancel.load(Ordering::Relaxed) {
                            return;
                        }
                        results.push(work(&mut state, *item));
                    }
                    (watch.done)(own.len());
                    finished.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push((share, results));
                }
            });
        }
    });
    let mut finished = finished.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    finished.sort_by_key(|(share, _)| *share);
    let all: Vec<T> = finished.into_iter().flat_map(|(_, results)| results).collect();
    (all.len() == items.len()).then_some(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{Body, Taps, Weights, kernel};
    use crate::scene::Shape;
    use glam::{DVec3, Mat4, Vec3};

    fn camera() -> Camera {
        Camera {
            position: Vec3::new(0.0, 3.0, 0.0),
            target: Vec3::ZERO,
            up: Vec3::NEG_Z,
            fov_y: std::f32::consts::FRAC_PI_2,
            near: 0.5,
            far: 10.0,
        }
    }

    fn world(plane: &crate::scene::Mesh, receives: bool, casts: bool) -> World {
        let body = |y: f32, receives, casts| Body {
            mesh: plane,
            object_to_world: Mat4::from_translation(Vec3::new(0.0, y, 0.0))
                * Mat4::from_scale(Vec3::splat(8.0 - 2.0 * y)),
            casts,
            receives,
        };
        World::new(&[body(0.0, receives, true), body(3.5, true, casts)])
    }

    static IDLE: AtomicBool = AtomicBool::new(false);

    #[test]
    fn rays_go_through_the_centres_of_pixels() {
        let ray = eye_ray(&camera(), (4, 2), (3, 0));
        // Up on the picture is -z; the picture is twice as wide as high; the distance is 3.
        assert!(ray.at(3.0).abs_diff_eq(DVec3::new(4.5, 0.0, -1.5), 1e-6), "{}", ray.at(3.0));
        assert_eq!((ray.near, ray.far), (0.5, 10.0));
    }

    #[test]
    fn flags_of_bodies_and_borders_of_lights_are_heeded() {
        let plane = Shape::Plane { size: [1.0, 1.0], segments: [1, 1] }.mesh().expect("a plane");
        let filter = Filter { kernel: kernel(Weights::Box, 3), taps: Taps::Bilinear, size: 64, factor: 4 };
        let watch = Watch { cancel: &IDLE, done: &|_| {} };
        for (receives, casts) in [(true, true), (false, true), (true, false)] {
            let world = world(&plane, receives, casts);
            let seen = points(&world, &camera(), (32, 16), watch).expect("not cancelled");
            let seen: Vec<_> = (0..).zip(seen).filter_map(|(i, p)| Some((i, p?))).collect();
            // 8 m of ground in the 12 m that are seen across.
            assert!((300..400).contains(&seen.len()), "{}", seen.len());
            let down = [vec![0.0, -1.0, 0.0], vec![0.0; 3], vec![5.0], vec![0.0]];
            let light = Light::projected("orthographic", &down, &world).expect("a sun");
            for method in [Method::Rays(16), Method::Filter(&filter)] {
                let lit = visibility(&world, &light, method, &seen, 32, watch).expect("not cancelled");
                let middle = seen.iter().position(|(i, _)| *i == 8 * 32 + 16).expect("seen");
                let expected = if receives && casts { 0.0 } else { 1.0 };
                assert!(
                    (lit[middle].mean - expected).abs() < 1e-12,
                    "{receives} {casts} {method:?}: {:?}",
                    lit[middle]
                );
            }
            let narrow = [vec![0.0, 5.0, 0.0], vec![0.0, -1.0, 0.0], vec![0.1], vec![0.1], vec![9.0], vec![0.0]];
            let light = Light::projected("perspective", &narrow, &world).expect("a spot light");
            let lit = visibility(&world, &light, Method::Rays(16), &seen, 32, watch).expect("not cancelled");
            assert!(lit[0].mean == 1.0, "outside the cone");
        }
    }

    #[test]
    fn a_cancelled_picture_is_none_and_progress_adds_up() {
        let plane = Shape::Plane { size: [1.0, 1.0], segments: [1, 1] }.mesh().expect("a plane");
        let world = world(&plane, true, true);
        let told = AtomicUsize::new(0);
        let done = |n: usize| {
            told.fetch_add(n, Ordering::Relaxed);
        };
        assert!(points(&world, &camera(), (32, 16), Watch { cancel: &IDLE, done: &done }).is_some());
        assert_eq!(told.into_inner(), 32 * 16);
        let cancel = AtomicBool::new(true);
        assert_eq!(points(&world, &camera(), (32, 16), Watch { cancel: &cancel, done: &|_| {} }), None);
    }
}
