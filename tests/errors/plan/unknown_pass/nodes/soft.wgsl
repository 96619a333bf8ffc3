//! label: Soft
//! category: shadow
//! use: light_space
//! map shadow_map: deepth > moments

/// point (point world; = @position_world): The shaded point.
/// space (space; hidden): The light's space.
/// shadow_map (map; hidden): Depths.
/// -> visibility (scalar visibility): Share of light.
fn soft(point: vec3f, space: LightSpace, shadow_map: texture_2d<f32>) -> f32 {
    return textureLoad(shadow_map, vec2i(0), 0).x;
}
