//! Measures batches of cells: errors against the truth, then times, all cells of a batch in turn.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::cells::{Batch, Cell, slug};
use super::check::{Stand, check, choices};
use super::document::{Case, Study, Timed};
use super::record::{Errors, Machine, Record, Role, Series, VERSION};
use super::silhouette::regions;
use crate::compile::{Options, Output};
use crate::reference::picture::Watch;
use crate::render::image_file::{Display, ToneCurve, encode_png};
use crate::render::{AdapterSummary, ColorFormat, Gpu, MapSummary, RenderError};
use crate::studio::measure::error_map;
use crate::studio::picture::{Aov, Exposure, draw, with_job};
use crate::studio::settings::{Assignment, Target};
use crate::studio::stock::Stock;
use crate::studio::trial::{Entrant, Lap, Laps, Part, Rounds, race};
use crate::studio::truth::{self, Reference, Wanted};
use crate::studio::weave::Weaver;
use crate::studio::{Collected, Failure, FailureKind, Shot, Shown, Subject};

/// What was measured of one cell.
pub struct Measured {
    /// The figures.
    pub record: Record,
    /// Pictures as PNG by their path below the folder of results.
    pub pictures: Vec<(String, Vec<u8>)>,
}

/// Pictures as PNG by their path below the folder of results.
type Pictures = Vec<(String, Vec<u8>)>;
/// Errors by reference, with pictures of them.
type Judged = (BTreeMap<String, Errors>, Pictures);
/// Pixels of a picture and a note on them.
type Pictured = (Vec<[f32; 4]>, String);

/// Measures cells of one study.
pub struct Runner<'a> {
    study: &'a Study,
    weaver: Weaver<'a>,
    cases: Vec<Stand>,
    stock: Stock,
    /// The truth by case and reference, and by the cell for references that depend on its filter.
    truths: BTreeMap<String, Pictured>,
    depths: BTreeMap<usize, Vec<[f32; 4]>>,
    /// Drawn times of each cell.
    pub rounds: Rounds,
}

impl<'a> Runner<'a> {
    /// Checks that all that the study names is there. `file` is the study's, from which paths of scenes count. Everything
    /// that is wrong is told together.
    pub fn new(study: &'a Study, file: &Path, weaver: Weaver<'a>) -> Result<Self, Failure> {
        let cases = check(study, file, &weaver)?;
        let rounds = Rounds { warm_up: study.warm_up, counted: study.rounds };
        let (truths, depths, stock) = (BTreeMap::new(), BTreeMap::new(), Stock::default());
        Ok(Self { study, weaver, cases, stock, truths, depths, rounds })
    }

    /// What is to be done for a batch, in frames and pixels of truth, for a progress bar.
    pub fn work(&self, batch: &Batch) -> u64 {
        let frames: u64 = batch.cells.iter().map(|c| pixels(c.frame)).sum();
        frames * (self.rounds.warm_up + self.rounds.counted) as u64
    }

    /// Measures a batch. `done` is told of the share of [`Runner::work`] that is done.
    pub fn measure(
        &mut self,
        batch: &Batch,
        gpu: &mut Gpu,
        cancel: &AtomicBool,
        done: &dyn Fn(u64),
    ) -> Result<Vec<Measured>, Failure> {
        let machine = machine(gpu.adapter());
        let mut all = Vec::new();
        let mut entrants = Vec::new();
        // Where each entrant belongs.
        let mut places = Vec::new();
        let mut by_errors: BTreeMap<String, Judged> = BTreeMap::new();
        for (index, cell) in batch.cells.iter().enumerate() {
            let mut record = self.blank(cell, &machine);
            let mut pictures = Vec::new();
            match self.prepare(cell, gpu, &mut record) {
                Ok(entrant) => {
                    let key = cell.without_frame();
                    if !by_errors.contains_key(&key) {
                        let found = self.errors(cell, &entrant, gpu, cancel)?;
                        by_errors.insert(key.clone(), found);
                    }
                    if let Some((errors, drawn)) = by_errors.get_mut(&key) {
                        record.errors = errors.clone();
                        if !record.errors.is_empty() {
                            record.pictures = Some(format!("pictures/{key}"));
                            record.truth_pictures = Some(truth_path(&self.study.cases[cell.case]));
                        }
                        pictures = std::mem::take(drawn);
                    }
                    entrants.push(entrant);
                    places.push(index);
                }
                Err(failure) if failure.kind == FailureKind::NoAdapter => return Err(failure),
                Err(failure) => record.failure = Some(in_words(&failure)),
            }
            all.push(Measured { record, pictures });
        }
        let mut turn = 0;
        let laps = race(&entrants, self.rounds, &self.stock, self.weaver.loader, gpu, cancel, || {
            done(pixels(batch.cells[places[turn % places.len()]].frame));
            turn += 1;
        })?;
        let mut totals: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
        for (place, laps) in places.iter().zip(laps) {
            totals.extend(laps.total().map(|t| (*place, t)));
            fill(&mut all[*place].record, laps);
        }
        for (index, plain) in batch.plain.iter().enumerate() {
            all[index].record.plain = totals.get(plain).cloned().unwrap_or_default();
        }
        Ok(all)
    }

