//! Models: points plus cells of every dimension 0..=d, given as sets of vertices.
//!
//! This is what generators and files produce and what a [`Struct`](crate::Struct) places in space. A model
//! carries no orientation: signs enter when it becomes a [`Surface`](crate::Surface) or a
//! [`ChainComplex`](crate::ChainComplex).

use crate::{Affine, AffineError, Cells, Points, VertexId};
use std::sync::LazyLock;

static NO_CELLS: LazyLock<Cells> = LazyLock::new(Cells::new);

/// Points and, for each dimension p = 0..=d, the p-cells as lists of vertices.
///
/// Two forms of 2-cells occur. When the model has 1-cells, a 2-cell is the *set* of its vertices in any order
/// (grids list them in grid order) and its boundary is found by incidence. When it has none, a 2-cell is a
/// *cyclic loop* of vertices and its orientation means something.
///
/// ```
/// use lar_core::{Cells, Model, Points};
/// let triangle = Model::new(
///     Points::from_columns(2, vec![0., 0., 1., 0., 0., 1.]),
///     vec![Cells::singletons(3), Cells::uniform(2, vec![0, 1, 0, 2, 1, 2]), Cells::uniform(3, vec![0, 1, 2])],
/// );
/// assert_eq!((triangle.dim(), triangle.f_vector()), (2, vec![3, 3, 1]));
/// assert!(triangle.validate().is_empty());
/// ```
#[doc(alias = "LAR")]
#[doc(alias = "LARmodel")]
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    points: Points,
    cells: Vec<Cells>,
}

/// A way in which a model is malformed; [`Model::validate`] lists them all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelViolation {
    /// A cell names a vertex that does not exist.
    #[error("{dim}-cell {cell} names vertex {vertex}, but there are {n_vertices} vertices")]
    VertexOutOfRange {
        /// Dimension of the cell.
        dim: usize,
        /// Index of the cell among those of its dimension.
        cell: usize,
        /// The vertex it names.
        vertex: VertexId,
        /// The number of vertices.
        n_vertices: usize,
    },
    /// A cell names one vertex twice.
    #[error("{dim}-cell {cell} names vertex {vertex} more than once")]
    RepeatedVertex {
        /// Dimension of the cell.
        dim: usize,
        /// Index of the cell among those of its dimension.
        cell: usize,
        /// The repeated vertex.
        vertex: VertexId,
    },
    /// A p-cell has fewer than p + 1 vertices, or a 0- or 1-cell has more than 1 or 2.
    #[error("{dim}-cell {cell} has {found} vertices")]
    CellSize {
        /// Dimension of the cell.
        dim: usize,
        /// Index of the cell among those of its dimension.
        cell: usize,
        /// The number of its vertices.
        found: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("coordinate {axis} of vertex {vertex} is {value}")]
    NonFinite {
        /// The vertex.
        vertex: VertexId,
        /// Which coordinate, from 0.
        axis: usize,
        /// Its value.
        value: f64,
    },
}

impl Model {
    /// A model from its points and its cells: `cells[p]` are the p-cells. Nothing is checked here; see
    /// [`validate`](Self::validate).
    #[must_use]
    pub fn new(points: Points, cells: Vec<Cells>) -> Self {
        Self { points, cells }
    }

    /// A model of cyclic faces: 0-cells are all points, no 1-cells, and each 2-cell an oriented loop.
    #[must_use]
    pub fn from_faces(points: Points, faces: Cells) -> Self {
        let vertices = Cells::singletons(points.len());
        Self { points, cells: vec![vertices, Cells::new(), faces] }
    }

    /// Positions of the vertices.
    #[must_use]
    pub fn points(&self) -> &Points {
        &self.points
    }

    /// The p-cells; none for p above [`dim`](Self::dim).
    #[must_use]
    pub fn cells(&self, p: usize) -> &Cells {
        self.cells.get(p).unwrap_or(&NO_CELLS)
    }

