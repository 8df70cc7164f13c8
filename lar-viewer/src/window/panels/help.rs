//! The overlay that lists mouse and keys.

use crate::window::keys::HELP;
use egui::{Align2, Grid, Ui, Window};

/// Shows the help while it is open.
pub(crate) fn help(ui: &Ui, open: &mut bool) {
    Window::new("Mouse and keys")
        .open(open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0; 2])
        .show(ui.ctx(), |ui| {
            Grid::new("keys").num_columns(2).striped(true).spacing([24.0, 4.0]).show(ui, |ui| {
                for (keys, meaning) in HELP {
                    ui.strong(keys);
                    ui.label(meaning);
                    ui.end_row();
                }
            });
        });
}
