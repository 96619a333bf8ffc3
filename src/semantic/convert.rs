//! The one table of conversions, and the cheapest chain through it.
//!
//! `steps` is the table: from a type, what one conversion can make of it and what that costs. [`Conversions::chain`]
//! finds the cheapest chain to what a port accepts, by shortest path over the types that are reachable. Only at the end
//! of a chain may properties be forgotten (`accepts`), so that no chain launders a point into a colour. Costs are
//! 16 per vector operation, as in `reference` tables of shader weavers: a frame change 3 or 4 operations, a normalise 3.
//! Lossy conversions (colour to luminance, dropping components, changing a quantity) are not in the table at all.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use crate::hash::HashMap;
use petgraph::algo::{astar, dijkstra};
use petgraph::graph::{DiGraph, NodeIndex};

use super::{Encoding, Frame, Kind, Length, Meaning, Quantity, Shape, Type};

/// Cost of one vector operation.
pub const OPERATION: u32 = 16;
/// Cost of forgetting one property at the end of a chain.
const FORGET: u32 = 1;
/// Cost of giving a meaning to an untyped number.
const ASSUME: u32 = 4;

/// One conversion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// WGSL with `$` for the value and `@name` for what the compiler provides.
    pub template: &'static str,
    /// What comes out.
    pub to: Type,
    /// Short word for a name of the result (`unit`, `world`).
    pub label: &'static str,
}

/// A chain of conversions with its cost.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Chain {
    /// Sum of the costs of its steps and of what is forgotten at its end.
    pub cost: u32,
    /// Steps in order; none if the value is used as it is.
    pub steps: Vec<Step>,
}

/// What one conversion can make of a type: the table.
fn steps(from: &Type) -> Vec<(u32, Step)> {
    let mut out = Vec::new();
    let m = from.meaning;
    let Some(width) = from.shape.width() else {
        if m.kind == Kind::Bool {
            let to = Type::new(Meaning::of(Kind::Scalar), Shape::F32(1));
            out.push((OPERATION, Step { template: "select(0.0, 1.0, $)", to, label: "number" }));
        }
        return out;
    };
    let mut add = |operations: u32, template: &'static str, label: &'static str, meaning: Meaning, width: u8| {
        let to = Type::new(meaning, Shape::F32(width));
        out.push((operations * OPERATION, Step { template, to, label }));
    };
    for &(kind, of, from_frame, to_frame, operations, template) in FRAMES {
        if kind == m.kind && m.frame == from_frame && m.encoding == Encoding::Linear && width == of {
            // A rigid map keeps lengths; the object's may scale.
            let rigid = !matches!((from_frame, to_frame), (Frame::Object, _) | (_, Frame::Object));
            let length = if rigid { m.length } else { Length::Any };
            add(operations, template, to_frame.word(), Meaning { frame: to_frame, length, ..m }, 3);
        }
    }
    match m.kind {
        Kind::Direction | Kind::Normal if m.encoding == Encoding::Linear && width == 3 => {
            if m.length != Length::Unit {
                add(3, "normalize($)", "unit", Meaning { length: Length::Unit, ..m }, 3);
            }
            if m.kind == Kind::Normal {
                add(0, "", "", Meaning { kind: Kind::Direction, ..m }, 3);
            } else {
                add(0, "", "", Meaning { kind: Kind::Vector, ..m }, 3);
            }
        }
        Kind::Vector if width == 3 && m.length == Length::Any => {
            add(3, "normalize($)", "unit", Meaning { kind: Kind::Direction, length: Length::Unit, ..m }, 3);
        }
        Kind::Color if m.encoding == Encoding::Srgb && width == 3 => {
            let decode = "select(pow(($ + 0.055) / 1.055, vec3f(2.4)), $ / 12.92, $ <= vec3f(0.04045))";
            add(6, decode, "linear", Meaning { encoding: Encoding::Linear, ..m }, 3);
        }
        Kind::Color if width == 4 => add(0, "$.rgb", "rgb", m, 3),
        Kind::Color if width == 3 => add(1, "vec4f($, 1.0)", "rgba", m, 4),
        Kind::Scalar if width == 1 => add(0, "vec3f($)", "color", Meaning { kind: Kind::Color, ..m }, 3),
        _ => {}
    }
    if m.encoding == Encoding::Signed01 && matches!(m.kind, Kind::Direction | Kind::Normal) && width == 3 {
        add(1, "($ * 2.0 - 1.0)", "signed", Meaning { encoding: Encoding::Linear, length: Length::Near, ..m }, 3);
    }
    // A plain colour or number may play a role that has no unit.
    if m.quantity == Quantity::None && matches!(m.kind, Kind::Color | Kind::Scalar) {
        for quantity in [Quantity::Reflectance, Quantity::Emission] {
            add(0, "", "", Meaning { quantity, ..m }, width);
        }
    }
    // An image read without decoding may hold directions.
    if m == Meaning::of(Kind::Color) && width == 3 {
        let to = Meaning { frame: Frame::Tangent, encoding: Encoding::Signed01, ..m };
        out.push((ASSUME, Step { template: "", to: Type::new(to, Shape::F32(3)), label: "" }));
    }
    for (cost, step) in assumptions(m, width) {
        out.push((cost, step));
    }
    // Conversions that only rename cost something, so that an exact match always wins.
    for (cost, step) in &mut out {
        if step.template.is_empty() || step.template == "vec3f($)" || step.template == "$.rgb" {
            *cost += 2 * FORGET;
        }
    }
    out
}

