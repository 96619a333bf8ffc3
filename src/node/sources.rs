//! What the compiler provides to inputs that ask for it with `= @name`.

use crate::semantic::{Encoding, Frame, Kind, Length, Meaning, Quantity, Shape, Type};

/// A value that the compiler provides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Name without the `@`.
    pub name: &'static str,
    /// Meaning and shape.
    pub ty: Type,
    /// What it is.
    pub doc: &'static str,
}

const fn meaning(kind: Kind, frame: Frame, length: Length) -> Meaning {
    Meaning { kind, frame, length, quantity: Quantity::None, encoding: Encoding::Linear }
}

const fn make(name: &'static str, meaning: Meaning, shape: Shape, doc: &'static str) -> Source {
    Source { name, ty: Type::new(meaning, shape), doc }
}

const SCALAR: Shape = Shape::F32(1);
const VEC2: Shape = Shape::F32(2);
const VEC3: Shape = Shape::F32(3);
const VEC4: Shape = Shape::F32(4);

/// All sources but those whose shape has to be written out.
static SIMPLE: &[Source] = &[
    make(
        "position_object",
        meaning(Kind::Point, Frame::Object, Length::Any),
        VEC3,
        "The shaded point in the object's own frame.",
    ),
    make("position_world", meaning(Kind::Point, Frame::World, Length::Any), VEC3, "The shaded point in the scene."),
    make(
        "normal_object",
        meaning(Kind::Normal, Frame::Object, Length::Near),
        VEC3,
        "Interpolated vertex normal in the object's own frame.",
    ),
    make(
        "normal_world",
        meaning(Kind::Normal, Frame::World, Length::Near),
        VEC3,
        "Interpolated vertex normal in the scene.",
    ),
    make(
        "tangent_object",
        meaning(Kind::Direction, Frame::Object, Length::Near),
        VEC3,
        "Interpolated direction of growing texture u, in the object's own frame.",
    ),
    make(
        "tangent_world",
        meaning(Kind::Direction, Frame::World, Length::Near),
        VEC3,
        "Interpolated direction of growing texture u, in the scene.",
    ),
    make(
        "bitangent_world",
        meaning(Kind::Direction, Frame::World, Length::Near),
        VEC3,
        "Interpolated direction of growing texture v, in the scene.",
    ),
    make("texcoord", meaning(Kind::Texcoord, Frame::Any, Length::Any), VEC2, "Place on the surface's chart."),
    make(
        "vertex_color",
        meaning(Kind::Color, Frame::Any, Length::Any),
        VEC4,
        "Interpolated linear vertex colour with opacity.",
    ),
    make(
        "to_camera",
        meaning(Kind::Direction, Frame::World, Length::Unit),
        VEC3,
        "From the shaded point towards the eye.",
    ),
    make("camera_position", meaning(Kind::Point, Frame::World, Length::Any), VEC3, "Where the eye is."),
    make("camera_forward", meaning(Kind::Direction, Frame::World, Length::Unit), VEC3, "Where the eye looks."),
    make("time", meaning(Kind::Scalar, Frame::Any, Length::Any), SCALAR, "Seconds since the start."),
    make(
        "pixel",
        meaning(Kind::Point, Frame::Screen, Length::Any),
        VEC2,
        "Centre of the pixel, in pixels, from the upper left.",
    ),
    make(
        "depth",
        meaning(Kind::Distance, Frame::View, Length::Any),
        SCALAR,
        "Metres from the eye along the viewing axis.",
    ),
    make(
        "front_facing",
        meaning(Kind::Bool, Frame::Any, Length::Any),
        Shape::Bool,
        "Whether the outer side of the surface is seen.",
    ),
    make(
        "receives",
        meaning(Kind::Scalar, Frame::Any, Length::Any),
        SCALAR,
        "1 where the object receives shadows, else 0.",
    ),
    make(
        "object_to_world",
        meaning(Kind::Matrix, Frame::Any, Length::Any),
        Shape::Matrix(4),
        "From the object's frame to the scene's.",
    ),
    make(
        "world_to_object",
        meaning(Kind::Matrix, Frame::Any, Length::Any),
        Shape::Matrix(4),
        "From the scene's frame to the object's.",
    ),
    make(
        "world_to_view",
        meaning(Kind::Matrix, Frame::Any, Length::Any),
        Shape::Matrix(4),
        "From the scene's frame to the camera's.",
    ),
    make(
        "world_to_clip",
        meaning(Kind::Matrix, Frame::Any, Length::Any),
        Shape::Matrix(4),
        "From the scene's frame to clip space.",
    ),
    make(
        "environment",
        meaning(Kind::Environment, Frame::World, Length::Any),
        Shape::Texture,
        "Equirectangular radiance of the surroundings; mip levels are ever rougher.",
    ),
    make(
        "environment_sampler",
        meaning(Kind::Sampler, Frame::Any, Length::Any),
        Shape::Sampler,
        "How the environment is sampled: trilinear, repeating around the horizon.",
    ),
    make(
        "environment_levels",
        meaning(Kind::Scalar, Frame::Any, Length::Any),
        SCALAR,
        "Number of the environment's last mip level.",
    ),
];

/// Every source, in the order of the documentation.
pub fn sources() -> &'static [Source] {
    static ALL: std::sync::OnceLock<Vec<Source>> = std::sync::OnceLock::new();
    ALL.get_or_init(|| {
        let mut all = SIMPLE.to_vec();
        all.push(make(
            "environment_irradiance",
            meaning(Kind::Environment, Frame::World, Length::Any),
            Shape::Named("array<vec4f, 9>".into()),
            "Spherical harmonics, order 2, of the irradiance from the surroundings.",
        ));
        all
    })
}

/// The source called `name`, without the `@`.
pub fn source(name: &str) -> Option<&'static Source> {
    sources().iter().find(|s| s.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_shapes_read_back() {
        for (i, s) in sources().iter().enumerate() {
            assert!(sources()[..i].iter().all(|t| t.name != s.name), "{}", s.name);
            assert_eq!(Shape::from_wgsl(&s.ty.shape.wgsl()), s.ty.shape);
        }
        assert_eq!(sources().len(), 25);
    }

    #[test]
    fn lookup() {
        assert_eq!(source("normal_world").unwrap().ty.meaning.to_string(), "normal world near");
        assert!(source("@normal_world").is_none());
    }
}
