//! Fixed passes: shaders that are not nodes, under `shaders/`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::catalog::Catalog;
use super::definition::{Choices, Item, OptionSpec};
use super::file::{self, resolve, stem};
use super::report::{Piece, Report, lines};
use super::settings;
use crate::diagnostic::{Diagnostic, Place, SourceText, did_you_mean};

/// What a pass runs over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PassKind {
    /// The objects of the scene, drawn from the light. Group 0 binding 0: `LightSpace`; group 1 binding 0: the object
    /// block; vertex location 0: object-space position. A colour target gets a depth buffer beside it.
    Geometry,
    /// Every texel of an image: a full-screen triangle that reads group 0 binding 0 (`texture_2d<f32>`) and writes a
    /// texture of the same size and format.
    Image,
    /// Every texel of every mip level but the first: as an image pass, but from each level of a texture to the next.
    Mip,
}

/// `skip: NAME == VALUE`: the pass does nothing for that choice and is left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skip {
    /// An option of the pass.
    pub option: String,
    /// The choice of it.
    pub value: String,
}

/// A fixed pass.
#[derive(Clone, Debug)]
pub struct PassFile {
    /// The file's stem.
    pub name: String,
    /// What it runs over.
    pub kind: PassKind,
    /// Libraries that it needs, direct ones only.
    pub uses: Vec<String>,
    /// Structural choices.
    pub options: Vec<OptionSpec>,
    /// Texture formats that it can write, the preferred one first, as its `target:` line words them.
    pub targets: Vec<String>,
    /// What its target holds before; empty: it does not matter.
    pub clear: Vec<f64>,
    /// Axes that it runs along one after the other (`x`, `y`); empty: it runs once.
    pub axes: Vec<String>,
    /// When it is left out.
    pub skip: Option<Skip>,
    /// Whether an image pass reads the light's view (`reads: light`): group 0 binding 1, `LightSpace`.
    pub reads_light: bool,
    /// All other header lines joined by spaces.
    pub description: String,
    /// The file.
    pub source: Arc<SourceText>,
}

const KEYS: &[&str] = &["kind", "use", "target", "clear", "axes", "skip", "reads", "option", "label"];

impl PassFile {
    /// Reads the header of a pass; the file's stem is its name.
    ///
    /// # Errors
    /// Everything that is wrong with the header.
    pub fn parse(source: &Arc<SourceText>) -> Result<Self, Vec<Diagnostic>> {
        let options = all_options(source);
        let defaults: Vec<(String, String)> = options.iter().map(|o| (o.name.clone(), o.default.clone())).collect();
        Self::read(source, &options, &defaults)
    }

    /// The pass for these choices: conditions may stand around header lines, too, though not around options. Choices that
    /// the pass does not know are passed over; [`PassFile::text`] complains of them.
    ///
    /// # Errors
    /// Everything that is wrong with the header for these choices.
    pub fn chosen(&self, choices: &Choices) -> Result<Self, Vec<Diagnostic>> {
        let made = |o: &OptionSpec| {
            let choice = choices.get(&o.name).filter(|c| o.choices.contains(c));
            (o.name.clone(), choice.unwrap_or(&o.default).clone())
        };
        let made: Vec<(String, String)> = self.options.iter().map(made).collect();
        Self::read(&self.source, &self.options, &made)
    }

