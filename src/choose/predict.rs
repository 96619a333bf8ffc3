//! How far off each candidate will be: its closed form against the rays, at the drawn receivers.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::blockers::searched;
use super::candidate::Candidate;
use super::filter::{Filter, Seen, read};
use super::judge::{Judge, lit};
use super::receiver::{Receivers, Site, Stratum, looked};
use super::texels::{Plane, Texels};
use crate::reference::picture::Watch;
use crate::reference::{Cut, Light};

/// What is bounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Metric {
    /// Root of the mean square error.
    #[default]
    Rms,
    /// Greatest error of 99 in 100 pixels.
    Percentile99,
    /// Greatest error.
    Most,
    /// Share of pixels that are off by more than 0.05.
    OverTwentieth,
}

impl Metric {
    /// Every metric with its name.
    pub const ALL: [(&'static str, Self); 4] = [
        ("rms", Self::Rms),
        ("percentile_99", Self::Percentile99),
        ("most", Self::Most),
        ("over_twentieth", Self::OverTwentieth),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, m)| *m == self).map_or("", |(n, _)| n)
    }
}

/// What is known of a candidate before it is tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlook {
    /// The candidate.
    pub candidate: Candidate,
    /// The error to be expected.
    pub error: f64,
    /// The error that will hardly be exceeded.
    pub bound: f64,
    /// Reads that a pixel makes along its footprint, on average.
    pub taps: f64,
}

/// Standard errors of the mean square that the bound leaves for the choice of receivers.
const DEVIATIONS: f64 = 2.0;
/// What the bound leaves for all that closed forms do not know: the rasteriser's rounding, weights of samplers, edges of
/// mips. As a part of the error, and of the whole range.
const UNKNOWN: (f64, f64) = (0.06, 0.0008);

/// Judges all candidates. None if cancelled.
pub fn predict(
    site: &Site<'_>,
    receivers: &Receivers,
    candidates: Vec<Candidate>,
    metric: Metric,
    watch: Watch<'_>,
) -> Option<Vec<Outlook>> {
    // Those that share a map are judged together.
    let mut groups: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for (index, candidate) in candidates.iter().enumerate() {
        groups.entry((candidate.side, candidate.parts)).or_default().push(index);
    }
    // The largest maps take longest, and so come first.
    let groups: Vec<_> = groups.into_iter().rev().collect();
    let (next, found) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(groups.len().max(1));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(((side, parts), members)) = groups.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let own: Vec<&Candidate> = members.iter().map(|i| &candidates[*i]).collect();
                    let Some(judged) = judge(site, receivers, (*side, *parts), &own, metric, watch) else { return };
                    let mut found = found.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                    found.extend(members.iter().copied().zip(judged));
                    (watch.done)(members.len());
                }
            });
        }
    });
    let mut found = found.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    found.sort_by_key(|(index, _)| *index);
    if found.len() != candidates.len() {
        return None;
    }
    let outlooks = candidates.into_iter().zip(found);
    Some(outlooks.map(|(candidate, (_, (error, bound, taps)))| Outlook { candidate, error, bound, taps }).collect())
}

/// The light with its view cut into parts.
pub fn cut(site: &Site<'_>, side: u32, parts: u32) -> Light {
    let light = site.light.clone();
    if parts <= 1 {
        return light;
    }
    let cut = Cut { parts, balance: 0.5, reach: 0.0, stable: false, blend: false, side };
    light.cut(&cut, &site.camera, site.size, site.world)
}

/// Error, bound and reads of candidates that share a map.
fn judge(
    site: &Site<'_>,
    receivers: &Receivers,
    (side, parts): (u32, u32),
    own: &[&Candidate],
    metric: Metric,
    watch: Watch<'_>,
) -> Option<Vec<(f64, f64, f64)>> {
    let light = cut(site, side, parts);
    let views = looked(site.world, &light, site.far);
    let mut maps: Vec<Texels<'_>> = views.iter().map(|l| Texels::new(site.world, *l, side)).collect();
    let mut filters: Vec<Filter> = own.iter().filter_map(|c| c.filter).collect();
    filters.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    filters.dedup();
    let mut errors: Vec<Errors> = own.iter().map(|_| Errors::default()).collect();
    for receiver in &receivers.drawn {
        if watch.cancel.load(Ordering::Relaxed) {
            return None;
        }
        let view = light.view_of(receiver.point.position).filter(|_| receiver.point.receives);
        let (Some(view), known) = (view, receiver.truth.error.powi(2)) else {
            errors
                .iter_mut()
                .for_each(|e| e.add(1.0 - receiver.truth.mean, 0.0, receiver.weight, receiver.stratum, 1.0));
            continue;
        };
        let plane = Plane::of(&views[view], &receiver.point);
        let map = &mut maps[view];
        let reads: Vec<Seen> = filters.iter().map(|f| read(*f, receiver, &plane, map)).collect();
        for (candidate, errors) in own.iter().zip(&mut errors) {
            let seen = candidate.filter.and_then(|f| filters.iter().position(|g| *g == f)).map(|i| &reads[i]);
            let value = match (candidate.judge, seen) {
                (Judge::Blockers { search, filter }, _) => {
                    searched((search, filter), &light.source, receiver.turn, &plane, map)
                }
                (closed, Some(seen)) => lit(closed, seen),
                (_, None) => 1.0,
            };
            let taps = seen.map_or(1.0, |s| s.taps);
            errors.add(value - receiver.truth.mean, known, receiver.weight, receiver.stratum, taps);
        }
    }
    Some(errors.iter().map(|e| e.summary(metric)).collect())
}

