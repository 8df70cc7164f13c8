//! Stage 1f: points whose triangles are known to have nothing in common but their shared edges.
//!
//! Most pairs of facets whose boxes meet and that no chart settles are neighbours in one mesh. All pairs around a point
//! are settled at once when the triangles there close up to a fan that goes once around some direction w: projected along w they lie side by
//! side.
//!
//! ```text
//!        a1 ──── a0          each triangle turns counter-clockwise about w,
//!       ╱  ╲   ╱  ╲          each edge at v has one triangle on either side,
//!     a2 ──── v ──── a5      and the fan passes the ray from v along m once
//!       ╲  ╱   ╲  ╱  → m
//!        a3 ──── a4
//! ```
//!
//! The test is one of `f64` with a margin for all rounding: where it fails nothing is claimed. The margin also keeps the
//! outer corners farther apart than points that are nearly one.

use crate::charts::Charts;
use crate::counting::sorted_by_place;
use crate::half_edges::MANY;
use crate::kernel::Geometry;
use crate::parallel;
use crate::soup::Soup;

/// Points a chunk of work.
const POINTS_A_CHUNK: usize = 512;
/// Facets a chunk of work.
const FACETS_A_CHUNK: usize = 1 << 12;
/// No number of a point.
const NOT_WANTED: u32 = u32::MAX;

/// What is known of the points.
#[derive(Debug)]
pub(crate) struct Stars {
    is_clean: Vec<bool>,
}

impl Stars {
    /// Looks at the points of a soup that are not inside of one chart. The corners of two triangles at a clean point are
    /// farther apart than `distance` along some axis, in grid steps. O(n).
    pub(crate) fn new(soup: &Soup, charts: &Charts, distance: f64) -> Self {
        let n = soup.geometry.n_points();
        let mut is_clean = vec![false; n];
        if !soup.geometry.is_on_grid() {
            return Self { is_clean };
        }
        let of_others = charts.without.iter().flat_map(|&f| soup.geometry.base(f));
        charts.between.iter().copied().chain(of_others).for_each(|p| is_clean[p as usize] = true);
        if charts.between.is_empty() && charts.without.is_empty() {
            return Self { is_clean };
        }
        let is_odd = |edge: u32| soup.facets_of_edge[edge as usize].iter().any(|&facet| facet >= MANY);
        for edge in parallel::select(soup.edges.len(), is_odd) {
            soup.edges[edge as usize].iter().for_each(|&p| is_clean[p as usize] = false);
        }
        for &facet in &charts.without {
            let edges = &soup.facet_edges[facet as usize];
            if edges.len() != 3 {
                edges.iter().for_each(|&code| is_clean[soup.directed(code)[0] as usize] = false);
            }
        }
        let around = Corners::new(soup, &is_clean);
        let (n_chunks, range) = parallel::chunks(around.points.len(), POINTS_A_CHUNK);
        let parts = parallel::map(n_chunks, |chunk| {
            let star = |i: usize| is_fan(&soup.geometry, around.points[i], around.of(i), distance);
            range(chunk).map(star).collect::<Vec<_>>()
        });
        for (&p, holds) in around.points.iter().zip(parts.into_iter().flatten()) {
            is_clean[p as usize] = holds;
        }
        Self { is_clean }
    }

    pub(crate) fn is_clean(&self, p: u32) -> bool {
        self.is_clean[p as usize]
    }

    /// Whether two facets share a clean corner: they have no other points in common than shared corners and edges.
    pub(crate) fn settle(&self, geometry: &Geometry, f: u32, g: u32) -> bool {
        let (a, b) = (geometry.base(f), geometry.base(g));
        a.iter().any(|p| b.contains(p) && self.is_clean(*p))
    }
}

/// The corners of triangles at some points: 3 · facet + corner.
struct Corners {
    points: Vec<u32>,
    offsets: Vec<u32>,
    corners: Vec<u32>,
}

impl Corners {
    fn new(soup: &Soup, is_wanted: &[bool]) -> Self {
        let points = parallel::select(is_wanted.len(), |p| is_wanted[p as usize]);
        let mut number = vec![NOT_WANTED; is_wanted.len()];
        points.iter().zip(0..).for_each(|(&p, i)| number[p as usize] = i);
        let (n_chunks, range) = parallel::chunks(soup.n_facets(), FACETS_A_CHUNK);
        let parts = parallel::map(n_chunks, |chunk| {
            let corners = range(chunk).flat_map(|f| {
                let base = soup.geometry.base(f as u32);
                [0, 1, 2].map(|k| (number[base[k] as usize], (3 * f + k) as u32))
            });
            corners.filter(|corner| corner.0 != NOT_WANTED).collect::<Vec<_>>()
        });
        let (offsets, sorted) =
            sorted_by_place(points.len(), &parallel::concat(&parts), |corner| corner.0 as usize);
        Self { points, offsets, corners: sorted.into_iter().map(|corner| corner.1).collect() }
    }

    /// Those at the i-th point.
    fn of(&self, i: usize) -> &[u32] {
        &self.corners[self.offsets[i] as usize..self.offsets[i + 1] as usize]
    }
}