    fn read(
        source: &Arc<SourceText>,
        options: &[OptionSpec],
        choices: &[(String, String)],
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut report = Report::new(source);
        let kept = file::kept_lines(&source.text, options, choices);
        let mut pass = Self {
            name: stem(&source.name).to_owned(),
            kind: PassKind::Image,
            uses: Vec::new(),
            options: Vec::new(),
            targets: Vec::new(),
            clear: Vec::new(),
            axes: Vec::new(),
            skip: None,
            reads_light: false,
            description: String::new(),
            source: source.clone(),
        };
        let mut seen: Vec<&str> = Vec::new();
        for line in header_lines(&source.text).filter(|l| kept.contains(&l.at)).map(Piece::trim) {
            if line.text.is_empty() {
                continue;
            }
            let line = line.slice(3..line.text.len()).trim();
            let Some((key, value)) = line.split_once(":") else {
                pass.describe(line);
                continue;
            };
            let words = key.words();
            let known = match words[..] {
                [word] => word.text != "option" && KEYS.contains(&word.text),
                [word, _] => word.text == "option",
                _ => false,
            };
            if known {
                if seen.contains(&key.text) {
                    report
                        .error("ST0104", key.range(), format!("`{}` is said twice", key.text))
                        .help("remove one of them");
                } else {
                    seen.push(key.text);
                    pass.line(&mut report, &words, value);
                }
            } else if words.len() == 1 && key.text.bytes().all(|b| b.is_ascii_lowercase() || b == b'_') {
                report
                    .error("ST0101", key.range(), format!("`{}` is not a key of pass headers", key.text))
                    .suggest(did_you_mean(key.text, KEYS.iter().copied()));
            } else {
                pass.describe(line);
            }
        }
        if !seen.contains(&"kind") {
            report
                .error("ST0138", 0..0, "the header says no kind")
                .help("add a line `//! kind: geometry`, `//! kind: image` or `//! kind: mip`");
        }
        pass.judge_skip(&mut report);
        if report.found.is_empty() { Ok(pass) } else { Err(report.found) }
    }

    fn describe(&mut self, line: Piece<'_>) {
        if !self.description.is_empty() && !line.text.is_empty() {
            self.description.push(' ');
        }
        self.description.push_str(line.text);
    }

