//! use: hash, lattice_gradients, fractal
//! Gradient noise on the square and cubic lattice (Perlin 2002, "Improving Noise"): zero at lattice points, within
//! [-1, 1], mean 0. The scale factors are one over the largest sum that the gradients allow.

/// The quintic blend 6t^5 - 15t^4 + 10t^3, whose first and second derivatives vanish at 0 and 1.
fn quintic_fade2(t: vec2f) -> vec2f {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

/// `quintic_fade2` for three numbers.
fn quintic_fade3(t: vec3f) -> vec3f {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

/// 2D Perlin noise, one feature per unit.
fn perlin_noise2(p: vec2f) -> f32 {
    let cell = floor(p);
    let f = p - cell;
    let w = quintic_fade2(f);
    let low = mix(
        lattice_gradient2(hash_cell2(cell).x, f),
        lattice_gradient2(hash_cell2(cell + vec2f(1.0, 0.0)).x, f - vec2f(1.0, 0.0)),
        w.x,
    );
    let high = mix(
        lattice_gradient2(hash_cell2(cell + vec2f(0.0, 1.0)).x, f - vec2f(0.0, 1.0)),
        lattice_gradient2(hash_cell2(cell + vec2f(1.0, 1.0)).x, f - vec2f(1.0, 1.0)),
        w.x,
    );
    return mix(low, high, w.y) * 1.4142135;
}

/// Gradient term of one corner of a cubic cell.
fn perlin_corner3(cell: vec3f, f: vec3f, corner: vec3f) -> f32 {
    return lattice_gradient3(hash_cell3(cell + corner).x, f - corner);
}

/// Gradient terms of the four corners of a cubic cell that share an x: y differs first, then z.
fn perlin_side3(cell: vec3f, f: vec3f, x: f32) -> vec4f {
    return vec4f(
        perlin_corner3(cell, f, vec3f(x, 0.0, 0.0)),
        perlin_corner3(cell, f, vec3f(x, 1.0, 0.0)),
        perlin_corner3(cell, f, vec3f(x, 0.0, 1.0)),
        perlin_corner3(cell, f, vec3f(x, 1.0, 1.0)),
    );
}

/// 3D Perlin noise, one feature per unit.
fn perlin_noise3(p: vec3f) -> f32 {
    let cell = floor(p);
    let f = p - cell;
    let w = quintic_fade3(f);
    let x = mix(perlin_side3(cell, f, 0.0), perlin_side3(cell, f, 1.0), w.x);
    let y = mix(x.xz, x.yw, w.y);
    return mix(y.x, y.y, w.z) * 0.9649214;
}

/// Mean of |perlin_noise3|, measured over 4 million points.
const PERLIN3_MEAN_ABSOLUTE: f32 = 0.2116;

/// Mean of (1 - |perlin_noise3|)^2, measured over 4 million points.
const PERLIN3_MEAN_RIDGE: f32 = 0.6442;

/// Turbulence (Perlin 1985): five octaves of |perlin_noise3|, each twice as fine and half as strong; 0..1.
/// `footprint` is the size of a pixel in units of `p`.
fn perlin_turbulence5(p: vec3f, footprint: f32) -> f32 {
    var sum = 0.0;
    var amplitude = 0.5161290;
    var frequency = 1.0;
    for (var octave = 0; octave < 5; octave++) {
        let noise = abs(perlin_noise3(p * frequency + octave_shift3(octave)));
        sum += amplitude * mix(PERLIN3_MEAN_ABSOLUTE, noise, detail_left(footprint * frequency));
        amplitude *= 0.5;
        frequency *= 2.0;
    }
    return sum;
}
