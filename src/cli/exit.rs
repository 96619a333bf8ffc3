//! How a command ends.

use std::path::Path;

use crate::diagnostic::{Diagnostic, Place};
use crate::studio::{self, FailureKind};

/// Exit codes. 101 (a panic) is a fault in the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Done.
    Done = 0,
    /// The input is wrong; diagnostics say how.
    Input = 1,
    /// The command line is wrong.
    Usage = 2,
    /// A file cannot be read or written.
    Io = 3,
    /// No suitable graphics adapter.
    NoAdapter = 4,
}

impl From<FailureKind> for Exit {
    fn from(kind: FailureKind) -> Self {
        match kind {
            FailureKind::Input | FailureKind::Cancelled => Self::Input,
            FailureKind::Usage => Self::Usage,
            FailureKind::Unreadable => Self::Io,
            FailureKind::NoAdapter => Self::NoAdapter,
        }
    }
}

/// Why a command did not do what it was asked.
#[derive(Debug)]
pub(super) struct Failure {
    pub(super) exit: Exit,
    /// What is still to be shown.
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl Failure {
    pub(super) fn new(exit: Exit, diagnostic: Diagnostic) -> Self {
        Self { exit, diagnostics: vec![diagnostic] }
    }

    /// The command line contradicts itself.
    pub(super) fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::new(Exit::Usage, Diagnostic::error("ST0500", message, Place::default()).help(help))
    }

    /// A file could not be written.
    pub(super) fn write(path: &Path, error: &std::io::Error) -> Self {
        let message = format!("cannot write: {error}");
        let place = Place::file(path.display().to_string());
        let help = "give -o a path in a folder that exists and that you may write to";
        Self::new(Exit::Io, Diagnostic::error("ST0505", message, place).help(help))
    }
}

impl From<studio::Failure> for Failure {
    fn from(failure: studio::Failure) -> Self {
        Self { exit: failure.kind.into(), diagnostics: failure.diagnostics }
    }
}

/// Diagnostics that were found in the input.
impl From<Vec<Diagnostic>> for Failure {
    fn from(diagnostics: Vec<Diagnostic>) -> Self {
        Self { exit: Exit::Input, diagnostics }
    }
}

/// What a command returns.
pub(super) type Outcome = Result<Exit, Failure>;
