//! label: Summands
//! kind: image
//! use: fullscreen
//! Moments of depth as the numbers that a summed-area table adds up (Crow 1984): depth and its square where both are within the light's range. Whole numbers are exact however many are added, even where their sum runs over, so that a filter of up to 2^(32 - fraction_bits) texels loses nothing to the size of the map; what it loses is the rounding to 2^-fraction_bits. Floats lose the more the larger their sums are: centred ones are depth minus 1/2, and the square of that minus 1/8, the middles of their ranges (Hensley and others 2005, section 5, for depth).
//! option storage: uint32 | centred | float32 = uint32 - What is added: whole numbers of 2^-fraction_bits, floats around 0, or floats as they come.
//! option fraction_bits: 16 | 18 | 20 | 22 = 18 - Digits after the binary point of whole numbers.
//! option format: rg32uint | rg32float = rg32uint - Format of the target: whole numbers need the first, floats the second.
//! target: rg32uint | rg32float

@group(0) @binding(0) var source: texture_2d<f32>;
//#if storage == uint32

const FRACTION_BITS: u32 = 18;
//#end

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return fullscreen_position(vertex);
}

@fragment
//#if storage == uint32
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec2u {
//#else
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec2f {
//#end
    let moments = textureLoad(source, vec2i(pixel.xy), 0).xy;
    // What lies beyond the far plane counts as lying in it: deeper texels would leave no digits to the others.
    let mean = saturate(moments.x);
    // A square is never less than that of the mean, nor more than the mean.
    let square = clamp(moments.y, mean * mean, mean);
//#if storage == uint32
    return vec2u(round(vec2f(mean, square) * f32(1u << FRACTION_BITS)));
//#elif storage == centred
    let centred = mean - 0.5;
    // E[(z - 1/2)^2] = E[z^2] - E[z] + 1/4, written so that the variance of one texel survives rounding.
    return vec2f(centred, (square - mean * mean) + centred * centred - 0.125);
//#else
    return vec2f(mean, square);
//#end
}
