//! The fragment stage, and what the vertex stage computes for it: one line per node, conversions in place.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::Reached;
use super::functions::Functions;
use super::names::Names;
use super::parts::{Division, divide};
use super::rates::Stages;
use super::stages::varying;
use super::text::{Part, Text, is_atomic, parts};
use crate::program::{Expression, Id, Op, Program, Resource, Varying};
use crate::semantic::Shape;

/// Calls longer than this take a line for each argument.
const LINE: usize = 92;

/// What both stages name alike.
pub(crate) struct Tables<'a> {
    pub(crate) functions: &'a Functions,
    pub(crate) variables: &'a BTreeMap<Resource, String>,
    /// By parameter: the WGSL that reads it.
    pub(crate) reads: &'a [Option<String>],
}

struct Printer<'a> {
    program: &'a Program,
    reached: &'a Reached,
    tables: &'a Tables<'a>,
    /// What is read of what is interpolated, by name; what is not in here is computed where it is read.
    interpolated: BTreeMap<Id, &'a str>,
    /// In the vertex stage the local values of what meshes bring; elsewhere they are inputs.
    local: Option<BTreeMap<Varying, String>>,
    names: Names,
    /// What to write where an expression is used, unless [`Printer::leaf`] knows it.
    printed: Vec<Text>,
    /// Names of the inputs of each function in use.
    ports: BTreeMap<usize, Vec<Arc<str>>>,
}

/// Computes in the vertex stage what is interpolated beside what meshes bring.
pub(crate) fn write_interpolated(
    text: &mut Text,
    program: &Program,
    stages: &Stages,
    tables: &Tables<'_>,
    names: &Names,
) {
    if stages.interpolated.is_empty() {
        return;
    }
    let mut printer = Printer::new(program, &stages.vertex, tables, names.clone());
    let mut local = BTreeMap::new();
    for v in &stages.vertex.varyings {
        let (name, _, value) = varying(*v);
        let name = printer.names.fresh(name);
        text.line(&format!("    let {name} = {value};"));
        local.insert(*v, name);
    }
    printer.local = Some(local);
    printer.write_lines(text, &stages.vertex.order, None);
    for (id, (name, _)) in &stages.interpolated {
        let start = text.len();
        text.push(&format!("    out.{name} = "));
        program.get(*id).operands.iter().for_each(|operand| printer.append(text, *operand));
        text.push(";\n");
        for node in program.get(*id).origins.iter() {
            text.origin(start, &program.nodes[node].id, None);
        }
    }
}

pub(crate) fn write_fragment(
    text: &mut Text,
    program: &Program,
    stages: &Stages,
    root: Id,
    tables: &Tables<'_>,
    names: Names,
) {
    let reached = &stages.fragment;
    let mut printer = Printer::new(program, reached, tables, names);
    printer.interpolated = stages.interpolated.iter().map(|(id, (name, _))| (*id, name.as_str())).collect();
    let division = divide(program, reached, root);
    let (attribute, parameter, argument) = if reached.inputs.contains("front_facing") {
        (", @builtin(front_facing) front_facing: bool", ", front_facing: bool", ", front_facing")
    } else {
        ("", "", "")
    };
    let count = division.as_ref().map_or(0, |d| d.parts);
    let part_names: Vec<String> = (1..=count).map(|p| printer.names.fresh(&format!("part_{p}"))).collect();
    if let Some(division) = &division {
        let mut order = reached.order.iter().copied().peekable();
        for (part, name) in part_names.iter().enumerate() {
            // What has no line goes with the line after it.
            let mut ids = Vec::new();
            let belongs = |id: &Id| !reached.has_line(program, *id) || division.part_of(*id) <= part;
            while let Some(id) = order.next_if(belongs) {
                ids.push(id);
            }
            text.blank();
            text.line(&format!("fn {name}(in: Varyings{parameter}) {{"));
            printer.write_lines(text, &ids, Some(division));
            text.line("}");
            printer.write_variables(text, &ids, division);
        }
    }
    text.blank();
    text.line("@fragment");
    text.line(&format!("fn fs_main(in: Varyings{attribute}) -> @location(0) vec4f {{"));
    match &division {
        Some(division) => (0..division.parts).for_each(|p| text.line(&format!("    {}(in{argument});", part_names[p]))),
        None => printer.write_lines(text, &reached.order, None),
    }
    let start = text.len();
    text.push("    return vec4f(");
    printer.append(text, root);
    text.line(", 1.0);");
    if let Some(node) = program.get(root).origins.first() {
        text.origin(start, &program.nodes[node].id, None);
    }
    text.line("}");
}

