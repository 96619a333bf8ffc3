// Spot light, variance shadow + Bumpy glass

struct Frame {
    world_to_clip: mat4x4f,
    world_to_view: mat4x4f,
    camera_position: vec3f,
    time: f32,
    camera_forward: vec3f,
    environment_levels: f32,
    environment_irradiance: array<vec4f, 9>,
}

struct Object {
    object_to_world: mat4x4f,
    world_to_object: mat4x4f,
    receives: f32,
}

struct Parameters {
    bump_amplitude: f32,
    bump_strength: f32,
    glass_ior: f32,
    glass_roughness: f32,
    glass_tint: vec3f,
    noise_gain: f32,
    noise_lacunarity: f32,
    noise_scale: f32,
    shadow_bleeding_reduction: f32,
    shadow_minimum_variance: f32,
    spot_color: vec3f,
    spot_direction: vec3f,
    spot_inner_angle: f32,
    spot_intensity: f32,
    spot_near: f32,
    spot_outer_angle: f32,
    spot_position: vec3f,
    spot_radius: f32,
    spot_range: f32,
}

struct LightSpace {
    /// Rigid: the light at the origin, looking along +z, +y up.
    world_to_light: mat4x4f,
    /// x, y: focal factors, ndc = projection.xy * light.xy / (perspective ? light.z : 1). z: 1 perspective, 0 parallel.
    /// w: layer of the light's maps that shows this view.
    projection: vec4f,
    /// x: near, y: far, z: 1 / (far - near). w: distance from the eye up to which this view is used.
    depth: vec4f,
    /// Half size of the shining surface along x and y: metres across the axis (perspective) or tangents of the angles that
    /// it is seen under (parallel). z: 1 an ellipse, 0 a rectangle. w: texels per metre here over those of the light's
    /// coarsest view.
    source: vec4f,
    /// x: strength of the warp, -1 to 1, where the light warps its map.
    warp: vec4f,
}

struct MapFootprint {
    level: f32,
    taps: f32,
    step: vec2f,
}

struct SpotLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var environment: texture_2d<f32>;
@group(0) @binding(2) var environment_sampler: sampler;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;
@group(2) @binding(1) var trilinear_clamp_sampler: sampler;
@group(3) @binding(0) var<uniform> spot_space: LightSpace;
@group(3) @binding(1) var spot_map: texture_2d_array<f32>;

fn pixel_width3(x: vec3f) -> vec3f {
    let across = dpdx(x);
    let down = dpdy(x);
    return sqrt(across * across + down * down);
}

fn detail_left(width: f32) -> f32 {
    return clamp(2.0 - 4.0 * width, 0.0, 1.0);
}

fn octave_shift3(octave: i32) -> vec3f {
    return vec3f(17.31, 5.77, 11.19) * f32(octave);
}

fn octave_footprint3(p: vec3f) -> f32 {
    let width = pixel_width3(p);
    return max(width.x, max(width.y, width.z));
}

