//! label: White Noise
//! category: procedural
//! synonyms: random, hash, static, cell noise
//! use: hash, box_filter
//! A random number and a random colour for each cube of a lattice throughout space, fixed to the object; neighbouring
//! cubes have nothing to do with each other. Cubes too small to be seen fade to the mean.
//! cheaper: constant - The mean of the pattern.

/// position (point object; = @position_object): Where to look the noise up.
/// scale (scalar; = 10): Cubes per metre.
/// seed (scalar; = 0): Another whole number gives other values.
/// -> value (scalar): Evenly distributed random number of the cube; from 0 to less than 1, and 0.5 where cubes are smaller than a pixel.
/// -> color (color): Three more of them, which do not depend on the first.
fn white_noise(position: vec3f, scale: f32, seed: f32) -> WhiteNoisePoint {
    // A face that lies exactly on a cube boundary would be torn between both cubes by rounding.
    let cell = floor(position * scale + 1e-3);
    let first = pcg3d(hash_cell3(cell) ^ vec3u(bitcast<u32>(i32(seed))));
    let width = pixel_width3(position * scale);
    // Full contrast down to cubes of two pixels, none below one: a pixel would see one of many cubes at random.
    let contrast = detail_left(0.5 * max(width.x, max(width.y, width.z)));
    let value = 0.5 + contrast * (hash_to_unit(first.x) - 0.5);
    return WhiteNoisePoint(value, 0.5 + contrast * (hash_to_unit3(pcg3d(first)) - 0.5));
}

struct WhiteNoisePoint {
    value: f32,
    color: vec3f,
}
