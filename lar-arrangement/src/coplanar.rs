//! Stage 2b: facets in one plane. Their edges split each other; facets whose insides overlap form a group that
//! is fragmented as one.

use crate::crossing::Contacts;
use crate::kernel::{Along, Geometry, Sign};
use crate::soup::Soup;

/// Two facets in one plane, and how the corners of each lie to the edges of the other.
///
/// All pairs of edges are looked at: a facet has at most 64.
#[derive(Default)]
pub(crate) struct Overlay {
    facets: [u32; 2],
    /// The axis along which the plane is seen.
    axis: usize,
    /// The turn from edge i of a facet to corner j of the other, at `i * corners of the other + j`.
    turns: [Vec<Sign>; 2],
}

/// Splits the edges of two coplanar facets by each other; true when the facets' insides (may) overlap.
pub(crate) fn meet(soup: &Soup, pair: [u32; 2], overlay: &mut Overlay, out: &mut Contacts) -> bool {
    if !overlay.look(soup, pair) {
        return false;
    }
    let [f, g] = pair.map(|f| &soup.facet_edges[f as usize]);
    for (i, &e) in f.iter().enumerate() {
        for (j, &h) in g.iter().enumerate() {
            if e / 2 != h / 2 {
                overlay.split_each_other(soup, [(i, e), (j, h)], out);
            }
        }
    }
    overlay.may_overlap(soup)
}

/// Whether the insides of two facets in one plane (may) overlap.
pub(crate) fn overlap(soup: &Soup, pair: [u32; 2]) -> bool {
    let mut overlay = Overlay::default();
    overlay.look(soup, pair) && overlay.may_overlap(soup)
}

impl Overlay {
    /// Looks at two facets; false when they are triangles and an edge of one has all of the other beyond it.
    fn look(&mut self, soup: &Soup, facets: [u32; 2]) -> bool {
        (self.axis, _) = soup.geometry.dominant_axis(facets[0]);
        self.facets = facets;
        let are_triangles = facets.iter().all(|&f| soup.facet_edges[f as usize].len() == 3);
        for k in 0..2 {
            let (f, g) = (facets[k], facets[1 - k]);
            let beyond = -self.inner(soup, k);
            self.turns[k].clear();
            for &e in &soup.facet_edges[f as usize] {
                let ends = soup.directed(e);
                let first = self.turns[k].len();
                self.turns[k].extend(soup.facet_edges[g as usize].iter().map(|&h| {
                    let [p, _] = soup.directed(h);
                    if ends.contains(&p) {
                        Sign::Zero
                    } else {
                        soup.geometry.turn_in_plane(f, ends, p, self.axis)
                    }
                }));
                if are_triangles && self.turns[k][first..].iter().all(|&turn| turn == beyond) {
                    return false;
                }
            }
        }
        true
    }

    /// On which side of its edges a facet lies as it is seen.
    fn inner(&self, soup: &Soup, k: usize) -> Sign {
        soup.geometry.normal_sign(self.facets[k], self.axis)
    }

    /// The turns from edge i of facet k to the ends of edge j of the other.
    fn turns_to(&self, soup: &Soup, k: usize, i: usize, j: usize) -> [Sign; 2] {
        let others = &soup.facet_edges[self.facets[1 - k] as usize];
        let turns = &self.turns[k][i * others.len()..];
        [turns[j], turns[soup.next_in_loop(others, j)]]
    }

    fn split_each_other(&self, soup: &Soup, [(i, e), (j, h)]: [(usize, u32); 2], out: &mut Contacts) {
        let geometry = &soup.geometry;
        let of_h = self.turns_to(soup, 0, i, j);
        let of_e = self.turns_to(soup, 1, j, i);
        if [of_h, of_e].iter().any(|turns| turns[0].times(turns[1]) == Sign::Positive) {
            return;
        }
        let (ends_e, ends_h) = (soup.directed(e), soup.directed(h));
        if of_h[0].times(of_h[1]) == Sign::Negative && of_e[0].times(of_e[1]) == Sign::Negative {
            let [ends, others] = [e, h].map(|e| soup.edges[e as usize / 2]);
            let def = geometry.crossing_definition(ends, others, self.axis);
            let v = out.edge_vertex(geometry, def, |def| geometry.vertex_on_edge(def));
            out.splits.extend([(e / 2, v), (h / 2, v)]);
            return;
        }
        for (edge, ends, others, turns) in [(e, ends_e, ends_h, of_h), (h, ends_h, ends_e, of_e)] {
            for (p, turn) in others.into_iter().zip(turns) {
                if turn == Sign::Zero && strictly_between(geometry, ends, p) {
                    out.splits.push((edge / 2, p));
                }
            }
        }
    }

    /// Whether the insides (may) overlap: neither facet is convex with an edge that has all corners of the other on its
    /// outer side or on its line.
    fn may_overlap(&self, soup: &Soup) -> bool {
        (0..2).all(|k| {
            let inner = self.inner(soup, k);
            let n_others = soup.facet_edges[self.facets[1 - k] as usize].len();
            let separates = |turns: &[Sign]| turns.iter().all(|&turn| turn != inner);
            !(self.turns[k].chunks(n_others).any(separates) && self.is_convex(soup, k))
        })
    }

    fn is_convex(&self, soup: &Soup, k: usize) -> bool {
        let facet = self.facets[k];
        let edges = &soup.facet_edges[facet as usize];
        let beyond = -self.inner(soup, k);
        let is_in = |ends: [u32; 2], p: u32| {
            ends.contains(&p) || soup.geometry.turn_in_plane(facet, ends, p, self.axis) != beyond
        };
        edges.len() == 3
            || edges.iter().all(|&e| edges.iter().all(|&h| is_in(soup.directed(e), soup.directed(h)[0])))
    }
}

/// For a point on the line of an edge: whether it lies inside the edge.
fn strictly_between(geometry: &Geometry, ends: [u32; 2], p: u32) -> bool {
    // Rounding is monotone: a point outside of the rounded box is outside of the exact one.
    let ([a, b], at) = (ends.map(|p| geometry.position(p)), geometry.position(p));
    if (0..3).any(|k| at[k] < a[k].min(b[k]) || a[k].max(b[k]) < at[k]) {
        return false;
    }
    let (axis, sign) = geometry.axis_of(&geometry.direction(Along::Edge(ends)));
    let [low, high] = if sign == Sign::Positive { ends } else { [ends[1], ends[0]] };
    geometry.cmp_points(low, p, axis).is_lt() && geometry.cmp_points(p, high, axis).is_lt()
}
