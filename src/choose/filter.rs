//! What filters of shadow maps read around a receiver: depths and their shares.

use glam::DVec2;

use super::receiver::Receiver;
use super::texels::{Plane, Texels};
use crate::reference::{Weights, kernel};

/// Most texels that are looked at for one filter; of wider ones so many are drawn, in even steps of their weight.
const MOST: usize = 192;
/// Most places along a side of a pixel's footprint.
const MOST_PLACES: usize = 4;

/// Which texels are read, and how they are weighted.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum Filter {
    /// The texel that the receiver falls into.
    Nearest,
    /// A Gaussian of so many texels, interpolated: percentage-closer filtering, and blurred maps without mips.
    Kernel(u32),
    /// The same, filtered over the pixel's footprint besides: blurred maps with mips. The second number is the longest
    /// footprint that is followed, in widths.
    Mips(u32, u32),
    /// Comparisons spread over the pixel's footprint, at most so many along each of its sides.
    Footprint(u32),
    /// So many samples of a disc of so many texels, turned from pixel to pixel.
    Disc(u32, f64),
}

impl Filter {
    /// How far it reaches from its middle, texels, without the pixel's footprint.
    pub fn reach(self) -> f64 {
        match self {
            Self::Nearest => 0.5,
            Self::Kernel(width) | Self::Mips(width, _) => f64::from(width) / 2.0 + 0.5,
            Self::Footprint(_) => 1.0,
            Self::Disc(_, radius) => radius + 1.0,
        }
    }
}

/// One depth under a filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Share of the filter.
    pub weight: f64,
    /// Depth, from 0 to 1.
    pub depth: f64,
    /// Variance of depth within the texel.
    pub slope: f64,
    /// Whether it lies in front of the receiver's plane.
    pub dark: bool,
}

/// What a filter reads around a receiver.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// Depths and their shares, which sum to 1.
    pub samples: Vec<Sample>,
    /// Depth of the receiver, which may lie beyond 1.
    pub receiver: f64,
    /// How far, in depth, the receiver's plane reaches to each side within the blur.
    pub reach: f64,
    /// Reads per pixel along the footprint, for those that follow it.
    pub taps: f64,
}

/// Reads a map.
pub(super) fn read(filter: Filter, receiver: &Receiver, plane: &Plane, map: &mut Texels<'_>) -> Seen {
    let side = f64::from(map.side());
    let at = plane.place * side;
    let (mut weights, mut taps) = (Grid::default(), 1.0);
    match filter {
        Filter::Nearest => weights.add(at.x.floor() as i64, at.y.floor() as i64, 1.0),
        Filter::Kernel(width) => weights.spread(at, &kernel(Weights::Gaussian, width as usize), 1.0),
        Filter::Mips(width, most) => {
            let kernel = kernel(Weights::Gaussian, width as usize);
            let footprint = Footprint::new(receiver.changes(plane, map), most);
            taps = footprint.taps as f64;
            let places = footprint.places();
            places.iter().for_each(|place| weights.spread(at + *place, &kernel, 1.0 / places.len() as f64));
        }
        Filter::Footprint(most) => {
            let [along_x, along_y] = receiver.changes(plane, map).map(|change| sides(change, most));
            taps = (along_x.1 * along_y.1) as f64;
            for x in 0..along_x.1 {
                for y in 0..along_y.1 {
                    let off = |i: usize, n: usize| i as f64 - (n as f64 - 1.0) / 2.0;
                    let place = along_x.0 * off(x, along_x.1) + along_y.0 * off(y, along_y.1);
                    weights.spread(at + place, &[1.0], 1.0 / taps);
                }
            }
        }
        Filter::Disc(count, radius) => {
            taps = f64::from(count);
            for place in disc(count, receiver.turn) {
                weights.add_nearest(at + place * radius, 1.0 / f64::from(count));
            }
        }
    }
    let margin = plane.margin(map.side(), if filter == Filter::Nearest { 0.5 } else { filter.reach() });
    let samples = weights.drawn().into_iter().map(|((column, row), weight)| {
        let texel = map.at(column, row);
        let center =
            DVec2::new(column as f64 + 0.5, row as f64 + 0.5).clamp(DVec2::splat(0.5), DVec2::splat(side - 0.5));
        let behind = map.looked().depth(plane.distance_at(center / side)).clamp(0.0, 1.0);
        Sample { weight, depth: texel.depth, slope: texel.slope, dark: texel.depth < behind - margin }
    });
    let samples = samples.collect();
    let slope = plane.depth_slope(map.side());
    Seen { samples, receiver: map.looked().depth(plane.distance), reach: (slope.x + slope.y) * filter.reach(), taps }
}

/// Samples of a spiral over the unit disc (Vogel 1979), turned by a part of a circle.
pub(super) fn disc(count: u32, turn: f64) -> impl Iterator<Item = DVec2> {
    (0..count).map(move |i| {
        let radius = ((f64::from(i) + 0.5) / f64::from(count)).sqrt();
        let golden = 2.399_963_229_728_653;
        DVec2::from_angle(f64::from(i) * golden + turn * std::f64::consts::TAU) * radius
    })
}

/// Steps along a side of a footprint, and how many.
fn sides(change: DVec2, most: u32) -> (DVec2, usize) {
    let width = change.length().max(1.0);
    let count = width.ceil().clamp(1.0, f64::from(most));
    let step = ((width * width - 1.0) / (count * count - 1.0).max(1.0)).sqrt();
    (change.normalize_or_zero() * if count > 1.0 { step } else { 0.0 }, count as usize)
}

