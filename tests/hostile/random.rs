//! Random graphs over the whole catalogue. Whatever is wired to whatever: a shader that naga accepts, or errors that say
//! why not; never a panic, and never a rejected shader. `SHADETREE_CASES=20000` makes more cases.

use std::fmt::Write;

use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use shadetree::node::{Choices, Definition, Port};
use shadetree::semantic::{Conversions, Shape, Value};

use super::{fuzz::cases, make};
use crate::support::catalog;

/// A node to come: which kind, which choices, and dice for everything else.
#[derive(Clone, Debug)]
struct Draft {
    kind: u32,
    choices: Vec<u32>,
    dice: Vec<(u32, u32, u32)>,
}

fn drafts() -> impl Strategy<Value = Vec<Draft>> {
    let dice = proptest::collection::vec((any::<u32>(), any::<u32>(), any::<u32>()), 0..6);
    let draft = (any::<u32>(), proptest::collection::vec(any::<u32>(), 0..4), dice)
        .prop_map(|(kind, choices, dice)| Draft { kind, choices, dice });
    proptest::collection::vec(draft, 1..14)
}

fn pick<T>(from: &[T], die: u32) -> Option<&T> {
    from.get(die as usize % from.len().max(1))
}

/// A value that a port takes, by its shape and range.
fn value(port: &Port, die: u32) -> Option<Value> {
    let (low, high) = (port.range.0.unwrap_or(-4.0), port.range.1.unwrap_or(4.0));
    let (low, high) = (low.min(high), high.max(low));
    let at = |i: u32| {
        // The ends of the range are where shaders divide by nothing.
        let share = [0.0, 1.0, 0.5, 0.25][((die >> (2 * i)) % 4) as usize];
        low + (high - low) * share
    };
    Some(match &port.ty.shape {
        Shape::Bool => Value::Bool(die.is_multiple_of(2)),
        Shape::I32 | Shape::U32 => Value::Numbers(vec![at(0).floor().max(low.ceil())]),
        Shape::F32(n) => Value::Numbers((0..u32::from(*n)).map(at).collect()),
        Shape::Generic => Value::Numbers((0..=die % 4).map(at).collect()),
        Shape::Texture => Value::Text("tiles.png".into()),
        _ => return None,
    })
}

