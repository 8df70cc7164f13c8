//! Stage 1d: half-edges with the same ends are one edge, found by a counting sort over the smaller ends.

use crate::boxes::bits_of;
use crate::parallel;
use lar_core::Cells;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Among so few half-edges those of one edge are looked for one by one.
const FEW: usize = 24;

/// Half-edges a chunk of work, a multiple of 64.
const CHUNK: usize = 1 << 13;

/// Half-edges by their ends.
#[derive(Clone, Copy)]
pub(crate) enum HalfEdges<'a> {
    /// Those of triangles one after the other: from each corner to the next.
    OfTriangles(&'a [[u32; 3]]),
    /// From `tails[h]` to `heads[h]`.
    Listed { tails: &'a [u32], heads: &'a [u32] },
}

impl HalfEdges<'_> {
    fn len(&self) -> usize {
        match self {
            Self::OfTriangles(corners) => 3 * corners.len(),
            Self::Listed { tails, .. } => tails.len(),
        }
    }

    /// From where to where one leads.
    pub(crate) fn ends(&self, h: usize) -> [u32; 2] {
        match self {
            Self::OfTriangles(corners) => {
                let (corners, k) = (&corners[h / 3], h % 3);
                [corners[k], corners[if k == 2 { 0 } else { k + 1 }]]
            }
            Self::Listed { tails, heads } => [tails[h], heads[h]],
        }
    }

    /// Calls `f` with each and its smaller end.
    fn for_each(&self, mut f: impl FnMut(u32, u32)) {
        match self {
            Self::OfTriangles(corners) => {
                for (&[a, b, c], h) in corners.iter().zip((0u32..).step_by(3)) {
                    f(h, a.min(b));
                    f(h + 1, b.min(c));
                    f(h + 2, c.min(a));
                }
            }
            Self::Listed { tails, heads } => {
                tails.iter().zip(*heads).zip(0..).for_each(|((&p, &q), h)| f(h, p.min(q)));
            }
        }
    }
}

/// For each half-edge the first one of its edge: itself, when it comes first. O(n log n).
pub(crate) fn first_of_edge(n_points: usize, half_edges: HalfEdges<'_>) -> Vec<u32> {
    if half_edges.len() < n_points / 16 {
        return firsts_by_sorting(half_edges);
    }
    shared_firsts(n_points, half_edges).into_iter().map(AtomicU32::into_inner).collect()
}

/// The same where most points have none, and looking at all points would take longer.
fn firsts_by_sorting(half_edges: HalfEdges<'_>) -> Vec<u32> {
    let keyed = |h: usize| {
        let [p, q] = half_edges.ends(h);
        ([p.min(q), p.max(q)], h as u32)
    };
    let mut sorted: Vec<([u32; 2], u32)> = (0..half_edges.len()).map(keyed).collect();
    sorted.sort_unstable();
    let mut first = vec![0; sorted.len()];
    for edge in sorted.chunk_by(|a, b| a.0 == b.0) {
        edge.iter().for_each(|&(_, h)| first[h as usize] = edge[0].1);
    }
    first
}

/// O(n log d) for at most d edges at a vertex.
fn shared_firsts(n_points: usize, half_edges: HalfEdges<'_>) -> Vec<AtomicU32> {
    let first = parallel::atomic_zeros(half_edges.len());
    // Every part reads all half-edges and sorts those of its points: as many parts as there are threads.
    parallel::map(parallel::n_threads(), |part| {
        let points = parallel::part_of(n_points, part);
        join_edges_at(points.start as u32, points.end as u32, half_edges, &first);
    });
    first
}

/// The edges whose smaller end is one of from..to.
fn join_edges_at(from: u32, to: u32, half_edges: HalfEdges<'_>, first: &[AtomicU32]) {
    let mut offsets = vec![0u32; (to - from) as usize + 2];
    half_edges.for_each(|_, low| {
        if from <= low && low < to {
            offsets[(low - from) as usize + 2] += 1;
        }
    });
    for i in 2..offsets.len() {
        offsets[i] += offsets[i - 1];
    }
    // offsets[i + 1] is where the next entry of point i goes; in the end, where those of i + 1 begin.
    let mut entries = vec![0u32; offsets.last().map_or(0, |&n| n as usize)];
    half_edges.for_each(|h, low| {
        if from <= low && low < to {
            let at = &mut offsets[(low - from) as usize + 1];
            entries[*at as usize] = h;
            *at += 1;
        }
    });
    let (mut uppers, mut sorted) = (Vec::new(), Vec::new());
    for range in offsets.windows(2) {
        // Ascending, so the first of an edge comes first.
        let around = &entries[range[0] as usize..range[1] as usize];
        uppers.clear();
        uppers.extend(around.iter().map(|&h| {
            let [p, q] = half_edges.ends(h as usize);
            p.max(q)
        }));
        if around.len() <= FEW {
            for (&h, upper) in around.iter().zip(&uppers) {
                let same = uppers.iter().position(|other| other == upper).expect("it is one of them");
                first[h as usize].store(around[same], Relaxed);
            }
            continue;
        }
        sorted.clear();
        sorted.extend(around.iter().zip(&uppers).map(|(&h, &upper)| (upper, h)));
        sorted.sort_unstable();
        for edge in sorted.chunk_by(|a, b| a.0 == b.0) {
            edge.iter().for_each(|&(_, h)| first[h as usize].store(edge[0].1, Relaxed));
        }
    }
}

