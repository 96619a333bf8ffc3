//! What a variant of a material costs, and how far it is off.
//!
//! Pictures are taken in linear radiance from the same camera with 4 samples a pixel. The error is the root of the mean
//! square difference of radiance, over the three channels and over all pixels that the material covers wholly, divided by
//! the mean radiance of the full material there. It says which share of the light is wrong, whatever the exposure. What is
//! brighter than 99 of 100 values of the full material counts as just that bright, in both pictures and in the mean: the
//! highlight of a polished coat is a thousand times as bright as all else on a few pixels, and would be all that counts. On
//! the stage the material's object is drawn alone.
//!
//! The cost is counted: operations of the fragment stage, its lights included, and [`READ`](super::search::READ) more for each texture read. It
//! is the same on every machine. By time it is the time of a frame beside that of the full material, both in turn.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};

use super::change::{Means, made, wanted_means};
use super::material::{Material, Silent};
use super::search::{Figures, Oracle, weighed};
use super::swap::swaps;
use crate::compile::{Options, Output};
use crate::cost::{Cost, total};
use crate::diagnostic::{Diagnostic, Place};
use crate::graph::Graph;
use crate::node::Catalog;
use crate::render::{ColorFormat, Frame, Gpu};
use crate::scene::Camera;
use crate::studio::load::Loader;
use crate::studio::picture::{Aov, Exposure, draw};
use crate::studio::stage::SHOWN;
use crate::studio::stock::Stock;
use crate::studio::trial::{Entrant, Laps, Rounds, race};
use crate::studio::weave::{Known, Weaver};
use crate::studio::{Failure, Focus, Shot};

/// Rounds of a race of two.
const DUEL: Rounds = Rounds { warm_up: 1, counted: 7 };
/// Coverage of a pixel that counts as whole.
const WHOLE: f32 = 0.999;

/// What is saved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum By {
    /// Operations and texture reads, counted.
    #[default]
    Operations,
    /// Time of a frame, measured.
    Time,
}

/// A form of the material.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The graph.
    pub graph: Graph,
    /// What its fragment stage costs.
    pub cost: Cost,
}

/// What a trial works with.
pub struct Tools<'a> {
    /// Where files come from.
    pub loader: &'a Loader,
    /// The nodes.
    pub catalog: &'a Catalog,
    /// The device.
    pub gpu: &'a mut Gpu,
    /// Set when nobody wants the result any more.
    pub cancel: &'a AtomicBool,
    /// Told of every picture and frame.
    pub each: &'a dyn Fn(),
}

/// The full material at one distance, and all that variants are measured with.
pub struct Trial<'t, 'a> {
    material: &'t Material,
    tools: &'t mut Tools<'a>,
    stock: Stock,
    known: Known,
    by: By,
    size: (u32, u32),
    camera: Camera,
    /// Pixels that the material covers wholly.
    mask: Vec<bool>,
    truth: Vec<[f32; 4]>,
    /// What is brighter counts as this bright.
    white: f32,
    mean: f64,
    full: Cost,
    means: Means,
}

impl<'t, 'a> Trial<'t, 'a> {
    /// Looks at the full material from a distance, in metres from the eye to what the scene's camera looks at; none for
    /// that of the camera.
    pub fn new(
        material: &'t Material,
        tools: &'t mut Tools<'a>,
        (size, distance, by): ((u32, u32), Option<f64>, By),
    ) -> Result<Self, Failure> {
        let mut trial = Self {
            material,
            tools,
            stock: Stock::default(),
            known: Known::default(),
            by,
            size,
            camera: Camera {
                position: glam::Vec3::Z,
                target: glam::Vec3::ZERO,
                up: glam::Vec3::Y,
                fov_y: 1.0,
                near: 0.1,
                far: 100.0,
            },
            mask: Vec::new(),
            truth: Vec::new(),
            white: f32::INFINITY,
            mean: 0.0,
            full: Cost::default(),
            means: Means::new(),
        };
        let graph = &material.graph;
        let (shot, loader) = trial.shot(graph, Output::Radiance, None)?;
        trial.full = cost(&shot);
        let assets = trial.stock.assets(&shot, &loader)?;
        trial.camera = assets.scene.camera.camera();
        if let Some(distance) = distance {
            trial.camera = at(&trial.camera, distance);
        }
        trial.truth = trial.picture(&shot, &loader, 4, Output::Radiance)?.pixels;
        let (depth, loader) = trial.shot(graph, Output::Depth, None)?;
        let covered = trial.picture(&depth, &loader, 4, Output::Depth)?;
        trial.mask = covered.pixels.iter().map(|p| p[3] >= WHOLE).collect();
        trial.white = trial.brightest();
        trial.clip_truth();
        trial.mean = trial.mean_of(&trial.truth).iter().sum::<f64>() / 3.0;
        if !trial.mask.contains(&true) {
            let help = "come nearer with --distance, or take a larger --size";
            return Err(trial.unseen("no pixel shows the material wholly", help));
        }
        if !(trial.mean.is_finite() && trial.mean > 0.0) {
            let help = "give it light: errors are shares of the light that it sends to the eye";
            return Err(trial.unseen("the material is black or not finite here", help));
        }
        trial.find_means()?;
        Ok(trial)
    }

