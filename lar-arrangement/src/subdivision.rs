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
use std::mem::take;
use std::ops::Range;

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
    /// of `next` and of two lists that are no longer needed.
    pub(crate) fn new(next: Vec<u32>, [mut offsets, mut half_edges]: [Vec<u32>; 2]) -> Self {
        const VISITED: u32 = 1 << 31;
        let mut of = next;
        half_edges.clear();
        half_edges.reserve_exact(of.len());
        offsets.clear();
        offsets.push(0);
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

/// Memory for small subdivisions that are made one after the other.
#[derive(Debug, Default)]
pub(crate) struct Room {
    star: Star,
    next: Vec<u32>,
    cycles: [Vec<u32>; 2],
    faces: [Vec<u32>; 3],
}

impl Room {
    /// Takes the memory of a subdivision that is no longer needed.
    pub(crate) fn take_back(&mut self, done: Subdivision) {
        let Cycles { list, of } = done.cycles;
        self.next = of;
        self.cycles = list.into_parts().into();
        let (offsets, cycles) = done.cycles_of_face.into_parts();
        self.faces = [done.face_of, cycles, offsets];
    }
}

impl Subdivision {
    /// `edges` join vertices below `n_vertices`; no edge is listed twice. O(n log n) and one location for each
    /// component when there are several.
    pub(crate) fn new(
        n_vertices: usize,
        edges: &[[u32; 2]],
        embedding: &impl Embedding,
        room: &mut Room,
    ) -> Self {
        let star = &mut room.star;
        star.fill(n_vertices, edges);
        star.sort(embedding);
        let cycles = Cycles::new(star.next(take(&mut room.next)), take(&mut room.cycles));
        let spare = take(&mut room.faces);
        let outer = |v: u32| cycles.of[star.last(v, embedding) as usize];
        // Euler: each component has two more vertices and cycles than edges.
        if star.centres().count() + cycles.list.len() == edges.len() + 2 {
            let first = star.centres().min_by(|&v, &w| embedding.sweep_order(v, w));
            let outer = [outer(first.expect("a component has vertices"))];
            return Self::nested(cycles, &outer, &[None], spare);
        }
        let component_of = components(n_vertices, edges);
        let mut firsts = first_vertices(&component_of, star, embedding);
        firsts.sort_by(|&v, &w| embedding.sweep_order(v, w));
        let outer: Vec<u32> = firsts.iter().map(|&v| outer(v)).collect();
        let around = |&v: &u32| embedding.locate(v, component_of[v as usize], &component_of);
        let around: Vec<Option<u32>> = firsts.iter().map(around).collect();
        Self::nested(cycles, &outer, &around, spare)
    }

    /// Every cycle bounds a face from outside, except one for each component, which is a hole of the face that the
    /// component lies in: the cycle with the wedge that opens towards −u at the component's first vertex. `outer`
    /// holds these cycles in sweep order of the first vertices, `around` a half-edge of the face around each. That
    /// is of a component that comes before it in the sweep: parents are settled first. In place of lists that are no longer
    /// needed, where they are long enough.
    pub(crate) fn nested(
        cycles: Cycles,
        outer: &[u32],
        around: &[Option<u32>],
        [face_of, outlines, offsets]: [Vec<u32>; 3],
    ) -> Self {
        let n = cycles.list.len();
        let (mut face_of, mut outlines) = (zeroed(face_of, n), zeroed(outlines, n));
        find_outlines(&mut face_of, &mut outlines, outer);
        let mut holes: Vec<(u32, u32)> = Vec::with_capacity(outer.len());
        for (&cycle, around) in outer.iter().zip(around) {
            let face = around.map_or(0, |h| face_of[cycles.of[h as usize] as usize]);
            face_of[cycle as usize] = face;
            holes.push((face, cycle));
        }
        // Those of a face stay in sweep order.
        holes.sort_by_key(|&(face, _)| face);
        let cycles_of_face = with_holes(outlines, &holes, offsets);
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

/// So many zeros.
fn zeroed(mut spare: Vec<u32>, n: usize) -> Vec<u32> {
    if spare.capacity() < n {
        return parallel::zeros(n);
    }
    spare.clear();
    spare.resize(n, 0);
    spare
}

/// Fills in, of zeros, the face of each cycle, from 1 on, and the cycles by face. Some cycles are no outlines of faces: they
/// have face 0, and leave room at the end.
fn find_outlines(face_of: &mut [u32], outlines: &mut [u32], others: &[u32]) {
    const OTHER: u32 = u32::MAX;
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
}

/// The cycles of each face, the outline first, in place of the outlines, behind which there is room for the holes: cycles
/// with their faces, by face. Filled from the back.
fn with_holes(outlines: Vec<u32>, holes: &[(u32, u32)], offsets: Vec<u32>) -> Cells {
    let mut cycles = outlines;
    let n_faces = cycles.len() + 1 - holes.len();
    let mut offsets = zeroed(offsets, n_faces + 1);
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
#[derive(Debug, Default)]
struct Star {
    offsets: Vec<u32>,
    half_edges: Vec<u32>,
}

impl Star {
    fn fill(&mut self, n_vertices: usize, edges: &[[u32; 2]]) {
        let Self { offsets, half_edges } = self;
        offsets.clear();
        offsets.resize(n_vertices + 2, 0);
        for &v in edges.as_flattened() {
            offsets[v as usize + 2] += 1;
        }
        for v in 2..offsets.len() {
            offsets[v] += offsets[v - 1];
        }
        half_edges.clear();
        half_edges.resize(2 * edges.len(), 0);
        // What begins behind each vertex moves on to its end.
        for (&v, h) in edges.as_flattened().iter().zip(0..) {
            let at = &mut offsets[v as usize + 1];
            half_edges[*at as usize] = h;
            *at += 1;
        }
        offsets.pop();
    }

    fn range(&self, v: u32) -> Range<usize> {
        self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize
    }

    fn leaving(&self, v: u32) -> &[u32] {
        &self.half_edges[self.range(v)]
    }

    /// The vertices that half-edges leave, ascending.
    fn centres(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.offsets.len() as u32 - 1).filter(|&v| !self.range(v).is_empty())
    }

    /// Sorts by angle where the order matters: two half-edges have only one cyclic order.
    fn sort(&mut self, embedding: &impl Embedding) {
        for v in 0..self.offsets.len() as u32 - 1 {
            let range = self.range(v);
            if range.len() > 2 {
                self.half_edges[range].sort_by(|&a, &b| embedding.angular_order(a, b));
            }
        }
    }

    /// The last half-edge that leaves a vertex of some, by angle.
    fn last(&self, v: u32, embedding: &impl Embedding) -> u32 {
        let last = match *self.leaving(v) {
            [a, b] if embedding.angular_order(a, b).is_gt() => Some(a),
            ref sorted => sorted.last().copied(),
        };
        last.expect("components have edges")
    }

    /// The half-edge after each one round its face, in place of a list: the first clockwise from its twin.
    fn next(&self, mut next: Vec<u32>) -> Vec<u32> {
        next.clear();
        next.resize(self.half_edges.len(), 0);
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
    for v in star.centres() {
        let best = &mut first[component_of[v as usize] as usize];
        if best.is_none_or(|b| embedding.sweep_order(v, b).is_lt()) {
            *best = Some(v);
        }
    }
    first.into_iter().flatten().collect()
}
