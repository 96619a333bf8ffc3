//! label: Geometric Normal
//! category: geometry
//! synonyms: flat normal, face normal, facet normal, true normal, flat shading, low poly
//! use: unit_vectors
//! The normal of the flat facet that the pixel lies in, facing the camera.
//! It is the cross product of the point's change to the next pixel across and down, so it follows any point that is
//! linked to it, moved ones too.

/// point (point world; = @position_world): The point whose facets are wanted.
/// to_camera (direction world unit; = @to_camera): Towards the eye; also the answer where a facet has no area.
/// -> normal (normal world unit): The facet's normal, on the camera's side.
fn facet_normal(point: vec3f, to_camera: vec3f) -> vec3f {
    // Unit edges, because the product of two short ones would leave the range of f32 in close views.
    let facet = cross(unit_or_zero(dpdx(point)), unit_or_zero(dpdy(point)));
    let normal = unit_or_zero(select(facet, -facet, dot(facet, to_camera) < 0.0));
    return select(normal, to_camera, dot(normal, normal) < 0.5);
}
