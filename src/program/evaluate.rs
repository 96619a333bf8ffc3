//! Calls of node functions: arguments from wires, in the context of a light or of none.

use super::{Bake, Id, MapDemand, Op, Parameter, Program, Resource, sampler_settings};
use crate::module::stored;
use crate::node::{Default, Definition, Port, rename};
use crate::semantic::{Chain, Kind, Quantity, Shape, Value};
use crate::weave::{Node, Wire, Woven, is_light, is_shadow};

use std::collections::BTreeMap;
use std::rc::Rc;

/// What a node is worth: one expression per output, without a light and under each light.
#[derive(Clone, Default)]
pub(crate) struct Worth {
    /// Under no light; for surfaces, the ambient part.
    pub(crate) plain: Option<Vec<Id>>,
    /// Under each light.
    pub(crate) lit: BTreeMap<usize, Vec<Id>>,
}

/// Everything a call needs to know.
pub(crate) struct Context<'a> {
    pub(crate) woven: &'a Woven,
    pub(crate) worth: &'a [Worth],
    /// Index of the node that is evaluated.
    pub(crate) index: usize,
    /// The light, if any.
    pub(crate) light: Option<usize>,
    /// A view of the light to be used instead of the one that sees the shaded point.
    pub(crate) view: Option<Id>,
}

impl Context<'_> {
    fn node(&self) -> &Node {
        &self.woven.nodes[self.index]
    }

    /// The outputs of another node as seen from here.
    fn outputs(&self, node: usize) -> Option<&[Id]> {
        let worth = &self.worth[node];
        let surface = self.woven.nodes[node].definition.main.outputs.first().map(|p| p.ty.meaning.quantity)
            == Some(Quantity::Radiance);
        let under = self.light.and_then(|l| worth.lit.get(&l));
        match under {
            Some(outputs) => Some(outputs),
            // The ambient part of a surface is not part of what it does under a light.
            None if surface && self.light.is_some() => None,
            None => worth.plain.as_deref(),
        }
    }

    fn output(&self, node: usize, name: &str) -> Option<Id> {
        let position = self.woven.nodes[node].definition.main.outputs.iter().position(|o| o.name == name)?;
        self.outputs(node)?.get(position).copied()
    }
}

impl Program {
    /// The outputs of a call of the main or the ambient function; none if an argument is missing in this context.
    pub(crate) fn call(&mut self, context: &Context<'_>, ambient: bool) -> Option<Vec<Id>> {
        let node = context.node();
        let definition = node.definition.clone();
        let function = match &definition.ambient {
            Some(function) if ambient => function,
            _ => &definition.main,
        };
        let mut arguments = Vec::with_capacity(function.inputs.len());
        for port in &function.inputs {
            arguments.push(self.argument(context, port)?);
        }
        let inline = function.body.as_ref().filter(|_| definition.header.inline);
        let index = self.function(&definition, node.generic.as_ref(), ambient);
        let name = self.result_name(context, function, ambient);
        let op = match inline {
            Some(body) => Op::Template { text: self.inline_text(index, body), function: Some(index) },
            None => Op::Call(index),
        };
        let id = self.add(op, arguments, &name, Some(context.index));
        let shape = match (&function.result_struct, function.outputs.first()) {
            (None, Some(output)) => Some(node.output_type(output).shape),
            _ => None,
        };
        let expression = &mut self.expressions[id.0 as usize];
        expression.shape = shape;
        expression.result = true;
        expression.light = context.light.filter(|_| !is_light(&node.definition) && !is_shadow(&node.definition));
        if function.result_struct.is_none() {
            return Some(vec![id]);
        }
        let member = |program: &mut Self, port: &Port| {
            program.add(Op::Member(port.name.as_str().into()), vec![id], "", Some(context.index))
        };
        Some(function.outputs.iter().map(|p| member(self, p)).collect())
    }

