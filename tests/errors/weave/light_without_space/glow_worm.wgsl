//! label: Glow-worm
//! category: light
//! A light that nobody can look out of.

/// point (point world; = @position_world): The shaded point.
/// -> irradiance (color irradiance): Light that arrives.
/// -> direction (direction world unit): Towards the light.
/// -> distance (distance): To the light.
fn glow_worm(point: vec3f) -> GlowWorm {
    return GlowWorm(vec3f(0.1), vec3f(0.0, 1.0, 0.0), length(point));
}

struct GlowWorm {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}
