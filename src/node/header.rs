//! The `//!` lines of a node file.

use std::sync::Arc;

use super::cheaper::{self, Form};
use super::definition::{Header, MapSpec, OptionSpec, SamplerSpec, SpaceSpec, TextureSpec};
use super::projection::{PROJECTIONS, Projection};
use super::report::{Piece, Report, lines};
use super::settings;
use super::tokens::is_identifier;
use crate::diagnostic::{Diagnostic, SourceText, did_you_mean};
use crate::semantic::Shape;

/// The families of nodes.
pub const CATEGORIES: &[&str] =
    &["light", "shadow", "surface", "geometry", "texture", "procedural", "math", "color", "logic"];

/// Keys of one word, then keys that name a port, option or type parameter.
const KEYS: &[&str] = &["label", "category", "synonyms", "use", "space"];
/// May be said many times.
const CHEAPER: &str = "cheaper";
const NAMED_KEYS: &[&str] = &["option", "map", "sampler", "texture", "generic"];

/// Reads the header. `strict` demands what the catalogue needs (label, category); WGSL inside a graph does without.
pub(crate) fn parse(source: &Arc<SourceText>, strict: bool) -> (Header, Vec<Diagnostic>) {
    let mut reader = Reader {
        report: Report::new(source),
        header: Header {
            source: source.clone(),
            label: String::new(),
            category: String::new(),
            synonyms: Vec::new(),
            description: String::new(),
            uses: Vec::new(),
            inline: false,
            commutative: false,
            vertex: false,
            generic: Vec::new(),
            options: Vec::new(),
            space: None,
            maps: Vec::new(),
            samplers: Vec::new(),
            textures: Vec::new(),
            cheaper: Vec::new(),
        },
        seen: Vec::new(),
        port_names: port_names(&source.text),
        mentioned: Vec::new(),
    };
    let mut in_header = true;
    for line in lines(&source.text) {
        match line.trim().text.strip_prefix("//!") {
            Some(rest) if in_header => {
                let line = line.trim();
                reader.line(line.slice(line.text.len() - rest.len()..line.text.len()).trim());
            }
            Some(_) => {
                reader
                    .report
                    .error("ST0108", line.range(), "a header line behind the header")
                    .help("`//!` lines stand together at the top of the file");
            }
            None => in_header &= line.text.trim().is_empty(),
        }
    }
    reader.finish(strict)
}

/// Names on port lines anywhere in the text, whatever the choices.
fn port_names(text: &str) -> Vec<&str> {
    lines(text)
        .filter_map(|l| l.text.trim().strip_prefix("/// "))
        .filter_map(|l| l.split_once('(').map(|(name, _)| name.trim()))
        .filter(|name| is_identifier(name))
        .collect()
}

struct Reader<'a> {
    report: Report,
    header: Header,
    seen: Vec<String>,
    port_names: Vec<&'a str>,
    /// Settings that refer to options, looked up once all options are read.
    mentioned: Vec<Piece<'a>>,
}

impl<'a> Reader<'a> {
    fn line(&mut self, line: Piece<'a>) {
        match line.text {
            "inline" => return self.flag(line, |h| &mut h.inline),
            "vertex" => return self.flag(line, |h| &mut h.vertex),
            "commutative" => return self.flag(line, |h| &mut h.commutative),
            _ => {}
        }
        let Some((key, value)) = line.split_once(":") else {
            return self.describe(line);
        };
        let words = key.words();
        match words[..] {
            [word] if word.text == CHEAPER => self.cheaper(value),
            [word] if KEYS.contains(&word.text) => {
                if self.once(word, word.text.to_owned()) {
                    self.plain(word.text, value);
                }
            }
            [word, name] if NAMED_KEYS.contains(&word.text) => {
                if !is_identifier(name.text) {
                    self.report
                        .error("ST0102", name.range(), format!("`{}` is not a name", name.text))
                        .help("a name has letters, digits and `_`, and no digit first");
                } else if self.once(key, key.text.to_owned()) {
                    self.named(word.text, name, value);
                }
            }
            [word] if looks_like_key(word.text) && (value.text.is_empty() || value.at > word.range().end + 1) => {
                let known = KEYS.iter().chain(NAMED_KEYS).copied().chain([CHEAPER, "inline", "commutative", "vertex"]);
                self.report
                    .error("ST0101", word.range(), format!("`{}` is not a key of node headers", word.text))
                    .suggest(did_you_mean(word.text, known));
            }
            _ => self.describe(line),
        }
    }

    fn describe(&mut self, line: Piece<'_>) {
        if !self.header.description.is_empty() && !line.text.is_empty() {
            self.header.description.push(' ');
        }
        self.header.description.push_str(line.text);
    }

    fn flag(&mut self, line: Piece<'_>, field: fn(&mut Header) -> &mut bool) {
        if self.once(line, line.text.to_owned()) {
            *field(&mut self.header) = true;
        }
    }

    fn once(&mut self, at: Piece<'_>, key: String) -> bool {
        let new = !self.seen.contains(&key);
        if new {
            self.seen.push(key);
        } else {
            self.report.error("ST0104", at.range(), format!("`{key}` is said twice")).help("remove one of them");
        }
        new
    }

    fn plain(&mut self, key: &str, value: Piece<'a>) {
        if value.text.is_empty() {
            self.report
                .error("ST0102", value.range(), format!("`{key}:` says nothing"))
                .help("write something behind the colon, or remove the line");
            return;
        }
        match key {
            "label" => self.header.label = value.text.to_owned(),
            "category" => {
                self.header.category = value.text.to_owned();
                if !CATEGORIES.contains(&value.text) {
                    self.report
                        .error("ST0103", value.range(), format!("`{}` is not a category", value.text))
                        .help(format!("categories are {}", CATEGORIES.join(", ")));
                }
            }
            "synonyms" => self.header.synonyms = settings::list(&mut self.report, value),
            "use" => self.header.uses = settings::names(&mut self.report, value),
            _ => self.space(value),
        }
    }

