//! Maps that are kept between pictures: for a light that stays as it was, and not for splits that follow the eye.

use glam::{DMat4, DVec3};
use shadetree::compile::{Options, Output};
use shadetree::scene::Shape;

use crate::stage::{Item, Stage, View, gpu};
use crate::support::{compiled, graph_file};

fn stage(eye: DVec3) -> Stage {
    let items = vec![
        Item::plane([40.0, 40.0], DMat4::IDENTITY),
        Item::new(&Shape::Box { size: [1.0, 2.0, 1.0], bevel: 0.0 }, DMat4::from_translation(DVec3::Y)),
    ];
    let view = View { position: eye, target: DVec3::ZERO, up: DVec3::Y, half_height: 0.5, size: (32, 32) };
    Stage::new(items, view)
}

#[test]
fn splits_follow_the_eye_and_other_maps_stay() {
    let Some(mut gpu) = gpu() else { return };
    // How many views are drawn again when the eye moves on.
    for (light, again) in [("sun_splits", 4), ("sun_vsm", 0), ("spot_sat_soft", 0), ("point_vsm", 0)] {
        let graphs = [format!("graphs/lights/{light}.ron"), "graphs/surfaces/lambert.ron".to_owned()];
        let graphs = graphs.map(|path| graph_file(path.as_ref()));
        let shader = compiled(&graphs, &Options { output: Output::Visibility(light.to_owned()), ..Options::default() });
        let mut drawn = Vec::new();
        let mut frames = Vec::new();
        for eye in [DVec3::new(4.0, 3.0, 5.0), DVec3::new(4.0, 3.0, 5.0), DVec3::new(1.0, 4.0, 6.0)] {
            let before = gpu.views_drawn();
            frames.push(stage(eye).frame(&mut gpu, &shader));
            drawn.push(gpu.views_drawn() - before);
        }
        assert_eq!((drawn[1], drawn[2]), (0, again), "{light}");
        assert!(drawn[0] > 0 && frames[0].pixels == frames[1].pixels, "{light}");
        assert_eq!(frames[1].timings.len(), 1, "{light}: {:?}", frames[1].timings);
        assert_eq!(frames[2].timings.len() > 1, again > 0, "{light}: {:?}", frames[2].timings);
    }
}
