//! label: Arc Cosine
//! category: math
//! synonyms: acos, arccos, inverse cosine, trigonometry, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! The angle that has a given cosine: the angle between two unit vectors from their dot product.

alias T = f32;

/// x (number): The cosine; it is held within -1..1.
/// -> angle (number): In radians, from 0 to pi.
fn arc_cosine(x: T) -> T {
    return acos(clamp(x, T(-1.0), T(1.0)));
}
