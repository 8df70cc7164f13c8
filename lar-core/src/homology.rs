//! Betti numbers: the ranks of the homology of a chain complex over a field.
//!
//! βp = n_p − rank ∂p − rank ∂p+1. Ranks are found over the field of q elements, q prime, from exact sparse
//! elimination in this order, so that little is left to eliminate in the usual complexes:
//!
//! 1. ∂1 is a graph: its rank is the number of edges of a spanning forest (disjoint sets). Since ∂1∂2 = 0, the
//!    rows of those edges in ∂2 depend on the others and are left out.
//! 2. From ∂d downwards: where no (p−1)-cell has more than two p-cells, ∂p is a graph as well, with p-cells as
//!    nodes. A row basis of ∂p names columns of ∂p−1 that depend on the others and are left out (the "clearing"
//!    of persistent homology, done for any field).
//! 3. What is left is eliminated, columns and rows of a single entry first (they cause no fill-in, and are what
//!    a collapse removes), then rows of few entries.
//!
//! Source: Chen, Kersten, "Persistent homology computation with a twist", EuroCG 2011, for the clearing; the
//! tree and cotree of steps 1 and 2 are Eppstein's, "Dynamic generators of topologically embedded graphs", 2003.

mod elimination;
mod field;
mod graph_rank;

use crate::listing::first_few;
use crate::{ChainComplex, Violation};
use field::Field;

/// 2^31 − 1, a prime so large that the ranks of the operators modulo it are those over the rational numbers
/// unless the homology has torsion of this very order.
const LARGE_PRIME: u32 = 2_147_483_647;

/// Why a complex has no homology.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HomologyError {
    /// The operators do not fit each other, or the boundary of a boundary is not zero; all violations.
    #[error("not a chain complex: {}", first_few(.0))]
    NotComplex(Vec<Violation>),
    /// Integers modulo a number that is not prime are no field.
    #[error("the integers modulo {modulus} are no field: {modulus} is not a prime")]
    NotPrime {
        /// The number.
        modulus: u32,
    },
}

impl ChainComplex {
    /// The Betti numbers β0 … βd over the rational numbers: components, handles, cavities, …; of a complex with
    /// exterior cell those of the sphere of which the cells are a partition.
    ///
    /// Ranks are taken modulo 2^31 − 1; they are those over the rationals unless the homology has torsion of
    /// that order. Almost linear time for surfaces, and in practice for solids.
    ///
    /// # Errors
    /// When the operators do not fit each other or ∂p·∂p+1 is not zero; all violations are listed.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let solid = ChainComplex::from_model(&cuboid_grid(&[3, 2, 1])).unwrap();
    /// assert_eq!(solid.betti_numbers().unwrap(), [1, 0, 0, 0]);
    /// assert_eq!(solid.with_exterior().unwrap().betti_numbers().unwrap(), [1, 0, 0, 1]);
    /// ```
    pub fn betti_numbers(&self) -> Result<Vec<usize>, HomologyError> {
        self.betti_numbers_modulo(LARGE_PRIME)
    }

    /// The Betti numbers over the field of `prime` elements. Where they differ from
    /// [`betti_numbers`](Self::betti_numbers), the integral homology has torsion of that order. The same cost.
    ///
    /// # Errors
    /// As [`betti_numbers`](Self::betti_numbers), and when `prime` is not prime.
    ///
    /// ```
    /// use lar_core::{Cells, ChainComplex, Model, Points};
    /// let points = Points::from_columns(2, (0..12).map(f64::from).collect());
    /// let faces = [
    ///     0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 1, 1, 2, 4, 2, 3, 5, 3, 4, 1, 4, 5, 2, 5, 1, 3,
    /// ];
    /// let projective_plane = Model::from_faces(points, Cells::uniform(3, faces.to_vec()));
    /// let complex = ChainComplex::from_model(&projective_plane).unwrap();
    /// assert_eq!(complex.betti_numbers().unwrap(), [1, 0, 0]);
    /// assert_eq!(complex.betti_numbers_modulo(2).unwrap(), [1, 1, 1]);
    /// ```
    pub fn betti_numbers_modulo(&self, prime: u32) -> Result<Vec<usize>, HomologyError> {
        let field = Field::new(prime).ok_or(HomologyError::NotPrime { modulus: prime })?;
        let violations = self.composition_violations();
        if !violations.is_empty() {
            return Err(HomologyError::NotComplex(violations));
        }
        let ranks = self.ranks(field);
        let betti = |p: usize| self.n_cells(p) - ranks[p] - ranks[p + 1];
        Ok((0..=self.dim()).map(betti).collect())
    }

