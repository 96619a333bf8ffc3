//! label: Contrast
//! category: color
//! synonyms: bright contrast, brightness contrast, punch, color correction, slope
//! Spreads a colour's components around a pivot or draws them towards it.
//! option curve: power | linear = power - Factor on the stops around the pivot, which keeps black and never goes negative; or on the plain difference.

/// color (color linear): The colour.
/// amount (scalar; = 1; 0..): 1 leaves the colour as it is, less is flatter, 0 is the pivot, more is harder.
/// pivot (scalar; = 0.18; 0..): The value that stays: 0.18 is the middle grey of photography.
/// -> color (color linear): The changed colour, not below zero.
fn contrast(color: vec3f, amount: f32, pivot: f32) -> vec3f {
//#if curve == power
    let center = max(pivot, 1e-6);
    return center * pow(max(color / center, vec3f(1e-30)), vec3f(amount));
//#else
    return max((color - pivot) * amount + pivot, vec3f(0.0));
//#end
}
