//! The result of a planar arrangement.

use crate::grid::Grid;
use crate::planar::carriers::{Carriers, Member};
use crate::planar::chains::{Chains, Source};
use crate::planar::edges::EdgeAt;
use crate::planar::location::LocationIndex;
use crate::stats::Stats;
use crate::winding::Windings;
use lar_core::{Biconnected, Cells, ChainComplex, EdgeId, FaceId, Graph, VertexId};
use std::sync::OnceLock;

/// The partition of the plane that some segments generate.
///
/// ∂1's columns hold −1 at the smaller vertex and +1 at the larger. Column 0 of ∂2 is the exterior face; a face's
/// column holds the edges of its loops, which keep it on their left (outer loops counter-clockwise, holes
/// clockwise), so every row has one +1 and one −1, or is empty when the edge dangles.
#[derive(Debug)]
pub struct PlanarArrangement {
    pub(super) complex: ChainComplex,
    pub(super) loops: Cells,
    pub(super) face_loops: Vec<u32>,
    pub(super) n_components: usize,
    pub(super) carriers: Carriers,
    pub(super) chains: Chains,
    /// What each vertex is.
    pub(super) sources: Vec<Source>,
    pub(super) grid: Grid,
    pub(super) edge_at: EdgeAt,
    /// The index for point location, built when it is first asked for.
    pub(super) index: OnceLock<LocationIndex>,
    /// Carrier of each edge: edges of one carrier lie on one line.
    pub(super) carrier_of: Vec<u32>,
    pub(super) regions: Vec<String>,
    pub(super) windings: Windings,
    pub(super) isolated: Vec<(VertexId, FaceId)>,
    pub(super) stats: Stats,
}

impl PlanarArrangement {
    /// Vertices and the operators ∂1, ∂2.
    #[must_use]
    pub fn complex(&self) -> &ChainComplex {
        &self.complex
    }

    /// Number of vertices.
    #[must_use]
    pub fn n_vertices(&self) -> usize {
        self.complex.n_cells(0)
    }

    /// Number of edges.
    #[must_use]
    pub fn n_edges(&self) -> usize {
        self.complex.n_cells(1)
    }

    /// Number of bounded faces.
    #[must_use]
    pub fn n_faces(&self) -> usize {
        self.complex.n_cells(2) - 1
    }

    /// Biconnected components of the edges, articulation points and bridges. Without dangling edges every component
    /// is a union of cycles, and there are no bridges. O(n log n).
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, planar_arrangement};
    /// let mut drawing = Drawing::new(lar_core::Points::new(2));
    /// drawing.push_polygon("A", &[vec![[0., 0.], [1., 0.], [1., 1.]]]);
    /// drawing.push_polygon("B", &[vec![[1., 1.], [2., 1.], [2., 2.]]]);
    /// let found = planar_arrangement(&drawing)?.biconnected_components();
    /// assert_eq!((found.components.len(), found.articulation_points.len()), (2, 1));
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    #[doc(alias = "biconnectedComponent")]
    #[must_use]
    pub fn biconnected_components(&self) -> Biconnected {
        let graph = Graph::of_complex(&self.complex).expect("edges have two of the vertices as ends");
        graph.biconnected_components()
    }

    /// Number of connected components of the edges, and of isolated vertices.
    #[must_use]
    pub fn n_components(&self) -> usize {
        self.n_components
    }

    /// Number of loops of the bounded faces.
    #[must_use]
    pub fn n_loops(&self) -> usize {
        self.loops.len() - self.face_loops[1] as usize
    }

    /// The loops of a face as half-edges (2 · edge, + 1 from the larger vertex to the smaller).
    pub(super) fn loops_of(&self, face: FaceId) -> impl ExactSizeIterator<Item = &[u32]> + '_ {
        let range = self.face_loops[face.index()] as usize..self.face_loops[face.index() + 1] as usize;
        range.map(|l| &self.loops[l])
    }

    pub(super) fn half_edges(&self, face: FaceId) -> impl Iterator<Item = u32> + '_ {
        self.loops_of(face).flat_map(|cycle| cycle.iter().copied())
    }

    /// The loops of a face, its outer one first (the exterior face 0 has only holes), as vertices.
    pub fn face_vertices(&self, face: FaceId) -> impl ExactSizeIterator<Item = Vec<u32>> + '_ {
        let ends = self.complex.boundary(1).indices();
        self.loops_of(face).map(|cycle| cycle.iter().map(|&h| ends[h as usize]).collect())
    }

    /// Signed area of a face; that of the exterior is minus the sum of the others. O(edges of the face).
    #[must_use]
    pub fn area(&self, face: FaceId) -> f64 {
        let points = self.complex.points();
        let mut twice = 0.0;
        for cycle in self.face_vertices(face) {
            let o = points.point(cycle[0] as usize);
            for (i, &v) in cycle.iter().enumerate() {
                let (p, q) = (points.point(v as usize), points.point(cycle[(i + 1) % cycle.len()] as usize));
                twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
            }
        }
        twice / 2.0
    }

    /// The edges that an input segment became, in its direction, with the sign of that direction relative to the
    /// edge's; without those that were dropped. Segments without length have none.
    pub fn edges_of(&self, segment: usize) -> impl Iterator<Item = (EdgeId, i8)> + '_ {
        let at = self.carriers.members.binary_search_by_key(&(segment as u32), |m| m.input);
        at.ok().into_iter().flat_map(|i| self.stretch(i))
    }

    fn stretch(&self, member: usize) -> Vec<(EdgeId, i8)> {
        let [from, to] = self.chains.stretches[member];
        let Member { carrier, reversed, .. } = self.carriers.members[member];
        let found = (from..to).filter_map(|place| {
            let edge = self.edge_at.edge(carrier, place)?;
            let ends = &self.chains.chain[place as usize..][..2];
            Some((EdgeId(edge), if ends[0] < ends[1] { 1 } else { -1 }))
        });
        let mut found: Vec<(EdgeId, i8)> = found.collect();
        if reversed {
            found.reverse();
            found.iter_mut().for_each(|(_, sign)| *sign = -*sign);
        }
        found
    }

    /// V − E + F − (1 + components) with the exterior face counted: 0 for every partition of the plane.
    #[must_use]
    pub fn euler(&self) -> i64 {
        self.n_vertices() as i64 - self.n_edges() as i64 + self.n_faces() as i64 - self.n_components as i64
    }

    /// Counts and times of the computation.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        &self.stats
    }
}
