//! Maps of lights: geometry, image and mip passes, and materials that read them.

use super::*;
use crate::module::{Address, SamplerSettings};
use crate::plan::{Light, Map, Pass, PassKind, Space};

const LIGHT_SPACE: &str =
    "struct LightSpace { world_to_light: mat4x4f, projection: vec4f, depth: vec4f, source: vec4f, warp: vec4f }
struct Object { world: mat4x4f }
@group(0) @binding(0) var<uniform> light: LightSpace;
@group(1) @binding(0) var<uniform> object: Object;
fn place(position: vec3f) -> vec3f {
    return (light.world_to_light * object.world * vec4f(position, 1.0)).xyz;
}
fn linear(z: f32) -> f32 { return (z - light.depth.x) * light.depth.z; }
struct Varying { @builtin(position) clip: vec4f, @location(0) z: f32 }
@vertex
fn vs_main(@location(0) position: vec3f) -> Varying {
    let p = place(position);
    return Varying(vec4f(p.xy * light.projection.xy, linear(p.z), 1.0), p.z);
}
";

const FULL_SCREEN: &str = "@group(0) @binding(0) var source: texture_2d<f32>;
@vertex
fn vs_main(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(vec2f(f32(i & 1u), f32(i >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}
";

fn pass(name: &str, kind: PassKind, wgsl: String, targets: &[&str]) -> Pass {
    Pass {
        name: name.into(),
        kind,
        choices: [("size".to_owned(), "64".to_owned())].into(),
        wgsl,
        targets: targets.iter().map(|t| (*t).to_owned()).collect(),
        clear: vec![1.0, 1.0],
        reads_light: false,
        repeat: None,
        otherwise: None,
    }
}

fn depth_pass() -> Pass {
    let fragment = "@fragment fn fs_main(in: Varying) -> @builtin(frag_depth) f32 { return linear(in.z); }";
    pass("depth", PassKind::Geometry, format!("{LIGHT_SPACE}{fragment}"), &["depth32float"])
}

pub(super) const COLOR: [&str; 3] = ["rg32float", "rg16unorm", "rg16float"];

pub(super) fn moment_passes() -> Vec<Pass> {
    let fragment = "@fragment fn fs_main(in: Varying) -> @location(0) vec2f { return vec2f(linear(in.z), 0.5); }";
    // Each image pass moves the picture by 8 texels, so that the number of passes that ran can be seen.
    let shift = |to: &str| {
        format!(
            "{FULL_SCREEN}@fragment fn fs_main(@builtin(position) p: vec4f) -> @location(0) vec4f {{
    let at = clamp(vec2i(p.xy) + vec2i({to}), vec2i(0), vec2i(textureDimensions(source)) - 1);
    return textureLoad(source, at, 0);
}}"
        )
    };
    let mip = format!(
        "{FULL_SCREEN}@fragment fn fs_main(@builtin(position) p: vec4f) -> @location(0) vec4f {{
    let at = vec2i(p.xy) * 2;
    return (textureLoad(source, at, 0) + textureLoad(source, at + vec2i(1, 0), 0)
        + textureLoad(source, at + vec2i(0, 1), 0) + textureLoad(source, at + vec2i(1, 1), 0)) * 0.25;
}}"
    );
    vec![
        pass("moments", PassKind::Geometry, format!("{LIGHT_SPACE}{fragment}"), &COLOR),
        pass("shift", PassKind::Image, shift("8, 0"), &COLOR),
        pass("shift", PassKind::Image, shift("0, 8"), &COLOR),
        pass("mips", PassKind::Mip, mip, &COLOR),
    ]
}

