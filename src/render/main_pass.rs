//! The main pass: background and objects, from the camera.

use std::sync::Arc;

use wgpu::{BindingType, TextureFormat};

use super::RenderError;
use super::blocks::{background_block, frame_block};
use super::device::Device;
use super::job::{Draw, Job};
use super::map_passes::{clear_depth, space_bytes};
use super::maps::LightPlans;
use super::pipeline::{Culling, DepthUse, Pipeline, Spec, UNIFORM, array_type, texture_type};
use super::timing::Timer;
use super::uploads::Uploads;
use crate::module::{Binding, Resource};

/// Target of the main pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Target {
    pub(super) format: TextureFormat,
    pub(super) samples: u32,
}

/// The pipeline that a draw needs. `map_of` tells which of the maps of `lights` its plan means.
pub(super) fn main_spec(
    device: &Device,
    draw: &Draw<'_>,
    map_of: &[usize],
    lights: &LightPlans<'_>,
    target: Target,
) -> Result<Spec, RenderError> {
    let module = &draw.shader.module;
    // Before the driver sees the shader: some refuse it with words of their own.
    device.check_uniform("parameters", u64::from(module.parameter_bytes))?;
    let filterable = wgpu::TextureSampleType::Float { filterable: true };
    let sampler = BindingType::Sampler;
    let mut bindings = Vec::new();
    for binding in &module.bindings {
        let ty = match &binding.resource {
            Resource::Frame | Resource::Object | Resource::Parameters | Resource::Space { .. } => UNIFORM,
            Resource::Image { .. } | Resource::Environment => texture_type(filterable),
            Resource::Sampler(s) if s.compare => sampler(wgpu::SamplerBindingType::Comparison),
            Resource::Sampler(s) if s.linear || s.mip_linear || s.anisotropy > 1 => {
                sampler(wgpu::SamplerBindingType::Filtering)
            }
            Resource::Sampler(_) => sampler(wgpu::SamplerBindingType::NonFiltering),
            Resource::EnvironmentSampler => sampler(wgpu::SamplerBindingType::Filtering),
            Resource::Map { ty, .. } if ty.starts_with("texture_depth") => array_type(wgpu::TextureSampleType::Depth),
            Resource::Map { ty, .. } if ty.ends_with("<u32>") => array_type(wgpu::TextureSampleType::Uint),
            Resource::Map { index, .. } => {
                let map = map_of.get(*index).map(|i| &lights.maps[*i]);
                let map = map.ok_or_else(|| missing_map(binding))?;
                // Depth can be read, but not interpolated.
                let depth = map.format().is_depth_stencil_format();
                let filterable = device.abilities(map.format()).filterable && !depth;
                array_type(wgpu::TextureSampleType::Float { filterable })
            }
        };
        bindings.push((binding.group, binding.binding, ty));
    }
    bindings.sort_by_key(|(group, binding, _)| (*group, *binding));
    Ok(Spec {
        wgsl: module.wgsl.clone(),
        locations: module.attributes.iter().map(|a| a.location()).collect(),
        bindings,
        color: Some(target.format),
        depth: DepthUse::Nearest,
        samples: target.samples,
        mirrored: draw.object_to_world.determinant() < 0.0,
        culling: Culling::Nothing,
    })
}

fn missing_map(binding: &Binding) -> RenderError {
    RenderError::Job(format!("`{}` is a map that the plan does not have", binding.name))
}

/// The pipeline of the background.
pub(super) fn background_spec(target: Target) -> Spec {
    let filterable = wgpu::TextureSampleType::Float { filterable: true };
    Spec {
        wgsl: include_str!("background.wgsl").into(),
        locations: Vec::new(),
        bindings: vec![
            (0, 0, UNIFORM),
            (0, 1, texture_type(filterable)),
            (0, 2, BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
        ],
        color: Some(target.format),
        depth: DepthUse::Ignore,
        samples: target.samples,
        mirrored: false,
        culling: Culling::Nothing,
    }
}

/// The main pass with everything that is ready before it.
pub(super) struct Main<'a> {
    pub(super) job: &'a Job<'a>,
    pub(super) target: Target,
    pub(super) lights: &'a LightPlans<'a>,
    pub(super) maps: &'a [wgpu::Texture],
    pub(super) objects: &'a [wgpu::Buffer],
}

