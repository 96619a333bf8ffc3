//! Which nodes of a graph can be swapped for a cheaper form of themselves.

use std::sync::Arc;

use crate::diagnostic::{Diagnostic, Place, Span, did_you_mean};
use crate::graph::Graph;
use crate::node::{Catalog, Choices, Form, Formula, Header};

/// A node in a cheaper form.
#[derive(Clone, Debug, PartialEq)]
pub struct Swap {
    /// The node.
    pub node: String,
    /// What is done to it.
    pub what: What,
    /// What that means, in words.
    pub doc: String,
}

/// What is done to a node.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// The option takes the choice.
    Choose(String, String),
    /// It becomes another kind, of which these ports take what the formulas over its own inputs say.
    Become(String, Vec<(String, Formula)>),
    /// What feeds the input stands in its place.
    Pass(String),
    /// Its outputs are what they come to on average.
    Mean,
    /// Its outputs are computed for each vertex.
    Vertex,
}

impl Swap {
    /// A name that tells it from all other swaps of a graph.
    pub fn name(&self) -> String {
        match &self.what {
            What::Choose(option, choice) => format!("{}: {option} = {choice}", self.node),
            What::Become(kind, _) => format!("{}: {kind}", self.node),
            What::Pass(input) => format!("{}: what feeds {input}", self.node),
            What::Mean => format!("{}: its mean", self.node),
            What::Vertex => format!("{}: for each vertex", self.node),
        }
    }
}

/// All swaps that nodes of a graph declare, in the order of the nodes and then of their declarations. Whether one can be
/// made shows when it is made.
pub fn swaps(graph: &Graph, catalog: &Catalog) -> Vec<Swap> {
    let mut found = Vec::new();
    for (name, node) in graph.nodes.iter().filter(|(_, node)| !node.muted && node.wgsl.is_none()) {
        let Some(header) = header(catalog, &node.kind) else { continue };
        for spec in &header.cheaper {
            let mut add = |what| found.push(Swap { node: name.clone(), what, doc: spec.doc.clone() });
            match &spec.form {
                Form::Option { name: option, choices } => {
                    let default = header.options.iter().find(|o| o.name == *option).map(|o| &o.default);
                    let Some(current) = node.options.get(option).or(default) else { continue };
                    let at = choices.iter().position(|c| c == current);
                    let rest = at.map_or(&[][..], |at| &choices[at + 1..]);
                    rest.iter().for_each(|choice| add(What::Choose(option.clone(), choice.clone())));
                }
                Form::Kind { kind, inputs } => add(What::Become(kind.clone(), inputs.clone())),
                Form::Input(input) => add(What::Pass(input.clone())),
                Form::Constant => add(What::Mean),
                Form::Vertex => add(What::Vertex),
            }
        }
    }
    found
}

fn header(catalog: &Catalog, kind: &str) -> Option<Arc<Header>> {
    catalog.get(kind)?.header().ok()
}

/// What is wrong with the cheaper forms that the nodes of a graph declare and that no file can know by itself: kinds and
/// ports of other files. Each such form is passed over.
pub fn check(graph: &Graph, catalog: &Catalog) -> Vec<Diagnostic> {
    let kinds: std::collections::BTreeSet<&String> = graph.nodes.values().map(|node| &node.kind).collect();
    kinds.into_iter().flat_map(|kind| check_kind(kind, catalog)).collect()
}

/// The same for one kind of node.
pub fn check_kind(kind: &str, catalog: &Catalog) -> Vec<Diagnostic> {
    let Some(header) = header(catalog, kind) else { return Vec::new() };
    let mut found = Vec::new();
    for spec in &header.cheaper {
        let Form::Kind { kind: other, inputs } = &spec.form else { continue };
        let place = || Place::span(Span::new(&header.source, spec.range.clone()));
        let Some(file) = catalog.get(other) else {
            let message = format!("a cheaper form of `{kind}` is the kind `{other}`, which does not exist");
            let help = match catalog.nearest(other) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "`shadetree nodes` lists all kinds".into(),
            };
            found.push(Diagnostic::warning("ST0752", message, place()).help(help));
            continue;
        };
        let Ok(definition) = file.definition(&Choices::new()) else { continue };
        for (port, _) in inputs.iter().filter(|(port, _)| definition.input(port).is_none_or(|p| p.hidden)) {
            let names: Vec<&str> = definition.inputs().filter(|p| !p.hidden).map(|p| p.name.as_str()).collect();
            let message = format!("a cheaper form of `{kind}` feeds `{port}`, which `{other}` does not have");
            let help = match did_you_mean(port, names.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("its inputs are {}", names.join(", ")),
            };
            found.push(Diagnostic::warning("ST0752", message, place()).help(help));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::SourceText;

    fn graph(text: &str) -> Graph {
        crate::graph::read(&SourceText::new("a.ron", text)).0.expect("a graph")
    }

    #[test]
    fn nodes_offer_what_is_cheaper_than_what_they_are() {
        let graph = graph(
            "Graph(version: 1, nodes: {\"m\": (kind: \"oren_nayar\"), \"n\": (kind: \"fbm3d\", options: {\"octaves\": \"3\"})})",
        );
        let names: Vec<String> = swaps(&graph, &Catalog::embedded()).iter().map(Swap::name).collect();
        assert_eq!(names, ["m: lambert", "n: octaves = 2", "n: octaves = 1", "n: its mean"]);
    }

    #[test]
    fn what_other_files_lack_is_told() {
        let with = |form: &str| {
            let text = format!(
                "//! label: A\n//! category: math\n//! cheaper: {form} - B.\n\n/// x (number): X.\n/// -> y (number): Y.\nfn a_node(x: f32) -> f32 {{ return x; }}\n"
            );
            let mut catalog = Catalog::embedded();
            assert_eq!(catalog.add_file("a_node.wgsl", &text), []);
            check_kind("a_node", &catalog)
        };
        for (form, expected) in [
            ("kind sinus", "the kind `sinus`, which does not exist"),
            ("kind sine(y = x)", "feeds `y`, which `sine` does not have"),
        ] {
            let found = with(form);
            assert!(found.len() == 1 && found[0].message.contains(expected) && found[0].help.is_some(), "{found:?}");
        }
        assert_eq!(with("kind sine(x = x)"), []);
    }

    #[test]
    fn every_declaration_of_the_catalogue_names_what_is_there() {
        let catalog = Catalog::embedded();
        let found: Vec<_> = catalog.kinds().flat_map(|kind| check_kind(kind, &catalog)).collect();
        assert_eq!(found, []);
        let declared = catalog.files().filter_map(|f| f.header().ok()).filter(|h| !h.cheaper.is_empty()).count();
        assert!(declared > 30, "{declared}");
    }
}
