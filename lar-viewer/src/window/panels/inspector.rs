//! What is known of the selected cell, with its boundary and coboundary to walk along.

use crate::session::{Command, Relation, Session};
use crate::{CellRef, session::Measuring};
use egui::{Ui, Widget};
use lar_core::Chain;

/// Entries of a chain that are listed; the rest is counted.
const LISTED: usize = 60;

/// What a cell is called, and its measure.
const KINDS: [(&str, &str); 4] = [("vertex", ""), ("edge", "length"), ("face", "area"), ("cell", "volume")];

/// Number, measures, parents, boundary and coboundary of the selected cell; measured points.
pub(crate) fn inspector(ui: &mut Ui, session: &Session) -> Vec<Command> {
    let mut commands = Vec::new();
    match session.selected() {
        Some(cell) => selected(ui, session, cell, &mut commands),
        None => _ = ui.weak("Click a cell, or find it by its number."),
    }
    if let Some(highlight) = session.highlight() {
        ui.horizontal(|ui| {
            ui.strong(&highlight.label);
            ui.label(format!("{} cells stand out", highlight.chain.entries().len()));
            if ui.button("Clear").clicked() {
                commands.push(Command::ClearHighlight);
            }
        });
    }
    measured(ui, session.measuring(), &mut commands);
    commands
}

fn selected(ui: &mut Ui, session: &Session, cell: CellRef, commands: &mut Vec<Command>) {
    let data = session.data();
    let (kind, measure) = KINDS[usize::from(cell.dim.min(3))];
    ui.horizontal(|ui| {
        let exterior = if data.is_exterior(cell) { ", the exterior" } else { "" };
        ui.strong(format!("{kind} {cell}{exterior}"));
        if ui.add_enabled(session.can_go_back(), egui::Button::new("Back")).clicked() {
            commands.push(Command::Back);
        }
    });
    if let Some(measures) = data.measures(cell) {
        if !measure.is_empty() {
            ui.label(format!("{measure} {}", number(measures.size)));
        }
        if let Some([x, y, z]) = measures.centroid {
            let title = if cell.dim == 0 { "at" } else { "centroid" };
            ui.label(format!("{title} ({}, {}, {})", number(x), number(y), number(z)));
        }
    }
    let name = |solid: u32| data.solids().get(solid as usize).map_or("", String::as_str);
    let inside: Vec<&str> = data.solids_of(cell).iter().map(|&s| name(s)).collect();
    if !inside.is_empty() {
        ui.label(format!("inside {}", inside.join(", ")));
    }
    for parent in data.parents(cell) {
        let sign = if parent.sign < 0 { "−" } else { "+" };
        ui.label(format!("piece of {sign} face {} of {}", parent.face, name(parent.solid)));
    }
    ui.horizontal(|ui| {
        if ui.button("Hide").clicked() {
            commands.push(Command::Hide(vec![cell]));
        }
        if 0 < cell.dim && ui.button("Isolate").clicked() {
            commands.push(Command::Isolate(vec![cell]));
        }
    });
    for (relation, title, chain) in [
        (Relation::Boundary, "boundary ∂", data.boundary(cell)),
        (Relation::Coboundary, "coboundary δ", data.coboundary(cell)),
    ] {
        if let Some(chain) = chain.filter(|c| !c.is_zero()) {
            ui.horizontal(|ui| {
                ui.label(format!("{title} ({})", chain.entries().len()));
                if ui.button("Highlight").on_hover_text(title).clicked() {
                    commands.push(Command::Highlight(cell, relation));
                }
            });
            entries(ui, &chain, commands);
        }
    }
}

/// The cells of a chain with their signs, each to be clicked.
fn entries(ui: &mut Ui, chain: &Chain, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for &(index, coefficient) in chain.entries().iter().take(LISTED) {
            let cell = CellRef { dim: chain.dim() as u8, index };
            let text = match coefficient {
                1 => format!("+{cell}"),
                -1 => format!("−{cell}"),
                c if c < 0 => format!("−{}{cell}", c.unsigned_abs()),
                c => format!("+{c}{cell}"),
            };
            if egui::Link::new(text).ui(ui).clicked() {
                commands.push(Command::Select(Some(cell)));
            }
        }
        if LISTED < chain.entries().len() {
            ui.weak(format!("and {} more", chain.entries().len() - LISTED));
        }
    });
}

fn measured(ui: &mut Ui, measuring: &Measuring, commands: &mut Vec<Command>) {
    if measuring.points().is_empty() {
        return;
    }
    ui.separator();
    ui.horizontal(|ui| {
        ui.strong("measured");
        if ui.button("Forget points").clicked() {
            commands.push(Command::ClearMeasuring);
        }
    });
    for [x, y, z] in measuring.points() {
        ui.label(format!("point ({}, {}, {})", number(*x), number(*y), number(*z)));
    }
    for distance in measuring.distances() {
        ui.label(format!("distance {}", number(distance)));
    }
    if let Some(angle) = measuring.angle() {
        ui.label(format!("angle {}°", number(angle.to_degrees())));
    }
}

/// A number with six significant digits.
pub(crate) fn number(x: f64) -> String {
    let magnitude = x.abs();
    if x == 0.0 || (1e-4..1e6).contains(&magnitude) {
        let decimals = if x == 0.0 { 0 } else { (5 - magnitude.log10().floor() as i32).clamp(0, 9) as usize };
        let text = format!("{x:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{x:.5e}")
    }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_have_six_digits() {
        let written = [0.0, 1.0, -0.5, 1.0 / 3.0, 1234.5678, 1e6, 1.5e-7, 999_999.9].map(number);
        assert_eq!(written, ["0", "1", "-0.5", "0.333333", "1234.57", "1.00000e6", "1.50000e-7", "1000000"]);
    }
}
