//! From vertex sets to oriented faces: what [`Model::to_surface`] and [`ChainComplex::from_model`] share.
//!
//! 1. The loop of each 2-cell: its 1-cells (those with both ends among its vertices) chained into a cycle, or
//!    the 2-cell itself when the model has no 1-cells.
//! 2. Orientation. With 3-cells: each 3-cell's faces are those whose vertices it has; they are oriented
//!    coherently and outward, and the signs of a face in its one or two 3-cells are added up. Without 3-cells,
//!    faces found by incidence are oriented coherently over edges of two faces, each closed component outward
//!    (in the plane: each face counter-clockwise); cyclic faces keep the orientation they came with.

use crate::incidence::contained_cells;
use crate::listing::first_few;
use crate::measure::{loop_area_2d, loop_cone_volume};
use crate::orient::{by_edge, edge_uses, orient};
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
    /// The edges of a 2-cell do not pass its vertices twice each: an edge is missing, or two vertices that are
    /// not neighbours are joined by a chord.
    #[error("{edges} edges of 2-cell {face} meet at its vertex {vertex} where 2 are needed: {}", reason(*.edges))]
    FaceNotLoop {
        /// The 2-cell.
        face: FaceId,
        /// One of its vertices.
        vertex: VertexId,
        /// How many of the 2-cell's edges end there.
        edges: usize,
    },
    /// The edges of a 2-cell make more than one cycle.
    #[error("the edges of 2-cell {face} make more than one cycle: vertex {vertex} is not on the first")]
    FaceManyLoops {
        /// The 2-cell.
        face: FaceId,
        /// The smallest vertex that is not on the cycle of the 2-cell's smallest vertex.
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
    /// One loop a face.
    pub(crate) loops: Cells,
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
    /// The loop of a 2-cell is the cycle of the 1-cells that have both ends in it; in a model without 1-cells
    /// each 2-cell is a loop already. With 3-cells, the coefficient of a face is the sum of its signs in the
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
        for (cycle, &coefficient) in faces.loops.iter().zip(&faces.coefficients) {
            surface.push_face([cycle], coefficient);
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
        let loops = if cyclic { self.cells(2).clone() } else { self.incident_loops()? };
        if !self.cells(3).is_empty() {
            self.check_spatial()?;
            return self.orient_by_cells(&loops);
        }
        let loops = if cyclic { loops } else { self.orient_coherently(&loops) };
        let coefficients = vec![1; loops.len()];
        Ok(OrientedFaces { loops, coefficients, cells: Cells::new(), cell_signs: Vec::new() })
    }

    fn incident_loops(&self) -> Result<Cells, ModelError> {
        let edges_of = contained_cells(self.cells(1), self.cells(2), self.points().len());
        let mut loops = Cells::with_capacity(edges_of.len(), edges_of.indices().len());
        for ((id, vertices), edges) in (0..).zip(self.cells(2).iter()).zip(edges_of.iter()) {
            let ends = edges.iter().map(|&e| [self.cells(1)[e as usize][0], self.cells(1)[e as usize][1]]);
            loops.push(&chain_loop(FaceId(id), vertices, ends)?);
        }
        Ok(loops)
    }

    fn orient_coherently(&self, loops: &Cells) -> Cells {
        let faces: Vec<&[u32]> = loops.iter().collect();
        match self.points().dim() {
            2 => signed(&faces, |f| if loop_area_2d(self.points(), faces[f]) < 0. { -1 } else { 1 }),
            3 => {
                let found = orient(&faces);
                let flip = self.inward_components(&faces, &found.signs, &found.component, &found.closed);
                signed(&faces, |f| {
                    if flip[found.component[f] as usize] { -found.signs[f] } else { found.signs[f] }
                })
            }
            _ => {
                let found = orient(&faces);
                signed(&faces, |f| found.signs[f])
            }
        }
    }

    /// Per component: whether it is closed and its volume negative.
    fn inward_components(
        &self,
        faces: &[&[u32]],
        signs: &[i8],
        component: &[u32],
        closed: &[bool],
    ) -> Vec<bool> {
        let mut apex = vec![None; closed.len()];
        let mut volume = vec![0.; closed.len()];
        for (f, cycle) in faces.iter().enumerate() {
            let c = component[f] as usize;
            let apex = *apex[c].get_or_insert(cycle[0]);
            volume[c] += f64::from(signs[f])
                * loop_cone_volume(self.points(), cycle, self.points().xyz(apex as usize));
        }
        closed.iter().zip(volume).map(|(&closed, volume)| closed && volume < 0.).collect()
    }

    fn orient_by_cells(&self, loops: &Cells) -> Result<OrientedFaces, ModelError> {
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
        let faces: Vec<&[u32]> = loops.iter().collect();
        let turned = signed(&faces, |f| if sums[f] < 0 { -1 } else { 1 });
        for (&f, sign) in cells.indices().iter().zip(&mut cell_signs) {
            *sign *= if sums[f as usize] < 0 { -1 } else { 1 };
        }
        let coefficients = sums.iter().map(|s| s.abs()).collect();
        Ok(OrientedFaces { loops: turned, coefficients, cells, cell_signs })
    }

    /// The signs that turn the faces of one 3-cell outward.
    fn outward_signs(&self, cell: CellId, faces: &[u32], loops: &Cells) -> Result<Vec<i8>, ModelError> {
        let cycles: Vec<&[u32]> = faces.iter().map(|&f| &loops[f as usize]).collect();
        for group in by_edge(&edge_uses((0..).zip(cycles.iter().copied()))) {
            if group.len() != 2 {
                let edge = group[0].ends.map(VertexId);
                return Err(ModelError::CellNotClosed { cell, edge, faces: group.len() });
            }
        }
        let found = orient(&cycles);
        if found.closed != [true] {
            return Err(ModelError::CellNotShell { cell, faces: faces.len() });
        }
        let apex = self.points().xyz(cycles[0][0] as usize);
        let cone =
            |(cycle, &sign): (&&[u32], &i8)| f64::from(sign) * loop_cone_volume(self.points(), cycle, apex);
        let volume: f64 = cycles.iter().zip(&found.signs).map(cone).sum();
        let outward = if volume < 0. { -1 } else { 1 };
        Ok(found.signs.iter().map(|sign| sign * outward).collect())
    }
}

