//! Every light under every shadow on every surface, and every node by itself with every option: naga accepts all.
//! Tint accepts all as well.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use shadetree::compile::{Compiled, NamedGraph, Options};
use shadetree::diagnostic::SourceText;
use shadetree::module::Module;
use shadetree::node::{Definition, PassKind, Port};
use shadetree::plan::Plan;
use shadetree::semantic::{Kind, Shape};

use crate::support::{catalog, compiled, graph_text, kinds, prove};
use crate::tint;

fn accepted_by_tint(modules: &[(String, String)]) {
    let listed = modules.iter().map(|(name, wgsl)| (name.as_str(), wgsl.as_str()));
    if let Some(complaints) = tint::complaints(listed) {
        assert!(complaints.is_empty(), "{}", complaints.join("\n"));
    }
}

/// A custom node that gives exactly what a port wants.
fn feeder(port: &Port, shape: &Shape) -> String {
    let ty = shape.wgsl();
    let value = match shape {
        Shape::Bool => "true".to_owned(),
        Shape::Matrix(4) => {
            "mat4x4f(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)".to_owned()
        }
        Shape::Matrix(3) => "mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)".to_owned(),
        Shape::Matrix(_) => "mat2x2f(1.0, 0.0, 0.0, 1.0)".to_owned(),
        Shape::I32 | Shape::U32 => format!("{ty}(1)"),
        _ => format!("{ty}(0.5)"),
    };
    format!(
        "/// -> value ({}): What is wanted.\\nfn feed_{}() -> {ty} {{ return {value}; }}",
        port.ty.meaning, port.name
    )
}

/// A graph around one node that feeds all of its required inputs.
pub(crate) fn alone(definition: &Definition, options: &BTreeMap<String, String>, width: Option<u8>) -> NamedGraph {
    let mut nodes = String::new();
    let mut links = String::new();
    let mut params = String::new();
    let mut lit = false;
    for port in definition.inputs().filter(|p| !p.hidden) {
        let kind = port.ty.meaning.kind;
        lit |= port.ty.meaning.quantity == shadetree::semantic::Quantity::Irradiance;
        let shape = match (&port.ty.shape, width) {
            (Shape::Generic, Some(w)) => Shape::F32(w),
            (shape, _) => shape.clone(),
        };
        if kind == Kind::Texture {
            let _ = write!(params, "\"{}\": \"graphs/textures/tiles.png\",", port.name);
        } else if port.ty.meaning.quantity == shadetree::semantic::Quantity::Radiance {
            let _ = write!(nodes, "\"base_{0}\": (kind: \"unlit\"),", port.name);
            let _ = write!(links, "\"base_{0} -> node.{0}\",", port.name);
        } else if (port.default.is_none() && !(lit && matches!(kind, Kind::Direction | Kind::Distance | Kind::Color)))
            || (port.ty.shape == Shape::Generic && width.is_some())
        {
            let _ = write!(nodes, "\"feed_{}\": (kind: \"custom\", wgsl: \"{}\"),", port.name, feeder(port, &shape));
            let _ = write!(links, "\"feed_{0} -> node.{0}\",", port.name);
        }
    }
    let shadow = definition.header.category == "shadow";
    if lit || shadow {
        nodes.push_str("\"lamp\": (kind: \"spot_light\"),");
        links.push_str("\"lamp -> node\",");
    }
    let options: String = options.iter().map(|(k, v)| format!("\"{k}\": \"{v}\",")).collect();
    let text = format!(
        "Graph(version: 1, nodes: {{{nodes} \"node\": (kind: \"{}\", params: {{{params}}}, options: {{{options}}})}}, links: [{links}], output: \"node\")",
        definition.kind
    );
    graph_text("alone", &SourceText::new("alone.ron", text))
}

/// All choices of each option, one option at a time.
fn variations(definition: &Definition) -> Vec<BTreeMap<String, String>> {
    let mut all = vec![BTreeMap::new()];
    for option in &definition.header.options {
        let others = option.choices.iter().filter(|c| **c != option.default);
        all.extend(others.map(|c| BTreeMap::from([(option.name.clone(), c.clone())])));
    }
    all
}