    /// Dimension d of the highest cells that the model lists, 0 when it lists none. The dimension of the space
    /// is `points().dim()`.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.cells.len().saturating_sub(1)
    }

    /// The number of cells of each dimension 0..=d.
    #[must_use]
    pub fn f_vector(&self) -> Vec<usize> {
        self.cells.iter().map(Cells::len).collect()
    }

    /// Takes the parts out: points, cells by dimension.
    #[must_use]
    pub fn into_parts(self) -> (Points, Vec<Cells>) {
        (self.points, self.cells)
    }

    /// The model moved by an affine map. Cyclic faces (2-cells of a model without 1-cells) are reversed when
    /// the map mirrors, so that an outward face stays outward. O(size).
    ///
    /// # Errors
    /// When the map is not of the model's space.
    pub fn transformed(&self, map: &Affine) -> Result<Self, AffineError> {
        let points = map.apply(&self.points)?;
        let mut cells = self.cells.clone();
        if map.is_mirror() && self.cells(1).is_empty() && self.dim() >= 2 {
            cells[2] = cells[2].iter().map(|c| c.iter().rev().copied().collect::<Vec<_>>()).collect();
        }
        Ok(Self { points, cells })
    }

    /// All ways in which the model is malformed, in the order coordinates, then cells by dimension; empty when
    /// it is well-formed. O(size) time plus the sorting of each cell.
    #[must_use]
    pub fn validate(&self) -> Vec<ModelViolation> {
        let mut found = Vec::new();
        for (i, axis, value) in self.points.non_finite() {
            found.push(ModelViolation::NonFinite { vertex: vertex(i), axis, value });
        }
        for (dim, cells) in self.cells.iter().enumerate() {
            for (cell, vertices) in cells.iter().enumerate() {
                self.check_cell(dim, cell, vertices, &mut found);
            }
        }
        found
    }

    fn check_cell(&self, dim: usize, cell: usize, vertices: &[u32], found: &mut Vec<ModelViolation>) {
        let n_vertices = self.points.len();
        if vertices.len() < dim + 1 || (dim < 2 && vertices.len() > dim + 1) {
            found.push(ModelViolation::CellSize { dim, cell, found: vertices.len() });
        }
        for &v in vertices.iter().filter(|&&v| v as usize >= n_vertices) {
            found.push(ModelViolation::VertexOutOfRange { dim, cell, vertex: VertexId(v), n_vertices });
        }
        let mut sorted = vertices.to_vec();
        sorted.sort_unstable();
        let mut repeated: Vec<u32> = sorted.windows(2).filter(|w| w[0] == w[1]).map(|w| w[0]).collect();
        repeated.dedup();
        for v in repeated {
            found.push(ModelViolation::RepeatedVertex { dim, cell, vertex: VertexId(v) });
        }
    }
}

fn vertex(i: usize) -> VertexId {
    VertexId(u32::try_from(i).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(model: &Model, expected: &[&str]) {
        let found: Vec<String> = model.validate().iter().map(ToString::to_string).collect();
        assert_eq!(found, expected);
    }

    fn square() -> Points {
        Points::from_columns(2, vec![0., 0., 1., 0., 1., 1., 0., 1.])
    }

    #[test]
    fn violations_are_all_listed() {
        check(&Model::from_faces(square(), Cells::uniform(4, vec![0, 1, 2, 3])), &[]);
        check(
            &Model::from_faces(square(), [&[0, 1, 9][..], &[0, 1], &[1, 2, 1, 1]].into_iter().collect()),
            &[
                "2-cell 0 names vertex v9, but there are 4 vertices",
                "2-cell 1 has 2 vertices",
                "2-cell 2 names vertex v1 more than once",
            ],
        );
        let mut points = square();
        points.coords_mut()[3] = f64::NAN;
        let edges = Cells::uniform(3, vec![0, 1, 2]);
        check(
            &Model::new(points, vec![Cells::singletons(4), edges]),
            &["coordinate 1 of vertex v1 is NaN", "1-cell 0 has 3 vertices"],
        );
    }

    #[test]
    fn mirrors_reverse_cyclic_faces_only() {
        let mirror = crate::s(&[-1., 1.]);
        let cyclic = Model::from_faces(square(), Cells::uniform(4, vec![0, 1, 2, 3]));
        assert_eq!(&cyclic.transformed(&mirror).unwrap().cells(2)[0], [3, 2, 1, 0]);
        let grid = crate::cuboid_grid(&[1, 1]);
        assert_eq!(grid.transformed(&mirror).unwrap().cells(2), grid.cells(2));
    }
}
