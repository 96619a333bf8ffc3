//! label: Rectangle light
//! category: light
//! synonyms: area light, panel, softbox, window light, quad light, polygonal light, tube
//! use: light_falloff, polygon
//! Light from a shining rectangle, equally bright from everywhere in front of it, dark behind it. On matte surfaces that see all of it, the light is exact (Lambert 1760); where the horizon of a surface cuts through the rectangle, the part below it counts against the part above, so that surfaces grow dark a little early, and smoothly. Glossy surfaces reflect it as if from a point.
//! space: rectangle(position, direction, outer_angle, near, range, width, height)

/// point (point world; = @position_world; hidden): The shaded point.
/// position (point world; = (2, 4, 3); in m): The middle of the rectangle.
/// direction (direction world; = (-2, -4, -3)): Where its front faces. Its upper edge is as near to up as can be; of one that lies flat, facing down, it is towards +z, facing up, towards -z.
/// color (color; = (1, 1, 1); 0..): Tint of the intensity, linear.
/// intensity (scalar; = 60; 0..): Radiant intensity along the axis, W/sr, whatever the size: far away the irradiance at 1 m would be this. Radiance is this over width times height.
/// width (distance; = 1; 0.001..; in m): Of the rectangle.
/// height (distance; = 0.6; 0.001..; in m): Of the rectangle.
/// inner_angle (angle; = 50; 0..89; in deg): From the axis, at the middle of the light, to where shades beside it begin to cut it off.
/// outer_angle (angle; = 65; 0.1..89; in deg): From the axis to where the light ends; maps cover this cone.
/// near (distance; = 0.3; 0.001..; in m): Where maps begin; nothing nearer casts a shadow.
/// range (distance; = 12; 0.01..; in m): Where maps end. The light goes on beyond.
/// -> irradiance (color irradiance): Light that arrives, measured facing the mean direction.
/// -> direction (direction world unit): Mean direction towards the light, weighted with what comes from there.
/// -> distance (distance): To the middle of the light.
fn rectangle_light(
    point: vec3f,
    position: vec3f,
    direction: vec3f,
    color: vec3f,
    intensity: f32,
    width: f32,
    height: f32,
    inner_angle: f32,
    outer_angle: f32,
    near: f32,
    range: f32,
) -> RectangleLight {
    let ray = point_light_ray(point, position);
    let axes = axes_along(direction);
    let half = max(0.5 * vec2f(width, height), vec2f(0.0005));
    let vector = rectangle_irradiance(position - point, axes[0] * half.x, axes[1] * half.y);
    let size = length(vector);
    let in_front = dot(ray.xyz, axes[2]) < 0.0;
    let shown = cone_falloff(-dot(ray.xyz, axes[2]), inner_angle, outer_angle);
    let amount = intensity / (4.0 * half.x * half.y) * shown * select(0.0, size, in_front);
    let to_light = select(ray.xyz, vector / max(size, 1e-30), in_front && size > 1e-12);
    return RectangleLight(color * amount, to_light, ray.w);
}

struct RectangleLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}
