//! The filtered methods side by side: each is what its formula makes of the distribution in the filter.

use shadetree::compile::Compiled;
use shadetree::reference::{Weights, chebyshev, exponential, hamburger, signed_moments, warped_bound};

use super::lamp::{Lamp, PLAIN};

/// A method with 32-bit storage and no reduction of bleeding, and what it makes of a distribution and a receiver's depth.
pub(super) struct Method {
    pub(super) name: &'static str,
    kind: &'static str,
    params: &'static str,
    options: &'static str,
    pub(super) value: fn(&[(f64, f64)], f64) -> f64,
}

pub(super) fn variance(seen: &[(f64, f64)], receiver: f64) -> f64 {
    let power = |n: i32| seen.iter().map(|(z, share)| share * z.powi(n)).sum();
    chebyshev(power(1), power(2), receiver, 1e-6)
}

fn rising(seen: &[(f64, f64)], receiver: f64) -> f64 {
    warped_bound(seen, receiver, 40.0, 1e-8)
}

fn both(seen: &[(f64, f64)], receiver: f64) -> f64 {
    rising(seen, receiver).min(warped_bound(seen, receiver, -5.0, 1e-8))
}

fn four(seen: &[(f64, f64)], receiver: f64) -> f64 {
    hamburger(signed_moments(seen, 3e-7, 0.375), 2.0 * receiver - 1.0)
}

pub(super) const METHODS: [Method; 5] = [
    Method {
        name: "VSM",
        kind: "variance_shadow",
        params: "\"bleeding_reduction\": 0, \"minimum_variance\": 0.000001",
        options: "\"format\": \"rg32float\"",
        value: variance,
    },
    Method {
        name: "ESM",
        kind: "exponential_shadow",
        params: "",
        options: "\"exponent\": \"80\"",
        value: |seen, receiver| exponential(seen, receiver, 80.0),
    },
    Method {
        name: "EVSM2",
        kind: "exponential_variance_shadow",
        params: "",
        options: "\"warps\": \"one\", \"exponent\": \"40\"",
        value: rising,
    },
    Method {
        name: "EVSM4",
        kind: "exponential_variance_shadow",
        params: "",
        options: "\"warps\": \"two\", \"exponent\": \"40\", \"falling\": \"5\"",
        value: both,
    },
    Method { name: "MSM4", kind: "moment_shadow", params: "\"bleeding_reduction\": 0", options: "", value: four },
];

impl Method {
    pub(super) fn named(name: &str) -> &'static Self {
        METHODS.iter().find(|m| m.name == name).expect("a method")
    }

    pub(super) fn shader(&self, lamp: Lamp, weights: Weights, width: usize) -> Compiled {
        let weights = Weights::ALL.iter().find(|(_, w)| *w == weights).expect("listed").0;
        // Without an own word on options there is one comma less.
        let own = if self.options.is_empty() { String::new() } else { format!("{}, ", self.options) };
        let sampling = "\"sampling\": \"manual\"";
        lamp.shadow(
            self.kind,
            self.params,
            &format!("{own}\"width\": \"{width}\", \"weights\": \"{weights}\", {sampling}, {PLAIN}"),
        )
    }
}
