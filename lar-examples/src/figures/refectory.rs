//! The refectory: a hierarchy of instances.

use super::Figure;
use super::collection::{Drawn, Request};
use super::gallery::counts;
use super::sheet::Eye;
use crate::shapes;
use crate::{CommandError, scenes};
use lar_arrangement::arrange;
use lar_core::{Node, Points, Struct, TriangleMesh};
use lar_viewer::{CellStyle, Coloring, Drawable, Rgb, Scene, View, WHITE, push_cells};

/// Settings along and across the hall.
const HALL: [usize; 2] = [4, 3];

const EYE: Eye = Eye { azimuth: -0.95, elevation: 0.5 };

const WOOD: Rgb = [0.80, 0.62, 0.42];
const SEATS: Rgb = [0.33, 0.55, 0.78];
const FLOOR: Rgb = [0.90, 0.90, 0.91];

/// Tables and chairs, and the arrangement of the boxes that they are made of.
pub(super) fn refectory(request: &Request) -> Result<Drawn, CommandError> {
    let hall = scenes::refectory(HALL[0], HALL[1])?;
    let surfaces = scenes::surfaces(&hall)?;
    let arrangement = arrange(&surfaces)?;
    let scene = scene(&hall)?;
    let size = request.size.unwrap_or([1200, 700]);
    let view = View { camera: EYE.camera(), background: WHITE, ..View::default() };
    let view = view.fit(&scene, f64::from(size[0]) / f64::from(size[1].max(1)));
    let name = "refectory".to_owned();
    let figure = Figure { name, title: "tables and chairs in a Struct", scene, view, size, svg: None };
    let wood: f64 = arrangement.volumes().iter().skip(1).sum();
    let numbers = format!(
        "{} boxes placed, {} stored\n{}volume {wood:.6} m³\n",
        surfaces.len(),
        stored(&hall)?,
        counts(&arrangement)
    );
    Ok(Drawn { numbers, figures: vec![figure] })
}

/// Number of different geometries in memory.
fn stored(hall: &Struct) -> Result<usize, CommandError> {
    let mut models = Vec::new();
    let visited = hall.visit(|entry| {
        if let Node::Model(_, model) = entry.node {
            models.push(std::sync::Arc::as_ptr(model));
        }
    });
    visited.map_err(scenes::SceneError::from)?;
    models.sort_unstable();
    models.dedup();
    Ok(models.len())
}

/// Tables in one colour, chairs in another, on a floor.
fn scene(hall: &Struct) -> Result<Scene, CommandError> {
    let mut scene = Scene::new();
    let (mut tables, mut chairs) = (Vec::new(), Vec::new());
    for (i, placed) in hall.eval_struct().map_err(scenes::SceneError::from)?.iter().enumerate() {
        let surface = placed.to_surface().map_err(scenes::SceneError::from)?;
        let kind = if placed.path.contains("/chair/") { &mut chairs } else { &mut tables };
        kind.push(shapes::surface(&surface, i as u32)?);
    }
    for (shapes, color) in [(tables, WOOD), (chairs, SEATS)] {
        let style = CellStyle { coloring: Coloring::Fixed(color), edge_width: 1.0, ..CellStyle::default() };
        push_cells(&mut scene, shapes, &style)?;
    }
    if let Some(bounds) = scene.bounds([1.0; 3]) {
        let [lo, hi] = [bounds.min.map(|x| x - 0.4), bounds.max.map(|x| x + 0.4)];
        let corners = [[lo[0], lo[1]], [hi[0], lo[1]], [hi[0], hi[1]], [lo[0], hi[1]]];
        let points = Points::from_xyz(&corners.map(|[x, y]| [x, y, bounds.min[2]]));
        let floor = TriangleMesh { points, triangles: vec![[0, 1, 2], [0, 2, 3]] };
        scene.push(Drawable::mesh("floor", floor).color(FLOOR).unlit())?;
    }
    Ok(scene)
}
