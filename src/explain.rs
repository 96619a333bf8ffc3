//! What each diagnostic code means, in one place: `shadetree explain`, the documentation and the tests read it.
//!
//! Codes are stable. ST0xx: files, graphs. ST1xx: node files. ST2xx: weaving. ST3xx: plan and text. ST4xx: scenes.
//! ST5xx: command line and rendering. ST6xx: studies. ST7xx: choosing shadows, simplifying. ST9xx: faults of the program
//! itself.

use crate::{choose, graph, node, ron, scene, study};

/// An explanation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The code.
    pub code: &'static str,
    /// What it means, in a sentence.
    pub meaning: &'static str,
    /// What to do, with an example; may be empty where the diagnostic's own help says it all.
    pub more: &'static str,
}

/// Codes of weaving and planning.
const WEAVE: &[(&str, &str, &str)] = &[
    (
        "ST0200",
        "There is no node of this kind, or a `custom` node has no WGSL.",
        "`shadetree nodes` lists all kinds; `--nodes DIR` adds a folder of your own.",
    ),
    ("ST0201", "The node has no such option.", "`shadetree nodes KIND` shows its options."),
    (
        "ST0202",
        "The option has no such choice.",
        "Options are chosen from a list, as texts: `options: {\"width\": \"5\"}`.",
    ),
    (
        "ST0203",
        "The node has no such input.",
        "`shadetree nodes KIND` shows its inputs. An option can add or remove some.",
    ),
    (
        "ST0204",
        "The value does not fit the input.",
        "A vector takes as many numbers as it has components, or one number for all of them.",
    ),
    ("ST0205", "The value is not finite.", "NaN and infinities spread through a picture and are refused."),
    (
        "ST0206",
        "The value is out of range.",
        "Ranges are inclusive, per component, and in the unit of the port (degrees, metres).",
    ),
    (
        "ST0207",
        "A value is set on a node that the graph does not have.",
        "Scenes and `--set` name nodes of the graph file as `node.port`.",
    ),
    (
        "ST0208",
        "A link names a port that its node does not have.",
        "Leave the port out, and the types decide: `\"noise -> glass\"`.",
    ),
    (
        "ST0209",
        "Nodes feed each other in a circle.",
        "No node of a circle can be computed first. Remove one of its links.",
    ),
    (
        "ST0210",
        "A light meets no surface that takes light.",
        "Add a surface, or link the light to the one that it is to shine on.",
    ),
    (
        "ST0211",
        "A shadow, or another node that asks for a light's space, is on no light.",
        "A shadow stands behind a light: `\"spot -> shadow\"`.",
    ),
    (
        "ST0212",
        "Two links lead to one input.",
        "An input takes one value. Combine the two with a node such as mix or add, or remove one link.",
    ),
    (
        "ST0213",
        "A link joins ports whose types do not go together.",
        "Only conversions that lose nothing are inserted. Put the node that loses what you want to lose between them.",
    ),
    (
        "ST0214",
        "More nodes are linked to a node than it has fitting inputs.",
        "Remove a link, or pin one to the input that it is meant for.",
    ),
    (
        "ST0215",
        "A node contributes nothing to the node that it is linked to.",
        "No output fits a free input, not even by conversion.",
    ),
    (
        "ST0216",
        "A link could mean several inputs.",
        "Two inputs fit equally well and the weaver does not guess. Pin the link:\n\n    \"noise.value -> bump.height\"",
    ),
    ("ST0217", "An input that has no default is not linked.", "Link a node that gives such a value to it."),
    (
        "ST0218",
        "The widths of the values at a generic node do not go together.",
        "All generic inputs of a node have one width; single numbers are spread.",
    ),
    (
        "ST0219",
        "There is no light of that name.",
        "`--aov visibility:LIGHT` takes the name of a light in the scene, or of a light node in a graph.",
    ),
    ("ST0220", "A node feeds nothing and is left out.", "Link it, mute it, or remove it."),
    ("ST0221", "Several nodes could be the result.", "Say which: `output: \"glass\"`."),
    (
        "ST0222",
        "The graph's output is not there.",
        "`output` names a node, and perhaps a port: `\"glass\"` or `\"glass.radiance\"`.",
    ),
    (
        "ST0223",
        "No light shines on a surface.",
        "Give a light's graph file as well: `shadetree generate spot.ron matte.ron`.",
    ),
    (
        "ST0224",
        "The result is nothing that can be shown.",
        "A picture shows colours, numbers and vectors. End the graph in a surface.",
    ),
    ("ST0225", "There is nothing to see.", "The smallest graph has one node, such as `lambert`."),
    (
        "ST0226",
        "This light cannot carry maps, which the shadow needs.",
        "Spot, point and directional lights can; a light of your own can with a `space:` line.",
    ),
    (
        "ST0227",
        "What a light's map depends on is not a parameter.",
        "Maps are rendered before the picture, so position, direction and angles of their light are values, not links.",
    ),
    (
        "ST0300",
        "A node asks for a pass that does not exist.",
        "Its `map` line names a file in shaders/; `shadetree nodes KIND` shows the node's file.",
    ),
    (
        "ST0301",
        "The parameters do not fit into one uniform block.",
        "Every device takes 64 KiB, which is some 4,000 values. Beyond that the values that no one changed are written into\nthe shader as constants, then all values; they can then not change without a new shader.",
    ),
];

