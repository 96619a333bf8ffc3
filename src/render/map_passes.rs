//! Runs the passes of a map: the casters are drawn, then the picture goes to and fro between textures.

use wgpu::TextureFormat;

use super::RenderError;
use super::device::Device;
use super::job::Draw;
use super::light_space::LightSpace;
use super::maps::{MapPlan, Step};
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

impl MapPlan<'_> {
    /// Runs the passes for every view; the result is the finished map, one layer per view.
    pub(super) fn render(&self, work: &mut Work<'_, '_>) -> Result<wgpu::Texture, RenderError> {
        let device = work.device;
        let layers = device.array_layers(u32::try_from(self.views.len()).unwrap_or(1));
        let make = |step: &Step, layers, levels| device.layers(self.light, step.side, step.format, 1, levels, layers);
        let last = self.passes.iter().rposition(|p| p.kind != PassKind::Mip).unwrap_or(0);
        let result = make(&self.steps[last], layers, self.levels());
        // OpenGL cannot read one layer of an array as a picture: there the passes run beside it.
        let beside =
            (!device.reads_layers() && self.passes.len() > 1).then(|| make(&self.steps[last], 1, self.levels()));
        let mut scratch: Vec<wgpu::Texture> = Vec::new();
        let depth = self.depth_beside(device);
        for (layer, view) in (0..).zip(&self.views) {
            let uniform = device.buffer("light space", wgpu::BufferUsages::UNIFORM, &view.to_bytes())?;
            let finished = |level| match &beside {
                Some(texture) => Place { texture: texture.clone(), layer: 0, level },
                None => Place { texture: result.clone(), layer, level },
            };
            let mut source: Option<Place> = None;
            for (index, (pass, step)) in self.passes.iter().zip(&self.steps).enumerate() {
                let Some(pipeline) = &step.pipeline else { continue };
                work.timer.next(self.label(index, layer as usize));
                if pass.kind == PassKind::Mip {
                    let levels = self.levels();
                    for level in 1..levels {
                        let (from, to) = (finished(level - 1).view(), finished(level).view());
                        let writes = work.timer.writes(level == 1, level + 1 == levels);
                        full_screen(device, work.encoder, writes, pipeline, &resources(&from, None), &to);
                    }
                    continue;
                }
                let target = if index == last {
                    finished(0)
                } else {
                    let taken = source.as_ref().map(|p| &p.texture);
                    let fits =
                        |t: &&wgpu::Texture| t.format() == step.format && t.width() == step.side && Some(*t) != taken;
                    let texture = scratch.iter().find(fits).cloned().unwrap_or_else(|| {
                        scratch.push(make(step, 1, 1));
                        scratch[scratch.len() - 1].clone()
                    });
                    Place { texture, layer: 0, level: 0 }
                };
                match (pass.kind, &source) {
                    (PassKind::Image, Some(from)) => {
                        let light = pass.reads_light.then_some(&uniform);
                        let from = from.view();
                        let writes = work.timer.writes(true, true);
                        let resources = resources(&from, light);
                        full_screen(device, work.encoder, writes, pipeline, &resources, &target.view());
                    }
                    _ => self.draw_casters(work, pipeline, &target.view(), depth.as_ref(), &uniform)?,
                }
                source = Some(target);
            }
            if let Some(texture) = &beside {
                for level in 0..self.levels() {
                    copy(
                        work.encoder,
                        &Place { texture: texture.clone(), layer: 0, level },
                        &Place { texture: result.clone(), layer, level },
                    );
                }
            }
        }
        Ok(result)
    }

    /// The depth buffer of the pass that draws, where it does not draw depth itself.
    fn depth_beside(&self, device: &Device) -> Option<wgpu::Texture> {
        let step = &self.steps[0];
        (step.format != TextureFormat::Depth32Float)
            .then(|| device.layers("depth", step.side, TextureFormat::Depth32Float, self.samples(device), 1, 1))
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
            .then(|| device.layers(self.light, self.steps[0].side, self.steps[0].format, samples, 1, 1))
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

/// What a full-screen pass reads: its source, and the light if it asks.
fn resources<'a>(
    source: &'a wgpu::TextureView,
    light: Option<&'a wgpu::Buffer>,
) -> Vec<(u32, u32, wgpu::BindingResource<'a>)> {
    let mut all = vec![(0, 0, wgpu::BindingResource::TextureView(source))];
    all.extend(light.map(|l| (0, 1, l.as_entire_binding())));
    all
}

fn full_screen(
    device: &Device,
    encoder: &mut wgpu::CommandEncoder,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    pipeline: &Pipeline,
    resources: &[(u32, u32, wgpu::BindingResource<'_>)],
    to: &wgpu::TextureView,
) {
    let groups = pipeline.bind(device, resources);
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
