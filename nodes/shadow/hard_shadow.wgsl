//! label: Hard shadow
//! category: shadow
//! synonyms: shadow map, sharp shadow, unfiltered shadow
//! use: receiver
//! Shadow by one comparison with the nearest texel of a depth map (Williams 1978): cheap, with stairs at the edges. The comparison is with the receiving plane at that texel's centre, so no bias has to be tuned.
//! option metric: linear | zw | radial = linear - How depth is measured: evenly along the light's axis, as projection matrices leave it, or by the distance from the light. All are linear in parallel light.
//! option cull: none | front | back = none - Sides of triangles that are left out.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 2048 - Texels on a side of the map.
//! map map: depth(size=$size, metric=$metric, cull=$cull)
//! sampler map_sampler: compare=on filter=nearest address=clamp

/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Depth of the nearest surface.
/// map_sampler (sampler; hidden): Compares with one texel.
/// bias (distance; = 0; 0..; in m): Extra distance by which an occluder must be nearer to the light, for surfaces that the plane does not describe.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn hard_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_depth_2d_array,
    map_sampler: sampler_comparison,
    bias: f32,
    receives: f32,
) -> f32 {
    let normal = geometric_normal(point);
    let position = light_position(space, point);
    let layer = light_layer(space);
    let plane = receiver_plane(space, position, normal);
    let size = vec2f(textureDimensions(map));
    let rounding = receiver_rounding(receiver_slope(space, plane) / size) + receiver_curvature(space, plane, size, 0.5);
    let margin = bias * space.depth.z + rounding;
    let center = (floor(plane.uv * size) + 0.5) / size;
    let depth = compared_at(space, plane, center, margin);
    let visibility = textureSampleCompareLevel(map, map_sampler, center, layer, depth);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}

/// Depth that the texel at `uv` must not be nearer than; the margin is in linear depth.
//#if metric == linear
fn compared_at(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> f32 {
    return receiver_depth(space, plane, uv) - margin;
}
//#elif metric == zw
fn compared_at(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> f32 {
    return receiver_depth_zw_less(space, plane, uv, margin);
}
//#else
fn compared_at(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> f32 {
    return receiver_depth_radial_less(space, plane, uv, margin);
}
//#end
