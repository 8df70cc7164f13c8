//! Stage 2d: each facet, or group of overlapping coplanar facets, is cut into faces by what lies inside it,
//! independently of all others.
//!
//! Holds afterwards: the faces tile the facets; a face knows every facet that it is a piece of; its loops keep it
//! on their left seen from the tip of the normal of its first parent.

mod local;

use crate::half_edges::MANY;
use crate::kernel::{Along, Vertex, Way};
use crate::parallel;
use crate::progress::{Cancelled, Course};
use crate::soup::Soup;
use crate::split::Cuts;
use crate::union_find::UnionFind;
use lar_core::Cells;
use local::Local;
pub(crate) use local::Room;
use std::ops::Range;

/// A piece of an edge, from `ends[0]` to `ends[1]`; vertices from `n_base` on are new ones of the same chunk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece<D = Way> {
    pub ends: [u32; 2],
    pub direction: D,
    pub soft: bool,
}

/// Marks half-edges that are whole edges of the input.
pub(crate) const WHOLE: u32 = 1 << 31;

/// A facet that a face is a piece of, and whether their normals point the same way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct FacetParent {
    pub facet: u32,
    pub same_way: bool,
}

/// The facets that are cut, or whose edges are, by groups that overlap in one plane. All others are faces as they are.
#[derive(Debug)]
pub(crate) struct Groups {
    /// The first facet of each group, ascending.
    pub leaders: Vec<u32>,
    /// The facets of each group, ascending.
    pub members: Cells,
    /// Whether each facet is in a group.
    pub is_member: Vec<bool>,
}

impl Groups {
    /// From the sets of facets that overlap, and what was found in and on the facets.
    pub(crate) fn new(soup: &Soup, cuts: &Cuts, mut overlapping: UnionFind) -> Self {
        let n = soup.n_facets();
        let is_split = |&code: &u32| !cuts.inner.of(code / 2).is_empty();
        let users = || cuts.inner.keys().iter().flat_map(|&edge| soup.facets_of_edge[edge as usize]);
        let mut is_member = if users().any(|user| user == MANY) {
            parallel::map(n, |f| soup.facet_edges[f].iter().any(is_split))
        } else {
            vec![false; n]
        };
        for f in cuts.cut_facets().iter().copied().chain(users().filter(|&user| user < MANY)) {
            is_member[f as usize] = true;
        }
        for f in overlapping.joined() {
            is_member[f as usize] = true;
            is_member[overlapping.find(f) as usize] = true;
        }
        let members = parallel::select(n, |f| is_member[f as usize]);
        let mut led: Vec<(u32, u32)> = members.into_iter().map(|f| (overlapping.find(f), f)).collect();
        led.sort_unstable();
        let mut out = Self { leaders: Vec::new(), members: Cells::new(), is_member };
        for group in led.chunk_by(|a, b| a.0 == b.0) {
            out.leaders.push(group[0].0);
            out.members.push(&group.iter().map(|g| g.1).collect::<Vec<_>>());
        }
        out
    }

    /// Number of groups of several facets.
    pub(crate) fn n_overlapping(&self) -> u64 {
        self.members.iter().filter(|group| group.len() > 1).count() as u64
    }
}

/// The faces of some facets.
#[derive(Debug, Default)]
pub(crate) struct Fragments {
    pub vertices: Vec<Vertex>,
    /// Each is in a loop: it is inside a facet, or has one on one side only.
    pub pieces: Vec<Piece>,
    /// Half-edges of all loops: 2 · piece, + 1 against its direction; or, marked with `WHOLE`, directed edges of the
    /// input that are not split.
    pub half_edges: Vec<u32>,
    /// End of each loop in `half_edges`.
    pub loop_ends: Vec<u32>,
    /// End of each face in `loop_ends`.
    pub face_ends: Vec<u32>,
    pub parents: Vec<FacetParent>,
    /// End of each face in `parents`.
    pub parent_ends: Vec<u32>,
    /// End of each group of facets in `face_ends`.
    pub group_ends: Vec<u32>,
}

impl Fragments {
    fn close_loop(&mut self) {
        self.loop_ends.push(self.half_edges.len() as u32);
    }