/// The loops, those of negative sign reversed.
fn signed(loops: &[&[u32]], sign: impl Fn(usize) -> i8) -> Cells {
    let turned = |(f, cycle): (usize, &&[u32])| {
        let mut cycle = cycle.to_vec();
        if sign(f) < 0 {
            cycle.reverse();
        }
        cycle
    };
    loops.iter().enumerate().map(turned).collect()
}

/// The cycle that the edges make of all `vertices`, from the smallest vertex towards its smaller neighbour.
fn chain_loop(
    face: FaceId,
    vertices: &[u32],
    edges: impl Iterator<Item = [u32; 2]>,
) -> Result<Vec<u32>, ModelError> {
    let mut ends: Vec<[u32; 2]> = edges.flat_map(|[a, b]| [[a, b], [b, a]]).collect();
    ends.sort_unstable();
    ends.dedup();
    let neighbours = |v: u32| {
        let first = ends.partition_point(|e| e[0] < v);
        &ends[first..first + ends[first..].partition_point(|e| e[0] == v)]
    };
    let mut sorted = vertices.to_vec();
    sorted.sort_unstable();
    for &v in &sorted {
        let edges = neighbours(v).len();
        if edges != 2 {
            return Err(ModelError::FaceNotLoop { face, vertex: VertexId(v), edges });
        }
    }
    let start = sorted[0];
    let mut cycle = vec![start];
    let (mut previous, mut at) = (start, neighbours(start)[0][1]);
    while at != start {
        cycle.push(at);
        let [one, other] = [neighbours(at)[0][1], neighbours(at)[1][1]];
        (previous, at) = (at, if one == previous { other } else { one });
    }
    if cycle.len() < sorted.len() {
        let mut seen = cycle;
        seen.sort_unstable();
        let missing = sorted.into_iter().find(|v| seen.binary_search(v).is_err()).unwrap_or(start);
        return Err(ModelError::FaceManyLoops { face, vertex: VertexId(missing) });
    }
    Ok(cycle)
}
