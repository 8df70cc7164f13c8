//! The figures of Paoluzzi et al. 2019 and the classic scenes of the first implementation, as scenes for the viewer
//! with the numbers that belong to them.
//!
//! [`COLLECTION`] lists them all; [`Entry::draw`] computes one. A [`Figure`] is one picture: what is drawn, from where,
//! in how many pixels. It is written as PNG ([`write_figures()`]) or shown in a window.
//!
//! ```
//! use lar_examples::figures::{COLLECTION, Request};
//! let cubes = COLLECTION.iter().find(|entry| entry.name == "figure6").expect("one of the collection");
//! let drawn = cubes.draw(&Request::default())?;
//! assert!(drawn.numbers.starts_with("49 vertices, 88 edges, 47 faces, 8 cells"));
//! assert_eq!(drawn.figures.len(), 4);
//! # Ok::<(), lar_examples::CommandError>(())
//! ```

mod collection;
mod gallery;
mod grids;
mod panels;
mod parts;
mod pipeline;
mod planar;
mod products;
mod program;
mod refectory;
mod rods;
mod sheet;
mod viewpoint;
mod wrapping;

pub use collection::{COLLECTION, Drawn, Entry, Request};
pub use panels::panels;
pub use program::{run_figure1, run_figure2, run_figure3, run_figures};

use crate::CommandError;
use crate::shapes::{self, Shapes};
use lar_arrangement::Arrangement;
use lar_core::Model;
use lar_viewer::{CellShape, OffscreenRenderer, Scene, View};
use std::path::Path;

/// A picture: what is drawn, from where, and in how many pixels.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of its file without the extension: `figure6a`, `refectory`.
    pub name: String,
    /// What it shows.
    pub title: &'static str,
    /// The drawables.
    pub scene: Scene,
    /// Camera, explosion, background.
    pub view: View,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The same as an SVG document, for pictures of the plane.
    pub svg: Option<String>,
}

/// The bounded 3-cells of an arrangement, in the form in which the viewer draws them: the triangles of their boundaries,
/// and their edges.
///
/// ```
/// use lar_examples::{figures::bounded_cells, scenes};
/// let cubes = lar_arrangement::arrange(&scenes::surfaces(&scenes::three_cubes())?)?;
/// let names: Vec<String> = bounded_cells(&cubes)?.into_iter().map(|cell| cell.name).collect();
/// assert_eq!(names, ["c1", "c2", "c3", "c4", "c5", "c6", "c7"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When a face cannot be triangulated.
pub fn bounded_cells(arrangement: &Arrangement) -> Result<Vec<CellShape>, CommandError> {
    Ok(Shapes::new(arrangement)?.bounded_cells()?)
}

/// The cells of highest dimension of a model, in the form in which the viewer draws them; a model of the plane lies in
/// z = 0.
///
/// # Errors
/// When the model is malformed or a face cannot be triangulated.
pub fn model_cells(model: &Model) -> Result<Vec<CellShape>, CommandError> {
    shapes::model_cells(model)
}

/// Draws the figures and writes them as `NAME.png`, those of the plane also as `NAME.svg`, into a directory, which is
/// made when it is missing. Nothing is written unless all could be drawn. Returns the name of the adapter.
///
/// # Errors
/// Without a graphics adapter, and when a picture cannot be drawn or written.
pub fn write_figures(figures: &[Figure], dir: &Path) -> Result<String, CommandError> {
    let mut renderer = OffscreenRenderer::new()?;
    let draw = |f: &Figure| renderer.render(&f.scene, &f.view, f.size[0], f.size[1]);
    let images: Vec<_> = figures.iter().map(draw).collect::<Result<_, _>>()?;
    std::fs::create_dir_all(dir).map_err(|source| CommandError::Write { path: dir.to_owned(), source })?;
    for (figure, image) in figures.iter().zip(images) {
        image.write_png(dir.join(format!("{}.png", figure.name)))?;
        if let Some(svg) = &figure.svg {
            let path = dir.join(format!("{}.svg", figure.name));
            lar_core::atomic_write(path, |file| file.write_all(svg.as_bytes()))?;
        }
    }
    Ok(renderer.adapter_name().to_owned())
}
