//! Welding: equal points become one vertex.
//!
//! Points are equal when all their coordinates are, never when they are merely near. A table of millions of points is in
//! no cache, and whoever looks up one corner after the other waits for the memory each time. Corners are therefore put into
//! parts by their hash, so that equal ones come into the same part, and each part is welded by itself in a table that the
//! cache holds.

use super::error::MeshFileError;
use super::source::Source;
use crate::Points;
use rustc_hash::FxHasher;
use std::hash::Hasher;
use std::ops::Range;

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

/// A part of 10^7 corners and its table take some megabytes; so many lists that grow keep neither the first cache nor the
/// table of pages busy. Measured from 16 to 512: 16 to 64 are about as fast, 256 a quarter slower.
const PARTS: usize = 64;
/// So many bits of the hash choose the part, those above them the slot.
const PART_BITS: u32 = PARTS.ilog2();
/// Corners whose vertices are written at a time, by all parts: what is written stays in the cache meanwhile.
const WINDOW: usize = 1 << 14;
const EMPTY: u32 = u32::MAX;

/// Corners in parts by their hash. −0 must have been made 0 before.
pub(crate) struct Corners<T, const D: usize> {
    parts: Vec<Vec<Corner<T, D>>>,
    n: u32,
}

#[derive(Clone, Copy)]
struct Corner<T, const D: usize> {
    point: [T; D],
    number: u32,
}

impl<T: Bits, const D: usize> Corners<T, D> {
    pub(crate) fn new() -> Self {
        Self { parts: (0..PARTS).map(|_| Vec::new()).collect(), n: 0 }
    }

    pub(crate) fn len(&self) -> usize {
        self.n as usize
    }

    /// Makes room for so many more corners, or says that there is none.
    pub(crate) fn make_room(&mut self, source: &Source<'_>, n: usize) -> Result<(), MeshFileError> {
        // Somewhat more than equally many for each: they are spread by chance.
        let share = n / PARTS;
        self.parts.iter_mut().try_for_each(|part| source.make_room(part, share + share / 16))
    }

    /// Adds the next corner. The caller keeps their number below 2^32 − 1.
    #[inline]
    pub(crate) fn push(&mut self, point: [T; D]) {
        self.parts[hash(point) % PARTS].push(Corner { point, number: self.n });
        self.n += 1;
    }

    /// The vertices in the order in which they first come, and the vertex of each corner. Expected O(n).
    pub(crate) fn weld(self) -> (Points, Vec<u32>) {
        let (firsts, n_vertices) = self.firsts();
        let (mut coords, mut vertices) = (vec![0.; D * n_vertices], vec![0; self.len()]);
        let points = coords.as_chunks_mut::<D>().0;
        let (mut begins, mut n_numbered) = ([0; PARTS], 0);
        for begin in (0..self.len()).step_by(WINDOW) {
            let end = self.len().min(begin + WINDOW);
            let mut ends = begins;
            for ((part, firsts), k) in self.parts.iter().zip(&firsts).zip(&mut ends) {
                while let Some(corner) = part.get(*k).filter(|corner| (corner.number as usize) < end) {
                    vertices[corner.number as usize] = firsts[*k];
                    *k += 1;
                }
            }
            number(&mut vertices, begin..end, &mut n_numbered);
            for ((part, firsts), (begin, end)) in
                self.parts.iter().zip(&firsts).zip(begins.into_iter().zip(ends))
            {
                for (corner, &first) in part[begin..end].iter().zip(&firsts[begin..end]) {
                    if corner.number == first {
                        points[vertices[first as usize] as usize] = corner.point.map(Bits::to_f64);
                    }
                }
            }
            begins = ends;
        }
        (Points::from_columns(D, coords), vertices)
    }

    /// For each corner of each part the number of the first one with the same point, and how many points there are.
    fn firsts(&self) -> (Vec<Vec<u32>>, usize) {
        let (mut slots, mut n_points) = (Vec::new(), 0);
        let of_part = |part: &Vec<_>| {
            let (firsts, n_of_part) = firsts(part, &mut slots);
            n_points += n_of_part;
            firsts
        };
        (self.parts.iter().map(of_part).collect(), n_points)
    }
}

/// Makes numbers of vertices of those of the first corners with the same points, in a range whose corners before it have
/// theirs.
fn number(vertices: &mut [u32], range: Range<usize>, n_numbered: &mut u32) {
    for corner in range {
        let first = vertices[corner] as usize;
        if first == corner {
            vertices[corner] = *n_numbered;
            *n_numbered += 1;
        } else {
            vertices[corner] = vertices[first];
        }
    }
}

/// The number of the first corner with the same point, for each corner of a part, and how many points there are.
fn firsts<T: Bits, const D: usize>(part: &[Corner<T, D>], slots: &mut Vec<u32>) -> (Vec<u32>, usize) {
    let n_slots = (2 * part.len()).next_power_of_two();
    slots.clear();
    slots.resize(n_slots, EMPTY);
    let mask = n_slots - 1;
    let mut n_points = 0;
    let first = |(corner, i): (&Corner<T, D>, u32)| {
        let mut slot = hash(corner.point) >> PART_BITS & mask;
        loop {
            let Some(other) = part.get(slots[slot] as usize) else {
                slots[slot] = i;
                n_points += 1;
                return corner.number;
            };
            if equal(other.point, corner.point) {
                return other.number;
            }
            slot = (slot + 1) & mask;
        }
    };
    let firsts = part.iter().zip(0..).map(first).collect();
    (firsts, n_points)
}

#[inline]
fn hash<T: Bits, const D: usize>(point: [T; D]) -> usize {
    let mut hasher = FxHasher::default();
    point.into_iter().for_each(|x| hasher.write_u64(x.bits()));
    hasher.finish() as usize
}

/// One decision for all coordinates: the first is seldom enough.
#[inline]
fn equal<T: Bits, const D: usize>(a: [T; D], b: [T; D]) -> bool {
    a.into_iter().zip(b).fold(0, |differing, (a, b)| differing | (a.bits() ^ b.bits())) == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn corners_become_vertices_in_the_order_in_which_they_come() {
        let scattered = |i: u32| [f64::from(i % 997), f64::from(i % 31), 0.1 * f64::from(i % 2)];
        let lattice = |i: u32| [i % 7, i / 7 % 7, i / 49 % 7].map(|x| 1e9 * f64::from(x));
        let same = |_: u32| [1., 2., 3.];
        let different = |i: u32| [0., 0., f64::from(i) * 1e-300];
        for point in [scattered, lattice, same, different] {
            for n in [0, 1, 3, 1000, 100_000] {
                let mut corners = Corners::new();
                let (mut known, mut distinct, mut expected) = (BTreeMap::new(), Vec::new(), Vec::new());
                for point in (0..n).map(point) {
                    corners.push(point);
                    let vertex = *known.entry(point.map(f64::to_bits)).or_insert(distinct.len());
                    expected.push(vertex as u32);
                    if vertex == distinct.len() {
                        distinct.push(point);
                    }
                }
                assert_eq!(corners.len(), n as usize);
                let (points, vertices) = corners.weld();
                assert_eq!(vertices, expected);
                assert_eq!(points.coords(), distinct.as_flattened());
            }
        }
    }

    #[test]
    fn single_precision_is_kept() {
        let mut corners = Corners::new();
        [[0.1f32, 0.], [0., 1e-45], [0.1, 0.]].into_iter().for_each(|point| corners.push(point));
        let (points, vertices) = corners.weld();
        assert_eq!((points.point(1), vertices), (&[0., f64::from(1e-45f32)][..], vec![0, 1, 0]));
    }
}
