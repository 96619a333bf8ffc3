//! Text that remembers where its bytes come from, and the filling of templates.

use std::sync::Arc;

use crate::module::Origin;

/// Text in the making.
#[derive(Clone, Default)]
pub(crate) struct Text {
    text: String,
    origins: Vec<Origin>,
}

impl Text {
    pub(crate) fn len(&self) -> usize {
        self.text.len()
    }

    pub(crate) fn push(&mut self, text: &str) {
        self.text.push_str(text);
    }

    pub(crate) fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    /// An empty line, unless one is there.
    pub(crate) fn blank(&mut self) {
        if !self.text.ends_with("\n\n") {
            self.text.push('\n');
        }
    }

    /// Says that everything since `start` comes from a node.
    pub(crate) fn origin(&mut self, start: usize, node: &Arc<str>, port: Option<&Arc<str>>) {
        if start < self.text.len() {
            self.origins.push(Origin { start, end: self.text.len(), node: node.clone(), port: port.cloned() });
        }
    }

    /// Adds another text with its origins.
    pub(crate) fn append(&mut self, other: &Self) {
        let shift = self.text.len();
        self.text.push_str(&other.text);
        let moved = |o: &Origin| Origin { start: o.start + shift, end: o.end + shift, ..o.clone() };
        self.origins.extend(other.origins.iter().map(moved));
    }

    pub(crate) fn as_str(&self) -> &str {
        &self.text
    }

    pub(crate) fn finish(mut self) -> (String, Vec<Origin>) {
        self.origins.sort_by(|a, b| (a.start, b.end, &a.node, &a.port).cmp(&(b.start, a.end, &b.node, &b.port)));
        self.origins.dedup();
        (self.text, self.origins)
    }
}

/// The operands that the template reads, as often as it does.
pub(crate) fn slots(template: &str) -> impl Iterator<Item = usize> + '_ {
    parts(template).filter_map(|p| if let Part::Slot(i, _) = p { Some(i) } else { None })
}

/// A piece of a template.
pub(crate) enum Part<'a> {
    /// Text as it is.
    Plain(&'a str),
    /// An operand, and whether it stands alone between brackets or commas, so that it needs no brackets of its own.
    Slot(usize, bool),
}

/// The pieces of a template in order.
pub(crate) fn parts(template: &str) -> impl Iterator<Item = Part<'_>> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let rest = &template[at..];
        if rest.is_empty() {
            return None;
        }
        let Some(digits) = rest.strip_prefix('$') else {
            let end = rest.find('$').unwrap_or(rest.len());
            at += end;
            return Some(Part::Plain(&rest[..end]));
        };
        let count = digits.bytes().take_while(u8::is_ascii_digit).count();
        let before = template[..at].trim_end().bytes().last();
        at += 1 + count;
        let after = template[at..].trim_start().bytes().next();
        let alone = matches!(before, None | Some(b'(' | b',')) && matches!(after, None | Some(b')' | b','));
        Some(Part::Slot(digits[..count].parse().unwrap_or(0), alone))
    })
}

/// Whether an expression can be an operand of anything without brackets: a name, a literal, a member or a call.
pub(crate) fn is_atomic(text: &str) -> bool {
    let mut depth = 0_i32;
    let mut previous = b' ';
    for (i, c) in text.bytes().enumerate() {
        match c {
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth -= 1,
            b' ' if depth == 0 => return false,
            b'-' | b'!' | b'~' | b'&' if depth == 0 && i == 0 => return false,
            // A plus sign after an `e` is part of a number.
            b'+' if depth == 0 && previous == b'e' => {}
            b'+' | b'*' | b'/' | b'%' | b'<' | b'>' | b'|' | b'^' if depth == 0 => return false,
            _ => {}
        }
        previous = c;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn atoms_need_no_brackets() {
        for atom in ["a", "a.b", "f(a + b)", "(a + b)", "1.0", "1e+20", "a[i + 1].x", "f(a)(b)"] {
            assert!(is_atomic(atom), "{atom}");
        }
        for sum in ["a + b", "-a", "!a", "a * (b)", "(a) + (b)", "a<b"] {
            assert!(!is_atomic(sum), "{sum}");
        }
    }

    #[test]
    fn slots_know_their_surroundings() {
        let alone: Vec<bool> =
            parts("f($0, $1 * 2.0)").filter_map(|p| if let Part::Slot(_, a) = p { Some(a) } else { None }).collect();
        assert_eq!(alone, [true, false]);
        assert_eq!(slots("$0 * $0 + $10").collect::<Vec<_>>(), [0, 0, 10]);
    }
}
