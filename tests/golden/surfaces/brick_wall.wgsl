// Brick wall

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
    bricks_brick_color: vec3f,
    bricks_columns: f32,
    bricks_mortar: f32,
    bricks_mortar_color: vec3f,
    bricks_row_shift: f32,
    bricks_rows: f32,
    bricks_variation: f32,
    bump_amplitude: f32,
    bump_strength: f32,
    wall_roughness: f32,
}

struct BrickPoint {
    color: vec3f,
    mask: f32,
    id: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

fn pixel_width2(x: vec2f) -> vec2f {
    let across = dpdx(x);
    let down = dpdy(x);
    return sqrt(across * across + down * down);
}

fn filter_span(width: f32) -> f32 {
    return clamp(width, 1e-3, 1e4);
}

fn pulse_integral(x: f32, duty: f32) -> f32 {
    let whole = floor(x);
    return whole * duty + min(x - whole, duty);
}

fn filtered_pulse(x: f32, duty: f32, width: f32) -> f32 {
    let span = filter_span(width);
    let near_zero = x - floor(x);
    let half_span = 0.5 * span;
    let area = pulse_integral(near_zero + half_span, duty) - pulse_integral(near_zero - half_span, duty);
    return clamp(area / span, 0.0, 1.0);
}

fn detail_left(width: f32) -> f32 {
    return clamp(2.0 - 4.0 * width, 0.0, 1.0);
}

fn pcg2d(seed: vec2u) -> vec2u {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> vec2u(16u);
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    return v ^ (v >> vec2u(16u));
}

fn hash_cell2(corner: vec2f) -> vec2u {
    return pcg2d(bitcast<vec2u>(vec2i(corner)));
}

fn hash_to_unit(hash: u32) -> f32 {
    return f32(hash >> 8u) * 5.9604645e-8;
}

fn cell_id2(cell: vec2f) -> f32 {
    return hash_to_unit(hash_cell2(cell + vec2f(-1031.0, 4099.0)).x);
}

fn unit_normal_or(v: vec3f, otherwise: vec3f) -> vec3f {
    let squared = dot(v, v);
    return select(otherwise, v * inverseSqrt(max(squared, 1e-36)), squared > 1e-30);
}

const MATTE_RADIANCE: f32 = 0.31830987;

fn environment_irradiance(harmonics: array<vec4f, 9>, normal: vec3f) -> vec3f {
    let n = normal;
    let first = harmonics[0] + n.y * harmonics[1] + n.z * harmonics[2] + n.x * harmonics[3];
    let second = n.x * n.y * harmonics[4] + n.y * n.z * harmonics[5] + (3.0 * n.z * n.z - 1.0) * harmonics[6]
        + n.x * n.z * harmonics[7] + (n.x * n.x - n.y * n.y) * harmonics[8];
    return max((first + second).rgb, vec3f(0.0));
}

fn brick(
    texcoord: vec2f,
    columns: f32,
    rows: f32,
    row_shift: f32,
    mortar: f32,
    brick_color: vec3f,
    mortar_color: vec3f,
    variation: f32,
) -> BrickPoint {
    let wall = texcoord * vec2f(columns, rows);
    // Taken before rows are shifted: the shift is no change of size.
    let width = pixel_width2(wall);
    let row = floor(wall.y);
    let odd = row - 2.0 * floor(0.5 * row);
    let p = vec2f(wall.x + odd * row_shift, wall.y);
    let gap_y = clamp(mortar, 0.0, 0.9);
    let gap_x = clamp(gap_y * abs(columns) / max(abs(rows), 1e-6), 0.0, 0.9);
    // Half of the gap lies on either side of the boundary between bricks.
    let mask = filtered_pulse(p.x - 0.5 * gap_x, 1.0 - gap_x, width.x)
        * filtered_pulse(p.y - 0.5 * gap_y, 1.0 - gap_y, width.y);
    let id = cell_id2(vec2f(floor(p.x), row));
    let shade = 1.0 + variation * (id - 0.5) * detail_left(max(width.x, width.y));
    let color = mix(mortar_color, clamp(brick_color * shade, vec3f(0.0), vec3f(1.0)), mask);
    return BrickPoint(color, mask, id);
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

fn oren_nayar_ambient(
    normal: vec3f,
    albedo: vec3f,
    roughness: f32,
    irradiance_harmonics: array<vec4f, 9>,
) -> vec3f {
    // Even surroundings see the base term alone, plus about an eighth of the lobe.
    let variance = roughness * roughness;
    let share = 1.0 - 0.5 * variance / (variance + 0.33) + 0.125 * 0.45 * variance / (variance + 0.09);
    return albedo * environment_irradiance(irradiance_harmonics, normal) * (share * MATTE_RADIANCE);
}

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) texcoord: vec2f,
}

struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) position_world: vec3f,
    @location(1) normal_world: vec3f,
    @location(2) texcoord: vec2f,
}

@vertex
fn vs_main(in: Vertex) -> Varyings {
    let world = object.object_to_world * vec4f(in.position, 1.0);
    var out: Varyings;
    out.clip_position = frame.world_to_clip * world;
    out.position_world = world.xyz;
    out.normal_world = normalize((vec4f(in.normal, 0.0) * object.world_to_object).xyz);
    out.texcoord = in.texcoord;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    // bricks: Brick
    let bricks = brick(
        in.texcoord,
        parameters.bricks_columns,
        parameters.bricks_rows,
        parameters.bricks_row_shift,
        parameters.bricks_mortar,
        parameters.bricks_brick_color,
        parameters.bricks_mortar_color,
        parameters.bricks_variation,
    );
    // bump: Bump
    let bump_normal = bump(
        bricks.mask,
        parameters.bump_amplitude,
        parameters.bump_strength,
        in.position_world,
        in.normal_world,
    );
    // wall: Oren-Nayar
    let wall_ambient_radiance = oren_nayar_ambient(
        bump_normal,
        bricks.color,
        parameters.wall_roughness,
        frame.environment_irradiance,
    );
    return vec4f(wall_ambient_radiance, 1.0);
}
