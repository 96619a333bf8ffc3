//! What a host must know to run a module, as JSON: bindings, parameters, vertex attributes, lights and maps.

use serde_json::{Map, Value as Json, json};

use crate::compile::Compiled;
use crate::export::{Class, slots};
use crate::module::{Attribute, Binding, FRAME_BYTES, OBJECT_BYTES, Parameter, Resource, SamplerSettings};
use crate::plan::{Light, Pass, Plan};
use crate::semantic::Value;
use crate::verify::Verified;

/// Version of the JSON form; a change that breaks readers raises it.
pub const SCHEMA: u32 = 1;

/// The reflection of a module and its plan. Offsets and sizes are bytes; values are in the unit that is named, and
/// `deg` is converted to radians when a value is stored.
pub fn reflect(compiled: &Compiled, verified: &Verified) -> Json {
    let module = &compiled.module;
    let slots = slots(&verified.module);
    let bindings = module.bindings.iter().map(|b| {
        let mut entry = binding(b, module.parameter_bytes);
        if let Some(slot) = slots.get(&(b.group, b.binding)) {
            let class = match slot.class {
                Class::Buffer => "buffer",
                Class::Texture => "texture",
                Class::Sampler => "sampler",
            };
            entry.insert("msl".into(), json!({ "class": class, "index": slot.in_class }));
            entry.insert("glsl".into(), json!({ "binding": slot.flat }));
            entry.insert("hlsl".into(), json!({ "space": b.group, "register": b.binding }));
        }
        Json::Object(entry)
    });
    json!({
        "schema": SCHEMA,
        "entry_points": { "vertex": "vs_main", "fragment": "fs_main" },
        "bindings": bindings.collect::<Vec<_>>(),
        "parameter_bytes": module.parameter_bytes,
        "parameters": module.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "attributes": module.attributes.iter().map(|a| attribute(*a)).collect::<Vec<_>>(),
        "plan": plan(&compiled.plan),
    })
}

fn binding(binding: &Binding, parameter_bytes: u32) -> Map<String, Json> {
    let resource = match &binding.resource {
        Resource::Frame => json!({ "kind": "frame", "bytes": FRAME_BYTES }),
        Resource::Object => json!({ "kind": "object", "bytes": OBJECT_BYTES }),
        Resource::Parameters => json!({ "kind": "parameters", "bytes": parameter_bytes }),
        Resource::Image { path, base, srgb } => {
            json!({ "kind": "image", "path": path, "relative_to": base, "srgb": srgb })
        }
        Resource::Sampler(settings) => sampler(settings),
        Resource::Space { light, views } => {
            json!({ "kind": "space", "light": light, "views": views, "bytes": 128 * views })
        }
        Resource::Map { index, ty } => json!({ "kind": "map", "map": index, "type": ty }),
        Resource::Environment => json!({ "kind": "environment" }),
        Resource::EnvironmentSampler => json!({ "kind": "environment_sampler" }),
    };
    let mut entry = Map::new();
    entry.insert("group".into(), binding.group.into());
    entry.insert("binding".into(), binding.binding.into());
    entry.insert("name".into(), binding.name.clone().into());
    entry.insert("resource".into(), resource);
    entry
}

fn sampler(settings: &SamplerSettings) -> Json {
    let address = match settings.address {
        crate::module::Address::Repeat => "repeat",
        crate::module::Address::Clamp => "clamp",
        crate::module::Address::Mirror => "mirror",
    };
    json!({
        "kind": "sampler",
        "filter": if settings.linear { "linear" } else { "nearest" },
        "mip_filter": if settings.mip_linear { "linear" } else { "nearest" },
        "address": address,
        "anisotropy": settings.anisotropy,
        "compare": settings.compare.then_some("less-equal"),
    })
}

fn parameter(parameter: &Parameter) -> Json {
    json!({
        "path": parameter.path,
        "name": parameter.name,
        "type": parameter.shape.wgsl(),
        "offset": parameter.offset,
        "meaning": parameter.meaning,
        "unit": parameter.unit,
        "range": [parameter.range.0, parameter.range.1],
        "default": value(&parameter.default),
        "value": value(&parameter.value),
        "doc": parameter.doc,
    })
}

fn value(value: &Value) -> Json {
    match value {
        Value::Bool(b) => json!(b),
        Value::Numbers(n) if n.len() == 1 => json!(n[0]),
        Value::Numbers(n) => json!(n),
        Value::Text(t) => json!(t),
    }
}

fn attribute(attribute: Attribute) -> Json {
    let (name, format) = match attribute {
        Attribute::Position => ("position", "float32x3"),
        Attribute::Normal => ("normal", "float32x3"),
        Attribute::Texcoord => ("texcoord", "float32x2"),
        Attribute::Tangent => ("tangent", "float32x4"),
        Attribute::Color => ("color", "float32x4"),
    };
    json!({ "name": name, "location": attribute.location(), "format": format })
}

fn pass(pass: &Pass) -> Json {
    json!({
        "name": pass.name,
        "kind": pass.kind.name(),
        "options": pass.choices,
        "formats": pass.targets,
        "clear": pass.clear,
        "light": pass.reads_light,
        "repeat": pass.repeat,
        "otherwise": pass.otherwise.as_deref().map(self::pass),
        "wgsl": pass.wgsl,
    })
}

fn plan(plan: &Plan) -> Json {
    let light = |light: &Light| {
        let space = light.space.as_ref().map(|s| json!({ "projection": s.projection, "inputs": s.inputs }));
        json!({ "name": light.name, "space": space })
    };
    let maps = plan.maps.iter().map(|map| {
        let passes: Vec<Json> = map.passes.iter().map(pass).collect();
        json!({ "light": map.light, "size": map.size(), "filtered": map.filtered, "passes": passes })
    });
    json!({
        "lights": plan.lights.iter().map(light).collect::<Vec<_>>(),
        "maps": maps.collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::module::Module;
    use crate::semantic::Shape;
    use crate::verify::verify;

    #[test]
    fn parameters_say_what_a_host_needs() {
        let wgsl = "struct P { outer: f32 } @group(2) @binding(0) var<uniform> p: P;
            @fragment fn fs_main() -> @location(0) vec4f { return vec4f(p.outer); }";
        let parameter = Parameter {
            path: "spot.outer_angle".into(),
            name: "outer".into(),
            shape: Shape::F32(1),
            offset: 0,
            meaning: "angle".into(),
            unit: "deg".into(),
            range: (Some(0.0), None),
            default: Value::Numbers(vec![30.0]),
            value: Value::Numbers(vec![20.0]),
            doc: "Half the opening.".into(),
        };
        let binding = Binding { group: 2, binding: 0, name: "p".into(), resource: Resource::Parameters };
        let module = Module {
            wgsl: wgsl.into(),
            bindings: vec![binding],
            parameters: vec![parameter],
            parameter_bytes: 16,
            attributes: vec![Attribute::Tangent],
            ..Module::default()
        };
        let verified = verify(&module).expect("valid");
        let json = reflect(&Compiled { module, plan: Plan::default() }, &verified);
        assert_eq!(json["bindings"][0]["resource"], json!({ "kind": "parameters", "bytes": 16 }));
        assert_eq!(json["bindings"][0]["msl"], json!({ "class": "buffer", "index": 0 }));
        assert_eq!(json["parameters"][0]["range"], json!([0.0, null]));
        assert_eq!(json["parameters"][0]["value"], json!(20.0));
        assert_eq!(json["attributes"][0]["location"], json!(3));
    }
}
