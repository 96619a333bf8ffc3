//! label: Cross Product
//! category: math
//! synonyms: cross, vector product, perpendicular, vector math
//! inline
//! The vector at right angles to two others, as long as the parallelogram between them is large.

/// a (number): First vector.
/// b (number): Second vector.
/// -> cross (number): x cross y is z.
fn cross_product(a: vec3f, b: vec3f) -> vec3f {
    return cross(a, b);
}
