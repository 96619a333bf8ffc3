//! label: Downsample
//! kind: image
//! use: fullscreen, split_halves
//! The exact average of blocks of texels, which makes the blur after it cheaper and wider. The target has the format of the source.
//! option scale: 1 | 2 | 4 = 1 - Texels on a side of a block.
//! option domain: plain | log = plain - Whether values are averaged, or their exponentials, as of a map that holds logarithms.
//! option exponent: 5 | 11 | 20 | 40 | 80 = 80 - What values are multiplied by in the exponential.
//! option format: auto | rg32float | rg16unorm | rg16float | split = auto - Storage. split: two values, each split over two halves.
//! skip: scale == 1
//! target: r32float | r16unorm | r16float | rg32float | rg16unorm | rg16float | rgba32float | rgba16unorm | rgba16float

@group(0) @binding(0) var source: texture_2d<f32>;

const SCALE: i32 = 2;
//#if domain == log
const EXPONENT: f32 = 80.0;
//#end

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return fullscreen_position(vertex);
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(source)) - 1;
    let first = vec2i(pixel.xy) * SCALE;
    var sum = vec4f(0.0);
//#if domain == log
    let base = textureLoad(source, min(first, last), 0);
//#end
    for (var y = 0; y < SCALE; y++) {
        for (var x = 0; x < SCALE; x++) {
            let texel = textureLoad(source, min(first + vec2i(x, y), last), 0);
//#if domain == log
            sum += exp(EXPONENT * (texel - base));
//#elif format == split
            sum += vec4f(join_halves(texel), 0.0, 0.0);
//#else
            sum += texel;
//#end
        }
    }
    let mean = sum / f32(SCALE * SCALE);
//#if domain == log
    return base + log(mean) / EXPONENT;
//#elif format == split
    return split_halves(mean.xy);
//#else
    return mean;
//#end
}
