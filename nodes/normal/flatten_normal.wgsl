//! label: Flatten Normal
//! category: geometry
//! synonyms: normal strength, soften normal, weaken bump
//! use: safe_normal
//! Bends a normal back towards that of the smooth surface.

/// bent (normal world unit): Normal from a normal map or bump.
/// amount (scalar; = 0.5; 0..1): 0 leaves it as it is, 1 gives the smooth surface.
/// normal (normal world near; = @normal_world; hidden): Normal of the smooth surface.
/// -> normal (normal world unit): The flattened normal.
fn flatten_normal(bent: vec3f, amount: f32, normal: vec3f) -> vec3f {
    let flat_normal = unit_normal_or(normal, vec3f(0.0, 1.0, 0.0));
    return unit_normal_or(mix(bent, flat_normal, clamp(amount, 0.0, 1.0)), flat_normal);
}