/// A sun along -z over a ball of radius 2, with a map; `body` reads `map` and `space`.
fn lit(passes: Vec<Pass>, declarations: &str, body: &str, ty: &str, settings: SamplerSettings) -> Compiled {
    let declarations = format!(
        "struct LightSpace {{ world_to_light: mat4x4f, projection: vec4f, depth: vec4f, source: vec4f, warp: vec4f }}
@group(3) @binding(0) var<uniform> space: LightSpace;
{declarations}
fn map_place(world: vec3f) -> vec3f {{
    let p = (space.world_to_light * vec4f(world, 1.0)).xyz;
    return vec3f(p.xy * space.projection.xy * vec2f(0.5, -0.5) + 0.5, (p.z - space.depth.x) * space.depth.z);
}}"
    );
    let mut shader = material(
        &declarations,
        body,
        vec![
            binding(3, 0, "space", Resource::Space { light: "sun".into(), views: 1 }),
            binding(3, 1, "map", Resource::Map { index: 0, ty: ty.into() }),
            binding(3, 2, "map_sampler", Resource::Sampler(settings.clone())),
        ],
    );
    shader.module.parameters = vec![
        parameter("sun.direction", Shape::F32(3), 0, &[0.0, 0.0, -1.0]),
        parameter("sun.center", Shape::F32(3), 16, &[0.0, 0.0, 0.0]),
        parameter("sun.radius", Shape::F32(1), 28, &[2.0]),
        parameter("sun.angle", Shape::F32(1), 32, &[0.0]),
    ];
    shader.module.parameter_bytes = 48;
    let inputs = ["sun.direction", "sun.center", "sun.radius", "sun.angle"].map(String::from).to_vec();
    let space = Some(Space { projection: "orthographic".into(), inputs, settings: [].into(), views: 1 });
    shader.plan.lights = vec![Light { name: "sun".into(), space }];
    shader.plan.maps = vec![Map { light: "sun".into(), passes, filtered: settings.linear }];
    shader
}

const COMPARE: SamplerSettings =
    SamplerSettings { linear: true, mip_linear: false, address: Address::Clamp, anisotropy: 1, compare: true };
const TRILINEAR: SamplerSettings =
    SamplerSettings { linear: true, mip_linear: true, address: Address::Clamp, anisotropy: 4, compare: false };

pub(super) fn shadowed() -> Compiled {
    lit(
        vec![depth_pass()],
        "@group(3) @binding(1) var map: texture_depth_2d_array;\n@group(3) @binding(2) var map_sampler: sampler_comparison;",
        "let at = map_place(in.world);
    let lit = textureSampleCompareLevel(map, map_sampler, at.xy, 0, at.z - 0.01);
    return vec4f(vec3f(mix(1.0, lit, object.receives)), 1.0);",
        "texture_depth_2d_array",
        COMPARE,
    )
}

/// A floor of 4 by 4 metres at z = 0 and an upright square of 1 by 1 metre above its upper right quarter at z = 1.
pub(super) fn floor_and_roof<'a>(mesh: &'a Mesh, shader: &'a Compiled) -> Vec<Draw<'a>> {
    let floor = Draw { object_to_world: Mat4::from_scale(Vec3::new(2.0, 2.0, 1.0)), ..draw(mesh, shader) };
    let place = Mat4::from_translation(Vec3::new(1.0, 1.0, 1.0)) * Mat4::from_scale(Vec3::new(0.5, 0.5, 1.0));
    vec![floor, Draw { object_to_world: place, ..draw(mesh, shader) }]
}

#[test]
fn a_depth_map_shadows_what_lies_behind() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), shadowed());
    // The camera looks from the side of the light, past the roof to the floor.
    let mut job = job(floor_and_roof(&mesh, &shader));
    job.size = (64, 64);
    job.camera.position = Vec3::new(-3.0, -3.0, 4.0);
    let frame = gpu.render(&job).expect("renders");
    let dark = |frame: &Frame| frame.pixels.iter().filter(|p| p[3] > 0.5 && p[0] < 0.1).count();
    let shadow = dark(&frame);
    assert!(shadow > 20, "{shadow} pixels in shadow");
    assert_eq!(frame.timings.iter().map(|t| t.name.as_str()).collect::<Vec<_>>(), ["sun: depth", "main"]);
    assert_eq!(gpu.pipelines_built(), 2, "both draws share map and pipelines");

    job.draws[0].receives = false;
    assert_eq!(dark(&gpu.render(&job).expect("renders")), 0, "the floor takes no shadow");
    job.draws[0].receives = true;
    job.draws[1].casts = false;
    assert_eq!(dark(&gpu.render(&job).expect("renders")), 0, "the roof casts none");
}

