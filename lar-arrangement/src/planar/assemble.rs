//! Planar stage 5: the chain complex from edges and faces.

use crate::counting::offsets;
use crate::grid::Grid;
use crate::parallel;
use crate::pipeline::boundary_1;
use crate::planar::carriers::Carriers;
use crate::planar::chains::Chains;
use crate::planar::edges::Edges;
use crate::planar::result::PlanarArrangement;
use crate::stats::Stats;
use crate::subdivision::Subdivision;
use crate::winding::Windings;
use lar_core::{Cells, ChainComplex, Points};
use std::sync::OnceLock;

/// `positions` are those of all vertices of the chains; vertices without edges are left out.
pub(crate) fn assemble(
    mut positions: Vec<[f64; 2]>,
    mut edges: Edges,
    subdivision: Subdivision,
    mut chains: Chains,
    carriers: Carriers,
    grid: Grid,
) -> PlanarArrangement {
    let mut sources = std::mem::take(&mut chains.vertices);
    if edges.ends.len() < chains.n_edges() {
        let is_used = edges.number_vertices(positions.len());
        retain(&mut positions, &is_used);
        retain(&mut sources, &is_used);
    }
    let n_components = subdivision.n_components;
    let points = Points::from_columns(2, positions.into_flattened());
    let faces = Faces::new(&edges.ends, subdivision);
    let Edges { mut ends, edge_at, runs, run_of: mut carrier_of } = edges;
    let n_edges = ends.len();
    carrier_of.iter_mut().for_each(|run| *run = runs[*run as usize].carrier);
    ends.iter_mut().for_each(|ends| ends.sort_unstable());
    let (boundary_1, boundary_2) = parallel::join(
        || boundary_1(points.len(), ends),
        || ChainComplex::operator_from_columns(n_edges, faces.columns, faces.signs),
    );
    PlanarArrangement {
        complex: ChainComplex::new(points, vec![boundary_1, boundary_2]),
        loops: faces.loops,
        face_loops: faces.face_loops,
        n_components,
        carriers,
        chains,
        sources,
        grid,
        index: OnceLock::new(),
        edge_at,
        carrier_of,
        regions: Vec::new(),
        windings: Windings::default(),
        isolated: Vec::new(),
        stats: Stats::default(),
    }
}

fn retain<T>(items: &mut Vec<T>, keep: &[bool]) {
    let mut keep = keep.iter();
    items.retain(|_| *keep.next().expect("one flag an item"));
}

impl Edges {
    /// Numbers the vertices that have edges, in their order; returns which have.
    fn number_vertices(&mut self, n: usize) -> Vec<bool> {
        let mut is_used = vec![false; n];
        self.ends.as_flattened().iter().for_each(|&v| is_used[v as usize] = true);
        let mut n_used = 0;
        let new: Vec<u32> = is_used
            .iter()
            .map(|&used| {
                n_used += u32::from(used);
                n_used.wrapping_sub(1)
            })
            .collect();
        self.ends.as_flattened_mut().iter_mut().for_each(|v| *v = new[*v as usize]);
        is_used
    }
}

/// The loops of all faces and the columns of ∂2.
struct Faces {
    loops: Cells,
    face_loops: Vec<u32>,
    columns: Cells,
    signs: Vec<i8>,
}

/// So many faces are filled in at a time.
const CHUNK: usize = 4096;

impl Faces {
    /// The lengths of all loops and columns first, then all of them in their places.
    fn new(ends: &[[u32; 2]], subdivision: Subdivision) -> Self {
        let lengths = subdivision.cycles_of_face.indices().iter().map(|&c| subdivision.cycle(c).len() as u32);
        let loops = offsets(lengths);
        let face_loops = subdivision.cycles_of_face.offsets();
        let n_faces = subdivision.n_faces();
        let sizes = parallel::map_light(n_faces, |face| subdivision.n_boundary_edges(face));
        let columns = offsets(sizes.into_iter());
        let mut half_edges = vec![0; loops[loops.len() - 1] as usize];
        let mut rows = vec![0; columns[n_faces] as usize];
        let mut signs = vec![0; rows.len()];
        let (n_chunks, range) = parallel::chunks(n_faces, CHUNK);
        let begin = |face: usize| loops[face_loops[face] as usize] as usize;
        let n_half_edges = |chunk| begin(range(chunk).end) - begin(range(chunk).start);
        let n_rows = |chunk| (columns[range(chunk).end] - columns[range(chunk).start]) as usize;
        let parts = parallel::cut(&mut half_edges, (0..n_chunks).map(n_half_edges)).into_iter();
        let parts = parts.zip(parallel::cut(&mut rows, (0..n_chunks).map(n_rows)));
        let parts = parts.zip(parallel::cut(&mut signs, (0..n_chunks).map(n_rows)));
        parallel::each(parts.enumerate().collect(), |(chunk, ((half_edges, rows), signs))| {
            let mut part = Part { half_edges, rows, signs };
            range(chunk).for_each(|face| {
                part.push_face(ends, &subdivision, face, (columns[face + 1] - columns[face]) as usize);
            });
        });
        let (face_loops, _) = subdivision.cycles_of_face.into_parts();
        Self {
            loops: Cells::from_parts(loops, half_edges),
            face_loops,
            columns: Cells::from_parts(columns, rows),
            signs,
        }
    }
}

/// What is not yet filled in of the loops of some faces and their columns of ∂2.
struct Part<'a> {
    half_edges: &'a mut [u32],
    rows: &'a mut [u32],
    signs: &'a mut [i8],
}

impl Part<'_> {
    /// Half-edges lead along the carrier or back; those of a loop lead from the smaller vertex to the larger or back.
    fn push_face(&mut self, ends: &[[u32; 2]], subdivision: &Subdivision, face: usize, size: usize) {
        let turned = |h: u32| {
            let [a, b] = ends[(h / 2) as usize];
            if a < b { h } else { h ^ 1 }
        };
        let column = take(&mut self.rows, size);
        let mut next = column.iter_mut();
        for &cycle in &subdivision.cycles_of_face[face] {
            let half_edges = subdivision.cycle(cycle);
            let to = take(&mut self.half_edges, half_edges.len());
            for (to, &h) in to.iter_mut().zip(half_edges) {
                *to = turned(h);
                if subdivision.is_boundary(h)
                    && let Some(next) = next.next()
                {
                    *next = *to;
                }
            }
        }
        sort(column, 2 * ends.len());
        let signs = take(&mut self.signs, column.len());
        for (h, sign) in column.iter_mut().zip(signs) {
            *sign = if *h % 2 == 0 { 1 } else { -1 };
            *h /= 2;
        }
    }
}

/// Cuts off the beginning of a slice.
fn take<'a, T>(rest: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let (taken, after) = std::mem::take(rest).split_at_mut(length);
    *rest = after;
    taken
}

/// Sorts distinct numbers below n. Of a large part of them, which only few faces have, it marks each.
fn sort(numbers: &mut [u32], n: usize) {
    if numbers.len() < 1024 || numbers.len() < n / 64 {
        return numbers.sort_unstable();
    }
    let mut marks = vec![0u64; n.div_ceil(64)];
    numbers.iter().for_each(|&x| marks[x as usize / 64] |= 1 << (x % 64));
    let mut next = numbers.iter_mut();
    for (mut mark, begin) in marks.into_iter().zip((0u32..).step_by(64)) {
        while mark != 0 {
            *next.next().expect("as many numbers as marks") = begin + mark.trailing_zeros();
            mark &= mark - 1;
        }
    }
}
