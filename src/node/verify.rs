//! Proving a node file: every set of choices, every width, through naga's parser and validator.

use super::catalog::Catalog;
use super::check::{check, guard};
use super::definition::{Choices, Header};
use super::file::{self, NodeFile};
use super::report::Report;
use crate::diagnostic::{Diagnostic, Place};
use crate::semantic::Shape;

/// The most sets of choices that are tried for one file.
const MAX_COMBINATIONS: usize = 64;
/// The largest node file, in bytes.
const MAX_FILE: usize = 1 << 20;

impl NodeFile {
    /// Everything that is wrong with the file, function bodies included: all sets of choices (all singles and then
    /// pairs where there are more than 64), with all widths of a generic file.
    pub fn verify(&self, catalog: &Catalog) -> Vec<Diagnostic> {
        if let Some((range, message)) = guard(&self.source().text, MAX_FILE) {
            let mut report = Report::new(self.source());
            report.error("ST0130", range, message).help("split it into shorter functions and statements");
            return report.found;
        }
        let header = match self.header() {
            Ok(header) => header,
            Err(found) => return found,
        };
        let mut found = catalog.unknown_libraries(&header);
        for choices in combinations(&header) {
            let new = self.verify_one(&header, &choices, catalog);
            for diagnostic in new {
                let known = |d: &Diagnostic| {
                    (d.code, &d.place, &d.message) == (diagnostic.code, &diagnostic.place, &diagnostic.message)
                };
                if !found.iter().any(known) {
                    found.push(diagnostic);
                }
            }
        }
        found
    }

    fn verify_one(&self, header: &Header, choices: &Choices, catalog: &Catalog) -> Vec<Diagnostic> {
        let definition = match self.definition(choices) {
            Ok(definition) => definition,
            Err(found) => return found,
        };
        let libraries = catalog.libraries_of(&definition);
        let mut report = Report::new(self.source());
        let applied = file::apply(&mut report, &header.options, &definition.choices);
        let mut found = report.found;
        let alias = applied.declarations.iter().find(|d| d.name == "T" && d.keyword == "alias");
        let widths: &[Shape] = if header.generic.is_empty() { &[Shape::Generic] } else { &header.generic };
        for width in widths {
            let mut kept = applied.kept.clone();
            if let (Some(alias), false) = (alias, *width == Shape::Generic) {
                kept.replace(alias.range.clone(), &format!("alias T = {};", width.wgsl()));
            }
            for mut error in check(&libraries, &kept, self.source()) {
                if !definition.choices.is_empty() {
                    let made: Vec<String> = definition.choices.iter().map(|(n, c)| format!("{n} = {c}")).collect();
                    error.notes.push(format!("with {}", made.join(", ")));
                }
                if *width != Shape::Generic {
                    error.notes.push(format!("with T = {}", width.wgsl()));
                }
                found.push(error);
            }
        }
        found
    }
}

impl Catalog {
    /// An error for each direct `use:` that names no library.
    pub(crate) fn unknown_libraries(&self, header: &Header) -> Vec<Diagnostic> {
        let unknown = header.uses.iter().filter(|name| self.library(name).is_none());
        unknown
            .map(|name| {
                let text = &header.source.text;
                let at = super::report::lines(text)
                    .find(|l| l.text.trim_start_matches("//!").trim_start().starts_with("use:"))
                    .and_then(|l| l.text.find(name.as_str()).map(|i| l.at + i));
                let place = match at {
                    Some(at) => Place::span(crate::diagnostic::Span::new(&header.source, at..at + name.len())),
                    None => Place::file(&header.source.name),
                };
                let mut error = Diagnostic::error("ST0128", format!("there is no library `{name}`"), place);
                error.help = Some(match crate::diagnostic::did_you_mean(name, self.library_names()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("libraries are {}", self.library_names().collect::<Vec<_>>().join(", ")),
                });
                error
            })
            .collect()
    }
}

/// The sets of choices to try: all, or the defaults with one and then two options changed, up to the limit.
pub(crate) fn combinations(header: &Header) -> Vec<Choices> {
    let options = &header.options;
    let all = options.iter().try_fold(1usize, |n, o| n.checked_mul(o.choices.len()));
    if all.is_some_and(|n| n <= MAX_COMBINATIONS) {
        return options.iter().fold(vec![Choices::new()], |sets, option| {
            let extended = sets.iter().flat_map(|set| {
                option.choices.iter().map(move |choice| {
                    let mut set = set.clone();
                    set.insert(option.name.clone(), choice.clone());
                    set
                })
            });
            extended.collect()
        });
    }
    let mut sets = vec![Choices::new()];
    let changes: Vec<(usize, &String)> = options
        .iter()
        .enumerate()
        .flat_map(|(i, o)| o.choices.iter().filter(|c| **c != o.default).map(move |c| (i, c)))
        .collect();
    let change = |picks: &[(usize, &String)]| -> Choices {
        picks.iter().map(|(i, c)| (options[*i].name.clone(), (*c).clone())).collect()
    };
    sets.extend(changes.iter().map(|c| change(&[*c])));
    for (n, a) in changes.iter().enumerate() {
        sets.extend(changes[n + 1..].iter().filter(|b| b.0 != a.0).map(|b| change(&[*a, *b])));
        if sets.len() >= MAX_COMBINATIONS {
            break;
        }
    }
    sets.truncate(MAX_COMBINATIONS);
    sets
}
