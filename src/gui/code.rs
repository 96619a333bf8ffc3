//! The woven text: lines of the selected node are lit, and a click on a line selects its node.

use std::ops::Range;
use std::sync::Arc;

use eframe::egui::{self, Color32, FontId, Ui, text::LayoutJob};

use crate::compile::Compiled;
use crate::export::{Target, export};
use crate::node::{TokenKind, tokenize};
use crate::preview::ShaderText;
use crate::verify::verify;

/// What is shown of a text, kept until it changes.
#[derive(Default)]
pub(super) struct Pane {
    shader: usize,
    target: Option<Target>,
    shown: Option<Shown>,
    /// A line to bring into view.
    goto: Option<usize>,
}

struct Shown {
    of: Arc<Compiled>,
    target: Target,
    text: String,
    lines: Vec<Range<usize>>,
    /// Colours of the text's parts.
    parts: Vec<(Range<usize>, Part)>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Word,
    Keyword,
    Type,
    Number,
    Comment,
    Attribute,
}

impl Pane {
    /// Brings the first line of a node into view.
    pub(super) fn go_to(&mut self, shaders: &[ShaderText], node: &str) {
        let Some(shader) = shaders.get(self.shader) else { return };
        let module = &shader.compiled.module;
        let first = module.source_map.iter().filter(|o| same(&o.node, node)).map(|o| o.start).min();
        self.goto = first.and_then(|at| module.wgsl.get(..at)).map(|before| before.matches('\n').count());
    }

    /// Shows the text. Answers the node that was clicked.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        shaders: &[ShaderText],
        selected: Option<&str>,
        dark: bool,
    ) -> Option<String> {
        if shaders.is_empty() {
            ui.weak("No shader yet.");
            return None;
        }
        self.shader = self.shader.min(shaders.len() - 1);
        let target = self.target.unwrap_or(Target::Wgsl);
        ui.horizontal(|ui| {
            if shaders.len() > 1 {
                let name = |s: &ShaderText| s.objects.join(", ");
                egui::ComboBox::from_id_salt("shader").selected_text(name(&shaders[self.shader])).show_ui(ui, |ui| {
                    for (i, shader) in shaders.iter().enumerate() {
                        ui.selectable_value(&mut self.shader, i, name(shader));
                    }
                });
            }
            for offered in Target::ALL {
                if ui.selectable_label(offered == target, offered.name().to_uppercase()).clicked() {
                    self.target = Some(offered);
                }
            }
            if ui.button("Copy").on_hover_text("Copies the whole text").clicked()
                && let Some(shown) = &self.shown
            {
                ui.copy_text(shown.text.clone());
            }
            if let Some(shown) = &self.shown {
                ui.weak(format!("{} lines", shown.lines.len()));
            }
        });
        let compiled = shaders[self.shader].compiled.clone();
        if self.shown.as_ref().is_none_or(|s| !Arc::ptr_eq(&s.of, &compiled) || s.target != target) {
            self.shown = Some(prepare(compiled, target));
        }
        let Some(shown) = &self.shown else { return None };
        lines(ui, shown, selected, dark, self.goto.take())
    }
}