impl<'a> Printer<'a> {
    fn new(program: &'a Program, reached: &'a Reached, tables: &'a Tables<'a>, names: Names) -> Self {
        let ports_of =
            |f: &usize| program.functions[*f].function().inputs.iter().map(|p| p.name.as_str().into()).collect();
        let ports = reached.functions.iter().map(|f| (*f, ports_of(f))).collect();
        let printed = vec![Text::default(); program.expressions.len()];
        Self { program, reached, tables, interpolated: BTreeMap::new(), local: None, names, printed, ports }
    }

    fn write_lines(&mut self, text: &mut Text, ids: &[Id], division: Option<&Division>) {
        let mut last_comment = String::new();
        for &id in ids {
            let read_later = division.is_some_and(|d| d.read_later[id.0 as usize]);
            self.write(text, id, read_later, &mut last_comment);
        }
    }

    /// The private variables for what later parts read of these.
    fn write_variables(&self, text: &mut Text, ids: &[Id], division: &Division) {
        text.blank();
        for id in ids.iter().filter(|id| division.read_later[id.0 as usize]) {
            let expression = self.program.get(*id);
            let result = match expression.op {
                Op::Call(function) => self.tables.functions.results.get(&function),
                _ => None,
            };
            let shape = || expression.shape.as_ref().map(Shape::wgsl).unwrap_or_default();
            let ty = result.cloned().unwrap_or_else(shape);
            text.line(&format!("var<private> {}: {ty};", self.printed[id.0 as usize].as_str()));
        }
    }

    fn write(&mut self, text: &mut Text, id: Id, read_later: bool, last_comment: &mut String) {
        let program = self.program;
        let expression = program.get(id);
        if !self.reached.has_line(program, id) {
            if self.leaf(expression).is_none() {
                let mut printed = Text::default();
                self.print(id, &mut printed);
                self.printed[id.0 as usize] = printed;
            }
            return;
        }
        if expression.result {
            let comment = comment(program, expression);
            if comment != *last_comment {
                text.push("    // ");
                text.line(&comment);
                *last_comment = comment;
            }
        }
        let name = if expression.name.contains("_under_") {
            self.names.fresh(&expression.name.replace("_under_", "_"))
        } else {
            self.names.fresh(&expression.name)
        };
        let start = text.len();
        text.push(if read_later { "    " } else { "    let " });
        text.push(&name);
        text.push(" = ");
        self.print(id, text);
        text.push(";\n");
        for node in expression.origins.iter() {
            text.origin(start, &program.nodes[node].id, expression.port.as_ref());
        }
        self.printed[id.0 as usize].push(&name);
    }

    /// What to write for an expression that is a word without parts.
    fn leaf<'e>(&'e self, expression: &'e Expression) -> Option<&'e str> {
        match &expression.op {
            Op::Parameter(index) => {
                Some(self.tables.reads[*index].as_deref().expect("what is reached is in the block"))
            }
            Op::Literal(text) => Some(text),
            Op::Resource(resource) => Some(self.tables.variables.get(resource).expect("what is reached is bound")),
            _ => None,
        }
    }

