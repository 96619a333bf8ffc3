//! A node file, read as far as somebody asks: header first, a definition per set of choices later.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::conditional::{self, Kept};
use super::definition::{Choices, Definition, Header, Item, OptionSpec};
use super::functions::Reader;
use super::header;
use super::items::{self, Declaration};
use super::report::Report;
use super::tokens::{is_identifier, is_reserved, mentions, tokenize};
use crate::diagnostic::{Diagnostic, Place, SourceText, did_you_mean};

type Outcome<T> = Result<Arc<T>, Vec<Diagnostic>>;

/// The most sets of choices whose definitions are remembered.
const MAX_CACHED: usize = 1024;

/// A node file. Nothing is read before it is asked for; answers are kept.
#[derive(Debug)]
pub struct NodeFile {
    kind: String,
    path: Cow<'static, str>,
    text: Cow<'static, str>,
    embedded: bool,
    source: OnceLock<Arc<SourceText>>,
    header: OnceLock<Outcome<Header>>,
    /// The definition with all defaults: most nodes want no other.
    plain: OnceLock<Outcome<Definition>>,
    definitions: Mutex<BTreeMap<Vec<String>, Outcome<Definition>>>,
}

/// A text with its choices applied, and its declarations.
pub(crate) struct Applied {
    pub(crate) kept: Kept,
    pub(crate) declarations: Vec<Declaration>,
}

impl NodeFile {
    pub(crate) fn new(path: Cow<'static, str>, text: Cow<'static, str>, embedded: bool) -> Self {
        Self {
            kind: stem(&path).to_owned(),
            path,
            text,
            embedded,
            source: OnceLock::new(),
            header: OnceLock::new(),
            plain: OnceLock::new(),
            definitions: Mutex::new(BTreeMap::new()),
        }
    }

    /// The file's stem: the node's kind and the name of its main function.
    pub fn kind(&self) -> &str {
        &self.kind
    }

    /// Name of the file as given.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Whether the file came with the program.
    pub fn is_embedded(&self) -> bool {
        self.embedded
    }

    /// The raw text for diagnostics to point into.
    pub fn source(&self) -> &Arc<SourceText> {
        self.source.get_or_init(|| SourceText::new(&*self.path, &*self.text))
    }

    /// The header.
    ///
    /// # Errors
    /// Everything that is wrong with the header or the file's name.
    pub fn header(&self) -> Result<Arc<Header>, Vec<Diagnostic>> {
        self.header
            .get_or_init(|| {
                let (header, mut found) = header::parse(self.source(), true);
                if !is_identifier(&self.kind) || is_reserved(&self.kind) {
                    let message = format!("`{}` cannot be the name of a WGSL function", self.kind);
                    found.push(Diagnostic::error("ST0109", message, Place::file(&*self.path)).help("rename the file"));
                }
                if found.is_empty() { Ok(Arc::new(header)) } else { Err(found) }
            })
            .clone()
    }

    /// The definition for these choices; options that are not named take their default.
    ///
    /// # Errors
    /// Everything that is wrong with the header, the choices, the port lines and the signatures. The bodies of
    /// functions are not judged here but in [`NodeFile::verify`](super::NodeFile::verify).
    pub fn definition(&self, choices: &Choices) -> Result<Arc<Definition>, Vec<Diagnostic>> {
        if choices.is_empty() {
            return self.plain.get_or_init(|| self.with_choices(choices)).clone();
        }
        self.with_choices(choices)
    }

    fn with_choices(&self, choices: &Choices) -> Result<Arc<Definition>, Vec<Diagnostic>> {
        let header = self.header()?;
        let made = resolve(&header.options, choices, Place::file(&*self.path))?;
        let key: Vec<String> = made.iter().map(|(_, choice)| choice.clone()).collect();
        let cached =
            |key: &Vec<String>| self.definitions.lock().unwrap_or_else(PoisonError::into_inner).get(key).cloned();
        if let Some(known) = cached(&key) {
            return known;
        }
        let outcome = define(&self.kind, &header, made, true).map(Arc::new);
        let mut definitions = self.definitions.lock().unwrap_or_else(PoisonError::into_inner);
        if definitions.len() < MAX_CACHED {
            definitions.insert(key, outcome.clone());
        }
        outcome
    }
}

/// The file name without folders and extension.
pub(crate) fn stem(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    name.strip_suffix(".wgsl").unwrap_or(name)
}

