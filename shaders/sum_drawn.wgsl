//! label: Sum, drawn
//! kind: image
//! use: fullscreen
//! What the pass `sum` makes, without a compute shader: for adapters that cannot store to textures of its formats.
//! option format: rg32uint | rg32float = rg32uint - Format of what is read and made.
//! option axis: x | y = x - Direction of this run.
//! option build: compute | image = image - By drawing here, or by a compute shader, in another pass.
//! axes: x | y
//! repeat: doubling 4
//! skip: build == compute
//! target: rg32uint | rg32float

//#if format == rg32uint
@group(0) @binding(0) var source: texture_2d<u32>;
//#else
@group(0) @binding(0) var source: texture_2d<f32>;
//#end
@group(0) @binding(3) var<uniform> distance: u32;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return fullscreen_position(vertex);
}

@fragment
//#if format == rg32uint
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4u {
//#else
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
//#end
    let texel = vec2u(pixel.xy);
    var sum = textureLoad(source, texel, 0);
//#if axis == x
    let step = vec2u(distance, 0u);
    let before = texel.x / distance;
//#else
    let step = vec2u(0u, distance);
    let before = texel.y / distance;
//#end
    for (var i = 1u; i <= min(before, 3u); i++) {
        sum += textureLoad(source, texel - i * step, 0);
    }
    return sum;
}
