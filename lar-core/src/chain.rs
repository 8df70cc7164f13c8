//! Chains: sparse integer combinations of the p-cells of one complex, and their boundaries.

use crate::{ChainComplex, Operator};
use std::ops::{Add, Mul, Neg, Sub};

/// A p-chain: integer coefficients on p-cells, zero except where listed.
///
/// The dimension p and the number of p-cells are checked wherever chains and operators meet.
///
/// ```
/// use lar_core::{Chain, ChainComplex, cuboid_grid};
/// let grid = ChainComplex::from_model(&cuboid_grid(&[2, 1])).unwrap();
/// let both = grid.chain(2, [(0, 1), (1, 1)]).unwrap();
/// let outline = grid.boundary_of(&both).unwrap();
/// assert_eq!((outline.dim(), outline.entries().len()), (1, 6));
/// assert!(grid.boundary_of(&outline).unwrap().is_zero());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain {
    dim: usize,
    n_cells: usize,
    entries: Vec<(u32, i32)>,
}

/// Why chains, or a chain and a complex, do not fit together.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ChainError {
    /// A cell that does not exist has a coefficient.
    #[error("{dim}-cell {cell} of {n_cells}")]
    CellOutOfRange {
        /// Dimension of the chain.
        dim: usize,
        /// The cell.
        cell: u32,
        /// The number of cells of that dimension.
        n_cells: usize,
    },
    /// Two chains, or a chain and a complex, are of different dimensions or cell counts.
    #[error(
        "a {found_dim}-chain on {found} cells where a {expected_dim}-chain on {expected} cells is needed"
    )]
    Mismatch {
        /// Dimension needed.
        expected_dim: usize,
        /// Number of cells needed.
        expected: usize,
        /// Dimension found.
        found_dim: usize,
        /// Number of cells found.
        found: usize,
    },
    /// A coefficient does not fit `i32`.
    #[error("the coefficient of {dim}-cell {cell} would be {value}, which is too large")]
    Overflow {
        /// Dimension of the chain.
        dim: usize,
        /// The cell.
        cell: u32,
        /// The coefficient, saturated.
        value: i64,
    },
}

impl Chain {
    /// A chain of dimension `dim` on `n_cells` cells from (cell, coefficient) pairs in any order; coefficients
    /// of one cell add up.
    ///
    /// # Errors
    /// When a cell is not below `n_cells`, or a sum does not fit `i32`.
    pub fn new(
        dim: usize,
        n_cells: usize,
        entries: impl IntoIterator<Item = (u32, i32)>,
    ) -> Result<Self, ChainError> {
        let terms: Vec<(u32, i64)> = entries.into_iter().map(|(cell, c)| (cell, i64::from(c))).collect();
        if let Some(&(cell, _)) = terms.iter().find(|e| e.0 as usize >= n_cells) {
            return Err(ChainError::CellOutOfRange { dim, cell, n_cells });
        }
        Self::collect(dim, n_cells, terms)
    }

    /// The dimension p.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// The number of p-cells of the complex, zero coefficients included.
    #[must_use]
    pub fn n_cells(&self) -> usize {
        self.n_cells
    }

    /// The cells with coefficients other than zero, in rising order.
    #[must_use]
    pub fn entries(&self) -> &[(u32, i32)] {
        &self.entries
    }

    /// The coefficient of a cell. O(log n).
    #[must_use]
    pub fn coefficient(&self, cell: u32) -> i32 {
        self.entries.binary_search_by_key(&cell, |e| e.0).map_or(0, |i| self.entries[i].1)
    }