/// A choice for every option, in declaration order.
pub(crate) fn resolve(
    options: &[OptionSpec],
    choices: &Choices,
    place: Place,
) -> Result<Vec<(String, String)>, Vec<Diagnostic>> {
    let mut found = Vec::new();
    for (name, choice) in choices {
        let Some(option) = options.iter().find(|o| o.name == *name) else {
            let mut error =
                Diagnostic::error("ST0133", format!("there is no option `{name}`"), place.clone().port(name));
            error.help = match did_you_mean(name, options.iter().map(|o| o.name.as_str())) {
                Some(near) => Some(format!("did you mean `{near}`?")),
                None if options.is_empty() => Some("it has no options".into()),
                None => {
                    let names: Vec<&str> = options.iter().map(|o| o.name.as_str()).collect();
                    Some(format!("options are {}", names.join(", ")))
                }
            };
            found.push(error);
            continue;
        };
        if !option.choices.contains(choice) {
            let message = format!("`{choice}` is not a choice of option `{name}`");
            let error = Diagnostic::error("ST0133", message, place.clone().port(name));
            found.push(error.help(format!("choices are {}", option.choices.join(", "))));
        }
    }
    if !found.is_empty() {
        return Err(found);
    }
    let made = |o: &OptionSpec| (o.name.clone(), choices.get(&o.name).unwrap_or(&o.default).clone());
    Ok(options.iter().map(made).collect())
}

/// Where the lines begin that the conditions of a text keep for these choices.
pub(crate) fn kept_lines(text: &str, options: &[OptionSpec], choices: &[(String, String)]) -> BTreeSet<usize> {
    let lookup = |name: &str| {
        let option = options.iter().find(|o| o.name == name)?;
        let choice = choices.iter().find(|(n, _)| n == name)?;
        Some((choice.1.as_str(), option.choices.as_slice()))
    };
    let kept = conditional::apply(text, &lookup).0;
    let starts = std::iter::once(0).chain(kept.text.match_indices('\n').map(|(at, _)| at + 1));
    starts.map(|at| kept.original(at)).collect()
}

/// Applies choices to the text of `report`: conditions, then constants that numeric options set.
pub(crate) fn apply(report: &mut Report, options: &[OptionSpec], choices: &[(String, String)]) -> Applied {
    let source = report.source.clone();
    let (mut kept, errors) = conditional::apply(&source.text, &|name| {
        let option = options.iter().find(|o| o.name == name)?;
        let choice = choices.iter().find(|(n, _)| n == name)?;
        Some((&choice.1, &option.choices))
    });
    for error in errors {
        report
            .error("ST0110", error.range, error.message)
            .help("conditions read `//#if OPTION == a | b`, `//#elif OPTION != c`, `//#else`, `//#end`");
    }
    let (mut declarations, mistakes) = items::split(&kept.text);
    for (range, message) in mistakes {
        let unknown = message.contains("does not begin");
        let entry = report.error("ST0124", kept.original_range(range), message);
        entry.help(if unknown {
            "a file holds `fn`, `struct`, `const` and `alias` declarations"
        } else {
            "close it; perhaps the end of the text was lost"
        });
    }
    let mut edits = Vec::new();
    for (name, choice) in choices {
        let numeric = options.iter().any(|o| o.name == *name && o.choices.iter().all(|c| c.parse::<f64>().is_ok()));
        let constant = declarations.iter().find(|d| d.keyword == "const" && d.name == name.to_uppercase());
        if let Some(constant) = constant.filter(|_| numeric) {
            edits.extend(initializer(&kept.text, constant).map(|range| (range, choice)));
        }
    }
    if !edits.is_empty() {
        edits.sort_by_key(|(range, _)| range.start);
        for (range, choice) in edits.into_iter().rev() {
            kept.replace(range, choice);
        }
        declarations = items::split(&kept.text).0;
    }
    Applied { kept, declarations }
}

/// The bytes between `=` and `;`.
fn initializer(text: &str, constant: &Declaration) -> Option<std::ops::Range<usize>> {
    let tokens = tokenize(&text[constant.range.clone()]);
    let equals = tokens.iter().position(|t| t.is(b'='))?;
    let (first, last) = (tokens.get(equals + 1)?, tokens.get(tokens.len().checked_sub(2)?)?);
    let start = constant.range.start;
    (first.range.start < last.range.end).then(|| start + first.range.start..start + last.range.end)
}

