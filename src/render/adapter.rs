//! Finding an adapter, and describing what it can do.

use super::RenderError;
use super::format::{self, Abilities};

/// Which adapter to render on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// The one that wgpu prefers.
    #[default]
    Any,
    /// A software adapter.
    Cpu,
    /// The first whose name contains this text, in any case.
    Name(String),
}

/// How to look for an adapter.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AdapterOptions {
    /// Which one.
    pub choice: AdapterChoice,
    /// Backends to look in, separated by commas (`vulkan`, `gl`, `metal`, `dx12`); all of them if none. Programs give
    /// the value of `WGPU_BACKEND` here.
    pub backends: Option<String>,
}

impl From<AdapterChoice> for AdapterOptions {
    fn from(choice: AdapterChoice) -> Self {
        Self { choice, backends: None }
    }
}

/// What is known of an adapter.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AdapterSummary {
    /// Name, as the driver gives it.
    pub name: String,
    /// Backend: `vulkan`, `gl`, `metal`, `dx12`.
    pub backend: String,
    /// Driver and its version.
    pub driver: String,
    /// `software`, `discrete`, `integrated`, `virtual` or `other`.
    pub kind: String,
    /// Whether it computes on the CPU: its timings say nothing about graphics cards.
    pub software: bool,
    /// Features that the renderer makes use of, by name, if the adapter has them.
    pub features: Vec<String>,
    /// Formats that maps are made in, each with what it can be used for.
    pub formats: Vec<(String, Abilities)>,
    /// Limits that bound a job, by name.
    pub limits: Vec<(String, u64)>,
}

impl std::fmt::Display for AdapterSummary {
    /// Name, driver and backend in one line; software adapters say so.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({}, {}", self.name, self.backend, self.kind)?;
        if !self.driver.is_empty() {
            write!(f, ", {}", self.driver)?;
        }
        f.write_str(")")
    }
}

/// Features that the renderer asks for where they are offered.
pub(super) fn wanted_features() -> wgpu::Features {
    wgpu::Features::FLOAT32_FILTERABLE
        | wgpu::Features::TIMESTAMP_QUERY
        | wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES
        | wgpu::Features::TEXTURE_FORMAT_16BIT_NORM
        | wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES
}

/// Every adapter of the machine, in the order that they are found.
pub fn adapters(options: &AdapterOptions) -> Result<Vec<AdapterSummary>, RenderError> {
    let backends = backends(options)?;
    let found = pollster::block_on(instance(backends).enumerate_adapters(backends));
    Ok(found.iter().map(summary).filter(|s| options.choice.accepts(s)).collect())
}

/// The adapter that the options ask for. GL is asked only where nothing else has one: merely loading its libraries makes
/// some of them write to stderr.
pub(super) fn find(options: &AdapterOptions) -> Result<wgpu::Adapter, RenderError> {
    let all = backends(options)?;
    let (first, last) = (all - wgpu::Backends::GL, all & wgpu::Backends::GL);
    let mut found = Vec::new();
    for backends in [first, last].into_iter().filter(|b| !b.is_empty()) {
        if let Some(adapter) = find_in(backends, &options.choice, &mut found) {
            return Ok(adapter);
        }
    }
    let wanted = match &options.choice {
        AdapterChoice::Any => options.backends.as_ref().map(|b| format!("backend {b}")),
        AdapterChoice::Cpu => Some("a software adapter".into()),
        AdapterChoice::Name(name) => Some(format!("the name `{name}`")),
    };
    Err(RenderError::NoAdapter { wanted, found })
}

/// The adapter of these backends that fits, or else the names of those that do not.
fn find_in(backends: wgpu::Backends, choice: &AdapterChoice, found: &mut Vec<String>) -> Option<wgpu::Adapter> {
    let instance = instance(backends);
    if *choice == AdapterChoice::Any {
        let request = instance.request_adapter(&wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        });
        return pollster::block_on(request).ok();
    }
    for adapter in pollster::block_on(instance.enumerate_adapters(backends)) {
        let summary = summary(&adapter);
        if choice.accepts(&summary) {
            return Some(adapter);
        }
        found.push(format!("`{}`", summary.name));
    }
    None
}

impl AdapterChoice {
    fn accepts(&self, summary: &AdapterSummary) -> bool {
        match self {
            Self::Any => true,
            Self::Cpu => summary.software,
            Self::Name(part) => summary.name.to_lowercase().contains(&part.to_lowercase()),
        }
    }
}

