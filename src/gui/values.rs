//! One widget for each sort of value: colours, angles, lengths, positions, files, choices.

use eframe::egui::{self, Color32, DragValue, Id, Slider, Ui};

use crate::node;
use crate::semantic::{Kind, Shape, Value};
use crate::view::PortView;

/// What a person did to a value.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Changed {
    /// The new value.
    pub(super) value: Option<Value>,
    /// Whether more of the same gesture may follow.
    pub(super) going_on: bool,
    /// Whether a file is to be chosen.
    pub(super) browse: bool,
}

/// A colour of a file, which is linear, as the screen shows it.
#[allow(clippy::cast_possible_truncation, reason = "colours need no more")]
pub(super) fn shown_color(linear: &[f64]) -> Color32 {
    let channel = |i: usize| linear.get(i).copied().unwrap_or(0.0).clamp(0.0, 1.0) as f32;
    egui::Rgba::from_rgb(channel(0), channel(1), channel(2)).into()
}

/// The value that a port has now: its own, or its default.
pub(super) fn current(port: &PortView) -> Option<Value> {
    let default = match &port.default {
        Some(node::Default::Value(value)) => Some(value.clone()),
        Some(node::Default::Source(_)) | None => None,
    };
    port.value.clone().or(default)
}

/// What is shown for a value that was never said.
fn blank(shape: &Shape) -> Option<Value> {
    Some(match shape {
        Shape::Bool => Value::Bool(false),
        Shape::I32 | Shape::U32 => Value::Numbers(vec![0.0]),
        Shape::F32(n) => Value::Numbers(vec![0.0; usize::from(*n)]),
        Shape::Matrix(n) => Value::Numbers(
            (0..usize::from(*n).pow(2)).map(|i| f64::from(u8::from(i % (usize::from(*n) + 1) == 0))).collect(),
        ),
        Shape::Generic => Value::Numbers(vec![0.0]),
        Shape::Texture => Value::Text(String::new()),
        Shape::DepthTexture | Shape::Sampler | Shape::ComparisonSampler | Shape::Named(_) => return None,
    })
}

/// Shows the value of a port and lets a person change it. `label` is the widget that names it.
pub(super) fn edit(ui: &mut Ui, port: &PortView, label: Id) -> Changed {
    let mut changed = Changed::default();
    let Some(mut value) = current(port).or_else(|| blank(&port.ty.shape)) else {
        ui.weak("made by the compiler");
        return changed;
    };
    // One number stands for every component.
    if let (Value::Numbers(n), Shape::F32(width)) = (&mut value, &port.ty.shape)
        && n.len() == 1
        && *width > 1
    {
        *n = vec![n[0]; usize::from(*width)];
    }
    match &mut value {
        Value::Bool(b) => {
            let response = ui.checkbox(b, "").labelled_by(label);
            changed.value = response.changed().then_some(value);
        }
        Value::Text(text) => {
            ui.horizontal(|ui| {
                let room = ui.available_width() - 34.0;
                let response = ui
                    .add(egui::TextEdit::singleline(text).desired_width(room).hint_text("path of a picture"))
                    .labelled_by(label);
                if response.changed() {
                    changed.value = Some(Value::Text(text.clone()));
                    changed.going_on = true;
                }
                changed.browse = ui.button("…").on_hover_text("Choose a file").clicked();
            });
        }
        Value::Numbers(numbers) => {
            if numbers_edit(ui, port, numbers, label, &mut changed.going_on) {
                changed.value = Some(Value::Numbers(numbers.clone()));
            }
        }
    }
    changed
}

