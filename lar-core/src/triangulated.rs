//! Triangle meshes of models with convex faces.

use crate::{Model, ModelError, TriangleMesh};

impl Model {
    /// The boundary of the model's solid, or all its faces when it has no 3-cells, as triangles: each face is
    /// fanned out from the first vertex of its loop, oriented as in [`to_surface`](Self::to_surface). Faces
    /// must be convex; those that are not, or have holes, need a constrained triangulation. Vertices keep
    /// their numbers. O(n log n).
    ///
    /// # Errors
    /// As [`to_surface`](Self::to_surface).
    ///
    /// ```
    /// let cube = lar_core::cuboid_grid(&[2, 2, 2]).to_triangle_mesh()?;
    /// assert_eq!(cube.triangles.len(), 48);
    /// assert!(cube.is_closed());
    /// assert_eq!(cube.signed_volume(), 8.);
    /// # Ok::<(), lar_core::ModelError>(())
    /// ```
    pub fn to_triangle_mesh(&self) -> Result<TriangleMesh, ModelError> {
        let surface = self.to_surface("")?;
        let mut triangles = Vec::new();
        for f in (0..surface.n_faces()).filter(|&f| surface.coefficient(f) != 0) {
            for cycle in surface.face(f) {
                triangles.extend(cycle[1..].windows(2).map(|w| [cycle[0], w[0], w[1]]));
            }
        }
        Ok(TriangleMesh { points: surface.points, triangles })
    }
}

#[cfg(test)]
mod tests {
    use crate::{ModelError, cuboid_grid, simplex, simplex_grid};

    #[test]
    fn solids_and_surfaces() {
        let mesh = simplex_grid(&[2, 1, 3]).unwrap().to_triangle_mesh().unwrap();
        assert!(mesh.is_closed());
        assert_eq!((mesh.triangles.len(), mesh.signed_volume()), (2 * 2 * (2 + 3 + 6), 6.));
        assert_eq!(simplex(3).to_triangle_mesh().unwrap().triangles.len(), 4);
        assert_eq!(cuboid_grid(&[1, 1]).to_triangle_mesh().unwrap_err(), ModelError::NotSpatial { dim: 2 });
        let sheet = cuboid_grid(&[2, 3]).embedded(3).unwrap().to_triangle_mesh().unwrap();
        assert_eq!((sheet.triangles.len(), sheet.area(), sheet.is_closed()), (12, 6., false));
    }
}
