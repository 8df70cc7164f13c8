//! Some of the numbers below another one.

use crate::counting::offsets;
use crate::parallel;

/// A bit each, which stay in a processor's cache: whether a number is marked, and which of the marked ones it is, are told in
/// O(1).
#[derive(Debug, Default)]
pub(crate) struct Marks {
    pub bits: Vec<u64>,
    /// How many there are before each word of bits.
    pub before: Vec<u32>,
    pub n: usize,
}

impl Marks {
    /// O(n), by all threads.
    pub(crate) fn new(n: usize, is_marked: impl Fn(usize) -> bool + Sync + Send) -> Self {
        let word = |w: usize| {
            (64 * w..n.min(64 * w + 64)).fold(0, |bits, i| bits | u64::from(is_marked(i)) << (i % 64))
        };
        Self::of_bits(parallel::map_light(n.div_ceil(64), word))
    }

    /// Some of the numbers below n.
    pub(crate) fn among(n: usize, marked: &[u32]) -> Self {
        let mut bits = vec![0; n.div_ceil(64)];
        marked.iter().for_each(|i| bits[*i as usize / 64] |= 1 << (i % 64));
        Self::of_bits(bits)
    }

    fn of_bits(bits: Vec<u64>) -> Self {
        let mut before = offsets(bits.iter().map(|bits| bits.count_ones()));
        let n = before.pop().map_or(0, |n| n as usize);
        Self { bits, before, n }
    }

    /// Which of the marked numbers i is, or the last one before it: there is one.
    pub(crate) fn number(&self, i: u32) -> u32 {
        let (word, up_to_it) = (i as usize / 64, u64::MAX >> (63 - i % 64));
        self.before[word] + (self.bits[word] & up_to_it).count_ones() - 1
    }

    /// Which of the marked numbers i is, if it is one.
    pub(crate) fn place(&self, i: u32) -> Option<usize> {
        (self.bits[i as usize / 64] >> (i % 64) & 1 == 1).then(|| self.number(i) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marked_numbers_have_places() {
        for n in [1, 63, 64, 65, 200] {
            let is_marked = |i: usize| i.is_multiple_of(3) || i == 64;
            let marked: Vec<u32> = (0..n as u32).filter(|&i| is_marked(i as usize)).collect();
            for marks in [Marks::new(n, is_marked), Marks::among(n, &marked)] {
                assert_eq!(marks.n, marked.len());
                for i in 0..n as u32 {
                    assert_eq!(marks.place(i), marked.iter().position(|&marked| marked == i));
                    assert_eq!(marks.number(i) as usize + 1, marked.partition_point(|&marked| marked <= i));
                }
            }
        }
    }
}
