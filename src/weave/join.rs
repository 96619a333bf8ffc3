//! Joining light programs to surface programs, by type alone.
//!
//! A light program ends in lights or shadows that feed nothing. A surface program has nodes that take irradiance and
//! that no light of its own graph feeds. Given together, every end of the former is linked to every such node of the
//! latter, abstractly, exactly as a person would draw it.

use super::{Found, Link, LinkPlace, is_light, is_lit, is_shadow};
use crate::compile::NamedGraph;
use crate::diagnostic::Diagnostic;

pub(crate) fn join(graphs: &[NamedGraph], nodes: &[Found<'_>], links: &mut Vec<Link<'_>>, out: &mut Vec<Diagnostic>) {
    if graphs.len() < 2 {
        return;
    }
    let is = |i: usize, what: fn(&crate::node::Definition) -> bool| nodes[i].definition.as_deref().is_some_and(what);
    let lamp = |i: usize| is(i, is_light) || is(i, is_shadow);
    let mut feeds = vec![false; nodes.len()];
    let mut fed_by_lamp = vec![false; nodes.len()];
    for link in links.iter() {
        feeds[link.from] = true;
        fed_by_lamp[link.to] |= lamp(link.from);
    }
    let ends: Vec<usize> = (0..nodes.len()).filter(|&i| lamp(i) && !feeds[i]).collect();
    let lit: Vec<usize> = (0..nodes.len()).filter(|&i| is(i, is_lit) && !fed_by_lamp[i]).collect();
    for &to in &lit {
        for &from in ends.iter().filter(|&&from| nodes[from].graph != nodes[to].graph) {
            let place = LinkPlace::Joined { from, to };
            links.push(Link { from, from_port: None, to, to_port: None, place });
        }
    }
    if lit.is_empty() {
        for &end in &ends {
            let message = format!("the light `{}` meets no surface that takes light", nodes[end].id);
            let help = "give a graph with a surface node, or give this file alone";
            out.push(
                Diagnostic::warning("ST0210", message, graphs[nodes[end].graph].graph.place(nodes[end].name))
                    .help(help),
            );
        }
    }
}
