//! Names in generated text: sanitised, never reserved, each used once.

use std::sync::OnceLock;

use crate::hash::{HashMap, HashSet};

use crate::node::is_reserved;

/// Names in use.
#[derive(Clone, Default)]
pub(crate) struct Names {
    used: HashSet<String>,
    /// The number to try next for a name that is taken.
    next: HashMap<String, usize>,
}

impl Names {
    /// Marks a name as used; whether it was free.
    pub(crate) fn claim(&mut self, name: &str) -> bool {
        !self.used.contains(name) && self.used.insert(name.to_owned())
    }

    /// A free name near `wanted`, now used.
    pub(crate) fn fresh(&mut self, wanted: &str) -> String {
        let base = sanitise(wanted);
        if !self.used.contains(&base) && !is_taken_by_wgsl(&base) {
            self.used.insert(base.clone());
            return base;
        }
        loop {
            let count = self.next.entry(base.clone()).or_insert(1);
            *count += 1;
            let name = format!("{base}_{count}");
            if self.used.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// A WGSL identifier near `name`: `car/spot light` becomes `car_spot_light`.
pub(crate) fn sanitise(name: &str) -> String {
    let plain = |pair: &[u8]| matches!(pair[1], b'a'..=b'z' | b'0'..=b'9') || (pair[1] == b'_' && pair[0] != b'_');
    if name.as_bytes().windows(2).all(plain)
        && name.starts_with(|c: char| c.is_ascii_lowercase())
        && !name.ends_with('_')
    {
        return name.to_owned();
    }
    let mut out = String::with_capacity(name.len());
    for c in name.chars() {
        let c = if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
        // None at the start, none twice.
        if c != '_' || !(out.is_empty() || out.ends_with('_')) {
            out.push(c);
        }
    }
    out.truncate(out.trim_end_matches('_').len());
    if !out.starts_with(|c: char| c.is_ascii_alphabetic()) {
        out.insert(0, 'n');
    }
    out
}

fn is_taken_by_wgsl(name: &str) -> bool {
    static BUILTIN: OnceLock<HashSet<&str>> = OnceLock::new();
    is_reserved(name) || BUILTIN.get_or_init(|| BUILTINS.iter().copied().collect()).contains(name)
}

/// Predeclared functions and types that a name of ours must not shadow.
const BUILTINS: &[&str] = &[
    "abs",
    "acos",
    "acosh",
    "all",
    "any",
    "array",
    "asin",
    "asinh",
    "atan",
    "atan2",
    "atanh",
    "atomic",
    "bitcast",
    "bool",
    "ceil",
    "clamp",
    "cos",
    "cosh",
    "cross",
    "degrees",
    "determinant",
    "distance",
    "dot",
    "dpdx",
    "dpdy",
    "exp",
    "exp2",
    "f16",
    "f32",
    "floor",
    "fma",
    "fract",
    "frexp",
    "fwidth",
    "i32",
    "ldexp",
    "length",
    "log",
    "log2",
    "max",
    "min",
    "mix",
    "modf",
    "normalize",
    "pow",
    "ptr",
    "radians",
    "reflect",
    "refract",
    "round",
    "sampler",
    "saturate",
    "select",
    "sign",
    "sin",
    "sinh",
    "smoothstep",
    "sqrt",
    "step",
    "tan",
    "tanh",
    "transpose",
    "trunc",
    "u32",
    "vec2f",
    "vec3f",
    "vec4f",
    "mat2x2f",
    "mat3x3f",
    "mat4x4f",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_legal_and_unique() {
        let mut names = Names::default();
        assert_eq!(names.fresh("car/spot light"), "car_spot_light");
        assert_eq!(names.fresh("car/spot light"), "car_spot_light_2");
        assert_eq!(names.fresh("mix"), "mix_2");
        assert_eq!(names.fresh("3d"), "n3d");
        assert_eq!(names.fresh("ü"), "n");
        assert_eq!(names.fresh("fn"), "fn_2");
    }
}
