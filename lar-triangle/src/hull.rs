//! Convex hulls of points of the plane or of space, in whatever dimension the points span.
//!
//! All decisions are exact signs of determinants. In space the hull grows point by point (Barber, Dobkin, Huhdanpaa,
//! *The Quickhull algorithm for convex hulls*, ACM TOMS 22(4), 1996, without its tolerances): the faces that a point sees
//! are replaced by the fan from the point to their horizon. A plane that passes through a point is not seen by it, so that
//! a facet of more than three corners is a fan of coplanar triangles; the edges between those are not edges of the hull.

use crate::TriangulateError;
use crate::predicates::orient;
use lar_core::{Points, TriangleMesh, VertexId};

/// The convex hull of points; indices are those of the points.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hull {
    /// Dimension that the points span: 0 to 3; `None` without points.
    pub dim: Option<usize>,
    /// Triangles of the boundary, counter-clockwise seen from outside; of the polygon itself when the hull is flat.
    pub triangles: Vec<[u32; 3]>,
    /// The edges between facets, or of the polygon, or the segment; the smaller index first, in rising order.
    pub edges: Vec<[u32; 2]>,
    /// The point when there is only one.
    pub point: Option<u32>,
}

impl Hull {
    /// The triangles over these points, which are those that the hull was made of.
    #[must_use]
    pub fn mesh(&self, points: &Points) -> TriangleMesh {
        TriangleMesh { points: points.clone(), triangles: self.triangles.clone() }
    }
}

/// The convex hull of points of two or three coordinates; equal points count once.
///
/// O(n log n) for points in general position where the hull is small or the points are many; O(n²) when each point sees
/// a part of the hull that grows with n, as on a sphere in the worst order.
///
/// ```
/// use lar_core::cuboid_grid;
/// let grid = cuboid_grid(&[2, 2, 2]);
/// let hull = lar_triangle::convex_hull(grid.points())?;
/// assert_eq!(hull.dim, Some(3));
/// assert_eq!(hull.mesh(grid.points()).signed_volume(), 8.0);
/// # Ok::<(), lar_triangle::TriangulateError>(())
/// ```
///
/// # Errors
/// `Dimension` for points of other than two or three coordinates, `NotFinite` with the point.
#[doc(alias("GLHull", "GLHull2d", "GLHulls"))]
pub fn convex_hull(points: &Points) -> Result<Hull, TriangulateError> {
    if !(2..=3).contains(&points.dim()) {
        return Err(TriangulateError::Dimension { found: points.dim(), expected: "2 or 3" });
    }
    let mut all = Vec::with_capacity(points.len());
    for (i, p) in points.iter().enumerate() {
        if let Some(&value) = p.iter().find(|x| !x.is_finite()) {
            return Err(TriangulateError::NotFinite { vertex: VertexId(i as u32), value });
        }
        // Adding zero makes minus zero plain, so that equal points have equal coordinates.
        all.push([p[0] + 0.0, p[1] + 0.0, p.get(2).copied().unwrap_or(0.0) + 0.0]);
    }
    Ok(Builder { points: all, faces: Vec::new() }.hull())
}

/// A triangle of the growing hull.
struct Face {
    corners: [u32; 3],
    /// Across the sides from corner 0, 1, 2.
    beside: [usize; 3],
    /// Points that see it; each is in the list of one face.
    outside: Vec<u32>,
    alive: bool,
}

struct Builder {
    points: Vec<[f64; 3]>,
    faces: Vec<Face>,
}

impl Builder {
    fn hull(mut self) -> Hull {
        let n = self.points.len() as u32;
        if n == 0 {
            return Hull::default();
        }
        let Some(b) = (1..n).find(|&i| self.points[i as usize] != self.points[0]) else {
            return Hull { dim: Some(0), point: Some(0), ..Hull::default() };
        };
        let Some((c, axes)) = (1..n).find_map(|i| Some((i, self.spanned([0, b, i])?))) else {
            return self.segment();
        };
        match (1..n).find(|&d| self.side([0, b, c], d) != 0.0) {
            None => self.polygon(axes),
            Some(d) => {
                self.start([0, b, c, d]);
                self.grow();
                self.solid()
            }
        }
    }

