//! The picture of what is being made: looked at from all sides, in several ways, with lights that can be dragged.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::Duration;

use eframe::egui::{
    self, Align2, Color32, FontId, PointerButton, Pos2, Rect, Sense, Stroke, StrokeKind, Ui, pos2, vec2,
};
use glam::{Vec2, Vec3};

use super::canvas::Subgraphs;
use super::tab::Tab;
use super::theme::Look as Theme;
use super::values;
use crate::compile::Output;
use crate::graph::Edit;
use crate::node::Catalog;
use crate::preview::{Image, Look, Show};
use crate::scene::environment::Sky;
use crate::scene::{Camera, Environment};
use crate::semantic::Value;
use crate::studio::Shown;

/// A number of a file as the screen needs it.
#[allow(clippy::cast_possible_truncation, reason = "what is shown needs no more")]
pub(super) fn narrow(x: f64) -> f32 {
    x as f32
}

/// How the preview is looked at.
pub(super) struct Preview {
    pub(super) look: Look,
    /// What the graph is shown on where no scene is.
    pub(super) shape: Shown,
    /// The scene that is shown instead of the stage.
    pub(super) scene: Option<PathBuf>,
    /// What lies around it by wish, with its name; none for what the scene or the stage has.
    pub(super) around: Option<(String, Environment)>,
    /// Where a person has gone; none where the scene's own camera is.
    pub(super) camera: Option<Camera>,
    pub(super) paused: bool,
    /// Points of the panel per pixel of the picture.
    pub(super) coarse: f32,
    pub(super) samples: u32,
    /// Size of the picture to ask for.
    pub(super) size: (u32, u32),
    pub(super) time: f32,
    /// Whether time goes on.
    pub(super) plays: bool,
    /// The latest picture.
    pub(super) image: Option<Image>,
    pub(super) texture: Option<egui::TextureHandle>,
    /// Why there is no newer picture.
    pub(super) failure: Option<(String, Option<String>)>,
    pub(super) held_light: Option<(String, f32)>,
}

impl Default for Preview {
    fn default() -> Self {
        Self {
            look: Look::Output(Output::Radiance),
            shape: Shown::Sphere,
            scene: None,
            around: None,
            camera: None,
            paused: false,
            coarse: 1.0,
            samples: 4,
            size: (480, 320),
            time: 0.0,
            plays: false,
            image: None,
            texture: None,
            failure: None,
            held_light: None,
        }
    }
}

/// What the preview asks of the rest of the editor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Wish {
    /// Choose a scene to show.
    OpenScene,
    /// Choose a model to show the graph on.
    OpenModel,
    /// Choose a picture of surroundings.
    OpenSurroundings,
    /// Leave the picture that is being made behind.
    Abandon,
}

impl Preview {
    /// Takes a new picture.
    pub(super) fn take(&mut self, ctx: &egui::Context, image: Image) {
        let (width, height) = (image.size.0 as usize, image.size.1 as usize);
        if image.rgba.len() != width * height * 4 || width == 0 {
            return;
        }
        let pixels = egui::ColorImage::from_rgba_unmultiplied([width, height], &image.rgba);
        match &mut self.texture {
            Some(texture) => texture.set(pixels, egui::TextureOptions::LINEAR),
            None => self.texture = Some(ctx.load_texture("preview", pixels, egui::TextureOptions::LINEAR)),
        }
        self.failure = None;
        self.image = Some(image);
    }

