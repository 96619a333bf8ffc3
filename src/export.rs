//! A proven module in other shading languages, from the same naga module that was validated.
//!
//! Binding points follow from WGSL's and are stated in the reflection: SPIR-V keeps group and binding; HLSL uses the
//! group as space and the binding as register; MSL and GLSL, which have flat numbers, count as [`slots`] says.

use std::collections::BTreeMap;

use naga::ShaderStage;
use naga::back::{glsl, hlsl, msl, spv};
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};

use crate::diagnostic::{Diagnostic, Place};
use crate::verify::{Verified, on_large_stack};

/// A language to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// The WGSL as woven.
    Wgsl,
    /// SPIR-V 1.3 (Vulkan 1.1), binary, little-endian.
    Spirv,
    /// Metal Shading Language 2.4.
    Msl,
    /// HLSL for shader model 6.0.
    Hlsl,
    /// GLSL 4.50, or GLSL ES 3.10 for what that cannot say; one file per stage.
    Glsl,
}

/// One file of an export.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Extension, without the first dot: `metal`, `vert.glsl`.
    pub extension: &'static str,
    /// Content.
    pub bytes: Vec<u8>,
}

/// Where a resource is bound in languages with flat numbers: counted over the bindings of the module in the order of
/// group and binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// Index among all bindings: GLSL's `binding`.
    pub flat: u8,
    /// Index among the bindings of the same class (buffers, textures, samplers): MSL's.
    pub in_class: u8,
    /// Which class.
    pub class: Class,
}

/// Classes of resources that number apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Uniform buffers.
    Buffer,
    /// Textures.
    Texture,
    /// Samplers.
    Sampler,
}

/// All policies alike: reading outside an array or image gives some element of it, as WGSL promises.
const BOUNDS: BoundsCheckPolicies = BoundsCheckPolicies {
    index: BoundsCheckPolicy::Restrict,
    buffer: BoundsCheckPolicy::Restrict,
    image_load: BoundsCheckPolicy::Restrict,
    binding_array: BoundsCheckPolicy::Restrict,
};

impl Target {
    /// All targets, in the order of the documentation.
    pub const ALL: [Self; 5] = [Self::Wgsl, Self::Spirv, Self::Msl, Self::Hlsl, Self::Glsl];

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Spirv => "spirv",
            Self::Msl => "msl",
            Self::Hlsl => "hlsl",
            Self::Glsl => "glsl",
        }
    }

    /// Extensions that files of it have, the usual one first.
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Wgsl => &["wgsl"],
            Self::Spirv => &["spv"],
            Self::Msl => &["metal", "msl"],
            Self::Hlsl => &["hlsl"],
            Self::Glsl => &["glsl"],
        }
    }

    /// The target whose files have this extension.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|t| t.extensions().contains(&extension.to_ascii_lowercase().as_str()))
    }

    /// Whether its files are not text.
    pub const fn is_binary(self) -> bool {
        matches!(self, Self::Spirv)
    }
}

/// The bindings of a module with their flat numbers, by group and binding.
pub fn slots(module: &naga::Module) -> BTreeMap<(u32, u32), Slot> {
    let mut bound = BTreeMap::new();
    for (_, variable) in module.global_variables.iter() {
        let Some(binding) = variable.binding else { continue };
        let class = match module.types[variable.ty].inner {
            naga::TypeInner::Image { .. } => Class::Texture,
            naga::TypeInner::Sampler { .. } => Class::Sampler,
            _ => Class::Buffer,
        };
        bound.insert((binding.group, binding.binding), class);
    }
    let mut count: BTreeMap<Class, u8> = BTreeMap::new();
    let numbered = bound.into_iter().zip(0_u8..).map(|((point, class), flat)| {
        let next = count.entry(class).or_default();
        let slot = Slot { flat, in_class: *next, class };
        *next = next.saturating_add(1);
        (point, slot)
    });
    numbered.collect()
}

