//! Claims about what is stored: C12, C13 and C17 to C19.

use glam::{DMat4, DVec3};
use shadetree::reference::worst_bleeding;
use shadetree::render::Gpu;

use super::{Claim, shows};
use crate::laws::lamp::{Lamp, PLAIN, Plate, under};
use crate::stability::bench::most;
use crate::stability::table::Bound;
use crate::stability::{bias, formats, moments4};
use crate::stage::{Item, Stage, View, light, visibility};

pub(super) fn claims(gpu: &mut Gpu) -> Vec<Claim> {
    let lit = ["rg16float", "split", "rg32float"].map(|format| formats::darkest_lit(gpu, format, 1e-6));
    let sums = moments4::summed(gpu, "float32", 1024);
    vec![
        Claim {
            id: 12,
            source: "VSM",
            says: "16-bit floats sometimes show artefacts, 32-bit floats never",
            holds: vec![
                shows("darkest lit plane, 16 bits, minimum variance 1e-6", lit[0], Bound::Most(0.99)),
                shows("the same in 32 bits", lit[2], Bound::Least(254.0 / 255.0)),
            ],
            limits: vec![shows(
                "darkest lit pixel, table of sums of 1024 texels in 32-bit floats",
                sums,
                Bound::Most(0.9),
            )],
        },
        Claim {
            id: 13,
            source: "VSM",
            says: "Splitting a value over two 16-bit floats cures their artefacts",
            holds: vec![shows(
                "darkest lit plane, moments split over two halves, minimum variance 1e-6",
                lit[1],
                Bound::Least(254.0 / 255.0),
            )],
            limits: vec![],
        },
        acne(gpu),
        metrics(gpu),
        wasted(gpu),
    ]
}

fn acne(gpu: &mut Gpu) -> Claim {
    let slope = (1.0, 0.5);
    let bare = bias::darkest(gpu, "naive_pcf", 3, slope, 0.0);
    let needed = bias::needed(3, slope);
    let enough = bias::darkest(gpu, "naive_pcf", 3, slope, 1.02 * needed);
    let plane = bias::darkest(gpu, "pcf_shadow", 3, slope, 0.0);
    let variance = bias::unbiased_variance(gpu, slope);
    Claim {
        id: 17,
        source: "VSM, note, Unity",
        says: "Variance maps lessen acne; percentage-closer filtering needs a bias",
        holds: vec![
            shows("darkest pixel of a lit slope, variance, no bias", variance, Bound::Least(0.99)),
            shows("the same, PCF of 3 texels with one depth for all taps, no bias", bare, Bound::Most(0.5)),
            shows("with the bias of T8", enough, Bound::Least(1.0)),
        ],
        limits: vec![shows("PCF that compares with the receiving plane, no bias", plane, Bound::Least(1.0))],
    }
}

/// Most light in full shadow under two plates in a spotlight, with depth measured so, and the law's value.
fn bleeding(gpu: &mut Gpu, metric: &str) -> (f64, f64) {
    let options = format!(
        "\"width\": \"11\", \"weights\": \"box\", \"metric\": \"{metric}\", \"slope_variance\": \"off\", {PLAIN}"
    );
    let shader = Lamp::Spot.shadow("variance_shadow", "\"bleeding_reduction\": 0", &options);
    let plates = [Plate { height: 1.0, edge: 3.0, angle: 0.0 }, Plate { height: 0.5, edge: 43.0, angle: 0.0 }];
    let values = under(Lamp::Spot, &plates, 16.0, (480, 2)).look(gpu, &shader);
    // Near 1 m, far 5 m, at 4 m above the ground.
    let depth = |height: f64| {
        let z = 4.0 - height;
        if metric == "zw" { 5.0 / 4.0 * (1.0 - 1.0 / z) } else { (z - 1.0) / 4.0 }
    };
    (most(&values), worst_bleeding((depth(0.5) - depth(1.0)) / (depth(0.0) - depth(0.5))))
}

fn metrics(gpu: &mut Gpu) -> Claim {
    let (linear, law) = bleeding(gpu, "linear");
    let (hyperbolic, warped) = bleeding(gpu, "zw");
    Claim {
        id: 18,
        source: "Unity",
        says: "z/w differs from linear depth, which bleeds a little less",
        holds: vec![
            shows("light in full shadow over that of T3, linear", linear / law, Bound::Near(1.0, 0.01)),
            shows("light in full shadow over that of T3, z/w", hyperbolic / warped, Bound::Near(1.0, 0.01)),
            shows("light with z/w over that with linear depth", hyperbolic / linear, Bound::Least(1.05)),
        ],
        limits: vec![],
    }
}

/// The largest error of stored depth, in metres, where the scene fills the upper part of the range: all of it, or half.
fn stored(gpu: &mut Gpu, fills: f64) -> f64 {
    let options = format!("\"width\": \"1\", \"slope_variance\": \"off\", \"format\": \"rg16unorm\", {PLAIN}");
    let shader = visibility(&light(
        "directional_light",
        "\"direction\": (0, -1, 0), \"radius\": 1",
        "variance_shadow",
        "",
        &format!("\"size\": \"256\", {options}"),
    ));
    let ramp = Item::plane([4.0, 4.0], DMat4::from_rotation_z(0.5));
    // Over the corner of the map, at the height that makes the scene fill that part.
    let half = 0.5_f64.tan();
    let speck = DMat4::from_translation(DVec3::new(0.99, 2.0 * half / fills - half, 0.99));
    let stage = Stage::new(vec![ramp, Item::plane([0.01, 0.01], speck)], View::down((0.0, 0.0), 1.0, 0.5, (4, 4)));
    let map = gpu.map(&stage.job(&shader), "light/lamp", 0).expect("renders");
    let space = map.spaces[0];
    let range = f64::from(space.depth.y - space.depth.x);
    let mut worst = 0.0_f64;
    for (i, texel) in map.pixels.iter().enumerate().filter(|(i, _)| i % 256 < 240) {
        // The ramp's height above the middle of the texel's column.
        let x = ((i % 256) as f64 + 0.5) / 128.0 - 1.0;
        let point = glam::Vec3::new(x as f32, (x * half) as f32, 0.0);
        let z = f64::from(space.world_to_light.transform_point3(point).z - space.depth.x);
        worst = worst.max((f64::from(texel[0]) * range - z).abs());
    }
    worst
}

fn wasted(gpu: &mut Gpu) -> Claim {
    let (whole, half) = (stored(gpu, 1.0), stored(gpu, 0.5));
    Claim {
        id: 19,
        source: "Unity",
        says: "Depth that fills half of its range wastes half of the resolution",
        holds: vec![shows(
            "largest error of stored depth in metres, half of the range used over all of it",
            half / whole,
            Bound::Near(2.0, 0.2),
        )],
        limits: vec![],
    }
}
