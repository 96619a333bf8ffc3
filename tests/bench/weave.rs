//! How long generation takes: per number of nodes within a process, and for the whole program on the car scene.
//!
//! `cargo bench` prints it. A graph of N nodes is a chain with a side branch every few nodes, ending in a surface.
#![allow(missing_docs, reason = "criterion's macros make the functions")]
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::fmt::Write as _;
use std::hint::black_box;
use std::process::Command;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use shadetree::compile::{NamedGraph, Options, compile};
use shadetree::diagnostic::SourceText;
use shadetree::graph;
use shadetree::node::Catalog;

/// The program's.
#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// A graph file with about `count` nodes of which every one counts.
fn text(count: usize) -> String {
    let mut nodes = String::from(
        "\"body\": (kind: \"lambert\"),\n\"n0\": (kind: \"perlin3d\"),\n\"lamp\": (kind: \"spot_light\"),\n",
    );
    let mut links = String::from("\"lamp -> body\",\n");
    for i in 1..count.saturating_sub(3) {
        let kind = ["multiply", "add", "sine", "smooth_step", "maximum"][i % 5];
        let _ = writeln!(nodes, "\"n{i}\": (kind: \"{kind}\"),");
        let _ = writeln!(links, "\"n{} -> n{i}\",", i - 1);
    }
    let _ = writeln!(links, "\"n{} -> body.albedo\",", count.saturating_sub(4));
    format!("Graph(version: 1, nodes: {{\n{nodes}}}, links: [\n{links}])")
}

fn generate(source: &std::sync::Arc<SourceText>, catalog: &Catalog) -> usize {
    let (graph, found) = graph::read(source);
    let graph = graph.unwrap_or_else(|| panic!("{found:?}"));
    let named = NamedGraph { name: "bench".into(), graph, ..NamedGraph::default() };
    let (compiled, found) = compile(&[named], catalog, &Options::default());
    let compiled = compiled.unwrap_or_else(|| panic!("{:?}", found.first()));
    shadetree::verify::verify(&compiled.module).unwrap_or_else(|e| panic!("{e:?}"));
    compiled.module.wgsl.len()
}

fn nodes(c: &mut Criterion) {
    let catalog = Catalog::embedded();
    phases(&catalog);
    let mut group = c.benchmark_group("read + weave + emit + validate");
    group.sample_size(20);
    for count in [20, 200, 2_000, 10_000] {
        let source = SourceText::new("bench.ron", text(count));
        group.throughput(Throughput::Elements(count as u64));
        group.bench_with_input(BenchmarkId::from_parameter(count), &source, |b, source| {
            b.iter(|| generate(black_box(source), &catalog));
        });
    }
    group.finish();
}

/// Where the time goes, once per size, in milliseconds.
fn phases(catalog: &Catalog) {
    println!("{:>7} {:>9} {:>9} {:>9} {:>11}", "nodes", "read", "compile", "validate", "WGSL bytes");
    for count in [200, 2_000, 10_000] {
        let source = SourceText::new("bench.ron", text(count));
        let start = std::time::Instant::now();
        let graph = graph::read(&source).0.expect("a sound graph");
        let read = start.elapsed();
        let named = NamedGraph { name: "bench".into(), graph, ..NamedGraph::default() };
        let compiled = compile(&[named], catalog, &Options::default()).0.expect("a sound graph");
        let woven = start.elapsed();
        shadetree::verify::verify(&compiled.module).expect("sound WGSL");
        let all = start.elapsed();
        let ms = |d: std::time::Duration| d.as_secs_f64() * 1e3;
        let bytes = compiled.module.wgsl.len();
        println!("{count:>7} {:>9.2} {:>9.2} {:>9.2} {bytes:>11}", ms(read), ms(woven - read), ms(all - woven));
    }
}

/// Peak resident memory of the process so far, in MB, where the system tells.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    Some(line.trim().trim_end_matches(" kB").trim().parse::<f64>().ok()? / 1024.0)
}

fn whole_process(c: &mut Criterion) {
    if let Some(megabytes) = peak_memory() {
        println!("peak memory with 10,000 nodes: {megabytes:.0} MB");
    }
    let root = env!("CARGO_MANIFEST_DIR");
    let mut group = c.benchmark_group("whole process");
    group.sample_size(20);
    group.bench_function("generate graphs/scenes/car.ron", |b| {
        b.iter(|| {
            let run = Command::new(env!("CARGO_BIN_EXE_shadetree"))
                .args(["generate", "graphs/scenes/car.ron", "-o", "-"])
                .current_dir(root)
                .output()
                .expect("the program runs");
            assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
            run.stdout.len()
        });
    });
    group.finish();
}

criterion_group!(benches, nodes, whole_process);
criterion_main!(benches);
