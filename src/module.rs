//! A woven shader: WGSL text with everything a renderer must know to run it, and nothing about graphs or nodes. (interface)

use std::sync::Arc;

use crate::semantic::{Shape, Value};

/// WGSL with its interface. Entry points are `vs_main` and `fs_main`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Module {
    /// The text.
    pub wgsl: String,
    /// Bindings in use, sorted by group and binding.
    pub bindings: Vec<Binding>,
    /// Members of the parameter block, in the order of their offsets.
    pub parameters: Vec<Parameter>,
    /// Size of the parameter block in bytes, a multiple of 16; 0 if there is none.
    pub parameter_bytes: u32,
    /// Vertex attributes in use, sorted by location.
    pub attributes: Vec<Attribute>,
    /// Which bytes of `wgsl` come from where, sorted by start; inner ranges follow outer ones.
    pub source_map: Vec<Origin>,
}

/// A resource at a binding point.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Bind group: 0 frame, 1 object, 2 material, 3 lights.
    pub group: u32,
    /// Binding in the group.
    pub binding: u32,
    /// WGSL name of the variable.
    pub name: String,
    /// What to bind.
    pub resource: Resource,
}

/// What a binding holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Resource {
    /// Uniform [`FRAME_BYTES`]: see [`FRAME_WGSL`].
    Frame,
    /// Uniform [`OBJECT_BYTES`]: see [`OBJECT_WGSL`].
    Object,
    /// Uniform with the members of [`Module::parameters`].
    Parameters,
    /// `texture_2d<f32>` from an image file.
    Image {
        /// Path as the graph gives it.
        path: String,
        /// File that mentions it, for relative paths; empty if unknown.
        base: String,
        /// Whether its bytes are sRGB-encoded and decoded on reading.
        srgb: bool,
    },
    /// A sampler.
    Sampler(SamplerSettings),
    /// Uniform `LightSpace` (128 bytes) of the light with this name in the plan, or an array of one for each of its views.
    Space {
        /// Name in the plan.
        light: String,
        /// Number of views; 1 is no array.
        views: u32,
    },
    /// Map with this index in the plan, one layer per view.
    Map {
        /// Index in the plan.
        index: usize,
        /// WGSL type: `texture_depth_2d_array`, or `texture_2d_array` of `f32` or `u32`.
        ty: String,
    },
    /// `texture_2d<f32>`: equirectangular surroundings, rougher with each mip level. +y is the top row; the middle of
    /// the picture is -z.
    Environment,
    /// A trilinear sampler that repeats along u and clamps along v.
    EnvironmentSampler,
}

/// The frame block, as every module that uses it declares it. Environment irradiance: coefficients in rgb, order
/// 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2 of real spherical harmonics, already convolved with the cosine lobe and
/// multiplied by the basis constants, so that irradiance(n) is the plain sum of coefficient times polynomial.
pub const FRAME_WGSL: &str = "struct Frame {
    world_to_clip: mat4x4f,
    world_to_view: mat4x4f,
    camera_position: vec3f,
    time: f32,
    camera_forward: vec3f,
    environment_levels: f32,
    environment_irradiance: array<vec4f, 9>,
}
";
/// Size of the frame block.
pub const FRAME_BYTES: u64 = 304;
/// The object block, as every module that uses it declares it. `receives` is 1 where the object receives shadows.
pub const OBJECT_WGSL: &str = "struct Object {
    object_to_world: mat4x4f,
    world_to_object: mat4x4f,
    receives: f32,
}
";
/// Size of the object block.
pub const OBJECT_BYTES: u64 = 144;

/// How a texture is sampled.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SamplerSettings {
    /// Interpolate between texels.
    pub linear: bool,
    /// Interpolate between mip levels.
    pub mip_linear: bool,
    /// What lies outside.
    pub address: Address,
    /// Anisotropy limit, 1 to 16.
    pub anisotropy: u16,
    /// A comparison sampler: 1 where the reference is less than or equal to the stored depth.
    pub compare: bool,
}

/// What lies outside a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Address {
    /// The texture again.
    Repeat,
    /// Its border texels.
    Clamp,
    /// The texture mirrored.
    Mirror,
}

/// A member of the parameter block: a value that can change without a new pipeline.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// `node.port`, or `graph/node.port` if there are several graphs.
    pub path: String,
    /// WGSL member name; in a block of hundreds with its group before it: `group_2.noise_scale`.
    pub name: String,
    /// Shape in WGSL. A `bool` is carried as `u32`.
    pub shape: Shape,
    /// Byte offset in the block.
    pub offset: u32,
    /// What it means, in words.
    pub meaning: String,
    /// Unit of values in files; `deg` is converted to radians when packed.
    pub unit: String,
    /// Inclusive limits per component, in the unit of files.
    pub range: (Option<f64>, Option<f64>),
    /// The node's default, in the unit of files.
    pub default: Value,
    /// The graph's value, in the unit of files.
    pub value: Value,
    /// What it does.
    pub doc: String,
}

