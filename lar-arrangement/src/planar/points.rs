//! Planar stage 1a: equal grid points are one.

use crate::parallel;
use rustc_hash::{FxBuildHasher, FxHashMap};
use std::hash::BuildHasher;

/// The distinct points in first-seen order, and the number of each among them. O(n).
pub(crate) fn unify(points: &[[i64; 2]]) -> (Vec<[i64; 2]>, Vec<u32>) {
    let mut number = first_equal(points);
    let mut distinct = Vec::new();
    for i in 0..points.len() {
        let first = number[i] as usize;
        number[i] = if first == i {
            distinct.push(points[i]);
            distinct.len() as u32 - 1
        } else {
            number[first]
        };
    }
    (distinct, number)
}

/// A part's table of this many points stays in a processor's cache.
const PART: usize = 1 << 14;

/// For each point the first one that equals it. Equal points have equal hashes, so parts by hash are independent.
fn first_equal(points: &[[i64; 2]]) -> Vec<u32> {
    let n_parts = (points.len() / PART).next_power_of_two();
    let part_of = |p: &[i64; 2]| (FxBuildHasher.hash_one(p) >> 24) as usize & (n_parts - 1);
    let mut parts: Vec<Vec<u32>> = vec![Vec::with_capacity(points.len() / n_parts); n_parts];
    for (p, i) in points.iter().zip(0..) {
        parts[part_of(p)].push(i);
    }
    let firsts = parallel::map(n_parts, |part| {
        let mut first: FxHashMap<[i64; 2], u32> = FxHashMap::default();
        first.reserve(parts[part].len());
        parts[part].iter().map(|&i| *first.entry(points[i as usize]).or_insert(i)).collect::<Vec<_>>()
    });
    let mut out = vec![0; points.len()];
    for (part, firsts) in parts.iter().zip(firsts) {
        part.iter().zip(firsts).for_each(|(&i, first)| out[i as usize] = first);
    }
    out
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
            let (distinct, number) = unify(&points);
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
