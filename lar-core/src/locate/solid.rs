//! Points and closed polygonal surfaces.
//!
//! Each face is replaced by the triangles from its first vertex to the edges of all its loops, with signs: as
//! a chain they are the face, holes included, whether it is convex or not. A vertical ray upward from the
//! point then adds up the signs of the triangles that it passes.

use super::boxes::{Box2, BoxTree};
use super::{Location, Point2, cover, on_segment, orientation};
use crate::listing::first_few;
use crate::measure::Vec3;
use crate::{BoundaryEdge, FaceId, Surface, SurfaceViolation};
use robust::{Coord3D, orient3d};

/// Why nothing can be located in a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LocateError {
    /// The surface is malformed; all violations are listed.
    #[error("malformed surface: {}", first_few(.0))]
    Malformed(Vec<SurfaceViolation>),
    /// The faces bound no solid; their boundary is listed.
    #[error("an open surface has no inside: {}", open_edges(.0))]
    Open(Vec<BoundaryEdge>),
}

fn open_edges(edges: &[BoundaryEdge]) -> String {
    let text = |edge: &BoundaryEdge| format!("edge {} → {} is open", edge.ends[0], edge.ends[1]);
    first_few(&edges.iter().map(text).collect::<Vec<_>>())
}

/// A closed surface prepared for many questions.
///
/// ```
/// use lar_core::{Location, SolidLocator, Surface, icosphere};
/// let surface = Surface::from_triangles("ball", &icosphere(4));
/// let ball = SolidLocator::new(&surface)?;
/// assert_eq!(ball.locate([0., 0., 0.]), Location::Inside);
/// assert_eq!(ball.locate([0., 0., 2.]), Location::Outside);
/// assert_eq!(ball.winding_number([0.5, 0.1, 0.]), Some(1));
/// # Ok::<(), lar_core::LocateError>(())
/// ```
#[doc(alias = "pointInPolyhedron")]
#[doc(alias = "testinternalpoint")]
pub struct SolidLocator<'a> {
    surface: &'a Surface,
    /// The faces that bound the solid, their boxes seen from above.
    faces: Vec<FaceId>,
    tree: BoxTree,
}

impl<'a> SolidLocator<'a> {
    /// Prepares a surface; faces of coefficient 0 bound nothing and are left out. O(n log n).
    ///
    /// # Errors
    /// When the surface is malformed or open.
    pub fn new(surface: &'a Surface) -> Result<Self, LocateError> {
        let violations = surface.validate();
        if !violations.is_empty() {
            return Err(LocateError::Malformed(violations));
        }
        let open = surface.boundary_edges();
        if !open.is_empty() {
            return Err(LocateError::Open(open));
        }
        let bounding = |f: &FaceId| surface.coefficient(f.index()) != 0;
        let faces: Vec<FaceId> = (0..surface.n_faces()).map(|f| FaceId(f as u32)).filter(bounding).collect();
        let boxes = faces.iter().map(|&f| box_above(surface, f)).collect();
        Ok(Self { surface, faces, tree: BoxTree::new(boxes) })
    }

    /// Inside when the winding number is not 0. O(log n + k) with k faces above and below the point.
    ///
    /// Exact when each face lies exactly in a plane, as triangles do, and products of differences of
    /// coordinates neither overflow nor underflow. A face that misses its plane by rounding is taken for the
    /// triangles from its first vertex to its edges.
    #[must_use]
    pub fn locate(&self, point: Vec3) -> Location {
        match self.winding_number(point) {
            None => Location::Boundary,
            Some(0) => Location::Outside,
            Some(_) => Location::Inside,
        }
    }

    /// How often the surface is wrapped around the point: 1 inside an outward surface, −1 inside an inward one,
    /// 2 where two outward ones overlap; `None` on the surface. Cost and exactness as for
    /// [`locate`](Self::locate).
    #[must_use]
    pub fn winding_number(&self, point: Vec3) -> Option<i64> {
        let (mut winding, mut on) = (0, false);
        self.tree.holding([point[0], point[1]], |i| {
            let face = Fan { surface: self.surface, face: self.faces[i] };
            let coefficient = i64::from(self.surface.coefficient(self.faces[i].index()));
            on = on || face.has_on_it(point);
            if !on {
                winding += coefficient * face.passed_above(point);
            }
        });
        if on { None } else { Some(winding) }
    }
}

fn box_above(surface: &Surface, face: FaceId) -> Box2 {
    let mut around = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for &v in surface.face(face.index()).flatten() {
        let p = surface.points.point(v as usize);
        for k in 0..2 {
            around[0][k] = around[0][k].min(p[k]);
            around[1][k] = around[1][k].max(p[k]);
        }
    }
    around
}

/// A face as the chain of triangles from its first vertex to its edges.
struct Fan<'a> {
    surface: &'a Surface,
    face: FaceId,
}

