//! Whole node files: what is read, what is refused and where.

use super::*;
use crate::diagnostic::{Diagnostic, Severity, Span};
use crate::semantic::{Shape, Value};

const GLOW: &str = "\
//! label: Glow
//! category: surface
//! synonyms: shine, bloom light
//! use: tools
//! Scatters light. Twice.
//! option steps: 3 | 5 = 5 - How many.
//! option tint: on | off = on - Whether it is coloured.
//! sampler smp: filter=linear address=repeat

const STEPS: i32 = 5;

struct Result {
    radiance: vec3f,
    share: f32,
}

/// irradiance (color irradiance): Arriving light.
/// to_light (direction world unit): Towards it.
/// normal (normal world unit; = @normal_world): Shading normal.
//#if tint == on
/// tint (color reflectance; = (1, 0.5, 0); 0..1; srgb): Its colour,
///   continued here.
//#end
/// smp (sampler; hidden): Sampler.
/// -> radiance (color radiance): Leaving light.
/// -> share (scalar): How much.
fn glow(
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    //#if tint == on
    tint: vec3f,
    //#end
    smp: sampler,
) -> Result {
    var r = irradiance * twice(f32(STEPS)) * dot(to_light, normal);
    //#if tint == on
    r *= tint;
    //#end
    return Result(r, 1.0);
}

/// emission (color emission; = 0): Own light.
/// -> radiance (color radiance): Leaving light.
fn glow_ambient(emission: vec3f) -> vec3f { return emission; }
";

fn catalog() -> Catalog {
    let mut catalog = Catalog::default();
    assert_eq!(catalog.add_library("lib/base.wgsl", "const TWO: f32 = 2.0;"), []);
    let tools = "//! use: base\nfn twice(x: f32) -> f32 { return TWO * x; }";
    assert_eq!(catalog.add_library("lib/tools.wgsl", tools), []);
    catalog
}

/// `CODE quoted text: message`, for each.
fn show(found: &[Diagnostic]) -> Vec<String> {
    let quoted = |d: &Diagnostic| d.place.span.as_ref().map_or("", |s| &s.source.text[s.range.clone()]).to_owned();
    found.iter().map(|d| format!("{} {}: {}", d.code, quoted(d), d.message)).collect()
}

fn add(text: &str) -> Vec<String> {
    show(&catalog().add_file("x/glow.wgsl", text))
}

/// The file with one text replaced.
fn altered(from: &str, to: &str) -> Vec<String> {
    assert!(GLOW.contains(from), "{from}");
    add(&GLOW.replacen(from, to, 1))
}

#[test]
fn a_file_is_read_whole() {
    let mut catalog = catalog();
    assert_eq!(catalog.add_file("x/glow.wgsl", GLOW), []);
    let file = catalog.get("glow").unwrap();
    let d = file.definition(&Choices::new()).unwrap();
    assert_eq!(d.header.description, "Scatters light. Twice.");
    assert_eq!(d.main.result_struct.as_deref(), Some("Result"));
    let tint = d.input("tint").unwrap();
    assert_eq!((tint.unit.as_str(), tint.range), ("srgb", (Some(0.0), Some(1.0))));
    assert_eq!(tint.default, Some(Default::Value(Value::Numbers(vec![1.0, 0.5, 0.0]))));
    assert_eq!(tint.doc, "Its colour, continued here.");
    assert_eq!(d.output("share").unwrap().ty.shape, Shape::F32(1));
    assert_eq!(d.ambient.as_ref().unwrap().inputs[0].name, "emission");
    let names: Vec<&str> = d.items.iter().map(|i| i.name.as_str()).collect();
    assert_eq!(names, ["STEPS", "Result", "glow", "glow_ambient"]);
    for item in &d.items {
        assert!(GLOW[item.offset..].starts_with(&item.text[..9]), "{}", item.name);
    }
    assert!(d.items[2].mentions.contains(&"twice".to_owned()));
    let libraries: Vec<&str> = catalog.libraries_of(&d).iter().map(|l| l.name.as_str()).collect();
    assert_eq!(libraries, ["base", "tools"]);
}

