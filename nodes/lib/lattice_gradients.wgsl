//! Gradients that lattice points are given: few and of equal length, so that a noise has a known bound.

/// Dot product of `offset` with one of eight unit vectors, chosen by the upper three bits of the hash.
fn lattice_gradient2(hash: u32, offset: vec2f) -> f32 {
    let negated = vec2f(
        select(offset.x, -offset.x, (hash & 0x80000000u) != 0u),
        select(offset.y, -offset.y, (hash & 0x40000000u) != 0u),
    );
    let diagonal = (negated.x + negated.y) * 0.70710678;
    // The four axis vectors: the second bit picks the axis, the first its sign.
    let along = select(offset.x, offset.y, (hash & 0x40000000u) != 0u);
    let axis = select(along, -along, (hash & 0x80000000u) != 0u);
    return select(axis, diagonal, (hash & 0x20000000u) != 0u);
}

/// Dot product of `offset` with one of the twelve edge midpoints of a cube of side 2 (Perlin 2002; length sqrt 2).
fn lattice_gradient3(hash: u32, offset: vec3f) -> f32 {
    let choice = hash % 12u;
    let first = select(offset.x, offset.y, choice >= 8u);
    let second = select(offset.z, offset.y, choice < 4u);
    return select(first, -first, (choice & 1u) != 0u) + select(second, -second, (choice & 2u) != 0u);
}
