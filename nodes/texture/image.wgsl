//! label: Image
//! category: texture
//! synonyms: picture, texture, bitmap, photo, png, jpeg, hdr
//! Reads a picture file. Colours come out in linear light, whatever the file holds. Choose the colour space srgb for
//! colours, and linear for data such as normals, heights or roughness; HDR files are linear either way.
//! option color_space: srgb | linear = srgb - What the file's numbers mean: linear for data.
//! option filter: nearest | linear | trilinear = trilinear - How texels and sizes are blended.
//! option address: repeat | clamp | mirror = repeat - What lies beyond the picture.
//! option anisotropy: 1 | 4 | 16 = 1 - Most samples along a slanted pixel; used with trilinear filtering.
//! sampler image_sampler: filter=$filter address=$address anisotropy=$anisotropy
//! texture image: encoding=$color_space
//! cheaper: constant - The mean of the picture.

/// image (texture): Path of a PNG, JPEG or HDR file.
/// image_sampler (sampler; hidden): Made from the options.
/// texcoord (texcoord; = @texcoord): Where to read: (0, 0) is the upper left corner, (1, 1) the lower right.
/// -> color (color): Colour in linear light.
/// -> alpha (scalar): Opacity, 0..1; 1 if the file has none.
fn image(image: texture_2d<f32>, image_sampler: sampler, texcoord: vec2f) -> ImageTexel {
    let texel = textureSample(image, image_sampler, texcoord);
    return ImageTexel(texel.rgb, texel.a);
}

struct ImageTexel {
    color: vec3f,
    alpha: f32,
}