/// Errors of one candidate, with what each stands for.
#[derive(Clone, Debug, Default)]
struct Errors {
    /// Error, the variance that is the truth's own, weight, and what it was drawn from.
    all: Vec<(f64, f64, f64, Stratum)>,
    taps: f64,
    weight: f64,
}

impl Errors {
    fn add(&mut self, error: f64, known: f64, weight: f64, stratum: Stratum, taps: f64) {
        self.all.push((if error.is_finite() { error } else { 1.0 }, known, weight, stratum));
        self.taps += taps * weight;
        self.weight += weight;
    }

    /// The error to be expected, the bound, and reads per pixel.
    fn summary(&self, metric: Metric) -> (f64, f64, f64) {
        let taps = self.taps / self.weight.max(1e-12);
        let (error, bound) = match metric {
            Metric::Rms => {
                let (mean, deviation) = self.mean(&|e, known| (e * e - known).max(0.0));
                (mean.sqrt(), (mean + DEVIATIONS * deviation).sqrt())
            }
            Metric::OverTwentieth => {
                let (mean, deviation) = self.mean(&|e, _| if e.abs() > 0.05 { 1.0 } else { 0.0 });
                (mean, mean + DEVIATIONS * deviation)
            }
            Metric::Percentile99 => (self.quantile(0.99), self.quantile(0.995)),
            Metric::Most => (self.quantile(1.0), self.quantile(1.0)),
        };
        (error, bound * (1.0 + UNKNOWN.0) + UNKNOWN.1, taps)
    }

    /// Weighted mean of something, and its standard error: the sum over all strata. Near edges a few receivers may be quite
    /// wrong that none was drawn of: one more that is half wrong is thought of.
    fn mean(&self, of: &dyn Fn(f64, f64) -> f64) -> (f64, f64) {
        let total = self.weight.max(1e-12);
        let mean = self.all.iter().map(|(e, known, w, _)| of(*e, *known) * w).sum::<f64>() / total;
        let variance: f64 = Stratum::ALL
            .into_iter()
            .map(|stratum| {
                let own = || self.all.iter().filter(move |a| a.3 == stratum);
                let (count, weight) = (own().count() as f64, own().map(|a| a.2).sum::<f64>() / total);
                if count < 2.0 {
                    return 0.0;
                }
                let middle = own().map(|a| of(a.0, a.1)).sum::<f64>() / count;
                let unseen = if stratum == Stratum::Other { 0.0 } else { of(0.5, 0.0) };
                let spread = own().map(|a| (of(a.0, a.1) - middle).powi(2)).sum::<f64>() + (unseen - middle).powi(2);
                let spread = spread / (count - 1.0);
                weight * weight * spread / count
            })
            .sum();
        (mean, variance.sqrt())
    }

    /// The error that a share of the weights is at most at.
    fn quantile(&self, share: f64) -> f64 {
        let mut sizes: Vec<(f64, f64)> = self.all.iter().map(|(e, _, w, _)| (e.abs(), *w)).collect();
        sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut sum = 0.0;
        for (size, weight) in &sizes {
            sum += weight;
            if sum >= share * self.weight * (1.0 - 1e-9) {
                return *size;
            }
        }
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_weighted_and_their_uncertainty_is_that_of_all_strata() {
        let mut errors = Errors::default();
        for i in 0..400 {
            errors.add(if i % 2 == 0 { 0.2 } else { -0.2 }, 0.0, 0.000_25, Stratum::Edge, 3.0);
        }
        for _ in 0..50 {
            errors.add(0.0, 0.0, 0.018, Stratum::Other, 1.0);
        }
        let (error, bound, taps) = errors.summary(Metric::Rms);
        assert!((error - 0.2 * 0.1_f64.sqrt()).abs() < 1e-9, "{error}");
        assert!(bound > error && bound < error * 1.1, "all errors of a stratum are as large: {bound}");
        assert!((taps - 1.2).abs() < 1e-9);
        assert!((errors.summary(Metric::OverTwentieth).0 - 0.1).abs() < 1e-9);
        assert_eq!(errors.summary(Metric::Percentile99).0, 0.2);
        assert_eq!(errors.summary(Metric::Most).0, 0.2);
    }

    #[test]
    fn what_is_not_known_of_the_truth_is_no_error_of_the_candidate() {
        let mut errors = Errors::default();
        (0..10).for_each(|_| errors.add(0.05, 0.05 * 0.05, 0.1, Stratum::Edge, 1.0));
        assert!(errors.summary(Metric::Rms).0 < 1e-9);
    }
}
