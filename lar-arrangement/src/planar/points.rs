//! Planar stage 1a: equal grid points are one.

use crate::counting::{offsets, sorted_by_place};
use crate::parallel;
use rustc_hash::FxBuildHasher;
use std::hash::BuildHasher;

/// The distinct points in first-seen order, and the number of each among them. O(n), in place.
pub(crate) fn unify(mut points: Vec<[i64; 2]>) -> (Vec<[i64; 2]>, Vec<u32>) {
    let first = first_equal(&points);
    let (n_chunks, range) = parallel::chunks(points.len(), CHUNK);
    let counts = parallel::map(n_chunks, |i| range(i).filter(|&i| first[i] == i as u32).count() as u32);
    let begins = offsets(counts.into_iter());
    if begins[n_chunks] as usize == points.len() {
        return (points, first);
    }
    let mut number = vec![0; points.len()];
    let chunks = parallel::cut(&mut number, (0..n_chunks).map(|i| range(i).len()));
    parallel::each(chunks.into_iter().enumerate().collect(), |(i, chunk)| {
        let firsts = chunk.iter_mut().zip(range(i)).filter(|(_, i)| first[*i] == *i as u32);
        firsts.zip(begins[i]..).for_each(|((to, _), number)| *to = number);
    });
    let mut place = 0..;
    points.retain(|_| place.next().is_some_and(|i| first[i] == i as u32));
    points.shrink_to_fit();
    let number = parallel::map_light(first.len(), |i| number[first[i] as usize]);
    (points, number)
}

/// A part's table of this many points stays in a processor's cache.
const PART: usize = 1 << 16;

/// So many points are divided into parts at a time.
const CHUNK: usize = 1 << 15;

/// For each point the first one that equals it. Equal points have equal hashes, so parts by hash are independent.
fn first_equal(points: &[[i64; 2]]) -> Vec<u32> {
    let n_parts = (points.len() / PART).next_power_of_two();
    if n_parts == 1 {
        return first_of_part(points, &[&Vec::from_iter(0..points.len() as u32)]).concat();
    }
    let (n_chunks, range) = parallel::chunks(points.len(), CHUNK);
    let chunks = parallel::map(n_chunks, |chunk| {
        let all: Vec<u32> = range(chunk).map(|i| i as u32).collect();
        sorted_by_place(n_parts, &all, |&i| hash(points[i as usize]) % n_parts)
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
    let outs = parallel::cut(&mut out, (0..n_chunks).map(|i| range(i).len()));
    parallel::each(outs.into_iter().enumerate().collect(), |(chunk, out)| {
        for (part, firsts) in firsts.iter().enumerate() {
            for (&i, &first) in of_part(chunk, part).iter().zip(&firsts[chunk]) {
                out[i as usize - range(chunk).start] = first;
            }
        }
    });
    out
}

fn hash(point: [i64; 2]) -> usize {
    (FxBuildHasher.hash_one(point) >> 20) as usize
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