/// A vertex attribute.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Attribute {
    /// Location 0, `vec3f`: object-space position.
    Position,
    /// Location 1, `vec3f`: object-space unit normal.
    Normal,
    /// Location 2, `vec2f`: texture coordinate, v down.
    Texcoord,
    /// Location 3, `vec4f`: object-space unit tangent, and the sign of the bitangent.
    Tangent,
    /// Location 4, `vec4f`: linear colour.
    Color,
}

impl Attribute {
    /// Shader location.
    pub const fn location(self) -> u32 {
        self as u32
    }
}

/// A byte range of the text and what it comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
    /// Node name (as in the plan and in parameter paths).
    pub node: Arc<str>,
    /// Port of the node, if the range belongs to one.
    pub port: Option<Arc<str>>,
}

impl Module {
    /// Names of the nodes that a byte of the text comes from, innermost first, with the port if known.
    pub fn origin_of(&self, byte: usize) -> Option<&Origin> {
        self.source_map.iter().filter(|o| o.start <= byte && byte < o.end).min_by_key(|o| o.end - o.start)
    }

    /// The parameter with this path, or the only one whose path ends in `/path`.
    pub fn parameter(&self, path: &str) -> Option<&Parameter> {
        if let Some(exact) = self.parameters.iter().find(|p| p.path == path) {
            return Some(exact);
        }
        let suffix = format!("/{path}");
        let mut ending = self.parameters.iter().filter(|p| p.path.ends_with(&suffix));
        ending.next().filter(|_| ending.next().is_none())
    }

    /// The bytes of the parameter block, with `value_of` asked for each parameter first and its own value used
    /// where that gives none or one that does not fit.
    pub fn pack(&self, value_of: &dyn Fn(&Parameter) -> Option<Value>) -> Vec<u8> {
        let mut bytes = vec![0; self.parameter_bytes as usize];
        for parameter in &self.parameters {
            let value = value_of(parameter).filter(|v| v.fits(&parameter.shape));
            parameter.write(value.as_ref().unwrap_or(&parameter.value), &mut bytes);
        }
        bytes
    }
}

impl Parameter {
    /// The numbers that the shader sees: one per component, `deg` as radians, `srgb` decoded, booleans as 0 or 1.
    pub fn stored(&self, value: &Value) -> Vec<f64> {
        stored(value, &self.shape, &self.unit)
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "parameters are f32, i32 or u32 by type"
    )]
    fn write(&self, value: &Value, bytes: &mut [u8]) {
        let side = match self.shape {
            Shape::Matrix(n) => usize::from(n),
            _ => usize::MAX,
        };
        for (i, x) in self.stored(value).into_iter().enumerate() {
            // Columns of a matrix with two or three rows start every 8 or 16 bytes.
            let stride = if side == 2 { 8 } else { 16 };
            let at = self.offset as usize + if side == usize::MAX { 4 * i } else { i / side * stride + 4 * (i % side) };
            let word = match self.shape {
                Shape::I32 => (x as i32).to_le_bytes(),
                Shape::U32 | Shape::Bool => (x as u32).to_le_bytes(),
                _ => (x as f32).to_le_bytes(),
            };
            if let Some(slot) = bytes.get_mut(at..at + 4) {
                slot.copy_from_slice(&word);
            }
        }
    }
}

/// The numbers that a shader sees for a value of this shape given in this unit.
pub(crate) fn stored(value: &Value, shape: &Shape, unit: &str) -> Vec<f64> {
    let scale = if unit == "deg" { std::f64::consts::PI / 180.0 } else { 1.0 };
    let count = match shape {
        Shape::F32(n) => usize::from(*n),
        Shape::Matrix(n) => usize::from(*n).pow(2),
        _ => 1,
    };
    match value {
        Value::Bool(b) => vec![f64::from(u8::from(*b))],
        Value::Numbers(n) if unit == "srgb" => {
            let spread = |i: usize| if n.len() == 1 && i < 3 { n[0] } else { n.get(i).copied().unwrap_or(1.0) };
            // Alpha is a share, not a colour.
            (0..count).map(|i| if i < 3 { linear_from_srgb(spread(i)) } else { spread(i) }).collect()
        }
        Value::Numbers(n) if n.len() == 1 => vec![n[0] * scale; count],
        Value::Numbers(n) => n.iter().map(|x| x * scale).collect(),
        Value::Text(_) => vec![0.0; count],
    }
}

/// The sRGB transfer curve, decoded (IEC 61966-2-1).
pub(crate) fn linear_from_srgb(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}
