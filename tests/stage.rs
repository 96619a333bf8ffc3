//! Small scenes on a real adapter: woven light graphs over real meshes, read back as floats with the world point of
//! every pixel.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use glam::{DMat4, DVec3};
use shadetree::compile::{Compiled, Options, Output};
use shadetree::diagnostic::SourceText;
use shadetree::reference::{Body, World};
use shadetree::render::{AdapterOptions, ColorFormat, Draw, Frame, Gpu, Job, Picture, RenderError, Surroundings};
use shadetree::scene::{Camera, Mesh, Shape};
use shadetree::semantic::Value;

use crate::support::{compiled, graph_file, graph_text};

/// The adapter that `WGPU_BACKEND` allows, opened once per run and used by one test at a time. None, with a note on the
/// terminal, where the machine has no adapter; where `CI` is set, that is a failure.
pub(crate) fn gpu() -> Option<MutexGuard<'static, Gpu>> {
    static SHARED: OnceLock<Option<Mutex<Gpu>>> = OnceLock::new();
    let shared = SHARED.get_or_init(|| open(std::env::var("WGPU_BACKEND").ok()).map(Mutex::new));
    shared.as_ref().map(|gpu| gpu.lock().unwrap_or_else(PoisonError::into_inner))
}

/// An adapter of these backends.
pub(crate) fn open(backends: Option<String>) -> Option<Gpu> {
    match Gpu::new(&AdapterOptions { backends, ..AdapterOptions::default() }) {
        Ok(gpu) => Some(gpu),
        Err(error @ RenderError::NoAdapter { .. }) => {
            assert!(std::env::var_os("CI").is_none(), "{error}: {}", error.help().unwrap_or_default());
            skipped(&error.to_string());
            None
        }
        Err(error) => panic!("{error}"),
    }
}

/// Whether an adapter renders a format.
pub(crate) fn renders(gpu: &Gpu, format: &str) -> bool {
    gpu.adapter().formats.iter().any(|(name, able)| name == format && able.renderable)
}

/// What the picture keeps of a value near 1: single precision, or half where the adapter cannot render more.
pub(crate) fn grain(gpu: &Gpu) -> f64 {
    if renders(gpu, "rgba32float") { 1e-6 } else { 1.0 / 1024.0 }
}

/// Says on the terminal that a test did not run: the captured output of a test that passes is not shown.
pub(crate) fn skipped(why: &str) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr(), "SKIPPED, {why}");
}

/// An object of a stage.
#[derive(Clone)]
pub(crate) struct Item {
    mesh: Mesh,
    place: DMat4,
    pub(crate) casts: bool,
    pub(crate) receives: bool,
}

impl Item {
    pub(crate) fn new(shape: &Shape, place: DMat4) -> Self {
        Self::of(shape.mesh().expect("a primitive"), place)
    }

    pub(crate) fn of(mesh: Mesh, place: DMat4) -> Self {
        Self { mesh, place, casts: true, receives: true }
    }

    /// Mirrors it along its own z axis.
    pub(crate) fn mirror(&mut self) {
        self.place *= DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0));
    }

    /// A horizontal rectangle.
    pub(crate) fn plane(size: [f64; 2], place: DMat4) -> Self {
        Self::new(&Shape::Plane { size, segments: [1, 1] }, place)
    }
}

/// A pinhole camera in float64, looking at a plane.
#[derive(Clone, Copy)]
pub(crate) struct View {
    pub(crate) position: DVec3,
    pub(crate) target: DVec3,
    pub(crate) up: DVec3,
    /// Half of the vertical extent at distance 1.
    pub(crate) half_height: f64,
    pub(crate) size: (u32, u32),
}

impl View {
    /// Straight down on the ground from above (x, z), seeing `width` by `height` metres of it.
    pub(crate) fn down((x, z): (f64, f64), above: f64, width: f64, size: (u32, u32)) -> Self {
        let half_height = width * f64::from(size.1) / f64::from(size.0) / 2.0 / above;
        let target = DVec3::new(x, 0.0, z);
        Self { position: target + DVec3::Y * above, target, up: DVec3::NEG_Z, half_height, size }
    }

    pub(crate) fn camera(&self) -> Camera {
        Camera {
            position: self.position.as_vec3(),
            target: self.target.as_vec3(),
            up: self.up.as_vec3(),
            fov_y: (2.0 * self.half_height.atan()) as f32,
            near: 0.001,
            far: 200.0,
        }
    }

