//! A device's constants: candidates of every sort are timed on two small scenes that are part of the program.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::stand::Stand;
use super::trial::Trier;
use crate::choose::{
    Candidate, CostTable, Demand, Effort, Filter, Judge, Metric, Share, Storage, Work, candidates, predict, work,
};
use crate::compile::Output;
use crate::node::Catalog;
use crate::reference::picture::Watch;
use crate::render::Gpu;
use crate::studio::failure::{Failure, Listener};
use crate::studio::load::{Loader, absolute};
use crate::studio::trial::{Laps, Part, Rounds};
use crate::studio::weave::{Known, Weaver};

/// The scenes: a spotlight over a few things, and the sun over a long ground, cut into parts.
const SPOT: &str = include_str!("spot.ron");
const SUN: &str = include_str!("sun.ron");
/// The ground of both, up to its size.
const GROUND: &str = "\"ground\": (";
const GROUND_BARE: &str = "\"ground\": (casts: false, ";
/// What is measured: scenes, parts of the view, sides of maps and sizes of pictures, and which candidates. Every kind of work
/// must differ from all others in some of them.
const SETTINGS: &[Setting] = &[
    Setting { scene: SPOT, bare: false, parts: 1, side: 256, size: (320, 180), which: |_| true },
    Setting { scene: SPOT, bare: false, parts: 1, side: 1024, size: (160, 120), which: |_| true },
    Setting { scene: SPOT, bare: false, parts: 1, side: 128, size: (640, 360), which: |_| true },
    Setting { scene: SPOT, bare: true, parts: 1, side: 128, size: (160, 120), which: is_plain },
    Setting { scene: SPOT, bare: true, parts: 1, side: 1024, size: (160, 120), which: is_short },
    Setting { scene: SPOT, bare: true, parts: 1, side: 4096, size: (160, 120), which: is_compared },
    Setting { scene: SPOT, bare: false, parts: 1, side: 4096, size: (160, 120), which: is_compared },
    Setting { scene: SUN, bare: false, parts: 2, side: 256, size: (320, 180), which: is_plain },
    Setting { scene: SUN, bare: true, parts: 2, side: 1024, size: (160, 120), which: is_compared },
];

struct Setting {
    scene: &'static str,
    /// Whether the ground casts no shadow, so that much of a map stays empty.
    bare: bool,
    parts: u32,
    side: u32,
    size: (u32, u32),
    /// Of those that are typical.
    which: fn(&Candidate) -> bool,
}

/// Rounds for each.
const ROUNDS: Rounds = Rounds { warm_up: 0, counted: 5 };
/// Exactness of what is only to tell how long footprints are.
const EFFORT: Effort = Effort { edges: 40, near: 40, others: 60, rays: 16 };

/// How many frames a calibration draws at most: for a bar of progress.
pub const FRAMES: u64 = 720;

