//! Which pixels are lit, dark, between the two, or beside the outline of a body.

use crate::reference::Metrics;

use std::collections::BTreeMap;

/// Visibility from which a pixel counts as lit, and as dark below its complement: half a step of 8 bits.
const LIT: f32 = 1.0 - 0.5 / 255.0;
/// Bend of depth between three neighbours, beside the least of them, from which there is an outline: surfaces seen at a
/// grazing angle change quickly, but evenly.
const BEND: f32 = 0.02;
/// Pixels on either side of an outline that belong to it.
const BORDER: usize = 2;

/// Visibility, as it ought to be, and whether an outline is near.
type Pixel = (f32, f32, bool);
/// Whether a pixel belongs to a part.
type Part = fn(&Pixel) -> bool;

/// Metrics over all pixels that both pictures show, and over the parts that the truth divides them into: `lit`, `umbra`,
/// `penumbra`, and `silhouette`, which are the pixels next to an outline of a body, whatever else they are. `depth` is the
/// distance from the eye, rows from the top, with coverage in the fourth number.
pub(super) fn regions(
    seen: &[[f32; 4]],
    truth: &[[f32; 4]],
    depth: &[[f32; 4]],
    columns: usize,
) -> BTreeMap<String, Metrics> {
    let outlines = outlines(depth, columns);
    let pixels: Vec<Pixel> = seen
        .iter()
        .zip(truth)
        .zip(&outlines)
        .filter(|((a, b), _)| a[3] > 0.0 && b[3] > 0.0)
        .map(|((a, b), outline)| (a[0], b[0], *outline))
        .collect();
    let parts: [(&str, Part); 5] = [
        ("all", |_| true),
        ("lit", |(_, truth, outline)| *truth >= LIT && !outline),
        ("penumbra", |(_, truth, outline)| (1.0 - LIT..LIT).contains(truth) && !outline),
        ("silhouette", |(_, _, outline)| *outline),
        ("umbra", |(_, truth, outline)| *truth < 1.0 - LIT && !outline),
    ];
    let of =
        |part: Part| Metrics::new(pixels.iter().filter(|p| part(p)).map(|(a, b, _)| (f64::from(*a), f64::from(*b))));
    parts.iter().map(|(name, part)| ((*name).to_owned(), of(*part))).collect()
}

/// Pixels within [`BORDER`] of a jump of depth, or of where nothing is seen.
fn outlines(depth: &[[f32; 4]], columns: usize) -> Vec<bool> {
    let columns = columns.max(1);
    let rows = depth.len() / columns;
    let at = |x: usize, y: usize| depth[y * columns + x];
    let bent = |a: [f32; 4], b: [f32; 4], c: [f32; 4]| {
        let shown = [a, b, c].iter().filter(|p| p[3] > 0.0).count();
        let least = a[0].min(b[0]).min(c[0]);
        shown == 1 || shown == 2 || (shown == 3 && (a[0] - 2.0 * b[0] + c[0]).abs() > BEND * least)
    };
    let mut jumps = vec![false; depth.len()];
    for y in 0..rows {
        for x in 0..columns {
            let across = x > 0 && x + 1 < columns && bent(at(x - 1, y), at(x, y), at(x + 1, y));
            let down = y > 0 && y + 1 < rows && bent(at(x, y - 1), at(x, y), at(x, y + 1));
            jumps[y * columns + x] = across || down;
        }
    }
    // A jump between two pixels bends at both, so one pixel more is enough.
    let reach = BORDER - 1;
    let near = |index: usize| {
        let (x, y) = (index % columns, index / columns);
        let xs = x.saturating_sub(reach)..=(x + reach).min(columns - 1);
        let ys = y.saturating_sub(reach)..=(y + reach).min(rows.max(1) - 1);
        ys.into_iter().any(|y| xs.clone().any(|x| jumps[y * columns + x]))
    };
    (0..rows * columns).map(near).chain(std::iter::repeat_n(false, depth.len() - rows * columns)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_told_apart_and_outlines_lie_beside_jumps() {
        let columns = 12;
        // A body at 1 m before a ground that runs away evenly.
        let depth: Vec<[f32; 4]> = (0..columns * 3)
            .map(|i| if i % columns < 4 { 1.0 } else { (i % columns) as f32 })
            .map(|d| [d, d, d, 1.0])
            .collect();
        let outline = outlines(&depth, columns);
        assert_eq!(
            outline[..columns].iter().map(|o| u8::from(*o)).collect::<Vec<_>>(),
            [0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0]
        );
        let truth: Vec<[f32; 4]> = (0..columns * 3)
            .map(|i| match i % columns {
                0..=7 => 0.0,
                8 => 0.5,
                _ => 1.0,
            })
            .map(|v| [v, v, v, 1.0])
            .collect();
        let seen: Vec<[f32; 4]> = truth.iter().map(|t| [(t[0] + 0.25).min(1.0), 0.0, 0.0, 1.0]).collect();
        let regions = regions(&seen, &truth, &depth, columns);
        let pixels = |name: &str| regions[name].pixels;
        assert_eq!(
            [pixels("all"), pixels("lit"), pixels("penumbra"), pixels("umbra"), pixels("silhouette")],
            [36, 9, 3, 12, 12]
        );
        assert_eq!((regions["lit"].rms, regions["umbra"].false_lit), (0.0, 1.0));
    }
}
