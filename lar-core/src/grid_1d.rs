//! Complexes on the line: evenly spaced points, unit intervals, and sequences of intervals and gaps. As
//! factors of a [`product`](crate::product) they make grids, grids with gaps, and flat cells in higher space.

use crate::{Cells, Model, Points};

/// Why a sequence of steps makes no complex on the line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// A step is zero, infinite or not a number, or the steps up to it add up to infinity.
    #[error("step {index} is {value}: steps are finite, not zero, and have a finite sum")]
    Step {
        /// Position in the sequence of steps, from 0.
        index: usize,
        /// The step.
        value: f64,
    },
    /// The complex would have more vertices than `u32` can number.
    #[error("{vertices} vertices; at most 2^31 can be numbered")]
    TooLarge {
        /// The number of vertices.
        vertices: u128,
    },
}

/// The n + 1 points 0, 1, …, n on the line as 0-cells, without edges: f-vector n + 1. As a factor of a
/// product, `grid_0(0)` embeds the other factor in a space of one more dimension. O(n).
///
/// # Errors
/// When `u32` cannot number the vertices.
///
/// ```
/// use lar_core::{cuboid_grid, grid_0, product};
/// let points = grid_0(3)?;
/// assert_eq!((points.dim(), points.f_vector()), (0, vec![4]));
/// let square_in_space = product(&cuboid_grid(&[1, 1]), &grid_0(0)?)?;
/// assert_eq!((square_in_space.points().dim(), square_in_space.f_vector()), (3, vec![4, 4, 1]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "larGrid")]
pub fn grid_0(n: usize) -> Result<Model, GridError> {
    let (points, cells) = grid_1(n)?.into_parts();
    Ok(Model::new(points, cells.into_iter().take(1).collect()))
}

/// The n unit intervals from 0 to n on the line, with their end points: f-vector n + 1, n. The same as
/// `cuboid_grid(&[n])`. O(n).
///
/// # Errors
/// When `u32` cannot number the vertices.
///
/// ```
/// let line = lar_core::grid_1(3)?;
/// assert_eq!(line.cells(1).indices(), [0, 1, 1, 2, 2, 3]);
/// # Ok::<(), lar_core::GridError>(())
/// ```
#[doc(alias = "larGrid")]
pub fn grid_1(n: usize) -> Result<Model, GridError> {
    check_size(n as u128 + 1)?;
    Ok(crate::cuboid_grid(&[n]))
}

/// Consecutive intervals on the line from 0: each positive step is an edge of that length, each negative step
/// a gap. Vertex i is the end of the first i steps, so there is one more vertex than there are steps, also
/// where two gaps meet. O(steps).
///
/// # Errors
/// When a step is zero or not finite, their sum is not finite, or `u32` cannot number the vertices.
///
/// ```
/// let line = lar_core::grid_1d(&[1., -1., 2.])?;
/// assert_eq!(line.points().coords(), [0., 1., 2., 4.]);
/// assert_eq!(line.cells(1).indices(), [0, 1, 2, 3]);
/// # Ok::<(), lar_core::GridError>(())
/// ```
#[doc(alias = "grid")]
#[doc(alias = "q")]
pub fn grid_1d(steps: &[f64]) -> Result<Model, GridError> {
    grid_1d_repeated(1, steps)
}

/// [`grid_1d`] of the steps taken `n` times over. O(n · steps).
///
/// # Errors
/// As [`grid_1d`].
///
/// ```
/// let line = lar_core::grid_1d_repeated(3, &[1.5, -2., 0.5])?;
/// assert_eq!(line.f_vector(), [10, 6]);
/// assert_eq!(line.points().point(9), [12.]);
/// # Ok::<(), lar_core::GridError>(())
/// ```
#[doc(alias = "qn")]
pub fn grid_1d_repeated(n: usize, steps: &[f64]) -> Result<Model, GridError> {
    check_size(n as u128 * steps.len() as u128 + 1)?;
    let mut at = 0.;
    let mut coords = vec![at];
    let mut edges = Vec::new();
    for (i, (index, &value)) in
        (0..n).flat_map(|_| steps.iter().enumerate()).zip(0_u32..).map(|(s, i)| (i, s))
    {
        at += value.abs();
        if value == 0. || !at.is_finite() {
            return Err(GridError::Step { index, value });
        }
        coords.push(at);
        if value > 0. {
            edges.extend([i, i + 1]);
        }
    }
    let vertices = Cells::singletons(coords.len());
    Ok(Model::new(Points::from_columns(1, coords), vec![vertices, Cells::uniform(2, edges)]))
}

fn check_size(vertices: u128) -> Result<(), GridError> {
    if vertices <= 1 << 31 { Ok(()) } else { Err(GridError::TooLarge { vertices }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(n: usize, steps: &[f64], coords: &[f64], edges: &[[u32; 2]]) {
        let line = grid_1d_repeated(n, steps).unwrap();
        assert_eq!(line.validate(), []);
        assert_eq!(line.points().coords(), coords);
        assert_eq!(line.cells(1).indices(), edges.as_flattened());
        assert_eq!(line.cells(0).len(), coords.len());
    }

    #[test]
    fn steps_and_gaps() {
        let whole: Vec<f64> = (0..=10).map(f64::from).collect();
        check(5, &[1., -1.], &whole, &[[0, 1], [2, 3], [4, 5], [6, 7], [8, 9]]);
        check(
            3,
            &[1.5, -2., 0.5],
            &[0., 1.5, 3.5, 4., 5.5, 7.5, 8., 9.5, 11.5, 12.],
            &[[0, 1], [2, 3], [3, 4], [5, 6], [6, 7], [8, 9]],
        );
        check(1, &[], &[0.], &[]);
        check(0, &[1.], &[0.], &[]);
        check(1, &[-1., -1.], &[0., 1., 2.], &[]);
        assert_eq!(grid_1d(&[1.; 4]).unwrap(), grid_1(4).unwrap());
        assert_eq!(grid_0(2).unwrap().f_vector(), [3]);
    }

    #[track_caller]
    fn refused(found: Result<Model, GridError>, message: &str) {
        assert_eq!(found.unwrap_err().to_string(), message);
    }

    #[test]
    fn refusals() {
        refused(grid_1d(&[1., 0.]), "step 1 is 0: steps are finite, not zero, and have a finite sum");
        refused(
            grid_1d(&[-1., f64::NAN]),
            "step 1 is NaN: steps are finite, not zero, and have a finite sum",
        );
        refused(
            grid_1d_repeated(2, &[f64::MAX]),
            &format!("step 0 is {}: steps are finite, not zero, and have a finite sum", f64::MAX),
        );
        refused(
            grid_1d_repeated(usize::MAX, &[1., 1.]),
            "36893488147419103231 vertices; at most 2^31 can be numbered",
        );
        refused(grid_0(1 << 31), "2147483649 vertices; at most 2^31 can be numbered");
    }
}
