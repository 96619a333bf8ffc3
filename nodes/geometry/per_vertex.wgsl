//! label: Per Vertex
//! category: geometry
//! synonyms: vertex rate, interpolate, gouraud, level of detail, cheap
//! inline
//! vertex
//! generic T: f32 | vec2f | vec3f | vec4f
//! Computes what feeds it for each vertex of a mesh, and interpolates in between: cheap where triangles are small, and
//! coarse where they are large. What only fragments know, such as pictures, derivatives and shadows, makes it do nothing.

alias T = f32;

/// value (number): What is computed for each vertex.
/// -> value (number): The same, interpolated.
fn per_vertex(value: T) -> T {
    return value;
}
