//! Pipelines from shader texts, kept by everything that they depend on. Parameter values are not among it.

use std::collections::HashMap;
use std::sync::Arc;

use wgpu::{BindingType, TextureFormat};

use super::RenderError;
use super::compute::{self, ComputePipeline, ComputeSpec};
use super::device::{Device, check};
use crate::module::Attribute;

/// Everything that a pipeline depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Spec {
    /// Shader with `vs_main` and `fs_main`.
    pub(super) wgsl: String,
    /// Locations of the vertex attributes, one buffer each.
    pub(super) locations: Vec<u32>,
    /// Group, binding, type; sorted.
    pub(super) bindings: Vec<(u32, u32, BindingType)>,
    /// Colour target.
    pub(super) color: Option<TextureFormat>,
    /// Depth buffer (always 32-bit float).
    pub(super) depth: DepthUse,
    /// Samples per pixel.
    pub(super) samples: u32,
    /// Whether the object is mirrored: triangles then run clockwise.
    pub(super) mirrored: bool,
    /// Which sides of triangles are left out.
    pub(super) culling: Culling,
}

/// Sides of triangles that are not drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) enum Culling {
    #[default]
    Nothing,
    /// The outer ones.
    Front,
    /// The inner ones.
    Back,
}

/// What a pipeline does with the depth buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum DepthUse {
    /// There is none.
    None,
    /// The nearest surface wins.
    Nearest,
    /// It stays as it is, and everything is drawn.
    Ignore,
}

/// A pipeline with the layouts of its groups, from group 0 on without gaps.
pub(super) struct Pipeline {
    pub(super) pipeline: wgpu::RenderPipeline,
    layouts: Vec<wgpu::BindGroupLayout>,
}

/// Pipelines made so far.
#[derive(Default)]
pub(super) struct Pipelines {
    kept: HashMap<Spec, Arc<Pipeline>>,
    kept_compute: HashMap<ComputeSpec, Arc<ComputePipeline>>,
    pub(super) built: usize,
}

impl Pipelines {
    /// More than a scene needs; a long editing session starts afresh when it is full.
    const MOST: usize = 512;

    /// The pipeline of a spec, made if it is new. `what` names it in errors.
    pub(super) fn get(&mut self, device: &Device, what: &str, spec: Spec) -> Result<Arc<Pipeline>, RenderError> {
        if let Some(kept) = self.kept.get(&spec) {
            return Ok(kept.clone());
        }
        let made = Arc::new(device.scoped(what, || build(device, what, &spec))?);
        self.built += 1;
        if self.kept.len() >= Self::MOST {
            self.kept.clear();
        }
        self.kept.insert(spec, made.clone());
        Ok(made)
    }

    /// The same for a compute shader.
    pub(super) fn compute(
        &mut self,
        device: &Device,
        what: &str,
        spec: ComputeSpec,
    ) -> Result<Arc<ComputePipeline>, RenderError> {
        if let Some(kept) = self.kept_compute.get(&spec) {
            return Ok(kept.clone());
        }
        let made = Arc::new(device.scoped(what, || compute::build(device, what, &spec))?);
        self.built += 1;
        if self.kept_compute.len() >= Self::MOST {
            self.kept_compute.clear();
        }
        self.kept_compute.insert(spec, made.clone());
        Ok(made)
    }
}