#[test]
fn a_depth_map_can_be_read_back() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), shadowed());
    let job = job(floor_and_roof(&mesh, &shader));
    let map = gpu.map(&job, "sun", 0);
    if gpu.adapter().backend == "gl" {
        // OpenGL ES cannot copy depth out of a texture.
        assert!(matches!(map, Err(RenderError::Unsupported(_))), "{map:?}");
        return;
    }
    let map = map.expect("renders");
    assert_eq!((map.size, map.channels, map.format), ((64, 64), 1, "depth32float"));
    // In light space +x is the world's -x here, so the roof is in the upper left quarter of the map.
    let at = |x: usize, y: usize| map.pixels[y * 64 + x][0];
    let metres = |v: f32| v * (map.spaces[0].depth.y - map.spaces[0].depth.x);
    assert!((metres(at(48, 48)) - metres(at(16, 16)) - 1.0).abs() < 1e-3, "{} {}", at(48, 48), at(16, 16));
    let error = gpu.map(&job, "moon", 0).expect_err("no such light");
    assert!(error.to_string().contains("lights with maps: sun"), "{error}");
}

pub(super) fn filtered() -> Compiled {
    lit_by(moment_passes())
}

/// The moments that a map holds, smallest level on the right.
pub(super) fn lit_by(passes: Vec<Pass>) -> Compiled {
    lit(
        passes,
        "@group(3) @binding(1) var map: texture_2d_array<f32>;\n@group(3) @binding(2) var map_sampler: sampler;",
        "let lod = select(0.0, 6.0, in.world.x > 0.0);
    return vec4f(textureSampleLevel(map, map_sampler, map_place(in.world).xy, 0, lod).rg, f32(textureNumLevels(map)), 1.0);",
        "texture_2d_array<f32>",
        TRILINEAR,
    )
}

#[test]
fn image_passes_run_in_order_and_mips_average() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), filtered());
    let job = job(vec![draw(&mesh, &shader)]);
    let map = gpu.map(&job, "sun", 0).expect("renders");
    assert_eq!(map.channels, 2);
    // The square covers the middle 32 texels; both shifts move it by 8 to the upper left.
    let covered = |x: usize, y: usize| map.pixels[y * 64 + x][1] < 0.75;
    for (x, y, expected) in
        [(7, 20, false), (8, 20, true), (39, 20, true), (40, 20, false), (20, 7, false), (20, 8, true)]
    {
        assert_eq!(covered(x, y), expected, "texel {x}, {y}");
    }
    let frame = gpu.render(&job).expect("renders");
    assert_eq!(frame.pixels[8 * 16 + 8][2], 7.0, "64 texels have 7 levels");
    // A quarter of the map holds 0.5 and the rest 1.
    assert!((pixel(&frame, 9, 8)[1] - 0.875).abs() < 2e-3, "{:?}", pixel(&frame, 9, 8));
    let names: Vec<&str> = frame.timings.iter().map(|t| t.name.as_str()).collect();
    assert_eq!(names, ["sun: moments", "sun: shift", "sun: shift", "sun: mips", "main"]);
    if gpu.adapter().features.iter().any(|f| f == "timestamp-query") {
        assert!(frame.timings.iter().all(|t| t.milliseconds.is_some()), "{:?}", frame.timings);
    }
    let first_choice = map.format == COLOR[0];
    assert_eq!(frame.messages.is_empty(), first_choice, "{} {:?}", map.format, frame.messages);
}

