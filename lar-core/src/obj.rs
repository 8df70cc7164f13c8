//! Wavefront OBJ files: polygonal surfaces in, polygons and triangles out.

mod read;
mod write;

pub use read::{ObjGrouping, parse_obj, read_obj};
pub(crate) use read::{is_utf16, parse};
pub(crate) use write::{write_face, write_vertices};

use crate::{FaceId, FileError, VertexId};
use std::path::PathBuf;

/// Why an OBJ file cannot be read or written. Errors in the text name the file and the line, counted from 1.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ObjError {
    /// The file could not be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file has no faces.
    #[error("{}: no faces", .file.display())]
    NoFaces {
        /// The file.
        file: PathBuf,
    },
    /// The text is UTF-16.
    #[error("{}:{line}: not UTF-8 text", .file.display())]
    NotUtf8 {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
    },
    /// A vertex has fewer than three coordinates: the line may be cut off.
    #[error("{}:{line}: a vertex of {found} coordinates where 3 are needed", .file.display())]
    ShortVertex {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// The number of coordinates.
        found: usize,
    },
    /// A coordinate is no number.
    #[error("{}:{line}: {value:?} is no number", .file.display())]
    NotANumber {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// What stands in its place.
        value: String,
    },
    /// A coordinate is infinite or NaN, or too large for `f64`.
    #[error("{}:{line}: coordinate {value} is not finite", .file.display())]
    NonFinite {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// The coordinate as written.
        value: String,
    },
    /// A corner of a face is not of the form v, v/vt, v//vn or v/vt/vn.
    #[error("{}:{line}: {value:?} is no corner of a face", .file.display())]
    NotACorner {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// The corner as written.
        value: String,
    },
    /// A face names a vertex that does not exist; indices count from 1, or from −1 backwards.
    #[error("{}:{line}: vertex {index} of {n_vertices}", .file.display())]
    VertexOutOfRange {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// The index as written.
        index: i64,
        /// For a positive index the vertices of the whole file, for a negative one those above the line.
        n_vertices: usize,
    },
    /// A face has fewer than three vertices.
    #[error("{}:{line}: a face of {found} vertices where 3 are needed", .file.display())]
    ShortFace {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// The number of its vertices.
        found: usize,
    },
    /// The file has more vertices than `u32` can number.
    #[error("{}:{line}: more than 2^32 - 1 vertices or corners", .file.display())]
    TooLarge {
        /// The file.
        file: PathBuf,
        /// The line at which the limit is passed.
        line: usize,
    },
    /// A face has holes, which a polygon of an OBJ file cannot have: triangulate first.
    #[error("face {face} has {loops} loops; a polygon in OBJ has one")]
    FaceWithHoles {
        /// The face.
        face: FaceId,
        /// The number of its loops.
        loops: usize,
    },
    /// Points must have two or three coordinates to be written.
    #[error("points of {dim} coordinates cannot be written as OBJ")]
    PointSize {
        /// Coordinates per point.
        dim: usize,
    },
    /// A coordinate to be written is infinite or not a number.
    #[error("coordinate {axis} of vertex {vertex} is {value}")]
    Coordinate {
        /// The vertex.
        vertex: VertexId,
        /// Which coordinate, from 0.
        axis: usize,
        /// Its value.
        value: f64,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {vertex} of {n_vertices}")]
    Triangle {
        /// Index of the triangle.
        triangle: usize,
        /// The vertex it names.
        vertex: u32,
        /// The number of vertices.
        n_vertices: usize,
    },
    /// A complex without 2-cells, or whose operators do not fit its points, has no polygons to write.
    #[error("a complex of dimension {dim} with {violations} violations of its laws cannot be written as OBJ")]
    NotPolygonal {
        /// Dimension of the complex.
        dim: usize,
        /// The number of violations that `validate` lists.
        violations: usize,
    },
}
