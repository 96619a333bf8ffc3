//! label: Blur
//! kind: image
//! use: spread_kernel, fullscreen, split_halves, light_space
//! One axis of a separable blur; edge texels are repeated. The weights are those of percentage-closer filtering, and sum to 1 before anything is summed, so that formats that nearly overflow do not. The target has the format of the source.
//! option width: 1 | 3 | 5 | 7 | 9 | 11 | 13 | 15 | 17 | 19 | 21 | 23 | 25 = 5 - Texels across, in the light's coarsest view.
//! option weights: gaussian | box | tent = gaussian - Shape of the kernel.
//! option zoom: on | off = on - As wide in metres in every view of the light: wider in texels where a view is zoomed in (Lauritzen 2007, parallel splits). On lights with one view, or equal ones, it changes nothing.
//! option domain: plain | log = plain - Whether values are averaged, or their exponentials, as of a map that holds logarithms.
//! option exponent: 5 | 11 | 20 | 40 | 80 = 80 - What values are multiplied by in the exponential.
//! option axis: x | y = x - Direction of this run.
//! option format: auto | rg32float | rg16unorm | rg16float | split = auto - Storage. split: two values, each split over two halves.
//! axes: x | y
//! skip: width == 1
//! target: r32float | r16unorm | r16float | rg32float | rg16unorm | rg16float | rgba32float | rgba16unorm | rgba16float
//#if zoom == on
//! reads: light
//#end

@group(0) @binding(0) var source: texture_2d<f32>;
//#if zoom == on
@group(0) @binding(1) var<uniform> light: LightSpace;
//#end

const WIDTH: f32 = 5;
//#if zoom == on
/// Most texels to either side.
const MAX_REACH: i32 = 128;
//#end
//#if domain == log
const EXPONENT: f32 = 80.0;
//#end

fn kernel_weight(offset: i32, width: f32) -> f32 {
//#if weights == gaussian
    return spread_gaussian(offset, width);
//#elif weights == box
    return spread_box(offset, width);
//#else
    return spread_tent(offset, width);
//#end
}

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return fullscreen_position(vertex);
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(source)) - 1;
    let center = vec2i(pixel.xy);
//#if zoom == on
//#if axis == x
    let width = max(WIDTH * light_zoom(light).x, 1.0);
//#else
    let width = max(WIDTH * light_zoom(light).y, 1.0);
//#end
    let reach = min(i32(ceil(0.5 * width - 0.5)), MAX_REACH);
//#else
    let width = WIDTH;
    let reach = i32(0.5 * WIDTH);
//#end
    var total = 0.0;
    for (var offset = -reach; offset <= reach; offset++) {
        total += kernel_weight(offset, width);
    }
    var sum = vec4f(0.0);
//#if domain == log
    let base = textureLoad(source, center, 0);
//#end
    for (var offset = -reach; offset <= reach; offset++) {
        let weight = kernel_weight(offset, width) / total;
//#if axis == x
        let place = center + vec2i(offset, 0);
//#else
        let place = center + vec2i(0, offset);
//#end
        let texel = textureLoad(source, clamp(place, vec2i(0), last), 0);
//#if domain == log
        sum += weight * exp(EXPONENT * (texel - base));
//#elif format == split
        sum += weight * vec4f(join_halves(texel), 0.0, 0.0);
//#else
        sum += weight * texel;
//#end
    }
//#if domain == log
    return base + log(sum) / EXPONENT;
//#elif format == split
    return split_halves(sum.xy);
//#else
    return sum;
//#end
}
