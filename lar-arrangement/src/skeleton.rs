//! Stage 3: the fragments of all facets → one skeleton with shared vertices and edges (the *congruence* of the
//! 2-dimensional arrangements).
//!
//! Holds afterwards: vertices are pairwise distinct points, edges pairwise distinct, ∂1∂2 = 0.

use crate::fragment::{FacetParent, Fragments};
use crate::interner::Interner;
use crate::kernel::{Direction, Geometry, Vertex};
use lar_core::Cells;
use rustc_hash::FxHashMap;

/// Vertices, edges and faces of the arrangement; no 3-cells yet.
#[derive(Debug, Default)]
pub(crate) struct Skeleton {
    pub vertices: Vec<Vertex>,
    /// Ends of each edge, the smaller first.
    pub edges: Vec<[u32; 2]>,
    /// Direction of each edge from the smaller end to the larger.
    pub directions: Vec<Direction>,
    /// Whether an edge is only a diagonal inside a polygon.
    pub soft: Vec<bool>,
    /// Half-edges (2 · edge, + 1 against its direction) of each loop, the face on their left.
    pub loops: Cells,
    /// The loops of face f are `face_loops[f]..face_loops[f + 1]`, the outer one first.
    pub face_loops: Vec<u32>,
    pub parents: Vec<FacetParent>,
    /// The parents of face f are `parent_offsets[f]..parent_offsets[f + 1]`.
    pub parent_offsets: Vec<u32>,
}

impl Skeleton {
    /// Unifies what the facets found independently. O(n) expected.
    pub(crate) fn new(mut fragments: Vec<Fragments>, mut interner: Interner, geometry: &Geometry) -> Self {
        let n_base = interner.vertices.len() as u32;
        for part in &mut fragments {
            let ids: Vec<u32> = part.vertices.drain(..).map(|v| interner.intern(v, geometry)).collect();
            for piece in &mut part.pieces {
                piece.ends = piece.ends.map(|v| if v < n_base { v } else { ids[(v - n_base) as usize] });
            }
        }
        let (vertices, compact) = used_vertices(&fragments, &interner);
        let mut out = Self { vertices, face_loops: vec![0], parent_offsets: vec![0], ..Self::default() };
        let mut edge_ids: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        let mut one_loop = Vec::new();
        for part in &fragments {
            let half_edges = out.push_edges(part, &compact, &mut edge_ids);
            let (loop_base, parent_base) = (out.loops.len() as u32, out.parents.len() as u32);
            let mut begin = 0;
            for &end in &part.loop_ends {
                one_loop.clear();
                one_loop.extend(part.half_edges[begin..end as usize].iter().map(|&h| half_edges[h as usize]));
                out.loops.push(&one_loop);
                begin = end as usize;
            }
            out.face_loops.extend(part.face_ends.iter().map(|&end| loop_base + end));
            out.parents.extend_from_slice(&part.parents);
            out.parent_offsets.extend(part.parent_ends.iter().map(|&end| parent_base + end));
        }
        out
    }

    /// Adds the edges of a part; returns the half-edge that each of the part's half-edges becomes.
    fn push_edges(
        &mut self,
        part: &Fragments,
        compact: &[u32],
        ids: &mut FxHashMap<[u32; 2], u32>,
    ) -> Vec<u32> {
        let mut half_edges = Vec::with_capacity(2 * part.pieces.len());
        for piece in &part.pieces {
            let [a, b] = piece.ends.map(|v| compact[v as usize]);
            let ends = [a.min(b), a.max(b)];
            let id = *ids.entry(ends).or_insert_with(|| {
                self.edges.push(ends);
                self.directions.push(if a < b { piece.direction } else { piece.direction.opposite() });
                self.soft.push(true);
                self.edges.len() as u32 - 1
            });
            self.soft[id as usize] &= piece.soft;
            let h = 2 * id + u32::from(a > b);
            half_edges.extend([h, h ^ 1]);
        }
        half_edges
    }

    pub(crate) fn n_faces(&self) -> usize {
        self.face_loops.len() - 1
    }

    /// The half-edges of all loops of a face.
    pub(crate) fn half_edges(&self, face: u32) -> impl Iterator<Item = u32> + '_ {
        let range = self.face_loops[face as usize]..self.face_loops[face as usize + 1];
        range.flat_map(|l| self.loops[l as usize].iter().copied())
    }

    pub(crate) fn face_parents(&self, face: u32) -> &[FacetParent] {
        &self.parents
            [self.parent_offsets[face as usize] as usize..self.parent_offsets[face as usize + 1] as usize]
    }

    /// The facet whose plane and orientation a face has.
    pub(crate) fn facet(&self, face: u32) -> u32 {
        self.parents[self.parent_offsets[face as usize] as usize].facet
    }

    /// First and last vertex of a half-edge.
    pub(crate) fn ends(&self, half_edge: u32) -> [u32; 2] {
        let [a, b] = self.edges[(half_edge / 2) as usize];
        if half_edge.is_multiple_of(2) { [a, b] } else { [b, a] }
    }
}

/// The vertices that edges end at, in their order, and the new number of each (only those of used ones count).
fn used_vertices(fragments: &[Fragments], interner: &Interner) -> (Vec<Vertex>, Vec<u32>) {
    let mut used = vec![false; interner.vertices.len()];
    for piece in fragments.iter().flat_map(|part| &part.pieces) {
        piece.ends.iter().for_each(|&v| used[v as usize] = true);
    }
    let mut vertices = Vec::new();
    let compact = used
        .iter()
        .zip(&interner.vertices)
        .map(|(&used, vertex)| {
            let id = vertices.len() as u32;
            if used {
                vertices.push(*vertex);
            }
            id
        })
        .collect();
    (vertices, compact)
}
