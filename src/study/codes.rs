//! The errors of studies, for `explain`.

/// Codes with what they mean and what is to be done, sorted.
pub const CODES: &[(&str, &str)] = &[
    (
        "ST0600",
        "The file is no study, or of a version that is not known. A study is written `Study(version: 1, title: ..., cases: {...}, methods: {...}, plain: ..., grids: [...])`.",
    ),
    (
        "ST0601",
        "Something that a study cannot do without is missing: cases, methods, grids, or the name of the plain shadow map that the others are compared with. Without them there is no cell to measure.",
    ),
    ("ST0602", "A grid, or the study's `plain`, names a case or a method that the study does not have."),
    (
        "ST0603",
        "A value of a study is out of its range: frames have 1 to 16384 pixels on a side, cells are drawn 1 to 10000 times, and a setting that is varied has at least one value.",
    ),
    (
        "ST0604",
        "A study measures against a reference that is not known. There are `rays`, to all parts of the light, and `pcf`, exhaustive filtering with the shadow's own kernel.",
    ),
    (
        "ST0610",
        "A method of a study names a shadow that there is not, or sets something that the shadow does not have. Ports and options of a node are listed by `shadetree nodes NAME`; those of the light are written `light.NAME`.",
    ),
    (
        "ST0611",
        "A case of a study cannot be used: its scene cannot be read, has no light of that name, or the light's graph has not exactly one shadow and one light node.",
    ),
    (
        "ST0612",
        "Nothing casts a shadow in the scene of a case, so that all methods would be equal and no error could be found.",
    ),
    (
        "ST0620",
        "Another run is writing into this folder of results. Wait for it, or give `-o` another folder; `shadetree study merge` puts several into one.",
    ),
    (
        "ST0621",
        "The folder holds results of another study, or of this one before it was changed. What was measured under other conditions is not mixed: give `-o` a new folder.",
    ),
    (
        "ST0622",
        "The folder holds results that another version of the program wrote, or lines that are no results. They are left as they are: give `-o` a new folder.",
    ),
    (
        "ST0623",
        "Folders of results that are to be merged were measured on different adapters. Times of different devices cannot be compared; `--mixed` merges them all the same, and each cell keeps the name of its adapter.",
    ),
    ("ST0624", "There are no results in a folder that is to be read."),
];
