//! label: Grid Lines
//! category: procedural
//! synonyms: mesh, wire, graph paper, ruler
//! use: box_filter
//! A square grid of lines on texture coordinates, averaged exactly over each pixel. Lines lie around whole numbers of
//! the scaled coordinate.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the grid up.
/// scale (scalar; = 10): Cells per unit of the texture coordinate.
/// thickness (scalar; = 0.06; 0..1): Width of a line as a share of a cell.
/// line_color (color reflectance; = (0.15, 0.15, 0.15); 0..1; srgb): Colour of the lines.
/// ground_color (color reflectance; = (0.85, 0.85, 0.85); 0..1; srgb): Colour between them.
/// -> color (color reflectance): Colour of the grid.
/// -> mask (scalar): 1 on a line, 0 between lines.
fn grid_lines(texcoord: vec2f, scale: f32, thickness: f32, line_color: vec3f, ground_color: vec3f) -> GridPoint {
    let line = clamp(thickness, 0.0, 1.0);
    let p = texcoord * scale;
    let width = pixel_width2(p);
    let open_x = 1.0 - filtered_pulse(p.x + 0.5 * line, line, width.x);
    let open_y = 1.0 - filtered_pulse(p.y + 0.5 * line, line, width.y);
    let mask = 1.0 - open_x * open_y;
    return GridPoint(mix(ground_color, line_color, mask), mask);
}

struct GridPoint {
    color: vec3f,
    mask: f32,
}
