//! Which cells touch which: the incidence and adjacency relations VV, VE, VF, …, CC by products of operators.
//!
//! The relations are products of the *unsigned* operators |∂p| and their transposes: one product for cells of
//! neighbouring dimensions or of one dimension, more for those further apart. With signed matrices some
//! products lose pairs to cancellation (∂1·δ0 is the graph Laplacian), so signs are dropped first, and in the
//! relation of a dimension with itself the pairs of a cell with itself are left out. A query is a row of a
//! 0/1 matrix that stands to the left of the product, so a batch of queries is a product too.

use crate::{Cells, ChainComplex, ChainError, Operator};

/// The unsigned operators of a complex in both directions, ready for queries: for each p, which (p−1)-cells
/// bound a p-cell and which p-cells a (p−1)-cell bounds. As large as the operators.
///
/// ```
/// use lar_core::{Cells, ChainComplex, cuboid_grid};
/// let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap().incidence();
/// assert_eq!(bar.related(3, 2, 0).unwrap().len(), 6); // the faces of cell 0
/// let halves = bar.batch(3, 0, &Cells::uniform(1, vec![1, 0])).unwrap(); // the vertices of cells 1 and 0
/// assert_eq!(&halves[1], [0, 1, 2, 3, 4, 5, 6, 7]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Incidence {
    n_cells: Vec<usize>,
    /// `down[p]`: the p-cells that bound each (p+1)-cell.
    down: Vec<Cells>,
    /// `up[p]`: the (p+1)-cells that each p-cell bounds.
    up: Vec<Cells>,
}

impl Incidence {
    /// The unsigned operators of `complex`. O(size).
    #[must_use]
    pub fn new(complex: &ChainComplex) -> Self {
        let down: Vec<Cells> = (1..=complex.dim()).map(|p| lists(complex.boundary(p))).collect();
        let up = (0..).zip(&down).map(|(p, cells)| transpose(cells, complex.n_cells(p))).collect();
        Self { n_cells: complex.f_vector(), down, up }
    }

    /// The q-cells related to one p-cell, in rising order; related as in [`ChainComplex::relation`]. Time in
    /// proportion to the cells met on the way, not to the size of the complex.
    ///
    /// # Errors
    /// When there is no such p-cell.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap().incidence();
    /// assert_eq!(square.related(0, 0, 3).unwrap(), [1, 2]); // the neighbours of vertex 3
    /// assert_eq!(square.related(2, 2, 1).unwrap_err().to_string(), "2-cell 1 of 1");
    /// ```
    pub fn related(&self, p: usize, q: usize, cell: u32) -> Result<Vec<u32>, ChainError> {
        self.batch(p, q, &Cells::uniform(1, vec![cell])).map(|found| found.into_parts().1)
    }

    /// Many queries as one product Q · R: each query is a set of p-cells, a row of Q (queries × p-cells); its
    /// answer are the q-cells related to at least one of them, in rising order.
    ///
    /// # Errors
    /// When a query names a p-cell that does not exist.
    ///
    /// # Panics
    /// When the answers have 2^32 entries or more in all.
    ///
    /// ```
    /// use lar_core::{Cells, ChainComplex, cuboid_grid};
    /// let grid = ChainComplex::from_model(&cuboid_grid(&[3, 1])).unwrap().incidence();
    /// let queries = [&[0, 1][..], &[], &[2]].into_iter().collect();
    /// let edges = grid.batch(2, 1, &queries).unwrap();
    /// assert_eq!(edges.iter().map(<[u32]>::len).collect::<Vec<_>>(), [7, 0, 4]);
    /// ```
    pub fn batch(&self, p: usize, q: usize, queries: &Cells) -> Result<Cells, ChainError> {
        let n_cells = self.n_cells.get(p).copied().unwrap_or(0);
        match queries.indices().iter().find(|&&c| c as usize >= n_cells) {
            Some(&cell) => Err(ChainError::CellOutOfRange { dim: p, cell, n_cells }),
            None => Ok(self.answers(p, q, queries.clone())),
        }
    }

    /// The whole relation: [`batch`](Self::batch) with each p-cell alone.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
    /// let ff = cube.incidence().relation(2, 2);
    /// assert_eq!(&ff[0], [2, 3, 4, 5]); // all but the opposite face
    /// ```
    #[doc(alias("VV", "VE", "VF", "EV", "EE", "EF", "FV", "FE", "FF"))]
    #[must_use]
    pub fn relation(&self, p: usize, q: usize) -> Cells {
        let n = self.n_cells.get(p).copied().unwrap_or(0);
        self.answers(p, q, Cells::singletons(n))
    }

    /// The relation as a 0/1 matrix: rows p-cells, columns q-cells, stored by rows. O(size of the products).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
    /// let fv = cube.incidence().matrix(2, 0);
    /// assert_eq!((fv.rows(), fv.cols(), fv.nnz()), (6, 8, 24));
    /// ```
    #[must_use]
    pub fn matrix(&self, p: usize, q: usize) -> Operator {
        let (offsets, indices) = self.relation(p, q).into_parts();
        let ones = vec![1; indices.len()];
        Operator::new((offsets.len() - 1, self.n_cells.get(q).copied().unwrap_or(0)), offsets, indices, ones)
    }