/// The backends that the options name.
fn backends(options: &AdapterOptions) -> Result<wgpu::Backends, RenderError> {
    let Some(list) = options.backends.as_deref().filter(|l| !l.trim().is_empty()) else {
        return Ok(wgpu::Backends::all());
    };
    let mut chosen = wgpu::Backends::empty();
    for word in list.split(',').map(|w| w.trim().to_lowercase()) {
        chosen |= match word.as_str() {
            "vulkan" | "vk" => wgpu::Backends::VULKAN,
            "gl" | "gles" | "opengl" => wgpu::Backends::GL,
            "metal" | "mtl" => wgpu::Backends::METAL,
            "dx12" | "d3d12" => wgpu::Backends::DX12,
            _ => return Err(RenderError::UnknownBackend(word)),
        };
    }
    Ok(chosen)
}

fn instance(backends: wgpu::Backends) -> wgpu::Instance {
    wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        // Debug builds would ask for validation layers, which are rarely installed; wgpu's own checks stay on.
        flags: wgpu::InstanceFlags::empty(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    })
}

/// Describes an adapter.
pub(super) fn summary(adapter: &wgpu::Adapter) -> AdapterSummary {
    let info = adapter.get_info();
    let features = adapter.features() & wanted_features();
    let limits = adapter.limits();
    let lower = info.name.to_lowercase();
    // GL drivers do not tell the type; these are the software rasterisers that exist.
    let software = info.device_type == wgpu::DeviceType::Cpu
        || ["llvmpipe", "softpipe", "swiftshader", "swrast"].iter().any(|n| lower.contains(n));
    let kind = match info.device_type {
        _ if software => "software",
        wgpu::DeviceType::DiscreteGpu => "discrete",
        wgpu::DeviceType::IntegratedGpu => "integrated",
        wgpu::DeviceType::VirtualGpu => "virtual",
        _ => "other",
    };
    let mut feature_names = Vec::new();
    for (flag, name) in [
        (wgpu::Features::FLOAT32_FILTERABLE, "float32-filterable"),
        (wgpu::Features::TIMESTAMP_QUERY, "timestamp-query"),
        (wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES, "timestamp-query-inside-passes"),
        (wgpu::Features::TEXTURE_FORMAT_16BIT_NORM, "texture-format-16bit-norm"),
        (wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES, "texture-adapter-specific-format-features"),
    ] {
        if features.contains(flag) {
            feature_names.push(name.to_owned());
        }
    }
    let downlevel = adapter.get_downlevel_capabilities().flags;
    for (flag, name) in [
        (wgpu::DownlevelFlags::ANISOTROPIC_FILTERING, "anisotropic-filtering"),
        (wgpu::DownlevelFlags::COMPARISON_SAMPLERS, "comparison-samplers"),
    ] {
        if downlevel.contains(flag) {
            feature_names.push(name.to_owned());
        }
    }
    AdapterSummary {
        name: info.name,
        backend: match info.backend {
            wgpu::Backend::Gl => "gl".to_owned(),
            other => format!("{other:?}").to_lowercase(),
        },
        driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
        kind: kind.to_owned(),
        software,
        features: feature_names,
        formats: format::NAMES
            .iter()
            .map(|(name, format)| ((*name).to_owned(), format::abilities(adapter, features, *format)))
            .collect(),
        limits: vec![
            ("max-texture-dimension-2d".into(), u64::from(limits.max_texture_dimension_2d)),
            ("max-uniform-buffer-binding-size".into(), limits.max_uniform_buffer_binding_size),
            ("max-buffer-size".into(), limits.max_buffer_size),
            ("max-sampled-textures-per-shader-stage".into(), u64::from(limits.max_sampled_textures_per_shader_stage)),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backend_lists_are_read_and_unknown_words_are_named() {
        let list = |text: &str| backends(&AdapterOptions { backends: Some(text.into()), ..Default::default() });
        assert_eq!(list("vulkan, GL"), Ok(wgpu::Backends::VULKAN | wgpu::Backends::GL));
        assert_eq!(list(""), Ok(wgpu::Backends::all()));
        assert_eq!(list("vulkan,glide"), Err(RenderError::UnknownBackend("glide".into())));
    }

    #[test]
    fn a_choice_compares_names_without_case() {
        let summary = AdapterSummary { name: "llvmpipe (LLVM)".into(), software: true, ..Default::default() };
        assert!(AdapterChoice::Name("LLVMPipe".into()).accepts(&summary));
        assert!(AdapterChoice::Cpu.accepts(&summary));
        assert!(!AdapterChoice::Name("radeon".into()).accepts(&summary));
    }

    #[test]
    fn a_machine_without_adapters_is_told_which_packages_help() {
        let error = RenderError::NoAdapter { wanted: None, found: Vec::new() };
        assert!(error.help().is_some_and(|h| h.contains("mesa-vulkan-drivers libvulkan1")));
    }
}
