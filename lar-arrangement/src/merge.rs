//! Faces that become one when edges between them disappear, and edges that become one when vertices do. Used by
//! stage 5b (soft edges) and by the simplification of Boolean results. Combinatorial: the caller decides what
//! disappears.

use lar_core::Cells;
use rustc_hash::FxHashMap;

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
    pub(crate) fn n_faces(&self) -> usize {
        self.face_loops.len() - 1
    }

    /// First and last vertex of a half-edge.
    pub(crate) fn ends(&self, half_edge: u32) -> [u32; 2] {
        let [a, b] = self.edges[(half_edge / 2) as usize];
        if half_edge.is_multiple_of(2) { [a, b] } else { [b, a] }
    }

    fn loops_of(&self, face: usize) -> std::ops::Range<u32> {
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
    /// Vertices with exactly two remaining edges, which become one edge; with these two edges.
    pub vertices: &'a FxHashMap<u32, [u32; 2]>,
}

/// Carries the removal out. `positions` are only used to tell a face's outer loop from its holes. O(n) expected.
pub(crate) fn merge(faces: &Faces, removal: &Removal, positions: impl Fn(u32) -> [f64; 3]) -> Merged {
    let chains = Chains::new(faces, removal);
    let mut rejoined = remaining_loops(faces, removal);
    let mut loops = Cells::with_capacity(faces.loops.len(), faces.loops.indices().len());
    let mut face_loops = Vec::with_capacity(removal.n_new_faces + 1);
    face_loops.push(0);
    let mut one_loop = Vec::new();
    let mut push = |cycle: &[u32]| {
        let new = cycle.iter().map(|&h| chains.new_half_edge[h as usize]);
        one_loop.clear();
        one_loop.extend(new.filter(|&h| h != NONE));
        loops.push(&one_loop);
        loops.len() as u32
    };
    for old in first_old_faces(removal) {
        let mut end = face_loops[face_loops.len() - 1];
        match rejoined.remove(&removal.new_face[old as usize]) {
            None => faces.loops_of(old as usize).for_each(|l| end = push(&faces.loops[l as usize])),
            Some(cycles) => {
                let first = outer_first(&cycles, faces, &positions);
                let order = first.into_iter().chain((0..cycles.len()).filter(|&i| Some(i) != first));
                order.for_each(|i| end = push(&cycles[i]));
            }
        }
        face_loops.push(end);
    }
    Merged {
        vertices: chains.vertices,
        edges: chains.edges,
        old_half_edge: chains.old_half_edge,
        loops,
        face_loops,
    }
}

/// The first old face of each new one; new faces are numbered in this order.
fn first_old_faces(removal: &Removal) -> Vec<u32> {
    let mut first = vec![NONE; removal.n_new_faces];
    for (&new, old) in removal.new_face.iter().zip(0..) {
        let first = &mut first[new as usize];
        *first = (*first).min(old);
    }
    first
}

/// No half-edge, no face.
const NONE: u32 = u32::MAX;

/// The candidates among the vertices with exactly two remaining edges, with these edges. O(edges).
pub(crate) fn with_two_edges(
    n_vertices: usize,
    edges: &[[u32; 2]],
    removed: &[bool],
    is_candidate: impl Fn(u32) -> bool,
) -> FxHashMap<u32, [u32; 2]> {
    let remaining =
        || edges.iter().zip(0u32..).zip(removed).filter(|(_, removed)| !**removed).map(|(edge, _)| edge);
    let mut degree = vec![0u32; n_vertices];
    for (ends, _) in remaining() {
        ends.iter().for_each(|&v| degree[v as usize] += 1);
    }
    if !degree.contains(&2) {
        return FxHashMap::default();
    }
    let mut found: FxHashMap<u32, [u32; 2]> = FxHashMap::default();
    for (ends, edge) in remaining() {
        for &v in ends.iter().filter(|&&v| degree[v as usize] == 2 && is_candidate(v)) {
            found.entry(v).or_insert([edge; 2])[1] = edge;
        }
    }
    found
}

/// Keeps the edges inside of new faces that would be none: where one remaining half-edge stands in two of the faces
/// to be joined, their union folds back over itself, and its boundary would count that edge twice; where no edge remains,
/// the faces close up to a surface, flat but for rounding. Polygons that cross themselves do the former when rounding has
/// bent them. True when there are such; faces are then to be joined anew.
/// O(n log n).
pub(crate) fn keep_folds(faces: &Faces, removed: &mut [bool], new_face: &[u32], n_new_faces: usize) -> bool {
    let mut size = vec![0u32; n_new_faces];
    new_face.iter().for_each(|&new| size[new as usize] += 1);
    let mut kept: Vec<(u32, u32)> = Vec::new();
    for (face, &new) in new_face.iter().enumerate().filter(|(_, new)| size[**new as usize] > 1) {
        kept.extend(faces.half_edges(face).filter(|h| !removed[(h / 2) as usize]).map(|h| (new, h)));
    }
    kept.sort_unstable();
    let mut folded: Vec<bool> = size.iter().map(|&size| size > 1).collect();
    kept.iter().for_each(|&(new, _)| folded[new as usize] = false);
    kept.windows(2).filter(|w| w[0] == w[1]).for_each(|w| folded[w[0].0 as usize] = true);
    for (face, _) in new_face.iter().enumerate().filter(|(_, new)| folded[**new as usize]) {
        faces.half_edges(face).for_each(|h| removed[(h / 2) as usize] = false);
    }
    folded.contains(&true)
}

