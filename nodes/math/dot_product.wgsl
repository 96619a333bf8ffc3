//! label: Dot Product
//! category: math
//! synonyms: dot, inner product, scalar product, cosine of angle, projection, vector math
//! inline
//! commutative
//! generic T: vec2f | vec3f | vec4f
//! The sum of the products of the components: for unit vectors the cosine of the angle between them.

alias T = vec2f;

/// a (number): First vector.
/// b (number): Second vector.
/// -> dot (number): The dot product.
fn dot_product(a: T, b: T) -> f32 {
    return dot(a, b);
}
