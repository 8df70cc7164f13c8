//! Stage 1e: points whose triangles are known to have nothing in common but their shared edges.
//!
//! Most pairs of facets whose boxes meet are neighbours in one mesh. All pairs around a point are settled at once when
//! the triangles there close up to a fan that goes once around some direction w: projected along w they lie side by
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

use crate::boxes::NO_MARK;
use crate::half_edges::MANY;
use crate::kernel::Geometry;
use crate::parallel;
use crate::soup::Soup;

/// Points a chunk of work.
const POINTS_A_CHUNK: usize = 4096;

/// What is known of the points.
#[derive(Debug)]
pub(crate) struct Stars {
    is_clean: Vec<bool>,
}

impl Stars {
    /// Looks at all points of a soup. The corners of two triangles at a clean point are farther apart than `distance` along
    /// some axis, in grid steps. O(n).
    pub(crate) fn new(soup: &Soup, distance: f64) -> Self {
        let n = soup.geometry.n_points();
        if !soup.geometry.is_on_grid() {
            return Self { is_clean: vec![false; n] };
        }
        let around = Corners::new(soup);
        let (n_chunks, range) = parallel::chunks(n, POINTS_A_CHUNK);
        let parts = parallel::map(n_chunks, |chunk| {
            let star = |p: usize| is_fan(&soup.geometry, p as u32, around.of(p), distance);
            range(chunk).map(star).collect::<Vec<_>>()
        });
        let mut is_clean = parts.concat();
        for (ends, users) in soup.edges.iter().zip(&soup.facets_of_edge) {
            if users.iter().any(|&facet| facet >= MANY) {
                ends.iter().for_each(|&p| is_clean[p as usize] = false);
            }
        }
        for corners in soup.facet_edges.iter().filter(|edges| edges.len() != 3) {
            corners.iter().for_each(|&code| is_clean[soup.directed(code)[0] as usize] = false);
        }
        Self { is_clean }
    }

    pub(crate) fn is_clean(&self, p: u32) -> bool {
        self.is_clean[p as usize]
    }

    /// The clean corners of a facet. Facets that share one have no other points in common than shared corners and edges.
    pub(crate) fn marks(&self, geometry: &Geometry, facet: u32) -> [u32; 3] {
        geometry.base(facet).map(|p| if self.is_clean(p) { p } else { NO_MARK })
    }
}

/// The corners of triangles at each point: 3 · facet + corner.
struct Corners {
    offsets: Vec<u32>,
    corners: Vec<u32>,
}

impl Corners {
    fn new(soup: &Soup) -> Self {
        let triangles = || soup.facet_edges.iter().zip(0u32..).filter(|(edges, _)| edges.len() == 3);
        let mut offsets = vec![0u32; soup.geometry.n_points() + 2];
        for (_, facet) in triangles() {
            soup.geometry.base(facet).iter().for_each(|&p| offsets[p as usize + 2] += 1);
        }
        for i in 2..offsets.len() {
            offsets[i] += offsets[i - 1];
        }
        let mut corners = vec![0; offsets.last().map_or(0, |&n| n as usize)];
        for (_, facet) in triangles() {
            for (p, corner) in soup.geometry.base(facet).into_iter().zip(3 * facet..) {
                let at = &mut offsets[p as usize + 1];
                corners[*at as usize] = corner;
                *at += 1;
            }
        }
        Self { offsets, corners }
    }

    fn of(&self, p: usize) -> &[u32] {
        &self.corners[self.offsets[p] as usize..self.offsets[p + 1] as usize]
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
        Stars::new(&Soup::new(&surfaces, placed), 1.5).is_clean(0)
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
