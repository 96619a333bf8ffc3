//! Colours and marks. A port's colour is never alone: its shape and a letter say the same.

use eframe::egui::{self, Color32, Pos2, Shape, Stroke, Vec2};

use crate::semantic::{Kind, Quantity, Type};

/// How a port is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    /// Plain values.
    Circle,
    /// Light on its way: irradiance, visibility, radiance.
    Diamond,
    /// Geometry: points, directions, normals.
    Triangle,
    /// Pictures, maps and how they are read.
    Square,
}

/// Colour, shape and letter of a type.
pub(super) fn badge(ty: &Type) -> (Color32, Mark, char) {
    let meaning = ty.meaning;
    match meaning.quantity {
        Quantity::Irradiance => return (Color32::from_rgb(0xf2, 0xb8, 0x3d), Mark::Diamond, 'L'),
        Quantity::Visibility => return (Color32::from_rgb(0xb0, 0x9c, 0x7a), Mark::Diamond, 'V'),
        Quantity::Radiance => return (Color32::from_rgb(0x5c, 0xc4, 0x8d), Mark::Diamond, 'S'),
        Quantity::None | Quantity::Reflectance | Quantity::Emission => {}
    }
    let (r, g, b, mark, letter) = match meaning.kind {
        Kind::Color => (0xe6, 0xc8, 0x4a, Mark::Circle, 'C'),
        Kind::Point => (0x8f, 0x8a, 0xf0, Mark::Triangle, 'P'),
        Kind::Vector => (0x7a, 0x8c, 0xe8, Mark::Triangle, 'v'),
        Kind::Direction => (0x63, 0x9c, 0xe8, Mark::Triangle, 'D'),
        Kind::Normal => (0x7d, 0xb4, 0xf5, Mark::Triangle, 'N'),
        Kind::Texcoord => (0xd0, 0x7c, 0xd6, Mark::Triangle, 'U'),
        Kind::Texture | Kind::Map | Kind::Environment => (0xd9, 0x7b, 0x56, Mark::Square, 'T'),
        Kind::Sampler | Kind::Space => (0x9a, 0x88, 0x80, Mark::Square, 's'),
        Kind::Bool => (0xd6, 0x60, 0x7c, Mark::Circle, 'b'),
        Kind::Index => (0x55, 0xb8, 0xae, Mark::Circle, 'i'),
        Kind::Matrix => (0xa0, 0xa0, 0x5a, Mark::Square, 'M'),
        Kind::Angle | Kind::Cosine => (0xc0, 0xc6, 0xa0, Mark::Circle, 'a'),
        Kind::Distance | Kind::Depth => (0x9f, 0xc2, 0xc0, Mark::Circle, 'd'),
        Kind::Scalar | Kind::Number => (0xb4, 0xb8, 0xc0, Mark::Circle, 'n'),
    };
    (Color32::from_rgb(r, g, b), mark, letter)
}

/// The colour of a category's cards.
pub(super) fn category(name: &str, dark: bool) -> Color32 {
    let hue = match name {
        "light" => 0.12,
        "shadow" => 0.07,
        "surface" => 0.40,
        "geometry" => 0.62,
        "texture" => 0.04,
        "procedural" => 0.78,
        "math" => 0.58,
        "color" => 0.15,
        "" => return if dark { Color32::from_rgb(0x7a, 0x3a, 0x3a) } else { Color32::from_rgb(0xe8, 0xb0, 0xb0) },
        other => f32::from(other.bytes().fold(0_u8, |a, b| a.wrapping_mul(31).wrapping_add(b))) / 255.0,
    };
    let (saturation, value) = if dark { (0.50, 0.46) } else { (0.28, 0.93) };
    egui::ecolor::HsvaGamma { h: hue, s: saturation, v: value, a: 1.0 }.into()
}

/// The mark of a port at a place.
pub(super) fn mark(mark: Mark, at: Pos2, radius: f32, fill: Color32, stroke: Stroke) -> Shape {
    let corners = |list: &[(f32, f32)]| list.iter().map(|(x, y)| at + Vec2::new(*x, *y) * radius).collect();
    match mark {
        Mark::Circle => Shape::Circle(egui::epaint::CircleShape { center: at, radius, fill, stroke }),
        Mark::Diamond => {
            Shape::convex_polygon(corners(&[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)]), fill, stroke)
        }
        Mark::Triangle => Shape::convex_polygon(corners(&[(-0.95, -1.1), (1.2, 0.0), (-0.95, 1.1)]), fill, stroke),
        Mark::Square => {
            Shape::convex_polygon(corners(&[(-0.95, -0.95), (0.95, -0.95), (0.95, 0.95), (-0.95, 0.95)]), fill, stroke)
        }
    }
}

/// Colours of the canvas that depend on the theme.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    pub(super) background: Color32,
    pub(super) grid: Color32,
    pub(super) card: Color32,
    pub(super) outline: Color32,
    pub(super) text: Color32,
    pub(super) weak: Color32,
    pub(super) selected: Color32,
    pub(super) error: Color32,
    pub(super) warning: Color32,
    pub(super) dark: bool,
}

impl Look {
    pub(super) fn of(visuals: &egui::Visuals) -> Self {
        if visuals.dark_mode {
            Self {
                background: Color32::from_rgb(0x1c, 0x1e, 0x22),
                grid: Color32::from_rgb(0x29, 0x2c, 0x32),
                card: Color32::from_rgb(0x30, 0x33, 0x3a),
                outline: Color32::from_rgb(0x12, 0x13, 0x16),
                text: Color32::from_rgb(0xe6, 0xe8, 0xec),
                weak: Color32::from_rgb(0x9a, 0xa0, 0xaa),
                selected: Color32::from_rgb(0x6c, 0xb4, 0xff),
                error: Color32::from_rgb(0xff, 0x6b, 0x6b),
                warning: Color32::from_rgb(0xff, 0xc1, 0x4d),
                dark: true,
            }
        } else {
            Self {
                background: Color32::from_rgb(0xee, 0xf0, 0xf3),
                grid: Color32::from_rgb(0xdc, 0xdf, 0xe4),
                card: Color32::from_rgb(0xff, 0xff, 0xff),
                outline: Color32::from_rgb(0xa8, 0xae, 0xb8),
                text: Color32::from_rgb(0x1d, 0x20, 0x26),
                weak: Color32::from_rgb(0x5e, 0x66, 0x72),
                selected: Color32::from_rgb(0x0b, 0x6b, 0xd6),
                error: Color32::from_rgb(0xc6, 0x28, 0x28),
                warning: Color32::from_rgb(0xa8, 0x63, 0x00),
                dark: false,
            }
        }
    }
}