/// Every texel becomes the sum of those before it in its row, by steps that grow by `factor`; another pass of the same
/// kind adds up the columns.
fn sums(kind: PassKind, factor: u32) -> Vec<Pass> {
    let mut passes = vec![moment_passes().remove(0)];
    let ones =
        "@fragment fn fs_main(@builtin(position) p: vec4f) -> @location(0) vec2u { return vec2u(1u, u32(p.x)); }";
    // A source that is not read would be left out of the layout that it is checked against.
    let ones = format!("{FULL_SCREEN}{ones}\nfn unused() -> vec4f {{ return textureLoad(source, vec2i(0), 0); }}");
    passes.push(pass("ones", PassKind::Image, ones, &["rg32uint"]));
    let body = |across: bool| {
        let (axis, step) = if across { ("x", "vec2u(distance, 0u)") } else { ("y", "vec2u(0u, distance)") };
        format!(
            "var sum = textureLoad(source, at, 0);
    for (var i = 1u; i <= min(at.{axis} / distance, {factor}u - 1u); i++) {{
        sum += textureLoad(source, at - i * {step}, 0);
    }}"
        )
    };
    let declared = "@group(0) @binding(3) var<uniform> distance: u32;\n";
    for across in [true, false] {
        let drawn = format!(
            "{}{declared}@fragment fn fs_main(@builtin(position) p: vec4f) -> @location(0) vec4u {{
    let at = vec2u(p.xy);
    {}
    return sum;
}}",
            FULL_SCREEN.replace("<f32>", "<u32>"),
            body(across)
        );
        let computed = format!(
            "@group(0) @binding(0) var source: texture_2d<u32>;
@group(0) @binding(1) var stored: texture_storage_2d<rg32uint, write>;
{declared}@compute @workgroup_size(16, 4) fn cs_main(@builtin(global_invocation_id) id: vec3u) {{
    let at = id.xy;
    {}
    textureStore(stored, at, sum);
}}",
            body(across)
        );
        let repeat = Some(factor);
        let drawn = Pass { repeat, ..pass("drawn", PassKind::Image, drawn, &["rg32uint"]) };
        let computed = Pass {
            repeat,
            otherwise: Some(Box::new(drawn.clone())),
            ..pass("computed", PassKind::Compute, computed, &["rg32uint"])
        };
        passes.push(if kind == PassKind::Compute { computed } else { drawn });
    }
    passes
}

fn summed(kind: PassKind, factor: u32) -> Compiled {
    lit(
        sums(kind, factor),
        "@group(3) @binding(1) var map: texture_2d_array<u32>;\n@group(3) @binding(2) var map_sampler: sampler;",
        "return vec4f(vec4u(textureLoad(map, vec2i(map_place(in.world).xy * 64.0), 0, 0)));",
        "texture_2d_array<u32>",
        SamplerSettings { linear: false, mip_linear: false, anisotropy: 1, ..TRILINEAR },
    )
}

/// Drawn and computed, by twos, threes and fours: the sum over 64 texels each way, exactly; one entry of time for all of
/// a pass's steps.
#[test]
fn repeated_passes_add_up_whole_rows_and_columns() {
    let Some(mut gpu) = gpu() else { return };
    let stores = gpu.adapter().formats.iter().any(|(name, able)| name == "rg32uint" && able.storable);
    // Where drawing takes the place of computing, both are the same map.
    gpu.keep_maps(0);
    let mesh = square();
    for kind in [PassKind::Image, PassKind::Compute] {
        for factor in [2, 3, 4, 64] {
            let shader = summed(kind, factor);
            let job = job(vec![draw(&mesh, &shader)]);
            let map = gpu.map(&job, "sun", 0).expect("renders");
            assert_eq!((map.format, map.channels), ("rg32uint", 2));
            for (i, texel) in (0_u32..).zip(&map.integers) {
                let (x, y) = (i % 64, i / 64);
                assert_eq!(*texel, [(x + 1) * (y + 1), x * (x + 1) / 2 * (y + 1), 0, 0], "{kind:?} {factor}: {x} {y}");
            }
            let frame = gpu.render(&job).expect("renders");
            let name = if kind == PassKind::Compute && stores { "sun: computed" } else { "sun: drawn" };
            let names: Vec<&str> = frame.timings.iter().map(|t| t.name.as_str()).collect();
            assert_eq!(names, ["sun: moments", "sun: ones", name, name, "main"]);
            if gpu.adapter().features.iter().any(|f| f == "timestamp-query") {
                assert!(frame.timings.iter().all(|t| t.milliseconds.is_some()), "{:?}", frame.timings);
            }
            let replaced = frame.messages.iter().any(|m| m.contains("`drawn`") && m.contains("rg32uint"));
            assert_eq!(replaced, kind == PassKind::Compute && !stores, "{:?}", frame.messages);
        }
    }
    let built = gpu.pipelines_built();
    let shader = summed(PassKind::Compute, 3);
    gpu.render(&job(vec![draw(&mesh, &shader)])).expect("renders");
    assert_eq!(gpu.pipelines_built(), built, "pipelines of compute passes are kept");
}

