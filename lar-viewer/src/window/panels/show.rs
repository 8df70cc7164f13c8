//! What is drawn, and in which colours.

use crate::session::{ColorBy, Command, Exterior, Session, scale_color, size_range};
use crate::{INK, Outlined, Rgb, SLATE, View, WHITE};
use egui::{ComboBox, Rect, Sense, Slider, Ui, vec2};

/// The dimensions, lowest first.
pub(crate) const LAYERS: [&str; 4] = ["vertices", "edges", "faces", "cells"];

/// Backgrounds and their names.
const BACKGROUNDS: [(&str, Rgb); 3] = [("slate", SLATE), ("white", WHITE), ("dark", INK)];

/// Layers, numbers, exterior, colours.
pub(crate) fn show(ui: &mut Ui, session: &mut Session) -> Vec<Command> {
    let mut commands = Vec::new();
    let dim = session.data().dim();
    egui::Grid::new("layers").num_columns(3).show(ui, |ui| {
        for (layer, name) in (0..=dim).zip(LAYERS) {
            let mut on = session.visibility().layers[usize::from(layer)];
            if ui.checkbox(&mut on, name).changed() {
                commands.push(Command::ToggleLayer(layer));
            }
            let mut numbered = session.numbers()[usize::from(layer)];
            if ui.checkbox(&mut numbered, "numbers").changed() {
                commands.push(Command::ToggleNumbers(layer));
            }
            ui.weak(session.data().n_cells(layer).to_string());
            ui.end_row();
        }
    });
    if session.data().has_exterior() {
        let mut exterior = session.visibility().exterior;
        choice(ui, "exterior", &mut exterior, &Exterior::ALL, Exterior::name);
        if exterior != session.visibility().exterior {
            commands.push(Command::SetExterior(exterior));
        }
    }
    choice(ui, "colour by", &mut session.coloring, &ColorBy::ALL, ColorBy::name);
    if session.coloring == ColorBy::Size {
        scale(ui, session);
    }
    ui.add(Slider::new(&mut session.opacity, 0.0..=1.0).text("opacity"));
    let outlines = [None].into_iter().chain(Outlined::ALL.map(Some)).collect::<Vec<_>>();
    choice(ui, "outline", &mut session.outline, &outlines, |of| of.map_or("none", Outlined::name));
    background(ui, &mut session.background);
    ui.horizontal(|ui| {
        let [undo, redo] = session.can_undo_redo();
        if ui.add_enabled(undo, egui::Button::new("Undo")).clicked() {
            commands.push(Command::Undo);
        }
        if ui.add_enabled(redo, egui::Button::new("Redo")).clicked() {
            commands.push(Command::Redo);
        }
        if ui.add_enabled(!session.visibility().shows_all(), egui::Button::new("Show all")).clicked() {
            commands.push(Command::ShowAll);
        }
    });
    commands
}

/// Solids whose opacity can be set for themselves, at most.
const MOST_SOLIDS: usize = 100;

/// The opacity of each solid.
pub(crate) fn solids(ui: &mut Ui, session: &Session) -> Vec<Command> {
    let mut commands = Vec::new();
    for (solid, name) in (0..).zip(session.data().solids()).take(MOST_SOLIDS) {
        let mut opacity = session.visibility().opacity_of(solid);
        if ui.add(Slider::new(&mut opacity, 0.0..=1.0).text(format!("opacity of {name}"))).changed() {
            commands.push(Command::SetOpacity(solid, opacity));
        }
    }
    commands
}

/// The same for a scene that is shown as it is.
pub(crate) fn show_plain(ui: &mut Ui, view: &mut View) {
    ui.add(Slider::new(&mut view.opacity, 0.05..=1.0).text("opacity"));
    ui.checkbox(&mut view.edges, "edges");
    background(ui, &mut view.background);
}

fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    label: &str,
    value: &mut T,
    all: &[T],
    name: fn(T) -> &'static str,
) {
    ComboBox::from_label(label).selected_text(name(*value)).show_ui(ui, |ui| {
        for &one in all {
            ui.selectable_value(value, one, name(one));
        }
    });
}

fn background(ui: &mut Ui, color: &mut Rgb) {
    ui.horizontal(|ui| {
        ui.label("background");
        for (name, background) in BACKGROUNDS {
            ui.selectable_value(color, background, name);
        }
        ui.color_edit_button_rgb(color);
    });
}

/// The colour scale as a bar with the least and greatest size.
fn scale(ui: &mut Ui, session: &Session) {
    let Some([low, high]) = size_range(session.data(), session.data().dim()) else { return };
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width().min(220.0), 12.0), Sense::hover());
    let n = 48_u16;
    for i in 0..n {
        let at = |i: u16| egui::lerp(rect.x_range(), f32::from(i) / f32::from(n));
        let stripe = Rect::from_x_y_ranges(at(i)..=at(i + 1), rect.y_range());
        let [r, g, b] = scale_color(f64::from(i) / f64::from(n - 1)).map(|c| (255.0 * c) as u8);
        ui.painter().rect_filled(stripe, 0.0, egui::Color32::from_rgb(r, g, b));
    }
    ui.horizontal(|ui| {
        ui.small(super::inspector::number(low));
        ui.small("…");
        ui.small(super::inspector::number(high));
    });
}