/// Items of an applied text.
pub(crate) fn items_of(applied: &Applied) -> Vec<Item> {
    let item = |d: &Declaration| {
        let text = applied.kept.text[d.range.clone()].to_owned();
        Item { name: d.name.clone(), mentions: mentions(&text), text, offset: applied.kept.original(d.range.start) }
    };
    applied.declarations.iter().map(item).collect()
}

/// Reads a whole definition of the function `kind`.
pub(crate) fn define(
    kind: &str,
    header: &Arc<Header>,
    choices: Vec<(String, String)>,
    strict: bool,
) -> Result<Definition, Vec<Diagnostic>> {
    let mut report = Report::new(&header.source);
    let applied = apply(&mut report, &header.options, &choices);
    let Applied { kept, declarations } = &applied;
    judge(&mut report, &applied);
    let reader = Reader { kept, declarations, header, strict };
    let function = |name: &str| declarations.iter().find(|d| d.keyword == "fn" && d.name == name);
    let main = function(kind);
    // A text that cannot be split may well hold the function.
    if main.is_none() && !report.found.iter().any(|d| d.code == "ST0124") {
        report
            .error("ST0121", 0..0, format!("the file has no function `{kind}`"))
            .help("the function that the node stands for is named like the file");
    }
    let ambient = function(&format!("{kind}_ambient"));
    let read = |report: &mut Report, d: Option<&Declaration>| d.and_then(|d| reader.function(report, d));
    let (main_read, ambient_read) = (read(&mut report, main), read(&mut report, ambient));
    for (declaration, read) in [(main, &main_read), (ambient, &ambient_read)] {
        if let (Some(declaration), Some(function)) = (declaration, read)
            && header.inline
            && function.body.is_none()
        {
            let place = kept.original_range(declaration.name_range.clone());
            report
                .error("ST0123", place, format!("`{kind}` is inline but its body is not one `return`"))
                .help("remove the line `//! inline`, or write the body as one `return ...;`");
        }
    }
    generic(&mut report, header, &applied);
    let items = items_of(&applied);
    match main_read {
        Some(main) if report.found.is_empty() => {
            // The alias only makes the file valid by itself; whoever instantiates replaces `T` in the text.
            let alias = |i: &Item| i.name == "T" && !header.generic.is_empty();
            let items = items.into_iter().filter(|i| !alias(i)).collect();
            Ok(Definition {
                kind: kind.to_owned(),
                header: header.clone(),
                choices,
                main,
                ambient: ambient_read,
                items,
            })
        }
        _ => Err(report.found),
    }
}

/// Declarations that cannot stand in a node: names twice or reserved, entry points, module-scope variables.
fn judge(report: &mut Report, applied: &Applied) {
    let Applied { kept, declarations } = applied;
    for (i, d) in declarations.iter().enumerate() {
        let place = kept.original_range(d.name_range.clone());
        if declarations[..i].iter().any(|e| e.name == d.name) {
            report
                .error("ST0104", place.clone(), format!("`{}` is declared twice", d.name))
                .help("give one of them another name");
        }
        if is_reserved(&d.name) || !is_identifier(&d.name) {
            report
                .error("ST0120", place.clone(), format!("`{}` is a word that WGSL keeps for itself", d.name))
                .help("give it another name");
        }
        if d.entry {
            report
                .error("ST0125", place, format!("`{}` is an entry point; a node is a function", d.name))
                .help("remove `@vertex`, `@fragment` or `@compute`: entry points are written by the program");
        } else if d.keyword == "var" || d.keyword == "override" {
            report
                .error("ST0125", place, format!("`{}` is a module-scope {}", d.name, d.keyword))
                .help("what a node needs comes in through its parameters");
        }
    }
}

fn generic(report: &mut Report, header: &Header, applied: &Applied) {
    let Some(first) = header.generic.first() else {
        return;
    };
    let Applied { kept, declarations } = applied;
    match declarations.iter().find(|d| d.keyword == "alias" && d.name == "T") {
        None => {
            report
                .error("ST0122", 0..0, "a generic file has no `alias T`")
                .help(format!("add `alias T = {};` under the header", first.wgsl()));
        }
        Some(alias) => {
            let ty = initializer(&kept.text, alias).map(|r| kept.text[r].to_owned()).unwrap_or_default();
            if crate::semantic::Shape::from_wgsl(&ty) != *first {
                let place = kept.original_range(alias.name_range.clone());
                report
                    .error("ST0122", place, format!("`T` is `{ty}`, the header's first width is `{}`", first.wgsl()))
                    .help(format!("write `alias T = {};`", first.wgsl()));
            }
        }
    }
}
