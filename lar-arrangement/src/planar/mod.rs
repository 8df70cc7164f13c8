//! Arrangements of segments in the plane as chain complexes: vertices, ∂1, ∂2 with the exterior face, faces with
//! holes nested to any depth, provenance, regions and their Booleans (Paoluzzi 2019, §3.3 and §6.1).
//!
//! The stages: [`input`](Drawing) → carriers (segments that do not overlap) → crossings (events on carriers) →
//! chains (events sorted and unified: vertices) → edges, cycles and faces → complex.

mod along;
mod arranger;
mod assemble;
mod boolean;
mod bundles;
mod carriers;
mod chains;
mod crossings;
mod edges;
mod events;
mod faces;
mod input;
mod isolated;
mod location;
mod numbering;
mod points;
mod positions;
mod query;
mod restrict;
mod result;
mod rotation;
mod slopes;

pub use arranger::{Dangling, Isolated, PlanarArranger, planar_arrangement};
pub use boolean::Polygons;
pub use input::Drawing;
pub use location::{Location, Locator};
pub use result::PlanarArrangement;
