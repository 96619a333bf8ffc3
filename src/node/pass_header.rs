//! The header of a fixed pass.

use std::sync::Arc;

use super::definition::{Choices, OptionSpec};
use super::file::{self, stem};
use super::pass::{PassFile, PassKind, Skip};
use super::report::{Piece, Report, lines};
use super::settings;
use crate::diagnostic::{Diagnostic, SourceText, did_you_mean};

const KEYS: &[&str] =
    &["kind", "use", "target", "clear", "axes", "skip", "reads", "repeat", "otherwise", "option", "label"];

/// Formats that WebGPU lets every compute shader write.
const STORED: &[&str] = &["r32uint", "r32float", "rg32uint", "rg32float", "rgba16float", "rgba32uint", "rgba32float"];

/// Most texels that a step of `repeat: doubling N` may be as long as the one before.
const MOST_GROWTH: u32 = 64;

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
            repeat: None,
            otherwise: None,
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
                .help("add a line `//! kind: geometry`, `//! kind: image`, `//! kind: compute` or `//! kind: mip`");
        }
        pass.judge_skip(&mut report);
        pass.judge_kind(&mut report, &seen);
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
            "kind" => match PassKind::ALL.iter().find(|(name, _)| *name == value.text) {
                Some((_, kind)) => self.kind = *kind,
                None => {
                    report
                        .error("ST0138", value.range(), format!("`{}` is not a kind of pass", value.text))
                        .help(format!("kinds are {}", PassKind::ALL.map(|(name, _)| name).join(", ")));
                }
            },
            "repeat" => {
                let factor = match value.words()[..] {
                    [word] if word.text == "doubling" => Some(2),
                    [word, factor] if word.text == "doubling" => factor.text.parse().ok(),
                    _ => None,
                };
                self.repeat = factor.filter(|n| (2..=MOST_GROWTH).contains(n));
                if self.repeat.is_none() {
                    report
                        .error(
                            "ST0138",
                            value.range(),
                            "`repeat` reads `doubling`, or `doubling N` with N from 2 to 64",
                        )
                        .help("write for example `repeat: doubling 4`, or leave the line out");
                }
            }
            "otherwise" => self.otherwise = Some(value.text.to_owned()),
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

    /// What only some kinds of passes have.
    fn judge_kind(&self, report: &mut Report, seen: &[&str]) {
        let compute = self.kind == PassKind::Compute;
        if self.repeat.is_some() && !compute && self.kind != PassKind::Image {
            report
                .error("ST0138", 0..0, format!("a {} pass cannot be repeated", self.kind.name()))
                .help("only image and compute passes can: leave `repeat` out, or change `kind`");
        }
        if self.otherwise.is_some() && !compute {
            report
                .error("ST0138", 0..0, format!("nothing can take the place of a {} pass", self.kind.name()))
                .help("every adapter runs it: leave `otherwise` out");
        }
        if !compute {
            return;
        }
        if seen.contains(&"clear") {
            report
                .error("ST0138", 0..0, "the target of a compute pass is not cleared")
                .help("leave `clear` out, and store every texel");
        }
        if self.targets.is_empty() {
            report
                .error("ST0138", 0..0, "a compute pass says which formats it stores")
                .help("add a line like `//! target: rg32float`, with the format of the texture at binding 1");
        }
        for target in self.targets.iter().filter(|t| !STORED.contains(&t.as_str())) {
            report
                .error("ST0138", 0..0, format!("`{target}` is not a format that compute passes store"))
                .help(format!("choose among {}", STORED.join(", ")));
        }
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