#[test]
fn choices_change_ports_and_constants() {
    let mut catalog = catalog();
    assert_eq!(catalog.add_file("glow.wgsl", GLOW), []);
    let file = catalog.get("glow").unwrap();
    let choices = Choices::from([("tint".into(), "off".into()), ("steps".into(), "3".into())]);
    let d = file.definition(&choices).unwrap();
    assert!(d.input("tint").is_none() && d.items[0].text == "const STEPS: i32 = 3;");
    assert!(!d.items[2].text.contains("tint"), "{}", d.items[2].text);
    assert!(std::sync::Arc::ptr_eq(&d, &file.definition(&choices).unwrap()));
    let wrong = Choices::from([("tnt".into(), "off".into()), ("steps".into(), "4".into())]);
    let found = file.definition(&wrong).unwrap_err();
    assert_eq!(show(&found), ["ST0133 : `4` is not a choice of option `steps`", "ST0133 : there is no option `tnt`"]);
    assert_eq!(found[1].help.as_deref(), Some("did you mean `tint`?"));
}

#[test]
fn header_mistakes() {
    for (from, to, expected) in [
        ("label: Glow", "lable: Glow", "ST0101 lable: "),
        ("//! label: Glow\n", "", "ST0100 : the header says no label"),
        ("//! category: surface\n", "", "ST0100 : the header says no category"),
        ("category: surface", "category: sufrace", "ST0103 sufrace: "),
        ("label: Glow", "label:", "ST0102 : "),
        ("synonyms: shine, bloom light", "synonyms: shine, shine", "ST0104 shine: "),
        ("synonyms: shine, bloom light", "synonyms: shine,, bloom", "ST0102 : "),
        ("//! synonyms", "//! label: Again\n//! synonyms", "ST0104 label: "),
        ("use: tools", "use: tols", "ST0128 tols: there is no library"),
        ("= 5 - How", "= 4 - How", "ST0105 4: "),
        ("5 = 5 - How", "5 - How", "ST0102 3 | 5: option `steps` has no default"),
        ("= 5 - How many.", "= 5", "ST0102 3 | 5 = 5: "),
        ("3 | 5 = 5", "3 | 5 | 3 = 5", "ST0104 3: "),
        ("sampler smp:", "sampler smq:", "ST0106 smq: "),
        ("filter=linear", "filter=liner", "ST0102 filter=liner address=repeat: `liner`"),
        ("filter=linear", "fitler=linear", "ST0101 "),
        ("filter=linear", "filter", "ST0102 filter: "),
        ("filter=linear", "filter=$stps", "ST0107 $stps: "),
        ("//! sampler", "//! map tint: blur(a=$nope) > blur\n//! sampler", "ST0107 $nope: "),
        ("//! sampler", "//! map nope: blur\n//! sampler", "ST0106 nope: "),
        ("//! sampler", "//! map tint: blur(a\n//! sampler", "ST0102 blur(a: "),
        ("//! sampler", "//! texture smp: encoding=rgb\n//! sampler", "ST0102 encoding=rgb: "),
        ("//! sampler", "//! space: perspective(a, b)\n//! sampler", "ST0102 perspective(a, b): "),
        ("//! sampler", "//! space: orthographic(normal, normal, nrmal)\n//! sampler", "ST0106 nrmal: "),
        ("//! sampler", "//! space: fisheye(normal)\n//! sampler", "ST0102 fisheye: "),
        ("//! sampler", "//! generic T: f32 | i32\n//! sampler", "ST0102 i32: "),
        ("struct Result", "//! late\nstruct Result", "ST0108 //! late: "),
    ] {
        let found = altered(from, to);
        assert!(found.iter().any(|f| f.starts_with(expected)), "{to}: {found:#?}");
    }
}

