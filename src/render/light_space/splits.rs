//! Parallel-split shadow maps (Zhang et al. 2006; Lauritzen 2007): the view is cut along its depth, and each part has a
//! view of the light that is zoomed in on it.

use glam::{Mat4, Vec2, Vec3, Vec4};

use super::{
    Eye, Inputs, LightSpace, Surroundings, covered_ball, depth_range, distant_source, fitted_depth, look_along,
};
use crate::plan::Space;
use crate::render::RenderError;

/// Part of a view's width that is added on each side, for filters that reach beyond what is seen.
pub(super) const BORDER: f32 = 0.03;

/// Part of a split, at its far end, in which the next one takes over where they blend: the shader counts on it.
const OVERLAP: f32 = 0.1;

/// The views of a light with splits, nearest to the eye first.
pub(super) fn views(
    inputs: &Inputs<'_>,
    space: &Space,
    around: Surroundings<'_>,
) -> Result<Vec<LightSpace>, RenderError> {
    let axis = inputs.axis(0)?;
    let (center, radius) = covered_ball(inputs, around.bounds)?;
    let source = distant_source(inputs, 3)?;
    let balance = inputs.number(4)?;
    if !(0.0..=1.0).contains(&balance) {
        return Err(inputs.refuse(4, "the balance must be between 0 (even) and 1 (logarithmic)"));
    }
    let reach = inputs.length(5)?;
    let stable = space.settings.get("fit").is_some_and(|fit| fit == "stable");
    let (near, far) = if stable { fixed_range(around, radius, reach) } else { visible(around, reach) };
    let ends = practical_splits(near, far, balance, space.views);
    let frame = look_along(center, axis);
    // One range of depths for all, so that what is filtered in depth means the same in each.
    let (nearest, length) = fitted_depth(around.bounds, frame, radius);
    let blend = space.settings.get("blend").is_some_and(|blend| blend == "on");
    let mut views = Vec::new();
    let mut begin = near;
    for &end in &ends {
        let (middle, half) = if stable {
            snapped_square(around.eye, (begin, end), frame, around.side)
        } else {
            bounding_rectangle(around.eye, (begin, end), frame, radius)
        };
        let shift = Mat4::from_translation(Vec3::new(-middle.x, -middle.y, -nearest));
        let mut depth = depth_range(0.0, length);
        depth.w = end;
        views.push(LightSpace {
            world_to_light: shift * frame,
            projection: Vec4::new(half.x.recip(), half.y.recip(), 0.0, 0.0),
            depth,
            source,
            warp: Vec4::ZERO,
        });
        begin = if blend { end * (1.0 - OVERLAP) } else { end };
    }
    let density = |view: &LightSpace| (view.projection.x * view.projection.y).sqrt();
    let coarsest = views.iter().map(density).fold(f32::INFINITY, f32::min);
    for view in &mut views {
        view.source.w = density(view) / coarsest;
    }
    // Whatever lies beyond belongs to the last view, which says that it does not know.
    if let Some(last) = views.last_mut() {
        last.depth.w = f32::MAX;
    }
    Ok(views)
}

/// The distances from the eye between which there is something to see.
pub(super) fn visible(around: Surroundings<'_>, reach: f32) -> (f32, f32) {
    let (near, far) = around.bounds.seen(around.eye).unwrap_or(around.eye.range);
    let far = if reach > 0.0 { far.min(reach) } else { far };
    (near, far.max(near * 1.001))
}

/// Distances from the eye that do not change as it moves: what is covered, as if seen from its edge.
fn fixed_range(around: Surroundings<'_>, radius: f32, reach: f32) -> (f32, f32) {
    let (first, last) = around.eye.range;
    let far = if reach > 0.0 { reach } else { 2.0 * radius }.min(last);
    // Closer than this there is hardly anything to see, and logarithms would spend their splits on it.
    let near = first.max(far * 1e-3);
    (near, far.max(near * 1.001))
}

/// Where each of `count` splits ends: between even and logarithmic spacing (the practical split scheme of Zhang et al.
/// 2006, section 3: z = L n (f/n)^(i/m) + (1 - L)(n + (f - n) i/m)).
fn practical_splits(near: f32, far: f32, balance: f32, count: u32) -> Vec<f32> {
    let end = |i: u32| {
        #[allow(clippy::cast_precision_loss, reason = "a handful of splits")]
        let part = i as f32 / count as f32;
        let even = near + (far - near) * part;
        let logarithmic = near * (far / near).powf(part);
        even + (logarithmic - even) * balance
    };
    (1..=count).map(end).collect()
}

/// Middle and half size, in the light's frame, of the rectangle around what is seen between two distances, within the
/// square that the light covers at all.
fn bounding_rectangle(eye: &Eye, (near, far): (f32, f32), frame: Mat4, radius: f32) -> (Vec2, Vec2) {
    let corners = eye.corners(near, far).map(|c| frame.transform_point3(c).truncate());
    let whole = Vec2::splat(radius);
    let low = corners.into_iter().fold(Vec2::INFINITY, Vec2::min).clamp(-whole, whole);
    let high = corners.into_iter().fold(Vec2::NEG_INFINITY, Vec2::max).clamp(-whole, whole);
    let half = ((high - low) * 0.5).max(whole * 1e-4) * (1.0 + 2.0 * BORDER);
    ((low + high) * 0.5, half)
}

/// Middle and half size of a square around the ball around what is seen between two distances. It does not turn with the
/// eye and moves by whole texels, so that the shadows of what stands still do not change (stable cascades: Valient
/// 2008).
fn snapped_square(eye: &Eye, (near, far): (f32, f32), frame: Mat4, side: u32) -> (Vec2, Vec2) {
    let slope = eye.half.0.hypot(eye.half.1);
    // The ball through all corners has its middle on the axis where near and far corners are equally far; but not beyond
    // the far end, where it would only grow.
    let along = ((far + near) * 0.5 * (1.0 + slope * slope)).min(far);
    let radius = ((far - along).hypot(far * slope)).max((along - near).hypot(near * slope));
    #[allow(clippy::cast_precision_loss, reason = "maps have far fewer than 2^24 texels on a side")]
    let side = side.max(2) as f32;
    // Rounded up on a fixed ladder, so that rounding does not make the size of a texel flicker.
    let half = 2.0_f32.powf((radius * (1.0 + 2.0 * BORDER)).log2().mul_add(16.0, 1e-3).ceil() / 16.0);
    let texel = 2.0 * half / side;
    // Texels are counted from the origin of the world, which stands still.
    let origin = frame.transform_point3(Vec3::ZERO).truncate();
    let middle = frame.transform_point3(eye.position + eye.forward * along).truncate() - origin;
    (((middle / texel).round() * texel) + origin, Vec2::splat(half))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_are_even_at_one_end_of_the_scale_and_logarithmic_at_the_other() {
        let close = |a: &[f32], b: [f32; 4]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3 * b);
        assert!(close(&practical_splits(1.0, 10_000.0, 1.0, 4), [10.0, 100.0, 1000.0, 10_000.0]));
        assert!(close(&practical_splits(0.0001, 8.0, 0.0, 4), [2.0, 4.0, 6.0, 8.0]));
        let half = practical_splits(1.0, 100.0, 0.5, 2);
        assert!((half[0] - (10.0 + 50.5) / 2.0).abs() < 1e-3 && (half[1] - 100.0).abs() < 1e-3, "{half:?}");
    }
}
