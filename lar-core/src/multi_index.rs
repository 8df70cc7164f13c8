//! Multi-indices: row-major addresses, and the axis masks that name the directions of grid cells.

/// The address of the entry `at` in a row-major array of `counts[0] × … × counts[d − 1]` entries, the last
/// index fastest; `None` when `at` lies outside or the array has more entries than `usize` can number. O(d).
///
/// ```
/// use lar_core::row_major_index;
/// assert_eq!(row_major_index(&[2, 3, 4], &[1, 2, 3]), Some(23));
/// assert_eq!(row_major_index(&[2, 3, 4], &[1, 3, 0]), None);
/// ```
#[doc(alias = "index2addr")]
#[must_use]
pub fn row_major_index(counts: &[usize], at: &[usize]) -> Option<usize> {
    let inside = counts.len() == at.len() && at.iter().zip(counts).all(|(x, n)| x < n);
    let step = |address: usize, (&x, &n): (&usize, &usize)| address.checked_mul(n)?.checked_add(x);
    if inside { at.iter().zip(counts).try_fold(0, step) } else { None }
}

/// The masks of `n` bits of which `k` are set, in rising order: C(n, k) of them. Bit n − 1 stands for the
/// first of n axes, bit 0 for the last. O(1) per mask.
///
/// # Panics
/// When `n` is above 63.
///
/// ```
/// let masks: Vec<u64> = lar_core::masks_of_order(3, 2).collect();
/// assert_eq!(masks, [0b011, 0b101, 0b110]);
/// ```
#[doc(alias = "filterByOrder")]
#[doc(alias = "binaryRange")]
pub fn masks_of_order(n: usize, k: usize) -> impl Iterator<Item = u64> {
    assert!(n <= 63, "masks of {n} bits do not fit 64");
    let first = (k <= n).then(|| (1_u64 << k) - 1);
    std::iter::successors(first, |&mask| next_of_same_order(mask)).take_while(move |&mask| mask < 1 << n)
}

/// The next larger number with as many bits set: the lowest run of ones gives its top bit to the place above
/// it and drops the others to the bottom. `None` after 0.
fn next_of_same_order(mask: u64) -> Option<u64> {
    let lowest = mask & mask.wrapping_neg();
    let carried = mask.checked_add(lowest).filter(|_| mask != 0)?;
    Some(carried | (((mask ^ carried) >> 2) / lowest))
}

/// Calls `visit` with each index of an array of shape `counts`, the last axis fastest; once with the empty
/// index when there are no axes.
pub(crate) fn for_each_row_major(counts: &[usize], mut visit: impl FnMut(&[usize])) {
    if counts.contains(&0) {
        return;
    }
    let mut at = vec![0; counts.len()];
    loop {
        visit(&at);
        let Some(axis) = (0..counts.len()).rev().find(|&k| at[k] + 1 < counts[k]) else { return };
        at[axis] += 1;
        at[axis + 1..].fill(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(n: usize, expected: &[usize]) {
        let groups: Vec<Vec<u64>> = (0..=n + 1).map(|k| masks_of_order(n, k).collect()).collect();
        let sizes: Vec<usize> = groups.iter().map(Vec::len).collect();
        assert_eq!(sizes, [expected, &[0]].concat());
        let mut all = groups.concat();
        all.sort_unstable();
        assert_eq!(all, (0..1 << n).collect::<Vec<u64>>());
        for (k, group) in (0..).zip(&groups) {
            assert!(group.is_sorted() && group.iter().all(|mask| mask.count_ones() == k));
        }
    }

    #[test]
    fn orders_are_binomial() {
        check(0, &[1]);
        check(1, &[1, 1]);
        check(2, &[1, 2, 1]);
        check(4, &[1, 4, 6, 4, 1]);
        check(7, &[1, 7, 21, 35, 35, 21, 7, 1]);
        assert_eq!(masks_of_order(63, 63).count(), 1);
        assert_eq!(masks_of_order(63, 1).count(), 63);
    }

    #[test]
    fn addresses_count_up() {
        let counts = [3, 1, 2, 4];
        let mut expected = 0;
        for_each_row_major(&counts, |at| {
            assert_eq!(row_major_index(&counts, at), Some(expected));
            expected += 1;
        });
        assert_eq!(expected, 24);
        assert_eq!(row_major_index(&[], &[]), Some(0));
        assert_eq!(row_major_index(&[2], &[0, 0]), None);
        assert_eq!(row_major_index(&[usize::MAX, 3], &[usize::MAX - 1, 0]), None);
        for_each_row_major(&[2, 0], |_| panic!("an empty array has no entries"));
    }
}
