//! Which cells are shown, and the way back.

use crate::{CellData, CellRef};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Sets of cells, one for each dimension. Copies share what they have in common, so that a history of them is cheap.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "[Vec<u32>; 4]", into = "[Vec<u32>; 4]")]
struct CellSets([Arc<BTreeSet<u32>>; 4]);

impl From<[Vec<u32>; 4]> for CellSets {
    fn from(sets: [Vec<u32>; 4]) -> Self {
        Self(sets.map(|set| Arc::new(set.into_iter().collect())))
    }
}

impl From<CellSets> for [Vec<u32>; 4] {
    fn from(CellSets(sets): CellSets) -> Self {
        sets.map(|set| set.iter().copied().collect())
    }
}

impl CellSets {
    fn contains(&self, cell: CellRef) -> bool {
        self.0.get(usize::from(cell.dim)).is_some_and(|set| set.contains(&cell.index))
    }

    fn insert(&mut self, cell: CellRef) {
        if let Some(set) = self.0.get_mut(usize::from(cell.dim)) {
            Arc::make_mut(set).insert(cell.index);
        }
    }

    fn remove(&mut self, cell: CellRef) {
        if let Some(set) = self.0.get_mut(usize::from(cell.dim)) {
            Arc::make_mut(set).remove(&cell.index);
        }
    }

    fn is_empty(&self) -> bool {
        self.0.iter().all(|set| set.is_empty())
    }

    /// The lowest dimension that is not empty; 3 when all are.
    fn lowest(&self) -> u8 {
        (0..3).find(|&dim| !self.0[usize::from(dim)].is_empty()).unwrap_or(3)
    }

    /// The highest dimension that is not empty; 0 when all are.
    fn highest(&self) -> u8 {
        (1..4).rev().find(|&dim| !self.0[usize::from(dim)].is_empty()).unwrap_or(0)
    }
}

/// How the exterior cell is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Exterior {
    /// Not at all.
    #[default]
    Hidden,
    /// As a white shell in its place, which the others are exploded out of.
    Shell,
    /// As a barely visible shell.
    Translucent,
}

impl Exterior {
    /// All ways.
    pub const ALL: [Self; 3] = [Self::Hidden, Self::Shell, Self::Translucent];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Hidden => "hidden",
            Self::Shell => "white shell",
            Self::Translucent => "translucent",
        }
    }
}

/// What is shown: dimensions, single cells hidden, some cells alone, the exterior.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Visibility {
    /// Whether vertices, edges, faces, cells are drawn.
    pub layers: [bool; 4],
    /// How the exterior is shown.
    pub exterior: Exterior,
    hidden: CellSets,
    /// The cells that are shown alone, with all cells in their boundaries.
    isolated: Option<CellSets>,
    /// What the opacity of cells is multiplied by, for single solids.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    opacities: BTreeMap<u32, f32>,
}

impl Default for Visibility {
    /// Cells and their edges.
    fn default() -> Self {
        Self {
            layers: [false, true, false, true],
            exterior: Exterior::default(),
            hidden: CellSets::default(),
            isolated: None,
            opacities: BTreeMap::new(),
        }
    }
}

impl Visibility {
    /// Whether a cell is neither hidden nor outside of what is isolated. Says nothing of its layer.
    #[must_use]
    pub fn shows(&self, cell: CellRef) -> bool {
        !self.hidden.contains(cell) && self.isolated.as_ref().is_none_or(|alone| alone.contains(cell))
    }

    /// What the opacity of the cells of a solid is multiplied by: of those that it is the first to contain.
    #[must_use]
    pub fn opacity_of(&self, solid: u32) -> f32 {
        self.opacities.get(&solid).map_or(1.0, |opacity| opacity.clamp(0.0, 1.0))
    }

    pub(super) fn set_opacity_of(&mut self, solid: u32, opacity: f32) {
        // What is nothing special is not remembered, so that equal states are equal.
        if (0.0..1.0).contains(&opacity) {
            self.opacities.insert(solid, opacity);
        } else {
            self.opacities.remove(&solid);
        }
    }

    /// Whether every cell is shown.
    #[must_use]
    pub fn shows_all(&self) -> bool {
        self.hidden.is_empty() && self.isolated.is_none()
    }

    /// The lowest dimension in which single cells are hidden or isolated for themselves; 3 when none are.
    #[must_use]
    pub(super) fn finest(&self) -> u8 {
        let hidden = self.hidden.lowest();
        hidden.min(self.isolated.as_ref().map_or(3, CellSets::highest))
    }

    /// Whether nothing of this dimension is isolated, but something of a lower one.
    #[must_use]
    pub(super) fn isolates_below(&self, unit: CellRef) -> bool {
        self.isolated.as_ref().is_some_and(|alone| alone.highest() < unit.dim)
    }

    /// The highest dimension of what is isolated.
    #[must_use]
    pub(super) fn isolated_dim(&self) -> Option<u8> {
        self.isolated.as_ref().map(CellSets::highest)
    }

    pub(super) fn hide(&mut self, cells: &[CellRef]) {
        cells.iter().for_each(|&c| self.hidden.insert(c));
    }

    /// Shows cells that were hidden; what is isolated grows by them.
    pub(super) fn show(&mut self, data: &CellData, cells: &[CellRef]) {
        cells.iter().for_each(|&c| self.hidden.remove(c));
        if let Some(alone) = &mut self.isolated {
            closure(data, cells).for_each(|c| alone.insert(c));
        }
    }

    /// Shows these cells alone, whether they were hidden or not.
    pub(super) fn isolate(&mut self, data: &CellData, cells: &[CellRef]) {
        let mut alone = CellSets::default();
        closure(data, cells).for_each(|c| alone.insert(c));
        cells.iter().for_each(|&c| self.hidden.remove(c));
        self.isolated = Some(alone);
    }

    pub(super) fn show_all(&mut self) {
        self.hidden = CellSets::default();
        self.isolated = None;
    }
}

fn closure<'a>(data: &CellData, cells: &'a [CellRef]) -> impl Iterator<Item = CellRef> + use<'a> {
    let closure = (0..).zip(data.closure(cells.iter().copied()));
    closure.flat_map(|(dim, cells)| cells.into_iter().map(move |index| CellRef { dim, index }))
}
