//! Where a light's maps are made: a rigid frame and a projection, from parameters and the extent of the scene.

use glam::{Mat4, Vec3, Vec4};

use super::RenderError;
use crate::module::{Module, Parameter};
use crate::plan::Light;
use crate::semantic::Value;

/// A light's view of the scene, laid out as the WGSL `LightSpace` (96 bytes). Lengths are metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSpace {
    /// Rigid: the light at the origin, looking along +z, +y up.
    pub world_to_light: Mat4,
    /// ndc.xy = projection.xy * light.xy / (perspective ? light.z : 1); z is 1 for perspective, 0 for parallel light.
    pub projection: Vec4,
    /// near, far, 1 / (far - near), 0.
    pub depth: Vec4,
}

/// Size of a [`LightSpace`] in a uniform buffer.
pub const LIGHT_SPACE_BYTES: u64 = 96;

impl LightSpace {
    /// As the shader reads it.
    pub fn to_bytes(&self) -> Vec<u8> {
        let columns = self.world_to_light.to_cols_array();
        let rest = self.projection.to_array().into_iter().chain(self.depth.to_array());
        columns.into_iter().chain(rest).flat_map(f32::to_le_bytes).collect()
    }
}

/// Boxes around the objects of a scene, as their corners in world space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bounds {
    corners: Vec<[Vec3; 8]>,
}

impl Bounds {
    /// Adds the box around `positions` (object space), placed by `object_to_world`.
    pub fn add(&mut self, positions: &[Vec3], object_to_world: Mat4) {
        let finite = || positions.iter().copied().filter(|p| p.is_finite());
        let Some(low) = finite().reduce(Vec3::min) else {
            return;
        };
        let high = finite().fold(low, Vec3::max);
        let corners: [Vec3; 8] = std::array::from_fn(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 1 { high[axis] } else { low[axis] }
            };
            object_to_world.transform_point3(Vec3::new(pick(0), pick(1), pick(2)))
        });
        if corners.iter().all(|c| c.is_finite()) {
            self.corners.push(corners);
        }
    }

    /// A ball around everything: centre and radius. A scene without anything has the unit ball.
    pub fn ball(&self) -> (Vec3, f32) {
        let all = || self.corners.iter().flatten().copied();
        let Some(low) = all().reduce(Vec3::min) else {
            return (Vec3::ZERO, 1.0);
        };
        let center = (low + all().fold(low, Vec3::max)) * 0.5;
        (center, all().map(|c| c.distance(center)).fold(0.0, f32::max))
    }

    /// Least and greatest z, in a frame, of what lies in the column |x|, |y| <= `radius` of that frame. Both are 0 where
    /// the column is empty.
    fn depth_in_column(&self, world_to_frame: Mat4, radius: f32) -> (f32, f32) {
        let mut range: Option<(f32, f32)> = None;
        for corners in &self.corners {
            let corners = corners.map(|c| world_to_frame.transform_point3(c));
            for face in FACES {
                for point in clip_to_column(face.iter().map(|i| corners[*i]).collect(), radius) {
                    let (low, high) = range.unwrap_or((point.z, point.z));
                    range = Some((low.min(point.z), high.max(point.z)));
                }
            }
        }
        range.unwrap_or_default()
    }
}

/// The faces of a box by the numbers of their corners, around each face.
const FACES: [[usize; 4]; 6] = [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]];

/// The part of a convex polygon with |x|, |y| <= `radius` (Sutherland and Hodgman 1974).
fn clip_to_column(mut polygon: Vec<Vec3>, radius: f32) -> Vec<Vec3> {
    for side in [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y] {
        let inside = |p: Vec3| radius - p.dot(side);
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let (a, b) = (inside(from), inside(to));
            if a >= 0.0 {
                kept.push(from);
            }
            if (a >= 0.0) != (b >= 0.0) {
                kept.push(from.lerp(to, a / (a - b)));
            }
        }
        polygon = kept;
    }
    polygon
}

/// The space of a light with a projection, from the values of its parameters.
pub fn light_space(
    light: &Light,
    module: &Module,
    value_of: &dyn Fn(&Parameter) -> Option<Value>,
    bounds: &Bounds,
) -> Result<LightSpace, RenderError> {
    let space = light
        .space
        .as_ref()
        .ok_or_else(|| RenderError::Job(format!("light `{}` has maps but no projection", light.name)))?;
    let inputs = Inputs { paths: &space.inputs, module, value_of };
    match space.projection.as_str() {
        "perspective" => perspective(&inputs),
        "orthographic" => orthographic(&inputs, bounds),
        other => Err(RenderError::Job(format!("light `{}`: `{other}` is not a projection", light.name))),
    }
}

/// The parameters that define a projection, in the order of [`crate::plan::Space`].
struct Inputs<'a> {
    paths: &'a [String],
    module: &'a Module,
    value_of: &'a dyn Fn(&Parameter) -> Option<Value>,
}

