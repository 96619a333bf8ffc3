//! use: hash
//! Cellular noise: distances to points that are scattered one to a cell (Worley 1996).

/// Where the point of a 2D cell lies in it: `jitter` 0 puts it in the middle, 1 anywhere.
fn cell_point2(hash: vec2u, jitter: f32) -> vec2f {
    return 0.5 + (hash_to_unit2(hash) - 0.5) * jitter;
}

/// Where the point of a 3D cell lies in it: `jitter` 0 puts it in the middle, 1 anywhere.
fn cell_point3(hash: vec3u, jitter: f32) -> vec3f {
    return 0.5 + (hash_to_unit3(hash) - 0.5) * jitter;
}

/// A random number in [0, 1) for a cell, independent of where its point lies.
fn cell_id2(cell: vec2f) -> f32 {
    return hash_to_unit(hash_cell2(cell + vec2f(-1031.0, 4099.0)).x);
}

/// A random number in [0, 1) for a cell, independent of where its point lies.
fn cell_id3(cell: vec3f) -> f32 {
    return hash_to_unit(hash_cell3(cell + vec3f(-1031.0, 4099.0, 257.0)).x);
}
