//! Claims about filtering: C1 to C3, C5 to C8, C14 to C16, C20 and C21.

use glam::{DMat4, DVec3};
use shadetree::render::Gpu;

use super::{Claim, shows};
use crate::laws::lamp::{CLOSED_FORM, Lamp, PLAIN, Plate, pcf, under, vsm};
use crate::laws::splits::{POSTER, on_long_ground};
use crate::stability::bench::{least, look_with, most};
use crate::stability::table::Bound;
use crate::stability::{bleeding, moments4, scales, splits};
use crate::stage::{Item, Stage, View, light, visibility};

pub(super) fn claims(gpu: &mut Gpu) -> Vec<Claim> {
    let mut all = vec![linear(gpu)];
    all.extend(bounds(gpu));
    all.extend(on_the_long_ground(gpu));
    all.push(lower_clamp(gpu));
    all.push(seams(gpu));
    all.push(culling(gpu));
    all.push(Claim {
        id: 21,
        source: "Unity",
        says: "The cure for bleeding fattens shadows",
        holds: vec![shows(
            "most that a reduction of 0.18 darkens an edge where nothing bleeds",
            bleeding::loss(gpu, 0.18),
            Bound::Near(0.18, 0.003),
        )],
        limits: vec![],
    });
    all
}

/// The largest difference between a blurred map and the means of what was not blurred.
fn blurred(gpu: &mut Gpu) -> f64 {
    let stage = under(Lamp::Sun, &[Plate { height: 1.0, edge: 4.3, angle: 0.3 }], 16.0, (4, 4));
    let mut map = |width: usize| {
        let shader =
            vsm(Lamp::Sun, "box", width, &format!("{PLAIN}, \"slope_variance\": \"off\", \"format\": \"rg32float\""));
        gpu.map(&stage.job(&shader), "light/lamp", 0).expect("renders").pixels
    };
    let (sharp, blurred) = (map(1), map(5));
    let (mut worst, side) = (0.0_f64, 256);
    for (x, y) in (100..156).flat_map(|y| (100..156).map(move |x| (x, y))) {
        for moment in 0..2 {
            let of = |i: usize, j: usize| f64::from(sharp[(y + j - 2) * side + x + i - 2][moment]);
            let mean = (0..5).flat_map(|j| (0..5).map(move |i| (i, j))).map(|(i, j)| of(i, j)).sum::<f64>() / 25.0;
            worst = worst.max((mean - f64::from(blurred[y * side + x][moment])).abs());
        }
    }
    worst
}

fn linear(gpu: &mut Gpu) -> Claim {
    Claim {
        id: 1,
        source: "VSM",
        says: "Moments average linearly, so that any linear filter is legal",
        holds: vec![shows(
            "largest difference of blurred moments from means in float64",
            blurred(gpu),
            Bound::Most(1e-6),
        )],
        limits: vec![shows(
            "with the deviation stored instead of the square, largest error between two texels",
            moments4::interpolated(gpu, "deviation").1,
            Bound::Least(0.9),
        )],
    }
}

