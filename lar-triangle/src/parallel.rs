//! Work in parts: the same results in the same order for any number of threads.

use std::ops::Range;

/// So few things are not worth another thread.
#[cfg(feature = "rayon")]
const WORTH_THREADS: usize = 1 << 10;

/// At most so many parts of each thread: where there are fewer, one waits long for another's last.
#[cfg(feature = "rayon")]
const PARTS: usize = 16;

/// Applies `f` to the parts of 0..n, and returns what it makes of them in order, or the first error.
#[cfg(feature = "rayon")]
pub(crate) fn map_parts<R: Send, E: Send>(
    n: usize,
    f: impl Fn(Range<usize>) -> Result<R, E> + Sync + Send,
) -> Result<Vec<R>, E> {
    use rayon::prelude::*;
    let n_threads = rayon::current_num_threads();
    if n < WORTH_THREADS || n_threads == 1 {
        return f(0..n).map(|all| vec![all]);
    }
    let size = n.div_ceil(PARTS * n_threads);
    let part = |i: usize| f(i * size..((i + 1) * size).min(n));
    let parts: Vec<Result<R, E>> = (0..n.div_ceil(size)).into_par_iter().with_max_len(1).map(part).collect();
    parts.into_iter().collect()
}

/// Applies `f` to all of 0..n.
#[cfg(not(feature = "rayon"))]
pub(crate) fn map_parts<R, E>(n: usize, f: impl Fn(Range<usize>) -> Result<R, E>) -> Result<Vec<R>, E> {
    f(0..n).map(|all| vec![all])
}
