//! Runs the passes of a map: the casters are drawn, then the picture goes to and fro between textures.

use wgpu::TextureFormat;

use super::RenderError;
use super::compute::Bound;
use super::device::{Device, Texels};
use super::job::Draw;
use super::light_space::LightSpace;
use super::maps::{MapPlan, Runner};
use super::pipeline::Pipeline;
use super::timing::Timer;
use super::uploads::Uploads;
use crate::module::Attribute;
use crate::plan::PassKind;

/// What all maps are made with.
pub(super) struct Work<'w, 'd> {
    pub(super) device: &'w Device,
    pub(super) encoder: &'w mut wgpu::CommandEncoder,
    pub(super) timer: &'w mut Timer,
    pub(super) draws: &'w [Draw<'d>],
    /// The object block of each draw.
    pub(super) objects: &'w [wgpu::Buffer],
    pub(super) uploads: &'w mut Uploads<'d>,
}

/// A place that a pass writes to or reads from: one layer, and its mip level.
#[derive(Clone)]
struct Place {
    texture: wgpu::Texture,
    layer: u32,
    level: u32,
}

impl Place {
    fn view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_mip_level: self.level,
            mip_level_count: Some(1),
            base_array_layer: self.layer,
            array_layer_count: Some(1),
            ..wgpu::TextureViewDescriptor::default()
        })
    }

    fn info(&self) -> wgpu::TexelCopyTextureInfo<'_> {
        wgpu::TexelCopyTextureInfo {
            texture: &self.texture,
            mip_level: self.level,
            origin: wgpu::Origin3d { x: 0, y: 0, z: self.layer },
            aspect: wgpu::TextureAspect::All,
        }
    }
}

/// What the first passes of a map have made already: a layer for each view, and how many passes that are.
pub(super) struct Base<'a> {
    pub(super) texture: &'a wgpu::Texture,
    pub(super) passes: usize,
}

impl MapPlan<'_> {
    /// Runs the first `count` passes for every view, but for those that `base` holds; the result has one layer per view,
    /// and is the finished map if there are no more passes.
    pub(super) fn render(
        &self,
        work: &mut Work<'_, '_>,
        base: Option<&Base<'_>>,
        count: usize,
    ) -> Result<wgpu::Texture, RenderError> {
        let device = work.device;
        let layers = device.array_layers(u32::try_from(self.views.len()).unwrap_or(1));
        let make = |index: usize, layers, levels| {
            device.layers(self.light, self.steps[index].side, layers, self.texels(device, index, levels))
        };
        let last = self.passes[..count].iter().rposition(|p| p.kind != PassKind::Mip).unwrap_or(0);
        let levels = if last + 1 < count { self.levels() } else { 1 };
        let result = make(last, layers, levels);
        let first = base.map_or(0, |b| b.passes);
        // OpenGL cannot read one layer of an array as a picture: there the passes run beside it.
        let beside = (!device.reads_layers() && first.max(1) < count).then(|| make(last, 1, levels));
        let mut scratch: Vec<wgpu::Texture> = Vec::new();
        let depth = (first == 0).then(|| self.depth_beside(device)).flatten();
        for (layer, view) in (0..).zip(&self.views) {
            let uniform = device.buffer("light space", wgpu::BufferUsages::UNIFORM, &view.to_bytes())?;
            let finished = |level| match &beside {
                Some(texture) => Place { texture: texture.clone(), layer: 0, level },
                None => Place { texture: result.clone(), layer, level },
            };
            let mut source: Option<Place> = None;
            if let Some(base) = base {
                let made = Place { texture: base.texture.clone(), layer, level: 0 };
                // The first mip level is where the last picture lies.
                let beside = (!device.reads_layers()).then(|| make(first - 1, 1, 1));
                let beside = beside.map(|texture| Place { texture, layer: 0, level: 0 });
                let to = if first > last { Some(finished(0)) } else { beside };
                if let Some(to) = &to {
                    copy(work.encoder, &made, to);
                }
                source = to.or(Some(made));
            }
            for index in first..count {
                let (pass, step) = (&self.passes[index], &self.steps[index]);
                let Some(runner) = &step.runner else { continue };
                work.timer.next(self.label(index, layer as usize));
                if pass.kind == PassKind::Mip {
                    for level in 1..levels {
                        let (from, to) = (finished(level - 1).view(), finished(level).view());
                        let run = Run { runner, side: step.side, ends: (level == 1, level + 1 == levels) };
                        run.encode(work, &from, &to, None, None);
                    }
                    continue;
                }
                let distances = pass.distances(step.side);
                let runs = distances.len().max(1);
                for repeat in 0..runs {
                    let target = if index == last && repeat + 1 == runs {
                        finished(0)
                    } else {
                        let taken = source.as_ref().map(|p| &p.texture);
                        let fits = |t: &&wgpu::Texture| {
                            t.format() == step.format && t.width() == step.side && Some(*t) != taken
                        };
                        let texture = scratch.iter().find(fits).cloned().unwrap_or_else(|| {
                            scratch.push(make(index, 1, 1));
                            scratch[scratch.len() - 1].clone()
                        });
                        Place { texture, layer: 0, level: 0 }
                    };
                    match (runner, &source) {
                        (Runner::Draw(pipeline), None) => {
                            self.draw_casters(work, pipeline, &target.view(), depth.as_ref(), &uniform)?;
                        }
                        (_, Some(from)) => {
                            let usage = wgpu::BufferUsages::UNIFORM;
                            let distance = distances.get(repeat).map(|d| d.to_le_bytes());
                            let distance = distance.map(|d| device.buffer("distance", usage, &d)).transpose()?;
                            let run = Run { runner, side: step.side, ends: (repeat == 0, repeat + 1 == runs) };
                            let light = pass.reads_light.then_some(&uniform);
                            run.encode(work, &from.view(), &target.view(), light, distance.as_ref());
                        }
                        // The first pass draws: plans where it does not are refused.
                        (Runner::Compute(_), None) => {}
                    }
                    source = Some(target);
                }
            }
            if let Some(texture) = &beside {
                for level in 0..levels {
                    let from = Place { texture: texture.clone(), layer: 0, level };
                    copy(work.encoder, &from, &Place { texture: result.clone(), layer, level });
                }
            }
        }
        Ok(result)
    }

    /// The depth buffer of the pass that draws, where it does not draw depth itself.
    fn depth_beside(&self, device: &Device) -> Option<wgpu::Texture> {
        let step = &self.steps[0];
        (step.format != TextureFormat::Depth32Float).then(|| {
            let samples = self.samples(device);
            let texels = Texels { samples, ..Texels::plain(TextureFormat::Depth32Float) };
            device.layers("depth", step.side, 1, texels)
        })
    }

    fn draw_casters(
        &self,
        work: &mut Work<'_, '_>,
        pipeline: &Pipeline,
        target: &wgpu::TextureView,
        beside: Option<&wgpu::Texture>,
        space: &wgpu::Buffer,
    ) -> Result<(), RenderError> {
        let device = work.device;
        let pass = &self.passes[0];
        let channel = |i: usize| pass.clear.get(i).copied().unwrap_or(0.0);
        let samples = self.samples(device);
        let many = (samples > 1)
            .then(|| {
                let texels = Texels { samples, ..Texels::plain(self.steps[0].format) };
                device.layers(self.light, self.steps[0].side, 1, texels)
            })
            .map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()));
        let depth_view =
            beside.map_or_else(|| target.clone(), |t| t.create_view(&wgpu::TextureViewDescriptor::default()));
        let color = beside.is_some().then(|| wgpu::RenderPassColorAttachment {
            view: many.as_ref().unwrap_or(target),
            depth_slice: None,
            resolve_target: many.is_some().then_some(target),
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color { r: channel(0), g: channel(1), b: channel(2), a: channel(3) }),
                store: if many.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store },
            },
        });
        let farthest = if beside.is_some() { 1.0 } else { pass.clear.first().copied().unwrap_or(1.0) };
        let colors: &[_] = if color.is_some() { &[color] } else { &[] };
        let mut encoded = work.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(&pass.name),
            color_attachments: colors,
            depth_stencil_attachment: Some(clear_depth(&depth_view, farthest)),
            timestamp_writes: work.timer.writes(true, true),
            ..wgpu::RenderPassDescriptor::default()
        });
        for (draw, object) in work.draws.iter().zip(work.objects).filter(|(d, _)| d.casts && !d.mesh.indices.is_empty())
        {
            let mirrored = self.steps[0].mirrored.as_deref().filter(|_| draw.object_to_world.determinant() < 0.0);
            let pipeline = mirrored.unwrap_or(pipeline);
            let resources = [(0, 0, space.as_entire_binding()), (1, 0, object.as_entire_binding())];
            pipeline.set(&mut encoded, &pipeline.bind(device, &resources));
            let positions = work.uploads.attribute(draw.mesh, Attribute::Position.location())?;
            encoded.set_vertex_buffer(0, positions.slice(..));
            encoded.set_index_buffer(work.uploads.indices(draw.mesh)?.slice(..), wgpu::IndexFormat::Uint32);
            encoded.draw_indexed(0..u32::try_from(draw.mesh.indices.len()).unwrap_or(0), 0, 0..1);
        }
        Ok(())
    }
}