fn pcg3d(seed: vec3u) -> vec3u {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

fn hash_cell3(corner: vec3f) -> vec3u {
    return pcg3d(bitcast<vec3u>(vec3i(corner)));
}

fn lattice_gradient3(hash: u32, offset: vec3f) -> f32 {
    let choice = hash % 12u;
    let first = select(offset.x, offset.y, choice >= 8u);
    let second = select(offset.z, offset.y, choice < 4u);
    return select(first, -first, (choice & 1u) != 0u) + select(second, -second, (choice & 2u) != 0u);
}

fn quintic_fade3(t: vec3f) -> vec3f {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

fn perlin_corner3(cell: vec3f, f: vec3f, corner: vec3f) -> f32 {
    return lattice_gradient3(hash_cell3(cell + corner).x, f - corner);
}

fn perlin_side3(cell: vec3f, f: vec3f, x: f32) -> vec4f {
    return vec4f(
        perlin_corner3(cell, f, vec3f(x, 0.0, 0.0)),
        perlin_corner3(cell, f, vec3f(x, 1.0, 0.0)),
        perlin_corner3(cell, f, vec3f(x, 0.0, 1.0)),
        perlin_corner3(cell, f, vec3f(x, 1.0, 1.0)),
    );
}

fn perlin_noise3(p: vec3f) -> f32 {
    let cell = floor(p);
    let f = p - cell;
    let w = quintic_fade3(f);
    let x = mix(perlin_side3(cell, f, 0.0), perlin_side3(cell, f, 1.0), w.x);
    let y = mix(x.xz, x.yw, w.y);
    return mix(y.x, y.y, w.z) * 0.9649214;
}

fn unit_normal_or(v: vec3f, otherwise: vec3f) -> vec3f {
    let squared = dot(v, v);
    return select(otherwise, v * inverseSqrt(max(squared, 1e-36)), squared > 1e-30);
}

fn point_light_ray(point: vec3f, position: vec3f) -> vec4f {
    let offset = position - point;
    let distance = length(offset);
    return vec4f(select(offset / max(distance, 1e-6), vec3f(0.0, 1.0, 0.0), distance < 1e-6), distance);
}

fn inverse_square(distance: f32) -> f32 {
    return 1.0 / max(distance * distance, 1e-6);
}

fn cone_falloff(cosine: f32, inner_angle: f32, outer_angle: f32) -> f32 {
    let outer = cos(outer_angle);
    let inner = max(cos(min(inner_angle, outer_angle)), outer + 1e-4);
    return smoothstep(outer, inner, cosine);
}

fn light_position(space: LightSpace, point: vec3f) -> vec3f {
    return (space.world_to_light * vec4f(point, 1.0)).xyz;
}

fn light_linear_depth(space: LightSpace, distance: f32) -> f32 {
    return (distance - space.depth.x) * space.depth.z;
}

fn light_depth_linear(space: LightSpace, position: vec3f) -> f32 {
    return light_linear_depth(space, position.z);
}

fn light_ray(space: LightSpace, position: vec3f) -> vec2f {
    return position.xy / select(1.0, max(position.z, 1e-6), space.projection.z > 0.5);
}

fn light_map_uv(space: LightSpace, position: vec3f) -> vec2f {
    return light_ray(space, position) * space.projection.xy * vec2f(0.5, -0.5) + 0.5;
}

fn light_layer(space: LightSpace) -> i32 {
    return i32(space.projection.w);
}

fn light_map_change(space: LightSpace, position: vec3f, change: vec3f) -> vec2f {
    let moved = (space.world_to_light * vec4f(change, 0.0)).xyz;
    let perspective = (moved.xy - light_ray(space, position) * moved.z) / max(position.z, 1e-6);
    let ray = select(moved.xy, perspective, space.projection.z > 0.5);
    return ray * space.projection.xy * vec2f(0.5, -0.5);
}

fn outside_light_map(space: LightSpace, position: vec3f, uv: vec2f) -> bool {
    return position.z < space.depth.x || any(uv < vec2f(0.0)) || any(uv > vec2f(1.0));
}

fn chebyshev_bound(variance: f32, behind: f32) -> f32 {
    return variance / (variance + behind * behind);
}

fn reduce_bleeding(visibility: f32, amount: f32) -> f32 {
    let least = clamp(amount, 0.0, 0.99);
    return saturate((visibility - least) / (1.0 - least));
}

fn map_footprint(size: vec2f, uv_dx: vec2f, uv_dy: vec2f, most: f32) -> MapFootprint {
    let across = length(uv_dx * size);
    let down = length(uv_dy * size);
    let longer = max(across, down);
    let taps = clamp(ceil(longer / max(min(across, down), 1.0) - 0.01), 1.0, most);
    let level = log2(max(longer / taps, 1.0));
    return MapFootprint(level, taps, select(uv_dy, uv_dx, across > down) / taps);
}

fn sample_footprint(
    map: texture_2d_array<f32>,
    map_sampler: sampler,
    uv: vec2f,
    layer: i32,
    uv_dx: vec2f,
    uv_dy: vec2f,
    most: f32,
) -> vec4f {
    let footprint = map_footprint(vec2f(textureDimensions(map)), uv_dx, uv_dy, most);
    let first = uv - 0.5 * (footprint.taps - 1.0) * footprint.step;
    var sum = vec4f(0.0);
    for (var i = 0.0; i < footprint.taps; i += 1.0) {
        sum += textureSampleLevel(map, map_sampler, first + i * footprint.step, layer, footprint.level);
    }
    return sum / footprint.taps;
}

const MATTE_RADIANCE: f32 = 0.31830987;

fn half_vector(a: vec3f, b: vec3f) -> vec3f {
    let sum = a + b;
    return sum * inverseSqrt(max(dot(sum, sum), 1e-12));
}

fn ggx_alpha(roughness: f32) -> f32 {
    let bounded = clamp(roughness, 0.045, 1.0);
    return bounded * bounded;
}

fn ggx_distribution(normal: vec3f, half: vec3f, alpha: f32) -> f32 {
    let cosine = max(dot(normal, half), 0.0);
    let sine = cross(normal, half);
    let spread = (cosine * alpha) * (cosine * alpha) + dot(sine, sine);
    let root = alpha / max(spread, 1e-8);
    return select(0.0, root * root * MATTE_RADIANCE, cosine > 0.0);
}

fn ggx_visibility(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    let square = alpha * alpha;
    let from_light = n_dot_v * sqrt(square + (1.0 - square) * n_dot_l * n_dot_l);
    let from_camera = n_dot_l * sqrt(square + (1.0 - square) * n_dot_v * n_dot_v);
    return 0.5 / max(from_light + from_camera, 1e-6);
}

fn fresnel_dielectric(cosine: f32, ior: f32) -> f32 {
    let eta = max(ior, 1e-3);
    let c = saturate(cosine);
    let inside_square = 1.0 - (1.0 - c * c) / (eta * eta);
    let inside = sqrt(max(inside_square, 0.0));
    let across = (c - eta * inside) / max(c + eta * inside, 1e-6);
    let along = (eta * c - inside) / max(eta * c + inside, 1e-6);
    return select(saturate(0.5 * (across * across + along * along)), 1.0, inside_square <= 0.0);
}

fn environment_uv(direction: vec3f) -> vec2f {
    // atan2 of two zeros is undefined: straight up and down count as forward.
    let pole = abs(direction.x) + abs(direction.z) < 1e-7;
    let turn = atan2(select(direction.x, 0.0, pole), select(-direction.z, 1.0, pole));
    return vec2f(0.5 + turn * 0.15915494, acos(clamp(direction.y, -1.0, 1.0)) * 0.31830987);
}

fn environment_radiance(
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    last_level: f32,
    direction: vec3f,
    roughness: f32,
) -> vec3f {
    let level = saturate(roughness) * last_level;
    return max(textureSampleLevel(environment, environment_sampler, environment_uv(direction), level).rgb, vec3f(0.0));
}

const OCTAVES: i32 = 3;

fn fbm3d(position: vec3f, scale: f32, lacunarity: f32, gain: f32) -> f32 {
    let base = position * scale;
    let footprint = octave_footprint3(base);
    var sum = 0.0;
    var total = 0.0;
    var amplitude = 1.0;
    var frequency = 1.0;
    for (var octave = 0; octave < OCTAVES; octave++) {
        let p = base * frequency + octave_shift3(octave);
        let noise = perlin_noise3(p);
        sum += amplitude * noise * detail_left(footprint * frequency);
        total += amplitude;
        amplitude *= gain;
        frequency *= lacunarity;
    }
    return clamp(0.5 + 0.5 * sum / total, 0.0, 1.0);
}

fn bump(height: f32, amplitude: f32, strength: f32, position: vec3f, normal: vec3f) -> vec3f {
    let smooth_normal = unit_normal_or(normal, vec3f(0.0, 1.0, 0.0));
    let right = dpdx(position);
    let down = dpdy(position);
    let rise = vec2f(dpdx(height), dpdy(height)) * amplitude * strength;
    // Vectors in the tangent plane, each perpendicular to the other screen direction.
    let along_right = cross(down, smooth_normal);
    let along_down = cross(smooth_normal, right);
    let area = dot(right, along_right);
    let gradient = sign(area) * (rise.x * along_right + rise.y * along_down);
    return unit_normal_or(abs(area) * smooth_normal - gradient, smooth_normal);
}

fn spot_light(
    point: vec3f,
    position: vec3f,
    direction: vec3f,
    color: vec3f,
    intensity: f32,
    inner_angle: f32,
    outer_angle: f32,
    near: f32,
    range: f32,
    radius: f32,
) -> SpotLight {
    let ray = point_light_ray(point, position);
    let axis = direction * inverseSqrt(max(dot(direction, direction), 1e-20));
    let cone = cone_falloff(-dot(ray.xyz, axis), inner_angle, outer_angle);
    return SpotLight(color * (intensity * cone * inverse_square(ray.w)), ray.xyz, ray.w);
}

const ANISOTROPY: f32 = 16;

fn variance_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_2d_array<f32>,
    tap_sampler: sampler,
    minimum_variance: f32,
    bleeding_reduction: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let uv = light_map_uv(space, position);
    let layer = light_layer(space);
    let uv_dx = light_map_change(space, position, dpdx(point));
    let uv_dy = light_map_change(space, position, dpdy(point));
    let texel = sample_footprint(map, tap_sampler, uv, layer, uv_dx, uv_dy, ANISOTROPY);
    let stored = texel.xy;
    let mean = stored.x;
    let spread = stored.y - mean * mean;
    let measured = light_depth_linear(space, position);
    // Beyond the far plane the map holds depths above 1, if its format can: there the receiver is lit where it is what
    // the map shows, and in the shadow of anything nearer.
    let depth = min(max(measured, 0.0), max(mean, 1.0));
    // 1e-12 keeps 0 / 0 out where both the variance and the difference vanish.
    let least = max(minimum_variance, 1e-12);
    let variance = max(spread, least);
    let bound = chebyshev_bound(variance, max(depth - mean, 0.0));
    let visibility = reduce_bleeding(bound, bleeding_reduction);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, uv));
}

