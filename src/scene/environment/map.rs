//! The surroundings as a picture with ever rougher mip levels.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec4};

use super::{Environment, Image, harmonics, prefilter};

/// Width of the first level in texels; the height is half of it.
pub(super) const WIDTH: u32 = 256;
/// Number of mip levels: the last one is 8 by 4 texels.
pub(super) const LEVELS: u32 = 6;

/// Surroundings ready for a renderer.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Mip levels, each half as wide and high as the one before. Level i is filtered for the GGX roughness
    /// i / (number of levels - 1), so a surface reads level roughness * `environment_levels`.
    pub levels: Vec<Level>,
    /// Irradiance by direction, W/m^2, as [`crate::module::FRAME_WGSL`] documents; w is 0.
    pub irradiance: [Vec4; 9],
}

/// An equirectangular picture of linear radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Texels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue and 1, row by row from the top.
    pub pixels: Vec<[f32; 4]>,
}

impl Map {
    /// Makes the map of `environment`. `image` is the decoded picture for [`Environment::Image`]; without it such an
    /// environment is black.
    pub fn new(environment: &Environment, image: Option<&Image>) -> Self {
        let base = match environment {
            Environment::Color(color) => Level::from_fn(WIDTH, WIDTH / 2, |_| DVec3::from_array(*color)),
            Environment::Sky(sky) => Level::from_fn(WIDTH, WIDTH / 2, |direction| sky.radiance(direction)),
            Environment::Image { rotation, intensity, .. } => match image {
                Some(image) => image.level(WIDTH, WIDTH / 2, *rotation, *intensity),
                None => Level::from_fn(WIDTH, WIDTH / 2, |_| DVec3::ZERO),
            },
        };
        let irradiance = harmonics::irradiance(&base);
        Self { levels: prefilter::levels(base, LEVELS), irradiance }
    }
}

impl Level {
    /// A picture of a function of the unit direction, sampled in the middle of each texel.
    pub fn from_fn(width: u32, height: u32, radiance: impl Fn(DVec3) -> DVec3) -> Self {
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let color = radiance(direction_of(texel_center(x, y, width, height))).as_vec3();
                pixels.push(color.extend(1.0).to_array());
            }
        }
        Self { width, height, pixels }
    }

    /// Unit direction and solid angle (sr) of the middle of each texel, with its radiance.
    pub(super) fn texels(&self) -> impl Iterator<Item = (DVec3, f64, DVec3)> {
        let width = self.width as usize;
        self.pixels.iter().enumerate().map(move |(i, p)| {
            let (x, y) = ((i % width) as u32, (i / width) as u32);
            let edge = |row: u32| (PI * f64::from(row) / f64::from(self.height)).cos();
            let angle = TAU / f64::from(self.width) * (edge(y) - edge(y + 1));
            let direction = direction_of(texel_center(x, y, self.width, self.height));
            (direction, angle, DVec3::new(p[0].into(), p[1].into(), p[2].into()))
        })
    }
}

fn texel_center(x: u32, y: u32, width: u32, height: u32) -> DVec2 {
    DVec2::new((f64::from(x) + 0.5) / f64::from(width), (f64::from(y) + 0.5) / f64::from(height))
}

/// The unit direction of a place in the picture.
pub fn direction_of(texcoord: DVec2) -> DVec3 {
    let (sin_around, cos_around) = (TAU * (texcoord.x - 0.5)).sin_cos();
    let (sin_down, cos_down) = (PI * texcoord.y).sin_cos();
    DVec3::new(sin_around * sin_down, cos_down, -cos_around * sin_down)
}

/// The place of a unit direction in the picture, both coordinates 0..1.
pub fn texcoord_of(direction: DVec3) -> DVec2 {
    let around = direction.x.atan2(-direction.z);
    DVec2::new(0.5 + around / TAU, direction.y.clamp(-1.0, 1.0).acos() / PI)
}
