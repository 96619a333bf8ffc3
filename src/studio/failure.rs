//! Why something could not be made of files.

use crate::diagnostic::{Diagnostic, Place};

/// What kind of failure it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FailureKind {
    /// The input is wrong; diagnostics say how.
    #[default]
    Input,
    /// What was asked for contradicts itself.
    Usage,
    /// A file cannot be read.
    Unreadable,
    /// No suitable graphics adapter, or it is gone.
    NoAdapter,
    /// It was called off.
    Cancelled,
}

/// A failure with all that is still to be told of it; what was told before, as it was found, is not repeated.
#[derive(Clone, Debug, Default)]
pub struct Failure {
    /// What kind it is.
    pub kind: FailureKind,
    /// What is still to be shown.
    pub diagnostics: Vec<Diagnostic>,
}

impl Failure {
    /// A failure with one diagnostic.
    pub fn new(kind: FailureKind, diagnostic: Diagnostic) -> Self {
        Self { kind, diagnostics: vec![diagnostic] }
    }

    /// What was asked for contradicts itself.
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::new(FailureKind::Usage, Diagnostic::error("ST0500", message, Place::default()).help(help))
    }

    /// A failure of which everything was told as it was found.
    pub fn told() -> Self {
        Self::default()
    }

    /// It was called off.
    pub fn cancelled() -> Self {
        Self { kind: FailureKind::Cancelled, diagnostics: Vec::new() }
    }
}

/// Diagnostics that were found in the input.
impl From<Vec<Diagnostic>> for Failure {
    fn from(diagnostics: Vec<Diagnostic>) -> Self {
        Self { kind: FailureKind::Input, diagnostics }
    }
}

/// Told of diagnostics as they are found.
pub trait Listener {
    /// Diagnostics, in the order in which they are to be shown.
    fn found(&self, diagnostics: &[Diagnostic]);

    /// A remark that only the curious want to read.
    fn detail(&self, _message: &str) {}

    /// A remark on how something was understood.
    fn note(&self, _message: &str) {}
}

/// Keeps what it is told.
#[derive(Debug, Default)]
pub struct Collected(std::cell::RefCell<Vec<Diagnostic>>);

impl Collected {
    /// Everything so far, each once.
    pub fn take(&self) -> Vec<Diagnostic> {
        let mut all: Vec<Diagnostic> = Vec::new();
        for diagnostic in self.0.take() {
            if !all.contains(&diagnostic) {
                all.push(diagnostic);
            }
        }
        all
    }
}

impl Listener for Collected {
    fn found(&self, diagnostics: &[Diagnostic]) {
        self.0.borrow_mut().extend_from_slice(diagnostics);
    }
}
