//! Stage 1d: half-edges with the same ends are one edge, found by a counting sort over the smaller ends.

use crate::parallel;
use lar_core::Cells;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// For each half-edge, from `tails[h]` to `heads[h]`, the first one of its edge: itself, when it comes first.
/// O(n log d) for at most d edges at a vertex.
pub(crate) fn first_of_edge(n_points: usize, tails: &[u32], heads: &[u32]) -> Vec<u32> {
    let first: Vec<AtomicU32> = (0..tails.len()).map(|_| AtomicU32::new(0)).collect();
    // Every part reads all half-edges and sorts those of its points: as many parts as there are threads.
    parallel::map(parallel::n_threads(), |part| {
        let points = parallel::part_of(n_points, part);
        join_edges_at(points.start as u32, points.end as u32, tails, heads, &first);
    });
    first.into_iter().map(AtomicU32::into_inner).collect()
}

/// The edges whose smaller end is one of from..to.
fn join_edges_at(from: u32, to: u32, tails: &[u32], heads: &[u32], first: &[AtomicU32]) {
    let own = || {
        let ends = tails.iter().zip(heads).zip(0u32..);
        let ascending = ends.map(|((&p, &q), h)| (p.min(q), p.max(q), h));
        ascending.filter(|&(low, _, _)| from <= low && low < to).map(|(low, high, h)| (low - from, high, h))
    };
    let mut offsets = vec![0u32; (to - from) as usize + 2];
    own().for_each(|(low, _, _)| offsets[low as usize + 2] += 1);
    for i in 2..offsets.len() {
        offsets[i] += offsets[i - 1];
    }
    // offsets[i + 1] is where the next entry of point i goes; in the end, where those of i + 1 begin.
    let mut entries = vec![0u64; offsets.last().map_or(0, |&n| n as usize)];
    for (low, high, h) in own() {
        let at = &mut offsets[low as usize + 1];
        entries[*at as usize] = u64::from(high) << 32 | u64::from(h);
        *at += 1;
    }
    for range in offsets.windows(2) {
        let around = &mut entries[range[0] as usize..range[1] as usize];
        around.sort_unstable();
        for edge in around.chunk_by(|a, b| a >> 32 == b >> 32) {
            for &h in edge {
                first[h as u32 as usize].store(edge[0] as u32, Relaxed);
            }
        }
    }
}

/// Edges in the order of their first half-edges, and for each half-edge 2 · edge, + 1 when it runs from the larger end
/// to the smaller.
pub(crate) fn edges(n_points: usize, tails: &[u32], heads: &[u32]) -> (Vec<[u32; 2]>, Vec<u32>) {
    let first = first_of_edge(n_points, tails, heads);
    let first_halves = parallel::select(first.len(), |h| first[h as usize] == h);
    let edges = parallel::map_light(first_halves.len(), |edge| {
        let h = first_halves[edge] as usize;
        [tails[h].min(heads[h]), tails[h].max(heads[h])]
    });
    let mut number = vec![0; first.len()];
    first_halves.iter().zip(0..).for_each(|(&h, edge)| number[h as usize] = edge);
    let mut codes = first;
    parallel::each_chunk(&mut codes, |begin, chunk| {
        for (code, h) in chunk.iter_mut().zip(begin..) {
            *code = 2 * number[*code as usize] + u32::from(tails[h] > heads[h]);
        }
    });
    (edges, codes)
}

/// No facet.
pub(crate) const NONE: u32 = u32::MAX;
/// More than one facet.
pub(crate) const MANY: u32 = u32::MAX - 1;

/// For each edge the facet that runs along it and the one that runs against it, or `NONE` or `MANY`.
pub(crate) fn facets_of_edges(n_edges: usize, facet_edges: &Cells) -> Vec<[u32; 2]> {
    let mut out = vec![[NONE; 2]; n_edges];
    for (codes, facet) in facet_edges.iter().zip(0..) {
        for &code in codes {
            let user = &mut out[(code / 2) as usize][(code % 2) as usize];
            *user = if *user == NONE { facet } else { MANY };
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_are_numbered_by_their_first_half_edges() {
        // Two triangles that share an edge, a third over the first, the other way round.
        let (tails, heads) = (vec![0, 1, 2, 2, 1, 3, 0, 2, 1], vec![1, 2, 0, 1, 3, 2, 2, 1, 0]);
        let (edges, codes) = edges(4, &tails, &heads);
        assert_eq!(edges, [[0, 1], [1, 2], [0, 2], [1, 3], [2, 3]]);
        assert_eq!(codes, [0, 2, 5, 3, 6, 9, 4, 3, 1]);
        let facets = facets_of_edges(5, &Cells::uniform(3, codes));
        assert_eq!(facets, [[0, 2], [0, MANY], [2, 0], [1, NONE], [NONE, 1]]);
    }
}
