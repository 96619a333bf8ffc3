//! Small pictures of pictures.

use std::io::Cursor;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ImageEncoder, ImageReader, Limits};

/// Most pixels along a side of a picture that is read.
const MOST: u32 = 8192;

/// A PNG file made so many pixels wide, if it is wider, as a PNG file; none where it cannot be read.
pub fn small(bytes: &[u8], wide: u32) -> Option<Vec<u8>> {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MOST);
    limits.max_image_height = Some(MOST);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), image::ImageFormat::Png);
    reader.limits(limits);
    let picture = reader.decode().ok()?.into_rgb8();
    let (columns, rows) = picture.dimensions();
    let picture = if columns > wide {
        let high = u64::from(rows) * u64::from(wide) / u64::from(columns.max(1));
        let high = u32::try_from(high).unwrap_or(MOST).max(1);
        image::imageops::resize(&picture, wide, high, image::imageops::FilterType::Triangle)
    } else {
        picture
    };
    let mut out = Vec::new();
    PngEncoder::new_with_quality(&mut out, CompressionType::Best, FilterType::Adaptive)
        .write_image(picture.as_raw(), picture.width(), picture.height(), image::ExtendedColorType::Rgb8)
        .ok()?;
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_shrink_and_what_is_none_is_refused() {
        let mut png = Vec::new();
        let pixels = vec![200_u8; 64 * 32 * 3];
        PngEncoder::new(&mut png).write_image(&pixels, 64, 32, image::ExtendedColorType::Rgb8).expect("a PNG");
        let of = |wide| image::load_from_memory(&small(&png, wide).expect("small")).expect("a PNG").into_rgb8();
        assert_eq!((of(16).dimensions(), of(100).dimensions()), ((16, 8), (64, 32)));
        assert!(of(16).pixels().all(|p| p.0 == [200; 3]));
        assert_eq!(small(b"no picture", 10), None);
        assert_eq!(small(&png[..40], 10), None);
    }
}