#[test]
fn port_and_text_mistakes() {
    for (from, to, expected) in [
        ("/// to_light (direction world unit): Towards it.\n", "", "ST0118 to_light: "),
        ("/// to_light", "/// to_lihgt (scalar): No.\n/// to_light", "ST0119 to_lihgt: `glow` takes no"),
        ("/// to_light", "/// normal (normal): No.\n/// to_light", "ST0117 normal: "),
        ("/// -> share (scalar): How much.\n", "", "ST0118 share: "),
        ("/// -> share", "/// -> sharp (scalar): No.\n/// -> share", "ST0119 sharp: "),
        ("= (1, 0.5, 0)", "= (1, 0.5)", "ST0114 (1, 0.5): "),
        ("= (1, 0.5, 0)", "= 2", "ST0116 2: the default"),
        ("= @normal_world", "= @texcoord", "ST0115 @texcoord: "),
        ("(sampler; hidden)", "(scalar; hidden)", "ST0136 scalar: "),
        ("normal world unit; = @normal_world", "normal world unit; hidden", "ST0137 normal: "),
        ("fn glow(", "fn glowing(", "ST0121 : "),
        ("    smp: sampler", "    static: sampler", "ST0120 "),
        ("const STEPS", "const static: i32 = 1;\nconst STEPS", "ST0120 static: "),
        ("const STEPS", "const STEPS: i32 = 1;\nconst STEPS", "ST0104 STEPS: "),
        ("const STEPS", "var<private> p: i32;\nconst STEPS", "ST0125 p: "),
        ("const STEPS", "@compute @workgroup_size(1) fn main() {}\nconst STEPS", "ST0125 main: "),
        ("const STEPS", "oops;\nconst STEPS", "ST0124 oops: "),
        ("//#if tint == on\n/// tint", "//#if tint == maybe\n/// tint", "ST0110 //#if tint == maybe: "),
        ("    //#end\n    return", "    return", "ST0110 //#if tint == on: "),
        ("//! sampler", "//! inline\n//! sampler", "ST0123 glow: "),
        ("//! sampler", "//! generic T: f32 | vec2f\n//! sampler", "ST0122 : "),
        ("-> Result {", "{", "ST0135 glow: "),
        ("r *= tint;", "r *= tnt;", "ST0126 tnt: "),
        ("r *= tint;", "r = 1;", "ST0127 1: "),
        ("irradiance * twice", "irradiance + twice", ""),
        ("return emission;", "return 1.0;", "ST0126 1.0: "),
    ] {
        let found = altered(from, to);
        let met = found.iter().any(|f| f.starts_with(expected));
        assert!(if expected.is_empty() { found.is_empty() } else { met }, "{to}: {found:#?}");
    }
}

#[test]
fn mistakes_accumulate() {
    let text = GLOW.replace("label: Glow", "label:").replace("category: surface", "category: none");
    assert_eq!(add(&text).len(), 2);
    let text = GLOW.replace("= @normal_world", "= @nose").replace("= (1, 0.5, 0)", "= big");
    assert_eq!(add(&text).len(), 2);
}

#[test]
fn wgsl_errors_say_line_and_choices() {
    let mut catalog = catalog();
    let found = catalog.add_file("glow.wgsl", &GLOW.replace("r *= tint;", "r *= tnt;"));
    let line = GLOW.lines().position(|l| l.contains("r *= tint")).unwrap() + 1;
    assert_eq!(found[0].place.span.as_ref().map(Span::line_column), Some((line, 10)));
    assert!(found[0].notes.contains(&format!("line {line}: r *= tnt;")), "{:?}", found[0].notes);
    assert!(found[0].notes.contains(&"with steps = 3, tint = on".to_owned()), "{:?}", found[0].notes);
    assert!(catalog.get("glow").is_none());
}

#[test]
fn generic_files_are_proven_for_every_width() {
    let text = "//! label: Half\n//! category: math\n//! inline\n//! generic T: f32 | vec3f\nalias T = f32;\n\
                /// a (number; = 1): In.\n/// -> b (number): Out.\nfn half(a: T) -> T { return a * 0.5; }";
    let mut catalog = Catalog::default();
    assert_eq!(catalog.add_file("half.wgsl", text), []);
    let d = catalog.get("half").unwrap().definition(&Choices::new()).unwrap();
    assert_eq!((d.main.body.as_deref(), &d.main.inputs[0].ty.shape), (Some("a * 0.5"), &Shape::Generic));
    assert_eq!(d.items.len(), 1);
    let found = catalog.add_file("half.wgsl", &text.replace("a * 0.5", "cross(a, a)"));
    assert!(found.iter().any(|f| f.notes.contains(&"with T = f32".to_owned())), "{found:?}");
    let found = catalog.add_file("half.wgsl", &text.replace("a * 0.5", "max(a, 0.5)"));
    assert!(found.iter().all(|f| f.notes.contains(&"with T = vec3f".to_owned())) && !found.is_empty(), "{found:?}");
    let found = catalog.add_file("half.wgsl", &text.replace("alias T = f32", "alias T = vec2f"));
    assert_eq!(found[0].code, "ST0122");
}

