//! What the picture costs, and what each kind of shadow would: error against time, to pick from.

use eframe::egui::{self, Ui};
use egui_plot::{Legend, MarkerShape, Plot, PlotPoints, Points, Text};

use super::feed::Feed;
use super::preview::Preview;
use crate::preview::Point;

/// What the panel asks of the rest of the editor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Wish {
    /// Measure every kind of shadow on this light.
    Measure(String),
    Cancel,
    /// Make the shadow of this light one of this kind.
    Use {
        light: String,
        kind: String,
    },
}

/// State of the panel alone.
#[derive(Default)]
pub(super) struct Panel {
    light: Option<String>,
}

/// Least error that the chart tells from none.
const FLOOR: f64 = 1e-5;

impl Panel {
    pub(super) fn show(&mut self, ui: &mut Ui, feed: &Feed, preview: &Preview) -> Vec<Wish> {
        let mut wishes = Vec::new();
        let width = ui.available_width();
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                ui.set_width((width * 0.32).max(220.0));
                passes(ui, feed, preview);
            });
            ui.separator();
            ui.vertical(|ui| self.chart(ui, feed, preview, &mut wishes));
        });
        wishes
    }

    fn chart(&mut self, ui: &mut Ui, feed: &Feed, preview: &Preview, wishes: &mut Vec<Wish>) {
        let lights: Vec<String> = preview.image.as_ref().map(|i| i.lights.clone()).unwrap_or_default();
        if lights.is_empty() {
            ui.weak("Shadows are compared where a light has one. Add a light and a shadow.");
            return;
        }
        let light = self.light.clone().filter(|l| lights.contains(l)).unwrap_or_else(|| lights[0].clone());
        ui.horizontal(|ui| {
            let label = ui.label("Shadows on");
            let combo = egui::ComboBox::from_id_salt("measured light").selected_text(&light).show_ui(ui, |ui| {
                for offered in &lights {
                    if ui.selectable_label(*offered == light, offered).clicked() {
                        self.light = Some(offered.clone());
                    }
                }
            });
            combo.response.labelled_by(label.id);
            if feed.measuring {
                if ui.button("Cancel").clicked() {
                    wishes.push(Wish::Cancel);
                }
                ui.spinner();
                ui.label(format!("{} measured", feed.points.len()));
            } else if ui
                .button("Measure")
                .on_hover_text("Renders every kind of shadow against the ray-traced truth")
                .clicked()
            {
                wishes.push(Wish::Measure(light.clone()));
            }
            if let Some(best) = best(&feed.points) {
                ui.weak(format!("least error: {best}"));
            }
        });
        if feed.points.is_empty() {
            ui.weak(
                "Measure to see the error of each kind of shadow against its time. A click on a point uses that kind.",
            );
            return;
        }
        let points = placed(&feed.points);
        let dark = ui.visuals().dark_mode;
        let plot = Plot::new("error against time")
            .legend(Legend::default().position(egui_plot::Corner::RightTop))
            .x_axis_label("time of all passes, ms")
            .y_axis_label("error (RMSE)")
            .x_axis_formatter(|mark, _| power(mark.value))
            .y_axis_formatter(|mark, _| power(mark.value))
            .show_grid(true)
            .allow_scroll(false);
        let front = front(&feed.points);
        let response = plot.show(ui, |plot| {
            for (i, (point, [x, y])) in points.iter().enumerate() {
                let on_front = front.contains(&point.kind);
                let color = if on_front { color(i) } else { egui::Color32::GRAY };
                plot.points(
                    Points::new(point.kind.clone(), PlotPoints::from(vec![[*x, *y]]))
                        .radius(if on_front { 7.0 } else { 5.0 })
                        .shape(shape(i))
                        .color(color),
                );
                let ink = if dark { egui::Color32::from_gray(220) } else { egui::Color32::from_gray(30) };
                plot.text(
                    Text::new(
                        String::new(),
                        [*x, *y].into(),
                        egui::RichText::new(format!("  {}", point.kind.trim_end_matches("_shadow"))).color(ink),
                    )
                    .anchor(egui::Align2::LEFT_CENTER),
                );
            }
            plot.response().clicked().then(|| plot.pointer_coordinate()).flatten().map(|p| (p, *plot.transform()))
        });
        if let Some((at, transform)) = response.inner {
            let clicked = transform.position_from_point(&at);
            let far = |p: &[f64; 2]| {
                (transform.position_from_point(&egui_plot::PlotPoint::new(p[0], p[1])) - clicked).length()
            };
            let near = points.iter().min_by(|a, b| far(&a.1).total_cmp(&far(&b.1)));
            if let Some((point, place)) = near
                && far(place) < 14.0
            {
                wishes.push(Wish::Use { light, kind: point.kind.clone() });
            }
        }
        // The same without a pointer.
        ui.horizontal_wrapped(|ui| {
            ui.label("Use");
            for point in &feed.points {
                if ui.small_button(point.kind.trim_end_matches("_shadow")).on_hover_text(told(point)).clicked() {
                    wishes.push(Wish::Use {
                        light: self.light.clone().filter(|l| lights.contains(l)).unwrap_or_else(|| lights[0].clone()),
                        kind: point.kind.clone(),
                    });
                }
            }
        });
    }
}

