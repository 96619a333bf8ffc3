//! label: Camera Forward
//! category: geometry
//! synonyms: view axis, camera direction, look direction, optical axis
//! inline
//! The unit direction in which the camera looks, the same for every point of the picture.

/// axis (direction world unit; = @camera_forward; hidden): The camera's axis.
/// -> direction (direction world unit): Away from the eye along the camera's axis, in world space.
fn camera_forward(axis: vec3f) -> vec3f {
    return axis;
}
