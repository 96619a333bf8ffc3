//! What every command shares: how to speak, and to whom. Data goes to stdout, messages go to stderr.

use std::io::{IsTerminal, Write};

use clap::ValueEnum;

use crate::diagnostic::{Diagnostic, Severity, has_errors};
use crate::report;
use crate::studio::Listener;

/// Form of messages and listings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// For people.
    #[default]
    Text,
    /// JSON, one object a line.
    Json,
    /// Markdown (only `nodes`).
    Md,
}

/// When to colour messages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Color {
    /// On a terminal, unless NO_COLOR is set.
    #[default]
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// How a command speaks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Context {
    pub(super) format: Format,
    pub(super) color: bool,
    pub(super) quiet: bool,
    pub(super) verbose: u8,
}

impl Context {
    pub(super) fn new(format: Format, color: Color, quiet: bool, verbose: u8) -> Self {
        let plain = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
        let color = match color {
            Color::Always => true,
            Color::Never => false,
            Color::Auto => !plain && std::io::stderr().is_terminal(),
        };
        Self { format, color, quiet, verbose }
    }

    pub(super) fn is_json(&self) -> bool {
        self.format == Format::Json
    }

    /// Shows diagnostics; errors also where quiet was asked for. Answers whether there was an error.
    pub(super) fn report(&self, diagnostics: &[Diagnostic]) -> bool {
        let mut text = String::new();
        for diagnostic in diagnostics.iter().filter(|d| !self.quiet || d.severity == Severity::Error) {
            if self.is_json() {
                text.push_str(&report::json(diagnostic).to_string());
                text.push('\n');
            } else {
                text.push_str(&report::text(diagnostic, self.color));
                text.push('\n');
            }
        }
        // Nobody is left to tell when stderr is gone.
        let _ = std::io::stderr().lock().write_all(text.as_bytes());
        has_errors(diagnostics)
    }

    /// A message for people, unless they asked for quiet or a program listens.
    pub(super) fn say(&self, message: &str) {
        if !self.quiet && !self.is_json() {
            let _ = writeln!(std::io::stderr().lock(), "{message}");
        }
    }

    /// A message that only `-v` shows.
    pub(super) fn detail(&self, message: &str) {
        if self.verbose > 0 {
            self.say(message);
        }
    }

    /// Whether progress may be drawn.
    #[cfg(feature = "render")]
    pub(super) fn draws_progress(&self) -> bool {
        !self.quiet && !self.is_json() && std::io::stderr().is_terminal()
    }
}

impl Listener for Context {
    fn found(&self, diagnostics: &[Diagnostic]) {
        self.report(diagnostics);
    }

    fn detail(&self, message: &str) {
        Self::detail(self, message);
    }

    fn note(&self, message: &str) {
        self.say(message);
    }
}
