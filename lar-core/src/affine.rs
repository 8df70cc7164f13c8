//! Affine maps as homogeneous matrices that multiply column vectors.

use crate::Points;
use nalgebra::DMatrix;

/// An affine map of d-space: a (d + 1) × (d + 1) matrix acting on columns (x, 1), its last row (0 … 0 1).
///
/// `&a * &b` first moves by `b`, then by `a`.
///
/// ```
/// use lar_core::{r, t};
/// let map = &t(&[1., 0.]) * &r(std::f64::consts::FRAC_PI_2);
/// let moved = map.apply_point(&[2., 0.]).unwrap();
/// assert!((moved[0] - 1.).abs() < 1e-15 && (moved[1] - 2.).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Affine {
    matrix: DMatrix<f64>,
}

/// Why a matrix is not an affine map, or cannot be applied.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AffineError {
    /// The matrix is not square, or empty.
    #[error("a matrix of {rows} × {cols} is not an affine map: it must be square")]
    NotSquare {
        /// Its rows.
        rows: usize,
        /// Its columns.
        cols: usize,
    },
    /// The last row is not (0 … 0 1).
    #[error("entry ({row}, {col}) is {value}: the last row of an affine map is (0 … 0 1)")]
    NotAffine {
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        col: usize,
        /// Its value.
        value: f64,
    },
    /// An entry is infinite or not a number.
    #[error("entry ({row}, {col}) is {value}")]
    NonFinite {
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        col: usize,
        /// Its value.
        value: f64,
    },
    /// The linear part maps space to something of lower dimension.
    #[error("the matrix is singular")]
    Singular,
    /// The map is of another space than what it should act on.
    #[error("a map of {found}-space where one of {expected}-space is needed")]
    Dimension {
        /// The dimension needed.
        expected: usize,
        /// The dimension of the map.
        found: usize,
    },
    /// A rotation axis has no direction.
    #[error("rotation axis ({}, {}, {}) has no direction", .0[0], .0[1], .0[2])]
    Axis([f64; 3]),
}

impl Affine {
    /// The map that leaves d-space as it is.
    #[must_use]
    pub fn identity(d: usize) -> Self {
        Self { matrix: DMatrix::identity(d + 1, d + 1) }
    }

    /// An affine map from its homogeneous matrix. O(d).
    ///
    /// # Errors
    /// When the matrix is not square or its last row is not (0 … 0 1).
    pub fn from_matrix(matrix: DMatrix<f64>) -> Result<Self, AffineError> {
        let (rows, cols) = matrix.shape();
        if rows != cols || rows == 0 {
            return Err(AffineError::NotSquare { rows, cols });
        }
        for col in 0..cols {
            let value = matrix[(rows - 1, col)];
            let expected = if col + 1 == cols { 1. } else { 0. };
            if value != expected {
                return Err(AffineError::NotAffine { row: rows - 1, col, value });
            }
        }
        Ok(Self { matrix })
    }

