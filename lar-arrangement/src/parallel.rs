//! Work in chunks: the same results in the same order for any number of threads.

use crate::error::ArrangementError;
#[cfg(feature = "rayon")]
use rayon::{ThreadPool, ThreadPoolBuilder};
#[cfg(feature = "rayon")]
use std::cell::Cell;
use std::cmp::Ordering;
use std::num::NonZeroUsize;
use std::ops::Range;
#[cfg(feature = "rayon")]
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::AtomicU32;
#[cfg(feature = "rayon")]
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

#[cfg(feature = "rayon")]
thread_local! {
    /// Whether work that begins on this thread stays on it.
    static ALONE: Cell<bool> = const { Cell::new(false) };
}

/// Threads that stay awake between the parallel sections of an operation. The system takes longer to wake a thread than
/// many a section lasts: a processor without work may be halted, and a virtual one given away.
#[cfg(feature = "rayon")]
mod attendance {
    use std::cell::Cell;
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
    use std::time::{Duration, Instant};

    /// A thread without work waits so long for more before it sleeps.
    const PATIENCE: Duration = Duration::from_millis(2);
    /// More threads than this are not kept awake: all of them would look for work in the same places.
    const MOST_AWAKE: usize = 16;

    /// Operations at work.
    static OPERATIONS: AtomicUsize = AtomicUsize::new(0);
    /// Threads that wait for work or do it, and those asked to.
    static PRESENT: AtomicUsize = AtomicUsize::new(0);

    thread_local! {
        /// Whether this thread runs an operation, or attends one already.
        static IS_TAKEN: Cell<bool> = const { Cell::new(false) };
    }

    /// While it lives, this thread runs an operation.
    pub(super) struct Lead {
        was_taken: bool,
    }

    impl Lead {
        pub(super) fn new() -> Self {
            OPERATIONS.fetch_add(1, Relaxed);
            Self { was_taken: IS_TAKEN.replace(true) }
        }
    }

    impl Drop for Lead {
        fn drop(&mut self) {
            OPERATIONS.fetch_sub(1, Relaxed);
            IS_TAKEN.set(self.was_taken);
        }
    }

    /// Asks those of n threads to be there that are not. A thread that is not there itself asks nobody: it might be the one
    /// to follow, while it waits in the midst of its work.
    pub(super) fn call(n: usize) {
        if IS_TAKEN.get() {
            while PRESENT.load(Relaxed) + 1 < n.min(MOST_AWAKE) {
                PRESENT.fetch_add(1, Relaxed);
                rayon::spawn(attend);
            }
        }
    }

    /// Works on what there is until there has been nothing for long.
    fn attend() {
        if !IS_TAKEN.replace(true) {
            let mut idle = Instant::now();
            while OPERATIONS.load(Relaxed) > 0 && idle.elapsed() < PATIENCE {
                if rayon::yield_now() == Some(rayon::Yield::Executed) {
                    idle = Instant::now();
                } else {
                    std::thread::yield_now();
                }
            }
            IS_TAKEN.set(false);
        }
        PRESENT.fetch_sub(1, Relaxed);
    }
}

/// At most so many threads for an operation of several steps. They are started for the first step that is worth it.
pub(crate) struct Team {
    #[cfg(feature = "rayon")]
    threads: Option<NonZeroUsize>,
    #[cfg(feature = "rayon")]
    pool: OnceLock<Arc<ThreadPool>>,
}

/// The threads of the last operation that was given a number of them, for the next one: the system takes milliseconds to
/// spread new threads over the processors, and memory that they have freed stays theirs.
#[cfg(feature = "rayon")]
static KEPT: Mutex<Option<Arc<ThreadPool>>> = Mutex::new(None);

/// A step that handles fewer things (segments, pairs, edges) than this takes no longer on one thread.
const WORTH_THREADS: usize = 1 << 15;

impl Team {
    #[cfg(feature = "rayon")]
    pub(crate) fn new(threads: Option<NonZeroUsize>) -> Self {
        Self { threads: threads.map(|n| n.min(most_threads())), pool: OnceLock::new() }
    }

