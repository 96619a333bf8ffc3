//! What a light's view of the scene is like: depths, layers, gaps, footprints. These say which candidates are worth
//! judging, and in words why the others are not.

use glam::DVec2;

use super::filter::{Filter, disc, read};
use super::predict::cut;
use super::pyramid::Pyramid;
use super::receiver::{Receivers, Site, Stratum, looked};
use super::texels::{Plane, Texels};
use crate::reference::{Source, worst_bleeding};

/// Side of the map that is looked at, and width of the filter on it.
const SIDE: u32 = 256;
const WIDTH: u32 = 5;
/// Side of the pyramid.
const PYRAMID: u32 = 64;
/// A sample behind the receiver by more of the range than this, beyond what its slope explains, is another surface.
const BEHIND: f64 = 0.004;
/// How much texels may differ in size on the picture within one part of the view.
const STRETCH: f64 = 4.0;

/// Statistics of a light's view of what the camera sees.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// Shares of what is seen that are lit, in full shadow, and between.
    pub shares: [f64; 3],
    /// Least and greatest depth of texels, and the greatest variance of depth in an eighth of the map's side squared.
    pub depths: [f64; 3],
    /// Distance between the planes of depth 0 and 1, metres: the widest of all views.
    pub range: f64,
    /// Receivers under a shadow whose filter holds occluders apart: the share of those that are dark at all.
    pub layered: f64,
    /// (B - A) / (t - B) of occluders from A to B above a receiver at t, as 95 in 100 of them have at most.
    pub spread: f64,
    /// Light that bleeds at most there: (r / (r + 2))^2.
    pub bleeding: f64,
    /// Gap between the lowest occluder and the receiver that 98 in 100 of them have at least, in parts of the range.
    pub gap: f64,
    /// Share of what is seen whose filter holds something behind the receiver: there single warps light up.
    pub behind: f64,
    /// Longest side of a pixel's footprint that 95 in 100 have at most, in parts of the map's side.
    pub footprint: f64,
    /// Widths of penumbrae, in parts of the map's side: the middle one, and that which 95 in 100 have at most.
    pub penumbra: [f64; 2],
    /// Nearest and farthest distance from the eye, along its axis, metres (2 and 98 in 100).
    pub seen: [f64; 2],
    /// Parts that the view wants to be cut into: ln(far / near) / ln 4, rounded up.
    pub split_demand: u32,
}