    fn argument(&mut self, context: &Context<'_>, port: &Port) -> Option<Id> {
        let node = context.node();
        let origin = Some(context.index);
        let radiance = port.ty.meaning.quantity == Quantity::Radiance;
        let Some(wire) = node.inputs.get(&port.name) else {
            return radiance.then(|| self.zero());
        };
        match wire {
            Wire::Output { node: from, output, chain } => match context.output(*from, output) {
                Some(value) => Some(self.converted(value, chain, origin, &port.name)),
                None if radiance => Some(self.zero()),
                None => None,
            },
            Wire::Light { output, chain } => {
                let value = context.output(context.light?, output)?;
                Some(self.converted(value, chain, origin, &port.name))
            }
            Wire::Irradiance => {
                let light = context.light?;
                // A light that shines on what lies under this layer, but not on the layer.
                let Some(shadows) = node.lights.get(&light) else { return Some(self.zero()) };
                let shadows: Vec<usize> = shadows.iter().copied().filter(|s| *s != context.index).collect();
                self.irradiance(context, light, &shadows)
            }
            Wire::Value(value) => Some(self.parameter(&node.definition, context.index, port, value)),
            Wire::Source(name) => Some(self.provided(context, name, port)),
            Wire::Space => {
                let light = context.light?;
                Some(context.view.unwrap_or_else(|| self.view_of_light(light, origin)))
            }
            Wire::Map => {
                let index = self.map(&node.definition, context.index, context.light?, port);
                let name = format!("{}_map", self.nodes[context.light?].short);
                Some(self.add(Op::Resource(Resource::Map(index)), Vec::new(), &name, origin))
            }
            Wire::Sampler => {
                let settings = sampler_settings(&node.definition, &port.name);
                Some(self.add(Op::Resource(Resource::Sampler(settings)), Vec::new(), &port.name, origin))
            }
            Wire::Image(path, base) => {
                let definition = &node.definition;
                let spec = definition.header.textures.iter().find(|t| t.port == port.name);
                let encoding = spec.and_then(|s| s.settings.iter().find(|(k, _)| k == "encoding"));
                let srgb = encoding.is_some_and(|(_, v)| definition.setting(v) == "srgb");
                let name = format!("{}_{}", self.nodes[context.index].short, port.name);
                let resource = Resource::Image { path: path.clone(), base: base.clone(), srgb, name: name.clone() };
                Some(self.add(Op::Resource(resource), Vec::new(), &name, origin))
            }
        }
    }

    /// The body of an inline function with `$i` for its parameters and `T` replaced.
    fn inline_text(&mut self, index: usize, body: &str) -> Rc<str> {
        if let Some(known) = self.inline_texts.get(&index) {
            return known.clone();
        }
        let instance = &self.functions[index];
        let inputs = &instance.function().inputs;
        let text = rename(body, &|word| match (word, &instance.generic) {
            ("T", Some(shape)) => Some(shape.wgsl()),
            _ => inputs.iter().position(|p| p.name == word).map(|i| format!("${i}")),
        });
        let text: Rc<str> = text.into();
        self.inline_texts.insert(index, text.clone());
        text
    }

    fn zero(&mut self) -> Id {
        self.add(Op::Literal("vec3f(0.0)".into()), Vec::new(), "zero", None)
    }

    /// A source converted to what the port wants: an interpolated normal is normalised here, once for all who ask.
    fn provided(&mut self, context: &Context<'_>, name: &str, port: &Port) -> Id {
        let id = self.source(name);
        let Some(source) = crate::node::source(name) else { return id };
        match self.conversions.chain(&source.ty, &port.ty) {
            Some(chain) => self.converted(id, &chain, Some(context.index), &port.name),
            None => id,
        }
    }

