//! Whether all that a study names is there: scenes with their lights, shadows with their settings.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::document::{Case, Method, Study};
use crate::diagnostic::{Diagnostic, Place, did_you_mean};
use crate::graph::Node;
use crate::node::Catalog;
use crate::studio::assets::mesh_of;
use crate::studio::load::relative;
use crate::studio::measure::{graph_of, is_shadow, shadow_kinds, shadow_of};
use crate::studio::shot::scene_of;
use crate::studio::weave::Weaver;
use crate::studio::{Failure, FailureKind, Shown, Subject};
use crate::weave::is_light;

/// A case with what is found out once.
pub(super) struct Stand {
    /// The scene.
    pub(super) files: Vec<PathBuf>,
    /// The shadow node of the light, with its graph's name.
    pub(super) shadow: String,
    /// The light node.
    pub(super) light: String,
    /// Its kind.
    pub(super) light_kind: String,
    /// Of all that casts.
    pub(super) triangles: usize,
}

/// Whether everything is there. `file` is the study's, from which paths of scenes count.
pub fn is_whole(study: &Study, file: &Path, weaver: &Weaver<'_>) -> Result<(), Failure> {
    check(study, file, weaver).map(drop)
}

/// The cases of a study, in their order. Everything that is wrong with cases and methods is told together.
pub(super) fn check(study: &Study, file: &Path, weaver: &Weaver<'_>) -> Result<Vec<Stand>, Failure> {
    let mut found = Vec::new();
    for method in &study.methods {
        check_method(method, study, weaver.catalog, &mut found);
    }
    let (mut cases, mut kind) = (Vec::new(), FailureKind::Input);
    for case in &study.cases {
        match find_case(case, file, weaver) {
            Ok(case) => cases.push(case),
            Err(failure) => {
                if failure.kind != FailureKind::Input {
                    kind = failure.kind;
                }
                found.extend(failure.diagnostics.into_iter().map(|d| of_case(d, case)));
            }
        }
    }
    // A case whose faults were told as they were found leaves none here.
    if cases.len() == study.cases.len() && found.is_empty() {
        return Ok(cases);
    }
    Err(Failure { kind, diagnostics: found })
}

fn of_case(mut diagnostic: Diagnostic, case: &Case) -> Diagnostic {
    diagnostic.message = format!("case `{}`: {}", case.name, diagnostic.message);
    diagnostic
}

fn find_case(case: &Case, file: &Path, weaver: &Weaver<'_>) -> Result<Stand, Failure> {
    let place = case.span.clone().map_or_else(Place::default, Place::span);
    let fail = |message: String, help: &str| {
        Failure::from(vec![Diagnostic::error("ST0611", message, place.clone()).help(help)])
    };
    let files = vec![relative(&case.scene, &file.display().to_string())];
    let subject = Subject { files: &files, scene: None, shape: &Shown::Sphere };
    let shadow = shadow_of(&subject, &case.light, weaver)?;
    let graph = graph_of(&subject, &case.light, weaver)?;
    let is_one = |node: &Node| {
        weaver.catalog.get(&node.kind).and_then(|f| f.definition(&node.options).ok()).is_some_and(|d| is_light(&d))
    };
    let mut lights = graph.graph.nodes.iter().filter(|(_, node)| is_one(node));
    let (light, light_kind) = match (lights.next(), lights.next()) {
        (Some((light, node)), None) => (format!("{}/{light}", graph.name), node.kind.clone()),
        _ => {
            return Err(fail(
                format!("the graph of `{}` has not exactly one light node", case.light),
                "take another light",
            ));
        }
    };
    let scene = scene_of(&files[0], weaver)?;
    let mut triangles = 0;
    for object in scene.objects.iter().filter(|o| o.casts) {
        triangles += mesh_of(&object.shape, &files[0], weaver.loader)?.indices.len() / 3;
    }
    if triangles == 0 {
        let message = format!("nothing casts a shadow in `{}`", case.scene);
        let diagnostic = Diagnostic::error("ST0612", message, place);
        return Err(vec![diagnostic.help("let an object cast, or take another scene")].into());
    }
    Ok(Stand { files, shadow, light, light_kind, triangles })
}

/// Whether the shadow of a method exists and has what is set on it.
fn check_method(method: &Method, study: &Study, catalog: &Catalog, found: &mut Vec<Diagnostic>) {
    let place = || method.span.clone().map_or_else(Place::default, Place::span);
    if !is_shadow(catalog, &method.shadow) {
        let kinds = shadow_kinds(catalog);
        let message = format!("the method `{}` has the shadow `{}`, which there is not", method.name, method.shadow);
        let help = match did_you_mean(&method.shadow, kinds.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("shadows are {}", kinds.join(", ")),
        };
        found.push(Diagnostic::error("ST0610", message, place()).help(help));
        return;
    }
    let varied = method.vary.iter().map(|(name, values)| (name, values.iter().collect::<Vec<_>>()));
    let fixed = method.set.iter().map(|(name, value)| (name, vec![value]));
    let in_grids = study.grids.iter().filter(|g| g.methods.is_empty() || g.methods.contains(&method.name));
    let in_grids = in_grids.flat_map(|g| &g.vary).map(|(name, values)| (name, values.iter().collect::<Vec<_>>()));
    let in_grids = in_grids.filter(|(name, _)| has_setting(catalog, &method.shadow, name));
    for (name, values) in varied.chain(fixed).chain(in_grids).filter(|(name, _)| !name.starts_with("light.")) {
        if !has_setting(catalog, &method.shadow, name) {
            let message =
                format!("the method `{}` sets `{name}`, which `{}` does not have", method.name, method.shadow);
            let help = format!("see `shadetree nodes {}`", method.shadow);
            found.push(Diagnostic::error("ST0610", message, place()).help(help));
        }
        let Some(choices) = choices(catalog, &method.shadow, name) else { continue };
        for value in values.into_iter().filter(|v| !choices.contains(v)) {
            let message = format!("the method `{}` sets `{name}` to `{value}`", method.name);
            let help = format!("choices are {}", choices.join(", "));
            found.push(Diagnostic::error("ST0610", message, place()).help(help));
        }
    }
}

/// What may be chosen for an option of a kind of node; none if it has no such option.
pub(super) fn choices(catalog: &Catalog, kind: &str, name: &str) -> Option<Vec<String>> {
    let header = catalog.get(kind)?.header().ok()?;
    header.options.iter().find(|o| o.name == name).map(|o| o.choices.clone())
}

/// Whether nodes of a kind have an option or a port of that name, with whatever options.
pub fn has_setting(catalog: &Catalog, kind: &str, name: &str) -> bool {
    let Some(file) = catalog.get(kind) else { return false };
    let Ok(header) = file.header() else { return false };
    if header.options.iter().any(|o| o.name == name) {
        return true;
    }
    // A port may be there with some choice of one option only.
    let choices =
        header.options.iter().flat_map(|o| o.choices.iter().map(|c| BTreeMap::from([(o.name.clone(), c.clone())])));
    std::iter::once(BTreeMap::new())
        .chain(choices)
        .any(|choices| file.definition(&choices).is_ok_and(|d| d.input(name).is_some_and(|p| !p.hidden)))
}
