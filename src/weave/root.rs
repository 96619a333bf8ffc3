//! What the fragment shader writes.

use std::rc::Rc;

use super::collect::{Collected, suggest};
use super::resolve::is_lamp;
use super::{Node, is_lit, is_surface};
use crate::compile::{NamedGraph, Output};
use crate::diagnostic::{Diagnostic, Place};
use crate::semantic::{Chain, Conversions, Kind, Meaning, Shape, Type};

/// Most nodes that one message names.
const MAX_NAMED: usize = 8;

/// What is written.
pub enum Root {
    /// A surface's radiance: summed over lights, ambient part once.
    Surface {
        /// Index of the node.
        node: usize,
    },
    /// A value as a colour.
    Value {
        /// Index of the node.
        node: usize,
        /// Name of the output.
        output: String,
        /// Conversions to a colour.
        chain: Rc<Chain>,
    },
    /// Sum of what these lights deliver after these shadows, facing the light.
    Irradiance {
        /// Light and last nodes before the picture.
        lights: Vec<(usize, Vec<usize>)>,
    },
    /// Product of the shadows on a light.
    Visibility {
        /// The light.
        light: usize,
        /// Its shadows.
        shadows: Vec<usize>,
    },
    /// The shading normal: of the surface with this index if it has one, else the mesh's.
    Normal {
        /// Index of a surface node.
        node: Option<usize>,
    },
    /// Distance along the view axis.
    Depth,
}

pub(crate) fn choose(
    graphs: &[NamedGraph],
    collected: &Collected,
    nodes: &[Option<Node>],
    output: &Output,
    conversions: &Conversions,
    out: &mut Vec<Diagnostic>,
) -> Option<Root> {
    match output {
        Output::Depth => Some(Root::Depth),
        Output::Visibility(light) | Output::Irradiance(light) => {
            let light = find_light(collected, nodes, light, out)?;
            let shadows = shadows_of(collected, nodes, light);
            Some(match output {
                Output::Visibility(_) => Root::Visibility { light, shadows },
                _ => Root::Irradiance { lights: vec![(light, shadows)] },
            })
        }
        Output::Radiance => seen(graphs, collected, nodes, conversions, out),
        Output::Normal => {
            let root = seen(graphs, collected, nodes, conversions, out)?;
            Some(Root::Normal { node: if let Root::Surface { node } = root { Some(node) } else { None } })
        }
    }
}

/// Every shadow of a light that feeds something seen, or that ends its program.
fn shadows_of(collected: &Collected, nodes: &[Option<Node>], light: usize) -> Vec<usize> {
    let mut shadows: Vec<usize> = Vec::new();
    for (node, found) in nodes.iter().zip(&collected.nodes) {
        let lit = found.definition.as_deref().is_some_and(|d| is_lit(d) || is_lamp(d));
        if let Some(above) = node.as_ref().filter(|_| lit).and_then(|n| n.lights.get(&light)) {
            shadows.extend(above);
        }
    }
    shadows.sort_unstable();
    shadows.dedup();
    shadows
}

/// The one of these light names that a person means by all of it, by its graph, or by its node.
pub fn light_called<'a>(names: impl Iterator<Item = &'a str> + Clone, wanted: &str) -> Option<&'a str> {
    let only = |test: &dyn Fn(&str) -> bool| {
        let mut found = names.clone().filter(|name| test(name));
        found.next().filter(|_| found.next().is_none())
    };
    only(&|n| n == wanted)
        .or_else(|| only(&|n| n.split_once('/').is_some_and(|(graph, _)| graph == wanted)))
        .or_else(|| only(&|n| n.rsplit('/').next() == Some(wanted)))
}

fn find_light(collected: &Collected, nodes: &[Option<Node>], name: &str, out: &mut Vec<Diagnostic>) -> Option<usize> {
    let lights: Vec<usize> =
        (0..nodes.len()).filter(|i| nodes[*i].as_ref().is_some_and(|n| n.lights.contains_key(i))).collect();
    let id = |i: &usize| &*collected.nodes[*i].id;
    let called = light_called(lights.iter().map(id), name);
    let found = called.and_then(|full| lights.iter().copied().find(|i| id(i) == full));
    if found.is_none() {
        let names: Vec<&str> = lights.iter().map(id).collect();
        let error = Diagnostic::error("ST0219", format!("there is no light called `{name}`"), Place::default());
        out.push(suggest(error, name, &names, "the lights are"));
    }
    found
}

