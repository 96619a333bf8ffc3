//! The one facade: graphs and a catalogue in, a module with its plan out.

use std::collections::BTreeMap;

use crate::diagnostic::{Diagnostic, Place, has_errors, limited};
use crate::emit::{emit, larger_than};
use crate::graph::Graph;
use crate::module::Module;
use crate::node::Catalog;
use crate::plan::Plan;
use crate::program::{Bake, build};
use crate::semantic::Value;
use crate::weave::{Woven, weave};

/// What the fragment shader writes.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Output {
    /// Linear radiance, alpha 1.
    #[default]
    Radiance,
    /// World-space shading normal in rgb.
    Normal,
    /// Distance along the view axis in all channels, metres.
    Depth,
    /// Visibility of the light with this name: the product of its shadows.
    Visibility(String),
    /// Irradiance of the light with this name, shadows included, facing the light.
    Irradiance(String),
}

/// How to compile.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// What to write.
    pub output: Output,
    /// Write parameters as constants instead of uniform members.
    pub bake: bool,
    /// Leave out every shadow, with all that it reads: for where nothing casts, or nothing receives. The picture is the
    /// same, bit by bit.
    pub unshadowed: bool,
}

/// A module and what must be rendered before it can run.
#[derive(Clone, Debug, PartialEq)]
pub struct Compiled {
    /// The shader.
    pub module: Module,
    /// Its maps and lights.
    pub plan: Plan,
}

/// A graph with the name that its nodes go by where there are several, and values that override its own.
#[derive(Clone, Debug, Default)]
pub struct NamedGraph {
    /// A file stem, or the name of a light in a scene.
    pub name: String,
    /// The graph, subgraphs expanded.
    pub graph: Graph,
    /// Values by `node.port`, in the unit of files.
    pub set: BTreeMap<String, Value>,
}

/// Most errors, and most warnings, that one compilation tells of.
pub(crate) const MAX_REPORTED: usize = 100;

/// Weaves graphs into one module. The module is there exactly if no diagnostic is an error.
pub fn compile(graphs: &[NamedGraph], catalog: &Catalog, options: &Options) -> (Option<Compiled>, Vec<Diagnostic>) {
    compile_watched(graphs, catalog, options, |_| {})
}

/// As [`compile`]; `watch` sees the resolved wiring, if there is one.
pub fn compile_watched(
    graphs: &[NamedGraph],
    catalog: &Catalog,
    options: &Options,
    watch: impl FnOnce(&Woven),
) -> (Option<Compiled>, Vec<Diagnostic>) {
    let (compiled, found) = compile_unlimited(graphs, catalog, options, watch);
    let message = format!("more than {MAX_REPORTED} mistakes; the rest are not listed");
    (compiled, limited(found, MAX_REPORTED, &Diagnostic::error("ST0066", message, Place::default())))
}

fn compile_unlimited(
    graphs: &[NamedGraph],
    catalog: &Catalog,
    options: &Options,
    watch: impl FnOnce(&Woven),
) -> (Option<Compiled>, Vec<Diagnostic>) {
    let (woven, mut diagnostics) = weave(graphs, catalog, &options.output);
    let Some(woven) = woven else { return (None, diagnostics) };
    watch(&woven);
    let mut program = build(&woven, if options.bake { Bake::All } else { Bake::Nothing }, options.unshadowed);
    // What no device need take as uniforms becomes constants, the nodes' own defaults first.
    for (bake, which) in [(Bake::Defaults, "values that no one changed"), (Bake::All, "all values")] {
        if let Some((count, bytes)) = larger_than(MAX_PARAMETER_BYTES, &program) {
            diagnostics.push(too_many_parameters(count, bytes, which, graphs));
            program = build(&woven, bake, options.unshadowed);
        }
    }
    let (module, plan, mut found) = emit(&program, catalog, &title(graphs));
    diagnostics.append(&mut found);
    if has_errors(&diagnostics) { (None, diagnostics) } else { (Some(Compiled { module, plan }), diagnostics) }
}

/// Adds the file and line of the node that a diagnostic names, where it has no place of its own: what
/// [`crate::verify`] reports is known by node alone.
pub fn locate(mut diagnostic: Diagnostic, graphs: &[NamedGraph]) -> Diagnostic {
    let Some(full) = diagnostic.place.node.clone().filter(|_| diagnostic.place.span.is_none()) else {
        return diagnostic;
    };
    for named in graphs {
        let node = full.strip_prefix(&format!("{}/", named.name)).unwrap_or(&full);
        if named.graph.nodes.contains_key(node) {
            let Place { span, file, .. } = named.graph.place(node);
            diagnostic.place.span = span;
            diagnostic.place.file = file;
            break;
        }
    }
    diagnostic
}

/// The largest uniform block that every WebGPU device takes, in bytes (limit `maxUniformBufferBindingSize`).
const MAX_PARAMETER_BYTES: u32 = 64 << 10;

fn too_many_parameters(count: usize, bytes: u32, which: &str, graphs: &[NamedGraph]) -> Diagnostic {
    let message = format!(
        "the {count} parameters take {bytes} bytes, and {MAX_PARAMETER_BYTES} is all that a device must take: {which} became constants"
    );
    let place = graphs.first().map_or_else(Place::default, |g| g.graph.file_place());
    let help =
        "a constant needs a new shader to change; `--bake` makes all values constants, and fewer nodes need fewer";
    Diagnostic::warning("ST0301", message, place).help(help)
}

/// The names of the graphs, for the first line of the text.
fn title(graphs: &[NamedGraph]) -> String {
    let name = |g: &NamedGraph| if g.graph.name.is_empty() { g.name.clone() } else { g.graph.name.clone() };
    let titles: Vec<String> = graphs.iter().map(name).collect();
    // Whatever a person calls a graph, it stays on one line of the text.
    titles.join(" + ").chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
