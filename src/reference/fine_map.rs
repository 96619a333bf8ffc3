//! Exhaustive percentage-closer filtering: every texel of a map that is several times finer than the one that is judged,
//! within the whole footprint of the filter, each by a ray through its centre.

use std::collections::{HashMap, HashSet};

use glam::{DVec2, DVec3};

use super::footprint::{filter_below, reach};
use super::layers::Taps;
use super::view::{Projection, View};
use super::world::{Point, World};

/// Fine texels on a side of what is kept together.
const TILE: i64 = 16;
/// Most tiles that are kept: some 100 MiB.
const MOST_TILES: usize = 1 << 15;
/// The triangle of a texel that nothing stands in.
const NOTHING: u32 = u32::MAX;
/// The triangle of a texel that no ray went through yet.
const UNKNOWN: u32 = u32::MAX - 1;
/// A plane that the light grazes at a smaller cosine is as good as one that runs along the light.
const EDGE_ON: f64 = 1e-12;

/// The filter that is judged, and how much finer it is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Filter {
    /// Weights of the texels around the middle one, along each axis; see [`super::kernel`].
    pub kernel: Vec<f64>,
    /// How the filter reads a texel.
    pub taps: Taps,
    /// Texels on a side of the map.
    pub size: u32,
    /// Fine texels along a texel.
    pub factor: u32,
}

/// What a light sees, sampled where it is asked for.
pub struct FineMap<'a> {
    world: &'a World,
    view: View,
    filter: &'a Filter,
    tiles: HashMap<(i64, i64), Tile>,
}

/// Depth and triangle of each of its texels.
struct Tile {
    depth: [f64; (TILE * TILE) as usize],
    triangle: [u32; (TILE * TILE) as usize],
}

/// A texel of a footprint that is nearer to the light than the receiver's plane.
struct Dark {
    weight: f64,
    triangle: u32,
}

impl<'a> FineMap<'a> {
    /// Nothing is sampled yet.
    pub fn new(world: &'a World, view: View, filter: &'a Filter) -> Self {
        Self { world, view, filter, tiles: HashMap::new() }
    }

    /// The lit share of the filter around a point: of each texel that part where nothing is nearer to the light than the
    /// plane of the point's triangle is. The map goes on beyond its border; what lies beyond it itself, or in front of the
    /// near plane, counts as lit.
    ///
    /// A plane has no outline, though the surface has one: where light grazes a surface, its plane soon runs behind what
    /// lies beyond the outline, and that part of the filter counts as dark. [`super::rays`] know better there.
    ///
    /// The part of the point's own surface around it does not count as nearer: triangles that the light sees in the
    /// footprint and that hang together with the point's by their corners, all turned towards the light. Such a patch
    /// lies side by side on the map, so it cannot stand in its own light; but where it bends up it rises above the plane,
    /// and corners rounded to float32 bend every surface a little.
    pub fn lit(&mut self, point: &Point) -> f64 {
        let position = self.view.point(point.position);
        if !self.view.holds(position) {
            return 1.0;
        }
        let (size, fine) = (f64::from(self.filter.size), f64::from(self.filter.factor));
        let at = self.view.place(position) * size;
        let (columns, rows) = (self.weights(at.x), self.weights(at.y));
        let normal = self.view.rotation * point.normal;
        let plane = Plane { normal, offset: normal.dot(position), tolerance: self.world.epsilon() };
        let side = plane.facing(&self.view, self.view.place(position)) >= 0.0;
        let step = 1.0 / (size * fine);
        let mut dark: Vec<Dark> = Vec::new();
        let mut seen: HashSet<u32> = HashSet::new();
        for tile_row in rows.first.div_euclid(TILE)..=rows.last().div_euclid(TILE) {
            for tile_column in columns.first.div_euclid(TILE)..=columns.last().div_euclid(TILE) {
                let tile = self.tile((tile_column, tile_row));
                let (mut rays, world, view) = (Vec::new(), self.world, self.view);
                for row in rows.part(tile_row) {
                    for column in columns.part(tile_column) {
                        let place = DVec2::new(column as f64 + 0.5, row as f64 + 0.5) * step;
                        rays.push((row, column, place));
                    }
                }
                let Some(tile) = self.tiles.get_mut(&tile) else { continue };
                for (row, column, place) in rays {
                    let index = (row.rem_euclid(TILE) * TILE + column.rem_euclid(TILE)) as usize;
                    if tile.triangle[index] == UNKNOWN {
                        let hit = world.first_caster(&view.ray(place));
                        (tile.depth[index], tile.triangle[index]) = hit.unwrap_or((f64::INFINITY, NOTHING));
                    }
                    let triangle = tile.triangle[index];
                    if triangle == NOTHING || triangle == point.triangle {
                        continue;
                    }
                    seen.insert(triangle);
                    if plane.is_behind(&view, place, tile.depth[index]) {
                        dark.push(Dark { weight: columns.of(column) * rows.of(row), triangle });
                    }
                }
            }
        }
        let own = if dark.is_empty() { HashSet::new() } else { self.own_surface(point, side, &seen) };
        let sum: f64 = dark.iter().filter(|d| !own.contains(&d.triangle)).map(|d| d.weight).sum();
        (1.0 - sum).clamp(0.0, 1.0)
    }

