//! `//#if NAME == a | b`, `//#elif`, `//#else`, `//#end`: text kept or dropped by the choices made.

use std::ops::Range;

/// How deep conditions may nest.
const MAX_DEPTH: usize = 16;

/// A mistake in the conditions of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ConditionError {
    /// Bytes of the original text.
    pub(crate) range: Range<usize>,
    /// What is wrong.
    pub(crate) message: String,
}

/// What is left of a text, and where it came from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Kept {
    /// The text.
    pub(crate) text: String,
    /// Where runs of it start: offset here, offset in the original; ascending.
    runs: Vec<(usize, usize)>,
}

impl Kept {
    /// The offset in the original text of an offset in the kept one.
    pub(crate) fn original(&self, offset: usize) -> usize {
        let next = self.runs.partition_point(|(here, _)| *here <= offset);
        match next.checked_sub(1) {
            Some(i) => self.runs[i].1 + (offset - self.runs[i].0),
            None => offset,
        }
    }

    /// The same for a range.
    pub(crate) fn original_range(&self, range: Range<usize>) -> Range<usize> {
        let start = self.original(range.start);
        // The end belongs to the run of the last byte, not to the one that may begin right behind it.
        let end = if range.end > range.start { self.original(range.end - 1) + 1 } else { start };
        start..end.max(start)
    }
}

impl Kept {
    /// Writes `new` in place of `range`; the new text counts as standing where the old one begins.
    pub(crate) fn replace(&mut self, range: Range<usize>, new: &str) {
        let behind = self.original(range.end.saturating_sub(1)) + 1;
        let start = self.original(range.start);
        let (old, now) = (range.len(), new.len());
        self.text.replace_range(range.clone(), new);
        self.runs.retain(|(here, _)| *here < range.start || *here >= range.end);
        for (here, _) in &mut self.runs {
            if *here >= range.end {
                *here = *here - old + now;
            }
        }
        self.runs.extend([(range.start, start), (range.start + now, behind)]);
        self.runs.sort_unstable();
        self.runs.dedup_by_key(|(here, _)| *here);
    }
}

/// The choice made for an option, and all that it could be.
pub(crate) type Lookup<'f, 'a> = &'f dyn Fn(&str) -> Option<(&'a str, &'a [String])>;

struct Block {
    start: Range<usize>,
    /// Whether the text around the block is kept.
    outer: bool,
    /// Whether a branch has been taken already.
    taken: bool,
    /// Whether the current branch is kept.
    on: bool,
    had_else: bool,
}

/// Applies the conditions of `text`. `choice` gives the choice made for an option and all that it could be; every
/// name and every alternative is checked against it, also in dropped text.
pub(crate) fn apply<'a>(text: &str, choice: Lookup<'_, 'a>) -> (Kept, Vec<ConditionError>) {
    let mut kept = Kept { text: String::with_capacity(text.len()), runs: Vec::new() };
    let mut errors = Vec::new();
    let mut blocks: Vec<Block> = Vec::new();
    let (mut offset, mut broken, mut tidy) = (0, true, false);
    for line in text.split_inclusive('\n') {
        let range = offset..offset + line.trim_end().len();
        let indented = range.start + (line.len() - line.trim_start().len());
        let start = offset;
        offset += line.len();
        let trimmed = line.trim();
        if let Some(directive) = trimmed.strip_prefix("//#") {
            step(directive, indented.min(range.end)..range.end, &mut blocks, choice, &mut errors);
            (broken, tidy) = (true, true);
            continue;
        }
        if !blocks.last().is_none_or(|b| b.on) {
            broken = true;
            continue;
        }
        let blank = trimmed.is_empty();
        if blank && tidy && (kept.text.is_empty() || kept.text.ends_with("\n\n") || kept.text.ends_with("{\n")) {
            broken = true;
            continue;
        }
        tidy &= blank;
        if broken {
            kept.runs.push((kept.text.len(), start));
            broken = false;
        }
        kept.text.push_str(line);
    }
    for block in blocks {
        errors.push(ConditionError { range: block.start, message: "`//#if` has no `//#end`".into() });
    }
    (kept, errors)
}

