//! What the camera sees of a light: points of surfaces with their true visibility, drawn so that few tell of all.

use glam::{DVec2, DVec3};

use super::texels::{Looked, Plane, Texels};
use crate::reference::picture::{Method, Watch, eye_ray, points, visibility};
use crate::reference::{Estimate, Light, Point, World};
use crate::scene::Camera;

/// Pixels of the coarse picture in which receivers are looked for, at most.
const MOST_PIXELS: f64 = 6000.0;
/// Visibilities that differ by more make an edge.
const EDGE: f64 = 0.02;

/// A light over a world, seen by a camera.
#[derive(Clone, Debug)]
pub struct Site<'a> {
    /// What stands where.
    pub world: &'a World,
    /// The light, its maps in one part.
    pub light: &'a Light,
    /// Where maps of the light end, metres along the axis; none where they fit the scene.
    pub far: Option<f64>,
    /// Who looks.
    pub camera: Camera,
    /// Columns and rows of the picture.
    pub size: (u32, u32),
}

/// How many receivers are drawn, and how exactly they are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// On the edges of shadows.
    pub edges: usize,
    /// Near them.
    pub near: usize,
    /// Elsewhere.
    pub others: usize,
    /// Rays to the light for each.
    pub rays: u32,
}

impl Default for Effort {
    fn default() -> Self {
        Self { edges: 400, near: 260, others: 200, rays: 64 }
    }
}

/// Parts of the picture that receivers are drawn from, each as often as it matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stratum {
    /// Pixels where visibility changes.
    Edge,
    /// What lies within a few pixels of them.
    Near,
    /// All else.
    Other,
}

impl Stratum {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Edge, Self::Near, Self::Other];
}

/// A point that the camera sees, with what it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver {
    /// Where it is.
    pub point: Point,
    /// The share of what is seen that it stands for. All sum to 1.
    pub weight: f64,
    /// What it was drawn from.
    pub stratum: Stratum,
    /// Visibility as it ought to be.
    pub truth: Estimate,
    /// How the point moves from a pixel to the next to the right, and below: metres.
    pub moves: [DVec3; 2],
    /// How much samples are turned at its pixel, in parts of a circle.
    pub turn: f64,
}

impl Receiver {
    /// The same moves, in texels of a map.
    pub fn changes(&self, plane: &Plane, map: &Texels<'_>) -> [DVec2; 2] {
        let view = &map.looked().view;
        let side = f64::from(map.side());
        self.moves.map(|by| {
            let there = view.place(view.point(self.point.position + by));
            let change = (there - plane.place) * side;
            if change.is_finite() { change } else { DVec2::ZERO }
        })
    }
}

/// Receivers of a light, and what is known of all that is seen.
#[derive(Clone, Debug, Default)]
pub struct Receivers {
    /// Those that were drawn.
    pub drawn: Vec<Receiver>,
    /// Share of the picture in which something is seen.
    pub seen: f64,
    /// Of what is seen: the shares that are lit, in full shadow, and between.
    pub lit: f64,
    /// See `lit`.
    pub dark: f64,
    /// See `lit`.
    pub between: f64,
    /// Share of the picture whose pixels look the shadow up: within the light's maps.
    pub shaded: f64,
}

/// What is seen through some pixels of a picture.
struct Pixels {
    /// Columns and rows of the picture.
    grid: (u32, u32),
    /// Pixels, in their order, with the points seen through them.
    points: Vec<(usize, Point)>,
    /// Their true visibilities.
    truth: Vec<Estimate>,
    /// The same, by pixel.
    lit: Vec<Option<f64>>,
}

impl Pixels {
    /// Looks through those pixels that are wanted.
    fn look(
        site: &Site<'_>,
        grid: (u32, u32),
        rays: u32,
        wanted: impl Fn(usize) -> bool,
        watch: Watch<'_>,
    ) -> Option<Self> {
        let all = points(site.world, &site.camera, grid, watch)?.into_iter().enumerate();
        let points: Vec<(usize, Point)> =
            all.filter_map(|(pixel, point)| Some((pixel, point.filter(|_| wanted(pixel))?))).collect();
        let truth = visibility(site.world, site.light, Method::Rays(rays), &points, grid.0, watch)?;
        let mut lit = vec![None; grid.0 as usize * grid.1 as usize];
        for ((pixel, _), estimate) in points.iter().zip(&truth) {
            lit[*pixel] = Some(estimate.mean);
        }
        Some(Self { grid, points, truth, lit })
    }

    /// Whether visibility changes at a pixel or within so many of it.
    fn changes(&self, pixel: usize, reach: i64) -> bool {
        let (width, height) = (i64::from(self.grid.0), i64::from(self.grid.1));
        let (x, y) = (pixel as i64 % width, pixel as i64 / width);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for row in (y - reach).max(0)..=(y + reach).min(height - 1) {
            for column in (x - reach).max(0)..=(x + reach).min(width - 1) {
                let found = usize::try_from(row * width + column).ok().and_then(|i| self.lit.get(i)).copied().flatten();
                if let Some(value) = found {
                    (low, high) = (low.min(value), high.max(value));
                }
            }
        }
        high - low > EDGE
    }

