//! Stage 3: the fragments of all facets → one skeleton with shared vertices and edges (the *congruence* of the
//! 2-dimensional arrangements).
//!
//! Holds afterwards: vertices are pairwise distinct points, edges pairwise distinct, ∂1∂2 = 0.

mod faces;
mod numbering;

use crate::counting::offsets;
use crate::fragment::{FacetParent, Fragments, Groups, WHOLE};
use crate::kernel::{Along, Direction, Geometry, Vertex, VertexDef, Way};
use crate::loops::LoopsOfFaces;
use crate::marks::Marks;
use crate::parallel;
use crate::soup::Soup;
use crate::split::Cuts;
use crate::vertices::Vertices;
use faces::Faces;
use lar_core::Cells;
use numbering::Numbering;
use std::mem::take;
use std::ops::Range;

/// Vertices, edges and faces of the arrangement; no 3-cells yet.
#[derive(Debug, Default)]
pub(crate) struct Skeleton {
    pub vertices: Vec<Vertex>,
    /// Ends of each edge, the smaller first.
    pub edges: Vec<[u32; 2]>,
    /// The edges that are pieces, not whole edges of the input.
    pieces: Marks,
    /// Their directions, from the smaller end to the larger.
    directions: Vec<Way>,
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
        mut vertices: Vertices,
        soup: &Soup,
        cuts: &Cuts,
    ) -> Self {
        unify(&mut fragments, &mut vertices, soup);
        let parts = Parts::new(&fragments, groups, soup);
        let n_vertices = vertices.list.len();
        let ((vertices, compact), mut numbering) = parallel::join(
            || used_vertices(&parts, vertices.list),
            || Numbering::new(&parts, cuts, n_vertices),
        );
        let edges = match compact {
            None => numbering.edges(|v| v),
            Some(compact) => numbering.edges(|v| compact[v as usize]),
        };
        let soft = numbering.soft(edges.len());
        let Faces { loops, parents, parent_offsets, of_groups } = Faces::new(&parts, &numbering);
        let LoopsOfFaces { loops, face_loops } = loops;
        let faces_of_facets = FacesOfFacets::new(groups, &of_groups);
        let Numbering { pieces, directions, .. } = numbering;
        let pieces = Marks::among(edges.len(), &pieces);
        Self {
            vertices,
            edges,
            pieces,
            directions,
            soft,
            loops,
            face_loops,
            parents,
            parent_offsets,
            faces_of_facets,
        }
    }

    /// Lets go of what only stages 4 and 5 need, once the loops are those of the arrangement.
    pub(crate) fn drop_edges(&mut self) {
        self.pieces = Marks::default();
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

    /// Direction of an edge from its smaller end to its larger. O(1).
    pub(crate) fn direction(&self, edge: u32, geometry: &Geometry) -> Direction {
        if let Some(at) = self.pieces.place(edge) {
            return geometry.towards(self.directions[at]);
        }
        let ends = self.edges[edge as usize].map(|v| match self.vertices[v as usize].def {
            VertexDef::Point(p) => p,
            _ => unreachable!("edges of the input have points of the input as ends"),
        });
        geometry.direction(Along::Edge(ends))
    }

    /// First and last vertex of a half-edge.
    pub(crate) fn ends(&self, half_edge: u32) -> [u32; 2] {
        let [a, b] = self.edges[(half_edge / 2) as usize];
        if half_edge.is_multiple_of(2) { [a, b] } else { [b, a] }
    }
}

/// Gives the new vertices of all parts their numbers.
fn unify(fragments: &mut [Fragments], vertices: &mut Vertices, soup: &Soup) {
    let n_base = vertices.list.len() as u32;
    let found = fragments.iter_mut().map(|part| take(&mut part.vertices)).collect();
    let (begins, numbers) = vertices.unify_chunks(found, &soup.geometry);
    let parts = begins.into_iter().zip(fragments.iter_mut()).collect();
    parallel::each(parts, |(begin, part): (u32, &mut Fragments)| {
        for v in part.pieces.iter_mut().flat_map(|piece| &mut piece.ends).filter(|v| **v >= n_base) {
            *v = numbers[(begin + (*v - n_base)) as usize];
        }
    });
}

/// All that the skeleton is made of.
struct Parts<'a> {
    fragments: &'a [Fragments],
    /// The number of the first piece of each part among those of all parts.
    first_pieces: Vec<u32>,
    groups: &'a Groups,
    soup: &'a Soup,
}

