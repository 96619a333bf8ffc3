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
    /// Near edges of shadows.
    pub edges: usize,
    /// Elsewhere.
    pub others: usize,
    /// Rays to the light for each.
    pub rays: u32,
}

impl Default for Effort {
    fn default() -> Self {
        Self { edges: 420, others: 220, rays: 64 }
    }
}

/// A point that the camera sees, with what it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver {
    /// Where it is.
    pub point: Point,
    /// The share of what is seen that it stands for. All sum to 1.
    pub weight: f64,
    /// Whether it was drawn from near the edges of shadows.
    pub edge: bool,
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

/// Looks at the scene and draws receivers. The same site gives the same ones. None if cancelled.
pub fn receivers(site: &Site<'_>, effort: Effort, watch: Watch<'_>) -> Option<Receivers> {
    let Site { world, light, camera, size, .. } = site;
    let pixels = f64::from(size.0) * f64::from(size.1);
    let coarse = (pixels / MOST_PIXELS).sqrt().max(1.0);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 1, at most the size")]
    let grid = ((f64::from(size.0) / coarse).ceil() as u32, (f64::from(size.1) / coarse).ceil() as u32);
    let found = points(world, camera, grid, watch)?;
    let seen: Vec<(usize, Point)> =
        found.into_iter().enumerate().filter_map(|(pixel, point)| Some((pixel, point?))).collect();
    let truth = visibility(world, light, Method::Rays(effort.rays), &seen, grid.0, watch)?;
    let mut lit_at: Vec<Option<f64>> = vec![None; grid.0 as usize * grid.1 as usize];
    for ((pixel, _), estimate) in seen.iter().zip(&truth) {
        lit_at[*pixel] = Some(estimate.mean);
    }
    let strata = [true, false]
        .map(|edge| -> Vec<usize> { (0..seen.len()).filter(|i| is_edge(&lit_at, grid, seen[*i].0) == edge).collect() });
    let mut drawn = Vec::new();
    for ((stratum, edge), most) in strata.iter().zip([true, false]).zip([effort.edges, effort.others]) {
        let count = stratum.len().min(most.max(1));
        for k in 0..count {
            // Even steps through the pixels in their order spread the points over the picture.
            let index = stratum[(2 * k + 1) * stratum.len() / (2 * count)];
            let (pixel, point) = &seen[index];
            let at = ((pixel % grid.0 as usize) as u32, (pixel / grid.0 as usize) as u32);
            drawn.push(Receiver {
                point: *point,
                weight: stratum.len() as f64 / count as f64 / seen.len().max(1) as f64,
                edge,
                truth: truth[index],
                moves: moves(camera, grid, at, point, *size),
                turn: turn(f64::from(at.0) * coarse, f64::from(at.1) * coarse),
            });
        }
    }
    let share =
        |of: &dyn Fn(f64) -> bool| truth.iter().filter(|t| of(t.mean)).count() as f64 / truth.len().max(1) as f64;
    let all = lit_at.len().max(1) as f64;
    let shaded = seen.iter().filter(|(_, p)| p.receives && light.view_of(p.position).is_some()).count();
    Some(Receivers {
        drawn,
        seen: seen.len() as f64 / all,
        lit: share(&|v| v >= 0.99),
        dark: share(&|v| v <= 0.01),
        between: share(&|v| v > 0.01 && v < 0.99),
        shaded: shaded as f64 / all,
    })
}

/// Whether visibility changes at a pixel or within two of it.
fn is_edge(lit: &[Option<f64>], grid: (u32, u32), pixel: usize) -> bool {
    let (width, height) = (i64::from(grid.0), i64::from(grid.1));
    let (x, y) = (pixel as i64 % width, pixel as i64 / width);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for row in (y - 2).max(0)..=(y + 2).min(height - 1) {
        for column in (x - 2).max(0)..=(x + 2).min(width - 1) {
            if let Some(Some(value)) = usize::try_from(row * width + column).ok().and_then(|i| lit.get(i)) {
                (low, high) = (low.min(*value), high.max(*value));
            }
        }
    }
    high - low > EDGE
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
