//! label: Directional light
//! category: light
//! synonyms: sun, parallel light, distant light, infinite light
//! Parallel light, as from the sun: the same everywhere.
//! option splits: 1 | 2 | 3 | 4 = 1 - Parts that the view is cut into along its depth, each with a map zoomed in on it: for wide views.
//! option fit: tight | stable = tight - Maps of parts cover just what is seen, or stand still in the world while the camera moves, at a loss of resolution.
//! option choice: pixel | quad = pixel - Parts are chosen per pixel, or one for each two by two, so that differences within it make sense.
//! option blend: off | on = off - Parts go over into each other in the last tenth of each; shadows are then made twice.
//! option warp: off | perspective = off - Spend the texels of a single map on what is near the eye (light-space perspective shadow maps).
//! space: orthographic(direction, center, radius, angle, split_balance, split_reach) splits=$splits fit=$fit choice=$choice blend=$blend warp=$warp

/// point (point world; = @position_world; hidden): The shaded point.
/// direction (direction world; = (-1, -2, -1.5)): The way the light travels.
/// color (color; = (1, 1, 1); 0..): Tint of the intensity, linear.
/// intensity (scalar; = 3; 0..): Irradiance facing the light, W/m^2.
/// center (point world; = (0, 0, 0); in m): Centre of the ball that maps cover.
/// radius (distance; = 0; 0..; in m): Radius of that ball; 0 fits the scene.
/// angle (angle; = 0.2665; 0..45; in deg): From the middle of the light to its rim; the sun's by default. Only shadows with penumbrae as wide as nature's ask for it.
//#if splits != 1
/// split_balance (scalar; = 0.5; 0..1): Sizes of the parts: 0 equal, 1 each a multiple of the one before.
/// split_reach (distance; = 0; 0..; in m): Distance from the eye up to which there are shadows; 0 reaches all that is seen.
//#end
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
    angle: f32,
//#if splits != 1
    split_balance: f32,
    split_reach: f32,
//#end
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
