//! Planar stage 1a: equal grid points are one.

use crate::counting::sorted_by_place;
use crate::parallel;
use rustc_hash::FxBuildHasher;
use std::hash::BuildHasher;

/// The distinct points in first-seen order, and the number of each among them. O(n), in place.
pub(crate) fn unify(mut points: Vec<[i64; 2]>) -> (Vec<[i64; 2]>, Vec<u32>) {
    let mut number = first_equal(&points);
    let mut n = 0;
    for i in 0..points.len() {
        let first = number[i] as usize;
        number[i] = if first == i {
            points[n] = points[i];
            n += 1;
            n as u32 - 1
        } else {
            number[first]
        };
    }
    points.truncate(n);
    points.shrink_to_fit();
    (points, number)
}

/// A part's table of this many points stays in a processor's cache.
const PART: usize = 1 << 16;

/// For each point the first one that equals it. Equal points have equal hashes, so parts by hash are independent.
fn first_equal(points: &[[i64; 2]]) -> Vec<u32> {
    let n_parts = (points.len() / PART).next_power_of_two();
    if n_parts == 1 {
        return first_of_part(points, 0..points.len() as u32);
    }
    let all = Vec::from_iter(0..points.len() as u32);
    let part_of = |&i: &u32| hash(points[i as usize]) % n_parts;
    let (offsets, parts) = sorted_by_place(n_parts, &all, part_of);
    let part = |part: usize| parts[offsets[part] as usize..offsets[part + 1] as usize].iter().copied();
    let firsts = parallel::map(n_parts, |i| first_of_part(points, part(i)));
    let mut out = all;
    for (i, first) in parts.iter().zip(firsts.iter().flatten()) {
        out[*i as usize] = *first;
    }
    out
}

fn hash(point: [i64; 2]) -> usize {
    (FxBuildHasher.hash_one(point) >> 20) as usize
}

/// For each of some points the first one of them that equals it. A table with open addressing, at most half full.
fn first_of_part(points: &[[i64; 2]], part: impl ExactSizeIterator<Item = u32>) -> Vec<u32> {
    const EMPTY: u32 = u32::MAX;
    let mask = (2 * part.len()).next_power_of_two() - 1;
    let mut table = vec![EMPTY; mask + 1];
    let first = |i: u32| {
        // The lowest bits are those of the part.
        let mut slot = (hash(points[i as usize]) >> 12) & mask;
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
    part.map(first).collect()
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
            let (distinct, number) = unify(points.clone());
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