#[test]
fn every_node_weaves_alone_with_every_option_and_width() {
    let mut modules = Vec::new();
    for kind in catalog().kinds() {
        let file = catalog().get(kind).expect("listed");
        let default = file.definition(&BTreeMap::new()).expect("embedded nodes are sound");
        for options in variations(&default) {
            let definition = file.definition(&options).expect("embedded nodes are sound");
            // An output that is no number or colour cannot be shown by itself.
            let shown = definition
                .main
                .outputs
                .first()
                .is_some_and(|o| matches!(o.ty.shape, Shape::F32(_) | Shape::Generic | Shape::Bool));
            if !shown {
                continue;
            }
            let widths: Vec<Option<u8>> = match definition.header.generic.as_slice() {
                [] => vec![None],
                shapes => shapes.iter().map(Shape::width).collect(),
            };
            for width in widths {
                let name = format!("{kind}-{}-{}", options.values().cloned().collect::<String>(), width.unwrap_or(0));
                let module = compiled(&[alone(&definition, &options, width)], &Options::default()).module;
                modules.push((name, module.wgsl));
            }
        }
    }
    accepted_by_tint(&modules);
}

/// Every fixed pass with every choice of each option: naga and Tint accept it.
#[test]
fn every_pass_is_accepted() {
    let (mut modules, mut kinds) = (Vec::new(), BTreeSet::new());
    for name in catalog().pass_names() {
        let pass = catalog().pass(name).expect("listed").expect("embedded passes are sound");
        for option in &pass.options {
            for choice in &option.choices {
                let choices = BTreeMap::from([(option.name.clone(), choice.clone())]);
                let wgsl = pass.text(&choices, catalog()).expect("embedded passes are sound");
                let name = format!("{name}-{}-{choice}", option.name);
                let entries: &[&str] =
                    if pass.kind == PassKind::Compute { &["cs_main"] } else { &["vs_main", "fs_main"] };
                let all = ["vs_main", "fs_main", "cs_main"];
                let found: Vec<&str> = all.into_iter().filter(|e| wgsl.contains(&format!("fn {e}("))).collect();
                assert_eq!(found, entries, "{name}");
                kinds.insert(pass.kind);
                let compiled =
                    Compiled { module: Module { wgsl: wgsl.clone(), ..Module::default() }, plan: Plan::default() };
                prove(&compiled, &name);
                modules.push((name, wgsl));
            }
        }
    }
    assert_eq!(kinds, PassKind::ALL.map(|(_, kind)| kind).into(), "a pass of each kind");
    accepted_by_tint(&modules);
}

#[test]
fn every_light_under_every_shadow_on_every_surface() {
    let (lights, shadows, surfaces) = (kinds("light"), kinds("shadow"), kinds("surface"));
    assert!(lights.len() >= 3 && shadows.len() >= 3 && surfaces.len() >= 10, "{lights:?} {shadows:?} {surfaces:?}");
    let program = |text: String, name: &str| graph_text(name, &SourceText::new(format!("{name}.ron"), text));
    let mut modules = Vec::new();
    for light in &lights {
        let maps = catalog().get(light).expect("listed").header().expect("sound").space.is_some();
        for shadow in shadows.iter().map(Some).chain([None]) {
            if shadow.is_some() && !maps {
                continue;
            }
            let chain = shadow.map_or_else(
                || format!("Graph(version: 1, nodes: {{\"lamp\": (kind: \"{light}\")}}, links: [])"),
                |s| format!("Graph(version: 1, nodes: {{\"lamp\": (kind: \"{light}\"), \"shade\": (kind: \"{s}\")}}, links: [\"lamp -> shade\"])"),
            );
            for surface in &surfaces {
                let definition = catalog().get(surface).expect("listed").definition(&BTreeMap::new()).expect("sound");
                let mut nodes = format!("\"body\": (kind: \"{surface}\"),");
                let mut links = String::new();
                for port in
                    definition.inputs().filter(|p| p.ty.meaning.quantity == shadetree::semantic::Quantity::Radiance)
                {
                    let _ =
                        write!(nodes, "\"under_{0}\": (kind: \"lambert\", params: {{\"albedo\": 0.5}}),", port.name);
                    let _ = write!(links, "\"under_{0} -> body.{0}\",", port.name);
                }
                let material = format!("Graph(version: 1, nodes: {{{nodes}}}, links: [{links}])");
                let graphs = [program(chain.clone(), "light"), program(material, "material")];
                let module = compiled(&graphs, &Options::default()).module;
                let name = format!("{light}-{}-{surface}", shadow.map_or("none", String::as_str));
                modules.push((name, module.wgsl));
            }
        }
    }
    println!("{} triples of light, shadow and surface", modules.len());
    accepted_by_tint(&modules);
}
