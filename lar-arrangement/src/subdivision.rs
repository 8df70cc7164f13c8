//! A planar subdivision from its edges: cycles around faces, components, holes. No coordinates here: the caller
//! supplies the angular order at a vertex, the order of vertices along a sweep, and point location.
//!
//! Half-edge 2e leads from the first end of edge e to the second, 2e + 1 back; a half-edge's face is on its left.
//!
//! ```text
//!          next(h) is the first half-edge clockwise from the twin of h:
//!                \   ^ next(h)
//!                 \ /
//!     ── h ──────> v        the wedge between them is the face's corner
//! ```

use crate::union_find::UnionFind;
use lar_core::Cells;
use std::cmp::Ordering;

/// What the topology needs to know of the embedding.
pub(crate) trait Embedding {
    /// Order by angle of two half-edges that leave the same vertex, counter-clockwise from direction −u
    /// (excluded) round to −u (included).
    fn angular_order(&self, a: u32, b: u32) -> Ordering;
    /// Lexicographic order of two vertices along (u, v).
    fn sweep_order(&self, a: u32, b: u32) -> Ordering;
    /// The half-edge on whose left a vertex lies that is the first of its component in sweep order; `None` when it
    /// is outside everything else.
    fn locate(&self, vertex: u32, component: u32, component_of: &[u32]) -> Option<u32>;
}

/// Faces of a planar subdivision. Face 0 is the unbounded one.
#[derive(Debug)]
pub(crate) struct Subdivision {
    /// Half-edges of each cycle, each cycle counter-clockwise round its face.
    pub cycles: Cells,
    /// Cycle of each half-edge.
    pub cycle_of: Vec<u32>,
    /// Face of each cycle.
    pub face_of: Vec<u32>,
    /// Cycles of each face, the outer one first (the unbounded face has none that is outer).
    pub cycles_of_face: Vec<Vec<u32>>,
}

impl Subdivision {
    /// `edges` join vertices below `n_vertices`; no edge is listed twice. O(n log n) and one location for each
    /// component after the first.
    pub(crate) fn new(n_vertices: usize, edges: &[[u32; 2]], embedding: &impl Embedding) -> Self {
        let mut star = Star::new(n_vertices, edges);
        let component_of = components(n_vertices, edges);
        let firsts = first_vertices(&component_of, &star, embedding);
        star.sort(&firsts, embedding);
        let (cycles, cycle_of) = cycles(edges, &star);
        let mut out =
            Self { face_of: vec![0; cycles.len()], cycles_of_face: vec![Vec::new()], cycles, cycle_of };
        out.number_faces(&firsts, &star, &component_of, embedding);
        out
    }

    /// Number of faces, the unbounded one included.
    pub(crate) fn n_faces(&self) -> usize {
        self.cycles_of_face.len()
    }

    /// The face on the left of a half-edge.
    pub(crate) fn face(&self, half_edge: u32) -> u32 {
        self.face_of[self.cycle_of[half_edge as usize] as usize]
    }

    /// Every cycle bounds a face from outside, except one for each component, which is a hole of the face that the
    /// component lies in: the cycle with the wedge that opens towards −u at the component's first vertex.
    fn number_faces(
        &mut self,
        firsts: &[u32],
        star: &Star,
        component_of: &[u32],
        embedding: &impl Embedding,
    ) {
        let outer: Vec<u32> = firsts
            .iter()
            .map(|&v| self.cycle_of[*star.leaving(v).last().expect("components have edges") as usize])
            .collect();
        let mut is_hole = vec![false; self.cycles.len()];
        for &cycle in &outer {
            is_hole[cycle as usize] = true;
        }
        for (&hole, cycle) in is_hole.iter().zip(0..) {
            if !hole {
                self.face_of[cycle as usize] = self.cycles_of_face.len() as u32;
                self.cycles_of_face.push(vec![cycle]);
            }
        }
        // A component is located relative to one that comes before it in the sweep: parents are settled first.
        let mut order: Vec<usize> = (0..firsts.len()).collect();
        order.sort_by(|&i, &j| embedding.sweep_order(firsts[i], firsts[j]));
        for i in order {
            let v = firsts[i];
            let around = match firsts.len() {
                1 => None,
                _ => embedding.locate(v, component_of[v as usize], component_of),
            };
            let face = around.map_or(0, |half_edge| self.face(half_edge));
            self.face_of[outer[i] as usize] = face;
            self.cycles_of_face[face as usize].push(outer[i]);
        }
    }
}

