//! Numbers of grid points by their coordinates.

use crate::parallel;
use std::ops::Range;

/// Points are looked at so many at a time.
const BLOCK: usize = 256;

/// Open addressing: at least half of the slots are empty.
#[derive(Debug, Default)]
pub(crate) struct PointTable {
    /// 0, or 32 bits of the hash above the point's number + 1.
    slots: Vec<u64>,
}

/// Some points, equal ones once.
pub(crate) struct Unified {
    pub table: PointTable,
    /// The distinct points in the order in which they come first.
    pub points: Vec<[i64; 3]>,
    /// Which of these each is; empty when all are distinct.
    pub number: Vec<u32>,
}

impl Unified {
    /// Every thread looks at all points and takes those with a place in its part of the table. O(n) expected for each.
    pub(crate) fn new(mut points: Vec<[i64; 3]>) -> Self {
        let at = |i: u32| points[i as usize];
        let mut table = PointTable { slots: parallel::zeros(PointTable::n_slots(points.len())) };
        let n_slots = table.slots.len();
        let filled = parallel::map_parts(&mut table.slots, |range, slots| {
            let mut part = Part { slots, range, bits: n_slots.ilog2(), ..Part::default() };
            let mut own = [(0, 0); BLOCK];
            for (block, begin) in points.chunks(BLOCK).zip((0..).step_by(BLOCK)) {
                let mut n = 0;
                // Without a branch: it is by chance whose a point is.
                for (&point, i) in block.iter().zip(begin..) {
                    own[n] = (hash(point), i);
                    n += usize::from(part.place(own[n].0).is_some());
                }
                own[..n].iter().for_each(|&(hash, i)| part.insert(hash, i, at));
            }
            (part.repeated, part.left)
        });
        let mut repeated = Vec::new();
        for (more, left) in filled {
            repeated.extend(more);
            // Those that are equal have been left by the same thread.
            for i in left {
                match table.slot(at(i), at) {
                    Ok(first) => repeated.push((i, first)),
                    Err(slot) => table.fill(slot, at(i), i),
                }
            }
        }
        if repeated.is_empty() {
            return Self { table, points, number: Vec::new() };
        }
        let mut number: Vec<u32> = (0..points.len() as u32).collect();
        repeated.into_iter().for_each(|(i, first)| number[i as usize] = first);
        let mut n = 0;
        for i in 0..points.len() {
            let first = number[i] as usize;
            if first == i {
                number[i] = n as u32;
                points[n] = points[i];
                n += 1;
            } else {
                number[i] = number[first];
            }
        }
        points.truncate(n);
        points.shrink_to_fit();
        parallel::each_chunk(&mut table.slots, |_, slots| {
            for entry in slots.iter_mut().filter(|entry| **entry != 0) {
                *entry = (*entry & TAG) | (u64::from(number[id(*entry) as usize]) + 1);
            }
        });
        Self { table, points, number }
    }
}

/// Consecutive slots of a table.
#[derive(Default)]
struct Part<'a> {
    slots: &'a mut [u64],
    range: Range<usize>,
    /// There are 2^bits slots in all.
    bits: u32,
    /// Points that are there already, and the numbers of the first ones that equal them.
    repeated: Vec<(u32, u32)>,
    /// Points whose slot is behind the part.
    left: Vec<u32>,
}

impl Part<'_> {
    /// Where a point belongs in the part, if it does.
    fn place(&self, hash: u64) -> Option<usize> {
        home(hash, self.bits).checked_sub(self.range.start).filter(|&i| i < self.slots.len())
    }

    /// Adds a point if it has a place in the part.
    fn insert(&mut self, hash: u64, i: u32, at: impl Fn(u32) -> [i64; 3]) {
        let Some(home) = self.place(hash) else { return };
        for entry in &mut self.slots[home..] {
            if *entry == 0 {
                *entry = tag(hash) | (u64::from(i) + 1);
                return;
            }
            if *entry & TAG == tag(hash) && at(id(*entry)) == at(i) {
                self.repeated.push((i, id(*entry)));
                return;
            }
        }
        self.left.push(i);
    }
}

impl PointTable {
    /// A table for at most `n` points.
    pub(crate) fn with_capacity(n: usize) -> Self {
        Self { slots: vec![0; Self::n_slots(n)] }
    }

