//! The typed, hash-consed expression DAG that a woven tree becomes, and how it is built.
//!
//! Equal expressions are one expression, so what two nodes share is computed once; what the root does not reach is
//! never emitted. A light is evaluated once; a shadow once per light that it is on; a surface once per light, and once
//! for what depends on no light. Nothing in here knows WGSL beyond the templates that nodes and conversions bring.

mod build;
mod evaluate;
mod origins;
mod source;
mod views;

use std::collections::BTreeMap;
use std::hash::BuildHasher;
use std::rc::Rc;
use std::sync::Arc;

use crate::hash::{HashMap, HashSet};
use foldhash::fast::RandomState;

use crate::module::{Address, SamplerSettings};
use crate::node::{Definition, Function};
use crate::semantic::{Conversions, Shape, Value};

pub use build::build;
pub use origins::Origins;

/// Index of an expression; operands have smaller indices than what uses them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Id(pub u32);

/// What an expression does with its operands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// WGSL with `$0`, `$1`, ... for the operands; from a conversion, a source or an inline node.
    Template {
        /// The text.
        text: Rc<str>,
        /// The node function that the text is the body of, if it is one.
        function: Option<usize>,
    },
    /// A call of `functions[.0]` with the operands as arguments.
    Call(usize),
    /// A member of the structure that the operand is.
    Member(Rc<str>),
    /// A value interpolated from vertices.
    Varying(Varying),
    /// The operand, to be computed for each vertex and interpolated where the vertex stage can compute it.
    Interpolated,
    /// A built-in input of the fragment stage: `clip_position` or `front_facing`.
    Input(&'static str),
    /// A member of the frame block.
    Frame(&'static str),
    /// A member of the object block.
    Object(&'static str),
    /// A parameter: index into `parameters`.
    Parameter(usize),
    /// A value written in place.
    Literal(Rc<str>),
    /// Something bound.
    Resource(Resource),
}

/// A value interpolated from vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(missing_docs, reason = "each is the source of the same name")]
pub enum Varying {
    PositionWorld,
    PositionObject,
    NormalWorld,
    NormalObject,
    TangentWorld,
    TangentObject,
    Texcoord,
    VertexColor,
}

/// Something bound, before it has a binding number.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Resource {
    /// An image file.
    Image {
        /// Path as the graph gives it.
        path: String,
        /// File that mentions it.
        base: String,
        /// Whether it is sRGB-encoded.
        srgb: bool,
        /// Node and port that ask for it, for its name.
        name: String,
    },
    /// A sampler.
    Sampler(SamplerSettings),
    /// The space of a light.
    Space(usize),
    /// A map: index into `maps`.
    Map(usize),
    /// The surroundings.
    Environment,
    /// Their sampler.
    EnvironmentSampler,
}

/// An expression.
#[derive(Clone, Debug)]
pub struct Expression {
    /// What it does.
    pub op: Op,
    /// To what.
    pub operands: Vec<Id>,
    /// A name for its value; empty for parameters and members, which never need a line.
    pub name: Rc<str>,
    /// Nodes that it stands for, by index into `nodes`.
    pub origins: Origins,
    /// The port of the first such node that it feeds, for conversions.
    pub port: Option<Arc<str>>,
    /// What carries its value, where that is known and no structure.
    pub shape: Option<Shape>,
    /// Whether it is the result of a node, and so gets a line of its own.
    pub result: bool,
    /// The light that a node's result was evaluated under, where it is one of several terms.
    pub light: Option<usize>,
}

/// A node function in use.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Where it is defined.
    pub definition: Arc<Definition>,
    /// What `T` stands for.
    pub generic: Option<Shape>,
    /// Whether it is the ambient function.
    pub ambient: bool,
}

impl Instance {
    /// The function.
    pub fn function(&self) -> &Function {
        match (&self.definition.ambient, self.ambient) {
            (Some(ambient), true) => ambient,
            _ => &self.definition.main,
        }
    }
}

/// A value that can change without a new pipeline.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Index of the node.
    pub node: usize,
    /// Name of the input.
    pub port: Arc<str>,
    /// Value from the graph or the node's default.
    pub value: Value,
}

/// A map that a node asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapDemand {
    /// Index of the light.
    pub light: usize,
    /// Passes with their options, `$option` resolved.
    pub passes: Vec<(String, BTreeMap<String, String>)>,
    /// WGSL type that it is read as.
    pub ty: String,
    /// Whether some sampler interpolates in it.
    pub filtered: bool,
    /// Index of the node that asked first.
    pub node: usize,
    /// Name of its input.
    pub port: String,
}

/// What is known of a node once it is part of a program.
#[derive(Clone, Debug)]
pub struct NodeInfo {
    /// Name among all graphs.
    pub id: Arc<str>,
    /// The last part of the name where that is unique, else all of it.
    pub short: Arc<str>,
    /// Its definition.
    pub definition: Arc<Definition>,
    /// What `T` stands for.
    pub generic: Option<Shape>,
}

