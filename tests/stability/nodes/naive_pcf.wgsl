//! label: Naive PCF
//! category: shadow
//! use: light_space
//! Percentage-closer filtering with one depth for all taps, less a constant bias: what needs tuning.
//! option width: 1 | 3 | 5 | 7 = 5 - Texels across.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 256 - Texels on a side of the map.
//! map map: depth(size=$size)
//! sampler map_sampler: compare=on filter=nearest address=clamp

const WIDTH: i32 = 5;

/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Depth.
/// map_sampler (sampler; hidden): Compares.
/// bias (distance; = 0; 0..; in m): Subtracted from the receiver's depth.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn naive_pcf(
    point: vec3f,
    space: LightSpace,
    map: texture_depth_2d_array,
    map_sampler: sampler_comparison,
    bias: f32,
) -> f32 {
    let position = light_position(space, point);
    let size = vec2f(textureDimensions(map));
    let depth = saturate(light_linear_depth(space, position.z - bias));
    let texel = floor(light_map_uv(space, position) * size) + 0.5;
    var sum = 0.0;
    for (var y = -(WIDTH / 2); y <= WIDTH / 2; y++) {
        for (var x = -(WIDTH / 2); x <= WIDTH / 2; x++) {
            let uv = (texel + vec2f(f32(x), f32(y))) / size;
            sum += textureSampleCompareLevel(map, map_sampler, uv, light_layer(space), depth);
        }
    }
    return sum / f32(WIDTH * WIDTH);
}