fn build(device: &Device, what: &str, spec: &Spec) -> Result<Pipeline, RenderError> {
    let groups = spec.bindings.iter().map(|(group, ..)| group + 1).max().unwrap_or(0);
    check(what, u64::from(groups), u64::from(device.limits.max_bind_groups), "bind groups")?;
    let layouts: Vec<wgpu::BindGroupLayout> = (0..groups)
        .map(|group| {
            let entries: Vec<wgpu::BindGroupLayoutEntry> = spec
                .bindings
                .iter()
                .filter(|(g, ..)| *g == group)
                .map(|&(_, binding, ty)| wgpu::BindGroupLayoutEntry {
                    binding,
                    visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                    ty,
                    count: None,
                })
                .collect();
            let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(what), entries: &entries };
            device.device.create_bind_group_layout(&descriptor)
        })
        .collect();
    let layout = device.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(what),
        bind_group_layouts: &layouts.iter().map(Some).collect::<Vec<_>>(),
        immediate_size: 0,
    });
    let module = device.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(what),
        source: wgpu::ShaderSource::Wgsl(spec.wgsl.as_str().into()),
    });
    let attributes = spec.locations.iter().map(|&l| vertex_attribute(l)).collect::<Result<Vec<_>, _>>()?;
    let buffers: Vec<Option<wgpu::VertexBufferLayout<'_>>> = attributes
        .iter()
        .map(|attribute| {
            Some(wgpu::VertexBufferLayout {
                array_stride: attribute.format.size(),
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: std::slice::from_ref(attribute),
            })
        })
        .collect();
    let depth_stencil = (spec.depth != DepthUse::None).then(|| wgpu::DepthStencilState {
        format: TextureFormat::Depth32Float,
        depth_write_enabled: Some(spec.depth == DepthUse::Nearest),
        depth_compare: Some(match spec.depth {
            DepthUse::Nearest => wgpu::CompareFunction::Less,
            _ => wgpu::CompareFunction::Always,
        }),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    });
    let targets: Vec<Option<wgpu::ColorTargetState>> = spec.color.iter().map(|&format| Some(format.into())).collect();
    let pipeline = device.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(what),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vs_main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &buffers,
        },
        primitive: wgpu::PrimitiveState {
            front_face: if spec.mirrored { wgpu::FrontFace::Cw } else { wgpu::FrontFace::Ccw },
            cull_mode: match spec.culling {
                Culling::Nothing => None,
                Culling::Front => Some(wgpu::Face::Front),
                Culling::Back => Some(wgpu::Face::Back),
            },
            ..wgpu::PrimitiveState::default()
        },
        depth_stencil,
        multisample: wgpu::MultisampleState { count: spec.samples, ..wgpu::MultisampleState::default() },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fs_main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    });
    Ok(Pipeline { pipeline, layouts })
}

fn vertex_attribute(location: u32) -> Result<wgpu::VertexAttribute, RenderError> {
    const FORMATS: [(Attribute, wgpu::VertexFormat); 5] = [
        (Attribute::Position, wgpu::VertexFormat::Float32x3),
        (Attribute::Normal, wgpu::VertexFormat::Float32x3),
        (Attribute::Texcoord, wgpu::VertexFormat::Float32x2),
        (Attribute::Tangent, wgpu::VertexFormat::Float32x4),
        (Attribute::Color, wgpu::VertexFormat::Float32x4),
    ];
    let found = FORMATS.iter().find(|(a, _)| a.location() == location);
    let (_, format) = found.ok_or_else(|| RenderError::Job(format!("no vertex attribute has location {location}")))?;
    Ok(wgpu::VertexAttribute { format: *format, offset: 0, shader_location: location })
}

impl Pipeline {
    /// Bind groups of this pipeline, for `resources` by group and binding.
    pub(super) fn bind(
        &self,
        device: &Device,
        resources: &[(u32, u32, wgpu::BindingResource<'_>)],
    ) -> Vec<wgpu::BindGroup> {
        (0..)
            .zip(&self.layouts)
            .map(|(group, layout)| {
                let entries: Vec<wgpu::BindGroupEntry<'_>> = resources
                    .iter()
                    .filter(|(g, ..)| *g == group)
                    .map(|(_, binding, resource)| wgpu::BindGroupEntry {
                        binding: *binding,
                        resource: resource.clone(),
                    })
                    .collect();
                let descriptor = wgpu::BindGroupDescriptor { label: None, layout, entries: &entries };
                device.device.create_bind_group(&descriptor)
            })
            .collect()
    }

    /// Makes a pass use this pipeline with these groups.
    pub(super) fn set(&self, pass: &mut wgpu::RenderPass<'_>, groups: &[wgpu::BindGroup]) {
        pass.set_pipeline(&self.pipeline);
        for (index, group) in (0..).zip(groups) {
            pass.set_bind_group(index, group, &[]);
        }
    }
}

/// A uniform buffer, as a binding type.
pub(super) const UNIFORM: BindingType =
    BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };

/// A two-dimensional texture, as a binding type.
pub(super) const fn texture_type(sample_type: wgpu::TextureSampleType) -> BindingType {
    BindingType::Texture { sample_type, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }
}

/// An array of two-dimensional textures, as a binding type.
pub(super) const fn array_type(sample_type: wgpu::TextureSampleType) -> BindingType {
    BindingType::Texture { sample_type, view_dimension: wgpu::TextureViewDimension::D2Array, multisampled: false }
}
