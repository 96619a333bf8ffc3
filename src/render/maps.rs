//! Maps of lights: which ones a job needs, and in which formats and sizes their passes write.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use wgpu::TextureFormat;

use super::RenderError;
use super::compute::{ComputePipeline, ComputeSpec};
use super::device::{Device, Texels};
use super::format::{self, Needs};
use super::job::{Draw, Job};
use super::light_space::{self, Bounds, Eye, LightSpace, light_spaces};
use super::pipeline::{Culling, DepthUse, Pipeline, Pipelines, Spec, UNIFORM, texture_type};
use crate::module::{Attribute, Resource};
use crate::plan::{Pass, PassKind};

/// A map that is to be made. Two draws share it when light, space and passes are equal.
pub(super) struct MapPlan<'a> {
    pub(super) light: &'a str,
    /// As planned, but for those that the adapter cannot run and that others take the place of.
    pub(super) passes: Cow<'a, [Pass]>,
    /// As planned.
    planned: &'a [Pass],
    /// One per view, which is one per layer.
    pub(super) views: Vec<LightSpace>,
    filtered: bool,
    /// Texels on a side of what is drawn first.
    size: u32,
    /// One per pass.
    pub(super) steps: Vec<Step>,
}

/// A pass with what it writes.
pub(super) struct Step {
    pub(super) runner: Option<Runner>,
    /// The same for mirrored objects, where sides are told apart.
    pub(super) mirrored: Option<Arc<Pipeline>>,
    pub(super) format: TextureFormat,
    /// Texels on a side.
    pub(super) side: u32,
}

/// What runs a pass.
#[derive(Clone)]
pub(super) enum Runner {
    Draw(Arc<Pipeline>),
    Compute(Arc<ComputePipeline>),
}

/// What the lights of a job need.
#[derive(Default)]
pub(super) struct LightPlans<'a> {
    /// Distinct maps, in the order of draws and their plans.
    pub(super) maps: Vec<MapPlan<'a>>,
    /// Per draw: for each map of its plan, its position in `maps`.
    pub(super) map_of: Vec<Vec<usize>>,
    /// Per draw: the views of the lights that it uses.
    pub(super) spaces: Vec<BTreeMap<&'a str, Vec<LightSpace>>>,
    pub(super) messages: Vec<String>,
}

impl<'a> LightPlans<'a> {
    /// Collects the spaces and maps of a job.
    pub(super) fn gather(device: &Device, job: &'a Job<'_>) -> Result<Self, RenderError> {
        let mut bounds = Bounds::default();
        for draw in &job.draws {
            bounds.add(&draw.mesh.positions, draw.object_to_world);
        }
        let eye = Eye::new(&job.camera, job.size);
        let mut plans = Self::default();
        for draw in &job.draws {
            let spaces = spaces_of(draw, &bounds, &eye)?;
            let mut map_of = Vec::new();
            for map in &draw.shader.plan.maps {
                let views = &spaces[map.light.as_str()];
                let same = |m: &MapPlan<'_>| m.light == map.light && m.views == *views && m.planned == map.passes;
                let index = plans.maps.iter().position(same).unwrap_or(plans.maps.len());
                if index == plans.maps.len() {
                    let passes = runnable(device, &map.light, &map.passes, &mut plans.messages)?;
                    check_passes(&map.light, &passes)?;
                    let size = map.size();
                    device.check_texture(&format!("a map of `{}`", map.light), size, size)?;
                    plans.maps.push(MapPlan {
                        light: &map.light,
                        passes,
                        planned: &map.passes,
                        views: views.clone(),
                        filtered: false,
                        size,
                        steps: Vec::new(),
                    });
                }
                plans.maps[index].filtered |= map.filtered;
                map_of.push(index);
            }
            plans.map_of.push(map_of);
            plans.spaces.push(spaces);
        }
        for map in &mut plans.maps {
            map.choose_formats(device, &mut plans.messages)?;
        }
        Ok(plans)
    }

