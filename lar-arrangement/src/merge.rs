//! Faces that become one when edges between them disappear, and edges that become one when vertices do. Used by
//! stage 5b (soft edges) and by the simplification of Boolean results. Combinatorial: the caller decides what
//! disappears.

use crate::counting;
use crate::loops::LoopsOfFaces;
use crate::parallel;
use lar_core::Cells;
use rustc_hash::{FxBuildHasher, FxHashMap, FxHashSet};
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Faces by their loops of half-edges, and edges by their ends.
pub(crate) struct Faces<'a> {
    /// Ends of each edge.
    pub edges: &'a [[u32; 2]],
    /// Half-edges (2 · edge, + 1 against its direction) of each loop.
    pub loops: &'a Cells,
    /// The loops of face f are `face_loops[f]..face_loops[f + 1]`.
    pub face_loops: &'a [u32],
}

impl Faces<'_> {
    /// First and last vertex of a half-edge.
    pub(crate) fn ends(&self, half_edge: u32) -> [u32; 2] {
        let [a, b] = self.edges[(half_edge / 2) as usize];
        if half_edge.is_multiple_of(2) { [a, b] } else { [b, a] }
    }

    fn loops_of(&self, face: usize) -> Range<u32> {
        self.face_loops[face]..self.face_loops[face + 1]
    }

    fn half_edges(&self, face: usize) -> impl Iterator<Item = u32> + '_ {
        self.loops_of(face).flat_map(|l| self.loops[l as usize].iter().copied())
    }
}

/// The faces, edges and vertices that remain, in terms of the old ones.
#[derive(Debug)]
pub(crate) struct Merged {
    /// Old vertex of each new one.
    pub vertices: Vec<u32>,
    /// Ends of each new edge, the smaller first.
    pub edges: Vec<[u32; 2]>,
    /// Old half-edge that is (part of) the new edge in its direction.
    pub old_half_edge: Vec<u32>,
    /// Half-edges of each loop.
    pub loops: Cells,
    /// The loops of face f are `face_loops[f]..face_loops[f + 1]`, the outer one first.
    pub face_loops: Vec<u32>,
}

/// What disappears.
pub(crate) struct Removal<'a> {
    /// Edges; each stands in loops exactly twice, in opposite directions.
    pub edges: &'a [bool],
    /// New face of each old one.
    pub new_face: &'a [u32],
    pub n_new_faces: usize,
    /// Vertices with exactly two remaining edges, which become one edge.
    pub vertices: &'a Passed,
}

/// Carries the removal out. `positions` are only used to tell a face's outer loop from its holes. O(n) expected.
pub(crate) fn merge(
    faces: &Faces,
    removal: &Removal,
    positions: impl Fn(u32) -> [f64; 3] + Sync + Send,
) -> Merged {
    let chains = Chains::new(faces, removal);
    let old_faces = by_new_face(removal.new_face, removal.n_new_faces);
    let places = parallel::atomic_zeros(2 * faces.edges.len());
    let (n_chunks, range) = parallel::chunks(removal.n_new_faces, CHUNK);
    let parts = parallel::map(n_chunks, |chunk| {
        // The first part gets room for the others.
        let [n_faces, n_loops, n_half_edges] = if chunk == 0 {
            [removal.n_new_faces, faces.loops.len(), faces.loops.indices().len()]
        } else {
            [CHUNK; 3]
        };
        let loops = LoopsOfFaces::with_room(n_faces, n_loops, n_half_edges);
        let mut new = NewLoops { loops, cycle: Vec::new() };
        for face in range(chunk) {
            new.push(&old_faces[face], faces, removal, &chains, &places, &positions);
        }
        new.loops
    });
    let LoopsOfFaces { loops, face_loops } = LoopsOfFaces::joined(parts);
    Merged {
        vertices: chains.vertices,
        edges: chains.edges,
        old_half_edge: chains.old_half_edge,
        loops,
        face_loops,
    }
}

/// The old faces of each new one, ascending.
fn by_new_face(new_face: &[u32], n_new_faces: usize) -> Cells {
    let old_faces: Vec<u32> = (0..new_face.len() as u32).collect();
    let (begins, old_faces) =
        counting::sorted_by_place(n_new_faces, &old_faces, |&old| new_face[old as usize] as usize);
    Cells::from_parts(begins, old_faces)
}

