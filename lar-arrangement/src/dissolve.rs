//! Stage 5b: soft edges and what only they caused disappear.
//!
//! A nearly planar polygon was cut into triangles by soft edges. Where a soft edge still has only two faces around
//! it, both pieces of the same polygons, the two faces become one. A vertex that is not a corner of the input and
//! is left with two edges was the crossing of a soft edge with something: its edges become one.

use crate::skeleton::Skeleton;
use crate::soup::Soup;
use crate::union_find::UnionFind;
use lar_core::Cells;
use rustc_hash::FxHashMap;

/// The faces, edges and vertices that remain, in terms of the old ones.
#[derive(Debug)]
pub(crate) struct Dissolved {
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
    /// The first of the old faces that make up each new one.
    pub old_face: Vec<u32>,
    /// New face of each old one.
    pub new_face: Vec<u32>,
}

/// Dissolves; copies the skeleton when there is nothing to dissolve.
pub(crate) fn dissolve(skeleton: &Skeleton, rings: &Cells, soup: &Soup) -> Dissolved {
    let removed: Vec<bool> =
        (0..skeleton.edges.len()).map(|e| is_dissolvable(e, skeleton, rings, soup)).collect();
    let (new_face, n_faces) = merged_faces(&removed, rings, skeleton.n_faces());
    let mut old_face = vec![u32::MAX; n_faces as usize];
    for (&new, old) in new_face.iter().zip(0..) {
        let first = &mut old_face[new as usize];
        *first = (*first).min(old);
    }
    let chains = Chains::new(skeleton, &removed);
    let by_face = remaining_loops(skeleton, &removed, &new_face, n_faces as usize);
    let mut loops = Cells::with_capacity(skeleton.loops.len(), skeleton.loops.indices().len());
    let mut face_loops = vec![0];
    let mut one_loop = Vec::new();
    for cycles in by_face {
        let first = outer_first(&cycles, skeleton);
        let order = first.into_iter().chain((0..cycles.len()).filter(|&i| Some(i) != first));
        for i in order {
            one_loop.clear();
            one_loop.extend(cycles[i].iter().filter_map(|&h| chains.new_half_edge[h as usize]));
            loops.push(&one_loop);
        }
        face_loops.push(loops.len() as u32);
    }
    Dissolved {
        vertices: chains.vertices,
        edges: chains.edges,
        old_half_edge: chains.old_half_edge,
        loops,
        face_loops,
        old_face,
        new_face,
    }
}

fn is_dissolvable(edge: usize, skeleton: &Skeleton, rings: &Cells, soup: &Soup) -> bool {
    let &[a, b] = &rings[edge] else { return false };
    let polygons = |face: u32| {
        let mut all: Vec<(u32, bool)> = skeleton
            .face_parents(face)
            .iter()
            .map(|p| (soup.facet_polygon[p.facet as usize], p.same_way))
            .collect();
        all.sort_unstable();
        all
    };
    skeleton.soft[edge] && (a ^ b) % 2 == 1 && polygons(a / 2) == polygons(b / 2)
}

fn merged_faces(removed: &[bool], rings: &Cells, n_faces: usize) -> (Vec<u32>, u32) {
    let mut sets = UnionFind::new(n_faces);
    for (ring, _) in rings.iter().zip(removed).filter(|(_, removed)| **removed) {
        sets.union(ring[0] / 2, ring[1] / 2);
    }
    sets.labels()
}

/// The loops of each new face as old half-edges: at a removed edge the walk goes on along the loop on its other
/// side.
fn remaining_loops(
    skeleton: &Skeleton,
    removed: &[bool],
    new_face: &[u32],
    n_faces: usize,
) -> Vec<Vec<Vec<u32>>> {
    let half_edges = skeleton.loops.indices();
    let mut next = vec![0u32; half_edges.len()];
    let mut at: FxHashMap<u32, u32> = FxHashMap::default();
    for bounds in skeleton.loops.offsets().windows(2) {
        for i in bounds[0]..bounds[1] {
            next[i as usize] = if i + 1 == bounds[1] { bounds[0] } else { i + 1 };
            if removed[(half_edges[i as usize] / 2) as usize] {
                at.insert(half_edges[i as usize], i);
            }
        }
    }
    let mut seen = vec![false; half_edges.len()];
    let mut by_face: Vec<Vec<Vec<u32>>> = vec![Vec::new(); n_faces];
    for face in 0..skeleton.n_faces() {
        for l in skeleton.face_loops[face]..skeleton.face_loops[face + 1] {
            let offsets = skeleton.loops.offsets();
            for start in offsets[l as usize]..offsets[l as usize + 1] {
                let mut cycle = Vec::new();
                let mut i = start;
                while !seen[i as usize] && !removed[(half_edges[i as usize] / 2) as usize] {
                    seen[i as usize] = true;
                    cycle.push(half_edges[i as usize]);
                    i = next[i as usize];
                    while removed[(half_edges[i as usize] / 2) as usize] {
                        i = next[at[&(half_edges[i as usize] ^ 1)] as usize];
                    }
                }
                if !cycle.is_empty() {
                    by_face[new_face[face] as usize].push(cycle);
                }
            }
        }
    }
    by_face
}