/// Something to bind, owned until the pass is encoded.
enum Bound {
    Buffer(wgpu::Buffer),
    Texture(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

impl Bound {
    fn resource(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::Texture(view) => wgpu::BindingResource::TextureView(view),
            Self::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
        }
    }
}

impl Main<'_> {
    /// Encodes the pass; the result is the single-sampled picture.
    pub(super) fn render(
        &self,
        device: &Device,
        encoder: &mut wgpu::CommandEncoder,
        timer: &Timer,
        pipelines: &[Arc<Pipeline>],
        background: Option<&Pipeline>,
        uploads: &mut Uploads<'_>,
    ) -> Result<wgpu::Texture, RenderError> {
        let Target { format, samples } = self.target;
        let size = self.job.size;
        let picture = device.target("picture", size, format, 1, 1);
        let many = (samples > 1).then(|| device.target("samples", size, format, samples, 1));
        let depth = device.target("depth", size, TextureFormat::Depth32Float, samples, 1);
        let view = |t: &wgpu::Texture| t.create_view(&wgpu::TextureViewDescriptor::default());
        let (picture_view, depth_view) = (view(&picture), view(&depth));
        let many_view = many.as_ref().map(view);
        let frame = device.buffer("frame", wgpu::BufferUsages::UNIFORM, &frame_block(self.job))?;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("main"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: many_view.as_ref().unwrap_or(&picture_view),
                depth_slice: None,
                resolve_target: many_view.is_some().then_some(&picture_view),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: if many_view.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store },
                },
            })],
            depth_stencil_attachment: Some(clear_depth(&depth_view, 1.0)),
            timestamp_writes: timer.writes(true, true),
            ..wgpu::RenderPassDescriptor::default()
        });
        if let Some(pipeline) = background {
            let (texture, sampler) = uploads.environment(self.job.surroundings)?;
            let block = background_block(&self.job.camera, size);
            let block = device.buffer("background", wgpu::BufferUsages::UNIFORM, &block)?;
            let resources = [Bound::Buffer(block), Bound::Texture(texture), Bound::Sampler(sampler)];
            let resources: Vec<_> = (0..).zip(&resources).map(|(i, r)| (0, i, r.resource())).collect();
            pipeline.set(&mut pass, &pipeline.bind(device, &resources));
            pass.draw(0..3, 0..1);
        }
        for (index, (draw, pipeline)) in self.job.draws.iter().zip(pipelines).enumerate() {
            if draw.mesh.indices.is_empty() {
                continue;
            }
            let module = &draw.shader.module;
            let mut bound = Vec::new();
            for binding in &module.bindings {
                bound.push((binding.group, binding.binding, self.bound(device, index, binding, &frame, uploads)?));
            }
            let resources: Vec<_> = bound.iter().map(|(g, b, r)| (*g, *b, r.resource())).collect();
            pipeline.set(&mut pass, &pipeline.bind(device, &resources));
            for (slot, attribute) in (0..).zip(&module.attributes) {
                pass.set_vertex_buffer(slot, uploads.attribute(draw.mesh, attribute.location())?.slice(..));
            }
            pass.set_index_buffer(uploads.indices(draw.mesh)?.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..u32::try_from(draw.mesh.indices.len()).unwrap_or(0), 0, 0..1);
        }
        drop(pass);
        Ok(picture)
    }

    fn bound(
        &self,
        device: &Device,
        index: usize,
        binding: &Binding,
        frame: &wgpu::Buffer,
        uploads: &mut Uploads<'_>,
    ) -> Result<Bound, RenderError> {
        let draw = &self.job.draws[index];
        let uniform = |bytes: &[u8]| device.buffer(&binding.name, wgpu::BufferUsages::UNIFORM, bytes);
        Ok(match &binding.resource {
            Resource::Frame => Bound::Buffer(frame.clone()),
            Resource::Object => Bound::Buffer(self.objects[index].clone()),
            Resource::Parameters => {
                Bound::Buffer(uniform(&draw.shader.module.pack(&|p| draw.values.get(&p.path).cloned()))?)
            }
            Resource::Image { path, base, srgb } => {
                Bound::Texture(uploads.image(path, base, *srgb, self.job.images)?)
            }
            Resource::Sampler(settings) => Bound::Sampler(uploads.sampler(settings)?),
            Resource::Space { light, .. } => {
                let views = self.lights.spaces[index].get(light.as_str());
                Bound::Buffer(uniform(&views.map(|v| space_bytes(v)).unwrap_or_default())?)
            }
            Resource::Map { index: map, .. } => {
                let texture = self.lights.map_of[index].get(*map).map(|i| &self.maps[*i]);
                let texture = texture.ok_or_else(|| missing_map(binding))?;
                let dimension = Some(wgpu::TextureViewDimension::D2Array);
                Bound::Texture(
                    texture.create_view(&wgpu::TextureViewDescriptor {
                        dimension,
                        ..wgpu::TextureViewDescriptor::default()
                    }),
                )
            }
            Resource::Environment => Bound::Texture(uploads.environment(self.job.surroundings)?.0),
            Resource::EnvironmentSampler => Bound::Sampler(uploads.environment(self.job.surroundings)?.1),
        })
    }
}