    /// True when all coefficients are zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.entries.is_empty()
    }

    /// The sum of two chains on the same cells. O(entries).
    ///
    /// # Errors
    /// When they are not of one dimension and cell count, or a coefficient does not fit `i32`.
    pub fn try_add(&self, other: &Self) -> Result<Self, ChainError> {
        self.combine(other, 1)
    }

    /// The difference of two chains on the same cells. O(entries).
    ///
    /// # Errors
    /// As [`try_add`](Self::try_add).
    pub fn try_sub(&self, other: &Self) -> Result<Self, ChainError> {
        self.combine(other, -1)
    }

    /// The chain with every coefficient multiplied by `factor`. O(entries).
    ///
    /// # Errors
    /// When a coefficient does not fit `i32`.
    pub fn try_scale(&self, factor: i32) -> Result<Self, ChainError> {
        let terms = self.entries.iter().map(|&(cell, c)| (cell, i64::from(c) * i64::from(factor))).collect();
        Self::collect(self.dim, self.n_cells, terms)
    }

    fn combine(&self, other: &Self, factor: i64) -> Result<Self, ChainError> {
        other.check_fits(self.dim, self.n_cells)?;
        let mine = self.entries.iter().map(|&(cell, c)| (cell, i64::from(c)));
        let theirs = other.entries.iter().map(|&(cell, c)| (cell, factor * i64::from(c)));
        Self::collect(self.dim, self.n_cells, mine.chain(theirs).collect())
    }

    pub(crate) fn check_fits(&self, expected_dim: usize, expected: usize) -> Result<(), ChainError> {
        let (found_dim, found) = (self.dim, self.n_cells);
        if (found_dim, found) == (expected_dim, expected) {
            Ok(())
        } else {
            Err(ChainError::Mismatch { expected_dim, expected, found_dim, found })
        }
    }

    /// Sorts, adds up and drops zeros.
    fn collect(dim: usize, n_cells: usize, mut terms: Vec<(u32, i64)>) -> Result<Self, ChainError> {
        terms.sort_unstable();
        let mut entries = Vec::with_capacity(terms.len());
        for same in terms.chunk_by(|a, b| a.0 == b.0) {
            let cell = same[0].0;
            let value = same.iter().fold(0_i64, |sum, term| sum.saturating_add(term.1));
            let c = i32::try_from(value).map_err(|_| ChainError::Overflow { dim, cell, value })?;
            if c != 0 {
                entries.push((cell, c));
            }
        }
        Ok(Self { dim, n_cells, entries })
    }

    /// The product of a matrix in compressed columns and this chain, a chain of dimension `dim`.
    fn times(&self, matrix: &Operator, dim: usize) -> Result<Self, ChainError> {
        let mut terms = Vec::new();
        for &(cell, c) in &self.entries {
            let column = matrix.outer_view(cell as usize);
            let column = column.iter().flat_map(sprs::CsVecBase::iter);
            terms.extend(column.map(|(row, &x)| (row as u32, i64::from(x) * i64::from(c))));
        }
        Self::collect(dim, matrix.rows(), terms)
    }
}

impl ChainComplex {
    /// A p-chain of this complex; see [`Chain::new`].
    ///
    /// # Errors
    /// When a cell does not exist or coefficients do not fit `i32`.
    pub fn chain(
        &self,
        p: usize,
        entries: impl IntoIterator<Item = (u32, i32)>,
    ) -> Result<Chain, ChainError> {
        Chain::new(p, self.n_cells(p), entries)
    }

    /// δp = ∂p+1ᵀ: rows (p+1)-cells, columns p-cells, compressed rows. O(entries).
    ///
    /// # Panics
    /// When `p` is not below `dim()`.
    #[must_use]
    pub fn coboundary(&self, p: usize) -> Operator {
        self.boundary(p + 1).clone().transpose_into()
    }

    /// ∂p · c, a (p−1)-chain. O(k log k) for k entries of the columns concerned. The boundary of a 0-chain is
    /// the zero chain on no cells of dimension 0.
    ///
    /// # Errors
    /// When the chain is not of this complex, or coefficients do not fit `i32`.
    pub fn boundary_of(&self, chain: &Chain) -> Result<Chain, ChainError> {
        chain.check_fits(chain.dim, self.n_cells(chain.dim))?;
        match chain.dim.checked_sub(1) {
            Some(below) if chain.dim <= self.dim() => chain.times(self.boundary(chain.dim), below),
            below => Chain::new(below.unwrap_or(0), 0, []),
        }
    }