    fn answers(&self, p: usize, q: usize, queries: Cells) -> Cells {
        let dim = self.down.len();
        if p > dim || q > dim || (p, q, dim) == (0, 0, 0) {
            return queries.iter().map(|_| &[][..]).collect();
        }
        if p == q {
            let steps =
                if p == 0 { [&self.up[0], &self.down[0]] } else { [&self.down[p - 1], &self.up[p - 1]] };
            return adjacency(&queries, steps);
        }
        let down = (q..p).rev().map(|k| &self.down[k]);
        let up = (p..q).map(|k| &self.up[k]);
        down.chain(up).fold(queries, |so_far, step| product(&so_far, step))
    }
}

impl ChainComplex {
    /// The unsigned operators in both directions, for many queries. O(size).
    #[must_use]
    pub fn incidence(&self) -> Incidence {
        Incidence::new(self)
    }

    /// For each p-cell, the q-cells related to it, in rising order: its faces of dimension q when q < p, the
    /// cells it is a face of when q > p, and when q = p the other p-cells that share a (p−1)-cell with it (for
    /// vertices: that share an edge). Cells of a dimension above d do not exist. O(size of the products); for
    /// several relations or single cells take [`incidence`](Self::incidence) once.
    ///
    /// # Panics
    /// When the relation has 2^32 pairs or more.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
    /// assert_eq!(&cube.relation(2, 1)[0], [0, 1, 4, 5]); // FE
    /// assert_eq!(&cube.relation(0, 2)[0], [0, 2, 4]); // VF
    /// assert_eq!(&cube.relation(0, 0)[0], [1, 2, 4]); // VV
    /// assert_eq!(cube.relation(2, 2)[0].len(), 4); // FF
    /// ```
    #[doc(alias(
        "VV", "VE", "VF", "VC", "EV", "EE", "EF", "EC", "FV", "FE", "FF", "FC", "CV", "CE", "CF", "CC"
    ))]
    #[must_use]
    pub fn relation(&self, p: usize, q: usize) -> Cells {
        self.incidence().relation(p, q)
    }
}

/// The rows with entries other than zero of each column.
pub(crate) fn lists(operator: &Operator) -> Cells {
    let by_columns;
    let operator = if operator.is_csc() {
        operator
    } else {
        by_columns = operator.to_csc();
        &by_columns
    };
    let mut cells = Cells::with_capacity(operator.cols(), operator.nnz());
    let mut buffer: Vec<u32> = Vec::new();
    for column in operator.outer_iterator() {
        buffer.clear();
        buffer.extend(column.indices().iter().zip(column.data()).filter(|e| *e.1 != 0).map(|e| *e.0));
        cells.push(&buffer);
    }
    cells
}

/// For each index below `n`, or named by a cell, the cells that name it, in rising order.
pub(crate) fn transpose(cells: &Cells, n: usize) -> Cells {
    let n = cells.indices().iter().fold(n, |n, &i| n.max(i as usize + 1));
    let mut offsets = vec![0_u32; n + 1];
    for &i in cells.indices() {
        offsets[i as usize + 1] += 1;
    }
    for i in 0..n {
        offsets[i + 1] += offsets[i];
    }
    let mut next = offsets.clone();
    let mut names = vec![0_u32; cells.indices().len()];
    for (cell, members) in (0..).zip(cells.iter()) {
        for &i in members {
            names[next[i as usize] as usize] = cell;
            next[i as usize] += 1;
        }
    }
    Cells::from_parts(offsets, names)
}

/// The nonzero pattern of a product: for each list of `first`, the union of the lists of `then` that it names.
fn product(first: &Cells, then: &Cells) -> Cells {
    let mut unions = Cells::with_capacity(first.len(), first.indices().len());
    let mut buffer = Vec::new();
    for names in first.iter() {
        buffer.clear();
        buffer.extend(names.iter().filter_map(|&i| then.get(i as usize)).flatten().copied());
        push_set(&mut unions, &mut buffer);
    }
    unions
}

/// As two products, but no cell is its own neighbour.
fn adjacency(queries: &Cells, [there, back]: [&Cells; 2]) -> Cells {
    let mut neighbours = Cells::with_capacity(queries.len(), queries.indices().len());
    let mut buffer = Vec::new();
    for names in queries.iter() {
        buffer.clear();
        for &own in names {
            let shared = there.get(own as usize).unwrap_or_default();
            let touching = shared.iter().filter_map(|&i| back.get(i as usize)).flatten().copied();
            buffer.extend(touching.filter(|&c| c != own));
        }
        push_set(&mut neighbours, &mut buffer);
    }
    neighbours
}

