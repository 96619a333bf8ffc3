//! Planar layers parallel to the map, and the filters over them, texel by texel.

/// How a filter reads a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taps {
    /// The one that the position falls into.
    Nearest,
    /// Four, weighted by their distance.
    Bilinear,
}

/// A convex part of a plane that faces the light.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Its depth.
    pub depth: f64,
    /// Half planes whose intersection it is: (a, b, c) holds the points with a x + b y <= c. (a, b) is a unit vector.
    pub sides: Vec<[f64; 3]>,
}

/// Layers over a receiver that fills the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// Depth of the receiver.
    pub receiver: f64,
    /// What lies above it.
    pub layers: Vec<Layer>,
}

impl Layers {
    /// Depth of what is nearest to the light at the centre of a texel.
    pub fn depth(&self, x: i64, y: i64) -> f64 {
        let (x, y) = (x as f64 + 0.5, y as f64 + 0.5);
        let covers = |l: &&Layer| l.sides.iter().all(|[a, b, c]| a * x + b * y <= *c);
        self.layers.iter().filter(covers).map(|l| l.depth).fold(self.receiver, f64::min)
    }

    /// The least distance between the centre of a texel within `reach` of (x, y) and the outline of a layer: how far an
    /// outline may be moved before the map changes there.
    pub fn margin(&self, x: f64, y: f64, reach: i64) -> f64 {
        let (column, row) = (x.floor() as i64, y.floor() as i64);
        let texels =
            (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| ((column + i) as f64, (row + j) as f64)));
        let sides = || self.layers.iter().flat_map(|l| &l.sides);
        texels
            .flat_map(|(x, y)| sides().map(move |[a, b, c]| (a * (x + 0.5) + b * (y + 0.5) - c).abs()))
            .fold(f64::INFINITY, f64::min)
    }

    /// The kernel over texels around a position, each read as `taps` says, of what `value` makes of their depth.
    fn filter(&self, kernel: &[f64], taps: Taps, (x, y): (f64, f64), value: impl Fn(f64) -> f64) -> f64 {
        let half = (kernel.len() / 2) as i64;
        let corners = |at: f64| match taps {
            Taps::Nearest => vec![(at.floor() as i64, 1.0)],
            Taps::Bilinear => {
                let low = (at - 0.5).floor();
                let part = at - 0.5 - low;
                vec![(low as i64, 1.0 - part), (low as i64 + 1, part)]
            }
        };
        let mut sum = 0.0;
        for (i, weight_x) in (-half..=half).zip(kernel) {
            for (j, weight_y) in (-half..=half).zip(kernel) {
                for (column, part_x) in corners(x + i as f64) {
                    for (row, part_y) in corners(y + j as f64) {
                        sum += weight_x * weight_y * part_x * part_y * value(self.depth(column, row));
                    }
                }
            }
        }
        sum
    }

    /// The lit share of the receiver: exhaustive percentage-closer filtering (Reeves, Salesin and Cook 1987).
    pub fn lit(&self, kernel: &[f64], taps: Taps, at: (f64, f64)) -> f64 {
        self.filter(kernel, taps, at, |z| if z >= self.receiver { 1.0 } else { 0.0 })
    }

    /// The share of each layer in the filter, and of the receiver, as a [`super::Mix`].
    pub fn mix(&self, kernel: &[f64], taps: Taps, at: (f64, f64)) -> super::Mix {
        #[allow(clippy::float_cmp, reason = "depths are copied, not computed")]
        let share = |depth: f64| self.filter(kernel, taps, at, |z| if z == depth { 1.0 } else { 0.0 });
        let mut depths: Vec<f64> = self.layers.iter().map(|l| l.depth).collect();
        depths.sort_by(f64::total_cmp);
        depths.dedup();
        super::Mix { receiver: self.receiver, occluders: depths.into_iter().map(|z| (z, share(z))).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Weights, edge_visibility, kernel};
    use super::*;

    fn edge(a: f64, b: f64, c: f64) -> Layers {
        Layers { receiver: 0.8, layers: vec![Layer { depth: 0.3, sides: vec![[a, b, c]] }] }
    }

    #[test]
    fn the_exhaustive_filter_of_a_straight_edge_is_the_closed_form() {
        for (_, weights) in Weights::ALL {
            for width in [1, 3, 7] {
                let kernel = kernel(weights, width);
                // Texels up to 9 are covered, so the edge counts as lying at 10 wherever it is between 9.5 and 10.5.
                for c in [10.0, 10.4] {
                    for at in [4.0, 8.3, 9.9, 10.0, 12.25, 15.0] {
                        let lit = edge(1.0, 0.0, c).lit(&kernel, Taps::Bilinear, (at, 3.3));
                        assert!((lit - edge_visibility(&kernel, at - 10.0)).abs() < 1e-12);
                    }
                }
            }
        }
    }

    #[test]
    fn nearest_taps_make_stairs() {
        let kernel = kernel(Weights::Box, 3);
        let levels: Vec<f64> = (0..60)
            .map(|i| edge(1.0, 0.0, 10.0).lit(&kernel, Taps::Nearest, (7.0 + f64::from(i) * 0.1, 2.5)))
            .collect();
        let mut distinct = levels.clone();
        distinct.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
        assert_eq!(distinct.len(), 4, "{distinct:?}");
        assert!(levels.is_sorted());
    }

    /// With one tap per texel the truth is the area; a wide box at any angle comes near the closed form, the
    /// convolution of the two projections of the box.
    #[test]
    fn a_turned_edge_comes_near_the_convolution_of_two_boxes() {
        let (sine, cosine) = 0.3_f64.sin_cos();
        let width = 41;
        let kernel = kernel(Weights::Box, width);
        let scene = edge(cosine, sine, 0.0);
        for x in [-25.0, -12.0, -3.0, 0.0, 5.0, 18.0] {
            let lit = scene.lit(&kernel, Taps::Bilinear, (x * cosine, x * sine));
            // The integral over the narrower projection of the ramp of the wider.
            let (wide, narrow) = (width as f64 * cosine, width as f64 * sine);
            let steps = 2000;
            let exact = (0..steps)
                .map(|i| super::super::box_ramp(wide, x + narrow * ((f64::from(i) + 0.5) / f64::from(steps) - 0.5)))
                .sum::<f64>()
                / f64::from(steps);
            assert!((lit - exact).abs() < 0.004, "{x}: {lit} {exact}");
        }
    }

    #[test]
    fn shares_are_told_apart_by_depth_and_margins_are_distances() {
        let mut scene = edge(1.0, 0.0, 10.25);
        scene.layers.push(Layer { depth: 0.1, sides: vec![[1.0, 0.0, 9.0]] });
        let kernel = kernel(Weights::Box, 3);
        let mix = scene.mix(&kernel, Taps::Bilinear, (9.5, 0.5));
        let shares: Vec<f64> = mix.occluders.iter().map(|o| o.1).collect();
        assert!((shares[0] - 1.0 / 3.0).abs() < 1e-12 && (shares[1] - 1.0 / 3.0).abs() < 1e-12, "{mix:?}");
        assert!((mix.lit() - scene.lit(&kernel, Taps::Bilinear, (9.5, 0.5))).abs() < 1e-12);
        assert!((scene.margin(9.5, 0.5, 3) - 0.25).abs() < 1e-12);
    }
}
