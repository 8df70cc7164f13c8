//! The result: a chain complex with everything that is known of its cells.

use crate::grid::Grid;
use crate::kernel::{Geometry, Vertex, VertexDef};
use crate::soup::{Parent, Parents};
use crate::stats::Stats;
use crate::winding::{Closure, Windings};
use lar_core::{CellId, Cells, ChainComplex, EdgeId, ExactPoints, FaceId, Operator, VertexId};
use sprs::CsMatI;

/// The partition of space that some surfaces generate.
///
/// Conventions: ∂1's columns hold −1 at the smaller vertex and +1 at the larger; face loops turn counter-clockwise
/// seen from the tip of the normal, holes clockwise; column 0 of ∂3 is the exterior cell; a cell's column holds +1
/// where the face's normal points out of the cell; the row of a *dangling* face (the same cell on both sides) is
/// empty.
#[derive(Debug)]
pub struct Arrangement {
    pub(crate) complex: ChainComplex,
    /// Half-edges (2 · edge, + 1 against its direction) of each loop.
    pub(crate) loops: Cells,
    pub(crate) face_loops: Vec<u32>,
    pub(crate) rings: Cells,
    /// Cells in front and behind of each face.
    pub(crate) cells_of_face: Vec<[u32; 2]>,
    pub(crate) shells_of_face: Vec<[u32; 2]>,
    pub(crate) n_shells: u32,
    pub(crate) parents: FaceParents,
    /// A facet with the plane and orientation of each face.
    pub(crate) facet_of_face: Vec<u32>,
    /// Faces with equal numbers are pieces of one polygon that is meant to be planar.
    pub(crate) plane_of_face: Vec<u32>,
    pub(crate) windings: Windings,
    pub(crate) solids: Vec<SolidInfo>,
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) geometry: Geometry,
    pub(crate) grid: Grid,
    /// How far, in grid steps, corners may lie from the plane of their face.
    pub(crate) bend: f64,
    pub(crate) stats: Stats,
}

/// The parents of the faces.
#[derive(Debug)]
pub(crate) struct FaceParents {
    pub all: Parents,
    /// How many of them the first piece of each face has, which come first: the ones that a path across it crosses. Empty when
    /// these are all.
    pub of_first_pieces: Vec<u32>,
}

impl FaceParents {
    /// Those that a path across a face crosses.
    pub(crate) fn crossed(&self, face: usize) -> &[Parent] {
        let all = self.all.of(face);
        self.of_first_pieces.get(face).map_or(all, |&n| &all[..n as usize])
    }
}

/// What the arrangement remembers of an input surface.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SolidInfo {
    pub name: String,
    /// Coefficient of each face in the boundary of the solid.
    pub coefficients: Vec<i8>,
}

/// What a vertex is by definition; its position follows from that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum VertexKind {
    /// A point of the input, on the grid.
    Input,
    /// The intersection of an input edge with the plane of a face, or with another edge of its plane.
    EdgeCrossing,
    /// The intersection of the planes of three faces.
    PlaneCrossing,
}

/// A directed edge of a face's loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HalfEdge {
    /// The edge.
    pub edge: EdgeId,
    /// Whether the loop runs against the edge's direction (from its larger vertex to its smaller).
    pub reversed: bool,
}

impl HalfEdge {
    pub(crate) fn from_code(code: u32) -> Self {
        Self { edge: EdgeId(code / 2), reversed: code % 2 == 1 }
    }
}

impl Arrangement {
    /// Vertices and the operators ∂1, ∂2, ∂3.
    #[must_use]
    pub fn complex(&self) -> &ChainComplex {
        &self.complex
    }

    /// Number of vertices.
    #[must_use]
    pub fn n_vertices(&self) -> usize {
        self.complex.n_cells(0)
    }

    /// Number of edges.
    #[must_use]
    pub fn n_edges(&self) -> usize {
        self.complex.n_cells(1)
    }

    /// Number of faces.
    #[must_use]
    pub fn n_faces(&self) -> usize {
        self.cells_of_face.len()
    }

