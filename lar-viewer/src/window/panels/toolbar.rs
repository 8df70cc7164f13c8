//! The bar above the picture.

use crate::window::controls::{PickAs, Tool};
use crate::window::keys::Action;
use crate::window::navigation::{Navigation, Turning};
use crate::{Projection, StandardView};
use egui::{ComboBox, Ui};

/// What is to be saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Capture {
    /// The picture as PNG.
    Screenshot,
    /// A full turn as numbered PNG files.
    Frames,
    /// A full turn as one animated PNG file.
    Animation,
    /// The camera as arguments of `lar render`, on the clipboard.
    Camera,
}

/// The state that the bar shows.
#[derive(Clone, Copy)]
pub(crate) struct Tools {
    pub(crate) navigation: Navigation,
    pub(crate) projection: Projection,
    pub(crate) tool: Tool,
}

/// Buttons for the camera, the tool, and what can be saved. Picking is offered for a complex only.
pub(crate) fn toolbar(
    ui: &mut Ui,
    tools: Tools,
    pick_as: Option<&mut PickAs>,
) -> (Vec<Action>, Option<Capture>) {
    let (mut actions, mut capture) = (Vec::new(), None);
    ui.horizontal_wrapped(|ui| {
        let mut button = |ui: &mut Ui, text: &str, hint: &str, on: bool, action: Action| {
            if ui.selectable_label(on, text).on_hover_text(hint).clicked() {
                actions.push(action);
            }
        };
        button(ui, "Fit", "F", false, Action::Fit);
        ui.menu_button("Views", |ui| {
            for (i, view) in StandardView::ALL.into_iter().enumerate() {
                button(ui, &format!("{} {}", i + 1, view.name()), "", false, Action::LookFrom(i));
            }
        });
        ui.separator();
        let orthographic = tools.projection == Projection::Orthographic;
        button(ui, "Orthographic", "P", orthographic, Action::Projection);
        button(ui, "2D", "D", tools.navigation.turning == Turning::Plane, Action::Plane);
        button(ui, "Trackball", "T", tools.navigation.turning == Turning::Trackball, Action::Trackball);
        ui.separator();
        if let Some(pick_as) = pick_as {
            button(ui, "Measure", "M", tools.tool == Tool::Measure, Action::Measure);
            let label = ui.weak("pick");
            let choice = ComboBox::from_id_salt("pick").selected_text(pick_as.name()).width(80.0);
            let choice = choice.show_ui(ui, |ui| {
                for one in PickAs::ALL {
                    ui.selectable_value(pick_as, one, one.name());
                }
            });
            choice.response.labelled_by(label.id);
            ui.separator();
        }
        let captures = [
            ("Screenshot", "S: the picture as PNG", Capture::Screenshot),
            ("Turn: APNG", "a full turn as an animation", Capture::Animation),
            ("Turn: PNGs", "a full turn as numbered pictures", Capture::Frames),
            ("Copy camera", "as arguments of lar render", Capture::Camera),
        ];
        // Browsers ask before a page may save many files.
        let offered = |what: Capture| cfg!(not(target_arch = "wasm32")) || what != Capture::Frames;
        for (text, hint, what) in captures.into_iter().filter(|c| offered(c.2)) {
            if ui.button(text).on_hover_text(hint).clicked() {
                capture = Some(what);
            }
        }
        if ui.button("?").on_hover_text("F1").clicked() {
            actions.push(Action::Help);
        }
    });
    (actions, capture)
}
