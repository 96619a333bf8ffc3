//! label: View Depth
//! category: geometry
//! synonyms: camera distance, camera data, z depth, eye distance, scene depth, fog distance
//! inline
//! How far the shaded point is from the camera, in units of the scene.
//! option measure: axis | eye = axis - Along the camera's axis (constant on planes parallel to the picture), or straight to the eye.

//#if measure == eye
/// point (point world; = @position_world; hidden): The shaded point.
/// eye (point world; = @camera_position; hidden): The eye.
/// -> depth (distance): The length of the line from the eye to the point.
fn view_depth(point: vec3f, eye: vec3f) -> f32 {
    return distance(point, eye);
}
//#else
/// along_axis (distance; = @depth; hidden): The distance along the camera's axis.
/// -> depth (distance): The distance along the camera's axis.
fn view_depth(along_axis: f32) -> f32 {
    return along_axis;
}
//#end
