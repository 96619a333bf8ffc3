// Tiles

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
    bend_strength: f32,
    place_offset: vec2f,
    place_pivot: vec2f,
    place_rotation: f32,
    place_scale: vec2f,
    tiles_ior: f32,
    tiles_metallic: f32,
    tiles_roughness: f32,
}

struct ImageTexel {
    color: vec3f,
    alpha: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var environment: texture_2d<f32>;
@group(0) @binding(2) var environment_sampler: sampler;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;
@group(2) @binding(1) var picture_image: texture_2d<f32>;
@group(2) @binding(2) var normals_image: texture_2d<f32>;
@group(2) @binding(3) var trilinear_repeat_sampler: sampler;

fn unit_normal_or(v: vec3f, otherwise: vec3f) -> vec3f {
    let squared = dot(v, v);
    return select(otherwise, v * inverseSqrt(max(squared, 1e-36)), squared > 1e-30);
}

const MATTE_RADIANCE: f32 = 0.31830987;

fn normal_reflectance(ior: f32) -> f32 {
    let ratio = (ior - 1.0) / (max(ior, 0.0) + 1.0);
    return ratio * ratio;
}

fn environment_brdf(roughness: f32, n_dot_v: f32) -> vec2f {
    let r = saturate(roughness);
    let m = saturate(n_dot_v);
    let powers = vec3f(1.0, m, m * m);
    let loss = vec3f(
        dot(powers, vec3f(0.1843, 0.8889, -2.4358)),
        dot(powers, vec3f(-0.5612, 0.5383, 4.5730)),
        dot(powers, vec3f(0.4168, -0.3580, -2.1897)),
    );
    let lost = r * r * dot(loss, vec3f(1.0, r, r * r)) / (m + 0.5 * r * r + 0.02);
    let grazing = 1.0 - m;
    let fifth = grazing * grazing * grazing * grazing * grazing;
    let at_grazing = fifth * saturate(1.0288 + 0.5008 * m + r * (2.8817 * m - 0.9173)) / (1.0 + 8.0 * r * r);
    let share = saturate(1.0 - lost);
    return vec2f(max(share - at_grazing, 0.0), min(at_grazing, share));
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

fn environment_irradiance(harmonics: array<vec4f, 9>, normal: vec3f) -> vec3f {
    let n = normal;
    let first = harmonics[0] + n.y * harmonics[1] + n.z * harmonics[2] + n.x * harmonics[3];
    let second = n.x * n.y * harmonics[4] + n.y * n.z * harmonics[5] + (3.0 * n.z * n.z - 1.0) * harmonics[6]
        + n.x * n.z * harmonics[7] + (n.x * n.x - n.y * n.y) * harmonics[8];
    return max((first + second).rgb, vec3f(0.0));
}

fn place2d(texcoord: vec2f, offset: vec2f, scale: vec2f, rotation: f32, pivot: vec2f) -> vec2f {
    let from_pivot = texcoord - pivot - offset;
    // Turning the pattern one way is turning the point the other way.
    let c = cos(rotation);
    let s = sin(rotation);
    let turned = vec2f(c * from_pivot.x + s * from_pivot.y, c * from_pivot.y - s * from_pivot.x);
    return turned * scale + pivot;
}

fn image(image: texture_2d<f32>, image_sampler: sampler, texcoord: vec2f) -> ImageTexel {
    let texel = textureSample(image, image_sampler, texcoord);
    return ImageTexel(texel.rgb, texel.a);
}

fn normal_map(color: vec3f, strength: f32, tangent: vec3f, bitangent: vec3f, normal: vec3f) -> vec3f {
    let packed = color * 2.0 - 1.0;
    let bend = packed.xy * strength;
    // A compressed or filtered map may have lost its third channel's sign; a normal never points into the surface.
    let height = max(packed.z, 1e-3);
    // The axes are used as interpolated, not made orthogonal: that is what map bakers assume (Mikkelsen 2008).
    let world = bend.x * tangent + bend.y * bitangent + height * normal;
    return unit_normal_or(world, unit_normal_or(normal, vec3f(0.0, 1.0, 0.0)));
}

fn ggx_ambient(
    normal: vec3f,
    to_camera: vec3f,
    base_color: vec3f,
    metallic: f32,
    roughness: f32,
    ior: f32,
    irradiance_harmonics: array<vec4f, 9>,
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    environment_levels: f32,
) -> vec3f {
    let n_dot_v = saturate(dot(normal, to_camera));
    let at_normal = mix(vec3f(normal_reflectance(ior)), base_color, metallic);
    let response = environment_brdf(roughness, n_dot_v);
    let mirrored = at_normal * response.x + response.y;
    let direction = reflect(-to_camera, normal);
    let sharp = environment_radiance(environment, environment_sampler, environment_levels, direction, roughness);
    let matte = environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
    return base_color * (1.0 - metallic) * (1.0 - mirrored) * matte + mirrored * sharp;
}

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) texcoord: vec2f,
    @location(3) tangent: vec4f,
}

struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) position_world: vec3f,
    @location(1) normal_world: vec3f,
    @location(2) tangent_world: vec4f,
    @location(3) texcoord: vec2f,
}

@vertex
fn vs_main(in: Vertex) -> Varyings {
    let world = object.object_to_world * vec4f(in.position, 1.0);
    var out: Varyings;
    out.clip_position = frame.world_to_clip * world;
    out.position_world = world.xyz;
    out.normal_world = normalize((vec4f(in.normal, 0.0) * object.world_to_object).xyz);
    out.tangent_world = vec4f(normalize((object.object_to_world * vec4f(in.tangent.xyz, 0.0)).xyz), in.tangent.w);
    out.texcoord = in.texcoord;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    // place: Place 2D
    let place_texcoord = place2d(
        in.texcoord,
        parameters.place_offset,
        parameters.place_scale,
        parameters.place_rotation,
        parameters.place_pivot,
    );
    // normals: Image
    let normals = image(normals_image, trilinear_repeat_sampler, place_texcoord);
    // bend: Normal Map
    let bend_normal = normal_map(
        normals.color,
        parameters.bend_strength,
        in.tangent_world.xyz,
        cross(in.normal_world, in.tangent_world.xyz) * in.tangent_world.w,
        in.normal_world,
    );
    // picture: Image
    let picture = image(picture_image, trilinear_repeat_sampler, place_texcoord);
    // tiles: Metallic-roughness
    let tiles_ambient_radiance = ggx_ambient(
        bend_normal,
        normalize(frame.camera_position - in.position_world),
        picture.color,
        parameters.tiles_metallic,
        parameters.tiles_roughness,
        parameters.tiles_ior,
        frame.environment_irradiance,
        environment,
        environment_sampler,
        frame.environment_levels,
    );
    return vec4f(tiles_ambient_radiance, 1.0);
}
