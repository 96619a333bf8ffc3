//! Joining signatures and port lines to functions that the weaver can call.

use std::collections::BTreeMap;

use super::conditional::Kept;
use super::definition::{Default, Function, Header, Port};
use super::items::{Declaration, Field, members, returned, signature};
use super::ports::{self, PortLine};
use super::report::{Piece, Report, lines};
use super::sources::source;
use super::tokens::is_reserved;
use crate::semantic::{Kind, Meaning, Shape, Type, Value};

/// What a function is read from.
pub(crate) struct Reader<'a> {
    pub(crate) kept: &'a Kept,
    pub(crate) declarations: &'a [Declaration],
    pub(crate) header: &'a Header,
    /// Whether every port must have a line.
    pub(crate) strict: bool,
}

impl Reader<'_> {
    /// Reads the function `declaration` with its port lines.
    pub(crate) fn function(&self, report: &mut Report, declaration: &Declaration) -> Option<Function> {
        let text = &self.kept.text;
        let at = |range| self.kept.original_range(range);
        let Some(signature) = signature(text, declaration) else {
            let message = format!("the signature of `{}` cannot be read", declaration.name);
            report.error("ST0124", at(declaration.name_range.clone()), message);
            return None;
        };
        let written = self.lines(report, declaration);
        let mut inputs = Vec::new();
        let mut lines: BTreeMap<&str, &PortLine> = BTreeMap::new();
        for line in written.iter().filter(|l| !l.output) {
            if lines.insert(&line.name, line).is_some() {
                report
                    .error("ST0117", line.name_range.clone(), format!("`{}` has two lines", line.name))
                    .help("remove one of them")
                    .port(&line.name);
            }
        }
        for field in &signature.parameters {
            let line = lines.remove(field.name.as_str());
            inputs.extend(self.port(report, field, line));
        }
        for (name, line) in lines {
            let near = crate::diagnostic::did_you_mean(name, signature.parameters.iter().map(|p| p.name.as_str()));
            report
                .error("ST0119", line.name_range.clone(), format!("`{}` takes no `{name}`", declaration.name))
                .suggest(near)
                .port(name);
        }
        let (outputs, result_struct) = self.outputs(report, declaration, signature.result.as_deref(), &written);
        let body = if self.header.inline { returned(text, signature.body) } else { None };
        Some(Function { name: declaration.name.clone(), inputs, outputs, result_struct, body })
    }

    /// The port lines right above a function; a line that begins with more than one space continues the one before.
    fn lines(&self, report: &mut Report, declaration: &Declaration) -> Vec<PortLine> {
        let above: Vec<Piece<'_>> = lines(&self.kept.text[..declaration.range.start]).collect();
        let mut found = Vec::new();
        for line in above.iter().rev() {
            let trimmed = line.trim();
            match trimmed.text.strip_prefix("///") {
                Some(rest) => found.push(trimmed.slice(trimmed.text.len() - rest.len()..trimmed.text.len())),
                None if trimmed.text.is_empty() || trimmed.text.starts_with("//") => {}
                None => break,
            }
            if trimmed.text.starts_with("//!") {
                break;
            }
        }
        found.reverse();
        let mut ports: Vec<PortLine> = Vec::new();
        for piece in found {
            let piece = Piece::new(piece.text, self.kept.original(piece.at));
            let indent = piece.text.len() - piece.text.trim_start().len();
            match ports.last_mut() {
                Some(port) if indent > 1 => {
                    port.doc.push(' ');
                    port.doc.push_str(piece.text.trim());
                }
                _ if self.strict || ports::looks_like_port(piece.text) => ports.extend(ports::parse(report, piece)),
                _ => {}
            }
        }
        ports
    }

    fn outputs(
        &self,
        report: &mut Report,
        declaration: &Declaration,
        result: Option<&str>,
        written: &[PortLine],
    ) -> (Vec<Port>, Option<String>) {
        let text = &self.kept.text;
        let place = self.kept.original_range(declaration.name_range.clone());
        let lines: Vec<&PortLine> = written.iter().filter(|l| l.output).collect();
        let Some(result) = result else {
            report
                .error("ST0135", place, format!("`{}` returns nothing", declaration.name))
                .help("a node computes something: write `-> f32` before the body, and `return` it");
            return (Vec::new(), None);
        };
        for (i, line) in lines.iter().enumerate() {
            if lines[..i].iter().any(|l| l.name == line.name) {
                report
                    .error("ST0117", line.name_range.clone(), format!("`{}` has two lines", line.name))
                    .help("remove one of them")
                    .port(&line.name);
            }
        }
        let structure = self.declarations.iter().find(|d| d.keyword == "struct" && d.name == result);
        if let Some(structure) = structure {
            let fields = members(text, structure);
            for line in &lines {
                if fields.iter().all(|f| f.name != line.name) {
                    report
                        .error("ST0119", line.name_range.clone(), format!("`{result}` has no `{}`", line.name))
                        .port(&line.name);
                }
            }
            let outputs = fields
                .iter()
                .filter_map(|f| self.port(report, f, lines.iter().copied().find(|l| l.name == f.name)))
                .collect();
            return (outputs, Some(result.to_owned()));
        }
        if self.strict && lines.is_empty() {
            report
                .error("ST0118", place.clone(), format!("what `{}` returns has no `/// ->` line", declaration.name))
                .help("add a line `/// -> name (meaning): What it is.`");
        }
        for extra in lines.iter().skip(1) {
            report
                .error("ST0119", extra.name_range.clone(), format!("`{}` returns one value", declaration.name))
                .help("remove this line, or return a struct with a member for each line")
                .port(&extra.name);
        }
        let line = lines.first().copied();
        let field = Field {
            name: line.map_or_else(|| "value".to_owned(), |l| l.name.clone()),
            range: declaration.name_range.clone(),
            ty: result.to_owned(),
        };
        // A single result has no name in WGSL, so any word will do.
        (self.port_of(report, &field, line).into_iter().collect(), None)
    }

    fn port(&self, report: &mut Report, field: &Field, line: Option<&PortLine>) -> Option<Port> {
        if is_reserved(&field.name) {
            let place = line.map_or_else(|| self.kept.original_range(field.range.clone()), |l| l.name_range.clone());
            report
                .error("ST0120", place, format!("`{}` is a word that WGSL keeps for itself", field.name))
                .help("give it another name")
                .port(&field.name);
        }
        if line.is_none() && self.strict {
            let place = self.kept.original_range(field.range.clone());
            report
                .error("ST0118", place, format!("`{}` has no port line", field.name))
                .help(format!("add a line `/// {} (meaning; = default): What it does.`", field.name))
                .port(&field.name);
            return None;
        }
        self.port_of(report, field, line)
    }

    fn port_of(&self, report: &mut Report, field: &Field, line: Option<&PortLine>) -> Option<Port> {
        let mut shape = Shape::from_wgsl(&field.ty);
        if shape == Shape::Generic && self.header.generic.is_empty() {
            shape = Shape::Named("T".into());
        }
        let Some(line) = line else {
            let meaning = Meaning::of(plain_kind(&shape));
            return Some(Port {
                name: field.name.clone(),
                ty: Type::new(meaning, shape),
                default: None,
                range: (None, None),
                unit: String::new(),
                hidden: false,
                doc: String::new(),
            });
        };
        if !carries(&shape, line.meaning.kind) {
            let message = format!("a `{}` cannot carry a {}", field.ty, line.meaning.kind.word());
            report.error("ST0136", line.meaning_range.clone(), message).port(&line.name);
        }
        self.default(report, line, &shape);
        Some(Port {
            name: field.name.clone(),
            ty: Type::new(line.meaning, shape),
            default: line.default.as_ref().map(|(d, _)| d.clone()),
            range: line.range,
            unit: line.unit.clone(),
            hidden: line.hidden,
            doc: line.doc.clone(),
        })
    }

    fn default(&self, report: &mut Report, line: &PortLine, shape: &Shape) {
        match &line.default {
            Some((Default::Value(value), place)) => {
                if !value.fits(shape) {
                    let message = format!("`{value}` does not fit a `{}`", shape.wgsl());
                    report.error("ST0114", place.clone(), message).port(&line.name);
                }
                if let Value::Numbers(numbers) = value
                    && numbers
                        .iter()
                        .any(|n| line.range.0.is_some_and(|low| *n < low) || line.range.1.is_some_and(|high| *n > high))
                {
                    let message = format!("the default `{value}` lies outside the range");
                    report.error("ST0116", place.clone(), message).port(&line.name);
                }
            }
            Some((Default::Source(name), place)) => {
                if let Some(source) = source(name).filter(|s| s.ty.shape != *shape) {
                    let message = format!("`@{name}` is a `{}`, the port a `{}`", source.ty.shape.wgsl(), shape.wgsl());
                    report.error("ST0115", place.clone(), message).port(&line.name);
                }
            }
            None => {
                let supplied = matches!(line.meaning.kind, Kind::Space | Kind::Map)
                    || self.header.maps.iter().any(|m| m.port == line.name)
                    || self.header.samplers.iter().any(|s| s.port == line.name);
                if line.hidden && !supplied {
                    report
                        .error(
                            "ST0137",
                            line.name_range.clone(),
                            format!("`{}` is hidden and has no default", line.name),
                        )
                        .help("only spaces, maps and samplers with a `sampler` line are supplied")
                        .port(&line.name);
                }
            }
        }
    }
}

