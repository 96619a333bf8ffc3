//! label: Place in a map
//! category: geometry
//! use: light_space
//! Where a light's first view sees the shaded point.

/// point (point world; = @position_world): The shaded point.
/// space (space): Of a light.
/// -> place (number): In its map.
fn map_depth(point: vec3f, space: LightSpace) -> vec3f {
    return light_position(space, point);
}
