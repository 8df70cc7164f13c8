//! Work in chunks: the same results in the same order for any number of threads.

use crate::error::ArrangementError;
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

/// The ranges of at most `size` that make up 0..n.
pub(crate) fn chunks(n: usize, size: usize) -> (usize, impl Fn(usize) -> std::ops::Range<usize>) {
    (n.div_ceil(size), move |i| i * size..((i + 1) * size).min(n))
}
