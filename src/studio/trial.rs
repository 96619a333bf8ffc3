//! Shaders timed against each other: each in turn, round after round, so that whatever slows the machine for a while
//! slows all of them.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use super::failure::Failure;
use super::load::Loader;
use super::picture::{Exposure, with_job};
use super::shot::Shot;
use super::stock::{Assets, Stock};
use crate::node::PassKind;
use crate::render::Gpu;

/// One of those that are timed.
pub struct Entrant {
    /// What is drawn.
    pub shot: Shot,
    /// What it needs besides.
    pub assets: Assets,
    /// How.
    pub exposure: Exposure,
}

/// How often each is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rounds {
    /// First, without being counted: pipelines are built, and memory is touched.
    pub warm_up: usize,
    /// Then, counted.
    pub counted: usize,
}

/// What a pass is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Draws casters as the light sees them.
    Light,
    /// Makes a map from a map.
    Filter,
    /// Draws the picture.
    Main,
}

/// One pass, round by round.
#[derive(Clone, Debug, PartialEq)]
pub struct Lap {
    /// Its name: light and pass, or `main`.
    pub name: String,
    /// What it is for.
    pub part: Part,
    /// Milliseconds; none where the adapter cannot tell.
    pub milliseconds: Vec<Option<f64>>,
}

/// What was measured of one entrant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Laps {
    /// Its passes, in the order in which they run.
    pub passes: Vec<Lap>,
    /// From the job to the finished picture, which stays on the device: milliseconds, round by round.
    pub wall: Vec<f64>,
    /// What was done otherwise than asked.
    pub messages: Vec<String>,
}

impl Laps {
    /// Milliseconds of all passes, round by round; none where one is not known.
    pub fn total(&self) -> Option<Vec<f64>> {
        (0..self.wall.len()).map(|round| self.passes.iter().map(|p| *p.milliseconds.get(round)?).sum()).collect()
    }
}

/// Draws all entrants in turn. `each` is told of every frame that is done. Keeps no maps meanwhile, so that everybody pays
/// for their own, and the device keeps none afterwards either.
pub fn race(
    entrants: &[Entrant],
    rounds: Rounds,
    stock: &Stock,
    loader: &Loader,
    gpu: &mut Gpu,
    cancel: &AtomicBool,
    mut each: impl FnMut(),
) -> Result<Vec<Laps>, Failure> {
    gpu.keep_maps(0);
    let mut all: Vec<Laps> = entrants.iter().map(|_| Laps::default()).collect();
    for round in 0..rounds.warm_up + rounds.counted {
        for (entrant, laps) in entrants.iter().zip(&mut all) {
            if cancel.load(Ordering::Relaxed) {
                return Err(Failure::cancelled());
            }
            let Entrant { shot, assets, exposure } = entrant;
            let (frame, wall) = with_job(shot, assets, stock, loader, exposure, |job| {
                let begin = Instant::now();
                (gpu.time(job), begin.elapsed().as_secs_f64() * 1e3)
            });
            let frame = frame?;
            each();
            if round < rounds.warm_up {
                continue;
            }
            if laps.passes.is_empty() {
                let lap = |name: &String| Lap { name: name.clone(), part: part(shot, name), milliseconds: Vec::new() };
                laps.passes = frame.timings.iter().map(|t| lap(&t.name)).collect();
                laps.messages = frame.messages;
            }
            for (lap, timing) in laps.passes.iter_mut().zip(&frame.timings) {
                lap.milliseconds.push(timing.milliseconds);
            }
            laps.wall.push(wall);
        }
    }
    Ok(all)
}

/// What the pass of this name is for, from the plans of the shaders.
fn part(shot: &Shot, name: &str) -> Part {
    if name == "main" {
        return Part::Main;
    }
    let maps = shot.shaders.iter().flat_map(|s| &s.compiled.plan.maps);
    let geometry = maps.flat_map(|m| m.passes.iter().map(|p| (&m.light, p))).any(|(light, pass)| {
        let own = name.strip_prefix(light.as_str()).and_then(|rest| rest.strip_prefix(": "));
        pass.kind == PassKind::Geometry && own.is_some_and(|rest| rest.split(&[' ', ',']).next() == Some(&pass.name))
    });
    if geometry { Part::Light } else { Part::Filter }
}
