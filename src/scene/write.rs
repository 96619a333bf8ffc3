//! The one text of a scene: sorted by name, one field a line, what equals its default left out.

use super::environment::Sky;
use super::{CameraSettings, Environment, LightInstance, Object, Scene, Settings, Shape, Transform, Unknown, VERSION};
use crate::ron::{identifier, inline, number, text};
use crate::semantic::Value;

/// The canonical text of a scene. Reading it gives the same scene, and writing that gives the same text.
pub fn write(scene: &Scene) -> String {
    let mut out = format!("Scene(\n    version: {VERSION},\n");
    let mut head = Fields::default();
    head.text("name", &scene.name);
    head.text("note", &scene.note);
    head.add("camera", camera(&scene.camera));
    if scene.environment != Environment::default() {
        head.add("environment", environment(&scene.environment));
    }
    out += &head.lines(1);
    let mut lights: Vec<&LightInstance> = scene.lights.iter().collect();
    lights.sort_by(|a, b| a.name.cmp(&b.name));
    block(&mut out, "lights", lights.into_iter().map(|l| (&l.name, light(l))));
    let mut objects: Vec<&Object> = scene.objects.iter().collect();
    objects.sort_by(|a, b| a.name.cmp(&b.name));
    block(&mut out, "objects", objects.into_iter().map(|o| (&o.name, object(o))));
    let mut rest = Fields::default();
    rest.unknown(&scene.unknown);
    out + &rest.lines(1) + ")\n"
}

/// Fields in order, each as `name: value`.
#[derive(Default)]
struct Fields(Vec<String>);

impl Fields {
    fn add(&mut self, name: &str, value: String) {
        self.0.push(format!("{name}: {value}"));
    }

    fn text(&mut self, name: &str, value: &str) {
        if !value.is_empty() {
            self.add(name, text(value));
        }
    }

    /// Left out where it equals the default.
    fn other<T: PartialEq>(&mut self, name: &str, value: T, default: T, write: impl Fn(T) -> String) {
        if value != default {
            self.add(name, write(value));
        }
    }

    fn unknown(&mut self, unknown: &Unknown) {
        for (name, value) in unknown {
            self.add(&identifier(name), inline(value));
        }
    }

    fn lines(&self, level: usize) -> String {
        self.0.iter().map(|field| format!("{}{field},\n", "    ".repeat(level))).collect()
    }

    fn inline(&self) -> String {
        format!("({})", self.0.join(", "))
    }
}

fn block<'a>(out: &mut String, field: &str, items: impl Iterator<Item = (&'a String, Fields)>) {
    let mut items = items.peekable();
    if items.peek().is_none() {
        return;
    }
    *out += &format!("    {field}: {{\n");
    for (name, fields) in items {
        *out += &format!("        {}: (\n{}        ),\n", text(name), fields.lines(3));
    }
    *out += "    },\n";
}

fn tuple<const N: usize>(numbers: [f64; N]) -> String {
    format!("({})", numbers.map(number).join(", "))
}

fn camera(camera: &CameraSettings) -> String {
    let d = CameraSettings::default();
    let mut fields = Fields::default();
    fields.add("position", tuple(camera.position));
    fields.add("target", tuple(camera.target));
    fields.other("up", camera.up, d.up, tuple);
    fields.add("fov", number(camera.fov));
    fields.other("near", camera.near, d.near, number);
    fields.other("far", camera.far, d.far, number);
    fields.unknown(&camera.unknown);
    fields.inline()
}

fn environment(environment: &Environment) -> String {
    match environment {
        Environment::Color(color) => format!("Color{}", tuple(*color)),
        Environment::Sky(sky) => {
            let d = Sky::default();
            let mut fields = Fields::default();
            fields.other("zenith", sky.zenith, d.zenith, tuple);
            fields.other("horizon", sky.horizon, d.horizon, tuple);
            fields.other("ground", sky.ground, d.ground, tuple);
            fields.other("sun_direction", sky.sun_direction, d.sun_direction, tuple);
            fields.other("sun_glow", sky.sun_glow, d.sun_glow, tuple);
            fields.other("intensity", sky.intensity, d.intensity, number);
            format!("Sky{}", fields.inline())
        }
        Environment::Image { image, rotation, intensity } => {
            let mut fields = Fields::default();
            fields.add("path", text(&image.path));
            fields.other("rotation", *rotation, 0.0, number);
            fields.other("intensity", *intensity, 1.0, number);
            format!("Image{}", fields.inline())
        }
    }
}

fn light(light: &LightInstance) -> Fields {
    let mut fields = Fields::default();
    fields.text("note", &light.note);
    fields.add("graph", text(&light.graph.path));
    settings(&mut fields, &light.set);
    fields.unknown(&light.unknown);
    fields
}

fn object(object: &Object) -> Fields {
    let d = Transform::default();
    let mut fields = Fields::default();
    fields.text("note", &object.note);
    fields.add("shape", shape(&object.shape));
    fields.add("surface", text(&object.surface.path));
    settings(&mut fields, &object.set);
    fields.other("translate", object.transform.translate, d.translate, tuple);
    fields.other("rotate", object.transform.rotate, d.rotate, tuple);
    fields.other("scale", object.transform.scale, d.scale, |s| if s == [s[0]; 3] { number(s[0]) } else { tuple(s) });
    fields.other("casts", object.casts, true, |b| b.to_string());
    fields.other("receives", object.receives, true, |b| b.to_string());
    fields.unknown(&object.unknown);
    fields
}

fn settings(fields: &mut Fields, settings: &Settings) {
    let items: Vec<String> = settings
        .iter()
        .map(|(name, setting)| {
            let value = match &setting.value {
                Value::Bool(b) => b.to_string(),
                Value::Text(t) => text(t),
                Value::Numbers(n) => match n.as_slice() {
                    [one] => number(*one),
                    many => format!("({})", many.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", ")),
                },
            };
            format!("{}: {value}", text(name))
        })
        .collect();
    if !items.is_empty() {
        fields.add("set", format!("{{{}}}", items.join(", ")));
    }
}

fn shape(shape: &Shape) -> String {
    let mut fields = Fields::default();
    let whole = |n: u32| n.to_string();
    match shape {
        Shape::Plane { size, segments } => {
            fields.add("size", tuple(*size));
            fields.other("segments", *segments, [1; 2], |n| tuple(n.map(f64::from)));
        }
        Shape::Box { size, bevel } => {
            fields.add("size", tuple(*size));
            fields.other("bevel", *bevel, 0.0, number);
        }
        Shape::Sphere { radius, segments } => {
            fields.add("radius", number(*radius));
            fields.other("segments", *segments, Shape::SPHERE_SEGMENTS, whole);
        }
        Shape::Cylinder { radius, height, capped, segments } => {
            fields.add("radius", number(*radius));
            fields.add("height", number(*height));
            fields.other("capped", *capped, true, |b| b.to_string());
            fields.other("segments", *segments, Shape::CYLINDER_SEGMENTS, whole);
        }
        Shape::Torus { major, minor, segments } => {
            fields.add("major", number(*major));
            fields.add("minor", number(*minor));
            fields.other("segments", *segments, Shape::TORUS_SEGMENTS, whole);
        }
        Shape::Obj(file) => return format!("Obj({})", text(&file.path)),
    }
    format!("{}{}", shape.name(), fields.inline())
}