/// What is seen: the exported node of the one program that has a surface, or else of the only program.
fn seen(
    graphs: &[NamedGraph],
    collected: &Collected,
    nodes: &[Option<Node>],
    conversions: &Conversions,
    out: &mut Vec<Diagnostic>,
) -> Option<Root> {
    let mut ends: Vec<(usize, Option<String>)> = Vec::new();
    let followers = Followers::of(collected);
    for index in 0..graphs.len() {
        ends.extend(exports(graphs, index, collected, &followers, out)?);
    }
    let is = |i: usize, what: fn(&crate::node::Definition) -> bool| {
        collected.nodes[i].definition.as_deref().is_some_and(what)
    };
    let surfaces: Vec<&(usize, Option<String>)> = ends.iter().filter(|(i, _)| is(*i, is_surface)).collect();
    let values: Vec<&(usize, Option<String>)> =
        ends.iter().filter(|(i, _)| !is(*i, is_surface) && !is(*i, is_lamp)).collect();
    let shown = if surfaces.is_empty() { &values } else { &surfaces };
    match shown[..] {
        [(node, port)] => {
            let left = |i: usize| i != *node && !collected.nodes[i].is_doubtful();
            for (other, _) in values.iter().filter(|(i, _)| left(*i)) {
                let message = format!("`{}` feeds nothing and is left out", collected.nodes[*other].id);
                let help = "link it to something, or name it as the graph's `output`";
                out.push(Diagnostic::warning("ST0220", message, collected.place(*other)).help(help));
            }
            finish(graphs, *node, port.as_deref(), collected, nodes, conversions, out)
        }
        [] => lamps_alone(graphs, &ends, collected, nodes, out),
        // Nodes that are misspelt, or whose links are, are not to be chosen between.
        _ if shown.iter().any(|(i, _)| collected.nodes[*i].is_doubtful()) => None,
        [(first, _), ..] => {
            let names = shown.iter().map(|(i, _)| format!("`{}`", collected.nodes[*i].id));
            let mut names: Vec<String> = names.collect();
            names.sort_unstable();
            if names.len() > MAX_NAMED {
                let more = names.len() - MAX_NAMED;
                names.truncate(MAX_NAMED);
                names.push(format!("{more} more"));
            }
            let message = format!("{} are all left without a follower: which one is seen?", names.join(", "));
            let help = format!(
                "say `output: \"{}\"`, or combine them with `mix_surface` or `add_surface`",
                super::lights::short(&collected.nodes[*first].id)
            );
            out.push(Diagnostic::error("ST0221", message, collected.place(*first)).help(help));
            None
        }
    }
}

/// The nodes that a graph exports: the one that it names, or those that feed nothing.
fn exports(
    graphs: &[NamedGraph],
    index: usize,
    collected: &Collected,
    followers: &Followers,
    out: &mut Vec<Diagnostic>,
) -> Option<Vec<(usize, Option<String>)>> {
    let named = &graphs[index];
    let own: Vec<usize> = (0..collected.nodes.len()).filter(|i| collected.nodes[*i].graph == index).collect();
    let Some(end) = &named.graph.output else {
        return Some(own.into_iter().filter(|i| followers.ends(*i, collected)).map(|i| (i, None)).collect());
    };
    let id = super::collect::identifier(graphs, index, &end.node);
    let found = own.iter().copied().find(|i| collected.nodes[*i].id == id);
    if found.is_none() {
        let muted = named.graph.nodes.get(&end.node).is_some_and(|n| n.muted);
        let why = if muted { "is muted" } else { "is not among its nodes" };
        let message = format!("the graph's output `{end}` {why}");
        let help = "name a node that is there and not muted, or leave `output` out";
        out.push(Diagnostic::error("ST0222", message, named.graph.output_place()).help(help));
        return None;
    }
    found.map(|i| vec![(i, end.port.clone())])
}

/// Which nodes feed any, and which feed one of their own graph.
struct Followers {
    any: Vec<bool>,
    own: Vec<bool>,
}

impl Followers {
    fn of(collected: &Collected) -> Self {
        let none = vec![false; collected.nodes.len()];
        let mut followers = Self { any: none.clone(), own: none };
        for link in &collected.links {
            followers.any[link.from] = true;
            followers.own[link.from] |= collected.nodes[link.from].graph == collected.nodes[link.to].graph;
        }
        followers
    }