/// What an untyped number may be taken for: any kind of its width, in any frame, but in no radiometric role.
fn assumptions(m: Meaning, width: u8) -> Vec<(u32, Step)> {
    let kinds: &[Kind] = match (m.kind, width) {
        (Kind::Number, 1) => &[Kind::Scalar, Kind::Angle, Kind::Cosine, Kind::Distance, Kind::Depth],
        (Kind::Number, 2) => &[Kind::Texcoord],
        (Kind::Number, 3) => &[Kind::Color, Kind::Vector, Kind::Point, Kind::Direction, Kind::Normal],
        (Kind::Number, 4) => &[Kind::Color],
        (Kind::Scalar, 1) => &[Kind::Angle, Kind::Cosine, Kind::Distance, Kind::Depth],
        _ => return Vec::new(),
    };
    let framed = |kind| matches!(kind, Kind::Vector | Kind::Point | Kind::Direction | Kind::Normal);
    let mut out = Vec::new();
    for &kind in kinds {
        let frames: &[Frame] =
            if framed(kind) { &[Frame::World, Frame::Object, Frame::View, Frame::Tangent] } else { &[Frame::Any] };
        for &frame in frames {
            let to = Type::new(Meaning { frame, ..Meaning::of(kind) }, Shape::F32(width));
            out.push((ASSUME, Step { template: "", to, label: "" }));
        }
    }
    out
}

/// Frame changes: kind, width, from, to, operations, WGSL.
const FRAMES: &[(Kind, u8, Frame, Frame, u32, &str)] = &[
    (Kind::Point, 3, Frame::Object, Frame::World, 4, "(@object_to_world * vec4f($, 1.0)).xyz"),
    (Kind::Point, 3, Frame::World, Frame::Object, 4, "(@world_to_object * vec4f($, 1.0)).xyz"),
    (Kind::Point, 3, Frame::World, Frame::View, 4, "(@world_to_view * vec4f($, 1.0)).xyz"),
    (Kind::Vector, 3, Frame::Object, Frame::World, 3, "(@object_to_world * vec4f($, 0.0)).xyz"),
    (Kind::Vector, 3, Frame::World, Frame::Object, 3, "(@world_to_object * vec4f($, 0.0)).xyz"),
    (Kind::Vector, 3, Frame::World, Frame::View, 3, "(@world_to_view * vec4f($, 0.0)).xyz"),
    (Kind::Vector, 3, Frame::View, Frame::World, 3, "(vec4f($, 0.0) * @world_to_view).xyz"),
    (Kind::Direction, 3, Frame::Object, Frame::World, 3, "(@object_to_world * vec4f($, 0.0)).xyz"),
    (Kind::Direction, 3, Frame::World, Frame::Object, 3, "(@world_to_object * vec4f($, 0.0)).xyz"),
    (Kind::Direction, 3, Frame::World, Frame::View, 3, "(@world_to_view * vec4f($, 0.0)).xyz"),
    (Kind::Direction, 3, Frame::View, Frame::World, 3, "(vec4f($, 0.0) * @world_to_view).xyz"),
    (Kind::Direction, 3, Frame::Tangent, Frame::World, 3, TANGENT_TO_WORLD),
    // A normal goes by the inverse transpose: a row vector times the inverse matrix.
    (Kind::Normal, 3, Frame::Object, Frame::World, 3, "(vec4f($, 0.0) * @world_to_object).xyz"),
    (Kind::Normal, 3, Frame::World, Frame::Object, 3, "(vec4f($, 0.0) * @object_to_world).xyz"),
    (Kind::Normal, 3, Frame::World, Frame::View, 3, "(@world_to_view * vec4f($, 0.0)).xyz"),
    (Kind::Normal, 3, Frame::View, Frame::World, 3, "(vec4f($, 0.0) * @world_to_view).xyz"),
    (Kind::Normal, 3, Frame::Tangent, Frame::World, 3, TANGENT_TO_WORLD),
];

