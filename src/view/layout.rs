//! Where nodes lie that nobody placed: in layers from left to right.

use std::collections::BTreeMap;

use crate::graph::Graph;
use crate::hash::HashMap;

/// Space between layers, in points.
const BETWEEN: f64 = 80.0;
/// Space between nodes of one layer, in points.
const BELOW: f64 = 24.0;
/// Rounds of moving nodes towards what they are linked to.
const SWEEPS: usize = 6;
/// Width beyond which nodes without links begin a new row, in points.
const ROW: f64 = 1600.0;

/// Places for all nodes: what feeds a node is left of it, as near as it can be; links cross little; nothing overlaps. The
/// same for the same graph and sizes.
pub fn arrange(graph: &Graph, sizes: &dyn Fn(&str) -> [f64; 2]) -> BTreeMap<String, [f64; 2]> {
    let names: Vec<&str> = graph.nodes.keys().map(String::as_str).collect();
    lay_out(graph, &names, sizes)
}

/// Places for all nodes: the given ones, and below them arranged ones for nodes that have none.
pub fn placed(graph: &Graph, sizes: &dyn Fn(&str) -> [f64; 2]) -> BTreeMap<String, [f64; 2]> {
    let known = |name: &&str| graph.layout.contains_key(*name);
    let names: Vec<&str> = graph.nodes.keys().map(String::as_str).filter(|name| !known(name)).collect();
    let mut out = lay_out(graph, &names, sizes);
    let (mut left, mut bottom) = (f64::INFINITY, f64::NEG_INFINITY);
    for (name, [x, y]) in graph.layout.iter().filter(|(name, _)| graph.nodes.contains_key(*name)) {
        left = left.min(*x);
        bottom = bottom.max(y + size(sizes, name)[1]);
    }
    for frame in graph.frames.values() {
        bottom = bottom.max(frame.at[1] + frame.size[1]);
    }
    if left.is_finite() && bottom.is_finite() {
        for [x, y] in out.values_mut() {
            *x += left;
            *y += bottom + BETWEEN;
        }
    }
    out.extend(graph.layout.iter().filter(|(n, _)| graph.nodes.contains_key(*n)).map(|(n, p)| (n.clone(), *p)));
    out
}

/// A size that can be reckoned with.
fn size(sizes: &dyn Fn(&str) -> [f64; 2], name: &str) -> [f64; 2] {
    sizes(name).map(|x| if x.is_finite() { x.clamp(1.0, 1e5) } else { 1.0 })
}

struct Layers {
    sizes: Vec<[f64; 2]>,
    /// Nodes that each node feeds, and that feed it.
    next: Vec<Vec<usize>>,
    before: Vec<Vec<usize>>,
    /// Nodes of each layer from top to bottom; the last layer is the right one.
    layers: Vec<Vec<usize>>,
    top: Vec<f64>,
}

fn lay_out(graph: &Graph, names: &[&str], sizes: &dyn Fn(&str) -> [f64; 2]) -> BTreeMap<String, [f64; 2]> {
    let numbers: HashMap<&str, usize> = names.iter().enumerate().map(|(i, name)| (*name, i)).collect();
    let (mut next, mut before) = (vec![Vec::new(); names.len()], vec![Vec::new(); names.len()]);
    for link in &graph.links {
        let ends = (numbers.get(link.from.node.as_str()), numbers.get(link.to.node.as_str()));
        let (Some(&from), Some(&to)) = ends else { continue };
        if from != to && next[from].last() != Some(&to) {
            next[from].push(to);
            before[to].push(from);
        }
    }
    let sizes = names.iter().map(|name| size(sizes, name)).collect();
    let mut work = Layers { sizes, next, before, layers: Vec::new(), top: vec![0.0; names.len()] };
    let loose: Vec<usize> =
        (0..names.len()).filter(|&i| work.next[i].is_empty() && work.before[i].is_empty()).collect();
    work.rank();
    work.stack();
    for round in 0..SWEEPS {
        work.sweep(round % 2 == 0, round + 2 < SWEEPS);
    }
    let mut places = work.places();
    work.rows(&loose, &mut places);
    names.iter().zip(places).map(|(name, place)| ((*name).to_owned(), place)).collect()
}

impl Layers {
    /// Puts each linked node one layer left of the leftmost that it feeds. Links that close a cycle do not count.
    fn rank(&mut self) {
        let count = self.sizes.len();
        let mut height = vec![0_usize; count];
        let mut state = vec![0_u8; count];
        for root in 0..count {
            if state[root] != 0 {
                continue;
            }
            let mut path = vec![(root, 0)];
            state[root] = 1;
            while let Some((node, step)) = path.last_mut() {
                let node = *node;
                let Some(&to) = self.next[node].get(*step) else {
                    state[node] = 2;
                    path.pop();
                    if let Some(&(parent, _)) = path.last() {
                        height[parent] = height[parent].max(height[node] + 1);
                    }
                    continue;
                };
                *step += 1;
                match state[to] {
                    0 => {
                        state[to] = 1;
                        path.push((to, 0));
                    }
                    2 => height[node] = height[node].max(height[to] + 1),
                    _ => {}
                }
            }
        }
        let linked = |i: &usize| !self.next[*i].is_empty() || !self.before[*i].is_empty();
        let most = (0..count).filter(linked).map(|i| height[i]).max();
        let mut layers = vec![Vec::new(); most.map_or(0, |most| most + 1)];
        let last = layers.len().saturating_sub(1);
        for i in (0..count).filter(linked) {
            layers[last - height[i]].push(i);
        }
        self.layers = layers;
    }

