//! Chooses shadows for scenes drawn at random, verifies each choice, and measures the other candidates for it, in turn:
//! does the bound hold, and is the choice among the cheapest that hold it?
//!
//! `cargo run --release --example choose_random -- --scenes 200 --seed 1`. Prints a line a scene, then the misses. With
//! `--error E` all scenes ask for that error; with `--write FOLDER` it writes the scenes there and does no more. What it
//! came to is in `choose_random.md`.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "what it finds is what it is for")]

use std::sync::atomic::AtomicBool;

use shadetree::choose::{Metric, Priced, Wish};
use shadetree::compile::Output;
use shadetree::node::Catalog;
use shadetree::reference::picture::Watch;
use shadetree::render::{AdapterChoice, AdapterOptions, Gpu};
use shadetree::studio::choice::{
    Choice, Stand, Trier, calibrate, candidate, chosen, read_table, verified, write_table,
};
use shadetree::studio::trial::Rounds;
use shadetree::studio::weave::{Known, Weaver};
use shadetree::studio::{Collected, Failure, Loader};

#[path = "random_scenes.rs"]
mod random_scenes;

const SIZE: (u32, u32) = (160, 120);
/// Errors that are asked for, one after the other.
const ERRORS: [f64; 4] = [0.08, 0.05, 0.035, 0.025];
const ROUNDS: Rounds = Rounds { warm_up: 1, counted: 5 };
/// Most candidates that are measured for a scene.
const MEASURED: usize = 14;
/// What a choice may cost, in parts of the cheapest.
const TOLERANCE: f64 = 1.25;

fn main() {
    let (mut scenes, mut seed, mut first, mut cache, mut folder) = (200, 1, 0, None, None);
    let mut errors = ERRORS.to_vec();
    let mut arguments = std::env::args().skip(1);
    while let Some(name) = arguments.next() {
        let value = arguments.next().unwrap_or_default();
        match name.as_str() {
            "--scenes" => scenes = value.parse().unwrap_or(scenes),
            "--seed" => seed = value.parse().unwrap_or(seed),
            "--first" => first = value.parse().unwrap_or(first),
            "--costs" => cache = Some(std::path::PathBuf::from(value)),
            "--error" => errors = value.parse().map_or(errors, |error| vec![error]),
            "--write" => folder = Some(std::path::PathBuf::from(value)),
            _ => {
                eprintln!(
                    "unknown argument `{name}`: --scenes N --seed N --first N --error E --costs FILE --write FOLDER"
                );
                std::process::exit(2);
            }
        }
    }
    if let Some(folder) = folder {
        if let Err(error) = written(scenes, seed, first, &folder) {
            eprintln!("{}: {error}", folder.display());
            std::process::exit(3);
        }
        return;
    }
    if let Err(failure) = run(scenes, seed, first, &errors, cache.as_deref()) {
        failure.diagnostics.iter().for_each(|d| eprintln!("{}", shadetree::report::text(d, false)));
        std::process::exit(1);
    }
}

/// Writes the scenes instead, each into a folder of its number, so that one can be looked at alone.
fn written(scenes: u64, seed: u64, first: u64, folder: &std::path::Path) -> std::io::Result<()> {
    for number in first..first + scenes {
        let folder = folder.join(number.to_string());
        std::fs::create_dir_all(&folder)?;
        for (path, text) in random_scenes::drawn(seed, number).texts {
            std::fs::write(folder.join(path.file_name().unwrap_or_default()), &*text)?;
        }
    }
    Ok(())
}

/// What became of one scene.
struct Row {
    number: u64,
    what: String,
    asked: f64,
    /// Chosen before anything was rendered; and the error that it has.
    open: Option<f64>,
    predicted: f64,
    /// Whether the choice holds the bound once it is verified.
    holds: bool,
    /// Whether anything that was measured holds it.
    possible: bool,
    /// Time of the choice over that of the cheapest that holds the bound, with their names.
    ratio: Option<(f64, String, String)>,
}

