//! Galleries: each shape by itself, fitted into a square. Figure 1 shows the 3-cells of an arrangement so, another
//! picture the shapes of the mapper.

use super::collection::{Drawn, Request};
use super::parts::{Part, cyclic};
use super::sheet::{Eye, Panel, Sheet};
use super::viewpoint::best_eye;
use crate::shapes::{self, Shapes};
use crate::{CommandError, scenes, tables};
use lar_arrangement::{Arrangement, arrange};
use lar_core::Model;
use lar_core::mapper::{
    Ball, Circle, Crown, Cylinder, Disk, Helicoid, Helix, HollowBall, HollowCylinder, Pizza, Ring, Rod,
    Sphere, Toroidal, Torus, cuboid,
};
use lar_viewer::{CellShape, Coloring};
use std::fmt::Write;

/// Seed of the five cubes: their arrangement has cells of many forms.
const SEED: u64 = 4;

/// Width of edges in pixels where there are many.
const THIN: f32 = 0.7;

/// Cubes of Figures 1 and 2.
const CUBES: usize = 5;

/// The arrangement of five random cubes.
pub(super) fn five_cubes(seed: u64) -> Result<Arrangement, CommandError> {
    let scene = scenes::random_cubes(CUBES, seed);
    Ok(arrange(&scenes::surfaces(&scene)?)?)
}

/// Figure 1: the bounded 3-cells of the arrangement of five random cubes, none in scale, each turned to where most of it
/// is seen.
pub(super) fn cells(request: &Request) -> Result<Drawn, CommandError> {
    let arrangement = five_cubes(request.seed.unwrap_or(SEED))?;
    let shapes = Shapes::new(&arrangement)?;
    let cells = shapes.bounded_cells()?;
    let columns = columns(cells.len());
    let panel = |(i, shape): (usize, CellShape)| {
        let (eye, name) = (best_eye(&shape.mesh), shape.name.clone());
        Panel::new(Part::of_cell(shape, Coloring::Cyclic.color(i), 1.0)).from(eye).called(name)
    };
    let panels = cells.into_iter().enumerate().map(panel).collect();
    let title = "3-cells of the arrangement of five random cubes";
    let figure = Sheet { panels, columns }.figure("figure1", title, 170, request.size)?;
    Ok(Drawn { numbers: numbers(&arrangement), figures: vec![figure] })
}

/// Columns of a sheet that is as wide as high, or a panel wider.
fn columns(n: usize) -> usize {
    (1..).find(|c| n <= c * c).unwrap_or(1)
}

fn numbers(arrangement: &Arrangement) -> String {
    format!("{}{}", counts(arrangement), tables::truth_table(arrangement, usize::MAX))
}

/// A line with the f-vector.
pub(super) fn counts(arrangement: &Arrangement) -> String {
    let [vertices, edges, faces, cells] = [0, 1, 2, 3].map(|p| arrangement.complex().n_cells(p));
    format!("{vertices} vertices, {edges} edges, {faces} faces, {cells} cells\n")
}

/// The shapes of the mapper with their usual parameters, by the names of the first implementation.
fn shapes_of_the_mapper() -> Result<Vec<(&'static str, Model)>, scenes::SceneError> {
    Ok(vec![
        ("circle", Circle::default().model()?),
        ("helix", Helix::default().model()?),
        ("disk", Disk::default().model()?),
        ("ring", Ring::default().model()?),
        ("helicoid", Helicoid::default().model()?),
        ("cylinder", Cylinder::default().model()?),
        ("sphere", Sphere::default().model()?),
        ("toroidal", Toroidal::default().model()?),
        ("crown", Crown::default().model()?),
        ("cuboid", cuboid(&[0.0; 3], &[1.0, 0.7, 0.5])?),
        ("ball", Ball::default().model()?),
        ("rod", Rod::default().model()?),
        ("hollowCyl", HollowCylinder::default().model()?),
        ("hollowBall", HollowBall::default().model()?),
        ("torus", Torus::default().model()?),
        ("pizza", Pizza::default().model()?),
    ])
}

/// All shapes of the mapper: curves by their edges, surfaces by their triangles, solids by their boundaries.
pub(super) fn mapper(request: &Request) -> Result<Drawn, CommandError> {
    let shapes = shapes_of_the_mapper()?;
    let mut numbers = String::new();
    for (name, model) in &shapes {
        let counts: Vec<String> = model.f_vector().iter().map(usize::to_string).collect();
        writeln!(numbers, "{name:<12}{}", counts.join(", ")).expect("a string takes all text");
    }
    let panel = |(i, (name, model)): (usize, &(&str, Model))| {
        let panel = Panel::new(mapper_parts(name, model, i)?).called(*name);
        Ok(panel.from(Eye { azimuth: -1.05, elevation: 0.6 }))
    };
    let panels = shapes.iter().enumerate().map(panel).collect::<Result<_, CommandError>>()?;
    let figure =
        Sheet { panels, columns: 4 }.figure("mapper", "the shapes of the mapper", 240, request.size)?;
    Ok(Drawn { numbers, figures: vec![figure] })
}

fn mapper_parts(name: &str, model: &Model, i: usize) -> Result<Vec<Part>, CommandError> {
    let color = Coloring::Cyclic.color(i);
    if model.dim() < 2 {
        let cells = shapes::model_cells(model)?;
        return Ok(cells.iter().map(|edge| Part::outline(edge, color, 3.0)).collect());
    }
    let spatial = if model.points().dim() < 3 {
        model.embedded(3).map_err(scenes::SceneError::from)?
    } else {
        model.clone()
    };
    let surface = spatial.to_surface(name).map_err(scenes::SceneError::from)?;
    Ok(Part::of_cell(shapes::surface(&surface, i as u32)?, color, 1.0).map(|part| part.width(THIN)).into())
}

/// The top cells of a model in cyclic colours, exploded.
pub(super) fn exploded(model: &Model, factor: f64, opacity: f32) -> Result<Vec<Part>, CommandError> {
    let cells = super::parts::exploded(shapes::model_cells(model)?, [factor; 3]);
    if model.dim() < 2 {
        let line = |(i, edge): (usize, &CellShape)| Part::outline(edge, Coloring::Cyclic.color(i), 4.0);
        return Ok(cells.iter().enumerate().map(line).collect());
    }
    Ok(cyclic(cells, opacity))
}