/// Edges in the order of their first half-edges, and for each half-edge 2 · edge, + 1 when it runs from the larger end
/// to the smaller.
pub(crate) fn edges(n_points: usize, half_edges: HalfEdges<'_>) -> (Vec<[u32; 2]>, Vec<u32>) {
    let codes = shared_firsts(n_points, half_edges);
    let (n_chunks, range) = parallel::chunks(codes.len(), CHUNK);
    // Which half-edges are the first of their edges, as bits.
    let firsts = parallel::map(n_chunks, |chunk| {
        let is_first = |h: usize| codes[h].load(Relaxed) as usize == h;
        let words = range(chunk).step_by(64).map(|begin| {
            let end = (begin + 64).min(codes.len());
            (begin..end).fold(0u64, |bits, h| bits | u64::from(is_first(h)) << (h - begin))
        });
        words.collect::<Vec<u64>>()
    });
    let counts: Vec<usize> =
        firsts.iter().map(|words| words.iter().map(|w| w.count_ones() as usize).sum()).collect();
    let mut edges = parallel::zeros(counts.iter().sum());
    let mut begin = 0;
    let begins = counts.iter().map(|count| {
        begin += count;
        (begin - count) as u32
    });
    let parts: Vec<_> =
        begins.zip(&firsts).zip(parallel::cut(&mut edges, counts.iter().copied())).enumerate().collect();
    parallel::each(parts, |(chunk, ((begin, words), part))| {
        let of_word = |(w, &word)| bits_of(word).map(move |bit| chunk * CHUNK + 64 * w + bit);
        for ((h, edge), number) in words.iter().enumerate().flat_map(of_word).zip(part).zip(begin..) {
            let [p, q] = half_edges.ends(h);
            *edge = [p.min(q), p.max(q)];
            codes[h].store(2 * number + u32::from(p > q), Relaxed);
        }
    });
    // The others have the numbers of their firsts, which have their codes by now.
    parallel::map(n_chunks, |chunk| {
        for h in range(chunk) {
            let at = h % CHUNK;
            if firsts[chunk][at / 64] >> (at % 64) & 1 == 0 {
                let [p, q] = half_edges.ends(h);
                let of_first = codes[codes[h].load(Relaxed) as usize].load(Relaxed);
                codes[h].store((of_first & !1) + u32::from(p > q), Relaxed);
            }
        }
    });
    (edges, codes.into_iter().map(AtomicU32::into_inner).collect())
}

/// No facet.
pub(crate) const NONE: u32 = u32::MAX;
/// More than one facet.
pub(crate) const MANY: u32 = u32::MAX - 1;

/// For each edge the facet that runs along it and the one that runs against it, or `NONE` or `MANY`.
///
/// Every thread looks at all facets for its part of the edges.
pub(crate) fn facets_of_edges(n_edges: usize, facet_edges: &Cells) -> Vec<[u32; 2]> {
    let mut out = parallel::map_light(n_edges, |_| [NONE; 2]);
    parallel::map_parts(&mut out, |range, out| {
        for (codes, facet) in facet_edges.iter().zip(0..) {
            for &code in codes {
                let place = ((code / 2) as usize).checked_sub(range.start);
                let Some(users) = place.and_then(|place| out.get_mut(place)) else { continue };
                let user = &mut users[(code % 2) as usize];
                *user = if *user == NONE { facet } else { MANY };
            }
        }
    });
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_are_numbered_by_their_first_half_edges() {
        // Two triangles that share an edge, a third over the first, the other way round.
        let (tails, heads) = (vec![0, 1, 2, 2, 1, 3, 0, 2, 1], vec![1, 2, 0, 1, 3, 2, 2, 1, 0]);
        let (edges, codes) = edges(4, HalfEdges::Listed { tails: &tails, heads: &heads });
        assert_eq!(edges, [[0, 1], [1, 2], [0, 2], [1, 3], [2, 3]]);
        assert_eq!(codes, [0, 2, 5, 3, 6, 9, 4, 3, 1]);
        let facets = facets_of_edges(5, &Cells::uniform(3, codes));
        assert_eq!(facets, [[0, 2], [0, MANY], [2, 0], [1, NONE], [NONE, 1]]);
        for n_points in [4, 400] {
            let half_edges = HalfEdges::Listed { tails: &tails, heads: &heads };
            assert_eq!(first_of_edge(n_points, half_edges), [0, 1, 2, 1, 4, 5, 2, 1, 0]);
        }
    }
}
