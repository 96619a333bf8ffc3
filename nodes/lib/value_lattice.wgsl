//! use: hash, perlin
//! Value noise: a random number at each lattice point, blended by the quintic; within [-1, 1], mean 0.

/// 2D value noise, one feature per unit.
fn value_lattice2(p: vec2f) -> f32 {
    let cell = floor(p);
    let w = quintic_fade2(p - cell);
    let low = mix(
        hash_to_unit(hash_cell2(cell).x),
        hash_to_unit(hash_cell2(cell + vec2f(1.0, 0.0)).x),
        w.x,
    );
    let high = mix(
        hash_to_unit(hash_cell2(cell + vec2f(0.0, 1.0)).x),
        hash_to_unit(hash_cell2(cell + vec2f(1.0, 1.0)).x),
        w.x,
    );
    return mix(low, high, w.y) * 2.0 - 1.0;
}

/// Random number in [0, 1) of one lattice point.
fn value_corner3(point: vec3f) -> f32 {
    return hash_to_unit(hash_cell3(point).x);
}

/// 3D value noise, one feature per unit.
fn value_lattice3(p: vec3f) -> f32 {
    let cell = floor(p);
    let w = quintic_fade3(p - cell);
    let x00 = mix(value_corner3(cell), value_corner3(cell + vec3f(1.0, 0.0, 0.0)), w.x);
    let x10 = mix(value_corner3(cell + vec3f(0.0, 1.0, 0.0)), value_corner3(cell + vec3f(1.0, 1.0, 0.0)), w.x);
    let x01 = mix(value_corner3(cell + vec3f(0.0, 0.0, 1.0)), value_corner3(cell + vec3f(1.0, 0.0, 1.0)), w.x);
    let x11 = mix(value_corner3(cell + vec3f(0.0, 1.0, 1.0)), value_corner3(cell + vec3f(1.0, 1.0, 1.0)), w.x);
    return mix(mix(x00, x10, w.y), mix(x01, x11, w.y), w.z) * 2.0 - 1.0;
}
