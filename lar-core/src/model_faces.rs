//! From vertex sets to oriented faces: what [`Model::to_surface`] and [`ChainComplex::from_model`] share.
//!
//! 1. The loops of each 2-cell: its 1-cells (those with both ends among its vertices, chords left out) chained
//!    into an outer cycle and holes, or the 2-cell itself when the model has no 1-cells.
//! 2. Orientation. With 3-cells: each 3-cell's faces are those whose vertices it has; they are oriented
//!    coherently and outward, and the signs of a face in its one or two 3-cells are added up. Without 3-cells,
//!    faces found by incidence are oriented coherently over edges of two faces, each closed component outward
//!    (in the plane: each face counter-clockwise); cyclic faces keep the orientation they came with.

use crate::face_edges::{FaceLoops, loops_of_face, nest};
use crate::incidence::contained_cells;
use crate::listing::first_few;
use crate::measure::{loop_area_2d, loop_cone_volume};
use crate::orient::{Orientation, by_edge, edge_uses, orient};
use crate::{CellId, Cells, FaceId, Model, ModelViolation, Surface, VertexId};

#[cfg(doc)]
use crate::ChainComplex;

/// Why a model cannot become a surface or a chain complex.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The model is malformed; all violations are listed.
    #[error("malformed model: {}", first_few(.0))]
    Malformed(Vec<ModelViolation>),
    /// A surface or a solid needs points of three coordinates.
    #[error("points of {dim} coordinates where 3 are needed")]
    NotSpatial {
        /// Coordinates per point.
        dim: usize,
    },
    /// The model has no 2-cells.
    #[error("the model has no 2-cells")]
    NoFaces,
    /// Chain complexes are built for cells of dimension 0..=3.
    #[error("cells of dimension {dim}; chain complexes are built up to dimension 3")]
    DimensionTooHigh {
        /// Dimension of the highest cells.
        dim: usize,
    },
    /// The edges of a 2-cell do not pass its vertices twice each: an edge is missing, or there are so many
    /// chords that which edges are sides is not settled by vertices with two edges.
    #[error("{edges} edges of 2-cell {face} meet at its vertex {vertex} where 2 are needed: {}", reason(*.edges))]
    FaceNotLoop {
        /// The 2-cell.
        face: FaceId,
        /// One of its vertices.
        vertex: VertexId,
        /// How many of the 2-cell's edges end there.
        edges: usize,
    },
    /// The edges of a 2-cell make several cycles that are no outer loop with holes: one lies outside the
    /// largest or inside another hole, or the points are not in the plane or in 3-space.
    #[error("the edges of 2-cell {face} make several cycles, and the one of vertex {vertex} is no hole")]
    FaceManyLoops {
        /// The 2-cell.
        face: FaceId,
        /// The smallest vertex of the cycle.
        vertex: VertexId,
    },
    /// An edge inside a 3-cell has not exactly two of the 3-cell's faces.
    #[error("edge {}-{} has {faces} faces in 3-cell {cell} where 2 are needed", .edge[0], .edge[1])]
    CellNotClosed {
        /// The 3-cell.
        cell: CellId,
        /// The ends of the edge.
        edge: [VertexId; 2],
        /// How many of the 3-cell's faces use it.
        faces: usize,
    },
    /// The faces of a 3-cell make no single orientable closed surface.
    #[error("the {faces} faces of 3-cell {cell} make no single closed, orientable surface")]
    CellNotShell {
        /// The 3-cell.
        cell: CellId,
        /// The number of its faces.
        faces: usize,
    },
    /// A 2-cell lies in the boundary of more than two 3-cells.
    #[error("2-cell {face} belongs to {cells} 3-cells; at most 2 can meet in a face")]
    FaceInManyCells {
        /// The 2-cell.
        face: FaceId,
        /// The number of its 3-cells.
        cells: usize,
    },
    /// The ends of a cyclic face's side are not the ends of any 1-cell.
    #[error("no 1-cell joins the consecutive vertices {} and {} of 2-cell {face}", .edge[0], .edge[1])]
    MissingEdge {
        /// The 2-cell.
        face: FaceId,
        /// The ends.
        edge: [VertexId; 2],
    },
    /// A face runs along one edge more than once in one direction.
    #[error("2-cell {face} runs {times} times from vertex {} to vertex {}", .side[0], .side[1])]
    RepeatedSide {
        /// The 2-cell.
        face: FaceId,
        /// The edge in the direction of the surplus.
        side: [VertexId; 2],
        /// How many times more often in this direction than back.
        times: u32,
    },
}

