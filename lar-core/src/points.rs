//! Points: a d × n matrix of coordinates, one column a point.

use nalgebra::DMatrix;

/// n points of d coordinates, stored by columns (the d coordinates of a point are contiguous), the layout of a
/// dense d × n matrix.
///
/// ```
/// use lar_core::Points;
/// let square = Points::from_columns(2, vec![0., 0., 1., 0., 1., 1., 0., 1.]);
/// assert_eq!((square.dim(), square.len()), (2, 4));
/// assert_eq!(square.point(2), [1., 1.]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    dim: usize,
    coords: Vec<f64>,
}

impl Points {
    /// No points of `dim` coordinates.
    #[must_use]
    pub fn new(dim: usize) -> Self {
        Self { dim, coords: Vec::new() }
    }

    /// Points from their coordinates, point after point.
    ///
    /// # Panics
    /// When `coords.len()` is not a multiple of `dim`.
    #[must_use]
    pub fn from_columns(dim: usize, coords: Vec<f64>) -> Self {
        assert!(
            if dim == 0 { coords.is_empty() } else { coords.len().is_multiple_of(dim) },
            "{} coordinates do not make points of {dim}",
            coords.len()
        );
        Self { dim, coords }
    }

    /// Points of three coordinates.
    #[must_use]
    pub fn from_xyz(points: &[[f64; 3]]) -> Self {
        Self { dim: 3, coords: points.as_flattened().to_vec() }
    }

    /// Coordinates per point, d.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// Number of points, n.
    #[must_use]
    #[inline]
    pub fn len(&self) -> usize {
        self.coords.len().checked_div(self.dim).unwrap_or(0)
    }

    /// True when there are no points.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.coords.is_empty()
    }

    /// The d coordinates of point `i`.
    ///
    /// # Panics
    /// When `i` is not below `len()`.
    #[must_use]
    #[inline]
    pub fn point(&self, i: usize) -> &[f64] {
        &self.coords[i * self.dim..(i + 1) * self.dim]
    }

    /// Point `i` of a three-dimensional set.
    ///
    /// # Panics
    /// When `i` is not below `len()` or `dim()` is not 3.
    #[must_use]
    #[inline]
    pub fn xyz(&self, i: usize) -> [f64; 3] {
        let p = self.point(i);
        assert_eq!(self.dim, 3, "xyz() of points of {} coordinates", self.dim);
        [p[0], p[1], p[2]]
    }

    /// Appends a point.
    ///
    /// # Panics
    /// When `point` has not `dim()` coordinates.
    pub fn push(&mut self, point: &[f64]) {
        assert_eq!(
            point.len(),
            self.dim,
            "a point of {} coordinates among points of {}",
            point.len(),
            self.dim
        );
        self.coords.extend_from_slice(point);
    }

    /// The points one after the other.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[f64]> + '_ {
        self.coords.chunks_exact(self.dim.max(1))
    }

    /// All coordinates, point after point.
    #[must_use]
    pub fn coords(&self) -> &[f64] {
        &self.coords
    }

    /// All coordinates, to be changed in place.
    pub fn coords_mut(&mut self) -> &mut [f64] {
        &mut self.coords
    }

    /// The d × n matrix, one column a point. O(d n).
    #[must_use]
    pub fn to_matrix(&self) -> DMatrix<f64> {
        DMatrix::from_column_slice(self.dim, self.len(), &self.coords)
    }

    /// The coordinates that are infinite or not numbers: point, axis, value. O(d n).
    pub fn non_finite(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let dim = self.dim.max(1);
        let at = move |(i, &x): (usize, &f64)| (i / dim, i % dim, x);
        self.coords.iter().enumerate().filter(|(_, x)| !x.is_finite()).map(at)
    }

    /// Lower and upper corner of the bounding box; `None` when there are no points. O(d n).
    #[must_use]
    pub fn bounds(&self) -> Option<(Vec<f64>, Vec<f64>)> {
        let first = self.iter().next()?;
        let (mut lo, mut hi) = (first.to_vec(), first.to_vec());
        for p in self.iter() {
            for (k, &x) in p.iter().enumerate() {
                lo[k] = lo[k].min(x);
                hi[k] = hi[k].max(x);
            }
        }
        Some((lo, hi))
    }
}