impl Inputs<'_> {
    fn path(&self, index: usize) -> Result<&str, RenderError> {
        let path = self.paths.get(index).map(String::as_str);
        path.ok_or_else(|| RenderError::Job(format!("a projection lacks its input number {}", index + 1)))
    }

    /// The components of an input, in the units of the shader, all finite.
    fn numbers<const N: usize>(&self, index: usize) -> Result<[f64; N], RenderError> {
        let path = self.path(index)?;
        let parameter = self
            .module
            .parameters
            .iter()
            .find(|p| p.path == path)
            .ok_or_else(|| self.refuse(index, "a light that makes maps needs a plain value here"))?;
        let value = (self.value_of)(parameter).filter(|v| v.fits(&parameter.shape));
        let stored = parameter.stored(value.as_ref().unwrap_or(&parameter.value));
        let numbers: [f64; N] =
            stored.try_into().map_err(|_| self.refuse(index, &format!("{N} components are needed")))?;
        if numbers.iter().all(|x| x.is_finite() && x.abs() < 1e12) {
            Ok(numbers)
        } else {
            Err(self.refuse(index, "the value is not finite"))
        }
    }

    fn number(&self, index: usize) -> Result<f32, RenderError> {
        self.numbers::<1>(index).map(|[x]| narrow(x))
    }

    fn vector(&self, index: usize) -> Result<Vec3, RenderError> {
        self.numbers::<3>(index).map(|v| Vec3::from_array(v.map(narrow)))
    }

    fn axis(&self, index: usize) -> Result<Vec3, RenderError> {
        self.vector(index)?.try_normalize().ok_or_else(|| self.refuse(index, "a direction cannot have length zero"))
    }

    fn refuse(&self, index: usize, message: &str) -> RenderError {
        RenderError::Parameter { path: self.paths.get(index).cloned().unwrap_or_default(), message: message.to_owned() }
    }
}

#[allow(clippy::cast_possible_truncation, reason = "shaders compute in f32")]
fn narrow(x: f64) -> f32 {
    x as f32
}

/// Half the opening of a cone that a flat map can hold: beyond 89 degrees the map would be hundreds of times as wide as
/// its distance.
const OUTER_ANGLE: std::ops::RangeInclusive<f32> = 0.000_1..=1.553_343;

fn perspective(inputs: &Inputs<'_>) -> Result<LightSpace, RenderError> {
    let position = inputs.vector(0)?;
    let axis = inputs.axis(1)?;
    let half_angle = inputs.number(2)?;
    let near = inputs.number(3)?;
    let far = inputs.number(4)?;
    if !OUTER_ANGLE.contains(&half_angle) {
        return Err(inputs.refuse(2, "the cone of a light with maps must be between 0 and 89 degrees"));
    }
    if near <= 0.0 {
        return Err(inputs.refuse(3, "maps must begin in front of the light"));
    }
    if far <= near {
        return Err(inputs.refuse(4, "maps must end behind where they begin"));
    }
    let focal = half_angle.tan().recip();
    Ok(LightSpace {
        world_to_light: look_along(position, axis),
        projection: Vec4::new(focal, focal, 1.0, 0.0),
        depth: depth_range(near, far),
    })
}

fn orthographic(inputs: &Inputs<'_>, bounds: &Bounds) -> Result<LightSpace, RenderError> {
    let axis = inputs.axis(0)?;
    let mut center = inputs.vector(1)?;
    let mut radius = inputs.number(2)?;
    if radius < 0.0 {
        return Err(inputs.refuse(2, "a radius cannot be negative"));
    }
    if radius == 0.0 {
        (center, radius) = bounds.ball();
    }
    // A scene of one point still has an extent to divide by.
    let radius = radius.max(1e-6);
    let (low, high) = bounds.depth_in_column(look_along(center, axis), radius);
    // A margin keeps surfaces at both ends inside, whatever rounding does to them.
    let margin = (high - low).max(radius) * 1e-3;
    let origin = center + axis * (low - margin);
    let focal = radius.recip();
    Ok(LightSpace {
        world_to_light: look_along(origin, axis),
        projection: Vec4::new(focal, focal, 0.0, 0.0),
        depth: depth_range(0.0, high - low + 2.0 * margin),
    })
}

fn depth_range(near: f32, far: f32) -> Vec4 {
    Vec4::new(near, far, (far - near).recip(), 0.0)
}

/// World to a frame at `origin` whose +z is the unit vector `axis` and whose +y is as near to world +y as can be.
fn look_along(origin: Vec3, axis: Vec3) -> Mat4 {
    // Straight up or down has no nearest: world -z or +z then takes the place of up, continuously with a slight tilt.
    let up = if axis.y.abs() > 0.9999 { Vec3::new(0.0, 0.0, -axis.y.signum()) } else { Vec3::Y };
    let x = up.cross(axis).normalize();
    let y = axis.cross(x);
    let rotation = Mat4::from_cols(
        Vec4::new(x.x, y.x, axis.x, 0.0),
        Vec4::new(x.y, y.y, axis.y, 0.0),
        Vec4::new(x.z, y.z, axis.z, 0.0),
        Vec4::W,
    );
    rotation * Mat4::from_translation(-origin)
}

#[cfg(test)]
#[path = "light_space_tests.rs"]
mod tests;
