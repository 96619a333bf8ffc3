//! label: Blend
//! category: color
//! synonyms: blend mode, layer, mixrgb, overlay, screen, multiply, dodge, burn, soft light, composite
//! Lays one colour over another by a blend mode (W3C Compositing and Blending Level 1, section 10.1; add and subtract are
//! the plain sums). The formulas are used on the values as they come; most modes are made for components within 0..1.
//! option mode: normal | add | subtract | multiply | screen | overlay | darken | lighten | color_dodge | color_burn | soft_light | hard_light | difference | exclusion = multiply - What the layer does to the base.

/// base (color): The colour below.
/// layer (color; = (0.8, 0.8, 0.8); srgb): The colour on top.
/// amount (scalar; = 1; 0..1): 0 shows the base alone, 1 the blend.
/// -> color (color): The blended colour.
fn blend(base: vec3f, layer: vec3f, amount: f32) -> vec3f {
//#if mode == normal
    let blended = layer;
//#elif mode == add
    let blended = base + layer;
//#elif mode == subtract
    let blended = max(base - layer, vec3f(0.0));
//#elif mode == multiply
    let blended = base * layer;
//#elif mode == screen
    let blended = base + layer - base * layer;
//#elif mode == darken
    let blended = min(base, layer);
//#elif mode == lighten
    let blended = max(base, layer);
//#elif mode == color_dodge
    let gap = max(vec3f(1.0) - layer, vec3f(1e-6));
    let blended = min(max(base, vec3f(0.0)) / gap, vec3f(1.0));
//#elif mode == color_burn
    let missing = max(vec3f(1.0) - base, vec3f(0.0));
    let blended = vec3f(1.0) - min(missing / max(layer, vec3f(1e-6)), vec3f(1.0));
//#elif mode == difference
    let blended = abs(base - layer);
//#elif mode == exclusion
    let blended = base + layer - 2.0 * base * layer;
//#elif mode == soft_light
    let low_curve = ((16.0 * base - 12.0) * base + 4.0) * base;
    let curve = select(sqrt(max(base, vec3f(0.0))), low_curve, base <= vec3f(0.25));
    let tilt = 2.0 * layer - 1.0;
    let slope = select(curve - base, base * (vec3f(1.0) - base), layer <= vec3f(0.5));
    let blended = base + tilt * slope;
//#else
//#if mode == overlay
    let pattern = base;
    let tone = layer;
//#else
    let pattern = layer;
    let tone = base;
//#end
    let doubled = 2.0 * pattern;
    let lighter = tone + (doubled - 1.0) * (vec3f(1.0) - tone);
    let blended = select(lighter, tone * doubled, pattern <= vec3f(0.5));
//#end
    return mix(base, blended, amount);
}
