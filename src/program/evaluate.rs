//! Calls of node functions: arguments from wires, in the context of a light or of none.

use super::{Bake, Id, MapDemand, Op, Parameter, Program, Resource, sampler_settings};
use crate::module::stored;
use crate::node::{Default, Definition, Port, rename};
use crate::semantic::{Chain, Kind, Quantity, Shape, Value};
use crate::weave::{Node, Wire, Woven, is_light, is_shadow, is_surface};

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

    /// What an output of another node is under the light in context, if it has a value of its own there.
    fn under_light(&self, node: usize, position: usize) -> Option<Id> {
        self.worth[node].lit.get(&self.light?)?.get(position).copied()
    }

    /// What a surface contributes here to one that combines it: its share under the light in context, or its ambient part.
    /// Nothing is darkness.
    fn contribution(&self, node: usize, output: &str) -> Option<Id> {
        let definition = &self.woven.nodes[node].definition;
        match self.light {
            Some(_) => self.under_light(node, position(&definition.main, output)?),
            None => self.worth[node].plain.as_ref()?.get(plain_position(definition, output)?).copied(),
        }
    }
}

fn position(function: &crate::node::Function, output: &str) -> Option<usize> {
    function.outputs.iter().position(|o| o.name == output)
}

/// Where an output stands in what a node is worth under no light.
fn plain_position(definition: &Definition, output: &str) -> Option<usize> {
    position(definition.ambient.as_ref().unwrap_or(&definition.main), output)
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
            _ if definition.header.vertex && arguments.len() == 1 => Op::Interpolated,
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
        let combined = combines(&node.definition, port);
        let Some(wire) = node.inputs.get(&port.name) else {
            return combined.then(|| self.zero(&self.shape_of(context.index, port)));
        };
        match wire {
            Wire::Output { node: from, output, chain } if combined => Some(match context.contribution(*from, output) {
                Some(value) => self.converted(value, chain, origin, &port.name),
                None => self.zero(&self.shape_of(context.index, port)),
            }),
            Wire::Output { node: from, output, chain } => {
                let value = self.value(context, *from, output);
                Some(self.converted(value, chain, origin, &port.name))
            }
            Wire::Light { output, chain } => {
                let value = self.value(context, context.light?, output);
                Some(self.converted(value, chain, origin, &port.name))
            }
            Wire::Irradiance => {
                let light = context.light?;
                // A light that shines on what lies under this layer, but not on the layer.
                let Some(shadows) = node.lights.get(&light) else {
                    return Some(self.zero(&self.shape_of(context.index, port)));
                };
                let shadows: Vec<usize> = shadows.iter().copied().filter(|s| *s != context.index).collect();
                self.irradiance(context, light, &shadows)
            }
            // What shines without a light is part of what is seen without one.
            Wire::Value(_) if combined && context.light.is_some() => {
                Some(self.zero(&self.shape_of(context.index, port)))
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

    /// What an output is worth to an input that takes it as a value, under the light in context or without one: never
    /// nothing. A surface is all that is seen of it, the same under every light. Another value that is not the same under
    /// every light is, where none of those lights is in context, their sum if it is an amount of light, else their mean.
    pub(crate) fn value(&mut self, context: &Context<'_>, node: usize, output: &str) -> Id {
        let from = &context.woven.nodes[node];
        let definition = &from.definition;
        let worth = &context.worth[node];
        let place = position(&definition.main, output).unwrap_or(0);
        let plain = worth.plain.as_ref().and_then(|o| o.get(plain_position(definition, output)?)).copied();
        let seen = is_seen(definition, output);
        if let Some(value) = context.under_light(node, place).or(plain).filter(|_| !seen) {
            return value;
        }
        let port = &definition.main.outputs[place];
        let shape = from.output_type(port).shape;
        let mut terms: Vec<Id> = worth.lit.values().filter_map(|outputs| outputs.get(place)).copied().collect();
        terms.extend(plain.filter(|_| seen));
        let numeric = matches!(shape, Shape::F32(_));
        if !numeric {
            terms.truncate(1);
        }
        let amount = matches!(port.ty.meaning.quantity, Quantity::Radiance | Quantity::Irradiance | Quantity::Emission);
        let name = format!("{}_{output}", self.nodes[node].short);
        match terms[..] {
            [] => self.zero(&shape),
            [one] => one,
            _ => {
                let slots: Vec<String> = (0..terms.len()).map(|i| format!("${i}")).collect();
                let total = slots.join(" + ");
                let text = if amount { total } else { format!("({total}) / {}.0", terms.len()) };
                let id = self.template(&text, terms, &name, None);
                self.shaped(id, shape)
            }
        }
    }

    /// Nothing of this shape.
    pub(crate) fn zero(&mut self, shape: &Shape) -> Id {
        let text = match shape {
            Shape::Bool => "false".to_owned(),
            Shape::I32 => "0i".to_owned(),
            Shape::U32 => "0u".to_owned(),
            Shape::F32(1) => "0.0".to_owned(),
            Shape::F32(_) => format!("{}(0.0)", shape.wgsl()),
            _ => format!("{}()", shape.wgsl()),
        };
        self.literal(&text, "zero")
    }

    /// What a shadow says where nothing casts.
    pub(crate) fn unit(&mut self, definition: &Definition) -> Id {
        let scalar = definition.main.outputs[0].ty.shape.width() == Some(1);
        self.literal(if scalar { "1.0" } else { "vec3f(1.0)" }, "lit")
    }

    pub(crate) fn literal(&mut self, text: &str, name: &str) -> Id {
        self.add(Op::Literal(text.into()), Vec::new(), name, None)
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
        let mut factors = vec![self.value(context, light, &output.name)];
        let mut shadows = shadows.to_vec();
        shadows.sort_by(|a, b| self.nodes[*a].id.cmp(&self.nodes[*b].id));
        factors.extend(self.visibilities(context.worth, light, &shadows).into_iter().map(|(_, visibility)| visibility));
        let name = format!("{}_irradiance", self.nodes[light].short);
        self.fold("*", &factors, &name)
    }

    /// What shadows say under a light, each with its node; nothing where they are left out.
    pub(crate) fn visibilities(&self, worth: &[Worth], light: usize, shadows: &[usize]) -> Vec<(usize, Id)> {
        let of = |shadow: &usize| Some((*shadow, *worth[*shadow].lit.get(&light)?.first()?));
        shadows.iter().filter(|_| !self.unshadowed).filter_map(of).collect()
    }

    /// Colours joined by an operator, if there are any: irradiance and visibility are summed and multiplied as such.
    pub(crate) fn fold(&mut self, operator: &str, operands: &[Id], name: &str) -> Option<Id> {
        if operands.len() < 2 {
            return operands.first().copied();
        }
        let slots: Vec<String> = (0..operands.len()).map(|i| format!("${i}")).collect();
        let id = self.template(&slots.join(&format!(" {operator} ")), operands.to_vec(), name, None);
        Some(self.shaped(id, Shape::F32(3)))
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

/// Whether what feeds an input is combined, light by light and ambient part by ambient part, into a surface.
pub(crate) fn combines(definition: &Definition, port: &Port) -> bool {
    let meaning = port.ty.meaning;
    is_surface(definition) && meaning.quantity == Quantity::Radiance && meaning.kind == Kind::Color
}

/// Whether a surface combines others.
pub(crate) fn takes_surfaces(definition: &Definition) -> bool {
    definition.main.inputs.iter().any(|port| combines(definition, port))
}

/// Whether an output is what is seen of a surface.
pub(crate) fn is_seen(definition: &Definition, output: &str) -> bool {
    is_surface(definition) && definition.output(output).is_some_and(|o| o.ty.meaning.quantity == Quantity::Radiance)
}
