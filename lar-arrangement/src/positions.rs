//! What lies at one position, found by all threads: numbers are sorted behind half of the hash of a position each, and only
//! those with the same half need to be compared.

use crate::counting::sorted_numbers;
use crate::grid_points::hash;
use crate::parallel;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Half of the hash of a position, above the number of what lies there.
fn keyed(at: [f64; 3], number: u32) -> u64 {
    // Adding zero makes −0 and 0 one.
    position_of(hash(at.map(|x| (x + 0.0).to_bits() as i64))) | u64::from(number)
}

/// An entry without its number.
pub(crate) fn position_of(entry: u64) -> u64 {
    entry >> 32 << 32
}

/// Entries for the numbers of n things by their positions, those of one position in the order of their numbers.
/// O(n) expected.
pub(crate) fn sorted_by_position(
    n: usize,
    number: impl Fn(u32) -> u32 + Sync + Send,
    at: impl Fn(u32) -> [f64; 3] + Sync + Send,
) -> Vec<u64> {
    let keys = parallel::map_light(n, |k| keyed(at(number(k as u32)), number(k as u32)));
    sorted_numbers(&keys, u64::BITS, |_| ())
}

/// Calls `f` with the entries of each position, in any order.
pub(crate) fn each_position(sorted: &[u64], f: impl Fn(&[u64]) + Sync + Send) {
    let (n_chunks, range) = parallel::chunks(sorted.len(), parallel::LIGHT_CHUNK);
    parallel::map(n_chunks, |chunk| {
        // A position is looked at where it begins, though it may end behind the chunk.
        let begin = |k: usize| match k.checked_sub(1) {
            Some(last) => sorted.partition_point(|&entry| position_of(entry) <= position_of(sorted[last])),
            None => 0,
        };
        let whole = begin(range(chunk).start)..begin(range(chunk).end);
        sorted[whole].chunk_by(|&a, &b| position_of(a) == position_of(b)).for_each(&f);
    });
}

/// For 0..n the number of the first one that is the same, one of those at its position. O(n) expected: each is compared with
/// the different ones of its position, and few that differ have the same half of a hash.
pub(crate) fn firsts(
    n: usize,
    at: impl Fn(u32) -> [f64; 3] + Sync + Send,
    are_same: impl Fn(u32, u32) -> bool + Sync + Send,
) -> Vec<u32> {
    let sorted = sorted_by_position(n, |i| i, at);
    let first = parallel::map_light(n, |i| AtomicU32::new(i as u32));
    each_position(&sorted, |same| {
        let mut distinct: Vec<u32> = Vec::new();
        for i in same.iter().map(|&entry| entry as u32) {
            match distinct.iter().find(|&&j| are_same(j, i)) {
                Some(&j) => first[i as usize].store(j, Relaxed),
                None => distinct.push(i),
            }
        }
    });
    first.into_iter().map(AtomicU32::into_inner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(16))]
        #[test]
        fn the_first_of_those_that_are_the_same_is_found(
            lines in prop::collection::vec(0u32..100, 1..40), n_kinds in 1u32..4, scale in prop::sample::select(vec![-0.0, 1.0]),
        ) {
            // Things of several kinds at every position; enough of them for several chunks.
            let things: Vec<(u32, u32)> =
                (0..400 * lines.len() as u32).map(|i| (lines[i as usize % lines.len()], i / 7 % n_kinds)).collect();
            let at = |i: u32| [scale * f64::from(things[i as usize].0), 0.0, scale];
            let are_same = |i: u32, j: u32| things[i as usize].1 == things[j as usize].1 && at(i) == at(j);
            let mut known: Vec<u32> = Vec::new();
            let expected = (0..things.len() as u32).map(|i| {
                let first = known.iter().copied().find(|&j| are_same(j, i));
                known.extend(first.is_none().then_some(i));
                first.unwrap_or(i)
            });
            prop_assert_eq!(firsts(things.len(), at, are_same), expected.collect::<Vec<u32>>());
        }
    }
}
