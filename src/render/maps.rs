//! Maps of lights: which ones a job needs, in which format, and the passes that make them.

use std::collections::BTreeMap;
use std::sync::Arc;

use wgpu::TextureFormat;

use super::RenderError;
use super::device::Device;
use super::format;
use super::job::{Draw, Job};
use super::light_space::{Bounds, LightSpace, light_space};
use super::pipeline::{DepthUse, Pipeline, Pipelines, Spec, UNIFORM, texture_type};
use super::timing::Timer;
use super::uploads::Uploads;
use crate::module::{Attribute, Resource};
use crate::plan::{Pass, PassKind};

/// A map that is to be made. Two draws share it when light, space and passes are equal.
pub(super) struct MapPlan<'a> {
    pub(super) light: &'a str,
    pub(super) passes: &'a [Pass],
    pub(super) space: LightSpace,
    pub(super) size: u32,
    pub(super) format: TextureFormat,
    filtered: bool,
    /// One per pass.
    pipelines: Vec<Arc<Pipeline>>,
}

/// What the lights of a job need.
#[derive(Default)]
pub(super) struct LightPlans<'a> {
    /// Distinct maps, in the order of draws and their plans.
    pub(super) maps: Vec<MapPlan<'a>>,
    /// Per draw: for each map of its plan, its position in `maps`.
    pub(super) map_of: Vec<Vec<usize>>,
    /// Per draw: the spaces of the lights that it uses.
    pub(super) spaces: Vec<BTreeMap<&'a str, LightSpace>>,
    pub(super) messages: Vec<String>,
}

impl<'a> LightPlans<'a> {
    /// Collects the spaces and maps of a job.
    pub(super) fn gather(device: &Device, job: &'a Job<'_>) -> Result<Self, RenderError> {
        let mut bounds = Bounds::default();
        for draw in &job.draws {
            bounds.add(&draw.mesh.positions, draw.object_to_world);
        }
        let mut plans = Self::default();
        for draw in &job.draws {
            let spaces = spaces_of(draw, &bounds)?;
            let mut map_of = Vec::new();
            for map in &draw.shader.plan.maps {
                let space = spaces[map.light.as_str()];
                let same = |m: &MapPlan<'_>| m.light == map.light && m.space == space && m.passes == map.passes;
                let index = plans.maps.iter().position(same).unwrap_or(plans.maps.len());
                if index == plans.maps.len() {
                    check_passes(&map.light, &map.passes)?;
                    device.check_texture(&format!("a map of `{}`", map.light), map.size(), map.size())?;
                    plans.maps.push(MapPlan {
                        light: &map.light,
                        passes: &map.passes,
                        space,
                        size: map.size(),
                        format: TextureFormat::Depth32Float,
                        filtered: false,
                        pipelines: Vec::new(),
                    });
                }
                plans.maps[index].filtered |= map.filtered;
                map_of.push(index);
            }
            plans.map_of.push(map_of);
            plans.spaces.push(spaces);
        }
        for map in &mut plans.maps {
            map.choose_format(device, &mut plans.messages)?;
        }
        Ok(plans)
    }

    /// Makes the pipelines of every pass.
    pub(super) fn build(&mut self, device: &Device, pipelines: &mut Pipelines) -> Result<(), RenderError> {
        for map in &mut self.maps {
            for pass in map.passes {
                let what = format!("pass `{}` of light `{}`", pass.name, map.light);
                map.pipelines.push(pipelines.get(device, &what, map.spec(pass))?);
            }
        }
        Ok(())
    }
}

/// The spaces of the lights that a draw binds or has maps of.
fn spaces_of<'a>(draw: &'a Draw<'_>, bounds: &Bounds) -> Result<BTreeMap<&'a str, LightSpace>, RenderError> {
    let shader = draw.shader;
    let bound = shader.module.bindings.iter().filter_map(|b| match &b.resource {
        Resource::Space { light } => Some(light.as_str()),
        _ => None,
    });
    let mut spaces = BTreeMap::new();
    for name in bound.chain(shader.plan.maps.iter().map(|m| m.light.as_str())) {
        if !spaces.contains_key(name) {
            let light = shader.plan.lights.iter().find(|l| l.name == name);
            let light = light.ok_or_else(|| RenderError::Job(format!("the plan has no light `{name}`")))?;
            let value_of = |p: &crate::module::Parameter| draw.values.get(&p.path).cloned();
            spaces.insert(name, light_space(light, &shader.module, &value_of, bounds)?);
        }
    }
    Ok(spaces)
}

