//! Devices that go away, and jobs that are too large.

use super::*;

#[test]
fn a_lost_device_is_an_error_that_says_so() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), paint());
    let job = job(vec![draw(&mesh, &shader)]);
    gpu.render(&job).expect("renders");
    gpu.lose();
    // Once with its pipelines made before, and once more: it stays lost.
    for _ in 0..2 {
        let error = gpu.render(&job).expect_err("the device is gone");
        assert!(matches!(error, RenderError::DeviceLost(_)), "{error:?}");
        assert!(error.help().is_some());
    }
    // Pipelines that are not made yet are not to blame either.
    let other = Job { samples: 4, ..job };
    assert!(matches!(gpu.render(&other), Err(RenderError::DeviceLost(_))));
}

#[test]
fn a_device_lost_before_its_first_job_is_an_error() {
    let Some(mut gpu) = gpu() else { return };
    gpu.lose();
    let (mesh, shader) = (square(), paint());
    let job = job(vec![draw(&mesh, &shader)]);
    assert!(matches!(gpu.render(&job), Err(RenderError::DeviceLost(_))));
}

/// WebGPU promises 64 KiB per uniform block; devices tell how much they take.
#[test]
fn too_many_parameters_are_counted_against_the_limit() {
    let Some(mut gpu) = gpu() else { return };
    let limit =
        gpu.adapter().limits.iter().find(|(name, _)| name == "max-uniform-buffer-binding-size").expect("a limit").1;
    let vectors = limit / 16 + 1;
    let mut shader = material(
        &format!(
            "struct Parameters {{ all: array<vec4f, {vectors}> }}\n@group(2) @binding(0) var<uniform> parameters: Parameters;"
        ),
        "return parameters.all[0];",
        vec![binding(2, 0, "parameters", Resource::Parameters)],
    );
    let Ok(bytes) = u32::try_from(vectors * 16) else { return };
    shader.module.parameter_bytes = bytes;
    let mesh = square();
    let error = gpu.render(&job(vec![draw(&mesh, &shader)])).expect_err("over the limit");
    let text = error.to_string();
    assert!(text.contains("`parameters`") && text.contains(&format!("{limit} bytes")), "{text}");
    assert!(error.help().is_some_and(|h| h.contains("parameters")), "{:?}", error.help());
}

#[test]
fn memory_is_counted_before_it_is_taken() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), paint());
    let side = gpu.adapter().limits.iter().find(|(name, _)| name == "max-texture-dimension-2d").expect("a limit").1;
    let side = u32::try_from(side).expect("small");
    let large = Job { size: (side, side), samples: 4, ..job(vec![draw(&mesh, &shader)]) };
    // Five colours of at least 8 bytes, each with its depth.
    if u64::from(side).pow(2) * 60 <= 4 << 30 {
        return;
    }
    let error = gpu.render(&large).expect_err("over the limit");
    assert!(matches!(error, RenderError::TooLarge { .. }) && error.to_string().contains("bytes"), "{error}");
    assert!(error.help().is_some_and(|h| h.contains("size of the picture")));
}
