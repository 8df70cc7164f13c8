//! Stage 3: the fragments of all facets → one skeleton with shared vertices and edges (the *congruence* of the
//! 2-dimensional arrangements).
//!
//! Holds afterwards: vertices are pairwise distinct points, edges pairwise distinct, ∂1∂2 = 0.

use crate::fragment::{FacetParent, Fragments, Groups, Piece, WHOLE};
use crate::half_edges::{self, HalfEdges};
use crate::interner::Interner;
use crate::kernel::{Along, Direction, Geometry, Vertex, VertexDef};
use crate::parallel;
use crate::soup::Soup;
use crate::split::Cuts;
use lar_core::Cells;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Vertices, edges and faces of the arrangement; no 3-cells yet.
#[derive(Debug, Default)]
pub(crate) struct Skeleton {
    pub vertices: Vec<Vertex>,
    /// Ends of each edge, the smaller first.
    pub edges: Vec<[u32; 2]>,
    /// Directions of the edges that do not end at two input points, from the smaller end to the larger.
    directions: Vec<Direction>,
    /// Which of these each edge has, or `NOT_SEEN`.
    direction_of: Vec<u32>,
    /// Whether an edge is only a diagonal inside a polygon.
    pub soft: Vec<bool>,
    /// Half-edges (2 · edge, + 1 against its direction) of each loop, the face on their left.
    pub loops: Cells,
    /// The loops of face f are `face_loops[f]..face_loops[f + 1]`, the outer one first.
    pub face_loops: Vec<u32>,
    pub parents: Vec<FacetParent>,
    /// The parents of face f are `parent_offsets[f]..parent_offsets[f + 1]`.
    pub parent_offsets: Vec<u32>,
    /// The faces that the group of each facet became.
    pub faces_of_facet: Vec<Range<u32>>,
}

impl Skeleton {
    /// Unifies what the facets found independently; facets that nothing touches are faces as they are. O(n) expected.
    pub(crate) fn new(
        mut fragments: Vec<Fragments>,
        groups: &Groups,
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
        let n_points = soup.geometry.n_points() as u32;
        let ((vertices, compact), input_edges) = parallel::join(
            || used_vertices(&fragments, groups, interner, soup),
            || {
                let pieces = fragments.iter().flat_map(|part| &part.pieces).map(|piece| piece.ends);
                let between_points = pieces.filter(|ends| ends.iter().all(|&v| v < n_points));
                soup.edges_between(between_points.map(|[a, b]| [a.min(b), a.max(b)]))
            },
        );
        let n_cut: usize = fragments.iter().map(|part| part.half_edges.len()).sum();
        let n_loops: usize = fragments.iter().map(|part| part.loop_ends.len()).sum();
        let (n_facets, n_half_edges) = (soup.n_facets(), soup.facet_edges.indices().len());
        let n_pieces: usize = fragments.iter().map(|part| part.pieces.len()).sum();
        let n_faces = n_facets + fragments.iter().map(|part| part.face_ends.len()).sum::<usize>();
        let n_edges = soup.edges.len() + n_pieces / 2;
        let out = Self {
            vertices,
            edges: Vec::with_capacity(n_edges),
            direction_of: Vec::with_capacity(n_edges),
            soft: Vec::with_capacity(n_edges),
            parents: Vec::with_capacity(n_faces),
            loops: Cells::with_capacity(n_loops + n_facets, n_cut + n_half_edges),
            face_loops: with_zero(n_faces),
            parent_offsets: with_zero(n_faces),
            faces_of_facet: vec![0..0; n_facets],
            ..Self::default()
        };
        let whole = vec![NOT_SEEN; soup.edges.len()];
        let ends = |k: usize| fragments.iter().flat_map(|part| &part.pieces).map(move |piece| piece.ends[k]);
        let (tails, heads): (Vec<u32>, Vec<u32>) = (ends(0).collect(), ends(1).collect());
        let pieces = HalfEdges::Listed { tails: &tails, heads: &heads };
        let first_piece = half_edges::first_of_edge(compact.len(), pieces);
        let edge_of_first = vec![NOT_SEEN; first_piece.len()];
        let mut builder = Builder {
            out,
            soup,
            cuts,
            compact,
            whole,
            input_edges,
            first_piece,
            edge_of_first,
            base: 0,
            done: 0,
            one_loop: Vec::new(),
        };
        let mut next = 0;
        for part in &fragments {
            for group in 0..part.group_ends.len() {
                let leader = groups.leaders[next];
                builder.push_untouched(groups, leader);
                let first = builder.out.n_faces() as u32;
                builder.push_group(part, group);
                let faces = first..builder.out.n_faces() as u32;
                let members = groups.members[next].iter();
                members.for_each(|&f| builder.out.faces_of_facet[f as usize] = faces.clone());
                next += 1;
            }
            builder.base += part.pieces.len() as u32;
        }
        builder.push_untouched(groups, n_facets as u32);
        builder.out
    }

