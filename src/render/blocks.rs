//! Uniform blocks of [`crate::module`] and the checks that keep nonsense out of them.

use glam::{Mat4, Vec3, Vec4};

use super::RenderError;
use super::job::{Draw, Job};
use crate::module::{FRAME_BYTES, OBJECT_BYTES};
use crate::scene::Camera;

fn bytes(values: impl IntoIterator<Item = f32>) -> Vec<u8> {
    values.into_iter().flat_map(f32::to_le_bytes).collect()
}

/// The frame block of a job whose camera has been checked.
pub(super) fn frame_block(job: &Job<'_>) -> Vec<u8> {
    let view = job.camera.world_to_view();
    let clip = view_to_clip(&job.camera, job.size) * view;
    let levels = job.surroundings.map_or(1, |s| s.levels.len().max(1));
    #[allow(clippy::cast_precision_loss, reason = "textures have at most some 15 levels")]
    let last_level = (levels - 1) as f32;
    let irradiance = job.surroundings.map_or([Vec4::ZERO; 9], |s| s.irradiance);
    let block = bytes(
        clip.to_cols_array()
            .into_iter()
            .chain(view.to_cols_array())
            .chain(job.camera.position.extend(job.time).to_array())
            .chain(forward(&job.camera).extend(last_level).to_array())
            .chain(irradiance.into_iter().flat_map(|c| c.to_array())),
    );
    debug_assert_eq!(block.len() as u64, FRAME_BYTES);
    block
}

/// The object block of a draw.
pub(super) fn object_block(draw: &Draw<'_>) -> Result<Vec<u8>, RenderError> {
    let inverse = draw.object_to_world.inverse();
    if !draw.object_to_world.is_finite() || !inverse.is_finite() {
        return Err(RenderError::Job("the transform of an object cannot be inverted".into()));
    }
    let receives = [f32::from(u8::from(draw.receives)), 0.0, 0.0, 0.0];
    let matrices = draw.object_to_world.to_cols_array().into_iter().chain(inverse.to_cols_array());
    let block = bytes(matrices.chain(receives));
    debug_assert_eq!(block.len() as u64, OBJECT_BYTES);
    Ok(block)
}

/// What the background shader needs to know of the camera.
pub(super) fn background_block(camera: &Camera, size: (u32, u32)) -> Vec<u8> {
    let world = camera.world_to_view().inverse();
    let half_height = (camera.fov_y * 0.5).tan();
    let half_width = half_height * aspect(size);
    bytes([world.x_axis * half_width, world.y_axis * half_height, -world.z_axis].into_iter().flat_map(|v| v.to_array()))
}

/// Fails where a camera sees nothing.
pub(super) fn check_camera(camera: &Camera) -> Result<(), RenderError> {
    let numbers = [camera.fov_y, camera.near, camera.far];
    let way = camera.target - camera.position;
    let message = if !camera.position.is_finite() || !camera.target.is_finite() || !camera.up.is_finite() {
        "has a place that is not finite"
    } else if !numbers.iter().all(|x| x.is_finite()) {
        "has a number that is not finite"
    } else if camera.fov_y <= 0.0 || camera.fov_y >= std::f32::consts::PI {
        "must see an angle between 0 and 180 degrees"
    } else if camera.near <= 0.0 || camera.far <= camera.near {
        "must see from a positive distance to a greater one"
    } else if way.try_normalize().is_none() {
        "stands where it looks at"
    } else if way.normalize().cross(camera.up.normalize_or_zero()).length() < 1e-6 {
        "looks along its own up direction"
    } else {
        return Ok(());
    };
    Err(RenderError::Job(format!("the camera {message}")))
}

fn forward(camera: &Camera) -> Vec3 {
    (camera.target - camera.position).normalize_or_zero()
}

#[allow(clippy::cast_precision_loss, reason = "pictures are far less than 2^24 wide")]
fn aspect((width, height): (u32, u32)) -> f32 {
    width as f32 / height as f32
}

/// View to clip space: depth 0 at the near plane, 1 at the far plane, y up.
fn view_to_clip(camera: &Camera, size: (u32, u32)) -> Mat4 {
    let focal = (camera.fov_y * 0.5).tan().recip();
    let depth = camera.far / (camera.near - camera.far);
    Mat4::from_cols(
        Vec4::new(focal / aspect(size), 0.0, 0.0, 0.0),
        Vec4::new(0.0, focal, 0.0, 0.0),
        Vec4::new(0.0, 0.0, depth, -1.0),
        Vec4::new(0.0, 0.0, camera.near * depth, 0.0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERA: Camera = Camera {
        position: Vec3::new(1.0, 2.0, 5.0),
        target: Vec3::new(1.0, 2.0, 0.0),
        up: Vec3::Y,
        fov_y: std::f32::consts::FRAC_PI_2,
        near: 0.5,
        far: 50.0,
    };

    fn project(point: Vec3) -> Vec3 {
        (view_to_clip(&CAMERA, (200, 100)) * CAMERA.world_to_view()).project_point3(point)
    }

    #[test]
    fn clip_space_runs_from_near_to_far_with_y_up() {
        assert!(project(Vec3::new(1.0, 2.0, 4.5)).z.abs() < 1e-5);
        assert!((project(Vec3::new(1.0, 2.0, -45.0)).z - 1.0).abs() < 1e-5);
        // At distance 2 the picture is 4 high and 8 wide.
        let corner = project(Vec3::new(5.0, 4.0, 3.0));
        assert!((corner.truncate() - glam::Vec2::ONE).length() < 1e-5, "{corner}");
    }

    #[test]
    fn cameras_that_see_nothing_are_refused() {
        assert_eq!(check_camera(&CAMERA), Ok(()));
        for broken in [
            Camera { target: CAMERA.position, ..CAMERA },
            Camera { up: Vec3::Z, ..CAMERA },
            Camera { up: Vec3::ZERO, ..CAMERA },
            Camera { near: 0.0, ..CAMERA },
            Camera { far: 0.1, ..CAMERA },
            Camera { fov_y: f32::NAN, ..CAMERA },
            Camera { position: Vec3::INFINITY, ..CAMERA },
        ] {
            assert!(check_camera(&broken).is_err(), "{broken:?}");
        }
    }

    #[test]
    fn the_background_looks_where_the_camera_does() {
        let block = background_block(&CAMERA, (200, 100));
        let floats: Vec<f32> = block.chunks_exact(4).map(|c| f32::from_le_bytes(c.try_into().expect("4"))).collect();
        let expected = [2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0];
        assert!(floats.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{floats:?}");
    }
}
