//! What is kept from one picture to the next, and what is made again.

use super::maps::{COLOR, filtered, floor_and_roof, lit_by, moment_passes, shadowed};
use super::*;
use crate::plan::Pass;

fn names(frame: &Frame) -> Vec<&str> {
    frame.timings.iter().map(|t| t.name.as_str()).collect()
}

#[test]
fn another_camera_draws_no_casters_and_sees_the_same_shadow() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), shadowed());
    let mut job = job(floor_and_roof(&mesh, &shader));
    job.size = (64, 64);
    job.camera.position = Vec3::new(-3.0, -3.0, 4.0);
    let first = gpu.render(&job).expect("renders");
    assert_eq!((names(&first), gpu.views_drawn()), (vec!["sun: depth", "main"], 1));
    let uploads = gpu.uploads_made();
    job.camera.position = Vec3::new(-2.0, -3.5, 4.0);
    let other = gpu.render(&job).expect("renders");
    assert_eq!((names(&other), gpu.views_drawn()), (vec!["main"], 1));
    assert!(first.pixels != other.pixels, "the camera has moved");
    let fresh = super::gpu().expect("as before").render(&job).expect("renders");
    assert!(fresh.pixels == other.pixels, "a kept map is the map that would be made");
    // The same shape at another address brings nothing new; another one does.
    let copy = mesh.clone();
    for draw in &mut job.draws {
        draw.mesh = &copy;
    }
    gpu.render(&job).expect("renders");
    assert_eq!((gpu.views_drawn(), gpu.uploads_made()), (1, uploads));
    let mut larger = mesh.clone();
    larger.positions[2] *= 1.5;
    job.draws = floor_and_roof(&larger, &shader);
    gpu.render(&job).expect("renders");
    assert_eq!((gpu.views_drawn(), gpu.uploads_made()), (2, uploads + 1), "its positions are new, its indices are not");
}

#[test]
fn whatever_a_map_depends_on_makes_it_anew() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), shadowed());
    let mut drawn = 0;
    let mut check = |change: &dyn Fn(&mut Vec<Draw<'_>>), passes: &Compiled, expected: usize, what: &str| {
        let mut draws = floor_and_roof(&mesh, passes);
        change(&mut draws);
        gpu.render(&job(draws)).expect("renders");
        drawn += expected;
        assert_eq!(gpu.views_drawn(), drawn, "{what}");
    };
    let with = |change: &dyn Fn(&mut Pass)| {
        let mut shader = shadowed();
        change(&mut shader.plan.maps[0].passes[0]);
        shader
    };
    check(&|_| {}, &shader, 1, "the first picture");
    check(&|_| {}, &shader, 0, "the same again");
    check(&|d| d[1].object_to_world.w_axis.x += 0.25, &shader, 1, "a caster has moved");
    check(&|d| d[1].casts = false, &shader, 1, "one casts no more");
    check(&|d| d[1].object_to_world = Mat4::from_rotation_z(0.3) * d[1].object_to_world, &shader, 1, "one has turned");
    let light = |d: &mut Vec<Draw<'_>>, path: &str, numbers: &[f64]| {
        for draw in d {
            draw.values.insert(path.into(), Value::Numbers(numbers.to_vec()));
        }
    };
    check(&|d| light(d, "sun.direction", &[0.1, 0.0, -1.0]), &shader, 1, "the light has turned");
    check(&|d| light(d, "sun.radius", &[2.5]), &shader, 1, "the map covers more");
    check(&|_| {}, &with(&|p| drop(p.choices.insert("size".into(), "128".into()))), 1, "another size");
    check(&|_| {}, &with(&|p| drop(p.choices.insert("cull".into(), "front".into()))), 1, "other sides");
    check(&|_| {}, &with(&|p| p.clear = vec![0.5]), 1, "another depth where nothing is");
    check(&|_| {}, &with(&|p| p.wgsl = p.wgsl.replace("linear(in.z)", "linear(in.z) * 0.5")), 1, "another shader");
    check(&|_| {}, &shader, 0, "what was there before is still there");
    gpu.keep_maps(0);
    for _ in 0..2 {
        let before = gpu.views_drawn();
        let frame = gpu.render(&job(floor_and_roof(&mesh, &shader))).expect("renders");
        assert_eq!((names(&frame).len(), gpu.views_drawn()), (2, before + 1), "nothing is kept where there is no room");
    }
}

/// Two maps of one light that begin alike: casters are drawn once, and passes run once as long as they are the same.
#[test]
fn equal_beginnings_are_made_once() {
    let Some(mut gpu) = gpu() else { return };
    let mesh = square();
    let longer = filtered();
    let without_mips: Vec<Pass> = moment_passes().drain(..2).collect();
    let mut again = moment_passes();
    again.remove(2);
    // Moments and one shift are the whole of one map, and the beginning of two others.
    for (shorter, expected) in [
        (again, vec!["sun: moments", "sun: shift", "sun: shift", "sun: mips", "sun: mips", "main"]),
        (without_mips, vec!["sun: moments", "sun: shift", "sun: shift", "sun: mips", "main"]),
    ] {
        let shorter = lit_by(shorter);
        let place =
            |x: f32| Mat4::from_translation(Vec3::new(x, 0.0, 0.0)) * Mat4::from_scale(Vec3::new(0.5, 1.0, 1.0));
        let draws = |left, right| {
            vec![
                Draw { object_to_world: place(-0.5), ..draw(&mesh, left) },
                Draw { object_to_world: place(0.5), ..draw(&mesh, right) },
            ]
        };
        let both = gpu.render(&job(draws(&longer, &shorter))).expect("renders");
        assert_eq!(names(&both), expected);
        assert_eq!(both.messages.is_empty(), gpu.adapter().formats.iter().any(|(n, a)| n == COLOR[0] && a.filterable));
        let alone = |shader| super::gpu().expect("as before").render(&job(draws(shader, shader))).expect("renders");
        let (left, right) = (alone(&longer), alone(&shorter));
        assert!(left.pixels != right.pixels, "they can be told apart");
        for (i, pixel) in both.pixels.iter().enumerate() {
            let expected = if i % 16 < 8 { &left } else { &right };
            assert_eq!(*pixel, expected.pixels[i], "pixel {i}");
        }
        gpu = super::gpu().expect("as before");
    }
}

#[test]
fn nothing_outlives_a_lost_device() {
    let Some(mut gpu) = gpu() else { return };
    let (mesh, shader) = (square(), shadowed());
    let job = job(floor_and_roof(&mesh, &shader));
    gpu.render(&job).expect("renders");
    gpu.lose();
    let lost = gpu.render(&job);
    assert!(matches!(lost, Err(RenderError::DeviceLost(_))), "{lost:?}");
    assert!(gpu.keeps_nothing());
}
