//! The solids and their cells: shown, hidden, isolated, found by number.

use super::Texts;
use crate::CellRef;
use crate::session::{Command, Session};
use egui::{CollapsingHeader, Role, ScrollArea, TextEdit, Ui, WidgetInfo};

/// Cells listed below one heading; more are found by search.
const LISTED: usize = 2000;

/// The search field, and the tree.
pub(crate) fn tree(ui: &mut Ui, session: &Session, texts: &mut Texts) -> Vec<Command> {
    let mut commands = Vec::new();
    search(ui, session, texts, &mut commands);
    ui.separator();
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let data = session.data();
        for (solid, name) in (0..).zip(data.solids()) {
            let cells = data.cells_of_solid(solid);
            branch(ui, session, name, &cells, &mut commands);
        }
        let alone: Vec<CellRef> =
            data.units().into_iter().filter(|&c| data.solids_of(c).is_empty()).collect();
        let title = if data.solids().is_empty() { "cells" } else { "in no solid" };
        if !alone.is_empty() {
            branch(ui, session, title, &alone, &mut commands);
        }
    });
    commands
}

fn search(ui: &mut Ui, session: &Session, texts: &mut Texts, commands: &mut Vec<Command>) {
    let label = ui.weak("find a cell");
    let field =
        TextEdit::singleline(&mut texts.search).hint_text("c3, f12, e5, v0").desired_width(f32::INFINITY);
    let response = ui.add(field).labelled_by(label.id);
    if response.changed() {
        texts.search_error = None;
    }
    if response.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter)) {
        match session.data().find(&texts.search, session.data().dim()) {
            Ok(cell) => {
                texts.search_error = None;
                commands.push(Command::Select(Some(cell)));
            }
            Err(error) => texts.search_error = Some(error),
        }
    }
    if let Some(error) = &texts.search_error {
        ui.colored_label(ui.visuals().error_fg_color, error);
    }
}

/// A heading with a check box for all of its cells, and a line for each.
fn branch(ui: &mut Ui, session: &Session, name: &str, cells: &[CellRef], commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        let shown = |&c: &CellRef| session.visibility().shows(c);
        let mut all = cells.iter().all(shown);
        let check = ui.add(egui::Checkbox::without_text(&mut all)).on_hover_text(format!("show {name}"));
        check.widget_info(|| named(all, &format!("show {name}")));
        if check.changed() {
            let cells = cells.to_vec();
            commands.push(if all { Command::Show(cells) } else { Command::Hide(cells) });
        }
        if ui.small_button("only").on_hover_text(format!("isolate {name}")).clicked() {
            commands.push(Command::Isolate(cells.to_vec()));
        }
        let title = format!("{name} ({})", cells.len());
        CollapsingHeader::new(title).id_salt(name).default_open(cells.len() <= 20).show(ui, |ui| {
            cells.iter().take(LISTED).for_each(|&cell| leaf(ui, session, cell, commands));
            if LISTED < cells.len() {
                ui.weak(format!("and {} more", cells.len() - LISTED));
            }
        });
    });
}

/// A check box for those who cannot see what it stands beside.
fn named(checked: bool, name: &str) -> WidgetInfo {
    WidgetInfo::selected(Role::CheckBox, true, checked, name)
}

fn leaf(ui: &mut Ui, session: &Session, cell: CellRef, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        let mut shown = session.draws(cell);
        let exterior = session.data().is_exterior(cell);
        let check = ui.add(egui::Checkbox::without_text(&mut shown));
        check.widget_info(|| named(shown, &format!("show {cell}")));
        if check.changed() {
            commands.push(if shown { Command::Show(vec![cell]) } else { Command::Hide(vec![cell]) });
        }
        let label = if exterior { format!("{cell} exterior") } else { cell.to_string() };
        if ui.selectable_label(session.selected() == Some(cell), label).clicked() {
            commands.push(Command::Select(Some(cell)));
        }
    });
}
