//! label: Screen Position
//! category: geometry
//! synonyms: pixel, fragment coordinates, frag coord, window coordinates, screen uv
//! inline
//! The place of the shaded point in the picture, in pixels from the upper left corner.

/// pixel (point screen; = @pixel; hidden; in px): The centre of the pixel.
/// -> position (point screen): x grows to the right and y downwards; centres of pixels lie at halves.
fn screen_position(pixel: vec2f) -> vec2f {
    return pixel;
}
