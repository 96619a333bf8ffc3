//! label: Mip level
//! kind: mip
//! use: fullscreen, split_halves
//! One mip level as the exact average of the level above; levels of odd size take three texels instead of two. The target has the format of the source.
//! option levels: off | on = on - Whether the levels are made at all.
//! option domain: plain | log = plain - Whether values are averaged, or their exponentials, as of a map that holds logarithms.
//! option exponent: 5 | 11 | 20 | 40 | 80 = 80 - What values are multiplied by in the exponential.
//! option format: auto | rg32float | rg16unorm | rg16float | split = auto - Storage. split: two values, each split over two halves.
//! skip: levels == off
//! target: r32float | r16unorm | r16float | rg32float | rg16unorm | rg16float | rgba32float | rgba16unorm | rgba16float

// The level above, as a view of that level alone.
@group(0) @binding(0) var source: texture_2d<f32>;
//#if domain == log

const EXPONENT: f32 = 80.0;
//#end

/// Weights along one axis of texels 2i, 2i + 1 and 2i + 2: the share of target texel i that each of them covers.
fn axis_weights(size: i32, i: i32) -> vec3f {
    if (size == 1) {
        return vec3f(1.0, 0.0, 0.0);
    }
    if (size % 2 == 0) {
        return vec3f(0.5, 0.5, 0.0);
    }
    let middle = size / 2;
    return vec3f(f32(middle - i), f32(middle), f32(i + 1)) / f32(size);
}

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return fullscreen_position(vertex);
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let size = vec2i(textureDimensions(source));
    let target_texel = vec2i(pixel.xy);
    var weights_x = axis_weights(size.x, target_texel.x);
    var weights_y = axis_weights(size.y, target_texel.y);
    var sum = vec4f(0.0);
//#if domain == log
    let base = textureLoad(source, min(2 * target_texel, size - 1), 0);
//#end
    for (var y = 0; y < 3; y++) {
        for (var x = 0; x < 3; x++) {
            let weight = weights_x[x] * weights_y[y];
            if (weight > 0.0) {
                let texel = textureLoad(source, min(2 * target_texel + vec2i(x, y), size - 1), 0);
//#if domain == log
                sum += weight * exp(EXPONENT * (texel - base));
//#elif format == split
                sum += weight * vec4f(join_halves(texel), 0.0, 0.0);
//#else
                sum += weight * texel;
//#end
            }
        }
    }
//#if domain == log
    return base + log(sum) / EXPONENT;
//#elif format == split
    return split_halves(sum.xy);
//#else
    return sum;
//#end
}
