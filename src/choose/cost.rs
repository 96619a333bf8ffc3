//! What a candidate costs on a device: work, counted, times constants that were measured there.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::candidate::Candidate;

/// Version of the tables that are written. Others are not read.
pub const VERSION: u32 = 3;
/// Rounds of the fit.
const ROUNDS: usize = 4000;

/// Milliseconds per unit of each kind of work, on one device.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CostTable {
    /// [`VERSION`].
    pub version: u32,
    /// Name of the adapter, with its driver.
    pub device: String,
    /// Milliseconds per unit, by the name of the work.
    pub items: BTreeMap<String, f64>,
}

/// Which passes work is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Share {
    /// Passes that draw occluders.
    Light,
    /// Passes that make maps from maps.
    Filter,
    /// The pass that draws the picture.
    Main,
}

/// Work by its name: passes by number; texels, pixels, reads and triangles in millions.
pub type Work = BTreeMap<Share, BTreeMap<String, f64>>;

/// What a picture asks of any candidate.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// Pixels of the picture.
    pub pixels: f64,
    /// Of these, those that look the shadow up.
    pub shaded: f64,
    /// Triangles of all that casts.
    pub triangles: f64,
    /// Views of the light when it is not cut into parts: six of a point light.
    pub views: u32,
    /// By the number of parts that the view is cut into: the share of all texels that an occluder covers.
    pub covered: BTreeMap<u32, f64>,
}

/// The work of a candidate whose pixels make so many reads along their footprints.
pub fn work(candidate: &Candidate, taps: f64, load: &Load) -> Work {
    let million = 1e-6;
    let views = f64::from(load.views.max(candidate.parts));
    let texels = f64::from(candidate.side).powi(2) * views * million;
    let map = candidate.map;
    let mut work = Work::new();
    let mut add = |share: Share, name: String, amount: f64| {
        *work.entry(share).or_default().entry(name).or_default() += amount;
    };
    add(Share::Light, "light pass".into(), views);
    let covered = load.covered.get(&candidate.parts).copied().unwrap_or(1.0);
    add(Share::Light, format!("clear {map}"), texels);
    add(Share::Light, format!("draw {map}"), texels * covered);
    add(Share::Light, "triangle".into(), load.triangles * views * million);
    if candidate.blur > 1 {
        add(Share::Filter, "blur pass".into(), 2.0 * views);
        add(Share::Filter, format!("blur {map}"), texels);
        add(Share::Filter, format!("blur tap {map}"), texels * f64::from(candidate.blur));
    }
    if candidate.mips {
        add(Share::Filter, "mip pass".into(), views * f64::from(candidate.side.max(1).ilog2()));
        add(Share::Filter, format!("mip {map}"), texels);
    }
    let (reads, count) = candidate.reads;
    add(Share::Main, "pixel".into(), load.pixels * million);
    add(Share::Main, format!("{} pixel", candidate.kind), load.shaded * million);
    // What follows the footprint counts its reads there.
    let count = if count > 0.0 { count } else { taps };
    let reads = if candidate.filter.is_some() && candidate.blur > 0 { format!("{reads}, {map}") } else { reads.into() };
    add(Share::Main, reads, load.shaded * count * million);
    if candidate.parts > 1 {
        add(Share::Main, "choice of a part".into(), load.shaded * million);
    }
    work
}

impl CostTable {
    /// Milliseconds of some work; none if it holds something that was not measured.
    pub fn price(&self, work: &Work) -> Option<f64> {
        let all = work.values().flatten();
        all.map(|(name, amount)| self.items.get(name).map(|each| each * amount)).sum()
    }

    /// Fits constants to measured work and times, milliseconds by share; relative errors are least. What never occurs gets
    /// no constant, and none is less than zero.
    pub fn fit(device: &str, measured: &[(Work, BTreeMap<Share, f64>)]) -> Self {
        let mut items = BTreeMap::new();
        for share in [Share::Light, Share::Filter, Share::Main] {
            let rows: Vec<(&BTreeMap<String, f64>, f64)> = measured
                .iter()
                .filter_map(|(work, times)| Some((work.get(&share)?, *times.get(&share)?)))
                .filter(|(_, time)| *time > 0.0)
                .collect();
            items.extend(least_squares(&rows));
        }
        Self { version: VERSION, device: device.to_owned(), items }
    }
}

/// Numbers of at least zero by which the rows come nearest to their times, as parts of these: one number after the other is
/// set to its best, over and over.
fn least_squares(rows: &[(&BTreeMap<String, f64>, f64)]) -> BTreeMap<String, f64> {
    let mut names: Vec<&String> = rows.iter().flat_map(|(work, _)| work.keys()).collect();
    names.sort();
    names.dedup();
    let columns: Vec<Vec<f64>> = names
        .iter()
        .map(|name| rows.iter().map(|(work, time)| work.get(*name).copied().unwrap_or_default() / time).collect())
        .collect();
    let mut left = vec![1.0; rows.len()];
    let mut values = vec![0.0; names.len()];
    for _ in 0..ROUNDS {
        for (value, column) in values.iter_mut().zip(&columns) {
            let square: f64 = column.iter().map(|a| a * a).sum();
            if square <= 0.0 {
                continue;
            }
            let better = (*value + column.iter().zip(&left).map(|(a, l)| a * l).sum::<f64>() / square).max(0.0);
            left.iter_mut().zip(column).for_each(|(l, a)| *l -= a * (better - *value));
            *value = better;
        }
    }
    names.into_iter().cloned().zip(values).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_found_again() {
        let truth: BTreeMap<&str, f64> = [("a", 0.5), ("b", 2.0), ("c", 0.0)].into();
        let row = |a: f64, b: f64, c: f64| {
            let amounts: BTreeMap<String, f64> = [("a".to_owned(), a), ("b".to_owned(), b), ("c".to_owned(), c)].into();
            let time = amounts.iter().map(|(n, x)| truth[n.as_str()] * x).sum();
            (Work::from([(Share::Main, amounts)]), BTreeMap::from([(Share::Main, time)]))
        };
        let measured = [row(1.0, 1.0, 1.0), row(2.0, 1.0, 0.0), row(1.0, 4.0, 2.0), row(3.0, 0.5, 1.0)];
        let table = CostTable::fit("a device", &measured);
        for (name, value) in truth {
            assert!((table.items[name] - value).abs() < 1e-3, "{name}: {:?}", table.items);
        }
        assert!((table.price(&measured[2].0).expect("known") - 8.5).abs() < 0.01);
        let unknown = Work::from([(Share::Main, BTreeMap::from([("d".to_owned(), 1.0)]))]);
        assert_eq!(table.price(&unknown), None);
    }
}
