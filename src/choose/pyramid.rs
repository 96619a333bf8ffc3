//! Least, greatest, mean and mean square depth of ever larger squares of a light's map.

use super::texels::Texels;

/// What is known of a square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Least depth.
    pub low: f64,
    /// Greatest depth.
    pub high: f64,
    /// Mean depth.
    pub mean: f64,
    /// Mean square of depth.
    pub square: f64,
}

impl Cell {
    /// Of one texel.
    fn of(depth: f64) -> Self {
        Self { low: depth, high: depth, mean: depth, square: depth * depth }
    }

    /// Variance of depth.
    pub fn variance(&self) -> f64 {
        (self.square - self.mean * self.mean).max(0.0)
    }
}

/// Levels from single texels to the whole map. The side must be a power of two; else the last rows and columns of a level
/// may be left out of the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Pyramid {
    /// Side of each level and its cells, row by row.
    pub levels: Vec<(usize, Vec<Cell>)>,
}

impl Pyramid {
    /// Looks at every texel of a map, which should be a small one.
    pub fn new(map: &mut Texels<'_>) -> Self {
        let side = map.side() as usize;
        let at = |i: usize| ((i % side) as i64, (i / side) as i64);
        let finest: Vec<Cell> = (0..side * side).map(|i| Cell::of(map.at(at(i).0, at(i).1).depth)).collect();
        let mut levels = vec![(side, finest)];
        while let Some((side, cells)) = levels.last().filter(|(side, _)| *side > 1) {
            let half = side / 2;
            let next = (0..half * half).map(|i| {
                let (x, y) = (2 * (i % half), 2 * (i / half));
                let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| cells[(y + dy) * side + x + dx]);
                let mean = |of: fn(&Cell) -> f64| four.iter().map(of).sum::<f64>() / 4.0;
                Cell {
                    low: four.iter().map(|c| c.low).fold(f64::INFINITY, f64::min),
                    high: four.iter().map(|c| c.high).fold(f64::NEG_INFINITY, f64::max),
                    mean: mean(|c| c.mean),
                    square: mean(|c| c.square),
                }
            });
            let next: (usize, Vec<Cell>) = (half, next.collect());
            levels.push(next);
        }
        Self { levels }
    }

    /// Least and greatest depth of all, and the greatest variance of an eighth of the side squared.
    pub fn extremes(&self) -> [f64; 3] {
        let whole = self.levels.last().and_then(|(_, cells)| cells.first());
        let eighth = self.levels.iter().rev().find(|(side, _)| *side >= 8).or(self.levels.first());
        let most = eighth.map_or(0.0, |(_, cells)| cells.iter().map(Cell::variance).fold(0.0, f64::max));
        whole.map_or([1.0, 1.0, 0.0], |cell| [cell.low, cell.high, most])
    }
}

#[cfg(test)]
mod tests {
    use super::super::texels::{Looked, Texels};
    use super::*;
    use crate::reference::{Body, View, World};
    use crate::scene::Shape;
    use glam::{DVec3, Mat4, Vec3};

    /// A plate that hides half of what a light sees of a ground.
    #[test]
    fn levels_hold_the_extremes_and_moments_of_what_is_below() {
        let plane = Shape::Plane { size: [20.0, 20.0], segments: [1, 1] }.mesh().expect("a plane");
        let body = |x: f32, y: f32| Body {
            mesh: &plane,
            object_to_world: Mat4::from_translation(Vec3::new(x, y, 0.0)),
            casts: true,
            receives: true,
        };
        let world = World::new(&[body(0.0, 0.0), body(10.0, 2.0)]);
        let view = View::perspective(DVec3::Y * 5.0, DVec3::NEG_Y, 0.6, 1.0);
        let pyramid = Pyramid::new(&mut Texels::new(&world, Looked { view, range: (1.0, 6.0) }, 16));
        assert_eq!(pyramid.levels.iter().map(|l| l.0).collect::<Vec<_>>(), [16, 8, 4, 2, 1]);
        let top = pyramid.levels[4].1[0];
        assert!((top.low - 0.4).abs() < 1e-9 && (top.high - 0.8).abs() < 1e-9, "{top:?}");
        assert!((top.mean - 0.6).abs() < 1e-9 && (top.variance() - 0.04).abs() < 1e-9, "{top:?}");
        let [low, high, variance] = pyramid.extremes();
        assert_eq!((low, high), (top.low, top.high));
        assert!(variance < 1e-9, "an eighth of the side sees one plate: {variance}");
    }
}
