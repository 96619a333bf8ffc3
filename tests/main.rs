//! All tests of the package that use it from outside.
use shadetree::*;
#[test]
fn try_it() {
    let catalog = node::Catalog::embedded();
    let g = |name: &str, t: &str| {
        let s = diagnostic::SourceText::new(name, t);
        let (g, d) = graph::read(&s);
        for d in &d {
            println!("{d:?}");
        }
        compile::NamedGraph { name: name.into(), graph: g.unwrap(), set: Default::default() }
    };
    let a = g(
        "spot_vsm",
        r#"Graph(version: 1, name: "Spot light with a variance shadow", nodes: {"spot": (kind: "spot_light"), "vsm": (kind: "variance_shadow")}, links: ["spot -> vsm"])"#,
    );
    let b = g(
        "bumpy_glass",
        r#"Graph(version: 1, name: "Bumpy glass", nodes: {"noise": (kind: "fbm3d", params: {"scale": 6}), "bump": (kind: "bump"), "glass": (kind: "glass")}, links: ["noise -> bump", "bump -> glass"])"#,
    );
    let (c, d) = compile::compile(&[a, b], &catalog, &Default::default());
    for d in &d {
        println!("{} {} {:?} {:?} {:?}", d.code, d.message, d.help, d.notes, d.place.node);
    }
    if let Some(c) = c {
        println!("{}", c.module.wgsl);
        println!(
            "{:#?}",
            c.plan
                .maps
                .iter()
                .map(|m| (&m.light, m.passes.iter().map(|p| (&p.name, &p.choices)).collect::<Vec<_>>()))
                .collect::<Vec<_>>()
        );
        let m = naga::front::wgsl::parse_str(&c.module.wgsl);
        match m {
            Ok(m) => println!(
                "{:?}",
                naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
                    .validate(&m)
                    .is_ok()
            ),
            Err(e) => println!("{}", e.emit_to_string(&c.module.wgsl)),
        }
    }
}
