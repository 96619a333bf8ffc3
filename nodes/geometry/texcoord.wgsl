//! label: Texture Coordinates
//! category: geometry
//! synonyms: uv, uv map, texture coordinate, st, mapping, attribute
//! inline
//! The texture coordinates of the shaded point, as the mesh has them.

/// coordinates (texcoord; = @texcoord; hidden): The vertices' texture coordinates, interpolated.
/// -> texcoord (texcoord): The texture coordinates; the mesh's chart usually fills 0..1 on both axes.
fn texcoord(coordinates: vec2f) -> vec2f {
    return coordinates;
}
