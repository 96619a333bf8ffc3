//! Pictures of materials.

use super::*;
use crate::module::{Address, SamplerSettings};
use crate::render::{AdapterChoice, Surroundings, SurroundingsLevel, Texels, adapters};

#[test]
fn a_parameter_colours_a_square_and_changing_it_builds_no_pipeline() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), paint());
    let mut job = job(vec![draw(&mesh, &shader)]);
    let frame = gpu.render(&job).expect("renders");
    assert!(near(pixel(&frame, 8, 8), [0.25, 0.5, 0.75, 1.0]), "{:?}", pixel(&frame, 8, 8));
    assert_eq!(pixel(&frame, 0, 0), [0.0; 4], "beside the square there is nothing");
    assert_eq!(frame.timings.len(), 1);
    assert_eq!(gpu.pipelines_built(), 1);

    job.draws[0].values.insert("paint.color".into(), Value::Numbers(vec![1.0, 0.0, 0.5]));
    let frame = gpu.render(&job).expect("renders");
    assert!(near(pixel(&frame, 8, 8), [1.0, 0.0, 0.5, 1.0]), "{:?}", pixel(&frame, 8, 8));
    assert_eq!(gpu.pipelines_built(), 1);
}

#[test]
fn the_nearest_object_is_seen_and_up_is_up() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), paint());
    let mut front = draw(&mesh, &shader);
    front.object_to_world = Mat4::from_translation(Vec3::new(0.0, 1.0, 0.5));
    front.values.insert("paint.color".into(), Value::Numbers(vec![1.0, 1.0, 1.0]));
    let frame = gpu.render(&job(vec![front, draw(&mesh, &shader)])).expect("renders");
    assert!(near(pixel(&frame, 8, 5), [1.0; 4]), "upper half: the one in front, though it was drawn first");
    assert!(near(pixel(&frame, 8, 10), [0.25, 0.5, 0.75, 1.0]), "lower half");
}

#[test]
fn four_samples_smooth_edges() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), paint());
    let mut turned = draw(&mesh, &shader);
    turned.object_to_world = Mat4::from_rotation_z(0.3);
    let mut job = job(vec![turned]);
    let between = |frame: &Frame| frame.pixels.iter().filter(|p| p[3] > 0.1 && p[3] < 0.9).count();
    let frame = gpu.render(&job).expect("renders");
    assert_eq!(between(&frame), 0);
    job.samples = 4;
    let frame = gpu.render(&job).expect("renders");
    assert!(between(&frame) > 10 || !frame.messages.is_empty(), "{:?}", frame.messages);
}

#[test]
fn images_are_decoded_and_sampled_upright() {
    let Some(mut gpu) = gpu() else { return };
    let settings =
        SamplerSettings { linear: false, mip_linear: false, address: Address::Clamp, anisotropy: 1, compare: false };
    let image = Resource::Image { path: "half.png".into(), base: "graph".into(), srgb: true };
    let shader = material(
        "@group(2) @binding(0) var image: texture_2d<f32>;\n@group(2) @binding(1) var image_sampler: sampler;",
        "return textureSample(image, image_sampler, in.uv);",
        vec![binding(2, 0, "image", image), binding(2, 1, "image_sampler", Resource::Sampler(settings))],
    );
    let mesh = square();
    let load = |path: &str, base: &str| {
        assert_eq!((path, base), ("half.png", "graph"));
        let texels = Texels::Bytes(vec![[255, 255, 255, 255], [188, 0, 0, 255]]);
        Ok(Picture { width: 1, height: 2, texels })
    };
    let frame = gpu.render(&Job { images: &load, ..job(vec![draw(&mesh, &shader)]) }).expect("renders");
    assert!(near(pixel(&frame, 8, 5), [1.0; 4]), "{:?}", pixel(&frame, 8, 5));
    assert!((pixel(&frame, 8, 10)[0] - 0.5).abs() < 0.01, "sRGB 188 is half: {:?}", pixel(&frame, 8, 10));

    let error = gpu.render(&job(vec![draw(&mesh, &shader)])).expect_err("the image is missing");
    assert!(matches!(error, RenderError::Image { ref path, .. } if path == "half.png"), "{error}");
}

