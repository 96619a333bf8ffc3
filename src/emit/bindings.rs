//! Binding numbers: group 0 frame and surroundings, 1 object, 2 material, 3 lights.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::Reached;
use super::names::Names;
use crate::module::{Address, Binding, Resource as Bound, SamplerSettings};
use crate::program::{Program, Resource};

/// The bindings in use, and the variable of each resource.
pub(crate) fn bind(
    program: &Program,
    reached: &Reached,
    maps: &[(usize, usize)],
    parameters: bool,
    names: &mut Names,
) -> (Vec<Binding>, BTreeMap<Resource, String>) {
    let mut bindings = Vec::new();
    let mut variables = BTreeMap::new();
    let fixed = |group, name: &str, resource| Binding { group, binding: 0, name: name.to_owned(), resource };
    bindings.push(fixed(0, "frame", Bound::Frame));
    bindings.push(fixed(1, "object", Bound::Object));
    if parameters {
        bindings.push(fixed(2, "parameters", Bound::Parameters));
    }
    let mut next = [1, 1, u32::from(parameters), 0];
    let mut lights: Vec<(usize, u8, &Resource)> = Vec::new();
    let mut add = |group: usize, wanted: &str, resource: &Resource, bound: Bound, names: &mut Names| {
        let name = names.fresh(wanted);
        variables.insert(resource.clone(), name.clone());
        bindings.push(Binding { group: group as u32, binding: next[group], name, resource: bound });
        next[group] += 1;
    };
    for resource in &reached.resources {
        match resource {
            Resource::Environment => add(0, "environment", resource, Bound::Environment, names),
            Resource::EnvironmentSampler => add(0, "environment_sampler", resource, Bound::EnvironmentSampler, names),
            Resource::Image { path, base, srgb, name } => {
                let bound = Bound::Image { path: path.clone(), base: base.clone(), srgb: *srgb };
                add(2, name, resource, bound, names);
            }
            Resource::Sampler(settings) => {
                add(2, &sampler_name(settings), resource, Bound::Sampler(settings.clone()), names)
            }
            Resource::Space(light) => lights.push((*light, 0, resource)),
            Resource::Map(map) => lights.push((program.maps[*map].light, 1, resource)),
        }
    }
    lights.sort_by_key(|(light, order, resource)| (program.nodes[*light].id.clone(), *order, *resource));
    for (light, _, resource) in lights {
        let info = &program.nodes[light];
        match resource {
            Resource::Map(map) => {
                let index = maps.iter().find(|(old, _)| old == map).map_or(0, |(_, new)| *new);
                let bound = Bound::Map { index, ty: program.maps[*map].ty.clone() };
                // One map says whose it is; of several each says which shadow asked first.
                let several = maps.iter().filter(|(old, _)| program.maps[*old].light == light).count() > 1;
                let asked = &program.nodes[program.maps[*map].node].short;
                let name = if several { format!("{}_{asked}_map", info.short) } else { format!("{}_map", info.short) };
                add(3, &name, resource, bound, names);
            }
            _ => {
                let views = info.definition.header.space.as_ref().map_or(1, |s| s.views(&info.definition));
                add(
                    3,
                    &format!("{}_space", info.short),
                    resource,
                    Bound::Space { light: info.id.to_string(), views },
                    names,
                );
            }
        }
    }
    bindings.sort_by_key(|b| (b.group, b.binding));
    (bindings, variables)
}

/// `trilinear_clamp_sampler`, `nearest_comparison_sampler`, ...
fn sampler_name(settings: &SamplerSettings) -> String {
    let filter = match (settings.linear, settings.mip_linear) {
        (false, _) => "nearest",
        (true, false) => "linear",
        (true, true) => "trilinear",
    };
    if settings.compare {
        return format!("{filter}_comparison_sampler");
    }
    let address = match settings.address {
        Address::Repeat => "repeat",
        Address::Clamp => "clamp",
        Address::Mirror => "mirror",
    };
    let anisotropy =
        if settings.anisotropy > 1 { format!("_anisotropic{}", settings.anisotropy) } else { String::new() };
    format!("{filter}_{address}{anisotropy}_sampler")
}

/// The declaration of a binding's variable.
pub(crate) fn declaration(binding: &Binding) -> String {
    let (space, ty): (&str, Cow<'_, str>) = match &binding.resource {
        Bound::Frame => ("<uniform>", "Frame".into()),
        Bound::Object => ("<uniform>", "Object".into()),
        Bound::Parameters => ("<uniform>", "Parameters".into()),
        Bound::Space { views: 1, .. } => ("<uniform>", "LightSpace".into()),
        Bound::Space { views, .. } => ("<uniform>", format!("array<LightSpace, {views}>").into()),
        Bound::Map { ty, .. } => ("", ty.as_str().into()),
        Bound::Image { .. } | Bound::Environment => ("", "texture_2d<f32>".into()),
        Bound::Sampler(SamplerSettings { compare: true, .. }) => ("", "sampler_comparison".into()),
        Bound::Sampler(_) | Bound::EnvironmentSampler => ("", "sampler".into()),
    };
    format!("@group({}) @binding({}) var{space} {}: {ty};", binding.group, binding.binding, binding.name)
}