    fn line(&mut self, report: &mut Report, key: &[Piece<'_>], value: Piece<'_>) {
        let alternatives = |report: &mut Report| -> Vec<String> {
            let parts = value.split('|');
            for part in parts.iter().filter(|p| p.text.is_empty()) {
                report.error("ST0138", part.range(), "an empty alternative").help("remove a `|`");
            }
            parts.iter().map(|p| p.text.to_owned()).collect()
        };
        match key[0].text {
            "kind" => {
                self.kind = match value.text {
                    "geometry" => PassKind::Geometry,
                    "image" => PassKind::Image,
                    "mip" => PassKind::Mip,
                    other => {
                        report
                            .error("ST0138", value.range(), format!("`{other}` is not a kind of pass"))
                            .help("kinds are geometry, image, mip");
                        return;
                    }
                }
            }
            "use" => self.uses = settings::names(report, value),
            "option" => self.options.extend(settings::option(report, key[1], value)),
            "target" => self.targets = alternatives(report),
            "reads" => {
                self.reads_light = value.text == "light";
                if !self.reads_light {
                    report
                        .error("ST0138", value.range(), format!("`{}` is nothing that a pass can read", value.text))
                        .help("write `reads: light`, or leave the line out");
                }
            }
            "axes" => {
                self.axes = alternatives(report);
                if self.axes.iter().any(|a| a != "x" && a != "y") {
                    report
                        .error("ST0138", value.range(), "axes are x and y")
                        .help("write `axes: x | y`, or leave the line out");
                }
            }
            "clear" => {
                let inner = value.text.trim_start_matches('(').trim_end_matches(')');
                let numbers = inner.split([',', ' ']).filter(|n| !n.is_empty()).map(|n| n.parse::<f64>());
                match numbers.collect::<Result<Vec<f64>, _>>() {
                    Ok(n) if (1..=4).contains(&n.len()) && n.iter().all(|x| x.is_finite()) => self.clear = n,
                    _ => {
                        report
                            .error("ST0138", value.range(), "`clear` takes one to four numbers")
                            .help("write for example `clear: (1, 0, 0, 0)`");
                    }
                }
            }
            "skip" => match value.split_once("==") {
                Some((option, value)) => {
                    self.skip = Some(Skip { option: option.text.to_owned(), value: value.text.to_owned() });
                }
                None => {
                    report
                        .error("ST0138", value.range(), "`skip` reads `OPTION == CHOICE`")
                        .help("write for example `skip: width == 1`");
                }
            },
            _ => {}
        }
    }

    fn judge_skip(&self, report: &mut Report) {
        let Some(skip) = &self.skip else { return };
        match self.options.iter().find(|o| o.name == skip.option) {
            Some(option) if option.choices.contains(&skip.value) => {}
            Some(option) => {
                report
                    .error("ST0138", 0..0, format!("`{}` is not a choice of `{}`", skip.value, skip.option))
                    .help(format!("choices are {}", option.choices.join(", ")));
            }
            None => {
                report
                    .error("ST0107", 0..0, format!("`skip` names no option: `{}`", skip.option))
                    .among(&skip.option, self.options.iter().map(|o| o.name.as_str()));
            }
        }
    }

    /// Whether the pass is left out for these choices.
    pub fn is_skipped(&self, choices: &Choices) -> bool {
        self.skip.as_ref().is_some_and(|skip| {
            let default = self.options.iter().find(|o| o.name == skip.option).map(|o| &o.default);
            choices.get(&skip.option).or(default) == Some(&skip.value)
        })
    }

    /// The complete WGSL for these choices: what its entry points reach in its libraries and in the file itself, in
    /// file order, libraries first.
    ///
    /// # Errors
    /// Unknown choices and libraries, malformed conditions and declarations. The text is not judged by naga here.
    pub fn text(&self, choices: &Choices, catalog: &Catalog) -> Result<String, Vec<Diagnostic>> {
        self.text_with(choices, catalog, None)
    }

    /// The same with the items of a variant in the place of those that they are a variant of ([`Catalog::variant`]).
    ///
    /// # Errors
    /// As [`Self::text`].
    pub fn text_with(
        &self,
        choices: &Choices,
        catalog: &Catalog,
        variant: Option<&str>,
    ) -> Result<String, Vec<Diagnostic>> {
        let mut report = Report::new(&self.source);
        let choices = resolve(&self.options, choices, Place::file(&self.source.name))?;
        let applied = file::apply(&mut report, &self.options, &choices);
        for name in self.uses.iter().filter(|name| catalog.library(name).is_none()) {
            report
                .error("ST0128", 0..0, format!("there is no library `{name}`"))
                .suggest(did_you_mean(name, catalog.library_names()));
        }
        if !report.found.is_empty() {
            return Err(report.found);
        }
        let own = file::items_of(&applied);
        let entries: Vec<&str> = applied.declarations.iter().filter(|d| d.entry).map(|d| d.name.as_str()).collect();
        if entries.is_empty() {
            report
                .error("ST0121", 0..0, format!("the pass `{}` has no entry point", self.name))
                .help("mark one function `@vertex` and one `@fragment`");
            return Err(report.found);
        }
        let others = variant.map_or(Vec::new(), |name| catalog.variant(name));
        let replaced = |item: &&Item| others.iter().all(|other| other.name != item.name);
        let libraries = catalog.closure(&self.uses).into_iter().flat_map(|l| &l.items).filter(replaced);
        let items: Vec<&Item> = libraries.chain(&others).chain(&own).collect();
        let kept = reachable(&items, &entries);
        let texts: Vec<&str> =
            items.iter().filter(|i| kept.contains(i.name.as_str())).map(|i| i.text.as_str()).collect();
        Ok(texts.join("\n\n") + "\n")
    }
}

/// Lines before the first one of code: headers, conditions around them, and empty ones.
fn header_lines(text: &str) -> impl Iterator<Item = Piece<'_>> {
    let is_header = |line: &Piece<'_>| {
        let line = line.trim().text;
        line.is_empty() || line.starts_with("//!") || line.starts_with("//#")
    };
    lines(text).take_while(is_header)
}

/// Options of a header, whatever the conditions around them; what is wrong with them is told when the header is read.
fn all_options(source: &Arc<SourceText>) -> Vec<OptionSpec> {
    let mut unheard = Report::new(source);
    let mut found: Vec<OptionSpec> = Vec::new();
    for line in header_lines(&source.text).map(Piece::trim).filter(|l| l.text.starts_with("//!")) {
        if let Some((key, value)) = line.slice(3..line.text.len()).trim().split_once(":")
            && let [word, name] = key.words()[..]
            && word.text == "option"
        {
            found.extend(settings::option(&mut unheard, name, value));
        }
    }
    found
}

