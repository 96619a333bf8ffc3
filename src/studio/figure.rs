//! Graphs, their text and their picture as one drawing, as SVG or PNG.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use image::ImageEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use resvg::{tiny_skia, usvg};

use super::failure::Failure;
use super::load::{Document, stems};
use super::picture::{Aov, Exposure, draw};
use super::settings;
use super::stock::Stock;
use super::weave::Weaver;
use super::{Resolved, Shot, Shown, Subject};
use crate::compile::{NamedGraph, Options, Output};
use crate::render::image_file::{Display, ToneCurve, encode_png};
use crate::render::{ColorFormat, Gpu, RenderError};
use crate::scene::Camera;
use crate::view::figure::{Across, Figure, Part};
use crate::view::node_view;

/// Pixels along a point of the drawing.
const PIXELS: f32 = 2.0;
/// Most pixels along a side.
const MOST: f32 = 16_384.0;

/// The form of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Lines and letters, with the picture in it.
    Svg,
    /// Pixels, two along a point.
    Png,
}

impl Form {
    /// The form that a file's name asks for.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_string_lossy().to_ascii_lowercase();
        match extension.as_str() {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            _ => None,
        }
    }
}

/// What a figure is made of.
#[derive(Clone, Debug)]
pub struct Request {
    /// Graph files that are woven together.
    pub files: Vec<PathBuf>,
    /// The scene that they are shown in.
    pub scene: Option<PathBuf>,
    /// Without a scene, the shape that they are shown on.
    pub shape: Shown,
    /// From where; none for the scene's own camera.
    pub camera: Option<Camera>,
    /// Columns and rows of the picture.
    pub size: (u32, u32),
    /// Form of the drawing.
    pub form: Form,
}

/// Makes a figure. The same files on the same adapter give the same bytes. The adapter is opened once the graphs are known to
/// be good.
pub fn make(
    request: &Request,
    weaver: &Weaver<'_>,
    open: impl FnOnce() -> Result<Gpu, RenderError>,
) -> Result<Vec<u8>, Failure> {
    let weaver = &Weaver { options: Options::default(), images: true, wiring: true, ..*weaver };
    let parts = parts(request, weaver)?;
    let subject = Subject { files: &request.files, scene: request.scene.as_deref(), shape: &request.shape };
    let shot = Shot::new(&subject, weaver)?;
    // What is on the stage besides comes later.
    let shader = shot.shaders.first().ok_or_else(Failure::told)?;
    let mut stock = Stock::default();
    let assets = stock.assets(&shot, weaver.loader)?;
    let exposure = Exposure {
        aov: Aov::Output(Output::Radiance),
        camera: request.camera,
        size: request.size,
        samples: 4,
        time: 0.0,
        format: ColorFormat::Half,
    };
    let frame = draw(&shot, &assets, &stock, weaver.loader, &exposure, &mut open()?)?;
    let display = Display { tone: ToneCurve::Filmic, ..Display::default() };
    let picture = encode_png(frame.size, &frame.pixels, &display, &[]).map_err(|e| cannot(&e))?;
    let across = across(&shader.wiring, &request.files);
    let title = parts.iter().map(|p| p.title.as_str()).collect::<Vec<_>>().join(" + ");
    let caption = match parts.as_slice() {
        [only] => only.graph.note.clone(),
        _ => String::new(),
    };
    let svg = Figure {
        title: &title,
        parts: &parts,
        across: &across,
        compiled: &shader.compiled,
        picture: Some((&picture, frame.size)),
        caption: &caption,
    }
    .svg();
    match request.form {
        Form::Svg => Ok(svg.into_bytes()),
        Form::Png => rasterized(&svg),
    }
}

/// The graphs as their files say, subgraphs as one node each, with overrides.
fn parts(request: &Request, weaver: &Weaver<'_>) -> Result<Vec<Part>, Failure> {
    let mut graphs = Vec::new();
    for (path, name) in request.files.iter().zip(stems(&request.files)) {
        match weaver.loader.document(path)? {
            Some(Document::Graph(graph)) => graphs.push(NamedGraph { name, graph: *graph, set: BTreeMap::new() }),
            Some(Document::Scene(_)) => {
                let help = "give graphs, and the scene that they are shown in with --scene";
                return Err(Failure::usage(format!("{} is a scene, and a figure is of graphs", path.display()), help));
            }
            // Told when it is woven, with all else that is wrong.
            None => {}
        }
    }
    // Reading is done once more for the shader, which tells what is found.
    weaver.loader.take_found();
    for assignment in weaver.set {
        // What lies in subgraphs is not drawn; what lies nowhere is told when it is woven.
        let _ = settings::apply(std::slice::from_ref(assignment), &mut graphs, weaver.catalog);
    }
    let part = |mut named: NamedGraph| {
        for (path, value) in named.set {
            if let Some((node, port)) = path.rsplit_once('.')
                && let Some(node) = named.graph.nodes.get_mut(node)
            {
                node.params.insert(port.to_owned(), value);
            }
        }
        let graph = named.graph;
        let cards = graph.nodes.keys().map(|n| (n.clone(), node_view(&graph, weaver.catalog, n, None))).collect();
        let title = if graph.name.is_empty() { named.name.clone() } else { graph.name.clone() };
        Part { name: named.name, title, graph, cards }
    };
    Ok(graphs.into_iter().map(part).collect())
}

