//! Leading what names a subgraph on to the nodes inside it.

use std::collections::{BTreeMap, BTreeSet};

use super::expand::Stand;
use super::{End, Expose, Graph, MAX_LINKS, Setting, check};
use crate::diagnostic::{Diagnostic, Place, did_you_mean};

/// Most steps from an exposed name to what it stands for, over a whole graph: exposed names can fan out at every level.
const MAX_STEPS: usize = 10 * MAX_LINKS;

#[derive(Clone, Copy, PartialEq)]
enum What {
    Link,
    Param,
    Option,
}

pub(super) struct Router<'a> {
    stands: &'a BTreeMap<String, Stand>,
    flat: &'a mut Graph,
    found: &'a mut Vec<Diagnostic>,
    steps: usize,
}

impl<'a> Router<'a> {
    pub(super) fn new(
        stands: &'a BTreeMap<String, Stand>,
        flat: &'a mut Graph,
        found: &'a mut Vec<Diagnostic>,
    ) -> Self {
        Self { stands, flat, found, steps: 0 }
    }

    /// Whether exposed names fan out beyond what is followed.
    pub(super) fn exhausted(&self) -> bool {
        self.steps > MAX_STEPS
    }

    /// The end in place that a link from `end` starts at.
    pub(super) fn output(&mut self, mut end: End, place: &Place) -> Option<End> {
        while let Some(stand) = self.stands.get(&end.node) {
            let outputs = &stand.inner.expose.outputs;
            let inner = match &end.port {
                Some(port) => match outputs.get(port) {
                    Some(inner) => inner,
                    None => {
                        return self.not_exposed("output", port, &end.node, outputs.keys(), place);
                    }
                },
                None => match &stand.exported {
                    Some(inner) => inner,
                    None => return self.ambiguous("output", &end.node, outputs.keys(), place),
                },
            };
            end = within(&end.node, inner);
        }
        Some(end)
    }

    /// The ends in place that a link to `end` leads to.
    pub(super) fn inputs(&mut self, end: End, place: &Place) -> Vec<End> {
        self.lead(end, What::Link, place)
    }

    /// What the root exposes, in place.
    pub(super) fn expose(&mut self, expose: &Expose, place: &Place) -> Expose {
        let mut led = Expose { unknown: expose.unknown.clone(), ..Expose::default() };
        for (fans, out, what) in
            [(&expose.inputs, &mut led.inputs, What::Link), (&expose.options, &mut led.options, What::Option)]
        {
            for (public, ends) in fans {
                let ends = ends.iter().flat_map(|end| self.lead(end.clone(), what, place)).collect();
                out.insert(public.clone(), ends);
            }
        }
        for (public, end) in &expose.outputs {
            if let Some(end) = self.output(end.clone(), place) {
                led.outputs.insert(public.clone(), end);
            }
        }
        led
    }

    /// Sets the parameters and options of the node that stood at `full` inside it.
    pub(super) fn settings(&mut self, full: &str) {
        let Some(stand) = self.stands.get(full) else {
            return;
        };
        let Some(node) = stand.outer.nodes.get(&stand.name) else {
            return;
        };
        let mut set: BTreeMap<(bool, End), &String> = BTreeMap::new();
        let params = node.params.keys().map(|key| (key, What::Param));
        for (key, what) in params.chain(node.options.keys().map(|key| (key, What::Option))) {
            let setting = if what == What::Option { Setting::Option } else { Setting::Param };
            let mut place = stand.outer.setting_place(&stand.name, setting, key);
            place.node = Some(full.to_owned());
            let end = match key.split_once('.') {
                Some((inner, port)) => End::port(format!("{full}/{inner}"), port),
                None => End::port(full, key),
            };
            for target in self.lead(end, what, &place) {
                let Some(port) = &target.port else {
                    let message = format!("`{key}` leads to a whole node of `{full}`, which takes links and no value");
                    let help = "name a port as well where the file exposes it: `\"scale\": \"noise.scale\"`";
                    self.push(Diagnostic::error("ST0064", message, place.clone()).help(help));
                    continue;
                };
                let Some(inside) = self.flat.nodes.get_mut(&target.node) else {
                    let wanted = key.split_once('.').map_or(key.as_str(), |(node, _)| node);
                    let file = self.file(full);
                    let message = format!("`{key}` names the node `{wanted}`, which is not in the subgraph{file}");
                    let names: Vec<&str> = stand.inner.nodes.keys().map(String::as_str).collect();
                    let help = match did_you_mean(wanted, names.iter().copied()) {
                        Some(near) => format!("did you mean `{near}`?"),
                        None => format!("its nodes are {}", names.join(", ")),
                    };
                    self.push(Diagnostic::error("ST0064", message, place.clone()).help(help));
                    continue;
                };
                if what == What::Option {
                    let span = node.spans.options.get(key).cloned();
                    inside.options.extend(node.options.get(key).map(|value| (port.clone(), value.clone())));
                    inside.spans.options.remove(port);
                    inside.spans.options.extend(span.map(|span| (port.clone(), span)));
                    let name = node.spans.names.get(&(Setting::Option, key.clone())).cloned();
                    inside.spans.names.extend(name.map(|name| ((Setting::Option, port.clone()), name)));
                } else {
                    let span = node.spans.params.get(key).cloned();
                    inside.params.extend(node.params.get(key).map(|value| (port.clone(), value.clone())));
                    inside.spans.params.remove(port);
                    inside.spans.params.extend(span.map(|span| (port.clone(), span)));
                    let name = node.spans.names.get(&(Setting::Param, key.clone())).cloned();
                    inside.spans.names.extend(name.map(|name| ((Setting::Param, port.clone()), name)));
                }
                if let Some(other) = set.insert((what == What::Option, target.clone()), key) {
                    let message = format!("`{other}` and `{key}` both set `{target}`");
                    self.push(Diagnostic::error("ST0067", message, place.clone()).help("remove one of them"));
                }
            }
        }
    }

