//! label: Hue Saturation Value
//! category: color
//! synonyms: hsv, hue shift, hue rotate, recolor, color correction, vibrance
//! use: hexcone
//! Turns a colour's hue and scales its saturation and value (Smith 1978, the hexcone model).

/// color (color): The colour.
/// hue (angle; = 0; in deg): How far the hue is turned: 120 takes red to green.
/// saturation (scalar; = 1; 0..): Factor on the saturation, which ends at pure colours.
/// value (scalar; = 1; 0..): Factor on the value.
/// -> color (color): The changed colour.
fn adjust_hsv(color: vec3f, hue: f32, saturation: f32, value: f32) -> vec3f {
    let hsv = hsv_of(color);
    let turned = hsv.x + hue * 0.15915494;
    return color_of_hsv(vec3f(turned, clamp(hsv.y * saturation, 0.0, 1.0), hsv.z * value));
}
