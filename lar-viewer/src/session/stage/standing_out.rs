//! What stands out of the pieces: selection, highlighted chain, replay, measurements, numbers.

use super::shapes::stroke;
use super::{Place, Stage, dots, fill};
use crate::session::{Highlight, Pieces, Session};
use crate::{CellData, CellRef, Drawable, GroupId, Rgb, Scene, TextStyle, ViewerError, push_numbers};

/// Colours of positive and negative cells of a chain.
const SIGN_COLORS: [Rgb; 2] = [[0.99, 0.55, 0.10], [0.15, 0.55, 0.98]];
/// Colour of a selected face, edge or vertex.
const SELECTED: Rgb = [1.0, 0.85, 0.15];
/// Colour of the chain of a replay, of its boundary, and of the corolla.
const REPLAY_COLORS: [Rgb; 3] = [[0.93, 0.33, 0.28], [0.98, 0.85, 0.20], [0.26, 0.52, 0.90]];
/// Colour of points and lines that are measured.
const MEASURED: Rgb = [0.95, 0.25, 0.60];

impl Stage {
    /// What stands out, in the groups of the pieces: numbers first.
    ///
    /// # Errors
    /// Those of [`Scene::push`].
    pub fn standing_out(&self, session: &Session) -> Result<Scene, ViewerError> {
        let mut scene = self.pieces.without_drawables();
        push_numbers(&mut scene, self.numbered(session), &TextStyle::default(), true)?;
        let chains = self.chains(session).into_iter().chain(measured(session.measuring().points()));
        chains.into_iter().try_for_each(|drawable| scene.push(drawable))?;
        Ok(scene)
    }

    /// Selection, highlighted chain and replay.
    fn chains(&self, session: &Session) -> Vec<Drawable> {
        let data = session.data();
        let mut found = Vec::new();
        if let Some(cell) = session.selected().filter(|c| !self.is_unit(*c)) {
            found.extend(self.cells(session, &[(cell, SELECTED)], None));
        }
        if let Some(Highlight { chain, within, .. }) = session.highlight() {
            let dim = chain.dim() as u8;
            let signed = chain
                .entries()
                .iter()
                .map(|&(index, sign)| (CellRef { dim, index }, SIGN_COLORS[usize::from(sign < 0)]));
            let signed: Vec<_> = signed.filter(|(c, _)| !self.is_unit(*c)).collect();
            found.extend(self.cells(session, &signed, *within));
        }
        if let Some(replay) = session.replay() {
            let step = replay.step();
            let mut parts = vec![(&step.chain, REPLAY_COLORS[0]), (&step.boundary, REPLAY_COLORS[1])];
            if replay.shows_corolla() {
                parts.push((&step.corolla, REPLAY_COLORS[2]));
            }
            for (chain, color) in parts {
                let dim = chain.dim() as u8;
                let cells: Vec<_> =
                    chain.entries().iter().map(|&(index, _)| (CellRef { dim, index }, color)).collect();
                found.extend(self.cells(session, &cells, Some(replay.cell())));
            }
        }
        debug_assert!(found.iter().all(|d| d.cell_ref().is_none_or(|c| data.contains(c))));
        found
    }

    /// The cells that carry their numbers, each once, well inside: in the first unit that is drawn.
    fn numbered(&self, session: &Session) -> Vec<(CellRef, [f64; 3], Option<GroupId>)> {
        let data = session.data();
        let mut found = Vec::new();
        for dim in (0..=data.dim()).filter(|&dim| session.numbers()[usize::from(dim)]) {
            let cells = (0..data.n_cells(dim) as u32).map(|index| CellRef { dim, index });
            for cell in cells.filter(|&c| session.visibility().shows(c)) {
                let units = data.units_of(cell).into_iter();
                let shown = units.filter(|&u| session.draws(u) || session.visibility().isolates_below(u));
                // The exterior stays in place: what others share with it carries its number with them.
                let unit = shown.min_by_key(|&u| data.is_exterior(u));
                let group = unit.and_then(|unit| self.groups_of(data, unit, cell).first().copied());
                let at = || {
                    *self.numbers_at[usize::from(dim)][cell.index as usize].get_or_init(|| data.inside(cell))
                };
                found.extend(group.map(|group| (cell, at(), group)));
            }
        }
        found
    }

    fn is_unit(&self, cell: CellRef) -> bool {
        cell.dim == 3 || self.groups.contains_key(&Place::unit(cell))
    }

    /// Cells in these colours, in every unit that has them and is drawn, or in one.
    fn cells(&self, session: &Session, cells: &[(CellRef, Rgb)], within: Option<CellRef>) -> Vec<Drawable> {
        let data = session.data();
        let mut found = Vec::new();
        for &(cell, color) in cells {
            let mut units = within.map_or_else(|| data.units_of(cell), |unit| vec![unit]);
            if within.is_none() && units.iter().any(|&u| session.draws(u)) {
                units.retain(|&u| session.draws(u));
            }
            for unit in units {
                let drawable = match cell.dim {
                    0 => dots(data, &[cell.index]).size(11.0),
                    1 => stroke(data, cell.index).width(5.0),
                    _ => fill(data, unit, &[cell.index]),
                };
                let drawable = drawable.color(color).cell(unit);
                found.extend(self.groups_of(data, unit, cell).into_iter().map(|group| match group {
                    Some(group) => drawable.clone().group(group),
                    None => drawable.clone(),
                }));
            }
        }
        found
    }

    /// The groups in which a cell of a unit is drawn.
    fn groups_of(&self, data: &CellData, unit: CellRef, cell: CellRef) -> Vec<Option<GroupId>> {
        let by_face = unit.dim == 3 && self.fineness != Pieces::Cells && cell.dim <= 2;
        let faces =
            if by_face { data.cells_above(cell, 2).into_iter().map(Some).collect() } else { vec![None] };
        let edge = (cell.dim == 1 && Pieces::Edges <= self.fineness).then_some(cell.index);
        let places = faces.into_iter().map(|face| Place { face, edge, ..Place::unit(unit) });
        let found: Vec<_> = places.filter_map(|place| self.groups.get(&place)).map(|&g| Some(g)).collect();
        let whole = self.groups.get(&Place::unit(unit)).copied();
        if found.is_empty() { vec![whole] } else { found }
    }
}

fn measured(points: &[[f64; 3]]) -> Vec<Drawable> {
    if points.is_empty() {
        return Vec::new();
    }
    let segments = points.windows(2).map(|w| [w[0], w[1]]);
    let lines = Drawable::lines("measured", segments).width(2.5).color(MEASURED).unclipped();
    vec![Drawable::points("measured", points.iter().copied()).size(10.0).color(MEASURED).unclipped(), lines]
}
