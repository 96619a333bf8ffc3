//! label: Angular Ramp
//! category: procedural
//! synonyms: gradient, conical, sweep, radar
//! use: turns
//! A blend from one colour to another once around a point on the texture plane.
//! option form: sweep | mirrored = sweep - Jump back after a whole turn, or return the way it came after half a turn.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the ramp up.
/// center (texcoord; = (0.5, 0.5)): The point to turn around.
/// rotation (angle; = 0; in deg): Where the ramp starts, from the first axis towards the second.
/// start_color (color; = (0, 0, 0); 0..; srgb): Colour at the start.
/// end_color (color; = (1, 1, 1); 0..; srgb): Colour after a whole turn, or half a turn if mirrored.
/// -> color (color): The blend, in linear light.
/// -> value (scalar): How far around, 0..1.
fn ramp_angular(
    texcoord: vec2f,
    center: vec2f,
    rotation: f32,
    start_color: vec3f,
    end_color: vec3f,
) -> AngularRampPoint {
    let turn = fract(turns_around(texcoord - center) - rotation * TURNS_PER_RADIAN);
//#if form == sweep
    let value = turn;
//#else
    let value = 1.0 - abs(2.0 * turn - 1.0);
//#end
    return AngularRampPoint(mix(start_color, end_color, value), value);
}

struct AngularRampPoint {
    color: vec3f,
    value: f32,
}
