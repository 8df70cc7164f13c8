//! The boundary operators from edges, loops and cells.

use crate::parallel;
use lar_core::{Cells, ChainComplex, Operator};
use std::ops::Range;

pub(crate) fn boundary_1(n_vertices: usize, edges: Vec<[u32; 2]>) -> Operator {
    let offsets = parallel::map_light(edges.len() + 1, |edge| 2 * edge as u32);
    let signs = parallel::map_light(edges.len(), |_| [-1, 1]).into_flattened();
    let columns = Cells::from_parts(offsets, edges.into_flattened());
    ChainComplex::operator_from_columns(n_vertices, columns, signs)
}

/// ∂2 of faces whose loops are `face_loops[f]..face_loops[f + 1]` of `loops`.
pub(crate) fn boundary_2(n_edges: usize, loops: &Cells, face_loops: &[u32]) -> Operator {
    Columns::of_faces(loops, face_loops).into_operator(n_edges)
}

/// Whether half-edges are of different edges.
fn distinct(a: u32, b: u32) -> bool {
    a / 2 != b / 2
}

/// Columns of ∂2.
pub(crate) struct Columns {
    offsets: Vec<u32>,
    edges: Vec<u32>,
    signs: Vec<i8>,
}

impl Columns {
    /// Of faces whose loops are `face_loops[f]..face_loops[f + 1]` of `loops`.
    pub(crate) fn of_faces(loops: &Cells, face_loops: &[u32]) -> Self {
        let n_faces = face_loops.len() - 1;
        let of_part = |part: usize| {
            // The first part gets room for the others.
            let n = if part == 0 { [n_faces, loops.indices().len()] } else { [0; 2] };
            Self::new(parallel::part_of(n_faces, part), loops, face_loops, n)
        };
        let mut parts = parallel::map(parallel::n_threads(), of_part).into_iter();
        let mut all = parts.next().expect("there is a thread");
        parts.for_each(|part| all.append(&part));
        all
    }

    /// The operator, whose rows are so many edges: looks through the columns once more.
    pub(crate) fn into_operator(self, n_edges: usize) -> Operator {
        let Self { offsets, edges, signs } = self;
        ChainComplex::operator_from_columns(n_edges, Cells::from_parts(offsets, edges), signs)
    }

    /// For some faces the half-edges of their loops, ascending, with room for so many columns and entries. An edge that
    /// stands in a face in both directions is no boundary.
    fn new(
        range: Range<usize>,
        loops: &Cells,
        face_loops: &[u32],
        [n_columns, n_entries]: [usize; 2],
    ) -> Self {
        let begin_of = |face: usize| loops.offsets()[face_loops[face] as usize] as usize;
        let n_entries = n_entries.max(begin_of(range.end) - begin_of(range.start));
        let mut out = Self {
            offsets: Vec::with_capacity(n_columns.max(range.len()) + 1),
            edges: Vec::with_capacity(n_entries),
            signs: Vec::with_capacity(n_entries),
        };
        let mut column: Vec<u32> = Vec::new();
        out.offsets.push(0);
        for face in range {
            let half_edges = &loops.indices()[begin_of(face)..begin_of(face + 1)];
            match half_edges {
                &[a, b, c] if distinct(a, b) && distinct(b, c) && distinct(c, a) => {
                    let ([a, b], c) = ([a.min(b), a.max(b)], c);
                    out.push([a.min(c), a.max(b.min(c)), b.max(c)]);
                }
                _ => {
                    column.clear();
                    column.extend_from_slice(half_edges);
                    column.sort_unstable();
                    let same = column.chunk_by(|&a, &b| !distinct(a, b));
                    same.filter(|same| same.len() == 1).for_each(|same| out.push([same[0]]));
                }
            }
            out.offsets.push(out.edges.len() as u32);
        }
        out
    }

    fn push<const N: usize>(&mut self, half_edges: [u32; N]) {
        self.edges.extend_from_slice(&half_edges.map(|h| h / 2));
        self.signs.extend_from_slice(&half_edges.map(|h| 1 - 2 * (h % 2) as i8));
    }

    fn append(&mut self, other: &Self) {
        let base = self.edges.len() as u32;
        let Self { offsets, edges, signs } = self;
        // As it is, that takes a fraction of what giving items to threads one by one does.
        parallel::join(
            || edges.extend_from_slice(&other.edges),
            || {
                offsets.extend(other.offsets[1..].iter().map(|offset| base + offset));
                signs.extend_from_slice(&other.signs);
            },
        );
    }
}

pub(crate) fn boundary_3(cells_of_face: &[[u32; 2]], n_cells: usize) -> Operator {
    let mut offsets = vec![0u32; n_cells + 1];
    let proper = || cells_of_face.iter().zip(0u32..).filter(|([front, back], _)| front != back);
    for (cells, _) in proper() {
        cells.iter().for_each(|&c| offsets[c as usize + 1] += 1);
    }
    for c in 0..n_cells {
        offsets[c + 1] += offsets[c];
    }
    let mut fill = offsets.clone();
    let mut faces = vec![0; offsets[n_cells] as usize];
    let mut signs = vec![0i8; faces.len()];
    for (cells, face) in proper() {
        for (&cell, sign) in cells.iter().zip([-1, 1]) {
            let at = fill[cell as usize] as usize;
            (faces[at], signs[at]) = (face, sign);
            fill[cell as usize] += 1;
        }
    }
    ChainComplex::operator_from_columns(cells_of_face.len(), Cells::from_parts(offsets, faces), signs)
}