fn run(scenes: u64, seed: u64, first: u64, errors: &[f64], cache: Option<&std::path::Path>) -> Result<(), Failure> {
    let options = AdapterOptions::from(AdapterChoice::default());
    let mut gpu = Gpu::new(&options)?;
    gpu.keep_maps(0);
    let catalog = Catalog::embedded();
    let cancel = AtomicBool::new(false);
    let device = format!("{} ({})", gpu.adapter().name, gpu.adapter().driver);
    let begin = std::time::Instant::now();
    let known = cache.and_then(|path| read_table(path, Some(&device)));
    let table = match known {
        Some(table) => table,
        None => calibrate(&device, &catalog, &Collected::default(), &mut gpu, &cancel, || {})?,
    };
    if let Some(path) = cache {
        write_table(path, &table).map_err(|e| Failure::usage(e.to_string(), ""))?;
    }
    println!("{device}; constants after {:.1} s", begin.elapsed().as_secs_f64());
    let mut rows = Vec::new();
    let mut unshadowed = (0, 0);
    for number in first..first + scenes {
        let drawn = random_scenes::drawn(seed, number);
        let loader = Loader::with_overlay(drawn.texts.clone());
        let (told, known) = (Collected::default(), Known::default());
        let stand = Stand::read(&drawn.scene, None, &Weaver::new(&told, &loader, &catalog, &known))?;
        let lamp = &stand.lamps[0];
        let wish = Wish { max_error: errors[number as usize % errors.len()], metric: Metric::Rms, budget: None };
        let (choice, all) = chosen(&stand, lamp, &table, &wish, SIZE, &catalog)?;
        let trier = Trier::new(&stand, &catalog, &told, &drawn.texts, &[], SIZE);
        if !drawn.casts {
            // With a shadow on it, nothing changes either: the two pictures are one.
            let pictures = [None, Some(0)].map(|with: Option<usize>| {
                let demand = shadetree::studio::choice::demand(lamp, &choice.facts);
                let some = with.map(|i| shadetree::choose::candidates(&demand)[i].clone());
                trier.picture(lamp, some.as_ref(), &Output::Radiance, &mut gpu).map(|f| f.pixels)
            });
            let [without, with] = pictures;
            unshadowed.1 += 1;
            unshadowed.0 += usize::from(candidate(&choice.verdict).is_none() && without? == with?);
            continue;
        }
        let row = measured(&trier, lamp, (choice, all), &wish, (number, drawn.what), &mut gpu, &cancel)?;
        let ratio = row.ratio.as_ref().map_or(String::new(), |(r, mine, best)| format!("{r:.2}x  {mine}  |  {best}"));
        println!(
            "{:3} {:38} asked {:.3} predicted {:.4} found {:.4} {} {ratio}",
            row.number,
            row.what,
            row.asked,
            row.predicted,
            row.open.unwrap_or(f64::NAN),
            if row.holds { "holds" } else { "MISS" },
        );
        rows.push(row);
    }
    summary(&rows, unshadowed, begin.elapsed().as_secs_f64());
    Ok(())
}

/// Verifies a choice and measures what else could be.
fn measured(
    trier: &Trier<'_>,
    lamp: &shadetree::studio::choice::Lamp,
    (choice, all): (Choice, Vec<Priced>),
    wish: &Wish,
    (number, what): (u64, String),
    gpu: &mut Gpu,
    cancel: &AtomicBool,
) -> Result<Row, Failure> {
    let predicted = candidate(&choice.verdict).map_or(0.0, |p| p.outlook.error);
    let choice = verified(choice, &all, lamp, trier, wish, gpu)?;
    let picked = candidate(&choice.verdict).cloned();
    let met = matches!(choice.verdict, shadetree::choose::Verdict::Met(_));
    let open = choice.verified.first().map(|(_, m)| m.rms).filter(|_| choice.verified.len() == 1);
    let open = open.or_else(|| choice.verified.first().map(|(_, m)| m.rms));
    let mut row = Row { number, what, asked: wish.max_error, open, predicted, holds: met, possible: met, ratio: None };
    let Some(picked) = picked else { return Ok(row) };
    let mut pool = pool(&all, &picked, wish);
    let (truth, _) = trier.truth(lamp, 128, Watch { cancel, done: &|_| {} })?;
    let mut errors = Vec::new();
    for priced in &pool {
        errors.push(trier.tried(lamp, Some(&priced.outlook.candidate), &truth, gpu)?.metrics.rms);
    }
    // The choice itself comes first, whatever its error; of the others those that hold the bound are timed.
    let mut keep = errors.iter().enumerate().map(|(i, e)| i == 0 || *e <= wish.max_error);
    pool.retain(|_| keep.next().unwrap_or_default());
    row.possible |= pool.len() > 1;
    let candidates: Vec<_> = pool.iter().map(|p| p.outlook.candidate.clone()).collect();
    let laps = trier.raced(lamp, &candidates, ROUNDS, gpu, cancel, || {})?;
    let times: Vec<f64> = laps
        .iter()
        .map(|l| {
            let mut all = l.total().unwrap_or_else(|| l.wall.clone());
            all.sort_by(f64::total_cmp);
            all[all.len() / 2]
        })
        .collect();
    let best = (0..times.len()).min_by(|a, b| times[*a].total_cmp(&times[*b])).unwrap_or_default();
    if met {
        let name =
            |i: usize| format!("{} {:.2} ms (priced {:.2})", candidates[i].name(), times[i], pool[i].milliseconds);
        row.ratio = Some((times[0] / times[best], name(0), name(best)));
    }
    Ok(row)
}

