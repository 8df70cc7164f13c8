//! Cartesian products of cellular complexes of any dimensions.
//!
//! The (i + j)-cells of A × B are the products of an i-cell of A and a j-cell of B; f-vectors multiply as
//! polynomials. A factor without edges (points only) copies the other factor into a space of higher
//! dimension.

use crate::from_model::sides;
use crate::{Cells, Model, ModelError, Points};
use std::borrow::Cow;

/// Why a product cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProductError {
    /// A factor is malformed.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The product would have more vertices or cell entries than `u32` can number.
    #[error("a product with {size} vertices or entries of {dim}-cells; fewer than 2^32 can be numbered")]
    TooLarge {
        /// Dimension of the cells.
        dim: usize,
        /// The number of vertices or entries, saturated.
        size: u64,
    },
}

/// The product A × B with all the skeletons that the factors have.
///
/// A point of the product is a point of A followed by one of B, in row-major order: vertex (a, b) has the number
/// a · |B| + b. The p-cells are, for i = 0..=p, each i-cell of A with each (p − i)-cell of B; the vertices of a
/// cell are the pairs in row-major order. Products of grids on the line are [`cuboid_grid`]s, though from four
/// axes on their cells come in another order. The sides of cyclic faces become edges first. O(size of the
/// product).
///
/// # Errors
/// When a factor is malformed, or `u32` cannot number the vertices and cell entries of the product.
///
/// ```
/// use lar_core::{cuboid_grid, product, simplex};
/// let prism = product(&simplex(2), &cuboid_grid(&[1]))?;
/// assert_eq!(prism.f_vector(), [6, 9, 5, 1]);
/// assert_eq!(product(&cuboid_grid(&[2, 3]), &cuboid_grid(&[4]))?, cuboid_grid(&[2, 3, 4]));
/// # Ok::<(), lar_core::ProductError>(())
/// ```
///
/// [`cuboid_grid`]: crate::cuboid_grid
#[doc(alias = "larModelProduct")]
pub fn product(a: &Model, b: &Model) -> Result<Model, ProductError> {
    a.check_well_formed()?;
    b.check_well_formed()?;
    let points = product_points(a.points(), b.points())?;
    let (a_cells, b_cells) = (skeletons(a), skeletons(b));
    let stride = b.points().len();
    let mut cells = Vec::new();
    for dim in 0..(a_cells.len() + b_cells.len()).saturating_sub(1) {
        let pairs =
            (0..a_cells.len().min(dim + 1)).filter_map(|i| Some((&*a_cells[i], &**b_cells.get(dim - i)?)));
        cells.push(union_of_products(dim, pairs, stride)?);
    }
    Ok(Model::new(points, cells))
}

/// The product of any number of factors, from left to right: A × B × C …; of none, the grid of no dimension.
/// O(size of the result).
///
/// # Errors
/// As [`product`].
///
/// ```
/// use lar_core::{grid_1d, product_all};
/// let line = grid_1d(&[0.1, -0.1, 0.1])?;
/// let eight = product_all([&line; 3])?;
/// assert_eq!((eight.points().len(), eight.cells(3).len()), (64, 8));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "INSR")]
pub fn product_all<'a>(factors: impl IntoIterator<Item = &'a Model>) -> Result<Model, ProductError> {
    let mut factors = factors.into_iter();
    let Some(first) = factors.next() else { return Ok(crate::cuboid_grid(&[])) };
    factors.try_fold(first.clone(), |so_far, next| product(&so_far, next))
}

/// All points of `a` followed by all of `b`, `b` fastest: a (d_a + d_b) × (n_a · n_b) matrix. O(size of the result).
///
/// # Errors
/// When there are 2^32 points or more.
///
/// ```
/// use lar_core::{Points, product_points};
/// let (xy, z) = (Points::from_columns(2, vec![1., 2.]), Points::from_columns(1, vec![3., 4.]));
/// assert_eq!(product_points(&xy, &z)?.coords(), [1., 2., 3., 1., 2., 4.]);
/// # Ok::<(), lar_core::ProductError>(())
/// ```
#[doc(alias = "larVertProd")]
pub fn product_points(a: &Points, b: &Points) -> Result<Points, ProductError> {
    check_size(0, a.len() as u128 * b.len() as u128)?;
    let dim = a.dim() + b.dim();
    let mut coords = Vec::with_capacity(a.len() * b.len() * dim);
    for p in a.iter() {
        for q in b.iter() {
            coords.extend_from_slice(p);
            coords.extend_from_slice(q);
        }
    }
    Ok(Points::from_columns(dim, coords))
}

/// Each cell of `a` times each cell of `b`, `b` fastest: cells of the pairs a · `stride` + b of their
/// vertices in row-major order, `stride` being the number of vertices that the cells of `b` are numbered by.
/// O(size of the result).
///
/// # Errors
/// When the cells would have 2^32 entries or more, or name a vertex that does not fit `u32`.
///
/// ```
/// use lar_core::{Cells, product_cells};
/// let edge = Cells::uniform(2, vec![0, 1]);
/// assert_eq!(&product_cells(&edge, &edge, 2)?[0], [0, 1, 2, 3]);
/// # Ok::<(), lar_core::ProductError>(())
/// ```
#[doc(alias = "larCellProd")]
pub fn product_cells(a: &Cells, b: &Cells, stride: usize) -> Result<Cells, ProductError> {
    let largest = |cells: &Cells| cells.indices().iter().max().map_or(0, |&v| u128::from(v));
    check_size(0, largest(a) * stride as u128 + largest(b) + 1)?;
    union_of_products(0, std::iter::once((a, b)), stride)
}

fn union_of_products<'a>(
    dim: usize,
    pairs: impl Iterator<Item = (&'a Cells, &'a Cells)> + Clone,
    stride: usize,
) -> Result<Cells, ProductError> {
    let sum =
        |of: fn(&Cells) -> usize| pairs.clone().map(|(a, b)| of(a) as u128 * of(b) as u128).sum::<u128>();
    let (n_cells, n_entries) = (sum(Cells::len), sum(|cells| cells.indices().len()));
    check_size(dim, n_entries.max(n_cells))?;
    let size = |n: u128| usize::try_from(n).expect("fewer than 2^32");
    let stride = u32::try_from(stride).unwrap_or(u32::MAX);
    let mut cells = Cells::with_capacity(size(n_cells), size(n_entries));
    let mut cell = Vec::new();
    for (a, b) in pairs {
        for p in a.iter() {
            for q in b.iter() {
                cell.clear();
                cell.extend(p.iter().flat_map(|&v| q.iter().map(move |&w| v * stride + w)));
                cells.push(&cell);
            }
        }
    }
    Ok(cells)
}

fn check_size(dim: usize, size: u128) -> Result<(), ProductError> {
    let size = u64::try_from(size).unwrap_or(u64::MAX);
    if size <= u64::from(u32::MAX) { Ok(()) } else { Err(ProductError::TooLarge { dim, size }) }
}

/// The cells by dimension; for a model of cyclic faces with their sides as edges.
pub(crate) fn skeletons(model: &Model) -> Vec<Cow<'_, Cells>> {
    let own = (0..model.f_vector().len()).map(|p| Cow::Borrowed(model.cells(p)));
    let mut cells: Vec<_> = own.collect();
    if model.dim() >= 2 && model.cells(1).is_empty() {
        cells[1] = Cow::Owned(sides(model.cells(2)));
    }
    cells
}
