//! Cuboidal grids of any dimension with the cells of every dimension.
//!
//! The p-cells of a d-dimensional grid are products of d factors, p of them unit intervals and d − p of them
//! grid points. Which factors are intervals is a bit mask (the first axis is the highest bit); p-cells come
//! in rising order of masks and, inside a mask, in row-major order of their lowest corner.

use crate::multi_index::{for_each_row_major, masks_of_order};
use crate::{Cells, Model, Points};

/// The grid of `shape[0] × … × shape[d − 1]` unit cubes with its lowest corner at the origin, with all its
/// skeletons: `cells(p)` for p = 0..=d, each cell the set of its 2^p vertices in row-major (grid) order.
///
/// A grid of no dimension has no cells, since points without coordinates are not counted.
///
/// Vertices are numbered in row-major order, the last coordinate fastest. O(cells · 2^d) time and memory.
///
/// # Panics
/// When the cells of one dimension have 2^32 vertices or more in all, which no `u32` index could address.
///
/// ```
/// let cube = lar_core::cuboid_grid(&[1, 1, 1]);
/// assert_eq!(cube.f_vector(), [8, 12, 6, 1]);
/// assert_eq!(&cube.cells(2)[0], [0, 1, 2, 3]);
/// assert_eq!(cube.points().point(4), [1., 0., 0.]);
/// ```
///
/// Source: DiCarlo, Paoluzzi, Shapiro, CAD 46 (2014).
#[doc(alias = "cuboidGrid")]
#[doc(alias = "larCuboids")]
#[must_use]
pub fn cuboid_grid(shape: &[usize]) -> Model {
    if shape.is_empty() {
        return Model::new(Points::new(0), vec![Cells::new()]);
    }
    let cells = (0..=shape.len()).map(|p| grid_skeleton(shape, p)).collect();
    Model::new(grid_points(shape), cells)
}

/// The p-cells of the cuboidal grid of `shape`, as vertices of that grid: all cells that are intervals along
/// p of the d axes and points along the others. None when p is above d, or when d is 0. O(cells · 2^p).
///
/// # Panics
/// As [`cuboid_grid`].
///
/// ```
/// let edges = lar_core::grid_skeleton(&[1, 2], 1);
/// assert_eq!(edges.indices(), [0, 1, 1, 2, 3, 4, 4, 5, 0, 3, 1, 4, 2, 5]);
/// ```
#[doc(alias = "larGridSkeleton")]
#[must_use]
pub fn grid_skeleton(shape: &[usize], p: usize) -> Cells {
    let d = shape.len();
    if p > d || d == 0 {
        return Cells::new();
    }
    assert!(d < 32, "a grid of {d} dimensions has cells of 2^32 vertices or more");
    check_numbering(shape);
    let masks: Vec<u64> = masks_of_order(d, p).collect();
    let n_cells: usize = masks.iter().map(|&mask| cell_counts(shape, mask).iter().product::<usize>()).sum();
    let mut cells = Cells::with_capacity(n_cells, n_cells << p);
    for mask in masks {
        push_cells(shape, mask, &mut cells);
    }
    cells
}

/// The vertices of the cuboidal grid of `shape`: all points with whole coordinates from 0 to those of `shape`, in
/// row-major order. O(vertices · d).
///
/// # Panics
/// When there are 2^32 points or more.
///
/// ```
/// let points = lar_core::grid_points(&[1, 2]);
/// assert_eq!((points.len(), points.point(5)), (6, &[1., 2.][..]));
/// ```
#[doc(alias = "larImageVerts")]
#[must_use]
pub fn grid_points(shape: &[usize]) -> Points {
    let n = check_numbering(shape);
    let counts: Vec<usize> = shape.iter().map(|&n| n + 1).collect();
    let mut coords = Vec::with_capacity(if shape.is_empty() { 0 } else { n * shape.len() });
    for_each_row_major(&counts, |at| {
        #[expect(clippy::cast_precision_loss, reason = "grid coordinates stay below 2^32")]
        coords.extend(at.iter().map(|&x| x as f64));
    });
    Points::from_columns(shape.len(), coords)
}

