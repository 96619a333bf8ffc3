//! Fixed passes: shaders that are not nodes, under `shaders/`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::catalog::Catalog;
use super::definition::{Choices, Item, OptionSpec};
use super::file::{self, resolve};
use super::report::Report;
use crate::diagnostic::{Diagnostic, Place, SourceText, did_you_mean};

/// What a pass runs over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PassKind {
    /// The objects of the scene, drawn from the light. Group 0 binding 0: `LightSpace`; group 1 binding 0: the object
    /// block; vertex location 0: object-space position. A colour target gets a depth buffer beside it.
    Geometry,
    /// Every texel of an image: a full-screen triangle that reads group 0 binding 0 (`texture_2d<f32>`) and writes a
    /// texture of the same size and format.
    Image,
    /// The same by a compute shader (`cs_main`): group 0 binding 0 is read, and the texture at binding 1, of the same size,
    /// is stored to. There are invocations for all texels, and some beyond the last.
    Compute,
    /// Every texel of every mip level but the first: as an image pass, but from each level of a texture to the next.
    Mip,
}

impl PassKind {
    /// Every kind with the name that headers give it.
    pub const ALL: [(&'static str, Self); 4] =
        [("geometry", Self::Geometry), ("image", Self::Image), ("compute", Self::Compute), ("mip", Self::Mip)];

    /// The name that headers give it.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }
}

/// `skip: NAME == VALUE`: the pass does nothing for that choice and is left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skip {
    /// An option of the pass.
    pub option: String,
    /// The choice of it.
    pub value: String,
}

/// A fixed pass.
#[derive(Clone, Debug)]
pub struct PassFile {
    /// The file's stem.
    pub name: String,
    /// What it runs over.
    pub kind: PassKind,
    /// Libraries that it needs, direct ones only.
    pub uses: Vec<String>,
    /// Structural choices.
    pub options: Vec<OptionSpec>,
    /// Texture formats that it can write, the preferred one first, as its `target:` line words them.
    pub targets: Vec<String>,
    /// What its target holds before; empty: it does not matter.
    pub clear: Vec<f64>,
    /// Axes that it runs along one after the other (`x`, `y`); empty: it runs once.
    pub axes: Vec<String>,
    /// When it is left out.
    pub skip: Option<Skip>,
    /// Whether an image pass reads the light's view (`reads: light`), a `LightSpace`: group 0 binding 1, or 2 of a compute
    /// pass.
    pub reads_light: bool,
    /// `repeat: doubling N`: an image or compute pass that is run for the distances 1, N, N^2, ... (texels) below the
    /// side, each time over what it made before. Group 0 binding 3 is the distance, a `u32`.
    pub repeat: Option<u32>,
    /// `otherwise: PASS`: what takes its place, with the same arguments, where an adapter cannot run it.
    pub otherwise: Option<String>,
    /// All other header lines joined by spaces.
    pub description: String,
    /// The file.
    pub source: Arc<SourceText>,
}

impl PassFile {
    /// Whether the pass is left out for these choices.
    pub fn is_skipped(&self, choices: &Choices) -> bool {
        self.skip.as_ref().is_some_and(|skip| {
            let default = self.options.iter().find(|o| o.name == skip.option).map(|o| &o.default);
            choices.get(&skip.option).or(default) == Some(&skip.value)
        })
    }

    /// The complete WGSL for these choices: what its entry points reach in its libraries and in the file itself, in
    /// file order, libraries first.
    ///
    /// # Errors
    /// Unknown choices and libraries, malformed conditions and declarations. The text is not judged by naga here.
    pub fn text(&self, choices: &Choices, catalog: &Catalog) -> Result<String, Vec<Diagnostic>> {
        self.text_with(choices, catalog, None)
    }

