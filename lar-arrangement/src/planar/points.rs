//! Planar stage 1a: equal grid points are one.

use crate::boxes::bits_of;
use crate::counting::sorted_by_place;
use crate::grid_points::hash;
use crate::marks::Marks;
use crate::parallel;
use std::ops::Range;

/// The distinct ones of n points in first-seen order, and the number of each among them. `is_again` tells of points
/// after the first that they equal the one before, as every other one does where segments are the sides of polygons:
/// these are not looked at. O(n).
pub(crate) fn unify(
    n: usize,
    is_again: impl Fn(usize) -> bool + Sync + Send,
    at: impl Fn(usize) -> [i64; 2] + Sync + Send,
) -> (Vec<[i64; 2]>, Vec<u32>) {
    let begun = Marks::new(n, |i| i == 0 || !is_again(i));
    let mut points = vec![[0; 2]; begun.n];
    let (n_chunks, range) = parallel::chunks(n, CHUNK);
    let parts = parallel::cut(&mut points, (0..n_chunks).map(|chunk| begun.in_chunk(chunk).len()));
    parallel::each(parts.into_iter().enumerate().collect(), |(chunk, part)| {
        part.iter_mut().zip(begun.of(range(chunk))).for_each(|(to, i)| *to = at(i));
    });
    let mut number = first_equal(&points);
    let firsts = Marks::new(number.len(), |i| number[i] == i as u32);
    if firsts.n < points.len() {
        parallel::each_chunk(&mut number, |_, part| part.iter_mut().for_each(|i| *i = firsts.number(*i)));
        firsts.keep(&mut points);
    }
    if begun.n < n {
        number = parallel::map_light(n, |i| number[begun.number(i as u32) as usize]);
    }
    (points, number)
}

impl Marks {
    /// The marked numbers in a range that begins and, unless it is the last, ends with a word of bits.
    fn of(&self, range: Range<usize>) -> impl Iterator<Item = usize> + '_ {
        let words = range.start / 64..range.end.div_ceil(64);
        words.flat_map(|w| bits_of(self.bits[w]).map(move |bit| 64 * w + bit))
    }

    /// Which of the marked numbers are in a chunk.
    fn in_chunk(&self, chunk: usize) -> Range<usize> {
        let begin = |chunk: usize| self.before.get(chunk * (CHUNK / 64)).map_or(self.n, |&n| n as usize);
        begin(chunk)..begin(chunk + 1)
    }

    /// Leaves the other points out: first within chunks, then what is left of these moves together.
    fn keep(&self, points: &mut Vec<[i64; 2]>) {
        parallel::each(points.chunks_mut(CHUNK).enumerate().collect(), |(chunk, part)| {
            let begin = chunk * CHUNK;
            for (to, from) in self.of(begin..begin + part.len()).enumerate() {
                part[to] = part[from - begin];
            }
        });
        for chunk in 0..points.len().div_ceil(CHUNK) {
            let (from, to) = (chunk * CHUNK, self.in_chunk(chunk));
            points.copy_within(from..from + to.len(), to.start);
        }
        points.truncate(self.n);
        points.shrink_to_fit();
    }
}

/// A part's table of this many points stays in a processor's cache.
const PART: usize = 1 << 16;

/// So many points are divided into parts at a time.
const CHUNK: usize = 1 << 15;

/// For each point the first one that equals it. Equal points have equal hashes, so parts by hash are independent.
fn first_equal(points: &[[i64; 2]]) -> Vec<u32> {
    let n_parts = (points.len() / PART).next_power_of_two();
    let (n_chunks, range) = parallel::chunks(points.len(), CHUNK);
    let chunks = parallel::map(n_chunks, |chunk| {
        let all: Vec<u32> = range(chunk).map(|i| i as u32).collect();
        sorted_by_place(n_parts, &all, |&i| hash(points[i as usize]) as usize % n_parts)
    });
    let of_part = |chunk: usize, part: usize| {
        let (offsets, numbers) = &chunks[chunk];
        &numbers[offsets[part] as usize..offsets[part + 1] as usize]
    };
    let firsts = parallel::map(n_parts, |part| {
        let lists: Vec<&[u32]> = (0..n_chunks).map(|chunk| of_part(chunk, part)).collect();
        first_of_part(points, &lists)
    });
    let mut out = vec![0; points.len()];
    parallel::each(out.chunks_mut(CHUNK).enumerate().collect(), |(chunk, out)| {
        for (part, firsts) in firsts.iter().enumerate() {
            for (&i, &first) in of_part(chunk, part).iter().zip(&firsts[chunk]) {
                out[i as usize - range(chunk).start] = first;
            }
        }
    });
    out
}

/// For each of some points, in lists, the first one of all that equals it. A table with open addressing, at most half
/// full.
fn first_of_part(points: &[[i64; 2]], part: &[&[u32]]) -> Vec<Vec<u32>> {
    const EMPTY: u32 = u32::MAX;
    let n: usize = part.iter().map(|list| list.len()).sum();
    let mask = (2 * n).next_power_of_two() - 1;
    let mut table = vec![EMPTY; mask + 1];
    let mut first = |i: u32| {
        // The lowest bits are those of the part.
        let mut slot = (hash(points[i as usize]) >> 24) as usize & mask;
        loop {
            match table[slot] {
                EMPTY => {
                    table[slot] = i;
                    return i;
                }
                other if points[other as usize] == points[i as usize] => return other,
                _ => slot = (slot + 1) & mask,
            }
        }
    };
    part.iter().map(|list| list.iter().map(|&i| first(i)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(8))]
        #[test]
        fn numbers_lead_back_to_the_points(points in prop::collection::vec(prop::array::uniform2(-3i64..3), 0..60)) {
            // Repeated until there is more than one part.
            let points: Vec<[i64; 2]> = (0..1000).flat_map(|k| points.iter().map(move |p| [p[0], p[1] + k])).collect();
            let (distinct, number) = unify(points.len(), |i| points[i] == points[i - 1], |i| points[i]);
            let back: Vec<[i64; 2]> = number.iter().map(|&i| distinct[i as usize]).collect();
            prop_assert_eq!(&back, &points);
            let mut highest = 0;
            for &i in &number {
                prop_assert!(i <= highest);
                highest = highest.max(i + 1);
            }
            let mut sorted = distinct.clone();
            sorted.sort_unstable();
            prop_assert!(sorted.is_sorted_by(|a, b| a < b));
        }
    }
}
