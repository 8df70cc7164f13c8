//! What rounding of positions did to faces: triangles that are turned over, or have nothing left.

use crate::complex::Triangulation;
use crate::predicates::orient;
use lar_core::{FaceId, Points};

/// Triangles that do not look along the normal of their face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Defects {
    /// Triangles that look the other way.
    pub inverted: usize,
    /// Triangles whose corners are on one line, seen along the normal's largest component.
    pub degenerate: usize,
}

impl Triangulation {
    /// Compares the triangles with the normals that their faces had before their corners were rounded. Signs are exact.
    /// O(triangles).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1]).embedded(3)?)?;
    /// let triangles = lar_triangle::triangulate(&square)?;
    /// let defects = |z: f64| triangles.defects(square.points(), |_| [0.0, 0.1, z]);
    /// // The loop of a grid's square turns clockwise seen from above: it looks down.
    /// assert_eq!((defects(-1.0).inverted, defects(1.0).inverted, defects(-1.0).degenerate), (0, 2, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    /// When `points` are not those of the triangulation, or not of space.
    #[must_use]
    pub fn defects(&self, points: &Points, normal: impl Fn(FaceId) -> [f64; 3]) -> Defects {
        let mut out = Defects::default();
        for face in (0..).map(FaceId).take(self.n_faces()) {
            let normal = normal(face);
            let axis = (1..3).fold(0, |best, k| if normal[k].abs() > normal[best].abs() { k } else { best });
            for triangle in self.face_triangles(face) {
                let [a, b, c] = triangle.map(|v| {
                    let p = points.xyz(v as usize);
                    [p[(axis + 1) % 3], p[(axis + 2) % 3]]
                });
                let turn = orient(a, b, c) * normal[axis].signum();
                out.inverted += usize::from(turn < 0.0);
                out.degenerate += usize::from(turn == 0.0);
            }
        }
        out
    }
}
