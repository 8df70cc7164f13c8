//! Cells of an arrangement or complex, and input surfaces, in the form in which the viewer draws them: triangles, and
//! the real edges.

use crate::CommandError;
use crate::scenes::SceneError;
use lar_arrangement::Arrangement;
use lar_core::{CellId, ChainComplex, EdgeId, FaceId, Model, Points, Surface, TriangleMesh};
use lar_triangle::{TriangulateError, Triangulation, triangulate};
use lar_viewer::{CellRef, CellShape, surface_shape};

/// A complex and the triangles of its faces.
#[derive(Clone, Debug)]
pub(crate) struct Shapes<'a> {
    complex: &'a ChainComplex,
    /// The arrangement that the complex is of: it knows the edges that run into faces, which ∂2 does not.
    arrangement: Option<&'a Arrangement>,
    triangles: Triangulation,
}

impl<'a> Shapes<'a> {
    pub(crate) fn new(arrangement: &'a Arrangement) -> Result<Self, TriangulateError> {
        Ok(Self { arrangement: Some(arrangement), ..Self::of_complex(arrangement.complex())? })
    }

    /// Of a complex of dimension 2 or 3.
    pub(crate) fn of_complex(complex: &'a ChainComplex) -> Result<Self, TriangulateError> {
        Ok(Self { complex, arrangement: None, triangles: triangulate(complex)? })
    }

    /// A 3-cell: its boundary.
    pub(crate) fn cell(&self, cell: CellId) -> Result<CellShape, TriangulateError> {
        let mesh = self.triangles.cell_mesh(self.complex, cell)?;
        let faces = self.complex.boundary(3).outer_view(cell.index());
        let edges =
            faces.iter().flat_map(|column| column.indices().iter().flat_map(|&f| self.edges(FaceId(f))));
        Ok(CellShape {
            name: cell.to_string(),
            cell: CellRef { dim: 3, index: cell.0 },
            mesh,
            edges: self.segments(edges.collect()),
        })
    }

    /// All cells but the first, which is the exterior of an arrangement.
    pub(crate) fn bounded_cells(&self) -> Result<Vec<CellShape>, TriangulateError> {
        (1..).map(CellId).take(self.complex.n_cells(3).saturating_sub(1)).map(|c| self.cell(c)).collect()
    }

    /// A face: its triangles, and the edges of its loops.
    pub(crate) fn face(&self, face: FaceId) -> Result<CellShape, TriangulateError> {
        Ok(CellShape {
            name: face.to_string(),
            cell: CellRef { dim: 2, index: face.0 },
            mesh: self.triangles.mesh_of_faces(self.complex.points(), [(face, 1)])?,
            edges: self.segments(self.edges(face)),
        })
    }

    /// All faces.
    pub(crate) fn faces(&self) -> Result<Vec<CellShape>, TriangulateError> {
        (0..).map(FaceId).take(self.complex.n_cells(2)).map(|f| self.face(f)).collect()
    }

    /// All faces and their edges as one.
    fn whole(&self, name: &str) -> Result<CellShape, TriangulateError> {
        let faces = || (0..).map(FaceId).take(self.complex.n_cells(2));
        Ok(CellShape {
            name: name.to_owned(),
            cell: CellRef { dim: 3, index: 0 },
            mesh: self.triangles.mesh_of_faces(self.complex.points(), faces().map(|f| (f, 1)))?,
            edges: self.segments(faces().flat_map(|f| self.edges(f)).collect()),
        })
    }

    fn edges(&self, face: FaceId) -> Vec<EdgeId> {
        match self.arrangement {
            Some(arrangement) => arrangement.face_loops(face).flatten().map(|h| h.edge).collect(),
            None => {
                let column = self.complex.boundary(2).outer_view(face.index());
                column.iter().flat_map(|c| c.indices().iter().map(|&e| EdgeId(e))).collect()
            }
        }
    }

