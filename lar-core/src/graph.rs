//! Graphs: neighbours, depth-first search, biconnected components.
//!
//! All searches are iterative, so their depth is bounded by memory and not by the stack, and visit vertices and
//! edges in rising order, so their results do not depend on anything but the input.

mod biconnected;

use crate::relations::transpose;
use crate::{Cells, ChainComplex};
pub use biconnected::Biconnected;

/// An undirected graph of n vertices: its edges, and at each vertex the edges that end there. Parallel edges
/// and loops are allowed.
///
/// ```
/// use lar_core::Graph;
/// let path = Graph::new(4, &[[0, 1], [1, 2]]).unwrap();
/// assert_eq!(path.neighbours(1), [0, 2]);
/// assert!(path.neighbours(3).is_empty());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graph {
    edges: Vec<[u32; 2]>,
    /// The edges at each vertex, rising; a loop is there once.
    at: Cells,
}

/// Why edges make no graph.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GraphError {
    /// An edge names a vertex that does not exist.
    #[error("edge {edge} names vertex {vertex}, but there are {n_vertices} vertices")]
    VertexOutOfRange {
        /// Index of the edge.
        edge: usize,
        /// The vertex.
        vertex: u32,
        /// The number of vertices.
        n_vertices: usize,
    },
    /// There are 2^31 edges or more.
    #[error("{edges} edges; graphs have fewer than 2147483648")]
    TooManyEdges {
        /// The number of edges.
        edges: usize,
    },
}

/// A depth-first search of a whole graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DepthFirst {
    /// The vertices in the order in which they were found.
    pub order: Vec<u32>,
    /// The edge through which each vertex was found; none for the root of each tree.
    pub parent_edge: Vec<Option<u32>>,
    /// The edges of the spanning forest in the order in which they were followed.
    pub tree: Vec<u32>,
    /// The other edges ("fronds"), in the order in which they were met; each joins a vertex to itself or to
    /// one of its ancestors.
    pub fronds: Vec<u32>,
}

impl Graph {
    /// A graph of `n_vertices` vertices. O(n).
    ///
    /// # Errors
    /// When an edge names a vertex that does not exist, or there are 2^31 edges or more.
    ///
    /// ```
    /// let message = lar_core::Graph::new(2, &[[0, 1], [1, 2]]).unwrap_err().to_string();
    /// assert_eq!(message, "edge 1 names vertex 2, but there are 2 vertices");
    /// ```
    pub fn new(n_vertices: usize, edges: &[[u32; 2]]) -> Result<Self, GraphError> {
        if edges.len() >= 1 << 31 {
            return Err(GraphError::TooManyEdges { edges: edges.len() });
        }
        for (edge, ends) in edges.iter().enumerate() {
            if let Some(&vertex) = ends.iter().find(|&&v| v as usize >= n_vertices) {
                return Err(GraphError::VertexOutOfRange { edge, vertex, n_vertices });
            }
        }
        let ends: Cells = edges.iter().map(|[a, b]| if a == b { vec![*a] } else { vec![*a, *b] }).collect();
        Ok(Self { edges: edges.to_vec(), at: transpose(&ends, n_vertices) })
    }

    /// The vertices and edges of a complex; edge e of the graph is edge e of the complex. O(n).
    ///
    /// # Errors
    /// When ∂1 has more rows than there are points. Edges without two ends become loops at vertex 0, or are an
    /// error where there is none.
    pub fn of_complex(complex: &ChainComplex) -> Result<Self, GraphError> {
        let n_edges = complex.n_cells(1);
        let edges: Vec<[u32; 2]> = (0..n_edges).map(|e| complex.edge_ends(e).unwrap_or_default()).collect();
        Self::new(complex.n_cells(0), &edges)
    }

    /// Number of vertices.
    #[must_use]
    pub fn n_vertices(&self) -> usize {
        self.at.len()
    }

    /// The edges.
    #[must_use]
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// The edges at vertex `v`, rising; a loop is listed once.
    ///
    /// # Panics
    /// When `v` is not below `n_vertices()`.
    #[must_use]
    pub fn edges_at(&self, v: u32) -> &[u32] {
        &self.at[v as usize]
    }

