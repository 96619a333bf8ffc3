//! What the codes of studies, their results, claims and published tables mean.

/// For `shadetree explain`, sorted.
pub const CODES: &[(&str, &str, &str)] = &[
    (
        "ST0600",
        "The file is no study, or of a version that is not known.",
        "A study is written `Study(version: 1, title: ..., cases: {...}, methods: {...}, plain: ..., grids: [...])`.",
    ),
    (
        "ST0601",
        "Something that a study cannot do without is missing: cases, methods, grids, or the name of the plain shadow map that the others are compared with.",
        "Without them there is no cell to measure.",
    ),
    ("ST0602", "A grid, or the study's `plain`, names a case or a method that the study does not have.", ""),
    (
        "ST0603",
        "A value of a study is out of its range: frames have 1 to 16384 pixels on a side, cells are drawn 1 to 10000 times, and a setting that is varied has at least one value.",
        "",
    ),
    (
        "ST0604",
        "A study measures against a reference that is not known.",
        "There are `rays`, to all parts of the light, and `pcf`, exhaustive filtering with the shadow's own kernel.",
    ),
    (
        "ST0610",
        "A method of a study names a shadow that there is not, or sets something that the shadow does not have.",
        "Ports and options of a node are listed by `shadetree nodes NAME`; those of the light are written `light.NAME`.",
    ),
    (
        "ST0611",
        "A case of a study cannot be used: its scene cannot be read, has no light of that name, or the light's graph has not exactly one shadow and one light node.",
        "",
    ),
    (
        "ST0612",
        "Nothing casts a shadow in the scene of a case, so that all methods would be equal and no error could be found.",
        "",
    ),
    (
        "ST0613",
        "A law that a study claims does not hold for what was measured.",
        "Laws are claims that are true of every device, such as that filtering comparisons takes as long whatever the size of\nthe map. One is refuted if a number and the whole of its interval are outside of what is allowed. Either the machine\nwas disturbed, or the claim is wrong.",
    ),
    (
        "ST0620",
        "Another run is writing into this folder of results.",
        "Wait for it, or give `-o` another folder; `shadetree study merge` puts several into one.",
    ),
    (
        "ST0621",
        "The folder holds results of another study, or of this one before it was changed.",
        "What was measured under other conditions is not mixed: give `-o` a new folder.",
    ),
    (
        "ST0623",
        "Folders of results that are to be merged were measured on different adapters.",
        "Times of different devices cannot be compared; `--mixed` merges them all the same, and each cell keeps the name of its adapter.",
    ),
    (
        "ST0650",
        "A claim asks for a test that there is none of.",
        "constant, steady, power, power_log, linear, ordered, crossing and grows are known:\n\n    (id: \"H1\", kind: \"constant\", time: \"main\", over: \"size\", within: 0.1)",
    ),
    ("ST0651", "A claim is about a time that is not measured.", "Times are total, main, light, filter and wall."),
    (
        "ST0652",
        "A claim or a published table names a method that the study does not have.",
        "Methods go by the names that the study's own list gives them.",
    ),
    ("ST0653", "A number of a claim or of a table is outside the range that makes sense there.", ""),
    ("ST0654", "A claim has no name, or the name of another.", "Verdicts are told apart by the names of their claims."),
    (
        "ST0655",
        "A claim lacks what its test needs, or has what its test does not take.",
        "Every test needs `kind`, `time` and `over`; `ordered` and `crossing` compare the methods that they name.",
    ),
    ("ST0656", "The unit of a published table is not known.", "Units are fps (frames a second) and ms (milliseconds)."),
    (
        "ST0657",
        "A published table is not whole.",
        "It says what varies, has a number above 0 in each column of each row, and names the row that the others are\ndivided by:\n\n    (vary: \"size\", columns: [\"128\", \"256\"], plain: \"Shadow Map\", rows: {\"Shadow Map\": [340, 334]})",
    ),
    ("ST0658", "A column of a published table cannot be found among measurements.", "Frames are written `640x480`."),
    (
        "ST0660",
        "The folder holds no results of a study.",
        "`shadetree study FILE -o DIR` makes a folder with a file `results.jsonl` in it.",
    ),
    (
        "ST0661",
        "A line of a results file is not what was measured of one cell.",
        "The file was written by something else, or changed by hand. Remove the line; the study measures its cell again.",
    ),
    (
        "ST0662",
        "The results were written by another version of shadetree.",
        "Numbers of different versions are not mixed. Run the study again into a new folder.",
    ),
    (
        "ST0663",
        "The last line of a results file is cut off.",
        "The study was stopped while it wrote. All cells before are good, and the study goes on where it stopped.",
    ),
    (
        "ST0664",
        "The results are of several graphics adapters.",
        "Times of different adapters do not belong in one chart. Choose one: `shadetree chart DIR --adapter NAME`.",
    ),
    (
        "ST0665",
        "There is nothing to chart.",
        "A point needs both a time and an error. `--time wall` does without times of the adapter; `--reference` chooses\nwhat errors are taken from.",
    ),
    (
        "ST0666",
        "A cell was measured more than once.",
        "The later measurement counts. `study merge` makes one file of the files of several machines.",
    ),
    (
        "ST0667",
        "The file beside the results is no study.",
        "Claims and published tables are taken from `study.ron` in the folder of results. Without it the chart has neither.",
    ),
];