    fn close_face(&mut self, parents: impl IntoIterator<Item = FacetParent>) {
        self.parents.extend(parents);
        self.parent_ends.push(self.parents.len() as u32);
        self.face_ends.push(self.loop_ends.len() as u32);
    }
}

/// Whether all contacts of the facets are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    Everywhere,
    /// Not where they do not matter to a result: edges that lie over each other may be split at different points there.
    NearResult,
}

/// What fragmentation reads.
pub(crate) struct Fragmenter<'a> {
    pub soup: &'a Soup,
    pub cuts: &'a Cuts,
    /// Vertices known to all facets.
    pub vertices: &'a [Vertex],
    pub extent: Extent,
    /// Without reports: the work in a group is part of a chunk.
    pub course: Course<'a>,
}

impl Fragmenter<'_> {
    /// Fragments without any, with room for those of some groups as they usually are.
    pub(crate) fn room_for(&self, groups: &Cells, range: Range<usize>) -> Fragments {
        let facets = || range.clone().flat_map(|group| &groups[group]).copied();
        let n_corners: usize = facets().map(|f| self.soup.facet_edges[f as usize].len()).sum();
        let n_segments: usize = facets().map(|f| self.cuts.segments(f).len()).sum();
        // A segment splits two edges, is met by another, and ends where a face does.
        let (n_pieces, n_faces) = (n_corners + 3 * n_segments, range.len() + n_segments);
        Fragments {
            pieces: Vec::with_capacity(n_pieces),
            half_edges: Vec::with_capacity(2 * n_pieces),
            loop_ends: Vec::with_capacity(n_faces),
            face_ends: Vec::with_capacity(n_faces),
            parents: Vec::with_capacity(n_faces),
            parent_ends: Vec::with_capacity(n_faces),
            group_ends: Vec::with_capacity(range.len()),
            ..Fragments::default()
        }
    }

    /// Cuts one group of facets that lie in one plane.
    pub(crate) fn fragment(
        &self,
        group: &[u32],
        room: &mut Room,
        out: &mut Fragments,
    ) -> Result<(), Cancelled> {
        self.course.go_on()?;
        match group {
            &[facet] if self.cuts.segments(facet).is_empty() => self.whole(facet, out),
            _ => Local::new(self, group, room).fragment(room, out)?,
        }
        out.group_ends.push(out.face_ends.len() as u32);
        Ok(())
    }

    /// A facet with nothing inside: one face, its edges possibly split.
    fn whole(&self, facet: u32, out: &mut Fragments) {
        let mut first = None;
        for &edge in &self.soup.facet_edges[facet as usize] {
            let [tail, head] = self.soup.directed(edge);
            first.get_or_insert(tail);
            if self.cuts.inner.of(edge / 2).is_empty() {
                out.half_edges.push(WHOLE | edge);
            } else {
                for piece in self.pieces(edge, way_of(edge, self.soup)) {
                    out.half_edges.push(2 * out.pieces.len() as u32);
                    out.pieces.push(piece);
                }
            }
            if first == Some(head) {
                out.close_loop();
                first = None;
            }
        }
        out.close_face([FacetParent { facet, same_way: true }]);
    }

    /// The pieces of a directed edge one after the other, with a direction.
    fn pieces<D: Copy>(&self, edge: u32, direction: D) -> impl Iterator<Item = Piece<D>> {
        let soft = self.soup.is_soft(edge / 2);
        let [tail, head] = self.soup.directed(edge);
        let inner = self.cuts.inner.of(edge / 2);
        let n = inner.len();
        let at = move |i: usize| match i {
            0 => tail,
            i if i == n + 1 => head,
            i if edge.is_multiple_of(2) => inner[i - 1],
            i => inner[n - i],
        };
        (0..=n).map(move |i| Piece { ends: [at(i), at(i + 1)], direction, soft })
    }
}

/// Where a directed edge of the input leads.
fn way_of(edge: u32, soup: &Soup) -> Way {
    Way { along: Along::Edge(soup.edges[(edge / 2) as usize]), reversed: !edge.is_multiple_of(2) }
}
