//! label: Dots
//! category: procedural
//! synonyms: polka, halftone, circles, perforation
//! use: box_filter, cellular
//! A round dot in every cell of a square grid on texture coordinates, with edges one pixel soft; where cells get
//! smaller than a pixel the pattern becomes the share that the dots cover.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the pattern up.
/// scale (scalar; = 8): Dots per unit of the texture coordinate.
/// radius (scalar; = 0.3; 0..0.5): Radius of a dot as a share of a cell.
/// dot_color (color reflectance; = (0.2, 0.2, 0.2); 0..1; srgb): Colour of the dots.
/// ground_color (color reflectance; = (0.9, 0.9, 0.9); 0..1; srgb): Colour between them.
/// -> color (color reflectance): Colour of the pattern.
/// -> mask (scalar): 1 in a dot, 0 outside.
/// -> id (scalar): A random number in 0..1 for each dot.
fn dots(texcoord: vec2f, scale: f32, radius: f32, dot_color: vec3f, ground_color: vec3f) -> DotPoint {
    let p = texcoord * scale;
    let pixel = pixel_width2(p);
    let width = max(pixel.x, pixel.y);
    let cell = floor(p);
    let r = clamp(radius, 0.0, 0.5);
    let sharp = filtered_edge(r - length(p - cell - 0.5), width);
    let mask = mix(3.1415927 * r * r, sharp, detail_left(width));
    return DotPoint(mix(ground_color, dot_color, mask), mask, cell_id2(cell));
}

struct DotPoint {
    color: vec3f,
    mask: f32,
    id: f32,
}
