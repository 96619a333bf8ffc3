//! Marks of methods: a shape and a colour each, so that either alone tells most of them apart and both all.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

/// Colours that those who see no red or no green tell apart too (Okabe and Ito 2008); its yellow is darker here, for white
/// paper.
const COLORS: [&str; 8] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#3b3b3b", "#a8930a"];
/// Corners on the unit circle: how many, the turn in parts of a full one, and how far in lie points between.
const SHAPES: [(usize, f64, f64); 11] = [
    (0, 0.0, 1.0),    // circle
    (4, 0.125, 1.0),  // square
    (3, 0.0, 1.0),    // triangle up
    (4, 0.0, 1.0),    // diamond
    (3, 0.5, 1.0),    // triangle down
    (5, 0.0, 0.45),   // star
    (4, 0.125, 0.38), // cross
    (6, 0.0, 1.0),    // hexagon
    (3, 0.25, 1.0),   // triangle right
    (4, 0.0, 0.38),   // plus, pointed
    (3, -0.25, 1.0),  // triangle left
];

/// The colour of a method by its number.
pub(super) fn color(method: usize) -> &'static str {
    COLORS[method % COLORS.len()]
}

/// A colour that is mostly grey, of a point that others beat.
pub(super) fn pale(method: usize) -> String {
    let base = color(method);
    let mix = |at: usize| {
        let c = base.get(at..at + 2).and_then(|t| u32::from_str_radix(t, 16).ok()).unwrap_or(128);
        (c * 28 + 215 * 72) / 100
    };
    format!("#{:02x}{:02x}{:02x}", mix(1), mix(3), mix(5))
}

/// Radius of a mark, in points: its area grows with the bits of a texel.
pub(super) fn radius(bits: Option<u32>) -> f64 {
    let bits = f64::from(bits.unwrap_or(16).clamp(8, 256));
    2.9 * (bits / 16.0).powf(0.38)
}

/// The mark of a method around a place, with further attributes. All shapes of one radius cover about the same area.
pub(super) fn mark(method: usize, [x, y]: [f64; 2], radius: f64, attributes: &str) -> String {
    let (corners, turn, inner) = SHAPES[method % SHAPES.len()];
    if corners == 0 {
        return format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.2}\" {attributes}/>");
    }
    let star = inner < 1.0;
    let count = if star { 2 * corners } else { corners };
    let angle = TAU / count as f64;
    // A star's area is that of triangles between its inner and outer corners.
    let area = count as f64 / 2.0 * angle.sin() * if star { inner } else { 1.0 };
    let reach = radius * (PI / area).sqrt().min(1.75);
    let mut points = String::new();
    for i in 0..count {
        let a = i as f64 * angle + turn * TAU;
        let r = if star && i % 2 == 1 { reach * inner } else { reach };
        let _ = write!(points, "{}{:.1},{:.1}", if i == 0 { "" } else { " " }, x + r * a.sin(), y - r * a.cos());
    }
    format!("<polygon points=\"{points}\" {attributes}/>")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn two_dozen_methods_are_told_apart() {
        let marks: BTreeSet<String> = (0..24).map(|m| color(m).to_owned() + &mark(m, [0.0, 0.0], 5.0, "")).collect();
        assert_eq!(marks.len(), 24);
        // Neighbours differ in both.
        for m in 0..100 {
            assert_ne!(color(m), color(m + 1));
            assert_ne!(mark(m, [0.0, 0.0], 5.0, ""), mark(m + 1, [0.0, 0.0], 5.0, ""));
        }
        assert!((0..30).all(|m| pale(m).len() == 7));
        assert!(radius(Some(16)) < radius(Some(32)) && radius(Some(64)) < radius(Some(128)));
        assert!((radius(None) - radius(Some(16))).abs() < 1e-12);
    }
}
