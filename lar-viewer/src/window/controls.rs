//! The panel, the mouse and the keys: how input changes a view. Needs no window and no graphics card.

use crate::{Scene, View};
use egui::{Key, PointerButton, Rect, Response, Ui};
use std::sync::Arc;

/// Range of the explode sliders.
const EXPLODE: std::ops::RangeInclusive<f32> = 1.0..=5.0;
/// Zoom per point of wheel motion, as a power of e: a notch of 50 points is a fifth.
const ZOOM_PER_POINT: f64 = 0.004;
/// Width of the panel in points.
const PANEL_WIDTH: f32 = 250.0;

/// The view and what the panel says about it.
pub(crate) struct Controls {
    pub(crate) view: View,
    /// Shown at the foot of the panel: where the last screenshot went, or why not.
    pub(crate) message: String,
    scene: Arc<Scene>,
    adapter: String,
}

/// What the user asked for in one frame, and where the picture goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Asked {
    /// Area of the picture, in points.
    pub(crate) area: Rect,
    pub(crate) screenshot: bool,
    pub(crate) close: bool,
    /// The mouse is dragging the scene or a slider.
    pub(crate) dragging: bool,
}

impl Controls {
    pub(crate) fn new(view: View, scene: Arc<Scene>, adapter: String) -> Self {
        Self { view, message: String::new(), scene, adapter }
    }

    /// Lays out panel and picture and applies the input.
    pub(crate) fn show(&mut self, ui: &mut Ui, picture: egui::TextureId) -> Asked {
        let mut fit = false;
        let mut screenshot = false;
        egui::Panel::right("controls").exact_size(PANEL_WIDTH).resizable(false).show(ui, |ui| {
            egui::ScrollArea::vertical().show(ui, |ui| {
                (fit, screenshot) = self.panel(ui);
            });
        });
        let central = egui::CentralPanel::no_frame().show(ui, |ui| {
            let response = ui.allocate_response(ui.available_size(), egui::Sense::click_and_drag());
            let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            ui.painter().image(picture, response.rect, whole, egui::Color32::WHITE);
            response
        });
        let response = central.inner;
        self.mouse(ui, &response);
        let typing = ui.ctx().text_edit_focused();
        let pressed = |key| !typing && ui.input(|i| i.key_pressed(key));
        if pressed(Key::P) {
            self.view.camera = self.view.camera.toggle_projection();
        }
        if fit || pressed(Key::F) {
            let aspect = f64::from(response.rect.width().max(1.0) / response.rect.height().max(1.0));
            self.view = self.view.fit(&self.scene, aspect);
        }
        Asked {
            area: response.rect,
            screenshot,
            close: pressed(Key::Escape),
            dragging: ui.input(|i| i.pointer.any_down()),
        }
    }

    /// Returns whether *Fit* and *Screenshot* were clicked.
    fn panel(&mut self, ui: &mut Ui) -> (bool, bool) {
        ui.add_space(6.0);
        ui.heading("Explode");
        self.explode_sliders(ui);
        ui.separator();
        ui.heading("Show");
        ui.add(egui::Slider::new(&mut self.view.opacity, 0.05..=1.0).text("opacity"));
        ui.checkbox(&mut self.view.edges, "edges");
        ui.separator();
        ui.heading("Camera");
        let fit = ui.button("Fit (F)").clicked();
        if ui.button(format!("{:?} (P)", self.view.camera.projection)).clicked() {
            self.view.camera = self.view.camera.toggle_projection();
        }
        ui.separator();
        let screenshot = ui.button("Screenshot").clicked();
        if !self.message.is_empty() {
            ui.label(&self.message);
        }
        ui.separator();
        ui.small("left drag: turn\nright, middle or shift drag: move\nwheel: zoom\nEsc: close");
        ui.small(&self.adapter);
        (fit, screenshot)
    }

    fn explode_sliders(&mut self, ui: &mut Ui) {
        let [x, y, z] = &mut self.view.explode.factors[0];
        let mut all = (*x + *y + *z) / 3.0;
        if ui.add(egui::Slider::new(&mut all, EXPLODE).text("all")).changed() {
            (*x, *y, *z) = (all, all, all);
        }
        for (factor, axis) in [(x, "x"), (y, "y"), (z, "z")] {
            ui.add(egui::Slider::new(factor, EXPLODE).text(axis));
        }
    }