    /// The weights of fine texels along one axis, around a place in texels of the map. They sum to 1 and are exact: the
    /// integral of the filter over each.
    fn weights(&self, at: f64) -> Weights {
        let Filter { kernel, taps, factor, .. } = self.filter;
        let (reach, fine) = (reach(kernel.len(), *taps), f64::from(*factor));
        let first = ((at - reach) * fine).floor() as i64;
        let last = ((at + reach) * fine).ceil() as i64;
        let below: Vec<f64> = (first..=last).map(|i| filter_below(kernel, *taps, i as f64 / fine - at)).collect();
        Weights { first, values: below.windows(2).map(|w| w[1] - w[0]).collect() }
    }

    /// Makes sure that a tile is there.
    fn tile(&mut self, key: (i64, i64)) -> (i64, i64) {
        if self.tiles.len() >= MOST_TILES && !self.tiles.contains_key(&key) {
            self.tiles.clear();
        }
        let count = (TILE * TILE) as usize;
        debug_assert_eq!(count, 256);
        self.tiles.entry(key).or_insert_with(|| Tile { depth: [0.0; 256], triangle: [UNKNOWN; 256] });
        key
    }

    /// The triangles among `seen` that hang together with the point's by corners, over triangles among `seen` that are
    /// turned to the light as the point's is.
    fn own_surface(&self, point: &Point, side: bool, seen: &HashSet<u32>) -> HashSet<u32> {
        let key = |corner: DVec3| corner.to_array().map(|x| (x + 0.0).to_bits());
        let mut around: HashMap<[u64; 3], Vec<u32>> = HashMap::new();
        let mut candidates: Vec<u32> = seen.iter().copied().collect();
        candidates.sort_unstable();
        for triangle in candidates {
            let corners = self.world.corners(triangle);
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let towards = match self.view.projection {
                Projection::Perspective => middle - self.view.origin,
                Projection::Parallel => self.view.rotation.row(2),
            };
            if (self.world.normal(triangle).dot(towards) >= 0.0) == side {
                corners.into_iter().for_each(|c| around.entry(key(c)).or_default().push(triangle));
            }
        }
        let mut own = HashSet::new();
        let mut open = vec![point.triangle];
        while let Some(triangle) = open.pop() {
            for corner in self.world.corners(triangle) {
                // Each corner is followed once.
                for next in around.remove(&key(corner)).unwrap_or_default() {
                    if own.insert(next) {
                        open.push(next);
                    }
                }
            }
        }
        own
    }
}

/// Weights of neighbouring fine texels.
struct Weights {
    first: i64,
    values: Vec<f64>,
}

impl Weights {
    fn last(&self) -> i64 {
        self.first + self.values.len() as i64 - 1
    }

    fn of(&self, texel: i64) -> f64 {
        self.values[(texel - self.first) as usize]
    }

    /// Those within a tile.
    fn part(&self, tile: i64) -> std::ops::RangeInclusive<i64> {
        self.first.max(tile * TILE)..=self.last().min(tile * TILE + TILE - 1)
    }
}

/// The plane of a receiver in the frame of a view.
struct Plane {
    normal: DVec3,
    offset: f64,
    tolerance: f64,
}

impl Plane {
    /// Cosine of the angle between the normal and a line of sight, times the length of its direction.
    fn facing(&self, view: &View, place: DVec2) -> f64 {
        self.normal.dot(view.line(place).1)
    }

    /// Whether the plane is farther from the light than a depth, along the line of sight through a place. A line that
    /// never meets the plane runs away from it to where all is nearer.
    fn is_behind(&self, view: &View, place: DVec2, depth: f64) -> bool {
        let (start, direction) = view.line(place);
        let facing = self.normal.dot(direction);
        let rise = self.offset - self.normal.dot(start);
        if facing.abs() < EDGE_ON {
            return true;
        }
        let meets = rise / facing;
        // A plane that is grazed is known the less exactly along the light.
        let tolerance = self.tolerance * (1.0 + direction.length() / facing.abs());
        let meets = if view.projection == Projection::Perspective && meets <= 0.0 { f64::INFINITY } else { meets };
        depth < meets - tolerance
    }
}

#[cfg(test)]
#[path = "fine_map_tests.rs"]
mod tests;
