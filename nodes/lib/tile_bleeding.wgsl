//! How much light bleeds at most where the depths around are known: what `shaders/occupancy.wgsl` says of a tile.

/// The most light that a variance bound lets into full shadow, from the depths that occur in a tile: with the nearest
/// occluder A, the farthest B and the receiver t, (r / (r + 2))^2 for r = (B - A) / (t - B), however many lie between. Depths that
/// are joined to the receiver's without a gap are its own surface, and so are those up to `rise` nearer to the light, which its own
/// plane spans within the tile. `tile`: nearest and farthest depth, and 32 bits, 16 in
/// each of two numbers divided by 65535, that say which of as many steps between them occur.
fn tile_bleeding(tile: vec4f, depth: f32, rise: f32) -> f32 {
    let step = (tile.y - tile.x) / 32.0;
    let place = (depth - rise - tile.x) / max(step, 1e-9);
    let bits = vec2u(tile.zw * 65535.0 + 0.5);
    let seen = bits.x | (bits.y << 16u);
    // Below the receiver's step: first what is joined to it, then a gap, then occluders. Behind all steps, all are.
    let own = u32(clamp(place, 0.0, 31.0));
    let empty = ~(seen | (1u << own)) & (0xffffffffu >> (31u - own));
    let gap = (1u << min(firstLeadingBit(empty), 31u)) - 1u;
    let occluders = select(seen & select(0u, gap, empty != 0u), seen, place >= 33.0);
    let farthest = min(tile.x + step * f32(min(firstLeadingBit(occluders), 31u) + 1u), tile.y);
    let spread = (farthest - tile.x) / max(depth - farthest, max(step, 1e-9));
    let part = spread / (spread + 2.0);
    return select(part * part, 0.0, occluders == 0u);
}