/// The number of vertices.
fn check_numbering(shape: &[usize]) -> usize {
    let n = shape.iter().try_fold(1_u32, |n, &k| n.checked_mul(u32::try_from(k).ok()?.checked_add(1)?));
    n.unwrap_or_else(|| panic!("a grid of shape {shape:?} has 2^32 vertices or more")) as usize
}

/// How many cells with intervals along the axes of `mask` there are along each axis.
fn cell_counts(shape: &[usize], mask: u64) -> Vec<usize> {
    let last = shape.len() - 1;
    (0..=last).map(|axis| shape[axis] + 1 - (mask >> (last - axis) & 1) as usize).collect()
}

/// The cells whose intervals lie along the axes of `mask`, row-major by their lowest corner.
fn push_cells(shape: &[usize], mask: u64, cells: &mut Cells) {
    let last = shape.len() - 1;
    let counts = cell_counts(shape, mask);
    let mut strides = vec![1_u32; shape.len()];
    for axis in (0..last).rev() {
        strides[axis] = strides[axis + 1] * index(shape[axis + 1] + 1);
    }
    let mut corners = vec![0_u32];
    for axis in (0..=last).filter(|&axis| counts[axis] == shape[axis]) {
        corners = corners.iter().flat_map(|&c| [c, c + strides[axis]]).collect();
    }
    let mut cell = corners.clone();
    for_each_row_major(&counts[..last], |at| {
        let row: u32 = at.iter().zip(&strides).map(|(&x, &stride)| index(x) * stride).sum();
        for lowest in row..row + index(counts[last]) {
            for (vertex, corner) in cell.iter_mut().zip(&corners) {
                *vertex = lowest + corner;
            }
            cells.push(&cell);
        }
    });
}

fn index(n: usize) -> u32 {
    u32::try_from(n).expect("the number of vertices fits u32")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(shape: &[usize], expected: &[usize]) {
        let grid = cuboid_grid(shape);
        assert_eq!(grid.f_vector(), expected, "{shape:?}");
        assert_eq!(grid.validate(), []);
        let euler: i64 =
            (0..).zip(expected).map(|(p, &n)| if p % 2 == 0 { n as i64 } else { -(n as i64) }).sum();
        assert_eq!(euler, 1, "{shape:?}");
    }

    #[test]
    fn f_vectors() {
        check(&[1], &[2, 1]);
        check(&[10], &[11, 10]);
        check(&[1, 1], &[4, 4, 1]);
        check(&[3, 2], &[12, 17, 6]);
        check(&[3, 3], &[16, 24, 9]);
        check(&[3, 10], &[44, 73, 30]);
        check(&[20, 20], &[441, 840, 400]);
        check(&[1, 1, 1], &[8, 12, 6, 1]);
        check(&[2, 2, 2], &[27, 54, 36, 8]);
        check(&[3, 2, 1], &[24, 46, 29, 6]);
        check(&[3, 3, 10], &[176, 424, 339, 90]);
        check(&[10, 10, 10], &[1331, 3630, 3300, 1000]);
        check(&[20, 20, 20], &[9261, 26460, 25200, 8000]);
        check(&[32, 32, 16], &[18513, 53328, 51200, 16384]);
        check(&[1, 1, 1, 1], &[16, 32, 24, 8, 1]);
    }

    #[test]
    fn flat_grids_lose_the_dimension() {
        assert_eq!(cuboid_grid(&[]).validate(), []);
        assert_eq!(cuboid_grid(&[]).f_vector(), [0]);
        check(&[0], &[1, 0]);
        check(&[2, 0], &[3, 2, 0]);
    }

    #[test]
    fn unit_cube_numbering() {
        let cube = cuboid_grid(&[1, 1, 1]);
        let one_based = |p: usize| -> Vec<String> {
            cube.cells(p).iter().map(|c| c.iter().map(|v| (v + 1).to_string()).collect()).collect()
        };
        let points: Vec<String> =
            cube.points().iter().map(|p| p.iter().map(ToString::to_string).collect()).collect();
        assert_eq!(points, ["000", "001", "010", "011", "100", "101", "110", "111"]);
        assert_eq!(one_based(1), ["12", "34", "56", "78", "13", "24", "57", "68", "15", "26", "37", "48"]);
        assert_eq!(one_based(2), ["1234", "5678", "1256", "3478", "1357", "2468"]);
        assert_eq!(one_based(3), ["12345678"]);
    }
}