/// Codes of the command line, of rendering and of the proof.
const OWN: &[(&str, &str, &str)] = &[
    (
        "ST0500",
        "The command line is wrong.",
        "An option is unknown, lacks its value, or contradicts another, as in\n\n    shadetree generate a.ron -o a.png\n\nwhere .png names no shading language. `shadetree COMMAND --help` shows examples.",
    ),
    (
        "ST0501",
        "A file or folder cannot be read.",
        "It does not exist, or permissions forbid it. Paths on the command line count from the current folder; paths in a\ngraph or scene count from the file that mentions them.",
    ),
    ("ST0502", "A folder was given where a file is needed.", "Name the files: `shadetree check graphs/lights/*.ron`."),
    (
        "ST0503",
        "A file is larger than 64 MiB.",
        "Nothing that large is a graph made by hand. A generated one can be split into subgraphs, which are files of\ntheir own: `\"stone\": (graph: \"stone.ron\")`.",
    ),
    (
        "ST0504",
        "A file is not UTF-8 text.",
        "Save it as UTF-8. An image or an archive was perhaps meant for another place.",
    ),
    (
        "ST0505",
        "The output cannot be written.",
        "The folder is missing or write-protected, or the disk is full. Files are written whole or not at all, so an older\nfile of that name is still there.",
    ),
    (
        "ST0506",
        "Binary output was about to go to the terminal.",
        "Name a file: `-o car.spv`; or redirect: `> car.spv`.",
    ),
    (
        "ST0507",
        "A scene was given where a graph is needed.",
        "A scene mentions graph files, and a graph can contain graphs; neither can contain a scene.",
    ),
    (
        "ST0508",
        "The module cannot be written in the chosen language.",
        "WGSL can say things that another language version cannot. WGSL itself and SPIR-V can say everything.",
    ),
    ("ST0509", "`new` does not overwrite files.", "Choose another name, or remove the file first."),
    (
        "ST0510",
        "The value after `=` cannot be read.",
        "Values are true, false, finite numbers, up to four numbers as `1,2,3` or `(1, 2, 3)`, or a path:\n\n    --set spot.position=0,5,0 --set brick.image=brick.png",
    ),
    (
        "ST0511",
        "`--set` or `--option` names a node that is not there.",
        "The name is the one in the graph file, after the file's stem and a `/` where several graphs have such a node:\n\n    --set spot_vsm/spot.range=20",
    ),
    (
        "ST0512",
        "`--aov` names no output, or no light of the scene.",
        "Outputs are radiance, normal, depth, visibility:LIGHT, irradiance:LIGHT and map:LIGHT. Lights of a scene have the\nname that the scene gives them.",
    ),
    (
        "ST0513",
        "No suitable graphics adapter was found.",
        "Rendering needs Vulkan, Metal, Direct3D 12 or OpenGL. A software adapter needs no graphics card; on Debian and\nUbuntu:\n\n    apt-get install mesa-vulkan-drivers libvulkan1\n\n`shadetree doctor` lists the adapters. generate, check, nodes and fmt need none.",
    ),
    (
        "ST0514",
        "The picture could not be rendered.",
        "The adapter refused or ran out of memory, or a picture that the scene needs cannot be used.",
    ),
    (
        "ST0515",
        "This build cannot render.",
        "It was built with `--no-default-features`. Build with the feature `render`:\n\n    cargo build --release --features render",
    ),
    ("ST0516", "There is no such node.", "`shadetree nodes` lists all; `--nodes DIR` adds a folder of your own."),
    ("ST0517", "There is no such code.", "`shadetree explain` without a code lists all of them."),
    ("ST0518", "A file is not in canonical form.", "`shadetree fmt FILE` rewrites it. Its meaning does not change."),
    ("ST0519", "Changes of files cannot be watched.", "The system's limit of watched folders may be reached."),
    (
        "ST0521",
        "There is nothing to compare on this light.",
        "`compare` puts every kind of shadow in the place of the one that the light's graph has. It needs a scene, a light
of it by name, and exactly one shadow node in that light's graph.",
    ),
    (
        "ST0520",
        "There is no truth to be had of this light.",
        "`--reference` must know where the light is: from the inputs that its node's `space:` line names, as values, not\nlinks. `--reference pcf` also needs a shadow on it, whose options `size`, `width`, `weights` and `taps` say what the\nfilter is; `--kernel WIDTH` says the width where `width` is no number.",
    ),
    (
        "ST0750",
        "There is nothing to simplify in these graphs.",
        "`simplify` makes cheaper forms of one material: of the graphs that it is given, exactly one has surface nodes, and\nthe others are lights.",
    ),
    (
        "ST0751",
        "The material that is to be simplified is not seen.",
        "Errors are shares of the light that the material sends to the eye, over the pixels that it covers wholly. Come\nnearer with `--distance`, take a larger `--size`, or give the material light.",
    ),
    (
        "ST0752",
        "A node file declares a cheaper form that cannot be.",
        "A line `//! cheaper: kind NAME(port = formula) - TEXT` names a kind of node, or an input of it, that is not there.\nThe form is passed over.",
    ),
    (
        "ST0753",
        "No node of a material has a cheaper form.",
        "Node files declare their cheaper forms in lines `//! cheaper: ...`. The ladder of this material is the material\nitself.",
    ),
    (
        "ST0900",
        "naga rejects the WGSL that was woven.",
        "If the place is a node of your own (a `custom` node, or a file in --nodes DIR), its WGSL is at fault: the notes\nshow the line. Otherwise this is a fault in shadetree; please report it with the graph.",
    ),
];

