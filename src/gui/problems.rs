//! The list of what is wrong. A click goes to the node.

use eframe::egui::{self, Ui};

use super::theme::Look;
use crate::diagnostic::{Diagnostic, Severity};

/// Shows the list. Answers the diagnostic whose place a person wants to see.
pub(super) fn show(ui: &mut Ui, found: &[Diagnostic]) -> Option<Diagnostic> {
    let look = Look::of(ui.visuals());
    if found.is_empty() {
        ui.weak("No problems.");
        return None;
    }
    let mut wanted = None;
    egui::ScrollArea::vertical().auto_shrink([false, false]).id_salt("problems").show(ui, |ui| {
        for diagnostic in found {
            let (mark, color) = match diagnostic.severity {
                Severity::Error => ("Error", look.error),
                Severity::Warning => ("Warning", look.warning),
            };
            ui.horizontal_wrapped(|ui| {
                ui.colored_label(color, mark);
                let place = place_of(diagnostic);
                if ui
                    .link(if place.is_empty() { diagnostic.code.to_owned() } else { place })
                    .on_hover_text(explained(diagnostic))
                    .clicked()
                {
                    wanted = Some(diagnostic.clone());
                }
                ui.label(&diagnostic.message);
            });
            for more in diagnostic.help.iter().chain(&diagnostic.notes) {
                ui.indent(("more", &diagnostic.message, more), |ui| ui.weak(more));
            }
        }
    });
    wanted
}

/// Node and port, or the line of the file.
fn place_of(diagnostic: &Diagnostic) -> String {
    let place = &diagnostic.place;
    match (&place.node, &place.port, &place.span) {
        (Some(node), Some(port), _) => format!("{node}.{port}"),
        (Some(node), None, _) => node.clone(),
        (None, _, Some(span)) => {
            let (line, column) = span.line_column();
            format!("{}:{line}:{column}", span.source.name)
        }
        (None, _, None) => place.file.clone().unwrap_or_default(),
    }
}

fn explained(diagnostic: &Diagnostic) -> String {
    let text = crate::explain::find(diagnostic.code).map_or_else(String::new, |e| e.meaning.to_owned());
    format!("{}: {text}", diagnostic.code)
}