/// The half-edges that leave each vertex.
struct Star {
    offsets: Vec<u32>,
    half_edges: Vec<u32>,
    /// Place of each half-edge in `half_edges`.
    place: Vec<u32>,
}

impl Star {
    fn new(n_vertices: usize, edges: &[[u32; 2]]) -> Self {
        let mut offsets = vec![0u32; n_vertices + 1];
        for &v in edges.as_flattened() {
            offsets[v as usize + 1] += 1;
        }
        for v in 0..n_vertices {
            offsets[v + 1] += offsets[v];
        }
        let mut fill = offsets.clone();
        let mut half_edges = vec![0; 2 * edges.len()];
        for (&v, h) in edges.as_flattened().iter().zip(0..) {
            half_edges[fill[v as usize] as usize] = h;
            fill[v as usize] += 1;
        }
        Self { offsets, half_edges, place: Vec::new() }
    }

    fn leaving(&self, v: u32) -> &[u32] {
        &self.half_edges[self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize]
    }

    /// Sorts by angle where the order matters: two half-edges have only one cyclic order, but at a component's
    /// first vertex it also matters which of them comes last.
    fn sort(&mut self, firsts: &[u32], embedding: &impl Embedding) {
        for w in 0..self.offsets.len() - 1 {
            let range = self.offsets[w] as usize..self.offsets[w + 1] as usize;
            if range.len() > 2 {
                self.half_edges[range].sort_by(|&a, &b| embedding.angular_order(a, b));
            }
        }
        for &v in firsts {
            let range = self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize;
            if range.len() == 2 {
                self.half_edges[range].sort_by(|&a, &b| embedding.angular_order(a, b));
            }
        }
        self.place = vec![0; self.half_edges.len()];
        for (&h, at) in self.half_edges.iter().zip(0..) {
            self.place[h as usize] = at;
        }
    }

    /// The first half-edge clockwise from h round the vertex that h leaves.
    fn clockwise(&self, h: u32, v: u32) -> u32 {
        let (from, to) = (self.offsets[v as usize], self.offsets[v as usize + 1]);
        let at = self.place[h as usize];
        self.half_edges[(if at == from { to - 1 } else { at - 1 }) as usize]
    }
}

/// Component of each vertex.
fn components(n_vertices: usize, edges: &[[u32; 2]]) -> Vec<u32> {
    let mut sets = UnionFind::new(n_vertices);
    for &[a, b] in edges {
        sets.union(a, b);
    }
    sets.labels().0
}

/// The first vertex in sweep order of each component that has edges.
fn first_vertices(component_of: &[u32], star: &Star, embedding: &impl Embedding) -> Vec<u32> {
    let n = component_of.iter().max().map_or(0, |&c| c as usize + 1);
    let mut first: Vec<Option<u32>> = vec![None; n];
    for (&c, v) in component_of.iter().zip(0..) {
        if star.leaving(v).is_empty() {
            continue;
        }
        let best = &mut first[c as usize];
        if best.is_none_or(|b| embedding.sweep_order(v, b).is_lt()) {
            *best = Some(v);
        }
    }
    first.into_iter().flatten().collect()
}

fn cycles(edges: &[[u32; 2]], star: &Star) -> (Cells, Vec<u32>) {
    const UNSET: u32 = u32::MAX;
    let mut cycle_of = vec![UNSET; 2 * edges.len()];
    let mut cycles = Cells::with_capacity(0, 2 * edges.len());
    let mut cycle = Vec::new();
    for start in 0..2 * edges.len() as u32 {
        if cycle_of[start as usize] != UNSET {
            continue;
        }
        cycle.clear();
        let mut h = start;
        while cycle_of[h as usize] == UNSET {
            cycle_of[h as usize] = cycles.len() as u32;
            cycle.push(h);
            let head = edges[(h / 2) as usize][(1 - h % 2) as usize];
            h = star.clockwise(h ^ 1, head);
        }
        cycles.push(&cycle);
    }
    (cycles, cycle_of)
}
