//! Sliders that pull the complex apart.

use crate::View;
use crate::session::{Center, Explode, ExplodeBy, LEVEL_NAMES};
use egui::{ComboBox, Slider, Ui};

/// Range of the sliders.
const RANGE: std::ops::RangeInclusive<f32> = 1.0..=5.0;

/// What moves, how far, and about what.
pub(crate) fn explode(ui: &mut Ui, explode: &mut Explode) {
    ComboBox::from_label("pull apart").selected_text(explode.by.name()).show_ui(ui, |ui| {
        for by in ExplodeBy::ALL {
            ui.selectable_value(&mut explode.by, by, by.name());
        }
    });
    if explode.by == ExplodeBy::Hierarchy {
        for (factor, name) in explode.levels.iter_mut().zip(LEVEL_NAMES) {
            ui.add(Slider::new(factor, RANGE).text(name));
        }
    } else {
        axes(ui, &mut explode.factors);
    }
    ui.horizontal(|ui| {
        ui.label("about");
        ui.selectable_value(&mut explode.center, Center::Model, "the middle");
        ui.selectable_value(&mut explode.center, Center::Origin, "the origin");
        if ui.button("Reset").clicked() {
            *explode = Explode { by: explode.by, center: explode.center, ..Explode::default() };
        }
    });
}

/// The sliders of a scene that is shown as it is.
pub(crate) fn explode_plain(ui: &mut Ui, view: &mut View) {
    axes(ui, &mut view.explode.factors[0]);
}

fn axes(ui: &mut Ui, [x, y, z]: &mut [f32; 3]) {
    let mut all = (*x + *y + *z) / 3.0;
    if ui.add(Slider::new(&mut all, RANGE).text("all")).changed() {
        (*x, *y, *z) = (all, all, all);
    }
    for (factor, axis) in [(x, "x"), (y, "y"), (z, "z")] {
        ui.add(Slider::new(factor, RANGE).text(axis));
    }
}
