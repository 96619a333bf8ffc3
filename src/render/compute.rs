//! Compute passes: every texel of an image is made by an invocation, and stored.

use naga::{ImageClass, ShaderStage, TypeInner};
use wgpu::{BindingType, TextureFormat};

use super::RenderError;
use super::device::Device;
use super::format::name_of;
use super::pipeline::{UNIFORM, texture_type};

/// Name of the entry point.
const ENTRY: &str = "cs_main";

/// Everything that the pipeline of a compute pass depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct ComputeSpec {
    /// Shader with `cs_main`.
    pub(super) wgsl: String,
    /// How binding 0 is read.
    pub(super) source: wgpu::TextureSampleType,
    /// Format of binding 1.
    pub(super) format: TextureFormat,
    /// Whether binding 2 is the light's view.
    pub(super) reads_light: bool,
    /// Whether binding 3 is a distance.
    pub(super) repeated: bool,
}

/// A compute pipeline with what is needed to run it.
pub(super) struct ComputePipeline {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    /// Texels that a workgroup makes, across and down.
    workgroup: [u32; 2],
}

/// Makes the pipeline of a spec; `what` names it in errors.
pub(super) fn build(device: &Device, what: &str, spec: &ComputeSpec) -> Result<ComputePipeline, RenderError> {
    let rejected = |message: String| RenderError::Rejected { what: what.to_owned(), message };
    let parsed = naga::front::wgsl::parse_str(&spec.wgsl).map_err(|e| rejected(e.emit_to_string(&spec.wgsl)))?;
    let workgroup = workgroup(&parsed).map_err(rejected)?;
    check_target(&parsed, spec.format).map_err(rejected)?;
    let stored = BindingType::StorageTexture {
        access: wgpu::StorageTextureAccess::WriteOnly,
        format: spec.format,
        view_dimension: wgpu::TextureViewDimension::D2,
    };
    let mut types = vec![(0, texture_type(spec.source)), (1, stored)];
    types.extend(spec.reads_light.then_some((2, UNIFORM)));
    types.extend(spec.repeated.then_some((3, UNIFORM)));
    let entries: Vec<wgpu::BindGroupLayoutEntry> = types
        .into_iter()
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty,
            count: None,
        })
        .collect();
    let layout = device
        .device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(what), entries: &entries });
    let pipeline_layout = device.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(what),
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let module = device.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(what),
        source: wgpu::ShaderSource::Wgsl(spec.wgsl.as_str().into()),
    });
    let pipeline = device.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(what),
        layout: Some(&pipeline_layout),
        module: &module,
        entry_point: Some(ENTRY),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    Ok(ComputePipeline { pipeline, layout, workgroup })
}

/// Width and height of the workgroups of `cs_main`.
fn workgroup(parsed: &naga::Module) -> Result<[u32; 2], String> {
    let entry = parsed.entry_points.iter().find(|e| e.name == ENTRY && e.stage == ShaderStage::Compute);
    match entry.map(|e| e.workgroup_size) {
        Some([x, y, 1]) if x > 0 && y > 0 => Ok([x, y]),
        Some(size) => Err(format!("workgroups of {size:?} do not lie flat on a picture")),
        None => Err(format!("there is no compute shader `{ENTRY}`")),
    }
}

/// Fails where binding 1 is not a texture of this format that is written.
fn check_target(parsed: &naga::Module, format: TextureFormat) -> Result<(), String> {
    let place = naga::ResourceBinding { group: 0, binding: 1 };
    let bound = parsed.global_variables.iter().find(|(_, v)| v.binding == Some(place));
    let found = bound.and_then(|(_, variable)| match parsed.types[variable.ty].inner {
        TypeInner::Image { class: ImageClass::Storage { format, .. }, .. } => {
            Some(format!("{format:?}").to_lowercase())
        }
        _ => None,
    });
    match found {
        Some(found) if found == name_of(format) => Ok(()),
        Some(found) => Err(format!("binding 1 is a texture of {found}, and the map is made in {}", name_of(format))),
        None => Err("binding 1 is no texture that is stored to".into()),
    }
}

/// What a compute pass binds.
#[derive(Clone, Copy)]
pub(super) struct Bound<'a> {
    pub(super) source: &'a wgpu::TextureView,
    pub(super) target: &'a wgpu::TextureView,
    pub(super) light: Option<&'a wgpu::Buffer>,
    pub(super) distance: Option<&'a wgpu::Buffer>,
}

impl ComputePipeline {
    /// Makes every texel of a square target.
    pub(super) fn run(
        &self,
        device: &Device,
        encoder: &mut wgpu::CommandEncoder,
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
        bound: Bound<'_>,
        side: u32,
    ) {
        let views = [(0, bound.source), (1, bound.target)];
        let buffers = [(2, bound.light), (3, bound.distance)];
        let views = views.map(|(binding, view)| (binding, wgpu::BindingResource::TextureView(view)));
        let buffers = buffers.into_iter().filter_map(|(binding, b)| Some((binding, b?.as_entire_binding())));
        let entries: Vec<wgpu::BindGroupEntry<'_>> = views
            .into_iter()
            .chain(buffers)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let group = device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.layout,
            entries: &entries,
        });
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("compute pass"), timestamp_writes });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        let [across, down] = self.workgroup;
        pass.dispatch_workgroups(side.div_ceil(across), side.div_ceil(down), 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(head: &str, target: &str) -> naga::Module {
        let text = format!(
            "@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var target_texture: {target};
{head}
fn cs_main(@builtin(global_invocation_id) id: vec3u) {{
    textureStore(target_texture, id.xy, textureLoad(source, id.xy, 0));
}}"
        );
        naga::front::wgsl::parse_str(&text).expect("sound")
    }

    #[test]
    fn workgroups_are_read_from_the_text() {
        let target = "texture_storage_2d<rg32float, write>";
        assert_eq!(workgroup(&parsed("@compute @workgroup_size(16, 4)", target)), Ok([16, 4]));
        assert_eq!(workgroup(&parsed("@compute @workgroup_size(64)", target)), Ok([64, 1]));
        let deep = workgroup(&parsed("@compute @workgroup_size(4, 4, 4)", target)).expect_err("deep");
        assert!(deep.contains("[4, 4, 4]"), "{deep}");
        let none = naga::front::wgsl::parse_str("@compute @workgroup_size(1) fn main() {}").expect("sound");
        assert!(workgroup(&none).expect_err("another name").contains("cs_main"));
    }

    #[test]
    fn the_format_in_the_text_is_the_one_that_is_made() {
        let parsed = parsed("@compute @workgroup_size(8, 8)", "texture_storage_2d<rg32float, write>");
        assert_eq!(check_target(&parsed, TextureFormat::Rg32Float), Ok(()));
        let other = check_target(&parsed, TextureFormat::Rgba16Float).expect_err("another format");
        assert!(other.contains("rg32float") && other.contains("rgba16float"), "{other}");
        let none = naga::front::wgsl::parse_str("@compute @workgroup_size(1) fn cs_main() {}").expect("sound");
        assert!(check_target(&none, TextureFormat::Rg32Float).is_err());
    }
}
