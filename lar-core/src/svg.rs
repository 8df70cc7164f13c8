//! SVG drawings: polylines in, planar complexes out.
//!
//! SVG's y axis points down, ours up: y is negated both ways, so that pictures stand upright and loops keep
//! the orientation that is seen. Coordinates are user units of the outermost `svg` element (1 px = 1).
//!
//! Reference: W3C, "Scalable Vector Graphics (SVG) 2", 2018.

mod drawing;
mod error;
mod write;
mod writer;

#[cfg(feature = "svg")]
mod pen;
#[cfg(feature = "svg")]
mod read;
#[cfg(feature = "svg")]
mod shapes;

pub use drawing::{Drawing, NamedShapes, Polyline};
pub use error::SvgError;
#[cfg(feature = "svg")]
pub use read::{parse_svg, read_svg};
pub use writer::{SvgStyle, SvgWriter};
