//! What a user has made of a complex on show: what is visible, selected, highlighted, exploded, cut, measured.
//!
//! A session is state and commands. It needs neither a window nor a graphics card, so that everything a window can do is
//! tested without one; panels read it and send it [`Command`]s.

mod coloring;
mod command;
mod explode;
mod history;
mod measuring;
mod queries;
mod replay;
mod section;
mod settings;
mod stage;
mod visibility;

pub use coloring::{ColorBy, scale_color, size_range};
pub use command::{Command, Relation};
pub use explode::{Center, Explode, ExplodeBy, LEVEL_NAMES, Pieces};
pub use measuring::Measuring;
pub(crate) use queries::NOT_WRAPPED;
pub use queries::{NoQueries, Queries};
pub use replay::{Replay, WrapStep};
pub use section::{Normal, Section};
pub use settings::Settings;
pub use stage::Stage;
pub use visibility::{Exterior, Visibility};

use crate::{CellData, CellRef, INK, Outline, Outlined, Rgb, SLATE, WHITE};
use history::{History, Shown};
use lar_core::Chain;
use std::sync::Arc;

/// A chain that is made to stand out.
#[derive(Clone, Debug, PartialEq)]
pub struct Highlight {
    /// What it is, in words.
    pub label: String,
    /// The cells, with their signs.
    pub chain: Chain,
    /// The piece of the exploded complex in which it is shown; all pieces when `None`.
    pub within: Option<CellRef>,
}

/// What the drawables of a session are made from. Opaque: only equality counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    pub(crate) pieces: Pieces,
    numbers: [bool; 4],
    selected: Option<CellRef>,
    highlight: Option<Highlight>,
    measuring: Measuring,
    replay: Option<Replay>,
    visibility: Option<Visibility>,
}

/// A complex on show and the state of its show.
///
/// ```
/// use lar_core::{ChainComplex, cuboid_grid};
/// use lar_viewer::session::{Command, Session};
/// use lar_viewer::{CellData, CellRef};
/// let mut session = Session::new(CellData::new(ChainComplex::from_model(&cuboid_grid(&[2, 1, 1]))?)?);
/// let first = CellRef { dim: 3, index: 0 };
/// session.apply(Command::Hide(vec![first]));
/// assert!(!session.visibility().shows(first));
/// session.apply(Command::Undo);
/// assert!(session.visibility().shows(first));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Session {
    data: Arc<CellData>,
    visibility: Visibility,
    history: History<Shown>,
    /// What was visible when it was last remembered; set when the session is complete.
    settled: Option<Shown>,
    selected: Option<CellRef>,
    trail: Vec<CellRef>,
    highlight: Option<Highlight>,
    measuring: Measuring,
    replay: Option<Replay>,
    numbers: [bool; 4],
    /// How far the pieces are pulled apart.
    pub explode: Explode,
    /// The clip plane.
    pub section: Section,
    /// What colours mean.
    pub coloring: ColorBy,
    /// Opacity of triangles.
    pub opacity: f32,
    /// What has an outline.
    pub outline: Option<Outlined>,
    /// Colour behind everything.
    pub background: Rgb,
}

impl Session {
    /// Shows the cells of the highest dimension that a solid contains, or all of them where no solid is known, with their
    /// edges. O(cells).
    #[must_use]
    pub fn new(data: CellData) -> Self {
        let mut session = Self {
            data: Arc::new(data),
            visibility: Visibility::default(),
            history: History::default(),
            settled: None,
            selected: None,
            trail: Vec::new(),
            highlight: None,
            measuring: Measuring::default(),
            replay: None,
            numbers: [false; 4],
            explode: Explode::default(),
            section: Section::default(),
            coloring: ColorBy::default(),
            opacity: 1.0,
            outline: None,
            background: SLATE,
        };
        let dim = session.data.dim();
        session.visibility.layers[usize::from(dim)] = true;
        if !session.data.solids().is_empty() {
            let cells = (0..session.data.n_cells(dim) as u32).map(|index| CellRef { dim, index });
            let void = |c: &CellRef| !session.data.is_exterior(*c) && session.data.solids_of(*c).is_empty();
            let voids: Vec<CellRef> = cells.filter(void).collect();
            session.visibility.hide(&voids);
        }
        session
    }

