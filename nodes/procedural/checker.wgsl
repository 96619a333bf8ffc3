//! label: Checker
//! category: procedural
//! synonyms: checkerboard, chess, tiles
//! use: box_filter
//! Squares of two colours in turn on texture coordinates, averaged exactly over each pixel, so that distant squares
//! melt into their mean instead of flickering.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the pattern up.
/// scale (scalar; = 8): Squares per unit of the texture coordinate.
/// color_a (color reflectance; = (0.9, 0.9, 0.9); 0..1; srgb): Colour of the square at the origin.
/// color_b (color reflectance; = (0.2, 0.2, 0.2); 0..1; srgb): Colour of its neighbours.
/// -> color (color reflectance): Colour of the pattern.
/// -> mask (scalar): 1 in squares of the first colour, 0 in the others.
fn checker(texcoord: vec2f, scale: f32, color_a: vec3f, color_b: vec3f) -> CheckerPoint {
    let p = texcoord * scale;
    let width = pixel_width2(p);
    let mask = 0.5 + 0.5 * filtered_square(p.x, width.x) * filtered_square(p.y, width.y);
    return CheckerPoint(mix(color_b, color_a, mask), mask);
}

struct CheckerPoint {
    color: vec3f,
    mask: f32,
}