/// The wires that lead from one of the files to another.
fn across(wiring: &[Resolved], files: &[PathBuf]) -> Vec<Across> {
    let place = |name: &str| files.iter().position(|f| f.display().to_string() == name);
    // A node within a subgraph is drawn as that.
    let drawn = |node: &str| node.split('/').next().unwrap_or(node).to_owned();
    let mut all: BTreeMap<_, BTreeSet<String>> = BTreeMap::new();
    for wire in wiring {
        if let (Some(from), Some(to)) = (place(&wire.from_graph), place(&wire.graph))
            && from != to
        {
            let ends = ((from, drawn(&wire.from.0)), (to, drawn(&wire.to.0)));
            all.entry(ends).or_default().insert(wire.to.1.clone());
        }
    }
    all.into_iter().map(|((from, to), ports)| Across { from, to, ports: ports.into_iter().collect() }).collect()
}

fn cannot(error: &dyn std::fmt::Display) -> Failure {
    RenderError::Job(format!("the figure cannot be drawn: {error}")).into()
}

/// The fonts of drawings, which come with the program.
pub(crate) fn fonts() -> usvg::Options<'static> {
    let mut options = usvg::Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.load_font_data(epaint_default_fonts::HACK_REGULAR.to_vec());
    fonts.set_sans_serif_family("Ubuntu");
    fonts.set_monospace_family("Hack");
    options.font_family = "Ubuntu".into();
    options
}

/// A drawing as a PNG file with two pixels a point, or fewer where it would be too large.
pub(crate) fn rasterized(svg: &str) -> Result<Vec<u8>, Failure> {
    let tree = usvg::Tree::from_str(svg, &fonts()).map_err(|e| cannot(&e))?;
    let (width, height) = (tree.size().width(), tree.size().height());
    let scale = PIXELS.min(MOST / width.max(height));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "sizes are positive and bounded")]
    let (columns, rows) = ((width * scale).ceil() as u32, (height * scale).ceil() as u32);
    let mut pixels = tiny_skia::Pixmap::new(columns, rows).ok_or_else(|| cannot(&"it is too large"))?;
    pixels.fill(tiny_skia::Color::WHITE);
    resvg::render(&tree, tiny_skia::Transform::from_scale(scale, scale), &mut pixels.as_mut());
    // Nothing shines through white.
    let bytes: Vec<u8> = pixels.data().chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, CompressionType::Best, FilterType::Adaptive)
        .write_image(&bytes, columns, rows, image::ExtendedColorType::Rgb8)
        .map_err(|e| cannot(&e))?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::node::Catalog;
    use crate::studio::weave::Known;
    use crate::studio::{Collected, Loader};

    /// The drawing of example graphs, without a picture.
    fn drawing(files: &[&str]) -> String {
        let request = Request {
            files: files.iter().map(|f| PathBuf::from(format!("{}/graphs/{f}", env!("CARGO_MANIFEST_DIR")))).collect(),
            scene: None,
            shape: Shown::Sphere,
            camera: None,
            size: (8, 8),
            form: Form::Svg,
        };
        let (listener, loader, catalog, known) =
            (Collected::default(), Loader::default(), Catalog::embedded(), Known::default());
        let weaver = Weaver { wiring: true, ..Weaver::new(&listener, &loader, &catalog, &known) };
        let parts = parts(&request, &weaver).expect("read");
        let subject = Subject { files: &request.files, scene: None, shape: &request.shape };
        let shot = Shot::new(&subject, &weaver).expect("woven");
        let across = across(&shot.shaders[0].wiring, &request.files);
        assert_eq!(across.is_empty(), files.len() < 2, "{across:?}");
        let compiled = &shot.shaders[0].compiled;
        Figure { title: "<&>", parts: &parts, across: &across, compiled, picture: None, caption: "" }.svg()
    }

    #[test]
    fn drawings_are_well_formed_and_come_out_the_same() {
        let sets: [&[&str]; 4] = [
            &["surfaces/bumpy_glass.ron"],
            &["surfaces/rust.ron"],
            &["surfaces/marble.ron"],
            &["lights/spot_vsm.ron", "surfaces/bumpy_glass.ron"],
        ];
        for files in sets {
            let svg = drawing(files);
            let tree = usvg::Tree::from_str(&svg, &fonts()).unwrap_or_else(|e| panic!("{files:?}: {e}"));
            // Nothing lies outside.
            let (size, all) = (tree.size(), tree.root().abs_stroke_bounding_box());
            assert!(all.left() >= -1.0 && all.top() >= -1.0, "{files:?}: {all:?}");
            assert!(all.right() <= size.width() + 1.0 && all.bottom() <= size.height() + 1.0, "{files:?}: {all:?}");
            assert_eq!(svg, drawing(files), "{files:?}");
        }
    }

    #[test]
    fn every_node_is_drawn_and_has_lines_of_its_colour() {
        let svg = drawing(&["lights/spot_vsm.ron", "surfaces/bumpy_glass.ron"]);
        for node in ["spot", "shadow", "noise", "bump", "glass"] {
            // Once on its card and at least once beside its lines.
            assert!(svg.matches(&format!(">{node}</text>")).count() >= 2, "{node}");
        }
        assert!(svg.contains(">irradiance</text>") && svg.contains("Spot light, variance shadow</text>"));
        assert!(drawing(&["surfaces/rust.ron"]).matches(">mask</text>").count() >= 2, "a subgraph");
    }

    #[test]
    fn the_form_is_told_by_the_name() {
        let of = |name: &str| Form::of(Path::new(name));
        assert_eq!((of("a.svg"), of("b.PNG"), of("c.exr"), of("d")), (Some(Form::Svg), Some(Form::Png), None, None));
    }
}
