//! One pass over the pairs of facets whose boxes meet: which have corners that are nearly one, and which lie nearly in
//! one plane.

use super::Input;
use super::vector::{cross, distance, dot, minus};
use crate::parallel;

/// Pairs of facets a chunk of work.
const PAIRS_A_CHUNK: usize = 1 << 14;

/// What the pass found.
#[derive(Debug, Default)]
pub(crate) struct Scan {
    /// Pairs of points within the tolerance, ascending.
    pub near: Vec<[u32; 2]>,
    /// Pairs of facets of different polygons that lie nearly in one plane.
    pub coplanar: Vec<[u32; 2]>,
    /// Of each facet.
    pub(super) shapes: Vec<Shape>,
}

/// A facet seen as a plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    unit: [f64; 3],
    origin: [f64; 3],
    /// Twice the area of the triangle that gives the plane, over its longest side.
    pub width: f64,
    /// No corner is farther from the origin.
    reach: f64,
    /// How far apart points may lie that were one, and how far from a plane its corners.
    points: f64,
    planes: f64,
}

impl Scan {
    pub(crate) fn new(input: &Input) -> Self {
        let n_facets = input.soup.n_facets() as u32;
        let shapes: Vec<Shape> = (0..n_facets).map(|f| Shape::of(input, f)).collect();
        let (n_chunks, range) = parallel::chunks(input.pairs.len(), PAIRS_A_CHUNK);
        let parts = parallel::map(n_chunks, |chunk| {
            let mut out = Self::default();
            input.pairs[range(chunk)].iter().for_each(|&pair| out.visit(input, &shapes, pair));
            out
        });
        let mut all = Self::default();
        for part in parts {
            all.near.extend(part.near);
            all.coplanar.extend(part.coplanar);
        }
        all.near.sort_unstable();
        all.near.dedup();
        Self { shapes, ..all }
    }

    fn visit(&mut self, input: &Input, shapes: &[Shape], [f, g]: [u32; 2]) {
        let (a, b) = (&shapes[f as usize], &shapes[g as usize]);
        self.push_near_points(input, [f, g], a.points.max(b.points));
        let polygons = [f, g].map(|f| input.soup.facet_polygon[f as usize]);
        let are_flat = polygons.iter().all(|&p| input.soup.polygon_flat[p as usize]);
        if are_flat && polygons[0] != polygons[1] {
            let (wide, narrow, facet) = if a.width >= b.width { (a, b, g) } else { (b, a, f) };
            if wide.nearly_holds(narrow, || input.corners(facet).map(|p| input.soup.geometry.position(p))) {
                self.coplanar.push([f, g]);
            }
        }
    }

    fn push_near_points(&mut self, input: &Input, [f, g]: [u32; 2], limit: f64) {
        let geometry = &input.soup.geometry;
        let is_triangle = |f: u32| input.soup.facet_edges[f as usize].len() == 3;
        let mut test = |p: u32, q: u32| {
            let (a, b) = (geometry.nearest_grid_point(p), geometry.nearest_grid_point(q));
            if p != q && (0..3).all(|k| a[k].abs_diff(b[k]) as f64 <= limit) {
                self.near.push([p.min(q), p.max(q)]);
            }
        };
        if is_triangle(f) && is_triangle(g) {
            let (corners, others) = (geometry.base(f), geometry.base(g));
            corners.into_iter().for_each(|p| others.into_iter().for_each(|q| test(p, q)));
        } else {
            // At most 64 corners each.
            input.corners(f).for_each(|p| input.corners(g).for_each(|q| test(p, q)));
        }
    }
}

impl Shape {
    fn of(input: &Input, facet: u32) -> Self {
        let geometry = &input.soup.geometry;
        let [a, b, c] = geometry.base(facet).map(|p| geometry.position(p));
        let normal = geometry.normal(facet);
        let length = dot(normal, normal).sqrt();
        let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
        let reach = match input.soup.facet_edges[facet as usize].len() {
            3 => longest,
            _ => input.corners(facet).map(|p| distance(a, geometry.position(p))).fold(0.0, f64::max),
        };
        let tolerance = input.tolerance(facet);
        Self {
            unit: normal.map(|x| x / length),
            origin: a,
            width: length / longest,
            reach,
            points: tolerance.points(),
            planes: tolerance.planes(),
        }
    }

    /// Whether the corners of another facet lie near this one's plane, the tolerance growing with the distance.
    fn nearly_holds<I: Iterator<Item = [f64; 3]>>(&self, other: &Self, corners: impl Fn() -> I) -> bool {
        let tolerance = self.planes.max(other.planes);
        let limit = |distance: f64| tolerance * (1.0 + 2.0 * distance / self.width);
        // Two corners of a facet of width w at an angle to the plane differ in height by w · sine.
        let normal = cross(self.unit, other.unit);
        let [x, y, z] = minus(self.origin, other.origin).map(f64::abs);
        let farthest = limit(x + y + z + other.reach);
        if dot(normal, normal) * other.width.powi(2) > 4.0 * farthest.powi(2) {
            return false;
        }
        corners().all(|p| {
            let d = minus(p, self.origin);
            dot(self.unit, d).abs() <= limit(dot(d, d).sqrt())
        })
    }
}