/// Whether the triangles at a point, if each edge there has one on either side, are a fan that goes around once.
fn is_fan(geometry: &Geometry, p: u32, corners: &[u32], distance: f64) -> bool {
    let w = corners.iter().fold([0.0; 3], |sum, &corner| {
        let normal = geometry.normal(corner / 3);
        [sum[0] + normal[0], sum[1] + normal[1], sum[2] + normal[2]]
    });
    let at = geometry.position(p);
    let length = |v: [f64; 3]| v[0].abs() + v[1].abs() + v[2].abs();
    // Exactly at right angles to w, whatever was rounded there; any such vector will do that is not tiny beside w, so the
    // 4 decides nothing.
    let m =
        if 4.0 * (w[0].abs() + w[1].abs()) > w[2].abs() { [-w[1], w[0], 0.0] } else { [0.0, -w[2], w[1]] };
    let mut passes = 0;
    for &corner in corners {
        let base = geometry.base(corner / 3);
        let spoke = |i: u32| {
            let to = geometry.position(base[(i % 3) as usize]);
            [to[0] - at[0], to[1] - at[1], to[2] - at[2]]
        };
        let (a, b) = (spoke(corner % 3 + 1), spoke(corner % 3 + 2));
        let (la, lb) = (length(a), length(b));
        // det(w, a, b), a × b being the normal. A corner is farther from the line of the other one, seen along w, than
        // det / (|w| · |other|); points within the distance along every axis are within √3 of it. The normal is off by
        // 2^-52 of its terms, their sum with w by little more.
        let turn = dot(w, geometry.normal(corner / 3));
        let margin = length(w) * la.max(lb) * (2.0 * distance + la.min(lb) * 2f64.powi(-48));
        if turn.partial_cmp(&margin) != Some(std::cmp::Ordering::Greater) {
            return false;
        }
        passes += u32::from(dot(m, a) < 0.0 && 0.0 <= dot(m, b));
    }
    passes == 1
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canonical::Tolerance;
    use crate::soup::Placed;
    use lar_core::{Points, Surface};

    /// Whether the first point is clean.
    fn is_clean(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> bool {
        let mut surface = Surface::new("star", Points::from_xyz(points));
        triangles.iter().for_each(|t| {
            surface.push_face([&t[..]], 1);
        });
        let surfaces = [surface];
        let placed = Placed::snapped(&surfaces, |_, _| 0.0).expect("the points are finite");
        assert!(Tolerance::new(0.5) <= placed.tolerances[0]);
        let soup = Soup::new(&surfaces, placed);
        Stars::new(&soup, &Charts::none(soup.n_facets()), 1.5).is_clean(0)
    }

    /// A fan of n triangles that goes around `turns` times.
    fn fan(n: u32, turns: f64, height: impl Fn(u32) -> f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let angle = |i: u32| std::f64::consts::TAU * turns * f64::from(i) / f64::from(n);
        let spoke = |i: u32| [angle(i).cos(), angle(i).sin(), height(i)];
        let points = [[0.0; 3]].into_iter().chain((0..n).map(spoke)).collect();
        (points, (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect())
    }

    #[test]
    fn fans_that_go_around_once_are_clean() {
        for n in [3, 4, 6, 40] {
            for height in [0.0, 1.0, -3.0] {
                let (points, mut triangles) = fan(n, 1.0, |_| height);
                assert!(is_clean(&points, &triangles), "{n} triangles, {height}");
                triangles.iter_mut().for_each(|t| t.reverse());
                assert!(is_clean(&points, &triangles), "{n} triangles, {height}, turned over");
            }
        }
        let (points, triangles) = fan(8, 1.0, |i| 0.3 * f64::from(i % 2));
        assert!(is_clean(&points, &triangles), "a saddle");
    }

    #[test]
    fn others_are_not() {
        let (points, triangles) = fan(8, 2.0, |i| 0.1 * f64::from(i));
        assert!(!is_clean(&points, &triangles), "twice around");
        let (points, mut triangles) = fan(6, 1.0, |_| 0.5);
        triangles.pop();
        assert!(!is_clean(&points, &triangles), "open");
        let (points, mut triangles) = fan(6, 1.0, |_| 0.5);
        triangles[2].reverse();
        assert!(!is_clean(&points, &triangles), "one triangle turned over");
        let (mut points, mut triangles) = fan(6, 1.0, |_| 0.5);
        points.push([0.1, 0.1, 2.0]);
        triangles.push([0, 1, 7]);
        assert!(!is_clean(&points, &triangles), "a fin");
        let (mut points, triangles) = fan(6, 1.0, |_| 0.5);
        points[2] = [0.1, -0.9, 0.5];
        assert!(!is_clean(&points, &triangles), "folded");
        let (mut points, triangles) = fan(6, 1.0, |_| 0.5);
        points[2] = points[1].map(|x| x + 1e-12);
        assert!(!is_clean(&points, &triangles), "two corners within the distance");
    }
}
