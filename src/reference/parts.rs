//! Maps of parallel light that are cut into parts along the view (parallel-split shadow maps, Zhang et al. 2006).

use glam::{DVec2, DVec3};

use super::eye::Eye;
use super::light::{Choice, Light};
use super::view::View;
use super::world::World;
use crate::scene::Camera;

/// What the renderer leaves around a part on each side, in parts of its width, and where the next one begins when parts
/// go over into each other.
const BORDER: f64 = 0.03;
const OVERLAP: f64 = 0.1;

/// How the view is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// Number of parts.
    pub parts: u32,
    /// 0 parts of equal length, 1 each a multiple of the one before.
    pub balance: f64,
    /// Distance from the eye up to which there are parts; 0 is all that is seen.
    pub reach: f64,
    /// Whether maps stand still in the world while the eye moves.
    pub stable: bool,
    /// Whether parts go over into each other.
    pub blend: bool,
    /// Texels on a side of a map.
    pub side: u32,
}

impl Light {
    /// This light, which has one parallel view, with that cut into parts for a camera whose picture has these columns and
    /// rows. Where parts go over into each other the nearer one is looked at alone.
    #[must_use]
    pub fn cut(mut self, cut: &Cut, camera: &Camera, size: (u32, u32), world: &World) -> Self {
        let [whole] = self.views[..] else { return self };
        let radius = whole.window[1].x;
        let eye = Eye::new(camera, size);
        let (near, far) = if cut.stable {
            let far = if cut.reach > 0.0 { cut.reach } else { (2.0 * radius).min(eye.range.1) };
            (eye.range.0.max(far * 1e-3), far)
        } else {
            let (near, far) = reach(&eye, world.boxes());
            (near, if cut.reach > 0.0 { far.min(cut.reach) } else { far })
        };
        let far = far.max(near * 1.001);
        let (mut begin, mut ends) = (near, Vec::new());
        self.views.clear();
        for i in 1..=cut.parts {
            let share = f64::from(i) / f64::from(cut.parts);
            let even = near + (far - near) * share;
            let end = even + (near * (far / near).powf(share) - even) * cut.balance;
            let window = if cut.stable {
                snapped(&eye, &whole, (begin, end), cut.side)
            } else {
                tight(&eye, &whole, (begin, end))
            };
            self.views.push(View { window, ..whole });
            ends.push(end);
            begin = if cut.blend { end * (1.0 - OVERLAP) } else { end };
        }
        ends.pop();
        self.choice = Choice::Distance { eye: eye.position, forward: eye.forward, ends };
        self
    }
}

/// Least and greatest distance of what is seen of boxes, given by their corners.
fn reach(eye: &Eye, boxes: &[[DVec3; 8]]) -> (f64, f64) {
    const FACES: [[usize; 4]; 6] = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let (near, far) = eye.range;
    // Planes of what is seen: n.p >= d.
    let sides = [
        (DVec3::new(1.0, 0.0, eye.half.x), 0.0),
        (DVec3::new(-1.0, 0.0, eye.half.x), 0.0),
        (DVec3::new(0.0, 1.0, eye.half.y), 0.0),
        (DVec3::new(0.0, -1.0, eye.half.y), 0.0),
        (DVec3::Z, near),
        (DVec3::NEG_Z, -far),
    ];
    let mut found: Option<(f64, f64)> = None;
    let mut add = |z: f64| found = Some(found.map_or((z, z), |(a, b)| (z.min(a), z.max(b))));
    for corners in boxes {
        let corners = corners.map(|c| eye.seen(c));
        // Corner numbers count the axes of the box in their bits.
        let inside = [1, 2, 4].iter().all(|i| {
            let edge = corners[*i] - corners[0];
            let along = -corners[0].dot(edge);
            along > 0.0 && along < edge.length_squared()
        });
        if inside {
            add(near);
        }
        for face in FACES {
            let mut polygon: Vec<DVec3> = face.iter().map(|i| corners[*i]).collect();
            for (normal, least) in sides {
                let over = |p: DVec3| normal.dot(p) - least;
                let mut kept = Vec::new();
                for (i, a) in polygon.iter().enumerate() {
                    let b = polygon[(i + 1) % polygon.len()];
                    if over(*a) >= 0.0 {
                        kept.push(*a);
                    }
                    if (over(*a) >= 0.0) != (over(b) >= 0.0) {
                        kept.push(a.lerp(b, over(*a) / (over(*a) - over(b))));
                    }
                }
                polygon = kept;
            }
            polygon.iter().for_each(|p| add(p.z));
        }
    }
    found.unwrap_or(eye.range)
}