fn reason(edges: usize) -> &'static str {
    if edges < 2 { "an edge is missing" } else { "it has a chord" }
}

/// The faces of a model as oriented loops.
pub(crate) struct OrientedFaces {
    /// The loops of each face, the outer one first.
    pub(crate) loops: FaceLoops,
    /// The sum of each face's signs in the boundaries of the 3-cells; 1 when there are none.
    pub(crate) coefficients: Vec<i8>,
    /// The faces of each 3-cell.
    pub(crate) cells: Cells,
    /// The sign of each of them, +1 where the loop is outward: parallel to `cells.indices()`.
    pub(crate) cell_signs: Vec<i8>,
}

impl Model {
    /// The polygonal surface of a model in 3-space, for an arrangement.
    ///
    /// The loops of a 2-cell are the cycles of the 1-cells that have both ends in it, chords left out: an outer
    /// loop and holes. In a model without 1-cells each 2-cell is a loop already. With 3-cells, the coefficient of a face is the sum of its signs in the
    /// boundaries of the 3-cells: +1 for a face of one 3-cell, turned outward, and 0 for a wall between two.
    /// Without them all coefficients are +1; faces found by incidence are oriented coherently, each closed
    /// component outward, and cyclic faces keep their orientation.
    ///
    /// O(n log n) in the size of the model.
    ///
    /// # Errors
    /// When the model is malformed, not in 3-space, has no faces, or its faces or 3-cells are not bounded by
    /// the cells one dimension below; the cell is named.
    ///
    /// ```
    /// let surface = lar_core::cuboid_grid(&[2, 1, 1]).to_surface("bar").unwrap();
    /// assert_eq!(surface.n_faces(), 11);
    /// assert_eq!((0..11).filter(|&f| surface.coefficient(f) == 0).count(), 1);
    /// assert!(surface.boundary_edges().is_empty());
    /// ```
    pub fn to_surface(&self, name: impl Into<String>) -> Result<Surface, ModelError> {
        self.check_spatial()?;
        if self.cells(2).is_empty() {
            return Err(ModelError::NoFaces);
        }
        let faces = self.oriented_faces()?;
        let mut surface = Surface::new(name, self.points().clone());
        for (f, &coefficient) in (0..).zip(&faces.coefficients) {
            surface.push_face(faces.loops.face(f), coefficient);
        }
        Ok(surface)
    }

    pub(crate) fn check_well_formed(&self) -> Result<(), ModelError> {
        let violations = self.validate();
        if violations.is_empty() { Ok(()) } else { Err(ModelError::Malformed(violations)) }
    }

    fn check_spatial(&self) -> Result<(), ModelError> {
        let dim = self.points().dim();
        if dim == 3 { Ok(()) } else { Err(ModelError::NotSpatial { dim }) }
    }

    pub(crate) fn oriented_faces(&self) -> Result<OrientedFaces, ModelError> {
        self.check_well_formed()?;
        let cyclic = self.cells(1).is_empty();
        let loops = if cyclic { FaceLoops::single(self.cells(2).clone()) } else { self.incident_loops()? };
        if !self.cells(3).is_empty() {
            self.check_spatial()?;
            return self.orient_by_cells(&loops);
        }
        let loops = if cyclic { loops } else { self.orient_coherently(&loops) };
        let coefficients = vec![1; loops.len()];
        Ok(OrientedFaces { loops, coefficients, cells: Cells::new(), cell_signs: Vec::new() })
    }

    fn incident_loops(&self) -> Result<FaceLoops, ModelError> {
        let edges_of = contained_cells(self.cells(1), self.cells(2), self.points().len());
        let mut faces = FaceLoops::new();
        for ((id, vertices), edges) in (0..).zip(self.cells(2).iter()).zip(edges_of.iter()) {
            let ends = edges.iter().map(|&e| [self.cells(1)[e as usize][0], self.cells(1)[e as usize][1]]);
            let loops = loops_of_face(FaceId(id), vertices, ends)?;
            faces.push(&nest(FaceId(id), self.points(), loops)?);
        }
        Ok(faces)
    }