    /// What is to be shown, for graphs by these paths.
    pub(super) fn show_what(&self, graph: PathBuf) -> Show {
        match &self.scene {
            Some(scene) => Show::Scene(scene.clone()),
            None => Show::Stage { shape: self.shape.clone(), graphs: vec![graph] },
        }
    }

    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        tab: Option<&mut Tab>,
        catalog: &Catalog,
        subgraphs: Subgraphs<'_>,
        busy: Option<Duration>,
    ) -> Vec<Wish> {
        let mut wishes = Vec::new();
        // The panel keeps the height that it was given.
        ui.set_min_height(ui.available_height());
        self.controls(ui, &mut wishes);
        let room = ui.available_size() - vec2(0.0, 22.0);
        let (rect, response) = ui.allocate_exact_size(room.max(vec2(60.0, 40.0)), Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Image, true, "Preview"));
        let pixels = rect.size() * ui.ctx().pixels_per_point() / self.coarse.max(0.25);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a size of a panel")]
        {
            // Steps of 16 keep a panel that is being resized from asking for a picture a frame.
            self.size = ((pixels.x as u32 / 16 * 16).clamp(32, 2048), (pixels.y as u32 / 16 * 16).clamp(32, 2048));
        }
        let theme = Theme::of(ui.visuals());
        ui.painter().rect_filled(rect, 0.0, Color32::from_gray(if theme.dark { 12 } else { 60 }));
        let picture = self.picture_rect(rect);
        if let Some(texture) = &self.texture {
            ui.painter().image(texture.id(), picture, Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0)), Color32::WHITE);
        }
        let mut held = false;
        if let Some(tab) = tab {
            held = self.lights(ui, tab, catalog, subgraphs, picture, &response);
        }
        if !held {
            self.steer(ui, &response, rect);
        }
        self.overlay(ui, rect, busy, &theme, &mut wishes);
        wishes
    }

    /// Where the picture lies: its shape is kept while the panel changes.
    fn picture_rect(&self, rect: Rect) -> Rect {
        let Some(image) = &self.image else { return rect };
        let size = vec2(
            f32::from(u16::try_from(image.size.0).unwrap_or(1)),
            f32::from(u16::try_from(image.size.1).unwrap_or(1)),
        );
        let scale = (rect.width() / size.x).min(rect.height() / size.y);
        Rect::from_center_size(rect.center(), size * scale)
    }

    fn controls(&mut self, ui: &mut Ui, wishes: &mut Vec<Wish>) {
        ui.horizontal_wrapped(|ui| {
            let label = ui.label("Look at");
            let combo = egui::ComboBox::from_id_salt("look").selected_text(name_of(&self.look)).width(150.0).show_ui(
                ui,
                |ui| {
                    for look in self.looks() {
                        let name = name_of(&look);
                        if ui.selectable_label(look == self.look, name).clicked() {
                            self.look = look;
                        }
                    }
                },
            );
            combo.response.labelled_by(label.id);
            let label = ui.label("on");
            let combo =
                egui::ComboBox::from_id_salt("shape").selected_text(self.shape_name()).width(100.0).show_ui(ui, |ui| {
                    for (name, shape) in shapes() {
                        if ui.selectable_label(self.scene.is_none() && self.shape == shape, name).clicked() {
                            (self.shape, self.scene, self.camera) = (shape, None, None);
                        }
                    }
                    if ui.selectable_label(false, "Model…").clicked() {
                        wishes.push(Wish::OpenModel);
                    }
                    if ui.selectable_label(self.scene.is_some(), "Scene…").clicked() {
                        wishes.push(Wish::OpenScene);
                    }
                });
            combo.response.labelled_by(label.id);
            // Lists do not go on to the next row by themselves.
            ui.end_row();
            self.surroundings(ui, wishes);
            let label = ui.label("Scale");
            let combo = egui::ComboBox::from_id_salt("coarse")
                .selected_text(format!("1/{}", self.coarse))
                .width(46.0)
                .show_ui(ui, |ui| {
                    for coarse in [1.0, 2.0, 4.0] {
                        ui.selectable_value(&mut self.coarse, coarse, format!("1/{coarse}"));
                    }
                });
            combo.response.labelled_by(label.id);
            ui.toggle_value(&mut self.paused, "Pause");
            if ui.toggle_value(&mut self.plays, "Play").on_hover_text("Lets time go on for animated nodes").changed()
                && !self.plays
            {
                self.time = 0.0;
            }
            if ui.add_enabled(self.camera.is_some(), egui::Button::new("Reset view")).clicked() {
                self.camera = None;
            }
        });
    }

    /// What lies around.
    fn surroundings(&mut self, ui: &mut Ui, wishes: &mut Vec<Wish>) {
        let label = ui.label("in").on_hover_text("What lies around: it lights, and shows in reflections");
        let own = "Own sky";
        let shown = self.around.as_ref().map_or(own, |(name, _)| name.as_str()).to_owned();
        let combo = egui::ComboBox::from_id_salt("around").selected_text(&shown).width(70.0).show_ui(ui, |ui| {
            if ui.selectable_label(self.around.is_none(), own).clicked() {
                self.around = None;
            }
            for (name, environment) in environments() {
                if ui.selectable_label(shown == name, name).clicked() {
                    self.around = Some((name.to_owned(), environment));
                }
            }
            if ui.selectable_label(false, "Picture…").clicked() {
                wishes.push(Wish::OpenSurroundings);
            }
        });
        combo.response.labelled_by(label.id);
    }

    /// The ways to look at it: those that depend on a light for each light.
    fn looks(&self) -> Vec<Look> {
        let mut looks = vec![Look::Output(Output::Radiance), Look::Output(Output::Normal), Look::Output(Output::Depth)];
        let lights: BTreeSet<&String> = self.image.iter().flat_map(|i| &i.lights).collect();
        for light in lights {
            looks.push(Look::Output(Output::Visibility(light.clone())));
            looks.push(Look::Output(Output::Irradiance(light.clone())));
            looks.push(Look::Map { light: light.clone(), index: 0 });
            looks.push(Look::Error { light: light.clone() });
        }
        if !looks.contains(&self.look) {
            looks.push(self.look.clone());
        }
        looks
    }

    fn shape_name(&self) -> String {
        match &self.scene {
            Some(scene) => scene.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned()),
            None => shapes().into_iter().find(|(_, s)| *s == self.shape).map_or("Model", |(n, _)| n).to_owned(),
        }
    }

    /// Orbit, pan and dolly.
    fn steer(&mut self, ui: &Ui, response: &egui::Response, rect: Rect) {
        let Some(image) = &self.image else { return };
        let mut camera = self.camera.unwrap_or(image.camera);
        let before = camera;
        let delta = response.drag_delta();
        let shift = ui.input(|i| i.modifiers.shift);
        if response.dragged_by(PointerButton::Middle)
            || response.dragged_by(PointerButton::Secondary)
            || (shift && response.dragged_by(PointerButton::Primary))
        {
            pan(&mut camera, delta / rect.height());
        } else if response.dragged_by(PointerButton::Primary) {
            orbit(&mut camera, delta / rect.height());
        }
        if response.hovered() {
            let scroll = ui.input(|i| i.smooth_scroll_delta().y);
            dolly(&mut camera, (-scroll * 0.003).exp());
        }
        if response.has_focus() {
            let step = |key| ui.input(|i| i.key_pressed(key));
            let turn = |on: bool, x: f32, y: f32| if on { vec2(x, y) } else { vec2(0.0, 0.0) };
            let by = turn(step(egui::Key::ArrowLeft), -0.05, 0.0)
                + turn(step(egui::Key::ArrowRight), 0.05, 0.0)
                + turn(step(egui::Key::ArrowUp), 0.0, -0.05)
                + turn(step(egui::Key::ArrowDown), 0.0, 0.05);
            orbit(&mut camera, by);
        }
        if response.double_clicked() {
            self.camera = None;
        } else if camera != before {
            self.camera = Some(camera);
        }
    }

    /// Handles of the lights; true while one is held.
    fn lights(
        &mut self,
        ui: &Ui,
        tab: &mut Tab,
        catalog: &Catalog,
        subgraphs: Subgraphs<'_>,
        picture: Rect,
        response: &egui::Response,
    ) -> bool {
        let Some(image) = &self.image else { return false };
        if !matches!(self.look, Look::Output(_)) {
            return false;
        }
        let camera = image.camera;
        let theme = Theme::of(ui.visuals());
        let graph = tab.document.graph();
        let lights: Vec<String> =
            graph.nodes.iter().filter(|(_, n)| n.kind.ends_with("_light")).map(|(n, _)| n.clone()).collect();
        let pointer = response.hover_pos().or_else(|| response.interact_pointer_pos());
        let mut near = None;
        for name in lights {
            let view = tab.cards.view(tab.document.graph(), catalog, subgraphs, &name);
            let Some(port) = view.inputs.iter().find(|p| p.name == "position" && !p.linked) else { continue };
            let Some(Value::Numbers(n)) = values::current(port) else { continue };
            let [x, y, z] = n[..] else { continue };
            let place = Vec3::new(narrow(x), narrow(y), narrow(z));
            let Some((spot, depth)) = project(&camera, place, picture) else { continue };
            let hot = pointer.is_some_and(|p| (p - spot).length() < 12.0)
                || self.held_light.as_ref().is_some_and(|(n, _)| *n == name);
            if picture.contains(spot) {
                ui.painter().circle(
                    spot,
                    if hot { 9.0 } else { 6.0 },
                    Color32::from_rgb(0xf2, 0xb8, 0x3d),
                    Stroke::new(1.5, Color32::BLACK),
                );
                if hot {
                    ui.painter().text(
                        spot + vec2(12.0, 0.0),
                        Align2::LEFT_CENTER,
                        &name,
                        FontId::proportional(13.0),
                        theme.selected,
                    );
                }
            }
            if hot && near.is_none() {
                near = Some((name, depth));
            }
        }
        if response.drag_started_by(PointerButton::Primary) {
            self.held_light = near;
        }
        let Some((name, depth)) = self.held_light.clone() else { return false };
        if response.dragged_by(PointerButton::Primary)
            && let Some(p) = response.interact_pointer_pos()
        {
            let place = unproject(&camera, p, depth, picture);
            let round = |x: f32| (f64::from(x) * 1e3).round() / 1e3;
            let value = Some(Value::Numbers(vec![round(place.x), round(place.y), round(place.z)]));
            let edit = Edit::SetParam { node: name.clone(), param: "position".into(), value };
            let _ = tab.document.gesture("Move light", &format!("move light {name}"), edit);
        }
        if response.drag_stopped() {
            self.held_light = None;
            tab.document.end_gesture();
        }
        true
    }

    /// What is to be known about the picture, over it and under it.
    fn overlay(&self, ui: &mut Ui, rect: Rect, busy: Option<Duration>, theme: &Theme, wishes: &mut Vec<Wish>) {
        let painter = ui.painter_at(rect);
        let mut lines: Vec<(String, Color32)> = Vec::new();
        if let Some((message, help)) = &self.failure {
            lines.push((message.clone(), theme.error));
            lines.extend(help.iter().map(|h| (h.clone(), Color32::WHITE)));
        }
        if let Some(busy) = busy.filter(|b| b.as_millis() > 700) {
            lines.push((format!("rendering for {:.1} s", busy.as_secs_f32()), Color32::WHITE));
        }
        if let Some((name, number)) = self.image.as_ref().and_then(|i| i.number.as_ref()) {
            lines.push((format!("{name} {number:.5}"), Color32::WHITE));
        }
        let mut y = rect.top() + 8.0;
        for (text, color) in lines {
            let galley = painter.layout(text, FontId::proportional(13.0), color, rect.width() - 24.0);
            let back = Rect::from_min_size(pos2(rect.left() + 8.0, y), galley.size() + vec2(10.0, 6.0));
            painter.rect(back, 4.0, Color32::from_black_alpha(190), Stroke::NONE, StrokeKind::Inside);
            y = back.bottom() + 4.0;
            painter.galley(back.min + vec2(5.0, 3.0), galley, color);
        }
        ui.horizontal(|ui| {
            if busy.is_some_and(|b| b.as_secs() >= 4) && ui.button("Give up on this picture").clicked() {
                wishes.push(Wish::Abandon);
            }
            if let Some(image) = &self.image {
                let software = if image.software { " (software)" } else { "" };
                let text = format!(
                    "{} × {}, {:.0} ms on {}{software}",
                    image.size.0, image.size.1, image.milliseconds, image.adapter
                );
                ui.add(egui::Label::new(egui::RichText::new(text).weak().small()).truncate());
            } else {
                ui.weak("No picture yet.");
            }
        });
    }
}