/// New faces a chunk of work.
const CHUNK: usize = 512;

/// The loops of some new faces.
struct NewLoops {
    loops: LoopsOfFaces,
    /// The one at hand.
    cycle: Vec<u32>,
}

impl NewLoops {
    /// The loops of the next new face, which these old ones become.
    fn push(
        &mut self,
        old_faces: &[u32],
        faces: &Faces,
        removal: &Removal,
        chains: &Chains,
        places: &[AtomicU32],
        positions: impl Fn(u32) -> [f64; 3],
    ) {
        let mut push = |cycle: &[u32]| {
            let new = cycle.iter().map(|&h| chains.new_half_edge[h as usize]);
            self.cycle.clear();
            self.cycle.extend(new.filter(|&h| h != NONE));
            self.loops.push(&self.cycle);
        };
        let half_edges = |old: &u32| faces.half_edges(*old as usize);
        if old_faces.iter().flat_map(half_edges).any(|h| removal.edges[(h / 2) as usize]) {
            let cycles = rejoined(old_faces, faces, removal, places);
            let first = outer_first(&cycles, faces, positions);
            let order = first.into_iter().chain((0..cycles.len()).filter(|&i| Some(i) != first));
            order.for_each(|i| push(&cycles[i]));
        } else {
            let loops = old_faces.iter().flat_map(|&old| faces.loops_of(old as usize));
            loops.for_each(|l| push(&faces.loops[l as usize]));
        }
        self.loops.close();
    }
}

/// No half-edge, no face.
const NONE: u32 = u32::MAX;

/// Vertices between two edges that become one.
#[derive(Debug, Default)]
pub(crate) struct Passed {
    /// The two edges of each such vertex, `NONE` for others; empty without any.
    edges: Vec<[u32; 2]>,
}

impl Passed {
    pub(crate) fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    fn get(&self, v: u32) -> Option<[u32; 2]> {
        self.edges.get(v as usize).copied().filter(|edges| edges[0] != NONE)
    }

    fn contains(&self, v: u32) -> bool {
        self.get(v).is_some()
    }

    /// Keeps those for which a condition on the vertex and its edges holds.
    pub(crate) fn retain(&mut self, mut holds: impl FnMut(u32, [u32; 2]) -> bool) {
        let mut is_any = false;
        for (edges, v) in self.edges.iter_mut().zip(0..).filter(|(edges, _)| edges[0] != NONE) {
            if holds(v, *edges) {
                is_any = true;
            } else {
                *edges = [NONE; 2];
            }
        }
        if !is_any {
            self.edges.clear();
        }
    }
}

/// The candidates among the vertices with exactly two remaining edges, with these edges. O(edges).
pub(crate) fn with_two_edges(
    n_vertices: usize,
    edges: &[[u32; 2]],
    removed: &[bool],
    is_candidate: impl Fn(u32) -> bool,
) -> Passed {
    let remaining =
        || edges.iter().zip(0u32..).zip(removed).filter(|(_, removed)| !**removed).map(|(edge, _)| edge);
    let mut degree = vec![0u32; n_vertices];
    for (ends, _) in remaining() {
        ends.iter().for_each(|&v| degree[v as usize] += 1);
    }
    if !degree.contains(&2) {
        return Passed::default();
    }
    let mut found = vec![[NONE; 2]; n_vertices];
    for (ends, edge) in remaining() {
        for &v in ends.iter().filter(|&&v| degree[v as usize] == 2 && is_candidate(v)) {
            let found = &mut found[v as usize];
            found[usize::from(found[0] != NONE)] = edge;
        }
    }
    Passed { edges: found }
}