/// Looks at a light's view of receivers.
pub fn facts(site: &Site<'_>, receivers: &Receivers) -> Facts {
    let all = looked(site.world, site.light, site.far);
    let mut maps: Vec<Texels<'_>> = all.iter().map(|l| Texels::new(site.world, *l, SIDE)).collect();
    let mut depths = [1.0_f64, 0.0, 0.0];
    for view in &all {
        let [low, high, variance] = Pyramid::new(&mut Texels::new(site.world, *view, PYRAMID)).extremes();
        depths = [depths[0].min(low), depths[1].max(high), depths[2].max(variance)];
    }
    let (mut spreads, mut gaps, mut footprints, mut penumbrae) = (vec![], vec![], vec![], vec![]);
    let (mut dark, mut layered, mut behind, mut total) = (0.0, 0.0, 0.0, 0.0);
    for receiver in &receivers.drawn {
        let Some(view) = site.light.view_of(receiver.point.position).filter(|_| receiver.point.receives) else {
            continue;
        };
        let map = &mut maps[view];
        let plane = Plane::of(&all[view], &receiver.point);
        let seen = read(Filter::Kernel(WIDTH), receiver, &plane, map);
        total += receiver.weight;
        let longest = receiver.changes(&plane, map).map(DVec2::length);
        footprints.push((longest[0].max(longest[1]) / f64::from(SIDE), receiver.weight));
        let occluders = || seen.samples.iter().filter(|s| s.dark && s.weight > 0.01).map(|s| s.depth);
        let (nearest, farthest) =
            (occluders().fold(f64::INFINITY, f64::min), occluders().fold(f64::NEG_INFINITY, f64::max));
        if nearest <= farthest {
            let gap = (seen.receiver.min(1.0) - farthest).max(1e-6);
            let spread = (farthest - nearest) / gap;
            dark += receiver.weight;
            layered += if spread > 0.1 { receiver.weight } else { 0.0 };
            spreads.push((spread, receiver.weight));
            gaps.push((gap, receiver.weight));
        }
        let reach = 2.0 * seen.reach + BEHIND;
        if seen.samples.iter().any(|s| s.depth > seen.receiver + reach && s.weight > 0.01) {
            behind += receiver.weight;
        }
        if let Some(width) =
            penumbra(&site.light.source, receiver.turn, &plane, map).filter(|_| receiver.stratum != Stratum::Other)
        {
            penumbrae.push((width, receiver.weight));
        }
    }
    let eye = (site.camera.target - site.camera.position).as_dvec3().normalize_or_zero();
    let from = site.camera.position.as_dvec3();
    let mut away: Vec<_> = receivers.drawn.iter().map(|r| ((r.point.position - from).dot(eye), r.weight)).collect();
    let seen = [quantile(&mut away, 0.02), quantile(&mut away, 0.98)];
    let spread = quantile(&mut spreads, 0.95);
    let demand = (seen[1].max(1e-6) / seen[0].max(1e-6)).ln() / STRETCH.ln();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 1 and 4")]
    let split_demand = demand.ceil().clamp(1.0, 4.0) as u32;
    Facts {
        shares: [receivers.lit, receivers.dark, receivers.between],
        depths,
        range: all.iter().map(|l| l.range.1 - l.range.0).fold(0.0, f64::max),
        layered: layered / f64::max(dark, 1e-12),
        spread,
        bleeding: worst_bleeding(spread),
        gap: quantile(&mut gaps, 0.02),
        behind: behind / f64::max(total, 1e-12),
        footprint: quantile(&mut footprints, 0.95),
        penumbra: [quantile(&mut penumbrae, 0.5), quantile(&mut penumbrae, 0.95)],
        seen,
        split_demand,
    }
}

/// The share of all texels of a light's maps that an occluder covers, where its view is cut into so many parts.
pub fn covered(site: &Site<'_>, parts: u32) -> f64 {
    let views = looked(site.world, &cut(site, PYRAMID, parts), site.far);
    let (mut covered, mut all) = (0.0, 0.0);
    for view in views {
        let mut map = Texels::new(site.world, view, PYRAMID);
        for i in 0..i64::from(PYRAMID * PYRAMID) {
            let texel = map.at(i % i64::from(PYRAMID), i / i64::from(PYRAMID));
            covered += if texel.distance.is_finite() { 1.0 } else { 0.0 };
            all += 1.0;
        }
    }
    covered / f64::max(all, 1.0)
}

/// Width of the penumbra at a receiver, in parts of the map's side, where there is an occluder around; similar triangles.
fn penumbra(source: &Source, turn: f64, plane: &Plane, map: &mut Texels<'_>) -> Option<f64> {
    let view = map.looked().view;
    let half = match source {
        Source::Point { .. } => 0.0,
        Source::Ball { radius, .. } | Source::Disc { radius, .. } => *radius,
        Source::Rectangle { half, .. } => half[0].length().max(half[1].length()),
        Source::Distant { angle, .. } => angle.tan(),
    };
    let side = f64::from(map.side());
    let margin = plane.margin(map.side(), 8.0);
    let (mut sum, mut count) = (0.0, 0.0);
    for place in disc(32, turn) {
        let at = plane.place * side + place * 8.0;
        let texel = map.at(at.x.floor() as i64, at.y.floor() as i64);
        if texel.depth < map.looked().depth(plane.distance_at(at / side)).clamp(0.0, 1.0) - margin {
            sum += texel.distance;
            count += 1.0;
        }
    }
    let occluder: f64 = (count > 0.0).then_some(sum / count)?;
    let [low, high] = view.window;
    Some(2.0 * half * plane.reach(occluder) / (high - low).max_element().max(1e-12))
}

/// The value that a share of the weights is at most at; 0 of nothing.
fn quantile(values: &mut [(f64, f64)], share: f64) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = values.iter().map(|v| v.1).sum();
    let mut sum = 0.0;
    for (value, weight) in values.iter() {
        sum += weight;
        if sum >= share * total {
            return *value;
        }
    }
    0.0
}