/// A map is drawn first, then filtered, then reduced.
fn check_passes(light: &str, passes: &[Pass]) -> Result<(), RenderError> {
    let rank = |p: &Pass| match p.kind {
        PassKind::Geometry => 0,
        PassKind::Image => 1,
        PassKind::Mip => 2,
    };
    let drawn = passes.first().is_some_and(|p| p.kind == PassKind::Geometry);
    let once = passes.iter().filter(|p| p.kind == PassKind::Geometry).count() == 1;
    let mips = passes.iter().filter(|p| p.kind == PassKind::Mip).count() <= 1;
    if drawn && once && mips && passes.is_sorted_by_key(rank) {
        Ok(())
    } else {
        Err(RenderError::Job(format!(
            "a map of light `{light}` must be one geometry pass, then image passes, then at most one mip pass"
        )))
    }
}

impl MapPlan<'_> {
    /// Takes the first format that the adapter can make, and that all passes can write.
    fn choose_format(&mut self, device: &Device, messages: &mut Vec<String>) -> Result<(), RenderError> {
        let names: Vec<String> = self.passes[0]
            .targets
            .iter()
            .filter(|name| self.passes.iter().all(|p| p.targets.is_empty() || p.targets.contains(name)))
            .cloned()
            .collect();
        let chosen = format::choose(&names, self.filtered, &|f| device.abilities(f));
        let Some((position, format)) = chosen else {
            return Err(RenderError::Unsupported(format!(
                "the adapter cannot make a map of light `{}` in any of its formats ({})",
                self.light,
                self.passes[0].targets.join(", ")
            )));
        };
        if format == TextureFormat::Depth32Float && self.passes.len() > 1 {
            return Err(RenderError::Job(format!(
                "light `{}`: depth targets cannot be filtered by passes",
                self.light
            )));
        }
        if position > 0 {
            messages.push(format!(
                "the map of light `{}` is made in {}: the adapter cannot {} {}",
                self.light,
                names[position],
                if self.filtered { "render and filter" } else { "render" },
                names[..position].join(", ")
            ));
        }
        self.format = format;
        Ok(())
    }

    fn is_depth(&self) -> bool {
        self.format == TextureFormat::Depth32Float
    }

    fn spec(&self, pass: &Pass) -> Spec {
        let (locations, bindings, depth) = match pass.kind {
            PassKind::Geometry => {
                (vec![Attribute::Position.location()], vec![(0, 0, UNIFORM), (1, 0, UNIFORM)], DepthUse::Nearest)
            }
            PassKind::Image | PassKind::Mip => {
                let source = texture_type(wgpu::TextureSampleType::Float { filterable: false });
                (Vec::new(), vec![(0, 0, source)], DepthUse::None)
            }
        };
        Spec {
            wgsl: pass.wgsl.clone(),
            locations,
            bindings,
            color: (!self.is_depth()).then_some(self.format),
            depth,
            samples: 1,
            mirrored: false,
        }
    }

    /// Number of mip levels.
    fn levels(&self) -> u32 {
        if self.passes.iter().any(|p| p.kind == PassKind::Mip) { self.size.ilog2() + 1 } else { 1 }
    }

    /// Bytes that the map and its helpers take at most.
    pub(super) fn bytes(&self) -> u64 {
        u64::from(self.size).pow(2) * u64::from(3 * format::texel_bytes(self.format) + 4)
    }

    /// Runs the passes; the result is the finished map.
    pub(super) fn render(
        &self,
        device: &Device,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut Timer,
        draws: &[Draw<'_>],
        objects: &[wgpu::Buffer],
        uploads: &mut Uploads<'_>,
    ) -> Result<wgpu::Texture, RenderError> {
        let images = self.passes.iter().filter(|p| p.kind == PassKind::Image).count();
        let make = |levels| device.target(self.light, (self.size, self.size), self.format, 1, levels);
        // The passes go to and fro between two textures; the last one writes the one with mip levels.
        let result = make(self.levels());
        let other = if images > 0 { Some(make(1)) } else { None };
        let at = |remaining: usize| other.as_ref().filter(|_| remaining % 2 == 1).unwrap_or(&result);
        let mut remaining = images;
        timer.next(self.label(0));
        self.draw_casters(device, encoder, timer, at(remaining), draws, objects, uploads)?;
        for (index, pass) in self.passes.iter().enumerate().skip(1) {
            let pipeline = &self.pipelines[index];
            match pass.kind {
                PassKind::Geometry => {}
                PassKind::Image => {
                    timer.next(self.label(index));
                    let (from, to) = (level(at(remaining), 0), level(at(remaining - 1), 0));
                    remaining -= 1;
                    full_screen(device, encoder, timer.writes(true, true), pipeline, &from, &to);
                }
                PassKind::Mip => {
                    timer.next(self.label(index));
                    let last = self.levels() - 1;
                    for target in 1..=last {
                        let (from, to) = (level(&result, target - 1), level(&result, target));
                        let writes = timer.writes(target == 1, target == last);
                        full_screen(device, encoder, writes, pipeline, &from, &to);
                    }
                }
            }
        }
        Ok(result)
    }

    fn label(&self, index: usize) -> String {
        let pass = &self.passes[index];
        // Passes that run once per axis are told apart.
        let axis = pass.choices.get("axis").map_or(String::new(), |a| format!(" {a}"));
        format!("{}: {}{axis}", self.light, pass.name)
    }

    #[allow(clippy::too_many_arguments, reason = "one call site; the arguments have no common owner")]
    fn draw_casters(
        &self,
        device: &Device,
        encoder: &mut wgpu::CommandEncoder,
        timer: &Timer,
        target: &wgpu::Texture,
        draws: &[Draw<'_>],
        objects: &[wgpu::Buffer],
        uploads: &mut Uploads<'_>,
    ) -> Result<(), RenderError> {
        let clear = &self.passes[0].clear;
        let channel = |i: usize| clear.get(i).copied().unwrap_or(0.0);
        let target_view = level(target, 0);
        let beside = (!self.is_depth())
            .then(|| device.target("depth", (self.size, self.size), TextureFormat::Depth32Float, 1, 1));
        let depth_view = beside.as_ref().map_or_else(|| target_view.clone(), |t| level(t, 0));
        let color = (!self.is_depth()).then(|| wgpu::RenderPassColorAttachment {
            view: &target_view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color { r: channel(0), g: channel(1), b: channel(2), a: channel(3) }),
                store: wgpu::StoreOp::Store,
            },
        });
        let farthest = if self.is_depth() { clear.first().copied().unwrap_or(1.0) } else { 1.0 };
        let colors: &[_] = if color.is_some() { &[color] } else { &[] };
        let space = device.buffer("light space", wgpu::BufferUsages::UNIFORM, &self.space.to_bytes())?;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(&self.passes[0].name),
            color_attachments: colors,
            depth_stencil_attachment: Some(clear_depth(&depth_view, farthest)),
            timestamp_writes: timer.writes(true, true),
            ..wgpu::RenderPassDescriptor::default()
        });
        for (draw, object) in draws.iter().zip(objects).filter(|(d, _)| d.casts && !d.mesh.indices.is_empty()) {
            // Both sides cast, so it does not matter whether the object is mirrored.
            let pipeline = &self.pipelines[0];
            let resources = [(0, 0, space.as_entire_binding()), (1, 0, object.as_entire_binding())];
            pipeline.set(&mut pass, &pipeline.bind(device, &resources));
            let positions = uploads.attribute(draw.mesh, Attribute::Position.location())?;
            pass.set_vertex_buffer(0, positions.slice(..));
            pass.set_index_buffer(uploads.indices(draw.mesh)?.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..u32::try_from(draw.mesh.indices.len()).unwrap_or(0), 0, 0..1);
        }
        Ok(())
    }
}

/// A depth buffer that starts at `value`.
pub(super) fn clear_depth(view: &wgpu::TextureView, value: f64) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    #[allow(clippy::cast_possible_truncation, reason = "depth is f32")]
    let value = value.clamp(0.0, 1.0) as f32;
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(value), store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    }
}

/// One mip level of a texture.
fn level(texture: &wgpu::Texture, base_mip_level: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        base_mip_level,
        mip_level_count: Some(1),
        ..wgpu::TextureViewDescriptor::default()
    })
}

fn full_screen(
    device: &Device,
    encoder: &mut wgpu::CommandEncoder,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    pipeline: &Pipeline,
    from: &wgpu::TextureView,
    to: &wgpu::TextureView,
) {
    let groups = pipeline.bind(device, &[(0, 0, wgpu::BindingResource::TextureView(from))]);
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("image pass"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: to,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        timestamp_writes,
        ..wgpu::RenderPassDescriptor::default()
    });
    pipeline.set(&mut pass, &groups);
    pass.draw(0..3, 0..1);
}