    /// The vertices joined to `v` by an edge, rising, each once. O(k log k) for k edges.
    ///
    /// # Panics
    /// When `v` is not below `n_vertices()`.
    #[must_use]
    pub fn neighbours(&self, v: u32) -> Vec<u32> {
        let mut all: Vec<u32> = self.edges_at(v).iter().map(|&e| self.across(e, v)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The neighbours of every vertex. O(n log n).
    ///
    /// ```
    /// use lar_core::{ChainComplex, Graph, cuboid_grid};
    /// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap();
    /// let all = Graph::of_complex(&square).unwrap().all_neighbours();
    /// assert_eq!(&all[0], [1, 2]);
    /// assert_eq!(all, square.relation(0, 0));
    /// ```
    #[doc(alias = "verts2verts")]
    #[must_use]
    pub fn all_neighbours(&self) -> Cells {
        (0..).take(self.n_vertices()).map(|v| self.neighbours(v)).collect()
    }

    /// Searches the graph depth-first from vertex 0, then from the smallest vertex not yet found, and so on; at
    /// each vertex edges are tried in rising order. O(n).
    ///
    /// ```
    /// use lar_core::Graph;
    /// let square = Graph::new(4, &[[0, 1], [0, 2], [1, 3], [2, 3]]).unwrap();
    /// let found = square.depth_first_search();
    /// assert_eq!(found.order, [0, 1, 3, 2]);
    /// assert_eq!((found.tree, found.fronds), (vec![0, 2, 3], vec![1]));
    /// ```
    #[doc(alias = "DFV_visit")]
    #[must_use]
    pub fn depth_first_search(&self) -> DepthFirst {
        let n = self.n_vertices();
        let mut found = DepthFirst {
            order: Vec::with_capacity(n),
            parent_edge: vec![None; n],
            tree: Vec::new(),
            fronds: Vec::new(),
        };
        self.search(|event| match event {
            Event::Found { vertex, edge } => {
                found.order.push(vertex);
                found.parent_edge[vertex as usize] = edge;
                found.tree.extend(edge);
            }
            Event::Frond { edge, .. } => found.fronds.push(edge),
            Event::Left { .. } => (),
        });
        found
    }

    /// Runs the search and reports what happens.
    fn search(&self, mut report: impl FnMut(Event)) {
        let mut next: Vec<u32> = vec![0; self.n_vertices()];
        let mut seen = vec![false; self.n_vertices()];
        let mut used = vec![false; self.edges.len()];
        let mut path: Vec<(u32, Option<u32>)> = Vec::new();
        for root in (0..).take(self.n_vertices()) {
            if seen[root as usize] {
                continue;
            }
            seen[root as usize] = true;
            report(Event::Found { vertex: root, edge: None });
            path.push((root, None));
            while let Some(&(vertex, parent)) = path.last() {
                let Some(&edge) = self.edges_at(vertex).get(next[vertex as usize] as usize) else {
                    path.pop();
                    if let (Some(edge), Some(&(above, _))) = (parent, path.last()) {
                        report(Event::Left { vertex, edge, above });
                    }
                    continue;
                };
                next[vertex as usize] += 1;
                if std::mem::replace(&mut used[edge as usize], true) {
                    continue;
                }
                let other = self.across(edge, vertex);
                if std::mem::replace(&mut seen[other as usize], true) {
                    report(Event::Frond { edge, from: vertex, to: other });
                } else {
                    report(Event::Found { vertex: other, edge: Some(edge) });
                    path.push((other, Some(edge)));
                }
            }
        }
    }

    /// The other end of an edge of `v`.
    fn across(&self, edge: u32, v: u32) -> u32 {
        let [a, b] = self.edges[edge as usize];
        if a == v { b } else { a }
    }
}

/// What happens during a search.
enum Event {
    /// A vertex is found, through an edge unless it is a root.
    Found { vertex: u32, edge: Option<u32> },
    /// An edge leads from a vertex to itself or to an ancestor.
    Frond { edge: u32, from: u32, to: u32 },
    /// All edges of a vertex are done; the search goes back through the edge to the vertex above.
    Left { vertex: u32, edge: u32, above: u32 },
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cuboid_grid;

    #[track_caller]
    fn check(n: usize, edges: &[[u32; 2]], order: &[u32], tree: &[u32], fronds: &[u32]) {
        let found = Graph::new(n, edges).unwrap().depth_first_search();
        assert_eq!((&found.order[..], &found.tree[..], &found.fronds[..]), (order, tree, fronds));
        let through: Vec<u32> = found.order.iter().filter_map(|&v| found.parent_edge[v as usize]).collect();
        assert_eq!(through, tree);
    }

    #[test]
    fn searches() {
        check(0, &[], &[], &[], &[]);
        check(3, &[], &[0, 1, 2], &[], &[]);
        check(3, &[[2, 1], [1, 2], [2, 2]], &[0, 1, 2], &[0], &[1, 2]);
        check(4, &[[0, 3], [3, 1], [1, 0], [1, 2]], &[0, 3, 1, 2], &[0, 1, 3], &[2]);
        check(5, &[[4, 0], [3, 4], [1, 2]], &[0, 4, 3, 1, 2], &[0, 1, 2], &[]);
    }

    #[test]
    fn grids() {
        let complex = ChainComplex::from_model(&cuboid_grid(&[3, 2, 1])).unwrap();
        let graph = Graph::of_complex(&complex).unwrap();
        assert_eq!(graph.all_neighbours(), complex.relation(0, 0));
        assert_eq!(graph.edges().len(), 46);
        assert_eq!(graph.depth_first_search().tree.len(), 23);
    }

    #[test]
    fn edges_without_ends_are_loops() {
        let zeros = crate::Operator::zero((2, 1)).to_csc();
        let points = crate::Points::from_columns(1, vec![0., 1.]);
        let graph = Graph::of_complex(&ChainComplex::new(points, vec![zeros])).unwrap();
        assert_eq!(graph.neighbours(0), [0]);
    }
}
