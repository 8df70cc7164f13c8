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
    /// The edges that are pieces, not whole edges of the input, ascending.
    pieces: Vec<u32>,
    /// Their directions, from the smaller end to the larger.
    directions: Vec<Direction>,
    /// Whether an edge is only a diagonal inside a polygon; empty when none is.
    soft: Vec<bool>,
    /// Half-edges (2 · edge, + 1 against its direction) of each loop, the face on their left.
    pub loops: Cells,
    /// The loops of face f are `face_loops[f]..face_loops[f + 1]`, the outer one first.
    pub face_loops: Vec<u32>,
    pub parents: Vec<FacetParent>,
    /// The parents of face f are `parent_offsets[f]..parent_offsets[f + 1]`.
    pub parent_offsets: Vec<u32>,
    pub faces_of_facets: FacesOfFacets,
}

/// The faces that the group of each facet became. A facet without a group became one, in its place among the others.
#[derive(Debug, Default)]
pub(crate) struct FacesOfFacets {
    /// The facets in groups, ascending, and the faces of their groups.
    members: Vec<(u32, Range<u32>)>,
    /// Behind so many of them, what is added (modulo 2^32) to the number of a facet for that of its face.
    shifts: Vec<u32>,
}

impl FacesOfFacets {
    /// From the faces of each group.
    fn new(groups: &Groups, faces: &[Range<u32>]) -> Self {
        let of_groups = groups.members.iter().zip(faces);
        let mut members: Vec<(u32, Range<u32>)> =
            of_groups.flat_map(|(facets, faces)| facets.iter().map(|&f| (f, faces.clone()))).collect();
        members.sort_unstable_by_key(|member| member.0);
        let mut shifts = vec![0u32];
        let mut leaders = groups.leaders.iter().zip(faces).peekable();
        let mut shift = 0u32;
        for (facet, _) in &members {
            let led = leaders.next_if(|(leader, _)| *leader == facet);
            shift = shift.wrapping_add(led.map_or(0, |(_, faces)| faces.len() as u32)).wrapping_sub(1);
            shifts.push(shift);
        }
        Self { members, shifts }
    }

    /// The faces of the group of a facet. O(log n).
    pub(crate) fn of(&self, facet: u32) -> Range<u32> {
        match self.members.binary_search_by_key(&facet, |member| member.0) {
            Ok(i) => self.members[i].1.clone(),
            Err(i) => {
                let face = facet.wrapping_add(self.shifts[i]);
                face..face + 1
            }
        }
    }
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
        let parts = Parts { fragments: &fragments, groups, soup };
        let n_vertices = interner.vertices.len();
        let ((vertices, compact), edges) =
            parallel::join(|| used_vertices(&parts, interner), || Edges::new(&parts, cuts, n_vertices));
        let (faces, edges) = parallel::join(|| faces(&parts), || edges.built(&parts, compact));
        let Edges { edges, pieces, directions, soft, loops, .. } = edges;
        Self { vertices, edges, pieces, directions, soft, loops, ..faces }
    }

    /// Lets go of what only stages 4 and 5 need, once the loops are those of the arrangement.
    pub(crate) fn drop_edges(&mut self) {
        self.pieces = Vec::new();
        self.directions = Vec::new();
        self.soft = Vec::new();
        self.faces_of_facets = FacesOfFacets::default();
    }

    pub(crate) fn has_soft_edges(&self) -> bool {
        self.soft.contains(&true)
    }

    /// Whether an edge is only a diagonal inside a polygon.
    pub(crate) fn is_soft(&self, edge: usize) -> bool {
        self.soft.get(edge) == Some(&true)
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

    /// Whether all faces are pieces of one facet.
    pub(crate) fn has_single_parents(&self) -> bool {
        self.parents.len() + 1 == self.parent_offsets.len()
    }

    /// The facet whose plane and orientation a face has.
    pub(crate) fn facet(&self, face: u32) -> u32 {
        self.parents[self.parent_offsets[face as usize] as usize].facet
    }

    /// Direction of an edge from its smaller end to its larger. O(log n).
    pub(crate) fn direction(&self, edge: u32, geometry: &Geometry) -> Direction {
        let ends = self.edges[edge as usize].map(|v| self.vertices[v as usize].def);
        match (self.pieces.binary_search(&edge), ends) {
            (Err(_), [VertexDef::Point(p), VertexDef::Point(q)]) => geometry.direction(Along::Edge([p, q])),
            (Ok(at) | Err(at), _) => self.directions[at],
        }
    }

    /// First and last vertex of a half-edge.
    pub(crate) fn ends(&self, half_edge: u32) -> [u32; 2] {
        let [a, b] = self.edges[(half_edge / 2) as usize];
        if half_edge.is_multiple_of(2) { [a, b] } else { [b, a] }
    }
}

/// All that the skeleton is made of.
struct Parts<'a> {
    fragments: &'a [Fragments],
    groups: &'a Groups,
    soup: &'a Soup,
}