#[test]
fn compute_passes_that_cannot_run_say_why() {
    let Some(mut gpu) = gpu() else { return };
    let stores = gpu.adapter().formats.iter().any(|(name, able)| name == "rg32uint" && able.storable);
    let mesh = square();
    let mut refused = |change: &dyn Fn(&mut Vec<Pass>)| {
        let mut shader = summed(PassKind::Compute, 4);
        change(&mut shader.plan.maps[0].passes);
        gpu.render(&job(vec![draw(&mesh, &shader)])).expect_err("refused").to_string()
    };
    // Nobody stores depth.
    let no_format = refused(&|passes| {
        passes[2] = Pass { targets: vec!["depth32float".into()], otherwise: None, ..passes[2].clone() };
    });
    assert!(no_format.contains("`computed`") && no_format.contains("depth32float"), "{no_format}");
    if !stores {
        return;
    }
    let not_its_own = refused(&|passes| {
        passes.remove(1);
    });
    assert!(not_its_own.contains("must make what it reads"), "{not_its_own}");
    let another_format = refused(&|passes| {
        for pass in &mut passes[1..] {
            pass.targets = vec!["rg32uint".into()];
            pass.wgsl = pass.wgsl.replace("<rg32uint, write>", "<rg32float, write>").replace("sum);", "vec4f(sum));");
        }
    });
    assert!(another_format.contains("rg32float") && another_format.contains("rg32uint"), "{another_format}");
    let deep = refused(&|passes| passes[2].wgsl = passes[2].wgsl.replace("(16, 4)", "(4, 4, 4)"));
    assert!(deep.contains("[4, 4, 4]"), "{deep}");
}

#[test]
fn plans_that_make_no_sense_are_refused() {
    let Some(mut gpu) = gpu() else { return };
    let mesh = square();
    let mut refused = |change: &dyn Fn(&mut Compiled)| {
        let mut shader = filtered();
        change(&mut shader);
        gpu.render(&job(vec![draw(&mesh, &shader)])).expect_err("refused").to_string()
    };
    assert!(refused(&|s| s.plan.maps[0].passes.reverse()).contains("one geometry pass"));
    assert!(refused(&|s| s.plan.maps[0].light = "moon".into()).contains("moon"));
    assert!(refused(&|s| s.plan.maps[0].passes[0].targets = vec!["rg12float".into()]).contains("rg"));
    assert!(refused(&|s| s.plan.lights[0].space = None).contains("no projection"));
    assert!(refused(&|s| s.plan.maps.clear()).contains("`map`"));
    let size = |text: &'static str| {
        move |s: &mut Compiled| {
            s.plan.maps[0].passes[0].choices.insert("size".into(), text.into());
        }
    };
    assert!(refused(&size("0")).contains("no pixels"));
    assert!(refused(&size("1048576")).contains("at most"));
}

#[test]
fn a_degenerate_light_is_named_by_its_parameter() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), shadowed());
    let mut dark = draw(&mesh, &shader);
    dark.values.insert("sun.direction".into(), Value::Numbers(vec![0.0, 0.0, 0.0]));
    let error = gpu.render(&job(vec![dark])).expect_err("no direction");
    assert!(matches!(&error, RenderError::Parameter { path, .. } if path == "sun.direction"), "{error}");
}