/// How shadow nodes cover a pixel's footprint: taps along its longer side, each as wide as they lie apart.
struct Footprint {
    taps: usize,
    step: DVec2,
    width: f64,
}

impl Footprint {
    fn new([across, down]: [DVec2; 2], most: u32) -> Self {
        let (longer, shorter) = if across.length() > down.length() { (across, down) } else { (down, across) };
        let taps = (longer.length() / shorter.length().max(1.0) - 0.01).ceil().clamp(1.0, f64::from(most));
        Self { taps: taps as usize, step: longer / taps, width: (longer.length() / taps).max(1.0) }
    }

    /// Places whose mean is that of the taps: each tap is a square of its width, of which one texel is interpolation.
    fn places(&self) -> Vec<DVec2> {
        let parts = (self.width.ceil() as usize).clamp(1, MOST_PLACES);
        let within = (self.width * self.width - 1.0).max(0.0).sqrt();
        let mut places = Vec::with_capacity(self.taps * parts * parts);
        for tap in 0..self.taps {
            let middle = self.step * (tap as f64 - (self.taps as f64 - 1.0) / 2.0);
            for i in 0..parts * parts {
                let cell = DVec2::new((i % parts) as f64, (i / parts) as f64) + 0.5;
                places.push(middle + (cell / parts as f64 - 0.5) * within);
            }
        }
        places
    }
}

/// Texels and their weights.
#[derive(Default)]
struct Grid {
    weights: std::collections::BTreeMap<(i64, i64), f64>,
}

impl Grid {
    fn add(&mut self, column: i64, row: i64, weight: f64) {
        *self.weights.entry((row, column)).or_default() += weight;
    }

    fn add_nearest(&mut self, at: DVec2, weight: f64) {
        self.add(at.x.floor() as i64, at.y.floor() as i64, weight);
    }

    /// A kernel of texels, each interpolated with its neighbours.
    fn spread(&mut self, at: DVec2, kernel: &[f64], weight: f64) {
        let corner = at - 0.5;
        let (first, part) = (corner.floor(), corner - corner.floor());
        let along = |part: f64| -> Vec<f64> {
            let of = |i: usize| kernel.get(i).copied().unwrap_or_default();
            (0..=kernel.len()).map(|i| of(i) * (1.0 - part) + if i > 0 { of(i - 1) * part } else { 0.0 }).collect()
        };
        let half = (kernel.len() / 2) as i64;
        let (columns, rows) = (along(part.x), along(part.y));
        for (y, of_row) in (0_i64..).zip(&rows) {
            for (x, of_column) in (0_i64..).zip(&columns) {
                self.add(first.x as i64 - half + x, first.y as i64 - half + y, of_row * of_column * weight);
            }
        }
    }

    /// All texels, as (column, row), or as many as are looked at, in even steps of their weight.
    fn drawn(self) -> Vec<((i64, i64), f64)> {
        let all = self.weights.into_iter().filter(|(_, w)| *w > 1e-6).map(|((row, column), w)| ((column, row), w));
        let all: Vec<_> = all.collect();
        let total: f64 = all.iter().map(|(_, w)| w).sum();
        if all.len() <= MOST {
            return all.into_iter().map(|(at, w)| (at, w / total)).collect();
        }
        let step = total / MOST as f64;
        let (mut drawn, mut sum, mut next) = (Vec::with_capacity(MOST), 0.0, step / 2.0);
        for (at, weight) in all {
            sum += weight;
            let mut times = 0.0;
            while sum > next {
                times += 1.0;
                next += step;
            }
            if times > 0.0 {
                drawn.push((at, times / MOST as f64));
            }
        }
        let total: f64 = drawn.iter().map(|(_, w): &(_, f64)| w).sum();
        drawn.into_iter().map(|(at, w)| (at, w / total)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_one_and_lie_around_the_place() {
        for width in [1, 3, 5, 9] {
            let mut grid = Grid::default();
            let at = DVec2::new(10.3, -4.8);
            grid.spread(at, &kernel(Weights::Gaussian, width), 1.0);
            let mean = grid.weights.iter().fold(DVec2::ZERO, |sum, ((row, column), w)| {
                sum + DVec2::new(*column as f64 + 0.5, *row as f64 + 0.5) * *w
            });
            assert!((grid.weights.values().sum::<f64>() - 1.0).abs() < 1e-12);
            assert!(mean.abs_diff_eq(at, 1e-9), "{mean}");
        }
    }

    #[test]
    fn wide_filters_are_drawn_in_even_steps() {
        let mut grid = Grid::default();
        grid.spread(DVec2::splat(0.2), &[1.0 / 25.0; 25], 1.0);
        let drawn = grid.drawn();
        assert!(drawn.len() <= MOST && drawn.len() > MOST / 2, "{}", drawn.len());
        assert!((drawn.iter().map(|d| d.1).sum::<f64>() - 1.0).abs() < 1e-12);
        let mean: f64 = drawn.iter().map(|((column, _), w)| (*column as f64 + 0.5) * w).sum();
        assert!((mean - 0.2).abs() < 0.5, "{mean}");
    }

    #[test]
    fn footprints_are_covered_by_their_taps() {
        let long = Footprint::new([DVec2::new(16.0, 0.0), DVec2::new(0.0, 2.0)], 16);
        assert_eq!((long.taps, long.step.x, long.width), (8, 2.0, 2.0));
        let places = long.places();
        assert_eq!(places.len(), 8 * 4);
        assert!(places.iter().all(|p| p.x.abs() < 8.0 && p.y.abs() < 1.0));
        assert_eq!(Footprint::new([DVec2::X * 0.2, DVec2::Y * 0.1], 16).places(), [DVec2::ZERO]);
    }
}
