//! label: Tone mapping
//! kind: image
//! use: fullscreen
//! Linear scene radiance to linear display values in [0, 1]; encoding for the screen (sRGB) is left to the host.
//! option curve: none | aces | agx | neutral = neutral - How bright values are brought into range.
//! target: rgba16float | rgba8unorm

@group(0) @binding(0) var source: texture_2d<f32>;

//#if curve == aces
/// The ACES reference and sRGB output transforms, fitted by Stephen Hill (2017; BakingLab, ACES.hlsl).
fn display_curve(color: vec3f) -> vec3f {
    let to_rrt = mat3x3f(
        0.59719, 0.07600, 0.02840,
        0.35458, 0.90834, 0.13383,
        0.04823, 0.01566, 0.83777,
    );
    let to_display = mat3x3f(
        1.60475, -0.10208, -0.00327,
        -0.53108, 1.10813, -0.07276,
        -0.07367, -0.00605, 1.07602,
    );
    let v = to_rrt * color;
    let curve = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return to_display * curve;
}
//#elif curve == agx
/// AgX by Troy Sobotka, base look, in the polynomial form of Benjamin Wrensch (2023, "Minimal AgX Implementation").
fn display_curve(color: vec3f) -> vec3f {
    let inset = mat3x3f(
        0.842479062, 0.042328242, 0.042375655,
        0.0784336, 0.878468636, 0.0784336,
        0.079223745, 0.079166127, 0.879142974,
    );
    let outset = mat3x3f(
        1.196879006, -0.052896852, -0.052971636,
        -0.098020881, 1.151903130, -0.098043450,
        -0.099029744, -0.098961177, 1.151073673,
    );
    let exposure_min = -12.47393;
    let exposure_max = 4.026069;
    let exposure = log2(max(inset * color, vec3f(1e-10)));
    let x = saturate((exposure - exposure_min) / (exposure_max - exposure_min));
    let x2 = x * x;
    let x4 = x2 * x2;
    let curve = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
    // The curve yields encoded values; the display transform of AgX is a power of 2.2.
    return pow(max(outset * curve, vec3f(0.0)), vec3f(2.2));
}
//#elif curve == neutral
/// Khronos PBR Neutral (2024 specification): leaves colours below 0.76 as they are, but for a Fresnel offset.
fn display_curve(color: vec3f) -> vec3f {
    let start = 0.8 - 0.04;
    let least = min(color.r, min(color.g, color.b));
    let offset = select(0.04, least - 6.25 * least * least, least < 0.08);
    let shifted = color - offset;
    let peak = max(shifted.r, max(shifted.g, shifted.b));
    if (peak < start) {
        return shifted;
    }
    let span = 1.0 - start;
    let new_peak = 1.0 - span * span / (peak + span - start);
    let pale = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
    return mix(shifted * (new_peak / peak), vec3f(new_peak), pale);
}
//#else
/// Values as they are, cut off at white.
fn display_curve(color: vec3f) -> vec3f {
    return color;
}
//#end

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return fullscreen_position(vertex);
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = textureLoad(source, vec2i(pixel.xy), 0);
    // Larger values would overflow inside the curves; max also turns NaN into 0.
    let color = clamp(max(texel.rgb, vec3f(0.0)), vec3f(0.0), vec3f(65504.0));
    return vec4f(saturate(display_curve(color)), texel.a);
}