/// All explanations, sorted by code.
pub fn entries() -> Vec<Entry> {
    let tables = [ron::CODES, graph::CODES, node::CODES, scene::CODES, choose::CODES];
    let others = tables.into_iter().flatten().map(|&(code, meaning)| Entry { code, meaning, more: "" });
    let own = WEAVE.iter().chain(OWN).chain(study::CODES).map(|&(code, meaning, more)| Entry { code, meaning, more });
    let mut all: Vec<Entry> = others.chain(own).collect();
    all.sort_by_key(|e| e.code);
    all
}

/// The explanation of a code.
pub fn find(code: &str) -> Option<Entry> {
    entries().into_iter().find(|e| e.code == code)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::path::Path;

    fn sources(folder: &Path, texts: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).expect("readable").map(|e| e.expect("readable").path()) {
            if entry.is_dir() {
                sources(&entry, texts);
            } else if entry.extension().is_some_and(|e| e == "rs") {
                let text = std::fs::read_to_string(&entry).expect("readable");
                // Tests may name codes that do not exist.
                texts.push(text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().to_owned());
            }
        }
    }

    /// Codes in quotes, and whether each is more than an entry of a table.
    fn codes_in(text: &str) -> impl Iterator<Item = (&str, bool)> {
        text.match_indices("\"ST").filter_map(move |(at, _)| {
            let code = text[at + 1..].split('"').next()?;
            let digits = &code[2..];
            // A row of a table begins its list or follows another row; a call follows a name.
            let before = text[..at].trim_end().strip_suffix('(').map(str::trim_end);
            let table = before.is_some_and(|b| b.ends_with(['[', ',']));
            (matches!(digits.len(), 3 | 4) && digits.bytes().all(|b| b.is_ascii_digit())).then_some((code, table))
        })
    }

    #[test]
    fn every_code_in_use_is_explained_and_no_other() {
        let mut texts = Vec::new();
        sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut texts);
        let explained: BTreeSet<&str> = entries().iter().map(|e| e.code).collect();
        assert_eq!(explained.len(), entries().len(), "a code is explained twice");
        let used: BTreeSet<&str> =
            texts.iter().flat_map(|t| codes_in(t)).filter(|(_, table)| !table).map(|(code, _)| code).collect();
        let missing: Vec<_> = used.difference(&explained).collect();
        let unused: Vec<_> = explained.difference(&used).collect();
        assert!(missing.is_empty(), "not explained: {missing:?}");
        assert!(unused.is_empty(), "explained but never given: {unused:?}");
    }
}