/// C2, C3, C6, C7 and C8.
fn bounds(gpu: &mut Gpu) -> Vec<Claim> {
    let drawn = bleeding::random_scenes(gpu, 20);
    let plate = [Plate { height: 1.0, edge: 4.0, angle: 0.0 }];
    let stage = under(Lamp::Sun, &plate, 16.0, (160, 2));
    let variance = stage.look(gpu, &vsm(Lamp::Sun, "gaussian", 5, PLAIN));
    let bilinear = stage.look(gpu, &pcf(Lamp::Sun, "gaussian", 5, "bilinear"));
    let nearest = stage.look(gpu, &pcf(Lamp::Sun, "gaussian", 5, "nearest"));
    let off = |a: &[f64], b: &[f64]| most(&a.iter().zip(b).map(|(a, b)| (a - b).abs()).collect::<Vec<_>>());
    let [_, _, exact] = scales::sizes(gpu, 512);
    let spreads = [0.5, 1.0, 2.0, 8.0].map(|r| bleeding::in_full_shadow(gpu, r, &[0.0])[0]);
    let growth = spreads.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
    let mut dark = under(Lamp::Sun, &[Plate { height: 1.0, edge: 60.0, angle: 0.0 }], 4.0, (8, 2));
    (dark.view.position.x, dark.view.target.x) = (0.0, 0.0);
    let shader = vsm(Lamp::Sun, "gaussian", 5, PLAIN);
    let bare = least(&look_with(&mut dark, gpu, &shader, "bleeding_reduction", 0.0));
    let reduced = most(&look_with(&mut dark, gpu, &shader, "bleeding_reduction", 0.18));
    vec![
        Claim {
            id: 2,
            source: "VSM, note",
            says: "p_max >= P(x >= t) for t above the mean",
            holds: vec![shows(
                "most that p_max is below the truth, 20 scenes drawn at random",
                drawn.below,
                Bound::Most(CLOSED_FORM),
            )],
            limits: vec![],
        },
        Claim {
            id: 3,
            source: "VSM",
            says: "For one planar occluder over one planar receiver the bound is the lit share",
            holds: vec![shows("largest difference from the closed form at an edge", exact, Bound::Most(1e-3))],
            limits: vec![],
        },
        Claim {
            id: 6,
            source: "VSM",
            says: "Blurred variance maps look like bilinear PCF of the same size, and better than nearest PCF",
            holds: vec![
                shows(
                    "one plate: largest difference from bilinear PCF",
                    off(&variance, &bilinear),
                    Bound::Most(1.0 / 255.0),
                ),
                shows("one plate: largest stair of nearest PCF", off(&nearest, &bilinear), Bound::Least(0.05)),
            ],
            limits: vec![shows("two plates, r = 2: light where PCF has none", spreads[2], Bound::Least(0.2))],
        },
        Claim {
            id: 7,
            source: "VSM, note",
            says: "Light bleeds only where occluders overlap, the more the farther they are apart",
            holds: vec![
                shows("one plate: largest difference from the closed form", exact, Bound::Most(1e-3)),
                shows("two plates: least growth between spreads of 0.5, 1, 2 and 8", growth, Bound::Least(0.01)),
                shows("two plates, r = 8: light in full shadow", spreads[3], Bound::Near(0.64, 0.001)),
            ],
            limits: vec![],
        },
        Claim {
            id: 8,
            source: "VSM",
            says: "Where the variance is not zero, no receiver is fully dark",
            holds: vec![shows(
                "darkest pixel 1 m below a plate, with the default minimum variance",
                bare,
                Bound::Least(1e-7),
            )],
            limits: vec![shows("the same, with the default bleeding reduction: brightest", reduced, Bound::Most(0.0))],
        },
    ]
}

/// C5 and C15: the poster's scene against the exact share of each pixel.
fn on_the_long_ground(gpu: &mut Gpu) -> Vec<Claim> {
    let mips = |rest: &str| format!("\"size\": \"1024\", \"width\": \"3\", {rest}");
    let (off, isotropic, anisotropic) = (
        mips("\"mips\": \"off\", \"filter\": \"linear\", \"anisotropy\": \"1\""),
        mips("\"anisotropy\": \"1\""),
        mips("\"anisotropy\": \"16\""),
    );
    let four = "\"splits\": \"4\"";
    let mut all = POSTER.to_vec();
    all.extend([
        (four, "variance_shadow", &*off),
        (four, "variance_shadow", &*isotropic),
        (four, "variance_shadow", &*anisotropic),
    ]);
    let errors = on_long_ground(gpu, &all);
    let [plain, variance, split, both, bare, mipped, long] = errors[..] else { unreachable!() };
    vec![
        Claim {
            id: 5,
            source: "VSM, blog",
            says: "Mips cure aliasing where maps are minified, anisotropic filtering at grazing views",
            holds: vec![
                shows(
                    "long ground, rms error with anisotropy 16 over that of one fetch",
                    long / bare,
                    Bound::Most(0.9),
                ),
                shows("with anisotropy 16 over that of mips alone", long / mipped, Bound::Most(0.9)),
            ],
            limits: vec![shows(
                "with mips alone over that of one fetch: mips blur grazing views",
                mipped / bare,
                Bound::Least(1.0),
            )],
        },
        Claim {
            id: 15,
            source: "PSVSM",
            says: "Splits cure magnification, variance maps aliasing, and both together both",
            holds: vec![
                shows("rms error, 4 x 512 filtered, over one plain map of 1024", both / plain, Bound::Most(0.95)),
                shows("over one filtered map of 1024", both / variance, Bound::Most(0.95)),
                shows("over 4 x 512 plain", both / split, Bound::Most(0.95)),
            ],
            limits: vec![],
        },
    ]
}

/// Over what length an edge goes from 0.1 to 0.9, in texels, where a texel is so many pixels.
fn ramp(gpu: &mut Gpu, pixels: f64) -> f64 {
    let shader = vsm(Lamp::Sun, "box", 5, "\"filter\": \"trilinear\", \"anisotropy\": \"1\"");
    // An odd number where there are few, so that one of them is on the edge.
    let columns = if pixels < 1.0 { 33 } else { 256 };
    let stage =
        under(Lamp::Sun, &[Plate { height: 1.0, edge: 0.0, angle: 0.0 }], f64::from(columns) / pixels, (columns, 2));
    let values = stage.look(gpu, &shader);
    let soft = stage.on_ground(&values).filter(|(p, v)| p.z > 0.0 && (0.1..0.9).contains(v)).count();
    soft as f64 / pixels
}

