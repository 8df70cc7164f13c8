//! Model types of the Linear Algebraic Representation (LAR).
//!
//! A *model* is a set of points plus cells of dimension 0..d; a *chain complex* is the list of its sparse
//! boundary operators ∂p : Cp → Cp−1 with entries −1, 0, +1. Every other crate of the workspace meets in these
//! types and in nothing else.

mod cells;
mod complex;
mod ids;
mod mesh;
mod points;
mod surface;

pub use cells::Cells;
pub use complex::{ChainComplex, Operator};
pub use ids::{CellId, EdgeId, FaceId, VertexId};
pub use mesh::TriangleMesh;
pub use points::Points;
pub use surface::Surface;
