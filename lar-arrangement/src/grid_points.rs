//! Numbers of grid points by their coordinates.

use crate::parallel;
use std::ops::Range;

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
    /// Every thread hands the points of its share to the thread in whose part of the table they belong. O(n) expected.
    pub(crate) fn new(mut points: Vec<[i64; 3]>) -> Self {
        let at = |i: u32| points[i as usize];
        let mut table = PointTable { slots: parallel::zeros(PointTable::n_slots(points.len())) };
        let (n_slots, n_parts) = (table.slots.len(), parallel::n_threads());
        let bits = n_slots.ilog2();
        let hashed = |share: Range<usize>| {
            let begin = share.start as u32;
            points[share].iter().zip(begin..).map(|(&point, i)| (hash(point), i))
        };
        let handed = (n_parts > 1).then(|| {
            parallel::map(n_parts, |share| {
                let share = parallel::part_of(points.len(), share);
                // Somewhat more than equally many for each: they are spread by chance.
                let room = 9 * share.len() / (8 * n_parts);
                let mut of_parts: Vec<Vec<(u64, u32)>> =
                    (0..n_parts).map(|_| Vec::with_capacity(room)).collect();
                for (hash, i) in hashed(share) {
                    of_parts[part_with(home(hash, bits), bits, n_parts)].push((hash, i));
                }
                of_parts
            })
        });
        let slots =
            parallel::cut(&mut table.slots, (0..n_parts).map(|i| parallel::part_of(n_slots, i).len()));
        let filled = parallel::map_each(slots, |i, slots| {
            let begin = parallel::part_of(n_slots, i).start;
            let mut part = Part { slots, begin, bits, ..Part::default() };
            match &handed {
                None => hashed(0..points.len()).for_each(|(hash, i)| part.insert(hash, i, at)),
                // Share by share, as the points come.
                Some(handed) => {
                    let own = handed.iter().flat_map(|of_parts| &of_parts[i]);
                    own.for_each(|&(hash, i)| part.insert(hash, i, at));
                }
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
    /// The first of them.
    begin: usize,
    /// There are 2^bits slots in all.
    bits: u32,
    /// Points that are there already, and the numbers of the first ones that equal them.
    repeated: Vec<(u32, u32)>,
    /// Points whose slot is behind the part.
    left: Vec<u32>,
}

impl Part<'_> {
    /// Adds a point that has its place in the part.
    fn insert(&mut self, hash: u64, i: u32, at: impl Fn(u32) -> [i64; 3]) {
        let home = home(hash, self.bits) - self.begin;
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

/// Which of the parts that `parallel::part_of` makes of 2^bits slots has a slot.
fn part_with(slot: usize, bits: u32, n_parts: usize) -> usize {
    ((slot + 1) * n_parts - 1) >> bits
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

    #[test]
    fn every_slot_is_in_one_part() {
        for (bits, n_parts) in [(1, 1), (1, 5), (3, 2), (3, 3), (4, 5), (6, 64), (10, 7)] {
            let n = 1 << bits;
            for slot in 0..n {
                let part = part_with(slot, bits, n_parts);
                assert!(
                    (n * part / n_parts..n * (part + 1) / n_parts).contains(&slot),
                    "{slot} of {n}, {n_parts} parts"
                );
            }
        }
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