/// Names of the items that `roots` mention, directly or through others, `roots` included.
pub fn reachable<'a>(items: &[&'a Item], roots: &[&'a str]) -> BTreeSet<&'a str> {
    let by_name: BTreeMap<&str, &'a Item> = items.iter().map(|i| (i.name.as_str(), *i)).collect();
    let mut open: Vec<&'a str> = roots.to_vec();
    let mut kept = BTreeSet::new();
    while let Some(name) = open.pop() {
        if let Some(item) = by_name.get(name)
            && kept.insert(item.name.as_str())
        {
            open.extend(item.mentions.iter().map(String::as_str));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLUR: &str = "\
//! kind: image
//! use: taps
//! option width: 3 | 5 = 5 - Taps along an axis.
//! option mode: box | none = box - Shape.
//! target: rg32float | rg16float
//! clear: (1, 0.5)
//! axes: x | y
//! skip: mode == none
//! Blurs along one axis.

const WIDTH: i32 = 5;
@group(0) @binding(0) var input: texture_2d<f32>;
fn unused() -> f32 { return 1.0; }
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f { return corner(i); }
@fragment fn fragment(@builtin(position) p: vec4f) -> @location(0) vec4f {
    return textureLoad(input, vec2i(p.xy), WIDTH);
}
";

    fn pass(text: &str) -> Result<PassFile, Vec<String>> {
        let found = PassFile::parse(&SourceText::new("shaders/blur.wgsl", text));
        found.map_err(|e| e.into_iter().map(|d| format!("{} {}", d.code, d.message)).collect())
    }

    #[test]
    fn header_is_read() {
        let p = pass(BLUR).unwrap();
        assert_eq!((p.name.as_str(), p.kind), ("blur", PassKind::Image));
        assert_eq!(p.targets, ["rg32float", "rg16float"]);
        assert_eq!((p.clear.as_slice(), p.axes.len()), ([1.0, 0.5].as_slice(), 2));
        assert_eq!(p.description, "Blurs along one axis.");
        assert!(!p.is_skipped(&Choices::new()));
        assert!(p.is_skipped(&Choices::from([("mode".into(), "none".into())])));
    }

    #[test]
    fn only_what_is_reached_is_written() {
        let mut catalog = Catalog::default();
        let library = "fn corner(i: u32) -> vec4f { return vec4f(f32(i)); }\nfn other() -> f32 { return 1.0; }";
        assert!(catalog.add_library("taps.wgsl", library).is_empty());
        let text = pass(BLUR).unwrap().text(&Choices::from([("width".into(), "3".into())]), &catalog).unwrap();
        assert!(text.contains("fn corner") && text.contains("var input") && text.contains("WIDTH: i32 = 3;"), "{text}");
        assert!(!text.contains("unused") && !text.contains("other"), "{text}");
        assert!(naga::front::wgsl::parse_str(&text).is_ok());
    }

    #[test]
    fn conditions_choose_header_lines() {
        let text = "\
//! kind: image
//! option precision: half | single = single - Bits.
//#if precision == half
//! target: rg16float
//! clear: 2
//#else
//! target: rg32float
//! clear: 3
//#end
//! Reads.
";
        let p = pass(text).unwrap();
        assert_eq!((p.targets.as_slice(), p.clear.as_slice()), (["rg32float".to_owned()].as_slice(), [3.0].as_slice()));
        let half = p.chosen(&Choices::from([("precision".into(), "half".into())])).unwrap();
        assert_eq!(
            (half.targets.as_slice(), half.clear.as_slice()),
            (["rg16float".to_owned()].as_slice(), [2.0].as_slice())
        );
        assert_eq!(half.description, "Reads.");
        let unknown = Choices::from([("precision".into(), "double".into()), ("other".into(), "a".into())]);
        assert_eq!(p.chosen(&unknown).unwrap().targets, p.targets);
    }

    #[test]
    fn mistakes() {
        let found = pass("//! kind: imge\n//! axs: x\n//! axes: z\n//! clear: a\n//! skip: a == b\n//! skip: a == c\n")
            .unwrap_err();
        let codes: Vec<&str> = found.iter().map(|f| &f[..6]).collect();
        assert_eq!(codes, ["ST0138", "ST0101", "ST0138", "ST0138", "ST0104", "ST0107"], "{found:?}");
        assert!(pass("").unwrap_err()[0].starts_with("ST0138"));
        let p = pass(BLUR).unwrap();
        assert_eq!(p.text(&Choices::new(), &Catalog::default()).unwrap_err()[0].code, "ST0128");
        let bad = Choices::from([("width".into(), "4".into()), ("wdth".into(), "3".into())]);
        assert_eq!(p.text(&bad, &Catalog::default()).unwrap_err().len(), 2);
    }
}
