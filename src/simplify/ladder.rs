//! From a material to its ladders: one for each distance, each rung a graph with its figures.

use super::front::{front, thinned};
use super::material::Material;
use super::search::{Limits, Searched, Single, search};
use super::trial::{By, Tools, Trial, Variant, ratios};
use crate::cost::Cost;
use crate::graph::Graph;
use crate::studio::Failure;
use crate::studio::trial::Rounds;
use crate::study::Spread;

/// Variants that are measured for one ladder at most.
const MOST: usize = 250;
/// Rounds in which the rungs are timed in turn.
const ROUNDS: Rounds = Rounds { warm_up: 2, counted: 9 };

/// What is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Columns and rows of the pictures that are compared.
    pub size: (u32, u32),
    /// Metres from the eye to what the scene's camera looks at, one ladder each; none at all for the camera's own.
    pub distances: Vec<f64>,
    /// Largest error; see [`super::trial`].
    pub error: f64,
    /// Most rungs below the full material.
    pub rungs: usize,
    /// What is saved.
    pub by: By,
}

/// One rung.
#[derive(Clone, Debug)]
pub struct Rung {
    /// The graph.
    pub graph: Graph,
    /// What was swapped, in words.
    pub swaps: Vec<String>,
    /// How far it is off.
    pub error: f64,
    /// What its fragment stage costs.
    pub cost: Cost,
    /// Time of a frame beside the full material's, in the same rounds.
    pub time: Option<Spread>,
}

/// The rungs at one distance, the full material first. Errors rise and costs fall along them.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// Metres from the eye.
    pub distance: f64,
    /// Pixels that were compared.
    pub pixels: usize,
    /// Every swap by itself.
    pub singles: Vec<Single>,
    /// The rungs.
    pub rungs: Vec<Rung>,
    /// Whether times are those of the adapter, rather than from the submission to the pixels on the host.
    pub on_adapter: bool,
    /// Whether the search ended before it had tried everything.
    pub cut: bool,
}

/// Makes the ladders, nearest first.
pub fn ladders(material: &Material, wanted: &Wanted, tools: &mut Tools<'_>) -> Result<Vec<Ladder>, Failure> {
    let mut distances: Vec<Option<f64>> = wanted.distances.iter().map(|d| Some(*d)).collect();
    distances.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    distances.dedup();
    if distances.is_empty() {
        distances.push(None);
    }
    distances.into_iter().map(|distance| ladder(material, wanted, distance, tools)).collect()
}

fn ladder(
    material: &Material,
    wanted: &Wanted,
    distance: Option<f64>,
    tools: &mut Tools<'_>,
) -> Result<Ladder, Failure> {
    let mut trial = Trial::new(material, tools, (wanted.size, distance, wanted.by))?;
    let (full, figures) = trial.start();
    let found = search(&mut trial, full, figures, Limits { error: wanted.error, measured: MOST })?;
    let chosen = chosen(&found, wanted.rungs + 1);
    let graphs: Vec<&Graph> = chosen.iter().skip(1).map(|i| &found.points[*i].variant.graph).collect();
    let laps = trial.race(&graphs, ROUNDS)?;
    let (on_adapter, ratios) = ratios(&laps);
    let times = std::iter::once(None).chain(ratios.iter().map(|r| Spread::of(r)));
    let rungs: Vec<Rung> = chosen
        .iter()
        .zip(times)
        .map(|(index, time)| {
            let point = &found.points[*index];
            let (graph, cost) = (point.variant.graph.clone(), point.variant.cost);
            Rung { graph, cost, swaps: last_of_each(&point.swaps), error: point.figures.error, time }
        })
        .collect();
    Ok(Ladder {
        distance: trial.distance(),
        pixels: trial.pixels(),
        singles: found.singles,
        rungs: if wanted.by == By::Time { still_faster(rungs) } else { rungs },
        on_adapter,
        cut: found.cut,
    })
}

/// The points that become rungs: the full material and the front below it.
fn chosen(found: &Searched<Variant>, most: usize) -> Vec<usize> {
    let points: Vec<(f64, f64)> = found.points.iter().map(|p| (p.figures.cost, p.figures.error)).collect();
    let mut all = front(&points);
    // What is free of error and cheaper than the full material stands beside it, not in its place.
    if all.first() != Some(&0) {
        all.insert(0, 0);
    }
    thinned(&points, &all, most)
}

/// The swaps without those that a later one took back: of several choices of one option the last.
fn last_of_each(swaps: &[String]) -> Vec<String> {
    let option = |words: &str| words.split_once(" = ").map(|(option, _)| option.to_owned());
    let later =
        |i: usize| option(&swaps[i]).is_some_and(|o| swaps[i + 1..].iter().any(|s| option(s).as_ref() == Some(&o)));
    (0..swaps.len()).filter(|i| !later(*i)).map(|i| swaps[i].clone()).collect()
}

/// Without the rungs that were not faster than those before them when all were timed together.
fn still_faster(rungs: Vec<Rung>) -> Vec<Rung> {
    let mut fastest = f64::INFINITY;
    let faster = |rung: &Rung| {
        let time = rung.time.map_or(1.0, |t| t.median);
        let stays = time < fastest;
        fastest = fastest.min(time);
        stays
    };
    let mut faster = faster;
    rungs.into_iter().filter(|r| faster(r)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rung(time: Option<f64>) -> Rung {
        let time = time.and_then(|t| Spread::of(&[t]));
        Rung { graph: Graph::default(), swaps: Vec::new(), error: 0.0, cost: Cost::default(), time }
    }

    #[test]
    fn what_was_chosen_last_is_said() {
        let swaps = ["n: octaves = 4", "m: lambert", "n: octaves = 2", "k: octaves = 4"].map(str::to_owned);
        assert_eq!(last_of_each(&swaps), ["m: lambert", "n: octaves = 2", "k: octaves = 4"]);
    }

    #[test]
    fn what_is_not_faster_when_timed_again_goes() {
        let rungs = vec![rung(None), rung(Some(0.8)), rung(Some(0.9)), rung(Some(1.2)), rung(Some(0.5))];
        let left: Vec<Option<f64>> = still_faster(rungs).iter().map(|r| r.time.map(|t| t.median)).collect();
        assert_eq!(left, [None, Some(0.8), Some(0.5)]);
    }
}
