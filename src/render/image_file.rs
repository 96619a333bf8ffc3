//! Pictures to files: PNG for the screen, OpenEXR for numbers. The same picture always gives the same bytes.

use std::io::{Cursor, Write};
use std::path::Path;

use exr::prelude::{Encoding, Image, Layer, LayerAttributes, SpecificChannels, Text, WritableImage};
use image::ImageEncoder;

use super::picture_levels::{encode_srgb, to_byte};

/// How linear values become 8-bit ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Display {
    /// Stops: each doubles the values.
    pub exposure: f32,
    /// How bright values are brought into range.
    pub tone: ToneCurve,
}

/// How bright values are brought into range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// Cut off at white.
    #[default]
    None,
    /// Rolled off towards white, with more contrast in the shadows: the fit of Narkowicz (2015) to the ACES curve, per
    /// channel.
    Filmic,
}

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ImageFileError {
    /// The list of pixels is no picture of that size.
    #[error("{pixels} pixels are no {width} x {height} picture")]
    Size {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Pixels given.
        pixels: usize,
    },
    /// The encoder refuses.
    #[error("the picture cannot be encoded: {0}")]
    Encode(String),
    /// The file system refuses.
    #[error(transparent)]
    Write(#[from] std::io::Error),
}

impl ToneCurve {
    /// Display value, 0 to 1, of a linear one.
    fn apply(self, x: f32) -> f32 {
        // NaN counts as 0; the bound keeps squares finite.
        let x = if x > 0.0 { x.min(1e9) } else { 0.0 };
        match self {
            Self::None => x.min(1.0),
            Self::Filmic => (x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)).min(1.0),
        }
    }
}

impl Display {
    /// 8-bit sRGB with straight alpha, of linear colour with premultiplied coverage.
    pub fn apply(&self, [r, g, b, a]: [f32; 4]) -> [u8; 4] {
        let coverage = a.clamp(0.0, 1.0);
        let scale = if coverage > 0.0 { self.exposure.exp2() / coverage } else { 0.0 };
        let channel = |x: f32| to_byte(encode_srgb(self.tone.apply(x * scale)));
        [channel(r), channel(g), channel(b), to_byte(coverage)]
    }
}

/// PNG, 8 bits per channel, sRGB. `notes` are kept as texts by keyword (1 to 79 printable Latin characters).
pub fn encode_png(
    size: (u32, u32),
    pixels: &[[f32; 4]],
    display: &Display,
    notes: &[(String, String)],
) -> Result<Vec<u8>, ImageFileError> {
    check_size(size, pixels)?;
    let bytes: Vec<u8> = pixels.iter().flat_map(|p| display.apply(*p)).collect();
    let mut file = Vec::new();
    image::codecs::png::PngEncoder::new(&mut file)
        .write_image(&bytes, size.0, size.1, image::ExtendedColorType::Rgba8)
        .map_err(|e| ImageFileError::Encode(e.to_string()))?;
    // Chunks of our own go behind the header: 8 bytes of signature and 25 of IHDR.
    let mut chunks = Vec::new();
    // Says that the values are sRGB, to be shown without compromise (rendering intent 0).
    push_chunk(&mut chunks, *b"sRGB", &[0]);
    for (keyword, text) in notes {
        if (1..=79).contains(&keyword.len()) && keyword.chars().all(|c| c == ' ' || c.is_ascii_graphic()) {
            // Keyword, end, not compressed (two bytes), no language, no translated keyword, text.
            let data = [keyword.as_bytes(), &[0, 0, 0, 0, 0], text.as_bytes()].concat();
            push_chunk(&mut chunks, *b"iTXt", &data);
        } else {
            return Err(ImageFileError::Encode(format!("`{keyword}` cannot be a keyword")));
        }
    }
    file.splice(33..33, chunks);
    Ok(file)
}