    /// Lets go of what only stages 4 and 5 need, once the loops are those of the arrangement.
    pub(crate) fn drop_edges(&mut self) {
        self.directions = Vec::new();
        self.direction_of = Vec::new();
        self.soft = Vec::new();
        self.faces_of_facet = Vec::new();
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

    /// Direction of an edge from its smaller end to its larger.
    pub(crate) fn direction(&self, edge: u32, geometry: &Geometry) -> Direction {
        let ends = self.edges[edge as usize].map(|v| self.vertices[v as usize].def);
        match (self.direction_of[edge as usize], ends) {
            (NOT_SEEN, [VertexDef::Point(p), VertexDef::Point(q)]) => geometry.direction(Along::Edge([p, q])),
            (at, _) => self.directions[at as usize],
        }
    }

    /// First and last vertex of a half-edge.
    pub(crate) fn ends(&self, half_edge: u32) -> [u32; 2] {
        let [a, b] = self.edges[(half_edge / 2) as usize];
        if half_edge.is_multiple_of(2) { [a, b] } else { [b, a] }
    }
}

/// A list that begins with 0, with room for n more.
fn with_zero(n: usize) -> Vec<u32> {
    let mut list = Vec::with_capacity(n + 1);
    list.push(0);
    list
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
    /// Of all pieces of all parts, the first one with the same ends.
    first_piece: Vec<u32>,
    /// The edge that each first piece is.
    edge_of_first: Vec<u32>,
    /// Number of the first piece of the part at hand.
    base: u32,
    /// Facets before this one are done.
    done: u32,
    one_loop: Vec<u32>,
}

impl Builder<'_> {
    /// The facets before `leader` that are in no group, each a face as it is.
    fn push_untouched(&mut self, groups: &Groups, leader: u32) {
        let soup = self.soup;
        for facet in (self.done..leader).filter(|&f| !groups.is_member[f as usize]) {
            let codes = &soup.facet_edges[facet as usize];
            if let &[a, b, c] = codes {
                let whole = [a, b, c].map(|code| 2 * self.whole_edge(code / 2) + code % 2);
                self.out.loops.push(&whole);
            } else {
                self.push_untouched_polygon(codes);
            }
            let face = self.out.n_faces() as u32;
            self.out.faces_of_facet[facet as usize] = face..face + 1;
            self.close_face(&[FacetParent { facet, same_way: true }]);
        }
        self.done = leader;
    }

    fn push_untouched_polygon(&mut self, codes: &[u32]) {
        let mut first = None;
        for &code in codes {
            let [tail, head] = self.soup.directed(code);
            first.get_or_insert(tail);
            let half_edge = 2 * self.whole_edge(code / 2) + code % 2;
            self.one_loop.push(half_edge);
            if first == Some(head) {
                self.close_loop();
                first = None;
            }
        }
    }

    /// The faces of a group.
    fn push_group(&mut self, part: &Fragments, group: usize) {
        let begin = |ends: &[u32], i: usize| if i == 0 { 0 } else { ends[i - 1] as usize };
        for face in begin(&part.group_ends, group)..part.group_ends[group] as usize {
            for l in begin(&part.face_ends, face)..part.face_ends[face] as usize {
                for &h in &part.half_edges[begin(&part.loop_ends, l)..part.loop_ends[l] as usize] {
                    let half_edge = match h & WHOLE {
                        0 => self.half_edge(part, h / 2) ^ (h % 2),
                        _ => 2 * self.whole_edge((h ^ WHOLE) / 2) + h % 2,
                    };
                    self.one_loop.push(half_edge);
                }
                self.close_loop();
            }
            self.close_face(&part.parents[begin(&part.parent_ends, face)..part.parent_ends[face] as usize]);
        }
    }