    fn mouse(&mut self, ui: &Ui, response: &Response) {
        let height = f64::from(response.rect.height().max(1.0));
        let delta = response.drag_delta();
        let moved = [f64::from(delta.x), f64::from(delta.y)];
        let camera = &mut self.view.camera;
        let shift = ui.input(|i| i.modifiers.shift);
        let moving =
            response.dragged_by(PointerButton::Secondary) || response.dragged_by(PointerButton::Middle);
        if moving || (shift && response.dragged_by(PointerButton::Primary)) {
            *camera = camera.pan(moved, height);
        } else if response.dragged_by(PointerButton::Primary) {
            camera.orientation = camera.orientation.orbit(moved);
        }
        if let Some(at) = response.hover_pos() {
            let wheel = f64::from(ui.input(|i| i.smooth_scroll_delta().y));
            if wheel != 0.0 {
                let cursor = at - response.rect.center();
                let cursor = [f64::from(cursor.x), f64::from(cursor.y)];
                *camera = camera.zoom((wheel * ZOOM_PER_POINT).exp(), cursor, height);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Drawable, Projection};
    use egui::{Event, Modifiers, Pos2, RawInput, pos2, vec2};

    /// A panel without a window: events in, view out.
    struct Session {
        context: egui::Context,
        controls: Controls,
        time: f64,
    }

    impl Session {
        fn new() -> Self {
            let mut scene = Scene::new();
            scene.push(Drawable::lines("diagonal", [[[0.0; 3], [1.0, 2.0, 3.0]]])).unwrap();
            let view = View::fitted(&scene, [1.0; 3], 1.5);
            let controls = Controls::new(view, Arc::new(scene), "test".into());
            let mut session = Self { context: egui::Context::default(), controls, time: 0.0 };
            session.frame(vec![]);
            session
        }

        fn frame(&mut self, events: Vec<Event>) -> Asked {
            self.time += 0.05;
            let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1000.0, 600.0)));
            let input =
                RawInput { screen_rect, time: Some(self.time), events, focused: true, ..Default::default() };
            let mut asked = None;
            let controls = &mut self.controls;
            let mut output =
                self.context.run_ui(input, |ui| asked = Some(controls.show(ui, egui::TextureId::User(0))));
            output.textures_delta.clear();
            asked.expect("the interface was run")
        }

        fn drag(&mut self, button: PointerButton, from: Pos2, to: Pos2) {
            let press =
                |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE };
            self.frame(vec![Event::PointerMoved(from)]);
            self.frame(vec![press(from, true)]);
            self.frame(vec![Event::PointerMoved(to)]);
            self.frame(vec![press(to, false)]);
        }

        fn key(&mut self, key: Key) -> Asked {
            let event = |pressed| Event::Key {
                key,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers: Modifiers::NONE,
            };
            let asked = self.frame(vec![event(true)]);
            self.frame(vec![event(false)]);
            asked
        }
    }

    #[test]
    fn left_drag_turns_and_right_drag_moves_by_the_pixels_dragged() {
        let mut session = Session::new();
        let before = session.controls.view.camera;
        session.drag(PointerButton::Primary, pos2(300.0, 300.0), pos2(340.0, 280.0));
        let turned = session.controls.view.camera;
        assert_eq!(turned.orientation, before.orientation.orbit([40.0, -20.0]));
        assert_eq!((turned.target, turned.distance), (before.target, before.distance));
        session.drag(PointerButton::Secondary, pos2(300.0, 300.0), pos2(340.0, 280.0));
        assert_eq!(session.controls.view.camera, turned.pan([40.0, -20.0], 600.0));
    }

    #[test]
    fn shift_makes_a_left_drag_move() {
        let mut session = Session::new();
        let before = session.controls.view.camera;
        session.frame(vec![Event::ModifiersChanged(Modifiers::SHIFT)]);
        session.drag(PointerButton::Primary, pos2(300.0, 300.0), pos2(310.0, 305.0));
        assert_eq!(session.controls.view.camera, before.pan([10.0, 5.0], 600.0));
    }

    #[test]
    fn dragging_in_the_panel_leaves_the_camera_alone() {
        let mut session = Session::new();
        let before = session.controls.view.camera;
        session.drag(PointerButton::Primary, pos2(900.0, 500.0), pos2(850.0, 550.0));
        assert_eq!(session.controls.view.camera, before);
    }

    #[test]
    fn the_wheel_zooms_to_the_cursor() {
        let mut session = Session::new();
        let before = session.controls.view.camera;
        session.frame(vec![Event::PointerMoved(pos2(200.0, 100.0))]);
        session.frame(vec![Event::MouseWheel {
            unit: egui::MouseWheelUnit::Line,
            delta: vec2(0.0, 2.0),
            phase: egui::TouchPhase::Move,
            modifiers: Modifiers::NONE,
            source: egui::MouseWheelSource::Wheel,
        }]);
        (0..40).for_each(|_| {
            session.frame(vec![]);
        });
        let after = session.controls.view.camera;
        assert!(after.distance < 0.9 * before.distance, "{} to {}", before.distance, after.distance);
        assert_ne!(after.target, before.target);
    }

    #[test]
    fn keys_fit_switch_projection_and_close() {
        let mut session = Session::new();
        let fitted = session.controls.view.fit(&session.controls.scene, 750.0 / 600.0);
        session.drag(PointerButton::Middle, pos2(100.0, 100.0), pos2(400.0, 300.0));
        assert!(!session.key(Key::F).close);
        let camera = session.controls.view.camera;
        assert!((camera.distance - fitted.camera.distance).abs() < 1e-6 * camera.distance);
        session.key(Key::P);
        assert_eq!(session.controls.view.camera.projection, Projection::Orthographic);
        assert!(session.key(Key::Escape).close);
    }

    #[test]
    fn the_picture_takes_what_the_panel_leaves() {
        let area = Session::new().frame(vec![]).area;
        assert_eq!(area.height(), 600.0);
        assert!((720.0..=1000.0 - PANEL_WIDTH).contains(&area.width()), "{area}");
    }
}