/// Keeps the edges inside of new faces that would be none: where one remaining half-edge stands in two of the faces
/// to be joined, their union folds back over itself, and its boundary would count that edge twice; where no edge remains,
/// the faces close up to a surface, flat but for rounding. Polygons that cross themselves do the former when rounding has
/// bent them. True when there are such; faces are then to be joined anew.
/// O(n).
pub(crate) fn keep_folds(faces: &Faces, removed: &mut [bool], new_face: &[u32], n_new_faces: usize) -> bool {
    let old_faces = by_new_face(new_face, n_new_faces);
    let half_edges = |old: u32| faces.half_edges(old as usize);
    // The last new face that each half-edge was seen in.
    let mut seen = vec![NONE; 2 * faces.edges.len()];
    let mut is_any = false;
    for (old_faces, new) in old_faces.iter().zip(0..).filter(|(old_faces, _)| old_faces.len() > 1) {
        let (mut remains, mut is_twice) = (false, false);
        let of_these = || old_faces.iter().flat_map(|&old| half_edges(old));
        for h in of_these().filter(|h| !removed[(h / 2) as usize]) {
            remains = true;
            is_twice |= std::mem::replace(&mut seen[h as usize], new) == new;
        }
        if is_twice || !remains {
            of_these().for_each(|h| removed[(h / 2) as usize] = false);
            is_any = true;
        }
    }
    is_any
}

/// The loops, as old half-edges, of a new face within which edges disappear: there the walk goes on along the loop on
/// the edge's other side, which is one of these old faces as well. `places` has room for each half-edge. O(n).
fn rejoined(old_faces: &[u32], faces: &Faces, removal: &Removal, places: &[AtomicU32]) -> Cells {
    // By places in the list of all half-edges of these faces: what follows on each.
    let (mut half_edges, mut next) = (Vec::new(), Vec::new());
    for l in old_faces.iter().flat_map(|&old| faces.loops_of(old as usize)) {
        let begin = half_edges.len() as u32;
        half_edges.extend_from_slice(&faces.loops[l as usize]);
        let end = half_edges.len() as u32;
        next.extend((begin..end).map(|i| if i + 1 == end { begin } else { i + 1 }));
    }
    // Removed half-edges stand in one face only, so no other thread asks for the places of these.
    let is_removed = |h: u32| removal.edges[(h / 2) as usize];
    for (&h, i) in half_edges.iter().zip(0..).filter(|&(&h, _)| is_removed(h)) {
        places[h as usize].store(i, Relaxed);
    }
    let opposite_place = |&h: &u32| if is_removed(h) { places[(h ^ 1) as usize].load(Relaxed) } else { NONE };
    let opposite: Vec<u32> = half_edges.iter().map(opposite_place).collect();
    let mut is_walked: Vec<bool> = opposite.iter().map(|&opposite| opposite != NONE).collect();
    let (mut cycles, mut cycle) = (Cells::new(), Vec::new());
    for start in 0..half_edges.len() {
        let mut i = start;
        while !std::mem::replace(&mut is_walked[i], true) {
            cycle.push(half_edges[i]);
            i = next[i] as usize;
            while opposite[i] != NONE {
                i = next[opposite[i] as usize] as usize;
            }
        }
        if !cycle.is_empty() {
            cycles.push(&cycle);
            cycle.clear();
        }
    }
    cycles
}

/// The outer one of several loops: it reaches farthest in every direction of the plane, so it wins along every
/// axis on which the loops differ.
fn outer_first(cycles: &Cells, faces: &Faces, positions: impl Fn(u32) -> [f64; 3]) -> Option<usize> {
    if cycles.len() < 2 {
        return (!cycles.is_empty()).then_some(0);
    }
    let reaches: Vec<[f64; 6]> = cycles
        .iter()
        .map(|cycle| {
            let mut reach = [f64::INFINITY; 6];
            for p in cycle.iter().map(|&h| positions(faces.ends(h)[0])) {
                for k in 0..3 {
                    reach[k] = reach[k].min(p[k]);
                    reach[k + 3] = reach[k + 3].min(-p[k]);
                }
            }
            reach
        })
        .collect();
    let best: [f64; 6] = std::array::from_fn(|k| reaches.iter().map(|r| r[k]).fold(f64::INFINITY, f64::min));
    let wins = |i: &usize| (0..6).filter(|&k| reaches[*i][k] <= best[k]).count();
    // Ties go to the first: `max_by_key` takes the last of equals.
    (0..cycles.len()).rev().max_by_key(wins)
}

/// One new edge: an old edge that is part of it, its ends, and where the old half-edges from one end to the other stand
/// among all walks, when there are more than that edge.
struct Chain {
    edge: u32,
    ends: [u32; 2],
    walk: Range<usize>,
}