/// Writes the graph. `wild` links anything to anything; otherwise links lead where a conversion exists, so that more
/// of the graphs compile.
fn write(drafts: &[Draft], wild: bool) -> String {
    let kinds: Vec<&str> = catalog().kinds().collect();
    let conversions = Conversions::default();
    let mut nodes = String::new();
    let mut links = String::new();
    let mut made: Vec<std::sync::Arc<Definition>> = Vec::new();
    for (index, draft) in drafts.iter().enumerate() {
        let kind = kinds[draft.kind as usize % kinds.len()];
        let file = catalog().get(kind).expect("listed");
        let header = file.header().expect("built in");
        let mut choices = Choices::new();
        for (option, die) in header.options.iter().zip(&draft.choices) {
            choices.extend(pick(&option.choices, *die).map(|c| (option.name.clone(), c.clone())));
        }
        let definition = file.definition(&choices).expect("built in");
        let inputs: Vec<&Port> = definition.inputs().filter(|p| !p.hidden).collect();
        let mut params = Vec::new();
        let mut taken: Vec<&str> = Vec::new();
        for (what, port_die, value_die) in &draft.dice {
            let Some(port) = pick(&inputs, *port_die).filter(|p| !taken.contains(&p.name.as_str())) else { continue };
            match what % 4 {
                0 => {
                    if let Some(value) = value(port, *value_die) {
                        taken.push(&port.name);
                        params.push(format!("\"{}\": {value}", port.name));
                    }
                }
                // An abstract link. Most of them fit nothing.
                1 if index > 0 && (wild || what & 12 == 0) => {
                    let from = *value_die as usize % index;
                    let _ = writeln!(links, "\"n{from} -> n{index}\",");
                }
                // A pinned one.
                2 | 3 if index > 0 => {
                    let all: Vec<(usize, String)> = made
                        .iter()
                        .enumerate()
                        .flat_map(|(i, d)| d.main.outputs.iter().map(move |o| (i, o)))
                        .filter(|(_, o)| wild || conversions.chain(&o.ty, &port.ty).is_some())
                        .map(|(i, o)| (i, o.name.clone()))
                        .collect();
                    if let Some((from, output)) = pick(&all, *value_die) {
                        taken.push(&port.name);
                        let _ = match what & 16 {
                            0 => writeln!(links, "\"n{from}.{output} -> n{index}.{}\",", port.name),
                            _ => writeln!(links, "\"n{from} -> n{index}.{}\",", port.name),
                        };
                    }
                }
                _ => {}
            }
        }
        // What must be linked gets the newest node that can feed it.
        for port in inputs.iter().filter(|p| !wild && p.default.is_none() && !taken.contains(&p.name.as_str())) {
            let from = (0..index).rev().find_map(|i| {
                let output = made[i].main.outputs.iter().find(|o| conversions.chain(&o.ty, &port.ty).is_some())?;
                Some((i, output.name.clone()))
            });
            match from {
                Some((from, output)) => {
                    let _ = writeln!(links, "\"n{from}.{output} -> n{index}.{}\",", port.name);
                }
                None => params.extend(value(port, draft.kind).map(|v| format!("\"{}\": {v}", port.name))),
            }
        }
        let options: Vec<String> = choices.iter().map(|(k, v)| format!("\"{k}\": \"{v}\"")).collect();
        let _ = writeln!(
            nodes,
            "\"n{index}\": (kind: \"{kind}\", params: {{{}}}, options: {{{}}}),",
            params.join(", "),
            options.join(", ")
        );
        made.push(definition);
    }
    // Half of the wild graphs say what is seen, so that loose ends do not hide everything else.
    let output = match wild && drafts[0].choices.len().is_multiple_of(2) {
        false => format!(", output: \"n{}\"", drafts.len() - 1),
        true => String::new(),
    };
    // The same link twice is a mistake of its own.
    let mut lines: Vec<&str> = links.lines().collect();
    lines.sort_unstable();
    lines.dedup();
    format!("Graph(version: 1, nodes: {{\n{nodes}}}, links: [\n{}\n]{output})", lines.join("\n"))
}

fn property(wild: bool, usual: u32) {
    let mut runner = TestRunner::new(cases(usual));
    let mut counts = std::collections::BTreeMap::<String, u32>::new();
    let counted = std::cell::RefCell::new(&mut counts);
    let result = runner.run(&drafts(), |drafts| {
        let text = write(&drafts, wild);
        let made = make(&text);
        let mut counts = counted.borrow_mut();
        *counts.entry(if made.wgsl.is_some() { "works".into() } else { "fails".into() }).or_default() += 1;
        for d in &made.found {
            *counts.entry(d.code.into()).or_default() += 1;
        }
        Ok(())
    });
    result.unwrap_or_else(|e| panic!("{e}"));
    if std::env::var_os("SHADETREE_CASES").is_some() {
        let report = std::env::temp_dir().join(format!("shadetree_random_{wild}.txt"));
        std::fs::write(report, format!("{counts:#?}")).expect("written");
    }
    // A generator whose graphs never work would prove nothing.
    let works = counts.get("works").copied().unwrap_or(0);
    let share = if wild { 0.02 } else { 0.2 };
    assert!(f64::from(works) >= share * f64::from(usual), "only {works} of {usual} compile: {counts:?}");
}

#[test]
fn random_graphs_that_may_fit_compile_or_say_why_not() {
    property(false, 100);
}

#[test]
fn random_graphs_that_need_not_fit_compile_or_say_why_not() {
    property(true, 100);
}
#[test]
fn the_output_is_the_node_of_exactly_that_name() {
    // Names that end alike, and come first in the order of the graph.
    let text = "Graph(version: 1, nodes: {\"a pre_matte\": (kind: \"checker\"), \"matte\": (kind: \"unlit\"), \
                \"other matte\": (kind: \"color\")}, links: [\"a pre_matte.color -> matte.color\"], output: \"matte\")";
    let wgsl = make(text).works();
    assert!(wgsl.contains("// matte"), "{wgsl}");
}
