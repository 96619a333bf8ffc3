//! The smaller commands.

use super::{names, program, put, run, run_fed};

const MESSY: &str = "Graph(version:1,nodes:{\"b\":(kind:\"lambert\"),\"a\":(kind:\"checker\")},links:[\"a.color -> b.albedo\"]) // kept?";

#[test]
fn fmt_rewrites_in_place_and_only_what_differs() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = put(folder.path(), "a.ron", MESSY);
    run(&format!("fmt --check {file}")).exits(1).says("ST0518").says("a.ron").no_data();
    assert_eq!(std::fs::read_to_string(&file).expect("there"), MESSY, "--check changes nothing");
    run(&format!("fmt {file}")).exits(0).no_data();
    let canonical = std::fs::read_to_string(&file).expect("there");
    assert!(canonical.starts_with("Graph(\n    version: 1,\n"), "{canonical}");
    assert!(canonical.find("\"a\"") < canonical.find("\"b\""), "sorted: {canonical}");
    assert!(canonical.contains("kept?"), "comments are data: {canonical}");
    let before = std::fs::metadata(&file).expect("there").modified().expect("a time");
    run(&format!("fmt {file}")).exits(0);
    assert_eq!(std::fs::metadata(&file).expect("there").modified().expect("a time"), before, "left alone");
    run(&format!("fmt --check {file}")).exits(0);
    assert_eq!(names(folder.path()), ["a.ron"]);
    assert_eq!(run_fed("fmt -", MESSY.as_bytes()).exits(0).text(), canonical);
}

#[test]
fn fmt_leaves_files_with_mistakes_alone_and_goes_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let bad = put(folder.path(), "bad.ron", "Graph(version: 1, nodes: {\"a\": (kind: )})");
    let good = put(folder.path(), "good.ron", MESSY);
    let none = folder.path().join("none.ron").display().to_string();
    // The graver code is the answer, whatever the order of the files.
    run(&format!("fmt {none} {bad} {good}")).exits(3).says("bad.ron:1:").says("ST0501");
    run(&format!("fmt {bad} {none}")).exits(3);
    assert_eq!(std::fs::read_to_string(&bad).expect("there"), "Graph(version: 1, nodes: {\"a\": (kind: )})");
    assert_ne!(std::fs::read_to_string(&good).expect("there"), MESSY);
    assert_eq!(run_fed("fmt -", b"Graph(version: 1, nodes: {").exits(1).text(), "");
}

#[test]
fn every_example_is_canonical() {
    let files = crate::support::files("graphs", "ron");
    let mut arguments = vec!["fmt".to_owned(), "--check".to_owned()];
    arguments.extend(files.iter().map(|f| f.display().to_string()));
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    assert_eq!(super::run_with(&arguments).exits(0).err, "");
}

#[test]
#[cfg(unix)]
fn fmt_keeps_links_and_permissions_and_heeds_read_only_files() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().expect("a folder");
    let file = put(folder.path(), "real.ron", MESSY);
    let link = folder.path().join("link.ron");
    symlink("real.ron", &link).expect("a link");
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o640)).expect("set");
    run(&format!("fmt {}", link.display())).exits(0);
    assert!(link.symlink_metadata().expect("there").is_symlink());
    let meta = std::fs::metadata(&file).expect("there");
    assert_eq!(meta.permissions().mode() & 0o777, 0o640);
    assert_ne!(std::fs::read_to_string(&file).expect("there"), MESSY);
    std::fs::write(&file, MESSY).expect("written");
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o440)).expect("set");
    run(&format!("fmt {file}")).exits(3).says("ST0505").says("read-only");
    assert_eq!(std::fs::read_to_string(&file).expect("there"), MESSY);
}

#[test]
fn new_writes_a_graph_that_works_and_never_overwrites() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = |line: &str| {
        let output = program().args(line.split_whitespace()).current_dir(folder.path()).output();
        super::Ran::from(output.expect("the program starts"))
    };
    here("new glow").exits(0).says("glow.ron").no_data();
    here("check glow.ron").exits(0);
    here("fmt --check glow.ron").exits(0);
    std::fs::write(folder.path().join("glow.ron"), "mine").expect("written");
    here("new glow").exits(3).says("ST0509").says("not overwritten");
    here("new glow.ron").exits(3).says("ST0509");
    assert_eq!(std::fs::read_to_string(folder.path().join("glow.ron")).expect("there"), "mine");
    here("new no/such/folder").exits(3).says("ST0505");
    here("new ..").exits(2).says("ST0500");
    assert_eq!(names(folder.path()), ["glow.ron"]);
}