/// The outer one of several loops: it reaches farthest in every direction of the plane, so it holds a vertex that
/// is first along an axis on which the loops differ.
fn outer_first(cycles: &[Vec<u32>], skeleton: &Skeleton) -> Option<usize> {
    let reach = |i: usize, axis: usize, least: bool| {
        let along = cycles[i].iter().map(|&h| skeleton.vertices[skeleton.ends(h)[0] as usize].at[axis]);
        if least { along.fold(f64::INFINITY, f64::min) } else { -along.fold(f64::NEG_INFINITY, f64::max) }
    };
    let wins = |i: usize| {
        (0..3)
            .flat_map(|axis| [(axis, true), (axis, false)])
            .filter(|&(axis, least)| {
                (0..cycles.len()).all(|j| reach(i, axis, least) <= reach(j, axis, least))
            })
            .count()
    };
    // Ties go to the first, as `max_by_key` would give them to the last.
    (0..cycles.len()).rev().max_by_key(|&i| if cycles.len() == 1 { 0 } else { wins(i) })
}

/// Edges joined through vertices that disappear.
struct Chains {
    vertices: Vec<u32>,
    edges: Vec<[u32; 2]>,
    old_half_edge: Vec<u32>,
    /// The new half-edge that stands for an old one; `None` for removed edges and for all but one of a chain.
    new_half_edge: Vec<Option<u32>>,
}

impl Chains {
    fn new(skeleton: &Skeleton, removed: &[bool]) -> Self {
        let passing = passing_vertices(skeleton, removed);
        let mut chains: Vec<(u32, [u32; 2], Vec<u32>)> = Vec::new();
        let mut seen = removed.to_vec();
        for edge in 0..skeleton.edges.len() as u32 {
            if !seen[edge as usize] {
                let walk = chain_through(edge, skeleton, &passing);
                walk.iter().for_each(|&h| seen[(h / 2) as usize] = true);
                let ends = [skeleton.ends(walk[0])[0], skeleton.ends(*walk.last().expect("not empty"))[1]];
                chains.push((edge, ends, walk));
            }
        }
        let chains = without_doubles(chains, skeleton);
        Self::numbered(&chains, skeleton)
    }

    fn numbered(chains: &[(u32, [u32; 2], Vec<u32>)], skeleton: &Skeleton) -> Self {
        let mut used = vec![false; skeleton.vertices.len()];
        chains.iter().for_each(|(_, ends, _)| ends.iter().for_each(|&v| used[v as usize] = true));
        let vertices: Vec<u32> = (0..used.len() as u32).filter(|&v| used[v as usize]).collect();
        let new_vertex = |v: u32| vertices.binary_search(&v).expect("ends are used") as u32;
        let mut edges = Vec::with_capacity(chains.len());
        let mut old_half_edge = Vec::with_capacity(chains.len());
        let mut new_half_edge = vec![None; 2 * skeleton.edges.len()];
        for ((edge, ends, walk), id) in chains.iter().zip(0..) {
            let [a, b] = ends.map(new_vertex);
            edges.push([a.min(b), a.max(b)]);
            let along = walk.iter().copied().find(|h| h / 2 == *edge).expect("chains hold their first edge");
            let forward = if a < b { along } else { along ^ 1 };
            old_half_edge.push(forward);
            new_half_edge[forward as usize] = Some(2 * id);
            new_half_edge[(forward ^ 1) as usize] = Some(2 * id + 1);
        }
        Self { vertices, edges, old_half_edge, new_half_edge }
    }
}

/// For each vertex that disappears its two remaining edges.
fn passing_vertices(skeleton: &Skeleton, removed: &[bool]) -> FxHashMap<u32, [u32; 2]> {
    let mut touched: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    for (ends, _) in skeleton.edges.iter().zip(removed).filter(|(_, removed)| **removed) {
        for &v in ends {
            if !matches!(skeleton.vertices[v as usize].def, crate::kernel::VertexDef::Grid(_)) {
                touched.insert(v, Vec::new());
            }
        }
    }
    for ((ends, edge), _) in skeleton.edges.iter().zip(0..).zip(removed).filter(|(_, removed)| !**removed) {
        for v in ends {
            if let Some(edges) = touched.get_mut(v) {
                edges.push(edge);
            }
        }
    }
    touched.into_iter().filter_map(|(v, edges)| Some((v, edges.try_into().ok()?))).collect()
}

/// The half-edges of the chain that an edge is part of. A chain that closes on itself stays in single edges.
fn chain_through(edge: u32, skeleton: &Skeleton, passing: &FxHashMap<u32, [u32; 2]>) -> Vec<u32> {
    let onward = |h: u32| {
        let head = skeleton.ends(h)[1];
        let other = passing.get(&head)?.iter().copied().find(|&e| e != h / 2)?;
        Some(2 * other + u32::from(skeleton.edges[other as usize][0] != head))
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
fn without_doubles(
    chains: Vec<(u32, [u32; 2], Vec<u32>)>,
    skeleton: &Skeleton,
) -> Vec<(u32, [u32; 2], Vec<u32>)> {
    let key = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let mut count: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    for (_, ends, _) in &chains {
        *count.entry(key(*ends)).or_default() += 1;
    }
    let mut out = Vec::with_capacity(chains.len());
    for (edge, ends, walk) in chains {
        if walk.len() == 1 || (ends[0] != ends[1] && count[&key(ends)] == 1) {
            out.push((edge, ends, walk));
        } else {
            out.extend(walk.into_iter().map(|h| (h / 2, skeleton.ends(h), vec![h])));
        }
    }
    out.sort_by_key(|(edge, ..)| *edge);
    out
}
