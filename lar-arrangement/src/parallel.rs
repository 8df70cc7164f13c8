//! Work in chunks: the same results in the same order for any number of threads.

use crate::error::ArrangementError;
use std::cmp::Ordering;
use std::num::NonZeroUsize;

/// Runs `f` with at most so many threads.
#[cfg(feature = "rayon")]
pub(crate) fn with_threads<R: Send>(
    threads: Option<NonZeroUsize>,
    f: impl FnOnce() -> R + Send,
) -> Result<R, ArrangementError> {
    let Some(threads) = threads else { return Ok(f()) };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.get())
        .build()
        .map_err(|e| ArrangementError::Threads { threads: threads.get(), reason: e.to_string() })?;
    Ok(pool.install(f))
}

/// Runs `f`; there is one thread.
#[cfg(not(feature = "rayon"))]
pub(crate) fn with_threads<R>(_: Option<NonZeroUsize>, f: impl FnOnce() -> R) -> Result<R, ArrangementError> {
    Ok(f())
}

/// Number of threads at work. What depends on it must not show in any result.
#[cfg(feature = "rayon")]
pub(crate) fn n_threads() -> usize {
    rayon::current_num_threads()
}

/// There is one.
#[cfg(not(feature = "rayon"))]
pub(crate) fn n_threads() -> usize {
    1
}

/// Applies `f` to 0..n and collects the results in order.
#[cfg(feature = "rayon")]
pub(crate) fn map<R: Send>(n: usize, f: impl Fn(usize) -> R + Sync + Send) -> Vec<R> {
    use rayon::prelude::*;
    if n < 2 { (0..n).map(f).collect() } else { (0..n).into_par_iter().map(f).collect() }
}

/// Applies `f` to 0..n and collects the results in order.
#[cfg(not(feature = "rayon"))]
pub(crate) fn map<R>(n: usize, f: impl Fn(usize) -> R) -> Vec<R> {
    (0..n).map(f).collect()
}

/// Runs both, and returns both results.
#[cfg(feature = "rayon")]
pub(crate) fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    rayon::join(a, b)
}

/// Runs both, and returns both results.
#[cfg(not(feature = "rayon"))]
pub(crate) fn join<A, B>(a: impl FnOnce() -> A, b: impl FnOnce() -> B) -> (A, B) {
    (a(), b())
}

/// Sorts distinct items.
#[cfg(feature = "rayon")]
pub(crate) fn sort_distinct_by<T: Send>(items: &mut [T], cmp: impl Fn(&T, &T) -> Ordering + Sync) {
    use rayon::prelude::*;
    // On one thread the standard library's algorithm is the faster one.
    match rayon::current_num_threads() {
        1 => items.sort_unstable_by(cmp),
        _ => items.par_sort_unstable_by(cmp),
    }
}

/// Sorts distinct items.
#[cfg(not(feature = "rayon"))]
pub(crate) fn sort_distinct_by<T>(items: &mut [T], cmp: impl Fn(&T, &T) -> Ordering) {
    items.sort_unstable_by(cmp);
}

/// Applies `f` to the stretches of `items` between neighbouring offsets, which rise from 0 to their number.
pub(crate) fn each_stretch<T: Send>(items: &mut [T], offsets: &[u32], f: impl Fn(&mut [T]) + Sync + Send) {
    let stretches = |items: &mut [T], offsets: &[u32]| {
        let mut rest = items;
        for w in offsets.windows(2) {
            let (stretch, after) = rest.split_at_mut((w[1] - w[0]) as usize);
            f(stretch);
            rest = after;
        }
    };
    halve(items, offsets, &stretches);
}

fn halve<T: Send>(items: &mut [T], offsets: &[u32], f: &(impl Fn(&mut [T], &[u32]) + Sync + Send)) {
    if offsets.len() < 4096 {
        return f(items, offsets);
    }
    let middle = offsets.len() / 2;
    let (left, right) = items.split_at_mut((offsets[middle] - offsets[0]) as usize);
    join(|| halve(left, &offsets[..=middle], f), || halve(right, &offsets[middle..], f));
}

/// The ranges of at most `size` that make up 0..n.
pub(crate) fn chunks(n: usize, size: usize) -> (usize, impl Fn(usize) -> std::ops::Range<usize>) {
    (n.div_ceil(size), move |i| i * size..((i + 1) * size).min(n))
}