impl Chain {
    fn single(half_edge: u32, faces: &Faces) -> Self {
        Self { edge: half_edge / 2, ends: faces.ends(half_edge), walk: 0..0 }
    }
}

/// Edges joined through vertices that disappear.
struct Chains {
    vertices: Vec<u32>,
    edges: Vec<[u32; 2]>,
    old_half_edge: Vec<u32>,
    /// The new half-edge that stands for an old one; `NONE` for removed edges and for all but one of a chain.
    new_half_edge: Vec<u32>,
}

impl Chains {
    fn new(faces: &Faces, removal: &Removal) -> Self {
        let passed = removal.vertices;
        let is_between_others =
            |edge: u32| passed.is_empty() || !faces.edges[edge as usize].iter().any(|&v| passed.contains(v));
        let mut seen = removal.edges.to_vec();
        // Edges of walks that close, each of which would go around its ring again.
        let mut of_ring: FxHashSet<u32> = FxHashSet::default();
        let mut chains = Vec::with_capacity(faces.edges.len());
        let mut walks: Vec<u32> = Vec::new();
        for edge in 0..faces.edges.len() as u32 {
            if seen[edge as usize] {
                continue;
            }
            if is_between_others(edge) || of_ring.contains(&edge) {
                chains.push(Chain::single(2 * edge, faces));
                continue;
            }
            let begin = walks.len();
            let is_closed = walk_through(edge, faces, passed, &mut walks);
            let walk = &walks[begin..];
            if is_closed {
                of_ring.extend(walk.iter().map(|h| h / 2));
                walks.truncate(begin);
                chains.push(Chain::single(2 * edge, faces));
                continue;
            }
            walk.iter().for_each(|&h| seen[(h / 2) as usize] = true);
            let ends = [faces.ends(walk[0])[0], faces.ends(walk[walk.len() - 1])[1]];
            chains.push(if walk.len() == 1 {
                Chain::single(walk[0], faces)
            } else {
                Chain { edge, ends, walk: begin..walks.len() }
            });
        }
        Self::numbered(&without_doubles(chains, &walks, faces), &walks, faces)
    }

    fn numbered(chains: &[Chain], walks: &[u32], faces: &Faces) -> Self {
        let n_vertices = faces.edges.as_flattened().iter().max().map_or(0, |&v| v as usize + 1);
        let mut used = vec![false; n_vertices];
        chains.iter().for_each(|c| c.ends.iter().for_each(|&v| used[v as usize] = true));
        let mut new_vertex = vec![0; n_vertices];
        let mut vertices = Vec::new();
        for v in (0..n_vertices).filter(|&v| used[v]) {
            new_vertex[v] = vertices.len() as u32;
            vertices.push(v as u32);
        }
        let mut edges = Vec::with_capacity(chains.len());
        let mut old_half_edge = Vec::with_capacity(chains.len());
        let mut new_half_edge = vec![NONE; 2 * faces.edges.len()];
        for (chain, id) in chains.iter().zip(0..) {
            let [a, b] = chain.ends.map(|v| new_vertex[v as usize]);
            edges.push([a.min(b), a.max(b)]);
            let in_walk = walks[chain.walk.clone()].iter().copied().find(|h| h / 2 == chain.edge);
            let along =
                in_walk.unwrap_or(2 * chain.edge + u32::from(faces.ends(2 * chain.edge) != chain.ends));
            let forward = if a < b { along } else { along ^ 1 };
            old_half_edge.push(forward);
            new_half_edge[forward as usize] = 2 * id;
            new_half_edge[(forward ^ 1) as usize] = 2 * id + 1;
        }
        Self { vertices, edges, old_half_edge, new_half_edge }
    }
}

/// Adds the half-edges of the chain that an edge is part of, each once; true when they close on themselves, and all of their
/// vertices would disappear.
fn walk_through(edge: u32, faces: &Faces, passed: &Passed, walks: &mut Vec<u32>) -> bool {
    let onward = |h: u32| {
        let head = faces.ends(h)[1];
        let other = passed.get(head)?.into_iter().find(|&e| e != h / 2)?;
        Some(2 * other + u32::from(faces.edges[other as usize][0] != head))
    };
    let begin = walks.len();
    let mut h = 2 * edge + 1;
    while let Some(back) = onward(h) {
        walks.push(back ^ 1);
        if back == 2 * edge + 1 {
            return true;
        }
        h = back;
    }
    walks[begin..].reverse();
    let mut ahead = Some(2 * edge);
    while let Some(h) = ahead {
        walks.push(h);
        ahead = onward(h);
    }
    false
}

