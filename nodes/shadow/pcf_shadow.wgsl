//! label: PCF shadow
//! category: shadow
//! synonyms: percentage closer filtering, soft shadow, filtered shadow, bilinear shadow, smooth shadow map, hardware pcf, comparison sampler, reeves
//! use: receiver, kernel
//! Shadow by comparing many texels of a depth map and averaging the results (Reeves, Salesin and Cook 1987). Every comparison is with the receiving plane at that texel, so no bias has to be tuned however wide the kernel. Width 1 is the bilinear blend of four comparisons, in the shader (bilinear) or by a comparison sampler (hardware).
//! option width: 1 | 3 | 5 | 7 | 9 = 5 - Texels across the kernel.
//! option weights: gaussian | box | tent = gaussian - Shape of the kernel.
//! option taps: nearest | bilinear | hardware = bilinear - How a tap reads: the nearest texel (stairs), four texels blended after exact comparisons, or four blended by the sampler with one biased comparison.
//! option compare: plane | point | offset = plane - With what a texel is compared: the receiving plane there; the shaded point itself, which needs a bias of half a kernel of slope; or the shaded point moved along its normal by that much. The last two follow no plane beyond the shaded point, for surfaces that are broken up within a kernel (leaves, hair, wire).
//! option metric: linear | zw | radial = linear - How depth is measured: evenly along the light's axis, as projection matrices leave it, or by the distance from the light. All are linear in parallel light.
//! option cull: none | front | back = none - Sides of triangles that are left out.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 2048 - Texels on a side of the map.
//! map map: depth(size=$size, metric=$metric, cull=$cull)
//! sampler map_sampler: compare=on filter=nearest address=clamp
//! sampler blending_sampler: compare=on filter=linear address=clamp

//#if width != 1
const WIDTH: i32 = 5;

//#end
/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Depth of the nearest surface.
//#if taps == hardware
/// blending_sampler (sampler; hidden): Compares with four texels and blends the results.
//#else
/// map_sampler (sampler; hidden): Compares with one texel.
//#end
//#if compare == plane
/// bias (distance; = 0; 0..; in m): Extra distance by which an occluder must be nearer to the light, for surfaces that the plane does not describe.
//#elif compare == point
/// bias (distance; = 0.05; 0..; in m): Distance by which an occluder must be nearer to the light. A slope of (u, v) metres per texel needs (u + v) times half the kernel's width (half a texel more with blended taps); shadows detach by as much.
//#else
/// bias (distance; = 0; 0..; in m): Extra distance by which an occluder must be nearer to the light.
/// offset (number; = 1.5; 0..): How far the point is moved along its normal, in half kernels times the sine of the angle to the light. From the square root of 2 on, no slope shadows itself.
//#end
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn pcf_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_depth_2d_array,
//#if taps == hardware
    blending_sampler: sampler_comparison,
//#else
    map_sampler: sampler_comparison,
//#end
    bias: f32,
//#if compare == offset
    offset: f32,
