//! Why a triangulation may be refused: only for malformed input, never for bad positions.

use lar_core::{CellId, EdgeId, FaceId, VertexId};

/// A malformed input of this crate. Positions of polygons are never refused: whatever they are, a polygon has a
/// combinatorial triangulation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TriangulateError {
    /// Points with a number of coordinates that the operation does not take.
    #[error("points have {found} coordinates, the triangulation takes {expected}")]
    Dimension {
        /// Coordinates that the points have.
        found: usize,
        /// Coordinates that the operation takes.
        expected: &'static str,
    },
    /// An index that names no point.
    #[error("{vertex} is named, but there are only {points} points")]
    NoSuchVertex {
        /// The index.
        vertex: VertexId,
        /// Number of points.
        points: usize,
    },
    /// A loop that bounds nothing.
    #[error("loop {index} has {corners} corners, a loop needs 3")]
    ShortLoop {
        /// The loop's place in its face, 0 for the outer one.
        index: usize,
        /// Its number of corners.
        corners: usize,
    },
    /// A coordinate that is not a finite number, where positions decide what is connected.
    #[error("{vertex} has the coordinate {value}")]
    NotFinite {
        /// The point.
        vertex: VertexId,
        /// The coordinate.
        value: f64,
    },
    /// Two edges of a planar drawing cross, or one passes through a vertex.
    #[error("{edge} ({from} to {to}) crosses another edge or passes through a vertex")]
    CrossingEdge {
        /// The edge that could not be added.
        edge: EdgeId,
        /// Its first end.
        from: VertexId,
        /// Its second end.
        to: VertexId,
    },
    /// The edges of a planar drawing do not close.
    #[error("{vertex} has {degree} edges, a closed boundary has an even number")]
    OpenBoundary {
        /// The vertex.
        vertex: VertexId,
        /// The number of edges at it, those with coincident ends counted once per end.
        degree: usize,
    },
    /// A complex without cells of the wanted dimension.
    #[error("the complex has dimension {dim}, {needed} is needed")]
    ComplexDimension {
        /// Its dimension.
        dim: usize,
        /// The dimension that is needed.
        needed: usize,
    },
    /// Two operators of a complex that do not fit.
    #[error("boundary {p} has {rows} rows, there are {cells} cells of dimension {}", p - 1)]
    Shape {
        /// Dimension of the operator's columns.
        p: usize,
        /// Its rows.
        rows: usize,
        /// The cells below.
        cells: usize,
    },
    /// A column of ∂1 that is not one −1 and one +1.
    #[error("{edge}: its column of boundary 1 has the entries {entries:?}, not one -1 and one +1")]
    BadEdge {
        /// The edge.
        edge: EdgeId,
        /// Row and value of each of its entries.
        entries: Vec<(u32, i8)>,
    },
    /// A face whose boundary is not closed.
    #[error("{face}: its boundary enters {vertex} {entering} times and leaves it {leaving} times")]
    OpenFace {
        /// The face.
        face: FaceId,
        /// A vertex where it is open.
        vertex: VertexId,
        /// Edges that end there.
        entering: usize,
        /// Edges that begin there.
        leaving: usize,
    },
    /// A face that does not exist.
    #[error("{face} is named, but there are only {faces} faces")]
    NoSuchFace {
        /// The face.
        face: FaceId,
        /// Number of faces.
        faces: usize,
    },
    /// A cell that does not exist.
    #[error("{cell} is named, but there are only {cells} cells")]
    NoSuchCell {
        /// The cell.
        cell: CellId,
        /// Number of cells.
        cells: usize,
    },
    /// More triangles, corners or points than 32-bit indices can name.
    #[error("{count} items are more than 32-bit indices can name")]
    TooMany {
        /// How many there would be.
        count: usize,
    },
}
