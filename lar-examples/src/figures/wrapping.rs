//! Figure 2: gift wrapping of one 3-cell. Panels a, c, e, … show the chain as it grows, panels b, d, f, … the faces
//! around the edges of its boundary, from which the next ones are chosen.

use super::collection::{Drawn, Request};
use super::gallery::{counts, five_cubes};
use super::parts::{Part, Point, Segment, plain};
use super::sheet::{Panel, Sheet, lettered};
use super::viewpoint::best_eye;
use crate::CommandError;
use crate::shapes::Shapes;
use lar_arrangement::{Arrangement, FaceSide, WrapStep};
use lar_core::{CellId, EdgeId, FaceId};
use lar_viewer::{Rgb, palette_color};
use std::cmp::Reverse;
use std::fmt::Write;

/// Seed of the five cubes: one of their cells is wrapped in four values, all of them well seen.
const SEED: u64 = 24;

/// Values of the chain in the paper's example: a first face, two corollas, the closed cycle.
const VALUES: usize = 4;

// Codes of the palette.
const CHAIN: u32 = 5;
const CANDIDATES: u32 = 4;
const BOUNDARY: u32 = 2;
const GHOST: Rgb = [0.72, 0.74, 0.77];

/// The wrapping of one cell.
struct Wrapping {
    cell: CellId,
    steps: Vec<WrapStep>,
}

/// Figure 2, of a cell of five random cubes.
pub(super) fn figure2(request: &Request) -> Result<Drawn, CommandError> {
    let arrangement = five_cubes(request.seed.unwrap_or(SEED))?;
    let wrapping = chosen(&arrangement);
    let figures = match &wrapping {
        Some(wrapping) => {
            let panels = panels(&arrangement, wrapping)?;
            let columns = panels.len().div_ceil(2);
            let title = "gift wrapping of one 3-cell, step by step";
            vec![Sheet { panels, columns }.figure("figure2", title, 300, request.size)?]
        }
        None => Vec::new(),
    };
    let steps = wrapping.map_or_else(String::new, |wrapping| steps(&wrapping));
    Ok(Drawn { numbers: counts(&arrangement) + &steps, figures })
}

/// Of the cells that are wrapped in four values from one of their faces, or else in the nearest number, the one whose
/// faces come most evenly: each step shows something. Of equal ones the one whose first face is largest.
fn chosen(arrangement: &Arrangement) -> Option<Wrapping> {
    let sides = (0..arrangement.n_faces() as u32).flat_map(|face| {
        let cells = arrangement.cells_of_face(FaceId(face));
        [false, true].map(|back| (FaceSide { face: FaceId(face), back }, cells[usize::from(back)]))
    });
    let bounded = sides.filter(|(_, cell)| *cell != CellId(0));
    let wrapped = bounded.map(|(side, cell)| {
        let wrapping = Wrapping { cell, steps: arrangement.wrap(side) };
        (wrapping.rank(), arrangement.area(side.face), wrapping)
    });
    wrapped.min_by(|(a, x, _), (b, y, _)| a.cmp(b).then(y.total_cmp(x))).map(|(_, _, wrapping)| wrapping)
}

impl Wrapping {
    /// Less is better: how far the number of values is from four, and the least number of faces that a step adds,
    /// the more the better.
    fn rank(&self) -> (usize, Reverse<usize>) {
        let added = self.steps.iter().map(|step| step.corolla.len()).filter(|n| 0 < *n);
        (self.steps.len().abs_diff(VALUES), Reverse(added.min().unwrap_or(0)))
    }
}

