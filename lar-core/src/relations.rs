//! Which cells touch which: the incidence and adjacency relations VV, VE, VF, …, CC by products of operators.
//!
//! The relations are products of the *unsigned* operators |∂p| and their transposes. With signed matrices some
//! products lose pairs to cancellation (∂1·δ0 is the graph Laplacian), so signs are dropped first, and in the
//! relation of a dimension with itself the pairs of a cell with itself are left out.

use crate::{Cells, ChainComplex, Operator};

impl ChainComplex {
    /// For each p-cell, the q-cells related to it, in rising order: its faces of dimension q when q < p, the
    /// cells it is a face of when q > p, and when q = p the other p-cells that share a (p−1)-cell with it (for
    /// vertices: that share an edge). Cells of a dimension above d do not exist. O(size of the products).
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
        let own = Cells::singletons(self.n_cells(p));
        if p > self.dim() || q > self.dim() {
            return own.iter().map(|_| &[][..]).collect();
        }
        if p == q {
            return self.adjacency(p, &own);
        }
        let down = (q..p).rev().map(|k| lists(self.boundary(k + 1)));
        let up = (p..q).map(|k| lists(&self.coboundary(k).to_csc()));
        down.chain(up).fold(own, |so_far, step| product(&so_far, &step))
    }

    fn adjacency(&self, p: usize, own: &Cells) -> Cells {
        let through = match (p, self.dim()) {
            (0, 0) => return own.iter().map(|_| &[][..]).collect(),
            (0, _) => product(&lists(&self.coboundary(0).to_csc()), &lists(self.boundary(1))),
            _ => product(&lists(self.boundary(p)), &lists(&self.coboundary(p - 1).to_csc())),
        };
        let others =
            |(i, cells): (u32, &[u32])| cells.iter().copied().filter(|&c| c != i).collect::<Vec<_>>();
        (0..).zip(through.iter()).map(others).collect()
    }
}

/// The rows with entries other than zero of each column.
fn lists(operator: &Operator) -> Cells {
    let nonzero = |column: sprs::CsVecViewI<'_, i8, u32>| -> Vec<u32> {
        column.indices().iter().zip(column.data()).filter(|e| *e.1 != 0).map(|e| *e.0).collect()
    };
    operator.outer_iterator().map(nonzero).collect()
}

/// The nonzero pattern of a product: for each list of `first`, the union of the lists of `then` that it names.
fn product(first: &Cells, then: &Cells) -> Cells {
    let union = |names: &[u32]| {
        let mut all: Vec<u32> = names.iter().flat_map(|&i| &then[i as usize]).copied().collect();
        all.sort_unstable();
        all.dedup();
        all
    };
    first.iter().map(union).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cuboid_grid;

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
    fn relations_are_transposes() {
        let complex = grid(&[3, 2, 1]);
        for (p, q) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3), (1, 1)] {
            let (pq, qp) = (complex.relation(p, q), complex.relation(q, p));
            assert_eq!(pq.indices().len(), qp.indices().len());
            for (i, cells) in (0..).zip(pq.iter()) {
                assert!(cells.iter().all(|&c| qp[c as usize].contains(&i)));
            }
        }
    }

    #[test]
    fn vertices_of_cells_are_those_of_the_model() {
        let model = cuboid_grid(&[2, 2, 2]);
        let complex = grid(&[2, 2, 2]);
        for p in 1..=3 {
            assert_eq!(&complex.relation(p, 0), model.cells(p));
        }
    }
}
