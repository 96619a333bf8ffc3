//! Light-space perspective shadow maps (Wimmer, Scherzer and Purgathofer 2004): a map whose texels grow with the distance
//! from the eye.

use glam::{Mat4, Vec2, Vec3, Vec4};

use super::splits::{BORDER, visible};
use super::{LightSpace, Surroundings};

/// Light and view nearer to parallel than this (sine of the angle) leave nothing to gain.
const LEAST_SINE: f32 = 0.05;

/// Turns the view so that the eye looks along its +y, and warps it. Parallel light is fitted to what is seen, within what
/// it covered before; a cone keeps all of its disc, which the warp maps onto itself.
pub(super) fn apply(view: &mut LightSpace, around: Surroundings<'_>) {
    let eye = around.eye;
    let forward = view.world_to_light.transform_vector3(eye.forward);
    let sine = forward.truncate().length();
    if sine < LEAST_SINE {
        return;
    }
    let up = forward.truncate() / sine;
    let turn = Mat4::from_cols(Vec4::new(up.y, up.x, 0.0, 0.0), Vec4::new(-up.x, up.y, 0.0, 0.0), Vec4::Z, Vec4::W);
    let frame = turn * view.world_to_light;
    let (near, far) = visible(around, 0.0);
    if view.projection.z > 0.5 {
        let middle = eye.depth(view.world_to_light.inverse().transform_point3(Vec3::ZERO));
        let near = near.max(middle - view.depth.y);
        let far = far.min(middle + view.depth.y).max(near * 1.001);
        let k = strength((far - near) * sine, near, far, sine);
        view.world_to_light = frame;
        view.projection.x *= (1.0 - k * k).sqrt();
        view.warp.x = k;
        return;
    }
    let radius = view.projection.x.recip();
    let corners = eye.corners(near, far).map(|c| frame.transform_point3(c).truncate());
    let clamped = corners.map(|c| c.y.clamp(-radius, radius));
    let low = clamped.into_iter().fold(f32::INFINITY, f32::min);
    let high = clamped.into_iter().fold(f32::NEG_INFINITY, f32::max).max(low + radius * 1e-4);
    let half = (high - low) * 0.5 * (1.0 + 2.0 * BORDER);
    let k = strength(2.0 * half, near, far, sine);
    let middle = Vec2::new(frame.transform_point3(eye.position).x.clamp(-radius, radius), (low + high) * 0.5);
    // How far to the side anything that is seen lies, as the warp leaves it.
    let widest = (0..=64_u8)
        .map(|i| {
            let y = f32::from(i) / 32.0 - 1.0;
            half_width(&corners, middle + Vec2::Y * (y * half), radius) / (1.0 + k * y)
        })
        .fold(radius * 1e-4, f32::max);
    view.world_to_light = Mat4::from_translation(Vec3::new(-middle.x, -middle.y, 0.0)) * frame;
    view.projection.x = (widest * (1.0 + 2.0 * BORDER)).recip();
    view.projection.y = half.recip();
    view.warp.x = k;
}

/// The warp of a window of this length across the light, for what is seen between two distances: with the perspective's
/// centre at n = (near + sqrt(near far)) / sine before the window (Wimmer et al. 2004, section 4).
fn strength(length: f32, near: f32, far: f32, sine: f32) -> f32 {
    let before = (near + (near * far).sqrt()) / sine;
    length / (2.0 * before + length)
}

/// Greatest distance from `middle` along x at which the convex hull of `corners`, within `radius` of the frame's origin,
/// meets the line through it.
fn half_width(corners: &[Vec2; 8], middle: Vec2, radius: f32) -> f32 {
    let mut widest = 0.0_f32;
    for (i, a) in corners.iter().enumerate() {
        for b in &corners[i + 1..] {
            let (from, to) = (a.y - middle.y, b.y - middle.y);
            if from * to <= 0.0 && (from - to).abs() > 0.0 {
                let x = a.x + (b.x - a.x) * (from / (from - to));
                widest = widest.max((x.clamp(-radius, radius) - middle.x).abs());
            }
        }
    }
    widest
}
