//! Stage 1d: half-edges with the same ends are one edge, found by a counting sort over the larger ends: where a mesh is refined
//! step by step these are of the last step, numbered as its triangles are.

use crate::notes::{Notes, Parts};
use crate::parallel;
use lar_core::Cells;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Among so few half-edges those of one edge are looked for one by one.
const FEW: usize = 24;

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

    /// The half-edges of one of as many parts as there are threads: of whole triangles.
    fn part(&self, part: usize) -> Range<usize> {
        match self {
            Self::OfTriangles(corners) => {
                let Range { start, end } = parallel::part_of(corners.len(), part);
                3 * start..3 * end
            }
            Self::Listed { tails, .. } => parallel::part_of(tails.len(), part),
        }
    }

    /// Calls `f` with those of a part and their ends.
    fn for_each(&self, range: Range<usize>, mut f: impl FnMut(u32, [u32; 2])) {
        match self {
            Self::OfTriangles(corners) => {
                let corners = &corners[range.start / 3..range.end / 3];
                for (&[a, b, c], h) in corners.iter().zip((range.start as u32..).step_by(3)) {
                    f(h, [a, b]);
                    f(h + 1, [b, c]);
                    f(h + 2, [c, a]);
                }
            }
            Self::Listed { tails, heads } => {
                let ends = tails[range.clone()].iter().zip(&heads[range.clone()]);
                ends.zip(range.start as u32..).for_each(|((&p, &q), h)| f(h, [p, q]));
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

/// O(n log d) for at most d edges at a vertex. Notes are few when half-edges near each other have larger ends near each other.
fn shared_firsts(n_points: usize, half_edges: HalfEdges<'_>) -> Vec<AtomicU32> {
    let first = parallel::atomic_zeros(half_edges.len());
    let points = Parts::with_equal_shares(n_points, half_edges.len(), |h| upper(half_edges.ends(h)));
    let lengths: Vec<usize> = points.lengths().collect();
    let (counts, notes) = Notes::of_all(&points, lengths, |part, n, pad| {
        let mut counts = vec![0u32; n + 2];
        let (of_points, place) = (&mut counts[2..], points.places(part));
        half_edges.for_each(half_edges.part(part), |h, ends| match of_points.get_mut(place(upper(ends))) {
            Some(n) => *n += 1,
            None => pad.note(upper(ends), h),
        });
        counts
    });
    parallel::map_each(counts, |part, mut offsets| {
        let ends = |h: u32| half_edges.ends(h as usize);
        let place = points.places(part);
        for ends in notes.of(part).map(|&h| ends(h)) {
            offsets[place(upper(ends)) + 2] += 1;
        }
        for i in 2..offsets.len() {
            offsets[i] += offsets[i - 1];
        }
        // The second number of point i is where its next entry goes; in the end, where those of i + 1 begin. An entry is the smaller
        // end and the half-edge.
        let mut entries = vec![(0u32, 0u32); offsets.last().map_or(0, |&n| n as usize)];
        let n = points.range(part).len();
        let begins = &mut offsets[1..=n];
        let mut push = |h: u32, [p, q]: [u32; 2]| {
            if let Some(at) = begins.get_mut(place(p.max(q))) {
                entries[*at as usize] = (p.min(q), h);
                *at += 1;
            }
        };
        notes.before(part).for_each(|&h| push(h, ends(h)));
        half_edges.for_each(half_edges.part(part), &mut push);
        notes.behind(part).for_each(|&h| push(h, ends(h)));
        offsets.windows(2).for_each(|range| {
            join_edges_at_point(&mut entries[range[0] as usize..range[1] as usize], &first);
        });
    });
    first
}

/// The larger end of a half-edge.
fn upper([p, q]: [u32; 2]) -> u32 {
    p.max(q)
}

/// Notes the first half-edge of each edge whose larger end is one point: its entries are the smaller ends and the half-edges,
/// these ascending.
fn join_edges_at_point(around: &mut [(u32, u32)], first: &[AtomicU32]) {
    if around.len() <= FEW {
        for &(lower, h) in around.iter() {
            let same = around.iter().find(|other| other.0 == lower).expect("it is one of them");
            first[h as usize].store(same.1, Relaxed);
        }
        return;
    }
    around.sort_unstable();
    for edge in around.chunk_by(|a, b| a.0 == b.0) {
        edge.iter().for_each(|&(_, h)| first[h as usize].store(edge[0].1, Relaxed));
    }
}

/// Edges in the order of their first half-edges, and for each half-edge 2 · edge, + 1 when it runs from the larger end
/// to the smaller.
pub(crate) fn edges(n_points: usize, half_edges: HalfEdges<'_>) -> (Vec<[u32; 2]>, Vec<u32>) {
    let codes = shared_firsts(n_points, half_edges);
    let first_of = |h: u32| codes[h as usize].load(Relaxed);
    let counts = parallel::map(parallel::n_threads(), |part| {
        let part = half_edges.part(part);
        codes[part.clone()].iter().zip(part).filter(|(code, h)| code.load(Relaxed) as usize == *h).count()
    });
    let mut edges = parallel::zeros(counts.iter().sum());
    let mut begin = 0;
    let begins = counts.iter().map(|count| {
        begin += count;
        (begin - count) as u32
    });
    let parts = begins.zip(parallel::cut(&mut edges, counts.iter().copied())).collect();
    let later = parallel::map_each(parts, |part, (begin, edges): (u32, &mut [[u32; 2]])| {
        let part = half_edges.part(part);
        let (from, mut number, mut later) = (part.start as u32, 0, Vec::new());
        half_edges.for_each(part, |h, [p, q]| {
            let first = first_of(h);
            let code = if first == h {
                edges[number as usize] = [p.min(q), p.max(q)];
                number += 1;
                2 * (begin + number - 1)
            } else if first >= from {
                // It has its code by now.
                first_of(first) & !1
            } else {
                later.push(h);
                return;
            };
            codes[h as usize].store(code + u32::from(p > q), Relaxed);
        });
        later
    });
    // Those whose firsts are in parts before.
    parallel::map(later.len(), |part| {
        for &h in &later[part] {
            let [p, q] = half_edges.ends(h as usize);
            codes[h as usize].store((first_of(first_of(h)) & !1) + u32::from(p > q), Relaxed);
        }
    });
    (edges, codes.into_iter().map(AtomicU32::into_inner).collect())
}

/// No facet.
pub(crate) const NONE: u32 = u32::MAX;
/// More than one facet.
pub(crate) const MANY: u32 = u32::MAX - 1;

/// For each edge the facet that runs along it and the one that runs against it, or `NONE` or `MANY`. Early facets should have
/// early edges.
pub(crate) fn facets_of_edges(n_edges: usize, facet_edges: &Cells) -> Vec<[u32; 2]> {
    let mut out = parallel::map_light(n_edges, |_| [NONE; 2]);
    let (edges, facets) = (Parts::new(n_edges), Parts::new(facet_edges.len()));
    let add = |users: &mut [u32; 2], code: u32, facet: u32| {
        let user = &mut users[(code % 2) as usize];
        *user = if *user == NONE { facet } else { MANY };
    };
    let own = parallel::cut(&mut out, edges.lengths());
    let (own, notes) = Notes::of_all(&edges, own, |part, own, pad| {
        let (facets, place) = (facets.range(part), edges.places(part));
        let begins = &facet_edges.offsets()[facets.start..=facets.end];
        for (range, facet) in begins.windows(2).zip(facets.start as u32..) {
            for &code in &facet_edges.indices()[range[0] as usize..range[1] as usize] {
                match own.get_mut(place(code / 2)) {
                    Some(users) => add(users, code, facet),
                    None => pad.note(code / 2, (code, facet)),
                }
            }
        }
        own
    });
    parallel::map_each(own, |part, own| {
        let place = edges.places(part);
        for &(code, facet) in notes.of(part) {
            add(&mut own[place(code / 2)], code, facet);
        }
    });
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn edges_are_numbered_by_their_first_half_edges() {
        // Two triangles that share an edge, a third over the first, the other way round.
        let (tails, heads) = (vec![0, 1, 2, 2, 1, 3, 0, 2, 1], vec![1, 2, 0, 1, 3, 2, 2, 1, 0]);
        let triangles = [[0, 1, 2], [2, 1, 3], [0, 2, 1]];
        for threads in 1..=4 {
            let team = parallel::Team::new(std::num::NonZeroUsize::new(threads));
            for half_edges in
                [HalfEdges::Listed { tails: &tails, heads: &heads }, HalfEdges::OfTriangles(&triangles)]
            {
                let (edges, codes) =
                    team.work(usize::MAX, || edges(4, half_edges)).expect("there are threads");
                assert_eq!(edges, [[0, 1], [1, 2], [0, 2], [1, 3], [2, 3]]);
                assert_eq!(codes, [0, 2, 5, 3, 6, 9, 4, 3, 1]);
                let facets = facets_of_edges(5, &Cells::uniform(3, codes));
                assert_eq!(facets, [[0, 2], [0, MANY], [2, 0], [1, NONE], [NONE, 1]]);
            }
        }
        for n_points in [4, 400] {
            let half_edges = HalfEdges::Listed { tails: &tails, heads: &heads };
            assert_eq!(first_of_edge(n_points, half_edges), [0, 1, 2, 1, 4, 5, 2, 1, 0]);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn edges_and_their_facets_are_found_as_one_by_one(
            // Few points have many edges, and triangles that come early have late points.
            n_points in 3u32..50,
            corners in prop::collection::vec(prop::array::uniform3(0u32..1 << 16), 0..150),
        ) {
            let distinct = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
            let triangles: Vec<[u32; 3]> = corners.iter().map(|t| t.map(|p| p % n_points)).filter(distinct).collect();
            let (mut known, mut users) = (Vec::new(), Vec::new());
            let mut code = |[p, q]: [u32; 2], facet: u32| {
                let ends = [p.min(q), p.max(q)];
                let edge = known.iter().position(|known| *known == ends).unwrap_or_else(|| {
                    known.push(ends);
                    users.push([NONE; 2]);
                    known.len() - 1
                });
                let user = &mut users[edge][usize::from(p > q)];
                *user = if *user == NONE { facet } else { MANY };
                2 * edge as u32 + u32::from(p > q)
            };
            let expected: Vec<u32> = (0..).zip(&triangles)
                .flat_map(|(facet, &[a, b, c])| [[a, b], [b, c], [c, a]].map(|ends| code(ends, facet)))
                .collect();
            for threads in 1..=3 {
                let found = || {
                    let (edges, codes) = edges(n_points as usize, HalfEdges::OfTriangles(&triangles));
                    let users = facets_of_edges(edges.len(), &Cells::uniform(3, codes.clone()));
                    (edges, codes, users)
                };
                let team = parallel::Team::new(std::num::NonZeroUsize::new(threads));
                let (edges, codes, facets) = team.work(usize::MAX, found).expect("there are threads");
                prop_assert_eq!(&edges, &known);
                prop_assert_eq!(&codes, &expected);
                prop_assert_eq!(&facets, &users);
            }
        }
    }
}
