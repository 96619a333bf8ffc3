//! label: Point light
//! category: light
//! synonyms: omni light, bulb, lamp
//! use: light_falloff
//! Light from a point into all directions. It falls off with the square of the distance.
//! space: cube(position, near, range, radius)

/// point (point world; = @position_world; hidden): The shaded point.
/// position (point world; = (2, 4, 3); in m): Where the light is.
/// color (color; = (1, 1, 1); 0..): Tint of the intensity, linear.
/// intensity (scalar; = 60; 0..): Radiant intensity, W/sr: the irradiance at 1 m is this, at 2 m a quarter.
/// near (distance; = 0.05; 0.001..; in m): Where maps begin; nothing nearer casts a shadow.
/// range (distance; = 12; 0.01..; in m): Where maps end. The light goes on beyond.
/// radius (distance; = 0.1; 0..; in m): Of the shining ball. Only shadows with penumbrae as wide as nature's ask for it.
/// -> irradiance (color irradiance): Light that arrives, measured facing the light.
/// -> direction (direction world unit): Towards the light.
/// -> distance (distance): To the light.
fn point_light(
    point: vec3f,
    position: vec3f,
    color: vec3f,
    intensity: f32,
    near: f32,
    range: f32,
    radius: f32,
) -> PointLight {
    let ray = point_light_ray(point, position);
    return PointLight(color * (intensity * inverse_square(ray.w)), ray.xyz, ray.w);
}

struct PointLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}
