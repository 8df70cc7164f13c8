//! The boundary operators from edges, loops and cells.

use crate::counting::joined;
use crate::merge::Merged;
use crate::parallel;
use lar_core::{Cells, ChainComplex, Operator};
use std::ops::Range;

pub(crate) fn boundary_1(n_vertices: usize, edges: Vec<[u32; 2]>) -> Operator {
    let (mut offsets, mut signs) = (parallel::zeros(edges.len() + 1), parallel::zeros(2 * edges.len()));
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
    let parts = parallel::map(parallel::n_threads(), |part| columns(parallel::part_of(n_faces, part), faces));
    let (offsets, entries) = joined(parts);
    let signs = entries.iter().map(|h| 1 - 2 * (h % 2) as i8).collect();
    let edges = entries.into_iter().map(|h| h / 2).collect();
    ChainComplex::operator_from_columns(n_edges, Cells::from_parts(offsets, edges), signs)
}

/// The columns of ∂2 for some faces: half-edges of their loops, ascending. An edge that stands in a face in both directions
/// is no boundary.
fn columns(range: Range<usize>, faces: &Merged) -> (Vec<u32>, Vec<u32>) {
    let begin_of = |face: usize| faces.loops.offsets()[faces.face_loops[face] as usize] as usize;
    let mut offsets = Vec::with_capacity(range.len() + 1);
    let mut entries = Vec::with_capacity(3 * range.len());
    let mut column: Vec<u32> = Vec::new();
    offsets.push(0);
    for face in range {
        column.clear();
        column.extend_from_slice(&faces.loops.indices()[begin_of(face)..begin_of(face + 1)]);
        column.sort_unstable();
        for same in column.chunk_by(|a, b| a / 2 == b / 2) {
            if let &[h] = same {
                entries.push(h);
            }
        }
        offsets.push(entries.len() as u32);
    }
    (offsets, entries)
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
