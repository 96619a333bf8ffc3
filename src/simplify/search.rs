//! The search: single swaps first, then one after the other by what each saves for the error that it adds.
//!
//! Which swap comes next is found lazily (Minoux 1978, "Accelerated greedy algorithms"): what was found out of a swap
//! earlier is taken for what it would do now, and only the best by that is measured again, until the best is one that was
//! just measured. Where swaps help or harm each other the order may so differ from that of measuring all again; every
//! figure that is given is measured all the same.

use std::collections::BTreeMap;

use crate::cost::Cost;

/// Operations that a texture read counts for where both are one number. Between the few that one costs from a cache and
/// the hundreds that it costs from memory.
pub const READ: f64 = 16.0;

/// Errors that differ by less are taken for equal, so that a swap that harms nothing is not infinitely good.
const LEAST_ERROR: f64 = 1e-5;

/// What was measured of a variant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    /// What it costs, in any unit.
    pub cost: f64,
    /// How far it is off; 0 for the full material.
    pub error: f64,
}

/// A cost as one number.
pub fn weighed(cost: Cost) -> f64 {
    f64::from(cost.operations) + READ * f64::from(cost.texture_reads)
}

/// Makes variants and measures them.
pub trait Oracle {
    /// A variant.
    type Variant: Clone;
    /// Why nothing more can be measured.
    type Failure;

    /// The swaps that can be made in a variant, by names under which they are known again, with words for people.
    fn swaps(&mut self, variant: &Self::Variant) -> Vec<(String, String)>;

    /// A variant with a swap made, measured. None where that cannot be.
    fn measure(
        &mut self,
        variant: &Self::Variant,
        swap: &str,
    ) -> Result<Option<(Self::Variant, Figures)>, Self::Failure>;
}

/// How far the search goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest error.
    pub error: f64,
    /// Most variants that are measured.
    pub measured: usize,
}

/// One swap by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Single {
    /// What is swapped, in words.
    pub words: String,
    /// The full material with it.
    pub figures: Figures,
}

/// A variant that was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Point<V> {
    /// The variant.
    pub variant: V,
    /// The swaps that made it, in words, in the order in which they were made.
    pub swaps: Vec<String>,
    /// What was measured.
    pub figures: Figures,
}

/// All that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Searched<V> {
    /// Every swap by itself.
    pub singles: Vec<Single>,
    /// The full material first, then everything that was measured and is within the largest error.
    pub points: Vec<Point<V>>,
    /// Whether the search ended because it had measured as much as it may.
    pub cut: bool,
}

/// What is thought of a swap.
#[derive(Clone, Copy)]
struct Opinion {
    /// Cost saved for each unit of error added; below zero where it is no use.
    worth: f64,
    /// After how many swaps that was found.
    at: usize,
}