const TANGENT_TO_WORLD: &str = "mat3x3f(@tangent_world, @bitangent_world, @normal_world) * $";

/// Whether a port of type `port` takes a value of type `value` as it is, and the cost of what is forgotten.
fn accepts(port: &Type, value: &Type) -> Option<u32> {
    let (p, v) = (port.meaning, value.meaning);
    if port.shape != value.shape {
        return None;
    }
    if p.kind == Kind::Number {
        return value.shape.width().map(|_| if v.kind == Kind::Number { 0 } else { FORGET });
    }
    let mut cost = 0;
    if p.kind != v.kind {
        // Every one of these is a pure number once it is asked for as one.
        let plain = matches!(v.kind, Kind::Cosine | Kind::Distance | Kind::Angle | Kind::Depth | Kind::Scalar);
        if !(p.kind == Kind::Scalar && plain) {
            return None;
        }
        cost += FORGET;
    }
    let mut forget = |stated: bool, same: bool| {
        if stated && !same {
            return false;
        }
        cost += if same { 0 } else { FORGET };
        true
    };
    let fits = forget(p.frame != Frame::Any, p.frame == v.frame)
        && forget(p.quantity != Quantity::None, p.quantity == v.quantity)
        && p.encoding == v.encoding
        && p.length <= v.length;
    fits.then(|| cost + if p.length == v.length { 0 } else { FORGET })
}

/// Types reachable from one type, with the cheapest way to each.
struct Reach {
    graph: DiGraph<Type, (u32, Step)>,
    cost: BTreeMap<usize, u32>,
}

impl Reach {
    fn from(source: &Type) -> Self {
        let mut graph = DiGraph::new();
        let mut index = HashMap::default();
        index.insert(source.clone(), graph.add_node(source.clone()));
        let mut open = vec![source.clone()];
        while let Some(ty) = open.pop() {
            for (cost, step) in steps(&ty) {
                let to = *index.entry(step.to.clone()).or_insert_with(|| {
                    open.push(step.to.clone());
                    graph.add_node(step.to.clone())
                });
                graph.add_edge(index[&ty], to, (cost, step));
            }
        }
        let cost = dijkstra(&graph, NodeIndex::new(0), None, |e| e.weight().0);
        let cost = cost.into_iter().map(|(n, c)| (n.index(), c)).collect();
        Self { graph, cost }
    }

    fn to(&self, port: &Type) -> Option<Chain> {
        let ending = |n: NodeIndex| Some(self.cost.get(&n.index())? + accepts(port, &self.graph[n])?);
        let end = self.graph.node_indices().filter(|n| ending(*n).is_some()).min_by_key(|n| ending(*n))?;
        let (_, path) = astar(&self.graph, NodeIndex::new(0), |n| n == end, |e| e.weight().0, |_| 0)?;
        let step = |pair: &[NodeIndex]| {
            let edges = self.graph.edges_connecting(pair[0], pair[1]);
            edges.min_by_key(|e| e.weight().0).map(|e| e.weight().1.clone())
        };
        let steps = path.windows(2).filter_map(step).filter(|s| !s.template.is_empty()).collect();
        Some(Chain { cost: ending(end)?, steps })
    }
}

/// Value and port.
type Pair = (Type, Type);

/// The cheapest chains, remembered.
#[derive(Default)]
pub struct Conversions {
    reach: RefCell<HashMap<Type, Rc<Reach>>>,
    chains: RefCell<HashMap<Pair, Option<Rc<Chain>>>>,
}

