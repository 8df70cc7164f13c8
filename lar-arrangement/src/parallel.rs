//! Work in chunks: the same results in the same order for any number of threads.

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
