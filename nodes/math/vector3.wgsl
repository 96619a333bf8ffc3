//! label: Vector 3
//! category: math
//! synonyms: vec3, xyz, constant vector, three numbers, float3
//! inline
//! Three numbers to set by hand.

/// vector (number; = (0, 0, 0)): The numbers.
/// -> vector (number): The same numbers.
fn vector3(vector: vec3f) -> vec3f {
    return vector;
}
