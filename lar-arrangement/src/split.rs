//! Stage 2c: every input edge is split once, globally, at all points found on it; both its facets see the same
//! pieces. Also the lists of what lies inside each facet.

use crate::crossing::{Contacts, Segment};
use crate::interner::Interner;
use crate::kernel::{Along, Sign};
use crate::parallel;
use crate::soup::Soup;
use lar_core::Cells;

/// The contacts of all facets, by edge and by facet.
#[derive(Debug)]
pub(crate) struct Cuts {
    /// Points inside each edge, from its first end to its second.
    pub inner: Cells,
    /// The edges that have any, ascending.
    pub split_edges: Vec<u32>,
    /// Sorted by facet.
    segments: Vec<Segment>,
    segment_offsets: Vec<u32>,
    touches: Vec<(u32, u32)>,
    touch_offsets: Vec<u32>,
}

impl Cuts {
    /// Unifies the vertices of the contacts and sorts everything.
    pub(crate) fn new(soup: &Soup, contacts: Contacts, interner: &mut Interner) -> Self {
        let geometry = &soup.geometry;
        let n_points = geometry.n_points() as u32;
        let ids: Vec<u32> = contacts.vertices.into_iter().map(|v| interner.intern(v, geometry)).collect();
        let id = |v: u32| if v < n_points { v } else { ids[(v - n_points) as usize] };
        let mut splits: Vec<(u32, u32)> = contacts.splits.into_iter().map(|(e, v)| (e, id(v))).collect();
        splits.sort_unstable();
        splits.dedup();
        let mut segments: Vec<Segment> =
            contacts.segments.into_iter().map(|s| Segment { ends: s.ends.map(id), ..s }).collect();
        segments.sort_by_key(|s| (s.facet, s.other, s.ends));
        let mut touches: Vec<(u32, u32)> = contacts.touches.into_iter().map(|(f, v)| (f, id(v))).collect();
        touches.sort_unstable();
        touches.dedup();
        let n_facets = soup.n_facets();
        let mut split_edges: Vec<u32> = splits.iter().map(|s| s.0).collect();
        split_edges.dedup();
        let of_facets = || {
            let segment_offsets = offsets(n_facets, segments.iter().map(|s| s.facet));
            (segment_offsets, offsets(n_facets, touches.iter().map(|t| t.0)))
        };
        let (inner, (segment_offsets, touch_offsets)) =
            parallel::join(|| sorted_along_edges(soup, &splits, interner), of_facets);
        Self { split_edges, inner, segment_offsets, touch_offsets, segments, touches }
    }

    /// The facets with segments inside, one after the other, some more than once.
    pub(crate) fn cut_facets(&self) -> impl Iterator<Item = u32> + '_ {
        self.segments.iter().map(|s| s.facet)
    }

    /// The segments inside a facet.
    pub(crate) fn segments(&self, facet: u32) -> &[Segment] {
        let f = facet as usize;
        &self.segments[self.segment_offsets[f] as usize..self.segment_offsets[f + 1] as usize]
    }

    /// The points inside a facet where another only touches it.
    pub(crate) fn touches(&self, facet: u32) -> impl Iterator<Item = u32> + '_ {
        let f = facet as usize;
        self.touches[self.touch_offsets[f] as usize..self.touch_offsets[f + 1] as usize].iter().map(|t| t.1)
    }
}

/// Where each of 0..n begins in a sorted list of them.
pub(crate) fn offsets(n: usize, sorted: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut offsets = vec![0; n + 1];
    for x in sorted {
        offsets[x as usize + 1] += 1;
    }
    for i in 0..n {
        offsets[i + 1] += offsets[i];
    }
    offsets
}

/// The points inside each edge, from its first end to its second.
fn sorted_along_edges(soup: &Soup, splits: &[(u32, u32)], interner: &Interner) -> Cells {
    let geometry = &soup.geometry;
    let vertex = |v: u32| &interner.vertices[v as usize];
    let mut inner: Vec<u32> = splits.iter().map(|s| s.1).collect();
    let mut rest = inner.as_mut_slice();
    for same in splits.chunk_by(|a, b| a.0 == b.0) {
        let (on_edge, after) = rest.split_at_mut(same.len());
        rest = after;
        if on_edge.len() > 1 {
            let ends = soup.edges[same[0].0 as usize];
            let (axis, sign) = geometry.axis_of(&geometry.direction(Along::Edge(ends)));
            on_edge.sort_by(|&a, &b| geometry.cmp_coordinate(vertex(a), vertex(b), axis));
            if sign == Sign::Negative {
                on_edge.reverse();
            }
        }
    }
    Cells::from_parts(offsets(soup.edges.len(), splits.iter().map(|s| s.0)), inner)
}
