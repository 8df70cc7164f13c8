//! Welding: equal points become one vertex.
//!
//! Points are equal when all their coordinates are, never when they are merely near. The table holds indices
//! only and compares through them, and the points stand in blocks that are freed as they are converted, so
//! that a soup of triangles passes in about twice the size of its file.

use crate::Points;
use rustc_hash::FxHasher;
use std::hash::Hasher;

/// What welding did to the corners of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Weld {
    /// Corners read: three per facet.
    pub corners: usize,
    /// Vertices that they make.
    pub vertices: usize,
    /// Facets left out because two of their corners are one vertex. Leaving them out opens no surface: their
    /// edges cancel each other.
    pub collapsed: usize,
}

/// A number as its bits, for hashing and exact comparison.
pub(crate) trait Bits: Copy {
    fn bits(self) -> u64;
    fn to_f64(self) -> f64;
}

impl Bits for f32 {
    fn bits(self) -> u64 {
        self.to_bits().into()
    }
    fn to_f64(self) -> f64 {
        self.into()
    }
}

impl Bits for f64 {
    fn bits(self) -> u64 {
        self.to_bits()
    }
    fn to_f64(self) -> f64 {
        self
    }
}

const EMPTY: u32 = u32::MAX;
/// Slots that the caches do not hold.
const LARGE: usize = 1 << 18;
/// Points a block: with 12 bytes each above 32 MiB, from where on the usual allocators give freed memory back to the
/// system at once.
const BLOCK: usize = 1 << 22;

/// Numbers points in the order in which they are first seen. −0 must have been made 0 before.
pub(crate) struct Welder<T, const D: usize> {
    blocks: Vec<Vec<[T; D]>>,
    n: u32,
    /// Open addressing with linear probing, a power of two, at most half full: what is not there is found missing soon.
    slots: Vec<u32>,
}

impl<T: Bits, const D: usize> Welder<T, D> {
    pub(crate) fn new() -> Self {
        Self { blocks: Vec::new(), n: 0, slots: vec![EMPTY; 64] }
    }

    pub(crate) fn len(&self) -> usize {
        self.n as usize
    }

    /// Makes room in the table for so many more vertices, which then needs not grow step by step.
    pub(crate) fn expect(&mut self, vertices: usize) {
        let needed = (2 * (self.len() + vertices)).next_power_of_two();
        if needed > self.slots.len() {
            self.resize(needed);
        }
    }

    /// The vertex at `point`; expected O(1). The caller keeps the number of vertices below 2^32 − 1.
    pub(crate) fn vertex(&mut self, point: [T; D]) -> u32 {
        if self.len() >= self.slots.len() / 2 {
            self.grow();
        }
        let slot = self.slot(point);
        if self.slots[slot] == EMPTY {
            self.slots[slot] = self.n;
            self.push(point);
        }
        self.slots[slot]
    }

    /// The vertices at points, as [`vertex`](Self::vertex) has them one after the other. Where the table is larger than
    /// the caches this takes a tenth less time: no look-up waits for the one before.
    pub(crate) fn batch(&mut self, points: &[[T; D]], vertices: &mut Vec<u32>) {
        while self.len() + points.len() > self.slots.len() / 2 {
            self.grow();
        }
        vertices.clear();
        if self.slots.len() < LARGE {
            vertices.extend(points.iter().map(|&point| self.vertex(point)));
            return;
        }
        let mask = self.slots.len() - 1;
        vertices.extend(points.iter().map(|&point| self.slots[hash(point) & mask]));
        for (vertex, &point) in vertices.iter_mut().zip(points) {
            if *vertex != EMPTY && !equal(self.point(*vertex), point) {
                *vertex = EMPTY;
            }
        }
        // What is not there, or not where it was looked for first.
        for (vertex, &point) in vertices.iter_mut().zip(points).filter(|(vertex, _)| **vertex == EMPTY) {
            *vertex = self.vertex(point);
        }
    }