    /// Positive when `p` is on the inner side of a face, counter-clockwise seen from outside.
    fn side(&self, corners: [u32; 3], p: u32) -> f64 {
        let [a, b, c, p] = [corners[0], corners[1], corners[2], p].map(|i| {
            let [x, y, z] = self.points[i as usize];
            robust::Coord3D { x, y, z }
        });
        robust::orient3d(a, b, c, p)
    }

    fn flat(&self, i: u32, axes: [usize; 2]) -> [f64; 2] {
        axes.map(|k| self.points[i as usize][k])
    }

    /// Two axes in whose plane the three points are not collinear.
    fn spanned(&self, corners: [u32; 3]) -> Option<[usize; 2]> {
        [[0, 1], [1, 2], [2, 0]].into_iter().find(|&axes| {
            let [a, b, c] = corners.map(|i| self.flat(i, axes));
            orient(a, b, c) != 0.0
        })
    }

    fn rising(&self) -> Vec<u32> {
        let mut order: Vec<u32> = (0..self.points.len() as u32).collect();
        order.sort_by(|&a, &b| {
            let [p, q] = [a, b].map(|i| self.points[i as usize]);
            p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])).then(p[2].total_cmp(&q[2])).then(a.cmp(&b))
        });
        order
    }

    fn segment(&self) -> Hull {
        let order = self.rising();
        let mut ends = [order[0], order[order.len() - 1]];
        ends.sort_unstable();
        Hull { dim: Some(1), edges: vec![ends], ..Hull::default() }
    }

    /// The hull of coplanar points, by the lower and the upper chain along the first axis of a plane where they do not
    /// coincide.
    fn polygon(&self, axes: [usize; 2]) -> Hull {
        let mut order = self.rising();
        order.sort_by(|&a, &b| {
            let [p, q] = [a, b].map(|i| self.flat(i, axes));
            p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])).then(a.cmp(&b))
        });
        order.dedup_by_key(|i| self.points[*i as usize].map(f64::to_bits));
        let chain = |order: &mut dyn Iterator<Item = u32>| {
            let mut chain: Vec<u32> = Vec::new();
            for i in order {
                while let [.., a, b] = *chain.as_slice() {
                    if 0.0 < orient(self.flat(a, axes), self.flat(b, axes), self.flat(i, axes)) {
                        break;
                    }
                    chain.pop();
                }
                chain.push(i);
            }
            chain.pop();
            chain
        };
        let mut corners = chain(&mut order.iter().copied());
        corners.extend(chain(&mut order.iter().rev().copied()));
        let triangles = corners.windows(2).skip(1).map(|w| [corners[0], w[0], w[1]]).collect();
        let next = corners.iter().skip(1).chain(corners.first());
        let edges = corners.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)]).collect();
        Hull { dim: Some(2), triangles, edges: sorted(edges), point: None }
    }

    /// The tetrahedron of four points, and all others in the lists of the faces that they see.
    fn start(&mut self, corners: [u32; 4]) {
        let [a, mut b, mut c, d] = corners;
        if self.side([a, b, c], d) < 0.0 {
            (b, c) = (c, b);
        }
        // Sides: (a b c), (a d b), (b d c), (c d a); across each side the face that has it the other way round.
        let faces =
            [([a, b, c], [1, 2, 3]), ([a, d, b], [3, 2, 0]), ([b, d, c], [1, 3, 0]), ([c, d, a], [2, 1, 0])];
        for (corners, beside) in faces {
            self.faces.push(Face { corners, beside, outside: Vec::new(), alive: true });
        }
        let rest = (0..self.points.len() as u32).filter(|i| !corners.contains(i)).collect();
        self.distribute(rest, 0);
    }

    /// Puts points into the list of the first face from `first` on that they see; what sees none is inside.
    fn distribute(&mut self, points: Vec<u32>, first: usize) {
        for p in points {
            let seen = (first..self.faces.len()).find(|&f| self.side(self.faces[f].corners, p) < 0.0);
            if let Some(f) = seen {
                self.faces[f].outside.push(p);
            }
        }
    }

    fn grow(&mut self) {
        let mut next = 0;
        while next < self.faces.len() {
            if self.faces[next].alive && !self.faces[next].outside.is_empty() {
                let p = self.farthest(next);
                self.add(p, next);
            }
            next += 1;
        }
    }

    /// The point of a face's list that is farthest from it, by rounded numbers: any choice gives the hull, this one soon.
    fn farthest(&self, face: usize) -> u32 {
        let [a, b, c] = self.faces[face].corners.map(|i| self.points[i as usize]);
        let (u, v) = (minus(b, a), minus(c, a));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let height = |&p: &u32| {
            let w = minus(self.points[p as usize], a);
            normal[0] * w[0] + normal[1] * w[1] + normal[2] * w[2]
        };
        let outside = &self.faces[face].outside;
        let farthest = outside.iter().max_by(|p, q| height(p).total_cmp(&height(q)).then(q.cmp(p)));
        *farthest.expect("the list is not empty")
    }

    /// Replaces the faces that `p` sees, `from` among them, by the fan from `p` to their horizon.
    fn add(&mut self, p: u32, from: usize) {
        let mut seen = vec![from];
        self.faces[from].alive = false;
        // Sides of the horizon: its start, its end, the face beyond.
        let mut horizon: Vec<([u32; 2], usize)> = Vec::new();
        let mut at = 0;
        while at < seen.len() {
            let Face { corners, beside, .. } = self.faces[seen[at]];
            for (k, other) in beside.into_iter().enumerate() {
                if !self.faces[other].alive {
                    continue;
                }
                if self.side(self.faces[other].corners, p) < 0.0 {
                    self.faces[other].alive = false;
                    seen.push(other);
                } else {
                    horizon.push(([corners[k], corners[(k + 1) % 3]], other));
                }
            }
            at += 1;
        }
        horizon.sort_unstable();
        let first = self.faces.len();
        // The horizon is a cycle: one side starts at each of its corners, and one ends there.
        let starting = |corner: u32| horizon.partition_point(|(side, _)| side[0] < corner);
        let mut ending = vec![0; horizon.len()];
        horizon.iter().enumerate().for_each(|(i, (side, _))| ending[starting(side[1])] = i);
        for (i, &([a, b], beyond)) in horizon.iter().enumerate() {
            let new = first + i;
            let back = self.faces[beyond].corners.iter().position(|&c| c == b).expect("the side is shared");
            self.faces[beyond].beside[back] = new;
            let beside = [beyond, first + starting(b), first + ending[i]];
            self.faces.push(Face { corners: [a, b, p], beside, outside: Vec::new(), alive: true });
        }
        let mut freed = Vec::new();
        for face in seen {
            freed.append(&mut self.faces[face].outside);
        }
        freed.retain(|&q| q != p);
        self.distribute(freed, first);
    }

    fn solid(&self) -> Hull {
        let alive = || self.faces.iter().filter(|f| f.alive);
        let mut edges = Vec::new();
        for face in alive() {
            for k in 0..3 {
                let other = &self.faces[face.beside[k]];
                let [a, b] = [face.corners[k], face.corners[(k + 1) % 3]];
                let opposite = other.corners.into_iter().find(|&c| c != a && c != b);
                let bends = opposite.is_some_and(|c| self.side(face.corners, c) != 0.0);
                if a < b && bends {
                    edges.push([a, b]);
                }
            }
        }
        let triangles = alive().map(|f| f.corners).collect();
        Hull { dim: Some(3), triangles, edges: sorted(edges), point: None }
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn sorted(mut edges: Vec<[u32; 2]>) -> Vec<[u32; 2]> {
    edges.sort_unstable();
    edges
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(points: &[[f64; 3]], dim: Option<usize>, triangles: usize, edges: usize) -> Hull {
        let hull = convex_hull(&Points::from_xyz(points)).unwrap();
        assert_eq!((hull.dim, hull.triangles.len(), hull.edges.len()), (dim, triangles, edges), "{hull:?}");
        hull
    }

    /// Points (x, y, z) with coordinates 0 … n.
    fn lattice(n: [usize; 3]) -> Vec<[f64; 3]> {
        let x = |i: usize, k: usize| (i % (n[k] + 1)) as f64;
        let count = n.iter().map(|n| n + 1).product();
        let (row, layer) = (n[0] + 1, (n[0] + 1) * (n[1] + 1));
        (0..count).map(|i: usize| [x(i, 0), x(i / row, 1), x(i / layer, 2)]).collect()
    }

    #[test]
    fn every_dimension() {
        check(&[], None, 0, 0);
        assert_eq!(check(&[[1., 2., 3.]; 4], Some(0), 0, 0).point, Some(0));
        assert_eq!(check(&lattice([3, 0, 0]), Some(1), 0, 1).edges, [[0, 3]]);
        check(&lattice([0, 3, 2]), Some(2), 2, 4);
        check(&lattice([1, 1, 1]), Some(3), 12, 12);
        let [mut tilted, flat] = [lattice([3, 4, 0]), lattice([3, 4, 0])];
        tilted.iter_mut().for_each(|p| p[2] = p[0] - 2.0 * p[1]);
        assert_eq!(check(&tilted, Some(2), 2, 4).edges, check(&flat, Some(2), 2, 4).edges);
        let hull =
            convex_hull(&Points::from_columns(2, vec![0., 0., 2., 0., 1., 1., 0., 2., 0.5, 0.5])).unwrap();
        assert_eq!(hull.edges, [[0, 1], [0, 3], [1, 3]]);
    }

    #[test]
    fn coplanar_points_make_one_facet() {
        let points = Points::from_xyz(&lattice([3, 2, 4]));
        let hull = convex_hull(&points).unwrap();
        let mesh = hull.mesh(&points);
        assert!(mesh.is_closed());
        assert_eq!(mesh.signed_volume(), 24.0);
        let length = |e: &[u32; 2]| {
            let [a, b] = e.map(|v| points.xyz(v as usize));
            minus(a, b).iter().map(|x| x.abs()).sum::<f64>()
        };
        assert_eq!(hull.edges.iter().map(length).sum::<f64>(), 36.0, "only the edges of the box");
    }

    #[test]
    fn points_that_are_none_are_refused() {
        let error = convex_hull(&Points::from_xyz(&[[0., f64::NAN, 0.]])).unwrap_err();
        assert!(matches!(error, TriangulateError::NotFinite { .. }), "{error}");
        assert!(matches!(convex_hull(&Points::new(4)), Err(TriangulateError::Dimension { found: 4, .. })));
    }

    proptest! {
        /// No point lies outside, and the triangles are a sphere, also for points on a coarse grid.
        #[test]
        fn hulls_are_closed_and_hold_all_points(
            coarse in prop::collection::vec(prop::array::uniform3(-3..=3_i32), 4..40),
            fine in prop::collection::vec(prop::array::uniform3(-3.0..3.0_f64), 0..40),
        ) {
            let mut xyz: Vec<[f64; 3]> = coarse.iter().map(|p| p.map(f64::from)).collect();
            xyz.extend(fine);
            let points = Points::from_xyz(&xyz);
            let hull = convex_hull(&points).unwrap();
            if hull.dim != Some(3) {
                return Ok(());
            }
            let mesh = hull.mesh(&points);
            prop_assert!(mesh.is_closed() && 0.0 < mesh.signed_volume());
            let builder = Builder { points: xyz.clone(), faces: Vec::new() };
            for &triangle in &hull.triangles {
                for p in 0..xyz.len() as u32 {
                    prop_assert!(0.0 <= builder.side(triangle, p), "{p} lies outside of {triangle:?}");
                }
            }
            let mut used = hull.triangles.as_flattened().to_vec();
            used.sort_unstable();
            used.dedup();
            prop_assert_eq!(2 * used.len(), hull.triangles.len() + 4, "Euler's formula");
        }
    }
}
