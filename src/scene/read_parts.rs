//! Reading shapes, environments, paths and settings, and what makes sense of them.

use glam::DVec3;

use super::environment::Sky;
use super::read::Report;
use super::{CameraSettings, Environment, FileReference, MAX_SEGMENTS, MIN_SEGMENTS, Setting, Settings, Shape};
use crate::diagnostic::{Diagnostic, Place, Span, did_you_mean};
use crate::ron::{Field, Node, Tree, field};
use crate::semantic::Value;

/// Name and fields of a variant such as `Sphere(radius: 1)`; fields not in the list of its name are errors, since a
/// variant has no place to keep them. `known` lists names with their fields; one marked `*` stands for a bare value.
fn variant<'a>(
    node: &'a Node,
    known: &[(&'static str, &[&str])],
    what: &str,
    report: &mut Report,
) -> Option<(&'static str, &'a [Field], &'a [Node])> {
    let (name, fields, items): (&str, &[Field], &[Node]) = match &node.value {
        Tree::Struct(Some(name), fields) => (name, fields, &[]),
        Tree::Tuple(Some(name), items) => (name, &[], items),
        Tree::Ident(name) => (name, &[], &[]),
        other => {
            let names: Vec<&str> = known.iter().map(|k| k.0).collect();
            let message = format!("expected {what}, found {}", other.describe());
            report.error("ST0408", message, node, &format!("write one of {}", names.join(", ")));
            return None;
        }
    };
    let Some((name, allowed)) = known.iter().find(|k| k.0 == name) else {
        let names: Vec<&str> = known.iter().map(|k| k.0).collect();
        let help = match did_you_mean(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("known ones: {}", names.join(", ")),
        };
        report.error("ST0408", format!("`{name}` is not {what}"), node, &help);
        return None;
    };
    if !items.is_empty() && !allowed.contains(&"*") {
        let message = format!("`{name}` takes named fields");
        report.error("ST0409", message, node, &format!("write `{name}({}: ...)`", allowed.first().unwrap_or(&"")));
        return None;
    }
    for f in fields.iter().filter(|f| !allowed.contains(&f.name.as_str())) {
        let help = match did_you_mean(&f.name, allowed.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("its fields: {}", allowed.join(", ")),
        };
        let place = Place::span(Span::new(&report.source, f.name_span.clone()));
        report.push(Diagnostic::error("ST0409", format!("`{name}` has no field `{}`", f.name), place).help(help));
    }
    Some((name, fields, items))
}

/// A shape.
pub(super) fn shape(node: &Node, report: &mut Report) -> Option<Shape> {
    let known: [(&str, &[&str]); 6] = [
        ("Plane", &["size", "segments"]),
        ("Box", &["size", "bevel"]),
        ("Sphere", &["radius", "segments"]),
        ("Cylinder", &["radius", "height", "capped", "segments"]),
        ("Torus", &["major", "minor", "segments"]),
        ("Obj", &["path", "*"]),
    ];
    let (name, fields, items) = variant(node, &known, "a shape", report)?;
    let shape = match name {
        "Plane" => Shape::Plane {
            size: report.get(fields, "size", [1.0; 2], Node::as_array),
            segments: report.get(fields, "segments", [1.0; 2], Node::as_array).map(|n| whole(n, 1, node, report)),
        },
        "Box" => Shape::Box {
            size: report.get(fields, "size", [1.0; 3], Node::as_array),
            bevel: report.get(fields, "bevel", 0.0, Node::as_f64),
        },
        "Sphere" => Shape::Sphere {
            radius: report.get(fields, "radius", 0.5, Node::as_f64),
            segments: segments(fields, Shape::SPHERE_SEGMENTS, node, report),
        },
        "Cylinder" => Shape::Cylinder {
            radius: report.get(fields, "radius", 0.5, Node::as_f64),
            height: report.get(fields, "height", 1.0, Node::as_f64),
            capped: report.get(fields, "capped", true, Node::as_bool),
            segments: segments(fields, Shape::CYLINDER_SEGMENTS, node, report),
        },
        "Torus" => Shape::Torus {
            major: report.get(fields, "major", 0.5, Node::as_f64),
            minor: report.get(fields, "minor", 0.2, Node::as_f64),
            segments: segments(fields, Shape::TORUS_SEGMENTS, node, report),
        },
        _ => match items {
            [only] => {
                let source = report.source.clone();
                let text = report.take(only.as_str(&source))?.to_string();
                Shape::Obj(reference(text, only, report))
            }
            _ => Shape::Obj(path(fields, "path", node, report)),
        },
    };
    check_shape(&shape, node, report);
    Some(shape)
}

fn segments(fields: &[Field], default: u32, node: &Node, report: &mut Report) -> u32 {
    let given = report.get(fields, "segments", f64::from(default), Node::as_f64);
    whole(given, MIN_SEGMENTS, field(fields, "segments").unwrap_or(node), report)
}

/// A number of segments.
fn whole(x: f64, min: u32, node: &Node, report: &mut Report) -> u32 {
    if x.fract() != 0.0 || x < f64::from(min) || x > f64::from(MAX_SEGMENTS) {
        let message = format!("{x} is not a number of segments");
        report.error("ST0404", message, node, &format!("write a whole number from {min} to {MAX_SEGMENTS}"));
        return min;
    }
    x as u32
}

fn check_shape(shape: &Shape, node: &Node, report: &mut Report) {
    let extents: Vec<f64> = match shape {
        Shape::Plane { size, .. } => size.to_vec(),
        Shape::Box { size, .. } => size.to_vec(),
        Shape::Sphere { radius, .. } => vec![*radius],
        Shape::Cylinder { radius, height, .. } => vec![*radius, *height],
        Shape::Torus { major, minor, .. } => vec![*major, *minor],
        Shape::Obj(_) => return,
    };
    if let Some(x) = extents.iter().find(|x| **x <= 0.0) {
        let message = format!("this {} has no size: {x}", shape.name());
        report.error("ST0407", message, node, "give every extent as a number of metres greater than 0");
    } else if let Some(x) = extents.iter().find(|x| !(1e-6..=1e6).contains(*x)) {
        let message = format!("an extent of {x} m cannot be shown");
        report.error("ST0404", message, node, "extents lie between 0.000001 and 1000000 metres");
    }
    match shape {
        Shape::Box { size, bevel } => {
            let most = size.iter().copied().fold(f64::INFINITY, f64::min) / 2.0;
            if *bevel < 0.0 || *bevel > most.max(0.0) {
                let message = format!("a bevel of {bevel} does not fit into this box");
                report.error(
                    "ST0404",
                    message,
                    node,
                    &format!("write a radius from 0 to {most}, half the shortest side"),
                );
            }
        }
        Shape::Torus { major, minor, .. } if minor >= major => {
            let message = format!("the tube ({minor}) is not thinner than the ring ({major})");
            report.error("ST0404", message, node, "make `minor` less than `major`");
        }
        _ => {}
    }
}

/// The surroundings.
pub(super) fn environment(node: &Node, report: &mut Report) -> Option<Environment> {
    let known: [(&str, &[&str]); 3] = [
        ("Color", &["color", "*"]),
        ("Sky", &["zenith", "horizon", "ground", "sun_direction", "sun_glow", "intensity"]),
        ("Image", &["path", "rotation", "intensity"]),
    ];
    let (name, fields, items) = variant(node, &known, "an environment", report)?;
    let source = report.source.clone();
    let environment = match name {
        "Color" => Environment::Color(match items {
            [] => report.get(fields, "color", [0.0; 3], Node::as_array),
            [one] => report.take(one.as_array(&source))?,
            many => {
                let numbers: Vec<f64> = many.iter().filter_map(|n| report.take(n.as_f64(&source))).collect();
                let Ok(color) = numbers.try_into() else {
                    report.error("ST0408", "a colour has 3 numbers", node, "write `Color(0.2, 0.3, 0.5)`");
                    return None;
                };
                color
            }
        }),
        "Sky" => {
            let d = Sky::default();
            Environment::Sky(Sky {
                zenith: report.get(fields, "zenith", d.zenith, Node::as_array),
                horizon: report.get(fields, "horizon", d.horizon, Node::as_array),
                ground: report.get(fields, "ground", d.ground, Node::as_array),
                sun_direction: report.get(fields, "sun_direction", d.sun_direction, Node::as_array),
                sun_glow: report.get(fields, "sun_glow", d.sun_glow, Node::as_array),
                intensity: report.get(fields, "intensity", d.intensity, Node::as_f64),
            })
        }
        _ => Environment::Image {
            image: path(fields, "path", node, report),
            rotation: report.get(fields, "rotation", 0.0, Node::as_f64),
            intensity: report.get(fields, "intensity", 1.0, Node::as_f64),
        },
    };
    let amounts = match &environment {
        Environment::Color(color) => color.to_vec(),
        Environment::Sky(s) => [&s.zenith[..], &s.horizon, &s.ground, &s.sun_glow, &[s.intensity]].concat(),
        Environment::Image { intensity, .. } => vec![*intensity],
    };
    // Half floats, which a renderer may store it in, end at 65504.
    if let Some(x) = amounts.iter().find(|x| !(0.0..=60_000.0).contains(*x)) {
        report.error(
            "ST0404",
            format!("{x} is not an amount of light"),
            node,
            "colours and intensities lie between 0 and 60000",
        );
    }
    if matches!(&environment, Environment::Sky(s) if s.sun_direction == [0.0; 3]) {
        report.error(
            "ST0404",
            "the direction to the sun has no length",
            node,
            "write for example `sun_direction: (0.5, 0.6, 0.4)`",
        );
    }
    Some(environment)
}

/// A path that must be given.
pub(super) fn path(fields: &[Field], name: &str, owner: &Node, report: &mut Report) -> FileReference {
    let Some(node) = field(fields, name) else {
        report.error("ST0011", format!("the field `{name}` is missing"), owner, &format!("add `{name}: \"FILE\"`"));
        return FileReference::default();
    };
    let source = report.source.clone();
    let text = report.take(node.as_str(&source)).map(str::to_string);
    text.map_or_else(FileReference::default, |text| reference(text, node, report))
}

fn reference(text: String, node: &Node, report: &mut Report) -> FileReference {
    if text.trim().is_empty() || text.contains('\0') {
        report.error("ST0411", "the path is empty", node, "write the path of a file, relative to this one");
    }
    FileReference { path: text, span: Some(report.span(node)) }
}

/// The field `set`.
pub(super) fn settings(fields: &[Field], report: &mut Report) -> Settings {
    let source = report.source.clone();
    let mut settings = Settings::new();
    let map = field(fields, "set").and_then(|node| report.take(node.as_map(&source)));
    for (key, node) in map.unwrap_or_default() {
        let Some(name) = report.take(key.as_str(&source)) else {
            continue;
        };
        if !name.split_once('.').is_some_and(|(node, port)| !node.trim().is_empty() && !port.trim().is_empty()) {
            let help = "write the name of a node of the graph, a dot, and the name of its port";
            report.error("ST0412", format!("`{name}` is not `node.port`"), key, help);
        }
        let value = match &node.value {
            Tree::Bool(b) => Some(Value::Bool(*b)),
            Tree::Text(text) => Some(Value::Text(text.clone())),
            Tree::Number(_) | Tree::Tuple(None, _) | Tree::List(_) => {
                report.take(node.as_numbers(&source)).map(Value::Numbers)
            }
            other => {
                let message = format!("{} is not a value of a port", other.describe());
                report.error(
                    "ST0413",
                    message,
                    node,
                    "write `true`, a number, a tuple of numbers, or a text in quotes",
                );
                None
            }
        };
        if let Some(value) = value {
            settings.insert(name.to_string(), Setting { value, span: Some(report.span(node)) });
        }
    }
    settings
}

/// Whether the camera can see.
pub(super) fn check_camera(camera: &CameraSettings, node: &Node, fields: &[Field], report: &mut Report) {
    let at = |name: &str| field(fields, name).unwrap_or(node);
    if !(camera.fov > 0.0 && camera.fov < 180.0) {
        let message = format!("a field of view of {} degrees is impossible", camera.fov);
        report.error("ST0404", message, at("fov"), "write the vertical angle in degrees, for example 40");
    }
    if camera.near <= 0.0 {
        let message = format!("the near distance {} is not in front of the camera", camera.near);
        report.error("ST0404", message, at("near"), "write a distance greater than 0, for example 0.1");
    }
    if camera.far <= camera.near {
        let message = format!("the far distance {} is not beyond the near distance {}", camera.far, camera.near);
        report.error("ST0406", message, at("far"), "make `far` greater than `near`");
    }
    let view = DVec3::from_array(camera.target) - DVec3::from_array(camera.position);
    let up = DVec3::from_array(camera.up);
    if view.length() < 1e-9 {
        report.error(
            "ST0405",
            "the camera looks at the place where it stands",
            at("target"),
            "move `position` or `target`",
        );
    } else if up.normalize_or_zero().cross(view.normalize()).length() < 1e-6 {
        report.error(
            "ST0405",
            "the camera looks along its up direction",
            at("up"),
            "turn `up`, for example to (0, 0, -1)",
        );
    }
}
