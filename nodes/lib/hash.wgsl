//! Hashes of lattice cells: integer arithmetic alone, so every adapter agrees bit for bit.
//! PCG hashes for two and three numbers from Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3).

/// Mixes two numbers into two.
fn pcg2d(seed: vec2u) -> vec2u {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> vec2u(16u);
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    return v ^ (v >> vec2u(16u));
}

/// Mixes three numbers into three.
fn pcg3d(seed: vec3u) -> vec3u {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

/// Hash of the 2D lattice cell whose lowest corner is `corner` (whole numbers, also negative).
fn hash_cell2(corner: vec2f) -> vec2u {
    return pcg2d(bitcast<vec2u>(vec2i(corner)));
}

/// Hash of the 3D lattice cell whose lowest corner is `corner` (whole numbers, also negative).
fn hash_cell3(corner: vec3f) -> vec3u {
    return pcg3d(bitcast<vec3u>(vec3i(corner)));
}

/// The upper 24 bits of a hash as a number in [0, 1): every value is exact in f32.
fn hash_to_unit(hash: u32) -> f32 {
    return f32(hash >> 8u) * 5.9604645e-8;
}

/// `hash_to_unit` for two numbers.
fn hash_to_unit2(hash: vec2u) -> vec2f {
    return vec2f(hash >> vec2u(8u)) * 5.9604645e-8;
}

/// `hash_to_unit` for three numbers.
fn hash_to_unit3(hash: vec3u) -> vec3f {
    return vec3f(hash >> vec3u(8u)) * 5.9604645e-8;
}
