//! What is wrong with a surface, and where it is open.

use crate::orient::{EdgeUse, by_edge, edge_uses};
use crate::{FaceId, Surface, VertexId};

/// A way in which a surface is malformed; [`Surface::validate`] lists them all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceViolation {
    /// Points of a surface have three coordinates.
    #[error("points of {dim} coordinates where 3 are needed")]
    NotSpatial {
        /// Coordinates per point.
        dim: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("coordinate {axis} of vertex {vertex} is {value}")]
    NonFinite {
        /// The vertex.
        vertex: VertexId,
        /// Which coordinate, from 0.
        axis: usize,
        /// Its value.
        value: f64,
    },
    /// A face has no loop.
    #[error("face {face} has no loop")]
    NoLoop {
        /// The face.
        face: FaceId,
    },
    /// A loop names a vertex that does not exist.
    #[error("loop {cycle} of face {face} names vertex {vertex}, but there are {n_vertices} vertices")]
    VertexOutOfRange {
        /// The face.
        face: FaceId,
        /// Which of its loops, 0 the outer one.
        cycle: usize,
        /// The vertex it names.
        vertex: VertexId,
        /// The number of vertices.
        n_vertices: usize,
    },
    /// A loop has fewer than three distinct vertices.
    #[error("loop {cycle} of face {face} has {distinct} distinct vertices where 3 are needed")]
    ShortLoop {
        /// The face.
        face: FaceId,
        /// Which of its loops, 0 the outer one.
        cycle: usize,
        /// The number of distinct vertices.
        distinct: usize,
    },
    /// A vertex follows itself in a loop.
    #[error("vertex {vertex} follows itself in loop {cycle} of face {face}")]
    RepeatedVertex {
        /// The face.
        face: FaceId,
        /// Which of its loops, 0 the outer one.
        cycle: usize,
        /// The vertex.
        vertex: VertexId,
    },
}

/// An edge whose uses by the faces do not cancel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct BoundaryEdge {
    /// Its ends, in the direction in which it is used more often.
    pub ends: [VertexId; 2],
    /// How much more often: uses in that direction minus uses in the other, each times the coefficient of its
    /// face.
    pub surplus: i64,
}

impl Surface {
    /// All ways in which the surface is malformed: coordinates first, then face by face. O(n log n).
    ///
    /// ```
    /// use lar_core::{Points, Surface};
    /// let mut s = Surface::new("s", Points::from_xyz(&[[0.; 3], [1., 0., 0.], [0., 1., 0.]]));
    /// s.push_face([&[0, 1, 7][..]], 1);
    /// let message = s.validate()[0].to_string();
    /// assert_eq!(message, "loop 0 of face f0 names vertex v7, but there are 3 vertices");
    /// ```
    #[must_use]
    pub fn validate(&self) -> Vec<SurfaceViolation> {
        let mut found = Vec::new();
        if self.points.dim() != 3 {
            found.push(SurfaceViolation::NotSpatial { dim: self.points.dim() });
        }
        for (i, axis, value) in self.points.non_finite() {
            let vertex = VertexId(u32::try_from(i).unwrap_or(u32::MAX));
            found.push(SurfaceViolation::NonFinite { vertex, axis, value });
        }
        for (face, f) in (0..self.n_faces()).zip((0..).map(FaceId)) {
            if self.face(face).len() == 0 {
                found.push(SurfaceViolation::NoLoop { face: f });
            }
            for (cycle, vertices) in self.face(face).enumerate() {
                self.check_loop(f, cycle, vertices, &mut found);
            }
        }
        found
    }

    fn check_loop(&self, face: FaceId, cycle: usize, vertices: &[u32], found: &mut Vec<SurfaceViolation>) {
        let n_vertices = self.points.len();
        for &v in vertices.iter().filter(|&&v| v as usize >= n_vertices) {
            found.push(SurfaceViolation::VertexOutOfRange { face, cycle, vertex: VertexId(v), n_vertices });
        }
        let mut sorted = vertices.to_vec();
        sorted.sort_unstable();
        sorted.dedup();
        if sorted.len() < 3 {
            found.push(SurfaceViolation::ShortLoop { face, cycle, distinct: sorted.len() });
        }
        for (i, &v) in vertices.iter().enumerate() {
            if vertices.len() > 1 && v == vertices[(i + 1) % vertices.len()] {
                found.push(SurfaceViolation::RepeatedVertex { face, cycle, vertex: VertexId(v) });
            }
        }
    }

