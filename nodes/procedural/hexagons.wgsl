//! label: Hexagons
//! category: procedural
//! synonyms: honeycomb, hex tiles
//! use: box_filter, cellular
//! Regular hexagons that fill the texture plane, with gaps between them; edges are one pixel soft, and where hexagons
//! get smaller than a pixel the pattern becomes the share that they cover.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the pattern up.
/// scale (scalar; = 8): Hexagons per unit of the first texture coordinate.
/// gap (scalar; = 0.08; 0..1): Width of the gap between hexagons as a share of their width.
/// tile_color (color reflectance; = (0.85, 0.62, 0.20); 0..1; srgb): Colour of the hexagons.
/// gap_color (color reflectance; = (0.2, 0.2, 0.2); 0..1; srgb): Colour of the gaps.
/// -> color (color reflectance): Colour of the pattern.
/// -> mask (scalar): 1 in a hexagon, 0 in a gap.
/// -> edge_distance (scalar): Distance to the nearest border as a share of the width; 0.5 in the middle.
/// -> id (scalar): A random number in 0..1 for each hexagon.
fn hexagons(texcoord: vec2f, scale: f32, gap: f32, tile_color: vec3f, gap_color: vec3f) -> HexagonPoint {
    let p = texcoord * scale;
    let pixel = pixel_width2(p);
    let width = max(pixel.x, pixel.y);
    // The centres are two rectangular lattices of 1 by sqrt 3, the second in the middle of the first's cells.
    let lattice = vec2f(1.0, 1.7320508);
    let first = floor(p / lattice + 0.5);
    let second = floor(p / lattice) + 0.5;
    let to_first = p - first * lattice;
    let to_second = p - second * lattice;
    let take_first = dot(to_first, to_first) < dot(to_second, to_second);
    let offset = abs(select(to_second, to_first, take_first));
    let center = select(second, first, take_first);
    let edge = clamp(0.5 - max(offset.x, dot(offset, vec2f(0.5, 0.8660254))), 0.0, 0.5);
    let half_gap = 0.5 * clamp(gap, 0.0, 1.0);
    let covered = (1.0 - 2.0 * half_gap) * (1.0 - 2.0 * half_gap);
    let mask = mix(covered, filtered_edge(edge - half_gap, width), detail_left(width));
    return HexagonPoint(mix(gap_color, tile_color, mask), mask, edge, cell_id2(2.0 * center));
}

struct HexagonPoint {
    color: vec3f,
    mask: f32,
    edge_distance: f32,
    id: f32,
}
