//! label: Voronoi Edges
//! category: procedural
//! synonyms: cracks, cells, cobblestone, crackle, leather
//! use: box_filter, cellular
//! Borders of the cells around scattered points on texture coordinates: the exact distance to the nearest border, which
//! is the distance to the bisector between the nearest point and each of its neighbours.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the cells up.
/// scale (scalar; = 6): Cells per unit of the texture coordinate.
/// jitter (scalar; = 0.9; 0..1): How irregular the cells are: 0 is a square lattice.
/// thickness (scalar; = 0.06; 0..1): Width of the borders as a share of a lattice cell.
/// -> mask (scalar): 1 inside a cell, 0 on a border; its edge is one pixel soft.
/// -> edge_distance (scalar): Distance to the nearest border, in lattice cells.
/// -> id (scalar): A random number in 0..1 for each cell.
fn voronoi_edges(texcoord: vec2f, scale: f32, jitter: f32, thickness: f32) -> VoronoiPoint {
    let p = texcoord * scale;
    let pixel = pixel_width2(p);
    let home = floor(p);
    let spread = clamp(jitter, 0.0, 1.0);
    var nearest = home;
    var to_nearest = vec2f(1e3);
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let cell = home + vec2f(f32(x), f32(y));
            let offset = cell - p + cell_point2(hash_cell2(cell), spread);
            let closer = dot(offset, offset) < dot(to_nearest, to_nearest);
            to_nearest = select(to_nearest, offset, closer);
            nearest = select(nearest, cell, closer);
        }
    }
    // The neighbours that matter surround the nearest point's cell, not this one's.
    var edge = 1e3;
    for (var y = -2; y <= 2; y++) {
        for (var x = -2; x <= 2; x++) {
            let cell = nearest + vec2f(f32(x), f32(y));
            let offset = cell - p + cell_point2(hash_cell2(cell), spread);
            let between = offset - to_nearest;
            let separation = dot(between, between);
            let reach = dot(0.5 * (offset + to_nearest), between) * inverseSqrt(max(separation, 1e-8));
            edge = min(edge, select(1e3, reach, separation > 1e-8));
        }
    }
    let distance_left = max(edge, 0.0);
    let mask = filtered_edge(distance_left - 0.5 * clamp(thickness, 0.0, 1.0), max(pixel.x, pixel.y));
    return VoronoiPoint(mask, distance_left, cell_id2(nearest));
}

struct VoronoiPoint {
    mask: f32,
    edge_distance: f32,
    id: f32,
}