    /// The value after a chain of conversions.
    pub(crate) fn converted(&mut self, value: Id, chain: &Chain, origin: Option<usize>, port: &str) -> Id {
        let mut value = value;
        if chain.steps.is_empty() {
            return value;
        }
        let word = self.word(port);
        for step in &chain.steps {
            let base = self.name(value);
            let mut text = String::new();
            let mut operands = vec![value];
            // `$` is the value, `@name` a source.
            let mut rest = step.template;
            while let Some(at) = rest.find(['$', '@']) {
                text.push_str(&rest[..at]);
                if rest.as_bytes()[at] == b'$' {
                    text.push_str("$0");
                    rest = &rest[at + 1..];
                    continue;
                }
                let name_end =
                    rest[at + 1..].find(|c: char| !c.is_alphanumeric() && c != '_').map_or(rest.len(), |e| at + 1 + e);
                let source = self.source(&rest[at + 1..name_end]);
                let position = operands.iter().skip(1).position(|o| *o == source).map_or(operands.len(), |p| p + 1);
                if position == operands.len() {
                    operands.push(source);
                }
                text.push_str(&format!("${position}"));
                rest = &rest[name_end..];
            }
            text.push_str(rest);
            value = self.template(&text, operands, &format!("{base}_{}", step.label), None);
            let expression = &mut self.expressions[value.0 as usize];
            expression.shape = Some(step.to.shape.clone());
            expression.origins.extend(origin);
            if expression.port.is_none() {
                expression.port = Some(word.clone());
            }
        }
        value
    }

    /// What a light delivers after these shadows.
    pub(crate) fn irradiance(&mut self, context: &Context<'_>, light: usize, shadows: &[usize]) -> Option<Id> {
        let definition = &context.woven.nodes[light].definition;
        let output = definition.main.outputs.iter().find(|o| o.ty.meaning.quantity == Quantity::Irradiance)?;
        let here = Context { light: Some(light), ..*context };
        let mut factors = vec![here.output(light, &output.name)?];
        let mut shadows = shadows.to_vec();
        shadows.sort_by(|a, b| self.nodes[*a].id.cmp(&self.nodes[*b].id));
        factors.extend(self.visibilities(here.worth, light, &shadows).into_iter().map(|(_, visibility)| visibility));
        let name = format!("{}_irradiance", self.nodes[light].short);
        Some(self.fold("*", &factors, &name))
    }

    /// What shadows say under a light, each with its node; nothing where they are left out.
    pub(crate) fn visibilities(&self, worth: &[Worth], light: usize, shadows: &[usize]) -> Vec<(usize, Id)> {
        let of = |shadow: &usize| Some((*shadow, *worth[*shadow].lit.get(&light)?.first()?));
        shadows.iter().filter(|_| !self.unshadowed).filter_map(of).collect()
    }

    /// The operands joined by an operator.
    pub(crate) fn fold(&mut self, operator: &str, operands: &[Id], name: &str) -> Id {
        if let [one] = operands {
            return *one;
        }
        let slots: Vec<String> = (0..operands.len()).map(|i| format!("${i}")).collect();
        let id = self.template(&slots.join(&format!(" {operator} ")), operands.to_vec(), name, None);
        // Irradiance, radiance and visibility are summed and multiplied as colours.
        self.shaped(id, Shape::F32(3))
    }

    fn parameter(&mut self, definition: &Definition, node: usize, port: &Port, value: &Value) -> Id {
        let default = matches!(&port.default, Some(Default::Value(d)) if d == value);
        let constant = self.bake == Bake::All || (self.bake == Bake::Defaults && default);
        let constant = constant && !space_inputs(definition).contains(&port.name);
        if constant {
            let shape = self.shape_of(node, port);
            let text = literal(&shape, port, value);
            return self.add(Op::Literal(text.into()), Vec::new(), &port.name, Some(node));
        }
        let index = self.parameter_slot(node, port, value);
        self.add(Op::Parameter(index), Vec::new(), "", Some(node))
    }

    /// The name of an expression's value.
    fn name(&self, id: Id) -> Rc<str> {
        let expression = self.get(id);
        match &expression.op {
            Op::Parameter(index) => {
                let Parameter { node, port, .. } = &self.parameters[*index];
                format!("{}_{port}", self.nodes[*node].short).into()
            }
            Op::Member(member) => format!("{}_{member}", self.get(expression.operands[0]).name).into(),
            _ => expression.name.clone(),
        }
    }

