//! What can be chosen: kinds of shadows with their options, and how each is judged and priced.
//!
//! [`MODELS`] is the one table that knows kinds of shadows by name. A kind that has no row here is never chosen, and the
//! plan says so.

use std::collections::BTreeMap;

use super::filter::Filter;
use super::judge::{Judge, Storage};

/// A kind of shadow with all its settings, on a light whose view is cut into so many parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Kind of the shadow node.
    pub kind: &'static str,
    /// Options of the shadow node that are not its defaults.
    pub options: BTreeMap<&'static str, String>,
    /// Values of its ports that are not its defaults.
    pub params: BTreeMap<&'static str, f64>,
    /// Texels on a side of the map.
    pub side: u32,
    /// Parts of the view, each with a map.
    pub parts: u32,
    /// What it reads; none for those that read for themselves.
    pub filter: Option<Filter>,
    /// What it makes of that.
    pub judge: Judge,
    /// What its map is, as the table of costs calls it.
    pub map: &'static str,
    /// Texels across the blur of the map.
    pub blur: u32,
    /// Whether the map has mips.
    pub mips: bool,
    /// What its reads are, as the table of costs calls them, and how many a pixel makes if that does not follow the
    /// footprint.
    pub reads: (&'static str, f64),
}

impl Candidate {
    /// One line: kind, options and values.
    pub fn name(&self) -> String {
        let mut text = self.kind.to_owned();
        if self.parts > 1 {
            text += &format!(" splits={}", self.parts);
        }
        for (name, value) in &self.options {
            text += &format!(" {name}={value}");
        }
        for (name, value) in &self.params {
            text += &format!(" {name}={value}");
        }
        text
    }
}

/// What the scene asks candidates to be like.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand {
    /// Sides of maps that are tried.
    pub sides: Vec<u32>,
    /// Numbers of parts that are tried.
    pub parts: Vec<u32>,
    /// How wide penumbrae are, in the parts of a map's side that hold most of them: half of them are narrower than the
    /// first, nearly all are narrower than the second.
    pub penumbra: [f64; 2],
    /// The longest side of nearly all pixels' footprints, in parts of the side of a map.
    pub footprint: f64,
    /// Whether the light has a size at all.
    pub soft: bool,
}

/// A kind of shadow that can be judged.
pub struct Model {
    /// Kind of the shadow node.
    pub kind: &'static str,
    /// Which variants of it are worth trying with one side of the map.
    variants: fn(&mut Maker<'_>),
}

/// Every kind that can be judged, in the order in which equals are preferred.
pub const MODELS: &[Model] = &[
    Model { kind: "hard_shadow", variants: hard },
    Model { kind: "pcf_shadow", variants: compared },
    Model { kind: "adaptive_pcf_shadow", variants: adaptive },
    Model { kind: "disc_shadow", variants: discs },
    Model { kind: "pcss_shadow", variants: searching },
    Model { kind: "variance_shadow", variants: variance },
    Model { kind: "exponential_shadow", variants: exponential },
    Model { kind: "exponential_variance_shadow", variants: warped },
    Model { kind: "moment_shadow", variants: moments },
];

/// All that is worth trying.
pub fn candidates(demand: &Demand) -> Vec<Candidate> {
    let mut all = Vec::new();
    for parts in &demand.parts {
        for side in &demand.sides {
            for model in MODELS {
                (model.variants)(&mut Maker { kind: model.kind, demand, side: *side, parts: *parts, all: &mut all });
            }
        }
    }
    all
}

/// Collects the variants of one kind with one side.
struct Maker<'a> {
    kind: &'static str,
    demand: &'a Demand,
    side: u32,
    parts: u32,
    all: &'a mut Vec<Candidate>,
}

impl Maker<'_> {
    fn add(
        &mut self,
        options: &[(&'static str, &str)],
        (map, reads): (&'static str, (&'static str, f64)),
        filter: Option<Filter>,
        judge: Judge,
    ) -> &mut Candidate {
        let mut all: BTreeMap<&'static str, String> = options.iter().map(|(n, v)| (*n, (*v).to_owned())).collect();
        all.insert("size", self.side.to_string());
        self.all.push(Candidate {
            kind: self.kind,
            options: all,
            params: BTreeMap::new(),
            side: self.side,
            parts: self.parts,
            filter,
            judge,
            map,
            blur: 0,
            mips: false,
            reads,
        });
        let last = self.all.len() - 1;
        &mut self.all[last]
    }

    /// Widths of filters, of those that there are, that neither blur far more than penumbrae do nor are all the same.
    fn widths(&self, all: &[u32]) -> Vec<u32> {
        let texels = self.demand.penumbra.map(|p| p * f64::from(self.side));
        // A Gaussian as wide as w texels has the deviation of a ramp of 0.87 w.
        let most = (texels[1] * 2.5).max(3.0);
        all.iter().copied().filter(|w| f64::from(*w) <= most).collect()
    }

    /// Whether pixels cover more than a texel.
    fn minified(&self) -> bool {
        self.demand.footprint * f64::from(self.side) > 1.0
    }
}

