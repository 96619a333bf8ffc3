//! Comma-separated things between brackets, and how reading goes on after one of them is wrong.

use std::ops::Range;

use super::MAX_ERRORS;
use super::read::{Mistake, Reader};
use super::scan::fatal;

impl Reader<'_> {
    pub(super) fn twice(&mut self, name: &str, at: Range<usize>) {
        let message = format!("`{name}` is given twice here");
        self.report(Mistake { code: "ST0006", message, at, fatal: false });
    }

    pub(super) fn colon(&mut self) -> Result<(), Mistake> {
        self.blank()?;
        if !self.eat(":") {
            return Err(self.mistake("ST0001", "expected `:`"));
        }
        self.blank()
    }

    /// Comma-separated things up to `close`; the opening bracket is behind the cursor.
    pub(super) fn series(
        &mut self,
        close: char,
        mut one: impl FnMut(&mut Self) -> Result<(), Mistake>,
    ) -> Result<(), Mistake> {
        let open = self.at.saturating_sub(1);
        loop {
            self.blank()?;
            match self.peek() {
                None => {
                    return Err(fatal("ST0001", format!("no `{close}` closes this"), open..self.at.min(open + 1)));
                }
                Some(c) if c == close => {
                    self.at += c.len_utf8();
                    return Ok(());
                }
                Some(c @ (')' | ']' | '}')) => {
                    let message = format!("expected `{close}`, found `{c}`");
                    return Err(fatal("ST0001", message, self.at..self.at + 1));
                }
                Some(_) => {}
            }
            let result = one(self).and_then(|()| {
                self.blank()?;
                match self.peek() {
                    Some(',') => self.at += 1,
                    None => {}
                    // A closing bracket of another kind is told at the head of the loop.
                    Some(')' | ']' | '}') => {}
                    Some(_) => {
                        return Err(self.mistake("ST0001", format!("expected `,` or `{close}`")));
                    }
                }
                Ok(())
            });
            match result {
                Ok(()) => {}
                Err(mistake) if mistake.fatal => return Err(mistake),
                Err(mistake) => {
                    self.report(mistake);
                    if self.is_full() {
                        // A text with nothing but mistakes is not worth reading to its end.
                        let message = format!("{MAX_ERRORS} mistakes so far; the rest of the file was not read");
                        return Err(fatal("ST0012", message, self.at..self.at));
                    }
                    self.recover()?;
                }
            }
        }
    }

    /// Steps to the end of the thing that went wrong: past the next comma, or up to a closing bracket, at this level.
    fn recover(&mut self) -> Result<(), Mistake> {
        let mut open = Vec::new();
        loop {
            self.blank()?;
            let Some(c) = self.peek() else { return Ok(()) };
            match c {
                '"' => {
                    self.string()?;
                    continue;
                }
                'r' if self.raw_string()?.is_some() => continue,
                '(' | '[' | '{' => open.push(c),
                ')' | ']' | '}' if open.is_empty() => return Ok(()),
                ')' | ']' | '}' => drop(open.pop()),
                ',' if open.is_empty() => {
                    self.at += 1;
                    return Ok(());
                }
                _ => {}
            }
            self.at += c.len_utf8();
        }
    }
}