/// The choice, and the cheapest by price of each kind that may hold the bound, then the second of each, and so on.
fn pool(all: &[Priced], picked: &Priced, wish: &Wish) -> Vec<Priced> {
    let mut list: Vec<&Priced> = all
        .iter()
        .filter(|p| p.outlook.error <= wish.max_error * 1.1 && p.milliseconds <= picked.milliseconds * 1.8)
        .filter(|p| p.outlook.candidate != picked.outlook.candidate)
        .collect();
    list.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
    let rank = |p: &Priced| {
        let kind = p.outlook.candidate.kind;
        list.iter()
            .take_while(|q| q.outlook.candidate != p.outlook.candidate)
            .filter(|q| q.outlook.candidate.kind == kind)
            .count()
    };
    let mut ranked: Vec<(usize, &Priced)> = list.iter().map(|p| (rank(p), *p)).collect();
    ranked.sort_by_key(|(rank, _)| *rank);
    std::iter::once(picked).chain(ranked.into_iter().map(|(_, p)| p)).take(MEASURED).cloned().collect()
}

fn summary(rows: &[Row], unshadowed: (usize, usize), seconds: f64) {
    let share = |n: usize, of: usize| 100.0 * n as f64 / of.max(1) as f64;
    let possible: Vec<&Row> = rows.iter().filter(|r| r.possible).collect();
    let first = possible.iter().filter(|r| r.open.is_some_and(|e| e <= r.asked)).count();
    let held = possible.iter().filter(|r| r.holds).count();
    println!("\n{} scenes in {seconds:.0} s", rows.len() + unshadowed.1);
    println!("nothing casts: {} of {} without shadow code, pictures bit by bit the same", unshadowed.0, unshadowed.1);
    println!("no candidate holds what is asked for: {}", rows.len() - possible.len());
    println!("bound held by the first choice: {first} of {} ({:.1}%)", possible.len(), share(first, possible.len()));
    println!("bound held once verified: {held} of {} ({:.1}%)", possible.len(), share(held, possible.len()));
    let timed: Vec<&Row> = rows.iter().filter(|r| r.ratio.is_some()).collect();
    let cheap = timed.iter().filter(|r| r.ratio.as_ref().is_some_and(|(x, ..)| *x <= TOLERANCE)).count();
    println!("within {TOLERANCE} of the cheapest: {cheap} of {} ({:.1}%)", timed.len(), share(cheap, timed.len()));
    println!("\nmisses:");
    for row in rows {
        if row.possible && row.open.is_none_or(|e| e > row.asked) {
            let found = row.open.unwrap_or(f64::NAN);
            println!(
                "{:3} error: {} asked {:.3}, predicted {:.4}, found {found:.4}",
                row.number, row.what, row.asked, row.predicted
            );
        }
        if let Some((ratio, mine, best)) = row.ratio.as_ref().filter(|r| r.0 > TOLERANCE) {
            println!("{:3} time: {ratio:.2}x, {mine} where {best} would do", row.number);
        }
    }
}