    /// There is one.
    #[cfg(not(feature = "rayon"))]
    pub(crate) fn new(_: Option<NonZeroUsize>) -> Self {
        Self {}
    }

    /// Runs a step that handles so many things: alone on the caller's thread when they are few.
    #[cfg(feature = "rayon")]
    pub(crate) fn work<R: Send>(
        &self,
        size: usize,
        f: impl FnOnce() -> R + Send,
    ) -> Result<R, ArrangementError> {
        if size < WORTH_THREADS || self.threads == Some(NonZeroUsize::MIN) {
            return Ok(alone(f));
        }
        let led = || {
            let _lead = attendance::Lead::new();
            on_thread(false, f)
        };
        match self.threads {
            // On one of the threads from here on: each section that came from elsewhere would wake one, and be waited for.
            None => Ok(rayon::scope(|_| led())),
            Some(threads) => Ok(self.pool(threads.get())?.install(led)),
        }
    }

    /// Runs a step; there is one thread.
    #[cfg(not(feature = "rayon"))]
    pub(crate) fn work<R>(&self, _: usize, f: impl FnOnce() -> R) -> Result<R, ArrangementError> {
        Ok(f())
    }

    #[cfg(feature = "rayon")]
    fn pool(&self, threads: usize) -> Result<&ThreadPool, ArrangementError> {
        if let Some(pool) = self.pool.get() {
            return Ok(pool);
        }
        let pool = kept_pool(threads)?;
        Ok(self.pool.get_or_init(|| pool))
    }
}

/// More threads are not started, whatever the limit is: they would take turns on the processors, and each takes memory.
#[cfg(feature = "rayon")]
fn most_threads() -> NonZeroUsize {
    const MANY: NonZeroUsize = NonZeroUsize::new(64).expect("not zero");
    std::thread::available_parallelism().unwrap_or(MANY).max(MANY)
}

/// So many threads: those that were kept, or new ones in their place.
#[cfg(feature = "rayon")]
fn kept_pool(threads: usize) -> Result<Arc<ThreadPool>, ArrangementError> {
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(pool) = kept.as_ref().filter(|pool| pool.current_num_threads() == threads) {
        return Ok(Arc::clone(pool));
    }
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|e| ArrangementError::Threads { threads, reason: e.to_string() })?;
    Ok(Arc::clone(kept.insert(Arc::new(pool))))
}

/// Runs `f` on the caller's thread.
#[cfg(feature = "rayon")]
fn alone<R>(f: impl FnOnce() -> R) -> R {
    on_thread(true, f)
}

