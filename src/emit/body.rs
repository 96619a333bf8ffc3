//! The fragment stage: one line per node, conversions in place.

use std::collections::BTreeMap;

use super::Reached;
use super::functions::Functions;
use super::names::Names;
use super::parts::{Division, divide};
use super::stages::varying;
use super::text::{Part, Text, is_atomic, parts};
use crate::module::Origin;
use crate::program::{Expression, Id, Op, Program, Resource};
use crate::semantic::Shape;

/// Calls longer than this take a line for each argument.
const LINE: usize = 92;

/// A printed expression with the origins of its parts, by bytes from its start.
#[derive(Clone, Default)]
struct Printed {
    text: String,
    origins: Vec<Origin>,
}

impl Printed {
    fn push(&mut self, text: &str) {
        self.text.push_str(text);
    }

    fn append(&mut self, other: &Printed) {
        let shift = self.text.len();
        self.text.push_str(&other.text);
        self.origins.extend(other.origins.iter().map(|o| Origin {
            start: o.start + shift,
            end: o.end + shift,
            ..o.clone()
        }));
    }
}

struct Printer<'a> {
    program: &'a Program,
    reached: &'a Reached,
    functions: &'a Functions,
    variables: &'a BTreeMap<Resource, String>,
    /// By parameter: the WGSL that reads it.
    reads: &'a [Option<String>],
    names: Names,
    /// What to write where an expression is used.
    printed: Vec<Printed>,
}

#[allow(clippy::too_many_arguments, reason = "the printer's whole input, handed over once")]
pub(crate) fn write_fragment(
    text: &mut Text,
    program: &Program,
    reached: &Reached,
    root: Id,
    functions: &Functions,
    variables: &BTreeMap<Resource, String>,
    reads: &[Option<String>],
    names: Names,
) {
    let printed = vec![Printed::default(); program.expressions.len()];
    let mut printer = Printer { program, reached, functions, variables, reads, names, printed };
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
    let color = printer.printed[root.0 as usize].clone();
    let start = text.len();
    text.push("    return vec4f(");
    let at = text.len();
    text.push(&color.text);
    for origin in color.origins {
        text.add(Origin { start: origin.start + at, end: origin.end + at, ..origin });
    }
    text.line(", 1.0);");
    if let Some(node) = program.get(root).origins.first() {
        text.origin(start, &program.nodes[*node].id, None);
    }
    text.line("}");
}

impl Printer<'_> {
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
                Op::Call(function) => self.functions.results.get(&function),
                _ => None,
            };
            let shape = || expression.shape.as_ref().map(Shape::wgsl).unwrap_or_default();
            let ty = result.cloned().unwrap_or_else(shape);
            text.line(&format!("var<private> {}: {ty};", self.printed[id.0 as usize].text));
        }
    }

    fn write(&mut self, text: &mut Text, id: Id, read_later: bool, last_comment: &mut String) {
        let program = self.program;
        let expression = program.get(id);
        let printed = self.print(expression);
        if !self.reached.has_line(program, id) {
            self.printed[id.0 as usize] = printed;
            return;
        }
        let comment = if expression.result { comment(program, expression) } else { String::new() };
        if expression.result && comment != *last_comment {
            text.line(&format!("    // {comment}"));
            *last_comment = comment;
        }
        let name = self.name(expression);
        let start = text.len();
        let declare = if read_later { "" } else { "let " };
        text.push(&format!("    {declare}{name} = "));
        let at = text.len();
        text.line(&format!("{};", printed.text));
        for node in &expression.origins {
            text.origin(start, &program.nodes[*node].id, expression.port.as_deref());
        }
        for origin in printed.origins {
            text.add(Origin { start: origin.start + at, end: origin.end + at, ..origin });
        }
        self.printed[id.0 as usize] = Printed { text: name, origins: Vec::new() };
    }

    fn name(&mut self, expression: &Expression) -> String {
        self.names.fresh(&expression.name.replace("_under_", "_"))
    }

    fn print(&self, expression: &Expression) -> Printed {
        let operand = |i: usize| expression.operands.get(i).map(|o| &self.printed[o.0 as usize]);
        let mut out = Printed::default();
        match &expression.op {
            Op::Template { text, .. } => {
                for part in parts(text) {
                    match part {
                        Part::Plain(plain) => out.push(plain),
                        Part::Slot(i, alone) => {
                            let Some(inner) = operand(i) else { continue };
                            if alone || is_atomic(&inner.text) {
                                out.append(inner);
                            } else {
                                out.push("(");
                                out.append(inner);
                                out.push(")");
                            }
                        }
                    }
                }
            }
            Op::Call(function) => {
                out.push(self.functions.names.get(function).map_or("", String::as_str));
                out.push("(");
                let inputs = &self.program.functions[*function].function().inputs;
                let length: usize = (0..expression.operands.len()).filter_map(operand).map(|o| o.text.len() + 2).sum();
                let broken = length + out.text.len() + expression.name.len() > LINE;
                for i in 0..expression.operands.len() {
                    match (broken, i) {
                        (true, _) => out.push("\n        "),
                        (false, 0) => {}
                        (false, _) => out.push(" "),
                    }
                    let start = out.text.len();
                    if let Some(inner) = operand(i) {
                        out.append(inner);
                    }
                    for node in &expression.origins {
                        let port = inputs.get(i).map(|p| p.name.clone());
                        let node = self.program.nodes[*node].id.clone();
                        out.origins.push(Origin { start, end: out.text.len(), node, port });
                    }
                    if broken || i + 1 < expression.operands.len() {
                        out.push(",");
                    }
                }
                out.push(if broken { "\n    )" } else { ")" });
            }
            Op::Member(name) => {
                if let Some(inner) = operand(0) {
                    out.append(inner);
                }
                out.push(".");
                out.push(name);
            }
            Op::Varying(v) => out.push(&format!("in.{}", varying(*v).0)),
            Op::Input("front_facing") => out.push("front_facing"),
            Op::Input(name) => out.push(&format!("in.{name}")),
            Op::Frame(name) => out.push(&format!("frame.{name}")),
            Op::Object(name) => out.push(&format!("object.{name}")),
            Op::Parameter(index) => out.push(self.reads.get(*index).and_then(Option::as_deref).unwrap_or_default()),
            Op::Literal(text) => out.push(text),
            Op::Resource(resource) => out.push(self.variables.get(resource).map_or("", String::as_str)),
        }
        out
    }
}

/// `node, other node: Label`, and the light it is evaluated under.
fn comment(program: &Program, expression: &Expression) -> String {
    let names: Vec<&str> = expression.origins.iter().map(|n| program.nodes[*n].id.as_str()).collect();
    let label = expression.origins.first().map_or("", |n| program.nodes[*n].label.as_str());
    let light = expression.light.map_or_else(String::new, |l| format!(", lit by {}", program.nodes[l].id));
    // Names may hold what would end a comment's line only if nobody checked them; labels are one line by their format.
    format!("{}: {label}{light}", names.join(", ")).replace(char::is_control, " ")
}
