//! label: Polar Coordinates
//! category: texture
//! synonyms: radial, circle, angle and radius
//! use: turns
//! Turns texture coordinates into an angle around a point and a distance from it, so that patterns run in circles.

/// texcoord (texcoord; = @texcoord): Coordinates to change.
/// center (texcoord; = (0.5, 0.5)): The point to turn around.
/// radius (scalar; = 0.5; 0.000001..): Distance that counts as one.
/// -> texcoord (texcoord): Angle from the first axis towards the second in turns, 0..1, and distance.
fn polar_coordinates(texcoord: vec2f, center: vec2f, radius: f32) -> vec2f {
    let offset = texcoord - center;
    return vec2f(fract(turns_around(offset)), length(offset) / max(radius, 1e-6));
}
