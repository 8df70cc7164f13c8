//! Arrangements as what a window explores: cells with provenance and triangles, Booleans, gift wrapping.

use crate::CommandError;
use lar_arrangement::planar::PlanarArrangement;
use lar_arrangement::{Arrangement, Closure, Expression, FaceSide, FillRule};
use lar_core::{CellId, Chain, ChainError, FaceId};
use lar_triangle::{FaceLoops, Triangulator};
use lar_viewer::session::WrapStep;
use lar_viewer::{Answers, CellData, FaceParent, Provenance, Queries};
use std::collections::BTreeSet;

/// What a window tells of the cells of an arrangement.
pub(crate) fn cell_data(arrangement: &Arrangement) -> Result<CellData, CommandError> {
    let triangles = lar_triangle::triangulate(arrangement.complex())?;
    let data = CellData::new(arrangement.complex().clone())?;
    let data = data.with_triangles(triangles.triangles, triangles.face_offsets)?;
    Ok(data.with_exterior().with_provenance(provenance(arrangement)))
}

/// The faces, edges and vertices of a partition of the plane; its exterior is face 0.
pub(crate) fn plane_data(arrangement: &PlanarArrangement) -> Result<CellData, CommandError> {
    let complex = arrangement.complex();
    let loops = FaceLoops::new(complex)?;
    let (mut triangles, mut offsets) = (Vec::new(), vec![0, 0]);
    let mut triangulator = Triangulator::new();
    for f in (1..=arrangement.n_faces()).map(|f| FaceId(f as u32)) {
        triangulator.face(complex.points(), loops.face(f), &mut triangles)?;
        offsets.push(triangles.len() as u32);
    }
    Ok(CellData::new(complex.clone())?.with_exterior().with_triangles(triangles, offsets)?)
}

fn provenance(arrangement: &Arrangement) -> Provenance {
    let n_solids = arrangement.n_solids();
    let parents = |face: FaceId| {
        let parents = arrangement.parents(face).iter();
        parents.map(|p| FaceParent { solid: p.solid, face: p.face, sign: p.sign }).collect()
    };
    let solids = |cell: CellId| {
        let inside = (0..n_solids).filter(|&s| arrangement.winding(cell, s) != 0);
        inside.map(|s| s as u32).collect()
    };
    Provenance {
        solids: (0..n_solids).map(|s| arrangement.solid_name(s).to_owned()).collect(),
        parents_of_face: (0..).map(FaceId).take(arrangement.n_faces()).map(parents).collect(),
        solids_of_cell: (0..).map(CellId).take(arrangement.n_cells()).map(solids).collect(),
    }
}

/// An arrangement, to be asked.
#[derive(Debug)]
pub(crate) struct Explored {
    arrangement: Arrangement,
}

impl Explored {
    pub(crate) fn new(arrangement: Arrangement) -> Self {
        Self { arrangement }
    }
}

impl Queries for Explored {
    fn boolean(&self, expression: &str) -> Result<Chain, String> {
        let names: Vec<&str> =
            (0..self.arrangement.n_solids()).map(|s| self.arrangement.solid_name(s)).collect();
        let expression = Expression::parse(expression, &names).map_err(|e| e.to_string())?;
        let solid = self.arrangement.boolean(&expression, FillRule::NonZero).map_err(|e| e.to_string())?;
        Ok(solid.chain())
    }

    /// Shell after shell where a cell has several.
    fn wrapping(&self, cell: u32) -> Result<Vec<WrapStep>, String> {
        let column = self.arrangement.complex().boundary(3).outer_view(cell as usize);
        let faces: Vec<(u32, i8)> =
            column.iter().flat_map(|c| c.iter()).map(|(face, &sign)| (face as u32, sign)).collect();
        let (mut steps, mut wrapped) = (Vec::<WrapStep>::new(), BTreeSet::new());
        // Each round wraps at least the face that it begins with.
        while let Some(&(face, sign)) = faces.iter().find(|entry| !wrapped.contains(*entry)) {
            // The cell lies behind the faces whose normals point out of it.
            let shell = self.arrangement.wrap(FaceSide { face: FaceId(face), back: 0 < sign });
            let shell_steps = shell.iter().map(|step| self.step(step, &wrapped));
            steps.extend(shell_steps.collect::<Result<Vec<_>, _>>().map_err(|e| e.to_string())?);
            wrapped
                .extend(shell.last().into_iter().flat_map(|s| s.chain.iter().map(|&(f, sign)| (f.0, sign))));
        }
        if steps.is_empty() { Err(format!("c{cell} has no faces to wrap")) } else { Ok(steps) }
    }
}

impl Explored {
    /// A step of a shell, with the shells that are wrapped already.
    fn step(
        &self,
        step: &lar_arrangement::WrapStep,
        wrapped: &BTreeSet<(u32, i8)>,
    ) -> Result<WrapStep, ChainError> {
        let complex = self.arrangement.complex();
        let own = step.chain.iter().map(|&(face, sign)| (face.0, sign));
        let chain = own.chain(wrapped.iter().copied()).map(|(face, sign)| (face, i32::from(sign)));
        let boundary = step.boundary.iter().map(|&(edge, sign)| (edge.0, i32::from(sign)));
        let corolla = step.corolla.iter().map(|side| (side.face.0, if side.back { 1 } else { -1 }));
        Ok(WrapStep {
            chain: complex.chain(2, chain)?,
            boundary: complex.chain(1, boundary)?,
            corolla: complex.chain(2, corolla)?,
        })
    }
}