/// Chains with the same ends, or with equal ends, would make edges that cannot be told apart: they stay in pieces.
fn without_doubles(chains: Vec<Chain>, walks: &[u32], faces: &Faces) -> Vec<Chain> {
    let key = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let n_walks = chains.iter().filter(|c| !c.walk.is_empty()).count();
    if n_walks == 0 {
        return chains;
    }
    // How many chains have the ends of a walk.
    let mut count: FxHashMap<[u32; 2], u32> = FxHashMap::with_capacity_and_hasher(n_walks, FxBuildHasher);
    for chain in chains.iter().filter(|c| !c.walk.is_empty()) {
        *count.entry(key(chain.ends)).or_default() += 1;
    }
    for chain in chains.iter().filter(|c| c.walk.is_empty()) {
        count.entry(key(chain.ends)).and_modify(|count| *count += 1);
    }
    let mut out = Vec::with_capacity(chains.len());
    for chain in chains {
        if chain.walk.is_empty() || (chain.ends[0] != chain.ends[1] && count[&key(chain.ends)] == 1) {
            out.push(chain);
        } else {
            out.extend(walks[chain.walk].iter().map(|&h| Chain::single(h, faces)));
        }
    }
    out.sort_by_key(|chain| chain.edge);
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::union_find::UnionFind;

    /// Merges faces, given by vertices around their loops, over some of their edges and through some of their vertices; the
    /// loops that remain, by vertices, each from its least.
    fn merged(polygons: &[&[&[u32]]], over: &[[u32; 2]], through: &[u32]) -> Vec<Vec<Vec<u32>>> {
        let (mut edges, mut loops, mut face_loops) = (Vec::<[u32; 2]>::new(), Cells::new(), vec![0]);
        let mut around = Vec::<Vec<u32>>::new();
        for (polygon, face) in polygons.iter().zip(0..) {
            for cycle in *polygon {
                let steps = cycle.iter().zip(cycle.iter().cycle().skip(1));
                let half_edge = |(&a, &b): (&u32, &u32)| {
                    let ends = [a.min(b), a.max(b)];
                    let edge = edges.iter().position(|&e| e == ends).unwrap_or_else(|| {
                        edges.push(ends);
                        around.push(Vec::new());
                        edges.len() - 1
                    });
                    around[edge].push(face);
                    2 * edge as u32 + u32::from(a > b)
                };
                loops.push(&steps.map(half_edge).collect::<Vec<_>>());
            }
            face_loops.push(loops.len() as u32);
        }
        let faces = Faces { edges: &edges, loops: &loops, face_loops: &face_loops };
        let joined = |removed: &[bool]| {
            let mut sets = UnionFind::new(polygons.len());
            let removed = around.iter().zip(removed).filter(|(_, removed)| **removed);
            for (faces, _) in removed {
                sets.union(faces[0], faces[1]);
            }
            sets.labels()
        };
        let mut removed: Vec<bool> = edges.iter().map(|ends| over.contains(ends)).collect();
        let (mut new_face, mut n) = joined(&removed);
        if keep_folds(&faces, &mut removed, &new_face, n as usize) {
            (new_face, n) = joined(&removed);
        }
        let n_vertices = edges.as_flattened().iter().max().map_or(0, |&v| v as usize + 1);
        let passed = with_two_edges(n_vertices, &edges, &removed, |v| through.contains(&v));
        let (edges, new_face) = (&removed, &new_face);
        let removal = Removal { edges, new_face, n_new_faces: n as usize, vertices: &passed };
        // On a parabola, so that the first and the last vertex reach farthest.
        let merged = merge(&faces, &removal, |v| [f64::from(v), f64::from(v * v), 0.0]);
        let tail = |&h: &u32| merged.vertices[merged.edges[(h / 2) as usize][(h % 2) as usize] as usize];
        let vertices = |cycle: u32| {
            let mut vertices: Vec<u32> = merged.loops[cycle as usize].iter().map(tail).collect();
            let least = (0..vertices.len()).min_by_key(|&i| vertices[i]).unwrap_or(0);
            vertices.rotate_left(least);
            vertices
        };
        merged.face_loops.windows(2).map(|w| (w[0]..w[1]).map(vertices).collect()).collect()
    }

    #[test]
    fn faces_are_joined_over_edges_that_disappear() {
        let square: &[&[&[u32]]] = &[&[&[0, 1, 2]], &[&[0, 2, 3]]];
        assert_eq!(merged(square, &[], &[]), [[[0, 1, 2]], [[0, 2, 3]]]);
        assert_eq!(merged(square, &[[0, 2]], &[]), [[[0, 1, 2, 3]]]);
        let with_another: &[&[&[u32]]] = &[&[&[0, 1, 2]], &[&[4, 3, 2]], &[&[0, 2, 3]]];
        assert_eq!(merged(with_another, &[[0, 2]], &[]), vec![vec![vec![0, 1, 2, 3]], vec![vec![2, 4, 3]]]);
        // Around 0, and around a hole, which is not the outer loop although it was met first.
        let fan: &[&[&[u32]]] = &[&[&[0, 1, 2]], &[&[0, 2, 3]], &[&[0, 3, 1]]];
        assert_eq!(merged(fan, &[[0, 1], [0, 2], [0, 3]], &[]), [[[1, 2, 3]]]);
        let fold: &[&[&[u32]]] = &[&[&[0, 1, 2, 3]], &[&[0, 2, 1, 3]]];
        assert_eq!(merged(fold, &[[1, 2]], &[]), merged(fold, &[], &[]), "3 to 0 would stand in it twice");
        let ring: &[&[&[u32]]] = &[&[&[2, 3, 0, 8]], &[&[3, 4, 9, 0]], &[&[4, 2, 8, 9]]];
        assert_eq!(merged(ring, &[[0, 3], [4, 9], [2, 8]], &[]), [[vec![0, 8, 9], vec![2, 3, 4]]]);
        let closed: &[&[&[u32]]] = &[&[&[0, 1, 2]], &[&[0, 2, 1]]];
        let all = [[0, 1], [1, 2], [0, 2]];
        assert_eq!(merged(closed, &all, &[]), merged(closed, &[], &[]), "nothing would be left");
    }

    #[test]
    fn edges_are_joined_through_vertices_that_disappear() {
        let pentagon: &[&[&[u32]]] = &[&[&[0, 3, 1, 4, 2]]];
        assert_eq!(merged(pentagon, &[], &[3, 4]), [[[0, 1, 2]]]);
        assert_eq!(merged(pentagon, &[], &[2, 4]), [[[0, 3, 1]]], "two in a row");
        assert_eq!(merged(pentagon, &[], &[2, 3, 4]), merged(pentagon, &[], &[]), "both would join 0 and 1");
        assert_eq!(merged(pentagon, &[], &[0, 1, 2, 3, 4]), merged(pentagon, &[], &[]), "no end is left");
        let square: &[&[&[u32]]] = &[&[&[0, 1, 2]], &[&[0, 2, 3]]];
        assert_eq!(merged(square, &[[0, 2]], &[2]), [[[0, 1, 3]]]);
        assert_eq!(merged(square, &[], &[1]), merged(square, &[], &[]), "0 and 2 are joined already");
    }

    #[test]
    fn a_long_ring_is_walked_once() {
        let n = 300_000;
        let edges: Vec<[u32; 2]> = (0..n).map(|i| [i, (i + 1) % n]).collect();
        let loops = Cells::from_parts(vec![0, n], (0..n).map(|edge| 2 * edge).collect());
        let faces = Faces { edges: &edges, loops: &loops, face_loops: &[0, 1] };
        let removed = vec![false; edges.len()];
        let passed = with_two_edges(edges.len(), &edges, &removed, |_| true);
        let removal = Removal { edges: &removed, new_face: &[0], n_new_faces: 1, vertices: &passed };
        let merged = merge(&faces, &removal, |_| [0.0; 3]);
        assert!(merged.vertices.iter().copied().eq(0..n) && merged.loops[0].len() == edges.len());
    }
}