    /// Makes the pipelines of every pass.
    pub(super) fn build(&mut self, device: &Device, pipelines: &mut Pipelines) -> Result<(), RenderError> {
        for map in &mut self.maps {
            for index in 0..map.passes.len() {
                let what = format!("pass `{}` of light `{}`", map.passes[index].name, map.light);
                let runner = match map.compute_spec(index) {
                    Some(spec) => Runner::Compute(pipelines.compute(device, &what, spec)?),
                    None => {
                        let spec = map.spec(device, index);
                        if spec.culling != Culling::Nothing {
                            let mirrored = Spec { mirrored: !spec.mirrored, ..spec.clone() };
                            map.steps[index].mirrored = Some(pipelines.get(device, &what, mirrored)?);
                        }
                        Runner::Draw(pipelines.get(device, &what, spec)?)
                    }
                };
                map.steps[index].runner = Some(runner);
            }
        }
        Ok(())
    }
}

/// The spaces of the lights that a draw binds or has maps of.
fn spaces_of<'a>(
    draw: &'a Draw<'_>,
    bounds: &Bounds,
    eye: &Eye,
) -> Result<BTreeMap<&'a str, Vec<LightSpace>>, RenderError> {
    let shader = draw.shader;
    let bound = shader.module.bindings.iter().filter_map(|b| match &b.resource {
        Resource::Space { light, .. } => Some(light.as_str()),
        _ => None,
    });
    let mut spaces = BTreeMap::new();
    for name in bound.chain(shader.plan.maps.iter().map(|m| m.light.as_str())) {
        if !spaces.contains_key(name) {
            let light = shader.plan.lights.iter().find(|l| l.name == name);
            let light = light.ok_or_else(|| RenderError::Job(format!("the plan has no light `{name}`")))?;
            let value_of = |p: &crate::module::Parameter| draw.values.get(&p.path).cloned();
            let sides = shader.plan.maps.iter().filter(|m| m.light == name).map(crate::plan::Map::size);
            let around = light_space::Surroundings { bounds, eye, side: sides.min().unwrap_or(0) };
            spaces.insert(name, light_spaces(light, &shader.module, &value_of, around)?);
        }
    }
    Ok(spaces)
}

/// The passes, with others in place of compute passes that the adapter cannot run.
fn runnable<'a>(
    device: &Device,
    light: &str,
    passes: &'a [Pass],
    messages: &mut Vec<String>,
) -> Result<Cow<'a, [Pass]>, RenderError> {
    let stores = |name: &String| format::from_name(name).is_some_and(|f| device.abilities(f).storable);
    let able = |p: &Pass| p.kind != PassKind::Compute || p.targets.iter().any(stores);
    if passes.iter().all(able) {
        return Ok(Cow::Borrowed(passes));
    }
    let mut all = Vec::new();
    for pass in passes {
        match &pass.otherwise {
            _ if able(pass) => all.push(pass.clone()),
            Some(other) => {
                let message = format!(
                    "the pass `{}` of light `{light}` takes the place of `{}`: the adapter has no compute shaders that \
                     store {}",
                    other.name,
                    pass.name,
                    pass.targets.join(", ")
                );
                if !messages.contains(&message) {
                    messages.push(message);
                }
                all.push((**other).clone());
            }
            None => {
                return Err(RenderError::Unsupported(format!(
                    "the adapter cannot run the pass `{}` of light `{light}`: it has no compute shaders that store {}",
                    pass.name,
                    pass.targets.join(", ")
                )));
            }
        }
    }
    Ok(Cow::Owned(all))
}

