//! label: Tile
//! category: texture
//! synonyms: repeat, wrap, mosaic, mirror
//! use: cellular
//! Repeats the unit square of the texture plane and numbers the tiles. For an image prefer its address option, which
//! has no seam of mip levels at the borders of tiles.
//! option repeat: same | mirrored = same - Every tile alike, or every other one mirrored so that borders meet.

/// texcoord (texcoord; = @texcoord): Coordinates to repeat.
/// scale (number; = (4, 4)): Tiles per unit.
/// -> texcoord (texcoord): Coordinates within the tile, 0..1.
/// -> id (scalar): A random number in 0..1 for each tile.
fn tile(texcoord: vec2f, scale: vec2f) -> TilePoint {
    let p = texcoord * scale;
    let cell = floor(p);
//#if repeat == same
    let within = p - cell;
//#else
    let within = 1.0 - abs(p - 2.0 * floor(0.5 * p) - 1.0);
//#end
    return TilePoint(within, cell_id2(cell));
}

struct TilePoint {
    texcoord: vec2f,
    id: f32,
}
