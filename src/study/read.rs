//! From text to study, with everything that is wrong on the way.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::claims::read_claims;
use super::document::{Case, Grid, Method, Study, Timed, TruthSettings, VERSION};
use super::published::read_published;
use super::reading::Reader;
use crate::diagnostic::{Diagnostic, Place, SourceText, Span, did_you_mean, has_errors};
use crate::ron::{self, Field, Node, Tree, expect_fields, field, unknown_fields};

/// Most mistakes that are told.
const MOST_FOUND: usize = 100;
/// Most columns or rows of a frame.
const MOST_PIXELS: u64 = 16_384;
/// Most times that a cell is drawn.
const MOST_ROUNDS: u64 = 10_000;

/// Reads a study. With errors there is none. Whether its scenes, nodes and settings exist is checked by others.
pub fn read(source: &Arc<SourceText>) -> (Option<Study>, Vec<Diagnostic>) {
    let (document, mut found) = ron::read(source);
    let mut reader = Reader { source, found: &mut found };
    let study = document.as_ref().and_then(|d| reader.study(&d.root));
    let broken = has_errors(&found);
    found.truncate(MOST_FOUND);
    (study.filter(|_| !broken), found)
}

impl Reader<'_> {
    fn at_root(&mut self, code: &'static str, message: impl Into<String>, root: &Node, help: &str) {
        let end = root.span.start + "Study".len().min(root.span.len());
        let place = Place::span(Span::new(self.source, root.span.start..end));
        self.found.push(Diagnostic::error(code, message, place).help(help));
    }

    fn known(&mut self, fields: &[Field], known: &[&str]) {
        self.found.extend(unknown_fields(fields, known, self.source));
    }

    fn words(&mut self, fields: &[Field], name: &str) -> String {
        self.text(fields, name).unwrap_or_default()
    }

    fn list<'n>(&mut self, fields: &'n [Field], name: &str) -> &'n [Node] {
        field(fields, name).and_then(|n| self.take(n.as_list(self.source))).unwrap_or_default()
    }

    fn map<'n>(&mut self, fields: &'n [Field], name: &str) -> Vec<(String, &'n Node, &'n Node)> {
        let entries = field(fields, name).and_then(|n| self.take(n.as_map(self.source))).unwrap_or_default();
        let read =
            |(key, value): &'n (Node, Node)| Some((self.take(key.as_str(self.source).map(str::to_owned))?, key, value));
        entries.iter().filter_map(read).collect()
    }

    fn study(&mut self, root: &Node) -> Option<Study> {
        let fields = match &root.value {
            Tree::Struct(Some(name), fields) if name == "Study" => fields,
            other => {
                let message = format!("expected `Study(...)`, found {}", other.describe());
                self.at_root("ST0600", message, root, "a study begins with `Study(version: 1, title: \"...\", ...)`");
                return None;
            }
        };
        match field(fields, "version").map(|n| (n, n.as_u64(self.source, u64::from(u32::MAX)))) {
            None => self.at_root(
                "ST0600",
                "the study does not say its version",
                root,
                "add `version: 1` as its first field",
            ),
            Some((_, Err(error))) => self.found.push(*error),
            Some((_, Ok(version))) if version == u64::from(VERSION) => {}
            Some((node, Ok(version))) => {
                let message =
                    format!("version {version} of studies is not known; this program reads version {VERSION}");
                self.error("ST0600", message, node, "use a newer shadetree, or write `version: 1`");
                return None;
            }
        }
        let mut study = Study {
            title: self.words(fields, "title"),
            note: self.words(fields, "note"),
            plain: self.words(fields, "plain"),
            truth: field(fields, "truth").map(|n| self.truth(n)).unwrap_or_default(),
            rounds: self.count(fields, "rounds", 20),
            warm_up: self.count(fields, "warm_up", 3),
            ..Study::default()
        };
        if let Some(node) = field(fields, "timed") {
            match self.take(node.as_str(self.source)) {
                Some("radiance") => study.shown = Timed::Radiance,
                Some("visibility") | None => {}
                Some(other) => {
                    let message = format!("`{other}` cannot be timed");
                    self.error("ST0603", message, node, "write \"visibility\" or \"radiance\"");
                }
            }
        }
        for (name, key, node) in self.map(fields, "cases") {
            let case = self.case(name, key, node);
            study.cases.extend(case);
        }
        for (name, key, node) in self.map(fields, "methods") {
            let method = self.method(name, key, node);
            study.methods.extend(method);
        }
        let methods: Vec<String> = study.methods.iter().map(|m| m.name.clone()).collect();
        if let Some(node) = field(fields, "published") {
            study.published = read_published(node, self.source, Some(&methods), self.found);
        }
        if let Some(node) = field(fields, "claims") {
            study.claims = read_claims(node, self.source, Some(&methods), self.found);
        }
        for node in self.list(fields, "grids") {
            let grid = self.grid(node, &study);
            study.grids.extend(grid);
        }
        self.known(
            fields,
            &[
                "version",
                "title",
                "note",
                "cases",
                "methods",
                "plain",
                "grids",
                "truth",
                "timed",
                "rounds",
                "warm_up",
                "published",
                "claims",
            ],
        );
        let empty = [
            (
                "cases",
                study.cases.is_empty(),
                "add `cases: {\"car\": (scene: \"car.ron\", light: \"spot\", class: \"...\")}`",
            ),
            ("methods", study.methods.is_empty(), "add `methods: {\"PCF\": (shadow: \"pcf_shadow\")}`"),
            ("grids", study.grids.is_empty(), "add `grids: [(frames: [(640, 480)])]`"),
        ];
        for (name, _, help) in empty.iter().filter(|(_, empty, _)| *empty) {
            self.at_root("ST0601", format!("the study has no {name}, so there is nothing to measure"), root, help);
        }
        if study.plain.is_empty() {
            let help = "add `plain: \"...\"` with the name of a method whose shadow is a plain shadow map";
            self.at_root("ST0601", "the study does not say what its methods are compared with", root, help);
        } else if study.method(&study.plain).is_none()
            && let Some(node) = field(fields, "plain")
        {
            let names: Vec<&str> = study.methods.iter().map(|m| m.name.as_str()).collect();
            self.unknown("method", &study.plain, &names, node);
        }
        Some(study)
    }

    fn unknown(&mut self, what: &str, name: &str, names: &[&str], node: &Node) {
        let help = match did_you_mean(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("there are {}", names.join(", ")),
        };
        self.error("ST0602", format!("the study has no {what} `{name}`"), node, help);
    }

    fn count(&mut self, fields: &[Field], name: &str, otherwise: usize) -> usize {
        let Some(node) = field(fields, name) else { return otherwise };
        match self.take(node.as_u64(self.source, u64::MAX)) {
            Some(count) if count <= MOST_ROUNDS && (count > 0 || name == "warm_up") => {
                usize::try_from(count).unwrap_or(otherwise)
            }
            Some(_) => {
                self.error("ST0603", format!("`{name}` is out of range"), node, format!("write 1 to {MOST_ROUNDS}"));
                otherwise
            }
            None => otherwise,
        }
    }

    fn size(&mut self, node: &Node) -> Option<(u32, u32)> {
        let [columns, rows] = self.take(node.as_array::<2>(self.source))?;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
        if [columns, rows].iter().all(|n| n.fract() == 0.0 && (1.0..=MOST_PIXELS as f64).contains(n)) {
            return Some((columns as u32, rows as u32));
        }
        let help = format!("write `(columns, rows)`, whole numbers from 1 to {MOST_PIXELS}");
        self.error("ST0603", "this is no size of a picture", node, help);
        None
    }

    fn truth(&mut self, node: &Node) -> TruthSettings {
        let mut truth = TruthSettings::default();
        let Some(fields) = self.take(expect_fields(node, self.source, "`(references: [...], size: (320, 240))`"))
        else {
            return truth;
        };
        if field(fields, "references").is_some() {
            truth.references.clear();
        }
        for node in self.list(fields, "references") {
            match self.take(node.as_str(self.source)) {
                Some(name @ ("rays" | "pcf")) => truth.references.push(name.to_owned()),
                Some(other) => {
                    let message = format!("the reference `{other}` is not known");
                    self.error("ST0604", message, node, "there are `rays` and `pcf`");
                }
                None => {}
            }
        }
        if let Some(size) = field(fields, "size").and_then(|n| self.size(n)) {
            truth.size = size;
        }
        if let Some(node) = field(fields, "samples") {
            match self.take(node.as_u64(self.source, 1 << 20)) {
                Some(0) => self.error("ST0603", "no samples are no truth", node, "write 16 or more"),
                Some(samples) => truth.samples = u32::try_from(samples).ok(),
                None => {}
            }
        }
        self.known(fields, &["references", "size", "samples"]);
        truth
    }

    fn case(&mut self, name: String, key: &Node, node: &Node) -> Option<Case> {
        let help = "a case `(scene: \"scene.ron\", light: \"sun\", class: \"...\")`";
        let fields = self.take(expect_fields(node, self.source, help))?;
        let case = Case {
            scene: self.words(fields, "scene"),
            light: self.words(fields, "light"),
            class: field(fields, "class").map_or_else(|| name.clone(), |_| self.words(fields, "class")),
            set: self.settings(fields),
            span: Some(Span::new(self.source, key.span.clone())),
            name,
        };
        for (missing, _) in [("scene", &case.scene), ("light", &case.light)].iter().filter(|(_, v)| v.is_empty()) {
            self.error("ST0601", format!("the case `{}` has no {missing}", case.name), key, format!("write {help}"));
        }
        self.known(fields, &["scene", "light", "class", "set"]);
        Some(case)
    }

    fn method(&mut self, name: String, key: &Node, node: &Node) -> Option<Method> {
        let help = "a method `(shadow: \"pcf_shadow\", set: {\"width\": 3})`";
        let fields = self.take(expect_fields(node, self.source, help))?;
        let method = Method {
            shadow: self.words(fields, "shadow"),
            set: self.settings(fields),
            vary: self.vary(fields),
            span: Some(Span::new(self.source, key.span.clone())),
            name,
        };
        if method.shadow.is_empty() {
            let message = format!("the method `{}` has no shadow", method.name);
            self.error("ST0601", message, key, format!("write {help}"));
        }
        self.known(fields, &["shadow", "set", "vary"]);
        Some(method)
    }

    fn settings(&mut self, fields: &[Field]) -> BTreeMap<String, String> {
        let entries = self.map(fields, "set");
        entries.into_iter().filter_map(|(name, _, value)| Some((name, self.value(value)?))).collect()
    }

    fn vary(&mut self, fields: &[Field]) -> Vec<(String, Vec<String>)> {
        let mut all = Vec::new();
        for (name, key, node) in self.map(fields, "vary") {
            let values = self.take(node.as_list(self.source)).unwrap_or_default();
            let values: Vec<String> = values.iter().filter_map(|v| self.value(v)).collect();
            if values.is_empty() {
                self.error("ST0603", format!("`{name}` is varied over no value"), key, "write `[...]` with its values");
            }
            all.push((name, values));
        }
        all
    }

    /// As overrides on the command line are written.
    fn value(&mut self, node: &Node) -> Option<String> {
        match &node.value {
            Tree::Text(text) => Some(text.clone()),
            Tree::Bool(b) => Some(b.to_string()),
            Tree::Number(written) => self.take(node.as_f64(self.source)).map(|_| written.clone()),
            _ => {
                let numbers = self.take(node.as_numbers(self.source))?;
                Some(format!("({})", numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")))
            }
        }
    }

    fn grid(&mut self, node: &Node, study: &Study) -> Option<Grid> {
        let fields = self.take(expect_fields(node, self.source, "a grid `(frames: [(640, 480)], vary: {...})`"))?;
        let cases: Vec<&str> = study.cases.iter().map(|c| c.name.as_str()).collect();
        let methods: Vec<&str> = study.methods.iter().map(|m| m.name.as_str()).collect();
        let names = |reader: &mut Self, field: &str, what: &str, known: &[&str]| {
            let mut all = Vec::new();
            for node in reader.list(fields, field) {
                let Some(name) = reader.take(node.as_str(reader.source)) else { continue };
                if known.contains(&name) {
                    all.push(name.to_owned());
                } else {
                    reader.unknown(what, name, known, node);
                }
            }
            all
        };
        let grid = Grid {
            cases: names(self, "cases", "case", &cases),
            methods: names(self, "methods", "method", &methods),
            frames: self.list(fields, "frames").iter().filter_map(|n| self.size(n)).collect(),
            vary: self.vary(fields),
            quick: field(fields, "quick").and_then(|n| self.take(n.as_bool(self.source))).unwrap_or(false),
        };
        if grid.frames.is_empty() {
            self.error("ST0601", "the grid has no frames", node, "add `frames: [(640, 480)]`");
        }
        self.known(fields, &["cases", "methods", "frames", "vary", "quick"]);
        Some(grid)
    }
}
