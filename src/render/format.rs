//! Texture formats by name: what a device can do with them, which one a map gets, and how their texels are read.

use half::f16;
use wgpu::TextureFormat;

/// Formats that passes may name as targets.
pub(super) const NAMES: &[(&str, TextureFormat)] = &[
    ("depth32float", TextureFormat::Depth32Float),
    ("r16float", TextureFormat::R16Float),
    ("r16unorm", TextureFormat::R16Unorm),
    ("r32float", TextureFormat::R32Float),
    ("rg16float", TextureFormat::Rg16Float),
    ("rg16unorm", TextureFormat::Rg16Unorm),
    ("rg32float", TextureFormat::Rg32Float),
    ("rg32uint", TextureFormat::Rg32Uint),
    ("rgba8unorm", TextureFormat::Rgba8Unorm),
    ("rgba16float", TextureFormat::Rgba16Float),
    ("rgba16unorm", TextureFormat::Rgba16Unorm),
    ("rgba32float", TextureFormat::Rgba32Float),
];

/// What a format can be used for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Abilities {
    /// Passes can write it and shaders read it.
    pub renderable: bool,
    /// Samplers can interpolate it.
    pub filterable: bool,
    /// It can have four samples per pixel that are resolved to one.
    pub multisampled: bool,
    /// Compute shaders can write it.
    pub storable: bool,
}

/// The format with this name.
pub(super) fn from_name(name: &str) -> Option<TextureFormat> {
    NAMES.iter().find(|(n, _)| *n == name).map(|(_, f)| *f)
}

/// The name of a format.
pub(super) fn name_of(format: TextureFormat) -> &'static str {
    NAMES.iter().find(|(_, f)| *f == format).map_or("other", |(n, _)| n)
}

/// What a device made with `features` from `adapter` can do with a format.
pub(super) fn abilities(adapter: &wgpu::Adapter, features: wgpu::Features, format: TextureFormat) -> Abilities {
    if !features.contains(format.required_features()) {
        return Abilities::default();
    }
    let known = if features.contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES) {
        adapter.get_texture_format_features(format)
    } else {
        format.guaranteed_format_features(features)
    };
    let usages = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
    let flags = known.flags;
    Abilities {
        renderable: known.allowed_usages.contains(usages),
        filterable: flags.contains(wgpu::TextureFormatFeatureFlags::FILTERABLE),
        multisampled: flags.contains(
            wgpu::TextureFormatFeatureFlags::MULTISAMPLE_X4 | wgpu::TextureFormatFeatureFlags::MULTISAMPLE_RESOLVE,
        ),
        storable: known.allowed_usages.contains(wgpu::TextureUsages::STORAGE_BINDING)
            && flags.contains(wgpu::TextureFormatFeatureFlags::STORAGE_WRITE_ONLY),
    }
}

/// What a map needs its format for, besides being rendered and read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Needs {
    /// Samplers interpolate it.
    pub(super) filtered: bool,
    /// Compute shaders write it.
    pub(super) stored: bool,
}

impl Needs {
    /// What a device must be able to do, as a verb.
    pub(super) fn verb(self) -> &'static str {
        match (self.filtered, self.stored) {
            (false, false) => "render",
            (true, false) => "render and filter",
            (false, true) => "render and store",
            (true, true) => "render, store and filter",
        }
    }
}

/// The first of `names` that can be rendered and does what is needed, with its position in the list.
pub(super) fn choose(
    names: &[&str],
    needs: Needs,
    abilities: &dyn Fn(TextureFormat) -> Abilities,
) -> Option<(usize, TextureFormat)> {
    names.iter().enumerate().find_map(|(i, name)| {
        let format = from_name(name)?;
        let able = abilities(format);
        // Depth is compared, not interpolated.
        let filters = !needs.filtered || able.filterable || format.is_depth_stencil_format();
        let fits = able.renderable && filters && (!needs.stored || able.storable);
        fits.then_some((i, format))
    })
}

/// Bytes of a texel of a format in [`NAMES`].
pub(super) fn texel_bytes(format: TextureFormat) -> u32 {
    match format {
        TextureFormat::R16Float | TextureFormat::R16Unorm => 2,
        TextureFormat::Rgba16Float
        | TextureFormat::Rgba16Unorm
        | TextureFormat::Rg32Float
        | TextureFormat::Rg32Uint => 8,
        TextureFormat::Rgba32Float => 16,
        _ => 4,
    }
}

/// Channels of a format in [`NAMES`].
pub(super) fn channels(format: TextureFormat) -> usize {
    match format {
        TextureFormat::Rg16Float | TextureFormat::Rg16Unorm | TextureFormat::Rg32Float | TextureFormat::Rg32Uint => 2,
        TextureFormat::Rgba8Unorm
        | TextureFormat::Rgba16Float
        | TextureFormat::Rgba16Unorm
        | TextureFormat::Rgba32Float => 4,
        _ => 1,
    }
}

/// Whether a format holds whole numbers.
pub(super) fn is_integer(format: TextureFormat) -> bool {
    format == TextureFormat::Rg32Uint
}

/// How shaders read a format without interpolation.
pub(super) fn sample_type(format: TextureFormat) -> wgpu::TextureSampleType {
    if is_integer(format) {
        wgpu::TextureSampleType::Uint
    } else {
        wgpu::TextureSampleType::Float { filterable: false }
    }
}

