//! What a study says of itself that a report repeats: its title and note, what others have published, and what is claimed.

use std::sync::Arc;

use super::claims::{Claim, read_claims};
use super::published::{Published, read_published};
use super::reading::Reader;
use crate::diagnostic::{Diagnostic, Place, SourceText};
use crate::ron::{self, Field, Tree, field};

/// The words of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// What it is called.
    pub title: String,
    /// What it is about.
    pub note: String,
    /// What others have published.
    pub published: Vec<Published>,
    /// What is claimed.
    pub claims: Vec<Claim>,
}

/// Reads them from the text of a study; its other fields are not looked at.
pub fn read(source: &Arc<SourceText>) -> (Sheet, Vec<Diagnostic>) {
    let (document, mut found) = ron::read(source);
    let Some(document) = document else { return (Sheet::default(), found) };
    let fields: &[Field] = match &document.root.value {
        Tree::Struct(Some(name), fields) if name == "Study" => fields,
        other => {
            let message = format!("expected `Study(...)`, found {}", other.describe());
            let help = "put the study's file there, or do without claims and published tables by removing it";
            found.push(Diagnostic::error("ST0667", message, Place::file(&source.name)).help(help));
            return (Sheet::default(), found);
        }
    };
    let mut sheet = Sheet::default();
    if let Some(node) = field(fields, "published") {
        sheet.published = read_published(node, source, None, &mut found);
    }
    if let Some(node) = field(fields, "claims") {
        sheet.claims = read_claims(node, source, None, &mut found);
    }
    let mut reader = Reader { source, found: &mut found };
    sheet.title = reader.text(fields, "title").unwrap_or_default();
    sheet.note = reader.text(fields, "note").unwrap_or_default();
    (sheet, found)
}
