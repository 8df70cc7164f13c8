//! PLY: a header that says which numbers follow, then the numbers as text or in binary of either byte order.
//!
//! Read are the coordinates `x`, `y`, `z` of the element `vertex` and the list `vertex_indices` (or
//! `vertex_index`) of the element `face`, of any number type; other elements and properties, in any order, are
//! passed over.
//!
//! Reference: G. Turk, "The PLY Polygon File Format", 1994.

mod header;
mod read;
mod write;

pub(crate) use read::read;
pub(crate) use write::write;