/// The channels of one texel; missing ones are 0, 0 and 1. Whole numbers of 32 bits are rounded to what a float holds.
pub(super) fn decode(format: TextureFormat, texel: &[u8]) -> [f32; 4] {
    let mut color = [0.0, 0.0, 0.0, 1.0];
    let channels = channels(format);
    let bytes = texel_bytes(format) as usize / channels;
    for (value, part) in color.iter_mut().zip(texel.chunks_exact(bytes)).take(channels) {
        *value = match (format, part) {
            (TextureFormat::R16Float | TextureFormat::Rg16Float | TextureFormat::Rgba16Float, &[a, b]) => {
                f16::from_le_bytes([a, b]).to_f32()
            }
            #[allow(clippy::cast_precision_loss, reason = "said above")]
            (TextureFormat::Rg32Uint, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]) as f32,
            (_, &[a]) => f32::from(a) / 255.0,
            (_, &[a, b]) => f32::from(u16::from_le_bytes([a, b])) / 65535.0,
            (_, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
            _ => 0.0,
        };
    }
    color
}

/// The channels of many texels.
pub(super) fn decode_all(format: TextureFormat, bytes: &[u8]) -> Vec<[f32; 4]> {
    bytes.chunks_exact(texel_bytes(format) as usize).map(|texel| decode(format, texel)).collect()
}

/// The whole numbers of many texels, missing ones 0; nothing for formats that hold others.
pub(super) fn integers(format: TextureFormat, bytes: &[u8]) -> Vec<[u32; 4]> {
    if !is_integer(format) {
        return Vec::new();
    }
    let whole = |texel: &[u8]| {
        let mut all = [0; 4];
        for (value, part) in all.iter_mut().zip(texel.chunks_exact(4)) {
            *value = part.try_into().map_or(0, u32::from_le_bytes);
        }
        all
    };
    bytes.chunks_exact(texel_bytes(format) as usize).map(whole).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 3] = ["rg32float", "rg16unorm", "rg16float"];

    const ALL: Abilities = Abilities { renderable: true, filterable: true, multisampled: true, storable: true };
    const PLAIN: Needs = Needs { filtered: false, stored: false };
    const FILTERED: Needs = Needs { filtered: true, stored: false };

    #[test]
    fn the_first_format_wins_where_everything_works() {
        assert_eq!(choose(&NAMES, FILTERED, &|_| ALL), Some((0, TextureFormat::Rg32Float)));
    }

    #[test]
    fn a_format_that_cannot_be_interpolated_is_passed_over_only_if_it_has_to_be() {
        let no_float_filter = |f| Abilities { filterable: f != TextureFormat::Rg32Float, ..ALL };
        assert_eq!(choose(&NAMES, FILTERED, &no_float_filter), Some((1, TextureFormat::Rg16Unorm)));
        assert_eq!(choose(&NAMES, PLAIN, &no_float_filter), Some((0, TextureFormat::Rg32Float)));
    }

    #[test]
    fn nothing_is_chosen_where_nothing_can_be_rendered_or_the_name_is_unknown() {
        assert_eq!(choose(&NAMES, PLAIN, &|_| Abilities { renderable: false, ..ALL }), None);
        assert_eq!(choose(&["rg12float"], PLAIN, &|_| ALL), None);
    }

    #[test]
    fn depth_needs_no_interpolation() {
        let depth = ["depth32float"];
        let able = |_| Abilities { filterable: false, ..ALL };
        assert_eq!(choose(&depth, FILTERED, &able), Some((0, TextureFormat::Depth32Float)));
    }

    #[test]
    fn texels_are_decoded_by_format() {
        assert_eq!(decode(TextureFormat::Rg16Unorm, &[0xff, 0xff, 0, 0]), [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(decode(TextureFormat::R32Float, &0.25_f32.to_le_bytes()), [0.25, 0.0, 0.0, 1.0]);
        let half: Vec<u8> = [2.0, 0.5].iter().flat_map(|x| f16::from_f32(*x).to_le_bytes()).collect();
        assert_eq!(decode(TextureFormat::Rg16Float, &half), [2.0, 0.5, 0.0, 1.0]);
        assert_eq!(decode(TextureFormat::Rgba8Unorm, &[255, 0, 51, 0]), [1.0, 0.0, 0.2, 0.0]);
        let whole: Vec<u8> = [7_u32, u32::MAX].iter().flat_map(|x| x.to_le_bytes()).collect();
        assert_eq!(decode(TextureFormat::Rg32Uint, &whole), [7.0, 4_294_967_296.0, 0.0, 1.0]);
        assert_eq!(integers(TextureFormat::Rg32Uint, &whole), [[7, u32::MAX, 0, 0]]);
        assert!(integers(TextureFormat::Rg32Float, &whole).is_empty());
    }

    #[test]
    fn every_named_format_has_whole_channels() {
        for (name, format) in super::NAMES {
            assert_eq!(from_name(name), Some(*format));
            assert_eq!(name_of(*format), *name);
            assert_eq!(texel_bytes(*format) as usize % channels(*format), 0, "{name}");
        }
    }
}