    fn close_loop(&mut self) {
        self.out.loops.push(&self.one_loop);
        self.one_loop.clear();
    }

    fn close_face(&mut self, parents: &[FacetParent]) {
        self.out.face_loops.push(self.out.loops.len() as u32);
        self.out.parents.extend_from_slice(parents);
        self.out.parent_offsets.push(self.out.parents.len() as u32);
    }

    /// The edge that an input edge without inner points is. Its ends ascend, and so do their new numbers.
    fn whole_edge(&mut self, edge: u32) -> u32 {
        let known = self.whole[edge as usize];
        if known != NOT_SEEN {
            return known;
        }
        let ends = self.soup.edges[edge as usize];
        let id = self.push_edge(ends.map(|v| self.compact[v as usize]), self.soup.is_soft(edge));
        self.whole[edge as usize] = id;
        id
    }

    /// The half-edge of a piece in its direction. A piece with the ends of an unsplit input edge is that edge.
    fn half_edge(&mut self, part: &Fragments, piece: u32) -> u32 {
        let first = self.first_piece[(self.base + piece) as usize] as usize;
        let piece = &part.pieces[piece as usize];
        let [a, b] = piece.ends;
        if self.edge_of_first[first] == NOT_SEEN {
            self.edge_of_first[first] = self.edge_of_piece(piece);
        }
        let id = self.edge_of_first[first];
        self.out.soft[id as usize] &= piece.soft;
        2 * id + u32::from(a > b)
    }

    fn edge_of_piece(&mut self, piece: &Piece) -> u32 {
        let [a, b] = piece.ends;
        let ends = [a.min(b), a.max(b)];
        let is_whole = |&edge: &u32| self.cuts.inner[edge as usize].is_empty();
        if let Some(edge) = self.input_edges.get(&ends).copied().filter(is_whole) {
            return self.whole_edge(edge);
        }
        let id = self.push_edge(ends.map(|v| self.compact[v as usize]), true);
        self.out.direction_of[id as usize] = self.out.directions.len() as u32;
        self.out.directions.push(if a < b { piece.direction } else { piece.direction.opposite() });
        id
    }

    fn push_edge(&mut self, ends: [u32; 2], soft: bool) -> u32 {
        self.out.edges.push(ends);
        self.out.direction_of.push(NOT_SEEN);
        self.out.soft.push(soft);
        self.out.edges.len() as u32 - 1
    }
}

/// The vertices that edges end at, in their order, and the new number of each (only those of used ones count).
fn used_vertices(
    fragments: &[Fragments],
    groups: &Groups,
    interner: Interner,
    soup: &Soup,
) -> (Vec<Vertex>, Vec<u32>) {
    let mut used = vec![false; interner.vertices.len()];
    for part in fragments {
        part.pieces.iter().for_each(|piece| piece.ends.iter().for_each(|&v| used[v as usize] = true));
        for &h in part.half_edges.iter().filter(|h| *h & WHOLE != 0) {
            used[soup.directed(h ^ WHOLE)[0] as usize] = true;
        }
    }
    for (edges, facet) in soup.facet_edges.iter().zip(0..).filter(|(_, f)| !groups.is_member[*f as usize]) {
        match edges.len() {
            3 => soup.geometry.base(facet).iter().for_each(|&p| used[p as usize] = true),
            _ => edges.iter().for_each(|&code| used[soup.directed(code)[0] as usize] = true),
        }
    }
    let mut n = 0;
    let number = |&used: &bool| {
        n += u32::from(used);
        n - u32::from(used)
    };
    let compact = used.iter().map(number).collect();
    let mut vertices = interner.vertices;
    if n as usize != vertices.len() {
        let mut is_used = used.iter();
        vertices.retain(|_| is_used.next() == Some(&true));
    }
    (vertices, compact)
}
