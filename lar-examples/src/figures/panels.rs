//! The four panels in which an arrangement is shown (Paoluzzi et al. 2019, Figure 6): input, faces, boundary cycles of
//! the faces, 3-cells. Everything but the input is exploded, and what is drawn as an edge is an edge of the complex.

use super::Figure;
use super::collection::{Drawn, Request};
use super::gallery::counts;
use crate::shapes::{self, Shapes};
use crate::{CommandError, scenes, tables};
use lar_arrangement::{Arrangement, arrange};
use lar_core::{CellId, Surface};
use lar_viewer::{
    Camera, CellShape, CellStyle, Coloring, Drawable, Orientation, Scene, View, WHITE, push_axes, push_cells,
};

/// Explosion of the faces and of their boundary cycles.
const FACES_EXPLODE: [f32; 3] = [1.5; 3];

/// Explosion of the 3-cells: far enough to see each of the three cubes' cells from all around, and wider across the
/// line of sight than up and down.
const CELLS_EXPLODE: [f32; 3] = [9.0, 7.0, 5.0];

/// Azimuth of the eye for panel a, in radians: the origin lies in front, the axes run to the left and right.
const INPUT_AZIMUTH: f64 = -2.2;

/// Azimuth of the eye for the exploded panels, in radians: no cell of the three cubes hides another.
const EXPLODED_AZIMUTH: f64 = 2.55;

/// Elevation of the eye in radians.
const ELEVATION: f64 = 0.4;

/// Height in pixels of the pictures for which line widths are chosen.
const DESIGN_HEIGHT: f64 = 800.0;

/// Width and height of a panel in pixels.
const SIZE: [u32; 2] = [1280, 800];

/// Figure 6 with its truth table.
pub(super) fn figure6(request: &Request) -> Result<Drawn, CommandError> {
    let surfaces = scenes::surfaces(&scenes::three_cubes())?;
    let arrangement = arrange(&surfaces)?;
    let figures = panels(&arrangement, &surfaces, request.size.unwrap_or(SIZE))?;
    let numbers = counts(&arrangement) + &tables::truth_table(&arrangement, usize::MAX);
    Ok(Drawn { numbers, figures: figures.into() })
}

/// The four panels of an arrangement of `surfaces`, `figure6a` … `figure6d`, for pictures of this size.
///
/// # Errors
/// When a face cannot be triangulated or a coordinate is too large to be drawn.
pub fn panels(
    arrangement: &Arrangement,
    surfaces: &[Surface],
    size: [u32; 2],
) -> Result<[Figure; 4], CommandError> {
    let shapes = Shapes::new(arrangement)?;
    let faces = shapes.faces()?;
    let figure = |panel: char, title, scene: Scene, explode: [f32; 3], azimuth| {
        let [width, height] = size.map(f64::from);
        let orientation = Orientation::turntable(azimuth, ELEVATION);
        let camera = Camera { orientation, ..Camera::default() };
        let scale = (height / DESIGN_HEIGHT).clamp(0.5, 4.0) as f32;
        let view = View { camera, explode: explode.into(), scale, ..View::default() }
            .fit(&scene, width / height.max(1.0));
        Figure { name: format!("figure6{panel}"), title, scene, view, size, svg: None }
    };
    Ok([
        figure('a', "input faces", input(surfaces)?, [1.0; 3], INPUT_AZIMUTH),
        figure('b', "faces, exploded", two_skeleton(faces.clone())?, FACES_EXPLODE, EXPLODED_AZIMUTH),
        figure(
            'c',
            "boundary cycles of the faces, exploded",
            cycles(&faces)?,
            FACES_EXPLODE,
            EXPLODED_AZIMUTH,
        ),
        figure('d', "3-cells, exploded", three_cells(&shapes)?, CELLS_EXPLODE, EXPLODED_AZIMUTH),
    ])
}

/// The input surfaces, translucent, with the axes.
fn input(surfaces: &[Surface]) -> Result<Scene, CommandError> {
    let mut scene = Scene::new();
    let style = CellStyle { opacity: 0.45, ..CellStyle::default() };
    let shapes = (0..).zip(surfaces).map(|(i, s)| shapes::surface(s, i)).collect::<Result<Vec<_>, _>>()?;
    push_cells(&mut scene, shapes, &style)?;
    push_frame(&mut scene)?;
    Ok(scene)
}

/// All faces in cyclic colours.
fn two_skeleton(faces: Vec<CellShape>) -> Result<Scene, CommandError> {
    let mut scene = Scene::new();
    push_cells(&mut scene, faces, &CellStyle::default())?;
    Ok(scene)
}

/// The boundary cycle of each face as a line of its own colour.
fn cycles(faces: &[CellShape]) -> Result<Scene, CommandError> {
    let mut scene = Scene::new();
    for (i, face) in faces.iter().enumerate() {
        let style =
            CellStyle { edge_color: Coloring::Cyclic.color(i), edge_width: 3.5, ..CellStyle::default() };
        let no_triangles = lar_core::TriangleMesh { points: lar_core::Points::new(3), triangles: Vec::new() };
        push_cells(&mut scene, [CellShape { mesh: no_triangles, ..face.clone() }], &style)?;
    }
    Ok(scene)
}

/// The bounded cells in cyclic colours, the exterior as a white shell in its place, and the axes.
fn three_cells(shapes: &Shapes<'_>) -> Result<Scene, CommandError> {
    let mut scene = Scene::new();
    push_cells(&mut scene, shapes.bounded_cells()?, &CellStyle { opacity: 0.5, ..CellStyle::default() })?;
    let shell = shapes.cell(CellId(0))?;
    let cell = shell.cell;
    scene.push(Drawable::mesh("exterior", shell.mesh).color(WHITE).opacity(0.4).cell(cell))?;
    scene.push(Drawable::edges("exterior", shell.edges).cell(cell))?;
    push_frame(&mut scene)?;
    Ok(scene)
}

/// Axes of four fifths of the largest coordinate: they reach out of a cube at the origin and do not shrink the rest.
fn push_frame(scene: &mut Scene) -> Result<(), CommandError> {
    let reach = scene.bounds([1.0; 3]).map_or(0.0, |b| b.max.into_iter().fold(0.0, f64::max));
    Ok(push_axes(scene, if 0.0 < reach { 0.8 * reach } else { 1.0 })?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_show_the_cells() {
        let surfaces = scenes::surfaces(&scenes::three_cubes()).unwrap();
        let arrangement = arrange(&surfaces).unwrap();
        let figures = panels(&arrangement, &surfaces, [320, 200]).unwrap();
        let groups = figures.each_ref().map(|f| f.scene.groups().len());
        assert_eq!(groups, [3, 47, 47, 7]);
        let seen =
            |f: &Figure, dim| f.scene.drawables().iter().filter_map(Drawable::cell_ref).any(|c| c.dim == dim);
        assert!(seen(&figures[1], 2) && seen(&figures[2], 2) && seen(&figures[3], 3));
    }
}
