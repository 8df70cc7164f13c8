//! Incidence between cells given as vertex sets: characteristic matrices and what their products say.
//!
//! With M_p the characteristic matrix of the p-cells (cells × vertices), the product M_q · M_pᵀ counts the
//! vertices that a q-cell and a p-cell share; where the count equals the size of the p-cell, the p-cell lies in
//! the q-cell. For convex cells this is the whole boundary relation. Only the entries that reach that count are
//! computed here.
//!
//! Source: DiCarlo, Paoluzzi, Shapiro, CAD 46 (2014), section 3.

use crate::relations::lists;
use crate::{Cells, ChainComplex, Model, ModelError, Operator};
use sprs::CsMatI;

/// The characteristic matrix of cells: rows cells, columns vertices, 1 where the cell has the vertex; stored by
/// rows. A vertex repeated in a cell counts once. O(n log k) for n indices in cells of k.
///
/// # Panics
/// When a cell names a vertex not below `n_vertices`.
///
/// ```
/// use lar_core::{Cells, characteristic_matrix};
/// let m = characteristic_matrix(&Cells::uniform(2, vec![0, 1, 1, 2]), 3);
/// assert_eq!((m.rows(), m.cols(), m.nnz()), (2, 3, 4));
/// ```
#[doc(alias("characteristicMatrix", "lar2cop"))]
#[must_use]
pub fn characteristic_matrix(cells: &Cells, n_vertices: usize) -> Operator {
    let sorted: Cells = cells
        .iter()
        .map(|cell| {
            let mut cell = cell.to_vec();
            cell.sort_unstable();
            cell.dedup();
            cell
        })
        .collect();
    let ones = vec![1; sorted.indices().len()];
    ChainComplex::operator_from_columns(n_vertices, sorted, ones).transpose_into()
}

/// The number of vertices that two cells share, for all pairs that share any: the product M_a · M_bᵀ of the
/// characteristic matrices, rows the cells of `a`, columns those of `b`. O(size of the product).
///
/// # Panics
/// When a cell names a vertex not below `n_vertices`.
///
/// ```
/// use lar_core::{cuboid_grid, shared_vertices};
/// let cube = cuboid_grid(&[1, 1, 1]);
/// let fe = shared_vertices(cube.cells(2), cube.cells(1), 8);
/// assert_eq!((fe.get(0, 0), fe.get(0, 8), fe.get(0, 2)), (Some(&2), Some(&1), None));
/// ```
#[must_use]
pub fn shared_vertices(a: &Cells, b: &Cells, n_vertices: usize) -> CsMatI<u32, u32> {
    let counts = |cells| characteristic_matrix(cells, n_vertices).map(|&x| u32::from(x.unsigned_abs()));
    &counts(a) * &counts(b).transpose_into().to_csr()
}

/// The cells whose characteristic matrix is given: for each row the columns with entries other than zero, in
/// rising order. O(size).
///
/// ```
/// use lar_core::{Cells, cells_of_matrix, characteristic_matrix};
/// let edges = Cells::uniform(2, vec![0, 1, 1, 2]);
/// assert_eq!(cells_of_matrix(&characteristic_matrix(&edges, 3)), edges);
/// ```
#[doc(alias = "cop2lar")]
#[must_use]
pub fn cells_of_matrix(matrix: &Operator) -> Cells {
    lists(&matrix.transpose_view().to_csc())
}

/// For each cell of `large`, the cells of `small` all of whose vertices it has, in rising order.
///
/// Each small cell is filed under the one of its vertices that fewest small cells share, so a hub vertex does
/// not make the search quadratic. O(output + Σ over large cells of the small cells filed under their vertices)
/// time. Empty small cells lie nowhere. Vertices must be below `n_vertices`.
pub(crate) fn contained_cells(small: &Cells, large: &Cells, n_vertices: usize) -> Cells {
    let filed = file_cells(small, n_vertices);
    let mut last_seen_in = vec![u32::MAX; n_vertices];
    let mut contained = Cells::with_capacity(large.len(), 0);
    for (stamp, cell) in (0..).zip(large.iter()) {
        for &v in cell {
            last_seen_in[v as usize] = stamp;
        }
        let mut inside: Vec<u32> = Vec::new();
        for &v in cell {
            let here = filed[v as usize].iter().copied();
            inside.extend(
                here.filter(|&c| small[c as usize].iter().all(|&w| last_seen_in[w as usize] == stamp)),
            );
        }
        inside.sort_unstable();
        inside.dedup();
        contained.push(&inside);
    }
    contained
}

