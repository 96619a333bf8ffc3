//! label: Bump
//! category: geometry
//! synonyms: height map, displacement, relief, dents
//! use: safe_normal
//! Bends the normal as if the surface were raised by a height, without needing texture coordinates: the surface
//! gradient from screen-space derivatives (Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the GPU").
//! cheaper: input normal - The smooth surface.

/// height (scalar): Height of the surface; any pattern or image. 1 stands for `amplitude` metres.
/// amplitude (distance; = 0.02; in m): Metres that a height of 1 stands for.
/// strength (scalar; = 1; -4..4): Multiplies the height; negative turns bumps into dents.
/// position (point world; = @position_world; hidden): Point of the smooth surface.
/// normal (normal world near; = @normal_world): Normal of the smooth surface.
/// -> normal (normal world unit): The bent normal.
fn bump(height: f32, amplitude: f32, strength: f32, position: vec3f, normal: vec3f) -> vec3f {
    let smooth_normal = unit_normal_or(normal, vec3f(0.0, 1.0, 0.0));
    let right = dpdx(position);
    let down = dpdy(position);
    let rise = vec2f(dpdx(height), dpdy(height)) * amplitude * strength;
    // Vectors in the tangent plane, each perpendicular to the other screen direction.
    let along_right = cross(down, smooth_normal);
    let along_down = cross(smooth_normal, right);
    let area = dot(right, along_right);
    let gradient = sign(area) * (rise.x * along_right + rise.y * along_down);
    return unit_normal_or(abs(area) * smooth_normal - gradient, smooth_normal);
}