    fn blank(&self, cell: &Cell, machine: &Machine) -> Record {
        let (case, method) = (&self.study.cases[cell.case], &self.study.methods[cell.method]);
        let versions = [("shadetree", env!("CARGO_PKG_VERSION")), ("wgpu", "30"), ("naga", "30")];
        Record {
            version: VERSION,
            study: self.study.title.clone(),
            cell: cell.name.clone(),
            case: case.name.clone(),
            class: case.class.clone(),
            scene: case.scene.clone(),
            light: case.light.clone(),
            method: method.name.clone(),
            shadow: method.shadow.clone(),
            settings: cell.settings.clone(),
            varied: cell.varied.clone(),
            baseline: cell.baseline,
            frame: cell.frame,
            triangles: self.cases[cell.case].triangles,
            machine: machine.clone(),
            versions: versions.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect(),
            ..Record::default()
        }
    }

    /// What is set for a cell.
    fn assignments(&self, cell: &Cell) -> Vec<Assignment> {
        let (case, method) = (&self.study.cases[cell.case], &self.study.methods[cell.method]);
        let place = &self.cases[cell.case];
        let graph = place.shadow.split_once('/').map_or("", |(graph, _)| graph);
        let one = |node: String, name: &str, value: &str, target| Assignment {
            node,
            name: name.to_owned(),
            value: value.to_owned(),
            target,
        };
        let mut all = vec![one(place.shadow.clone(), "kind", &method.shadow, Target::Fresh)];
        let target = |kind: &str, name: &str| {
            if choices(self.weaver.catalog, kind, name).is_some() { Target::Option } else { Target::Port }
        };
        for (path, value) in &case.set {
            let (node, name) = path.rsplit_once('.').unwrap_or((place.light.as_str(), path));
            all.push(one(format!("{graph}/{node}"), name, value, Target::Port));
        }
        for (name, value) in &cell.settings {
            all.push(match name.strip_prefix("light.") {
                Some(name) => one(place.light.clone(), name, value, target(&place.light_kind, name)),
                None => one(place.shadow.clone(), name, value, target(&method.shadow, name)),
            });
        }
        all
    }

    fn shot(&self, cell: &Cell, output: Output) -> Result<Shot, Failure> {
        let set = self.assignments(cell);
        let options = Options { output, ..Options::default() };
        let weaver = Weaver { options, set: &set, ..self.weaver };
        let place = &self.cases[cell.case];
        Shot::new(&Subject { files: &place.files, scene: None, shape: &Shown::Sphere }, &weaver)
    }

    /// The shaders of a cell, and what its map is.
    fn prepare(&mut self, cell: &Cell, gpu: &Gpu, record: &mut Record) -> Result<Entrant, Failure> {
        let case = &self.study.cases[cell.case];
        let output = match self.study.shown {
            Timed::Radiance => Output::Radiance,
            Timed::Visibility => Output::Visibility(case.light.clone()),
        };
        let shot = self.shot(cell, output.clone())?;
        let assets = self.stock.assets(&shot, self.weaver.loader)?;
        let exposure = Exposure {
            aov: Aov::Output(output),
            camera: None,
            size: cell.frame,
            samples: 1,
            time: 0.0,
            format: ColorFormat::Half,
        };
        let maps = with_job(&shot, &assets, &self.stock, self.weaver.loader, &exposure, |job| gpu.maps_of(job))?;
        let own = |m: &&MapSummary| m.light.split('/').next() == Some(&case.light) || m.light == case.light;
        if let Some(map) = maps.iter().find(own) {
            (record.side, record.bits, record.format) = (Some(map.side), Some(map.bits), Some(map.format.to_owned()));
        }
        Ok(Entrant { shot, assets, exposure })
    }

    /// Errors of a cell against each reference, and its pictures.
    fn errors(
        &mut self,
        cell: &Cell,
        entrant: &Entrant,
        gpu: &mut Gpu,
        cancel: &AtomicBool,
    ) -> Result<Judged, Failure> {
        let (mut all, mut pictures) = (BTreeMap::new(), Vec::new());
        let size = self.study.truth.size;
        let visibility = Output::Visibility(self.study.cases[cell.case].light.clone());
        if self.study.truth.references.is_empty() {
            return Ok((all, pictures));
        }
        // What is timed may be what is looked at.
        let seen = match self.study.shown {
            Timed::Visibility => self.drawn(&entrant.shot, visibility, gpu)?,
            Timed::Radiance => self.picture(cell, visibility, gpu)?,
        };
        if !self.depths.contains_key(&cell.case) {
            let depth = self.picture(cell, Output::Depth, gpu)?;
            self.depths.insert(cell.case, depth);
        }
        let case = &self.study.cases[cell.case];
        let stem = format!("pictures/{}", cell.without_frame());
        for (index, name) in self.study.truth.references.iter().enumerate() {
            let (reference, key) = match name.as_str() {
                "pcf" => (Reference::Pcf, format!("{name} {}", cell.without_frame())),
                _ => (Reference::Rays, format!("{name} {}", case.name)),
            };
            if !self.truths.contains_key(&key) {
                let found = match self.truth(cell, reference, cancel) {
                    Err(failure) if failure.kind == FailureKind::Cancelled => return Err(failure),
                    // Not every shadow has a filter that could be judged.
                    Err(_) => (Vec::new(), String::new()),
                    Ok(found) => found,
                };
                if reference == Reference::Rays {
                    pictures.push((format!("{}.{name}.png", truth_path(case)), png(size, &found.0)?));
                }
                self.truths.insert(key.clone(), found);
            }
            let (truth, note) = &self.truths[&key];
            if truth.is_empty() {
                continue;
            }
            let regions = regions(&seen, truth, &self.depths[&cell.case], size.0 as usize);
            all.insert(name.clone(), Errors { size, note: note.clone(), regions });
            if index == 0 {
                pictures.push((format!("{stem}.visibility.png"), png(size, &seen)?));
                pictures.push((format!("{stem}.error.png"), colors(size, &error_map(&seen, truth))?));
            }
        }
        // Truths of one cell only would pile up.
        self.truths.retain(|key, _| !key.starts_with("pcf "));
        Ok((all, pictures))
    }

