//! Stage 3: the fragments of all facets → one skeleton with shared vertices and edges (the *congruence* of the
//! 2-dimensional arrangements).
//!
//! Holds afterwards: vertices are pairwise distinct points, edges pairwise distinct, ∂1∂2 = 0.

use crate::fragment::{FacetParent, Fragments, Piece, WHOLE};
use crate::interner::Interner;
use crate::kernel::{Along, Direction, Vertex};
use crate::soup::Soup;
use crate::split::Cuts;
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
    pub(crate) fn new(
        mut fragments: Vec<Fragments>,
        mut interner: Interner,
        soup: &Soup,
        cuts: &Cuts,
    ) -> Self {
        let n_base = interner.vertices.len() as u32;
        for part in &mut fragments {
            let ids: Vec<u32> = part.vertices.drain(..).map(|v| interner.intern(v, &soup.geometry)).collect();
            for piece in &mut part.pieces {
                piece.ends = piece.ends.map(|v| if v < n_base { v } else { ids[(v - n_base) as usize] });
            }
        }
        let (vertices, compact) = used_vertices(&fragments, &interner, soup);
        let n_half_edges = fragments.iter().map(|part| part.half_edges.len()).sum();
        let n_loops = fragments.iter().map(|part| part.loop_ends.len()).sum();
        let out = Self {
            vertices,
            loops: Cells::with_capacity(n_loops, n_half_edges),
            face_loops: vec![0],
            parent_offsets: vec![0],
            ..Self::default()
        };
        let whole = vec![NOT_SEEN; soup.edges.len()];
        let n_points = soup.geometry.n_points() as u32;
        let pieces = fragments.iter().flat_map(|part| &part.pieces).map(|piece| piece.ends);
        let between_points = pieces.filter(|ends| ends.iter().all(|&v| v < n_points));
        let input_edges = soup.edges_between(between_points.map(|[a, b]| [a.min(b), a.max(b)]));
        let ids = FxHashMap::default();
        let mut builder = Builder { out, soup, cuts, compact, whole, input_edges, ids };
        fragments.iter().for_each(|part| builder.push(part));
        builder.out
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

const NOT_SEEN: u32 = u32::MAX;

struct Builder<'a> {
    out: Skeleton,
    soup: &'a Soup,
    cuts: &'a Cuts,
    /// New number of each vertex.
    compact: Vec<u32>,
    /// Edge that each input edge without inner points became.
    whole: Vec<u32>,
    /// Input edges that pieces may be, by their ends.
    input_edges: FxHashMap<[u32; 2], u32>,
    /// Edges that are pieces, by their ends.
    ids: FxHashMap<[u32; 2], u32>,
}

impl Builder<'_> {
    fn push(&mut self, part: &Fragments) {
        let mut of_piece = vec![NOT_SEEN; part.pieces.len()];
        let (loop_base, parent_base) = (self.out.loops.len() as u32, self.out.parents.len() as u32);
        let mut one_loop = Vec::new();
        let mut begin = 0;
        for &end in &part.loop_ends {
            one_loop.clear();
            for &h in &part.half_edges[begin..end as usize] {
                one_loop.push(if h & WHOLE != 0 {
                    2 * self.whole_edge((h ^ WHOLE) / 2) + h % 2
                } else {
                    let at = (h / 2) as usize;
                    if of_piece[at] == NOT_SEEN {
                        of_piece[at] = self.half_edge(&part.pieces[at]);
                    }
                    of_piece[at] ^ (h % 2)
                });
            }
            self.out.loops.push(&one_loop);
            begin = end as usize;
        }
        self.out.face_loops.extend(part.face_ends.iter().map(|&end| loop_base + end));
        self.out.parents.extend_from_slice(&part.parents);
        self.out.parent_offsets.extend(part.parent_ends.iter().map(|&end| parent_base + end));
    }

    /// The edge that an input edge without inner points is. Its ends ascend, and so do their new numbers.
    fn whole_edge(&mut self, edge: u32) -> u32 {
        let known = self.whole[edge as usize];
        if known != NOT_SEEN {
            return known;
        }
        let ends = self.soup.edges[edge as usize];
        let direction = self.soup.geometry.direction(Along::Edge(ends));
        let id = self.push_edge(ends.map(|v| self.compact[v as usize]), direction, self.soup.is_soft(edge));
        self.whole[edge as usize] = id;
        id
    }

    /// The half-edge of a piece in its direction. A piece with the ends of an unsplit input edge is that edge.
    fn half_edge(&mut self, piece: &Piece) -> u32 {
        let [a, b] = piece.ends;
        let ends = [a.min(b), a.max(b)];
        let input = self.input_edges.get(&ends).copied().filter(|&e| self.cuts.inner[e as usize].is_empty());
        let id = match (input, self.ids.get(&ends)) {
            (Some(edge), _) => self.whole_edge(edge),
            (None, Some(&id)) => id,
            (None, None) => {
                let direction = if a < b { piece.direction } else { piece.direction.opposite() };
                let id = self.push_edge(ends.map(|v| self.compact[v as usize]), direction, true);
                self.ids.insert(ends, id);
                id
            }
        };
        self.out.soft[id as usize] &= piece.soft;
        2 * id + u32::from(a > b)
    }

    fn push_edge(&mut self, ends: [u32; 2], direction: Direction, soft: bool) -> u32 {
        self.out.edges.push(ends);
        self.out.directions.push(direction);
        self.out.soft.push(soft);
        self.out.edges.len() as u32 - 1
    }
}

/// The vertices that edges end at, in their order, and the new number of each (only those of used ones count).
fn used_vertices(fragments: &[Fragments], interner: &Interner, soup: &Soup) -> (Vec<Vertex>, Vec<u32>) {
    let mut used = vec![false; interner.vertices.len()];
    for part in fragments {
        part.pieces.iter().for_each(|piece| piece.ends.iter().for_each(|&v| used[v as usize] = true));
        for &h in part.half_edges.iter().filter(|h| *h & WHOLE != 0) {
            used[soup.directed(h ^ WHOLE)[0] as usize] = true;
        }
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
