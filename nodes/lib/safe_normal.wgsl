//! Unit normals without a division by zero.

/// `v` at length one, or `otherwise` where `v` is too short to have a direction.
fn unit_normal_or(v: vec3f, otherwise: vec3f) -> vec3f {
    let squared = dot(v, v);
    return select(otherwise, v * inverseSqrt(max(squared, 1e-36)), squared > 1e-30);
}