/// Per vertex, the cells filed under it.
fn file_cells(cells: &Cells, n_vertices: usize) -> Cells {
    let mut degree = vec![0_u32; n_vertices];
    for &v in cells.indices() {
        degree[v as usize] += 1;
    }
    let owners: Vec<Option<u32>> =
        cells.iter().map(|cell| cell.iter().copied().min_by_key(|&v| (degree[v as usize], v))).collect();
    let mut offsets = vec![0_u32; n_vertices + 1];
    for &owner in owners.iter().flatten() {
        offsets[owner as usize + 1] += 1;
    }
    for v in 0..n_vertices {
        offsets[v + 1] += offsets[v];
    }
    let mut next = offsets.clone();
    let mut filed = vec![0_u32; offsets[n_vertices] as usize];
    for (cell, owner) in (0..).zip(&owners) {
        if let Some(owner) = *owner {
            filed[next[owner as usize] as usize] = cell;
            next[owner as usize] += 1;
        }
    }
    Cells::from_parts(offsets, filed)
}

impl Model {
    /// Unsigned ∂p of convex cells in any dimension: rows (p−1)-cells (vertices for p = 1), columns p-cells,
    /// stored by columns, 1 where all vertices of the (p−1)-cell are vertices of the p-cell: where the product
    /// M_p−1 · M_pᵀ counts as many as the (p−1)-cell has. For faces that are not convex see
    /// [`coboundary_1`](Self::coboundary_1). Without rows for p = 0. O(size of the product).
    ///
    /// # Errors
    /// When the model is malformed.
    ///
    /// ```
    /// let cube = lar_core::cuboid_grid(&[1, 1, 1]);
    /// let shapes = [1, 2, 3].map(|p| cube.unsigned_boundary(p).unwrap().shape());
    /// assert_eq!(shapes, [(8, 12), (12, 6), (6, 1)]);
    /// assert_eq!(lar_core::cuboid_grid(&[1, 1, 1, 1]).unsigned_boundary(4).unwrap().nnz(), 8);
    /// ```
    #[doc(alias("boundary_1", "u_boundary_2", "u_boundary_3"))]
    pub fn unsigned_boundary(&self, p: usize) -> Result<Operator, ModelError> {
        self.check_well_formed()?;
        let n_vertices = self.points().len();
        let (rows, faces) = match p {
            0 => (0, self.cells(0).iter().map(|_| [0_u32; 0]).collect()),
            1 => return Ok(characteristic_matrix(self.cells(1), n_vertices).transpose_into()),
            _ => (self.cells(p - 1).len(), contained_cells(self.cells(p - 1), self.cells(p), n_vertices)),
        };
        let ones = vec![1; faces.indices().len()];
        Ok(ChainComplex::operator_from_columns(rows, faces, ones))
    }

    /// Unsigned δp = |∂p+1|ᵀ of convex cells: rows (p+1)-cells, columns p-cells, stored by rows; see
    /// [`unsigned_boundary`](Self::unsigned_boundary).
    ///
    /// # Errors
    /// When the model is malformed.
    ///
    /// ```
    /// let delta = lar_core::cuboid_grid(&[1, 1, 1]).unsigned_coboundary(1).unwrap();
    /// assert_eq!(delta.outer_view(0).unwrap().indices(), [0, 1, 4, 5]);
    /// ```
    #[doc(alias("u_coboundary_1", "u_coboundary_2"))]
    pub fn unsigned_coboundary(&self, p: usize) -> Result<Operator, ModelError> {
        Ok(self.unsigned_boundary(p + 1)?.transpose_into())
    }

    /// δ0 = ∂1ᵀ: rows edges, columns vertices, −1 at the smaller vertex of each edge and +1 at the larger. O(edges).
    ///
    /// # Errors
    /// When the model is malformed.
    ///
    /// ```
    /// let delta = lar_core::cuboid_grid(&[2]).coboundary_0().unwrap();
    /// assert_eq!((delta.shape(), delta.get(1, 1), delta.get(1, 2)), ((2, 3), Some(&-1), Some(&1)));
    /// ```
    #[doc(alias = "build_copEV")]
    pub fn coboundary_0(&self) -> Result<Operator, ModelError> {
        Ok(self.signed_boundary_1()?.transpose_into())
    }

