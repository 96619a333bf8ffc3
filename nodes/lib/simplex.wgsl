//! use: hash, lattice_gradients
//! Gradient noise on the triangular and tetrahedral lattice (Perlin 2001; construction as in Gustavson 2005); within
//! [-1, 1], mean 0. The kernel is (1/2 - r^2)^4, which is zero before the next simplex begins, so there is no seam.

/// Share of one lattice point, `offset` away from it.
fn simplex_corner2(point: vec2f, offset: vec2f) -> f32 {
    let k = max(0.5 - dot(offset, offset), 0.0);
    return k * k * k * k * lattice_gradient2(hash_cell2(point).x, offset);
}

/// 2D simplex noise.
fn simplex_noise2(p: vec2f) -> f32 {
    // Skewing by (sqrt 3 - 1) / 2 makes triangles half squares; (3 - sqrt 3) / 6 takes them back.
    let cell = floor(p + (p.x + p.y) * 0.36602540);
    let first = p - cell + (cell.x + cell.y) * 0.21132487;
    let middle = select(vec2f(0.0, 1.0), vec2f(1.0, 0.0), first.x > first.y);
    let sum = simplex_corner2(cell, first)
        + simplex_corner2(cell + middle, first - middle + 0.21132487)
        + simplex_corner2(cell + 1.0, first - 0.57735027);
    return sum * 99.204;
}

/// Share of one lattice point, `offset` away from it.
fn simplex_corner3(point: vec3f, offset: vec3f) -> f32 {
    let k = max(0.5 - dot(offset, offset), 0.0);
    return k * k * k * k * lattice_gradient3(hash_cell3(point).x, offset);
}

/// 3D simplex noise.
fn simplex_noise3(p: vec3f) -> f32 {
    // Skewing by 1/3 makes tetrahedra sixths of cubes; 1/6 takes them back.
    let cell = floor(p + (p.x + p.y + p.z) / 3.0);
    let first = p - cell + (cell.x + cell.y + cell.z) / 6.0;
    // Walk from the lowest to the highest corner along the largest coordinate first; ties go x, y, z.
    let x_first = first.x >= first.y;
    let y_first = first.y >= first.z;
    let x_over_z = first.x >= first.z;
    let one = vec3f(
        select(0.0, 1.0, x_first && x_over_z),
        select(0.0, 1.0, !x_first && y_first),
        select(0.0, 1.0, !x_over_z && !y_first),
    );
    let two = vec3f(
        select(0.0, 1.0, x_first || x_over_z),
        select(0.0, 1.0, !x_first || y_first),
        select(0.0, 1.0, !(x_over_z && y_first)),
    );
    let sum = simplex_corner3(cell, first)
        + simplex_corner3(cell + one, first - one + 1.0 / 6.0)
        + simplex_corner3(cell + two, first - two + 1.0 / 3.0)
        + simplex_corner3(cell + 1.0, first - 0.5);
    return sum * 76.88;
}
