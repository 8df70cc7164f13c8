//! Planar stage 4b: the rotation system, which runs pass each vertex in which order, and what follows from it: the
//! half-edge after each one round its face, and the components.
//!
//! The half-edges that leave a vertex are those of the runs that pass it: forwards ones by slope, then backwards ones by
//! slope, as carriers point right or straight up.

use crate::counting::offsets;
use crate::parallel;
use crate::planar::carriers::Carriers;
use crate::planar::edges::Edges;
use crate::union_find::UnionFind;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// A run at a vertex: its number, and the edge that would leave the vertex forwards if the run went on, which is marked
/// with the sides on which it does. There are fewer than 2^30 edges. (Plain numbers can be zero without being written.)
type Pass = [u32; 2];

const FORWARDS: u32 = 1 << 31;
const BACKWARDS: u32 = 1 << 30;

/// The half-edge that leaves the vertex forwards along the run.
fn forwards(&[_, edge]: &Pass) -> Option<u32> {
    (edge & FORWARDS != 0).then_some(2 * (edge & (BACKWARDS - 1)))
}

/// The half-edge that leaves the vertex backwards along the run.
fn backwards(&[_, edge]: &Pass) -> Option<u32> {
    (edge & BACKWARDS != 0).then(|| 2 * (edge & (BACKWARDS - 1)) - 1)
}

/// Calls `visit` with the vertices that runs pass.
fn each_pass(edges: &Edges, mut visit: impl FnMut(u32, Pass)) {
    for run in 0..edges.runs.len() as u32 {
        let range = edges.of_run(run);
        let mut marks = FORWARDS;
        for (&[start, _], edge) in edges.ends[range.clone()].iter().zip(range.start as u32..) {
            visit(start, [run, marks | edge]);
            marks = FORWARDS | BACKWARDS;
        }
        visit(edges.ends[range.end - 1][1], [run, BACKWARDS | range.end as u32]);
    }
}

/// The runs that pass each vertex.
pub(super) struct Rotation {
    offsets: Vec<u32>,
    passes: Vec<Pass>,
}

impl Rotation {
    /// Every thread takes some of the vertices and looks for them in all runs: to read these is quick, but what it fills
    /// in lies scattered. The runs of a vertex are in no order yet.
    pub(super) fn new(edges: &Edges, n_vertices: usize) -> Self {
        let ranges = (0..parallel::n_threads()).map(|part| parallel::part_of(n_vertices, part));
        let ranges: Vec<Range<usize>> = ranges.filter(|range| !range.is_empty()).collect();
        let mut ends = vec![0; n_vertices + 1];
        let parts = parallel::cut(&mut ends, ranges.iter().map(Range::len)).into_iter().zip(&ranges);
        parallel::each(parts.collect(), |(ends, range)| count_passes(edges, range.start as u32, ends));
        let sizes: Vec<usize> = ranges.iter().map(|range| ends[range.end - 1] as usize).collect();
        let begins = offsets(sizes.iter().map(|&size| size as u32));
        let mut passes = vec![[0; 2]; begins[sizes.len()] as usize];
        ends[n_vertices] = begins[sizes.len()];
        let parts = parallel::cut(&mut ends, ranges.iter().map(Range::len)).into_iter();
        let parts = parts.zip(parallel::cut(&mut passes, sizes.into_iter()));
        parallel::each(parts.zip(&ranges).zip(begins).collect(), |(((ends, passes), range), begin)| {
            fill_passes(edges, range.start as u32, ends, passes);
            ends.iter_mut().for_each(|offset| *offset += begin);
        });
        Self { offsets: ends, passes }
    }

    /// The half-edge after each one round its face: the first clockwise from its twin, of those that leave the same vertex.
    pub(super) fn next(&mut self, edges: &Edges, carriers: &Carriers) -> Vec<u32> {
        let next = parallel::atomic_zeros(2 * edges.ends.len());
        let rank = |&[run, _]: &Pass| carriers.rank[edges.runs[run as usize].carrier as usize];
        parallel::each_stretch(&mut self.passes, &self.offsets, |at| {
            match at {
                [a, b] if rank(b) < rank(a) => std::mem::swap(a, b),
                [_, _] => {}
                _ => at.sort_unstable_by_key(rank),
            }
            let leaving = || at.iter().filter_map(forwards).chain(at.iter().filter_map(backwards));
            let mut clockwise = leaving().last().unwrap_or_default();
            for h in leaving() {
                next[h as usize ^ 1].store(clockwise, Relaxed);
                clockwise = h;
            }
        });
        next.into_iter().map(AtomicU32::into_inner).collect()
    }

    /// The connected component of each run.
    pub(super) fn components(self, n_runs: usize) -> Vec<u32> {
        let mut sets = UnionFind::new(n_runs);
        for range in self.offsets.windows(2) {
            for w in self.passes[range[0] as usize..range[1] as usize].windows(2) {
                sets.union(w[0][0], w[1][0]);
            }
        }
        sets.labels().0
    }
}

/// Where the passes of each of some vertices end, among those of all of them.
fn count_passes(edges: &Edges, first_vertex: u32, ends: &mut [u32]) {
    each_pass(edges, |v, _| {
        if let Some(n) = ends.get_mut(v.wrapping_sub(first_vertex) as usize) {
            *n += 1;
        }
    });
    let mut end = 0;
    for n in ends {
        end += *n;
        *n = end;
    }
}

/// Fills in the passes of some vertices, from the back: each end moves to where the vertex begins.
fn fill_passes(edges: &Edges, first_vertex: u32, ends: &mut [u32], passes: &mut [Pass]) {
    each_pass(edges, |v, pass| {
        if let Some(end) = ends.get_mut(v.wrapping_sub(first_vertex) as usize) {
            *end -= 1;
            passes[*end as usize] = pass;
        }
    });
}
