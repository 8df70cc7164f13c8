//! Cells of an arrangement, and input surfaces, in the form in which the viewer draws them: triangles, and the real
//! edges.

use lar_arrangement::Arrangement;
use lar_core::{CellId, EdgeId, FaceId, Surface};
use lar_triangle::{TriangulateError, Triangulation, triangulate};
use lar_viewer::{CellRef, CellShape};

/// An arrangement and the triangles of its faces.
#[derive(Clone, Debug)]
pub(crate) struct Shapes<'a> {
    arrangement: &'a Arrangement,
    triangles: Triangulation,
}

impl<'a> Shapes<'a> {
    pub(crate) fn new(arrangement: &'a Arrangement) -> Result<Self, TriangulateError> {
        Ok(Self { arrangement, triangles: triangulate(arrangement.complex())? })
    }

    /// A 3-cell: its boundary.
    pub(crate) fn cell(&self, cell: CellId) -> Result<CellShape, TriangulateError> {
        let complex = self.arrangement.complex();
        let mesh = self.triangles.cell_mesh(complex, cell)?;
        let faces = complex.boundary(3).outer_view(cell.index());
        let mut edges: Vec<EdgeId> = faces
            .iter()
            .flat_map(|column| column.indices().iter().flat_map(|&f| self.edges(FaceId(f))))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        Ok(CellShape {
            name: cell.to_string(),
            cell: CellRef { dim: 3, index: cell.0 },
            mesh,
            edges: edges.into_iter().map(|e| self.segment(e)).collect(),
        })
    }

    /// A face: its triangles, and the edges of its loops.
    pub(crate) fn face(&self, face: FaceId) -> Result<CellShape, TriangulateError> {
        Ok(CellShape {
            name: face.to_string(),
            cell: CellRef { dim: 2, index: face.0 },
            mesh: self.triangles.mesh_of_faces(self.arrangement.complex().points(), [(face, 1)])?,
            edges: self.edges(face).into_iter().map(|e| self.segment(e)).collect(),
        })
    }

    fn edges(&self, face: FaceId) -> Vec<EdgeId> {
        let mut edges: Vec<EdgeId> = self.arrangement.face_loops(face).flatten().map(|h| h.edge).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    fn segment(&self, edge: EdgeId) -> [[f64; 3]; 2] {
        self.arrangement.edge(edge).map(|v| self.arrangement.complex().points().xyz(v.index()))
    }
}

/// The faces of an input surface: their triangles and the edges of their loops.
pub(crate) fn surface(surface: &Surface, index: u32) -> Result<CellShape, TriangulateError> {
    let mesh = crate::mesh::of_surface(surface)?;
    let sides = |cycle: &[u32]| -> Vec<[u32; 2]> {
        let next = cycle.iter().skip(1).chain(cycle.first());
        cycle.iter().zip(next).map(|(&a, &b)| if a < b { [a, b] } else { [b, a] }).collect()
    };
    let mut edges: Vec<[u32; 2]> =
        (0..surface.n_faces()).flat_map(|f| surface.face(f).flat_map(sides).collect::<Vec<_>>()).collect();
    edges.sort_unstable();
    edges.dedup();
    Ok(CellShape {
        name: surface.name.clone(),
        cell: CellRef { dim: 3, index },
        mesh,
        edges: edges.into_iter().map(|ends| ends.map(|v| surface.points.xyz(v as usize))).collect(),
    })
}