    fn n_slots(n: usize) -> usize {
        (2 * n).next_power_of_two().max(2)
    }

    /// Adds a point that is not there yet, by its number; `at` gives the coordinates of the others.
    pub(crate) fn insert(&mut self, point: [i64; 3], id: u32, at: impl Fn(u32) -> [i64; 3]) {
        if let Err(slot) = self.slot(point, at) {
            self.fill(slot, point, id);
        }
    }

    /// The number of the point with these coordinates; `at` gives those of a number.
    pub(crate) fn find(&self, point: [i64; 3], at: impl Fn(u32) -> [i64; 3]) -> Option<u32> {
        if self.slots.is_empty() { None } else { self.slot(point, at).ok() }
    }

    fn fill(&mut self, slot: usize, point: [i64; 3], id: u32) {
        self.slots[slot] = tag(hash(point)) | (u64::from(id) + 1);
    }

    /// The number of a point, or the empty slot where it belongs.
    fn slot(&self, point: [i64; 3], at: impl Fn(u32) -> [i64; 3]) -> Result<u32, usize> {
        let hash = hash(point);
        let mask = self.slots.len() - 1;
        let mut slot = home(hash, mask.count_ones());
        loop {
            match self.slots[slot] {
                0 => return Err(slot),
                entry if entry & TAG == tag(hash) && at(id(entry)) == point => return Ok(id(entry)),
                _ => slot = (slot + 1) & mask,
            }
        }
    }
}

const TAG: u64 = 0xffff_ffff << 32;

/// The number in a slot that is not empty.
fn id(entry: u64) -> u32 {
    (entry & !TAG) as u32 - 1
}

/// Where a point belongs among 2^bits slots, if it is free.
fn home(hash: u64, bits: u32) -> usize {
    (hash >> (64 - bits)) as usize
}

fn tag(hash: u64) -> u64 {
    hash << 32 & TAG
}

/// Coordinates are often multiples of a high power of two: each factor's high bits come down before the next.
pub(crate) fn hash<const N: usize>(point: [i64; N]) -> u64 {
    let mixed = point
        .iter()
        .fold(0u64, |hash, &x| (hash.rotate_left(32) ^ x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    (mixed ^ mixed >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::num::NonZeroUsize;

    #[test]
    fn points_are_numbered_in_the_order_in_which_they_come() {
        // All on a coarse lattice, so that the low bits are equal.
        let lattice = |i: u32| [i % 7, i / 7 % 7, i / 49 % 7].map(|x| (i64::from(x) - 3) << 37);
        let Unified { table, points, number } = Unified::new((0..2 * 343).map(lattice).collect());
        assert_eq!(points, (0..343).map(lattice).collect::<Vec<_>>());
        assert!(number.iter().copied().eq((0..343).chain(0..343)));
        assert_eq!(table.find(lattice(200), |id| points[id as usize]), Some(200));
        assert_eq!(table.find([1, 2, 3], |id| points[id as usize]), None);
        assert_eq!(PointTable::default().find([0; 3], |_| [0; 3]), None);
    }

    proptest! {
        #[test]
        fn points_are_unified_by_any_number_of_threads(of in prop::collection::vec(0i64..40, 0..200), few in 1i64..40) {
            // Points for which the threads' parts are full to the end, and others.
            let point = |i: u32| [of[i as usize] % few, 0, 0];
            let mut points: Vec<[i64; 3]> = Vec::new();
            let mut number = Vec::new();
            for p in (0..of.len() as u32).map(point) {
                let known = points.iter().position(|q| *q == p);
                number.push(known.unwrap_or(points.len()) as u32);
                points.extend(known.is_none().then_some(p));
            }
            for threads in 1..=5 {
                let unified = || Unified::new((0..of.len() as u32).map(point).collect());
                let unified = parallel::Team::new(NonZeroUsize::new(threads)).work(usize::MAX, unified).unwrap();
                prop_assert_eq!(&unified.points, &points);
                if points.len() == of.len() {
                    prop_assert!(unified.number.is_empty());
                } else {
                    prop_assert_eq!(&unified.number, &number);
                }
                for (&p, id) in points.iter().zip(0..) {
                    prop_assert_eq!(unified.table.find(p, |id| points[id as usize]), Some(id));
                }
                prop_assert_eq!(unified.table.find([99, 0, 0], |id| points[id as usize]), None);
            }
        }
    }
}
