//! The plane: drawings read as segments and regions, their partitions and Booleans as pictures, the paper's figures of
//! planar arrangements, a floor plan.
//!
//! What is shown is a [`Picture`]: painted paths, with explosion already applied. It is written as SVG by
//! [`Picture::to_svg`], which needs no graphics, and drawn as PNG by the off-screen renderer with the same colours and
//! line widths.

mod boolean;
mod color;
pub mod figures;
mod file;
pub mod floor_plan;
mod input;
mod picture;
#[cfg(feature = "viewer")]
mod render;
pub mod scenes;

pub(crate) use boolean::{Boolean, BooleanOptions, arranged};
pub use color::face_colors;
pub(crate) use file::PictureFile;
pub(crate) use input::{Input, Shapes, Source, extension};
pub use picture::{Color, PaintedPath, Picture, Run, Stroke};
