//! Two lights straight above a ground, and plates that hover over it.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::reference::{Layer, Layers};
use shadetree::render::Gpu;

use crate::stage::{Item, Stage, View, light, visibility};

/// Texels of the maps, on a side.
pub(crate) const SIDE: f64 = 256.0;
/// One 8-bit step.
pub(crate) const STEP: f64 = 1.0 / 255.0;
/// What float32 may differ from float64 by: positions are known to some 1e-7 of the scene, which is 1e-4 texel.
pub(crate) const CLOSED_FORM: f64 = 5e-4;

/// What a filtering sampler may differ from float64 by: devices may round its weights to 1/256; Vulkan's lavapipe does not.
pub(crate) fn sampled(gpu: &Gpu) -> f64 {
    if gpu.adapter().software && gpu.adapter().backend == "vulkan" { CLOSED_FORM } else { STEP }
}

/// A light straight above the ground with its map of 256 texels, and how the ground lies on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lamp {
    /// Parallel; the map covers 2 m.
    Sun,
    /// From 4 m above, opening 2 m wide at each metre; near 1, range 5.
    Spot,
}

impl Lamp {
    pub(crate) const BOTH: [Self; 2] = [Self::Sun, Self::Spot];

    pub(crate) fn kind(self) -> (&'static str, &'static str) {
        match self {
            Self::Sun => ("directional_light", "\"direction\": (0, -1, 0), \"radius\": 1"),
            Self::Spot => (
                "spot_light",
                "\"position\": (0, 4, 0), \"direction\": (0, -1, 0), \"outer_angle\": 45, \"inner_angle\": 44, \"near\": 1, \"range\": 5",
            ),
        }
    }

    /// Metres per texel at a height above the ground.
    pub(crate) fn texel(self, height: f64) -> f64 {
        match self {
            Self::Sun => 2.0 / SIDE,
            Self::Spot => 2.0 * (4.0 - height) / SIDE,
        }
    }

    /// Depth at a height, where the highest object is at 1.
    pub(crate) fn depth(self, height: f64) -> f64 {
        match self {
            // The range is fitted with a margin of a thousandth of the radius.
            Self::Sun => (1.0 + 0.001 - height) / 1.002,
            Self::Spot => (4.0 - height - 1.0) / 4.0,
        }
    }

    /// The texel position of a point of the ground.
    pub(crate) fn at(self, point: DVec3) -> (f64, f64) {
        (SIDE / 2.0 + point.x / self.texel(0.0), SIDE / 2.0 - point.z / self.texel(0.0))
    }

    pub(crate) fn shadow(self, kind: &str, params: &str, options: &str) -> Compiled {
        let (lamp, at) = self.kind();
        visibility(&light(lamp, at, kind, params, &format!("\"size\": \"256\", {options}")))
    }
}

pub(crate) fn pcf(lamp: Lamp, weights: &str, width: usize, taps: &str) -> Compiled {
    let options = format!("\"width\": \"{width}\", \"weights\": \"{weights}\", \"taps\": \"{taps}\"");
    lamp.shadow("pcf_shadow", "", &options)
}

pub(crate) fn vsm(lamp: Lamp, weights: &str, width: usize, rest: &str) -> Compiled {
    let options = format!("\"width\": \"{width}\", \"weights\": \"{weights}\", {rest}");
    lamp.shadow("variance_shadow", "\"bleeding_reduction\": 0, \"minimum_variance\": 0.000001", &options)
}

pub(crate) const PLAIN: &str = "\"mips\": \"off\", \"filter\": \"linear\", \"anisotropy\": \"1\"";

/// A plate at a height whose right edge lies `edge` texels right of the middle of the map and runs at `angle` to its
/// columns, turned about the light's axis; it reaches far to the left.
pub(crate) struct Plate {
    pub(crate) height: f64,
    pub(crate) edge: f64,
    pub(crate) angle: f64,
}

impl Plate {
    fn item(&self, lamp: Lamp) -> Item {
        let beside = DVec3::new(self.edge * lamp.texel(self.height) - 4.0, self.height, 0.0);
        Item::plane([8.0, 16.0], DMat4::from_rotation_y(self.angle) * DMat4::from_translation(beside))
    }

    fn layer(&self, lamp: Lamp) -> Layer {
        // Rotation about +y carries +x towards -z, and row numbers grow towards -z.
        let (across, down) = (self.angle.cos(), self.angle.sin());
        Layer { depth: lamp.depth(self.height), sides: vec![[across, down, self.edge + (across + down) * SIDE / 2.0]] }
    }
}

/// Plates over the ground, seen from below them: a strip of `texels` texels around the edge of the first.
pub(crate) fn under(lamp: Lamp, plates: &[Plate], texels: f64, size: (u32, u32)) -> Stage {
    let lowest = plates.iter().map(|p| p.height).fold(1.0, f64::min);
    let (sine, cosine) = plates[0].angle.sin_cos();
    let middle = plates[0].edge * lamp.texel(0.0);
    let view = View::down((middle * cosine, -middle * sine), 0.75 * lowest, texels * lamp.texel(0.0), size);
    let mut items = vec![Item::plane([16.0, 16.0], DMat4::IDENTITY)];
    items.extend(plates.iter().map(|p| p.item(lamp)));
    Stage::new(items, view)
}

/// The same in float64.
pub(crate) fn layers(lamp: Lamp, plates: &[Plate]) -> Layers {
    Layers { receiver: lamp.depth(0.0), layers: plates.iter().map(|p| p.layer(lamp)).collect() }
}
