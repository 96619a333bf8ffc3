//! label: Sum
//! kind: compute
//! Along each axis, every texel becomes the sum of itself and all before it: a summed-area table (Crow 1984) by recursive doubling (Hensley and others 2005, section 3). A step adds four sums that lie its distance apart, and the next step's distance is four times that; texels that have no others before them are done and are copied. Whole numbers that run over are right modulo 2^32.
//! option format: rg32uint | rg32float = rg32uint - Format of what is read and made.
//! option axis: x | y = x - Direction of this run.
//! option build: compute | image = compute - By a compute shader here, or by drawing, in another pass.
//! axes: x | y
//! repeat: doubling 4
//! skip: build == image
//! otherwise: sum_drawn
//! target: rg32uint | rg32float

//#if format == rg32uint
@group(0) @binding(0) var source: texture_2d<u32>;
@group(0) @binding(1) var destination: texture_storage_2d<rg32uint, write>;
//#else
@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var destination: texture_storage_2d<rg32float, write>;
//#end
@group(0) @binding(3) var<uniform> distance: u32;

@compute @workgroup_size(8, 8)
fn cs_main(@builtin(global_invocation_id) id: vec3u) {
    if (any(id.xy >= textureDimensions(source))) {
        return;
    }
    var sum = textureLoad(source, id.xy, 0);
//#if axis == x
    let step = vec2u(distance, 0u);
    let before = id.x / distance;
//#else
    let step = vec2u(0u, distance);
    let before = id.y / distance;
//#end
    for (var i = 1u; i <= min(before, 3u); i++) {
        sum += textureLoad(source, id.xy - i * step, 0);
    }
    textureStore(destination, id.xy, sum);
}
