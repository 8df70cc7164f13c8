//! The laws of a chain complex, one check a file; each lists every violation.
//!
//! [`ChainComplex::validate`] runs all that hold for any complex; [`ChainComplex::validate_with_exterior`] also
//! those of a complex whose d-cells include the exterior. A law that needs operators to fit each other is only
//! tried where they do.

mod edges;
mod entries;
mod exterior;
mod points;
mod shapes;
mod squares;

use crate::{ChainComplex, EdgeId, VertexId};

/// A law that a chain complex breaks, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Violation {
    /// ∂p has not one row for each (p−1)-cell.
    #[error("∂{p} has {rows} rows, but there are {cells} {}-cells", .p - 1)]
    Shape {
        /// Which operator.
        p: usize,
        /// Its rows.
        rows: usize,
        /// The number of (p−1)-cells.
        cells: usize,
    },
    /// ∂p is stored by rows, not by columns.
    #[error("∂{p} is stored by rows; boundary operators are stored by columns")]
    Storage {
        /// Which operator.
        p: usize,
    },
    /// An entry is not −1, 0 or +1.
    #[error("entry ({row}, {column}) of ∂{p} is {value}; entries are -1, 0 or 1")]
    Entry {
        /// Which operator.
        p: usize,
        /// The (p−1)-cell.
        row: u32,
        /// The p-cell.
        column: u32,
        /// The entry.
        value: i8,
    },
    /// The column of an edge is not −1 at its smaller and +1 at its larger vertex.
    #[error("edge {edge} has entries {}; an edge has -1 at its smaller vertex and 1 at its larger", list(.entries))]
    Edge {
        /// The edge.
        edge: EdgeId,
        /// Its column.
        entries: Vec<(VertexId, i8)>,
    },
    /// The boundary of the boundary of a cell is not zero.
    #[error("∂{}·∂{p} is {value} at ({row}, {column}), not 0", .p - 1)]
    Square {
        /// Dimension of the cell whose boundary is open.
        p: usize,
        /// The (p−2)-cell.
        row: u32,
        /// The p-cell.
        column: u32,
        /// The entry of the product.
        value: i64,
    },
    /// More than two d-cells of a complex in d-space meet in a (d−1)-cell, or two lie on the same side of it.
    #[error("row {row} of ∂{p} has entries {}; a cell has at most one cell on each side", list(.entries))]
    Sides {
        /// Which operator.
        p: usize,
        /// The (p−1)-cell.
        row: u32,
        /// The p-cells beside it with their signs.
        entries: Vec<(u32, i8)>,
    },
    /// With an exterior cell, a (d−1)-cell has a cell on one side only.
    #[error("row {row} of ∂{p} has entries {}; with an exterior cell a row sums to 0", list(.entries))]
    OneSided {
        /// Which operator.
        p: usize,
        /// The (p−1)-cell.
        row: u32,
        /// The p-cells beside it with their signs.
        entries: Vec<(u32, i8)>,
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

fn list(entries: &[(impl ToString, i8)]) -> String {
    if entries.is_empty() {
        return "none".to_owned();
    }
    entries
        .iter()
        .map(|(cell, sign)| format!("{sign} at {}", cell.to_string()))
        .collect::<Vec<_>>()
        .join(", ")
}

impl ChainComplex {
    /// All violations of the laws that every complex keeps: operators fit, their entries are −1, 0, +1, each
    /// edge runs from its smaller to its larger vertex, ∂p·∂p+1 = 0, at most one d-cell of a complex in
    /// d-space on each side of a (d−1)-cell, finite points. Empty when all hold. O(size · log).
    ///
    /// That rows are distinct in each column is kept by the matrix type itself.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let grid = ChainComplex::from_model(&cuboid_grid(&[3, 2, 1])).unwrap();
    /// assert!(grid.validate().is_empty());
    /// assert_eq!(grid.validate_with_exterior().len(), 22);
    /// ```
    #[must_use]
    pub fn validate(&self) -> Vec<Violation> {
        let mut found = Vec::new();
        points::check(self, &mut found);
        shapes::check(self, &mut found);
        let fits = found.iter().all(|v| !matches!(v, Violation::Shape { .. } | Violation::Storage { .. }));
        if fits {
            entries::check(self, &mut found);
            edges::check(self, &mut found);
            squares::check(self, &mut found);
            exterior::check_sides(self, &mut found);
        }
        found
    }

    /// As [`validate`](Self::validate), for a complex whose d-cells include the exterior: each row of ∂d also
    /// sums to zero, so it has two entries, or none where a dangling cell has one d-cell on both sides.
    #[must_use]
    pub fn validate_with_exterior(&self) -> Vec<Violation> {
        let mut found = self.validate();
        if found.iter().all(|v| !matches!(v, Violation::Shape { .. } | Violation::Storage { .. })) {
            exterior::check_sums(self, &mut found);
        }
        found
    }
}

impl ChainComplex {
    /// The operators that do not fit each other or the points.
    pub(crate) fn shape_violations(&self) -> Vec<Violation> {
        let mut found = Vec::new();
        shapes::check(self, &mut found);
        found
    }

    /// What keeps the operators from being composed to zero: those that do not fit, or else the products
    /// ∂p·∂p+1 that are not zero.
    pub(crate) fn composition_violations(&self) -> Vec<Violation> {
        let mut found = self.shape_violations();
        if found.is_empty() {
            squares::check(self, &mut found);
        }
        found
    }
}

#[cfg(test)]
pub(crate) mod fixtures {
    use super::Violation;
    use crate::complex::sign_columns;
    use crate::{ChainComplex, Points, cuboid_grid};

    /// Two cubes side by side, with the exterior as 3-cell 0.
    pub(crate) fn bar() -> ChainComplex {
        let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
        let d3 = bar.boundary(3);
        let cells: Vec<Vec<(u32, i8)>> = d3
            .outer_iterator()
            .map(|c| c.iter().map(|(f, &s)| (u32::try_from(f).unwrap(), s)).collect())
            .collect();
        let outer = bar.n_cells(2);
        let sums: Vec<(u32, i8)> = (0..u32::try_from(outer).unwrap())
            .map(|f| (f, -cells.iter().flatten().filter(|e| e.0 == f).map(|e| e.1).sum::<i8>()))
            .filter(|e| e.1 != 0)
            .collect();
        let columns = std::iter::once(sums).chain(cells);
        with_boundary(&bar, 3, sign_columns(outer, columns))
    }

    /// The complex with another ∂p.
    pub(crate) fn with_boundary(from: &ChainComplex, p: usize, operator: crate::Operator) -> ChainComplex {
        let mut boundaries: Vec<_> = (1..=from.dim()).map(|q| from.boundary(q).clone()).collect();
        boundaries[p - 1] = operator;
        ChainComplex::new(from.points().clone(), boundaries)
    }

    /// The complex with one stored entry of ∂p changed.
    pub(crate) fn with_entry(from: &ChainComplex, p: usize, entry: usize, value: i8) -> ChainComplex {
        let mut operator = from.boundary(p).clone();
        operator.data_mut()[entry] = value;
        with_boundary(from, p, operator)
    }

    pub(crate) fn with_points(from: &ChainComplex, points: Points) -> ChainComplex {
        ChainComplex::new(points, (1..=from.dim()).map(|q| from.boundary(q).clone()).collect())
    }

    /// Runs one check alone and compares its messages.
    #[track_caller]
    pub(crate) fn check(
        run: fn(&ChainComplex, &mut Vec<Violation>),
        complex: &ChainComplex,
        expected: &[&str],
    ) {
        let mut found = Vec::new();
        run(complex, &mut found);
        assert_eq!(found.iter().map(ToString::to_string).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn all_laws_together() {
        assert_eq!(bar().validate_with_exterior(), []);
        let broken = with_entry(&with_entry(&bar(), 1, 0, 1), 3, 0, 2);
        let kinds: Vec<String> = broken
            .validate_with_exterior()
            .iter()
            .map(|v| format!("{v:?}").split([' ', '{']).next().unwrap().to_owned())
            .collect();
        let expected = [
            "Entry", "Edge", "Square", "Square", "Square", "Square", "Square", "Square", "Sides", "OneSided",
        ];
        assert_eq!(kinds, expected);
    }
}
