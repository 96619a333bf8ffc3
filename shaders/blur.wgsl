//! label: Blur
//! kind: image
//! use: kernel, fullscreen
//! One axis of a separable blur; edge texels are repeated. The weights are those of percentage-closer filtering, normalised. The target has the format of the source.
//! option width: 1 | 3 | 5 | 7 | 9 | 11 = 5 - Texels across.
//! option weights: gaussian | box | tent = gaussian - Shape of the kernel.
//! option axis: x | y = x - Direction of this run.
//! axes: x | y
//! skip: width == 1
//! target: rg32float | rg16unorm | rg16float

@group(0) @binding(0) var source: texture_2d<f32>;

const WIDTH: i32 = 5;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return fullscreen_position(vertex);
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(source)) - 1;
    let center = vec2i(pixel.xy);
    var sum = vec4f(0.0);
    var total = 0.0;
    for (var offset = -(WIDTH / 2); offset <= WIDTH / 2; offset++) {
//#if weights == gaussian
        let weight = kernel_gaussian(offset, WIDTH);
//#elif weights == box
        let weight = kernel_box(offset, WIDTH);
//#else
        let weight = kernel_tent(offset, WIDTH);
//#end
//#if axis == x
        let texel = center + vec2i(offset, 0);
//#else
        let texel = center + vec2i(0, offset);
//#end
        sum += weight * textureLoad(source, clamp(texel, vec2i(0), last), 0);
        total += weight;
    }
    return sum / total;
}