/// Surroundings that need no file.
fn environments() -> [(&'static str, Environment); 4] {
    let dusk = Sky {
        zenith: [0.05, 0.07, 0.16],
        horizon: [0.55, 0.25, 0.12],
        ground: [0.04, 0.03, 0.03],
        sun_direction: [0.8, 0.08, -0.6],
        sun_glow: [3.0, 1.1, 0.3],
        intensity: 1.0,
    };
    [
        ("Day", Environment::Sky(Sky::default())),
        ("Dusk", Environment::Sky(dusk)),
        ("White room", Environment::Color([0.8; 3])),
        ("Darkness", Environment::Color([0.0; 3])),
    ]
}

fn shapes() -> [(&'static str, Shown); 5] {
    [
        ("Ball", Shown::Sphere),
        ("Cube", Shown::Cube),
        ("Plane", Shown::Plane),
        ("Cylinder", Shown::Cylinder),
        ("Torus", Shown::Torus),
    ]
}

/// What a way to look is called.
pub(super) fn name_of(look: &Look) -> String {
    match look {
        Look::Output(Output::Radiance) => "Picture".into(),
        Look::Output(Output::Normal) => "Normals".into(),
        Look::Output(Output::Depth) => "Depth".into(),
        Look::Output(Output::Visibility(light)) => format!("Visibility of {light}"),
        Look::Output(Output::Irradiance(light)) => format!("Irradiance of {light}"),
        Look::Map { light, .. } => format!("Shadow map of {light}"),
        Look::Error { light } => format!("Error of {light}"),
        Look::Node { node, .. } => format!("Node {node}"),
    }
}

/// Turns around the target; a whole height of the panel is half a turn.
fn orbit(camera: &mut Camera, by: egui::Vec2) {
    if by == egui::Vec2::ZERO {
        return;
    }
    let arm = camera.position - camera.target;
    let up = camera.up.normalize_or(Vec3::Y);
    let around = glam::Quat::from_axis_angle(up, -by.x * std::f32::consts::PI);
    let arm = around * arm;
    let right = up.cross(arm).normalize_or(Vec3::X);
    let tilted = glam::Quat::from_axis_angle(right, -by.y * std::f32::consts::PI) * arm;
    // Not over the poles.
    let steep = tilted.normalize_or(Vec3::Z).dot(up).abs();
    camera.position = camera.target + if steep < 0.995 { tilted } else { arm };
}

/// Moves eye and target across the view.
fn pan(camera: &mut Camera, by: egui::Vec2) {
    let forward = (camera.target - camera.position).normalize_or(Vec3::NEG_Z);
    let right = forward.cross(camera.up).normalize_or(Vec3::X);
    let up = right.cross(forward);
    let height = 2.0 * (camera.fov_y / 2.0).tan() * (camera.target - camera.position).length();
    let shift = (right * -by.x + up * by.y) * height;
    camera.position += shift;
    camera.target += shift;
}

/// Moves the eye nearer to the target, or away.
fn dolly(camera: &mut Camera, factor: f32) {
    let arm = camera.position - camera.target;
    let length = (arm.length() * factor).clamp(camera.near * 2.0, camera.far * 0.5);
    if (factor - 1.0).abs() > 1e-4 && length.is_finite() {
        camera.position = camera.target + arm.normalize_or(Vec3::Z) * length;
    }
}

fn axes(camera: &Camera) -> (Vec3, Vec3, Vec3) {
    let forward = (camera.target - camera.position).normalize_or(Vec3::NEG_Z);
    let right = forward.cross(camera.up).normalize_or(Vec3::X);
    (right, right.cross(forward), forward)
}

/// Where a point of the world is seen, and its distance along the view; none behind the eye.
fn project(camera: &Camera, place: Vec3, picture: Rect) -> Option<(Pos2, f32)> {
    let (right, up, forward) = axes(camera);
    let offset = place - camera.position;
    let depth = offset.dot(forward);
    if depth <= camera.near {
        return None;
    }
    let half = (camera.fov_y / 2.0).tan();
    let at = Vec2::new(offset.dot(right), offset.dot(up)) / (depth * half);
    Some((picture.center() + vec2(at.x, -at.y) * picture.height() / 2.0, depth))
}

/// The point of the world at a distance along the view that is seen at a place.
fn unproject(camera: &Camera, p: Pos2, depth: f32, picture: Rect) -> Vec3 {
    let (right, up, forward) = axes(camera);
    let half = (camera.fov_y / 2.0).tan();
    let at = (p - picture.center()) * 2.0 / picture.height() * half * depth;
    camera.position + forward * depth + right * at.x - up * at.y
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera {
            position: Vec3::new(1.0, 2.0, 5.0),
            target: Vec3::new(0.0, 0.5, 0.0),
            up: Vec3::Y,
            fov_y: 0.6,
            near: 0.1,
            far: 100.0,
        }
    }

    #[test]
    fn there_and_back() {
        let picture = Rect::from_min_size(pos2(10.0, 20.0), vec2(300.0, 200.0));
        let place = Vec3::new(0.4, 1.0, -0.7);
        let (spot, depth) = project(&camera(), place, picture).expect("before the eye");
        assert!((unproject(&camera(), spot, depth, picture) - place).length() < 1e-4);
        assert!(project(&camera(), Vec3::new(2.0, 4.0, 20.0), picture).is_none());
        let (center, _) = project(&camera(), camera().target, picture).expect("before the eye");
        assert!((center - picture.center()).length() < 1e-3);
    }

    #[test]
    fn turning_keeps_the_distance() {
        let mut turned = camera();
        for _ in 0..50 {
            orbit(&mut turned, vec2(0.13, 0.31));
        }
        let far = |c: &Camera| (c.position - c.target).length();
        assert!((far(&turned) - far(&camera())).abs() < 1e-3);
        assert!(turned.position.is_finite());
        dolly(&mut turned, 0.5);
        assert!((far(&turned) * 2.0 - far(&camera())).abs() < 1e-3);
    }
}
