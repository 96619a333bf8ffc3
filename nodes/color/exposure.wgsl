//! label: Exposure
//! category: color
//! synonyms: stops, ev, brightness, gain, intensity, hdr
//! inline
//! Brightens or darkens a linear colour by photographic stops.

/// color (color linear): The colour.
/// stops (scalar; = 0; -64..64): Each stop doubles the colour; each negative stop halves it.
/// -> color (color linear): The colour times two to the stops.
fn exposure(color: vec3f, stops: f32) -> vec3f {
    return color * exp2(clamp(stops, -64.0, 64.0));
}