/// What is done with faces one after the other.
trait Take {
    /// A facet that nothing touches.
    fn facet(&mut self, soup: &Soup, facet: u32);
    /// The faces of a group, and the number of the first piece of its part among those of all parts.
    fn group(&mut self, soup: &Soup, part: &Fragments, group: usize, first_piece: u32);
}

impl Parts<'_> {
    /// All faces in their order: groups stand in the places of their first facets.
    fn each(&self, take: &mut impl Take) {
        let (soup, is_member) = (self.soup, &self.groups.is_member);
        let mut leaders = self.groups.leaders.iter();
        let (mut done, mut first_piece) = (0, 0);
        for part in self.fragments {
            for (group, &leader) in (0..part.group_ends.len()).zip(&mut leaders) {
                let before = (done..leader).filter(|&f| !is_member[f as usize]);
                before.for_each(|f| take.facet(soup, f));
                take.group(soup, part, group, first_piece);
                done = leader;
            }
            first_piece += part.pieces.len() as u32;
        }
        (done..soup.n_facets() as u32).filter(|&f| !is_member[f as usize]).for_each(|f| take.facet(soup, f));
    }

    fn sum(&self, of: impl Fn(&Fragments) -> usize) -> usize {
        self.fragments.iter().map(of).sum()
    }
}

/// A list that begins with 0, with room for n more.
fn with_zero(n: usize) -> Vec<u32> {
    let mut list = Vec::with_capacity(n + 1);
    list.push(0);
    list
}

fn range_before(ends: &[u32], i: usize) -> Range<usize> {
    let begin = if i == 0 { 0 } else { ends[i - 1] as usize };
    begin..ends[i] as usize
}

/// The number of loops of all faces, and the facets that they are pieces of.
fn faces(parts: &Parts<'_>) -> Skeleton {
    let n = parts.soup.n_facets() + parts.sum(|part| part.face_ends.len());
    let mut faces = Faces {
        out: Skeleton {
            face_loops: with_zero(n),
            parents: Vec::with_capacity(n),
            parent_offsets: with_zero(n),
            ..Skeleton::default()
        },
        n_loops: 0,
        of_groups: Vec::with_capacity(parts.groups.leaders.len()),
    };
    parts.each(&mut faces);
    faces.out.faces_of_facets = FacesOfFacets::new(parts.groups, &faces.of_groups);
    faces.out
}

struct Faces {
    out: Skeleton,
    n_loops: u32,
    of_groups: Vec<Range<u32>>,
}

impl Faces {
    fn push(&mut self, n_loops: usize, parents: &[FacetParent]) {
        self.n_loops += n_loops as u32;
        self.out.face_loops.push(self.n_loops);
        self.out.parents.extend_from_slice(parents);
        self.out.parent_offsets.push(self.out.parents.len() as u32);
    }
}

impl Take for Faces {
    fn facet(&mut self, soup: &Soup, facet: u32) {
        let codes = &soup.facet_edges[facet as usize];
        let n_loops = if codes.len() == 3 { 1 } else { loops_of(soup, codes).count() };
        self.push(n_loops, &[FacetParent { facet, same_way: true }]);
    }

    fn group(&mut self, _: &Soup, part: &Fragments, group: usize, _: u32) {
        let first = self.out.n_faces() as u32;
        for face in range_before(&part.group_ends, group) {
            let parents = &part.parents[range_before(&part.parent_ends, face)];
            self.push(range_before(&part.face_ends, face).len(), parents);
        }
        self.of_groups.push(first..self.out.n_faces() as u32);
    }
}

/// The loops of a facet.
fn loops_of<'a>(soup: &'a Soup, codes: &'a [u32]) -> impl Iterator<Item = &'a [u32]> {
    let mut rest = codes;
    std::iter::from_fn(move || {
        let first = soup.directed(*rest.first()?)[0];
        let last = rest.iter().position(|&code| soup.directed(code)[1] == first).expect("loops are closed");
        let (codes, after) = rest.split_at(last + 1);
        rest = after;
        Some(codes)
    })
}

const NOT_SEEN: u32 = u32::MAX;

/// Edges and loops.
struct Edges<'a> {
    soup: &'a Soup,
    cuts: &'a Cuts,
    edges: Vec<[u32; 2]>,
    pieces: Vec<u32>,
    directions: Vec<Direction>,
    soft: Vec<bool>,
    /// Whether there may be soft edges.
    any_soft: bool,
    loops: Cells,
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
    one_loop: Vec<u32>,
}