    /// Number of 3-cells, the exterior included.
    #[must_use]
    pub fn n_cells(&self) -> usize {
        self.windings.n_cells()
    }

    /// Number of shells: closed 2-cycles of face sides, each a connected part of the boundary of one cell.
    #[must_use]
    pub fn n_shells(&self) -> usize {
        self.n_shells as usize
    }

    /// Number of loops of all faces.
    #[must_use]
    pub fn n_loops(&self) -> usize {
        self.loops.len()
    }

    /// The loops of a face, the outer one first, as directed edges. An edge that runs into a face and ends there
    /// stands in a loop twice, once in each direction.
    pub fn face_loops(
        &self,
        face: FaceId,
    ) -> impl ExactSizeIterator<Item = impl Iterator<Item = HalfEdge> + '_> + '_ {
        self.loop_range(face).map(|l| self.loops[l].iter().map(|&h| HalfEdge::from_code(h)))
    }

    pub(crate) fn loop_range(&self, face: FaceId) -> std::ops::Range<usize> {
        self.face_loops[face.index()] as usize..self.face_loops[face.index() + 1] as usize
    }

    /// The vertices of a face's loops, in order.
    pub fn face_vertices(&self, face: FaceId) -> impl ExactSizeIterator<Item = Vec<u32>> + '_ {
        self.loop_range(face).map(|l| self.loops[l].iter().map(|&h| self.tail(h)).collect())
    }

    /// First vertex of a half-edge.
    pub(crate) fn tail(&self, h: u32) -> u32 {
        let start = 2 * (h / 2) as usize;
        // Columns of ∂1 hold the smaller vertex first.
        self.complex.boundary(1).indices()[start + (h % 2) as usize]
    }

    /// What a vertex is by definition.
    #[must_use]
    pub fn vertex_kind(&self, vertex: VertexId) -> VertexKind {
        let vertex = &self.vertices[vertex.index()];
        match vertex.def {
            VertexDef::Point(_) => VertexKind::Input,
            _ if vertex.is_on_edge => VertexKind::EdgeCrossing,
            _ => VertexKind::PlaneCrossing,
        }
    }

    /// The exact positions of the vertices, of which those of [`complex`](Self::complex) are the correctly rounded ones.
    /// O(vertices).
    ///
    /// ```
    /// let simplex = lar_core::simplex(3).to_surface("simplex")?;
    /// let exact = lar_arrangement::arrange(&[simplex])?.exact_points();
    /// assert_eq!(exact.points[1][3], "1");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn exact_points(&self) -> ExactPoints {
        ExactPoints {
            step: self.grid.step(),
            origin: self.grid.origin(),
            points: self.vertices.iter().map(|v| self.geometry.homogeneous_point(v)).collect(),
        }
    }

    /// The unit normal of a face's exact plane, rounded.
    #[must_use]
    pub fn normal(&self, face: FaceId) -> [f64; 3] {
        let normal = self.geometry.normal(self.facet_of_face[face.index()]);
        let length = normal.iter().fold(0.0, |length: f64, x| length.hypot(*x));
        normal.map(|x| x / length)
    }

    /// The ends of an edge, the smaller first.
    #[must_use]
    pub fn edge(&self, edge: EdgeId) -> [VertexId; 2] {
        [0, 1].map(|side| VertexId(self.tail(2 * edge.0 + side)))
    }

    /// The cells in front of a face (where its normal points) and behind it.
    #[must_use]
    pub fn cells_of_face(&self, face: FaceId) -> [CellId; 2] {
        self.cells_of_face[face.index()].map(CellId)
    }

    /// The shells on the two sides of a face, in front and behind.
    #[must_use]
    pub fn shells_of_face(&self, face: FaceId) -> [u32; 2] {
        self.shells_of_face[face.index()]
    }

    /// Faces with the same cell on both sides: open sheets. O(faces).
    pub fn dangling_faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        (0..).map(FaceId).zip(&self.cells_of_face).filter(|(_, [front, back])| front == back).map(|(f, _)| f)
    }

    /// The input faces that a face is a piece of, with the sign of its orientation relative to theirs. A face merged
    /// of coplanar pieces ([`Merge::Coplanar`](crate::Merge)) has the parents of all of them.
    #[must_use]
    pub fn parents(&self, face: FaceId) -> &[Parent] {
        self.parents.all.of(face.index())
    }

    /// The input faces that a path across a face passes at one point of it: its parents, or those of one of the pieces
    /// that it is merged of. The solids crossed, and how, are the same everywhere in a face.
    #[must_use]
    pub fn crossed(&self, face: FaceId) -> &[Parent] {
        self.parents.crossed(face.index())
    }

    /// Q for one input surface: rows its faces, columns the faces of the arrangement, entry ±1 where the latter is
    /// a piece of the former, by relative orientation (Paoluzzi 2019, §4.3); or the former of the latter, when it is merged.
    /// O(parents of all faces).
    #[must_use]
    pub fn provenance(&self, solid: usize) -> Operator {
        let (mut offsets, mut rows, mut signs) = (vec![0u32], Vec::new(), Vec::new());
        for face in 0..self.n_faces() as u32 {
            let mut column: Vec<(u32, i8)> = self
                .parents(FaceId(face))
                .iter()
                .filter(|p| p.solid as usize == solid)
                .map(|p| (p.face, p.sign))
                .collect();
            column.sort_unstable();
            column.dedup_by_key(|entry| entry.0);
            rows.extend(column.iter().map(|c| c.0));
            signs.extend(column.iter().map(|c| c.1));
            offsets.push(rows.len() as u32);
        }
        CsMatI::new_csc((self.solids[solid].coefficients.len(), self.n_faces()), offsets, rows, signs)
    }

    /// The faces around an edge, counter-clockwise seen from the tip of its direction; the flag says whether the
    /// face's loop runs against the edge.
    pub fn faces_around(&self, edge: EdgeId) -> impl ExactSizeIterator<Item = (FaceId, bool)> + '_ {
        self.rings[edge.index()].iter().map(|&entry| (FaceId(entry / 2), entry % 2 == 1))
    }

    /// Number of input surfaces.
    #[must_use]
    pub fn n_solids(&self) -> usize {
        self.solids.len()
    }

    /// Name of an input surface.
    #[must_use]
    pub fn solid_name(&self, solid: usize) -> &str {
        &self.solids[solid].name
    }

    /// Whether an input surface bounds a solid.
    #[must_use]
    pub fn closure(&self, solid: usize) -> Closure {
        self.windings.closure[solid]
    }

    /// The winding number of a solid in a cell (its parity for unoriented solids, 0 for open surfaces).
    /// O(log solids around the cell).
    #[must_use]
    pub fn winding(&self, cell: CellId, solid: usize) -> i32 {
        let row = self.windings.of_cell(cell.index());
        row.binary_search_by_key(&(solid as u32), |e| e.0).map_or(0, |i| row[i].1)
    }

    /// Counts and times of the computation.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// Edges where the surface of a solid is open. Empty for closed surfaces. O(size of the faces).
    #[must_use]
    pub fn open_edges(&self, solid: usize) -> Vec<EdgeId> {
        let mut uses = vec![0i32; self.n_edges()];
        for face in 0..self.n_faces() {
            let odd = self
                .crossed(FaceId(face as u32))
                .iter()
                .filter(|p| p.solid as usize == solid && self.is_boundary(p))
                .count() as i32;
            for l in self.loop_range(FaceId(face as u32)) {
                self.loops[l].iter().for_each(|&h| uses[(h / 2) as usize] += odd);
            }
        }
        (0..).zip(uses).filter(|(_, n)| n % 2 != 0).map(|(e, _)| EdgeId(e)).collect()
    }

    fn is_boundary(&self, parent: &Parent) -> bool {
        self.solids[parent.solid as usize].coefficients[parent.face as usize] % 2 != 0
    }
}