#[test]
fn surroundings_are_seen_behind_with_their_right_side_right() {
    let Some(mut gpu) = gpu() else { return };
    let (red, green, blue) = ([1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]);
    let row = [blue, red, green, blue];
    let level = SurroundingsLevel { width: 4, height: 2, pixels: row.repeat(2) };
    let surroundings = Surroundings { levels: vec![level], irradiance: [Vec4::ZERO; 9], background: true };
    let job = Job { surroundings: Some(&surroundings), ..job(Vec::new()) };
    let frame = gpu.render(&job).expect("renders");
    let (left, right) = (pixel(&frame, 1, 8), pixel(&frame, 14, 8));
    assert!(left[0] > left[1] && right[1] > right[0], "red left of -z, green right of it: {left:?} {right:?}");
    assert_eq!(left[3], 1.0);
}

#[test]
fn mistakes_are_errors_with_the_devices_words() {
    let Some(mut gpu) = gpu() else { return };
    let mesh = square();
    let broken = material("", "return vec4f(nothing);", Vec::new());
    let error = gpu.render(&job(vec![draw(&mesh, &broken)])).expect_err("no such name");
    assert!(matches!(&error, RenderError::Rejected { message, .. } if message.contains("nothing")), "{error}");

    let mut unbound = paint();
    unbound.module.bindings.pop();
    assert!(gpu.render(&job(vec![draw(&mesh, &unbound)])).is_err());

    let shader = paint();
    let sized = |size, samples| Job { size, samples, ..job(vec![draw(&mesh, &shader)]) };
    assert!(matches!(gpu.render(&sized((0, 4), 1)), Err(RenderError::Job(_))));
    assert!(matches!(gpu.render(&sized((1 << 20, 4), 1)), Err(RenderError::TooLarge { .. })));
    assert!(matches!(gpu.render(&sized((4, 4), 3)), Err(RenderError::Job(_))));

    let stray = Mesh { indices: vec![0, 1, 9], ..square() };
    assert!(matches!(gpu.render(&job(vec![draw(&stray, &shader)])), Err(RenderError::Job(_))));
    let flat = Draw { object_to_world: Mat4::from_scale(Vec3::new(1.0, 0.0, 1.0)), ..draw(&mesh, &shader) };
    assert!(matches!(gpu.render(&job(vec![flat])), Err(RenderError::Job(_))));

    let frame = gpu.render(&sized((4, 4), 1)).expect("and still it renders");
    assert!(near(pixel(&frame, 2, 2), [0.25, 0.5, 0.75, 1.0]));
}

#[test]
fn a_parameter_block_over_the_limit_is_refused_before_it_is_made() {
    let Some(mut gpu) = gpu() else { return };
    let mesh = square();
    let mut shader = paint();
    shader.module.parameter_bytes = u32::MAX / 16 * 16 / 8;
    let error = gpu.render(&job(vec![draw(&mesh, &shader)])).expect_err("half a gigabyte of parameters");
    assert!(matches!(error, RenderError::TooLarge { .. }), "{error}");
}

#[test]
fn the_adapter_in_use_is_among_those_that_are_listed() {
    let Some(gpu) = gpu() else { return };
    let options = AdapterOptions { backends: std::env::var("WGPU_BACKEND").ok(), ..AdapterOptions::default() };
    let all = adapters(&options).expect("a list");
    assert!(all.contains(gpu.adapter()), "{all:?}");
    let half = gpu.adapter().formats.iter().find(|(n, _)| n == "rgba16float");
    assert!(half.is_some_and(|(_, able)| able.renderable), "pictures can be made");
    assert!(gpu.adapter().limits.iter().all(|(_, limit)| *limit > 0));

    let part = gpu.adapter().name.to_uppercase();
    let named = AdapterOptions { choice: AdapterChoice::Name(part), ..options.clone() };
    assert_eq!(Gpu::new(&named).expect("opens").adapter().name, gpu.adapter().name);
    let unknown = AdapterChoice::Name("no such adapter".into());
    let Err(error) = Gpu::new(&AdapterOptions { choice: unknown, ..options }) else {
        panic!("nothing is called that");
    };
    assert!(error.help().is_some_and(|h| h.contains(&gpu.adapter().name)), "{error}");
}
