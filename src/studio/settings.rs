//! Overrides: `NODE.PORT=VALUE`, `NODE.NAME=VALUE` and `NODE=KIND`, as the command line takes them.

use super::failure::Failure;
use crate::compile::NamedGraph;
use crate::diagnostic::{Diagnostic, Place, did_you_mean};
use crate::node::Catalog;
use crate::semantic::Value;
use crate::view::commands::change_kind;

/// One override.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// Node, perhaps after its graph's name and a `/`.
    pub node: String,
    /// Port or option.
    pub name: String,
    /// What is right of the `=`.
    pub value: String,
    /// What it changes.
    pub target: Target,
}

/// What an assignment changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Target {
    /// The value of a port (`--set`).
    #[default]
    Port,
    /// A structural choice (`--option`).
    Option,
    /// The kind of the node itself (`--kind`).
    Kind,
    /// The same, and nothing is left that was set on the node: it is as if just added.
    Fresh,
}

/// Reads `NODE=KIND`. The error says what is wrong.
pub fn kind(text: &str) -> Result<Assignment, String> {
    match text.split_once('=').map(|(node, kind)| (node.trim(), kind.trim())) {
        Some((node, kind)) if !node.is_empty() && !kind.is_empty() => {
            Ok(Assignment { node: node.into(), name: "kind".into(), value: kind.into(), target: Target::Kind })
        }
        _ => Err("expected NODE=KIND, as in `shadow=pcf_shadow`".into()),
    }
}

impl std::str::FromStr for Assignment {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let split = text.split_once('=').and_then(|(path, value)| Some((path.trim().rsplit_once('.')?, value.trim())));
        match split {
            Some(((node, name), value)) if !node.is_empty() && !name.is_empty() && !value.is_empty() => {
                Ok(Self { node: node.into(), name: name.into(), value: value.into(), target: Target::Port })
            }
            _ => Err("expected NODE.NAME=VALUE, as in `spot.position=(1, 2, 3)`".into()),
        }
    }
}

impl Assignment {
    /// The value: `true`, `3`, `1,2,3`, `(1, 2, 3)`; anything else is a text, as a path.
    fn value(&self) -> Result<Value, String> {
        let text = self.value.as_str();
        match text {
            "true" => return Ok(Value::Bool(true)),
            "false" => return Ok(Value::Bool(false)),
            _ => {}
        }
        if let Some(inner) = text.strip_prefix('"').and_then(|t| t.strip_suffix('"')) {
            return Ok(Value::Text(inner.into()));
        }
        let tuple = text.strip_prefix('(').and_then(|t| t.strip_suffix(')'));
        let list = tuple.unwrap_or(text);
        let numbers: Result<Vec<f64>, _> = list.split(',').map(|x| x.trim().parse::<f64>()).collect();
        match numbers {
            Ok(n) if n.iter().all(|x| x.is_finite()) => Ok(Value::Numbers(n)),
            Ok(_) => Err(format!("`{text}` is not finite")),
            Err(_) if tuple.is_some() => Err(format!("`{text}` is not a list of numbers")),
            Err(_) => Ok(Value::Text(text.into())),
        }
    }
}

/// All overrides in the order in which they apply.
pub fn overrides(kinds: &[Assignment], set: &[Assignment], option: &[Assignment]) -> Vec<Assignment> {
    let options = option.iter().map(|a| Assignment { target: Target::Option, ..a.clone() });
    kinds.iter().chain(set).cloned().chain(options).collect()
}

/// Puts overrides into graphs, and those that name one of the stage's lights into these.
pub fn apply_on_stage(
    assignments: &[Assignment],
    graphs: &mut [NamedGraph],
    lights: &mut [NamedGraph],
    catalog: &Catalog,
) -> Result<(), Failure> {
    let of_stage = |a: &&Assignment| a.node.split_once('/').is_some_and(|(g, _)| lights.iter().any(|l| l.name == g));
    let (own, others): (Vec<&Assignment>, Vec<&Assignment>) = assignments.iter().partition(of_stage);
    let owned = |all: Vec<&Assignment>| all.into_iter().cloned().collect::<Vec<_>>();
    apply(&owned(own), lights, catalog)?;
    apply(&owned(others), graphs, catalog)
}

