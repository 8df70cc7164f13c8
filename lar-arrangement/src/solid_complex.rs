//! The surface of a solid as a 2-complex, with where its faces come from.

use crate::soup::{Parent, Parents};
use crate::union_find::UnionFind;
use lar_core::{Cells, ChainComplex, FaceId};

/// The surface of a solid: vertices, ∂1 and ∂2, all faces oriented outwards.
#[derive(Clone, Debug)]
pub struct SolidComplex {
    /// The 2-complex.
    pub complex: ChainComplex,
    /// Vertices of the loops, the face on their left seen from outside.
    pub(crate) loops: Cells,
    pub(crate) face_loops: Vec<u32>,
    pub(crate) parents: Parents,
    /// The exact normals, rounded, up to positive factors.
    pub(crate) normals: Vec<[f64; 3]>,
    /// The first face of the arrangement that is part of each; empty when there is no arrangement.
    pub(crate) pieces: Vec<(FaceId, i8)>,
}

impl SolidComplex {
    /// Number of faces.
    #[must_use]
    pub fn n_faces(&self) -> usize {
        self.normals.len()
    }

    /// Number of loops of all faces.
    #[must_use]
    pub fn n_loops(&self) -> usize {
        self.loops.len()
    }

    /// Vertices of the loops of a face, the outer one first.
    pub fn face_loops(&self, face: FaceId) -> impl ExactSizeIterator<Item = &[u32]> + Clone + '_ {
        (self.face_loops[face.index()]..self.face_loops[face.index() + 1]).map(|l| &self.loops[l as usize])
    }

    /// The input faces that a face is made of pieces of; the sign is +1 where they look the same way.
    #[must_use]
    pub fn parents(&self, face: FaceId) -> &[Parent] {
        self.parents.of(face.index())
    }

    /// The first of the arrangement's faces that a face is made of, and +1 where they look the same way, −1 where not.
    /// `None` when there is no arrangement ([`Arranger::boolean`](crate::Arranger::boolean)).
    #[must_use]
    pub fn piece(&self, face: FaceId) -> Option<(FaceId, i8)> {
        self.pieces.get(face.index()).copied()
    }

    /// The unit normal of a face's exact plane, rounded; it points out of the solid.
    #[must_use]
    pub fn normal(&self, face: FaceId) -> [f64; 3] {
        let normal = self.normals[face.index()];
        let length = normal.iter().fold(0.0, |length: f64, x| length.hypot(*x));
        normal.map(|x| x / length)
    }

    /// The volume enclosed; minus that of the rest of space when the exterior is part of the solid. By the divergence
    /// theorem, with a cone over each face. O(size).
    ///
    /// ```
    /// use lar_arrangement::{arrange, Detail};
    /// let bar = arrange(&[lar_core::cuboid_grid(&[3, 2, 1]).to_surface("bar")?])?;
    /// let all = bar.union_of_cells((1..7).map(lar_core::CellId)).to_complex(Detail::Simplified);
    /// assert_eq!((all.volume(), all.area()), (6.0, 22.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn volume(&self) -> f64 {
        let points = self.complex.points();
        if points.is_empty() {
            return 0.0;
        }
        let apex = points.xyz(0);
        let cone = |face: usize| {
            let area = self.complex.face_area_vector(face);
            let base = points.xyz(self.loops[self.face_loops[face] as usize][0] as usize);
            (0..3).map(|k| (base[k] - apex[k]) * area[k]).sum::<f64>() / 3.0
        };
        (0..self.n_faces()).map(cone).sum()
    }

    /// The area of all faces. O(size).
    #[must_use]
    pub fn area(&self) -> f64 {
        (0..self.n_faces()).map(|face| self.complex.face_area(face)).sum()
    }

    /// V − E + Σ over faces of (2 − loops). O(faces).
    #[must_use]
    pub fn euler(&self) -> i64 {
        let faces: i64 = self.face_loops.windows(2).map(|w| 2 - i64::from(w[1] - w[0])).sum();
        self.complex.n_cells(0) as i64 - self.complex.n_cells(1) as i64 + faces
    }

    /// Whether the surface is a cycle: ∂2 applied to the sum of all faces is zero. O(size).
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let boundary = self.complex.boundary(2);
        let mut sums = vec![0i32; boundary.rows()];
        for (&edge, &sign) in boundary.indices().iter().zip(boundary.data()) {
            sums[edge as usize] += i32::from(sign);
        }
        sums.iter().all(|&s| s == 0)
    }

    /// Number of connected components of the surface. O(n α(n)).
    #[must_use]
    pub fn n_components(&self) -> usize {
        let n = self.complex.n_cells(0);
        let mut sets = UnionFind::new(n + self.n_faces());
        for face in 0..self.n_faces() as u32 {
            for &v in self.face_loops(FaceId(face)).flatten() {
                sets.union(v, n as u32 + face);
            }
        }
        sets.labels().1 as usize
    }
}
