//! Boolean expressions, and the replay of gift wrapping.

use super::Texts;
use crate::session::{Command, Highlight, Queries, Session};
use egui::{Slider, TextEdit, Ui};

/// The expression field with its result, and the replay of the selected cell.
pub(crate) fn algebra(
    ui: &mut Ui,
    session: &Session,
    queries: &dyn Queries,
    texts: &mut Texts,
) -> Vec<Command> {
    let mut commands = Vec::new();
    if !session.data().solids().is_empty() {
        expression(ui, session, queries, texts, &mut commands);
        ui.separator();
    }
    replay(ui, session, queries, texts, &mut commands);
    commands
}

fn expression(
    ui: &mut Ui,
    session: &Session,
    queries: &dyn Queries,
    texts: &mut Texts,
    commands: &mut Vec<Command>,
) {
    let hint = match session.data().solids() {
        [a, b, ..] => format!("{a} - {b}"),
        names => names.first().cloned().unwrap_or_default(),
    };
    let label = ui.label("Boolean expression: ! & - ^ |");
    let field = TextEdit::singleline(&mut texts.expression).hint_text(hint).desired_width(f32::INFINITY);
    if ui.add(field).labelled_by(label.id).changed() {
        if texts.expression.trim().is_empty() {
            texts.expression_result = None;
            commands.push(Command::ClearHighlight);
        } else {
            texts.expression_result = Some(evaluate(session, queries, &texts.expression, commands));
        }
    }
    match &texts.expression_result {
        Some(Ok(result)) => _ = ui.label(result),
        Some(Err(error)) => _ = ui.colored_label(ui.visuals().error_fg_color, error),
        None => {}
    }
}

/// Makes the cells of the result stand out and says how many they are.
fn evaluate(
    session: &Session,
    queries: &dyn Queries,
    expression: &str,
    commands: &mut Vec<Command>,
) -> Result<String, String> {
    let chain = queries.boolean(expression)?;
    let data = session.data();
    let cells = chain.entries().iter().map(|&(index, _)| crate::CellRef { dim: data.dim(), index });
    let bounded: Vec<_> = cells.filter(|&c| !data.is_exterior(c)).collect();
    let unbounded = bounded.len() < chain.entries().len();
    let size: f64 = bounded.iter().filter_map(|&c| Some(data.measures(c)?.size)).sum();
    let size = if unbounded { "unbounded".to_owned() } else { super::inspector::number(size) };
    let measure = if data.dim() == 3 { "volume" } else { "area" };
    let text = format!("{} cells, {measure} {size}", chain.entries().len());
    commands.push(Command::ShowChain(Highlight { label: expression.trim().to_owned(), chain, within: None }));
    Ok(text)
}

fn replay(
    ui: &mut Ui,
    session: &Session,
    queries: &dyn Queries,
    texts: &mut Texts,
    commands: &mut Vec<Command>,
) {
    let Some(replay) = session.replay() else {
        let cell = session.selected().filter(|c| c.dim == session.data().dim());
        let button = egui::Button::new("Replay gift wrapping");
        let response = ui.add_enabled(cell.is_some(), button);
        if let Some(cell) = cell.filter(|_| response.clicked()) {
            match queries.wrapping(cell.index) {
                Ok(steps) => commands.push(Command::StartReplay(cell, steps)),
                Err(error) => texts.expression_result = Some(Err(error)),
            }
        }
        if cell.is_none() {
            ui.weak("of a selected cell");
        }
        return;
    };
    ui.strong(format!("Gift wrapping of {}", replay.cell()));
    ui.label(replay.caption());
    let (at, last) = (replay.picture(), replay.n_pictures() - 1);
    ui.horizontal(|ui| {
        if ui.add_enabled(0 < at, egui::Button::new("Previous")).clicked() {
            commands.push(Command::GoTo(at - 1));
        }
        if ui.add_enabled(at < last, egui::Button::new("Next")).clicked() {
            commands.push(Command::GoTo(at + 1));
        }
        if ui.button("End replay").clicked() {
            commands.push(Command::ClearHighlight);
        }
    });
    let mut picture = at;
    if 0 < last && ui.add(Slider::new(&mut picture, 0..=last).text("picture")).changed() {
        commands.push(Command::GoTo(picture));
    }
    ui.small("red: the chain c · yellow: ∂c · blue: the corolla");
}