#[test]
fn kinds_may_be_replaced_with_a_warning() {
    let mut catalog = catalog();
    assert_eq!(catalog.add_file("a/glow.wgsl", GLOW), []);
    let found = catalog.add_file("b/glow.wgsl", GLOW);
    assert_eq!((found.len(), found[0].code, found[0].severity), (1, "ST0132", Severity::Warning));
    assert_eq!(catalog.get("glow").unwrap().path(), "b/glow.wgsl");
    assert_eq!(
        show(&catalog.add_file("my glow.wgsl", GLOW))[0],
        "ST0109 : `my glow` cannot be the name of a WGSL function"
    );
}

#[test]
fn names_are_found() {
    let mut catalog = catalog();
    assert_eq!(catalog.add_file("glow.wgsl", GLOW), []);
    assert_eq!(catalog.nearest("glwo").or(catalog.nearest("gloww")).as_deref(), Some("glow"));
    assert_eq!(catalog.nearest("shien").or(catalog.nearest("Bloom-Light")).as_deref(), Some("glow"));
    assert_eq!(catalog.nearest("entirely_else"), None);
    assert_eq!(catalog.search("bloom scatters").len(), 1);
    assert_eq!(catalog.search("bloom zebra").len(), 0);
    assert_eq!(catalog.kinds().collect::<Vec<_>>(), ["glow"]);
}

#[test]
fn libraries_in_circles_are_cut() {
    let mut catalog = Catalog::default();
    assert_eq!(catalog.add_library("a.wgsl", "//! use: b\nconst A: f32 = 1.0;"), []);
    assert_eq!(catalog.add_library("b.wgsl", "//! use: a\nconst B: f32 = A;"), []);
    let order: Vec<&str> = catalog.closure(&["a".into()]).iter().map(|l| l.name.as_str()).collect();
    assert_eq!(order, ["b", "a"]);
    assert_eq!(show(&catalog.add_library("c.wgsl", "fn f() -> f32 { return x; }"))[0][..9], *"ST0126 x:");
    assert!(catalog.library("c").is_none());
}

#[test]
fn combinations_are_bounded() {
    let option = |n: usize| format!("//! option o{n}: a | b | c = a - X.\n");
    let options: String = (0..9).map(option).collect();
    let file = NodeFile::new("x.wgsl".into(), format!("//! label: X\n//! category: math\n{options}").into(), false);
    let header = file.header().unwrap();
    let sets = verify::combinations(&header);
    assert_eq!(sets.len(), 64);
    assert!(sets.iter().enumerate().all(|(i, s)| !sets[..i].contains(s)));
}

#[test]
fn embedded_files_are_sound() {
    let catalog = Catalog::embedded();
    let mut found = Vec::new();
    for name in catalog.library_names() {
        found.extend_from_slice(catalog.library_diagnostics(name));
    }
    for file in catalog.files() {
        found.extend(file.verify(&catalog));
    }
    for name in catalog.pass_names() {
        match catalog.pass(name) {
            Some(Ok(pass)) => match pass.text(&Choices::new(), &catalog) {
                Ok(text) => assert_eq!(
                    naga::front::wgsl::parse_str(&text).err().map(|e| e.emit_to_string(&text)),
                    None,
                    "{name}"
                ),
                Err(errors) => found.extend(errors),
            },
            Some(Err(errors)) => found.extend(errors),
            None => {}
        }
    }
    assert!(found.is_empty(), "{:#?}", show(&found));
}