/// A light's view in bytes: one, or all of them.
pub(super) fn space_bytes(views: &[LightSpace]) -> Vec<u8> {
    views.iter().flat_map(LightSpace::to_bytes).collect()
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

/// Copies one mip level of one layer.
fn copy(encoder: &mut wgpu::CommandEncoder, from: &Place, to: &Place) {
    let side = |extent: u32| (extent >> from.level).max(1);
    let size = wgpu::Extent3d {
        width: side(from.texture.width()),
        height: side(from.texture.height()),
        depth_or_array_layers: 1,
    };
    encoder.copy_texture_to_texture(from.info(), to.info(), size);
}

/// One run of a pass over a picture.
struct Run<'a> {
    runner: &'a Runner,
    side: u32,
    /// Whether it begins and whether it ends what is timed.
    ends: (bool, bool),
}

impl Run<'_> {
    fn encode(
        &self,
        work: &mut Work<'_, '_>,
        from: &wgpu::TextureView,
        to: &wgpu::TextureView,
        light: Option<&wgpu::Buffer>,
        distance: Option<&wgpu::Buffer>,
    ) {
        let (first, last) = self.ends;
        match self.runner {
            Runner::Compute(pipeline) => {
                let writes = work.timer.compute_writes(first, last);
                let bound = Bound { source: from, target: to, light, distance };
                pipeline.run(work.device, work.encoder, writes, bound, self.side);
            }
            Runner::Draw(pipeline) => {
                let mut resources = vec![(0, 0, wgpu::BindingResource::TextureView(from))];
                resources.extend(light.map(|l| (0, 1, l.as_entire_binding())));
                resources.extend(distance.map(|d| (0, 3, d.as_entire_binding())));
                let groups = pipeline.bind(work.device, &resources);
                let writes = work.timer.writes(first, last);
                full_screen(work.encoder, writes, pipeline, &groups, to);
            }
        }
    }
}

fn full_screen(
    encoder: &mut wgpu::CommandEncoder,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    pipeline: &Pipeline,
    groups: &[wgpu::BindGroup],
    to: &wgpu::TextureView,
) {
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
    pipeline.set(&mut pass, groups);
    pass.draw(0..3, 0..1);
}