fn lines(ui: &mut Ui, shown: &Shown, selected: Option<&str>, dark: bool, goto: Option<usize>) -> Option<String> {
    let font = FontId::monospace(12.5);
    let height = ui.fonts_mut(|f| f.row_height(&font));
    let mut clicked = None;
    let mut area = egui::ScrollArea::both().auto_shrink([false, false]).id_salt("wgsl");
    if let Some(line) = goto {
        #[allow(clippy::cast_precision_loss, reason = "a line number")]
        let y = (line as f32 - 3.0).max(0.0) * height;
        area = area.vertical_scroll_offset(y);
    }
    ui.spacing_mut().item_spacing.y = 0.0;
    let map = (shown.target == Target::Wgsl).then_some(&shown.of.module.source_map);
    area.show_rows(ui, height, shown.lines.len(), |ui, rows| {
        for number in rows {
            let Some(range) = shown.lines.get(number).cloned() else { continue };
            let lit = selected.is_some_and(|node| {
                map.is_some_and(|m| m.iter().any(|o| o.start < range.end && range.start < o.end && same(&o.node, node)))
            });
            let job = colored(shown, &range, number, dark, &font);
            let response = ui.add(egui::Label::new(job).selectable(false).extend().sense(egui::Sense::click()));
            if lit {
                let row = egui::Rect::from_min_max(
                    egui::pos2(ui.clip_rect().left(), response.rect.top()),
                    egui::pos2(ui.clip_rect().right(), response.rect.bottom()),
                );
                ui.painter().rect_filled(row, 0.0, Color32::from_rgba_unmultiplied(0x6c, 0xb4, 0xff, 48));
            }
            if response.clicked() {
                clicked = map.and_then(|_| {
                    let inside = (range.start..range.end).find(|at| !shown.text[*at..=*at].trim().is_empty())?;
                    shown.of.module.origin_of(inside).map(|o| o.node.to_string())
                });
            }
        }
    });
    clicked
}

/// Whether a name of the source map is that of a node, perhaps behind the name of its graph.
pub(super) fn same(full: &str, node: &str) -> bool {
    full == node || full.strip_suffix(node).is_some_and(|rest| rest.ends_with('/'))
}

fn prepare(of: Arc<Compiled>, target: Target) -> Shown {
    let wgsl = &of.module.wgsl;
    let text = if target == Target::Wgsl { wgsl.clone() } else { translated(&of, target) };
    let mut lines = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        lines.push(start..start + line.trim_end_matches(['\n', '\r']).len());
        start += line.len();
    }
    let parts = if target.is_binary() { Vec::new() } else { parts(&text) };
    Shown { of, target, text, lines, parts }
}

/// The module in another language, or why not.
fn translated(of: &Compiled, target: Target) -> String {
    let files = match verify(&of.module) {
        Ok(verified) => export(&verified, &of.module.wgsl, target).map_err(|d| vec![*d]),
        Err(found) => Err(found),
    };
    match files {
        Ok(files) => {
            let one = |file: &crate::export::File| match target.is_binary() {
                true => words(&file.bytes),
                false => String::from_utf8_lossy(&file.bytes).into_owned(),
            };
            let title = |file: &crate::export::File| {
                if files.len() > 1 { format!("// {}\n", file.extension) } else { String::new() }
            };
            files.iter().map(|file| title(file) + &one(file)).collect::<Vec<_>>().join("\n")
        }
        Err(found) => found.iter().map(|d| crate::report::text(d, false)).collect(),
    }
}

/// A binary as rows of words.
fn words(bytes: &[u8]) -> String {
    let word = |w: &[u8]| w.iter().rev().map(|b| format!("{b:02x}")).collect::<String>();
    bytes.chunks(32).map(|row| row.chunks(4).map(word).collect::<Vec<_>>().join(" ") + "\n").collect()
}

/// Which parts of a text have a colour of their own.
fn parts(text: &str) -> Vec<(Range<usize>, Part)> {
    const KEYWORDS: &[&str] = &[
        "fn",
        "let",
        "var",
        "const",
        "return",
        "if",
        "else",
        "for",
        "loop",
        "while",
        "break",
        "continue",
        "struct",
        "switch",
        "case",
        "default",
        "discard",
        "override",
        "alias",
        "using",
        "namespace",
        "constant",
        "static",
        "in",
        "out",
        "inout",
        "void",
        "layout",
        "uniform",
        "precision",
    ];
    let mut parts = Vec::new();
    let tokens = tokenize(text);
    let mut before = 0;
    let mut attribute = false;
    let comments = |range: Range<usize>, parts: &mut Vec<(Range<usize>, Part)>| {
        // Between tokens there is only space and comment.
        let gap = &text[range.clone()];
        if let Some(at) = gap.find('/') {
            parts.push((range.start + at..range.end, Part::Comment));
        }
    };
    for token in tokens {
        comments(before..token.range.start, &mut parts);
        before = token.range.end;
        let word = token.text(text);
        let part = match token.kind {
            TokenKind::Word if attribute => Part::Attribute,
            TokenKind::Word if KEYWORDS.contains(&word) => Part::Keyword,
            TokenKind::Word if is_type(word) => Part::Type,
            TokenKind::Number => Part::Number,
            _ => Part::Word,
        };
        attribute = token.is(b'@');
        if part != Part::Word {
            parts.push((token.range, part));
        }
    }
    comments(before..text.len(), &mut parts);
    parts
}

