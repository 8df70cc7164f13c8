//! Stage 4: topological gift wrapping in linear time. The sides of the faces are joined around every edge; each
//! class of joined sides is a *shell*, a closed 2-cycle.
//!
//! The algorithm of the papers (Paoluzzi et al., "Topological computing of arrangements with (co)chains", §4;
//! CAD 155, §3) grows one 2-cycle at a time by adding, at every boundary edge, the next face around it. Read as
//! orbits that is a union-find on face sides: the same shells, whatever the order, and it cannot loop.
//!
//! Around an edge with direction t, a face whose loop runs along t (sign σ = +1) or against it (−1) and whose
//! normal is n lies on the side (σ n) × t. Seen from the tip of t, the angular order of these sides is that of the
//! vectors σ n, so faces are sorted by signs of det(n1, n2, t): no angle and no vertex coordinate is involved.
//!
//! ```text
//!                 f2            side codes: 2f front (where the normal points), 2f + 1 back
//!                 |  front      a ring entry is 2f + (1 when σ = −1): the code of the side
//!       back  f3  |             that comes next, counter-clockwise
//!        ─────────t───────── f1
//!                 |             joined: next(f1) with before(f2), next(f2) with before(f3), …
//! ```

use crate::kernel::{Direction, Geometry, Sign};
use crate::parallel;
use crate::skeleton::Skeleton;
use crate::union_find::UnionFind;
use lar_core::Cells;
use std::cmp::Ordering;
use std::ops::Range;

/// For every edge the faces around it, counter-clockwise seen from the tip of its direction: 2 · face, + 1 where
/// the face's loop runs against the edge. A face may stand there twice (both sides of a slit).
pub(crate) fn rings(skeleton: &Skeleton, geometry: &Geometry) -> Cells {
    let n = skeleton.edges.len();
    let (offsets, mut entries) = faces_at_edges(n, &skeleton.loops, &skeleton.face_loops);
    let of = |edge: u32| offsets[edge as usize] as usize..offsets[edge as usize + 1] as usize;
    let crowded: Vec<u32> = (0..n as u32).filter(|&edge| of(edge).len() > 2).collect();
    let (n_chunks, range) = parallel::chunks(crowded.len(), 1024);
    let sorted = parallel::map(n_chunks, |chunk| {
        let mut out = Vec::new();
        for &edge in &crowded[range(chunk)] {
            let at = out.len();
            out.extend_from_slice(&entries[of(edge)]);
            sort_ring(&mut out[at..], edge, skeleton, geometry);
        }
        out
    });
    for (rings, chunk) in sorted.iter().zip(0..) {
        let mut rest = rings.as_slice();
        for &edge in &crowded[range(chunk)] {
            let (ring, after) = rest.split_at(of(edge).len());
            entries[of(edge)].copy_from_slice(ring);
            rest = after;
        }
    }
    Cells::from_parts(offsets, entries)
}

/// For every edge the faces that have it in a loop, ascending: 2 · face, + 1 where the loop runs against the edge. The loops of
/// face f are `face_loops[f]..face_loops[f + 1]`. O(size of the loops) for each thread.
pub(crate) fn faces_at_edges(n_edges: usize, loops: &Cells, face_loops: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let n_parts = parallel::n_threads();
    let edges = |part: usize| parallel::part_of(n_edges, part);
    // Behind the 0, the place of edge i is where its next entry goes within its part; in the end, where they end.
    let mut offsets = vec![0u32; n_edges + 1];
    let parts = parallel::cut(&mut offsets[1..], (0..n_parts).map(|part| edges(part).len()));
    let counted = parallel::map_each(parts, |part, ends| {
        let place = place_in(edges(part));
        loops.indices().iter().filter_map(|&h| place(h)).for_each(|i| ends[i] += 1);
        let n = ends.iter_mut().fold(0, |n, end| n + std::mem::replace(end, n));
        (ends, n as usize)
    });
    let lengths: Vec<usize> = counted.iter().map(|part| part.1).collect();
    let mut entries = vec![0; lengths.iter().sum()];
    let mut begin = 0;
    let parts = counted.into_iter().zip(parallel::cut(&mut entries, lengths.into_iter())).map(
        |((ends, n), entries)| {
            begin += n as u32;
            (begin - n as u32, ends, entries)
        },
    );
    parallel::map_each(parts.collect(), |part, (begin, ends, entries)| {
        let place = place_in(edges(part));
        for (range, face) in face_loops.windows(2).zip(0u32..) {
            let [begin, end] = [range[0], range[1]].map(|l| loops.offsets()[l as usize] as usize);
            for &h in &loops.indices()[begin..end] {
                if let Some(i) = place(h) {
                    let at = &mut ends[i];
                    entries[*at as usize] = 2 * face + h % 2;
                    *at += 1;
                }
            }
        }
        if begin > 0 {
            ends.iter_mut().for_each(|end| *end += begin);
        }
    });
    (offsets, entries)
}