    /// The same settings for another complex: what a reload keeps. Cells that are gone are no longer selected, and
    /// nothing is hidden, as the cells are numbered anew. O(cells).
    #[must_use]
    pub fn with_data(&self, data: CellData) -> Self {
        let mut next = Self::new(data);
        next.visibility.layers = self.visibility.layers;
        next.visibility.exterior = self.visibility.exterior;
        for solid in 0..next.data.solids().len() as u32 {
            next.visibility.set_opacity_of(solid, self.visibility.opacity_of(solid));
        }
        next.selected = self.selected.filter(|&c| next.data.contains(c));
        Self {
            numbers: self.numbers,
            explode: self.explode,
            section: self.section,
            coloring: self.coloring,
            opacity: self.opacity,
            outline: self.outline,
            background: self.background,
            ..next
        }
    }

    /// The complex and what is known of it.
    #[must_use]
    pub fn data(&self) -> &CellData {
        &self.data
    }

    /// What is visible.
    #[must_use]
    pub fn visibility(&self) -> &Visibility {
        &self.visibility
    }

    /// The outline, pale on a dark background.
    #[must_use]
    pub fn outline(&self) -> Option<Outline> {
        let is_dark = self.background.iter().sum::<f32>() < 0.6;
        let color = if is_dark { WHITE } else { INK };
        self.outline.map(|of| Outline { of, color, ..Outline::default() })
    }

    /// The selected cell.
    #[must_use]
    pub fn selected(&self) -> Option<CellRef> {
        self.selected
    }

    /// Whether something was selected before.
    #[must_use]
    pub fn can_go_back(&self) -> bool {
        !self.trail.is_empty()
    }

    /// The chain that stands out.
    #[must_use]
    pub fn highlight(&self) -> Option<&Highlight> {
        self.highlight.as_ref()
    }

    /// The points to measure from.
    #[must_use]
    pub fn measuring(&self) -> &Measuring {
        &self.measuring
    }

    /// The replay that runs.
    #[must_use]
    pub fn replay(&self) -> Option<&Replay> {
        self.replay.as_ref()
    }

    /// Whether the cells of each dimension carry their numbers.
    #[must_use]
    pub fn numbers(&self) -> [bool; 4] {
        self.numbers
    }

    /// Whether a cell of the highest dimension is drawn as a solid thing: shown, and not a hidden exterior.
    #[must_use]
    pub fn draws(&self, cell: CellRef) -> bool {
        let exterior = self.data.is_exterior(cell) && self.visibility.exterior == Exterior::Hidden;
        !exterior && self.visibility.shows(cell)
    }

    /// How finely the complex must be taken apart for what moves, is hidden and is coloured for itself.
    #[must_use]
    pub fn pieces(&self) -> Pieces {
        let faces_alone =
            self.data.dim() == 3 && (self.visibility.layers[2] || self.visibility.finest() == 2);
        let hidden = match self.visibility.finest() {
            0 => Pieces::Vertices,
            1 if self.visibility.layers[0] => Pieces::Vertices,
            1 => Pieces::Edges,
            _ if faces_alone => Pieces::Faces,
            _ => Pieces::Cells,
        };
        self.explode.pieces(self.data.dim()).max(hidden)
    }

    /// What the drawables are made from: while it stays equal, only looks change. O(cells hidden or highlighted).
    #[must_use]
    pub fn shape(&self) -> Shape {
        let faces_alone = self.selected.filter(|c| c.dim < self.data.dim());
        Shape {
            pieces: self.pieces(),
            numbers: self.numbers,
            selected: faces_alone,
            highlight: self.highlight.clone(),
            measuring: self.measuring.clone(),
            replay: self.replay.clone(),
            visibility: self.outlines_visible().then(|| self.visibility.clone()),
        }
    }

    /// Whether what stands out depends on which units are drawn.
    fn outlines_visible(&self) -> bool {
        self.highlight.is_some() || self.selected.is_some() || self.numbers.contains(&true)
    }
}

#[cfg(test)]
mod tests;