/// Measures the constants of a device. `each` is told of every frame.
pub fn calibrate(
    device: &str,
    catalog: &Catalog,
    listener: &dyn Listener,
    gpu: &mut Gpu,
    cancel: &AtomicBool,
    mut each: impl FnMut(),
) -> Result<CostTable, Failure> {
    let mut measured: Vec<(Work, BTreeMap<Share, f64>)> = Vec::new();
    for Setting { scene, bare, parts, side, size, which } in SETTINGS {
        let (side, size) = (*side, *size);
        let scene = if *bare { scene.replace(GROUND, GROUND_BARE) } else { (*scene).to_owned() };
        // Made up, and never written.
        let file = PathBuf::from("shadetree calibration").join("scene.ron");
        let texts: BTreeMap<PathBuf, Arc<str>> = [
            (absolute(&file), Arc::from(scene)),
            (absolute(&file.with_file_name("spot.ron")), Arc::from(include_str!("../../../graphs/lights/spot.ron"))),
            (absolute(&file.with_file_name("sun.ron")), Arc::from(include_str!("../../../graphs/lights/sun.ron"))),
            (
                absolute(&file.with_file_name("matte.ron")),
                Arc::from(include_str!("../../../graphs/surfaces/lambert.ron")),
            ),
        ]
        .into();
        let (loader, known) = (Loader::with_overlay(texts.clone()), Known::default());
        let stand = Stand::read(&file, None, &Weaver::new(listener, &loader, catalog, &known))?;
        let Some(lamp) = stand.lamps.first() else { continue };
        let watch = Watch { cancel, done: &|_| {} };
        let look = stand.look(lamp, size, EFFORT, watch).ok_or_else(Failure::cancelled)?;
        let demand = Demand {
            sides: vec![side],
            parts: vec![*parts],
            penumbra: [8.0 / f64::from(side); 2],
            footprint: 4.0 / f64::from(side),
            soft: true,
        };
        let few: Vec<Candidate> = candidates(&demand).into_iter().filter(|c| is_typical(c) && which(c)).collect();
        let site = stand.site(lamp, size);
        let outlooks = predict(&site, &look.0, few, Metric::Rms, watch).ok_or_else(Failure::cancelled)?;
        let trier = Trier::new(&stand, catalog, listener, &texts, &[], size);
        // What a device cannot draw gets no price, and so is never chosen.
        let output = Output::Visibility(lamp.name.clone());
        let able = |c: &Candidate, gpu: &mut Gpu| trier.picture(lamp, Some(c), &output, gpu).is_ok();
        let outlooks: Vec<_> = outlooks.into_iter().filter(|o| able(&o.candidate, gpu)).collect();
        let all: Vec<Candidate> = outlooks.iter().map(|o| o.candidate.clone()).collect();
        let laps = trier.raced(lamp, &all, ROUNDS, gpu, cancel, &mut each)?;
        let load = stand.load(lamp, &look.0, size);
        for (outlook, laps) in outlooks.iter().zip(laps) {
            measured.push(told(work(&outlook.candidate, outlook.taps, &load), &laps));
        }
    }
    Ok(CostTable::fit(device, &measured))
}

/// One of each sort that the table of costs tells apart, and of those that differ in width, two.
fn is_typical(candidate: &Candidate) -> bool {
    let judged = match candidate.judge {
        Judge::Variance { reduction, .. } => reduction > 0.0,
        Judge::Exponential { exponent } => exponent > 60.0,
        Judge::Comparison | Judge::Warped { .. } | Judge::Moments { .. } => true,
        Judge::Blockers { search, .. } => search != 16,
    };
    let filtered = match candidate.filter {
        Some(Filter::Kernel(width)) if candidate.blur == 0 => [1, 3, 7].contains(&width),
        Some(Filter::Kernel(width)) => [1, 3, 11].contains(&width),
        Some(Filter::Mips(width, _)) => width == 3,
        Some(Filter::Disc(count, _)) => count != 16,
        Some(Filter::Nearest | Filter::Footprint(_)) | None => true,
    };
    judged && filtered
}

/// Those whose maps are made in one pass, of every sort of map.
fn is_short(candidate: &Candidate) -> bool {
    matches!(candidate.filter, Some(Filter::Nearest | Filter::Kernel(1)))
}

/// Those that compare depths, one with few reads and one with many.
fn is_compared(candidate: &Candidate) -> bool {
    candidate.judge == Judge::Comparison && matches!(candidate.filter, Some(Filter::Nearest | Filter::Kernel(3)))
}

/// Those that say what a setting changes for comparisons and for maps of moments.
fn is_plain(candidate: &Candidate) -> bool {
    matches!(candidate.filter, Some(Filter::Nearest | Filter::Kernel(3)))
        && matches!(candidate.judge, Judge::Comparison | Judge::Variance { storage: Storage::Single, .. })
}

/// Work with its times. Where the adapter has no timestamps, all of it stands against the time on the wall.
fn told(work: Work, laps: &Laps) -> (Work, BTreeMap<Share, f64>) {
    if laps.total().is_none() {
        let mut merged = BTreeMap::new();
        work.into_values().flatten().for_each(|(name, amount)| *merged.entry(name).or_default() += amount);
        return (Work::from([(Share::Main, merged)]), BTreeMap::from([(Share::Main, middle(&laps.wall))]));
    }
    let mut times = BTreeMap::new();
    for lap in &laps.passes {
        let share = match lap.part {
            Part::Light => Share::Light,
            Part::Filter => Share::Filter,
            Part::Main => Share::Main,
        };
        let known: Vec<f64> = lap.milliseconds.iter().flatten().copied().collect();
        *times.entry(share).or_insert(0.0) += middle(&known);
    }
    (work, times)
}

/// The median.
pub(super) fn middle(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}