//#end
    receives: f32,
) -> f32 {
    let size = vec2f(textureDimensions(map));
    let layer = light_layer(space);
//#if width == 1
//#if taps == nearest
    let reach = 0.5;
//#else
    let reach = 1.0;
//#end
//#else
//#if taps == nearest
    let reach = 0.5 * f32(WIDTH);
//#else
    let reach = 0.5 * f32(WIDTH) + 0.5;
//#end
//#end
//#if compare == plane
    let position = light_position(space, point);
    let plane = receiver_plane(space, position, geometric_normal(point));
    let rounding = receiver_rounding(receiver_slope(space, plane) / size);
    let margin = bias * space.depth.z + rounding + receiver_curvature(space, plane, size, reach);
//#elif compare == point
    let position = light_position(space, point);
    let plane = facing_receiver(space, position);
    let margin = bias * space.depth.z + receiver_rounding(vec2f(0.0));
//#else
    let moved = receiver_offset(space, light_position(space, point), geometric_normal(point), size, offset * reach);
    let position = light_position(space, point) + moved;
    let plane = facing_receiver(space, position);
    let margin = bias * space.depth.z + receiver_rounding(vec2f(0.0));
//#end
//#if taps == hardware
    // The sampler compares one depth with four texels, whose centres lie up to a texel to each side: the depth is taken
    // a texel away, where the plane is nearest to the light.
    let nearer = sign(plane.slope) / size;
//#end
//#if width == 1
//#if taps == bilinear
    let corner = plane.uv * size - 0.5;
    let texel = (floor(corner) + 0.5) / size;
    let part = fract(corner);
    let next = 1.0 / size;
    let uv_10 = texel + vec2f(next.x, 0.0);
    let uv_01 = texel + vec2f(0.0, next.y);
    let uv_11 = texel + next;
    let lit_00 = textureSampleCompareLevel(map, map_sampler, texel, layer, compared_at(space, plane, texel, margin));
    let lit_10 = textureSampleCompareLevel(map, map_sampler, uv_10, layer, compared_at(space, plane, uv_10, margin));
    let lit_01 = textureSampleCompareLevel(map, map_sampler, uv_01, layer, compared_at(space, plane, uv_01, margin));
    let lit_11 = textureSampleCompareLevel(map, map_sampler, uv_11, layer, compared_at(space, plane, uv_11, margin));
    let visibility = mix(mix(lit_00, lit_10, part.x), mix(lit_01, lit_11, part.x), part.y);
//#elif taps == nearest
    let uv = (floor(plane.uv * size) + 0.5) / size;
    let visibility = textureSampleCompareLevel(map, map_sampler, uv, layer, compared_at(space, plane, uv, margin));
//#else
    let depth = compared_at(space, plane, plane.uv + nearer, margin);
    let visibility = textureSampleCompareLevel(map, blending_sampler, plane.uv, layer, depth);
//#end
//#else
//#if taps == bilinear
    // Bilinear taps on a grid share their texels: each texel is compared once, with the kernel convolved with the tent.
    let corner = plane.uv * size - 0.5;
    let part = fract(corner);
    let first = floor(corner) + 0.5 - f32(WIDTH / 2);
    let last_offset = WIDTH / 2 + 1;
//#elif taps == nearest
    let first = floor(plane.uv * size) + 0.5 - f32(WIDTH / 2);
    let last_offset = WIDTH / 2;
//#else
    let first = plane.uv * size - f32(WIDTH / 2);
    let last_offset = WIDTH / 2;
//#end
    var sum = 0.0;
    var total = 0.0;
//#if taps == bilinear
    var before_y = 0.0;
//#end
    for (var y = -(WIDTH / 2); y <= last_offset; y++) {
//#if weights == gaussian
        let kernel_y = kernel_gaussian(y, WIDTH);
//#elif weights == box
        let kernel_y = kernel_box(y, WIDTH);
//#else
        let kernel_y = kernel_tent(y, WIDTH);
//#end
//#if taps == bilinear
        let weight_y = mix(kernel_y, before_y, part.y);
        before_y = kernel_y;
        var before_x = 0.0;
//#else
        let weight_y = kernel_y;
//#end
        for (var x = -(WIDTH / 2); x <= last_offset; x++) {
//#if weights == gaussian
            let kernel_x = kernel_gaussian(x, WIDTH);
//#elif weights == box
            let kernel_x = kernel_box(x, WIDTH);
//#else
            let kernel_x = kernel_tent(x, WIDTH);
//#end
//#if taps == bilinear
            let weight = mix(kernel_x, before_x, part.x) * weight_y;
            before_x = kernel_x;
//#else
            let weight = kernel_x * weight_y;
//#end
            let uv = (first + vec2f(f32(x + WIDTH / 2), f32(y + WIDTH / 2))) / size;
//#if taps == hardware
            let depth = compared_at(space, plane, uv + nearer, margin);
            sum += weight * textureSampleCompareLevel(map, blending_sampler, uv, layer, depth);
//#else
            let depth = compared_at(space, plane, uv, margin);
            sum += weight * textureSampleCompareLevel(map, map_sampler, uv, layer, depth);
//#end
            total += weight;
        }
    }
    let visibility = sum / total;
//#end
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}

/// Depth that the texel at `uv` must not be nearer than; the margin is in linear depth.
//#if metric == linear
fn compared_at(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> f32 {
    return receiver_depth(space, plane, uv) - margin;
}
//#elif metric == zw
fn compared_at(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> f32 {
    return receiver_depth_zw_less(space, plane, uv, margin);
}
//#else
fn compared_at(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> f32 {
    return receiver_depth_radial_less(space, plane, uv, margin);
}
//#end