fn is_type(word: &str) -> bool {
    const STARTS: &[&str] = &["vec", "mat", "texture", "sampler", "array", "float", "int", "uint", "half"];
    matches!(word, "f32" | "i32" | "u32" | "bool" | "ptr" | "atomic")
        || STARTS.iter().any(|s| word.starts_with(s))
        || word.starts_with(|c: char| c.is_ascii_uppercase())
}

fn colored(shown: &Shown, range: &Range<usize>, number: usize, dark: bool, font: &FontId) -> LayoutJob {
    let mut job = LayoutJob::default();
    let format = |color| egui::TextFormat::simple(font.clone(), color);
    let weak = if dark { Color32::from_gray(0x70) } else { Color32::from_gray(0x90) };
    job.append(&format!("{:>4}  ", number + 1), 0.0, format(weak));
    let ink = |part| match (part, dark) {
        (Part::Word, true) => Color32::from_rgb(0xd6, 0xda, 0xe0),
        (Part::Word, false) => Color32::from_rgb(0x22, 0x26, 0x2e),
        (Part::Keyword, true) => Color32::from_rgb(0xc7, 0x92, 0xea),
        (Part::Keyword, false) => Color32::from_rgb(0x8a, 0x2b, 0xb0),
        (Part::Type, true) => Color32::from_rgb(0x7f, 0xc8, 0xe8),
        (Part::Type, false) => Color32::from_rgb(0x0b, 0x6e, 0x96),
        (Part::Number, true) => Color32::from_rgb(0xf0, 0xb6, 0x72),
        (Part::Number, false) => Color32::from_rgb(0xa6, 0x53, 0x00),
        (Part::Comment, true) => Color32::from_rgb(0x86, 0xa5, 0x7a),
        (Part::Comment, false) => Color32::from_rgb(0x3d, 0x73, 0x2e),
        (Part::Attribute, _) => Color32::from_rgb(0xb0, 0x8a, 0x50),
    };
    let mut at = range.start;
    let first = shown.parts.partition_point(|(r, _)| r.end <= range.start);
    for (part, kind) in shown.parts.iter().skip(first).take_while(|(r, _)| r.start < range.end) {
        let (start, end) = (part.start.max(at), part.end.min(range.end));
        if let Some(plain) = shown.text.get(at..start) {
            job.append(plain, 0.0, format(ink(Part::Word)));
        }
        if let Some(piece) = shown.text.get(start..end) {
            job.append(piece, 0.0, format(ink(*kind)));
        }
        at = end.max(at);
    }
    if let Some(rest) = shown.text.get(at..range.end) {
        job.append(rest, 0.0, format(ink(Part::Word)));
    }
    job
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_told_apart() {
        let text = "@vertex\nfn a(x: vec3f) -> f32 { // why\n    return 1.5; /* b */ }\n";
        let found: Vec<(&str, bool)> =
            parts(text).iter().map(|(r, p)| (&text[r.clone()], *p == Part::Comment)).collect();
        let words: Vec<&str> = found.iter().map(|(t, _)| t.trim()).collect();
        assert_eq!(words, ["vertex", "fn", "vec3f", "f32", "// why", "return", "1.5", "/* b */"]);
        assert_eq!(found.iter().filter(|(_, c)| *c).count(), 2);
    }

    #[test]
    fn names_may_stand_behind_their_graph() {
        assert!(same("lamp/spot", "spot") && same("spot", "spot") && !same("myspot", "spot"));
    }
}