impl Fan<'_> {
    fn edges(&self) -> impl Iterator<Item = [Vec3; 2]> {
        let at = |&v: &u32| self.surface.points.xyz(v as usize);
        self.surface.face(self.face.index()).flat_map(move |cycle| {
            let next = cycle.iter().cycle().skip(1);
            cycle.iter().zip(next).map(move |(a, b)| [at(a), at(b)])
        })
    }

    fn triangles(&self) -> impl Iterator<Item = [Vec3; 3]> {
        let apex = self.edges().next().map_or([0.; 3], |[a, _]| a);
        self.edges().map(move |[a, b]| [apex, a, b]).filter(move |[_, a, b]| *a != apex && *b != apex)
    }

    /// True when the point lies on an edge, or the triangles whose planes it lies on cover it.
    fn has_on_it(&self, p: Vec3) -> bool {
        if self.edges().any(|[a, b]| on_segment_in_space(a, b, p)) {
            return true;
        }
        let axis = self.open_axis();
        let covered = self
            .triangles()
            .filter(|&triangle| height(triangle, p) == 0.)
            .map(|triangle| cover(triangle.map(|q| along(q, axis)), along(p, axis)));
        covered.sum::<i32>() != 0
    }

    /// The signs of the triangles above the point, added up: +1 for one that faces up.
    fn passed_above(&self, p: Vec3) -> i64 {
        let above = |triangle: [Vec3; 3]| {
            let covers = cover(triangle.map(|q| along(q, 2)), along(p, 2));
            // Positive height: below the plane when the triangle turns counter-clockwise seen from above.
            let height = if covers == 0 { 0. } else { height(triangle, p) };
            let below = height * f64::from(covers) > 0.;
            if below { i64::from(covers) } else { 0 }
        };
        self.triangles().map(above).sum()
    }

    /// An axis along which the face is seen as more than a line, by exact signs; in its plane the answer is the
    /// same for all of them.
    fn open_axis(&self) -> usize {
        let seen = |&axis: &usize| self.triangles().any(|t| orientation(t.map(|q| along(q, axis))) != 0.);
        [2, 1, 0].into_iter().find(seen).unwrap_or(2)
    }
}

/// Positive when p lies below the plane of a triangle that turns counter-clockwise seen from above; zero in
/// its plane.
fn height([a, b, c]: [Vec3; 3], p: Vec3) -> f64 {
    let coord = |[x, y, z]: Vec3| Coord3D { x, y, z };
    orient3d(coord(a), coord(b), coord(c), coord(p))
}

/// The point seen along an axis, from its tip.
fn along([x, y, z]: Vec3, axis: usize) -> Point2 {
    match axis {
        0 => [y, z],
        1 => [z, x],
        _ => [x, y],
    }
}

