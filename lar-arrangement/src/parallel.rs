//! Work in chunks: the same results in the same order for any number of threads.

use crate::error::ArrangementError;
#[cfg(feature = "rayon")]
use std::cell::Cell;
use std::cmp::Ordering;
use std::num::NonZeroUsize;
#[cfg(feature = "rayon")]
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

#[cfg(feature = "rayon")]
thread_local! {
    /// Whether work that begins on this thread stays on it.
    static ALONE: Cell<bool> = const { Cell::new(false) };
}

/// Runs `f` with at most so many threads; one is the caller's.
#[cfg(feature = "rayon")]
pub(crate) fn with_threads<R: Send>(
    threads: Option<NonZeroUsize>,
    f: impl FnOnce() -> R + Send,
) -> Result<R, ArrangementError> {
    let Some(threads) = threads else { return Ok(f()) };
    if threads.get() == 1 {
        let before = ALONE.replace(true);
        // A panic must not leave the caller's thread alone.
        let done = catch_unwind(AssertUnwindSafe(f));
        ALONE.set(before);
        return done.map_err(|panic| resume_unwind(panic));
    }
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
    if ALONE.get() { 1 } else { rayon::current_num_threads() }
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
    if n < 2 || n_threads() == 1 { (0..n).map(f).collect() } else { (0..n).into_par_iter().map(f).collect() }
}

/// Applies `f` to 0..n and collects the results in order.
#[cfg(not(feature = "rayon"))]
pub(crate) fn map<R>(n: usize, f: impl Fn(usize) -> R) -> Vec<R> {
    (0..n).map(f).collect()
}

/// As `map`, for work that takes less time than giving it to a thread.
pub(crate) fn map_light<R: Send>(n: usize, f: impl Fn(usize) -> R + Sync + Send) -> Vec<R> {
    const WORTH_A_THREAD: usize = 2048;
    if n < WORTH_A_THREAD { (0..n).map(f).collect() } else { map(n, f) }
}

/// Runs both, and returns both results.
#[cfg(feature = "rayon")]
pub(crate) fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    if n_threads() == 1 { (a(), b()) } else { rayon::join(a, b) }
}

/// Runs both, and returns both results.
#[cfg(not(feature = "rayon"))]
pub(crate) fn join<A, B>(a: impl FnOnce() -> A, b: impl FnOnce() -> B) -> (A, B) {
    (a(), b())
}

/// Applies `f` to all items.
#[cfg(feature = "rayon")]
pub(crate) fn each<T: Send>(items: Vec<T>, f: impl Fn(T) + Sync + Send) {
    use rayon::prelude::*;
    if n_threads() == 1 { items.into_iter().for_each(f) } else { items.into_par_iter().for_each(f) }
}

/// Applies `f` to all items.
#[cfg(not(feature = "rayon"))]
pub(crate) fn each<T>(items: Vec<T>, f: impl Fn(T)) {
    items.into_iter().for_each(f);
}

/// Sorts distinct items.
#[cfg(feature = "rayon")]
pub(crate) fn sort_distinct_by<T: Send>(items: &mut [T], cmp: impl Fn(&T, &T) -> Ordering + Sync) {
    use rayon::prelude::*;
    if n_threads() == 1 { items.sort_unstable_by(cmp) } else { items.par_sort_unstable_by(cmp) }
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

/// Sorts distinct items by stretches, of which each holds nothing that belongs to one after it.
pub(crate) fn sort_stretches<T: Send>(
    items: &mut [T],
    offsets: &[u32],
    cmp: impl Fn(&T, &T) -> Ordering + Sync + Send,
) {
    const MANY: usize = 4096;
    each_stretch(items, offsets, |stretch| match stretch.len() {
        0..2 => {}
        2..MANY => stretch.sort_unstable_by(&cmp),
        _ => sort_distinct_by(stretch, &cmp),
    });
}

/// Cuts a slice into parts of some lengths, which add up to no more than its own.
pub(crate) fn cut<T>(items: &mut [T], lengths: impl Iterator<Item = usize>) -> Vec<&mut [T]> {
    let mut rest = items;
    let mut part = |length| {
        let (part, after) = std::mem::take(&mut rest).split_at_mut(length);
        rest = after;
        part
    };
    lengths.map(&mut part).collect()
}

/// The ranges of at most `size` that make up 0..n.
pub(crate) fn chunks(n: usize, size: usize) -> (usize, impl Fn(usize) -> std::ops::Range<usize>) {
    (n.div_ceil(size), move |i| i * size..((i + 1) * size).min(n))
}