fn numbers_edit(ui: &mut Ui, port: &PortView, numbers: &mut [f64], label: Id, going_on: &mut bool) -> bool {
    let whole = matches!(port.ty.shape, Shape::I32 | Shape::U32);
    let (least, most) = port.range;
    let suffix = match port.unit.as_str() {
        "" => String::new(),
        "deg" => "°".into(),
        unit => format!(" {unit}"),
    };
    if port.ty.meaning.kind == Kind::Color && (3..=4).contains(&numbers.len()) {
        return color_edit(ui, numbers, label, going_on);
    }
    if let ([x], Some(least), Some(most)) = (&mut *numbers, least, most) {
        // Showing a value must not change it: only what a person does is rounded or kept within the range.
        let mut slider = Slider::new(x, least..=most).suffix(&suffix).clamping(egui::SliderClamping::Edits);
        if whole {
            slider = slider.integer();
        } else if least > 0.0 && most / least > 90.0 {
            slider = slider.logarithmic(true);
        }
        let response = ui.add(slider).labelled_by(label);
        *going_on = response.dragged() || response.has_focus();
        return response.changed();
    }
    let range = least.unwrap_or(f64::NEG_INFINITY)..=most.unwrap_or(f64::INFINITY);
    let columns = if numbers.len() == 9 { 3 } else { 4.min(numbers.len()) };
    let mut changed = false;
    for (row, chunk) in numbers.chunks_mut(columns.max(1)).enumerate() {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            for (i, x) in chunk.iter_mut().enumerate() {
                let speed = if whole { 0.1 } else { (x.abs() * 0.01).clamp(0.002, 10.0) };
                let mut drag = DragValue::new(x)
                    .range(range.clone())
                    .clamp_existing_to_range(false)
                    .speed(speed)
                    .max_decimals(if whole { 0 } else { 5 });
                if columns == 1 {
                    drag = drag.suffix(&suffix);
                }
                let response = ui.add(drag).labelled_by(label);
                let response = if columns > 1 {
                    response.on_hover_text(axis(row * columns + i, columns, &suffix))
                } else {
                    response
                };
                *going_on |= response.dragged() || response.has_focus();
                changed |= response.changed();
            }
        });
    }
    changed
}

fn axis(index: usize, columns: usize, suffix: &str) -> String {
    let name = ["x", "y", "z", "w"].get(index % columns).copied().unwrap_or_default();
    format!("{name}{suffix}")
}

#[allow(clippy::cast_possible_truncation, reason = "a picker's colours need no more")]
fn color_edit(ui: &mut Ui, numbers: &mut [f64], label: Id, going_on: &mut bool) -> bool {
    let mut changed = false;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        // Brighter than white is kept as a factor beside the picker.
        let peak = numbers.iter().take(3).fold(1.0_f64, |a, b| a.max(*b));
        let mut rgb = [0, 1, 2].map(|i| (numbers.get(i).copied().unwrap_or(0.0).max(0.0) / peak) as f32);
        let response = ui.color_edit_button_rgb(&mut rgb).on_hover_text("Linear colour");
        if response.changed() {
            for (number, channel) in numbers.iter_mut().zip(rgb) {
                *number = tidy(f64::from(channel) * peak);
            }
            changed = true;
            *going_on = true;
        }
        for x in numbers.iter_mut() {
            let response = ui
                .add(
                    DragValue::new(x)
                        .range(0.0..=f64::INFINITY)
                        .clamp_existing_to_range(false)
                        .speed(0.005)
                        .max_decimals(3),
                )
                .labelled_by(label);
            *going_on |= response.dragged() || response.has_focus();
            changed |= response.changed();
        }
    });
    changed
}

/// Four digits are all that a picker means.
fn tidy(x: f64) -> f64 {
    (x * 1e4).round() / 1e4
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_shown_encoded() {
        assert_eq!(shown_color(&[0.0, 1.0, 2.0]), Color32::from_rgb(0, 255, 255));
        assert_eq!(shown_color(&[0.2140, 0.2140, 0.2140]).r(), 127);
    }

    #[test]
    fn what_was_never_said_has_a_widget_where_a_value_can_be() {
        assert_eq!(blank(&Shape::F32(2)), Some(Value::Numbers(vec![0.0; 2])));
        assert_eq!(blank(&Shape::Matrix(2)), Some(Value::Numbers(vec![1.0, 0.0, 0.0, 1.0])));
        assert_eq!(blank(&Shape::Sampler), None);
    }
}