    /// What to write where an expression is used.
    fn used(&self, id: Id) -> &str {
        self.leaf(self.program.get(id)).unwrap_or_else(|| self.printed(id).as_str())
    }

    fn append(&self, out: &mut Text, id: Id) {
        match self.leaf(self.program.get(id)) {
            Some(leaf) => out.push(leaf),
            None => out.append(self.printed(id)),
        }
    }

    fn printed(&self, id: Id) -> &Text {
        let printed = &self.printed[id.0 as usize];
        assert!(printed.len() > 0, "operands come before what uses them");
        printed
    }

    fn print(&self, id: Id, out: &mut Text) {
        let expression = self.program.get(id);
        let operands = &expression.operands;
        match &expression.op {
            Op::Template { text, .. } => {
                for part in parts(text) {
                    match part {
                        Part::Plain(plain) => out.push(plain),
                        Part::Slot(i, alone) => {
                            let operand = operands[i];
                            if alone || is_atomic(self.used(operand)) {
                                self.append(out, operand);
                            } else {
                                out.push("(");
                                self.append(out, operand);
                                out.push(")");
                            }
                        }
                    }
                }
            }
            Op::Call(function) => self.print_call(*function, expression, out),
            Op::Member(name) => {
                operands.iter().for_each(|of| self.append(out, *of));
                out.push(".");
                out.push(name);
            }
            Op::Interpolated => match self.interpolated.get(&id) {
                Some(name) => word(out, "in.", name),
                None => operands.iter().for_each(|of| self.append(out, *of)),
            },
            Op::Varying(v) => match self.local.as_ref().and_then(|local| local.get(v)) {
                Some(name) => out.push(name),
                None => word(out, "in.", varying(*v).0),
            },
            Op::Input("front_facing") => out.push("front_facing"),
            Op::Input(name) => word(out, "in.", name),
            Op::Frame(name) => word(out, "frame.", name),
            Op::Object(name) => word(out, "object.", name),
            Op::Parameter(_) | Op::Literal(_) | Op::Resource(_) => out.push(self.leaf(expression).unwrap_or_default()),
        }
    }

    fn print_call(&self, function: usize, expression: &Expression, out: &mut Text) {
        let called = self.tables.functions.names.get(&function).expect("what is reached is declared");
        word(out, called, "(");
        let operands = &expression.operands;
        let ports = self.ports.get(&function);
        let length: usize = operands.iter().map(|o| self.used(*o).len() + 2).sum();
        let broken = length + called.len() + 1 + expression.name.len() > LINE;
        for (i, operand) in operands.iter().enumerate() {
            match (broken, i) {
                (true, _) => out.push("\n        "),
                (false, 0) => {}
                (false, _) => out.push(" "),
            }
            let start = out.len();
            self.append(out, *operand);
            for node in expression.origins.iter() {
                let port = ports.and_then(|p| p.get(i));
                out.origin(start, &self.program.nodes[node].id, port);
            }
            if broken || i + 1 < operands.len() {
                out.push(",");
            }
        }
        out.push(if broken { "\n    )" } else { ")" });
    }
}

fn word(out: &mut Text, first: &str, second: &str) {
    out.push(first);
    out.push(second);
}

/// `node, other node: Label`, and the light it is evaluated under.
fn comment(program: &Program, expression: &Expression) -> String {
    let mut out = String::with_capacity(64);
    for (i, node) in expression.origins.iter().enumerate() {
        if i > 0 {
            out.push_str(", ");
        }
        out.push_str(&program.nodes[node].id);
    }
    out.push_str(": ");
    out.push_str(expression.origins.first().map_or("", |n| program.nodes[n].definition.header.label.as_str()));
    if let Some(light) = expression.light {
        out.push_str(", lit by ");
        out.push_str(&program.nodes[light].id);
    }
    // Names may hold what would end a comment's line only if nobody checked them; labels are one line by their format.
    if out.contains(char::is_control) { out.replace(char::is_control, " ") } else { out }
}