fn panels(arrangement: &Arrangement, wrapping: &Wrapping) -> Result<Vec<Panel>, CommandError> {
    let shapes = Shapes::new(arrangement)?;
    let cell = shapes.cell(wrapping.cell)?;
    let eye = best_eye(&cell.mesh);
    let faces = |faces: &[FaceId], color: u32, opacity: f32| -> Result<Vec<Part>, CommandError> {
        let shapes = faces.iter().map(|&f| shapes.face(f)).collect::<Result<Vec<_>, _>>()?;
        Ok(plain(shapes, palette_color(color), opacity).collect())
    };
    let around: Vec<Vec<FaceId>> = wrapping.steps.iter().map(|step| candidates(arrangement, step)).collect();
    let frame: Vec<Point> = around.iter().flatten().flat_map(|&f| corners(arrangement, f)).collect();
    let mut panels = Vec::new();
    for (step, around) in wrapping.steps.iter().zip(&around) {
        let chain: Vec<FaceId> = step.chain.iter().map(|&(face, _)| face).collect();
        let boundary = segments(arrangement, step.boundary.iter().map(|&(edge, _)| edge));
        let mut grown = faces(&chain, CHAIN, 1.0)?;
        grown.push(Part::lines("cell", cell.edges.clone(), GHOST, 1.2));
        grown.push(Part::lines("boundary", boundary, palette_color(BOUNDARY), 4.0));
        panels.push(Panel::new(grown.clone()).from(eye).framed(frame.clone()));
        if !around.is_empty() {
            grown.extend(faces(around, CANDIDATES, 0.35)?);
            panels.push(Panel::new(grown).from(eye).framed(frame.clone()));
        }
    }
    Ok(lettered(panels))
}

/// The faces around the edges of the chain's boundary that are not in the chain.
fn candidates(arrangement: &Arrangement, step: &WrapStep) -> Vec<FaceId> {
    let around = step.boundary.iter().flat_map(|&(edge, _)| arrangement.faces_around(edge));
    let mut faces: Vec<FaceId> = around.map(|(face, _)| face).collect();
    faces.sort_unstable();
    faces.dedup();
    faces.retain(|face| step.chain.iter().all(|(in_chain, _)| in_chain != face));
    faces
}

fn corners(arrangement: &Arrangement, face: FaceId) -> Vec<Point> {
    let points = arrangement.complex().points();
    arrangement.face_vertices(face).flatten().map(|v| points.xyz(v as usize)).collect()
}

fn segments(arrangement: &Arrangement, edges: impl Iterator<Item = EdgeId>) -> Vec<Segment> {
    let points = arrangement.complex().points();
    edges.map(|e| arrangement.edge(e).map(|v| points.xyz(v.index()))).collect()
}

/// A line for each value of the chain.
fn steps(wrapping: &Wrapping) -> String {
    let mut text = format!("cell {}\n", wrapping.cell);
    for (k, step) in wrapping.steps.iter().enumerate() {
        let (chain, boundary, next) = (step.chain.len(), step.boundary.len(), step.corolla.len());
        writeln!(text, "value {k}: {chain} faces, {boundary} boundary edges, {next} faces next")
            .expect("a string takes all text");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chain_grows_until_it_is_closed() {
        let arrangement = five_cubes(SEED).unwrap();
        let wrapping = chosen(&arrangement).unwrap();
        assert_eq!(wrapping.steps.len(), VALUES, "seven panels");
        let last = wrapping.steps.last().unwrap();
        assert!(last.boundary.is_empty() && last.corolla.is_empty());
        let column = arrangement.complex().boundary(3).outer_view(wrapping.cell.index()).unwrap();
        let column: Vec<(u32, i8)> = column.iter().map(|(face, &sign)| (face as u32, sign)).collect();
        let chain: Vec<(u32, i8)> = last.chain.iter().map(|&(face, sign)| (face.0, sign)).collect();
        assert_eq!(chain, column, "the last value is the cell's column of ∂3");
    }

    #[test]
    fn seven_panels() {
        let drawn = figure2(&Request::default()).unwrap();
        assert_eq!(drawn.numbers.lines().count(), 2 + VALUES);
        let arrangement = five_cubes(SEED).unwrap();
        assert_eq!(panels(&arrangement, &chosen(&arrangement).unwrap()).unwrap().len(), 2 * VALUES - 1);
    }
}
