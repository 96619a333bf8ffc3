//! label: Directional light
//! category: light
//! synonyms: sun, parallel light, distant light, infinite light
//! Parallel light, as from the sun: the same everywhere.
//! space: orthographic(direction, center, radius)

/// point (point world; = @position_world; hidden): The shaded point.
/// direction (direction world; = (-1, -2, -1.5)): The way the light travels.
/// color (color; = (1, 1, 1); 0..): Tint of the intensity, linear.
/// intensity (scalar; = 3; 0..): Irradiance facing the light, W/m^2.
/// center (point world; = (0, 0, 0); in m): Centre of the ball that maps cover.
/// radius (distance; = 0; 0..; in m): Radius of that ball; 0 fits the scene.
/// -> irradiance (color irradiance): Light that arrives, measured facing the light.
/// -> direction (direction world unit): Towards the light.
/// -> distance (distance): Along the light's way, from the plane that touches the ball where light enters it.
fn directional_light(
    point: vec3f,
    direction: vec3f,
    color: vec3f,
    intensity: f32,
    center: vec3f,
    radius: f32,
) -> DirectionalLight {
    // A direction of length zero counts as straight down.
    let square = dot(direction, direction);
    let axis = select(direction * inverseSqrt(max(square, 1e-20)), vec3f(0.0, -1.0, 0.0), square < 1e-20);
    return DirectionalLight(color * intensity, -axis, max(dot(point - center, axis) + radius, 0.0));
}

struct DirectionalLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}
