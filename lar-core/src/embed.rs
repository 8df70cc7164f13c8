//! Embedding into space of higher dimension: missing coordinates are 0, maps leave the new axes alone.

use crate::{Affine, AffineError, Model, Points};
use nalgebra::DMatrix;

impl Points {
    /// The points in a space of `dim` coordinates, the new ones 0. O(n · dim).
    ///
    /// # Errors
    /// When the points have more coordinates than that.
    ///
    /// ```
    /// let p = lar_core::Points::from_columns(2, vec![1., 2., 3., 4.]);
    /// assert_eq!(p.embedded(3)?.coords(), [1., 2., 0., 3., 4., 0.]);
    /// # Ok::<(), lar_core::AffineError>(())
    /// ```
    pub fn embedded(&self, dim: usize) -> Result<Self, AffineError> {
        check(self.dim(), dim)?;
        let added = dim - self.dim();
        let coords = self.iter().flat_map(|p| p.iter().copied().chain(std::iter::repeat_n(0., added)));
        Ok(Self::from_columns(dim, coords.collect()))
    }
}

impl Model {
    /// The model in a space of `dim` coordinates, the new ones 0; cells stay as they are. O(size).
    ///
    /// # Errors
    /// When the points have more coordinates than that.
    ///
    /// ```
    /// use lar_core::mapper::Disk;
    /// let disk = Disk::default().model()?.embedded(3)?;
    /// assert!(!disk.to_surface("disk")?.boundary_edges().is_empty());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn embedded(&self, dim: usize) -> Result<Self, AffineError> {
        let cells = (0..self.f_vector().len()).map(|p| self.cells(p).clone()).collect();
        Ok(Self::new(self.points().embedded(dim)?, cells))
    }
}

impl Affine {
    /// The map of a space of `dim` coordinates that acts on the first ones as this map does and leaves the
    /// others alone. O(dim²).
    ///
    /// # Errors
    /// When the map is of a space of more coordinates than that.
    ///
    /// ```
    /// let map = lar_core::t(&[1., 2.]).embedded(3)?;
    /// assert_eq!(map.apply_point(&[0., 0., 5.])?, [1., 2., 5.]);
    /// # Ok::<(), lar_core::AffineError>(())
    /// ```
    pub fn embedded(&self, dim: usize) -> Result<Self, AffineError> {
        let d = self.dim();
        check(d, dim)?;
        let mut matrix = DMatrix::identity(dim + 1, dim + 1);
        matrix.view_mut((0, 0), (d, d)).copy_from(&self.matrix().view((0, 0), (d, d)));
        matrix.view_mut((0, dim), (d, 1)).copy_from(&self.matrix().view((0, d), (d, 1)));
        Self::from_matrix(matrix)
    }
}

fn check(found: usize, expected: usize) -> Result<(), AffineError> {
    if found <= expected { Ok(()) } else { Err(AffineError::Dimension { expected, found }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cuboid_grid, r, t};

    #[test]
    fn embedding_commutes_with_maps() {
        let map = &t(&[3., -1.]) * &r(0.3);
        let model = cuboid_grid(&[2, 1]);
        for dim in 2..5 {
            let moved_first = model.transformed(&map).unwrap().embedded(dim).unwrap();
            let embedded_first =
                model.embedded(dim).unwrap().transformed(&map.embedded(dim).unwrap()).unwrap();
            assert_eq!(moved_first, embedded_first);
            assert_eq!((moved_first.points().dim(), moved_first.validate()), (dim, vec![]));
        }
        let too_small = AffineError::Dimension { expected: 1, found: 2 };
        assert_eq!(model.embedded(1).unwrap_err(), too_small);
        assert_eq!(map.embedded(1).unwrap_err(), too_small);
    }
}
