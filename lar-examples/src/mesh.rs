//! Input surfaces as triangle meshes.

use lar_core::{Surface, TriangleMesh};
use lar_triangle::{TriangulateError, Triangulator};

/// The triangles of the faces of a surface, over the points of the surface. Inner walls, which bound nothing, are left
/// out.
pub(crate) fn of_surface(surface: &Surface) -> Result<TriangleMesh, TriangulateError> {
    let mut triangulator = Triangulator::new();
    let mut triangles = Vec::new();
    for f in (0..surface.n_faces()).filter(|&f| surface.coefficient(f) != 0) {
        triangulator.face(&surface.points, surface.face(f), &mut triangles)?;
    }
    Ok(TriangleMesh { points: surface.points.clone(), triangles })
}