/// What a port without a line means.
fn plain_kind(shape: &Shape) -> Kind {
    match shape {
        Shape::Bool => Kind::Bool,
        Shape::Matrix(_) => Kind::Matrix,
        Shape::Texture | Shape::DepthTexture => Kind::Texture,
        Shape::Sampler | Shape::ComparisonSampler => Kind::Sampler,
        _ => Kind::Number,
    }
}

/// Whether a shape can carry a kind at all. Named types are left to whoever named them.
fn carries(shape: &Shape, kind: Kind) -> bool {
    match kind {
        Kind::Bool => *shape == Shape::Bool,
        Kind::Matrix => matches!(shape, Shape::Matrix(_)),
        Kind::Sampler => matches!(shape, Shape::Sampler | Shape::ComparisonSampler),
        Kind::Texture => matches!(shape, Shape::Texture | Shape::DepthTexture | Shape::Named(_)),
        Kind::Map => matches!(
            shape,
            Shape::Texture | Shape::DepthTexture | Shape::Sampler | Shape::ComparisonSampler | Shape::Named(_)
        ),
        Kind::Space | Kind::Environment => true,
        Kind::Index => matches!(shape, Shape::I32 | Shape::U32 | Shape::F32(1) | Shape::Named(_)),
        Kind::Point | Kind::Vector | Kind::Direction | Kind::Normal | Kind::Texcoord => {
            matches!(shape, Shape::F32(2..) | Shape::Generic | Shape::Named(_))
        }
        Kind::Color => matches!(shape, Shape::F32(_) | Shape::Generic | Shape::Named(_)),
        Kind::Number | Kind::Scalar | Kind::Angle | Kind::Cosine | Kind::Distance | Kind::Depth => {
            matches!(shape, Shape::F32(_) | Shape::I32 | Shape::U32 | Shape::Generic | Shape::Named(_))
        }
    }
}
