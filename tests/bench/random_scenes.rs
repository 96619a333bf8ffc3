//! Scenes drawn at random for choosing shadows: a number gives the same scene everywhere. Objects stand apart, in contact,
//! in layers of plates, and as thin bars, under every kind of light; in some nothing casts.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// A scene as texts in place of files, by paths that do not exist.
pub(crate) struct Drawn {
    /// The scene among the texts.
    pub(crate) scene: PathBuf,
    /// All texts.
    pub(crate) texts: BTreeMap<PathBuf, Arc<str>>,
    /// What it is, in words.
    pub(crate) what: String,
    /// Whether anything casts.
    pub(crate) casts: bool,
}

/// Numbers drawn one after the other (splitmix64).
struct Draw(u64);

impl Draw {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// Between two numbers, with three digits.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        let part = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        ((low + (high - low) * part) * 1000.0).round() / 1000.0
    }

    fn below(&mut self, count: u64) -> u64 {
        self.bits() % count
    }
}

const SPOT: &str = "Graph(version: 1, nodes: {\"lamp\": (kind: \"spot_light\")})";
const POINT: &str = "Graph(version: 1, nodes: {\"lamp\": (kind: \"point_light\")})";
const SUN: &str = "Graph(version: 1, nodes: {\"lamp\": (kind: \"directional_light\")})";
const PANEL: &str = "Graph(version: 1, nodes: {\"lamp\": (kind: \"rectangle_light\")})";
const MATTE: &str = "Graph(version: 1, nodes: {\"matte\": (kind: \"lambert\")})";

/// The scene of a number, of a series.
pub(crate) fn drawn(seed: u64, number: u64) -> Drawn {
    let mut draw = Draw(seed.wrapping_mul(1_000_003).wrapping_add(number.wrapping_mul(7919)));
    let casts = number % 20 != 19;
    let style = ["apart", "contact", "layers", "thin", "mixed"][draw.below(5) as usize];
    let count = 1 + draw.below(8);
    let mut objects =
        String::from("\"ground\": (shape: Plane(size: (14, 14)), surface: \"matte.ron\", casts: false),\n");
    if casts && draw.below(2) == 0 {
        objects = objects.replace(", casts: false", "");
    }
    for i in 0..count {
        let (x, z) = (draw.between(-1.6, 1.6), draw.between(-1.6, 1.2));
        let (size, height) = (draw.between(0.15, 0.55), draw.between(0.0, 1.2));
        let own = if style == "mixed" { ["apart", "contact", "layers", "thin"][draw.below(4) as usize] } else { style };
        let turn = draw.between(0.0, 90.0);
        let (shape, y, rotate) = match (own, draw.below(3)) {
            ("layers", _) => {
                let shape = format!("Plane(size: ({}, {}))", 2.0 * size, draw.between(0.3, 1.4));
                (shape, 0.15 + height, format!("({}, {turn}, 0)", draw.between(-15.0, 15.0)))
            }
            ("thin", _) => {
                let shape = format!("Box(size: ({}, {}, {}))", draw.between(0.02, 0.06), 0.6 + height, 0.04);
                (shape, 0.3 + height / 2.0, format!("({}, {turn}, {})", draw.between(-60.0, 60.0), turn / 3.0))
            }
            (own, 0) => (
                format!("Sphere(radius: {size})"),
                if own == "contact" { size } else { size + height },
                "(0, 0, 0)".into(),
            ),
            (own, 1) => {
                let shape = format!("Box(size: ({size}, {}, {size}), bevel: 0.02)", 2.0 * size);
                (shape, if own == "contact" { size } else { size + height }, format!("(0, {turn}, 0)"))
            }
            (own, _) => {
                let shape = format!("Torus(major: {size}, minor: {})", size * 0.3);
                (
                    shape,
                    if own == "contact" { size * 0.3 } else { size * 1.3 + height },
                    format!("({}, {turn}, 0)", if own == "contact" { 0.0 } else { 60.0 }),
                )
            }
        };
        let flag = if casts { "" } else { ", casts: false" };
        objects += &format!(
            "\"thing {i}\": (shape: {shape}, surface: \"matte.ron\", translate: ({x}, {y:.3}, {z}), rotate: {rotate}{flag}),\n"
        );
    }
    let kind = draw.below(4);
    let (px, py, pz) = (draw.between(-3.0, 3.0), draw.between(3.2, 5.0), draw.between(-1.0, 3.5));
    let towards = format!("({}, {}, {})", -px, -py, -pz);
    let (name, file, set) = match kind {
        0 => {
            let radius = [0.0, 0.03, 0.1, 0.25][draw.below(4) as usize];
            let set = format!(
                "\"lamp.position\": ({px}, {py}, {pz}), \"lamp.direction\": {towards}, \"lamp.radius\": {radius}, \"lamp.near\": 0.8, \"lamp.range\": 12, \"lamp.outer_angle\": 36"
            );
            ("spotlight", SPOT, set)
        }
        1 => {
            let radius = [0.0, 0.05, 0.15][draw.below(3) as usize];
            let set = format!(
                "\"lamp.position\": ({px}, {py}, {pz}), \"lamp.radius\": {radius}, \"lamp.near\": 0.3, \"lamp.range\": 14"
            );
            ("point light", POINT, set)
        }
        2 => {
            let angle = [0.0, 0.2665, 1.5][draw.below(3) as usize];
            ("sun", SUN, format!("\"lamp.direction\": {towards}, \"lamp.angle\": {angle}"))
        }
        _ => {
            let (width, height) = (draw.between(0.1, 0.8), draw.between(0.1, 0.6));
            let set = format!(
                "\"lamp.position\": ({px}, {py}, {pz}), \"lamp.direction\": {towards}, \"lamp.width\": {width}, \"lamp.height\": {height}, \"lamp.near\": 0.8, \"lamp.range\": 12, \"lamp.inner_angle\": 36, \"lamp.outer_angle\": 44"
            );
            ("panel", PANEL, set)
        }
    };
    let (cx, cy, cz) = (draw.between(-2.5, 2.5), draw.between(1.2, 3.2), draw.between(3.6, 5.2));
    let scene = format!(
        "Scene(version: 1, name: \"Drawn {number}\", camera: (position: ({cx}, {cy}, {cz}), target: (0, 0.4, -0.2), fov: 42),\n\
         lights: {{\"light\": (graph: \"light.ron\", set: {{{set}}})}},\nobjects: {{\n{objects}}})\n"
    );
    let folder = std::path::absolute("drawn at random").unwrap_or_default();
    let texts = [("scene.ron", scene.as_str()), ("light.ron", file), ("matte.ron", MATTE)];
    let count = count as usize;
    Drawn {
        scene: folder.join("scene.ron"),
        texts: texts.map(|(n, t)| (folder.join(n), Arc::from(t))).into(),
        what: format!("{name}, {count} {style}{}", if casts { "" } else { ", nothing casts" }),
        casts,
    }
}