/// Exact: on the segment in space is on it from all three sides.
fn on_segment_in_space(a: Vec3, b: Vec3, p: Vec3) -> bool {
    (0..3).all(|axis| on_segment(along(a, axis), along(b, axis), along(p, axis)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, Points, cuboid_grid, icosphere, r, s};
    use proptest::prelude::*;

    #[track_caller]
    fn check(surface: &Surface, point: Vec3, expected: Location) {
        assert_eq!(SolidLocator::new(surface).unwrap().locate(point), expected);
    }

    fn cube() -> Surface {
        cuboid_grid(&[2, 2, 2]).to_surface("cube").unwrap()
    }

    /// Rays through vertices and along edges and faces of a grid: 27 × 8 points on half steps.
    #[test]
    fn every_degenerate_ray_of_a_cube() {
        let surface = cube();
        let locator = SolidLocator::new(&surface).unwrap();
        let half = |i: usize| i as f64 / 2. - 0.5;
        for i in 0..7_usize.pow(3) {
            let p = [half(i % 7), half(i / 7 % 7), half(i / 49)];
            let outside = p.iter().any(|&x| !(0. ..=2.).contains(&x));
            let boundary = p.iter().any(|&x| x == 0. || x == 2.);
            let expected = if outside {
                Location::Outside
            } else if boundary {
                Location::Boundary
            } else {
                Location::Inside
            };
            assert_eq!(locator.locate(p), expected, "{p:?}");
        }
    }

    /// A square tube: its ends are faces with a square hole.
    fn tube() -> Surface {
        let square = |lo: f64, hi: f64, z: f64| [[lo, lo, z], [hi, lo, z], [hi, hi, z], [lo, hi, z]];
        let rings = [square(0., 4., 0.), square(0., 4., 1.), square(1., 3., 0.), square(1., 3., 1.)];
        let mut surface = Surface::new("tube", Points::from_xyz(rings.as_flattened()));
        surface.push_face([&[4, 5, 6, 7][..], &[12, 15, 14, 13][..]], 1);
        surface.push_face([&[0, 3, 2, 1][..], &[8, 9, 10, 11][..]], 1);
        for i in 0..4 {
            let j = (i + 1) % 4;
            surface.push_face([&[i, j, j + 4, i + 4][..]], 1);
            surface.push_face([&[i + 8, i + 12, j + 12, j + 8][..]], 1);
        }
        surface
    }

    #[test]
    fn holes_in_faces() {
        let tube = tube();
        check(&tube, [2., 2., 0.5], Location::Outside);
        check(&tube, [2., 2., 1.], Location::Outside);
        check(&tube, [0.5, 0.5, 0.5], Location::Inside);
        check(&tube, [0.5, 0.5, 1.], Location::Boundary);
        check(&tube, [3.5, 3.5, 0.], Location::Boundary);
        check(&tube, [1., 2., 0.5], Location::Boundary);
        check(&tube, [1., 1., 0.5], Location::Boundary);
        check(&tube, [3.5, 2., 0.5], Location::Inside);
        check(&tube, [3.5, 2., -1.], Location::Outside);
        check(&tube, [5., 2., 0.5], Location::Outside);
    }

    #[test]
    fn windings() {
        let ball = Surface::from_triangles("ball", &icosphere(1));
        let inward = ball.transformed(&s(&[-1., -1., -1.])).unwrap();
        assert_eq!(SolidLocator::new(&inward).unwrap().winding_number([0.; 3]), Some(1));
        let mut twice = ball.clone();
        let again: Vec<Vec<u32>> =
            (0..ball.n_faces()).flat_map(|f| ball.face(f).map(<[u32]>::to_vec)).collect();
        again.iter().for_each(|cycle| {
            twice.push_face([&cycle[..]], 1);
        });
        assert_eq!(SolidLocator::new(&twice).unwrap().winding_number([0.; 3]), Some(2));
        let mut reversed = Surface::new("inward", ball.points.clone());
        again.iter().for_each(|cycle| {
            reversed.push_face([&cycle.iter().rev().copied().collect::<Vec<_>>()[..]], 1);
        });
        let locator = SolidLocator::new(&reversed).unwrap();
        assert_eq!((locator.winding_number([0.; 3]), locator.locate([0.; 3])), (Some(-1), Location::Inside));
        assert_eq!(locator.winding_number(ball.points.xyz(3)), None);
    }

    #[test]
    fn refusals() {
        let open = Model::from_faces(
            Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]),
            [[0, 1, 2]].into_iter().collect(),
        );
        let error = SolidLocator::new(&open.to_surface("a").unwrap()).err().unwrap().to_string();
        assert_eq!(
            error,
            "an open surface has no inside: edge v0 → v1 is open; edge v2 → v0 is open; edge v1 → v2 is open"
        );
        let flat = Surface::new("flat", Points::from_columns(2, vec![0., 0.]));
        let error = SolidLocator::new(&flat).err().unwrap().to_string();
        assert_eq!(error, "malformed surface: points of 2 coordinates where 3 are needed");
        check(&Surface::new("none", Points::new(3)), [0.; 3], Location::Outside);
    }

    proptest! {
        /// A cube of any position: the same answer as after moving the point back, except near the boundary.
        #[test]
        fn moved_cubes(v in prop::array::uniform3(-3.0..3.0_f64), p in prop::array::uniform3(-0.5..2.5_f64)) {
            let near = p.iter().any(|x| (x - x.round()).abs() < 1e-9);
            prop_assume!(!near);
            let moved = cube().transformed(&r(v)).unwrap();
            let q: [f64; 3] = r(v).apply_point(&p).unwrap().try_into().unwrap();
            let inside = p.iter().all(|x| (0. ..=2.).contains(x));
            let expected = if inside { Location::Inside } else { Location::Outside };
            prop_assert_eq!(SolidLocator::new(&moved).unwrap().locate(q), expected);
        }

        /// Corners and exact midpoints of triangles with integer corners lie on them.
        #[test]
        fn points_of_triangles(corners in prop::collection::vec(-8_i8..8, 12), at in 0..4_usize) {
            let points = Points::from_columns(3, corners.iter().map(|&x| f64::from(x)).collect());
            let mut surface = Surface::new("tetrahedron", points);
            for t in [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] {
                surface.push_face([&t[..]], 1);
            }
            let locator = SolidLocator::new(&surface).unwrap();
            let [a, b, c] = [0, 1, 2].map(|i| surface.points.xyz((at + i) % 4));
            let within = [0, 1, 2].map(|k| a[k] / 4. + b[k] / 4. + c[k] / 2.);
            prop_assert_eq!(locator.locate(a), Location::Boundary);
            prop_assert_eq!(locator.locate([0, 1, 2].map(|k| a[k] / 2. + b[k] / 2.)), Location::Boundary);
            prop_assert_eq!(locator.locate(within), Location::Boundary);
            prop_assert_eq!(locator.locate([9., 0.5, 0.]), Location::Outside);
        }
    }
}
