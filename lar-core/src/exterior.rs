//! The exterior as a cell: complexes with and without it.
//!
//! The sum of the columns of ∂d over all bounded d-cells is the boundary of the whole; the exterior lies on its
//! other side, so its column is minus that sum. With it every (d−1)-cell has two sides and the rows of ∂d sum
//! to zero.

use crate::complex::sign_columns;
use crate::{ChainComplex, Operator, Violation};

impl ChainComplex {
    /// The complex with the exterior as d-cell 0 and the others moved up by one: column 0 of ∂d is minus the
    /// sum of the others. A complex of dimension below 2 is returned as it is. O(size).
    ///
    /// # Errors
    /// When a (d−1)-cell has more than one d-cell on one side, or ∂d has rows without sign: the row.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
    /// let whole = bar.with_exterior().unwrap();
    /// assert_eq!(whole.f_vector(), [12, 20, 11, 3]);
    /// assert!(whole.validate_with_exterior().is_empty());
    /// assert_eq!(whole.without_exterior(), bar);
    /// ```
    #[doc(alias = "coboundary_1")]
    #[doc(alias = "chaincomplex")]
    pub fn with_exterior(&self) -> Result<Self, Violation> {
        let p = self.dim();
        if p < 2 {
            return Ok(self.clone());
        }
        let outer = exterior_column(p, self.boundary(p))?;
        let columns = std::iter::once(outer).chain(columns(self.boundary(p)));
        Ok(self.with_highest(sign_columns(self.boundary(p).rows(), columns)))
    }

    /// The complex without its d-cell 0, the exterior where there is one. A complex without d-cells, or of
    /// dimension below 2, is returned as it is. O(size).
    #[must_use]
    pub fn without_exterior(&self) -> Self {
        let p = self.dim();
        if p < 2 {
            return self.clone();
        }
        self.with_highest(sign_columns(self.boundary(p).rows(), columns(self.boundary(p)).skip(1)))
    }

    /// The complex with another ∂d.
    fn with_highest(&self, operator: Operator) -> Self {
        let below = (1..self.dim()).map(|p| self.boundary(p).clone());
        Self::new(self.points().clone(), below.chain([operator]).collect())
    }
}

fn columns(operator: &Operator) -> impl Iterator<Item = Vec<(u32, i8)>> + '_ {
    operator.outer_iterator().map(|c| c.indices().iter().copied().zip(c.data().iter().copied()).collect())
}

/// Minus the sum of the columns of ∂p.
fn exterior_column(p: usize, operator: &Operator) -> Result<Vec<(u32, i8)>, Violation> {
    let by_rows = operator.to_csr();
    let mut outer = Vec::new();
    for (row, cells) in (0..).zip(by_rows.outer_iterator()) {
        let count = |sign: i8| cells.data().iter().filter(|&&x| x == sign).count();
        let (plus, minus) = (count(1), count(-1));
        if plus > 1 || minus > 1 || plus + minus + count(0) < cells.nnz() {
            let entries = cells.indices().iter().copied().zip(cells.data().iter().copied()).collect();
            return Err(Violation::Sides { p, row, entries });
        }
        match plus.cmp(&minus) {
            std::cmp::Ordering::Greater => outer.push((row, -1)),
            std::cmp::Ordering::Less => outer.push((row, 1)),
            std::cmp::Ordering::Equal => (),
        }
    }
    Ok(outer)
}

#[cfg(test)]
mod tests {
    use crate::validate::fixtures::{with_boundary, with_entry};
    use crate::{ChainComplex, Model, Points, cuboid_grid};

    #[track_caller]
    fn check(shape: &[usize], outer_entries: usize) {
        let inner = ChainComplex::from_model(&cuboid_grid(shape)).unwrap();
        let whole = inner.with_exterior().unwrap();
        assert_eq!(whole.validate_with_exterior(), []);
        assert_eq!(whole.boundary(shape.len()).outer_view(0).unwrap().nnz(), outer_entries);
        assert_eq!(whole.without_exterior(), inner);
        let d = shape.len() as i64;
        assert_eq!(whole.euler_characteristic(), 1 + if d % 2 == 0 { 1 } else { -1 });
    }

    #[test]
    fn grids() {
        check(&[3, 2], 10);
        check(&[32, 32, 16], 4096);
    }

    #[test]
    fn too_many_cells_on_a_side() {
        let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
        let wall = (0..11).find(|&f| bar.relation(2, 3)[f].len() == 2).unwrap();
        let sign = *bar.boundary(3).get(wall, 1).unwrap();
        let place = bar.boundary(3).nnz_index(wall, 1).unwrap().0;
        let message = with_entry(&bar, 3, place, -sign).with_exterior().unwrap_err().to_string();
        assert_eq!(
            message,
            format!(
                "row {wall} of ∂3 has entries {0} at 0, {0} at 1; a cell has at most one cell on each side",
                -sign
            )
        );
        let large = with_entry(&bar, 3, 0, 2);
        assert!(large.with_exterior().is_err());
        let stored_zeros = with_boundary(&bar, 3, bar.boundary(3).map(|_| 0)).with_exterior().unwrap();
        assert_eq!(stored_zeros.boundary(3).outer_view(0).unwrap().nnz(), 0);
    }

    #[test]
    fn nothing_to_be_outside_of() {
        let dust = ChainComplex::from_model(&Model::new(Points::new(2), Vec::new())).unwrap();
        assert_eq!(dust.with_exterior().unwrap(), dust);
        assert_eq!(dust.without_exterior(), dust);
        let path = ChainComplex::from_model(&cuboid_grid(&[3])).unwrap();
        assert_eq!(path.with_exterior().unwrap(), path);
        assert_eq!(path.without_exterior(), path);
        let empty = ChainComplex::from_model(&cuboid_grid(&[0, 3])).unwrap();
        assert_eq!(empty.without_exterior(), empty);
    }
}
