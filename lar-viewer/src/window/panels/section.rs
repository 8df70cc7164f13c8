//! The clip plane.

use crate::session::{Normal, Section};
use egui::{Slider, Ui};
use std::f64::consts::{FRAC_PI_2, PI};

/// Direction, position and kind of the clip plane.
pub(crate) fn section(ui: &mut Ui, section: &mut Section) {
    ui.checkbox(&mut section.on, "cut");
    ui.add_enabled_ui(section.on, |ui| {
        ui.horizontal(|ui| {
            for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
                ui.selectable_value(&mut section.normal, Normal::Axis(k), name);
            }
            let free = matches!(section.normal, Normal::Free { .. });
            if ui.selectable_label(free, "free").clicked() && !free {
                section.normal = Normal::Free { azimuth: 0.5, elevation: 0.5 };
            }
        });
        if let Normal::Free { azimuth, elevation } = &mut section.normal {
            ui.add(Slider::new(azimuth, -PI..=PI).text("azimuth").custom_formatter(degrees));
            ui.add(
                Slider::new(elevation, -FRAC_PI_2..=FRAC_PI_2).text("elevation").custom_formatter(degrees),
            );
        }
        ui.add(Slider::new(&mut section.position, 0.0..=1.0).text("position"));
        ui.horizontal(|ui| {
            ui.checkbox(&mut section.whole_cells, "whole cells");
            ui.checkbox(&mut section.flipped, "other half");
        });
    });
}

fn degrees(radians: f64, _: std::ops::RangeInclusive<usize>) -> String {
    format!("{:.0}°", radians.to_degrees())
}
