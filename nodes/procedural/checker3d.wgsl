//! label: Checker 3D
//! category: procedural
//! synonyms: checkerboard, cubes, solid checker
//! use: box_filter
//! Cubes of two colours in turn throughout space, fixed to the object and averaged over each pixel.
//! cheaper: constant - The mean of the pattern.

/// position (point object; = @position_object): Where to look the pattern up.
/// scale (scalar; = 4): Cubes per metre.
/// color_a (color reflectance; = (0.9, 0.9, 0.9); 0..1; srgb): Colour of the cube that begins at the origin.
/// color_b (color reflectance; = (0.2, 0.2, 0.2); 0..1; srgb): Colour of its neighbours.
/// -> color (color reflectance): Colour of the pattern.
/// -> mask (scalar): 1 in cubes of the first colour, 0 in the others.
fn checker3d(position: vec3f, scale: f32, color_a: vec3f, color_b: vec3f) -> SolidCheckerPoint {
    // A face that lies exactly on a cube boundary would be torn between both colours by rounding.
    let p = position * scale + 1e-3;
    let width = pixel_width3(p);
    let product = filtered_square(p.x, width.x) * filtered_square(p.y, width.y) * filtered_square(p.z, width.z);
    let mask = 0.5 + 0.5 * product;
    return SolidCheckerPoint(mix(color_b, color_a, mask), mask);
}

struct SolidCheckerPoint {
    color: vec3f,
    mask: f32,
}
