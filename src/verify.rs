//! Proves a module with naga: parsed, and validated in full, for what every WebGPU device can do.

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use crate::diagnostic::{Diagnostic, Place};
use crate::module::Module;

/// Stack for naga, which recurses over nested expressions: what a long chain of nodes may need, with a wide margin.
/// Only pages that are touched cost memory.
const STACK_BYTES: usize = 256 << 20;

/// A module that naga accepted, in naga's form: what other languages and devices are given.
#[derive(Debug)]
pub struct Verified {
    /// The parsed module.
    pub module: naga::Module,
    /// What validation found out about it.
    pub info: ModuleInfo,
}

/// Parses and validates a module with every check on and no optional capability allowed. Each error names the node and
/// the port that the WGSL came from. It is an internal error unless the text came from a node that a person wrote.
pub fn verify(module: &Module) -> Result<Verified, Vec<Diagnostic>> {
    let checked = if is_shallow(&module.wgsl) {
        // A thread costs as much as a short module does.
        catch_unwind(AssertUnwindSafe(|| check(&module.wgsl))).map_err(|_| stopped())
    } else {
        on_large_stack(|| check(&module.wgsl))
    };
    checked.and_then(|r| r).map_err(|fault| fault.report(module))
}

/// Deepest brackets, most operators and members in a statement, and most branches, with which naga needs no more than half
/// a small stack (2 MiB): it recurses over each, at no more than 8 KiB a level with optimisation off.
const SHALLOW: usize = 64;
/// Most declarations, which naga sorts by recursion over what they mention.
const FEW: usize = 512;

/// Whether naga can take a text without recursing deeply. Comments count as if they were code, which errs on the safe
/// side: an end of a statement in a comment is followed by the end of the line, never by more of a statement.
fn is_shallow(wgsl: &str) -> bool {
    if wgsl.matches("else").nth(SHALLOW).is_some() {
        return false;
    }
    let (mut depth, mut operators, mut declarations) = (0_usize, 0_usize, 0_usize);
    let bytes = wgsl.as_bytes();
    for (at, byte) in bytes.iter().copied().enumerate() {
        match byte {
            b'(' => depth += 1,
            // `a[0][1]` is as deep as `a.b.c`.
            b'[' => (depth, operators) = (depth + 1, operators + 1),
            b'.' => operators += usize::from(bytes.get(at + 1).is_some_and(|b| !b.is_ascii_digit())),
            b')' | b']' => depth = depth.saturating_sub(1),
            b'+' | b'-' | b'*' | b'/' | b'%' | b'&' | b'|' | b'^' | b'<' | b'>' | b'=' | b'!' | b'~' => operators += 1,
            b'{' | b'}' | b';' => {
                operators = 0;
                match byte {
                    b'{' => depth += 1,
                    b'}' => depth = depth.saturating_sub(1),
                    _ => {}
                }
                declarations += usize::from(depth == 0);
            }
            _ => continue,
        }
        if depth > SHALLOW || operators > SHALLOW || declarations > FEW {
            return false;
        }
    }
    true
}

fn stopped() -> Fault {
    Fault::new("naga stopped unexpectedly")
}

/// Runs `work` on a thread whose stack holds the deepest module, and turns a panic there into a fault.
pub(crate) fn on_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, Fault> {
    std::thread::scope(|scope| {
        let spawned = std::thread::Builder::new().name("naga".into()).stack_size(STACK_BYTES).spawn_scoped(scope, work);
        let thread = spawned.map_err(|e| Fault::new(format!("no thread for validation: {e}")))?;
        thread.join().map_err(|_| stopped())
    })
}

/// What naga objects to, before it is mapped to nodes.
#[derive(Debug)]
pub(crate) struct Fault {
    message: String,
    /// Byte ranges of the WGSL, the most telling first, with what is said about each.
    at: Vec<(Range<usize>, String)>,
    notes: Vec<String>,
}

impl Fault {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), at: Vec::new(), notes: Vec::new() }
    }

    fn report(self, module: &Module) -> Vec<Diagnostic> {
        let origin = self.at.iter().find_map(|(range, _)| module.origin_of(range.start));
        let place = match origin {
            Some(origin) => {
                let place = Place::default().node(&*origin.node);
                origin.port.iter().fold(place, |p, port| p.port(&**port))
            }
            None => Place::default(),
        };
        let mut diagnostic =
            Diagnostic::error("ST0900", format!("naga rejects the woven WGSL: {}", self.message), place);
        for (range, said) in &self.at {
            diagnostic = diagnostic.note(quote(&module.wgsl, range, said));
        }
        for note in self.notes {
            diagnostic = diagnostic.note(note);
        }
        vec![diagnostic.help("if the node is your own, correct its WGSL; otherwise this is a fault in shadetree")]
    }
}

