//! What a light must have so that maps can be made in its space, and who may ask for them.

use std::collections::BTreeSet;

use super::collect::Collected;
use super::{Node, Wire, is_light, is_shadow};
use crate::diagnostic::Diagnostic;

/// Checks every light that carries a map: it has a projection, and that comes from values, not links, because the passes
/// run before the shader does. What asks for a map is on a light.
pub(crate) fn check(collected: &Collected<'_>, nodes: &[Option<Node>], out: &mut Vec<Diagnostic>) {
    let mut checked: BTreeSet<usize> = BTreeSet::new();
    for (index, node) in nodes.iter().enumerate() {
        let Some(node) = node else { continue };
        if !node.inputs.values().any(|w| matches!(w, Wire::Space | Wire::Map)) {
            continue;
        }
        // A shadow on no light has been reported.
        if is_light(&node.definition) || (node.lights.is_empty() && !is_shadow(&node.definition)) {
            let message =
                format!("`{}` ({}) asks for the space of a light and is on none", node.id, node.definition.kind);
            let help = "only shadows and surfaces with a light linked to them can ask for its space and its maps";
            out.push(Diagnostic::error("ST0211", message, collected.place(index)).help(help));
            continue;
        }
        for &light in node.lights.keys() {
            let Some(lamp) = nodes[light].as_ref().filter(|_| checked.insert(light)) else { continue };
            let Some(space) = &lamp.definition.header.space else {
                let message = format!("`{}` ({}) cannot carry the shadow `{}`", lamp.id, lamp.definition.kind, node.id);
                let help = "maps need a light with a `space:` line, such as `spot_light`, `point_light` or `directional_light`";
                out.push(Diagnostic::error("ST0226", message, collected.place(index)).help(help));
                continue;
            };
            for input in space.inputs_of(&lamp.definition) {
                if !matches!(lamp.inputs.get(input), Some(Wire::Value(_))) {
                    let message = format!(
                        "`{input}` of the light `{}` must be a value, because its maps are made from it",
                        lamp.id
                    );
                    let help = format!("remove the link to `{input}` and set it under `params`, or remove the shadow");
                    out.push(Diagnostic::error("ST0227", message, collected.place(light).port(input)).help(help));
                }
            }
        }
    }
}
