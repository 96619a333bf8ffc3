//! Sharing out the lines of a long fragment stage over several functions.
//!
//! Compilers take a time that grows with the square of a function's length (naga's front end does), so a stage of more
//! than [`LONGEST`] lines is written as parts of at most [`PART`] lines that are called in order. What a later part reads
//! is a private variable.

use super::Reached;
use crate::program::{Id, Op, Program};

/// The most lines that stay together in one function.
const LONGEST: usize = 128;
/// The most lines of a part, where there are more.
const PART: usize = 64;

/// Which function each line stands in, and which lines others read.
pub(crate) struct Division {
    /// Number of parts before the stage itself.
    pub(crate) parts: usize,
    /// By expression: the part of its line; `parts` is the stage.
    part: Vec<usize>,
    /// By expression: whether a later part reads it.
    pub(crate) read_later: Vec<bool>,
}

impl Division {
    /// The part in which an expression has its line.
    pub(crate) fn part_of(&self, id: Id) -> usize {
        self.part[id.0 as usize]
    }
}

/// Shares out the lines, if there are so many that it pays, and if the type of all that crosses is known.
pub(crate) fn divide(program: &Program, reached: &Reached, root: Id) -> Option<Division> {
    let lines: Vec<Id> = reached.order.iter().copied().filter(|id| reached.has_line(program, *id)).collect();
    if lines.len() <= LONGEST {
        return None;
    }
    let parts = lines.len().div_ceil(PART);
    let each = lines.len().div_ceil(parts);
    let mut part = vec![parts; program.expressions.len()];
    for (index, id) in lines.iter().enumerate() {
        part[id.0 as usize] = index / each;
    }
    let mut read_later = vec![false; program.expressions.len()];
    if reached.has_line(program, root) {
        read_later[root.0 as usize] = true;
    }
    // Users come after their operands, so that going backwards the part of a user is known.
    for &id in reached.order.iter().rev() {
        let here = part[id.0 as usize];
        for &operand in &program.get(id).operands {
            let mut read = operand;
            // A member is written wherever it is used.
            while let (Op::Member(_), [of]) = (&program.get(read).op, program.get(read).operands.as_slice()) {
                read = *of;
            }
            if reached.has_line(program, read) {
                read_later[read.0 as usize] |= part[read.0 as usize] != here;
            } else {
                part[read.0 as usize] = here;
            }
        }
    }
    let known = |id: &Id| !read_later[id.0 as usize] || program.has_type(*id);
    lines.iter().all(known).then_some(Division { parts, part, read_later })
}
