//! label: Brick
//! category: procedural
//! synonyms: wall, masonry, tiles, mortar
//! use: box_filter, cellular
//! A wall of bricks in shifted rows on texture coordinates, with mortar of equal width all around; every brick has a
//! shade of its own. Averaged over each pixel.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the wall up.
/// columns (scalar; = 4): Bricks per unit of the first texture coordinate.
/// rows (scalar; = 12): Rows of bricks per unit of the second.
/// row_shift (scalar; = 0.5; 0..1): How far every other row is shifted, in brick lengths.
/// mortar (scalar; = 0.12; 0..0.9): Width of the mortar as a share of the height of a row.
/// brick_color (color reflectance; = (0.62, 0.27, 0.20); 0..1; srgb): Mean colour of the bricks.
/// mortar_color (color reflectance; = (0.76, 0.73, 0.68); 0..1; srgb): Colour of the mortar.
/// variation (scalar; = 0.35; 0..1): How much bricks differ in brightness.
/// -> color (color reflectance): Colour of the wall.
/// -> mask (scalar): 1 on a brick, 0 in the mortar.
/// -> id (scalar): A random number in 0..1 for each brick.
fn brick(
    texcoord: vec2f,
    columns: f32,
    rows: f32,
    row_shift: f32,
    mortar: f32,
    brick_color: vec3f,
    mortar_color: vec3f,
    variation: f32,
) -> BrickPoint {
    let wall = texcoord * vec2f(columns, rows);
    // Taken before rows are shifted: the shift is no change of size.
    let width = pixel_width2(wall);
    let row = floor(wall.y);
    let odd = row - 2.0 * floor(0.5 * row);
    let p = vec2f(wall.x + odd * row_shift, wall.y);
    let gap_y = clamp(mortar, 0.0, 0.9);
    let gap_x = clamp(gap_y * abs(columns) / max(abs(rows), 1e-6), 0.0, 0.9);
    // Half of the gap lies on either side of the boundary between bricks.
    let mask = filtered_pulse(p.x - 0.5 * gap_x, 1.0 - gap_x, width.x)
        * filtered_pulse(p.y - 0.5 * gap_y, 1.0 - gap_y, width.y);
    let id = cell_id2(vec2f(floor(p.x), row));
    let shade = 1.0 + variation * (id - 0.5) * detail_left(max(width.x, width.y));
    let color = mix(mortar_color, clamp(brick_color * shade, vec3f(0.0), vec3f(1.0)), mask);
    return BrickPoint(color, mask, id);
}

struct BrickPoint {
    color: vec3f,
    mask: f32,
    id: f32,
}
