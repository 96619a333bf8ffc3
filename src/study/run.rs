//! Measures batches of cells: errors against the truth, then times, all cells of a batch in turn.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use super::cells::{Batch, Cell, slug};
use super::document::{Case, Method, Study, Timed};
use super::record::{Errors, Machine, Record, Role, Series, VERSION};
use super::silhouette::regions;
use crate::compile::{Options, Output};
use crate::diagnostic::{Diagnostic, Place};
use crate::node::Catalog;
use crate::reference::picture::Watch;
use crate::render::image_file::{Display, ToneCurve, encode_png};
use crate::render::{AdapterSummary, ColorFormat, Gpu};
use crate::scene::Scene;
use crate::studio::load::relative;
use crate::studio::measure::{error_map, graph_of, shadow_of};
use crate::studio::picture::{Aov, Exposure, draw, with_job};
use crate::studio::settings::{Assignment, Target};
use crate::studio::stock::Stock;
use crate::studio::trial::{Entrant, Laps, Part, Rounds, race};
use crate::studio::truth::{self, Reference, Wanted};
use crate::studio::weave::Weaver;
use crate::studio::{Collected, Failure, Loader, Shot, Shown, Subject};
use crate::weave::is_light;

/// What was measured of one cell, and its pictures as PNG by their path below the folder of results.
pub struct Measured {
    /// The figures.
    pub record: Record,
    /// Pictures.
    pub pictures: Vec<(String, Vec<u8>)>,
}

/// A case with what is found out once.
struct Stand {
    files: Vec<PathBuf>,
    shadow: String,
    light: String,
    light_kind: String,
    triangles: usize,
}

/// Pixels of a picture and a note on them.
type Pictured = (Vec<[f32; 4]>, String);

