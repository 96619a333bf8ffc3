//! T16: where pixels are larger than texels, a kernel as large as the pixel's footprint comes near the exact integral over
//! it, and a kernel of a fixed width does not.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::render::Gpu;

use super::lamp::CLOSED_FORM;
use super::planar::worst;
use crate::stage::{Item, Stage, View, gpu, light, visibility};

/// Metres per texel of the sun's map, which is straight above and 16 m wide.
const TEXEL: f64 = 16.0 / 1024.0;

fn shader(kind: &str, options: &str) -> Compiled {
    let sun = "\"direction\": (0, -1, 0), \"radius\": 8";
    visibility(&light("directional_light", sun, kind, "", &format!("\"size\": \"1024\", {options}")))
}

/// Bars above the ground, given by the middles and half widths of their shadows along a line at `angle`.
struct Bars {
    angle: f64,
    bars: Vec<(f64, f64)>,
}

impl Bars {
    fn items(&self) -> Vec<Item> {
        let turn = DMat4::from_rotation_y(self.angle);
        let bar = |(middle, half): &(f64, f64)| {
            Item::plane([2.0 * half, 40.0], turn * DMat4::from_translation(DVec3::new(*middle, 2.0, 0.0)))
        };
        let ground = Item::plane([40.0, 40.0], DMat4::IDENTITY);
        std::iter::once(ground).chain(self.bars.iter().map(bar)).collect()
    }

    fn lights(&self, point: DVec3) -> bool {
        let along = point.x * self.angle.cos() - point.z * self.angle.sin();
        self.bars.iter().all(|(middle, half)| (along - middle).abs() > *half)
    }

    /// The lit share of every pixel's footprint, at 40 by 40 places of it.
    fn exact(&self, view: View) -> Vec<f64> {
        const PARTS: u32 = 40;
        let fine = View { size: (view.size.0 * PARTS, view.size.1 * PARTS), ..view };
        let pixel = |x: u32, y: u32| {
            let places = (0..PARTS).flat_map(|i| (0..PARTS).map(move |j| (x * PARTS + i, y * PARTS + j)));
            let lit = places.filter(|p| self.lights(fine.point(*p, DVec3::ZERO, DVec3::Y))).count();
            lit as f64 / f64::from(PARTS * PARTS)
        };
        (0..view.size.1).flat_map(|y| (0..view.size.0).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect()
    }

    /// Root mean square and greatest error of a shader.
    fn error(&self, gpu: &mut Gpu, view: View, exact: &[f64], shader: &Compiled) -> (f64, f64) {
        let values = Stage::new(self.items(), view).look(gpu, shader);
        let square = values.iter().zip(exact).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / exact.len() as f64;
        (square.sqrt(), worst(values.into_iter().zip(exact.iter().copied())))
    }
}

/// Seen from below the bars, each pixel covering `footprint` texels, the picture turned against the map.
fn turned(footprint: f64, turn: f64) -> View {
    let mut view = View::down((0.013, -0.021), 1.5, 24.0 * footprint * TEXEL, (24, 24));
    view.up = DVec3::new(turn.sin(), 0.0, -turn.cos());
    view
}

const WIDTHS: [u32; 3] = [1, 5, 9];

/// The edge of a wide plate: a texel belongs to one side or the other, so the edge is off by up to half a texel, and taps
/// spread it over one more, a quarter of which is on the wrong side at most: 3/4 of a texel in a footprint of `footprint`.
#[test]
fn an_edge_is_integrated_to_a_part_of_a_texel() {
    let Some(mut gpu) = gpu() else { return };
    for (angle, turn) in [(0.0, 0.0), (0.3, 0.3), (0.4, -0.5)] {
        let bars = Bars { angle, bars: vec![(-8.0 + 0.3 * TEXEL, 8.0)] };
        for footprint in [2.0, 4.0, 8.0] {
            let view = turned(footprint, turn);
            let exact = bars.exact(view);
            for taps in ["bilinear", "hardware"] {
                let adaptive = shader("adaptive_pcf_shadow", &format!("\"taps\": \"{taps}\""));
                let (_, off) = bars.error(&mut gpu, view, &exact, &adaptive);
                assert!(off < 0.75 / footprint, "{angle} {turn} {footprint} {taps}: {off}");
            }
        }
    }
}

/// Bars thinner than pixels: kernels of fixed width see them come and go. Seen straight on and along the ground.
#[test]
fn thin_bars_do_not_alias() {
    let Some(mut gpu) = gpu() else { return };
    let bars = Bars { angle: 0.25, bars: (-60..60).map(|i| (f64::from(i) * 5.3 * TEXEL, 1.05 * TEXEL)).collect() };
    let grazing = View {
        position: DVec3::new(0.0, 0.6, 2.0),
        target: DVec3::new(0.1, 0.0, -2.0),
        up: DVec3::Y,
        half_height: 0.06,
        size: (24, 24),
    };
    for (what, view) in [("straight", turned(8.0, 0.2)), ("turned", turned(16.0, 0.7)), ("grazing", grazing)] {
        let exact = bars.exact(view);
        let mut error = |kind: &str, options: &str| bars.error(&mut gpu, view, &exact, &shader(kind, options)).0;
        let adaptive = error("adaptive_pcf_shadow", "\"most\": \"16\"");
        for width in WIDTHS {
            let fixed = error("pcf_shadow", &format!("\"weights\": \"box\", \"width\": \"{width}\""));
            // A box of 9 texels is nearly the footprint of 8.
            let least = if what == "straight" && width == 9 { 1.0 } else { 1.5 };
            assert!(fixed > least * adaptive, "{what} {width}: {fixed}, adaptive {adaptive}");
        }
        // More taps than texels change nothing; fewer are worse.
        let errors: Vec<f64> = ["1", "2", "4", "8"]
            .iter()
            .map(|most| error("adaptive_pcf_shadow", &format!("\"most\": \"{most}\"")))
            .collect();
        assert!(errors[0] > 2.0 * adaptive && errors[1] > errors[3], "{what}: {errors:?} {adaptive}");
        assert!(errors[3] > adaptive - 0.02, "{what}: {errors:?} {adaptive}");
    }
}

/// Near the camera a footprint is less than a texel: four texels are blended, as by filtered comparison one texel wide. A
/// least width of n texels is the box of n texels, whatever the view.
#[test]
fn near_the_camera_it_is_the_blend_of_four_texels_or_the_least_box() {
    let Some(mut gpu) = gpu() else { return };
    let bars = Bars { angle: 0.3, bars: vec![(-8.0, 8.0)] };
    let stage = Stage::new(bars.items(), turned(0.25, 0.0));
    for (least, width) in [(0.0, 1), (1.0, 1), (3.0, 3), (7.0, 7)] {
        let mut adaptive = shader("adaptive_pcf_shadow", "\"most\": \"8\"");
        for parameter in adaptive.module.parameters.iter_mut().filter(|p| p.path.ends_with("shadow.width")) {
            parameter.value = shadetree::semantic::Value::Numbers(vec![least]);
        }
        let fixed = shader("pcf_shadow", &format!("\"weights\": \"box\", \"width\": \"{width}\""));
        let (a, b) = (stage.look(&mut gpu, &adaptive), stage.look(&mut gpu, &fixed));
        assert!(b.iter().any(|v| *v > 0.2 && *v < 0.8), "the edge is seen");
        let off = worst(a.into_iter().zip(b));
        assert!(off < CLOSED_FORM, "{least}: {off}");
    }
}
