//! Cartesian products of complexes of any dimensions.

use super::collection::{Drawn, Request};
use super::gallery::exploded;
use super::sheet::{ABOVE, Panel, Sheet, lettered};
use crate::CommandError;
use crate::scenes::SceneError;
use lar_core::mapper::{Circle, Disk};
use lar_core::{Model, cuboid_grid, grid_1d, grid_skeleton, product, product_all, simplex_grid};
use std::fmt::Write;

/// Six products, exploded: what they are made of, and their numbers of cells.
pub(super) fn products(request: &Request) -> Result<Drawn, CommandError> {
    let mut numbers = String::new();
    let mut panels = Vec::new();
    for (letter, (name, model, factor)) in ('a'..).zip(&models()?) {
        let counts: Vec<String> = model.f_vector().iter().map(usize::to_string).collect();
        writeln!(numbers, "({letter}) {name:<38}{}", counts.join(", ")).expect("a string takes all text");
        let panel = Panel::new(exploded(model, *factor, 1.0)?);
        panels.push(if model.points().dim() == 2 { panel.from(ABOVE) } else { panel });
    }
    let title = "Cartesian products of complexes, exploded";
    let figure =
        Sheet { panels: lettered(panels), columns: 3 }.figure("products", title, 300, request.size)?;
    Ok(Drawn { numbers, figures: vec![figure] })
}

/// Names, models and factors of explosion.
fn models() -> Result<Vec<(&'static str, Model, f64)>, SceneError> {
    let gaps = grid_1d(&[1., -0.5, 1., -0.5, 1.])?;
    let line = grid_1d(&[1., 1.])?;
    let frame = cuboid_grid(&[3, 3]);
    let walls = Model::new(frame.points().clone(), vec![frame.cells(0).clone(), grid_skeleton(&[3, 3], 1)]);
    let circle = Circle { shape: 24, ..Circle::default() }.model()?;
    let disk = Disk { shape: [18, 2], ..Disk::default() }.model()?;
    Ok(vec![
        ("intervals × intervals", product(&gaps, &gaps)?, 1.0),
        ("intervals × intervals × intervals", product_all([&gaps; 3])?, 1.0),
        ("circle × segments", product(&circle, &line)?, 1.2),
        ("disk × segments", product(&disk, &line)?, 1.35),
        ("simplex_grid([2, 2]) × segments", product(&simplex_grid(&[2, 2])?, &line)?, 1.35),
        ("edges of a grid 3 × 3 × segments", product(&walls, &line)?, 1.0),
    ])
}
