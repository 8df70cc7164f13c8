//! Triangle meshes: what triangulation gives and what viewers and mesh files take.

use crate::measure::{cross, dot, sub};
use crate::orient::{by_edge, edge_uses};
use crate::topology::DisjointSets;
use crate::{Affine, AffineError, Points};

/// Triangles over a 3 × n set of points, each counter-clockwise seen from outside.
///
/// The methods panic when a triangle names a vertex that does not exist or the points are not of three
/// coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    /// 3 × n.
    pub points: Points,
    /// Three vertices a triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// The enclosed volume, negative when the triangles face inward; for an open mesh the volume of the cones
    /// over its triangles from the middle of its bounding box. O(n).
    ///
    /// # Panics
    /// When a triangle names a vertex that there is not.
    ///
    /// ```
    /// let ball = lar_core::icosphere(5);
    /// let exact = 4. / 3. * std::f64::consts::PI;
    /// assert!(ball.signed_volume() < exact && ball.signed_volume() > 0.99 * exact);
    /// ```
    #[must_use]
    pub fn signed_volume(&self) -> f64 {
        let Some((lo, hi)) = self.bounds() else { return 0. };
        let middle = [0, 1, 2].map(|k| lo[k] / 2. + hi[k] / 2.);
        let six: f64 = self
            .corners()
            .map(|corners| corners.map(|p| sub(p, middle)))
            .map(|[a, b, c]| dot(a, cross(b, c)))
            .sum();
        six / 6.
    }

    /// The mesh moved by an affine map; triangles are reversed when the map mirrors, so that outward stays
    /// outward. O(n).
    ///
    /// # Errors
    /// When the map is not of the space of the points.
    ///
    /// ```
    /// use lar_core::{icosphere, s};
    /// let egg = icosphere(3).transformed(&s(&[1., 1., -2.])).unwrap();
    /// assert!((egg.signed_volume() - 2. * icosphere(3).signed_volume()).abs() < 1e-12);
    /// ```
    pub fn transformed(&self, map: &Affine) -> Result<Self, AffineError> {
        let mirror = map.is_mirror();
        let turned = |&[a, b, c]: &[u32; 3]| if mirror { [c, b, a] } else { [a, b, c] };
        let triangles = self.triangles.iter().map(turned).collect();
        Ok(Self { points: map.apply(&self.points)?, triangles })
    }

    /// The sum of the areas of the triangles. O(n).
    ///
    /// # Panics
    /// When a triangle names a vertex that there is not.
    #[must_use]
    pub fn area(&self) -> f64 {
        let doubled = self.corners().map(|[a, b, c]| {
            let normal = cross(sub(b, a), sub(c, a));
            dot(normal, normal).sqrt()
        });
        doubled.sum::<f64>() / 2.
    }

    /// Lower and upper corner of the bounding box of the points; `None` when there are none. O(n).
    #[must_use]
    pub fn bounds(&self) -> Option<([f64; 3], [f64; 3])> {
        let (lo, hi) = self.points.bounds()?;
        Some(([lo[0], lo[1], lo[2]], [hi[0], hi[1], hi[2]]))
    }

    /// True when each directed edge is matched by its reverse, as often as it occurs. Vertices are told apart
    /// by index, not by position. O(n log n).
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let triangles = (0..).zip(self.triangles.iter().map(|t| &t[..]));
        by_edge(&edge_uses(triangles)).all(|uses| uses.iter().map(|u| i64::from(u.sign)).sum::<i64>() == 0)
    }

    /// The number of parts that no vertex joins; vertices without triangle do not count. O(n α(n)).
    ///
    /// # Panics
    /// When a triangle names a vertex that there is not.
    #[must_use]
    pub fn n_components(&self) -> usize {
        let mut sets = DisjointSets::new(self.points.len());
        for &[a, b, c] in &self.triangles {
            sets.join(a as usize, b as usize);
            sets.join(b as usize, c as usize);
        }
        let mut roots: Vec<usize> = self.triangles.iter().map(|t| sets.find(t[0] as usize)).collect();
        roots.sort_unstable();
        roots.dedup();
        roots.len()
    }

    fn corners(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        self.triangles.iter().map(|t| t.map(|v| self.points.xyz(v as usize)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::icosphere;

    fn tetrahedron() -> TriangleMesh {
        TriangleMesh {
            points: Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]]),
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        }
    }

    #[track_caller]
    fn check(mesh: &TriangleMesh, volume: f64, area: f64, closed: bool, components: usize) {
        assert!((mesh.signed_volume() - volume).abs() < 1e-12, "{}", mesh.signed_volume());
        assert!((mesh.area() - area).abs() < 1e-12, "{}", mesh.area());
        assert_eq!((mesh.is_closed(), mesh.n_components()), (closed, components));
    }

    #[test]
    fn measures() {
        let area = 1.5 + 3_f64.sqrt() / 2.;
        check(&tetrahedron(), 1. / 6., area, true, 1);
        let mut inward = tetrahedron();
        inward.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        check(&inward, -1. / 6., area, true, 1);
        let mut one_flipped = tetrahedron();
        one_flipped.triangles[3].swap(0, 1);
        assert!(!one_flipped.is_closed());
        let empty = TriangleMesh { points: Points::new(3), triangles: Vec::new() };
        check(&empty, 0., 0., true, 0);
        assert_eq!(empty.bounds(), None);
    }

    #[test]
    fn far_away_meshes_keep_their_volume() {
        let mut far = tetrahedron();
        far.points.coords_mut().iter_mut().for_each(|x| *x += 1e6);
        check(&far, 1. / 6., 1.5 + 3_f64.sqrt() / 2., true, 1);
    }

    #[test]
    fn two_balls() {
        let ball = icosphere(2);
        let n = u32::try_from(ball.points.len()).unwrap();
        let coords = ball.points.coords().iter().map(|x| x + 3.).chain(ball.points.coords().iter().copied());
        let triangles = ball.triangles.iter().map(|t| t.map(|v| v + n)).chain(ball.triangles.iter().copied());
        let two = TriangleMesh {
            points: Points::from_columns(3, coords.collect()),
            triangles: triangles.collect(),
        };
        check(&two, 2. * ball.signed_volume(), 2. * ball.area(), true, 2);
    }
}
