//! Explosion as the user sets it.
//!
//! Pieces are nested: a solid holds cells, a cell faces, a face edges. Moving every level by the same factors up to the
//! cells moves each cell away from the centre as if there were no solids around it; so the plain modes are the
//! hierarchical one with equal factors.

use crate::{Explosion, LEVELS};
use serde::{Deserialize, Serialize};

/// How finely a complex is taken apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pieces {
    /// Cells of the highest dimension, each with its boundary.
    #[default]
    Cells,
    /// Each face of each cell, with its edges.
    Faces,
    /// Each edge of each face of each cell.
    Edges,
    /// Each edge and each vertex of each face of each cell.
    Vertices,
}

/// What an explosion stays in place around.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Center {
    /// The middle of the model.
    #[default]
    Model,
    /// The origin of the coordinates.
    Origin,
}

/// What is pulled apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExplodeBy {
    /// Solids from each other, each with all its cells.
    Solids,
    /// Cells.
    #[default]
    Cells,
    /// Faces.
    Faces,
    /// Edges.
    Edges,
    /// Solids, cells in their solids, faces in their cells, edges in their faces, each by a factor of its own.
    Hierarchy,
}

impl ExplodeBy {
    /// All ways.
    pub const ALL: [Self; 5] = [Self::Solids, Self::Cells, Self::Faces, Self::Edges, Self::Hierarchy];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Solids => "solids",
            Self::Cells => "cells",
            Self::Faces => "faces",
            Self::Edges => "edges",
            Self::Hierarchy => "hierarchy",
        }
    }
}

/// The levels of the hierarchy, outermost first.
pub const LEVEL_NAMES: [&str; LEVELS] = ["solids", "cells", "faces", "edges"];

/// Factors of an explosion, and what they move.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explode {
    /// What is pulled apart.
    pub by: ExplodeBy,
    /// Factors x, y, z; 1 leaves everything in place.
    pub factors: [f32; 3],
    /// Factors of the levels of the hierarchy, for [`ExplodeBy::Hierarchy`].
    pub levels: [f32; LEVELS],
    /// The fixed point.
    pub center: Center,
}

impl Default for Explode {
    /// Nothing moves.
    fn default() -> Self {
        Self { by: ExplodeBy::default(), factors: [1.0; 3], levels: [1.0; LEVELS], center: Center::Model }
    }
}

impl Explode {
    /// Cells moved by these factors.
    ///
    /// ```
    /// use lar_viewer::session::Explode;
    /// let explosion = Explode::cells([1.5; 3]).explosion();
    /// assert_eq!(explosion.factors, [[1.5; 3], [1.5; 3], [1.0; 3], [1.0; 3]]);
    /// ```
    #[must_use]
    pub fn cells(factors: [f32; 3]) -> Self {
        Self { factors, ..Self::default() }
    }

    /// The same for the renderer.
    #[must_use]
    pub fn explosion(&self) -> Explosion {
        let about = (self.center == Center::Origin).then_some([0.0; 3]);
        let moved = match self.by {
            ExplodeBy::Solids => 1,
            ExplodeBy::Cells => 2,
            ExplodeBy::Faces => 3,
            ExplodeBy::Edges | ExplodeBy::Hierarchy => LEVELS,
        };
        let of_level = |level| if level < moved { self.factors } else { [1.0; 3] };
        let factors = match self.by {
            ExplodeBy::Hierarchy => self.levels.map(|s| [s; 3]),
            _ => std::array::from_fn(of_level),
        };
        Explosion { factors, about }
    }

    /// The coarsest pieces that are moved for themselves in a complex of dimension `dim`: in the plane the cells are the
    /// faces.
    #[must_use]
    pub fn pieces(&self, dim: u8) -> Pieces {
        let levels = self.levels.map(|s| s != 1.0);
        match self.by {
            ExplodeBy::Solids | ExplodeBy::Cells => Pieces::Cells,
            ExplodeBy::Faces if dim < 3 => Pieces::Cells,
            ExplodeBy::Faces => Pieces::Faces,
            ExplodeBy::Edges => Pieces::Edges,
            ExplodeBy::Hierarchy if levels[3] || (levels[2] && dim < 3) => Pieces::Edges,
            ExplodeBy::Hierarchy if levels[2] => Pieces::Faces,
            ExplodeBy::Hierarchy => Pieces::Cells,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_as_fine_as_what_moves() {
        let by = |by| Explode { by, ..Explode::default() };
        let of = |explode: Explode| [explode.pieces(3), explode.pieces(2)];
        assert_eq!(of(by(ExplodeBy::Solids)), [Pieces::Cells; 2]);
        assert_eq!(of(by(ExplodeBy::Faces)), [Pieces::Faces, Pieces::Cells]);
        assert_eq!(of(by(ExplodeBy::Edges)), [Pieces::Edges; 2]);
        assert_eq!(of(by(ExplodeBy::Hierarchy)), [Pieces::Cells; 2]);
        let faces = Explode { levels: [1.0, 2.0, 1.5, 1.0], ..by(ExplodeBy::Hierarchy) };
        assert_eq!(of(faces), [Pieces::Faces, Pieces::Edges]);
        assert_eq!(faces.explosion().factors, [[1.0; 3], [2.0; 3], [1.5; 3], [1.0; 3]]);
    }

    #[test]
    fn cells_move_as_if_there_were_no_solids() {
        let explode = Explode::cells([3.0, 1.0, 2.0]);
        let nested = explode.explosion().displacement(&[[1.0, 0.0, 4.0], [2.0, 5.0, 5.0]], [0.0; 3]);
        assert_eq!(nested, [4.0, 0.0, 5.0]);
        let origin = Explode { center: Center::Origin, ..explode };
        assert_eq!(origin.explosion().about, Some([0.0; 3]));
    }
}
