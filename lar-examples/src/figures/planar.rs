//! The figures of the plane, as members of the collection.

use super::Figure;
use super::collection::{Drawn, Request};
use crate::CommandError;
use crate::plane::figures::{CIRCLES, Pictures, RECTANGLES, SEED, circles_and_polygons, rectangles};
use crate::plane::floor_plan::apartment;

/// Shapes of the small figures.
const FEW: [usize; 2] = [7, 20];

/// Circles and polygons.
pub(super) fn figure4(request: &Request) -> Result<Drawn, CommandError> {
    let shapes = if request.small { FEW[0] } else { CIRCLES };
    drawn(circles_and_polygons(shapes, request.seed.unwrap_or(SEED))?, request.size.unwrap_or([1000; 2]))
}

/// Rectangles.
pub(super) fn figure5(request: &Request) -> Result<Drawn, CommandError> {
    let shapes = if request.small { FEW[1] } else { RECTANGLES };
    drawn(rectangles(shapes, request.seed.unwrap_or(SEED))?, request.size.unwrap_or([1000; 2]))
}

/// The walls and rooms of an apartment.
pub(super) fn floor_plan(request: &Request) -> Result<Drawn, CommandError> {
    drawn(apartment()?, request.size.unwrap_or([1280, 800]))
}

fn drawn(Pictures { numbers, pictures }: Pictures, size: [u32; 2]) -> Result<Drawn, CommandError> {
    let figures = pictures.into_iter().map(|(name, title, picture)| {
        let (scene, view) = picture.scene(size)?;
        Ok(Figure { name, title, scene, view, size, svg: Some(picture.to_svg(size)) })
    });
    Ok(Drawn { numbers, figures: figures.collect::<Result<_, CommandError>>()? })
}
