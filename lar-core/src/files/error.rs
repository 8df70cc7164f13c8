//! What can be wrong with a file of surfaces or segments, and where.

use crate::{FileError, ObjError, VertexId};
use std::fmt;
use std::path::PathBuf;

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line of a text, counted from 1.
    Line(u64),
    /// A byte, counted from 0.
    Byte(u64),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// What is wrong at a place of a file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file ends too early.
    #[error("the file ends where {expected} is needed")]
    Ends {
        /// What is missing.
        expected: &'static str,
    },
    /// The text is UTF-16.
    #[error("not UTF-8 text")]
    NotUtf8,
    /// Something else stands where a word or number is needed.
    #[error("{found:?} where {expected} is needed")]
    Expected {
        /// What is needed.
        expected: &'static str,
        /// What stands there, empty at the end of a line.
        found: String,
    },
    /// A form of the format that is not read.
    #[error("{what} is not supported: {found:?}")]
    Unsupported {
        /// Which part of the format.
        what: &'static str,
        /// What stands there.
        found: String,
    },
    /// A coordinate is infinite or not a number, or too large for `f64`.
    #[error("coordinate {value} is not finite")]
    NonFinite {
        /// The coordinate.
        value: String,
    },
    /// A line holds another number of numbers than it should.
    #[error("{found} numbers where the {needed} of {what} are needed")]
    NumberCount {
        /// How many stand there.
        found: usize,
        /// How many are needed.
        needed: usize,
        /// What they make.
        what: &'static str,
    },
    /// The number of items announced does not fit the length of the file.
    #[error("{announced} {what} are announced, which takes {needed} bytes, but the file has {found}")]
    Length {
        /// What is counted.
        what: &'static str,
        /// How many are announced.
        announced: u64,
        /// The bytes that they take.
        needed: u64,
        /// The bytes that are there.
        found: u64,
    },
    /// A face names a vertex that does not exist.
    #[error("vertex {index} of {n_vertices}")]
    VertexOutOfRange {
        /// The index as written.
        index: i64,
        /// The number of vertices.
        n_vertices: usize,
    },
    /// A face has fewer than three vertices, or a facet of an STL file not exactly three.
    #[error("a face of {found} vertices where 3 are needed")]
    FaceSize {
        /// The number of its vertices.
        found: i64,
    },
    /// The file has no faces.
    #[error("no faces")]
    NoFaces,
    /// More vertices or corners than `u32` can number.
    #[error("more than 2^32 - 1 vertices or corners")]
    TooLarge,
    /// A line so long that it is none.
    #[error("a line of more than {limit} bytes")]
    LongLine {
        /// The most that is read.
        limit: u64,
    },
}

/// Why a file of surfaces or segments cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFileError {
    /// The file could not be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// An OBJ file is malformed.
    #[error(transparent)]
    Obj(#[from] ObjError),
    /// The content is malformed.
    #[error("{}: {place}: {problem}", .file.display())]
    Malformed {
        /// The file.
        file: PathBuf,
        /// Where in the file.
        place: Place,
        /// What is wrong.
        problem: Problem,
    },
    /// Neither the content nor the extension says which format it is.
    #[error("{}: extension {extension:?} is none of obj, stl, ply, off, gltf, glb", .file.display())]
    UnknownFormat {
        /// The file.
        file: PathBuf,
        /// Its extension, empty when it has none.
        extension: String,
    },
    /// A format that is written, but not read.
    #[error("{}: glTF files are written, not read", .file.display())]
    WriteOnly {
        /// The file.
        file: PathBuf,
    },
    /// Points must have two or three coordinates to be written.
    #[error("points of {dim} coordinates cannot be written as a surface")]
    PointSize {
        /// Coordinates per point.
        dim: usize,
    },
    /// A coordinate is infinite or not a number, or too large for the 32-bit numbers of the format.
    #[error("coordinate {axis} of vertex {vertex} is {value}, which the format cannot hold")]
    Coordinate {
        /// The vertex.
        vertex: VertexId,
        /// Which coordinate, from 0.
        axis: usize,
        /// Its value.
        value: f64,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex} of {n_vertices}")]
    VertexOutOfRange {
        /// Index of the face.
        face: usize,
        /// The vertex that it names.
        vertex: u32,
        /// The number of vertices.
        n_vertices: usize,
    },
    /// A face has holes, or is no triangle where the format has only triangles: triangulate first.
    #[error(
        "face {face} has {loops} loops of {vertices} vertices in all; the format takes {}",
        if *.triangles { "triangles" } else { "polygons of one loop" }
    )]
    NotAPolygon {
        /// Index of the face.
        face: usize,
        /// The number of its loops.
        loops: usize,
        /// The number of vertices of all its loops.
        vertices: usize,
        /// True when the format takes triangles only.
        triangles: bool,
    },
    /// The content of one file would pass 2^32 bytes or items, the limit of the format.
    #[error("{bytes} bytes or items, but the format has at most 2^32 - 1")]
    TooLarge {
        /// Bytes or items that the content takes.
        bytes: u64,
    },
}
