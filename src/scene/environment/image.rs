//! Pictures of surroundings.

use std::io::Cursor;

use glam::{DVec2, DVec3};

use super::Level;
use super::map::texcoord_of;
use crate::diagnostic::{Diagnostic, Place};

/// Largest width or height that is decoded.
const MAX_SIDE: u32 = 16_384;
/// Most memory that decoding may take, in bytes.
const MAX_BYTES: u64 = 1 << 30;

/// A decoded equirectangular picture, linear.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Texels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue, row by row from the top.
    pub pixels: Vec<[f32; 3]>,
}

/// Decodes the bytes of an HDR (linear), PNG or JPEG (sRGB) file; `place` is where the file is asked for.
///
/// # Errors
/// The bytes are no such picture, or one that is too large.
pub fn decode(bytes: &[u8], place: &Place) -> Result<Image, Box<Diagnostic>> {
    let wrong = |reason: String| {
        let message = format!("the environment picture cannot be read: {reason}");
        let help = "give an equirectangular HDR, PNG or JPEG picture";
        Box::new(Diagnostic::error("ST0425", message, place.clone()).help(help))
    };
    let mut reader = ::image::ImageReader::new(Cursor::new(bytes));
    let mut limits = ::image::Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    let reader = reader.with_guessed_format().map_err(|e| wrong(e.to_string()))?;
    let linear = reader.format() == Some(::image::ImageFormat::Hdr);
    let picture = reader.decode().map_err(|e| wrong(e.to_string()))?.into_rgb32f();
    let (width, height) = picture.dimensions();
    if width == 0 || height == 0 {
        return Err(wrong("it has no pixels".into()));
    }
    // A negative, infinite or NaN texel would spread over every rougher level.
    let clean = |x: f32| if x.is_finite() { x.max(0.0) } else { 0.0 };
    let read = |x: f32| {
        if linear { clean(x) } else { decode_srgb(clean(x)) }
    };
    let pixels = picture.pixels().map(|p| p.0.map(read)).collect();
    Ok(Image { width, height, pixels })
}

/// IEC 61966-2-1.
fn decode_srgb(x: f32) -> f32 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

impl Image {
    /// The picture resampled, turned about +y by `rotation` degrees and scaled.
    pub(super) fn level(&self, width: u32, height: u32, rotation: f64, intensity: f64) -> Level {
        let (sin, cos) = rotation.to_radians().sin_cos();
        // Enough taps that every texel of the picture counts.
        let taps = (self.width.div_ceil(width)).max(self.height.div_ceil(height)).clamp(1, 64);
        Level::from_fn(width, height, |direction| {
            let turned =
                DVec3::new(direction.x * cos - direction.z * sin, direction.y, direction.x * sin + direction.z * cos);
            let center = texcoord_of(turned);
            let mut sum = DVec3::ZERO;
            for j in 0..taps {
                for i in 0..taps {
                    let offset = DVec2::new(f64::from(2 * i + 1), f64::from(2 * j + 1)) / f64::from(2 * taps) - 0.5;
                    sum += self.texel(center + offset / DVec2::new(f64::from(width), f64::from(height)));
                }
            }
            sum * (intensity / f64::from(taps * taps))
        })
    }

    /// The nearest texel; repeats along u, clamps along v.
    fn texel(&self, at: DVec2) -> DVec3 {
        let x = (at.x.rem_euclid(1.0) * f64::from(self.width)) as u32;
        let y = (at.y.clamp(0.0, 1.0) * f64::from(self.height)) as u32;
        let index = y.min(self.height - 1) as usize * self.width as usize + x.min(self.width - 1) as usize;
        self.pixels.get(index).map_or(DVec3::ZERO, |p| DVec3::new(p[0].into(), p[1].into(), p[2].into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::environment::{Environment, Map};

    fn encode(picture: &::image::RgbImage) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, ::image::ImageFormat::Png).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn a_png_is_linearised_and_lands_where_it_should() {
        // White at the right quarter of the picture, which is +x, on mid grey.
        let picture =
            ::image::RgbImage::from_fn(64, 32, |x, _| ::image::Rgb([if (40..56).contains(&x) { 255 } else { 188 }; 3]));
        let image = decode(&encode(&picture), &Place::default()).unwrap();
        let radiance = |rotation: f64, direction: DVec3| {
            let environment = Environment::Image { image: Default::default(), rotation, intensity: 2.0 };
            let level = &Map::new(&environment, Some(&image)).levels[0];
            level.texels().min_by(|a, b| a.0.distance(direction).total_cmp(&b.0.distance(direction))).unwrap().2.x
        };
        assert!((radiance(0.0, DVec3::X) - 2.0).abs() < 1e-6);
        assert!((radiance(0.0, DVec3::NEG_X) - 2.0 * 0.5029).abs() < 1e-3);
        // A quarter turn counter-clockwise from above takes +x to -z.
        assert!((radiance(90.0, DVec3::NEG_Z) - 2.0).abs() < 1e-6);
        assert!((radiance(90.0, DVec3::X) - 2.0 * 0.5029).abs() < 1e-3);
    }

    #[test]
    fn what_is_no_picture_is_said_to_be_none() {
        for bytes in [
            &b""[..],
            b"not a picture",
            b"\x89PNG\r\n\x1a\n\0\0\0",
            b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9999999 +X 9999999\n",
        ] {
            assert_eq!(decode(bytes, &Place::default()).unwrap_err().code, "ST0425");
        }
    }
}
