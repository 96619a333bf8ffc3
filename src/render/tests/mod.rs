//! Tests on whatever adapter there is, with modules and plans written by hand.

mod kept;
mod maps;
mod materials;
mod trouble;

use std::collections::BTreeMap;

use glam::{Mat4, Vec2, Vec3, Vec4};

use super::{AdapterOptions, ColorFormat, Draw, Frame, Gpu, Job, Picture, RenderError};
use crate::compile::Compiled;
use crate::module::{Attribute, Binding, FRAME_WGSL, Module, OBJECT_WGSL, Parameter, Resource};
use crate::plan::Plan;
use crate::scene::{Camera, Mesh};
use crate::semantic::{Shape, Value};

/// A device, or none with a note in the test's output where the machine has no adapter.
fn gpu() -> Option<Gpu> {
    let options = AdapterOptions { backends: std::env::var("WGPU_BACKEND").ok(), ..AdapterOptions::default() };
    match Gpu::new(&options) {
        Ok(gpu) => Some(gpu),
        Err(error @ RenderError::NoAdapter { .. }) => {
            use std::io::Write;
            // Straight to the terminal: captured output of a test that passes is not shown.
            let _ = writeln!(std::io::stderr(), "SKIPPED, {error}: {}", error.help().unwrap_or_default());
            None
        }
        Err(error) => panic!("{error}"),
    }
}

/// A square from -1 to 1 in x and y, facing +z.
fn square() -> Mesh {
    let corners = [Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0), Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0)];
    Mesh {
        positions: corners.iter().map(|c| c.extend(0.0)).collect(),
        normals: vec![Vec3::Z; 4],
        texcoords: corners.iter().map(|c| Vec2::new(c.x * 0.5 + 0.5, 0.5 - c.y * 0.5)).collect(),
        tangents: vec![Vec4::new(1.0, 0.0, 0.0, -1.0); 4],
        colors: vec![Vec4::ONE; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
    }
}

/// At distance 4 along +z, sees 4 by 4 metres of the plane z = 0.
fn camera() -> Camera {
    Camera {
        position: Vec3::new(0.0, 0.0, 4.0),
        target: Vec3::ZERO,
        up: Vec3::Y,
        fov_y: 2.0 * 0.5_f32.atan(),
        near: 0.1,
        far: 20.0,
    }
}

fn no_images(path: &str, _: &str) -> Result<Picture, String> {
    Err(format!("{path} was not expected"))
}

fn draw<'a>(mesh: &'a Mesh, shader: &'a Compiled) -> Draw<'a> {
    Draw { mesh, object_to_world: Mat4::IDENTITY, casts: true, receives: true, shader, values: BTreeMap::new() }
}

fn job<'a>(draws: Vec<Draw<'a>>) -> Job<'a> {
    Job {
        draws,
        camera: camera(),
        surroundings: None,
        size: (16, 16),
        samples: 1,
        time: 0.0,
        images: &no_images,
        output: ColorFormat::Float,
    }
}

fn binding(group: u32, binding: u32, name: &str, resource: Resource) -> Binding {
    Binding { group, binding, name: name.into(), resource }
}

fn parameter(path: &str, shape: Shape, offset: u32, value: &[f64]) -> Parameter {
    Parameter {
        path: path.into(),
        name: path.replace('.', "_"),
        shape,
        offset,
        meaning: String::new(),
        unit: String::new(),
        range: (None, None),
        default: Value::Numbers(value.to_vec()),
        value: Value::Numbers(value.to_vec()),
        doc: String::new(),
    }
}

/// A material with frame, object and whatever `bindings` say; `body` computes a `vec4f` from `in.world` and `in.uv`.
fn material(declarations: &str, body: &str, bindings: Vec<Binding>) -> Compiled {
    let wgsl = format!(
        "{FRAME_WGSL}{OBJECT_WGSL}
@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
{declarations}
struct Varying {{
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) uv: vec2f,
}}
@vertex
fn vs_main(@location(0) position: vec3f, @location(2) uv: vec2f) -> Varying {{
    let world = object.object_to_world * vec4f(position, 1.0);
    return Varying(frame.world_to_clip * world, world.xyz, uv);
}}
@fragment
fn fs_main(in: Varying) -> @location(0) vec4f {{
    {body}
}}
"
    );
    let mut all = vec![binding(0, 0, "frame", Resource::Frame), binding(1, 0, "object", Resource::Object)];
    all.extend(bindings);
    all.sort_by_key(|b| (b.group, b.binding));
    let module =
        Module { wgsl, bindings: all, attributes: vec![Attribute::Position, Attribute::Texcoord], ..Module::default() };
    Compiled { module, plan: Plan::default() }
}

/// A material of one colour, the parameter `paint.color`.
fn paint() -> Compiled {
    let mut shader = material(
        "struct Parameters { color: vec3f }\n@group(2) @binding(0) var<uniform> parameters: Parameters;",
        "return vec4f(parameters.color, 1.0);",
        vec![binding(2, 0, "parameters", Resource::Parameters)],
    );
    shader.module.parameters = vec![parameter("paint.color", Shape::F32(3), 0, &[0.25, 0.5, 0.75])];
    shader.module.parameter_bytes = 16;
    shader
}

fn pixel(frame: &Frame, x: u32, y: u32) -> [f32; 4] {
    frame.pixels[(y * frame.size.0 + x) as usize]
}

fn near(a: [f32; 4], b: [f32; 4]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 2e-3)
}