    /// The index of the parameter for an input.
    pub(crate) fn parameter_slot(&mut self, node: usize, port: &Port, value: &Value) -> usize {
        if self.slots.len() <= node {
            self.slots.resize(self.nodes.len().max(node + 1), Vec::new());
        }
        if let Some(known) = self.slots[node].iter().find(|i| *self.parameters[**i].port == port.name) {
            return *known;
        }
        self.slots[node].push(self.parameters.len());
        let name = self.word(&port.name);
        self.parameters.push(Parameter { node, port: name, value: value.clone() });
        self.parameters.len() - 1
    }

    /// The shape of an input once `T` is chosen.
    pub(crate) fn shape_of(&self, node: usize, port: &Port) -> Shape {
        match (&port.ty.shape, &self.nodes[node].generic) {
            (Shape::Generic, Some(shape)) => shape.clone(),
            (shape, _) => shape.clone(),
        }
    }

    fn map(&mut self, definition: &Definition, node: usize, light: usize, port: &Port) -> usize {
        let spec = definition.header.maps.iter().find(|m| m.port == port.name);
        let passes: Vec<(String, BTreeMap<String, String>)> = spec
            .map(|s| s.passes.as_slice())
            .unwrap_or_default()
            .iter()
            .map(|(name, arguments)| {
                let resolved = arguments.iter().map(|(k, v)| (k.clone(), definition.setting(v).to_owned()));
                (name.clone(), resolved.collect())
            })
            .collect();
        let ty = port.ty.shape.wgsl();
        let filtered = !ty.starts_with("texture_depth")
            && definition
                .inputs()
                .any(|p| p.ty.shape == Shape::Sampler && sampler_settings(definition, &p.name).linear);
        if let Some(i) = self.maps.iter().position(|m| m.light == light && m.passes == passes && m.ty == ty) {
            self.maps[i].filtered |= filtered;
            return i;
        }
        self.maps.push(MapDemand { light, passes, ty, filtered, node, port: port.name.clone() });
        self.maps.len() - 1
    }

    /// A name for the result of a node: the node's, with the light's and the output's where they say more.
    fn result_name(&self, context: &Context<'_>, function: &crate::node::Function, ambient: bool) -> String {
        let node = context.node();
        let mut name = self.nodes[context.index].short.to_string();
        if let Some(light) = context.light
            && (!is_shadow(&node.definition) || node.lights.len() > 1)
            && !is_light(&node.definition)
        {
            name.push_str("_under_");
            name.push_str(&self.nodes[light].short);
        }
        if ambient {
            name.push_str("_ambient");
        }
        match function.outputs.as_slice() {
            [one]
                if function.result_struct.is_none()
                    && !matches!(one.name.as_str(), "value" | "result")
                    && !name.ends_with(&one.name) =>
            {
                name.push('_');
                name.push_str(&one.name);
            }
            _ => {}
        }
        name
    }
}

/// Inputs of a light that define the space of its maps.
pub(crate) fn space_inputs(definition: &Definition) -> &[String] {
    definition.header.space.as_ref().map_or(&[], |s| &s.inputs)
}

/// A value as WGSL.
pub(crate) fn literal(shape: &Shape, port: &Port, value: &Value) -> String {
    let numbers = stored(value, shape, &port.unit);
    #[allow(clippy::cast_possible_truncation, reason = "WGSL has no 64-bit numbers")]
    let float = |x: f64| format!("{:?}", x as f32);
    match (shape, numbers.as_slice()) {
        (Shape::Bool, [x, ..]) => (*x != 0.0).to_string(),
        (Shape::I32, [x, ..]) => format!("{x}i"),
        (Shape::U32, [x, ..]) => format!("{x}u"),
        (Shape::F32(1), [x, ..]) => float(*x),
        _ => {
            let parts: Vec<String> = numbers.iter().map(|x| float(*x)).collect();
            format!("{}({})", shape.wgsl(), parts.join(", "))
        }
    }
}

/// Whether a node of this kind is worth a call at all outside a light.
pub(crate) fn takes_surfaces(definition: &Definition) -> bool {
    definition
        .main
        .inputs
        .iter()
        .any(|p| p.ty.meaning.quantity == Quantity::Radiance && p.ty.meaning.kind == Kind::Color)
}
