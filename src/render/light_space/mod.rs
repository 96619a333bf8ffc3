//! Where a light's maps are made: a rigid frame and a projection for each view, from parameters and the extent of the
//! scene.

mod bounds;
mod eye;
mod splits;
mod warp;

use glam::{Mat4, Vec3, Vec4};

use super::RenderError;
use crate::module::{Module, Parameter};
use crate::plan::Light;
use crate::semantic::Value;

pub use bounds::Bounds;
pub use eye::Eye;

/// One view that a light has of the scene, laid out as the WGSL `LightSpace` (128 bytes). Lengths are metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSpace {
    /// Rigid: the light at the origin, looking along +z, +y up.
    pub world_to_light: Mat4,
    /// ndc.xy = projection.xy * light.xy / (perspective ? light.z : 1); z is 1 for perspective, 0 for parallel light;
    /// w is the layer of the light's maps.
    pub projection: Vec4,
    /// near, far, 1 / (far - near), and the distance from the eye up to which this view is used.
    pub depth: Vec4,
    /// Half size of the shining surface along x and y, in metres for perspective, as tangents of angles for parallel
    /// light; z is 1 for an ellipse and 0 for a rectangle; w is texels per metre over those of the coarsest view.
    pub source: Vec4,
    /// x is the strength of the warp of a light-space perspective shadow map, between -1 and 1.
    pub warp: Vec4,
}

/// Size of a [`LightSpace`] in a uniform buffer.
pub const LIGHT_SPACE_BYTES: u64 = 128;

impl LightSpace {
    /// As the shader reads it.
    pub fn to_bytes(&self) -> Vec<u8> {
        let columns = self.world_to_light.to_cols_array();
        let rest = [self.projection, self.depth, self.source, self.warp].into_iter().flat_map(|v| v.to_array());
        columns.into_iter().chain(rest).flat_map(f32::to_le_bytes).collect()
    }
}

/// Everything that the views of a light may depend on besides its parameters.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// What there is to see.
    pub bounds: &'a Bounds,
    /// Who looks at it.
    pub eye: &'a Eye,
    /// Texels on a side of the light's smallest map.
    pub side: u32,
}

