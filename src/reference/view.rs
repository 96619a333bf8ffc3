//! How a light looks at the scene: a rigid frame and a window, over which maps are laid.

use glam::{DMat3, DVec2, DVec3};

use super::ray::Ray;

/// Whether lines of sight meet in a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// They meet in the light.
    Perspective,
    /// They run along the axis.
    Parallel,
}

/// A light's view. In its frame the light is at the origin and looks along +z, with +y up; metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the origin of the frame is in the world.
    pub origin: DVec3,
    /// World directions to those of the frame: a rotation.
    pub rotation: DMat3,
    /// How lines of sight run.
    pub projection: Projection,
    /// The corners of the map, lower left and upper right: x and y in the frame (parallel), or divided by z
    /// (perspective). Any part of a view may be one: a face of a cube, a split.
    pub window: [DVec2; 2],
    /// Least z that is looked at; what is nearer stands in no light.
    pub near: f64,
}

impl View {
    /// From a point along an axis (any length), a square window that opens by `half_angle` (radians) to each side.
    pub fn perspective(origin: DVec3, axis: DVec3, half_angle: f64, near: f64) -> Self {
        let side = DVec2::splat(half_angle.tan());
        Self { origin, rotation: frame(axis), projection: Projection::Perspective, window: [-side, side], near }
    }

    /// Along an axis (any length), a square window of half side `radius` around a centre. What is before the centre is
    /// seen, too: `near` may be less than zero.
    pub fn parallel(center: DVec3, axis: DVec3, radius: f64, near: f64) -> Self {
        let side = DVec2::splat(radius);
        Self { origin: center, rotation: frame(axis), projection: Projection::Parallel, window: [-side, side], near }
    }

    /// The six views from a point along +x, -x, +y, -y, +z and -z. Each is a sixteenth wider to each side than a right
    /// angle, for filters that reach across an edge.
    pub fn cube(origin: DVec3, near: f64) -> [Self; 6] {
        let half_angle = (1.0 + 1.0 / 16.0_f64).atan();
        [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]
            .map(|axis| Self::perspective(origin, axis, half_angle, near))
    }

    /// A point in the frame.
    pub fn point(&self, world: DVec3) -> DVec3 {
        self.rotation * (world - self.origin)
    }

    /// Where a point of the frame lies in the plane of the window.
    fn flat(&self, point: DVec3) -> DVec2 {
        point.truncate() / if self.projection == Projection::Perspective { point.z } else { 1.0 }
    }

    /// Place of a point of the frame on the map: (0, 0) is its upper left corner, (1, 1) its lower right.
    pub fn place(&self, point: DVec3) -> DVec2 {
        let [low, high] = self.window;
        let at = (self.flat(point) - low) / (high - low);
        DVec2::new(at.x, 1.0 - at.y)
    }

    /// Whether a point of the frame is on the map.
    pub fn holds(&self, point: DVec3) -> bool {
        let at = self.place(point);
        point.z >= self.near && at.min_element() >= 0.0 && at.max_element() <= 1.0
    }

    /// The line of sight through a place of the map, in the frame: a point of it with z = 0 and its direction with z = 1.
    pub fn line(&self, place: DVec2) -> (DVec3, DVec3) {
        let [low, high] = self.window;
        let flat = low + (high - low) * DVec2::new(place.x, 1.0 - place.y);
        match self.projection {
            Projection::Perspective => (DVec3::ZERO, flat.extend(1.0)),
            Projection::Parallel => (flat.extend(0.0), DVec3::Z),
        }
    }

    /// The same in the world; distances along the ray are z in the frame.
    pub fn ray(&self, place: DVec2) -> Ray {
        let (start, direction) = self.line(place);
        let back = self.rotation.transpose();
        Ray { origin: self.origin + back * start, direction: back * direction, near: self.near, far: f64::INFINITY }
    }
}

/// The rotation that turns an axis to +z, with +y as near to world +y as can be; straight up or down, world +z or -z
/// takes its place, which is where a slight tilt towards +z brings it.
fn frame(axis: DVec3) -> DMat3 {
    let z = axis.normalize_or(DVec3::NEG_Y);
    let up = if z.y.abs() > 0.9999 { DVec3::new(0.0, 0.0, -z.y.signum()) } else { DVec3::Y };
    let x = up.cross(z).normalize();
    DMat3::from_cols(x, z.cross(x), z).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_go_through_the_places_that_they_are_asked_for() {
        let axis = DVec3::new(0.3, -0.8, 0.5);
        for view in [
            View::perspective(DVec3::new(1.0, 4.0, -2.0), axis, 0.6, 0.1),
            View::parallel(DVec3::new(1.0, 4.0, -2.0), axis, 3.0, -7.0),
        ] {
            for place in [DVec2::new(0.1, 0.3), DVec2::new(0.9, 0.2), DVec2::splat(0.5)] {
                let ray = view.ray(place);
                let point = view.point(ray.at(2.5));
                assert!((point.z - 2.5).abs() < 1e-12, "{point}");
                assert!(view.place(point).abs_diff_eq(place, 1e-12) && view.holds(point));
            }
            assert!(!view.holds(view.point(view.ray(DVec2::new(1.01, 0.5)).at(1.0))));
            assert!(!view.holds(view.point(view.ray(DVec2::splat(0.5)).at(view.near - 0.01))));
            // World +y is up on the map, and the frame is not mirrored.
            let (here, above) = (view.ray(DVec2::splat(0.5)).at(2.0), view.ray(DVec2::splat(0.5)).at(2.0) + DVec3::Y);
            assert!(view.place(view.point(above)).y < view.place(view.point(here)).y);
            assert!((view.rotation.determinant() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn straight_down_the_map_has_x_to_the_right_and_z_up() {
        let view = View::perspective(DVec3::Y * 4.0, DVec3::NEG_Y, std::f64::consts::FRAC_PI_4, 0.1);
        let at = |x: f64, z: f64| view.place(view.point(DVec3::new(x, 0.0, z)));
        assert!(at(1.0, 0.0).x > 0.6 && at(0.0, 1.0).y < 0.4, "{} {}", at(1.0, 0.0), at(0.0, 1.0));
    }

    #[test]
    fn six_faces_see_every_direction() {
        let faces = View::cube(DVec3::ONE, 0.0);
        for i in 0..500 {
            let z = 1.0 - f64::from(2 * i + 1) / 500.0;
            let (sine, cosine) = (f64::from(i) * 2.4).sin_cos();
            let around = (1.0 - z * z).sqrt();
            let point = DVec3::ONE + DVec3::new(around * cosine, around * sine, z) * 3.0;
            assert!((1..=3).contains(&faces.iter().filter(|f| f.holds(f.point(point))).count()), "{point}");
        }
    }
}