fn glass(
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    ior: f32,
    roughness: f32,
) -> vec3f {
    let n_dot_l = saturate(dot(normal, to_light));
    let n_dot_v = clamp(dot(normal, to_camera), 1e-4, 1.0);
    let half = half_vector(to_light, to_camera);
    let alpha = ggx_alpha(roughness);
    let front = fresnel_dielectric(dot(half, to_light), ior);
    let fresnel = front;
    let facets = ggx_distribution(normal, half, alpha) * ggx_visibility(n_dot_l, n_dot_v, alpha);
    return irradiance * (fresnel * facets * n_dot_l);
}

fn glass_ambient(
    normal: vec3f,
    to_camera: vec3f,
    tint: vec3f,
    ior: f32,
    roughness: f32,
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    environment_levels: f32,
) -> vec3f {
    let front = fresnel_dielectric(dot(normal, to_camera), ior);
    let mirror = reflect(-to_camera, normal);
    let fresnel = front;
    let through = refract(-to_camera, normal, 1.0 / max(ior, 1.0));
    let mirrored = environment_radiance(environment, environment_sampler, environment_levels, mirror, roughness);
    let passed = environment_radiance(environment, environment_sampler, environment_levels, through, roughness);
    return mix(tint * passed, mirrored, fresnel);
}

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
}

struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) position_world: vec3f,
    @location(1) position_object: vec3f,
    @location(2) normal_world: vec3f,
}

@vertex
fn vs_main(in: Vertex) -> Varyings {
    let world = object.object_to_world * vec4f(in.position, 1.0);
    var out: Varyings;
    out.clip_position = frame.world_to_clip * world;
    out.position_world = world.xyz;
    out.position_object = in.position;
    out.normal_world = normalize((vec4f(in.normal, 0.0) * object.world_to_object).xyz);
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    // spot_vsm/spot: Spot light
    let spot = spot_light(
        in.position_world,
        parameters.spot_position,
        parameters.spot_direction,
        parameters.spot_color,
        parameters.spot_intensity,
        parameters.spot_inner_angle,
        parameters.spot_outer_angle,
        parameters.spot_near,
        parameters.spot_range,
        parameters.spot_radius,
    );
    // spot_vsm/shadow: Variance shadow
    let shadow_visibility = variance_shadow(
        in.position_world,
        spot_space,
        spot_map,
        trilinear_clamp_sampler,
        parameters.shadow_minimum_variance,
        parameters.shadow_bleeding_reduction,
        object.receives,
    );
    // bumpy_glass/noise: Fractal Noise 3D
    let noise = fbm3d(
        in.position_object,
        parameters.noise_scale,
        parameters.noise_lacunarity,
        parameters.noise_gain,
    );
    // bumpy_glass/bump: Bump
    let bump_normal = bump(
        noise,
        parameters.bump_amplitude,
        parameters.bump_strength,
        in.position_world,
        in.normal_world,
    );
    let to_camera = normalize(frame.camera_position - in.position_world);
    // bumpy_glass/glass: Glass, lit by spot_vsm/spot
    let glass_spot_radiance = glass(
        spot.irradiance * shadow_visibility,
        spot.direction,
        bump_normal,
        to_camera,
        parameters.glass_ior,
        parameters.glass_roughness,
    );
    // bumpy_glass/glass: Glass
    let glass_ambient_radiance = glass_ambient(
        bump_normal,
        to_camera,
        parameters.glass_tint,
        parameters.glass_ior,
        parameters.glass_roughness,
        environment,
        environment_sampler,
        frame.environment_levels,
    );
    return vec4f(glass_spot_radiance + glass_ambient_radiance, 1.0);
}