    /// The edges, each once, from end to end.
    fn segments(&self, mut edges: Vec<EdgeId>) -> Vec<[[f64; 3]; 2]> {
        edges.sort_unstable();
        edges.dedup();
        edges.into_iter().filter_map(|e| segment(self.complex, e)).collect()
    }
}

fn segment(complex: &ChainComplex, edge: EdgeId) -> Option<[[f64; 3]; 2]> {
    Some(complex.edge_ends(edge.index())?.map(|v| complex.points().xyz(v as usize)))
}

/// The cells of highest dimension of a model, embedded in space when it is of less: 3-cells, faces or edges.
pub(crate) fn model_cells(model: &Model) -> Result<Vec<CellShape>, CommandError> {
    let complex = complex_of(model)?;
    match complex.dim() {
        3 => {
            let shapes = Shapes::of_complex(&complex)?;
            Ok((0..)
                .map(CellId)
                .take(complex.n_cells(3))
                .map(|c| shapes.cell(c))
                .collect::<Result<_, _>>()?)
        }
        2 => Ok(Shapes::of_complex(&complex)?.faces()?),
        _ => Ok((0..).map(EdgeId).take(complex.n_cells(1)).map(|e| edge(&complex, e)).collect()),
    }
}

fn complex_of(model: &Model) -> Result<ChainComplex, SceneError> {
    let embedded = if model.points().dim() < 3 { Some(model.embedded(3)?) } else { None };
    Ok(ChainComplex::from_model(embedded.as_ref().unwrap_or(model))?)
}

/// A complex of dimension 2, its faces and edges as one.
pub(crate) fn complex_whole(name: &str, complex: &ChainComplex) -> Result<CellShape, TriangulateError> {
    Shapes::of_complex(complex)?.whole(name)
}

fn edge(complex: &ChainComplex, edge: EdgeId) -> CellShape {
    CellShape {
        name: edge.to_string(),
        cell: CellRef { dim: 1, index: edge.0 },
        mesh: TriangleMesh { points: Points::new(3), triangles: Vec::new() },
        edges: segment(complex, edge).into_iter().collect(),
    }
}

/// The faces of an input surface that bound it: their triangles and the edges of their loops.
pub(crate) fn surface(surface: &Surface, index: u32) -> Result<CellShape, TriangulateError> {
    Ok(surface_shape(surface, crate::mesh::of_surface(surface)?, CellRef { dim: 3, index }))
}

/// Each face of a surface by itself.
pub(crate) fn surface_faces(surface: &Surface) -> Result<Vec<CellShape>, TriangulateError> {
    let mut triangulator = lar_triangle::Triangulator::new();
    let mut face = |f: usize| {
        let mut triangles = Vec::new();
        triangulator.face(&surface.points, surface.face(f), &mut triangles)?;
        Ok(CellShape {
            name: format!("{} {}", surface.name, FaceId(f as u32)),
            cell: CellRef { dim: 2, index: f as u32 },
            mesh: TriangleMesh { points: surface.points.clone(), triangles },
            edges: segments(surface, sides(surface, f)),
        })
    };
    (0..surface.n_faces()).map(&mut face).collect()
}

/// The sides of the loops of a face, the smaller end first.
fn sides(surface: &Surface, f: usize) -> Vec<[u32; 2]> {
    let sides = |cycle: &[u32]| -> Vec<[u32; 2]> {
        let next = cycle.iter().skip(1).chain(cycle.first());
        cycle.iter().zip(next).map(|(&a, &b)| if a < b { [a, b] } else { [b, a] }).collect()
    };
    surface.face(f).flat_map(sides).collect()
}

fn segments(surface: &Surface, mut sides: Vec<[u32; 2]>) -> Vec<[[f64; 3]; 2]> {
    sides.sort_unstable();
    sides.dedup();
    sides.into_iter().map(|ends| ends.map(|v| surface.points.xyz(v as usize))).collect()
}
