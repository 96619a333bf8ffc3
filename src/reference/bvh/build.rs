//! Makes the tree: splits where the surface area heuristic says (MacDonald and Booth 1990), estimated in bins.

use glam::DVec3;

use super::{Bvh, Node};

/// What boxes are widened by on all sides, as a part of the greatest coordinate: rounding makes rays meet triangles that
/// they pass within some parts in 10^16 of their distance, and from far away that is more.
const PADDING: f64 = 1e-12;
/// Most triangles that are not split further.
const LEAF: usize = 4;
/// Places per axis that are tried for a split.
const BINS: usize = 16;
/// From this level on triangles are halved by number, which needs at most 32 levels more: see [`super::MAX_DEPTH`].
const HALVED_FROM: usize = 56;

struct Item {
    low: DVec3,
    high: DVec3,
    number: u32,
}

impl Item {
    /// Twice its middle.
    fn middle(&self) -> DVec3 {
        self.low + self.high
    }
}

/// Part of the items that is to become a node, its level, and the node whose second child it is.
struct Task {
    from: usize,
    to: usize,
    level: usize,
    parent: Option<usize>,
}

pub(super) fn build(triangles: &[[DVec3; 3]]) -> Bvh {
    let mut items: Vec<Item> = Vec::with_capacity(triangles.len());
    for (number, corners) in triangles.iter().enumerate() {
        let flat = (corners[1] - corners[0]).cross(corners[2] - corners[0]) == DVec3::ZERO;
        if !flat && corners.iter().all(|p| p.is_finite()) {
            let (low, high) = (corners[0].min(corners[1]).min(corners[2]), corners[0].max(corners[1]).max(corners[2]));
            items.push(Item { low, high, number: u32::try_from(number).unwrap_or(u32::MAX) });
        }
    }
    let size = items.iter().map(|i| i.low.abs().max(i.high.abs()).max_element()).fold(0.0, f64::max);
    let padding = DVec3::splat(size * PADDING);
    let mut nodes = Vec::new();
    let mut open = Vec::new();
    if !items.is_empty() {
        open.push(Task { from: 0, to: items.len(), level: 0, parent: None });
    }
    while let Some(task) = open.pop() {
        let index = nodes.len();
        if let Some(parent) = task.parent {
            let node: &mut Node = &mut nodes[parent];
            node.first = index as u32;
        }
        let part = &mut items[task.from..task.to];
        let (low, high) = bounds(part);
        let (low, high) = (low - padding, high + padding);
        if part.len() <= LEAF {
            nodes.push(Node { low, high, first: task.from as u32, count: part.len() as u32 });
            continue;
        }
        nodes.push(Node { low, high, first: 0, count: 0 });
        let split = task.from + split(part, task.level);
        // The first child is taken next, so it follows its parent.
        let level = task.level + 1;
        open.push(Task { from: split, to: task.to, level, parent: Some(index) });
        open.push(Task { from: task.from, to: split, level, parent: None });
    }
    let numbers: Vec<u32> = items.iter().map(|i| i.number).collect();
    Bvh { nodes, triangles: numbers.iter().map(|n| triangles[*n as usize]).collect(), numbers }
}

fn bounds(items: &[Item]) -> (DVec3, DVec3) {
    items.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), i| (l.min(i.low), h.max(i.high)))
}

/// Half the surface of a box.
fn area(low: DVec3, high: DVec3) -> f64 {
    let e = high - low;
    e.x * e.y + e.y * e.z + e.z * e.x
}

/// Sorts items to two sides, none of them empty, and answers where the second begins.
fn split(items: &mut [Item], level: usize) -> usize {
    let (low, high) = items.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), i| {
        let m = i.middle();
        (l.min(m), h.max(m))
    });
    let extent = (high - low).to_array();
    let bin_of = |item: &Item, axis: usize| {
        let at = (item.middle()[axis] - low[axis]) / extent[axis] * BINS as f64;
        (at as usize).min(BINS - 1)
    };
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in (0..3).filter(|a| extent[*a] > 0.0 && level < HALVED_FROM) {
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0_usize);
        let mut bins = [empty; BINS];
        for item in items.iter() {
            let bin = &mut bins[bin_of(item, axis)];
            *bin = (bin.0.min(item.low), bin.1.max(item.high), bin.2 + 1);
        }
        let join = |a: (DVec3, DVec3, usize), b: (DVec3, DVec3, usize)| (a.0.min(b.0), a.1.max(b.1), a.2 + b.2);
        let cost = |b: (DVec3, DVec3, usize)| if b.2 == 0 { 0.0 } else { area(b.0, b.1) * b.2 as f64 };
        let mut right = [empty; BINS + 1];
        for i in (0..BINS).rev() {
            right[i] = join(right[i + 1], bins[i]);
        }
        let mut left = empty;
        for i in 1..BINS {
            left = join(left, bins[i - 1]);
            let total = cost(left) + cost(right[i]);
            if left.2 > 0 && right[i].2 > 0 && best.is_none_or(|b| total < b.0) {
                best = Some((total, axis, i));
            }
        }
    }
    if let Some((_, axis, bin)) = best {
        let mut kept = 0;
        for i in 0..items.len() {
            if bin_of(&items[i], axis) < bin {
                items.swap(kept, i);
                kept += 1;
            }
        }
        return kept;
    }
    let longest = (0..3).max_by(|a, b| extent[*a].total_cmp(&extent[*b])).unwrap_or(0);
    let half = items.len() / 2;
    items.select_nth_unstable_by(half, |a, b| a.middle()[longest].total_cmp(&b.middle()[longest]));
    half
}
