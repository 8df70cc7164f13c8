//! Model types of the Linear Algebraic Representation (LAR).
//!
//! A *model* is a set of points plus cells of dimension 0..d; a *chain complex* is the list of its sparse
//! boundary operators ∂p : Cp → Cp−1 with entries −1, 0, +1. Every other crate of the workspace meets in these
//! types and in nothing else.

mod affine;
mod atomic_write;
mod cells;
mod chain;
mod complex;
mod face_loops;
mod from_model;
mod generators;
mod grid;
mod ids;
mod incidence;
mod json;
mod measure;
mod mesh;
mod model;
mod model_faces;
mod obj;
mod orient;
mod points;
mod relations;
mod structure;
mod surface;
mod surface_check;
mod topology;
mod validate;

pub use affine::{Affine, AffineError, RotationVector, r, rotation, s, t};
pub use atomic_write::{FileError, atomic_write};
pub use cells::Cells;
pub use chain::{Chain, ChainError};
pub use complex::{ChainComplex, Operator};
pub use generators::{icosphere, simplex, triangular_prism};
pub use grid::cuboid_grid;
pub use ids::{CellId, EdgeId, FaceId, VertexId};
pub use incidence::characteristic_matrix;
pub use json::JsonError;
pub use mesh::TriangleMesh;
pub use model::{Model, ModelViolation};
pub use model_faces::ModelError;
pub use obj::{ObjError, ObjGrouping, parse_obj, read_obj};
pub use points::Points;
pub use structure::{Instance, Node, PlacedModel, Struct, StructError};
pub use surface::Surface;
pub use surface_check::{BoundaryEdge, SurfaceViolation};
pub use topology::Components;
pub use validate::Violation;