/// Faces of the largest cell whose gift wrapping is written down: the steps of a long one hold many chains.
const MOST_WRAPPED: usize = 2000;

/// What a page cannot ask the arrangement, asked before.
pub(crate) fn answers(explored: &Explored) -> Answers {
    let arrangement = &explored.arrangement;
    let refusal = |solid| {
        let is_open = arrangement.closure(solid) != Closure::Closed;
        let refused = || arrangement.boolean(&Expression::solid(solid), FillRule::NonZero).err();
        is_open.then(refused).flatten().map(|error| error.to_string())
    };
    let n_faces = |cell| arrangement.complex().boundary(3).outer_view(cell).map_or(0, |column| column.nnz());
    let wrapping = |cell: usize| {
        let steps = if n_faces(cell) <= MOST_WRAPPED { explored.wrapping(cell as u32) } else { Ok(vec![]) };
        Answers::recorded(&steps.unwrap_or_default())
    };
    Answers {
        refusals: (0..arrangement.n_solids()).map(refusal).collect(),
        wrappings: (0..arrangement.n_cells()).map(wrapping).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes;
    use lar_core::Surface;
    use lar_viewer::CellRef;

    fn three_cubes() -> Arrangement {
        let surfaces = scenes::surfaces(&scenes::three_cubes()).unwrap();
        lar_arrangement::arrange(&surfaces).unwrap()
    }

    #[test]
    fn cells_know_their_solids_and_faces_their_parents() {
        let data = cell_data(&three_cubes()).unwrap();
        assert_eq!((data.solids().len(), data.n_cells(3)), (3, 8));
        assert!(data.is_exterior(CellRef::new(3, 0)) && data.solids_of(CellRef::new(3, 0)).is_empty());
        for cell in 1..8 {
            assert!(!data.solids_of(CellRef::new(3, cell)).is_empty(), "c{cell}");
        }
        for face in 0..data.n_cells(2) as u32 {
            assert!(!data.parents(CellRef::new(2, face)).is_empty(), "f{face}");
            assert!(!data.triangles(face).is_empty(), "f{face}");
        }
    }

    #[test]
    fn wrapping_ends_in_the_boundary_of_the_cell() {
        let arrangement = three_cubes();
        let data = cell_data(&arrangement).unwrap();
        let explored = Explored::new(arrangement);
        for cell in 0..8 {
            let steps = explored.wrapping(cell).unwrap();
            let last = steps.last().unwrap();
            assert_eq!(last.chain, data.boundary(CellRef::new(3, cell)).unwrap(), "c{cell}");
            assert!(last.boundary.is_zero() && last.corolla.is_zero());
            for step in &steps {
                assert_eq!(step.boundary, data.boundary_of(&step.chain).unwrap());
            }
        }
        assert_eq!(explored.wrapping(8).unwrap_err(), "c8 has no faces to wrap");
    }

    #[test]
    fn booleans_are_chains_or_say_what_is_wrong() {
        let explored = Explored::new(three_cubes());
        let names: Vec<String> = (0..3).map(|s| explored.arrangement.solid_name(s).to_owned()).collect();
        let union = explored.boolean(&format!("{:?} | {:?} | {:?}", names[0], names[1], names[2]));
        assert_eq!(union.unwrap().entries().len(), 7);
        assert!(explored.boolean("nothing of that name").is_err());
    }

    #[test]
    fn what_is_written_down_is_what_the_arrangement_answers() {
        let arrangement = three_cubes();
        let data = cell_data(&arrangement).unwrap();
        let explored = Explored::new(arrangement);
        let answers = answers(&explored);
        for cell in 0..8 {
            assert_eq!(answers.wrapping(&data, cell), explored.wrapping(cell), "c{cell}");
        }
        let names: Vec<&str> = data.solids().iter().map(String::as_str).collect();
        for text in ["{0}", "!{0} & {1}", "{0} ^ {1} ^ {2}", "({0} - {1}) | {2}"] {
            let name = |text: String, i: usize| text.replace(&format!("{{{i}}}"), &format!("{:?}", names[i]));
            let text = (0..3).fold(text.to_owned(), name);
            let expression = Expression::parse(&text, &names).unwrap();
            let cells =
                answers.cells_where(&data, &expression.operands(), |inside| expression.evaluate(inside));
            assert_eq!(cells, explored.boolean(&text), "{text}");
        }
    }

    #[test]
    fn open_operands_are_refused_in_the_same_words() {
        let mut surfaces = scenes::surfaces(&scenes::three_cubes()).unwrap();
        let mut open = Surface::new(surfaces[1].name.clone(), surfaces[1].points.clone());
        (1..surfaces[1].n_faces()).for_each(|f| _ = open.push_face(surfaces[1].face(f), 1));
        surfaces[1] = open;
        let arrangement = lar_arrangement::arrange(&surfaces).unwrap();
        let data = cell_data(&arrangement).unwrap();
        let open = format!("{:?}", arrangement.solid_name(1));
        let explored = Explored::new(arrangement);
        let refused = explored.boolean(&open).unwrap_err();
        assert!(refused.contains("bounds no solid"), "{refused}");
        assert_eq!(answers(&explored).cells_where(&data, &[0, 1], |_| true), Err(refused));
    }
}
