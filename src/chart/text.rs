//! Words in charts and reports.

use crate::markup;
pub(super) use crate::markup::cut;

/// Fonts of drawings; the first is the one that PNG files are made with.
pub(super) const FONT: &str = "Ubuntu, 'Ubuntu Light', Helvetica, Arial, sans-serif";

/// A text as XML and HTML hold it, in one line.
pub(super) fn escaped(text: &str) -> String {
    markup::escaped(&text.replace('\n', " "))
}

/// About how wide a text is, in points, a little more rather than less.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let letter = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | ' ' | '·' => 0.3,
        'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '/' | '-' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' => 0.9,
        c if c.is_uppercase() => 0.68,
        _ => 0.56,
    };
    text.chars().map(letter).sum::<f64>() * size
}

/// A text in lines of at most so many points.
pub(super) fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(word, size) + 0.3 * size <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(cut(word, 120)),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_breaks_out_and_lines_are_filled() {
        assert_eq!(escaped("a<b & \"c\"\u{7}\t>"), "a&lt;b &amp; &quot;c&quot; &gt;");
        assert_eq!((cut("abcdef", 4), cut("abc", 4)), ("abc…".to_owned(), "abc".to_owned()));
        let lines = wrapped("one two three four five six seven", 10.0, 80.0);
        assert!(lines.len() > 1 && lines.iter().all(|l| width(l, 10.0) <= 80.0), "{lines:?}");
        assert_eq!(lines.join(" "), "one two three four five six seven");
    }
}