fn step<'a>(
    directive: &str,
    range: Range<usize>,
    blocks: &mut Vec<Block>,
    choice: Lookup<'_, 'a>,
    errors: &mut Vec<ConditionError>,
) {
    let mut fail = |message: String| errors.push(ConditionError { range: range.clone(), message });
    let (word, rest) = directive.split_once(char::is_whitespace).unwrap_or((directive, ""));
    let mut condition = || {
        evaluate(rest, choice).unwrap_or_else(|message| {
            fail(message);
            false
        })
    };
    match word {
        "if" => {
            let outer = blocks.last().is_none_or(|b| b.on);
            let holds = condition();
            if blocks.len() >= MAX_DEPTH {
                fail(format!("conditions nest deeper than {MAX_DEPTH}"));
            }
            blocks.push(Block { start: range.clone(), outer, taken: holds, on: outer && holds, had_else: false });
        }
        "elif" => {
            let holds = condition();
            match blocks.last_mut() {
                Some(b) if !b.had_else => {
                    b.on = b.outer && !b.taken && holds;
                    b.taken |= holds;
                }
                Some(_) => fail("`//#elif` after `//#else`".into()),
                None => fail("`//#elif` without `//#if`".into()),
            }
        }
        "else" => match blocks.last_mut() {
            Some(b) if !b.had_else => {
                b.on = b.outer && !b.taken;
                b.had_else = true;
            }
            Some(_) => fail("a second `//#else`".into()),
            None => fail("`//#else` without `//#if`".into()),
        },
        "end" => {
            if blocks.pop().is_none() {
                fail("`//#end` without `//#if`".into());
            }
        }
        _ => fail(format!("`//#{word}` is not one of //#if, //#elif, //#else, //#end")),
    }
    if matches!(word, "else" | "end") && !rest.trim().is_empty() {
        fail(format!("`//#{word}` takes no condition"));
    }
}

fn evaluate<'a>(condition: &str, choice: Lookup<'_, 'a>) -> Result<bool, String> {
    let (name, equal, alternatives) = match (condition.split_once("=="), condition.split_once("!=")) {
        (Some((n, a)), None) => (n.trim(), true, a),
        (None, Some((n, a))) => (n.trim(), false, a),
        _ => return Err("a condition reads `NAME == choice | choice` or `NAME != choice`".into()),
    };
    let (chosen, choices) = choice(name).ok_or_else(|| format!("`{name}` is not an option of this file"))?;
    let mut found = false;
    for alternative in alternatives.split('|').map(str::trim) {
        if !choices.iter().any(|c| c == alternative) {
            return Err(format!("`{alternative}` is not a choice of `{name}`, which is {}", choices.join(" | ")));
        }
        found |= alternative == chosen;
    }
    Ok(found == equal)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(text: &str, chosen: &str) -> (Kept, Vec<String>) {
        let choices: Vec<String> = ["a", "b", "c"].map(String::from).to_vec();
        let choices = choices.leak();
        let chosen: &'static str = chosen.to_owned().leak();
        let (kept, errors) = apply(text, &|name| (name == "o").then_some((chosen, &*choices)));
        (kept, errors.into_iter().map(|e| format!("{}: {}", &text[e.range], e.message)).collect())
    }

    #[test]
    fn branches_and_alternatives() {
        let text = "0\n//#if o == a | b\n1\n//#if o != a\n2\n//#end\n//#elif o == c\n3\n//#else\n4\n//#end\n5\n";
        assert_eq!(run(text, "a").0.text, "0\n1\n5\n");
        assert_eq!(run(text, "b").0.text, "0\n1\n2\n5\n");
        assert_eq!(run(text, "c").0.text, "0\n3\n5\n");
        assert!(run(text, "a").1.is_empty());
    }

    #[test]
    fn offsets_point_into_the_original() {
        let text = "x\n//#if o == a\ny\n//#end\nz w\n";
        for chosen in ["a", "b"] {
            let kept = run(text, chosen).0;
            let at = kept.text.find('w').unwrap();
            assert_eq!(&text[kept.original_range(at..at + 1)], "w");
        }
        let kept = run(text, "a").0;
        assert_eq!(&text[kept.original_range(2..3)], "y");
    }

    #[test]
    fn blank_lines_around_dropped_text_are_tidied() {
        assert_eq!(run("x\n\n//#if o == a\ny\n//#end\n\nz\n", "b").0.text, "x\n\nz\n");
    }

    #[test]
    fn replacing_keeps_the_rest_in_place() {
        let text = "//#if o == a\nW = 5;\n//#end\nx = W;\n";
        let mut kept = run(text, "a").0;
        kept.replace(4..5, "12");
        assert_eq!(kept.text, "W = 12;\nx = W;\n");
        let at = kept.text.find('x').unwrap();
        assert_eq!(&text[kept.original_range(at..at + 5)], "x = W");
        assert_eq!(&text[kept.original_range(6..7)], ";");
        assert_eq!(kept.original(4), text.find('5').unwrap());
    }

    #[test]
    fn mistakes_accumulate_with_places() {
        let errors = run("//#if q == a\n//#elif o == z\n//#els\n//#end x\n//#end\n//#if o = a\n", "a").1;
        assert_eq!(errors.len(), 7, "{errors:?}");
        assert!(errors[0].starts_with("//#if q == a: `q` is not an option"), "{errors:?}");
        assert!(errors[1].contains("`z` is not a choice of `o`, which is a | b | c"), "{errors:?}");
        assert!(errors[6].contains("no `//#end`"), "{errors:?}");
    }

    #[test]
    fn nesting_is_bounded() {
        let text = "//#if o == a\n".repeat(40) + &"//#end\n".repeat(40);
        assert!(run(&text, "a").1.iter().any(|e| e.contains("nest deeper")));
    }
}