    /// Signed δ1 = ∂2ᵀ of faces convex or not, with holes or without: rows faces, columns edges, stored by rows,
    /// +1 where a loop of the face runs from the smaller vertex of the edge to the larger, −1 where it runs
    /// back. Loops are oriented as in [`to_surface`](Self::to_surface), in the plane counter-clockwise with
    /// clockwise holes. Without signs: `.map(|x| x.abs())`. O(n log n).
    ///
    /// # Errors
    /// When the model is malformed or the edges of a face make no loops.
    ///
    /// ```
    /// use lar_core::{Cells, Model, Points};
    /// // An L whose corner is filled by a triangle: their vertices alone would make 2-4 an edge of both.
    /// let xy = vec![0., 0., 2., 0., 2., 1., 1., 1., 1., 2., 0., 2.];
    /// let edges = vec![0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 0, 5, 2, 4];
    /// let faces = [&[0, 1, 2, 3, 4, 5][..], &[2, 3, 4]].into_iter().collect();
    /// let cells = vec![Cells::singletons(6), Cells::uniform(2, edges), faces];
    /// let model = Model::new(Points::from_columns(2, xy), cells);
    /// assert_eq!(model.unsigned_coboundary(1).unwrap().outer_view(0).unwrap().nnz(), 7);
    /// assert_eq!(model.coboundary_1().unwrap().outer_view(0).unwrap().indices(), [0, 1, 2, 3, 4, 5]);
    /// ```
    pub fn coboundary_1(&self) -> Result<Operator, ModelError> {
        Ok(self.signed_boundary_2()?.transpose_into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cuboid_grid;

    #[test]
    fn unsigned_coboundary_of_the_cube() {
        let delta = cuboid_grid(&[1, 1, 1]).unsigned_coboundary(1).unwrap();
        assert_eq!((delta.rows(), delta.cols(), delta.nnz()), (6, 12, 24));
        let rows: Vec<Vec<u32>> =
            delta.outer_iterator().map(|row| row.indices().iter().map(|e| e + 1).collect()).collect();
        assert_eq!(
            rows,
            [[1, 2, 5, 6], [3, 4, 7, 8], [1, 3, 9, 10], [2, 4, 11, 12], [5, 7, 9, 11], [6, 8, 10, 12]]
        );
        let mut sums = [0; 12];
        for &e in delta.indices() {
            sums[e as usize] += 1;
        }
        assert_eq!(sums, [2; 12]);
    }

    #[test]
    fn operators_of_the_cube() {
        let cube = cuboid_grid(&[1, 1, 1]);
        let unsigned = cube.unsigned_boundary(1).unwrap();
        assert_eq!((unsigned.rows(), unsigned.cols()), (8, 12));
        assert!(unsigned.is_csc() && unsigned.data().iter().all(|&x| x == 1));
        let d0 = cube.coboundary_0().unwrap();
        let d1 = cube.coboundary_1().unwrap();
        assert_eq!((d0.rows(), d0.cols(), d1.rows(), d1.cols()), (12, 8, 6, 12));
        assert!((&d1 * &d0).data().iter().all(|&x| x == 0));
        assert_eq!(d1.map(|x| x.abs()), cube.unsigned_coboundary(1).unwrap());
    }

    #[test]
    fn containment_is_a_count_of_shared_vertices() {
        for shape in [&[3, 2][..], &[2, 2, 2], &[2, 1, 1, 2]] {
            let grid = cuboid_grid(shape);
            for p in 2..=shape.len() {
                let shared = shared_vertices(grid.cells(p), grid.cells(p - 1), grid.points().len());
                let full = |(&count, (row, column)): (&u32, (u32, u32))| {
                    (count as usize == grid.cells(p - 1)[column as usize].len()).then_some((row, column))
                };
                let expected: Vec<(u32, u32)> = shared.iter().filter_map(full).collect();
                let delta = grid.unsigned_coboundary(p - 1).unwrap();
                assert_eq!(delta.iter().map(|e| e.1).collect::<Vec<_>>(), expected);
            }
            assert_eq!(
                cells_of_matrix(&characteristic_matrix(grid.cells(2), grid.points().len())),
                *grid.cells(2)
            );
        }
    }

    #[test]
    fn operators_of_the_ends() {
        let square = cuboid_grid(&[1, 1]);
        assert_eq!(square.unsigned_boundary(0).unwrap().shape(), (0, 4));
        assert_eq!(square.unsigned_boundary(3).unwrap().shape(), (1, 0));
        assert_eq!(square.unsigned_coboundary(7).unwrap().shape(), (0, 0));
    }

    #[test]
    fn a_hub_does_not_make_containment_quadratic() {
        let n = 100_000_u32;
        let edges: Cells = (1..n).map(|v| [0, v]).collect();
        let faces: Cells = (1..n - 1).map(|v| [0, v, v + 1]).collect();
        let inside = contained_cells(&edges, &faces, n as usize);
        assert!(inside.iter().enumerate().all(|(f, e)| e == [f as u32, f as u32 + 1]));
    }
}
