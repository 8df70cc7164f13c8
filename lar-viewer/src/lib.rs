//! Stage 8: views of cell complexes, off-screen and in a window.
//!
//! A [`Scene`] is a list of named [`Drawable`]s — triangles, segments, points — with colour, opacity and an explode
//! group; it is draw data and knows nothing of models. A [`View`] is what changes from picture to picture: the
//! [`Camera`], the factors of the explosion, opacity, background. [`OffscreenRenderer`] turns both into an [`Image`];
#![cfg_attr(
    feature = "window",
    doc = "[`view()`] shows them in a window, with the same renderer; [`explore()`] shows a complex, to be asked and taken apart."
)]
#![cfg_attr(not(feature = "window"), doc = "the feature `window` adds a window with the same renderer.")]
//!
//! Transparent cells are blended exactly, whatever the order in which they are drawn. Cell edges are the real edges
//! of cells, never those of a triangulation, and keep their width on the screen. Exploding a scene moves each group
//! rigidly on the graphics card and rebuilds nothing.
//!
//! Features: `window` (default) brings winit and egui; without it the crate needs wgpu and png only.

mod animation;
mod bounds;
mod camera;
mod cell_data;
mod cells;
mod clip;
mod color_bar;
mod color_map;
mod drawing;
mod error;
mod gpu;
mod image;
mod offscreen;
mod orientation;
mod outline;
mod palette;
mod pick;
mod primitives;
mod scene;
pub mod session;
mod shared;
mod text;
mod view;
#[cfg(feature = "window")]
mod window;

pub use animation::Animation;
pub use bounds::Bounds;
pub use camera::{Camera, Projection};
pub use cell_data::{CellData, FaceParent, Measures, Provenance};
pub use cells::{CellShape, CellStyle, push_axes, push_cells, push_plane_axes};
pub use clip::Clip;
pub use color_bar::ColorBar;
pub use color_map::ColorMap;
pub use drawing::{InkArea, InkLine, LineDrawing};
pub use error::ViewerError;
pub use gpu::traffic::{Traffic, Upload};
pub use image::Image;
pub use offscreen::{OffscreenRenderer, Prepared};
pub use orientation::{Orientation, StandardView};
pub use outline::{Outline, Outlined};
pub use palette::{Coloring, INK, PALETTE, Rgb, SLATE, WHITE, palette_color};
pub use pick::Hit;
/// Encoding of pictures; its error is inside [`ViewerError`].
pub use png;
pub use primitives::{cuboid_shape, push_arrow, push_exploded_groups, surface_shape};
pub use scene::{Appearance, CellRef, Drawable, Explosion, Group, GroupId, LEVELS, Scene};
pub use session::{NoQueries, Queries};
pub use shared::{Answers, SharedView, Wrapping};
pub use text::{
    HorizontalAlign, Label, NUMBER_COLORS, TextStyle, VerticalAlign, push_numbers, text_model, text_segments,
};
pub use view::View;
#[cfg(all(feature = "window", target_arch = "wasm32"))]
pub use window::open;
#[cfg(feature = "window")]
pub use window::{Exhibit, Exploration, Host, Source};
#[cfg(all(feature = "window", not(target_arch = "wasm32")))]
pub use window::{explore, view};
