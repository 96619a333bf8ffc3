//! label: Triplanar Image
//! category: texture
//! synonyms: box projection, box mapping, cube projection
//! use: safe_normal
//! Projects a picture file onto an object along three axes and blends by the normal, so that no texture coordinates
//! are needed. Colours come out in linear light; choose the colour space linear for data.
//! option frame: object | world = object - Whether the picture sticks to the object or to the world.
//! option color_space: srgb | linear = srgb - What the file's numbers mean: linear for data.
//! option filter: nearest | linear | trilinear = trilinear - How texels and sizes are blended.
//! option address: repeat | clamp | mirror = repeat - What lies beyond the picture.
//! option anisotropy: 1 | 4 | 16 = 1 - Most samples along a slanted pixel; used with trilinear filtering.
//! sampler image_sampler: filter=$filter address=$address anisotropy=$anisotropy
//! texture image: encoding=$color_space
//! cheaper: constant - The mean of the picture.

/// image (texture): Path of a PNG, JPEG or HDR file.
/// image_sampler (sampler; hidden): Made from the options.
//#if frame == object
/// position (point object; = @position_object): Where to look the picture up.
/// normal (normal object near; = @normal_object): Decides how much each axis counts.
//#else
/// position (point world; = @position_world): Where to look the picture up.
/// normal (normal world near; = @normal_world): Decides how much each axis counts.
//#end
/// scale (scalar; = 1): Pictures per metre.
/// sharpness (scalar; = 4; 1..32): How narrow the blend between two axes is.
/// -> color (color): Colour in linear light.
/// -> alpha (scalar): Opacity, 0..1; 1 if the file has none.
fn image_triplanar(
    image: texture_2d<f32>,
    image_sampler: sampler,
    position: vec3f,
    normal: vec3f,
    scale: f32,
    sharpness: f32,
) -> TriplanarTexel {
    let p = position * scale;
    let n = unit_normal_or(normal, vec3f(0.0, 1.0, 0.0));
    // Seen from outside, each picture is upright (y up, or -z up from above) and reads from left to right.
    let side = select(vec3f(-1.0), vec3f(1.0), n >= vec3f(0.0));
    let from_x = textureSample(image, image_sampler, vec2f(-side.x * p.z, -p.y));
    let from_y = textureSample(image, image_sampler, vec2f(p.x, side.y * p.z));
    let from_z = textureSample(image, image_sampler, vec2f(side.z * p.x, -p.y));
    // A unit vector's largest component is at least 0.57, so the sum stays above zero for any sharpness in range.
    let weight = pow(max(abs(n), vec3f(1e-4)), vec3f(clamp(sharpness, 1.0, 32.0)));
    let texel = (from_x * weight.x + from_y * weight.y + from_z * weight.z) / (weight.x + weight.y + weight.z);
    return TriplanarTexel(texel.rgb, texel.a);
}

struct TriplanarTexel {
    color: vec3f,
    alpha: f32,
}