    /// δp · c, a (p+1)-chain. O(entries of ∂p+1), since its rows are needed; for many chains take
    /// [`coboundary`](Self::coboundary) once. The coboundary of a d-chain is the zero chain on no cells.
    ///
    /// # Errors
    /// When the chain is not of this complex, or coefficients do not fit `i32`.
    pub fn coboundary_of(&self, chain: &Chain) -> Result<Chain, ChainError> {
        chain.check_fits(chain.dim, self.n_cells(chain.dim))?;
        if chain.dim >= self.dim() {
            return Chain::new(chain.dim + 1, 0, []);
        }
        chain.times(&self.coboundary(chain.dim).to_csc(), chain.dim + 1)
    }
}

const FITS: &str = "the chains are of one complex and their coefficients fit i32";

impl Add for &Chain {
    type Output = Chain;

    /// # Panics
    /// Where [`Chain::try_add`] returns an error.
    fn add(self, other: Self) -> Chain {
        self.try_add(other).expect(FITS)
    }
}

impl Sub for &Chain {
    type Output = Chain;

    /// # Panics
    /// Where [`Chain::try_sub`] returns an error.
    fn sub(self, other: Self) -> Chain {
        self.try_sub(other).expect(FITS)
    }
}

impl Mul<&Chain> for i32 {
    type Output = Chain;

    /// # Panics
    /// Where [`Chain::try_scale`] returns an error.
    fn mul(self, chain: &Chain) -> Chain {
        chain.try_scale(self).expect(FITS)
    }
}

impl Neg for &Chain {
    type Output = Chain;

    /// # Panics
    /// When a coefficient is `i32::MIN`.
    fn neg(self) -> Chain {
        -1 * self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cuboid_grid;
    use proptest::prelude::*;

    #[test]
    fn refusals() {
        let grid = ChainComplex::from_model(&cuboid_grid(&[2, 1])).unwrap();
        let far = grid.chain(2, [(2, 1)]);
        assert_eq!(far, Err(ChainError::CellOutOfRange { dim: 2, cell: 2, n_cells: 2 }));
        let large = grid.chain(1, [(3, i32::MAX), (3, 1)]);
        assert_eq!(large, Err(ChainError::Overflow { dim: 1, cell: 3, value: 1 << 31 }));
        let edge = grid.chain(1, [(0, 1)]).unwrap();
        let face = grid.chain(2, [(0, 1)]).unwrap();
        let message = "a 2-chain on 2 cells where a 1-chain on 7 cells is needed";
        assert_eq!(edge.try_add(&face).unwrap_err().to_string(), message);
        assert_eq!(edge.try_sub(&face).unwrap_err().to_string(), message);
        let wrong = Chain::new(1, 8, [(7, 1)]).unwrap();
        assert!(matches!(grid.boundary_of(&wrong), Err(ChainError::Mismatch { .. })));
    }

    #[test]
    fn ends_of_the_sequence() {
        let grid = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap();
        let point = grid.chain(0, [(0, 1)]).unwrap();
        assert!(grid.boundary_of(&point).unwrap().is_zero());
        let face = grid.chain(2, [(0, 1)]).unwrap();
        assert!(grid.coboundary_of(&face).unwrap().is_zero());
        assert_eq!(grid.coboundary_of(&point).unwrap().entries(), [(0, -1), (2, -1)]);
    }

    fn chain(p: usize, n: usize) -> impl Strategy<Value = Chain> {
        prop::collection::vec((0..n as u32, -9..9), 0..20).prop_map(move |e| Chain::new(p, n, e).unwrap())
    }

    proptest! {
        #[test]
        fn laws((a, b) in (chain(2, 36), chain(2, 36)), k in -9..9) {
            let grid = ChainComplex::from_model(&cuboid_grid(&[2, 2, 2])).unwrap();
            let boundary = |c: &Chain| grid.boundary_of(c).unwrap();
            prop_assert_eq!(&(&a + &b) - &b, a.clone());
            prop_assert_eq!(boundary(&(&a + &(k * &b))), &boundary(&a) + &(k * &boundary(&b)));
            prop_assert!(boundary(&boundary(&a)).is_zero());
            prop_assert!((&a + &-&a).is_zero());
            let up = grid.coboundary_of(&boundary(&a)).unwrap();
            prop_assert_eq!((up.dim(), up.n_cells()), (2, 36));
        }
    }
}
