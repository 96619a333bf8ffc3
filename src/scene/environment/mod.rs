//! What surrounds a scene: its light is seen in reflections, in refractions, and as ambient light.
//!
//! Directions and pictures: the top row is +y, the middle of the picture is -z, and +x is to the right of it. With
//! u to the right and v down, both 0..1: u = 1/2 + atan2(x, -z) / 2pi, v = acos(y) / pi.

mod harmonics;
mod image;
mod map;
mod prefilter;
mod sky;

pub use harmonics::irradiance;
pub use image::{Image, decode};
pub use map::{Level, Map, direction_of, texcoord_of};
pub use sky::Sky;

use super::FileReference;

/// What lies in every direction, as a scene file says it.
#[derive(Clone, Debug, PartialEq)]
pub enum Environment {
    /// The same radiance everywhere, linear.
    Color([f64; 3]),
    /// A procedural sky.
    Sky(Sky),
    /// An equirectangular picture.
    Image {
        /// HDR (linear radiance), PNG or JPEG (sRGB).
        image: FileReference,
        /// Turns the picture about +y, degrees, counter-clockwise seen from above.
        rotation: f64,
        /// Factor on its radiance, at least 0.
        intensity: f64,
    },
}

impl Default for Environment {
    /// Black: only lights give light.
    fn default() -> Self {
        Self::Color([0.0; 3])
    }
}