    /// Whether a node ends the program of its graph: it feeds nothing, or is a lamp that feeds only other graphs.
    fn ends(&self, node: usize, collected: &Collected) -> bool {
        let lamp = || collected.nodes[node].definition.as_deref().is_some_and(is_lamp);
        !self.any[node] || (!self.own[node] && lamp())
    }
}

fn finish(
    graphs: &[NamedGraph],
    index: usize,
    port: Option<&str>,
    collected: &Collected,
    nodes: &[Option<Node>],
    conversions: &Conversions,
    out: &mut Vec<Diagnostic>,
) -> Option<Root> {
    let node = nodes[index].as_ref()?;
    if is_surface(&node.definition) && port.is_none() {
        // A light that is misspelt does not shine either, but that is said already.
        let doubtful = collected.nodes.iter().any(super::Found::is_doubtful);
        if is_lit(&node.definition) && node.lights.is_empty() && !doubtful {
            let message = format!("no light shines on `{}`: only its ambient part is seen", node.id);
            let help = "link a light to it, give the file of a light as well, or add a light to the scene";
            out.push(Diagnostic::warning("ST0223", message, collected.place(index)).help(help));
        }
        return Some(Root::Surface { node: index });
    }
    let Some(output) = node.definition.main.outputs.iter().find(|o| port.is_none_or(|p| p == o.name)) else {
        let names: Vec<&str> = node.definition.main.outputs.iter().map(|o| o.name.as_str()).collect();
        let wanted = port.unwrap_or_default();
        let error = Diagnostic::error(
            "ST0222",
            format!("`{}` has no output `{wanted}`", node.id),
            graphs[collected.nodes[index].graph].graph.output_place().node(&*node.id),
        );
        out.push(suggest(error, wanted, &names, "its outputs are"));
        return None;
    };
    let color = Type::new(Meaning::of(Kind::Color), Shape::F32(3));
    let number = Type::new(Meaning::of(Kind::Number), Shape::F32(3));
    let ty = node.output_type(output);
    if let Some(chain) = conversions.chain(&ty, &color).or_else(|| conversions.chain(&ty, &number)) {
        return Some(Root::Value { node: index, output: output.name.clone(), chain });
    }
    // Anything numeric can be looked at: what is missing is zero.
    let template = match ty.shape.width() {
        Some(2) => "vec3f($, 0.0)",
        Some(4) => "$.xyz",
        _ => {
            let message = format!("`{}.{}` is {ty} and cannot be shown", node.id, output.name);
            out.push(
                Diagnostic::error("ST0224", message, collected.place(index))
                    .help("link it to a node that makes a colour of it"),
            );
            return None;
        }
    };
    let step = crate::semantic::Step { template, to: number, label: "shown" };
    Some(Root::Value { node: index, output: output.name.clone(), chain: Rc::new(Chain { cost: 0, steps: vec![step] }) })
}

/// Lights without anything to shine on show what they deliver.
fn lamps_alone(
    graphs: &[NamedGraph],
    ends: &[(usize, Option<String>)],
    collected: &Collected,
    nodes: &[Option<Node>],
    out: &mut Vec<Diagnostic>,
) -> Option<Root> {
    let mut lights: std::collections::BTreeMap<usize, Vec<usize>> = std::collections::BTreeMap::new();
    for (end, _) in ends {
        for (light, shadows) in nodes[*end].as_ref().map(|n| &n.lights).into_iter().flatten() {
            lights.entry(*light).or_default().extend(shadows);
        }
    }
    if lights.is_empty() {
        if !collected.nodes.iter().any(|n| n.definition.is_none()) {
            let muted = graphs.iter().any(|g| !g.graph.nodes.is_empty());
            let why = if muted { "every node is muted" } else { "the graph has no nodes" };
            let place = graphs.first().map_or_else(Place::default, |g| g.graph.file_place());
            let error = Diagnostic::error("ST0225", format!("there is nothing to see: {why}"), place);
            let help = if muted { "unmute one" } else { "add a surface node: `\"matte\": (kind: \"lambert\")`" };
            out.push(error.help(help));
        }
        return None;
    }
    for shadows in lights.values_mut() {
        shadows.sort_unstable();
        shadows.dedup();
    }
    Some(Root::Irradiance { lights: lights.into_iter().collect() })
}
