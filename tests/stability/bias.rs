//! Acne, and what constant biases do against it and to contacts.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::render::Gpu;

use super::bench::{least, look_with, naive};
use super::table::{Bound, Table};
use crate::laws::lamp::Lamp;
use crate::stage::{Item, Stage, View, gpu, light, visibility};

/// A lit plane that rises by this much per metre along x and z, seen over two texels of the map.
fn slope(x: f64, z: f64) -> Stage {
    let normal = DVec3::new(-x, 1.0, -z).normalize();
    let turn = DMat4::from_quat(glam::DQuat::from_rotation_arc(DVec3::Y, normal));
    let seen = 2.0 * Lamp::Sun.texel(0.0);
    Stage::new(vec![Item::plane([16.0, 16.0], turn)], View::down((0.301, 0.203), 0.5 + x + z, seen, (48, 48)))
}

fn shader(kind: &str, width: usize) -> Compiled {
    let (sun, at) = Lamp::Sun.kind();
    let taps = if kind == "pcf_shadow" { ", \"weights\": \"box\", \"taps\": \"nearest\"" } else { "" };
    naive(&light(sun, at, kind, "", &format!("\"size\": \"256\", \"width\": \"{width}\"{taps}")))
}

/// The darkest pixel of a lit slope, with a bias in metres.
pub(super) fn darkest(gpu: &mut Gpu, kind: &str, width: usize, (x, z): (f64, f64), bias: f64) -> f64 {
    least(&look_with(&mut slope(x, z), gpu, &shader(kind, width), "bias", bias))
}

/// The bias that a kernel needs on a slope, metres.
pub(super) fn needed(width: usize, (x, z): (f64, f64)) -> f64 {
    (x + z) * Lamp::Sun.texel(0.0) * (width as f64 / 2.0)
}

#[test]
fn acne_needs_a_bias_that_grows_with_slope_and_kernel() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "acne",
        "The darkest pixel of a lit plane in parallel light from above, map of 256 texels, nearest taps. One depth for all\ntaps needs the bias b = (|gu| + |gv|) (R + 1/2), g being the change of depth per texel and R half the kernel; the\nnode `pcf_shadow` compares each tap with the plane itself and needs none.",
        (0.0, ""),
        (1e-3, 0.0),
    );
    for width in [1, 3, 5, 7] {
        for slope in [(0.5, 0.0), (1.0, 0.5), (2.0, 2.0)] {
            let needed = needed(width, slope);
            let taps = (width * width) as f64;
            let what = |rest: &str| format!("width {width}, rise {} {}, {rest}", slope.0, slope.1);
            // Pixels come within 1/24 texel of the worst place, and vertices are placed on a grid of 1/256.
            let short = darkest(&mut gpu, "naive_pcf", width, slope, 0.93 * needed);
            table.row(what("0.93 b"), "T8: some tap fails", short, Bound::Most(1.0 - 1.0 / taps + 1e-6));
            let enough = darkest(&mut gpu, "naive_pcf", width, slope, 1.02 * needed);
            table.row(what("1.02 b"), "T8: none fails", enough, Bound::Least(1.0 - 1e-6));
            let plane = darkest(&mut gpu, "pcf_shadow", width, slope, 0.0);
            table.row(what("pcf_shadow, 0"), "T8 with the plane: none fails", plane, Bound::Least(1.0 - 1e-6));
        }
    }
    table.check(&gpu);
}

/// A thin wall on the ground in light at 45 degrees, and the ground behind it: how far from the wall the shadow begins,
/// along the light, in metres. `size` texels lie across the 3 m of the map.
pub(super) fn detachment(gpu: &mut Gpu, kind: &str, size: u32, bias: f64) -> f64 {
    let wall = DMat4::from_translation(DVec3::Y * 0.5) * DMat4::from_rotation_z(std::f64::consts::FRAC_PI_2);
    let items = vec![Item::plane([8.0, 8.0], DMat4::IDENTITY), Item::plane([1.0, 8.0], wall)];
    // From behind, so that the wall does not hide what lies at its foot.
    let view = View {
        position: DVec3::new(0.5, 0.6, 0.0),
        target: DVec3::new(0.12, 0.0, 0.0),
        up: DVec3::NEG_X,
        half_height: 0.24,
        size: (4, 512),
    };
    let mut stage = Stage::new(items, view);
    let lamp = "\"direction\": (1, -1, 0), \"radius\": 1.5";
    let shader = visibility(&light("directional_light", lamp, kind, "", &format!("\"size\": \"{size}\"")));
    let values = look_with(&mut stage, gpu, &shader, "bias", bias);
    let lit = stage.on_ground(&values).filter(|(p, v)| p.x > 0.0 && *v > 0.5).map(|(p, _)| p.x);
    lit.fold(0.0, f64::max) * std::f64::consts::SQRT_2
}

#[test]
fn biases_detach_shadows_by_their_length_in_world_units() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "peter_panning",
        "A wall on the ground in parallel light at 45 degrees: distance along the light, in metres, from the wall to where\nits shadow begins. A bias is a length in the world: the map's size, range and kernel do not change what it does.",
        (0.0, ""),
        (2e-3, 0.0),
    );
    for (kind, size) in [("hard_shadow", 512), ("hard_shadow", 2048), ("pcf_shadow", 512), ("pcf_shadow", 2048)] {
        for bias in [0.0, 0.02, 0.05, 0.1, 0.2] {
            let texel = 3.0 / f64::from(size);
            // Half a texel, seen at 45 degrees: a texel; and what the nodes keep against facets, an eighth of half a kernel.
            let kernel = if kind == "hard_shadow" { 0.5 } else { 3.0 };
            let within = texel * (1.0 + kernel * 0.25) * 2.0 + 0.002;
            let measured = detachment(&mut gpu, kind, size, bias);
            table.row(format!("{kind} {size}, bias {bias}"), "T8: detached by b", measured, Bound::Near(bias, within));
        }
    }
    table.check(&gpu);
}

/// The darkest pixel of a lit slope by an unblurred variance map that is fetched once, bilinearly.
pub(super) fn unbiased_variance(gpu: &mut Gpu, (x, z): (f64, f64)) -> f64 {
    let (sun, at) = Lamp::Sun.kind();
    let options =
        "\"size\": \"256\", \"width\": \"3\", \"mips\": \"off\", \"filter\": \"linear\", \"anisotropy\": \"1\"";
    least(&slope(x, z).look(gpu, &naive(&light(sun, at, "variance_shadow", "", options))))
}