    /// Receivers for a picture of `size`, drawn from some of these, which stand for so much of what is seen.
    fn drawn<'a>(
        &'a self,
        (camera, size): (&'a Camera, (u32, u32)),
        from: &'a [usize],
        (most, stratum, share): (usize, Stratum, f64),
    ) -> impl Iterator<Item = Receiver> + 'a {
        let count = from.len().min(most.max(1));
        let step = f64::from(size.0) / f64::from(self.grid.0);
        (0..count).map(move |k| {
            // Even steps through the pixels in their order spread the points over the picture.
            let index = from[(2 * k + 1) * from.len() / (2 * count)];
            let (pixel, point) = &self.points[index];
            let at = ((pixel % self.grid.0 as usize) as u32, (pixel / self.grid.0 as usize) as u32);
            Receiver {
                point: *point,
                weight: share / count as f64,
                stratum,
                truth: self.truth[index],
                moves: moves(camera, self.grid, at, point, size),
                turn: turn(f64::from(at.0) * step, f64::from(at.1) * step),
            }
        })
    }
}

/// Looks at the scene and draws receivers. The same site gives the same ones. None if cancelled.
pub fn receivers(site: &Site<'_>, effort: Effort, watch: Watch<'_>) -> Option<Receivers> {
    let Site { light, camera, size, .. } = site;
    let pixels = f64::from(size.0) * f64::from(size.1);
    let coarse = (pixels / MOST_PIXELS).sqrt().max(1.0);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 1, at most the size")]
    let grid = ((f64::from(size.0) / coarse).ceil() as u32, (f64::from(size.1) / coarse).ceil() as u32);
    let seen = Pixels::look(site, grid, effort.rays, |_| true, watch)?;
    let near_edges: Vec<bool> = (0..seen.lit.len()).map(|pixel| seen.changes(pixel, 2)).collect();
    // Where visibility changes, all pixels of the picture are looked at: what is wrong there may be as narrow as one.
    let cell = |pixel: usize| {
        let (x, y) = (pixel % size.0 as usize, pixel / size.0 as usize);
        let along = |at: usize, all: u32, cells: u32| at * cells as usize / all as usize;
        along(y, size.1, grid.1) * grid.0 as usize + along(x, size.0, grid.0)
    };
    let fine = Pixels::look(site, *size, effort.rays, |pixel| near_edges[cell(pixel)], watch)?;
    let (edge, near): (Vec<usize>, Vec<usize>) =
        (0..fine.points.len()).partition(|i| fine.changes(fine.points[*i].0, 1));
    let other: Vec<usize> = (0..seen.points.len()).filter(|i| !near_edges[seen.points[*i].0]).collect();
    // Pixels of the picture that one of the coarse ones stands for.
    let each = pixels / (f64::from(grid.0) * f64::from(grid.1));
    let total = (fine.points.len() as f64 + other.len() as f64 * each).max(1.0);
    let view = (camera, *size);
    let mut drawn = Vec::new();
    drawn.extend(fine.drawn(view, &edge, (effort.edges, Stratum::Edge, edge.len() as f64 / total)));
    drawn.extend(fine.drawn(view, &near, (effort.near, Stratum::Near, near.len() as f64 / total)));
    drawn.extend(seen.drawn(view, &other, (effort.others, Stratum::Other, other.len() as f64 * each / total)));
    let truth = &seen.truth;
    let share =
        |of: &dyn Fn(f64) -> bool| truth.iter().filter(|t| of(t.mean)).count() as f64 / truth.len().max(1) as f64;
    let all = seen.lit.len().max(1) as f64;
    let shaded = seen.points.iter().filter(|(_, p)| p.receives && light.view_of(p.position).is_some()).count();
    Some(Receivers {
        drawn,
        seen: seen.points.len() as f64 / all,
        lit: share(&|v| v >= 0.99),
        dark: share(&|v| v <= 0.01),
        between: share(&|v| v > 0.01 && v < 0.99),
        shaded: shaded as f64 / all,
    })
}

/// How the point seen through a pixel moves on its plane to the pixel beside and to the pixel below, of a picture of
/// `size` whose coarse form is `grid`.
fn moves(camera: &Camera, grid: (u32, u32), at: (u32, u32), point: &Point, size: (u32, u32)) -> [DVec3; 2] {
    let ray = eye_ray(camera, grid, at);
    let next = [eye_ray(camera, grid, (at.0 + 1, at.1)), eye_ray(camera, grid, (at.0, at.1 + 1))];
    let scale = [f64::from(grid.0) / f64::from(size.0), f64::from(grid.1) / f64::from(size.1)];
    let mut moves = [DVec3::ZERO; 2];
    for ((to, next), scale) in moves.iter_mut().zip(next).zip(scale) {
        // One pixel of the picture, not of its coarse form.
        let direction = ray.direction + (next.direction - ray.direction) * scale;
        let facing = point.normal.dot(direction);
        let distance = point.normal.dot(point.position - ray.origin) / facing;
        let there = ray.origin + direction * distance;
        if there.is_finite() && distance > 0.0 {
            *to = there - point.position;
        }
    }
    moves
}

/// Interleaved gradient noise (Jimenez 2014), by which samples are turned.
fn turn(x: f64, y: f64) -> f64 {
    (52.982_918_9 * (0.067_110_56 * x.floor() + 0.005_837_15 * y.floor()).fract()).fract()
}

/// The views of a light's maps with the range of their depths.
pub fn looked(world: &World, light: &Light, far: Option<f64>) -> Vec<Looked> {
    let fitted = |view: &crate::reference::View| {
        let z = || world.boxes().iter().flatten().map(|c| view.point(*c).z);
        let (low, high) = (z().fold(f64::INFINITY, f64::min), z().fold(f64::NEG_INFINITY, f64::max));
        if low > high {
            return (0.0, 1.0);
        }
        let margin = (high - low).max(view.window[1].x.abs()) * 1e-3;
        (low - margin, high + margin)
    };
    let range = |view: &crate::reference::View| far.map_or_else(|| fitted(view), |far| (view.near, far));
    light.views.iter().map(|view| Looked { view: *view, range: range(view) }).collect()
}
