//! Planar stage 5: the chain complex from edges and faces.

use crate::counting::offsets;
use crate::grid::Grid;
use crate::operators::boundary_1;
use crate::parallel;
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
    parallel::each_chunk(&mut carrier_of, |_, part| {
        part.iter_mut().for_each(|run| *run = runs[*run as usize].carrier);
    });
    parallel::each_chunk(&mut ends, |_, part| part.iter_mut().for_each(|ends| ends.sort_unstable()));
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
        let columns = columns(&subdivision, &loops);
        let turned = Turned::new(ends);
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
                part.push_face(&turned, &subdivision, face, (columns[face + 1] - columns[face]) as usize);
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

/// Where the columns of ∂2 begin: every edge of a face's loops is in its column once, but for those with the face on
/// both sides.
fn columns(subdivision: &Subdivision, loops: &[u32]) -> Vec<u32> {
    let face_loops = subdivision.cycles_of_face.offsets();
    let begin = |face: usize| loops[face_loops[face] as usize];
    let mut lengths = parallel::map_light(subdivision.n_faces(), |face| begin(face + 1) - begin(face));
    for edge in subdivision.dangling_edges() {
        lengths[subdivision.face(2 * edge) as usize] -= 2;
    }
    offsets(lengths.into_iter())
}

/// Which edges lead along their carriers from the larger vertex to the smaller: a bit each, which stay in the
/// processor's cache.
struct Turned {
    bits: Vec<u64>,
    n_edges: usize,
}

impl Turned {
    fn new(ends: &[[u32; 2]]) -> Self {
        let word = |i: usize| {
            let of_word = &ends[64 * i..(64 * i + 64).min(ends.len())];
            of_word.iter().rev().fold(0, |bits, [a, b]| bits << 1 | u64::from(a > b))
        };
        Self { bits: parallel::map_light(ends.len().div_ceil(64), word), n_edges: ends.len() }
    }

    /// The half-edge along the edge or back for one along the carrier or back.
    fn half_edge(&self, h: u32) -> u32 {
        let edge = h / 2;
        h ^ (self.bits[edge as usize / 64] >> (edge % 64) & 1) as u32
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
    fn push_face(&mut self, turned: &Turned, subdivision: &Subdivision, face: usize, size: usize) {
        let cycles = subdivision.cycles_of_face[face].iter().map(|&cycle| subdivision.cycle(cycle));
        let all = take(&mut self.half_edges, cycles.clone().map(<[u32]>::len).sum());
        for (to, &h) in all.iter_mut().zip(cycles.clone().flatten()) {
            *to = turned.half_edge(h);
        }
        let column = take(&mut self.rows, size);
        if column.len() == all.len() {
            column.copy_from_slice(all);
        } else {
            let boundary = all.iter().zip(cycles.flatten()).filter(|(_, h)| subdivision.is_boundary(**h));
            column.iter_mut().zip(boundary).for_each(|(to, (h, _))| *to = *h);
        }
        sort(column, 2 * turned.n_edges);
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
