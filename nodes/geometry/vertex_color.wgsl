//! label: Vertex Color
//! category: geometry
//! synonyms: color attribute, vertex paint, mesh color, vertex alpha, attribute
//! The colour that is painted on the mesh's vertices.

/// The two parts of a vertex colour.
struct VertexColor {
    color: vec3f,
    alpha: f32,
}

/// painted (color; = @vertex_color; hidden): The vertices' colours, interpolated.
/// -> color (color): Red, green and blue, linear.
/// -> alpha (scalar): The fourth component: cover, or any mask that was painted there.
fn vertex_color(painted: vec4f) -> VertexColor {
    return VertexColor(painted.rgb, painted.a);
}
