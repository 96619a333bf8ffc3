//! Mip levels of images, made on the host.

use super::job::{Picture, Texels};

/// A picture with all its smaller levels, each the exact average of the one before.
pub(super) fn levels(picture: &Picture, srgb: bool) -> Vec<Picture> {
    let mut all = vec![picture.clone()];
    let mut current = to_linear(picture, srgb);
    let (mut width, mut height) = (picture.width, picture.height);
    while width > 1 || height > 1 {
        (current, width, height) = halve(&current, width, height);
        let texels = match picture.texels {
            Texels::Floats(_) => Texels::Floats(current.clone()),
            Texels::Bytes(_) => Texels::Bytes(current.iter().map(|c| to_bytes(*c, srgb)).collect()),
        };
        all.push(Picture { width, height, texels });
    }
    all
}

fn to_linear(picture: &Picture, srgb: bool) -> Vec<[f32; 4]> {
    match &picture.texels {
        Texels::Floats(texels) => texels.clone(),
        Texels::Bytes(texels) => texels
            .iter()
            .map(|t| {
                let [r, g, b, a] = t.map(|x| f32::from(x) / 255.0);
                if srgb { [decode_srgb(r), decode_srgb(g), decode_srgb(b), a] } else { [r, g, b, a] }
            })
            .collect(),
    }
}

fn to_bytes([r, g, b, a]: [f32; 4], srgb: bool) -> [u8; 4] {
    let encoded = if srgb { [encode_srgb(r), encode_srgb(g), encode_srgb(b), a] } else { [r, g, b, a] };
    encoded.map(to_byte)
}

/// The nearest 8-bit value; NaN is 0.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the value is clamped to the range of u8")]
pub(super) fn to_byte(x: f32) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// sRGB to linear (IEC 61966-2-1).
pub(super) fn decode_srgb(x: f32) -> f32 {
    if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

/// Linear to sRGB (IEC 61966-2-1).
pub(super) fn encode_srgb(x: f32) -> f32 {
    if x <= 0.003_130_8 { x * 12.92 } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// The next level: sides halve, rounded down. Sides of odd length take three texels, each with the share that is covered.
fn halve(texels: &[[f32; 4]], width: u32, height: u32) -> (Vec<[f32; 4]>, u32, u32) {
    let (new_width, new_height) = ((width / 2).max(1), (height / 2).max(1));
    let mut result = Vec::with_capacity(new_width as usize * new_height as usize);
    for row in 0..new_height {
        for column in 0..new_width {
            let mut sum = [0.0; 4];
            for (y, weight_y) in shares(height, row) {
                for (x, weight_x) in shares(width, column) {
                    let texel = texels[y as usize * width as usize + x as usize];
                    for (total, value) in sum.iter_mut().zip(texel) {
                        *total += value * weight_x * weight_y;
                    }
                }
            }
            result.push(sum);
        }
    }
    (result, new_width, new_height)
}

/// Texels along an axis of `size` that texel `i` of the next level covers, with their shares, which add up to 1.
#[allow(clippy::cast_precision_loss, reason = "sizes of textures are far below 2^24")]
fn shares(size: u32, i: u32) -> impl Iterator<Item = (u32, f32)> {
    let (first, weights) = match size {
        1 => (0, [1.0, 0.0, 0.0]),
        s if s % 2 == 0 => (2 * i, [0.5, 0.5, 0.0]),
        s => {
            let half = s / 2;
            (2 * i, [half - i, half, i + 1].map(|w| w as f32 / s as f32))
        }
    };
    (first..).zip(weights).filter(|(_, w)| *w > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_level_keeps_the_mean() {
        let texels: Vec<[f32; 4]> = (0..35_u8).map(|i| [f32::from(i), 1.0, f32::from(i % 3), 0.5]).collect();
        let picture = Picture { width: 7, height: 5, texels: Texels::Floats(texels) };
        let all = levels(&picture, false);
        let sizes: Vec<_> = all.iter().map(|l| (l.width, l.height)).collect();
        assert_eq!(sizes, [(7, 5), (3, 2), (1, 1)]);
        let Texels::Floats(last) = &all[2].texels else { panic!("floats stay floats") };
        assert!((last[0][0] - 17.0).abs() < 1e-4, "{:?}", last[0]);
        assert!((last[0][1] - 1.0).abs() < 1e-6);
    }

    #[test]
    fn encoded_colours_are_averaged_as_light() {
        let texels = Texels::Bytes(vec![[0, 0, 0, 255], [255, 255, 255, 255]]);
        let all = levels(&Picture { width: 2, height: 1, texels }, true);
        assert_eq!(all[1].texels, Texels::Bytes(vec![[188, 188, 188, 255]]));
    }

    #[test]
    fn srgb_round_trips() {
        for i in 0..=255_u8 {
            assert_eq!(to_byte(encode_srgb(decode_srgb(f32::from(i) / 255.0))), i);
        }
    }
}
