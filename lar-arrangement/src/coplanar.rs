//! Stage 2b: facets in one plane. Their edges split each other; facets whose insides overlap form a group that
//! is fragmented as one.

use crate::crossing::Contacts;
use crate::kernel::{Along, Geometry, Seen, Sign, longest_axis};
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
    edges: Vec<u32>,
    /// Of each edge.
    ends: Vec<[u32; 2]>,
    /// Where edge i starts.
    corners: Vec<Seen>,
    /// The edge after each edge in its loop.
    next: Vec<usize>,
    /// On which side of its edges the facet lies as it is seen.
    inner: Option<Sign>,
    /// The turn from edge i to corner j of the other facet, at `i * corners of the other + j`.
    turns: Vec<Sign>,
}

/// Splits the edges of two coplanar facets by each other; true when the facets' insides (may) overlap.
pub(crate) fn meet(soup: &Soup, pair: [u32; 2], overlay: &mut Overlay, out: &mut Contacts) -> bool {
    if !overlay.look(soup, pair) {
        return false;
    }
    let [f, g] = &overlay.facets;
    for i in 0..f.edges.len() {
        for j in 0..g.edges.len() {
            if f.edges[i] / 2 != g.edges[j] / 2 {
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
        for (facet, id) in self.facets.iter_mut().zip(pair) {
            facet.read(soup, id, self.axis);
        }
        let [f, g] = &mut self.facets;
        f.look_at(soup, g, self.axis) && g.look_at(soup, f, self.axis)
    }

    fn split_each_other(&self, soup: &Soup, [i, j]: [usize; 2], out: &mut Contacts) {
        let geometry = &soup.geometry;
        let [f, g] = &self.facets;
        let of_h = f.turns_to(i, g, j);
        if of_h[0].times(of_h[1]) == Sign::Positive {
            return;
        }
        let of_e = g.turns_to(j, f, i);
        if of_e[0].times(of_e[1]) == Sign::Positive {
            return;
        }
        let (e, h) = (f.edges[i] / 2, g.edges[j] / 2);
        if of_h[0].times(of_h[1]) == Sign::Negative && of_e[0].times(of_e[1]) == Sign::Negative {
            let ends = [e, h].map(|e| soup.edges[e as usize]);
            let def = geometry.crossing_definition(ends, f.id, self.axis);
            let v = out.edge_vertex(geometry, def, |def| geometry.vertex_on_edge(def));
            out.splits.extend([(e, v), (h, v)]);
            return;
        }
        for (edge, ends, others, turns) in [(e, f.ends[i], g.ends[j], of_h), (h, g.ends[j], f.ends[i], of_e)]
        {
            for (p, turn) in others.into_iter().zip(turns) {
                if turn == Sign::Zero && strictly_between(geometry, ends, p) {
                    out.splits.push((edge, p));
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
    fn read(&mut self, soup: &Soup, id: u32, axis: usize) {
        let edges = &soup.facet_edges[id as usize];
        self.id = id;
        self.edges.clear();
        self.ends.clear();
        self.corners.clear();
        self.next.clear();
        self.edges.extend_from_slice(edges);
        self.ends.extend(edges.iter().map(|&e| soup.directed(e)));
        self.corners.extend(self.ends.iter().map(|&[p, _]| soup.geometry.seen_along(p, axis)));
        self.next.extend((0..edges.len()).map(|i| soup.next_in_loop(edges, i)));
        self.inner = Some(soup.geometry.normal_sign(id, axis));
    }

    /// Finds the turns; false when both are triangles and an edge has all of the other facet beyond it but for its own ends.
    fn look_at(&mut self, soup: &Soup, other: &Self, axis: usize) -> bool {
        let are_triangles = self.edges.len() == 3 && other.edges.len() == 3;
        let mut turns = std::mem::take(&mut self.turns);
        turns.clear();
        let is_apart = (0..self.edges.len()).any(|i| {
            let mut is_beyond = are_triangles;
            for j in 0..other.edges.len() {
                let turn = self.turn(soup, i, (other, j), axis);
                is_beyond &= match turn {
                    Sign::Zero => self.ends[i].contains(&other.ends[j][0]),
                    turn => Some(turn) != self.inner,
                };
                turns.push(turn);
            }
            is_beyond
        });
        self.turns = turns;
        !is_apart
    }

    /// The turn from edge i to corner j of a facet in the same plane.
    fn turn(&self, soup: &Soup, i: usize, (other, j): (&Self, usize), axis: usize) -> Sign {
        if self.ends[i].contains(&other.ends[j][0]) {
            return Sign::Zero;
        }
        let [a, b] = [i, self.next[i]].map(|corner| &self.corners[corner]);
        soup.geometry.turn_in_plane(self.id, [a, b, &other.corners[j]], axis)
    }

    /// The turns from edge i to the ends of edge j of the other facet.
    fn turns_to(&self, i: usize, other: &Self, j: usize) -> [Sign; 2] {
        let turns = &self.turns[i * other.edges.len()..];
        [turns[j], turns[other.next[j]]]
    }

    fn is_convex(&self, soup: &Soup, axis: usize) -> bool {
        let is_in = |turn: Sign| turn == Sign::Zero || Some(turn) == self.inner;
        let n = self.edges.len();
        n == 3 || (0..n).all(|i| (0..n).all(|j| is_in(self.turn(soup, i, (self, j), axis))))
    }
}

/// For a point on the line of an edge: whether it lies inside the edge.
fn strictly_between(geometry: &Geometry, ends: [u32; 2], p: u32) -> bool {
    // Rounding is monotone: a point outside of the rounded box is outside of the exact one.
    let ([a, b], at) = (ends.map(|p| geometry.position(p)), geometry.position(p));
    if (0..3).any(|k| at[k] < a[k].min(b[k]) || a[k].max(b[k]) < at[k]) {
        return false;
    }
    // So does a place strictly between others.
    let k = longest_axis(std::array::from_fn(|k| b[k] - a[k]));
    if a[k].min(b[k]) < at[k] && at[k] < a[k].max(b[k]) {
        return true;
    }
    let (axis, sign) = geometry.axis_of(&geometry.direction(Along::Edge(ends)));
    let [low, high] = if sign == Sign::Positive { ends } else { [ends[1], ends[0]] };
    geometry.cmp_points(low, p, axis).is_lt() && geometry.cmp_points(p, high, axis).is_lt()
}
