//! Counts that depend on the operators alone: f-vector, Euler characteristic, connected components.

use crate::relations::{lists, transpose};
use crate::{Cells, ChainComplex, Operator};

/// Which component each vertex is in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    /// The number of components.
    pub n: usize,
    /// The component of each vertex; components are numbered in the order of their smallest vertices.
    pub of_vertex: Vec<u32>,
}

impl ChainComplex {
    /// The number of cells of each dimension 0..=d, the exterior cell included where there is one.
    #[must_use]
    pub fn f_vector(&self) -> Vec<usize> {
        (0..=self.dim()).map(|p| self.n_cells(p)).collect()
    }

    /// The alternating sum of the f-vector.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let grid = ChainComplex::from_model(&cuboid_grid(&[3, 2, 1])).unwrap();
    /// assert_eq!((grid.f_vector(), grid.euler_characteristic()), (vec![24, 46, 29, 6], 1));
    /// ```
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        self.f_vector().iter().rev().fold(0, |sum, &n| i64::try_from(n).unwrap_or(i64::MAX) - sum)
    }

    /// The connected components of the 1-skeleton. A vertex without edges is a component. O(n α(n)).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let grid = ChainComplex::from_model(&cuboid_grid(&[3, 3])).unwrap();
    /// assert_eq!(grid.connected_components().n, 1);
    /// ```
    #[must_use]
    pub fn connected_components(&self) -> Components {
        let mut sets = DisjointSets::new(self.n_cells(0));
        let edges = if self.dim() == 0 { None } else { Some(self.boundary(1)) };
        for column in edges.iter().flat_map(|edges: &&Operator| edges.outer_iterator()) {
            for pair in column.indices().windows(2) {
                sets.join(pair[0] as usize, pair[1] as usize);
            }
        }
        let (of_vertex, n) = sets.labels();
        Components { n, of_vertex }
    }
}

/// Which component each cell of each dimension is in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellComponents {
    /// The number of components.
    pub n: usize,
    /// `of_cell[p][i]` is the component of p-cell i; components are numbered in first-seen order, lower
    /// dimensions first.
    pub of_cell: Vec<Vec<u32>>,
}

impl ChainComplex {
    /// The connected components of the whole complex: cells are joined to the cells of their boundaries,
    /// whatever the dimension. A cell without boundary is a component unless another is joined to it: of a
    /// valid complex without exterior the components are those of the 1-skeleton. O(n α(n)).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap();
    /// let found = square.cell_components();
    /// assert_eq!((found.n, &found.of_cell[2][..]), (1, &[0][..]));
    /// ```
    #[must_use]
    pub fn cell_components(&self) -> CellComponents {
        let mut first = vec![0];
        for p in 0..=self.dim() {
            let rows = if p < self.dim() { self.boundary(p + 1).rows() } else { 0 };
            first.push(first[p] + self.n_cells(p).max(rows));
        }
        let mut sets = DisjointSets::new(first[self.dim() + 1]);
        for p in 1..=self.dim() {
            for (cell, faces) in lists(self.boundary(p)).iter().enumerate() {
                faces.iter().for_each(|&f| sets.join(first[p] + cell, first[p - 1] + f as usize));
            }
        }
        let (labels, n) = sets.labels();
        let of_cell =
            (0..=self.dim()).map(|p| labels[first[p]..first[p] + self.n_cells(p)].to_vec()).collect();
        CellComponents { n, of_cell }
    }