/// Runs `f` on this thread, alone or not.
#[cfg(feature = "rayon")]
fn on_thread<R>(is_alone: bool, f: impl FnOnce() -> R) -> R {
    let before = ALONE.replace(is_alone);
    // A panic must not leave the thread as it is now.
    let done = catch_unwind(AssertUnwindSafe(f));
    ALONE.set(before);
    done.unwrap_or_else(|panic| resume_unwind(panic))
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

/// At most so many pieces of work are worth giving to threads one by one. Left to itself rayon makes fewer, and one
/// thread waits long for the other's last.
const PIECES: usize = 512;

/// Applies `f` to 0..n, up to `piece` at a time, and collects the results in order.
#[cfg(feature = "rayon")]
fn map_pieces<R: Send>(n: usize, piece: usize, f: impl Fn(usize) -> R + Sync + Send) -> Vec<R> {
    use rayon::prelude::*;
    if n <= piece || n_threads() == 1 {
        return (0..n).map(f).collect();
    }
    attendance::call(n_threads());
    (0..n).into_par_iter().with_max_len(piece).map(f).collect()
}

/// Applies `f` to 0..n and collects the results in order.
#[cfg(not(feature = "rayon"))]
fn map_pieces<R>(n: usize, _: usize, f: impl Fn(usize) -> R) -> Vec<R> {
    (0..n).map(f).collect()
}

/// Applies `f` to 0..n and collects the results in order.
pub(crate) fn map<R: Send>(n: usize, f: impl Fn(usize) -> R + Sync + Send) -> Vec<R> {
    map_pieces(n, n.div_ceil(PIECES).max(1), f)
}

/// So many small items are worth another thread.
const WORTH_A_THREAD: usize = 1024;

/// So many are a chunk of light work: where there are fewer chunks one thread waits long for the other's last.
pub(crate) const LIGHT_CHUNK: usize = 1 << 12;

/// How many of n items of light work are a piece.
fn light_piece(n: usize) -> usize {
    n.div_ceil(PIECES).max(WORTH_A_THREAD)
}

/// As `map`, for work that takes less time than giving it to a thread.
pub(crate) fn map_light<R: Send>(n: usize, f: impl Fn(usize) -> R + Sync + Send) -> Vec<R> {
    map_pieces(n, light_piece(n), f)
}

/// As `map_light`, for the items of lists: `f(l, i)` for the i-th of list l, which begins at `begins[l]` among all; the
/// number of all comes last.
pub(crate) fn map_lists<R: Send>(begins: &[u32], f: impl Fn(usize, usize) -> R + Sync + Send) -> Vec<R> {
    let mut all = Vec::with_capacity(begins.last().map_or(0, |&n| n as usize));
    for (l, range) in begins.windows(2).enumerate() {
        extend_light(&mut all, (range[1] - range[0]) as usize, |i| f(l, i));
    }
    all
}

/// As `map_light`, the results behind what a list has already.
#[cfg(feature = "rayon")]
pub(crate) fn extend_light<R: Send>(list: &mut Vec<R>, n: usize, f: impl Fn(usize) -> R + Sync + Send) {
    use rayon::prelude::*;
    if n <= light_piece(n) || n_threads() == 1 {
        list.extend((0..n).map(f));
    } else {
        attendance::call(n_threads());
        list.par_extend((0..n).into_par_iter().with_max_len(light_piece(n)).map(f));
    }
}

/// As `map_light`, the results behind what a list has already.
#[cfg(not(feature = "rayon"))]
pub(crate) fn extend_light<R>(list: &mut Vec<R>, n: usize, f: impl Fn(usize) -> R) {
    list.extend((0..n).map(f));
}

/// As `map_light`, for two results.
#[cfg(feature = "rayon")]
pub(crate) fn unzip_light<A: Send, B: Send>(
    n: usize,
    f: impl Fn(usize) -> (A, B) + Sync + Send,
) -> (Vec<A>, Vec<B>) {
    use rayon::prelude::*;
    if n <= light_piece(n) || n_threads() == 1 {
        return (0..n).map(f).unzip();
    }
    attendance::call(n_threads());
    let (mut a, mut b) = (Vec::new(), Vec::new());
    (0..n).into_par_iter().with_max_len(light_piece(n)).map(f).unzip_into_vecs(&mut a, &mut b);
    (a, b)
}

/// As `map_light`, for two results.
#[cfg(not(feature = "rayon"))]
pub(crate) fn unzip_light<A, B>(n: usize, f: impl Fn(usize) -> (A, B)) -> (Vec<A>, Vec<B>) {
    (0..n).map(f).unzip()
}

/// Runs both, and returns both results.
#[cfg(feature = "rayon")]
pub(crate) fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    if n_threads() == 1 {
        return (a(), b());
    }
    attendance::call(n_threads());
    rayon::join(a, b)
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
    if n_threads() == 1 {
        return items.into_iter().for_each(f);
    }
    attendance::call(n_threads());
    let piece = items.len().div_ceil(PIECES).max(1);
    items.into_par_iter().with_max_len(piece).for_each(f);
}

/// Applies `f` to all items.
#[cfg(not(feature = "rayon"))]
pub(crate) fn each<T>(items: Vec<T>, f: impl Fn(T)) {
    items.into_iter().for_each(f);
}

/// Applies `f` to all items and their places, and collects the results in order.
#[cfg(feature = "rayon")]
pub(crate) fn map_each<T: Send, R: Send>(items: Vec<T>, f: impl Fn(usize, T) -> R + Sync + Send) -> Vec<R> {
    use rayon::prelude::*;
    if n_threads() == 1 {
        return items.into_iter().enumerate().map(|(i, item)| f(i, item)).collect();
    }
    attendance::call(n_threads());
    items.into_par_iter().enumerate().with_max_len(1).map(|(i, item)| f(i, item)).collect()
}

