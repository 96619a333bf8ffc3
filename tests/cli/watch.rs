//! `--watch` with real changes of real files, and what Ctrl-C leaves behind.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use super::generate::STRIPES;
use super::{LIGHT, names, program, put};

/// Longest wait for something that must happen; only a hang takes so long.
const PATIENCE: Duration = Duration::from_secs(60);
/// How long nothing must happen where nothing is to happen: several times what changes need to settle.
const QUIET: Duration = Duration::from_millis(600);

/// A program that watches, and the lines of its stderr.
struct Watching {
    child: Child,
    lines: Receiver<String>,
}

impl Watching {
    fn start(line: &str) -> Self {
        let mut child = program()
            .args(line.split_whitespace())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let stderr = BufReader::new(child.stderr.take().expect("piped"));
        let (send, lines) = mpsc::channel();
        std::thread::spawn(move || {
            for line in stderr.lines().map_while(Result::ok) {
                if send.send(line).is_err() {
                    break;
                }
            }
        });
        Self { child, lines }
    }

    /// What it says until it waits for changes again.
    #[track_caller]
    fn settled(&self) -> String {
        let mut said = String::new();
        loop {
            let line = self.lines.recv_timeout(PATIENCE).unwrap_or_else(|e| panic!("{e} after: {said}"));
            if line.ends_with("waiting for changes") {
                return if line == "done; waiting for changes" { format!("{said}done") } else { said };
            }
            said.push_str(&line);
            said.push('\n');
        }
    }

    /// As [`Self::settled`], until a run ends well.
    #[track_caller]
    fn done(&self) {
        while !self.settled().ends_with("done") {}
    }

    /// As [`Self::settled`], until a run tells of this.
    #[track_caller]
    fn fails_with(&self, what: &str) {
        while !self.settled().contains(what) {}
    }

    /// Waits until nothing is going on any more; a program that wakes itself never gets there.
    #[track_caller]
    fn calms_down(&self) {
        for _ in 0..8 {
            if self.lines.recv_timeout(QUIET).is_err() {
                return;
            }
        }
        panic!("it runs again and again");
    }

    #[track_caller]
    fn stays_quiet(&self) {
        let said = self.lines.recv_timeout(QUIET);
        assert!(said.is_err(), "{said:?}");
    }

    fn signal(&self, signal: &str) {
        let sent = Command::new("kill").args([signal, &self.child.id().to_string()]).status();
        assert!(sent.expect("`kill` is there").success());
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// As editors save: to a new file that takes the old one's name.
fn replace(path: &Path, text: &str) {
    let next = path.with_extension("ron~");
    std::fs::write(&next, text).expect("written");
    std::fs::rename(&next, path).expect("renamed");
}

fn graph(albedo: &str) -> String {
    format!("Graph(version: 1, nodes: {{\"m\": (kind: \"lambert\", params: {{\"albedo\": {albedo}}})}})")
}

/// A folder for a test, with its file `g.ron`.
fn stage() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = PathBuf::from(put(folder.path(), "g.ron", &graph("(0.125, 0.5, 0.5)")));
    (folder, file)
}

#[test]
fn check_runs_again_when_a_file_changes() {
    let (_folder, file) = stage();
    let watching = Watching::start(&format!("check {LIGHT} {} --watch", file.display()));
    watching.done();
    std::fs::write(&file, graph("true")).expect("written");
    watching.fails_with("ST0204");
    replace(&file, &graph("(0.25, 0.5, 0.5)"));
    watching.done();
    std::fs::remove_file(&file).expect("removed");
    watching.fails_with("ST0501");
    std::fs::write(&file, graph("(0.25, 0.5, 0.5)")).expect("written");
    watching.done();
    watching.calms_down();
    // Reading is no change.
    std::fs::read(&file).expect("there");
    watching.stays_quiet();
}

#[test]
fn generate_replaces_its_output_by_good_output_only() {
    let (folder, file) = stage();
    let out = folder.path().join("out.wgsl");
    let watching = Watching::start(&format!("generate {LIGHT} {} --bake -o {} --watch", file.display(), out.display()));
    watching.done();
    let read = || std::fs::read_to_string(&out).expect("there is output");
    assert!(read().contains("vec3f(0.125, 0.5, 0.5)"), "{}", read());

    std::fs::write(&file, graph("(0.25, 0.5, 0.5)")).expect("written");
    watching.done();
    assert!(read().contains("vec3f(0.25, 0.5, 0.5)"), "{}", read());

    let good = read();
    std::fs::write(&file, "Graph(version: 1, nodes: {").expect("written");
    watching.fails_with("error[ST00");
    assert_eq!(read(), good, "the last good output stays");

    replace(&file, &graph("(0.375, 0.5, 0.5)"));
    watching.done();
    assert!(read().contains("vec3f(0.375, 0.5, 0.5)"), "{}", read());

    replace(&file, &graph("(0.625, 0.5, 0.5)"));
    watching.done();
    assert!(read().contains("vec3f(0.625, 0.5, 0.5)"), "a file that was replaced is still watched");
    // What it writes itself, and strangers, wake nobody.
    watching.calms_down();
    put(folder.path(), "stranger.txt", "hello");
    watching.stays_quiet();
    assert_eq!(names(folder.path()), ["g.ron", "out.wgsl", "stranger.txt"]);
}

#[test]
fn subgraphs_and_nodes_are_watched_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let inner = |count: u32| {
        format!(
            "Graph(version: 1, nodes: {{\"s\": (kind: \"bars\", params: {{\"count\": {count}.5}})}}, expose: (outputs: {{\"color\": \"s.color\"}}))"
        )
    };
    let outer = "Graph(version: 1, nodes: {\"p\": (graph: \"parts/inner.ron\"), \"m\": (kind: \"lambert\")}, links: [\"p.color -> m.albedo\"])";
    let file = put(folder.path(), "g.ron", outer);
    let part = PathBuf::from(put(folder.path(), "parts/inner.ron", &inner(3)));
    let node = PathBuf::from(put(folder.path(), "nodes/bars.wgsl", STRIPES));
    let out = folder.path().join("out.wgsl");
    let nodes = node.parent().expect("a folder").display();
    let watching =
        Watching::start(&format!("generate {LIGHT} {file} --bake --nodes {nodes} -o {} --watch", out.display()));
    let read = || std::fs::read_to_string(&out).expect("there is output");
    watching.done();
    assert!(read().contains("3.5"), "{}", read());