/// Writes a module in another language. `wgsl` is its text. The error says what that language cannot do.
pub fn export(verified: &Verified, wgsl: &str, target: Target) -> Result<Vec<File>, Box<Diagnostic>> {
    let one = |extension, bytes| vec![File { extension, bytes }];
    let written = on_large_stack(|| match target {
        Target::Wgsl => Ok(one("wgsl", wgsl.as_bytes().to_vec())),
        Target::Spirv => to_spirv(verified).map(|b| one("spv", b)),
        Target::Msl => to_msl(verified).map(|t| one("metal", t.into_bytes())),
        Target::Hlsl => to_hlsl(verified).map(|t| one("hlsl", t.into_bytes())),
        Target::Glsl => to_glsl(verified),
    });
    let fail = |message: String| {
        let message = format!("the module cannot be written as {}: {message}", target.name());
        Box::new(Diagnostic::error("ST0508", message, Place::default()).help("choose another --target"))
    };
    written.map_err(|_| fail("naga stopped unexpectedly".into()))?.map_err(fail)
}

fn to_spirv(verified: &Verified) -> Result<Vec<u8>, String> {
    let options = spv::Options {
        lang_version: (1, 3),
        // Said in full, as naga's default differs between debug and release builds.
        flags: spv::WriterFlags::ADJUST_COORDINATE_SPACE
            | spv::WriterFlags::LABEL_VARYINGS
            | spv::WriterFlags::CLAMP_FRAG_DEPTH,
        bounds_check_policies: BOUNDS,
        ..Default::default()
    };
    let words = spv::write_vec(&verified.module, &verified.info, &options, None).map_err(|e| e.to_string())?;
    Ok(words.into_iter().flat_map(u32::to_le_bytes).collect())
}

fn to_msl(verified: &Verified) -> Result<String, String> {
    let slots = slots(&verified.module);
    let resources: msl::BindingMap = slots
        .into_iter()
        .map(|((group, binding), slot)| {
            let of = |class| (slot.class == class).then_some(slot.in_class);
            let target = msl::BindTarget {
                buffer: of(Class::Buffer),
                texture: of(Class::Texture),
                sampler: of(Class::Sampler).map(msl::BindSamplerTarget::Resource),
                ..Default::default()
            };
            (naga::ResourceBinding { group, binding }, target)
        })
        .collect();
    let point =
        |name: &String| (name.clone(), msl::EntryPointResources { resources: resources.clone(), ..Default::default() });
    let options = msl::Options {
        lang_version: (2, 4),
        per_entry_point_map: verified.module.entry_points.iter().map(|e| point(&e.name)).collect(),
        fake_missing_bindings: false,
        bounds_check_policies: BOUNDS,
        ..Default::default()
    };
    let pipeline = msl::PipelineOptions::default();
    let written = msl::write_string(&verified.module, &verified.info, &options, &pipeline);
    written.map(|(text, _)| text).map_err(|e| e.to_string())
}

fn to_hlsl(verified: &Verified) -> Result<String, String> {
    let target = |space, register| hlsl::BindTarget { space, register, ..Default::default() };
    let mut options = hlsl::Options { shader_model: hlsl::ShaderModel::V6_0, ..Default::default() };
    options.fake_missing_bindings = false;
    for (group, binding) in slots(&verified.module).into_keys() {
        let space = u8::try_from(group).unwrap_or(u8::MAX);
        options.binding_map.insert(naga::ResourceBinding { group, binding }, target(space, binding));
        // Samplers are read from one heap through an index buffer per group, as Direct3D limits their number: the
        // buffer of a group is register t255 of its space, and holds the heap index at the sampler's binding.
        let key = hlsl::SamplerIndexBufferKey { group };
        options.sampler_buffer_binding_map.insert(key, target(space, 255));
    }
    // Two spaces that no group uses.
    options.sampler_heap_target =
        hlsl::SamplerHeapBindTargets { standard_samplers: target(254, 0), comparison_samplers: target(255, 0) };
    let pipeline = hlsl::PipelineOptions { entry_point: None };
    let mut text = String::new();
    let mut writer = hlsl::Writer::new(&mut text, &options, &pipeline);
    writer.write(&verified.module, &verified.info, None).map_err(|e| e.to_string())?;
    Ok(text)
}