/// `WGSL line N: text`, with what is said about it.
fn quote(wgsl: &str, range: &Range<usize>, said: &str) -> String {
    let before = wgsl.get(..range.start).unwrap_or_default();
    let start = before.rfind('\n').map_or(0, |i| i + 1);
    let number = before.matches('\n').count() + 1;
    let line = wgsl[start..].lines().next().unwrap_or_default().trim();
    let said = if said.is_empty() || said == "see msg" || said.starts_with("naga::") {
        String::new()
    } else {
        format!(" ({said})")
    };
    format!("WGSL line {number}: {line}{said}")
}

fn check(wgsl: &str) -> Result<Verified, Fault> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| Fault {
        message: error.message().to_owned(),
        at: error.labels().filter_map(|(span, said)| Some((span.to_range()?, said.to_owned()))).collect(),
        notes: error.notes().map(str::to_owned).collect(),
    })?;
    // naga's default capabilities hold more than WebGPU core guarantees, and nothing woven needs them.
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    let info = validator.validate(&module).map_err(|error| {
        let mut chain = vec![error.as_inner().to_string()];
        let mut cause = std::error::Error::source(error.as_inner());
        while let Some(inner) = cause {
            chain.push(inner.to_string());
            cause = inner.source();
        }
        Fault {
            message: chain.join(": "),
            at: error.spans().filter_map(|(span, said)| Some((span.to_range()?, said.clone()))).collect(),
            notes: Vec::new(),
        }
    })?;
    Ok(Verified { module, info })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::module::Origin;

    fn module(wgsl: &str, bad: &str) -> Module {
        let start = wgsl.find(bad).expect("the marked text is there");
        let origin = Origin { start, end: start + bad.len(), node: "noise".into(), port: Some("scale".into()) };
        Module { wgsl: wgsl.into(), source_map: vec![origin], ..Module::default() }
    }

    #[test]
    fn accepts_what_is_valid() {
        let wgsl = "@fragment fn fs_main() -> @location(0) vec4f { return vec4f(1.0); }\n";
        let verified = verify(&Module { wgsl: wgsl.into(), ..Module::default() }).expect("valid");
        assert_eq!(verified.module.entry_points.len(), 1);
    }

    #[test]
    fn what_is_deep_is_known_before() {
        assert!(is_shallow("fn a(x: f32) -> f32 { let y = (x + 1.0) * 2.0; return y; }\n"));
        let brackets = format!("fn a() -> f32 {{ return {}1.0{}; }}", "(".repeat(80), ")".repeat(80));
        let sum = format!("fn a() -> f32 {{ return 1.0{}; }}", " + 1.0".repeat(80));
        let many: String = (0..600).map(|i| format!("const C{i} = 1.0;\n")).collect();
        let members = format!("fn a(v: vec3f) -> vec3f {{ return v{}; }}", ".xyz".repeat(80));
        let indices = format!("fn a(v: vec3f) -> f32 {{ return v{}; }}", "[0]".repeat(80));
        let branches = format!("fn a(b: bool) {{ if b {{}} {} }}", "else if b {} ".repeat(80));
        for deep in [brackets, sum, many, members, indices, branches] {
            assert!(!is_shallow(&deep), "{deep}");
        }
        let statements = format!("fn a() {{ {} }}", "let b = 1.0 + 2.0; ".repeat(600));
        assert!(is_shallow(&statements));
        // What is not deep by that measure fits in half of the smallest stack, unoptimised.
        let edge = format!(
            "@fragment fn a() -> @location(0) vec4f {{ return vec4f({}1.0{}{}); }}",
            "abs(".repeat(SHALLOW - 4),
            ")".repeat(SHALLOW - 4),
            " + 1.0".repeat(SHALLOW - 4)
        );
        assert!(is_shallow(&edge));
        let work = move || check(&edge).is_ok();
        let thread = std::thread::Builder::new().stack_size(1 << 20).spawn(work).expect("a thread");
        assert!(thread.join().expect("no panic"));
    }

    #[test]
    fn a_parse_error_names_node_port_and_line() {
        let errors =
            verify(&module("fn a() -> f32 {\n    let b = wobble;\n    return b;\n}\n", "wobble")).expect_err("invalid");
        let place = &errors[0].place;
        assert_eq!((place.node.as_deref(), place.port.as_deref()), (Some("noise"), Some("scale")));
        assert!(errors[0].notes[0].starts_with("WGSL line 2: let b = wobble;"), "{:?}", errors[0].notes);
    }

    #[test]
    fn a_validation_error_names_node_and_line() {
        let errors = verify(&module(
            "fn a(v: vec3f) -> f32 {\n    let b = determinant(v);\n    return b;\n}\n",
            "determinant(v)",
        ))
        .expect_err("invalid");
        assert_eq!(errors[0].place.node.as_deref(), Some("noise"), "{errors:?}");
        assert_eq!(errors[0].code, "ST0900");
    }
}
