//! `explain`: more about a code.

use clap::Args;

use super::context::Context;
use super::exit::Outcome;
use super::{Exit, output};
use crate::diagnostic::{Diagnostic, Place, did_you_mean};
use crate::explain;

/// Tell more about a diagnostic code
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree explain ST0501
  shadetree explain          # lists all codes")]
pub(super) struct Explain {
    /// The code, as in `error[ST0501]`
    code: Option<String>,
}

impl Explain {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let entries = explain::entries();
        let json = |e: &explain::Entry| serde_json::json!({ "schema": 1, "code": e.code, "meaning": e.meaning, "more": e.more });
        let Some(code) = &self.code else {
            let line = |e: &explain::Entry| match context.is_json() {
                true => format!("{}\n", json(e)),
                false => format!("{}  {}\n", e.code, e.meaning),
            };
            output::print(entries.iter().map(line).collect::<String>().as_bytes())?;
            return Ok(Exit::Done);
        };
        let wanted = code.to_ascii_uppercase();
        let Some(entry) = explain::find(&wanted) else {
            let near = did_you_mean(&wanted, entries.iter().map(|e| e.code));
            let help = near.map_or("`shadetree explain` lists all codes".into(), |n| format!("did you mean {n}?"));
            let message = format!("there is no code `{code}`");
            return Err(vec![Diagnostic::error("ST0517", message, Place::default()).help(help)].into());
        };
        let text = match context.is_json() {
            true => format!("{}\n", json(&entry)),
            false if entry.more.is_empty() => format!("{}: {}\n", entry.code, entry.meaning),
            false => format!("{}: {}\n\n{}\n", entry.code, entry.meaning, entry.more),
        };
        output::print(text.as_bytes())?;
        Ok(Exit::Done)
    }
}
