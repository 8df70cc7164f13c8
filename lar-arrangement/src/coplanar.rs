//! Stage 2b: facets in one plane. Their edges split each other; facets whose insides overlap form a group that
//! is fragmented as one.

use crate::crossing::Contacts;
use crate::kernel::{Geometry, Plane, Sign, Support};
use crate::soup::Soup;

/// Splits the edges of two coplanar facets by each other; true when the facets' insides (may) overlap.
///
/// All pairs of edges are tested: a facet has at most 64.
pub(crate) fn meet(soup: &Soup, [f, g]: [u32; 2], out: &mut Contacts) -> bool {
    let (axis, up) = soup.geometry.dominant_axis(f);
    let (edges_f, edges_g) = (&soup.facet_edges[f as usize], &soup.facet_edges[g as usize]);
    for &e in edges_f {
        for &h in edges_g {
            if e / 2 != h / 2 {
                split_each_other(soup, e / 2, h / 2, axis, out);
            }
        }
    }
    let up_g = soup.geometry.normal_sign(g, axis) == Sign::Positive;
    !(separates(soup, edges_f, edges_g, axis, up) || separates(soup, edges_g, edges_f, axis, up_g))
}

fn turn(geometry: &Geometry, [a, b]: [u32; 2], p: u32, axis: usize) -> Sign {
    let [a, b, p] = [a, b, p].map(|p| geometry.points[p as usize]);
    Sign::from(Plane::vertical(a, b, axis).side(p))
}

fn split_each_other(soup: &Soup, e: u32, h: u32, axis: usize, out: &mut Contacts) {
    let geometry = &soup.geometry;
    let n_points = geometry.points.len() as u32;
    let [ends_e, ends_h] = [e, h].map(|e| soup.edges[e as usize]);
    if !boxes_meet(geometry, ends_e, ends_h) {
        return;
    }
    let of_h = ends_h.map(|p| if ends_e.contains(&p) { Sign::Zero } else { turn(geometry, ends_e, p, axis) });
    if of_h[0].times(of_h[1]) == Sign::Positive {
        return;
    }
    let of_e = ends_e.map(|p| if ends_h.contains(&p) { Sign::Zero } else { turn(geometry, ends_h, p, axis) });
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
    let [[a, b], [c, d]] = [e, h].map(|e| e.map(|p| geometry.points[p as usize]));
    (0..3).all(|k| a[k].min(b[k]) <= c[k].max(d[k]) && c[k].min(d[k]) <= a[k].max(b[k]))
}

/// For a point on the line of an edge: whether it lies inside the edge.
fn strictly_between(geometry: &Geometry, ends: [u32; 2], p: u32) -> bool {
    let ([a, b], p) = (ends.map(|p| geometry.points[p as usize]), geometry.points[p as usize]);
    let axis = (0..3).max_by_key(|&k| (a[k] - b[k]).abs()).expect("three axes");
    a[axis].min(b[axis]) < p[axis] && p[axis] < a[axis].max(b[axis])
}

/// Whether the first facet is convex and one of its edges has all corners of the second facet on its outer side
/// or on its line. `counter_clockwise` says how the first one turns in the projection.
fn separates(soup: &Soup, edges: &[u32], others: &[u32], axis: usize, counter_clockwise: bool) -> bool {
    let inner = if counter_clockwise { Sign::Positive } else { Sign::Negative };
    let all_but = |side: Sign, ends: [u32; 2], edges: &[u32]| {
        edges.iter().all(|&e| {
            let [p, _] = soup.directed(e);
            ends.contains(&p) || turn(&soup.geometry, ends, p, axis) != side
        })
    };
    edges.iter().all(|&e| all_but(-inner, soup.directed(e), edges))
        && edges.iter().any(|&e| all_but(inner, soup.directed(e), others))
}