    /// The full material.
    pub fn start(&self) -> (Variant, Figures) {
        let variant = Variant { graph: self.material.graph.clone(), cost: self.full };
        let cost = if self.by == By::Time { 1.0 } else { weighed(self.full) };
        (variant, Figures { cost, error: 0.0 })
    }

    /// From where it is looked at.
    pub fn distance(&self) -> f64 {
        f64::from(self.camera.position.distance(self.camera.target))
    }

    /// Pixels that are compared.
    pub fn pixels(&self) -> usize {
        self.mask.iter().filter(|m| **m).count()
    }

    fn unseen(&self, message: &str, help: &str) -> Failure {
        let place = Place::file(self.material.file().display().to_string());
        vec![Diagnostic::error("ST0751", message, place).help(help)].into()
    }

    /// A graph of the material woven, or one of its nodes, and where its files come from.
    fn shot(&self, graph: &Graph, output: Output, focus: Option<Focus>) -> Result<(Shot, Loader), Failure> {
        if self.tools.cancel.load(Ordering::Relaxed) {
            return Err(Failure::cancelled());
        }
        let loader = self.material.loader(graph, &self.material.files, self.tools.loader)?.with_focus(focus);
        let options = Options { output, ..Options::default() };
        let weaver = Weaver { options, ..Weaver::new(&Silent, &loader, self.tools.catalog, &self.known) };
        let mut shot = Shot::new(&self.material.subject(), &weaver)?;
        if self.material.scene.is_none() {
            // The floor is no part of the material.
            shot.shaders.truncate(1);
            shot.shaders.iter_mut().for_each(|s| s.objects = vec![SHOWN.to_owned()]);
        }
        Ok((shot, loader))
    }

    fn exposure(&self, samples: u32, output: Output) -> Exposure {
        let (camera, size) = (Some(self.camera), self.size);
        Exposure { aov: Aov::Output(output), camera, size, samples, time: 0.0, format: ColorFormat::Float }
    }

    fn picture(&mut self, shot: &Shot, loader: &Loader, samples: u32, output: Output) -> Result<Frame, Failure> {
        let assets = self.stock.assets(shot, loader)?;
        let exposure = self.exposure(samples, output);
        let frame = draw(shot, &assets, &self.stock, loader, &exposure, self.tools.gpu)?;
        (self.tools.each)();
        Ok(frame)
    }

    /// The value that 99 of 100 of the full material do not exceed.
    fn brightest(&self) -> f32 {
        let whole = self.truth.iter().zip(&self.mask).filter(|(_, m)| **m);
        let mut all: Vec<f32> = whole.flat_map(|(p, _)| [p[0], p[1], p[2]]).collect();
        all.sort_by(f32::total_cmp);
        all.get(all.len() * 99 / 100).or(all.last()).copied().unwrap_or(f32::INFINITY)
    }

    fn clip_truth(&mut self) {
        let white = self.white;
        self.truth.iter_mut().for_each(|p| (0..3).for_each(|i| p[i] = p[i].min(white)));
    }

    /// The mean of a picture over the pixels that count.
    fn mean_of(&self, pixels: &[[f32; 4]]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (pixel, _) in pixels.iter().zip(&self.mask).filter(|(_, m)| **m) {
            (0..3).for_each(|i| sum[i] += f64::from(pixel[i]));
        }
        sum.map(|s| s / self.pixels().max(1) as f64)
    }

    /// How far a picture is off.
    fn error(&self, pixels: &[[f32; 4]]) -> f64 {
        let mut sum = 0.0;
        for ((seen, truth), _) in pixels.iter().zip(&self.truth).zip(&self.mask).filter(|(_, m)| **m) {
            let seen = |i: usize| if seen[i].is_nan() { f32::NAN } else { seen[i].min(self.white) };
            sum += (0..3).map(|i| f64::from(seen(i)) - f64::from(truth[i])).map(|d| d * d).sum::<f64>();
        }
        (sum / (3 * self.pixels().max(1)) as f64).sqrt() / self.mean
    }

