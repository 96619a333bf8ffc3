//! Which candidates are rendered, one after the other, to find the cheapest that keeps an error.

use std::collections::BTreeMap;

use crate::choose::{Priced, Wish};

/// Most candidates that are rendered to verify a choice.
const MOST_TRIED: usize = 24;
/// Of these, those that by all that is known do not keep the error, but come near.
const MOST_UNLIKELY: usize = 6;
/// Cheaper candidates are tried if they cost less than this part of what is known to hold.
const CHEAPER: f64 = 0.9;

/// What is known after each rendering, and what is rendered next.
pub(super) struct Trial<'a> {
    wish: &'a Wish,
    /// Those that were not rendered, the cheapest first.
    left: Vec<&'a Priced>,
    first: Option<Priced>,
    /// By how much those of a kind, with or without splits, were worse than expected.
    worse: BTreeMap<(&'static str, bool), f64>,
    /// The cheapest that keeps the error, or else the most exact, with its error.
    pub(super) best: Option<(Priced, f64)>,
    tried: usize,
    /// Of these, those that were not expected to keep it.
    unlikely: usize,
}

impl<'a> Trial<'a> {
    pub(super) fn new(all: &'a [Priced], first: &Priced, wish: &'a Wish) -> Self {
        let affordable = |p: &Priced| wish.budget.is_none_or(|b| p.milliseconds <= b);
        let mut left: Vec<&Priced> =
            all.iter().filter(|p| affordable(p) && p.outlook.candidate != first.outlook.candidate).collect();
        left.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
        Self { wish, left, first: Some(first.clone()), worse: BTreeMap::new(), best: None, tried: 0, unlikely: 0 }
    }

    fn holds(&self) -> Option<&Priced> {
        self.best.as_ref().filter(|(_, error)| *error <= self.wish.max_error).map(|(priced, _)| priced)
    }

    fn expected(&self, priced: &Priced) -> f64 {
        let candidate = &priced.outlook.candidate;
        priced.outlook.error * self.worse.get(&(candidate.kind, candidate.parts > 1)).copied().unwrap_or(1.0)
    }

    /// First the choice itself, then the cheapest that may keep the error by all that is known now; if there is none, and
    /// none was found, whatever comes nearest.
    pub(super) fn next(&mut self) -> Option<Priced> {
        self.tried += 1;
        if let Some(first) = self.first.take() {
            return Some(first);
        }
        // None that is hardly cheaper: prices are not that exact.
        let cheaper = |p: &Priced| self.holds().is_none_or(|best| p.milliseconds < best.milliseconds * CHEAPER);
        let likely = self.left.iter().position(|p| cheaper(p) && self.expected(p) <= self.wish.max_error);
        let at = match likely {
            Some(at) if self.tried <= MOST_TRIED => at,
            _ if self.holds().is_some() || self.unlikely >= MOST_UNLIKELY => return None,
            _ => {
                self.unlikely += 1;
                let of = |i: &usize| self.expected(self.left[*i]);
                (0..self.left.len()).min_by(|a, b| of(a).total_cmp(&of(b)))?
            }
        };
        Some(self.left.remove(at).clone())
    }

    pub(super) fn found(&mut self, priced: &Priced, error: f64) {
        let kept = error <= self.wish.max_error;
        let better = match &self.best {
            None => true,
            Some((best, least)) if *least <= self.wish.max_error => kept && priced.milliseconds < best.milliseconds,
            Some((_, least)) => error < *least,
        };
        if better {
            self.best = Some((priced.clone(), error));
        }
        if !kept {
            let candidate = &priced.outlook.candidate;
            let worse = self.worse.entry((candidate.kind, candidate.parts > 1)).or_insert(1.0);
            *worse = worse.max(error / priced.outlook.error.max(1e-6));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choose::{Demand, Metric, Outlook, candidates};

    const WISH: Wish = Wish { max_error: 0.05, metric: Metric::Rms, budget: None };

    /// Candidates of every kind with prices and expected errors that follow no order, prices well apart.
    fn all() -> Vec<Priced> {
        let demand =
            Demand { sides: vec![256, 1024], parts: vec![1, 2], penumbra: [0.02, 0.05], footprint: 0.001, soft: true };
        let list = candidates(&demand).into_iter().step_by(9);
        let priced = list.enumerate().map(|(i, candidate)| {
            let error = 0.01 + 0.012 * ((i * 7) % 13) as f64;
            let milliseconds = 1.3_f64.powi(((i * 11) % 31) as i32) + i as f64 * 1e-3;
            Priced { outlook: Outlook { candidate, error, bound: error * 1.3, taps: 1.0 }, milliseconds }
        });
        priced.collect()
    }

    /// Tries until the end, where a kind is so many times worse than expected. The best with its error, and all tries.
    fn tried(all: &[Priced], first: &Priced, worse: impl Fn(&str) -> f64) -> ((Priced, f64), usize) {
        let mut trial = Trial::new(all, first, &WISH);
        let mut names = Vec::new();
        while let Some(priced) = trial.next() {
            let name = priced.outlook.candidate.name();
            assert!(!names.contains(&name), "{name} twice");
            names.push(name);
            trial.found(&priced, priced.outlook.error * worse(priced.outlook.candidate.kind));
        }
        (trial.best.expect("one was tried"), names.len())
    }

    #[test]
    fn the_cheapest_that_keeps_the_error_is_found_whatever_kinds_are_worse_than_expected() {
        let all = all();
        assert!(all.len() > 40, "{}", all.len());
        for worse in [1.0, 1.5, 3.0] {
            for kind in ["pcf_shadow", "variance_shadow", "hard_shadow"] {
                let of = |k: &str| if k == kind { worse } else { 1.0 };
                let error = |p: &Priced| p.outlook.error * of(p.outlook.candidate.kind);
                let good = all.iter().filter(|p| error(p) <= WISH.max_error);
                let best = good.min_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds)).expect("some hold");
                for first in [&all[0], &all[17], &all[all.len() - 1]] {
                    let ((found, at), count) = tried(&all, first, of);
                    assert!(at <= WISH.max_error && count <= MOST_TRIED, "{count}");
                    let ratio = found.milliseconds / best.milliseconds;
                    assert!(
                        ratio <= 1.0 / CHEAPER,
                        "{ratio} {} {}",
                        found.outlook.candidate.name(),
                        best.outlook.candidate.name()
                    );
                }
            }
        }
    }

    #[test]
    fn where_nothing_keeps_it_the_nearest_of_a_few_is_told() {
        let all = all();
        let ((_, error), count) = tried(&all, &all[3], |_| 20.0);
        assert!(error > WISH.max_error);
        assert!(count < all.len() / 2, "{count}");
        let least = all.iter().map(|p| p.outlook.error * 20.0).fold(f64::INFINITY, f64::min);
        assert!(error <= least * 1.5, "{error} {least}");
    }

    #[test]
    fn nothing_beyond_the_budget_is_tried() {
        let all = all();
        let wish = Wish { budget: Some(10.0), ..WISH };
        let mut trial = Trial::new(&all, &all[0], &wish);
        trial.next();
        trial.found(&all[0], 1.0);
        while let Some(priced) = trial.next() {
            assert!(priced.milliseconds <= 10.0);
            trial.found(&priced, 1.0);
        }
    }
}