    /// Dimension d of the space.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.matrix.nrows() - 1
    }

    /// The homogeneous matrix, (d + 1) × (d + 1).
    #[must_use]
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Determinant of the linear part: the factor by which volumes grow, negative for mirrors. O(d³).
    #[must_use]
    pub fn determinant(&self) -> f64 {
        determinant(self.linear())
    }

    /// True when the map reverses orientation.
    #[must_use]
    pub fn is_mirror(&self) -> bool {
        scaled_determinant(self.linear()) < 0.
    }

    /// Checks that the map can place a solid: all entries finite, linear part not singular (its columns scaled
    /// to unit size have a determinant that is not zero). O(d³).
    ///
    /// # Errors
    /// Says which of the two fails.
    pub fn check_regular(&self) -> Result<(), AffineError> {
        for col in 0..self.matrix.ncols() {
            for row in 0..self.matrix.nrows() {
                let value = self.matrix[(row, col)];
                if !value.is_finite() {
                    return Err(AffineError::NonFinite { row, col, value });
                }
            }
        }
        if scaled_determinant(self.linear()) == 0. { Err(AffineError::Singular) } else { Ok(()) }
    }

    /// The map that undoes this one. O(d³).
    ///
    /// # Errors
    /// As [`check_regular`](Self::check_regular).
    pub fn inverse(&self) -> Result<Self, AffineError> {
        self.check_regular()?;
        let mut matrix = self.matrix.clone().try_inverse().ok_or(AffineError::Singular)?;
        let last = self.dim();
        matrix.row_mut(last).fill(0.);
        matrix[(last, last)] = 1.;
        Ok(Self { matrix })
    }

    /// `self` after `first`. O(d³).
    ///
    /// # Errors
    /// When they are maps of different spaces.
    pub fn compose(&self, first: &Self) -> Result<Self, AffineError> {
        if self.dim() != first.dim() {
            return Err(AffineError::Dimension { expected: self.dim(), found: first.dim() });
        }
        Ok(Self { matrix: &self.matrix * &first.matrix })
    }

    /// The image of one point of d coordinates.
    ///
    /// # Errors
    /// When the point is not of the map's space.
    pub fn apply_point(&self, point: &[f64]) -> Result<Vec<f64>, AffineError> {
        self.check_dim(point.len())?;
        Ok(self.image(point).collect())
    }

    /// The images of all points. O(d² n).
    ///
    /// # Errors
    /// When the points are not of the map's space.
    ///
    /// ```
    /// use lar_core::{Points, t};
    /// let moved = t(&[1., 2.]).apply(&Points::from_columns(2, vec![0., 0., 3., 0.])).unwrap();
    /// assert_eq!(moved.coords(), [1., 2., 4., 2.]);
    /// ```
    pub fn apply(&self, points: &Points) -> Result<Points, AffineError> {
        self.check_dim(points.dim())?;
        let coords = points.iter().flat_map(|p| self.image(p)).collect();
        Ok(Points::from_columns(points.dim(), coords))
    }

    fn image<'a>(&'a self, point: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let d = self.dim();
        (0..d).map(move |i| (0..d).map(|j| self.matrix[(i, j)] * point[j]).sum::<f64>() + self.matrix[(i, d)])
    }

    fn check_dim(&self, expected: usize) -> Result<(), AffineError> {
        let found = self.dim();
        if found == expected { Ok(()) } else { Err(AffineError::Dimension { expected, found }) }
    }

    fn linear(&self) -> DMatrix<f64> {
        let d = self.dim();
        self.matrix.view((0, 0), (d, d)).into_owned()
    }
}

impl std::ops::Mul for &Affine {
    type Output = Affine;

    /// `self` after `first`.
    ///
    /// # Panics
    /// When they are maps of different spaces; [`Affine::compose`] returns an error instead.
    fn mul(self, first: Self) -> Affine {
        self.compose(first).expect("both maps are of one space")
    }
}

/// 1 for 0 × 0.
fn determinant(matrix: DMatrix<f64>) -> f64 {
    if matrix.is_empty() { 1. } else { matrix.lu().determinant() }
}

/// The determinant after each column is divided by its largest entry, so that only the directions of the
/// columns count and no product of small or large scales is rounded to zero or infinity.
fn scaled_determinant(mut matrix: DMatrix<f64>) -> f64 {
    for mut column in matrix.column_iter_mut() {
        let size = column.amax();
        if size == 0. {
            return 0.;
        }
        column.apply(|x| *x /= size);
    }
    determinant(matrix)
}

/// Translation by the vector `by`.
///
/// ```
/// assert_eq!(lar_core::t(&[1., 2.]).apply_point(&[10., 10.]).unwrap(), [11., 12.]);
/// ```
#[must_use]
pub fn t(by: &[f64]) -> Affine {
    let mut map = Affine::identity(by.len());
    for (i, &x) in by.iter().enumerate() {
        map.matrix[(i, by.len())] = x;
    }
    map
}