/// Measures cells of one study.
pub struct Runner<'a> {
    study: &'a Study,
    catalog: &'a Catalog,
    loader: &'a Loader,
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
        let mut found = Vec::new();
        for method in &study.methods {
            check_method(method, study, weaver.catalog, &mut found);
        }
        let mut cases = Vec::new();
        for case in &study.cases {
            match find_case(case, file, &weaver) {
                Ok(case) => cases.push(case),
                Err(failure) => found.extend(failure.diagnostics.into_iter().map(|d| of_case(d, case))),
            }
        }
        if !found.is_empty() {
            return Err(found.into());
        }
        let rounds = Rounds { warm_up: study.warm_up, counted: study.rounds };
        let (catalog, loader) = (weaver.catalog, weaver.loader);
        let (truths, depths, stock) = (BTreeMap::new(), BTreeMap::new(), Stock::default());
        Ok(Self { study, catalog, loader, weaver, cases, stock, truths, depths, rounds })
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
        let mut by_errors: BTreeMap<String, (BTreeMap<String, Errors>, Vec<(String, Vec<u8>)>)> = BTreeMap::new();
        for (index, cell) in batch.cells.iter().enumerate() {
            let mut record = self.blank(cell, &machine);
            let mut pictures = Vec::new();
            match self.prepare(cell, gpu, &mut record) {
                Ok(entrant) => {
                    let key = cell.without_frame();
                    if !by_errors.contains_key(&key) {
                        let found = self.errors(cell, gpu, cancel)?;
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
                Err(failure) if failure.kind == crate::studio::FailureKind::NoAdapter => return Err(failure),
                Err(failure) => record.failure = Some(in_words(&failure)),
            }
            all.push(Measured { record, pictures });
        }
        let mut turn = 0;
        let laps = race(&entrants, self.rounds, &self.stock, self.loader, gpu, cancel, || {
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
            if choices(self.catalog, kind, name).is_some() { Target::Option } else { Target::Port }
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
        let assets = self.stock.assets(&shot, self.loader)?;
        let exposure = Exposure {
            aov: Aov::Output(output),
            camera: None,
            size: cell.frame,
            samples: 1,
            time: 0.0,
            format: ColorFormat::Half,
        };
        let maps = with_job(&shot, &assets, &self.stock, self.loader, &exposure, |job| gpu.maps_of(job))?;
        let own =
            |m: &&crate::render::MapSummary| m.light.split('/').next() == Some(&case.light) || m.light == case.light;
        if let Some(map) = maps.iter().find(own) {
            (record.side, record.bits, record.format) = (Some(map.side), Some(map.bits), Some(map.format.to_owned()));
        }
        Ok(Entrant { shot, assets, exposure })
    }

    /// Errors of a cell against each reference, and its pictures.
    fn errors(
        &mut self,
        cell: &Cell,
        gpu: &mut Gpu,
        cancel: &AtomicBool,
    ) -> Result<(BTreeMap<String, Errors>, Vec<(String, Vec<u8>)>), Failure> {
        let (mut all, mut pictures) = (BTreeMap::new(), Vec::new());
        let size = self.study.truth.size;
        let visibility = Output::Visibility(self.study.cases[cell.case].light.clone());
        if self.study.truth.references.is_empty() {
            return Ok((all, pictures));
        }
        let seen = self.picture(cell, visibility, gpu)?;
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
                    Err(failure) if failure.kind == crate::studio::FailureKind::Cancelled => return Err(failure),
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
        let assets = self.stock.assets(&shot, self.loader)?;
        let size = self.study.truth.size;
        let aov = Aov::Output(output);
        let exposure = Exposure { aov, camera: None, size, samples: 1, time: 0.0, format: ColorFormat::Float };
        Ok(draw(&shot, &assets, &self.stock, self.loader, &exposure, gpu)?.pixels)
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
    let series = |lap: crate::studio::trial::Lap| Series {
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
    vec![Diagnostic::error("ST0514", format!("a picture could not be encoded: {why}"), Place::default())].into()
}

fn of_case(mut diagnostic: Diagnostic, case: &Case) -> Diagnostic {
    diagnostic.message = format!("case `{}`: {}", case.name, diagnostic.message);
    diagnostic
}

fn find_case(case: &Case, file: &Path, weaver: &Weaver<'_>) -> Result<Stand, Failure> {
    let place = case.span.clone().map_or_else(Place::default, Place::span);
    let fail = |message: String, help: &str| {
        Failure::from(vec![Diagnostic::error("ST0611", message, place.clone()).help(help)])
    };
    let files = vec![relative(&case.scene, &file.display().to_string())];
    let subject = Subject { files: &files, scene: None, shape: &Shown::Sphere };
    let shadow = shadow_of(&subject, &case.light, weaver)?;
    let graph = graph_of(&subject, &case.light, weaver)?;
    let is_one = |node: &crate::graph::Node| {
        weaver.catalog.get(&node.kind).and_then(|f| f.definition(&node.options).ok()).is_some_and(|d| is_light(&d))
    };
    let mut lights = graph.graph.nodes.iter().filter(|(_, node)| is_one(node));
    let (light, light_kind) = match (lights.next(), lights.next()) {
        (Some((light, node)), None) => (format!("{}/{light}", graph.name), node.kind.clone()),
        _ => {
            return Err(fail(
                format!("the graph of `{}` has not exactly one light node", case.light),
                "take another light",
            ));
        }
    };
    let scene: Scene = crate::studio::shot::scene_of(&files[0], weaver)?;
    let mut triangles = 0;
    for object in scene.objects.iter().filter(|o| o.casts) {
        triangles += crate::studio::assets::mesh_of(&object.shape, &files[0], weaver.loader)?.indices.len() / 3;
    }
    if triangles == 0 {
        let message = format!("nothing casts a shadow in `{}`", case.scene);
        let diagnostic = Diagnostic::error("ST0612", message, place);
        return Err(vec![diagnostic.help("let an object cast, or take another scene")].into());
    }
    Ok(Stand { files, shadow, light, light_kind, triangles })
}

/// Whether the shadow of a method exists and has what is set on it.
fn check_method(method: &Method, study: &Study, catalog: &Catalog, found: &mut Vec<Diagnostic>) {
    let place = || method.span.clone().map_or_else(Place::default, Place::span);
    if !crate::studio::measure::is_shadow(catalog, &method.shadow) {
        let kinds = crate::studio::measure::shadow_kinds(catalog);
        let message = format!("the method `{}` has the shadow `{}`, which there is not", method.name, method.shadow);
        let help = match crate::diagnostic::did_you_mean(&method.shadow, kinds.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("shadows are {}", kinds.join(", ")),
        };
        found.push(Diagnostic::error("ST0610", message, place()).help(help));
        return;
    }
    let varied = method.vary.iter().map(|(name, values)| (name, values.iter().collect::<Vec<_>>()));
    let fixed = method.set.iter().map(|(name, value)| (name, vec![value]));
    let in_grids = study.grids.iter().filter(|g| g.methods.is_empty() || g.methods.contains(&method.name));
    let in_grids = in_grids.flat_map(|g| &g.vary).map(|(name, values)| (name, values.iter().collect::<Vec<_>>()));
    let in_grids = in_grids.filter(|(name, _)| has_setting(catalog, &method.shadow, name));
    for (name, values) in varied.chain(fixed).chain(in_grids).filter(|(name, _)| !name.starts_with("light.")) {
        if !has_setting(catalog, &method.shadow, name) {
            let message =
                format!("the method `{}` sets `{name}`, which `{}` does not have", method.name, method.shadow);
            let help = format!("see `shadetree nodes {}`", method.shadow);
            found.push(Diagnostic::error("ST0610", message, place()).help(help));
        }
        let Some(choices) = choices(catalog, &method.shadow, name) else { continue };
        for value in values.into_iter().filter(|v| !choices.contains(v)) {
            let message = format!("the method `{}` sets `{name}` to `{value}`", method.name);
            let help = format!("choices are {}", choices.join(", "));
            found.push(Diagnostic::error("ST0610", message, place()).help(help));
        }
    }
}

/// What may be chosen for an option of a kind of node; none if it has no such option.
fn choices(catalog: &Catalog, kind: &str, name: &str) -> Option<Vec<String>> {
    let header = catalog.get(kind)?.header().ok()?;
    header.options.iter().find(|o| o.name == name).map(|o| o.choices.clone())
}

/// Whether nodes of a kind have an option or a port of that name, with whatever options.
pub fn has_setting(catalog: &Catalog, kind: &str, name: &str) -> bool {
    let Some(file) = catalog.get(kind) else { return false };
    let Ok(header) = file.header() else { return false };
    if header.options.iter().any(|o| o.name == name) {
        return true;
    }
    // A port may be there with some choice of one option only.
    let choices =
        header.options.iter().flat_map(|o| o.choices.iter().map(|c| BTreeMap::from([(o.name.clone(), c.clone())])));
    std::iter::once(BTreeMap::new())
        .chain(choices)
        .any(|choices| file.definition(&choices).is_ok_and(|d| d.input(name).is_some_and(|p| !p.hidden)))
}