fn push_set(cells: &mut Cells, buffer: &mut Vec<u32>) {
    buffer.sort_unstable();
    buffer.dedup();
    cells.push(buffer);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, cuboid_grid};
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    fn grid(shape: &[usize]) -> ChainComplex {
        ChainComplex::from_model(&cuboid_grid(shape)).unwrap()
    }

    /// The number of pairs in each relation, by rows VV VE VF VC, EV …, CC.
    #[track_caller]
    fn check(shape: &[usize], expected: &[[usize; 4]; 4]) {
        let complex = grid(shape);
        let found = [0, 1, 2, 3].map(|p| [0, 1, 2, 3].map(|q| complex.relation(p, q).indices().len()));
        assert_eq!(&found, expected, "{shape:?}");
    }

    #[test]
    fn sizes() {
        check(&[1, 1, 1], &[[24, 24, 24, 8], [24, 48, 24, 12], [24, 24, 24, 6], [8, 12, 6, 0]]);
        check(&[2, 1, 1], &[[40, 40, 44, 16], [40, 96, 44, 24], [44, 44, 56, 12], [16, 24, 12, 2]]);
        check(&[1, 1], &[[8, 8, 4, 0], [8, 8, 4, 0], [4, 4, 0, 0], [0; 4]]);
    }

    #[test]
    fn vertices_of_cells_are_those_of_the_model() {
        let model = cuboid_grid(&[2, 2, 2]);
        let complex = grid(&[2, 2, 2]);
        for p in 1..=3 {
            assert_eq!(&complex.relation(p, 0), model.cells(p));
        }
    }

    #[test]
    fn points_alone_have_no_neighbours() {
        let dust = ChainComplex::new(crate::Points::from_columns(1, vec![1., 2.]), Vec::new()).incidence();
        assert_eq!(dust.related(0, 0, 1), Ok(vec![]));
        assert_eq!(dust.related(1, 0, 0), Err(ChainError::CellOutOfRange { dim: 1, cell: 0, n_cells: 0 }));
        assert_eq!(dust.matrix(1, 0).shape(), (0, 2));
    }

    #[test]
    fn operators_stored_by_rows_and_explicit_zeros() {
        let square = grid(&[1, 1]);
        let rows = (1..=2).map(|p| square.boundary(p).to_csr()).collect();
        assert_eq!(ChainComplex::new(square.points().clone(), rows).incidence(), square.incidence());
        let zeros = square.boundary(2).map(|_| 0);
        let open = ChainComplex::new(square.points().clone(), vec![square.boundary(1).clone(), zeros]);
        assert_eq!(open.relation(2, 1).indices().len(), 0);
    }

    /// The grid without some of its 3-cells and, of the rest, only faces of those kept.
    fn some_cubes(shape: &[usize], keep: &[bool]) -> Model {
        let (points, mut cells) = cuboid_grid(shape).into_parts();
        cells[3] = cells[3].iter().zip(keep).filter(|e| *e.1).map(|e| e.0).collect();
        for p in (1..3).rev() {
            let inside = |c: &&[u32]| cells[3].iter().any(|big| c.iter().all(|v| big.contains(v)));
            cells[p] = cells[p].iter().filter(inside).collect();
        }
        Model::new(points, cells)
    }

    /// Convex cells: a face is a cell whose vertices are all among those of another.
    fn brute_force(model: &Model, p: usize, q: usize) -> Vec<Vec<u32>> {
        let within = |a: &[u32], b: &[u32]| a.iter().all(|v| b.contains(v));
        let neighbours = |a: &[u32], b: &[u32]| {
            let through = if p == 0 { model.cells(1) } else { model.cells(p - 1) };
            a != b
                && through
                    .iter()
                    .any(|t| if p == 0 { within(a, t) && within(b, t) } else { within(t, a) && within(t, b) })
        };
        let related = |a: &[u32], b: &[u32]| match p.cmp(&q) {
            std::cmp::Ordering::Less => within(a, b),
            std::cmp::Ordering::Equal => neighbours(a, b),
            std::cmp::Ordering::Greater => within(b, a),
        };
        let row =
            |a: &[u32]| (0..).zip(model.cells(q).iter()).filter(|e| related(a, e.1)).map(|e| e.0).collect();
        model.cells(p).iter().map(row).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn agreement_with_brute_force(keep in prop::collection::vec(any::<bool>(), 12), pick in any::<u32>()) {
            let model = some_cubes(&[3, 2, 2], &keep);
            let incidence = ChainComplex::from_model(&model).unwrap().incidence();
            for (p, q) in (0..4).flat_map(|p| (0..4).map(move |q| (p, q))) {
                let expected = brute_force(&model, p, q);
                let relation = incidence.relation(p, q);
                prop_assert_eq!(relation.iter().collect::<Vec<_>>(), expected.clone(), "{} {}", p, q);
                let n = model.cells(p).len() as u32;
                if n > 0 {
                    let (a, b) = (pick % n, pick / 7 % n);
                    prop_assert_eq!(&incidence.related(p, q, a).unwrap(), &expected[a as usize]);
                    let both = incidence.batch(p, q, &Cells::uniform(2, vec![a, b])).unwrap();
                    let union: BTreeSet<u32> =
                        expected[a as usize].iter().chain(&expected[b as usize]).copied().collect();
                    prop_assert_eq!(&both[0], union.into_iter().collect::<Vec<_>>());
                }
                prop_assert_eq!(incidence.matrix(p, q).nnz(), relation.indices().len());
            }
        }
    }
}
