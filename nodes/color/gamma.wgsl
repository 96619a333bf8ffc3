//! label: Gamma
//! category: color
//! synonyms: power, gamma correction, midtones, color correction, exponent
//! Raises a colour's components to a power: black and white stay, the tones between move.

/// color (color): The colour; negative components count as zero.
/// gamma (scalar; = 1; 0.01..): The exponent: below 1 brightens the middle tones, above 1 darkens them.
/// -> color (color): The colour to the power of gamma.
fn gamma(color: vec3f, gamma: f32) -> vec3f {
    let raised = pow(max(color, vec3f(1e-30)), vec3f(max(gamma, 0.01)));
    return select(raised, vec3f(0.0), color <= vec3f(0.0));
}
