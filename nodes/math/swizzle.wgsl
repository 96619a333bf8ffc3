//! label: Swizzle
//! category: math
//! synonyms: reorder, shuffle components, permute, swap axes, y up to z up, channel swap
//! inline
//! Takes the components of a vector in another order.
//! option first: x | y | z = x - Which component becomes the first.
//! option second: x | y | z = y - Which component becomes the second.
//! option third: x | y | z = z - Which component becomes the third.

/// vector (number): The vector.
/// -> reordered (number): The vector of the chosen components.
fn swizzle(vector: vec3f) -> vec3f {
    return vec3f(
//#if first == x
        vector.x,
//#elif first == y
        vector.y,
//#else
        vector.z,
//#end
//#if second == x
        vector.x,
//#elif second == y
        vector.y,
//#else
        vector.z,
//#end
//#if third == x
        vector.x,
//#elif third == y
        vector.y,
//#else
        vector.z,
//#end
    );
}
