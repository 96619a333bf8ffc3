//! Short names for contents: equal contents have equal fingerprints, and other contents others.
//!
//! 128 bits by folded multiplication, fast enough to be taken of every mesh for every picture. By chance, two contents
//! meet in one of some 10^19 pairs of a billion contents; nothing is kept from whoever would make them meet on purpose.

/// Stands for contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Fingerprint(u64, u64);

/// Takes a fingerprint, field by field.
#[derive(Clone, Debug)]
pub(super) struct Fingerprinter(u64, u64);

/// Digits of pi: numbers without a pattern.
const KEYS: [u64; 4] = [0x243f_6a88_85a3_08d3, 0x1319_8a2e_0370_7344, 0xa409_3822_299f_31d0, 0x082e_fa98_ec4e_6c89];

/// What stands beside the length of a field, beside a number, and at the end. None is among the keys: a factor of zero would
/// forget what came before.
const MARKS: [u64; 3] = [0x4528_21e6_38d0_1377, 0xbe54_66cf_34e9_0c6c, 0xc0ac_29b7_c97c_50dd];

/// Both halves of the product, one over the other: every bit depends on every bit of both.
fn fold(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    #[allow(clippy::cast_possible_truncation, reason = "the lower half is meant")]
    let low = product as u64;
    low ^ (product >> 64) as u64
}

impl Fingerprinter {
    pub(super) fn new() -> Self {
        Self(KEYS[2], KEYS[3])
    }

    fn words(&mut self, a: u64, b: u64) {
        *self = Self(fold(a ^ KEYS[0], b ^ self.0), fold(b ^ KEYS[1], a ^ self.1).rotate_left(23));
    }

    /// A field. Where it ends is part of it: `ab` and `c` are not `a` and `bc`.
    pub(super) fn bytes(mut self, bytes: &[u8]) -> Self {
        self.words(bytes.len() as u64, MARKS[0]);
        let (whole, rest) = bytes.as_chunks::<16>();
        let word = |part: &[u8]| part.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte));
        for chunk in whole {
            let [a, b] = bytemuck::cast::<[u8; 16], [u64; 2]>(*chunk);
            self.words(a, b);
        }
        if !rest.is_empty() {
            let (a, b) = rest.split_at(rest.len().min(8));
            self.words(word(a), word(b));
        }
        self
    }

    /// A number as a field.
    pub(super) fn number(mut self, number: u64) -> Self {
        self.words(number, MARKS[1]);
        self
    }

    /// Another fingerprint as a field.
    pub(super) fn and(mut self, other: Fingerprint) -> Self {
        self.words(other.0, other.1);
        self
    }

    pub(super) fn finish(&self) -> Fingerprint {
        let mut last = self.clone();
        last.words(MARKS[2], MARKS[2]);
        Fingerprint(last.0, last.1)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    fn of(fields: &[&[u8]]) -> Fingerprint {
        fields.iter().fold(Fingerprinter::new(), |f, bytes| f.bytes(bytes)).finish()
    }

    #[test]
    fn every_bit_counts_and_so_do_lengths() {
        let mut seen = HashSet::new();
        for length in 0..70 {
            let mut bytes = vec![0_u8; length];
            assert!(seen.insert(of(&[&bytes])), "{length} zeros");
            for bit in 0..length * 8 {
                bytes[bit / 8] ^= 1 << (bit % 8);
                assert!(seen.insert(of(&[&bytes])), "bit {bit} of {length}");
                bytes[bit / 8] ^= 1 << (bit % 8);
            }
        }
        assert_ne!(of(&[b"ab", b"c"]), of(&[b"a", b"bc"]));
        assert_ne!(of(&[b"a", b"b"]), of(&[b"b", b"a"]));
        assert_eq!(of(&[b"shadow", b"map"]), of(&[b"shadow", b"map"]));
    }
}