impl<'a> Parts<'a> {
    fn new(fragments: &'a [Fragments], groups: &'a Groups, soup: &'a Soup) -> Self {
        let first_pieces = offsets(fragments.iter().map(|part| part.pieces.len() as u32));
        Self { fragments, first_pieces, groups, soup }
    }

    /// The groups of a part in their order.
    fn groups_of(&self, part: usize) -> impl Iterator<Item = Group<'a>> + use<'a> {
        let (first_piece, part) = (self.first_pieces[part], &self.fragments[part]);
        (0..part.group_ends.len()).map(move |group| Group { part, group, first_piece })
    }

    /// All groups in their order.
    fn each_group(&self) -> impl Iterator<Item = Group<'a>> {
        (0..self.fragments.len()).flat_map(|part| self.groups_of(part))
    }

    fn sum(&self, of: impl Fn(&Fragments) -> usize) -> usize {
        self.fragments.iter().map(of).sum()
    }
}

/// The faces of a group.
struct Group<'a> {
    part: &'a Fragments,
    /// Which of its part.
    group: usize,
    /// The number of the first piece of its part among those of all parts.
    first_piece: u32,
}

impl Group<'_> {
    fn faces(&self) -> Range<usize> {
        range_before(&self.part.group_ends, self.group)
    }

    fn loops(&self, face: usize) -> Range<usize> {
        range_before(&self.part.face_ends, face)
    }

    fn parents(&self, face: usize) -> &[FacetParent] {
        &self.part.parents[range_before(&self.part.parent_ends, face)]
    }

    /// The half-edges of a loop, as its part has them.
    fn half_edges(&self, cycle: usize) -> &[u32] {
        &self.part.half_edges[range_before(&self.part.loop_ends, cycle)]
    }

    /// Those of all loops.
    fn all_half_edges(&self) -> &[u32] {
        let Range { start, end } = self.faces();
        let of_faces = [start, end].map(|face| end_before(&self.part.face_ends, face));
        let [start, end] = of_faces.map(|cycle| end_before(&self.part.loop_ends, cycle));
        &self.part.half_edges[start..end]
    }
}

fn range_before(ends: &[u32], i: usize) -> Range<usize> {
    end_before(ends, i)..ends[i] as usize
}

fn end_before(ends: &[u32], i: usize) -> usize {
    if i == 0 { 0 } else { ends[i - 1] as usize }
}

/// The vertices that edges end at, in their order, and the new number of each (only those of used ones count); none when all
/// are used.
fn used_vertices(parts: &Parts<'_>, mut vertices: Vec<Vertex>) -> (Vec<Vertex>, Option<Vec<u32>>) {
    let used = parallel::map(parallel::n_threads(), |part| used_in(parts, part, vertices.len()));
    let is_used = |v: usize| used.iter().any(|used| used[v]);
    if parallel::all(vertices.len(), is_used) {
        return (vertices, None);
    }
    let mut n = 0;
    let number = |v: usize| {
        n += u32::from(is_used(v));
        n - u32::from(is_used(v))
    };
    let compact = (0..vertices.len()).map(number).collect();
    let mut all = 0..vertices.len();
    vertices.retain(|_| all.next().is_some_and(is_used));
    (vertices, Some(compact))
}

/// Whether each of n vertices is one of a part of the facets or of their groups.
fn used_in(parts: &Parts<'_>, part: usize, n: usize) -> Vec<bool> {
    let (soup, is_member) = (parts.soup, &parts.groups.is_member);
    let mut used = vec![false; n];
    for f in parallel::part_of(soup.n_facets(), part).filter(|&f| !is_member[f]) {
        match &soup.facet_edges[f] {
            [_, _, _] => soup.geometry.base(f as u32).iter().for_each(|&p| used[p as usize] = true),
            edges => edges.iter().for_each(|&code| used[soup.directed(code)[0] as usize] = true),
        }
    }
    for part in &parts.fragments[parallel::part_of(parts.fragments.len(), part)] {
        part.pieces.iter().flat_map(|piece| &piece.ends).for_each(|&v| used[v as usize] = true);
        for &h in part.half_edges.iter().filter(|h| *h & WHOLE != 0) {
            used[soup.directed(h ^ WHOLE)[0] as usize] = true;
        }
    }
    used
}
