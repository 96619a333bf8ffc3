//! What a node file says, once its options are chosen. (interface)

use std::collections::BTreeMap;
use std::sync::Arc;

use super::cheaper::CheaperSpec;
use crate::diagnostic::SourceText;
use crate::semantic::{Shape, Type, Value};

/// A node file with all options chosen: ports, text, demands.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The file's stem, which is also the name of its main function.
    pub kind: String,
    /// The header of the file.
    pub header: Arc<Header>,
    /// The choice made for each option, in declaration order.
    pub choices: Vec<(String, String)>,
    /// The function named like the kind.
    pub main: Function,
    /// The function `<kind>_ambient`, if there is one.
    pub ambient: Option<Function>,
    /// Module-scope items of the file in file order, options applied.
    pub items: Vec<Item>,
}

/// The part of a node file that does not depend on options.
#[derive(Clone, Debug)]
pub struct Header {
    /// Where the file came from.
    pub source: Arc<SourceText>,
    /// Name for people.
    pub label: String,
    /// Family.
    pub category: String,
    /// Other names.
    pub synonyms: Vec<String>,
    /// All description lines joined by spaces; the first sentence is the summary.
    pub description: String,
    /// Names of library files that the text needs, direct ones only.
    pub uses: Vec<String>,
    /// Whether the body is one `return`, to be written in place.
    pub inline: bool,
    /// Whether the result is computed for each vertex and interpolated, where the vertex stage can compute it.
    pub vertex: bool,
    /// Whether the first two inputs may be swapped.
    pub commutative: bool,
    /// Shapes that `T` may take; the first is the file's own. Empty: not generic.
    pub generic: Vec<Shape>,
    /// Structural choices.
    pub options: Vec<OptionSpec>,
    /// Projection that a light's maps are made in.
    pub space: Option<SpaceSpec>,
    /// Demand for maps, by port.
    pub maps: Vec<MapSpec>,
    /// How samplers are made, by port.
    pub samplers: Vec<SamplerSpec>,
    /// How images are read, by port.
    pub textures: Vec<TextureSpec>,
    /// Cheaper forms that can stand for the node.
    pub cheaper: Vec<CheaperSpec>,
}

/// A structural choice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OptionSpec {
    /// Its name.
    pub name: String,
    /// What may be chosen.
    pub choices: Vec<String>,
    /// What is taken if nothing is said.
    pub default: String,
    /// What it is for.
    pub doc: String,
}

/// `space: perspective(a, b, ...) key=value`: a projection and the inputs that define it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpaceSpec {
    /// Name of one of [`super::PROJECTIONS`].
    pub projection: String,
    /// Input names, in the order of the projection's parameters.
    pub inputs: Vec<String>,
    /// Settings; values are literals or `$option`.
    pub settings: Vec<(String, String)>,
}

/// `map PORT: pass(a=1) > pass(b=$option)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapSpec {
    /// The input that receives the map.
    pub port: String,
    /// Passes in order; arguments are literals or `$option`.
    pub passes: Vec<(String, Vec<(String, String)>)>,
}

/// `sampler PORT: key=value ...`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SamplerSpec {
    /// The input that receives the sampler.
    pub port: String,
    /// Settings; values are literals or `$option`.
    pub settings: Vec<(String, String)>,
}

/// `texture PORT: key=value ...`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextureSpec {
    /// The input that receives the texture.
    pub port: String,
    /// Settings; values are literals or `$option`.
    pub settings: Vec<(String, String)>,
}

impl Definition {
    /// The value of a header setting: a literal, or the choice made for `$option`.
    pub fn setting<'a>(&'a self, value: &'a str) -> &'a str {
        match value.strip_prefix('$') {
            Some(name) => self.choices.iter().find(|(n, _)| n == name).map_or(value, |(_, v)| v),
            None => value,
        }
    }

    /// Inputs of the main function, then those that only the ambient function has.
    pub fn inputs(&self) -> impl Iterator<Item = &Port> {
        let extra = self.ambient.iter().flat_map(|f| &f.inputs);
        self.main.inputs.iter().chain(extra.filter(|p| self.main.inputs.iter().all(|q| q.name != p.name)))
    }

    /// The input called `name`.
    pub fn input(&self, name: &str) -> Option<&Port> {
        self.inputs().find(|p| p.name == name)
    }

    /// The output called `name`.
    pub fn output(&self, name: &str) -> Option<&Port> {
        self.main.outputs.iter().find(|p| p.name == name)
    }
}

/// A function of a node file that the weaver can call.
#[derive(Clone, Debug)]
pub struct Function {
    /// WGSL name.
    pub name: String,
    /// Parameters, in order.
    pub inputs: Vec<Port>,
    /// Results: one, or the members of the returned struct in order.
    pub outputs: Vec<Port>,
    /// Name of the returned struct, if it returns one.
    pub result_struct: Option<String>,
    /// The returned expression, for `inline` files.
    pub body: Option<String>,
}

/// An input or output with all that is known of it.
#[derive(Clone, Debug)]
pub struct Port {
    /// Its name, from the signature.
    pub name: String,
    /// Meaning and shape.
    pub ty: Type,
    /// What it takes when nothing is linked.
    pub default: Option<Default>,
    /// Inclusive limits per component, in the unit of the file.
    pub range: (Option<f64>, Option<f64>),
    /// Unit of values in files (`deg`, `m`, `s`, `px`), empty for none. `deg` is converted to radians before use.
    pub unit: String,
    /// Whether only the default is ever used.
    pub hidden: bool,
    /// What it does.
    pub doc: String,
}

/// What an unlinked input takes.
#[derive(Clone, Debug, PartialEq)]
pub enum Default {
    /// A value, which becomes a parameter that can be changed.
    Value(Value),
    /// Something that the compiler provides, by name without the `@`.
    Source(String),
}

/// A module-scope declaration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// What it declares.
    pub name: String,
    /// Its text, attributes included, doc comments excluded.
    pub text: String,
    /// Identifiers that it mentions, sorted, each once.
    pub mentions: Vec<String>,
    /// Byte offset of the text in the file.
    pub offset: usize,
}

/// A library file under `nodes/lib/`.
#[derive(Clone, Debug)]
pub struct Library {
    /// Its name in `use:` lines.
    pub name: String,
    /// Libraries that it needs, direct ones only.
    pub uses: Vec<String>,
    /// Its declarations.
    pub items: Vec<Item>,
}

/// Options by name, as a graph gives them.
pub type Choices = BTreeMap<String, String>;