impl<'a> Edges<'a> {
    fn new(parts: &Parts<'a>, cuts: &'a Cuts, n_vertices: usize) -> Self {
        let soup = parts.soup;
        let n_pieces = parts.sum(|part| part.pieces.len());
        let n_edges = soup.edges.len() + n_pieces / 2;
        let n_loops = soup.n_facets() + parts.sum(|part| part.loop_ends.len());
        let n_half_edges = soup.facet_edges.indices().len() + parts.sum(|part| part.half_edges.len());
        let pieces = || parts.fragments.iter().flat_map(|part| &part.pieces);
        let n_points = soup.geometry.n_points() as u32;
        let between_points =
            pieces().map(|piece| piece.ends).filter(|ends| ends.iter().all(|&v| v < n_points));
        let (tails, heads): (Vec<u32>, Vec<u32>) =
            pieces().map(|piece| (piece.ends[0], piece.ends[1])).unzip();
        let half_edges = HalfEdges::Listed { tails: &tails, heads: &heads };
        let first_piece = half_edges::first_of_edge(n_vertices, half_edges);
        Self {
            soup,
            cuts,
            edges: Vec::with_capacity(n_edges),
            pieces: Vec::new(),
            directions: Vec::new(),
            soft: Vec::new(),
            any_soft: soup.has_soft_edges() || pieces().any(|piece| piece.soft),
            loops: Cells::with_capacity(n_loops, n_half_edges),
            compact: Vec::new(),
            whole: vec![NOT_SEEN; soup.edges.len()],
            input_edges: soup.edges_between(between_points.map(|[a, b]| [a.min(b), a.max(b)])),
            edge_of_first: vec![NOT_SEEN; first_piece.len()],
            first_piece,
            one_loop: Vec::new(),
        }
    }

    /// With all faces, vertices getting new numbers.
    fn built(mut self, parts: &Parts<'_>, compact: Vec<u32>) -> Self {
        self.compact = compact;
        parts.each(&mut self);
        self
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

    /// The half-edge that a directed edge of the input is.
    fn whole_half_edge(&mut self, code: u32) -> u32 {
        2 * self.whole_edge(code / 2) + code % 2
    }

    /// The half-edge of a piece, the first of its part being `base`, in its direction. A piece with the ends of an unsplit
    /// input edge is that edge.
    fn half_edge(&mut self, part: &Fragments, piece: u32, base: u32) -> u32 {
        let first = self.first_piece[(base + piece) as usize] as usize;
        let piece = &part.pieces[piece as usize];
        let [a, b] = piece.ends;
        if self.edge_of_first[first] == NOT_SEEN {
            self.edge_of_first[first] = self.edge_of_piece(piece);
        }
        let id = self.edge_of_first[first];
        if self.any_soft {
            self.soft[id as usize] &= piece.soft;
        }
        2 * id + u32::from(a > b)
    }

    fn edge_of_piece(&mut self, piece: &Piece) -> u32 {
        let [a, b] = piece.ends;
        let ends = [a.min(b), a.max(b)];
        let is_whole = |&edge: &u32| self.cuts.inner.of(edge).is_empty();
        if let Some(edge) = self.input_edges.get(&ends).copied().filter(is_whole) {
            return self.whole_edge(edge);
        }
        let id = self.push_edge(ends.map(|v| self.compact[v as usize]), true);
        self.pieces.push(id);
        self.directions.push(if a < b { piece.direction } else { piece.direction.opposite() });
        id
    }

    fn push_edge(&mut self, ends: [u32; 2], soft: bool) -> u32 {
        self.edges.push(ends);
        if self.any_soft {
            self.soft.push(soft);
        }
        self.edges.len() as u32 - 1
    }
}

impl Take for Edges<'_> {
    fn facet(&mut self, soup: &Soup, facet: u32) {
        let codes = &soup.facet_edges[facet as usize];
        if let &[a, b, c] = codes {
            let cycle = [a, b, c].map(|code| self.whole_half_edge(code));
            self.loops.push(&cycle);
            return;
        }
        for codes in loops_of(soup, codes) {
            self.one_loop.clear();
            for &code in codes {
                let half_edge = self.whole_half_edge(code);
                self.one_loop.push(half_edge);
            }
            self.loops.push(&self.one_loop);
        }
    }

    fn group(&mut self, _: &Soup, part: &Fragments, group: usize, first_piece: u32) {
        for l in range_before(&part.group_ends, group).flat_map(|face| range_before(&part.face_ends, face)) {
            self.one_loop.clear();
            for &h in &part.half_edges[range_before(&part.loop_ends, l)] {
                let half_edge = match h & WHOLE {
                    0 => self.half_edge(part, h / 2, first_piece) ^ (h % 2),
                    _ => self.whole_half_edge(h ^ WHOLE),
                };
                self.one_loop.push(half_edge);
            }
            self.loops.push(&self.one_loop);
        }
    }
}

/// The vertices that edges end at, in their order, and the new number of each (only those of used ones count).
fn used_vertices(parts: &Parts<'_>, interner: Interner) -> (Vec<Vertex>, Vec<u32>) {
    let soup = parts.soup;
    let mut used = vec![false; interner.vertices.len()];
    for part in parts.fragments {
        part.pieces.iter().for_each(|piece| piece.ends.iter().for_each(|&v| used[v as usize] = true));
        for &h in part.half_edges.iter().filter(|h| *h & WHOLE != 0) {
            used[soup.directed(h ^ WHOLE)[0] as usize] = true;
        }
    }
    let is_member = &parts.groups.is_member;
    for (edges, facet) in soup.facet_edges.iter().zip(0..).filter(|(_, f)| !is_member[*f as usize]) {
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