    fn space(&mut self, value: Piece<'a>) {
        let end = value.text.rfind(')').map_or(value.text.len(), |at| at + 1);
        let (call, rest) = (value.slice(0..end), value.slice(end..value.text.len()).trim());
        let Some((name, arguments)) = settings::call(&mut self.report, call) else {
            return;
        };
        let Some(projection) = Projection::named(name.text) else {
            let known: Vec<String> = PROJECTIONS.iter().map(Projection::signature).collect();
            self.report
                .error("ST0102", name.range(), format!("`{}` is not a projection", name.text))
                .help(format!("projections are {}", known.join(", ")));
            return;
        };
        let inputs = arguments.map_or(Vec::new(), |a| a.split(','));
        if inputs.len() != projection.needed && inputs.len() != projection.inputs.len() {
            self.report
                .error("ST0102", call.range(), format!("{} takes {} inputs", projection.signature(), projection.needed))
                .help("name an input of this node for each, in this order");
        }
        for input in &inputs {
            self.port(*input);
        }
        let inputs = inputs.iter().map(|i| i.text.to_owned()).collect();
        let settings = settings::space(&mut self.report, rest, projection, &mut self.mentioned);
        self.header.space = Some(SpaceSpec { projection: projection.name.to_owned(), inputs, settings });
    }

    fn named(&mut self, key: &str, name: Piece<'a>, value: Piece<'a>) {
        let port = name.text.to_owned();
        match key {
            "option" => {
                if let Some(option) = settings::option(&mut self.report, name, value) {
                    self.header.options.push(option);
                }
                return;
            }
            "generic" => return self.generic(name, value),
            "map" => {
                let passes = settings::passes(&mut self.report, value, &mut self.mentioned);
                self.header.maps.push(MapSpec { port, passes });
            }
            "sampler" => {
                let settings = settings::sampler(&mut self.report, value, &mut self.mentioned);
                self.header.samplers.push(SamplerSpec { port, settings });
            }
            _ => {
                let settings = settings::texture(&mut self.report, value, &mut self.mentioned);
                self.header.textures.push(TextureSpec { port, settings });
            }
        }
        self.port(name);
    }

    fn cheaper(&mut self, value: Piece<'a>) {
        let mut inputs = Vec::new();
        let spec = cheaper::cheaper(&mut self.report, value, &mut inputs, &mut self.mentioned);
        inputs.into_iter().for_each(|input| self.port(input));
        self.header.cheaper.extend(spec);
    }

    /// Choices of `cheaper:` lines that their options do not have.
    fn check_choices(&mut self) {
        for spec in &self.header.cheaper {
            let Form::Option { name, choices } = &spec.form else { continue };
            let Some(option) = self.header.options.iter().find(|o| o.name == *name) else { continue };
            for choice in choices.iter().filter(|c| !option.choices.contains(c)) {
                self.report
                    .error("ST0105", spec.range.clone(), format!("`{choice}` is not a choice of option `{name}`"))
                    .help(format!("its choices are {}", option.choices.join(", ")));
            }
        }
    }

    fn generic(&mut self, name: Piece<'a>, value: Piece<'a>) {
        if name.text != "T" {
            self.report
                .error("ST0102", name.range(), "the type parameter is called `T`")
                .help("write `generic T: f32 | vec3f`");
        }
        for choice in value.split('|') {
            match Shape::from_wgsl(choice.text) {
                shape @ Shape::F32(_) if !self.header.generic.contains(&shape) => self.header.generic.push(shape),
                Shape::F32(_) => {
                    self.report
                        .error("ST0104", choice.range(), format!("`{}` is said twice", choice.text))
                        .help("remove one of them");
                }
                _ => {
                    self.report
                        .error("ST0102", choice.range(), format!("`{}` is not a width", choice.text))
                        .help("T may be f32, vec2f, vec3f, vec4f");
                }
            }
        }
    }

    fn port(&mut self, name: Piece<'_>) {
        if !self.port_names.contains(&name.text) {
            self.report
                .error("ST0106", name.range(), format!("no input is called `{}`", name.text))
                .among(name.text, self.port_names.iter().copied())
                .port(name.text);
        }
    }

    fn finish(mut self, strict: bool) -> (Header, Vec<Diagnostic>) {
        if strict {
            for (key, value) in [("label", &self.header.label), ("category", &self.header.category)] {
                if value.is_empty() && !self.seen.iter().any(|s| s == key) {
                    self.report
                        .error("ST0100", 0..0, format!("the header says no {key}"))
                        .help(format!("add a line `//! {key}: ...` at the top"));
                }
            }
        }
        for mention in std::mem::take(&mut self.mentioned) {
            let name = mention.text.trim_start_matches('$');
            if !self.header.options.iter().any(|o| o.name == name) {
                let names = self.header.options.iter().map(|o: &OptionSpec| o.name.as_str());
                self.report
                    .error("ST0107", mention.range(), format!("no option is called `{name}`"))
                    .among(name, names);
            }
        }
        self.check_choices();
        (self.header, self.report.found)
    }
}

/// A lower-case word, as keys are; prose that holds a colon starts with a capital or has more words before it.
fn looks_like_key(word: &str) -> bool {
    word.bytes().all(|b| b.is_ascii_lowercase() || b == b'_')
}
