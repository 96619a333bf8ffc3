//! label: Place 2D
//! category: texture
//! synonyms: mapping, uv transform, tiling, offset, rotate uv
//! Moves, scales and turns texture coordinates, and with them the pattern that is looked up there.

/// texcoord (texcoord; = @texcoord): Coordinates to change.
/// offset (texcoord; = (0, 0)): How far the pattern is moved.
/// scale (number; = (1, 1)): How often the pattern repeats where it was once before.
/// rotation (angle; = 0; in deg): Turns the pattern from the first axis towards the second.
/// pivot (texcoord; = (0.5, 0.5)): The point that scaling and turning leave in place.
/// -> texcoord (texcoord): Changed coordinates.
fn place2d(texcoord: vec2f, offset: vec2f, scale: vec2f, rotation: f32, pivot: vec2f) -> vec2f {
    let from_pivot = texcoord - pivot - offset;
    // Turning the pattern one way is turning the point the other way.
    let c = cos(rotation);
    let s = sin(rotation);
    let turned = vec2f(c * from_pivot.x + s * from_pivot.y, c * from_pivot.y - s * from_pivot.x);
    return turned * scale + pivot;
}
