//! How far things reach: what a directional light must cover.

use glam::{Mat4, Vec3};

use super::Mesh;

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub min: Vec3,
    /// Greatest coordinates.
    pub max: Vec3,
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its centre.
    pub center: Vec3,
    /// Its radius.
    pub radius: f32,
}

impl Bounds {
    /// Of some points; none if there are none. Points that are not finite do not count.
    pub fn of_points(points: impl IntoIterator<Item = Vec3>) -> Option<Self> {
        points.into_iter().filter(|p| p.is_finite()).fold(None, |bounds: Option<Self>, p| {
            Some(bounds.map_or(Self { min: p, max: p }, |b| Self { min: b.min.min(p), max: b.max.max(p) }))
        })
    }

    /// Of meshes in world space, each with its object-to-world matrix: exact, vertex by vertex.
    pub fn of_meshes<'a>(meshes: impl IntoIterator<Item = (&'a Mesh, Mat4)>) -> Option<Self> {
        Self::of_points(world_points(meshes))
    }

    /// The middle.
    pub fn center(&self) -> Vec3 {
        (self.min + self.max) * 0.5
    }
}

impl Ball {
    /// Around meshes in world space, each with its object-to-world matrix; none if they have no vertices.
    ///
    /// Centred on their bounds and tight for that centre: at most sqrt(3) times the smallest ball, and stable when
    /// something inside moves.
    pub fn of_meshes<'a, I>(meshes: I) -> Option<Self>
    where
        I: IntoIterator<Item = (&'a Mesh, Mat4)> + Clone,
    {
        let center = Bounds::of_meshes(meshes.clone())?.center();
        let squares = world_points(meshes).filter(|p| p.is_finite()).map(|p| p.distance_squared(center));
        Some(Self { center, radius: squares.fold(0.0, f32::max).sqrt() })
    }
}

fn world_points<'a>(meshes: impl IntoIterator<Item = (&'a Mesh, Mat4)>) -> impl Iterator<Item = Vec3> {
    meshes.into_iter().flat_map(|(mesh, matrix)| mesh.positions.iter().map(move |p| matrix.transform_point3(*p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_and_moved_box_is_bounded_exactly() {
        let mesh = super::super::primitive::cuboid([2.0, 2.0, 2.0], 0.0);
        let matrix = Mat4::from_translation(Vec3::X * 3.0) * Mat4::from_rotation_y(45f32.to_radians());
        let bounds = Bounds::of_meshes([(&mesh, matrix)]).unwrap();
        let root = 2f32.sqrt();
        assert!((bounds.max - Vec3::new(3.0 + root, 1.0, root)).length() < 1e-5, "{bounds:?}");
        let ball = Ball::of_meshes([(&mesh, matrix)]).unwrap();
        assert!((ball.center - Vec3::X * 3.0).length() < 1e-5 && (ball.radius - 3f32.sqrt()).abs() < 1e-5);
    }

    #[test]
    fn nothing_has_no_bounds() {
        assert_eq!(Bounds::of_meshes([]), None);
        assert_eq!(Ball::of_meshes([(&Mesh::default(), Mat4::IDENTITY)]), None);
        assert_eq!(Bounds::of_points([Vec3::NAN]), None);
    }
}