    /// Where the ray through the centre of a pixel meets the plane through `origin` with this normal.
    pub(crate) fn point(&self, pixel: (u32, u32), origin: DVec3, normal: DVec3) -> DVec3 {
        let forward = (self.target - self.position).normalize();
        let right = forward.cross(self.up).normalize();
        let up = right.cross(forward);
        let ndc = |i: u32, n: u32| (f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0;
        let aspect = f64::from(self.size.0) / f64::from(self.size.1);
        let ray = forward + right * (ndc(pixel.0, self.size.0) * self.half_height * aspect)
            - up * (ndc(pixel.1, self.size.1) * self.half_height);
        self.position + ray * (normal.dot(origin - self.position) / normal.dot(ray))
    }
}

/// A light graph and how it is seen.
pub(crate) struct Stage {
    pub(crate) items: Vec<Item>,
    pub(crate) view: View,
    /// Values of parameters by their path.
    pub(crate) values: BTreeMap<String, Value>,
    pub(crate) surroundings: Option<Surroundings>,
}

impl Stage {
    pub(crate) fn new(items: Vec<Item>, view: View) -> Self {
        Self { items, view, values: BTreeMap::new(), surroundings: None }
    }

    pub(crate) fn set(&mut self, path: &str, numbers: &[f64]) {
        self.values.insert(path.to_owned(), Value::Numbers(numbers.to_vec()));
    }

    /// Renders every object with one shader, one float sample per pixel.
    pub(crate) fn frame(&self, gpu: &mut Gpu, shader: &Compiled) -> Frame {
        gpu.render(&self.job(shader)).unwrap_or_else(|e| panic!("{e}"))
    }

    /// The first channel of every pixel.
    pub(crate) fn look(&self, gpu: &mut Gpu, shader: &Compiled) -> Vec<f64> {
        let frame = self.frame(gpu, shader);
        assert!(frame.pixels.iter().all(|p| p[3] == 1.0), "the stage fills the picture");
        frame.pixels.iter().map(|p| f64::from(p[0])).collect()
    }

    pub(crate) fn job<'a>(&'a self, shader: &'a Compiled) -> Job<'a> {
        let draw = |item: &'a Item| Draw {
            mesh: &item.mesh,
            object_to_world: item.place.as_mat4(),
            casts: item.casts,
            receives: item.receives,
            shader,
            values: self.values.clone(),
        };
        Job {
            draws: self.items.iter().map(draw).collect(),
            camera: self.view.camera(),
            surroundings: self.surroundings.as_ref(),
            size: self.view.size,
            samples: 1,
            time: 0.0,
            images: &no_images,
            output: ColorFormat::Float,
        }
    }

    /// The same things in float64.
    pub(crate) fn world(&self) -> World {
        let bodies = self.items.iter().map(|item| Body {
            mesh: &item.mesh,
            object_to_world: item.place.as_mat4(),
            casts: item.casts,
            receives: item.receives,
        });
        World::new(&bodies.collect::<Vec<_>>())
    }

    /// Every pixel with the point of the ground (y = 0) that it sees and its value, from the left, row by row.
    pub(crate) fn on_ground<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = (DVec3, f64)> + 'a {
        self.on_plane(values, DVec3::ZERO, DVec3::Y)
    }

    /// Every pixel with the point of a plane that it sees and its value.
    pub(crate) fn on_plane<'a>(
        &'a self,
        values: &'a [f64],
        origin: DVec3,
        normal: DVec3,
    ) -> impl Iterator<Item = (DVec3, f64)> + 'a {
        let (width, height) = self.view.size;
        let pixels = (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)));
        pixels.zip(values).map(move |(pixel, value)| (self.view.point(pixel, origin, normal), *value))
    }
}

fn no_images(path: &str, _: &str) -> Result<Picture, String> {
    Err(format!("{path} was not expected"))
}

/// A light with one shadow: node `lamp` of `light_kind` and node `shadow` of `shadow_kind`, each with its parameters and
/// options as in a file (`"size": "256"`).
pub(crate) fn light(light_kind: &str, lamp: &str, shadow_kind: &str, params: &str, options: &str) -> String {
    format!(
        "Graph(version: 1, nodes: {{\"lamp\": (kind: \"{light_kind}\", params: {{{lamp}}}), \"shadow\": (kind: \
         \"{shadow_kind}\", params: {{{params}}}, options: {{{options}}})}}, links: [\"lamp -> shadow\"])"
    )
}

/// The visibility of the node `lamp` of a light graph, on matte grey.
pub(crate) fn visibility(graph: &str) -> Compiled {
    woven(&[("light", graph)], Output::Visibility("light".into()))
}

/// Light graphs by name, on matte grey.
pub(crate) fn woven(lights: &[(&str, &str)], output: Output) -> Compiled {
    let mut graphs: Vec<_> =
        lights.iter().map(|(name, text)| graph_text(name, &SourceText::new(format!("{name}.ron"), *text))).collect();
    graphs.push(graph_file("graphs/surfaces/lambert.ron".as_ref()));
    compiled(&graphs, &Options { output, ..Options::default() })
}
