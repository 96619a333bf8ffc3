//! Hue, saturation and value (Smith 1978, "Color Gamut Transform Pairs", the hexcone model); hue in turns.

/// (hue, saturation, value) of a colour; hue is 0 for greys, saturation 0 for black.
fn hsv_of(color: vec3f) -> vec3f {
    let high = max(color.r, max(color.g, color.b));
    let low = min(color.r, min(color.g, color.b));
    let chroma = high - low;
    let scale = 1.0 / select(chroma, 1.0, chroma <= 0.0);
    var sector = 4.0 + (color.r - color.g) * scale;
    if high == color.r {
        sector = (color.g - color.b) * scale;
    } else if high == color.g {
        sector = 2.0 + (color.b - color.r) * scale;
    }
    let hue = select(fract(sector / 6.0), 0.0, chroma <= 0.0);
    return vec3f(hue, chroma / select(high, 1.0, high <= 0.0), high);
}

/// The colour of a (hue, saturation, value).
fn color_of_hsv(hsv: vec3f) -> vec3f {
    let pure = clamp(abs(fract(vec3f(hsv.x) + vec3f(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, vec3f(0.0), vec3f(1.0));
    return hsv.z * mix(vec3f(1.0), pure, hsv.y);
}
