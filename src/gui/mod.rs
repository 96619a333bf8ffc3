//! The editor: a window on documents, their pictures and their text. It changes graphs only through their edits, and
//! everything that takes long runs elsewhere.

mod actions;
mod app;
mod canvas;
mod code;
mod command;
mod cost;
mod dialogs;
mod feed;
mod files;
mod finder;
mod inspector;
mod library;
mod open;
mod outline;
mod panels;
mod preview;
mod problems;
mod tab;
#[cfg(test)]
mod tests;
mod theme;
mod values;
mod windows;

pub use app::{Editor, Options};
pub use files::Places;

/// Opens the window and returns when it is closed. The error is a sentence.
pub fn run(options: Options) -> Result<(), String> {
    let viewport = eframe::egui::ViewportBuilder::default()
        .with_title("shadetree")
        .with_app_id("shadetree")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([640.0, 420.0]);
    let native =
        eframe::NativeOptions { viewport, renderer: eframe::Renderer::Wgpu, ..eframe::NativeOptions::default() };
    eframe::run_native("shadetree", native, Box::new(|cc| Ok(Box::new(Editor::new(&cc.egui_ctx, options)))))
        .map_err(|e| e.to_string())
}
