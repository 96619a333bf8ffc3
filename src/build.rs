//! Lists the shader files of the package in tables that the program is compiled with.

#![allow(clippy::print_stdout, reason = "cargo reads what a build script prints")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?);
    let out = PathBuf::from(env::var("OUT_DIR").map_err(io::Error::other)?);
    println!("cargo::rerun-if-changed=src/build.rs");
    let (libraries, nodes): (Vec<_>, Vec<_>) =
        shaders(&root.join("nodes"))?.into_iter().partition(|p| p.starts_with(root.join("nodes/lib")));
    let mut text = String::new();
    table(&mut text, &root, "NODES", "Node files", &nodes)?;
    table(&mut text, &root, "LIBRARIES", "Library files", &libraries)?;
    table(&mut text, &root, "SHADERS", "Fixed passes", &shaders(&root.join("shaders"))?)?;
    fs::write(out.join("embedded.rs"), text)
}

/// Every `.wgsl` file below `folder`, sorted. A folder that is not there holds none.
fn shaders(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        println!("cargo::rerun-if-changed={}", folder.display());
        if !folder.is_dir() {
            continue;
        }
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "wgsl") {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}

fn table(text: &mut String, root: &Path, name: &str, doc: &str, files: &[PathBuf]) -> io::Result<()> {
    let _ = writeln!(text, "/// {doc}: relative path and text, sorted by path.");
    let _ = writeln!(text, "pub(crate) const {name}: &[(&str, &str)] = &[");
    for file in files {
        let relative = file.strip_prefix(root).map_err(io::Error::other)?;
        let relative = relative.to_string_lossy().replace('\\', "/");
        let _ = writeln!(text, "    ({relative:?}, include_str!({:?})),", file.to_string_lossy());
    }
    text.push_str("];\n");
    Ok(())
}