#[test]
fn nodes_lists_describes_and_suggests() {
    let list = run("nodes").exits(0);
    assert!(list.text().contains("oren_nayar") && list.text().lines().count() > 90, "{}", list.text());
    assert!(run("nodes oren_nayar").exits(0).text().contains("roughness"));
    assert!(run("nodes oren_nayar --format md").exits(0).text().contains('#'));
    assert!(run("nodes clay").exits(0).text().contains("Oren-Nayar"), "synonyms are found");
    run("nodes oren_nayer").exits(1).says("ST0516").says("did you mean `oren_nayar`?").no_data();
    let json: serde_json::Value = serde_json::from_str(run("nodes --format json").exits(0).text()).expect("JSON");
    assert!(json["nodes"].as_array().is_some_and(|n| n.len() >= 90));
    run("check --format md x.ron").exits(2).says("Markdown");
}

#[test]
fn codes_are_explained() {
    assert!(run("explain ST0501").exits(0).text().starts_with("ST0501: "));
    assert!(run("explain st0501").exits(0).text().starts_with("ST0501: "));
    assert!(run("explain").exits(0).text().lines().count() > 50);
    run("explain ST9999").exits(1).says("ST0517").no_data();
}

#[test]
fn the_doctor_speaks_without_an_adapter() {
    let output = program()
        .arg("doctor")
        .env("WGPU_BACKEND", "vulkan")
        .env("VK_DRIVER_FILES", "/nowhere")
        .env("VK_ICD_FILENAMES", "/nowhere")
        .output();
    let ran = super::Ran::from(output.expect("the program starts")).exits(0);
    assert!(ran.text().contains("nodes: ") && ran.text().contains("rendering: "), "{}", ran.text());
    #[cfg(feature = "render")]
    assert!(ran.text().contains("mesa-vulkan-drivers"), "{}", ran.text());
}

#[test]
fn shells_and_man_get_their_pages() {
    for (shell, mark) in [("bash", "complete -F"), ("zsh", "#compdef shadetree"), ("fish", "complete -c shadetree")] {
        let script = run(&format!("completions {shell}")).exits(0);
        assert!(script.text().contains(mark) && script.text().contains("reflect"), "{shell}");
    }
    run("completions tcsh").exits(2).says("possible values");
    let page = run("man").exits(0);
    assert!(page.text().contains(".TH"), "{}", page.text());
    for command in ["edit", "generate", "check", "render", "nodes", "fmt", "new", "explain", "doctor"] {
        assert!(page.text().contains(command), "{command}");
    }
}

#[test]
#[cfg(unix)]
fn the_scripts_are_accepted_by_their_shell() {
    let script = run("completions bash").exits(0);
    let folder = tempfile::tempdir().expect("a folder");
    let file = put(folder.path(), "c.bash", script.text());
    let Ok(output) = std::process::Command::new("bash").args(["-n", &file]).output() else { return };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn help_has_examples_and_goes_to_stdout() {
    for command in
        ["edit", "generate", "check", "render", "nodes", "fmt", "new", "explain", "doctor", "completions", "man"]
    {
        let help = run(&format!("{command} --help")).exits(0);
        assert!(help.text().contains("Examples:") && help.err.is_empty(), "{command}");
        assert!(help.text().contains(&format!("shadetree {command}")), "{command}");
    }
    let help = run("--help").exits(0);
    assert!(help.text().contains("Exit codes: 0 done") && help.text().contains("Examples:"));
    assert!(run("--version").exits(0).text().starts_with("shadetree "));
    // With the editor, no command means the editor.
    if cfg!(not(feature = "gui")) {
        run("").exits(2).no_data().says("Usage");
    }
    run("paint").exits(2).says("unrecognized subcommand");
}

#[test]
fn colours_come_only_when_asked_for() {
    let bad = "Graph(version: 1, nodes: {\"a\": (kind: \"nope\")})";
    assert!(!run_fed("check -", bad.as_bytes()).exits(1).err.contains('\u{1b}'));
    assert!(run_fed("check - --color always", bad.as_bytes()).exits(1).err.contains('\u{1b}'));
    assert!(!run_fed("check - --color never", bad.as_bytes()).exits(1).err.contains('\u{1b}'));
}