/// Puts overrides into the graphs that have such a node. Ports, options and types are checked when compiling.
pub fn apply(assignments: &[Assignment], graphs: &mut [NamedGraph], catalog: &Catalog) -> Result<(), Failure> {
    for assignment in assignments {
        let wrong = |message| {
            let place = Place::default().node(&assignment.node).port(&assignment.name);
            let help = "write a number, true or false, several numbers as (1, 2, 3), or a path";
            Diagnostic::error("ST0510", message, place).help(help)
        };
        let (flag, value) = match assignment.target {
            Target::Port => ("--set", assignment.value().map_err(|m| vec![wrong(m)])?),
            Target::Option => ("--option", Value::Bool(true)),
            Target::Kind | Target::Fresh => ("--kind", Value::Bool(true)),
        };
        let (graph, node) = match assignment.node.split_once('/') {
            Some((graph, node)) if graphs.iter().any(|g| g.name == graph) => (Some(graph), node),
            _ => (None, assignment.node.as_str()),
        };
        let mut found = false;
        for named in graphs.iter_mut().filter(|g| graph.is_none_or(|name| g.name == name)) {
            let Some(target) = named.graph.nodes.get_mut(node) else { continue };
            found = true;
            match assignment.target {
                Target::Port => drop(named.set.insert(format!("{node}.{}", assignment.name), value.clone())),
                Target::Option => drop(target.options.insert(assignment.name.clone(), assignment.value.clone())),
                Target::Fresh => {
                    target.kind.clone_from(&assignment.value);
                    target.params.clear();
                    target.options.clear();
                    named.set.retain(|path, _| path.rsplit_once('.').is_none_or(|(of, _)| of != node));
                }
                Target::Kind => {
                    change_kind(target, &assignment.value, catalog);
                    let kept = |path: &String| match path.rsplit_once('.') {
                        Some((of, port)) if of == node => catalog
                            .get(&target.kind)
                            .and_then(|f| f.definition(&target.options).ok())
                            .is_none_or(|d| d.input(port).is_some()),
                        _ => true,
                    };
                    named.set.retain(|path, _| kept(path));
                }
            }
        }
        if !found {
            let nodes = || graphs.iter().flat_map(|g| g.graph.nodes.keys().map(String::as_str));
            let diagnostic = Diagnostic::error(
                "ST0511",
                format!("{flag} names the node `{}`, which no graph has", assignment.node),
                Place::default().node(&assignment.node),
            );
            let help = match did_you_mean(node, nodes()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("nodes are: {}", nodes().take(20).collect::<Vec<_>>().join(", ")),
            };
            return Err(vec![diagnostic.help(help)].into());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<Value, String> {
        text.parse::<Assignment>()?.value()
    }

    #[test]
    fn values_are_read_as_graphs_write_them() {
        assert_eq!(value("a.b=true"), Ok(Value::Bool(true)));
        assert_eq!(value("a.b = 2.5"), Ok(Value::Numbers(vec![2.5])));
        assert_eq!(value("a.b=1, -2,3"), Ok(Value::Numbers(vec![1.0, -2.0, 3.0])));
        assert_eq!(value("g/a.b=(1,2)"), Ok(Value::Numbers(vec![1.0, 2.0])));
        assert_eq!(value("a.b=brick.png"), Ok(Value::Text("brick.png".into())));
        assert!(value("a.b=NaN").is_err() && value("a.b=(1,x)").is_err());
    }

    #[test]
    fn what_is_not_an_assignment_is_refused() {
        for text in ["", "a", "a.b", "a=1", ".b=1", "a.=1", "a.b="] {
            assert!(text.parse::<Assignment>().is_err(), "{text}");
        }
    }
}
