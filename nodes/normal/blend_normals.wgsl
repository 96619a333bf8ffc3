//! label: Blend Normals
//! category: geometry
//! synonyms: detail normal, combine normals, reoriented normal mapping
//! use: safe_normal
//! Puts the relief of a detail normal on top of that of a base normal. Both are normals in the world, bent away from
//! the same smooth surface (methods compared by Barre-Brisebois and Hill 2012, "Blending in Detail").
//! option method: reoriented | whiteout | udn = reoriented - Turn the detail with the base, or add slopes.
//! cheaper: input base - The coarse relief alone.

/// base (normal world unit; = @normal_world): Normal with the coarse relief.
/// detail (normal world unit; = @normal_world): Normal with the fine relief.
/// strength (scalar; = 1; 0..1): How much of the detail is used.
/// normal (normal world near; = @normal_world; hidden): Normal of the smooth surface.
/// -> normal (normal world unit): Normal with both.
fn blend_normals(base: vec3f, detail: vec3f, strength: f32, normal: vec3f) -> vec3f {
    let up = unit_normal_or(normal, vec3f(0.0, 1.0, 0.0));
    let fine = unit_normal_or(mix(up, detail, strength), up);
//#if method == reoriented
    // The least rotation from `up` to `base` is a reflection at `up` followed by one at the vector half way.
    let middle = unit_normal_or(up + base, up);
    let mirrored = fine - 2.0 * dot(fine, up) * up;
    return unit_normal_or(mirrored - 2.0 * dot(mirrored, middle) * middle, base);
//#elif method == whiteout
    let base_height = dot(base, up);
    let fine_height = dot(fine, up);
    let slopes = base - base_height * up + fine - fine_height * up;
    return unit_normal_or(slopes + base_height * fine_height * up, base);
//#else
    return unit_normal_or(base + fine - dot(fine, up) * up, base);
//#end
}