/// Applies `f` to all items and their places, and collects the results in order.
#[cfg(not(feature = "rayon"))]
pub(crate) fn map_each<T, R>(items: Vec<T>, f: impl Fn(usize, T) -> R) -> Vec<R> {
    items.into_iter().enumerate().map(|(i, item)| f(i, item)).collect()
}

/// Sorts distinct items.
#[cfg(feature = "rayon")]
pub(crate) fn sort_distinct_by<T: Send>(items: &mut [T], cmp: impl Fn(&T, &T) -> Ordering + Sync) {
    use rayon::prelude::*;
    if n_threads() == 1 {
        return items.sort_unstable_by(cmp);
    }
    attendance::call(n_threads());
    items.par_sort_unstable_by(cmp);
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

/// Zeros, whose memory is touched for the first time by all threads: before one of them fills it, or where the allocator
/// would have one of them overwrite what was in use before.
pub(crate) fn zeros<T: Copy + Default + Send>(n: usize) -> Vec<T> {
    if n_threads() == 1 { vec![T::default(); n] } else { map_light(n, |_| T::default()) }
}

/// Zeros for all threads to write to; like those of `vec!`, in memory that is touched where it is first written to.
pub(crate) fn atomic_zeros(n: usize) -> Vec<AtomicU32> {
    if n_threads() == 1 {
        // Costs nothing: a number and an atomic one are the same in memory.
        return vec![0; n].into_iter().map(AtomicU32::new).collect();
    }
    map_light(n, |_| AtomicU32::new(0))
}

/// Calls `f` with 0..n in any order.
pub(crate) fn for_each(n: usize, f: impl Fn(usize) + Sync + Send) {
    // A list of nothing takes no memory.
    map_pieces(n, light_piece(n), f);
}

/// Applies `f` to chunks of some items, each with the place that it begins at.
pub(crate) fn each_chunk<T: Send>(items: &mut [T], f: impl Fn(usize, &mut [T]) + Sync + Send) {
    let chunks = (0..).step_by(LIGHT_CHUNK).zip(items.chunks_mut(LIGHT_CHUNK));
    each(chunks.collect(), |(begin, chunk)| f(begin, chunk));
}

/// The items of some lists, list after list.
pub(crate) fn concat<T: Copy + Default + Send + Sync>(lists: &[Vec<T>]) -> Vec<T> {
    let mut all = vec![T::default(); lists.iter().map(Vec::len).sum()];
    let parts = cut(&mut all, lists.iter().map(Vec::len)).into_iter().zip(lists);
    let copy = |(part, list): (&mut [T], &Vec<T>)| part.copy_from_slice(list);
    if lists.iter().map(Vec::len).sum::<usize>() < WORTH_THREADS {
        parts.for_each(copy);
    } else {
        each(parts.collect(), copy);
    }
    all
}

/// As `concat`, for items without a default; lists are let go of one by one where there is one thread.
pub(crate) fn joined<T: Copy + Send + Sync>(lists: Vec<Vec<T>>) -> Vec<T> {
    let n = lists.iter().map(Vec::len).sum();
    let mut all = Vec::with_capacity(n);
    if n_threads() == 1 || n < WORTH_THREADS {
        lists.into_iter().for_each(|list| all.extend(list));
        return all;
    }
    let mut ends: Vec<usize> = lists.iter().map(Vec::len).collect();
    (1..ends.len()).for_each(|list| ends[list] += ends[list - 1]);
    // The lists that each stretch of items, as many as are worth a thread, begins and ends in: few, in which that of an item is
    // looked for.
    let list_of = |lists: Range<usize>, i: usize| lists.start + ends[lists].partition_point(|&end| end <= i);
    let borders = map_light(n.div_ceil(WORTH_A_THREAD) + 1, |i| {
        list_of(0..ends.len(), (i * WORTH_A_THREAD).min(n - 1))
    });
    extend_light(&mut all, n, |i| {
        let stretch = i / WORTH_A_THREAD;
        let list = list_of(borders[stretch]..borders[stretch + 1], i);
        lists[list][i + lists[list].len() - ends[list]]
    });
    all
}

/// Whether something holds for all of 0..n.
pub(crate) fn all(n: usize, holds: impl Fn(usize) -> bool + Sync + Send) -> bool {
    let (n_chunks, range) = chunks(n, LIGHT_CHUNK);
    map(n_chunks, |i| range(i).all(&holds)).into_iter().all(|holds| holds)
}

/// The numbers below n that are to be kept, ascending.
pub(crate) fn select(n: usize, keep: impl Fn(u32) -> bool + Sync + Send) -> Vec<u32> {
    // Few enough to be zeroed for nothing, many enough that adding them to a list is little work beside. Not tuned.
    const BLOCK: usize = 512;
    let select = |range: Range<usize>| {
        let (mut kept, mut block) = (Vec::with_capacity(range.len().min(LIGHT_CHUNK)), [0; BLOCK]);
        for begin in range.clone().step_by(BLOCK) {
            let mut n = 0;
            // Without a branch: often about as many are kept as are not.
            for x in begin..range.end.min(begin + BLOCK) {
                block[n] = x as u32;
                n += usize::from(keep(x as u32));
            }
            kept.extend_from_slice(&block[..n]);
        }
        kept
    };
    if n_threads() == 1 {
        return select(0..n);
    }
    let (n_chunks, range) = chunks(n, LIGHT_CHUNK);
    concat(&map(n_chunks, |chunk| select(range(chunk))))
}

/// One of as many parts of 0..n as there are threads: for work that is the same however it is divided.
pub(crate) fn part_of(n: usize, part: usize) -> Range<usize> {
    let n_parts = n_threads();
    n * part / n_parts..n * (part + 1) / n_parts
}

/// Applies `f` to each of as many parts of a slice as there are threads, and to what of it that is: for work in which every thread
/// looks at all there is and writes its own part.
pub(crate) fn map_parts<T: Send, R: Send>(
    items: &mut [T],
    f: impl Fn(Range<usize>, &mut [T]) -> R + Sync + Send,
) -> Vec<R> {
    let n = items.len();
    let parts = cut(items, (0..n_threads()).map(|part| part_of(n, part).len()));
    map_each(parts, |part, items| f(part_of(n, part), items))
}

/// The ranges of at most `size` that make up 0..n.
pub(crate) fn chunks(n: usize, size: usize) -> (usize, impl Fn(usize) -> Range<usize>) {
    (n.div_ceil(size), move |i| i * size..((i + 1) * size).min(n))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(feature = "rayon")]
    fn a_limit_of_threads_is_no_demand() {
        for (limit, started) in [(1, 1), (7, 7), (64, 64), (1_000_000, most_threads().get())] {
            let team = Team::new(NonZeroUsize::new(limit));
            assert_eq!(team.work(usize::MAX, n_threads).expect("there are threads"), started, "{limit}");
        }
    }

    #[test]
    fn lists_are_joined_in_their_order() {
        // Short ones and long ones, and many without anything.
        let length = |i: usize| if i.is_multiple_of(5) { 0 } else { [1, 40, 700, 3000][i % 4] };
        for n_lists in [0, 1, 2, 30, 200] {
            let list = |i: usize| (0..length(i)).map(|k| (i, k)).collect::<Vec<_>>();
            let lists: Vec<Vec<(usize, usize)>> = (0..n_lists).map(list).collect();
            for threads in 1..=3 {
                let team = Team::new(NonZeroUsize::new(threads));
                let all = team.work(usize::MAX, || joined(lists.clone())).expect("there are threads");
                assert_eq!(all, lists.concat());
            }
        }
    }

    #[test]
    fn numbers_are_selected_in_their_order() {
        for n in [0, 1, 511, 512, 513, 4096, 4097, 20_000] {
            for keep in [|_| true, |_| false, |x: u32| x.is_multiple_of(3), |x: u32| x / 600 % 2 == 1] {
                let expected: Vec<u32> = (0..n as u32).filter(|&x| keep(x)).collect();
                for threads in 1..=3 {
                    let team = Team::new(NonZeroUsize::new(threads));
                    assert_eq!(
                        team.work(usize::MAX, || select(n, keep)).expect("there are threads"),
                        expected
                    );
                }
            }
        }
    }
}
