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

use crate::parallel;
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

/// The half-edges round each face: a permutation's orbits, in the order of their smallest members.
#[derive(Debug)]
pub(crate) struct Cycles {
    /// Half-edges of each cycle, each cycle counter-clockwise round its face.
    pub list: Cells,
    /// Cycle of each half-edge.
    pub of: Vec<u32>,
}

impl Cycles {
    /// `next` holds the half-edge after each one round the face on its left; fewer than 2^31 of them. O(n), in place
    /// of `next`.
    pub(crate) fn new(next: Vec<u32>) -> Self {
        const VISITED: u32 = 1 << 31;
        let mut of = next;
        let mut half_edges = Vec::with_capacity(of.len());
        let mut offsets = vec![0];
        for start in 0..of.len() as u32 {
            if of[start as usize] & VISITED != 0 {
                continue;
            }
            let mark = VISITED | (offsets.len() as u32 - 1);
            let mut h = start;
            loop {
                half_edges.push(h);
                h = std::mem::replace(&mut of[h as usize], mark);
                if h == start {
                    break;
                }
            }
            offsets.push(half_edges.len() as u32);
        }
        of.iter_mut().for_each(|mark| *mark ^= VISITED);
        Self { list: Cells::from_parts(offsets, half_edges), of }
    }
}

/// Faces of a planar subdivision. Face 0 is the unbounded one.
#[derive(Debug)]
pub(crate) struct Subdivision {
    pub cycles: Cycles,
    /// Face of each cycle.
    pub face_of: Vec<u32>,
    /// Cycles of each face, the outer one first (the unbounded face has none that is outer).
    pub cycles_of_face: Cells,
    /// Connected components of the edges.
    pub n_components: usize,
}

impl Subdivision {
    /// `edges` join vertices below `n_vertices`; no edge is listed twice. O(n log n) and one location for each
    /// component when there are several.
    pub(crate) fn new(n_vertices: usize, edges: &[[u32; 2]], embedding: &impl Embedding) -> Self {
        let mut star = Star::new(n_vertices, edges);
        let component_of = components(n_vertices, edges);
        let mut firsts = first_vertices(&component_of, &star, embedding);
        star.sort(&firsts, embedding);
        firsts.sort_by(|&v, &w| embedding.sweep_order(v, w));
        let cycles = Cycles::new(star.next());
        let last = |v: u32| *star.leaving(v).last().expect("components have edges");
        let outer: Vec<u32> = firsts.iter().map(|&v| cycles.of[last(v) as usize]).collect();
        let around = |&v: &u32| match firsts.len() {
            1 => None,
            _ => embedding.locate(v, component_of[v as usize], &component_of),
        };
        let around: Vec<Option<u32>> = firsts.iter().map(around).collect();
        Self::nested(cycles, &outer, &around)
    }

    /// Every cycle bounds a face from outside, except one for each component, which is a hole of the face that the
    /// component lies in: the cycle with the wedge that opens towards −u at the component's first vertex. `outer`
    /// holds these cycles in sweep order of the first vertices, `around` a half-edge of the face around each. That
    /// is of a component that comes before it in the sweep: parents are settled first.
    pub(crate) fn nested(cycles: Cycles, outer: &[u32], around: &[Option<u32>]) -> Self {
        let (mut face_of, outlines) = outlines(cycles.list.len(), outer);
        let mut holes: Vec<(u32, u32)> = Vec::with_capacity(outer.len());
        for (&cycle, around) in outer.iter().zip(around) {
            let face = around.map_or(0, |h| face_of[cycles.of[h as usize] as usize]);
            face_of[cycle as usize] = face;
            holes.push((face, cycle));
        }
        // Those of a face stay in sweep order.
        holes.sort_by_key(|&(face, _)| face);
        let cycles_of_face = with_holes(outlines, &holes);
        Self { cycles, face_of, cycles_of_face, n_components: outer.len() }
    }

    /// Number of faces, the unbounded one included.
    pub(crate) fn n_faces(&self) -> usize {
        self.cycles_of_face.len()
    }

    /// The half-edges of a cycle.
    pub(crate) fn cycle(&self, cycle: u32) -> &[u32] {
        &self.cycles.list[cycle as usize]
    }

    /// The face on the left of a half-edge.
    pub(crate) fn face(&self, half_edge: u32) -> u32 {
        self.face_of[self.cycles.of[half_edge as usize] as usize]
    }
}

/// The face of each of n cycles, from 1 on, and the cycles by face. Some cycles are no outlines of faces: they have face 0,
/// and leave room at the end.
fn outlines(n: usize, others: &[u32]) -> (Vec<u32>, Vec<u32>) {
    const OTHER: u32 = u32::MAX;
    let (mut face_of, mut outlines) = (parallel::zeros(n), parallel::zeros(n));
    others.iter().for_each(|&cycle| face_of[cycle as usize] = OTHER);
    let mut n_outlines = 0;
    for (face, cycle) in face_of.iter_mut().zip(0..) {
        if *face == OTHER {
            *face = 0;
        } else {
            outlines[n_outlines] = cycle;
            n_outlines += 1;
            *face = n_outlines as u32;
        }
    }
    (face_of, outlines)
}

/// The cycles of each face, the outline first, in place of the outlines, behind which there is room for the holes: cycles
/// with their faces, by face. Filled from the back.
fn with_holes(outlines: Vec<u32>, holes: &[(u32, u32)]) -> Cells {
    let mut cycles = outlines;
    let n_faces = cycles.len() + 1 - holes.len();
    let mut offsets = parallel::zeros(n_faces + 1);
    let (mut end, mut n_holes) = (cycles.len(), holes.len());
    offsets[n_faces] = end as u32;
    for face in (0..n_faces).rev() {
        while n_holes > 0 && holes[n_holes - 1].0 as usize == face {
            n_holes -= 1;
            end -= 1;
            cycles[end] = holes[n_holes].1;
        }
        if face > 0 {
            end -= 1;
            cycles[end] = cycles[face - 1];
        }
        offsets[face] = end as u32;
    }
    Cells::from_parts(offsets, cycles)
}

/// The half-edges that leave each vertex.
struct Star {
    offsets: Vec<u32>,
    half_edges: Vec<u32>,
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
        Self { offsets, half_edges }
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
    }

    /// The half-edge after each one round its face: the first clockwise from its twin.
    fn next(&self) -> Vec<u32> {
        let mut next = vec![0; self.half_edges.len()];
        for range in self.offsets.windows(2) {
            let leaving = &self.half_edges[range[0] as usize..range[1] as usize];
            let before = leaving.iter().cycle().skip(leaving.len().max(1) - 1);
            for (&h, &clockwise) in leaving.iter().zip(before) {
                next[(h ^ 1) as usize] = clockwise;
            }
        }
        next
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