    /// The components of the p-cells joined through (p−1)-cells that they share (vertices: through edges), and
    /// how many there are: faces joined through edges, solids joined through faces. Numbered in the order of
    /// their smallest cells. O(n α(n)).
    ///
    /// ```
    /// use lar_core::{ChainComplex, Struct, cuboid_grid, t};
    /// let two = Struct::new("corner to corner").with(cuboid_grid(&[1, 1])).with(t(&[1., 1.]));
    /// let two = two.with(cuboid_grid(&[1, 1])).struct2lar().unwrap();
    /// let complex = ChainComplex::from_model(&two).unwrap();
    /// assert_eq!(complex.strong_components(2), (vec![0, 1], 2));
    /// ```
    #[must_use]
    pub fn strong_components(&self, p: usize) -> (Vec<u32>, usize) {
        let mut sets = DisjointSets::new(self.n_cells(p));
        let groups = match p {
            _ if p > self.dim() || self.dim() == 0 => Cells::new(),
            0 => lists(self.boundary(1)),
            _ => transpose(&lists(self.boundary(p)), self.n_cells(p - 1)),
        };
        for pair in groups.iter().flat_map(|group| group.windows(2)) {
            sets.join(pair[0] as usize, pair[1] as usize);
        }
        sets.labels()
    }
}

/// Disjoint sets of 0..n, joined pairwise (union by index, path halving).
pub(crate) struct DisjointSets {
    parents: Vec<usize>,
}

impl DisjointSets {
    pub(crate) fn new(n: usize) -> Self {
        Self { parents: (0..n).collect() }
    }

    pub(crate) fn find(&mut self, mut i: usize) -> usize {
        while self.parents[i] != i {
            self.parents[i] = self.parents[self.parents[i]];
            i = self.parents[i];
        }
        i
    }

    /// The smaller root stays the root, so that the root of a set is its smallest element.
    pub(crate) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.parents[a.max(b)] = a.min(b);
    }

    /// The set of each element, numbered in the order of their smallest elements, and how many there are.
    pub(crate) fn labels(mut self) -> (Vec<u32>, usize) {
        let mut labels = vec![0_u32; self.parents.len()];
        let mut n = 0;
        for i in 0..labels.len() {
            let root = self.find(i);
            if root == i {
                labels[i] = n;
                n += 1;
            } else {
                labels[i] = labels[root];
            }
        }
        (labels, n as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Points, Struct, cuboid_grid, t};

    #[test]
    fn components_are_numbered_by_first_vertex() {
        let square = cuboid_grid(&[1, 1]);
        let two = Struct::new("s").with(square.clone()).with(t(&[2., 0.])).with(square).struct2lar().unwrap();
        let found = ChainComplex::from_model(&two).unwrap().connected_components();
        assert_eq!((found.n, found.of_vertex), (2, vec![0, 0, 0, 0, 1, 1, 1, 1]));
        let dust = ChainComplex::new(Points::from_columns(1, vec![1., 2., 3.]), Vec::new());
        assert_eq!(dust.connected_components().of_vertex, [0, 1, 2]);
        assert_eq!(dust.euler_characteristic(), 3);
        assert_eq!((dust.cell_components().n, dust.strong_components(0).1), (3, 3));
    }

    #[test]
    fn components_of_cells() {
        let square = cuboid_grid(&[1, 1]);
        let scene = Struct::new("s").with(square.clone()).with(t(&[1., 1.])).with(square.clone());
        let two =
            ChainComplex::from_model(&scene.with(t(&[5., 0.])).with(square).struct2lar().unwrap()).unwrap();
        let found = two.cell_components();
        assert_eq!(found.of_cell[0], two.connected_components().of_vertex);
        assert_eq!((found.n, found.of_cell[2].len()), (two.connected_components().n, 3));
        assert_eq!(two.strong_components(0).0, two.connected_components().of_vertex);
        assert_eq!(two.strong_components(2), (vec![0, 1, 2], 3));
        assert_eq!(two.strong_components(1).1, two.connected_components().n);
        assert_eq!(two.strong_components(3), (vec![], 0));
        let closed = ChainComplex::new(two.points().clone(), vec![two.boundary(1).map(|_| 0)]);
        assert_eq!(closed.cell_components().n, two.n_cells(0) + two.n_cells(1));
    }
}