/// Scaling by `by[i]` along axis i; a negative factor mirrors, a zero gives a singular map.
///
/// ```
/// assert_eq!(lar_core::s(&[2., -1.]).apply_point(&[10., 10.]).unwrap(), [20., -10.]);
/// ```
#[must_use]
pub fn s(by: &[f64]) -> Affine {
    let mut map = Affine::identity(by.len());
    for (i, &x) in by.iter().enumerate() {
        map.matrix[(i, i)] = x;
    }
    map
}

/// What a rotation is given by: an angle in the plane, or in space a vector whose direction is the axis and
/// whose length is the angle. Made from `f64`, `[f64; 1]` and `[f64; 3]` or references to such arrays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RotationVector {
    /// Counter-clockwise angle in radians.
    Plane(f64),
    /// Axis times angle in radians, right-handed.
    Space([f64; 3]),
}

impl From<f64> for RotationVector {
    fn from(angle: f64) -> Self {
        Self::Plane(angle)
    }
}

impl From<[f64; 1]> for RotationVector {
    fn from([angle]: [f64; 1]) -> Self {
        Self::Plane(angle)
    }
}

impl From<[f64; 3]> for RotationVector {
    fn from(vector: [f64; 3]) -> Self {
        Self::Space(vector)
    }
}

impl From<&[f64; 1]> for RotationVector {
    fn from(&[angle]: &[f64; 1]) -> Self {
        Self::Plane(angle)
    }
}

impl From<&[f64; 3]> for RotationVector {
    fn from(&vector: &[f64; 3]) -> Self {
        Self::Space(vector)
    }
}

/// Rotation: `r(angle)` of the plane, `r([a, b, c])` of space about the axis in direction (a, b, c) by the
/// angle that is its length. The sign counts: `r([-0.5, 0., 0.])` undoes `r([0.5, 0., 0.])`. The zero vector
/// gives the identity.
///
/// ```
/// use std::f64::consts::FRAC_PI_2;
/// let y = lar_core::r([FRAC_PI_2, 0., 0.]).apply_point(&[0., 1., 0.]).unwrap();
/// assert!((y[2] - 1.).abs() < 1e-15);
/// ```
#[must_use]
pub fn r(vector: impl Into<RotationVector>) -> Affine {
    match vector.into() {
        RotationVector::Plane(angle) => {
            let (sin, cos) = angle.sin_cos();
            Affine { matrix: DMatrix::from_row_slice(3, 3, &[cos, -sin, 0., sin, cos, 0., 0., 0., 1.]) }
        }
        RotationVector::Space(vector) => {
            let (axis, angle) = split(vector);
            about(axis, angle)
        }
    }
}

/// Rotation of space about the axis through the origin by `angle` radians, right-handed; the length of `axis`
/// does not matter.
///
/// # Errors
/// When `axis` is zero or not finite.
///
/// ```
/// let x = lar_core::rotation([0., 0., 5.], std::f64::consts::PI).unwrap().apply_point(&[1., 0., 0.]).unwrap();
/// assert!((x[0] + 1.).abs() < 1e-15);
/// ```
pub fn rotation(axis: [f64; 3], angle: f64) -> Result<Affine, AffineError> {
    let (unit, length) = split(axis);
    if length > 0. && unit.iter().all(|x| x.is_finite()) {
        Ok(about(unit, angle))
    } else {
        Err(AffineError::Axis(axis))
    }
}

/// Direction and length; scaled first, so that nothing overflows or underflows on the way. The direction of the
/// zero vector is x.
fn split(vector: [f64; 3]) -> ([f64; 3], f64) {
    let size = vector.iter().fold(0_f64, |m, x| m.max(x.abs()));
    if size == 0. && vector.iter().all(|&x| x == 0.) {
        return ([1., 0., 0.], 0.);
    }
    let scaled = vector.map(|x| x / size);
    let norm = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
    (scaled.map(|x| x / norm), norm * size)
}

