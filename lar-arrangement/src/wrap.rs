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
use crate::notes::{Notes, Parts};
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
    let crowded = parallel::select(n, |edge| of(edge).len() > 2);
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
/// face f are `face_loops[f]..face_loops[f + 1]`. O(size of the loops). Early faces should have early edges.
pub(crate) fn faces_at_edges(n_edges: usize, loops: &Cells, face_loops: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let (edges, own_faces) = (Parts::new(n_edges), Parts::new(face_loops.len() - 1));
    let faces = Faces { loops, face_loops };
    // Behind the 0, the place of edge i is where its next entry goes within its part; in the end, where they end.
    let mut offsets = parallel::zeros(n_edges + 1);
    let parts = parallel::cut(&mut offsets[1..], edges.lengths());
    let (parts, notes) = Notes::of_all(&edges, parts, |part, ends: &mut [u32], pad| {
        let place = edges.places(part);
        faces.each_half_edge(own_faces.range(part), |h, face| match ends.get_mut(place(h / 2)) {
            Some(n) => *n += 1,
            None => pad.note(h / 2, (h, face)),
        });
        ends
    });
    let counted = parallel::map_each(parts, |part, ends| {
        let place = edges.places(part);
        notes.of(part).for_each(|&(h, _)| ends[place(h / 2)] += 1);
        let n = ends.iter_mut().fold(0, |n, end| n + std::mem::replace(end, n));
        (ends, n as usize)
    });
    let lengths: Vec<usize> = counted.iter().map(|part| part.1).collect();
    let mut entries = parallel::zeros(lengths.iter().sum());
    let mut begin = 0;
    let parts = counted.into_iter().zip(parallel::cut(&mut entries, lengths.into_iter())).map(
        |((ends, n), entries)| {
            begin += n as u32;
            (begin - n as u32, ends, entries)
        },
    );
    parallel::map_each(parts.collect(), |part, (begin, ends, entries)| {
        let place = edges.places(part);
        let mut push = |h: u32, face: u32| {
            if let Some(end) = ends.get_mut(place(h / 2)) {
                entries[*end as usize] = 2 * face + h % 2;
                *end += 1;
            }
        };
        notes.before(part).for_each(|&(h, face)| push(h, face));
        faces.each_half_edge(own_faces.range(part), &mut push);
        notes.behind(part).for_each(|&(h, face)| push(h, face));
        if begin > 0 {
            ends.iter_mut().for_each(|end| *end += begin);
        }
    });
    (offsets, entries)
}

/// Faces by their loops.
struct Faces<'a> {
    loops: &'a Cells,
    face_loops: &'a [u32],
}

impl Faces<'_> {
    /// Calls `f` with the half-edges of some faces, each with its face.
    fn each_half_edge(&self, faces: Range<usize>, mut f: impl FnMut(u32, u32)) {
        let begins = self.face_loops[faces.start..=faces.end].iter();
        let mut begins = begins.map(|&cycle| self.loops.offsets()[cycle as usize] as usize);
        let mut begin = begins.next().unwrap_or(0);
        for (end, face) in begins.zip(faces.start as u32..) {
            self.loops.indices()[begin..end].iter().for_each(|&h| f(h, face));
            begin = end;
        }
    }
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

/// Shell of each face side (2f front, 2f + 1 back), numbered by the first side in them, and their number. Faces that are
/// alone at an edge, running along it in opposite ways, share their shells in front and behind: such *patches* come first.
pub(crate) fn shells(rings: &Cells, n_faces: usize) -> (Vec<u32>, u32) {
    let beside = |edges: Range<usize>| edges.filter_map(|edge| are_beside(&rings[edge]));
    let (patch_of, n_patches) = UnionFind::of_pairs(n_faces, rings.len(), beside).labels();
    let side = |entry: u32| 2 * patch_of[(entry / 2) as usize] + entry % 2;
    let mut sides = UnionFind::new(2 * n_patches as usize);
    for edge in parallel::select(rings.len(), |edge| are_beside(&rings[edge as usize]).is_none()) {
        facing_sides(&rings[edge as usize]).for_each(|(x, y)| _ = sides.union(side(x), side(y)));
    }
    let (shell_of, n_shells) = sides.labels();
    let of_face = |face: usize| [0, 1].map(|s| shell_of[(2 * patch_of[face] + s) as usize]);
    (parallel::map_light(n_faces, of_face).into_flattened(), n_shells)
}

/// The faces at an edge, if there are two that run along it in opposite ways.
fn are_beside(ring: &[u32]) -> Option<(u32, u32)> {
    match *ring {
        [a, b] if a % 2 != b % 2 => Some((a / 2, b / 2)),
        _ => None,
    }
}

/// The pairs of sides that face each other around an edge.
fn facing_sides(ring: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    let last = ring.last().copied();
    ring.iter().scan(last, |before, &next| before.replace(next).map(|entry| (entry, next ^ 1)))
}

/// Component of each shell, and their number: shells of some faces' sides are of one. Faces that share an edge share a shell, so
/// components of faces connected through edges are those of shells connected through faces.
pub(crate) fn components(sides: impl Iterator<Item = [u32; 2]>, n_shells: u32) -> (Vec<u32>, u32) {
    let mut shells = UnionFind::new(n_shells as usize);
    sides.for_each(|[front, back]| _ = shells.union(front, back));
    shells.labels()
}
