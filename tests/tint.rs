//! Asks Tint, the WGSL compiler of Chromium, about modules: it checks the uniformity of control flow, which naga does
//! not. Needs Node and `npm ci` in tests/tint; without them the check is skipped in words, and fails where CI is set.

use std::path::Path;
use std::process::Command;

/// What Tint objects to in modules given by name and text, or `None` if Tint is not there.
pub fn complaints<'a>(modules: impl IntoIterator<Item = (&'a str, &'a str)>) -> Option<Vec<String>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/tint");
    let texts = tempfile::tempdir().expect("a temporary folder");
    for (name, wgsl) in modules {
        let file = format!("{}.wgsl", name.replace(['/', ' '], "_"));
        std::fs::write(texts.path().join(file), wgsl).expect("written");
    }
    let installed = folder.join("node_modules/webgpu").is_dir();
    let ran = installed.then(|| Command::new("node").arg(folder.join("check.mjs")).arg(texts.path()).output());
    let output = match ran {
        Some(Ok(output)) if output.status.code() != Some(2) => output,
        other => {
            let why = match other {
                None => "tests/tint/node_modules is missing: run `npm ci` in tests/tint".to_owned(),
                Some(Err(error)) => format!("Node does not start: {error}"),
                Some(Ok(output)) => String::from_utf8_lossy(&output.stderr).into_owned(),
            };
            assert!(std::env::var_os("CI").is_none(), "Tint is required here: {why}");
            eprintln!("SKIPPED: Tint did not check the modules: {why}");
            return None;
        }
    };
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON from check.mjs");
    let errors = json["errors"].as_array().expect("a list of errors");
    let name = |file: &str| Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let line = |e: &serde_json::Value| {
        format!("{}:{}:{}: {}", name(e["file"].as_str().unwrap_or("")), e["line"], e["column"], e["message"])
    };
    Some(errors.iter().map(line).collect())
}

#[test]
fn tint_refuses_what_naga_lets_through() {
    let sampling = "@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;
@fragment fn fs_main(@location(0) uv: vec2f) -> @location(0) vec4f {
    if uv.x > 0.5 { return textureSample(picture, picture_sampler, uv); }
    return vec4f(1.0);
}";
    let plain = "@fragment fn fs_main() -> @location(0) vec4f { return vec4f(1.0); }";
    let Some(found) = complaints([("good", plain), ("bad", sampling)]) else { return };
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with("bad:4:"), "{found:?}");
}
