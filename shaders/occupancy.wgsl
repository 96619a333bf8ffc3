//! label: Depths of a tile
//! kind: image
//! use: fullscreen, light_space
//! Which depths occur in each tile of a moment map and in what a filter reaches around it: the nearest, the farthest, and which of 32 even steps between them, in two numbers of 16 bits, divided by 65535. It tells how far occluders lie apart, and so how much light can bleed.
//! option width: 1 | 3 | 5 | 7 | 9 | 11 | 13 | 15 | 17 | 19 | 21 | 23 | 25 = 5 - Texels across the blur of the map, in the light's coarsest view.
//! option downsample: 1 | 2 | 4 = 1 - Texels of the source on a side of a texel that the blur sees.
//! option scale: 16 = 16 - Texels of the source on a side of a tile.
//! target: rgba32float | rgba16unorm
//! reads: light

@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var<uniform> light: LightSpace;

const WIDTH: f32 = 5;
const DOWNSAMPLE: f32 = 1;
const SCALE: i32 = 16;
/// Most texels that are looked at around a tile.
const MAX_REACH: i32 = 128;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return fullscreen_position(vertex);
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(source)) - 1;
    // The blur and one texel of the sampler.
    let kernel = (0.5 * WIDTH * light_zoom(light) + 1.0) * DOWNSAMPLE;
    let reach = min(vec2i(ceil(kernel)), vec2i(MAX_REACH));
    let low = clamp(vec2i(pixel.xy) * SCALE - reach, vec2i(0), last);
    let high = clamp(vec2i(pixel.xy) * SCALE + SCALE - 1 + reach, vec2i(0), last);
    var nearest = 1e9;
    var farthest = 0.0;
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            let depth = textureLoad(source, vec2i(x, y), 0).x;
            nearest = min(nearest, depth);
            farthest = max(farthest, depth);
        }
    }
    let steps = 32.0 / max(farthest - nearest, 1e-9);
    var seen = 0u;
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            let depth = textureLoad(source, vec2i(x, y), 0).x;
            seen |= 1u << u32(clamp((depth - nearest) * steps, 0.0, 31.0));
        }
    }
    return vec4f(nearest, farthest, f32(seen & 0xffffu) / 65535.0, f32(seen >> 16u) / 65535.0);
}
