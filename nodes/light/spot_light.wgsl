//! label: Spot light
//! category: light
//! synonyms: spotlight, cone light, projector, torch
//! use: light_falloff
//! Light from a point within a cone, with a smooth edge. It falls off with the square of the distance; nothing else bounds it.
//! option warp: off | perspective = off - Spend the texels of the map on what is near the eye (light-space perspective shadow maps).
//! space: perspective(position, direction, outer_angle, near, range, radius) warp=$warp

/// point (point world; = @position_world; hidden): The shaded point.
/// position (point world; = (2, 4, 3); in m): Where the light is.
/// direction (direction world; = (-2, -4, -3)): Along the axis of the cone, away from the light.
/// color (color; = (1, 1, 1); 0..): Tint of the intensity, linear.
/// intensity (scalar; = 60; 0..): Radiant intensity along the axis, W/sr: the irradiance at 1 m is this, at 2 m a quarter.
/// inner_angle (angle; = 20; 0..89; in deg): From the axis to where the edge begins.
/// outer_angle (angle; = 30; 0.1..89; in deg): From the axis to where the light ends; maps cover this cone.
/// near (distance; = 0.1; 0.001..; in m): Where maps begin; nothing nearer casts a shadow.
/// range (distance; = 12; 0.01..; in m): Where maps end. The light goes on beyond.
/// radius (distance; = 0.1; 0..; in m): Of the shining ball. Only shadows with penumbrae as wide as nature's ask for it.
/// -> irradiance (color irradiance): Light that arrives, measured facing the light.
/// -> direction (direction world unit): Towards the light.
/// -> distance (distance): To the light.
fn spot_light(
    point: vec3f,
    position: vec3f,
    direction: vec3f,
    color: vec3f,
    intensity: f32,
    inner_angle: f32,
    outer_angle: f32,
    near: f32,
    range: f32,
    radius: f32,
) -> SpotLight {
    let ray = point_light_ray(point, position);
    let axis = direction * inverseSqrt(max(dot(direction, direction), 1e-20));
    let cone = cone_falloff(-dot(ray.xyz, axis), inner_angle, outer_angle);
    return SpotLight(color * (intensity * cone * inverse_square(ray.w)), ray.xyz, ray.w);
}

struct SpotLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}