/// Searches from the full material on.
pub fn search<O: Oracle>(
    oracle: &mut O,
    full: O::Variant,
    figures: Figures,
    limits: Limits,
) -> Result<Searched<O::Variant>, O::Failure> {
    let mut current = Point { variant: full, swaps: Vec::new(), figures };
    let mut found = Searched { singles: Vec::new(), points: vec![current.clone()], cut: false };
    let mut opinions: BTreeMap<String, Opinion> = BTreeMap::new();
    let mut measured = 0;
    for made in 0.. {
        let open = oracle.swaps(&current.variant);
        let mut ready: BTreeMap<String, Point<O::Variant>> = BTreeMap::new();
        let next = loop {
            // What is not known yet is looked at first. Of equals the first by name is taken, so that runs are alike.
            let worth = |name: &String| opinions.get(name).map_or(f64::INFINITY, |o| o.worth);
            let best = open.iter().reduce(|a, b| if worth(&b.0) > worth(&a.0) { b } else { a });
            let Some((name, words)) = best.filter(|(name, _)| worth(name) > 0.0) else { break None };
            if opinions.get(name).is_some_and(|o| o.at == made) {
                break ready.remove(name);
            }
            if measured >= limits.measured {
                found.cut = true;
                return Ok(found);
            }
            measured += 1;
            let mut worth = -1.0;
            if let Some((variant, figures)) = oracle.measure(&current.variant, name)? {
                let saved = current.figures.cost - figures.cost;
                let added = (figures.error - current.figures.error).max(LEAST_ERROR);
                if made == 0 {
                    found.singles.push(Single { words: words.clone(), figures });
                }
                if figures.error <= limits.error && saved > 0.0 {
                    worth = saved / added;
                    let swaps = current.swaps.iter().chain([words]).cloned().collect();
                    let point = Point { variant, swaps, figures };
                    found.points.push(point.clone());
                    ready.insert(name.clone(), point);
                }
            }
            opinions.insert(name.clone(), Opinion { worth, at: made });
        };
        match next {
            Some(point) => current = point,
            None => break,
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simplify::front::front;

    /// A made-up material: swaps that save and harm by fixed amounts, each usable once, and one that needs another.
    struct Made {
        swaps: Vec<(&'static str, f64, f64)>,
        after: Option<(&'static str, &'static str)>,
        measured: usize,
    }

    impl Oracle for Made {
        type Variant = Vec<String>;
        type Failure = ();

        fn swaps(&mut self, variant: &Self::Variant) -> Vec<(String, String)> {
            let has = |name: &str| variant.iter().any(|v| v == name);
            let open = self.swaps.iter().filter(|(name, ..)| {
                !has(name) && self.after.is_none_or(|(later, earlier)| later != *name || has(earlier))
            });
            open.map(|(name, ..)| ((*name).to_owned(), format!("swap {name}"))).collect()
        }

        fn measure(&mut self, variant: &Self::Variant, swap: &str) -> Result<Option<(Self::Variant, Figures)>, ()> {
            self.measured += 1;
            if swap == "broken" {
                return Ok(None);
            }
            let all: Vec<String> = variant.iter().cloned().chain([swap.to_owned()]).collect();
            let sum = |of: &dyn Fn(&(&str, f64, f64)) -> f64| {
                self.swaps.iter().filter(|s| all.iter().any(|n| n == s.0)).map(of).sum::<f64>()
            };
            let figures = Figures { cost: 100.0 - sum(&|s| s.1), error: sum(&|s| s.2 * s.2).sqrt() };
            Ok(Some((all, figures)))
        }
    }

    fn run(swaps: &[(&'static str, f64, f64)], limits: Limits) -> (Searched<Vec<String>>, usize) {
        let mut oracle = Made { swaps: swaps.to_vec(), after: Some(("late", "a")), measured: 0 };
        let full = Figures { cost: 100.0, error: 0.0 };
        let found = search(&mut oracle, Vec::new(), full, limits).expect("nothing fails");
        (found, oracle.measured)
    }

    const SWAPS: &[(&str, f64, f64)] = &[
        ("a", 20.0, 0.01),
        ("b", 30.0, 0.03),
        ("c", 5.0, 0.2),
        ("far", 40.0, 0.9),
        ("dearer", -3.0, 0.0),
        ("broken", 9.0, 0.0),
        ("late", 10.0, 0.05),
    ];

    #[test]
    fn the_best_comes_first_and_the_front_is_the_known_one() {
        let (found, _) = run(SWAPS, Limits { error: 0.5, measured: 100 });
        let singles: Vec<&str> = found.singles.iter().map(|s| s.words.as_str()).collect();
        assert_eq!(singles, ["swap a", "swap b", "swap c", "swap far", "swap dearer"]);
        let points: Vec<(f64, f64)> = found.points.iter().map(|p| (p.figures.cost, p.figures.error)).collect();
        let path: Vec<Vec<String>> = front(&points).iter().map(|i| found.points[*i].variant.clone()).collect();
        let expected: [&[&str]; 6] = [&[], &["a"], &["b"], &["a", "b"], &["a", "b", "late"], &["a", "b", "late", "c"]];
        assert_eq!(path, expected.map(|names| names.iter().map(|n| (*n).to_owned()).collect::<Vec<_>>()));
        assert!(!found.cut && points.iter().all(|p| p.1 <= 0.5));
    }

    #[test]
    fn it_ends_where_it_is_told_to() {
        let (found, measured) = run(SWAPS, Limits { error: 0.5, measured: 3 });
        assert!(found.cut && measured == 3 && found.points.len() == 4, "{measured}");
        let (found, _) = run(SWAPS, Limits { error: 0.02, measured: 100 });
        assert_eq!(found.points.last().map(|p| p.variant.clone()), Some(vec!["a".to_owned()]));
        let (found, measured) = run(&[], Limits { error: 1.0, measured: 100 });
        assert_eq!((found.points.len(), measured), (1, 0));
    }

    #[test]
    fn what_is_known_is_not_measured_again_for_nothing() {
        let many: Vec<(&'static str, f64, f64)> = ('a'..='t')
            .map(|c| {
                let name: &'static str = Box::leak(format!("{c}x").into_boxed_str());
                (name, 1.0 + f64::from(u32::from(c) % 7), 0.01)
            })
            .collect();
        let (found, measured) = run(&many, Limits { error: 9.0, measured: 1000 });
        assert_eq!(found.points.iter().map(|p| p.variant.len()).max(), Some(20));
        // Measuring all after each step would take 210.
        assert!(measured < 150, "{measured}");
    }
}