fn passes(ui: &mut Ui, feed: &Feed, preview: &Preview) {
    let Some(image) = &preview.image else {
        ui.weak("No picture yet.");
        return;
    };
    let software = if image.software { ", computed on the CPU: it says nothing about graphics cards" } else { "" };
    ui.label(format!("On {}{software}", image.adapter));
    egui::ScrollArea::vertical().auto_shrink([false, true]).id_salt("passes").show(ui, |ui| {
        egui::Grid::new("passes").striped(true).num_columns(2).show(ui, |ui| {
            for pass in &image.timings {
                ui.label(&pass.name);
                ui.monospace(pass.milliseconds.map_or_else(|| "kept".into(), |ms| format!("{ms:8.3} ms")));
                ui.end_row();
            }
            for (name, ms) in [
                ("weave and prove", feed.compile_ms),
                ("picture in all", image.milliseconds),
                ("change to picture", feed.latency_ms),
            ] {
                ui.weak(name);
                ui.monospace(format!("{ms:8.3} ms"));
                ui.end_row();
            }
            ui.weak("pipelines built so far");
            ui.monospace(image.pipelines_built.to_string());
            ui.end_row();
        });
    });
}

/// Points on log axes; those without a time are left out.
fn placed(points: &[Point]) -> Vec<(&Point, [f64; 2])> {
    points.iter().filter_map(|p| Some((p, [p.milliseconds?.max(1e-4).log10(), p.rmse.max(FLOOR).log10()]))).collect()
}

/// Kinds that no other beats in both time and error.
fn front(points: &[Point]) -> Vec<String> {
    let beats = |a: &Point, b: &Point| {
        let (ta, tb) = (a.milliseconds.unwrap_or(f64::INFINITY), b.milliseconds.unwrap_or(f64::INFINITY));
        ta <= tb && a.rmse <= b.rmse && (ta < tb || a.rmse < b.rmse)
    };
    points.iter().filter(|p| !points.iter().any(|q| beats(q, p))).map(|p| p.kind.clone()).collect()
}

fn best(points: &[Point]) -> Option<&str> {
    points.iter().min_by(|a, b| a.rmse.total_cmp(&b.rmse)).map(|p| p.kind.as_str())
}

fn told(point: &Point) -> String {
    let time = point.milliseconds.map_or_else(|| "unknown time".to_owned(), |ms| format!("{ms:.2} ms"));
    format!("{}: RMSE {:.5}, {time}", point.kind, point.rmse)
}

/// A power of ten as a number.
fn power(log: f64) -> String {
    let x = 10_f64.powf(log);
    if x >= 1.0 { format!("{x:.0}") } else { format!("{x:.*}", (-log.floor()).clamp(1.0, 6.0) as usize) }
}

/// Colours that are told apart without red and green.
fn color(i: usize) -> egui::Color32 {
    const COLORS: [(u8, u8, u8); 7] = [
        (0xe6, 0x9f, 0x00),
        (0x56, 0xb4, 0xe9),
        (0x00, 0x9e, 0x73),
        (0xf0, 0xe4, 0x42),
        (0x00, 0x72, 0xb2),
        (0xd5, 0x5e, 0x00),
        (0xcc, 0x79, 0xa7),
    ];
    let (r, g, b) = COLORS[i % COLORS.len()];
    egui::Color32::from_rgb(r, g, b)
}

fn shape(i: usize) -> MarkerShape {
    MarkerShape::all().nth(i % MarkerShape::all().count()).unwrap_or(MarkerShape::Circle)
}