    /// Looks at every output whose mean is wanted.
    fn find_means(&mut self) -> Result<(), Failure> {
        let graph = &self.material.graph;
        for (node, port) in wanted_means(graph, self.tools.catalog, &swaps(graph, self.tools.catalog)) {
            let focus =
                Focus { graph: self.material.file().to_path_buf(), node: node.clone(), port: Some(port.clone()) };
            // What cannot be shown alone has no mean, and is not swapped for one.
            let (shot, loader) = match self.shot(graph, Output::Radiance, Some(focus)) {
                Ok(shown) => shown,
                Err(failure) if self.tools.cancel.load(Ordering::Relaxed) => return Err(failure),
                Err(_) => continue,
            };
            if shot.is_radiance() {
                continue;
            }
            let pixels = self.picture(&shot, &loader, 4, Output::Radiance)?.pixels;
            let mean = self.mean_of(&pixels);
            if mean.iter().all(|x| x.is_finite()) {
                self.means.insert((node, port), mean);
            }
        }
        Ok(())
    }

    /// Draws variants in turn, after the full material.
    pub fn race(&mut self, graphs: &[&Graph], rounds: Rounds) -> Result<Vec<Laps>, Failure> {
        let mut entrants = Vec::new();
        for graph in std::iter::once(&self.material.graph).chain(graphs.iter().copied()) {
            let (shot, loader) = self.shot(graph, Output::Radiance, None)?;
            let assets = self.stock.assets(&shot, &loader)?;
            entrants.push(Entrant { shot, assets, exposure: self.exposure(4, Output::Radiance) });
        }
        let (each, cancel) = (self.tools.each, self.tools.cancel);
        race(&entrants, rounds, &self.stock, self.tools.loader, self.tools.gpu, cancel, each)
    }
}

impl Oracle for Trial<'_, '_> {
    type Variant = Variant;
    type Failure = Failure;

    fn swaps(&mut self, variant: &Variant) -> Vec<(String, String)> {
        let words = |s: &super::Swap| (s.name(), s.name());
        let all: BTreeMap<String, String> = swaps(&variant.graph, self.tools.catalog).iter().map(words).collect();
        all.into_iter().collect()
    }

    fn measure(&mut self, variant: &Variant, swap: &str) -> Result<Option<(Variant, Figures)>, Failure> {
        let catalog = self.tools.catalog;
        let all = swaps(&variant.graph, catalog);
        let Some(swap) = all.iter().find(|s| s.name() == swap) else { return Ok(None) };
        let Some(graph) = made(&variant.graph, catalog, swap, &self.means) else { return Ok(None) };
        let (shot, loader) = match self.shot(&graph, Output::Radiance, None) {
            Ok(woven) => woven,
            Err(failure) if self.tools.cancel.load(Ordering::Relaxed) => return Err(failure),
            // What cannot be woven is no form of the material.
            Err(_) => return Ok(None),
        };
        let pixels = self.picture(&shot, &loader, 4, Output::Radiance)?.pixels;
        let error = self.error(&pixels);
        if !error.is_finite() {
            return Ok(None);
        }
        let cost = cost(&shot);
        let figure = match self.by {
            By::Operations => weighed(cost),
            By::Time => {
                let laps = self.race(&[&graph], DUEL)?;
                fastest(&laps)
            }
        };
        Ok(Some((Variant { graph, cost }, Figures { cost: figure, error })))
    }
}

/// The same camera at another distance from what it looks at.
fn at(camera: &Camera, distance: f64) -> Camera {
    let away = camera.position - camera.target;
    let far = camera.far.max(2.0 * distance as f32);
    Camera { position: camera.target + away.normalize_or(glam::Vec3::Z) * distance as f32, far, ..*camera }
}

/// What all fragment stages of a shot cost. Its other objects are not there.
fn cost(shot: &Shot) -> Cost {
    shot.shaders.first().map(|s| total(&s.verified)).unwrap_or_default()
}

/// The fastest frame of the second beside the fastest of the first: whatever else the machine does only ever slows one,
/// and a search that followed such a mishap would end there.
fn fastest(laps: &[Laps]) -> f64 {
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    match &times(laps).1[..] {
        [full, other] => least(other) / least(full).max(1e-9),
        _ => f64::NAN,
    }
}

/// Milliseconds of each, round by round, and whether they are times on the adapter: else all are from the submission to the
/// pixels on the host.
fn times(laps: &[Laps]) -> (bool, Vec<Vec<f64>>) {
    let timed: Option<Vec<Vec<f64>>> = laps.iter().map(Laps::total).collect();
    match timed {
        Some(timed) => (true, timed),
        None => (false, laps.iter().map(|l| l.wall.clone()).collect()),
    }
}

/// Times beside those of the first, round by round, of each but the first; and whether they are times on the adapter.
pub fn ratios(laps: &[Laps]) -> (bool, Vec<Vec<f64>>) {
    let (on_adapter, times) = times(laps);
    let Some((full, others)) = times.split_first() else { return (on_adapter, Vec::new()) };
    let beside = |own: &Vec<f64>| own.iter().zip(full).map(|(t, f)| t / f.max(1e-9)).collect();
    (on_adapter, others.iter().map(beside).collect())
}
