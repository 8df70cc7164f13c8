//! Model types of the Linear Algebraic Representation (LAR).
//!
//! A *model* is a set of points plus cells of dimension 0..d; a *chain complex* is the list of its sparse
//! boundary operators ∂p : Cp → Cp−1 with entries −1, 0, +1. Every other crate of the workspace meets in these
//! types and in nothing else.

mod affine;
mod cells;
mod complex;
mod from_model;
mod grid;
mod ids;
mod incidence;
mod measure;
mod mesh;
mod model;
mod model_faces;
mod orient;
mod points;
mod structure;
mod surface;
mod surface_check;

pub use affine::{Affine, AffineError, RotationVector, r, rotation, s, t};
pub use cells::Cells;
pub use complex::{ChainComplex, Operator};
pub use grid::cuboid_grid;
pub use ids::{CellId, EdgeId, FaceId, VertexId};
pub use incidence::characteristic_matrix;
pub use mesh::TriangleMesh;
pub use model::{Model, ModelViolation};
pub use model_faces::ModelError;
pub use points::Points;
pub use structure::{Instance, Node, PlacedModel, Struct, StructError};
pub use surface::Surface;
pub use surface_check::{BoundaryEdge, SurfaceViolation};