    replace(&part, &inner(7));
    watching.done();
    assert!(read().contains("7.5"), "{}", read());

    std::fs::write(&node, STRIPES.replace("step(0.5,", "step(0.0625,")).expect("written");
    watching.done();
    assert!(read().contains("step(0.0625,"), "{}", read());

    let good = read();
    std::fs::write(&node, STRIPES.replace("step(0.5,", "stpe(0.5,")).expect("written");
    watching.fails_with("bars.wgsl:9:");
    std::fs::rename(&part, part.with_extension("away")).expect("renamed");
    watching.fails_with("inner.ron");
    assert_eq!(read(), good);
    std::fs::rename(part.with_extension("away"), &part).expect("renamed");
    std::fs::write(&node, STRIPES).expect("written");
    watching.done();
    assert!(read().contains("step(0.5,"), "{}", read());

    // A node that was not there before.
    put(folder.path(), "nodes/spots.wgsl", &STRIPES.replace("bars", "spots").replace("Bars", "Spots"));
    put(folder.path(), "parts/inner.ron", &inner(9).replace("\"bars\"", "\"spots\""));
    watching.done();
    while !read().contains("fn spots(") {
        watching.done();
    }
}

#[test]
fn a_folder_that_is_made_later_is_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let outer = "Graph(version: 1, nodes: {\"p\": (graph: \"later/inner.ron\"), \"m\": (kind: \"lambert\")}, links: [\"p -> m.albedo\"])";
    let file = put(folder.path(), "g.ron", outer);
    let watching = Watching::start(&format!("check {LIGHT} {file} --watch"));
    watching.fails_with("inner.ron");
    put(folder.path(), "later/inner.ron", "Graph(version: 1, nodes: {\"c\": (kind: \"checker\")})");
    watching.done();
}

#[test]
fn stdin_cannot_be_watched() {
    super::run("check - --watch").exits(2).says("ST0500").says("stdin");
}

#[test]
#[cfg(feature = "render")]
fn render_keeps_the_last_good_picture() {
    let (folder, file) = stage();
    let out = folder.path().join("out.png");
    let watching = Watching::start(&format!(
        "render {LIGHT} {} -o {} --size 32x24 --samples 1 --watch",
        file.display(),
        out.display()
    ));
    watching.done();
    let read = || std::fs::read(&out).expect("there is a picture");
    let first = read();
    assert_eq!(&first[1..4], b"PNG");
    std::fs::write(&file, graph("(0.9, 0, 0)")).expect("written");
    watching.done();
    let second = read();
    assert_ne!(first, second, "another colour");
    std::fs::write(&file, graph("\"red\"")).expect("written");
    watching.fails_with("ST0204");
    assert_eq!(read(), second);
    replace(&file, &graph("(0.125, 0.5, 0.5)"));
    watching.done();
    assert_eq!(read(), first, "the same picture as at first");
}

#[test]
fn signals_end_a_watch_and_leave_nothing() {
    for (signal, code) in [("-INT", 130), ("-TERM", 130)] {
        let (folder, file) = stage();
        let out = folder.path().join("out.wgsl");
        let mut watching = Watching::start(&format!("generate {} -o {} --watch", file.display(), out.display()));
        watching.done();
        watching.signal(signal);
        assert_eq!(watching.child.wait().expect("it ends").code(), Some(code), "{signal}");
        assert_eq!(names(folder.path()), ["g.ron", "out.wgsl"]);
    }
}

/// Whenever the signal comes, the file is whole or not there, and nothing else is.
#[test]
fn an_interrupt_at_any_moment_leaves_no_partial_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out.wgsl");
    let mut command = program();
    command.args(["generate", LIGHT, super::SURFACE, "-o"]).arg(&out).stderr(Stdio::piped());
    let started = std::time::Instant::now();
    assert!(command.status().expect("the program starts").success());
    let whole = started.elapsed();
    let good = std::fs::read(&out).expect("written");
    for step in 0..24 {
        std::fs::remove_file(&out).ok();
        let mut child = command.spawn().expect("the program starts");
        // Most of the interesting moments are near the end.
        std::thread::sleep(whole.mul_f64(0.5 + f64::from(step) / 24.0));
        // It may have ended already; then there is nothing to interrupt.
        let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).stderr(Stdio::null()).status();
        child.wait().expect("it ends");
        match names(folder.path()).as_slice() {
            [] => {}
            [only] if only == "out.wgsl" => assert_eq!(std::fs::read(&out).expect("there"), good),
            others => panic!("left behind: {others:?}"),
        }
    }
}
