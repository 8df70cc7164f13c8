//! Exact arrangements of polygonal surfaces as chain complexes, and Booleans over their 3-cells.

mod boxes;
mod coplanar;
mod crossing;
mod error;
mod fragment;
mod grid;
mod interner;
mod kernel;
mod nest;
mod parallel;
mod polygon;
mod skeleton;
mod soup;
mod split;
mod subdivision;
mod union_find;
mod wrap;

pub use error::ArrangementError;
pub use kernel::{Counters, Sign};
pub use soup::Parent;
