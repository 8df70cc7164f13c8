//! Exact arrangements of polygonal surfaces as chain complexes, and Booleans over their 3-cells.

mod arrangement;
mod boxes;
mod check;
mod coplanar;
mod crossing;
mod dissolve;
mod error;
mod fragment;
mod grid;
mod interner;
mod kernel;
mod measure;
mod nest;
mod parallel;
mod pipeline;
mod polygon;
mod skeleton;
mod soup;
mod split;
mod stats;
mod subdivision;
mod union_find;
mod winding;
mod wrap;

pub use arrangement::{Arrangement, HalfEdge};
pub use error::ArrangementError;
pub use pipeline::{Arranger, Checks, arrange};
pub use soup::Parent;
pub use stats::Stats;
pub use winding::Closure;