/// A program: expressions and what they refer to.
#[derive(Default)]
pub struct Program {
    /// All expressions, operands first.
    pub expressions: Vec<Expression>,
    /// Node functions.
    pub functions: Vec<Instance>,
    /// Parameters.
    pub parameters: Vec<Parameter>,
    /// Maps.
    pub maps: Vec<MapDemand>,
    /// Nodes.
    pub nodes: Vec<NodeInfo>,
    /// The `vec3f` that is written.
    pub root: Option<Id>,
    /// By hash of operation and operands, or the next number that was free.
    known: HashMap<u64, Id>,
    hasher: RandomState,
    nameless: Rc<str>,
    function_index: HashMap<String, usize>,
    /// What `function_index` says, by address: the nodes keep every definition where it is.
    function_at: HashMap<(usize, Option<Shape>, bool), usize>,
    /// Parameters of each node.
    slots: Vec<Vec<usize>>,
    words: HashSet<Arc<str>>,
    inline_texts: HashMap<usize, Rc<str>>,
    conversions: Conversions,
    bake: Bake,
    unshadowed: bool,
}

/// Which values are written as constants instead of parameters. What the spaces of maps are made from never is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bake {
    /// None.
    #[default]
    Nothing,
    /// Those that are the defaults of their nodes.
    Defaults,
    /// All.
    All,
}

impl Program {
    /// The expression that does `op` to `operands`: an existing one if there is one.
    pub fn add(&mut self, op: Op, operands: Vec<Id>, name: &str, origin: Option<usize>) -> Id {
        if let Op::Template { text, .. } | Op::Literal(text) = &op {
            assert!(!text.is_empty(), "an expression without text: {name}");
        }
        let mut key = self.hasher.hash_one((&op, &operands));
        while let Some(&id) = self.known.get(&key) {
            let known = &mut self.expressions[id.0 as usize];
            if known.op == op && known.operands == operands {
                known.origins.extend(origin);
                return id;
            }
            key = key.wrapping_add(1);
        }
        let id = Id(u32::try_from(self.expressions.len()).expect("bounded by the limits on nodes"));
        self.expressions.push(Expression {
            op,
            operands,
            name: if name.is_empty() { self.nameless.clone() } else { name.into() },
            origins: origin.into_iter().collect(),
            port: None,
            shape: None,
            result: false,
            light: None,
        });
        self.known.insert(key, id);
        id
    }

    /// A template over operands.
    pub fn template(&mut self, text: &str, operands: Vec<Id>, name: &str, origin: Option<usize>) -> Id {
        self.add(Op::Template { text: text.into(), function: None }, operands, name, origin)
    }

    /// Whether a variable can be declared for an expression: its shape is known, or it is a node's structure.
    pub fn has_type(&self, id: Id) -> bool {
        let expression = self.get(id);
        let call = |f: usize| self.functions[f].function().result_struct.is_some();
        expression.shape.is_some() || matches!(expression.op, Op::Call(f) if call(f))
    }

    /// Says what carries the value of an expression.
    pub(crate) fn shaped(&mut self, id: Id, shape: Shape) -> Id {
        self.expressions[id.0 as usize].shape = Some(shape);
        id
    }

    /// The expression.
    pub fn get(&self, id: Id) -> &Expression {
        &self.expressions[id.0 as usize]
    }

    /// A word that many share, such as the name of a port.
    fn word(&mut self, word: &str) -> Arc<str> {
        if let Some(known) = self.words.get(word) {
            return known.clone();
        }
        let shared: Arc<str> = word.into();
        self.words.insert(shared.clone());
        shared
    }

    fn function(&mut self, definition: &Arc<Definition>, generic: Option<&Shape>, ambient: bool) -> usize {
        let at = (Arc::as_ptr(definition) as usize, generic.cloned(), ambient);
        if let Some(known) = self.function_at.get(&at) {
            return *known;
        }
        let instance = Instance { definition: definition.clone(), generic: generic.cloned(), ambient };
        let index = self.function_like(instance);
        self.function_at.insert(at, index);
        index
    }

    /// Equal definitions are one function, wherever they were read.
    fn function_like(&mut self, instance: Instance) -> usize {
        let d = &instance.definition;
        let key = format!(
            "{}\n{}\n{:?}\n{:?}\n{}",
            d.header.source.name, d.kind, d.choices, instance.generic, instance.ambient
        );
        *self.function_index.entry(key).or_insert_with(|| {
            self.functions.push(instance);
            self.functions.len() - 1
        })
    }
}

/// Sampler settings from a definition's header line.
pub(crate) fn sampler_settings(definition: &Definition, port: &str) -> SamplerSettings {
    let spec = definition.header.samplers.iter().find(|s| s.port == port);
    let get = |key: &str| {
        let setting = spec?.settings.iter().find(|(k, _)| k == key)?;
        Some(definition.setting(&setting.1))
    };
    let filter = get("filter").unwrap_or("linear");
    let anisotropy = get("anisotropy").and_then(|a| a.parse().ok()).unwrap_or(1);
    // Anisotropic filtering needs every filter linear.
    let anisotropy = if filter == "trilinear" { anisotropy } else { 1 };
    SamplerSettings {
        linear: filter != "nearest",
        mip_linear: filter == "trilinear",
        address: match get("address") {
            Some("clamp") => Address::Clamp,
            Some("mirror") => Address::Mirror,
            _ => Address::Repeat,
        },
        anisotropy,
        compare: get("compare") == Some("on"),
    }
}
