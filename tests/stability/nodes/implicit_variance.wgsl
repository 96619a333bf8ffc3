//! label: Variance shadow with implicit gradients
//! category: shadow
//! use: light_space
//! A variance shadow whose sampler takes the footprint from differences of map coordinates within a quad, which mean nothing where the quad's pixels are on different maps.
//! option size: 256 | 512 | 1024 = 512 - Texels on a side of the map.
//! option anisotropy: 1 | 16 = 1 - Longest footprint.
//! map map: moments(size=$size) > blur(width=5, weights=gaussian) > mips(levels=on)
//! sampler map_sampler: filter=trilinear address=clamp anisotropy=$anisotropy

/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Moments.
/// map_sampler (sampler; hidden): Filters moments.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn implicit_variance(
    point: vec3f,
    space: LightSpace,
    map: texture_2d_array<f32>,
    map_sampler: sampler,
) -> f32 {
    let position = light_position(space, point);
    let uv = light_map_uv(space, position);
    let moments = textureSample(map, map_sampler, uv, light_layer(space)).xy;
    let depth = min(max(light_linear_depth(space, position.z), 0.0), max(moments.x, 1.0));
    let variance = max(moments.y - moments.x * moments.x, 1e-6);
    let behind = max(depth - moments.x, 0.0);
    let bound = variance / (variance + behind * behind);
    let visibility = saturate((bound - 0.18) / 0.82);
    return select(visibility, 1.0, outside_light_map(space, position, uv));
}
