//! What the truth needs to know of a light and of the shadows on it, from the wiring of its graph.

use super::failure::{Failure, Listener};
use super::truth::{Wanted, no_truth};
use crate::module::stored;
#[cfg(feature = "render")]
use crate::node::Projection;
use crate::node::SpaceSpec;
use crate::reference::{Cut, Filter, Light, Taps, Weights, World, kernel};
use crate::weave::{Node, Root, Wire, Woven};

/// Fine texels along a texel unless said otherwise.
const FACTOR: u32 = 8;

/// Widest filter that a node's option can ask for: time grows with its square.
const MOST_WIDE: u32 = 256;

/// The light whose visibility is wanted, from the values of the inputs that its `space:` line names.
pub(super) fn light(woven: &Woven, world: &World) -> Result<Light, Failure> {
    let (node, _) = wanted(woven)?;
    let fail = |message: String, help: &str| no_truth(message, help, node.place());
    let Some(space) = &node.definition.header.space else {
        let message = format!("it is not known where the light `{}` shines from", node.id);
        return Err(fail(message, "take a light node that has a `space:` line, such as `spot_light`"));
    };
    let inputs = inputs(node, space)?;
    let message = |m: String| format!("the light `{}`: {m}", node.id);
    Light::projected(&space.projection, &inputs, world).map_err(|m| {
        fail(message(m), "the inputs named by the `space:` line of the light must be numbers that make sense")
    })
}

/// Where the maps of the light end, metres along their axes; none where they fit the scene.
#[cfg(feature = "render")]
pub(super) fn far(woven: &Woven) -> Result<Option<f64>, Failure> {
    let (node, _) = wanted(woven)?;
    let Some(space) = &node.definition.header.space else { return Ok(None) };
    let known = Projection::named(&space.projection);
    let Some(index) = known.and_then(|p| p.inputs.iter().position(|i| *i == "range")) else { return Ok(None) };
    Ok(inputs(node, space)?.get(index).and_then(|i| i.first()).copied())
}

/// The values of the inputs that a light's maps are made from, in metres and radians.
fn inputs(node: &Node, space: &SpaceSpec) -> Result<Vec<Vec<f64>>, Failure> {
    let value_of = |name: &String| match (node.inputs.get(name), node.definition.input(name)) {
        (Some(Wire::Value(value)), Some(port)) => Ok(stored(value, &port.ty.shape, &port.unit)),
        _ => {
            let message = format!("`{name}` of the light `{}` comes from a link", node.id);
            Err(no_truth(message, "the place of a light must be values: set it under `params`", node.place()))
        }
    };
    space.inputs_of(&node.definition).map(value_of).collect()
}

/// The filter of the first shadow on that light, from what its options named `size`, `width`, `weights` and `taps` say,
/// unless something else is wanted.
pub(super) fn filter(woven: &Woven, asked: &Wanted, listener: &dyn Listener) -> Result<Filter, Failure> {
    let (light, shadows) = wanted(woven)?;
    let Some(shadow) = shadows.first() else {
        let message = format!("the light `{}` has no shadow whose filter could be judged", light.id);
        return Err(no_truth(message, "link a shadow behind it, or use --reference rays", light.place()));
    };
    if shadows.len() > 1 {
        listener.note(&format!("`{}` has {} shadows; the filter is that of `{}`", light.id, shadows.len(), shadow.id));
    }
    let choices = &shadow.definition.choices;
    let option = |name: &str| choices.iter().find(|(n, _)| n == name).map(|(_, choice)| choice.as_str());
    let number = |name: &str, otherwise: u32| match option(name).map(str::parse) {
        None => Ok(otherwise),
        Some(Ok(number)) => Ok(number),
        Some(Err(_)) => {
            let message = format!("the option `{name}` of `{}` is not a number", shadow.id);
            Err(no_truth(message, "give the width with --kernel", shadow.place()))
        }
    };
    let width = match asked.kernel {
        Some(width) => width,
        None => number("width", 1)?.clamp(1, MOST_WIDE),
    };
    let weights = option("weights").and_then(|name| Weights::ALL.iter().find(|(n, _)| *n == name));
    let taps = match option("taps") {
        Some("nearest") => Taps::Nearest,
        Some(_) => Taps::Bilinear,
        // Filtered maps are read with interpolation; those without a filter are not.
        None => {
            if width > 1 {
                Taps::Bilinear
            } else {
                Taps::Nearest
            }
        }
    };
    Ok(Filter {
        kernel: kernel(weights.map_or(Weights::Box, |w| w.1), width as usize),
        taps,
        size: number("size", 1024)?.max(1),
        factor: asked.samples.unwrap_or(FACTOR),
    })
}

/// How the maps of the light are cut into parts, if they are.
pub(super) fn cut(woven: &Woven, side: u32) -> Result<Option<Cut>, Failure> {
    let (light, _) = wanted(woven)?;
    let definition = &light.definition;
    let space = definition.header.space.as_ref().filter(|s| s.projection == "orthographic");
    let Some((space, parts)) = space.map(|s| (s, s.views(definition))).filter(|(_, parts)| *parts > 1) else {
        return Ok(None);
    };
    let inputs = inputs(light, space)?;
    let number = |index: usize| inputs.get(index).and_then(|i| i.first()).copied().unwrap_or_default();
    Ok(Some(Cut {
        parts,
        balance: number(4),
        reach: number(5),
        stable: space.setting(definition, "fit") == "stable",
        blend: space.blends(definition),
        side,
    }))
}

/// The light that is wanted and the shadows on it.
fn wanted(woven: &Woven) -> Result<(&Node, Vec<&Node>), Failure> {
    match &woven.root {
        Root::Visibility { light, shadows } => {
            Ok((&woven.nodes[*light], shadows.iter().map(|s| &woven.nodes[*s]).collect()))
        }
        _ => Err(Failure::told()),
    }
}
