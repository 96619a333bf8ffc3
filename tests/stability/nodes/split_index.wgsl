//! label: Split index
//! category: shadow
//! use: light_space
//! Shows which of a light's views sees a point, or which it would be if splits lay in each quad in one of the 256 ways in which four pixels can lie in four splits.
//! option of: view | pattern | chosen = view - The view of the point; the split of the pattern; the one split that its quad takes.

//#if of == view
/// space (space; hidden): The light's space.
//#else
/// pixel (vector screen; = @pixel; hidden): Where the pixel is.
//#end
/// -> visibility (scalar visibility): Number of the view, divided by 4.
//#if of == view
fn split_index(space: LightSpace) -> f32 {
    return f32(light_layer(space)) / 4.0;
}
//#else
fn split_index(pixel: vec2f) -> f32 {
    let at = vec2u(pixel);
    let quad = at.x / 2u + 16u * (at.y / 2u);
    let place = at.x % 2u + 2u * (at.y % 2u);
    let split = quad >> (2u * place) & 3u;
//#if of == chosen
    return f32(split_of_quad(split)) / 4.0;
//#else
    return f32(split) / 4.0;
//#end
}
//#end
