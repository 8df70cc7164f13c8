//! The list of all figures.

use super::{Figure, gallery, grids, panels, pipeline, planar, products, refectory, rods, wrapping};
use crate::CommandError;

/// What may be asked of a figure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// For random scenes: another seed than the usual one.
    pub seed: Option<u64>,
    /// Width and height in pixels, instead of the usual ones of each picture.
    pub size: Option<[u32; 2]>,
    /// Fewer shapes where the whole scene takes seconds or does not fit a small picture.
    pub small: bool,
}

/// A figure, computed: its pictures and what is printed with them.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Lines of text.
    pub numbers: String,
    /// The pictures in their order.
    pub figures: Vec<Figure>,
}

/// One of the collection.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// What it is called on the command line, and what the names of its files begin with.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    draw: fn(&Request) -> Result<Drawn, CommandError>,
}

impl Entry {
    /// Computes the figure.
    ///
    /// # Errors
    /// When faces cannot be triangulated; not for the seeds that are usual.
    pub fn draw(&self, request: &Request) -> Result<Drawn, CommandError> {
        (self.draw)(request)
    }
}

/// All figures: those of the paper in its order, then the classic scenes.
pub const COLLECTION: &[Entry] = &[
    Entry { name: "figure1", title: "3-cells of the arrangement of five random cubes", draw: gallery::cells },
    Entry { name: "figure2", title: "gift wrapping of one 3-cell", draw: wrapping::figure2 },
    Entry { name: "figure3", title: "the pipeline in eight panels", draw: pipeline::figure3 },
    Entry { name: "figure4", title: "circles and polygons", draw: planar::figure4 },
    Entry { name: "figure5", title: "random rectangles", draw: planar::figure5 },
    Entry { name: "figure6", title: "three cubes", draw: panels::figure6 },
    Entry { name: "refectory", title: "tables and chairs in a Struct", draw: refectory::refectory },
    Entry { name: "cube_grids", title: "two cube grids, one turned", draw: grids::cube_grids },
    Entry { name: "numbered_grid", title: "the grid 3 × 2 × 1, its cells numbered", draw: grids::numbered },
    Entry { name: "mapper", title: "the shapes of the mapper", draw: gallery::mapper },
    Entry { name: "simplicial_grids", title: "grids of simplices", draw: grids::simplicial },
    Entry { name: "floor_plan", title: "Booleans and rooms of a floor plan", draw: planar::floor_plan },
    Entry { name: "products", title: "Cartesian products of complexes", draw: products::products },
    Entry { name: "rods", title: "three rods and their Booleans", draw: rods::rods },
];
