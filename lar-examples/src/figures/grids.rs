//! Grids: two of cubes, one turned, as an arrangement; a numbered one; grids of simplices.

use super::Figure;
use super::collection::{Drawn, Request};
use super::gallery::{counts, exploded};
use super::parts::cyclic;
use super::sheet::{ABOVE, Eye, Panel, Sheet, lettered, single};
use crate::shapes::{self, Shapes};
use crate::{CommandError, scenes};
use lar_arrangement::arrange;
use lar_core::{
    CellId, ChainComplex, Model, cuboid_grid, extrude_simplicial, quads_to_triangles, simplex,
    simplex_boundary, simplex_grid, simplicial_complex,
};
use lar_viewer::{
    CellRef, CellStyle, GroupId, SLATE, Scene, TextStyle, View, WHITE, push_cells, push_numbers,
};
use std::fmt::Write;

/// Cubes along a side of each grid.
const SIDE: usize = 10;
const SMALL_SIDE: usize = 3;

/// Height of the numbers in pixels.
const NUMBERS: f64 = 13.0;

/// Two grids of 10 × 10 × 10 cubes, one turned, as an arrangement, exploded: each cube that crosses others is cut into
/// their common parts.
pub(super) fn cube_grids(request: &Request) -> Result<Drawn, CommandError> {
    let side = if request.small { SMALL_SIDE } else { SIDE };
    let arrangement = arrange(&scenes::surfaces(&scenes::cube_grids(side))?)?;
    let shapes = Shapes::new(&arrangement)?;
    let mut scene = Scene::new();
    push_cells(&mut scene, shapes.bounded_cells()?, &CellStyle { edge_width: 1.0, ..CellStyle::default() })?;
    let size = request.size.unwrap_or([1000, 800]);
    let view = View { explode: [1.8; 3].into(), background: WHITE, ..View::default() };
    let view = view.fit(&scene, f64::from(size[0]) / f64::from(size[1].max(1)));
    let title = "two cube grids, one turned, exploded";
    let figure = Figure { name: "cube_grids".to_owned(), title, scene, view, size, svg: None };
    let both = (1..arrangement.n_cells() as u32).map(CellId);
    let both = both.filter(|&c| (0..2).all(|solid| arrangement.winding(c, solid) != 0)).count();
    let numbers =
        format!("2 grids of {side}³ cubes\n{}{both} cells lie in both grids\n", counts(&arrangement));
    Ok(Drawn { numbers, figures: vec![figure] })
}

/// The grid 3 × 2 × 1 with all its cells.
pub(super) fn numbered(request: &Request) -> Result<Drawn, CommandError> {
    let grid = cuboid_grid(&[3, 2, 1]);
    let complex = ChainComplex::from_model(&grid).map_err(scenes::SceneError::from)?;
    let parts = cyclic(shapes::model_cells(&grid)?, 0.25);
    let title = "the grid 3 × 2 × 1, its cells numbered";
    let size = request.size.unwrap_or([1000, 700]);
    let mut figure = single("numbered_grid", title, parts, Eye { azimuth: -1.02, elevation: 0.62 }, size)?;
    let style = TextStyle { size: NUMBERS, ..TextStyle::default() };
    push_numbers(&mut figure.scene, numbers_of(&grid), &style, true)?;
    figure.view.background = SLATE;
    let [vertices, edges, faces, cells] = [0, 1, 2, 3].map(|p| complex.n_cells(p));
    let numbers = format!("{vertices} vertices, {edges} edges, {faces} faces, {cells} cells\n");
    Ok(Drawn { numbers, figures: vec![figure] })
}

/// Each cell and the mean of its vertices.
fn numbers_of(model: &Model) -> impl Iterator<Item = (CellRef, [f64; 3], Option<GroupId>)> + '_ {
    (0..=3u8).flat_map(move |dim| {
        let cells = (0..).zip(model.cells(usize::from(dim)).iter());
        cells.map(move |(i, cell)| {
            let sum = cell.iter().map(|&v| model.points().xyz(v as usize));
            let sum = sum.fold([0.0; 3], |s, p| [0, 1, 2].map(|k| s[k] + p[k]));
            (CellRef::new(dim, i), sum.map(|x| x / cell.len().max(1) as f64), None)
        })
    })
}

/// Grids of simplices, extrusions with gaps, a boundary.
pub(super) fn simplicial(request: &Request) -> Result<Drawn, CommandError> {
    let models = simplicial_models()?;
    let mut numbers = String::new();
    let mut panels = Vec::new();
    for (letter, (name, model, factor)) in ('a'..).zip(&models) {
        let counts: Vec<String> = model.f_vector().iter().map(usize::to_string).collect();
        writeln!(numbers, "({letter}) {name:<38}{}", counts.join(", ")).expect("a string takes all text");
        let eye = if model.points().dim() == 2 { ABOVE } else { Eye { azimuth: 0.45, elevation: 0.42 } };
        panels.push(Panel::new(exploded(model, *factor, 1.0)?).from(eye));
    }
    let title = "grids of simplices, exploded";
    let figure = Sheet { panels: lettered(panels), columns: 3 }.figure(
        "simplicial_grids",
        title,
        300,
        request.size,
    )?;
    Ok(Drawn { numbers, figures: vec![figure] })
}

/// Names, models and factors of explosion.
fn simplicial_models() -> Result<Vec<(&'static str, Model, f64)>, scenes::SceneError> {
    let quads = cuboid_grid(&[4, 3]);
    let split = simplicial_complex(quads.points().clone(), quads_to_triangles(quads.cells(2))?)?;
    let tetrahedra = simplex_grid(&[2, 2, 2])?;
    let shell = simplicial_complex(tetrahedra.points().clone(), simplex_boundary(tetrahedra.cells(3))?)?;
    let facets = simplicial_complex(simplex(3).points().clone(), simplex_boundary(simplex(3).cells(3))?)?;
    Ok(vec![
        ("simplex_grid([5, 4])", simplex_grid(&[5, 4])?, 1.25),
        ("simplex_grid([2, 2, 2])", tetrahedra, 2.2),
        ("its boundary", shell, 1.3),
        ("simplex(3), its facets", facets, 1.9),
        ("quads_to_triangles of a grid 4 × 3", split, 1.25),
        (
            "simplex_grid([3, 2]) extruded",
            extrude_simplicial(&simplex_grid(&[3, 2])?, &[1., -1., 1., -1., 1.])?,
            1.15,
        ),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_both_grids_have_the_volume_of_the_overlap() {
        let arrangement = arrange(&scenes::surfaces(&scenes::cube_grids(2)).unwrap()).unwrap();
        let volumes = arrangement.volumes();
        let of = |solid: usize| -> f64 {
            let inside = |c: &u32| arrangement.winding(CellId(*c), solid) != 0;
            (1..volumes.len() as u32).filter(inside).map(|c| volumes[c as usize]).sum()
        };
        assert!((of(0) - 8.0).abs() < 1e-9 && (of(1) - 8.0).abs() < 1e-9);
    }
}
