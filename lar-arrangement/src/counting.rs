//! Counting sorts: items to places that are known, in their order.

use crate::parallel;

/// Where each of some stretches begins when they have these lengths and lie one after the other, and where the last
/// one ends. Lengths add up to less than 2^32.
pub(crate) fn offsets(lengths: impl ExactSizeIterator<Item = u32>) -> Vec<u32> {
    let mut out = Vec::with_capacity(lengths.len() + 1);
    let mut end = 0;
    out.push(0);
    out.extend(lengths.map(|length| {
        end += length;
        end
    }));
    out
}

/// As `offsets`, for n lengths that are looked up by all threads.
pub(crate) fn offsets_of(n: usize, length: impl Fn(usize) -> u32 + Sync + Send) -> Vec<u32> {
    if parallel::n_threads() == 1 {
        return offsets((0..n).map(length));
    }
    let (n_chunks, range) = parallel::chunks(n, parallel::LIGHT_CHUNK);
    let begins = offsets(parallel::map(n_chunks, |i| range(i).map(&length).sum()).into_iter());
    let mut out = parallel::zeros(n + 1);
    let parts = parallel::cut(&mut out[1..], (0..n_chunks).map(|i| range(i).len()));
    parallel::each(parts.into_iter().zip(begins).enumerate().collect(), |(i, (part, begin))| {
        part.iter_mut().zip(range(i)).fold(begin, |end, (to, item)| {
            *to = end + length(item);
            *to
        });
    });
    out
}

/// The items by place, those of one place in their order: where each place begins, and all items.
pub(crate) fn sorted_by_place<T: Copy>(
    n_places: usize,
    items: &[T],
    place: impl Fn(&T) -> usize,
) -> (Vec<u32>, Vec<T>) {
    let mut sorted = items.to_vec();
    let offsets = sort_by_place(n_places, items, place, &mut sorted);
    (offsets, sorted)
}

/// Puts the items by place, those of one place in their order; returns where each place begins.
fn sort_by_place<T: Copy>(
    n_places: usize,
    items: &[T],
    place: impl Fn(&T) -> usize,
    sorted: &mut [T],
) -> Vec<u32> {
    let mut lengths = vec![0u32; n_places];
    items.iter().for_each(|item| lengths[place(item)] += 1);
    let offsets = offsets(lengths.iter().copied());
    let mut fill = lengths;
    fill.copy_from_slice(&offsets[..n_places]);
    for item in items {
        let at = &mut fill[place(item)];
        sorted[*at as usize] = *item;
        *at += 1;
    }
    offsets
}

/// So many numbers are sorted by their highest bits at a time.
const CHUNK: usize = 1 << 15;
/// Fewer are sorted by one thread. More have at least one highest bit to be divided by. Not tuned.
const WORTH_THREADS: usize = 1 << 13;

/// Sorts distinct numbers of so many bits. Chunks are sorted by the highest bits, then what has these in common is brought
/// together and sorted further: O(n) when numbers are spread evenly, and all of it in caches. Such a part of the result
/// is given to `settle`, which may change the order of numbers that differ only in lower bits.
pub(crate) fn sorted_numbers(
    numbers: &[u64],
    bits: u32,
    settle: impl Fn(&mut [u64]) + Sync + Send,
) -> Vec<u64> {
    let mut sorted = vec![0; numbers.len()];
    let chunk = CHUNK.min(numbers.len().div_ceil(parallel::n_threads())).max(WORTH_THREADS);
    if numbers.len() <= chunk {
        sort_below(numbers, bits, &mut sorted);
        settle(&mut sorted);
        return sorted;
    }
    let upper = (numbers.len() >> 12).ilog2().min(8);
    let (n_chunks, range) = parallel::chunks(numbers.len(), chunk);
    let chunks = parallel::map(n_chunks, |chunk| {
        sorted_by_place(1 << upper, &numbers[range(chunk)], |x| (x >> (bits - upper)) as usize)
    });
    let of_place = |place: usize| {
        let in_chunks = chunks
            .iter()
            .map(|(offsets, numbers)| &numbers[offsets[place] as usize..offsets[place + 1] as usize]);
        in_chunks.collect::<Vec<&[u64]>>()
    };
    let lengths = (0..1 << upper).map(|place| of_place(place).iter().map(|numbers| numbers.len()).sum());
    let parts = parallel::cut(&mut sorted, lengths);
    parallel::each(parts.into_iter().enumerate().collect(), |(place, part)| {
        sort_below(&of_place(place).concat(), bits - upper, part);
        settle(part);
    });
    sorted
}

/// Sorts numbers that have all but so many bits in common: first by as many places as hold a few each, then again what
/// is crowded in one place. Each time some bits fewer are left.
fn sort_below(numbers: &[u64], bits: u32, sorted: &mut [u64]) {
    const CROWD: usize = 64;
    let upper = (numbers.len() / 4).max(2).ilog2().min(16).min(bits);
    let mask = (1 << upper) - 1;
    let place = |x: &u64| (x >> (bits - upper)) as usize & mask;
    let offsets = sort_by_place(1 << upper, numbers, place, sorted);
    parallel::each_stretch(sorted, &offsets, |stretch| match stretch.len() {
        0..2 => {}
        2..CROWD => stretch.sort_unstable(),
        _ if stretch.is_sorted() => {}
        _ => {
            let crowd = stretch.to_vec();
            sort_below(&crowd, bits - upper, stretch);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::num::NonZeroUsize;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(16))]
        #[test]
        fn numbers_are_sorted(upper in prop::collection::vec(0u64..1 << 20, 0..50), shift in 0u32..24) {
            let n = 1000 * upper.len();
            let numbers: Vec<u64> = (0..n).rev().map(|i| upper[i / 1000] << shift << 20 | i as u64).collect();
            let mut expected = numbers.clone();
            expected.sort_unstable();
            for threads in 1..=3 {
                let team = parallel::Team::new(NonZeroUsize::new(threads));
                let sorted = team.work(usize::MAX, || sorted_numbers(&numbers, 64, |_| ()));
                prop_assert_eq!(sorted.expect("there are threads"), expected.as_slice());
            }
        }
    }
}