fn lower_clamp(gpu: &mut Gpu) -> Claim {
    let widths = [32.0, 16.0, 8.0].map(|pixels| ramp(gpu, pixels));
    let far = ramp(gpu, 1.0 / 16.0);
    Claim {
        id: 14,
        source: "PSVSM",
        says: "A blur bounds the width of the filter from below",
        holds: vec![
            shows("texels from 0.1 to 0.9 under a blur of 5, at 32 pixels a texel", widths[0], Bound::Near(4.0, 0.25)),
            shows("at 16 pixels a texel", widths[1], Bound::Near(4.0, 0.25)),
            shows("at 8 pixels a texel", widths[2], Bound::Near(4.0, 0.25)),
            shows("at 16 texels a pixel the pixel decides", far, Bound::Near(16.0, 1.0)),
        ],
        limits: vec![],
    }
}

fn seams(gpu: &mut Gpu) -> Claim {
    let [bad, _, two, _] = splits::seams(gpu, "pixel", false);
    let [cured, ..] = splits::seams(gpu, "quad", false);
    let [disagree, ..] = splits::disagreements(gpu);
    Claim {
        id: 16,
        source: "PSVSM",
        says: "Seams come from meaningless differences within quads; one split for a quad removes them",
        holds: vec![
            shows(
                "share of pixels on seams that are off by 1/255, a split for each pixel",
                bad as f64 / two as f64,
                Bound::Least(0.02),
            ),
            shows("pixels on seams that are off, one split for a quad", cured as f64, Bound::Most(0.0)),
        ],
        limits: vec![shows(
            "of the 256 ways for four pixels to lie in four splits, those that stay split",
            disagree as f64,
            Bound::Near(40.0, 0.0),
        )],
    }
}

/// Where the ground behind a wall of 0.3 m begins to be dark, in light at 45 degrees with a bias of 0.1 m; and the
/// darkest pixel under a plate that shows the light its front.
fn culled(gpu: &mut Gpu, cull: &str) -> (f64, f64) {
    let body = |thick: f64| {
        let shape = shadetree::scene::Shape::Box { size: [thick, 1.0, 6.0], bevel: 0.0 };
        Item::new(&shape, DMat4::from_translation(DVec3::new(-thick / 2.0, 0.5, 0.0)))
    };
    let view = View {
        position: DVec3::new(0.9, 0.5, 0.0),
        target: DVec3::new(0.1, 0.0, 0.0),
        up: DVec3::NEG_X,
        half_height: 0.25,
        size: (2, 400),
    };
    let stage = Stage::new(vec![Item::plane([8.0, 8.0], DMat4::IDENTITY), body(0.3)], view);
    let shader = visibility(&light(
        "directional_light",
        "\"direction\": (1, -1, 0), \"radius\": 2",
        "hard_shadow",
        "\"bias\": 0.1",
        &format!("\"cull\": \"{cull}\""),
    ));
    let values = stage.look(gpu, &shader);
    let gap = stage
        .on_ground(&values)
        .filter(|(p, v)| p.x > 0.004 && *v < 0.5)
        .map(|(p, _)| p.x)
        .fold(f64::INFINITY, f64::min);
    let sheet = under(Lamp::Sun, &[Plate { height: 1.0, edge: 60.0, angle: 0.0 }], 4.0, (8, 2));
    let values = sheet.look(gpu, &Lamp::Sun.shadow("hard_shadow", "", &format!("\"cull\": \"{cull}\"")));
    (gap, least(&values))
}

fn culling(gpu: &mut Gpu) -> Claim {
    let (whole, shadowed) = culled(gpu, "none");
    let (shrunk, lit) = culled(gpu, "front");
    Claim {
        id: 20,
        source: "Unity",
        says: "Leaving out front faces shrinks shadows",
        holds: vec![
            shows("metres from a wall of 0.3 m to its shadow, bias 0.1 m, nothing left out", whole, Bound::Most(0.01)),
            shows(
                "the same without front faces: the bias over the square root of two",
                shrunk,
                Bound::Near(0.0707, 0.006),
            ),
            shows("under a sheet that shows its front, nothing left out", shadowed, Bound::Most(0.0)),
            shows("the same without front faces: no shadow", lit, Bound::Least(1.0)),
        ],
        limits: vec![],
    }
}
