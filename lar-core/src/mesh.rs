//! Triangle meshes: what triangulation gives and what viewers and mesh files take.

use crate::Points;

/// Triangles over a 3 × n set of points, each counter-clockwise seen from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    /// 3 × n.
    pub points: Points,
    /// Three vertices a triangle.
    pub triangles: Vec<[u32; 3]>,
}
