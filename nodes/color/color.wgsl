//! label: Color
//! category: color
//! synonyms: rgb, constant color, colour, swatch, parameter
//! inline
//! A colour to set by hand and to use in several places.

/// color (color; = (0.8, 0.8, 0.8); 0..; srgb): The colour, given as it looks on a screen.
/// -> color (color linear): The same colour, linear.
fn color(color: vec3f) -> vec3f {
    return color;
}