fn to_glsl(verified: &Verified) -> Result<Vec<File>, String> {
    let mut files = Vec::new();
    for entry in &verified.module.entry_points {
        let extension = match entry.stage {
            ShaderStage::Vertex => "vert.glsl",
            ShaderStage::Fragment => "frag.glsl",
            _ => return Err(format!("`{}` is neither a vertex nor a fragment shader", entry.name)),
        };
        let desktop = glsl_stage(verified, entry, glsl::Version::Desktop(450));
        let text = match desktop {
            Ok(text) => text,
            Err(first) => glsl_stage(verified, entry, glsl::Version::new_gles(310))
                .map_err(|second| format!("GLSL 4.50: {first}; GLSL ES 3.10: {second}"))?,
        };
        files.push(File { extension, bytes: text.into_bytes() });
    }
    Ok(files)
}

fn glsl_stage(verified: &Verified, entry: &naga::EntryPoint, version: glsl::Version) -> Result<String, String> {
    let binding = |((group, binding), slot): ((u32, u32), Slot)| (naga::ResourceBinding { group, binding }, slot.flat);
    let options = glsl::Options {
        version,
        writer_flags: glsl::WriterFlags::ADJUST_COORDINATE_SPACE,
        binding_map: slots(&verified.module).into_iter().map(binding).collect(),
        zero_initialize_workgroup_memory: true,
    };
    let pipeline =
        glsl::PipelineOptions { shader_stage: entry.stage, entry_point: entry.name.clone(), multiview: None };
    let mut text = String::new();
    let writer = glsl::Writer::new(&mut text, &verified.module, &verified.info, &options, &pipeline, BOUNDS);
    writer.and_then(|mut w| w.write()).map_err(|e| e.to_string())?;
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::module::Module;
    use crate::verify::verify;

    const WGSL: &str = "
        struct Frame { world_to_clip: mat4x4f, list: array<vec4f, 9> }
        @group(0) @binding(0) var<uniform> frame: Frame;
        @group(2) @binding(1) var picture: texture_2d<f32>;
        @group(2) @binding(2) var picture_sampler: sampler;
        @group(3) @binding(0) var map: texture_depth_2d;
        @group(3) @binding(1) var map_sampler: sampler_comparison;
        struct Varying { @builtin(position) clip: vec4f, @location(0) uv: vec2f }
        @vertex fn vs_main(@location(0) p: vec3f, @location(2) uv: vec2f) -> Varying {
            return Varying(frame.world_to_clip * vec4f(p, 1.0), uv);
        }
        @fragment fn fs_main(v: Varying) -> @location(0) vec4f {
            let lit = textureSampleCompareLevel(map, map_sampler, v.uv, 0.5);
            let size = textureDimensions(picture);
            let texel = textureLoad(picture, vec2i(size) / 2, 0);
            return textureSample(picture, picture_sampler, v.uv) * lit + texel + frame.list[u32(v.uv.x)];
        }";

    fn write(target: Target) -> Vec<File> {
        let verified = verify(&Module { wgsl: WGSL.into(), ..Module::default() }).expect("valid");
        export(&verified, WGSL, target).expect("exportable")
    }

    fn text(file: &File) -> &str {
        std::str::from_utf8(&file.bytes).expect("text")
    }

    #[test]
    fn every_target_writes_both_stages() {
        for target in Target::ALL {
            let files = write(target);
            assert_eq!(files, write(target), "{} is deterministic", target.name());
            assert_eq!(files.len(), if target == Target::Glsl { 2 } else { 1 });
            assert_eq!(Target::of_extension(files[0].extension.rsplit('.').next().unwrap_or("")), Some(target));
        }
        assert_eq!(write(Target::Spirv)[0].bytes[..4], 0x0723_0203_u32.to_le_bytes());
    }

    #[test]
    fn binding_points_are_those_of_the_slots() {
        let verified = verify(&Module { wgsl: WGSL.into(), ..Module::default() }).expect("valid");
        let slots = slots(&verified.module);
        assert_eq!(slots[&(3, 0)], Slot { flat: 3, in_class: 1, class: Class::Texture });
        let msl = write(Target::Msl);
        assert!(text(&msl[0]).contains("map [[texture(1)]]"), "{}", text(&msl[0]));
        let hlsl = write(Target::Hlsl);
        assert!(text(&hlsl[0]).contains("register(t1, space2)"), "{}", text(&hlsl[0]));
        let glsl = write(Target::Glsl);
        let fragment = text(&glsl[1]);
        assert!(fragment.starts_with("#version 450") && fragment.contains("layout(binding = 3)"), "{fragment}");
    }
}