fn hard(make: &mut Maker<'_>) {
    make.add(&[], ("depth", ("nearest comparison", 1.0)), Some(Filter::Nearest), Judge::Comparison);
}

fn compared(make: &mut Maker<'_>) {
    for width in make.widths(&[1, 3, 5, 7, 9]) {
        let name = width.to_string();
        let filter = Some(Filter::Kernel(width));
        let blended = f64::from((width + 1) * (width + 1));
        // Samplers compare four texels with one depth, which is off the receiver's plane at all of them: no model here tells
        // how far off that makes them.
        let options = [("taps", "bilinear"), ("width", name.as_str())];
        make.add(&options, ("depth", ("exact comparison", blended)), filter, Judge::Comparison);
    }
}

fn adaptive(make: &mut Maker<'_>) {
    if make.minified() {
        let filter = Some(Filter::Footprint(8));
        make.add(&[("taps", "bilinear")], ("depth", ("adaptive comparison", 0.0)), filter, Judge::Comparison);
    }
}

fn discs(make: &mut Maker<'_>) {
    let side = f64::from(make.side);
    let typical = (make.demand.penumbra[0] * side * 0.6).clamp(1.0, 24.0);
    let radius = (typical * 2.0).round() / 2.0;
    if radius > 1.5 {
        for count in [8, 16, 32] {
            let filter = Some(Filter::Disc(count, radius));
            let reads = ("disc comparison", f64::from(count));
            make.add(&[("count", &count.to_string())], ("depth", reads), filter, Judge::Comparison)
                .params
                .insert("radius", radius);
        }
    }
}

fn searching(make: &mut Maker<'_>) {
    if make.demand.soft && make.demand.penumbra[1] * f64::from(make.side) > 1.5 {
        for (search, filter) in [(8, 16), (16, 32), (32, 64)] {
            let judge = Judge::Blockers { search, filter };
            let reads = ("searching read", f64::from(search + filter));
            let options = [("filter", filter.to_string()), ("search", search.to_string())];
            let options = options.each_ref().map(|(n, v)| (*n, v.as_str()));
            make.add(&options, ("depth", reads), None, judge);
        }
    }
}

/// The forms of a blurred map: its width, and whether it has mips. What has is also tried without.
fn blurred(make: &mut Maker<'_>, each: impl Fn(&mut Maker<'_>, u32, bool, Filter)) {
    for width in make.widths(&[1, 3, 5, 7, 9, 11, 13, 15, 19, 25]) {
        each(make, width, false, Filter::Kernel(width));
        if make.minified() {
            each(make, width, true, Filter::Mips(width, 16));
        }
    }
}

/// One blurred map with its options.
fn filtered(
    make: &mut Maker<'_>,
    (width, mips, filter): (u32, bool, Filter),
    options: &[(&'static str, &str)],
    map: &'static str,
    judge: Judge,
) {
    let width_text = width.to_string();
    let mut all = options.to_vec();
    all.extend([("mips", if mips { "on" } else { "off" }), ("width", width_text.as_str())]);
    let reads = if mips { ("filtered read", 0.0) } else { ("plain read", 1.0) };
    let made = make.add(&all, (map, reads), Some(filter), judge);
    (made.blur, made.mips) = (width, mips);
}

fn variance(make: &mut Maker<'_>) {
    blurred(make, |make, width, mips, filter| {
        for reduction in [0.18, 0.0] {
            for (format, storage, least, map) in [
                ("rg32float", Storage::Single, 1e-6, "two moments"),
                ("rg16unorm", Storage::Unorm, 2e-5, "two moments in 16 bits"),
            ] {
                let judge = Judge::Variance { least, reduction, storage };
                filtered(make, (width, mips, filter), &[("format", format)], map, judge);
                if let Some(made) = make.all.last_mut() {
                    if reduction != 0.18 {
                        made.params.insert("bleeding_reduction", reduction);
                    }
                    if storage == Storage::Unorm {
                        made.params.insert("minimum_variance", least);
                    }
                }
            }
        }
    });
}

fn exponential(make: &mut Maker<'_>) {
    blurred(make, |make, width, mips, filter| {
        for (option, exponent) in [("40", 40.0), ("80", 80.0)] {
            let judge = Judge::Exponential { exponent };
            filtered(make, (width, mips, filter), &[("exponent", option)], "one warp", judge);
        }
    });
}

fn warped(make: &mut Maker<'_>) {
    blurred(make, |make, width, mips, filter| {
        for (option, falling, map) in [("one", None, "two warped moments"), ("two", Some(5.0), "four warped moments")] {
            let judge = Judge::Warped { exponent: 40.0, falling, least: WARPED_LEAST, reduction: WARPED_REDUCTION };
            filtered(make, (width, mips, filter), &[("warps", option)], map, judge);
        }
    });
}

/// Defaults of the exponential variance shadow.
const WARPED_LEAST: f64 = 1e-8;
const WARPED_REDUCTION: f64 = 0.0;

fn moments(make: &mut Maker<'_>) {
    blurred(make, |make, width, mips, filter| {
        filtered(make, (width, mips, filter), &[], "four moments", Judge::Moments { reduction: 0.02 });
    });
}
