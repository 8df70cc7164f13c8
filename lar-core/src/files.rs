//! Surface files: STL, PLY, OFF and OBJ in and out, glTF out. Segments of the plane: text, in.
//!
//! One entry each way: [`read_surface`] tells the format by content and extension, [`write_mesh`] by extension.
//! Readers run through the file once, in pieces; what they keep grows with what they have read, never with
//! what a header announces, so that a file of ten lines cannot ask for the memory of four billion vertices.
//! Lines of text in the form that programs write them are read in one pass over the bytes ([`Scan`]), all others word
//! by word. Every refusal names the file and the line or byte where it stands, and both values where two disagree.
//! Beside the surface a reader says what the coordinates are worth ([`Precision`]) and what was welded
//! ([`Weld`]).

mod decimal;
mod error;
mod format;
mod gltf;
mod off;
mod ply;
mod polygons;
mod precision;
mod scan;
mod seg;
mod source;
mod stl;
mod text;
mod weld;
mod words;

pub use error::{MeshFileError, Place, Problem};
pub use format::{MeshFormat, SurfaceFile, parse_surface, read_surface, write_mesh};
pub use gltf::{GltfNode, to_glb, to_gltf, write_gltf};
pub use polygons::PolygonMesh;
pub(crate) use precision::Digits;
pub use precision::Precision;
pub(crate) use scan::Scan;
pub use seg::{parse_segments, read_segments};
pub(crate) use source::MARK;
#[cfg(feature = "svg")]
pub(crate) use source::clip;
pub(crate) use text::TextWriter;
pub(crate) use text::push_number;
pub(crate) use weld::Corners;
pub use weld::Weld;
pub(crate) use words::{Words, words_of};
