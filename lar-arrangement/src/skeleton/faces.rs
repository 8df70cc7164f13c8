//! The faces of the skeleton and their loops.

use super::numbering::Numbering;
use super::{Group, Parts};
use crate::fragment::FacetParent;
use crate::loops::LoopsOfFaces;
use crate::parallel;
use crate::soup::Soup;
use std::ops::Range;

/// Some faces.
pub(super) struct Faces {
    /// The outer one of each first.
    pub loops: LoopsOfFaces,
    pub parents: Vec<FacetParent>,
    /// The parents of face f are `parent_offsets[f]..parent_offsets[f + 1]`.
    pub parent_offsets: Vec<u32>,
    /// The faces of each group.
    pub of_groups: Vec<Range<u32>>,
}

impl Faces {
    /// All faces in their order: groups stand in the places of their first facets. O(n).
    pub(super) fn new(parts: &Parts<'_>, numbering: &Numbering<'_>) -> Self {
        let soup = parts.soup;
        let groups: Vec<(u32, Group<'_>)> =
            parts.groups.leaders.iter().copied().zip(parts.each_group()).collect();
        let n_faces = parts.sum(|part| part.face_ends.len());
        let n_loops = parts.sum(|part| part.loop_ends.len());
        let of_facets = |part: usize| {
            let range = parallel::part_of(soup.n_facets(), part);
            // The first part gets room for the others.
            let n_facets = if part == 0 { soup.n_facets() } else { range.len() };
            let n_half_edges =
                soup.facet_edges.offsets()[range.start + n_facets] - soup.facet_edges.offsets()[range.start];
            let mut faces = Self::with_room(
                n_facets + n_faces,
                n_facets + n_loops,
                n_half_edges as usize + parts.sum(|part| part.half_edges.len()),
            );
            let mut led = groups[groups.partition_point(|group| (group.0 as usize) < range.start)..].iter();
            let mut next = led.next();
            for facet in range.start as u32..range.end as u32 {
                if !parts.groups.is_member[facet as usize] {
                    faces.push_facet(soup, facet, numbering);
                } else if let Some((_, group)) = next.filter(|group| group.0 == facet) {
                    faces.push_group(group, numbering);
                    next = led.next();
                }
            }
            faces
        };
        let mut all = parallel::map(parallel::n_threads(), of_facets).into_iter();
        let mut faces = all.next().expect("there is a thread");
        all.for_each(|part| faces.append(&part));
        faces
    }

    fn with_room(n_faces: usize, n_loops: usize, n_half_edges: usize) -> Self {
        let mut parent_offsets = Vec::with_capacity(n_faces + 1);
        parent_offsets.push(0);
        Self {
            loops: LoopsOfFaces::with_room(n_faces, n_loops, n_half_edges),
            parents: Vec::with_capacity(n_faces),
            parent_offsets,
            of_groups: Vec::new(),
        }
    }

    /// A face whose loops are there.
    fn close(&mut self, parents: &[FacetParent]) {
        self.loops.close();
        self.parents.extend_from_slice(parents);
        self.parent_offsets.push(self.parents.len() as u32);
    }

    /// A facet that nothing touches.
    fn push_facet(&mut self, soup: &Soup, facet: u32, numbering: &Numbering<'_>) {
        let codes = &soup.facet_edges[facet as usize];
        if let &[a, b, c] = codes {
            self.loops.push(&[a, b, c].map(|code| numbering.whole_half_edge(code)));
        } else {
            for codes in loops_of(soup, codes) {
                let half_edges: Vec<u32> =
                    codes.iter().map(|&code| numbering.whole_half_edge(code)).collect();
                self.loops.push(&half_edges);
            }
        }
        self.close(&[FacetParent { facet, same_way: true }]);
    }

    fn push_group(&mut self, group: &Group<'_>, numbering: &Numbering<'_>) {
        let first = self.parent_offsets.len() as u32 - 1;
        let mut half_edges = Vec::new();
        for face in group.faces() {
            for cycle in group.loops(face) {
                half_edges.clear();
                half_edges.extend(group.half_edges(cycle).iter().map(|&h| numbering.half_edge(group, h)));
                self.loops.push(&half_edges);
            }
            self.close(group.parents(face));
        }
        self.of_groups.push(first..self.parent_offsets.len() as u32 - 1);
    }

    /// Adds those of the next facets.
    fn append(&mut self, other: &Self) {
        let n_faces = self.parent_offsets.len() as u32 - 1;
        let n_parents = self.parents.len() as u32;
        let Self { loops, parents, parent_offsets, .. } = self;
        parallel::join(
            || loops.append(&other.loops),
            || {
                parents.extend_from_slice(&other.parents);
                parent_offsets.extend(other.parent_offsets[1..].iter().map(|p| n_parents + p));
            },
        );
        self.of_groups.extend(other.of_groups.iter().map(|faces| n_faces + faces.start..n_faces + faces.end));
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
