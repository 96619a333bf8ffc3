//! What passes take, where clocks can tell; and what is the same whatever the clock.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::render::Gpu;
use shadetree::scene::Shape;

use crate::stage::{Item, Stage, View, light, visibility};

/// A spotlight over a ball on the ground, of so many segments, in a picture of this width. The ball rises a little with
/// every run, as maps of what stands still are kept.
fn stage(segments: u32, width: u32, run: u32) -> Stage {
    let place = DVec3::new(0.3, 0.8 + 1e-3 * f64::from(run), 0.1);
    let ball = Item::new(&Shape::Sphere { radius: 0.5, segments }, DMat4::from_translation(place));
    let view = View {
        position: DVec3::new(0.0, 3.0, 3.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        half_height: 0.35,
        size: (width, width * 3 / 4),
    };
    Stage::new(vec![Item::plane([12.0, 12.0], DMat4::IDENTITY), ball], view)
}

/// What to time: a shadow with its options on a map of this size, in a picture this wide, of a ball of so many segments.
#[derive(Clone, Copy)]
pub(super) struct Timed {
    pub(super) shadow: &'static str,
    pub(super) options: &'static str,
    pub(super) size: u32,
    pub(super) width: u32,
    pub(super) segments: u32,
}

/// Milliseconds of the passes of a shadow: what draws casters, what blurs, and what shades; and all of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Times {
    pub(super) casters: f64,
    pub(super) blur: f64,
    pub(super) main: f64,
    pub(super) all: f64,
}

/// The least of several runs, one after the other so that neighbours disturb all alike. None where there is no clock.
pub(super) fn times(gpu: &mut Gpu, all: &[Timed]) -> Option<Vec<Times>> {
    let shaders: Vec<Compiled> = all
        .iter()
        .map(|t| {
            let options = format!("\"size\": \"{}\"{}", t.size, t.options);
            visibility(&light("spot_light", "", t.shadow, "", &options))
        })
        .collect();
    let never = Times { casters: f64::INFINITY, blur: f64::INFINITY, main: f64::INFINITY, all: f64::INFINITY };
    let mut best = vec![never; all.len()];
    for run in 0..6 {
        for ((shader, t), best) in shaders.iter().zip(all).zip(&mut best) {
            let timings = stage(t.segments, t.width, run).frame(gpu, shader).timings;
            let of = |what: &dyn Fn(&str) -> bool| {
                timings.iter().filter(|t| what(&t.name)).map(|t| t.milliseconds).sum::<Option<f64>>()
            };
            best.casters = best.casters.min(of(&|n| n.contains("depth") || n.contains("moments"))?);
            best.blur = best.blur.min(of(&|n| n.contains("blur"))?);
            best.main = best.main.min(of(&|n| n == "main")?);
            best.all = best.all.min(of(&|_| true)?);
        }
    }
    Some(best)
}

/// Milliseconds of shading with boxes of two widths from a table of sums.
pub(super) fn widths(gpu: &mut Gpu, narrow: f64, wide: f64) -> Option<(f64, f64)> {
    let shader =
        visibility(&light("spot_light", "", "summed_area_shadow", "", "\"size\": \"256\", \"footprint\": \"fixed\""));
    let mut stage = stage(24, 256, 0);
    let mut best = [f64::INFINITY; 2];
    for _ in 0..8 {
        for (width, best) in [narrow, wide].into_iter().zip(&mut best) {
            stage.set("light/shadow.width", &[width]);
            let timings = stage.frame(gpu, &shader).timings;
            *best = best.min(timings.iter().find(|t| t.name == "main")?.milliseconds?);
        }
    }
    Some((best[0], best[1]))
}
