//! The boundary operators from edges, loops and cells.

use crate::merge::Merged;
use crate::parallel;
use lar_core::{Cells, ChainComplex, Operator};
use std::ops::Range;

pub(crate) fn boundary_1(n_vertices: usize, edges: Vec<[u32; 2]>) -> Operator {
    let (mut offsets, mut signs) = (vec![0; edges.len() + 1], vec![0; 2 * edges.len()]);
    parallel::each_chunk(&mut offsets, |begin, part| {
        part.iter_mut().zip((2 * begin as u32..).step_by(2)).for_each(|(to, offset)| *to = offset);
    });
    parallel::each_chunk(&mut signs, |_, part| {
        part.chunks_exact_mut(2).for_each(|pair| pair.copy_from_slice(&[-1, 1]));
    });
    let columns = Cells::from_parts(offsets, edges.into_flattened());
    ChainComplex::operator_from_columns(n_vertices, columns, signs)
}

pub(crate) fn boundary_2(n_edges: usize, faces: &Merged) -> Operator {
    let n_faces = faces.face_loops.len() - 1;
    let parts = parallel::map(parallel::n_threads(), |part| {
        let range = parallel::part_of(n_faces, part);
        let mut columns =
            Columns::with_capacity(faces.loops.indices().len() * range.len() / n_faces.max(1) + 8);
        range.for_each(|face| {
            columns.push(faces.face_loops[face] as usize..faces.face_loops[face + 1] as usize, faces);
        });
        columns
    });
    let Columns { ends, edges, signs, .. } = Columns::joined(parts);
    ChainComplex::operator_from_columns(n_edges, Cells::from_parts(ends, edges), signs)
}

/// Columns of ∂2.
struct Columns {
    /// Where each column ends, after a 0.
    ends: Vec<u32>,
    edges: Vec<u32>,
    signs: Vec<i8>,
    /// The half-edges of a column.
    scratch: Vec<u32>,
}

impl Columns {
    fn with_capacity(n: usize) -> Self {
        let (edges, signs) = (Vec::with_capacity(n), Vec::with_capacity(n));
        Self { ends: vec![0], edges, signs, scratch: Vec::new() }
    }

    /// Adds the face with some loops. An edge that stands in them in both directions is no boundary.
    fn push(&mut self, loops: Range<usize>, faces: &Merged) {
        let offsets = faces.loops.offsets();
        let half_edges = &faces.loops.indices()[offsets[loops.start] as usize..offsets[loops.end] as usize];
        self.scratch.clear();
        self.scratch.extend_from_slice(half_edges);
        self.scratch.sort_unstable();
        for same in self.scratch.chunk_by(|a, b| a / 2 == b / 2) {
            if let &[h] = same {
                self.edges.push(h / 2);
                self.signs.push(1 - 2 * (h % 2) as i8);
            }
        }
        self.ends.push(self.edges.len() as u32);
    }

    fn joined(parts: Vec<Self>) -> Self {
        let mut parts = parts.into_iter();
        let mut all = parts.next().unwrap_or_else(|| Self::with_capacity(0));
        for part in parts {
            let base = all.edges.len() as u32;
            all.ends.extend(part.ends[1..].iter().map(|end| base + end));
            all.edges.extend(part.edges);
            all.signs.extend(part.signs);
        }
        all
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
