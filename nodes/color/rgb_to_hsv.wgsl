//! label: RGB to HSV
//! category: color
//! synonyms: separate hsv, split hsv, hue, saturation, value, convert color
//! use: hexcone
//! Splits a colour into hue, saturation and value (Smith 1978, the hexcone model).

/// What a colour is made of in the hexcone model.
struct HueSaturationValue {
    hue: f32,
    saturation: f32,
    value: f32,
}

/// color (color): The colour.
/// -> hue (scalar): In turns: 0 red, 1/3 green, 2/3 blue; 0 for greys.
/// -> saturation (scalar): 0 for greys, 1 for pure colours.
/// -> value (scalar): The greatest component.
fn rgb_to_hsv(color: vec3f) -> HueSaturationValue {
    let hsv = hsv_of(color);
    return HueSaturationValue(hsv.x, hsv.y, hsv.z);
}