    fn picture(&mut self, cell: &Cell, output: Output, gpu: &mut Gpu) -> Result<Vec<[f32; 4]>, Failure> {
        let shot = self.shot(cell, output.clone())?;
        self.drawn(&shot, output, gpu)
    }

    fn drawn(&mut self, shot: &Shot, output: Output, gpu: &mut Gpu) -> Result<Vec<[f32; 4]>, Failure> {
        let assets = self.stock.assets(shot, self.weaver.loader)?;
        let size = self.study.truth.size;
        let aov = Aov::Output(output);
        let exposure = Exposure { aov, camera: None, size, samples: 1, time: 0.0, format: ColorFormat::Float };
        Ok(draw(shot, &assets, &self.stock, self.weaver.loader, &exposure, gpu)?.pixels)
    }

    fn truth(&self, cell: &Cell, reference: Reference, cancel: &AtomicBool) -> Result<Pictured, Failure> {
        let set = self.assignments(cell);
        let output = Output::Visibility(self.study.cases[cell.case].light.clone());
        let quiet = Collected::default();
        let weaver =
            Weaver { options: Options { output, ..Options::default() }, set: &set, listener: &quiet, ..self.weaver };
        let files = &self.cases[cell.case].files;
        let subject = Subject { files, scene: None, shape: &Shown::Sphere };
        let samples = self.study.truth.samples.filter(|_| reference == Reference::Rays);
        let wanted = Wanted { reference, camera: None, size: self.study.truth.size, samples, kernel: None };
        let found = truth::find(&subject, &wanted, &weaver, Watch { cancel, done: &|_| {} }, &|_| {})?;
        Ok((found.pixels, found.note))
    }
}

fn pixels(frame: (u32, u32)) -> u64 {
    u64::from(frame.0) * u64::from(frame.1)
}

fn truth_path(case: &Case) -> String {
    format!("pictures/{}", slug(&case.name))
}

fn machine(adapter: &AdapterSummary) -> Machine {
    Machine {
        adapter: adapter.name.clone(),
        driver: adapter.driver.clone(),
        backend: adapter.backend.clone(),
        software: adapter.software,
    }
}

/// Puts times into a record.
fn fill(record: &mut Record, laps: Laps) {
    record.messages = laps.messages;
    record.wall = laps.wall;
    let series = |lap: Lap| Series {
        role: match lap.part {
            Part::Light => Role::Light,
            Part::Filter => Role::Filter,
            Part::Main => Role::Main,
        },
        // A pass that could not be timed once says nothing.
        milliseconds: lap.milliseconds.into_iter().collect::<Option<Vec<f64>>>().unwrap_or_default(),
        name: lap.name,
    };
    record.passes = laps.passes.into_iter().map(series).collect();
}

fn in_words(failure: &Failure) -> String {
    let messages: Vec<&str> = failure.diagnostics.iter().map(|d| d.message.as_str()).collect();
    if messages.is_empty() { "its graph cannot be woven".to_owned() } else { messages.join("; ") }
}

fn png(size: (u32, u32), pixels: &[[f32; 4]]) -> Result<Vec<u8>, Failure> {
    let display = Display { tone: ToneCurve::None, ..Display::default() };
    encode_png(size, pixels, &display, &[]).map_err(|e| unwritable(&e.to_string()))
}

fn colors(size: (u32, u32), pixels: &[[u8; 4]]) -> Result<Vec<u8>, Failure> {
    let bytes: Vec<u8> = pixels.iter().flatten().copied().collect();
    let image = image::RgbaImage::from_raw(size.0, size.1, bytes).ok_or_else(|| unwritable("its size is wrong"))?;
    let mut out = std::io::Cursor::new(Vec::new());
    image.write_to(&mut out, image::ImageFormat::Png).map_err(|e| unwritable(&e.to_string()))?;
    Ok(out.into_inner())
}

fn unwritable(why: &str) -> Failure {
    RenderError::Job(format!("a picture could not be encoded: {why}")).into()
}
