//! What is said where ports do not go together, and what to do about it.

use super::{NEVER, Offer, Work, short};
use crate::diagnostic::Diagnostic;
use crate::node::Port;
use crate::semantic::{Kind, Quantity, Shape, Type};
use crate::weave::{Link, is_light};

impl Work<'_> {
    pub(super) fn mismatch(&self, link: &Link, port: &Port) -> Diagnostic {
        let from = self.done[link.from].as_ref().expect("checked by the caller");
        let outputs: Vec<&Port> = from
            .definition
            .main
            .outputs
            .iter()
            .filter(|o| link.from_port.as_ref().is_none_or(|n| *n == o.name))
            .collect();
        let offered = outputs.iter().map(|o| format!("`{}` is {}", o.name, from.output_type(o))).collect::<Vec<_>>();
        let message = format!(
            "`{}` cannot feed `{}.{}`: {}, and {} is wanted",
            from.id,
            self.found.id,
            port.name,
            offered.join(", "),
            port.ty
        );
        let help = outputs.first().and_then(|o| missing_conversion(&from.output_type(o), &port.ty));
        let error = Diagnostic::error("ST0213", message, self.collected.link_place(link));
        match help {
            Some(help) => error.help(help),
            None => error.help("put a node between them that makes the one from the other"),
        }
    }

    pub(super) fn contributes_nothing(&self, link: &Link, free: &[&Port]) -> Diagnostic {
        let from = self.done[link.from].as_ref().expect("only resolved neighbours are open");
        let message = format!("`{}` contributes nothing to `{}`", from.id, self.found.id);
        let mut error = Diagnostic::error("ST0215", message, self.collected.link_place(link));
        let given =
            from.definition.main.outputs.iter().filter(|o| link.from_port.as_ref().is_none_or(|n| *n == o.name));
        for output in given {
            error = error.note(format!("`{}.{}` is {}", from.id, output.name, from.output_type(output)));
        }
        for port in free {
            error = error.note(format!("`{}.{}` wants {}", self.found.id, port.name, port.ty));
        }
        if free.is_empty() {
            let nothing = if is_light(&from.definition) { "takes no light" } else { "has no free input" };
            error = error.note(format!("`{}` ({}) {nothing}", self.found.id, self.definition.kind));
        }
        let primary = from.definition.main.outputs.first().map(|o| from.output_type(o));
        let near = free.iter().find_map(|p| missing_conversion(primary.as_ref()?, &p.ty));
        error.help(near.unwrap_or_else(|| "remove the link, or put a node between them that converts".to_owned()))
    }

    #[allow(clippy::too_many_arguments, reason = "one message about one assignment")]
    pub(super) fn ambiguous(
        &self,
        open: &[&Link],
        free: &[&Port],
        offers: &[Vec<Option<Offer<'_>>>],
        cost: &[Vec<u64>],
        row: usize,
        one: usize,
        other: usize,
    ) -> Diagnostic {
        let from = &self.collected.nodes[open[row].from];
        let message = format!(
            "`{}` could feed `{}` or `{}` of `{}`, and nothing tells which",
            from.id, free[one].name, free[other].name, self.found.id
        );
        let mut error = Diagnostic::error("ST0216", message, self.collected.link_place(open[row]));
        let mut candidates: Vec<usize> = (0..free.len()).filter(|c| cost[row][*c] < NEVER).collect();
        candidates.sort_by_key(|c| cost[row][*c]);
        let equal = |c: &usize| *c == one || *c == other || cost[row][*c] == cost[row][one];
        let tied: Vec<usize> = candidates.iter().copied().filter(equal).take(4).collect();
        for column in candidates {
            let Some(offer) = &offers[row][column] else { continue };
            error = error.note(format!(
                "candidate `{}`, {}, conversion cost {}",
                free[column].name, free[column].ty, offer.chain.cost
            ));
        }
        let (source, target) = (short(&from.id), short(&self.found.id));
        let text = match &open[row].from_port {
            Some(port) => format!("{source}.{port}"),
            None => source.to_owned(),
        };
        let pins: Vec<String> = tied.iter().map(|c| format!("`\"{text} -> {target}.{}\"`", free[*c].name)).collect();
        error.help(format!("pin one: {}", pins.join(" or ")))
    }

    pub(super) fn missing(&self, port: &Port, incoming: &[&Link]) -> Diagnostic {
        let message = format!("nothing feeds `{}` of `{}`, which needs {}", port.name, self.found.id, port.ty);
        let place = self.collected.place(self.index).port(&port.name);
        let mut error = Diagnostic::error("ST0217", message, place);
        for link in incoming.iter().filter(|l| l.to_port.is_none()).take(4) {
            let Some(node) = &self.done[link.from] else { continue };
            for output in &node.definition.main.outputs {
                error = error.note(format!("`{}.{}` gives {}", node.id, output.name, node.output_type(output)));
            }
        }
        let target = short(&self.found.id);
        let name = &port.name;
        let link = format!("link a node to it: `\"NODE -> {target}.{name}\"`");
        let example = match port.ty.shape {
            Shape::Texture => {
                return error.help(format!("name an image file: `params: {{\"{name}\": \"picture.png\"}}`"));
            }
            Shape::F32(1) | Shape::Generic => "0.5",
            Shape::F32(2) => "(0.5, 0.5)",
            Shape::F32(3) => "(0.5, 0.5, 0.5)",
            Shape::F32(4) => "(0.5, 0.5, 0.5, 1)",
            Shape::I32 | Shape::U32 => "3",
            Shape::Bool => "true",
            _ => return error.help(link),
        };
        error.help(format!("{link}, or give it a value: `params: {{\"{name}\": {example}}}`"))
    }
}

/// What a person has to insert where a conversion would lose something.
fn missing_conversion(from: &Type, to: &Type) -> Option<String> {
    let (a, b) = (from.meaning, to.meaning);
    let wide = from.shape.width().unwrap_or(1);
    let narrow = to.shape.width().unwrap_or(1);
    let numeric = |ty: &Type| matches!(ty.shape, Shape::F32(_));
    let text = match (a.kind, b.kind) {
        _ if a.quantity == Quantity::Radiance && b.quantity != Quantity::Radiance => {
            "radiance is seen, not reflected: take the colour from before the surface node, or mix surfaces with `mix_surface`"
        }
        (Kind::Color, Kind::Scalar | Kind::Number) if narrow == 1 => {
            "insert `luminance`, or `separate3` for one channel"
        }
        (Kind::Point, Kind::Vector | Kind::Direction) => "insert `subtract` to say from which point it leads",
        (Kind::Scalar | Kind::Number, Kind::Bool) => "insert `compare` to say from which value it is true",
        (_, Kind::Color) if b.quantity == Quantity::Radiance => "insert a surface node, such as `lambert` or `unlit`",
        _ if !numeric(from) || !numeric(to) => return None,
        _ if wide > narrow => return Some(format!("insert `separate{wide}` to choose components")),
        _ if wide < narrow => return Some(format!("insert `combine{narrow}` to build it from components")),
        _ => "insert a maths node such as `multiply_add`: what it gives may mean anything",
    };
    Some(text.to_owned())
}
