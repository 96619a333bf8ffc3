//! label: Spherical Coordinates
//! category: texture
//! synonyms: equirectangular, latitude longitude, panorama, environment
//! use: turns, safe_normal
//! Place of a direction on an equirectangular picture: -z is in the middle, +x to its right, +y along the top edge.

/// direction (direction; = (0, 0, -1)): Direction to look up; its length does not matter.
/// rotation (angle; = 0; in deg): Turns the picture around the y axis, to the right.
/// -> texcoord (texcoord): Coordinates on the picture, 0..1.
fn spherical_coordinates(direction: vec3f, rotation: f32) -> vec2f {
    let unit = unit_normal_or(direction, vec3f(0.0, 0.0, -1.0));
    let longitude = turns_around(vec2f(-unit.z, unit.x)) - rotation * TURNS_PER_RADIAN;
    // acos loses precision at the poles, where atan2 does not.
    let latitude = turns_around(vec2f(length(unit.xz), unit.y));
    return vec2f(fract(0.5 + longitude), 0.5 - 2.0 * latitude);
}
