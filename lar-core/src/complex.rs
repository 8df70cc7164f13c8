//! Chain complexes: the points of the 0-cells and the boundary operators ∂1 … ∂d.

use crate::{Cells, Points};
use sprs::CsMatI;

/// A boundary or coboundary operator: a sparse matrix with entries −1, 0, +1, in compressed columns for
/// boundaries (column = the boundary of one cell) and compressed rows for their transposes. The matrix type
/// keeps the indices of a column distinct and in range; the entries are checked by [`ChainComplex::validate`].
///
/// ```
/// use lar_core::{ChainComplex, Operator, cuboid_grid};
/// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap();
/// let boundary: &Operator = square.boundary(2);
/// assert_eq!((boundary.shape(), boundary.nnz()), ((4, 1), 4));
/// ```
#[doc(alias = "ChainOp")]
pub type Operator = CsMatI<i8, u32>;

/// Points and boundary operators ∂p : Cp → Cp−1, p = 1..=d; `boundary(p)` has one row for each (p−1)-cell and
/// one column for each p-cell.
///
/// ```
/// use lar_core::{ChainComplex, cuboid_grid};
/// let complex = ChainComplex::from_model(&cuboid_grid(&[2, 1])).unwrap();
/// assert_eq!(complex.f_vector(), [6, 7, 2]);
/// assert_eq!((complex.boundary(2).rows(), complex.boundary(2).cols()), (7, 2));
/// assert!(complex.validate().is_empty());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ChainComplex {
    points: Points,
    boundaries: Vec<Operator>,
}

impl ChainComplex {
    /// A complex from its points and ∂1 … ∂d. The laws are not checked here.
    #[must_use]
    pub fn new(points: Points, boundaries: Vec<Operator>) -> Self {
        Self { points, boundaries }
    }

    /// Positions of the 0-cells.
    #[must_use]
    pub fn points(&self) -> &Points {
        &self.points
    }

    /// Dimension d of the highest cells.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.boundaries.len()
    }

    /// ∂p: rows (p−1)-cells, columns p-cells, compressed columns.
    ///
    /// # Panics
    /// When `p` is 0 or above `dim()`.
    #[must_use]
    pub fn boundary(&self, p: usize) -> &Operator {
        &self.boundaries[p - 1]
    }

    /// The number of p-cells.
    #[must_use]
    pub fn n_cells(&self, p: usize) -> usize {
        if p == 0 { self.points.len() } else { self.boundaries.get(p - 1).map_or(0, Operator::cols) }
    }
}

impl ChainComplex {
    /// An operator of `rows` rows from its columns, stored by columns: `columns[c]` lists the rows of column c
    /// in rising order, and `signs` holds the entries in the same flat order.
    ///
    /// # Panics
    /// When the rows of a column do not rise, one is not below `rows`, or there are not as many signs as rows
    /// listed.
    ///
    /// ```
    /// use lar_core::{Cells, ChainComplex};
    /// let edges = Cells::uniform(2, vec![0, 1, 1, 2]);
    /// let d1 = ChainComplex::operator_from_columns(3, edges, vec![-1, 1, -1, 1]);
    /// assert_eq!((d1.rows(), d1.cols(), d1.get(2, 1)), (3, 2, Some(&1)));
    /// ```
    #[must_use]
    pub fn operator_from_columns(rows: usize, columns: Cells, signs: Vec<i8>) -> Operator {
        let cols = columns.len();
        let (offsets, indices) = columns.into_parts();
        CsMatI::new_csc((rows, cols), offsets, indices, signs)
    }
}

/// An operator of `rows` rows from its columns, each a list of distinct rows with their entries in any order.
pub(crate) fn sign_columns<C: AsMut<[(u32, i8)]>>(rows: usize, columns: impl Iterator<Item = C>) -> Operator {
    let mut offsets = vec![0];
    let (mut indices, mut signs) = (Vec::new(), Vec::new());
    for mut column in columns {
        let column = column.as_mut();
        column.sort_unstable();
        indices.extend(column.iter().map(|entry| entry.0));
        signs.extend(column.iter().map(|entry| entry.1));
        offsets.push(u32::try_from(indices.len()).expect("operators hold fewer than 2^32 entries"));
    }
    CsMatI::new_csc((rows, offsets.len() - 1), offsets, indices, signs)
}
