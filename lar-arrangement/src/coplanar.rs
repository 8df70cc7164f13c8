//! Stage 2b: facets in one plane. Their edges split each other; facets whose insides overlap form a group that
//! is fragmented as one.

use crate::crossing::Contacts;
use crate::kernel::{Seen, Sign};
use crate::soup::Soup;

/// Two facets in one plane, and how the corners of each lie to the edges of the other.
///
/// All pairs of edges are looked at: a facet has at most 64.
#[derive(Default)]
pub(crate) struct Overlay {
    facets: [Facet; 2],
    /// The axis along which the plane is seen.
    axis: usize,
}

#[derive(Default)]
struct Facet {
    id: u32,
    /// The axis along which it is seen.
    axis: usize,
    edges: Vec<Edge>,
    /// On which side of its edges the facet lies as it is seen.
    inner: Option<Sign>,
    /// The turn from edge i to corner j of the other facet, at `i * corners of the other + j`.
    turns: Vec<Sign>,
}

/// An edge of a facet.
struct Edge {
    number: u32,
    start: Seen,
    /// The edge after this one in its loop, by its place.
    next: usize,
}

/// Splits the edges of two coplanar facets by each other; true when the facets' insides (may) overlap.
pub(crate) fn meet(soup: &Soup, pair: [u32; 2], overlay: &mut Overlay, out: &mut Contacts) -> bool {
    if !overlay.look(soup, pair) {
        return false;
    }
    let [f, g] = &overlay.facets;
    for i in 0..f.edges.len() {
        for j in 0..g.edges.len() {
            if f.edges[i].number != g.edges[j].number {
                overlay.split_each_other(soup, [i, j], out);
            }
        }
    }
    overlay.may_overlap(soup)
}

/// Whether the insides of two facets in one plane (may) overlap.
pub(crate) fn overlap(soup: &Soup, pair: [u32; 2], overlay: &mut Overlay) -> bool {
    overlay.look(soup, pair) && overlay.may_overlap(soup)
}

impl Overlay {
    /// Looks at two facets; false when they have nothing in common but shared corners and a shared edge, as two triangles of
    /// which one has the other beyond an edge.
    fn look(&mut self, soup: &Soup, pair: [u32; 2]) -> bool {
        (self.axis, _) = soup.geometry.dominant_axis(pair[0]);
        // One facet after the other is in many pairs, first or second.
        if self.facets[0].id == pair[1] || self.facets[1].id == pair[0] {
            self.facets.swap(0, 1);
        }
        for (facet, id) in self.facets.iter_mut().zip(pair) {
            facet.read(soup, id, self.axis);
        }
        let [f, g] = &mut self.facets;
        f.look_at(soup, g, self.axis) && g.look_at(soup, f, self.axis)
    }

    fn split_each_other(&self, soup: &Soup, [i, j]: [usize; 2], out: &mut Contacts) {
        let geometry = &soup.geometry;
        let [f, g] = &self.facets;
        let (of_h, of_e) = (f.turns_to(i, g, j), g.turns_to(j, f, i));
        let sides = [of_h, of_e].map(|[from, to]| from.times(to));
        if sides.contains(&Sign::Positive) {
            return;
        }
        let (e, h) = (f.edges[i].number, g.edges[j].number);
        if sides == [Sign::Negative; 2] {
            let ends = [e, h].map(|e| soup.edges[e as usize]);
            let def = geometry.crossing_definition(ends, f.id, self.axis);
            let v = out.edge_vertex(geometry, def, |def| geometry.vertex_on_edge(def));
            out.splits.extend([(e, v), (h, v)]);
            return;
        }
        let (ends_e, ends_h) = (f.ends(i), g.ends(j));
        for (edge, ends, others, turns) in [(e, ends_e, ends_h, of_h), (h, ends_h, ends_e, of_e)] {
            for (point, turn) in others.into_iter().zip(turns) {
                if turn == Sign::Zero && geometry.is_inside_edge(ends, point) {
                    out.splits.push((edge, point.p));
                }
            }
        }
    }

    /// Whether the insides (may) overlap: neither facet is convex with an edge that has all corners of the other on its
    /// outer side or on its line.
    fn may_overlap(&self, soup: &Soup) -> bool {
        let [f, g] = &self.facets;
        [(f, g), (g, f)].into_iter().all(|(this, other)| {
            let separates = |turns: &[Sign]| turns.iter().all(|&turn| Some(turn) != this.inner);
            !(this.turns.chunks(other.edges.len()).any(separates) && this.is_convex(soup, self.axis))
        })
    }
}

impl Facet {
    /// O(its edges); nothing to do for the facet that is there.
    fn read(&mut self, soup: &Soup, id: u32, axis: usize) {
        if (self.id, self.axis) == (id, axis) && !self.edges.is_empty() {
            return;
        }
        let edges = &soup.facet_edges[id as usize];
        (self.id, self.axis) = (id, axis);
        self.edges.clear();
        self.edges.extend(edges.iter().enumerate().map(|(i, &edge)| {
            let start = soup.geometry.seen_along(soup.directed(edge)[0], axis);
            Edge { number: edge / 2, start, next: soup.next_in_loop(edges, i) }
        }));
        self.inner = Some(soup.geometry.normal_sign(id, axis));
    }

    /// Finds the turns; false when both are triangles and an edge has all of the other facet beyond it but for its own ends.
    fn look_at(&mut self, soup: &Soup, other: &Self, axis: usize) -> bool {
        let are_triangles = self.edges.len() == 3 && other.edges.len() == 3;
        let mut turns = std::mem::take(&mut self.turns);
        turns.clear();
        let is_apart = (0..self.edges.len()).any(|i| {
            let (mut is_beyond, [a, b]) = (are_triangles, self.ends(i));
            for corner in &other.edges {
                let corner = &corner.start;
                let turn = soup.geometry.turn_in_plane(self.id, [a, b, corner], axis);
                let is_end = (corner.p == a.p) | (corner.p == b.p);
                is_beyond &= (Some(turn) != self.inner) & (is_end | (turn != Sign::Zero));
                turns.push(turn);
            }
            is_beyond
        });
        self.turns = turns;
        !is_apart
    }

    /// The ends of edge i.
    fn ends(&self, i: usize) -> [&Seen; 2] {
        [i, self.edges[i].next].map(|edge| &self.edges[edge].start)
    }

    /// The turns from edge i to the ends of edge j of the other facet.
    fn turns_to(&self, i: usize, other: &Self, j: usize) -> [Sign; 2] {
        let turns = &self.turns[i * other.edges.len()..];
        [turns[j], turns[other.edges[j].next]]
    }

    fn is_convex(&self, soup: &Soup, axis: usize) -> bool {
        let is_in = |i: usize, corner: &Edge| {
            let [a, b] = self.ends(i);
            let turn = soup.geometry.turn_in_plane(self.id, [a, b, &corner.start], axis);
            turn == Sign::Zero || Some(turn) == self.inner
        };
        let n = self.edges.len();
        n == 3 || (0..n).all(|i| self.edges.iter().all(|corner| is_in(i, corner)))
    }
}
