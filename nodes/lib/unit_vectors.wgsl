//! Lengths made one without a division by zero.

/// The vector scaled to length one; a zero vector stays zero.
fn unit_or_zero(v: vec3f) -> vec3f {
    return v * inverseSqrt(max(dot(v, v), 1e-36));
}
