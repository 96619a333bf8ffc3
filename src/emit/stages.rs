//! The vertex stage: only what the fragment stage reads is interpolated.

use super::body::{Tables, write_interpolated};
use super::names::Names;
use super::rates::Stages;
use super::text::Text;
use crate::module::Attribute;
use crate::program::{Program, Varying};

/// Name, type and value of an interpolated quantity.
pub(crate) fn varying(varying: Varying) -> (&'static str, &'static str, &'static str) {
    match varying {
        Varying::PositionWorld => ("position_world", "vec3f", "world.xyz"),
        Varying::PositionObject => ("position_object", "vec3f", "in.position"),
        Varying::NormalWorld => {
            ("normal_world", "vec3f", "normalize((vec4f(in.normal, 0.0) * object.world_to_object).xyz)")
        }
        Varying::NormalObject => ("normal_object", "vec3f", "in.normal"),
        Varying::TangentWorld => (
            "tangent_world",
            "vec4f",
            "vec4f(normalize((object.object_to_world * vec4f(in.tangent.xyz, 0.0)).xyz), in.tangent.w)",
        ),
        Varying::TangentObject => ("tangent_object", "vec4f", "in.tangent"),
        Varying::Texcoord => ("texcoord", "vec2f", "in.texcoord"),
        Varying::VertexColor => ("vertex_color", "vec4f", "in.color"),
    }
}

fn attribute(attribute: Attribute) -> (&'static str, &'static str) {
    match attribute {
        Attribute::Position => ("position", "vec3f"),
        Attribute::Normal => ("normal", "vec3f"),
        Attribute::Texcoord => ("texcoord", "vec2f"),
        Attribute::Tangent => ("tangent", "vec4f"),
        Attribute::Color => ("color", "vec4f"),
    }
}

pub(crate) fn write_vertex(
    text: &mut Text,
    attributes: &[Attribute],
    program: &Program,
    stages: &Stages,
    tables: &Tables<'_>,
    names: &Names,
) {
    let reached = &stages.fragment;
    text.blank();
    text.line("struct Vertex {");
    for a in attributes {
        let (name, ty) = attribute(*a);
        text.line(&format!("    @location({}) {name}: {ty},", a.location()));
    }
    text.line("}");
    text.blank();
    text.line("struct Varyings {");
    text.line("    @builtin(position) clip_position: vec4f,");
    for (location, v) in reached.varyings.iter().enumerate() {
        let (name, ty, _) = varying(*v);
        text.line(&format!("    @location({location}) {name}: {ty},"));
    }
    for (index, (name, shape)) in stages.interpolated.values().enumerate() {
        let location = reached.varyings.len() + index;
        text.line(&format!("    @location({location}) {name}: {},", shape.wgsl()));
    }
    text.line("}");
    text.blank();
    text.line("@vertex");
    text.line("fn vs_main(in: Vertex) -> Varyings {");
    text.line("    let world = object.object_to_world * vec4f(in.position, 1.0);");
    text.line("    var out: Varyings;");
    text.line("    out.clip_position = frame.world_to_clip * world;");
    for v in &reached.varyings {
        let (name, _, value) = varying(*v);
        text.line(&format!("    out.{name} = {value};"));
    }
    write_interpolated(text, program, stages, tables, names);
    text.line("    return out;");
    text.line("}");
}
