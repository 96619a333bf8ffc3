//! Comments of a file become notes of what they stand at, since the writer has no other place for them.

use std::ops::Range;

use super::Graph;
use crate::ron::{Comment, Document};

/// Something that a comment can belong to.
pub(super) enum Target<'a> {
    Node(&'a str),
    /// Index into the links, before they are sorted.
    Link(usize),
}

/// A target and where it stands.
pub(super) struct Item<'a> {
    pub(super) span: Range<usize>,
    pub(super) target: Target<'a>,
}

/// Puts each comment of the document into the note that it belongs to.
pub(super) fn keep(document: &Document, text: &str, mut items: Vec<Item<'_>>, graph: &mut Graph) {
    items.sort_by_key(|item| item.span.start);
    let owners = owners(&document.comments, text, &items);
    for (comment, owner) in document.comments.iter().zip(owners) {
        let note = match owner.map(|index| &items[index].target) {
            Some(Target::Node(name)) => graph.nodes.get_mut(*name).map(|n| &mut n.note),
            Some(Target::Link(index)) => graph.links.get_mut(*index).map(|l| &mut l.note),
            None => None,
        };
        append(note.unwrap_or(&mut graph.note), &content(&text[comment.span.clone()], comment.block));
    }
}

/// The item that each comment belongs to; none: the graph.
fn owners(comments: &[Comment], text: &str, items: &[Item<'_>]) -> Vec<Option<usize>> {
    let mut owners = vec![None; comments.len()];
    // Where the run of comments right above the item `follows` begins; walked from the end of the file.
    let mut run = None;
    for (index, comment) in comments.iter().enumerate().rev() {
        let Range { start, end } = comment.span.clone();
        let next = items.partition_point(|item| item.span.start < end);
        let before = next.checked_sub(1).filter(|&i| {
            let item_end = items[i].span.end;
            start < item_end || !text[item_end..start].contains('\n')
        });
        if before.is_some() {
            owners[index] = before;
            continue;
        }
        let Some(item) = items.get(next) else {
            continue;
        };
        let border = match run {
            Some((item, border)) if item == next => border,
            _ => item.span.start,
        };
        if border >= end && text[end..border].trim().is_empty() {
            owners[index] = Some(next);
            run = Some((next, start));
        }
    }
    owners
}

/// A comment without its marks.
fn content(comment: &str, block: bool) -> String {
    if !block {
        let body = comment.trim_start_matches('/');
        return body.strip_prefix(' ').unwrap_or(body).trim_end().to_string();
    }
    let body = comment.strip_prefix("/*").unwrap_or(comment);
    let body = body.strip_suffix("*/").unwrap_or(body);
    let lines = body.lines().map(|line| {
        let line = line.trim();
        line.strip_prefix('*').map_or(line, str::trim_start)
    });
    lines.collect::<Vec<_>>().join("\n").trim().to_string()
}

/// Adds a line to a note.
pub(super) fn append(note: &mut String, line: &str) {
    if line.is_empty() {
        return;
    }
    if !note.is_empty() {
        note.push('\n');
    }
    note.push_str(line);
}