/// A PNG chunk: length, type, data, checksum of type and data.
fn push_chunk(file: &mut Vec<u8>, kind: [u8; 4], data: &[u8]) {
    file.extend(u32::try_from(data.len()).unwrap_or(u32::MAX).to_be_bytes());
    file.extend(kind);
    file.extend(data);
    file.extend(crc32(kind.iter().chain(data)).to_be_bytes());
}

/// CRC-32 as PNG defines it (ISO 3309), bit by bit: the texts are short.
fn crc32<'a>(bytes: impl Iterator<Item = &'a u8>) -> u32 {
    let mut crc = u32::MAX;
    for byte in bytes {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
        }
    }
    !crc
}

/// OpenEXR with 32-bit float channels R, G, B, A, compressed without loss. `notes` become lines of the comment.
pub fn encode_exr(
    size: (u32, u32),
    pixels: &[[f32; 4]],
    notes: &[(String, String)],
) -> Result<Vec<u8>, ImageFileError> {
    check_size(size, pixels)?;
    let (width, height) = (size.0 as usize, size.1 as usize);
    // One comment rather than many attributes: those are written in no fixed order.
    let comment: String = notes.iter().map(|(keyword, text)| format!("{keyword}: {text}\n")).collect();
    let comment: String = comment.chars().map(|c| if c.is_ascii() { c } else { '?' }).collect();
    let attributes = LayerAttributes {
        software_name: Text::new_or_none("shadetree"),
        comments: if comment.is_empty() { None } else { Text::new_or_none(&comment) },
        ..LayerAttributes::default()
    };
    let channels = SpecificChannels::rgba(|at: exr::math::Vec2<usize>| {
        let [r, g, b, a] = pixels.get(at.1 * width + at.0).copied().unwrap_or_default();
        (r, g, b, a)
    });
    let picture = Image::from_layer(Layer::new((width, height), attributes, Encoding::SMALL_LOSSLESS, channels));
    let mut file = Cursor::new(Vec::new());
    picture.write().non_parallel().to_buffered(&mut file).map_err(|e| ImageFileError::Encode(e.to_string()))?;
    Ok(file.into_inner())
}

/// Writes a PNG file; see [`encode_png`].
pub fn write_png(
    path: &Path,
    size: (u32, u32),
    pixels: &[[f32; 4]],
    display: &Display,
    notes: &[(String, String)],
) -> Result<(), ImageFileError> {
    Ok(write_whole(path, &encode_png(size, pixels, display, notes)?)?)
}

/// Writes an OpenEXR file; see [`encode_exr`].
pub fn write_exr(
    path: &Path,
    size: (u32, u32),
    pixels: &[[f32; 4]],
    notes: &[(String, String)],
) -> Result<(), ImageFileError> {
    Ok(write_whole(path, &encode_exr(size, pixels, notes)?)?)
}

/// Writes a file whole or not at all: under another name in the same folder, then renamed.
pub fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let old = std::fs::metadata(path).ok();
    if old.as_ref().is_some_and(|m| !m.is_file()) {
        // A device or a pipe is written to, not replaced. A folder gives the error that it should.
        return std::fs::write(path, bytes);
    }
    // A link stays a link; what it points to is replaced.
    let path = if old.is_some() { std::fs::canonicalize(path)? } else { path.to_owned() };
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".shadetree-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // What new files usually get; the process's mask still applies.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    if let Some(old) = old {
        file.as_file().set_permissions(old.permissions())?;
    }
    file.persist(&path).map_err(|e| e.error)?;
    Ok(())
}

fn check_size((width, height): (u32, u32), pixels: &[[f32; 4]]) -> Result<(), ImageFileError> {
    if pixels.is_empty() || pixels.len() as u64 != u64::from(width) * u64::from(height) {
        return Err(ImageFileError::Size { width, height, pixels: pixels.len() });
    }
    Ok(())
}

#[cfg(test)]
#[path = "image_file_tests.rs"]
mod tests;
