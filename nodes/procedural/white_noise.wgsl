//! label: White Noise
//! category: procedural
//! synonyms: random, hash, static, cell noise
//! use: hash
//! A random number and a random colour for each cube of a lattice throughout space, fixed to the object; neighbouring
//! cubes have nothing to do with each other.

/// position (point object; = @position_object): Where to look the noise up.
/// scale (scalar; = 10): Cubes per metre.
/// seed (scalar; = 0): Another whole number gives other values.
/// -> value (scalar): Evenly distributed random number of the cube; from 0 to less than 1.
/// -> color (color): Three more of them, which do not depend on the first.
fn white_noise(position: vec3f, scale: f32, seed: f32) -> WhiteNoisePoint {
    // A face that lies exactly on a cube boundary would be torn between both cubes by rounding.
    let cell = floor(position * scale + 1e-3);
    let first = pcg3d(hash_cell3(cell) ^ vec3u(bitcast<u32>(i32(seed))));
    return WhiteNoisePoint(hash_to_unit(first.x), hash_to_unit3(pcg3d(first)));
}

struct WhiteNoisePoint {
    value: f32,
    color: vec3f,
}
