//! Nothing more than a scene needs: no binding, parameter, map or pass that nobody reads, and no shadow method that the
//! renderer would have to know.

use std::fmt::Write as _;

use glam::DMat4;
use shadetree::compile::{Compiled, Options, Output};
use shadetree::diagnostic::SourceText;
use shadetree::module::Resource;
use shadetree::node::mentions;
use shadetree::render::RenderError;

use crate::stage::{Item, Stage, View, gpu, light, skipped, woven};
use crate::support::{catalog, compiled, files, graph_file, graph_text, kinds, root};

/// Every light under every shadow, on matte grey.
fn pairs(options: &Options) -> Vec<(String, Compiled)> {
    let mut all = Vec::new();
    for lamp in kinds("light") {
        for shadow in kinds("shadow") {
            let text = light(&lamp, "", &shadow, "", "");
            let graphs = [
                graph_text("light", &SourceText::new("light.ron", text)),
                graph_file("graphs/surfaces/lambert.ron".as_ref()),
            ];
            all.push((format!("{lamp} {shadow}"), compiled(&graphs, options)));
        }
    }
    all
}

/// How often a text mentions a name.
fn times(text: &str, name: &str) -> usize {
    let word = |c: char| c.is_alphanumeric() || c == '_';
    text.split(|c| !word(c)).filter(|w| *w == name).count()
}

#[test]
fn everything_that_is_bound_is_read() {
    let mut wrong = String::new();
    for (name, shader) in pairs(&Options::default()) {
        let module = &shader.module;
        for binding in &module.bindings {
            if times(&module.wgsl, &binding.name) < 2 {
                let _ = writeln!(wrong, "{name}: `{}` is declared and not read", binding.name);
            }
        }
        let spaces: Vec<&String> =
            shader.plan.lights.iter().filter_map(|l| l.space.as_ref()).flat_map(|s| &s.inputs).collect();
        for parameter in &module.parameters {
            let read = times(&module.wgsl, &parameter.name) > 1;
            if !read && !spaces.contains(&&parameter.path) {
                let _ = writeln!(wrong, "{name}: nobody needs `{}`", parameter.path);
            }
        }
        for (index, map) in shader.plan.maps.iter().enumerate() {
            let bound = |r: &Resource| matches!(r, Resource::Map { index: i, .. } if *i == index);
            if !module.bindings.iter().any(|b| bound(&b.resource)) {
                let _ = writeln!(wrong, "{name}: a map of `{}` is made and not bound", map.light);
            }
            for pass in &map.passes {
                for declared in pass.wgsl.lines().filter(|l| l.starts_with("@group")) {
                    let variable = declared.split(':').next().and_then(|l| l.rsplit([' ', '>']).next());
                    let variable = variable.expect("a declaration has a name").trim();
                    if times(&pass.wgsl, variable) < 2 {
                        let _ = writeln!(wrong, "{name}: pass `{}` does not read `{variable}`", pass.name);
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn without_casters_no_shadow_is_left_in_the_shader() {
    let options = Options { unshadowed: true, ..Options::default() };
    for (name, shader) in pairs(&options) {
        assert!(shader.plan.maps.is_empty() && shader.plan.lights.is_empty(), "{name}: {:?}", shader.plan);
        let bindings = &shader.module.bindings;
        let shadow = |r: &Resource| matches!(r, Resource::Map { .. } | Resource::Space { .. });
        assert!(!bindings.iter().any(|b| b.group == 3 || shadow(&b.resource)), "{name}: {bindings:?}");
        assert!(!shader.module.wgsl.contains("shadow"), "{name}: {}", shader.module.wgsl);
    }
}

/// The picture is that of the light without its shadow node, bit by bit; and what the shader would say of maps that hold
/// nothing differs from it by no more than the rounding of a few sums.
#[test]
fn without_casters_the_picture_is_that_of_the_bare_light() {
    let Some(mut gpu) = gpu() else { return };
    let mut ground = Item::plane([16.0, 16.0], DMat4::IDENTITY);
    ground.casts = false;
    let stage = Stage::new(vec![ground], View::down((0.4, 0.2), 3.0, 5.0, (24, 24)));
    let plain = pairs(&Options { unshadowed: true, ..Options::default() });
    for ((name, full), (_, bare)) in pairs(&Options::default()).iter().zip(&plain) {
        let lamp = name.split(' ').next().expect("a light");
        let text = format!("Graph(version: 1, nodes: {{\"lamp\": (kind: \"{lamp}\")}}, links: [])");
        let alone = woven(&[("light", &text)], Output::Radiance);
        let mut picture = |shader| stage.frame(&mut gpu, shader).pixels;
        let (without, alone) = (picture(bare), picture(&alone));
        assert!(without == alone, "{name}: not the picture of the light alone");
        let with = match gpu.render(&stage.job(full)) {
            Ok(frame) => frame.pixels,
            // Maps in formats that this adapter does not have.
            Err(RenderError::Unsupported(why)) => {
                skipped(&format!("{name}: {why}"));
                continue;
            }
            Err(error) => panic!("{name}: {error}"),
        };
        let most = with.iter().zip(&without).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
        assert!(most <= 2e-6, "{name}: off by {most}");
    }
}

#[test]
fn visibility_without_casters_is_one() {
    let options = Options { unshadowed: true, output: Output::Visibility("light".into()), ..Options::default() };
    for (name, shader) in pairs(&options) {
        assert!(shader.plan.maps.is_empty(), "{name}");
        assert!(shader.module.wgsl.contains("vec4f(vec3f(1.0), 1.0)"), "{name}: {}", shader.module.wgsl);
    }
}

/// The renderer, the planner, the scene and the program know passes and projections, and no shadow.
#[test]
fn no_method_is_named_outside_its_files() {
    let shadows = kinds("shadow");
    let passes: Vec<&str> = catalog().pass_names().filter(|p| *p != "depth" && *p != "tonemap").collect();
    let mut wrong = String::new();
    for folder in ["src/render", "src/plan", "src/scene", "src/program", "src/emit", "src/weave"] {
        for file in files(folder, "rs").iter().filter(|f| !f.to_string_lossy().contains("tests")) {
            let text = std::fs::read_to_string(root().join(file)).expect("a source file");
            // Tests beside the code may use what they like.
            let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
            let strings: Vec<String> = code.split('"').skip(1).step_by(2).map(str::to_owned).collect();
            let named = |word: &str| strings.iter().any(|s| mentions(s).iter().any(|m| m == word));
            for name in shadows.iter().map(String::as_str).chain(passes.iter().copied()) {
                if named(name) || times(code, name) > 0 && name.contains("shadow") {
                    let _ = writeln!(wrong, "{} names `{name}`", file.display());
                }
            }
            for word in ["vsm", "pcf", "esm", "evsm", "msm", "pcss", "chebyshev"] {
                if times(&code.to_lowercase(), word) > 0 {
                    let _ = writeln!(wrong, "{} names `{word}`", file.display());
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