/// The views of a light with a projection, in the order of the layers of its maps, from the values of its parameters.
pub fn light_spaces(
    light: &Light,
    module: &Module,
    value_of: &dyn Fn(&Parameter) -> Option<Value>,
    around: Surroundings<'_>,
) -> Result<Vec<LightSpace>, RenderError> {
    let space = light
        .space
        .as_ref()
        .ok_or_else(|| RenderError::Job(format!("light `{}` has maps but no projection", light.name)))?;
    let inputs = Inputs { paths: &space.inputs, module, value_of };
    let mut views = match space.projection.as_str() {
        "perspective" => vec![perspective(&inputs, disc(inputs.length(5)?))?],
        "rectangle" => {
            let half = (inputs.length(5)? / 2.0, inputs.length(6)? / 2.0);
            vec![perspective(&inputs, Vec4::new(half.0, half.1, 0.0, 1.0))?]
        }
        "cube" => cube(&inputs)?,
        "orthographic" => match space.views {
            0 | 1 => vec![orthographic(&inputs, around.bounds)?],
            _ => splits::views(&inputs, space, around)?,
        },
        other => return Err(RenderError::Job(format!("light `{}`: `{other}` is not a projection", light.name))),
    };
    if let [view] = views.as_mut_slice()
        && space.settings.get("warp").is_some_and(|warp| warp == "perspective")
    {
        warp::apply(view, around);
    }
    for (layer, view) in (0_u8..).zip(&mut views) {
        view.projection.w = f32::from(layer);
    }
    Ok(views)
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

    /// A length or an angle, not negative.
    fn length(&self, index: usize) -> Result<f32, RenderError> {
        let length = self.number(index)?;
        if length >= 0.0 { Ok(length) } else { Err(self.refuse(index, "a size cannot be negative")) }
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

fn perspective(inputs: &Inputs<'_>, source: Vec4) -> Result<LightSpace, RenderError> {
    let position = inputs.vector(0)?;
    let axis = inputs.axis(1)?;
    let half_angle = inputs.number(2)?;
    let near = inputs.number(3)?;
    let far = inputs.number(4)?;
    if !OUTER_ANGLE.contains(&half_angle) {
        return Err(inputs.refuse(2, "the cone of a light with maps must be between 0 and 89 degrees"));
    }
    check_range(inputs, (3, near), (4, far))?;
    let focal = half_angle.tan().recip();
    Ok(LightSpace {
        world_to_light: look_along(position, axis),
        projection: Vec4::new(focal, focal, 1.0, 0.0),
        depth: depth_range(near, far),
        source,
        warp: Vec4::ZERO,
    })
}

fn check_range(inputs: &Inputs<'_>, near: (usize, f32), far: (usize, f32)) -> Result<(), RenderError> {
    if near.1 <= 0.0 {
        return Err(inputs.refuse(near.0, "maps must begin in front of the light"));
    }
    if far.1 <= near.1 {
        return Err(inputs.refuse(far.0, "maps must end behind where they begin"));
    }
    Ok(())
}

/// Half width of a face of the cube at distance 1. What is beyond 1 belongs to the neighbours and is there for filters
/// that reach across the edge: 7.5 texels of 256 to each side.
const FACE: f32 = 1.0 + 1.0 / 16.0;

/// Six views along the axes of the world: +x, -x, +y, -y, +z, -z.
fn cube(inputs: &Inputs<'_>) -> Result<Vec<LightSpace>, RenderError> {
    let position = inputs.vector(0)?;
    let (near, far) = (inputs.number(1)?, inputs.number(2)?);
    check_range(inputs, (1, near), (2, far))?;
    let source = disc(inputs.length(3)?);
    let axes = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let face = |axis| LightSpace {
        world_to_light: look_along(position, axis),
        projection: Vec4::new(FACE.recip(), FACE.recip(), 1.0, 0.0),
        depth: depth_range(near, far),
        source,
        warp: Vec4::ZERO,
    };
    Ok(axes.map(face).to_vec())
}

/// The source of a light that shines from a disc of this half size, in its only or coarsest view.
fn disc(half: f32) -> Vec4 {
    Vec4::new(half, half, 1.0, 1.0)
}

/// The source of parallel light from a disc, from the angle between its middle and its rim.
fn distant_source(inputs: &Inputs<'_>, index: usize) -> Result<Vec4, RenderError> {
    let angle = inputs.length(index)?;
    if angle >= 1.5 {
        return Err(inputs.refuse(index, "the light must come from less than half of the sky"));
    }
    Ok(disc(angle.tan()))
}

fn orthographic(inputs: &Inputs<'_>, bounds: &Bounds) -> Result<LightSpace, RenderError> {
    let axis = inputs.axis(0)?;
    let (center, radius) = covered_ball(inputs, bounds)?;
    let (begin, length) = fitted_depth(bounds, look_along(center, axis), radius);
    let origin = center + axis * begin;
    let focal = radius.recip();
    Ok(LightSpace {
        world_to_light: look_along(origin, axis),
        projection: Vec4::new(focal, focal, 0.0, 0.0),
        depth: depth_range(0.0, length),
        source: distant_source(inputs, 3)?,
        warp: Vec4::ZERO,
    })
}

/// Centre and radius of what the maps of parallel light cover: as given, or everything.
fn covered_ball(inputs: &Inputs<'_>, bounds: &Bounds) -> Result<(Vec3, f32), RenderError> {
    let given = (inputs.vector(1)?, inputs.length(2)?);
    let (center, radius) = if given.1 == 0.0 { bounds.ball() } else { given };
    // A scene of one point still has an extent to divide by.
    Ok((center, radius.max(1e-6)))
}

/// Where the maps of parallel light begin along its axis, from the origin of a frame, and how far they reach: all that
/// stands in its column, with a margin that keeps surfaces at both ends inside, whatever rounding does to them.
fn fitted_depth(bounds: &Bounds, frame: Mat4, radius: f32) -> (f32, f32) {
    let (low, high) = bounds.depth_in_column(frame, radius);
    let margin = (high - low).max(radius) * 1e-3;
    (low - margin, high - low + 2.0 * margin)
}

fn depth_range(near: f32, far: f32) -> Vec4 {
    Vec4::new(near, far, (far - near).recip(), f32::MAX)
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
mod tests;