/// The rectangle around what is seen between two distances, within the whole view.
fn tight(eye: &Eye, whole: &View, (begin, end): (f64, f64)) -> [DVec2; 2] {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for distance in [begin, end] {
        for place in [DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE] {
            let at = whole.point(eye.at(place, distance)).truncate().clamp(whole.window[0], whole.window[1]);
            (low, high) = (low.min(at), high.max(at));
        }
    }
    let half = ((high - low) / 2.0).max(whole.window[1] * 1e-4) * (1.0 + 2.0 * BORDER);
    let middle = (low + high) / 2.0;
    [middle - half, middle + half]
}

/// The square around the ball around what is seen between two distances, moved by whole texels.
fn snapped(eye: &Eye, whole: &View, (begin, end): (f64, f64), side: u32) -> [DVec2; 2] {
    let slope = eye.half.length();
    let along = ((end + begin) / 2.0 * (1.0 + slope * slope)).min(end);
    let radius = (end - along).hypot(end * slope).max((along - begin).hypot(begin * slope));
    // Sizes are on a ladder of sixteen steps an octave.
    let half = (((radius * (1.0 + 2.0 * BORDER)).log2() * 16.0 + 1e-3).ceil() / 16.0).exp2();
    let texel = 2.0 * half / f64::from(side.max(2));
    let origin = whole.point(DVec3::ZERO).truncate();
    let middle = whole.point(eye.at(DVec2::ZERO, along)).truncate() - origin;
    let middle = (middle / texel).round() * texel + origin;
    [middle - half, middle + half]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Body;
    use crate::scene::Shape;
    use glam::{Mat4, Vec3};

    /// Every point that is seen is looked up in the part that its distance says, and lies on that part's map.
    #[test]
    fn parts_share_out_what_is_seen() {
        let ground = Shape::Plane { size: [60.0, 60.0], segments: [1, 1] }.mesh().expect("a plane");
        let body = Body { mesh: &ground, object_to_world: Mat4::IDENTITY, casts: true, receives: true };
        let world = World::new(&[body]);
        let camera = Camera {
            position: Vec3::new(1.0, 2.0, 8.0),
            target: Vec3::new(0.0, 0.0, -4.0),
            up: Vec3::Y,
            fov_y: 0.7,
            near: 0.1,
            far: 200.0,
        };
        let sun = [vec![0.4, -1.0, 0.3], vec![0.0; 3], vec![0.0], vec![0.0]];
        for (stable, blend) in [(false, false), (true, false), (false, true)] {
            let cut = Cut { parts: 3, balance: 0.6, reach: 30.0, stable, blend, side: 512 };
            let light = Light::projected("orthographic", &sun, &world).expect("a sun");
            let light = light.cut(&cut, &camera, (32, 18), &world);
            assert_eq!(light.views.len(), 3);
            let width = |v: &View| v.window[1].x - v.window[0].x;
            assert!(light.views.windows(2).all(|w| width(&w[0]) < width(&w[1])), "{:?}", light.views);
            let mut used = [0; 3];
            for pixel in 0..32 * 18 {
                let ray = crate::reference::picture::eye_ray(&camera, (32, 18), (pixel % 32, pixel / 32));
                let Some((distance, point)) = world.seen(&ray) else { continue };
                match light.view_of(point.position) {
                    Some(part) => used[part] += 1,
                    None => assert!(distance > 29.9, "{stable} {blend}: nothing holds {} m", distance),
                }
            }
            assert!(used.iter().all(|n| *n > 10), "{stable} {blend}: {used:?}");
        }
    }
}