    /// The edges at which the surface, its faces taken with their coefficients, is open: the boundary of its
    /// 2-chain. Sorted by ends; empty when the surface bounds a solid. Vertices are told apart by index, not
    /// by position. O(n log n).
    #[must_use]
    pub fn boundary_edges(&self) -> Vec<BoundaryEdge> {
        let surplus = |group: &[EdgeUse]| -> i64 {
            group.iter().map(|u| i64::from(u.sign) * i64::from(self.coefficient(u.face as usize))).sum()
        };
        let open = |group: &[EdgeUse]| {
            let [a, b] = group[0].ends.map(VertexId);
            match surplus(group) {
                0 => None,
                n if n > 0 => Some(BoundaryEdge { ends: [a, b], surplus: n }),
                n => Some(BoundaryEdge { ends: [b, a], surplus: -n }),
            }
        };
        by_edge(&self.uses()).filter_map(open).collect()
    }

    /// The edges used an odd number of times by faces of odd coefficient: the boundary modulo 2, smaller end
    /// first, sorted. Where this is empty and [`boundary_edges`](Self::boundary_edges) is not, the surface is
    /// closed but not oriented consistently. O(n log n).
    #[must_use]
    pub fn odd_boundary_edges(&self) -> Vec<[VertexId; 2]> {
        let odd = |u: &&EdgeUse| self.coefficient(u.face as usize) % 2 != 0;
        by_edge(&self.uses())
            .filter(|group| group.iter().filter(odd).count() % 2 == 1)
            .map(|group| group[0].ends.map(VertexId))
            .collect()
    }

    fn uses(&self) -> Vec<EdgeUse> {
        let faces = (0..self.n_faces()).zip(0..);
        edge_uses(faces.flat_map(|(face, f)| self.face(face).map(move |cycle| (f, cycle))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Points;

    fn corner() -> Points {
        Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]])
    }

    fn surface(faces: &[(&[&[u32]], i8)]) -> Surface {
        let mut surface = Surface::new("s", corner());
        for (loops, coefficient) in faces {
            surface.push_face(loops.iter().copied(), *coefficient);
        }
        surface
    }

    #[track_caller]
    fn check_violations(surface: &Surface, expected: &[&str]) {
        let found: Vec<String> = surface.validate().iter().map(ToString::to_string).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn violations_are_all_listed() {
        check_violations(&surface(&[(&[&[0, 1, 2]], 1)]), &[]);
        check_violations(
            &surface(&[(&[], 1), (&[&[0, 1, 2], &[0, 4]], 1), (&[&[0, 1, 2, 0]], 1)]),
            &[
                "face f0 has no loop",
                "loop 1 of face f1 names vertex v4, but there are 4 vertices",
                "loop 1 of face f1 has 2 distinct vertices where 3 are needed",
                "vertex v0 follows itself in loop 0 of face f2",
            ],
        );
        let mut infinite = surface(&[]);
        infinite.points.coords_mut()[4] = f64::NEG_INFINITY;
        check_violations(&infinite, &["coordinate 1 of vertex v1 is -inf"]);
        check_violations(
            &Surface::new("flat", Points::new(2)),
            &["points of 2 coordinates where 3 are needed"],
        );
    }

    #[track_caller]
    fn check_boundary(faces: &[(&[&[u32]], i8)], signed: &[([u32; 2], i64)], odd: &[[u32; 2]]) {
        let surface = surface(faces);
        let found: Vec<_> =
            surface.boundary_edges().iter().map(|e| (e.ends.map(|v| v.0), e.surplus)).collect();
        assert_eq!(found, signed);
        let found: Vec<_> = surface.odd_boundary_edges().iter().map(|e| e.map(|v| v.0)).collect();
        assert_eq!(found, odd);
    }

    #[test]
    fn boundaries() {
        let outward: [(&[&[u32]], i8); 4] =
            [(&[&[0, 2, 1]], 1), (&[&[0, 1, 3]], 1), (&[&[0, 3, 2]], 1), (&[&[1, 2, 3]], 1)];
        check_boundary(&outward, &[], &[]);
        check_boundary(&outward[1..], &[([0, 1], 1), ([2, 0], 1), ([1, 2], 1)], &[[0, 1], [0, 2], [1, 2]]);
        let mut flipped = outward;
        flipped[0].1 = -1;
        check_boundary(&flipped, &[([0, 1], 2), ([2, 0], 2), ([1, 2], 2)], &[]);
        let mut wall = outward;
        wall[0].1 = 0;
        check_boundary(&wall, &[([0, 1], 1), ([2, 0], 1), ([1, 2], 1)], &[[0, 1], [0, 2], [1, 2]]);
    }
}