    /// The rank of ∂p at place p, for p = 0..=d+1; those at both ends are 0.
    fn ranks(&self, field: Field) -> Vec<usize> {
        let mut ranks = vec![0; self.dim() + 2];
        if self.dim() == 0 {
            return ranks;
        }
        let forest = Matrix::new(self, 1, field, &[], &[]).column_basis(field);
        ranks[1] = forest.len();
        let mut dependent: Vec<u32> = Vec::new();
        for p in (2..=self.dim()).rev() {
            let dropped_rows = if p == 2 { &forest[..] } else { &[] };
            dependent = Matrix::new(self, p, field, dropped_rows, &dependent).row_basis(field);
            ranks[p] = dependent.len();
        }
        ranks
    }
}

/// A sparse matrix over a finite field, as columns of (row, entry) pairs with rising rows and entries other
/// than zero.
struct Matrix {
    n_rows: usize,
    columns: Vec<Vec<(u32, u32)>>,
}

impl Matrix {
    /// ∂p without some of its rows and columns, which become zero.
    fn new(
        complex: &ChainComplex,
        p: usize,
        field: Field,
        dropped_rows: &[u32],
        dropped_columns: &[u32],
    ) -> Self {
        let operator = complex.boundary(p);
        let keep_row = kept(operator.rows(), dropped_rows);
        let keep_column = kept(operator.cols(), dropped_columns);
        let entries = |(column, keep): (sprs::CsVecViewI<'_, i8, u32>, bool)| {
            let entry = |(row, &x): (usize, &i8)| (row as u32, field.element(x));
            let all = column.iter().filter(|e| keep && keep_row[e.0]).map(entry);
            all.filter(|e| e.1 != 0).collect()
        };
        let columns = operator.outer_iterator().zip(keep_column).map(entries).collect();
        Self { n_rows: operator.rows(), columns }
    }

    /// Columns that are linearly independent and span all others.
    fn column_basis(self, field: Field) -> Vec<u32> {
        if self.columns.iter().all(|c| c.len() <= 2) {
            graph_rank::independent_lines(self.n_rows, self.columns.iter().map(|c| &c[..]), field)
        } else {
            elimination::pivots(self, field).into_iter().map(|pivot| pivot.1).collect()
        }
    }

    /// Rows that are linearly independent and span all others.
    fn row_basis(self, field: Field) -> Vec<u32> {
        match self.rows_of_two() {
            Some(rows) => {
                let lines = rows.iter().map(|(n, line)| &line[..usize::from(*n)]);
                graph_rank::independent_lines(self.columns.len(), lines, field)
            }
            None => elimination::pivots(self, field).into_iter().map(|pivot| pivot.0).collect(),
        }
    }

    /// The rows, each with the number of its entries, when none has more than two.
    fn rows_of_two(&self) -> Option<Vec<ShortLine>> {
        let mut rows = vec![(0_u8, [(0, 0); 2]); self.n_rows];
        for (column, entries) in (0..).zip(&self.columns) {
            for &(row, x) in entries {
                let (n, line) = &mut rows[row as usize];
                *line.get_mut(usize::from(*n))? = (column, x);
                *n += 1;
            }
        }
        Some(rows)
    }
}

/// The number of entries, and the entries as (index, value).
type ShortLine = (u8, [(u32, u32); 2]);

fn kept(n: usize, dropped: &[u32]) -> Vec<bool> {
    let mut keep = vec![true; n];
    for &i in dropped {
        keep[i as usize] = false;
    }
    keep
}