/// A map is drawn first, then filtered, then reduced.
fn check_passes(light: &str, passes: &[Pass]) -> Result<(), RenderError> {
    let rank = |p: &Pass| match p.kind {
        PassKind::Geometry => 0,
        PassKind::Image | PassKind::Compute => 1,
        PassKind::Mip => 2,
    };
    let drawn = passes.first().is_some_and(|p| p.kind == PassKind::Geometry);
    let once = passes.iter().filter(|p| p.kind == PassKind::Geometry).count() == 1;
    let mips = passes.iter().filter(|p| p.kind == PassKind::Mip).count() <= 1;
    if drawn && once && mips && passes.is_sorted_by_key(rank) {
        Ok(())
    } else {
        Err(RenderError::Job(format!(
            "a map of light `{light}` must be one geometry pass, then image and compute passes, then at most one mip \
             pass"
        )))
    }
}

impl MapPlan<'_> {
    /// Takes for each run of passes that can write the same formats the first one that the adapter can make. A pass that
    /// can write none of those before it begins a new run.
    fn choose_formats(&mut self, device: &Device, messages: &mut Vec<String>) -> Result<(), RenderError> {
        let mut runs: Vec<(Vec<&str>, usize)> = Vec::new();
        for pass in self.passes.iter() {
            let targets: Vec<&str> = pass.targets.iter().map(String::as_str).collect();
            match runs.last_mut() {
                Some((_, passes)) if targets.is_empty() => *passes += 1,
                Some((names, passes)) if names.iter().any(|n| targets.contains(n)) => {
                    names.retain(|n| targets.contains(n));
                    *passes += 1;
                }
                _ => runs.push((targets, 1)),
            }
        }
        let mut side = self.size;
        let mut position = 0;
        for (index, (names, passes)) in runs.iter().enumerate() {
            let run = &self.passes[position..position + passes];
            let needs = Needs {
                filtered: self.filtered && index + 1 == runs.len(),
                stored: run.iter().any(|p| p.kind == PassKind::Compute),
            };
            let format = self.choose_format(device, names, needs, messages)?;
            if format == TextureFormat::Depth32Float && self.passes.len() > 1 {
                return Err(RenderError::Job(format!(
                    "light `{}`: depth targets cannot be filtered by passes",
                    self.light
                )));
            }
            for pass in run {
                side = (side / pass.number("scale").unwrap_or(1).max(1)).max(1);
                let before = self.steps.last().map(|s: &Step| (format::is_integer(s.format), s.side));
                if pass.distances(side).len() > 1 && before != Some((format::is_integer(format), side)) {
                    return Err(RenderError::Job(format!(
                        "light `{}`: the pass `{}` is repeated, so it must make what it reads, in size and kind of \
                         numbers",
                        self.light, pass.name
                    )));
                }
                self.steps.push(Step { runner: None, mirrored: None, format, side });
            }
            position += passes;
        }
        Ok(())
    }

    fn choose_format(
        &self,
        device: &Device,
        names: &[&str],
        needs: Needs,
        messages: &mut Vec<String>,
    ) -> Result<TextureFormat, RenderError> {
        let Some((position, format)) = format::choose(names, needs, &|f| device.abilities(f)) else {
            return Err(RenderError::Unsupported(format!(
                "the adapter cannot make a map of light `{}` in any of its formats ({})",
                self.light,
                names.join(", ")
            )));
        };
        if position > 0 {
            messages.push(format!(
                "the map of light `{}` is made in {}: the adapter cannot {} {}",
                self.light,
                names[position],
                needs.verb(),
                names[..position].join(", ")
            ));
        }
        Ok(format)
    }

    /// Format of the finished map.
    pub(super) fn format(&self) -> TextureFormat {
        self.steps.last().map_or(TextureFormat::Depth32Float, |s| s.format)
    }

    /// Texels on a side of the finished map.
    pub(super) fn side(&self) -> u32 {
        self.steps.last().map_or(1, |s| s.side)
    }

    /// Samples per texel of the pass that draws, where its format has as many.
    pub(super) fn samples(&self, device: &Device) -> u32 {
        let wanted = self.passes[0].number("samples").unwrap_or(1);
        let able =
            self.steps[0].format != TextureFormat::Depth32Float && device.abilities(self.steps[0].format).multisampled;
        if wanted == 4 && able { 4 } else { 1 }
    }

    fn spec(&self, device: &Device, index: usize) -> Spec {
        let (pass, step) = (&self.passes[index], &self.steps[index]);
        let is_depth = step.format == TextureFormat::Depth32Float;
        let (locations, bindings, depth) = match pass.kind {
            PassKind::Geometry => {
                (vec![Attribute::Position.location()], vec![(0, 0, UNIFORM), (1, 0, UNIFORM)], DepthUse::Nearest)
            }
            PassKind::Image | PassKind::Compute | PassKind::Mip => {
                let mut bindings = vec![(0, 0, texture_type(self.source_type(index)))];
                bindings.extend(pass.reads_light.then_some((0, 1, UNIFORM)));
                bindings.extend(pass.repeat.map(|_| (0, 3, UNIFORM)));
                (Vec::new(), bindings, DepthUse::None)
            }
        };
        Spec {
            wgsl: pass.wgsl.clone(),
            locations,
            bindings,
            color: (!is_depth).then_some(step.format),
            depth,
            samples: if pass.kind == PassKind::Geometry { self.samples(device) } else { 1 },
            // A light's frame is right-handed and looks along +z, so that maps are mirror images.
            mirrored: pass.kind == PassKind::Geometry,
            culling: match pass.choices.get("cull").map(String::as_str) {
                Some("front") => Culling::Front,
                Some("back") => Culling::Back,
                _ => Culling::Nothing,
            },
        }
    }

    /// What a compute pass is built from; nothing for other passes.
    fn compute_spec(&self, index: usize) -> Option<ComputeSpec> {
        let pass = &self.passes[index];
        (pass.kind == PassKind::Compute).then(|| ComputeSpec {
            wgsl: pass.wgsl.clone(),
            source: self.source_type(index),
            format: self.steps[index].format,
            reads_light: pass.reads_light,
            repeated: pass.repeat.is_some(),
        })
    }

    /// How a pass reads what the one before made.
    fn source_type(&self, index: usize) -> wgpu::TextureSampleType {
        format::sample_type(self.steps[index.saturating_sub(1)].format)
    }

    /// How the textures of a pass are made.
    pub(super) fn texels(&self, device: &Device, index: usize, levels: u32) -> Texels {
        let format = self.steps[index].format;
        // Whichever textures compute passes go to and fro between.
        let computes = self.passes.iter().any(|p| p.kind == PassKind::Compute);
        Texels { levels, stored: computes && device.abilities(format).storable, ..Texels::plain(format) }
    }

    /// Number of mip levels of the finished map.
    pub(super) fn levels(&self) -> u32 {
        if self.passes.iter().any(|p| p.kind == PassKind::Mip) { self.side().ilog2() + 1 } else { 1 }
    }

    /// Bytes that the map and its helpers take at most.
    pub(super) fn bytes(&self) -> u64 {
        let squared = |s: &Step| u64::from(s.side).pow(2) * u64::from(format::texel_bytes(s.format));
        let most = self.steps.iter().map(squared).max().unwrap_or(0);
        // Two to go to and fro, one multisampled, and a depth buffer beside each.
        most * (self.views.len() as u64 * 2 + 8)
    }

    /// What the pass at `index` is called in timings.
    pub(super) fn label(&self, index: usize, view: usize) -> String {
        let pass = &self.passes[index];
        // Passes that run once per axis are told apart.
        let axis = pass.choices.get("axis").map_or(String::new(), |a| format!(" {a}"));
        let view = if self.views.len() > 1 { format!(", view {}", view + 1) } else { String::new() };
        format!("{}: {}{axis}{view}", self.light, pass.name)
    }
}