    fn orient_coherently(&self, faces: &FaceLoops) -> FaceLoops {
        if self.points().dim() == 2 {
            let mut areas = vec![0.; faces.len()];
            for (f, cycle) in faces.pairs() {
                areas[f as usize] += loop_area_2d(self.points(), cycle);
            }
            return faces.signed(|f| if areas[f] < 0. { -1 } else { 1 });
        }
        let found = orient(faces.len(), faces.pairs());
        if self.points().dim() != 3 {
            return faces.signed(|f| found.signs[f]);
        }
        let flip = self.inward_components(faces, &found);
        faces.signed(|f| if flip[found.component[f] as usize] { -found.signs[f] } else { found.signs[f] })
    }

    /// Per component: whether it is closed and its volume negative.
    fn inward_components(&self, faces: &FaceLoops, found: &Orientation) -> Vec<bool> {
        let mut apex = vec![None; found.closed.len()];
        let mut volume = vec![0.; found.closed.len()];
        for (f, cycle) in faces.pairs() {
            let c = found.component[f as usize] as usize;
            let apex = *apex[c].get_or_insert(cycle[0]);
            volume[c] += f64::from(found.signs[f as usize])
                * loop_cone_volume(self.points(), cycle, self.points().xyz(apex as usize));
        }
        found.closed.iter().zip(volume).map(|(&closed, volume)| closed && volume < 0.).collect()
    }

    fn orient_by_cells(&self, loops: &FaceLoops) -> Result<OrientedFaces, ModelError> {
        let cells = contained_cells(self.cells(2), self.cells(3), self.points().len());
        let mut cell_signs = Vec::with_capacity(cells.indices().len());
        for (cell, faces) in (0..).zip(cells.iter()) {
            cell_signs.extend(self.outward_signs(CellId(cell), faces, loops)?);
        }
        let mut uses = vec![0_usize; loops.len()];
        let mut sums = vec![0_i8; loops.len()];
        for (&f, &sign) in cells.indices().iter().zip(&cell_signs) {
            let f = f as usize;
            uses[f] += 1;
            if uses[f] <= 2 {
                sums[f] += sign;
            }
        }
        if let Some((face, cells)) = (0..).zip(uses).find(|&(_, n)| n > 2) {
            return Err(ModelError::FaceInManyCells { face: FaceId(face), cells });
        }
        let turned = loops.signed(|f| if sums[f] < 0 { -1 } else { 1 });
        for (&f, sign) in cells.indices().iter().zip(&mut cell_signs) {
            *sign *= if sums[f as usize] < 0 { -1 } else { 1 };
        }
        let coefficients = sums.iter().map(|s| s.abs()).collect();
        Ok(OrientedFaces { loops: turned, coefficients, cells, cell_signs })
    }

    /// The signs that turn the faces of one 3-cell outward.
    fn outward_signs(&self, cell: CellId, faces: &[u32], loops: &FaceLoops) -> Result<Vec<i8>, ModelError> {
        let cycles = || (0..).zip(faces).flat_map(|(i, &f)| loops.face(f).map(move |cycle| (i, cycle)));
        for group in by_edge(&edge_uses(cycles())) {
            if group.len() != 2 {
                let edge = group[0].ends.map(VertexId);
                return Err(ModelError::CellNotClosed { cell, edge, faces: group.len() });
            }
        }
        let found = orient(faces.len(), cycles());
        if found.closed != [true] {
            return Err(ModelError::CellNotShell { cell, faces: faces.len() });
        }
        let apex = cycles().next().map_or([0.; 3], |(_, cycle)| self.points().xyz(cycle[0] as usize));
        let cone = |(i, cycle): (u32, &[u32])| {
            f64::from(found.signs[i as usize]) * loop_cone_volume(self.points(), cycle, apex)
        };
        let volume: f64 = cycles().map(cone).sum();
        let outward = if volume < 0. { -1 } else { 1 };
        Ok(found.signs.iter().map(|sign| sign * outward).collect())
    }
}