/// The loops, as old half-edges, of each new face that a removed edge bounds or bounded: there the walk goes on along
/// the loop on its other side.
fn remaining_loops(faces: &Faces, removal: &Removal) -> FxHashMap<u32, Vec<Vec<u32>>> {
    let is_removed = |h: u32| removal.edges[(h / 2) as usize];
    let mut touched: FxHashMap<u32, Vec<Vec<u32>>> = FxHashMap::default();
    for old in (0..faces.n_faces()).filter(|&old| faces.half_edges(old).any(is_removed)) {
        touched.entry(removal.new_face[old]).or_default();
    }
    if touched.is_empty() {
        return touched;
    }
    let is_touched = |old: &usize| touched.contains_key(&removal.new_face[*old]);
    let old_faces: Vec<usize> = (0..faces.n_faces()).filter(is_touched).collect();
    // By places in the list of all half-edges: what follows on each that was not walked, and where removed ones stand.
    let half_edges = faces.loops.indices();
    let mut next: FxHashMap<u32, u32> = FxHashMap::default();
    let mut at: FxHashMap<u32, u32> = FxHashMap::default();
    let places = |l: u32| faces.loops.offsets()[l as usize]..faces.loops.offsets()[l as usize + 1];
    for place in old_faces.iter().flat_map(|&old| faces.loops_of(old)).map(places) {
        for i in place.clone() {
            next.insert(i, if i + 1 == place.end { place.start } else { i + 1 });
            if is_removed(half_edges[i as usize]) {
                at.insert(half_edges[i as usize], i);
            }
        }
    }
    for old in old_faces {
        let cycles = touched.entry(removal.new_face[old]).or_default();
        for start in faces.loops_of(old).flat_map(places) {
            let (mut cycle, mut i) = (Vec::new(), start);
            while !is_removed(half_edges[i as usize])
                && let Some(mut onward) = next.remove(&i)
            {
                cycle.push(half_edges[i as usize]);
                while is_removed(half_edges[onward as usize]) {
                    onward = next[&at[&(half_edges[onward as usize] ^ 1)]];
                }
                i = onward;
            }
            if !cycle.is_empty() {
                cycles.push(cycle);
            }
        }
    }
    touched
}

/// The outer one of several loops: it reaches farthest in every direction of the plane, so it wins along every
/// axis on which the loops differ.
fn outer_first(cycles: &[Vec<u32>], faces: &Faces, positions: impl Fn(u32) -> [f64; 3]) -> Option<usize> {
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

/// One new edge: its first old edge, its ends, and the old half-edges from one end to the other when there are more
/// than that edge.
struct Chain {
    edge: u32,
    ends: [u32; 2],
    walk: Vec<u32>,
}

impl Chain {
    fn single(half_edge: u32, faces: &Faces) -> Self {
        Self { edge: half_edge / 2, ends: faces.ends(half_edge), walk: Vec::new() }
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
        let passes = |v: &u32| removal.vertices.contains_key(v);
        let is_single =
            |edge: u32| removal.vertices.is_empty() || !faces.edges[edge as usize].iter().any(passes);
        let mut seen = removal.edges.to_vec();
        let mut chains = Vec::with_capacity(faces.edges.len());
        for edge in 0..faces.edges.len() as u32 {
            if seen[edge as usize] {
                continue;
            }
            if is_single(edge) {
                chains.push(Chain::single(2 * edge, faces));
                continue;
            }
            let walk = chain_through(edge, faces, removal.vertices);
            walk.iter().for_each(|&h| seen[(h / 2) as usize] = true);
            let ends = [faces.ends(walk[0])[0], faces.ends(*walk.last().expect("not empty"))[1]];
            chains.push(if walk.len() == 1 {
                Chain::single(walk[0], faces)
            } else {
                Chain { edge, ends, walk }
            });
        }
        Self::numbered(&without_doubles(chains, faces), faces)
    }

    fn numbered(chains: &[Chain], faces: &Faces) -> Self {
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
            let in_walk = chain.walk.iter().copied().find(|h| h / 2 == chain.edge);
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

/// The half-edges of the chain that an edge is part of. A chain that closes on itself stays in single edges.
fn chain_through(edge: u32, faces: &Faces, passing: &FxHashMap<u32, [u32; 2]>) -> Vec<u32> {
    let onward = |h: u32| {
        let head = faces.ends(h)[1];
        let other = passing.get(&head)?.iter().copied().find(|&e| e != h / 2)?;
        Some(2 * other + u32::from(faces.edges[other as usize][0] != head))
    };
    let mut ahead = vec![2 * edge];
    while let Some(h) = onward(*ahead.last().expect("not empty")) {
        if h == ahead[0] {
            return vec![2 * edge];
        }
        ahead.push(h);
    }
    let mut behind = Vec::new();
    let mut h = 2 * edge + 1;
    while let Some(back) = onward(h) {
        behind.push(back ^ 1);
        h = back;
    }
    behind.reverse();
    behind.extend(ahead);
    behind
}

/// Chains with the same ends, or with equal ends, would make edges that cannot be told apart: they stay in pieces.
fn without_doubles(chains: Vec<Chain>, faces: &Faces) -> Vec<Chain> {
    let key = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let mut count: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    if chains.iter().all(|c| c.walk.is_empty()) {
        return chains;
    }
    for chain in &chains {
        *count.entry(key(chain.ends)).or_default() += 1;
    }
    let mut out = Vec::with_capacity(chains.len());
    for chain in chains {
        if chain.walk.is_empty() || (chain.ends[0] != chain.ends[1] && count[&key(chain.ends)] == 1) {
            out.push(chain);
        } else {
            out.extend(chain.walk.into_iter().map(|h| Chain::single(h, faces)));
        }
    }
    out.sort_by_key(|chain| chain.edge);
    out
}
