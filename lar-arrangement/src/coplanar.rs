//! Stage 2b: facets in one plane. Their edges split each other; facets whose insides overlap form a group that
//! is fragmented as one.

use crate::boxes::Aabb;
use crate::crossing::Contacts;
use crate::kernel::{Along, Geometry, Sign, Support};
use crate::soup::Soup;

/// Splits the edges of two coplanar facets by each other; true when the facets' insides (may) overlap.
///
/// All pairs of edges are tested: a facet has at most 64.
pub(crate) fn meet(soup: &Soup, [f, g]: [u32; 2], out: &mut Contacts) -> bool {
    let (axis, _) = soup.geometry.dominant_axis(f);
    let (edges_f, edges_g) = (&soup.facet_edges[f as usize], &soup.facet_edges[g as usize]);
    for &e in edges_f {
        for &h in edges_g {
            if e / 2 != h / 2 {
                split_each_other(soup, e / 2, h / 2, axis, out);
            }
        }
    }
    overlap(soup, [f, g])
}

/// Whether the insides of two facets in one plane (may) overlap.
pub(crate) fn overlap(soup: &Soup, [f, g]: [u32; 2]) -> bool {
    let (axis, up) = soup.geometry.dominant_axis(f);
    let (edges_f, edges_g) = (&soup.facet_edges[f as usize], &soup.facet_edges[g as usize]);
    let up_g = soup.geometry.normal_sign(g, axis) == Sign::Positive;
    !(separates(soup, edges_f, edges_g, axis, up) || separates(soup, edges_g, edges_f, axis, up_g))
}

fn split_each_other(soup: &Soup, e: u32, h: u32, axis: usize, out: &mut Contacts) {
    let geometry = &soup.geometry;
    let n_points = geometry.n_points() as u32;
    let [ends_e, ends_h] = [e, h].map(|e| soup.edges[e as usize]);
    if !boxes_meet(geometry, ends_e, ends_h) {
        return;
    }
    let of_h =
        ends_h.map(|p| if ends_e.contains(&p) { Sign::Zero } else { geometry.turn_to(ends_e, p, axis) });
    if of_h[0].times(of_h[1]) == Sign::Positive {
        return;
    }
    let of_e =
        ends_e.map(|p| if ends_h.contains(&p) { Sign::Zero } else { geometry.turn_to(ends_h, p, axis) });
    if of_h[0].times(of_h[1]) == Sign::Negative && of_e[0].times(of_e[1]) == Sign::Negative {
        let vertex = geometry.edge_vertex(ends_e, Support::Vertical { ends: ends_h, axis: axis as u8 });
        let v = out.push_split(e, &vertex, n_points);
        out.splits.push((h, v));
        return;
    }
    for (edge, ends, others, signs) in [(e, ends_e, ends_h, of_h), (h, ends_h, ends_e, of_e)] {
        for (p, sign) in others.into_iter().zip(signs) {
            if sign == Sign::Zero && strictly_between(geometry, ends, p) {
                out.splits.push((edge, p));
            }
        }
    }
}

fn boxes_meet(geometry: &Geometry, e: [u32; 2], h: [u32; 2]) -> bool {
    // Rounding is monotone: exact boxes that meet have rounded ones that do.
    let [e, h] = [e, h].map(|ends| Aabb::around(ends.map(|p| geometry.position(p))));
    e.meets(&h)
}

/// For a point on the line of an edge: whether it lies inside the edge.
fn strictly_between(geometry: &Geometry, ends: [u32; 2], p: u32) -> bool {
    let (axis, sign) = geometry.axis_of(&geometry.direction(Along::Edge(ends)));
    let [low, high] = if sign == Sign::Positive { ends } else { [ends[1], ends[0]] };
    geometry.cmp_points(low, p, axis).is_lt() && geometry.cmp_points(p, high, axis).is_lt()
}

/// Whether the first facet is convex and one of its edges has all corners of the second facet on its outer side
/// or on its line. `counter_clockwise` says how the first one turns in the projection.
fn separates(soup: &Soup, edges: &[u32], others: &[u32], axis: usize, counter_clockwise: bool) -> bool {
    let inner = if counter_clockwise { Sign::Positive } else { Sign::Negative };
    let all_but = |side: Sign, ends: [u32; 2], edges: &[u32]| {
        edges.iter().all(|&e| {
            let [p, _] = soup.directed(e);
            ends.contains(&p) || soup.geometry.turn_to(ends, p, axis) != side
        })
    };
    edges.iter().all(|&e| all_but(-inner, soup.directed(e), edges))
        && edges.iter().any(|&e| all_but(inner, soup.directed(e), others))
}