    /// Follows exposed names inwards until nothing stands for a subgraph any more.
    fn lead(&mut self, end: End, what: What, place: &Place) -> Vec<End> {
        let mut reached = BTreeSet::new();
        let mut seen = BTreeSet::from([end.clone()]);
        let mut open = vec![end];
        while let Some(end) = open.pop() {
            self.steps += 1;
            if self.exhausted() {
                break;
            }
            let Some(stand) = self.stands.get(&end.node) else {
                reached.insert(end);
                continue;
            };
            let expose = &stand.inner.expose;
            let (word, fans) = match what {
                What::Option => ("option", &expose.options),
                What::Param => ("parameter", &expose.inputs),
                What::Link => ("input", &expose.inputs),
            };
            let whole;
            let ends = match &end.port {
                Some(port) => match fans.get(port) {
                    Some(ends) => ends,
                    None => {
                        let _: Option<End> = self.not_exposed(word, port, &end.node, fans.keys(), place);
                        continue;
                    }
                },
                None => match (fans.len(), fans.values().next(), &stand.exported) {
                    (1, Some(ends), _) => ends,
                    (0, None, Some(end)) => {
                        whole = vec![End::node(&end.node)];
                        &whole
                    }
                    _ => {
                        let _: Option<End> = self.ambiguous(word, &end.node, fans.keys(), place);
                        continue;
                    }
                },
            };
            for inner in ends {
                let inner = within(&end.node, inner);
                if seen.insert(inner.clone()) {
                    open.push(inner);
                }
            }
        }
        reached.into_iter().collect()
    }

    /// The file that a subgraph was read from, in brackets.
    fn file(&self, stand: &str) -> String {
        let source = self.stands.get(stand).and_then(|s| s.inner.source.as_ref());
        source.map_or_else(String::new, |s| format!(" ({})", s.name))
    }

    fn push(&mut self, diagnostic: Diagnostic) {
        check::push(self.found, diagnostic, Place::default());
    }

    fn not_exposed<'b>(
        &mut self,
        what: &str,
        name: &str,
        node: &str,
        exposed: impl Iterator<Item = &'b String> + Clone,
        place: &Place,
    ) -> Option<End> {
        let message = format!("the subgraph `{node}`{} exposes no {what} `{name}`", self.file(node));
        let error = Diagnostic::error("ST0064", message, place.clone());
        let near = did_you_mean(name, exposed.clone().map(String::as_str));
        self.push(match near {
            Some(near) => error.help(format!("did you mean `{near}`?")),
            None => error.help(offered(exposed)),
        });
        None
    }

    fn ambiguous<'b>(
        &mut self,
        what: &str,
        node: &str,
        exposed: impl Iterator<Item = &'b String>,
        place: &Place,
    ) -> Option<End> {
        let message = format!("it is not clear which {what} of the subgraph `{node}`{} is meant", self.file(node));
        let names: Vec<String> = exposed.map(|name| format!("`{node}.{name}`")).take(20).collect();
        let help = match names.as_slice() {
            [] => format!("the file exposes no {what}; add one to its `expose`, or name its `output`"),
            names => format!("name one: {}", names.join(", ")),
        };
        self.push(Diagnostic::error("ST0065", message, place.clone()).help(help));
        None
    }
}

fn offered<'b>(exposed: impl Iterator<Item = &'b String>) -> String {
    let names: Vec<&str> = exposed.map(String::as_str).take(20).collect();
    match names.as_slice() {
        [] => "the file exposes none; add it to its `expose`".into(),
        names => format!("it exposes: {}", names.join(", ")),
    }
}

fn within(stand: &str, end: &End) -> End {
    End { node: format!("{stand}/{}", end.node), port: end.port.clone() }
}
