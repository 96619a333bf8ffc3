//! label: HSV to RGB
//! category: color
//! synonyms: combine hsv, make color, hue, saturation, value, rainbow, convert color
//! use: hexcone
//! inline
//! Makes a colour from hue, saturation and value (Smith 1978, the hexcone model).

/// hue (scalar; = 0): In turns: 0 red, 1/3 green, 2/3 blue; it goes round.
/// saturation (scalar; = 1; 0..1): 0 for greys, 1 for pure colours.
/// value (scalar; = 1; 0..): The greatest component.
/// -> color (color): The colour.
fn hsv_to_rgb(hue: f32, saturation: f32, value: f32) -> vec3f {
    return color_of_hsv(vec3f(hue, saturation, value));
}