impl Conversions {
    /// The cheapest lossless chain from a value to a port, if there is one. A generic port takes any width; an untyped
    /// port that is wider than a one-component value takes it in every component.
    pub fn chain(&self, value: &Type, port: &Type) -> Option<Rc<Chain>> {
        let key = (value.clone(), port.clone());
        if let Some(known) = self.chains.borrow().get(&key) {
            return known.clone();
        }
        let found = self.search(value, port).map(Rc::new);
        self.chains.borrow_mut().insert(key, found.clone());
        found
    }

    fn search(&self, value: &Type, port: &Type) -> Option<Chain> {
        if port.shape == Shape::Generic {
            value.shape.width()?;
            return self.chain(value, &Type::new(port.meaning, value.shape.clone())).map(|c| (*c).clone());
        }
        // One component is spread over an untyped port; a detour over colours would set an alpha of 1.
        if let (Some(1), Some(width @ 2..=4), Kind::Number) =
            (value.shape.width(), port.shape.width(), port.meaning.kind)
        {
            let template = ["vec2f($)", "vec3f($)", "vec4f($)"][usize::from(width) - 2];
            let to = Type::new(port.meaning, port.shape.clone());
            return Some(Chain { cost: 3 * FORGET, steps: vec![Step { template, to, label: "wide" }] });
        }
        let mut known = self.reach.borrow_mut();
        let reach = known.entry(value.clone()).or_insert_with(|| Rc::new(Reach::from(value))).clone();
        reach.to(port)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ty(words: &str, width: u8) -> Type {
        Type::new(Meaning::parse(words).expect("meaning"), Shape::F32(width))
    }

    fn check(from: (&str, u8), to: (&str, u8), expected: Option<&[&str]>) {
        let conversions = Conversions::default();
        let chain = conversions.chain(&ty(from.0, from.1), &ty(to.0, to.1));
        let templates = chain.map(|c| c.steps.iter().map(|s| s.template).collect::<Vec<_>>());
        assert_eq!(templates.as_deref(), expected, "{from:?} -> {to:?}");
    }

    #[test]
    fn normals_go_by_the_inverse_transpose_and_are_normalised_once() {
        check(
            ("normal object unit", 3),
            ("normal world unit", 3),
            Some(&["(vec4f($, 0.0) * @world_to_object).xyz", "normalize($)"]),
        );
        check(("normal world near", 3), ("normal world unit", 3), Some(&["normalize($)"]));
        check(("normal world unit", 3), ("normal world unit", 3), Some(&[]));
        check(("normal world unit", 3), ("normal view unit", 3), Some(&["(@world_to_view * vec4f($, 0.0)).xyz"]));
        check(
            ("direction object unit", 3),
            ("direction view unit", 3),
            Some(&["(@object_to_world * vec4f($, 0.0)).xyz", "(@world_to_view * vec4f($, 0.0)).xyz", "normalize($)"]),
        );
    }

    #[test]
    fn lossy_conversions_are_never_found() {
        check(("color", 3), ("scalar", 1), None);
        check(("point world", 3), ("vector world", 3), None);
        check(("point world", 3), ("color reflectance", 3), None);
        check(("color radiance", 3), ("color reflectance", 3), None);
        check(("number", 3), ("color irradiance", 3), None);
        check(("number", 3), ("number", 2), None);
        check(("scalar", 1), ("bool", 1), None);
    }

    #[test]
    fn cheap_conversions_are_found() {
        check(("scalar", 1), ("color reflectance", 3), Some(&["vec3f($)"]));
        check(("color", 4), ("color reflectance", 3), Some(&["$.rgb"]));
        check(("scalar", 1), ("number", 3), Some(&["vec3f($)"]));
        check(("number", 1), ("number", 4), Some(&["vec4f($)"]));
        check(("point world", 3), ("number", 3), Some(&[]));
        check(("cosine", 1), ("scalar", 1), Some(&[]));
    }

    #[test]
    fn an_exact_match_is_cheaper_than_any_other() {
        let conversions = Conversions::default();
        let cost = |a: (&str, u8), b: (&str, u8)| conversions.chain(&ty(a.0, a.1), &ty(b.0, b.1)).expect("chain").cost;
        assert_eq!(cost(("color reflectance", 3), ("color reflectance", 3)), 0);
        assert!(cost(("color", 3), ("color reflectance", 3)) < cost(("scalar", 1), ("color reflectance", 3)));
        assert!(cost(("scalar", 1), ("scalar", 1)) < cost(("scalar", 1), ("color", 3)));
    }
}
