//! What a user asks of a session, and what it does then.

use super::history::History;
use super::{Exterior, Highlight, Replay, Session, WrapStep};
use crate::CellRef;

/// Cells that were selected before, which the way back leads through.
const TRAIL_LIMIT: usize = 500;

/// Which chain of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// ∂: the cells in its boundary.
    Boundary,
    /// δ: the cells in whose boundary it is.
    Coboundary,
}

/// What a user asks of a session.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Shows or hides all cells of a dimension.
    ToggleLayer(u8),
    /// Shows the exterior in another way.
    SetExterior(Exterior),
    /// Hides cells.
    Hide(Vec<CellRef>),
    /// Shows cells that were hidden or outside of what is isolated.
    Show(Vec<CellRef>),
    /// Shows cells alone, with their boundaries.
    Isolate(Vec<CellRef>),
    /// Shows everything.
    ShowAll,
    /// Multiplies the opacity of a solid's cells, those that it is the first to contain; a step to be undone once it rests, as
    /// with [`Session::opacity`].
    SetOpacity(u32, f32),
    /// Takes the last change of what is visible back: cells, dimensions, exterior, numbers, clip plane, opacity, outline.
    Undo,
    /// Makes it again.
    Redo,
    /// Turns numbers on the cells of a dimension on or off.
    ToggleNumbers(u8),
    /// Selects a cell, or nothing.
    Select(Option<CellRef>),
    /// Selects what was selected before.
    Back,
    /// Highlights the boundary or coboundary chain of a cell.
    Highlight(CellRef, Relation),
    /// Highlights any chain.
    ShowChain(Highlight),
    /// Highlights nothing and ends the replay.
    ClearHighlight,
    /// Adds a point to measure from.
    Measure([f64; 3]),
    /// Forgets the points to measure from.
    ClearMeasuring,
    /// Begins the replay of a cell's gift wrapping.
    StartReplay(CellRef, Vec<WrapStep>),
    /// Goes to a picture of the replay.
    GoTo(usize),
}

impl Session {
    /// Does what is asked. What names cells that do not exist changes nothing.
    pub fn apply(&mut self, command: Command) {
        match command {
            Command::ToggleLayer(_)
            | Command::SetExterior(_)
            | Command::Hide(_)
            | Command::Show(_)
            | Command::Isolate(_)
            | Command::ShowAll
            | Command::ToggleNumbers(_) => {
                self.settle();
                self.change_visibility(command);
                self.settle();
            }
            Command::SetOpacity(solid, opacity) => self.visibility.set_opacity_of(solid, opacity),
            Command::Undo => self.travel(History::undo),
            Command::Redo => self.travel(History::redo),
            Command::Select(cell) => self.select(cell),
            Command::Back => {
                self.selected = self.trail.pop().or(self.selected);
                self.highlight = None;
            }
            Command::Highlight(cell, relation) => self.highlight_relation(cell, relation),
            Command::ShowChain(highlight) => self.highlight = Some(highlight),
            Command::ClearHighlight => (self.highlight, self.replay) = (None, None),
            Command::Measure(point) => self.measuring.push(point),
            Command::ClearMeasuring => self.measuring.clear(),
            Command::StartReplay(cell, steps) => {
                self.highlight = None;
                self.replay = Replay::new(cell, steps);
            }
            Command::GoTo(picture) => self.replay.iter_mut().for_each(|r| r.go_to(picture)),
        }
    }

    fn change_visibility(&mut self, command: Command) {
        let exterior = CellRef { dim: self.data.dim(), index: 0 };
        let names_exterior = |cells: &[CellRef]| self.data.has_exterior() && cells.contains(&exterior);
        match &command {
            Command::Hide(cells) if names_exterior(cells) => self.visibility.exterior = Exterior::Hidden,
            Command::Show(cells) | Command::Isolate(cells)
                if names_exterior(cells) && self.visibility.exterior == Exterior::Hidden =>
            {
                self.visibility.exterior = Exterior::Shell;
            }
            _ => {}
        }
        let existing = |mut cells: Vec<CellRef>| {
            cells.retain(|&c| self.data.contains(c));
            cells
        };
        match command {
            Command::ToggleLayer(dim) => toggle(&mut self.visibility.layers, dim),
            Command::ToggleNumbers(dim) => toggle(&mut self.numbers, dim),
            Command::SetExterior(exterior) => self.visibility.exterior = exterior,
            Command::Hide(cells) => self.visibility.hide(&existing(cells)),
            Command::Show(cells) => self.visibility.show(&self.data, &existing(cells)),
            Command::Isolate(cells) => self.visibility.isolate(&self.data, &existing(cells)),
            _ => self.visibility.show_all(),
        }
    }

    fn select(&mut self, cell: Option<CellRef>) {
        let cell = cell.filter(|&c| self.data.contains(c));
        if cell != self.selected {
            self.trail.extend(self.selected);
            let excess = self.trail.len().saturating_sub(TRAIL_LIMIT);
            self.trail.drain(..excess);
            self.selected = cell;
            self.highlight = None;
        }
    }

    fn highlight_relation(&mut self, cell: CellRef, relation: Relation) {
        let (symbol, chain) = match relation {
            Relation::Boundary => ("∂", self.data.boundary(cell)),
            Relation::Coboundary => ("δ", self.data.coboundary(cell)),
        };
        let top = relation == Relation::Boundary && cell.dim == self.data.dim();
        if let Some(chain) = chain {
            let within = top.then_some(cell);
            self.highlight = Some(Highlight { label: format!("{symbol} {cell}"), chain, within });
        }
    }
}

fn toggle(flags: &mut [bool; 4], dim: u8) {
    if let Some(flag) = flags.get_mut(usize::from(dim)) {
        *flag = !*flag;
    }
}
