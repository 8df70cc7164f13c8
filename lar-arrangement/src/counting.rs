//! Counting sorts: items to places that are known, in their order.

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

/// The items by place, those of one place in their order: where each place begins, and all items.
pub(crate) fn sorted_by_place<T: Copy>(
    n_places: usize,
    items: &[T],
    place: impl Fn(&T) -> usize,
) -> (Vec<u32>, Vec<T>) {
    let mut lengths = vec![0u32; n_places];
    items.iter().for_each(|item| lengths[place(item)] += 1);
    let offsets = offsets(lengths.iter().copied());
    let mut fill = lengths;
    fill.copy_from_slice(&offsets[..n_places]);
    let mut sorted = items.to_vec();
    for item in items {
        let at = &mut fill[place(item)];
        sorted[*at as usize] = *item;
        *at += 1;
    }
    (offsets, sorted)
}
