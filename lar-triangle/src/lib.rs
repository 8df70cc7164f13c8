//! Triangulation of the polygonal faces of a chain complex (stage 7), of polygons with holes, and of points.
//!
//! ```text
//! ChainComplex ──loops──▶ FaceLoops ──face by face──▶ Triangulation ──signs of ∂3──▶ TriangleMesh of a cell
//!
//! one face:  flat (project, scale) ─┬─ 3, 4 corners: at once
//!                                   ├─ few corners, no hole: ears ───┐
//!                                   └─ others: cdt (spade), checked ─┴─▶ flips ─▶ constrained Delaunay
//!                                        └─ rounding broke the loops: ring of bridges, ears; else fan
//! ```
//!
//! What is promised for each face:
//! - no point is invented, and every loop edge is an edge of exactly one triangle, in its direction ([`check_laws`]);
//! - triangles turn like the face;
//! - all decisions are taken with exact predicates on the given positions;
//! - the result is *the* constrained Delaunay triangulation, ties going to the smallest index, and so independent of
//!   the order of the input, unless rounding made the face untriangulable, which is counted
//!   ([`Triangulation::fallbacks`]).

// The tests of this crate share code with those beside it, which know it by its name.
#[cfg(test)]
extern crate self as lar_triangle;

mod cdt;
mod complex;
mod defects;
mod ears;
mod error;
mod face;
mod fan;
mod flat;
mod flips;
mod hull;
mod laws;
mod loops;
mod parallel;
mod planar;
mod predicates;
mod ring;
mod steps;
mod tree;

pub use complex::{CellTriangles, Triangulation, triangulate, triangulate_cells};
pub use defects::Defects;
pub use error::TriangulateError;
pub use face::{Quality, Triangulator, triangulate_face};
pub use hull::{Hull, convex_hull};
pub use laws::{BrokenLaw, check_laws};
pub use loops::FaceLoops;
pub use planar::{delaunay, triangulate2d};
