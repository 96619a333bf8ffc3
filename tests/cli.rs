//! The program as people and scripts run it: exit codes, what goes to stdout and what to stderr, and files.

mod chart;
mod commands;
#[cfg(feature = "render")]
mod choose;
#[cfg(feature = "render")]
mod compare;
#[cfg(feature = "render")]
mod figure;
pub(crate) mod generate;
mod json;
#[cfg(feature = "render")]
mod reference;
#[cfg(feature = "render")]
mod render;
#[cfg(feature = "render")]
mod simplify;
#[cfg(feature = "render")]
mod study;
#[cfg(unix)]
mod watch;

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value as Json;

/// A light with a shadow, and surfaces, of the examples.
pub(crate) const LIGHT: &str = "graphs/lights/spot_pcf.ron";
pub(crate) const SURFACE: &str = "graphs/surfaces/oren_nayar.ron";

/// What a run gave.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) code: Option<i32>,
    pub(crate) out: Vec<u8>,
    pub(crate) err: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: output.stdout,
            err: String::from_utf8(output.stderr).expect("messages are UTF-8"),
        }
    }
}

impl Ran {
    /// stdout as text.
    pub(crate) fn text(&self) -> &str {
        std::str::from_utf8(&self.out).expect("text")
    }

    /// The same run, which must have ended with this code.
    #[track_caller]
    pub(crate) fn exits(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "stdout: {}\nstderr: {}", String::from_utf8_lossy(&self.out), self.err);
        self
    }

    /// The same run, which must have named this on stderr.
    #[track_caller]
    pub(crate) fn says(self, what: &str) -> Self {
        assert!(self.err.contains(what), "`{what}` is not in: {}", self.err);
        self
    }

    /// The same run, which must have kept stdout empty: there is no data.
    #[track_caller]
    pub(crate) fn no_data(self) -> Self {
        assert!(self.out.is_empty(), "{}", String::from_utf8_lossy(&self.out));
        self
    }

    /// stderr as JSON, one object a line, each of the documented form.
    #[track_caller]
    pub(crate) fn diagnostics(&self) -> Vec<Json> {
        let parsed = self.err.lines().map(|line| {
            let json: Json = serde_json::from_str(line).unwrap_or_else(|e| panic!("{e} in `{line}`"));
            assert_eq!(json["schema"], 1, "{line}");
            let code = json["code"].as_str().unwrap_or_default();
            assert!(code.len() == 6 && code.starts_with("ST"), "{line}");
            assert!(matches!(json["severity"].as_str(), Some("error" | "warning")), "{line}");
            assert!(json["message"].as_str().is_some_and(|m| !m.is_empty()), "{line}");
            for key in ["file", "line", "column", "end", "node", "port", "help", "notes"] {
                assert!(json.get(key).is_some(), "no `{key}` in {line}");
            }
            json
        });
        parsed.collect()
    }
}

/// The program, in the package's folder, without colours from the environment.
pub(crate) fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_shadetree"));
    command.current_dir(crate::support::root()).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    command
}

/// Runs the program with words split at blanks.
pub(crate) fn run(line: &str) -> Ran {
    run_with(&line.split_whitespace().collect::<Vec<_>>())
}

/// Runs the program with these arguments.
pub(crate) fn run_with(arguments: &[&str]) -> Ran {
    program().args(arguments).stdin(Stdio::null()).output().expect("the program starts").into()
}

/// Runs the program with words split at blanks and this on stdin.
pub(crate) fn run_fed(line: &str, input: &[u8]) -> Ran {
    let mut child = program()
        .args(line.split_whitespace())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdin = child.stdin.take().expect("piped");
    let input = input.to_vec();
    // A program that stops early closes the pipe; that is its right.
    let writer = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().expect("it ends");
    writer.join().expect("the writer ends");
    output.into()
}

/// Writes a file of a test's own folder and gives its path.
pub(crate) fn put(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
    std::fs::write(&path, text).expect("written");
    path.display().to_string()
}

/// Names of what a folder holds, sorted.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("readable");
    let mut names: Vec<String> =
        entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}