/// The place of a half-edge's edge among some, if it is one of them.
fn place_in(edges: Range<usize>) -> impl Fn(u32) -> Option<usize> {
    move |h| ((h / 2) as usize).checked_sub(edges.start).filter(|&place| place < edges.len())
}

fn sort_ring(ring: &mut [u32], edge: u32, skeleton: &Skeleton, geometry: &Geometry) {
    let first = ring[0];
    let along = skeleton.direction(edge, geometry);
    let half = |entry: u32| match turn(first, entry, &along, skeleton, geometry) {
        Sign::Zero if opposite(first, entry, skeleton, geometry) => 2u8,
        Sign::Zero => 0,
        Sign::Positive => 1,
        Sign::Negative => 3,
    };
    let mut keyed: Vec<(u8, u32)> = ring.iter().map(|&entry| (half(entry), entry)).collect();
    keyed.sort_by(|a, b| {
        a.0.cmp(&b.0).then_with(|| match turn(a.1, b.1, &along, skeleton, geometry) {
            Sign::Positive => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Negative => Ordering::Greater,
        })
    });
    for (entry, (_, sorted)) in ring.iter_mut().zip(keyed) {
        *entry = sorted;
    }
}

/// Sign of the turn about an edge of some direction that leads from one face to another by less than half a turn.
pub(crate) fn turn(a: u32, b: u32, along: &Direction, skeleton: &Skeleton, geometry: &Geometry) -> Sign {
    let (f, g) = (skeleton.facet(a / 2), skeleton.facet(b / 2));
    if f == g {
        return Sign::Zero;
    }
    let sign = geometry.turn_about(f, g, along);
    if (a ^ b).is_multiple_of(2) { sign } else { -sign }
}

/// For two faces in one plane: whether they lie on opposite sides of their edge.
fn opposite(a: u32, b: u32, skeleton: &Skeleton, geometry: &Geometry) -> bool {
    let same_way = geometry.same_way(skeleton.facet(a / 2), skeleton.facet(b / 2));
    same_way != (a ^ b).is_multiple_of(2)
}

/// Shell of each face side (2f front, 2f + 1 back), numbered by the first side in them, and their number.
pub(crate) fn shells(rings: &Cells, n_faces: usize) -> (Vec<u32>, u32) {
    let facing = |edges: Range<usize>| edges.flat_map(|edge| facing_sides(&rings[edge]));
    UnionFind::of_pairs(2 * n_faces, rings.len(), facing).labels()
}

/// The pairs of sides that face each other around an edge.
fn facing_sides(ring: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    let last = ring.last().copied();
    ring.iter().scan(last, |before, &next| before.replace(next).map(|entry| (entry, next ^ 1)))
}

/// Component of each shell, and their number. Faces that share an edge share a shell, so components of faces connected
/// through edges are those of shells connected through faces.
pub(crate) fn components(shell_of_side: &[u32], n_shells: u32) -> (Vec<u32>, u32) {
    let mut shells = UnionFind::new(n_shells as usize);
    for sides in shell_of_side.as_chunks::<2>().0 {
        shells.union(sides[0], sides[1]);
    }
    shells.labels()
}
