//! Rays, and where they meet triangles.

use glam::DVec3;

/// A half line, or a part of one. Distances along it are in units of `direction`, whose length is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes; not zero.
    pub direction: DVec3,
    /// Nothing before this distance counts.
    pub near: f64,
    /// Nothing behind this distance counts.
    pub far: f64,
}

impl Ray {
    /// The point at a distance.
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }
}

/// A ray made ready for many triangles: sheared so that it runs along one axis (Woop, Benthin and Wald 2013,
/// "Watertight Ray/Triangle Intersection", section 3). Two triangles with a common edge leave no gap between them.
pub(super) struct Sheared {
    origin: DVec3,
    /// The axes that become x, y and z; the ray is longest along the last.
    axes: [usize; 3],
    shear: [f64; 3],
}

impl Sheared {
    pub(super) fn new(ray: &Ray) -> Self {
        let d = ray.direction.to_array();
        let longest = (0..3).max_by(|a, b| d[*a].abs().total_cmp(&d[*b].abs())).unwrap_or(0);
        let axes = [(longest + 1) % 3, (longest + 2) % 3, longest];
        let shear = [d[axes[0]] / d[longest], d[axes[1]] / d[longest], 1.0 / d[longest]];
        Self { origin: ray.origin, axes, shear }
    }

    /// Distance to a triangle from either side; none where the ray misses it or lies in its plane.
    pub(super) fn meets(&self, corners: &[DVec3; 3]) -> Option<f64> {
        let [sx, sy, sz] = self.shear;
        let [a, b, c] = corners.map(|p| {
            let p = (p - self.origin).to_array();
            let z = p[self.axes[2]];
            [p[self.axes[0]] - sx * z, p[self.axes[1]] - sy * z, sz * z]
        });
        // Twice the areas that the ray cuts off at each edge: equal but for the sign from both sides of an edge.
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let outside = (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0);
        let area = u + v + w;
        if outside {
            return None;
        }
        // What rounding makes of an area of zero: the offsets across are off by parts in 10^16 of the distance along.
        let size = |axis: usize| a[axis].abs().max(b[axis].abs()).max(c[axis].abs());
        let (across, along) = (size(0).max(size(1)), size(2) / sz.abs());
        (area.abs() > across * (across + along) * 1e-15).then(|| (u * a[2] + v * b[2] + w * c[2]) / area)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
        Ray { origin: origin.into(), direction: direction.into(), near: 0.0, far: f64::INFINITY }
    }

    #[test]
    fn triangles_are_met_from_both_sides_at_the_right_distance() {
        let triangle = [DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0];
        for direction in [[0.0, 0.0, -0.5], [0.0, 0.0, 0.5]] {
            let from = [0.5, 0.5, -4.0 * f64::signum(direction[2])];
            let found = Sheared::new(&ray(from, direction)).meets(&triangle);
            assert_eq!(found, Some(8.0));
        }
        assert_eq!(Sheared::new(&ray([1.5, 1.5, 1.0], [0.0, 0.0, -1.0])).meets(&triangle), None);
        assert_eq!(Sheared::new(&ray([-1.0, 0.5, 0.0], [1.0, 0.0, 0.0])).meets(&triangle), None, "in its plane");
        let behind = Sheared::new(&ray([0.5, 0.5, 1.0], [0.0, 0.0, 1.0])).meets(&triangle);
        assert_eq!(behind, Some(-1.0), "what counts is for the caller to say");
    }

    /// Rays through points of the common edge of two triangles, from everywhere: one of the two is met.
    #[test]
    fn no_ray_slips_between_two_triangles() {
        let (a, b) = (DVec3::new(0.1, 0.7, -0.3), DVec3::new(1.3, -0.2, 0.9));
        let (left, right) = ([a, b, DVec3::new(-1.0, -0.9, 0.2)], [b, a, DVec3::new(1.1, 1.4, 0.3)]);
        for i in 0..1000 {
            let t = (f64::from(i) * 0.618_033_988_749).fract();
            let angle = f64::from(i) * 0.37;
            let origin = DVec3::new(angle.cos(), angle.sin(), 3.0 + 0.1 * angle.sin());
            let sheared = Sheared::new(&ray(origin.into(), (a.lerp(b, t) - origin).into()));
            assert!(sheared.meets(&left).is_some() || sheared.meets(&right).is_some(), "{i}");
        }
    }
}
