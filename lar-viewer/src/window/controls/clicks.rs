//! Clicks on the picture: what they are, and what they do once it is known what they hit.

use super::Controls;
use crate::session::Command;
use crate::{Camera, CellRef, Hit};
use egui::Response;
use glam::DVec3;

/// What a click does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tool {
    /// Selects a cell.
    #[default]
    Select,
    /// Picks points to measure between.
    Measure,
}

/// What a click selects.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum PickAs {
    /// The vertex, edge, or cell that is seen; the face when cells are not drawn.
    #[default]
    Seen,
    /// A cell of this dimension.
    Dimension(u8),
}

impl PickAs {
    pub(crate) const ALL: [Self; 5] =
        [Self::Seen, Self::Dimension(3), Self::Dimension(2), Self::Dimension(1), Self::Dimension(0)];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Seen => "anything",
            Self::Dimension(dim) => ["vertices", "edges", "faces", "cells"][usize::from(dim.min(3))],
        }
    }
}

/// A click on the picture, to be looked up there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Click {
    /// In points from the upper left corner of the picture.
    pub(crate) at: [f32; 2],
    /// Turns about the point instead of selecting.
    pub(crate) double: bool,
}

/// A click that was no drag, on the picture.
pub(super) fn click(response: &Response) -> Option<Click> {
    let at = response.interact_pointer_pos()? - response.rect.min;
    let double = response.double_clicked();
    (double || response.clicked()).then_some(Click { at: [at.x, at.y], double })
}

impl Controls {
    /// Does what a click asks for, now that it is known what it hit.
    pub(crate) fn clicked(&mut self, click: Click, hit: Option<Hit>) {
        if click.double {
            if let Some(hit) = hit {
                let target = (DVec3::from(hit.point) + DVec3::from(hit.moved)).to_array();
                self.view.camera = Camera { target, ..self.view.camera };
            }
        } else if self.tool == Tool::Measure {
            let point = hit.map(|hit| self.snapped(&hit));
            self.subject.apply(point.map(Command::Measure));
        } else {
            let picked = hit.and_then(|hit| self.picked(&hit));
            self.subject.apply([Command::Select(picked)]);
        }
        if let Err(error) = self.subject.update() {
            self.message = error.to_string();
        }
    }

    /// The point that was hit, or the vertex that it shows.
    fn snapped(&self, hit: &Hit) -> [f64; 3] {
        let vertex = hit.cell.filter(|c| c.dim == 0);
        let data = self.subject.explored.as_ref().map(|e| e.session.data());
        data.zip(vertex).and_then(|(data, v)| data.position(v.index)).unwrap_or(hit.point)
    }

    fn picked(&self, hit: &Hit) -> Option<CellRef> {
        let session = &self.subject.explored.as_ref()?.session;
        let layers = session.visibility().layers;
        let found = [hit.cell, hit.owner].into_iter().flatten();
        match self.pick_as {
            PickAs::Dimension(dim) => found.into_iter().find(|c| c.dim == dim),
            PickAs::Seen => {
                let through =
                    |c: &CellRef| c.dim == 2 && session.data().dim() == 3 && layers[3] && !layers[2];
                hit.cell.filter(|c| !through(c)).or(hit.owner)
            }
        }
    }
}
