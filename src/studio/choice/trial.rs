//! Candidates on a device: pictures of visibility against the truth, and times against each other.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::graphs::{rewritten, settings_for};
use super::stand::{Lamp, Stand};
use crate::choose::Candidate;
use crate::compile::{Options, Output};
use crate::graph;
use crate::node::Catalog;
use crate::reference::Metrics;
use crate::reference::picture::Watch;
use crate::render::{ColorFormat, Frame, Gpu};
use crate::scene::{self, FileReference};
use crate::studio::failure::{Failure, Listener};
use crate::studio::load::{Loader, absolute};
use crate::studio::measure::compare;
use crate::studio::picture::{Aov, Exposure, draw};
use crate::studio::settings::Assignment;
use crate::studio::shot::{Shot, Subject};
use crate::studio::stage::Shown;
use crate::studio::stock::Stock;
use crate::studio::trial::{Entrant, Laps, Rounds, race};
use crate::studio::truth::{self, Reference, Wanted};
use crate::studio::weave::{Known, Weaver};

/// What a device made of one candidate.
#[derive(Clone, Debug)]
pub struct Tried {
    /// Errors of visibility.
    pub metrics: Metrics,
    /// Visibility, as it was drawn.
    pub frame: Frame,
}

/// Tries candidates on the lights of a scene.
pub struct Trier<'a> {
    /// The scene.
    pub stand: &'a Stand,
    /// All nodes.
    pub catalog: &'a Catalog,
    /// Told what is found.
    pub listener: &'a dyn Listener,
    /// Texts that stand in place of files, by their paths: those that the scene itself was read from.
    pub texts: &'a BTreeMap<PathBuf, Arc<str>>,
    /// Values that were set besides. Those of shadows are left out.
    pub set: &'a [Assignment],
    /// Columns and rows.
    pub size: (u32, u32),
    known: Known,
    stock: std::cell::RefCell<Stock>,
}

impl<'a> Trier<'a> {
    /// Nothing is tried yet.
    pub fn new(
        stand: &'a Stand,
        catalog: &'a Catalog,
        listener: &'a dyn Listener,
        texts: &'a BTreeMap<PathBuf, Arc<str>>,
        set: &'a [Assignment],
        size: (u32, u32),
    ) -> Self {
        Self { stand, catalog, listener, texts, set, size, known: Known::default(), stock: Stock::default().into() }
    }

    /// The scene with a candidate on one light (or no shadow), as texts beside the files that they are made from, and the
    /// scene's path among them.
    fn written(&self, lamp: &Lamp, chosen: Option<&Candidate>) -> (PathBuf, BTreeMap<PathBuf, Arc<str>>) {
        let made = rewritten(&lamp.graph, &lamp.node, self.catalog, chosen);
        let mut scene = self.stand.scene.clone();
        let mut texts = self.texts.clone();
        for light in scene.lights.iter_mut().filter(|l| l.name == lamp.name) {
            light.set = settings_for(&light.set, &made, self.catalog);
            let beside = |path: &str| path.rfind('/').map_or("", |end| &path[..=end]).to_owned();
            light.graph = FileReference::new(format!("{}.chosen light.ron", beside(&light.graph.path)));
        }
        texts.insert(absolute(&lamp.file.with_file_name(".chosen light.ron")), graph::write(&made).into());
        let file = absolute(&self.stand.file.with_file_name(".chosen scene.ron"));
        texts.insert(file.clone(), scene::write(&scene).into());
        (file, texts)
    }

    /// What is drawn of a candidate. Assignments to its shadow are left out.
    fn shot(&self, lamp: &Lamp, chosen: Option<&Candidate>, output: Output) -> Result<(Shot, Loader), Failure> {
        let (file, texts) = self.written(lamp, chosen);
        let loader = Loader::with_overlay(texts);
        let is_left = |a: &&Assignment| {
            let node = a.node.rsplit_once('/').map_or(a.node.as_str(), |(_, node)| node);
            node == lamp.node || !lamp.graph.nodes.contains_key(node)
        };
        let set: Vec<Assignment> = self.set.iter().filter(is_left).cloned().collect();
        let options = Options { output, ..Options::default() };
        let quiet = crate::studio::Collected::default();
        let weaver = Weaver { options, set: &set, ..Weaver::new(&quiet, &loader, self.catalog, &self.known) };
        let files = [file];
        let shot = Shot::new(&Subject { files: &files, scene: None, shape: &Shown::Sphere }, &weaver);
        if shot.is_err() {
            self.listener.found(&quiet.take());
        }
        shot.map(|shot| (shot, loader))
    }

    fn exposure(&self, output: Output) -> Exposure {
        Exposure {
            aov: Aov::Output(output),
            camera: None,
            size: self.size,
            samples: 1,
            time: 0.0,
            format: ColorFormat::Float,
        }
    }

    /// The picture of a candidate: of a light's visibility, or another output.
    pub fn picture(
        &self,
        lamp: &Lamp,
        chosen: Option<&Candidate>,
        output: &Output,
        gpu: &mut Gpu,
    ) -> Result<Frame, Failure> {
        let (shot, loader) = self.shot(lamp, chosen, output.clone())?;
        let mut stock = self.stock.borrow_mut();
        let assets = stock.assets(&shot, &loader)?;
        Ok(draw(&shot, &assets, &stock, &loader, &self.exposure(output.clone()), gpu)?)
    }

    /// The true visibility of a light, and how exact it is in words.
    pub fn truth(&self, lamp: &Lamp, rays: u32, watch: Watch<'_>) -> Result<(Vec<[f32; 4]>, String), Failure> {
        let loader = Loader::with_overlay(self.texts.clone());
        let options = Options { output: Output::Visibility(lamp.name.clone()), ..Options::default() };
        let weaver =
            Weaver { options, set: self.set, ..Weaver::new(self.listener, &loader, self.catalog, &self.known) };
        let files = [self.stand.file.clone()];
        let subject = Subject { files: &files, scene: None, shape: &Shown::Sphere };
        let wanted =
            Wanted { reference: Reference::Rays, camera: None, size: self.size, samples: Some(rays), kernel: None };
        truth::find(&subject, &wanted, &weaver, watch, &|_| {}).map(|t| (t.pixels, t.note))
    }

    /// Draws a candidate and compares it with the truth.
    pub fn tried(
        &self,
        lamp: &Lamp,
        chosen: Option<&Candidate>,
        truth: &[[f32; 4]],
        gpu: &mut Gpu,
    ) -> Result<Tried, Failure> {
        let frame = self.picture(lamp, chosen, &Output::Visibility(lamp.name.clone()), gpu)?;
        Ok(Tried { metrics: compare(&frame.pixels, truth), frame })
    }

    /// Times candidates against each other.
    pub fn raced(
        &self,
        lamp: &Lamp,
        all: &[Candidate],
        rounds: Rounds,
        gpu: &mut Gpu,
        cancel: &AtomicBool,
        each: impl FnMut(),
    ) -> Result<Vec<Laps>, Failure> {
        let output = Output::Visibility(lamp.name.clone());
        let mut entrants = Vec::new();
        let mut stock = self.stock.borrow_mut();
        for candidate in all {
            let (shot, loader) = self.shot(lamp, Some(candidate), output.clone())?;
            let assets = stock.assets(&shot, &loader)?;
            entrants.push(Entrant { shot, assets, exposure: self.exposure(output.clone()) });
        }
        let loader = Loader::with_overlay(self.texts.clone());
        race(&entrants, rounds, &stock, &loader, gpu, cancel, each)
    }
}