    /// The points, vertex after vertex.
    pub(crate) fn into_points(self) -> Points {
        let Self { mut blocks, n, slots } = self;
        drop(slots);
        // Zeroed memory is not there until it is written, and each block goes as its part is written.
        let mut coords = vec![0.; n as usize * D];
        while let Some(block) = blocks.pop() {
            let to = coords[blocks.len() * BLOCK * D..].iter_mut();
            to.zip(block.as_flattened()).for_each(|(to, &from)| *to = from.to_f64());
        }
        Points::from_columns(D, coords)
    }

    fn push(&mut self, point: [T; D]) {
        match self.blocks.last_mut() {
            Some(block) if block.len() < BLOCK => block.push(point),
            _ => {
                let mut block = if self.blocks.is_empty() { Vec::new() } else { Vec::with_capacity(BLOCK) };
                block.push(point);
                self.blocks.push(block);
            }
        }
        self.n += 1;
    }

    fn point(&self, vertex: u32) -> [T; D] {
        let i = vertex as usize;
        self.blocks[i / BLOCK][i % BLOCK]
    }

    /// The slot of an equal point, or the empty one where it belongs.
    fn slot(&self, point: [T; D]) -> usize {
        let mask = self.slots.len() - 1;
        let mut slot = hash(point) & mask;
        while self.slots[slot] != EMPTY && !equal(self.point(self.slots[slot]), point) {
            slot = (slot + 1) & mask;
        }
        slot
    }

    fn grow(&mut self) {
        self.resize(2 * self.slots.len());
    }

    /// Puts the vertices into a table of another size, a power of two.
    fn resize(&mut self, n_slots: usize) {
        self.slots = Vec::new();
        self.slots = vec![EMPTY; n_slots];
        let mask = n_slots - 1;
        for vertex in 0..self.n {
            let mut slot = hash(self.point(vertex)) & mask;
            while self.slots[slot] != EMPTY {
                slot = (slot + 1) & mask;
            }
            self.slots[slot] = vertex;
        }
    }
}

fn hash<T: Bits, const D: usize>(point: [T; D]) -> usize {
    let mut hasher = FxHasher::default();
    point.into_iter().for_each(|x| hasher.write_u64(x.bits()));
    hasher.finish() as usize
}

/// One decision for all coordinates: the first is seldom enough.
fn equal<T: Bits, const D: usize>(a: [T; D], b: [T; D]) -> bool {
    a.into_iter().zip(b).fold(0, |differing, (a, b)| differing | (a.bits() ^ b.bits())) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_are_welded_like_single_points() {
        let n = u32::try_from(LARGE).unwrap();
        let points: Vec<_> = (0..n).map(|i| [f64::from(i % 100_003), f64::from(i % 2)]).collect();
        let mut one_by_one = Welder::new();
        let expected: Vec<_> = points.iter().map(|&point| one_by_one.vertex(point)).collect();
        for size in [192, 5000] {
            let (mut welder, mut batch, mut found) = (Welder::new(), Vec::new(), Vec::new());
            for points in points.chunks(size) {
                welder.batch(points, &mut batch);
                found.extend_from_slice(&batch);
            }
            assert_eq!(found, expected);
            assert_eq!(welder.len(), one_by_one.len());
        }
    }

    #[test]
    fn equal_points_are_one_vertex() {
        let mut welder = Welder::new();
        let point = |i: u32| [i as f32 * 0.1, (i % 7) as f32, -1.];
        let n = 3 * u32::try_from(BLOCK).unwrap() / 2;
        for i in (0..n).chain((0..n).rev()) {
            assert_eq!(welder.vertex(point(i)), i);
        }
        assert_eq!(welder.vertex([0., 0., 1e-45]), n);
        assert_eq!(welder.len(), n as usize + 1);
        let points = welder.into_points();
        assert_eq!(points.xyz(70_000), point(70_000).map(f64::from));
    }
}