    /// The same with the items of a variant in the place of those that they are a variant of ([`Catalog::variant`]).
    ///
    /// # Errors
    /// As [`Self::text`].
    pub fn text_with(
        &self,
        choices: &Choices,
        catalog: &Catalog,
        variant: Option<&str>,
    ) -> Result<String, Vec<Diagnostic>> {
        let mut report = Report::new(&self.source);
        let choices = resolve(&self.options, choices, Place::file(&self.source.name))?;
        let applied = file::apply(&mut report, &self.options, &choices);
        for name in self.uses.iter().filter(|name| catalog.library(name).is_none()) {
            report
                .error("ST0128", 0..0, format!("there is no library `{name}`"))
                .suggest(did_you_mean(name, catalog.library_names()));
        }
        if !report.found.is_empty() {
            return Err(report.found);
        }
        let own = file::items_of(&applied);
        let entries: Vec<&str> = applied.declarations.iter().filter(|d| d.entry).map(|d| d.name.as_str()).collect();
        if entries.is_empty() {
            let help = match self.kind {
                PassKind::Compute => "mark one function `@compute @workgroup_size(8, 8)` and call it `cs_main`",
                _ => "mark one function `@vertex` and one `@fragment`",
            };
            report.error("ST0121", 0..0, format!("the pass `{}` has no entry point", self.name)).help(help);
            return Err(report.found);
        }
        let others = variant.map_or(Vec::new(), |name| catalog.variant(name));
        let replaced = |item: &&Item| others.iter().all(|other| other.name != item.name);
        let libraries = catalog.closure(&self.uses).into_iter().flat_map(|l| &l.items).filter(replaced);
        let items: Vec<&Item> = libraries.chain(&others).chain(&own).collect();
        let kept = reachable(&items, &entries);
        let texts: Vec<&str> =
            items.iter().filter(|i| kept.contains(i.name.as_str())).map(|i| i.text.as_str()).collect();
        Ok(texts.join("\n\n") + "\n")
    }
}

/// Names of the items that `roots` mention, directly or through others, `roots` included.
pub fn reachable<'a>(items: &[&'a Item], roots: &[&'a str]) -> BTreeSet<&'a str> {
    let by_name: BTreeMap<&str, &'a Item> = items.iter().map(|i| (i.name.as_str(), *i)).collect();
    let mut open: Vec<&'a str> = roots.to_vec();
    let mut kept = BTreeSet::new();
    while let Some(name) = open.pop() {
        if let Some(item) = by_name.get(name)
            && kept.insert(item.name.as_str())
        {
            open.extend(item.mentions.iter().map(String::as_str));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLUR: &str = "\
//! kind: image
//! use: taps
//! option width: 3 | 5 = 5 - Taps along an axis.
//! option mode: box | none = box - Shape.
//! target: rg32float | rg16float
//! clear: (1, 0.5)
//! axes: x | y
//! skip: mode == none
//! Blurs along one axis.

const WIDTH: i32 = 5;
@group(0) @binding(0) var input: texture_2d<f32>;
fn unused() -> f32 { return 1.0; }
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f { return corner(i); }
@fragment fn fragment(@builtin(position) p: vec4f) -> @location(0) vec4f {
    return textureLoad(input, vec2i(p.xy), WIDTH);
}
";

    fn pass(text: &str) -> Result<PassFile, Vec<String>> {
        let found = PassFile::parse(&SourceText::new("shaders/blur.wgsl", text));
        found.map_err(|e| e.into_iter().map(|d| format!("{} {}", d.code, d.message)).collect())
    }

    #[test]
    fn header_is_read() {
        let p = pass(BLUR).unwrap();
        assert_eq!((p.name.as_str(), p.kind), ("blur", PassKind::Image));
        assert_eq!(p.targets, ["rg32float", "rg16float"]);
        assert_eq!((p.clear.as_slice(), p.axes.len()), ([1.0, 0.5].as_slice(), 2));
        assert_eq!(p.description, "Blurs along one axis.");
        assert!(!p.is_skipped(&Choices::new()));
        assert!(p.is_skipped(&Choices::from([("mode".into(), "none".into())])));
    }

    #[test]
    fn compute_passes_say_what_they_store_and_how_often_they_run() {
        let text = "//! kind: compute\n//! target: rg32uint\n//! repeat: doubling 4\n//! otherwise: drawn\n";
        let p = pass(text).unwrap();
        assert_eq!(
            (p.kind, p.kind.name(), p.repeat, p.otherwise.as_deref()),
            (PassKind::Compute, "compute", Some(4), Some("drawn"))
        );
        assert_eq!(pass("//! kind: image\n//! repeat: doubling\n").unwrap().repeat, Some(2));
        let missing = p.text(&Choices::new(), &Catalog::default()).unwrap_err();
        assert!(missing[0].help.as_ref().is_some_and(|h| h.contains("cs_main")), "{missing:?}");
    }

    #[test]
    fn only_what_is_reached_is_written() {
        let mut catalog = Catalog::default();
        let library = "fn corner(i: u32) -> vec4f { return vec4f(f32(i)); }\nfn other() -> f32 { return 1.0; }";
        assert!(catalog.add_library("taps.wgsl", library).is_empty());
        let text = pass(BLUR).unwrap().text(&Choices::from([("width".into(), "3".into())]), &catalog).unwrap();
        assert!(text.contains("fn corner") && text.contains("var input") && text.contains("WIDTH: i32 = 3;"), "{text}");
        assert!(!text.contains("unused") && !text.contains("other"), "{text}");
        assert!(naga::front::wgsl::parse_str(&text).is_ok());
    }

    #[test]
    fn conditions_choose_header_lines() {
        let text = "\
//! kind: image
//! option precision: half | single = single - Bits.
//#if precision == half
//! target: rg16float
//! clear: 2
//#else
//! target: rg32float
//! clear: 3
//#end
//! Reads.
";
        let p = pass(text).unwrap();
        assert_eq!((p.targets.as_slice(), p.clear.as_slice()), (["rg32float".to_owned()].as_slice(), [3.0].as_slice()));
        let half = p.chosen(&Choices::from([("precision".into(), "half".into())])).unwrap();
        assert_eq!(
            (half.targets.as_slice(), half.clear.as_slice()),
            (["rg16float".to_owned()].as_slice(), [2.0].as_slice())
        );
        assert_eq!(half.description, "Reads.");
        let unknown = Choices::from([("precision".into(), "double".into()), ("other".into(), "a".into())]);
        assert_eq!(p.chosen(&unknown).unwrap().targets, p.targets);
    }

    #[test]
    fn mistakes() {
        let found = pass("//! kind: imge\n//! axs: x\n//! axes: z\n//! clear: a\n//! skip: a == b\n//! skip: a == c\n")
            .unwrap_err();
        let codes: Vec<&str> = found.iter().map(|f| &f[..6]).collect();
        assert_eq!(codes, ["ST0138", "ST0101", "ST0138", "ST0138", "ST0104", "ST0107"], "{found:?}");
        assert!(pass("").unwrap_err()[0].starts_with("ST0138"));
        let wrong = |text: &str| pass(text).unwrap_err().concat();
        assert!(wrong("//! kind: compute\n").contains("which formats it stores"));
        assert!(wrong("//! kind: compute\n//! target: rg32float\n//! clear: 1\n").contains("not cleared"));
        assert!(wrong("//! kind: compute\n//! target: rg16float\n").contains("`rg16float`"));
        assert!(wrong("//! kind: geometry\n//! repeat: doubling\n").contains("a geometry pass cannot be repeated"));
        assert!(wrong("//! kind: mip\n//! otherwise: blur\n").contains("place of a mip pass"));
        for word in ["tripling", "doubling 1", "doubling 65", "doubling x", "doubling 2 2", ""] {
            assert!(wrong(&format!("//! kind: image\n//! repeat: {word}\n")).contains("`repeat` reads"), "{word}");
        }
        let p = pass(BLUR).unwrap();
        assert_eq!(p.text(&Choices::new(), &Catalog::default()).unwrap_err()[0].code, "ST0128");
        let bad = Choices::from([("width".into(), "4".into()), ("wdth".into(), "3".into())]);
        assert_eq!(p.text(&bad, &Catalog::default()).unwrap_err().len(), 2);
    }
}
