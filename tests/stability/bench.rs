//! What the scenes share: woven lights with shadows, also with nodes that do things the naive way.

use std::sync::OnceLock;

use shadetree::compile::{Compiled, Options, Output, compile};
use shadetree::diagnostic::SourceText;
use shadetree::node::Catalog;
use shadetree::render::Gpu;

use crate::stage::{Stage, renders};
use crate::support::{catalog, graph_file, graph_text, prove, show};

/// Shadows from maps of depth or its moments.
pub(super) const SHADOWS: [&str; 3] = ["hard_shadow", "pcf_shadow", "variance_shadow"];

/// Shadows from maps that hold something else than depth, or more: what goes wrong with depth may grow in them.
const DERIVED: [&str; 4] = ["exponential_shadow", "exponential_variance_shadow", "moment_shadow", "summed_area_shadow"];

/// All of them that the adapter has formats for: maps that hold more than depth want floats of 32 bits.
pub(super) fn shadows(gpu: &Gpu) -> Vec<&'static str> {
    let derived = DERIVED.into_iter().filter(|_| single_precision(gpu));
    SHADOWS.into_iter().chain(derived).collect()
}

/// Whether the adapter makes maps of single precision.
pub(super) fn single_precision(gpu: &Gpu) -> bool {
    ["r32float", "rg32float", "rgba32float"].iter().all(|format| renders(gpu, format))
}

/// Shadow nodes that do what textbooks warn of: they show the failures that the nodes of the catalogue avoid.
const NAIVE: [(&str, &str); 3] = [
    ("naive_pcf", include_str!("nodes/naive_pcf.wgsl")),
    ("split_index", include_str!("nodes/split_index.wgsl")),
    ("implicit_variance", include_str!("nodes/implicit_variance.wgsl")),
];

fn naive_catalog() -> &'static Catalog {
    static CATALOG: OnceLock<Catalog> = OnceLock::new();
    CATALOG.get_or_init(|| {
        let mut catalog = catalog().clone();
        for (name, text) in NAIVE {
            let found = catalog.add_file(&format!("{name}.wgsl"), text);
            assert!(found.is_empty(), "{}", show(&found));
        }
        catalog
    })
}

/// The visibility of a light graph's node `lamp`, whose nodes may be naive.
pub(super) fn naive(graph: &str) -> Compiled {
    let graphs = [
        graph_text("light", &SourceText::new("light.ron".to_owned(), graph)),
        graph_file("graphs/surfaces/lambert.ron".as_ref()),
    ];
    let options = Options { output: Output::Visibility("light".into()), ..Options::default() };
    let (compiled, found) = compile(&graphs, naive_catalog(), &options);
    let compiled = compiled.unwrap_or_else(|| panic!("{}", show(&found)));
    prove(&compiled, graph);
    compiled
}

pub(super) fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

pub(super) fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// The share of values for which something holds.
pub(super) fn share(values: &[f64], holds: impl Fn(f64) -> bool) -> f64 {
    values.iter().filter(|v| holds(**v)).count() as f64 / values.len() as f64
}

/// Numbers that look random and are the same everywhere: the additive recurrence of the golden ratio, hashed.
pub(super) struct Numbers(pub(super) u64);

impl Numbers {
    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^= x >> 31;
        low + (high - low) * ((x >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// Renders with a parameter of the node `shadow` of the light `light` set.
pub(super) fn look_with(stage: &mut Stage, gpu: &mut Gpu, shader: &Compiled, name: &str, value: f64) -> Vec<f64> {
    stage.set(&format!("light/shadow.{name}"), &[value]);
    stage.look(gpu, shader)
}

/// A picture to look at, in the folder that `STABILITY_PICTURES` names; none without it.
pub(super) fn picture(name: &str, values: &[f64], (width, height): (u32, u32)) {
    let Some(folder) = std::env::var_os("STABILITY_PICTURES") else { return };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to a byte")]
    let bytes = values.iter().map(|v| (v.clamp(0.0, 1.0) * 255.0).round() as u8).collect();
    let picture = image::GrayImage::from_raw(width, height, bytes).expect("a value for each pixel");
    let scale = (512 / width.max(height)).max(1);
    let picture =
        image::imageops::resize(&picture, width * scale, height * scale, image::imageops::FilterType::Nearest);
    picture.save(std::path::Path::new(&folder).join(format!("{name}.png"))).expect("a picture");
}