/// Rodrigues' formula: cos·I + sin·[u]× + (1 − cos)·u uᵀ for a unit axis u.
fn about([x, y, z]: [f64; 3], angle: f64) -> Affine {
    let (sin, cos) = angle.sin_cos();
    let rest = 1. - cos;
    let rows = [
        [cos + rest * x * x, rest * x * y - sin * z, rest * x * z + sin * y, 0.],
        [rest * y * x + sin * z, cos + rest * y * y, rest * y * z - sin * x, 0.],
        [rest * z * x - sin * y, rest * z * y + sin * x, cos + rest * z * z, 0.],
        [0., 0., 0., 1.],
    ];
    Affine { matrix: DMatrix::from_row_slice(4, 4, rows.as_flattened()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn distance(a: &Affine, b: &Affine) -> f64 {
        (a.matrix() - b.matrix()).amax()
    }

    #[test]
    fn rotations_keep_the_sign_and_the_axis() {
        let c = (PI / 5.).cos();
        let s = (PI / 5.).sin();
        let about_x = [1., 0., 0., 0., 0., c, -s, 0., 0., s, c, 0., 0., 0., 0., 1.];
        assert!(
            distance(&r([PI / 5., 0., 0.]), &Affine { matrix: DMatrix::from_row_slice(4, 4, &about_x) })
                < 1e-15
        );
        assert!(distance(&(&r([-PI / 5., 0., 0.]) * &r([PI / 5., 0., 0.])), &Affine::identity(3)) < 1e-15);
        assert!(distance(&rotation([1., 2., 2.], 3.).unwrap(), &r([1., 2., 2.])) < 1e-15);
        assert_eq!(r([0., 0., 0.]), Affine::identity(3));
    }

    #[test]
    fn refusals() {
        let square = DMatrix::from_row_slice(2, 2, &[1., 0., 1., 1.]);
        assert_eq!(Affine::from_matrix(square), Err(AffineError::NotAffine { row: 1, col: 0, value: 1. }));
        assert_eq!(
            Affine::from_matrix(DMatrix::zeros(2, 3)),
            Err(AffineError::NotSquare { rows: 2, cols: 3 })
        );
        assert_eq!(rotation([0., 0., 0.], 1.), Err(AffineError::Axis([0., 0., 0.])));
        assert!(matches!(rotation([f64::NAN, 0., 0.], 1.), Err(AffineError::Axis(_))));
        assert_eq!(s(&[1., 0., 1.]).check_regular(), Err(AffineError::Singular));
        assert_eq!(s(&[1e-200, 1e-200, 1e-200]).check_regular(), Ok(()));
        assert!(matches!(
            t(&[f64::INFINITY]).check_regular(),
            Err(AffineError::NonFinite { row: 0, col: 1, .. })
        ));
        assert_eq!(
            t(&[1., 2.]).apply(&Points::new(3)),
            Err(AffineError::Dimension { expected: 3, found: 2 })
        );
    }

    #[test]
    fn mirrors() {
        assert!(s(&[-1., 1., 1.]).is_mirror());
        assert!(!s(&[-1., -1., 1.]).is_mirror());
        assert!(s(&[-1e-300, 1e-300, 1e-300]).is_mirror());
    }

    proptest! {
        #[test]
        fn rotations_are_orthogonal(v in prop::array::uniform3(-10.0..10.0_f64)) {
            let m = r(v);
            prop_assert!((m.matrix() * m.matrix().transpose() - Affine::identity(3).matrix()).amax() < 1e-14);
            prop_assert!((m.determinant() - 1.).abs() < 1e-14);
            prop_assert!(distance(&m.inverse().unwrap(), &r(v.map(|x| -x))) < 1e-14);
        }
    }
}