    /// Stacks every layer around the same middle.
    fn stack(&mut self) {
        for layer in &self.layers {
            let total: f64 = layer.iter().map(|&i| self.sizes[i][1] + BELOW).sum();
            let mut y = -total / 2.0;
            for &i in layer {
                self.top[i] = y;
                y += self.sizes[i][1] + BELOW;
            }
        }
    }

    fn middle(&self, node: usize) -> f64 {
        self.top[node] + self.sizes[node][1] / 2.0
    }

    /// The median of the middles of what a node is linked to on one side.
    fn wanted(&self, node: usize, right: bool) -> Option<f64> {
        let others = if right { &self.next[node] } else { &self.before[node] };
        let mut middles: Vec<f64> = others.iter().map(|&other| self.middle(other)).collect();
        middles.sort_by(f64::total_cmp);
        let upper = middles.get(middles.len() / 2)?;
        let lower = middles.get(middles.len().saturating_sub(1) / 2)?;
        Some((upper + lower) / 2.0)
    }

    /// Moves the nodes of every layer to the height of what they are linked to on one side; `sort` lets them pass each
    /// other on the way.
    fn sweep(&mut self, right: bool, sort: bool) {
        let count = self.layers.len();
        for step in 0..count {
            let index = if right { count - 1 - step } else { step };
            let mut layer = std::mem::take(&mut self.layers[index]);
            let mut wanted: HashMap<usize, f64> = HashMap::default();
            for &node in &layer {
                wanted.insert(node, self.wanted(node, right).unwrap_or_else(|| self.middle(node)));
            }
            let want = |node: &usize| wanted.get(node).copied().unwrap_or_default();
            if sort {
                layer.sort_by(|a, b| want(a).total_cmp(&want(b)));
            }
            let wishes: Vec<(f64, f64)> =
                layer.iter().map(|i| (want(i) - self.sizes[*i][1] / 2.0, self.sizes[*i][1] + BELOW)).collect();
            for (node, top) in layer.iter().zip(pack(&wishes)) {
                self.top[*node] = top;
            }
            self.layers[index] = layer;
        }
    }

    /// Left and top of every node; nodes without links lie at zero.
    fn places(&self) -> Vec<[f64; 2]> {
        let mut places = vec![[0.0, 0.0]; self.sizes.len()];
        let tops = self.layers.iter().flatten().map(|&i| self.top[i]);
        let highest = tops.fold(f64::INFINITY, f64::min);
        let mut x = 0.0;
        for layer in &self.layers {
            let width = layer.iter().map(|&i| self.sizes[i][0]).fold(0.0, f64::max);
            for &i in layer {
                places[i] = [x, (self.top[i] - highest).round()];
            }
            x += width + BETWEEN;
        }
        places
    }

    /// Puts nodes without links in rows below all others.
    fn rows(&self, loose: &[usize], places: &mut [[f64; 2]]) {
        let bottom = |i: &usize| places[*i][1] + self.sizes[*i][1] + BETWEEN;
        let mut y = self.layers.iter().flatten().map(bottom).fold(0.0, f64::max);
        let row = (loose.len() as f64).sqrt() * 250.0;
        let (mut x, mut height) = (0.0, 0.0_f64);
        for &i in loose {
            let [width, own] = self.sizes[i];
            if x > 0.0 && x + width > row.max(ROW) {
                (x, y, height) = (0.0, y + height + BELOW, 0.0);
            }
            places[i] = [x, y];
            x += width + BETWEEN;
            height = height.max(own);
        }
    }
}

/// Tops of boxes in this order, each at least a height below the one before, with the least sum of squared distances to
/// what each wishes. Wishes and heights. Pool adjacent violators: linear in the number of boxes.
fn pack(boxes: &[(f64, f64)]) -> Vec<f64> {
    // Taking off the heights above makes it a matter of not decreasing.
    let mut blocks: Vec<(f64, f64)> = Vec::new();
    let mut above = 0.0;
    let mut offsets = Vec::with_capacity(boxes.len());
    for (wish, height) in boxes {
        offsets.push(above);
        let mut block = (wish - above, 1.0);
        while let Some((mean, count)) = blocks.last().copied().filter(|(mean, _)| *mean > block.0) {
            block = ((mean * count + block.0 * block.1) / (count + block.1), count + block.1);
            blocks.pop();
        }
        blocks.push(block);
        above += height;
    }
    let levels = blocks.iter().flat_map(|&(mean, count)| std::iter::repeat_n(mean, count as usize));
    levels.zip(offsets).map(|(level, offset)| (level + offset).ceil()).collect()
}
