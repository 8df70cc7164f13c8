//! Chain complexes of models: signed boundary operators from vertex sets.

use crate::complex::sign_columns;
use crate::face_edges::FaceLoops;
use crate::{Cells, ChainComplex, FaceId, Model, ModelError, Operator, VertexId};
use rustc_hash::FxHashMap;

impl ChainComplex {
    /// The chain complex of a model of dimension d ≤ 3, without exterior cell: points, and ∂1 … ∂d.
    ///
    /// Faces are oriented as in [`Model::to_surface`]; in the plane, faces found by incidence are
    /// counter-clockwise. An entry of ∂3 is +1 where the face's normal points out of the 3-cell. The 1-cells
    /// of a model without any are the sides of its cyclic faces in first-seen order. O(n log n).
    ///
    /// # Errors
    /// When the model is malformed, its dimension is above 3, or a cell is not bounded by those below; see
    /// [`ModelError`].
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
    /// assert_eq!((cube.dim(), cube.n_cells(2)), (3, 6));
    /// assert!((cube.boundary(2) * cube.boundary(3)).data().iter().all(|&x| x == 0));
    /// ```
    #[doc(alias = "chaincomplex")]
    #[doc(alias = "lar2cop")]
    pub fn from_model(model: &Model) -> Result<Self, ModelError> {
        let dim = model.dim();
        if dim > 3 {
            return Err(ModelError::DimensionTooHigh { dim });
        }
        if dim < 2 {
            let boundaries = if dim == 1 { vec![model.signed_boundary_1()?] } else { Vec::new() };
            model.check_well_formed()?;
            return Ok(Self::new(model.points().clone(), boundaries));
        }
        let faces = model.oriented_faces()?;
        let edges = if model.cells(1).is_empty() { &sides(faces.loops.loops()) } else { model.cells(1) };
        let mut boundaries =
            vec![edge_columns(model.points().len(), edges), face_columns(edges, &faces.loops)?];
        if dim == 3 {
            let mut signs = faces.cell_signs.iter().copied();
            let columns =
                faces.cells.iter().map(|fs| fs.iter().copied().zip(signs.by_ref()).collect::<Vec<_>>());
            boundaries.push(sign_columns(faces.loops.len(), columns));
        }
        Ok(Self::new(model.points().clone(), boundaries))
    }
}

impl Model {
    pub(crate) fn signed_boundary_1(&self) -> Result<Operator, ModelError> {
        self.check_well_formed()?;
        Ok(edge_columns(self.points().len(), self.cells(1)))
    }

    pub(crate) fn signed_boundary_2(&self) -> Result<Operator, ModelError> {
        let faces = self.oriented_faces()?;
        let edges = if self.cells(1).is_empty() { &sides(faces.loops.loops()) } else { self.cells(1) };
        face_columns(edges, &faces.loops)
    }
}

fn edge_columns(n_vertices: usize, edges: &Cells) -> Operator {
    sign_columns(n_vertices, edges.iter().map(|e| [(e[0].min(e[1]), -1), (e[0].max(e[1]), 1)]))
}

/// The distinct sides of the loops in first-seen order.
pub(crate) fn sides(loops: &Cells) -> Cells {
    let mut seen = FxHashMap::default();
    let mut edges = Cells::new();
    for cycle in loops.iter() {
        for (i, &a) in cycle.iter().enumerate() {
            let b = cycle[(i + 1) % cycle.len()];
            let ends = [a.min(b), a.max(b)];
            seen.entry(ends).or_insert_with(|| edges.push(&ends));
        }
    }
    edges
}

/// ∂2: the sides of each face's loops, +1 where a loop runs from the smaller vertex to the larger. Of equal
/// edges the first counts.
fn face_columns(edges: &Cells, faces: &FaceLoops) -> Result<Operator, ModelError> {
    let mut edge_of = FxHashMap::default();
    for (id, e) in (0_u32..).zip(edges.iter()) {
        edge_of.entry([e[0].min(e[1]), e[0].max(e[1])]).or_insert(id);
    }
    let mut columns: Vec<Vec<(u32, i8)>> = vec![Vec::new(); faces.len()];
    for (face, cycle) in faces.pairs() {
        let column = &mut columns[face as usize];
        for (i, &a) in cycle.iter().enumerate() {
            let b = cycle[(i + 1) % cycle.len()];
            let Some(&edge) = edge_of.get(&[a.min(b), a.max(b)]) else {
                return Err(ModelError::MissingEdge { face: FaceId(face), edge: [VertexId(a), VertexId(b)] });
            };
            column.push((edge, if a < b { 1 } else { -1 }));
        }
    }
    Ok(sign_columns(edges.len(), columns.into_iter()))
}
