//! From the plane that nodes lie on to the screen and back.

use eframe::egui::{Pos2, Rect, Vec2, pos2, vec2};

/// What part of the plane is seen, and how large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::gui) struct Camera {
    /// The point of the plane in the middle of the view.
    pub(in crate::gui) center: Pos2,
    /// Points of the screen per point of the plane.
    pub(in crate::gui) zoom: f32,
}

impl Default for Camera {
    fn default() -> Self {
        Self { center: Pos2::ZERO, zoom: 1.0 }
    }
}

/// Least and greatest zoom.
pub(in crate::gui) const ZOOM: std::ops::RangeInclusive<f32> = 0.02..=3.0;

/// How much is drawn of each node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Detail {
    /// A coloured box.
    Box,
    /// A box with its title.
    Title,
    /// Ports and values.
    Full,
}

/// A camera over a part of the screen.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) camera: Camera,
    pub(super) screen: Rect,
}

impl View {
    pub(super) fn to_screen(self, p: Pos2) -> Pos2 {
        self.screen.center() + (p - self.camera.center) * self.camera.zoom
    }

    pub(super) fn to_plane(self, p: Pos2) -> Pos2 {
        self.camera.center + (p - self.screen.center()) / self.camera.zoom
    }

    pub(super) fn rect(&self, r: Rect) -> Rect {
        Rect::from_min_max(self.to_screen(r.min), self.to_screen(r.max))
    }

    /// The part of the plane that is seen.
    pub(super) fn seen(&self) -> Rect {
        Rect::from_min_max(self.to_plane(self.screen.min), self.to_plane(self.screen.max))
    }

    pub(super) fn detail(&self) -> Detail {
        match self.camera.zoom {
            z if z < 0.22 => Detail::Box,
            z if z < 0.5 => Detail::Title,
            _ => Detail::Full,
        }
    }
}

impl Camera {
    /// Zooms so that the point under the cursor stays there.
    pub(super) fn zoom_at(&mut self, screen: Rect, cursor: Pos2, factor: f32) {
        let before = View { camera: *self, screen }.to_plane(cursor);
        self.zoom = (self.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
        let after = View { camera: *self, screen }.to_plane(cursor);
        self.center += before - after;
    }

    /// Shows a rectangle of the plane, not larger than life.
    pub(in crate::gui) fn fit(&mut self, what: Rect, size: Vec2) {
        if !what.is_positive() || size.x < 1.0 || size.y < 1.0 {
            return;
        }
        let room = size - vec2(60.0, 60.0);
        let zoom = (room.x / what.width()).min(room.y / what.height());
        self.zoom = zoom.clamp(*ZOOM.start(), 1.0);
        self.center = what.center();
    }
}

/// A position as documents hold it.
#[allow(clippy::cast_possible_truncation, reason = "positions on a canvas need no more")]
pub(in crate::gui) fn at(position: [f64; 2]) -> Pos2 {
    pos2(position[0] as f32, position[1] as f32)
}

/// A position for a document: whole points, so that files stay short.
pub(in crate::gui) fn position(p: Pos2) -> [f64; 2] {
    [f64::from(p.x.round()), f64::from(p.y.round())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_under_the_cursor_stays_there() {
        let screen = Rect::from_min_size(pos2(100.0, 50.0), vec2(640.0, 480.0));
        let mut camera = Camera { center: pos2(-20.0, 33.0), zoom: 0.7 };
        let cursor = pos2(300.0, 99.0);
        let before = View { camera, screen }.to_plane(cursor);
        for factor in [1.5, 0.2, 8.0, 0.001] {
            camera.zoom_at(screen, cursor, factor);
            assert!((View { camera, screen }.to_plane(cursor) - before).length() < 1e-2);
            assert!(ZOOM.contains(&camera.zoom));
        }
    }

    #[test]
    fn there_and_back() {
        let view = View {
            camera: Camera { center: pos2(5.0, 6.0), zoom: 2.0 },
            screen: Rect::from_min_size(pos2(10.0, 10.0), vec2(80.0, 60.0)),
        };
        let p = pos2(7.5, -3.0);
        assert!((view.to_plane(view.to_screen(p)) - p).length() < 1e-4);
        assert!(view.seen().contains(view.camera.center));
    }

    #[test]
    fn fitting_shows_all() {
        let mut camera = Camera::default();
        let what = Rect::from_min_size(pos2(1000.0, 0.0), vec2(4000.0, 100.0));
        camera.fit(what, vec2(800.0, 600.0));
        let view = View { camera, screen: Rect::from_min_size(Pos2::ZERO, vec2(800.0, 600.0)) };
        assert!(view.seen().contains_rect(what));
    }
}
