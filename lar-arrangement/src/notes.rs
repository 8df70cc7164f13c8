//! What threads find for each other: each looks at its part of some things for its part of others. What it finds for itself it
//! uses at once, and makes notes of the rest. Nobody looks at all there is.
//!
//! ```text
//!    half-edges  ├───────────────┼───────────────┤
//!                    │      ╲        │
//!                    ▼       ╲note   ▼
//!    points      ├───────────────┼───────────────┤
//! ```
//!
//! Where things that are numbered one after the other belong together, as in meshes, there are few notes.

use crate::parallel;
use std::ops::Range;

/// So many users for each part are asked what they use: shares are then equal within some hundredths. Not tuned.
const ASKED: usize = 256;

/// 0..n in as many parts as there are threads.
pub(crate) struct Parts {
    begins: Vec<usize>,
}

impl Parts {
    pub(crate) fn new(n: usize) -> Self {
        let begins = (0..=parallel::n_threads()).map(|part| parallel::part_of(n, part).start);
        Self { begins: begins.collect() }
    }

    /// The same, so that each has about as many of some users: the u-th of `n_users` uses `used(u)`.
    pub(crate) fn with_equal_shares(n: usize, n_users: usize, used: impl Fn(usize) -> u32) -> Self {
        let n_parts = parallel::n_threads();
        if n_parts == 1 {
            return Self::new(n);
        }
        let n_asked = n_users.min(ASKED * n_parts);
        let mut asked: Vec<u32> =
            (0..n_asked).map(|i| used((i as u64 * n_users as u64 / n_asked as u64) as usize)).collect();
        asked.sort_unstable();
        let begin = |part: usize| match part {
            0 => 0,
            _ if part == n_parts || asked.is_empty() => n,
            _ => asked[part * n_asked / n_parts] as usize,
        };
        Self { begins: (0..=n_parts).map(begin).collect() }
    }

    pub(crate) fn range(&self, part: usize) -> Range<usize> {
        self.begins[part]..self.begins[part + 1]
    }

    /// What gives the place of x in a part: beyond its end when x is in another.
    pub(crate) fn places(&self, part: usize) -> impl Fn(u32) -> usize + use<> {
        let begin = self.begins[part];
        move |x| (x as usize).wrapping_sub(begin)
    }

    pub(crate) fn lengths(&self) -> impl Iterator<Item = usize> + '_ {
        self.begins.windows(2).map(|ends| ends[1] - ends[0])
    }

    /// The part that x is in.
    fn with(&self, x: usize) -> usize {
        self.begins.partition_point(|&begin| begin <= x) - 1
    }
}

/// Notes of one thread, by the parts that they are for.
pub(crate) struct Notepad<'a, T> {
    parts: &'a Parts,
    of_parts: Vec<Vec<T>>,
}

impl<T> Notepad<'_, T> {
    /// Notes something for the part that x is in: seldom.
    #[cold]
    pub(crate) fn note(&mut self, x: u32, what: T) {
        self.of_parts[self.parts.with(x as usize)].push(what);
    }
}

/// Notes of all threads: by who made them, and by the parts that they are for.
pub(crate) struct Notes<T>(Vec<Vec<Vec<T>>>);

impl<T: Send + Sync> Notes<T> {
    /// Lets each thread look: with its part's number, its own one of `parts_of`, and a pad for notes about other parts of what `parts`
    /// divides. Returns what each has made of its own, and all notes.
    pub(crate) fn of_all<O: Send, R: Send>(
        parts: &Parts,
        own: Vec<O>,
        look: impl Fn(usize, O, &mut Notepad<'_, T>) -> R + Sync + Send,
    ) -> (Vec<R>, Self) {
        let n_parts = own.len();
        let looked = parallel::map_each(own, |part, own| {
            let mut pad = Notepad { parts, of_parts: (0..n_parts).map(|_| Vec::new()).collect() };
            (look(part, own, &mut pad), pad.of_parts)
        });
        let (made, notes) = looked.into_iter().unzip();
        (made, Self(notes))
    }

    /// Those for a part.
    pub(crate) fn of(&self, part: usize) -> impl Iterator<Item = &T> {
        self.before(part).chain(self.behind(part))
    }

    /// Those for a part of who is before it.
    pub(crate) fn before(&self, part: usize) -> impl Iterator<Item = &T> {
        self.0[..part].iter().flat_map(move |notes| &notes[part])
    }

    /// Those for a part of who is behind it.
    pub(crate) fn behind(&self, part: usize) -> impl Iterator<Item = &T> {
        self.0[part..].iter().flat_map(move |notes| &notes[part])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::num::NonZeroUsize;

    /// The lengths of the parts of 0..n for the users of some things on three threads.
    fn check(n: usize, used: &[u32], expected: [usize; 3]) {
        let lengths = || Parts::with_equal_shares(n, used.len(), |u| used[u]).lengths().collect::<Vec<_>>();
        let team = parallel::Team::new(NonZeroUsize::new(3));
        assert_eq!(team.work(usize::MAX, lengths).expect("there are threads"), expected);
    }

    #[test]
    fn parts_have_equal_shares_of_the_users() {
        let each: Vec<u32> = (0..600).collect();
        check(600, &each, [200, 200, 200]);
        // What comes early is used as little as in a mesh that was refined.
        let late: Vec<u32> = each.iter().map(|x| 400 + x / 3).collect();
        check(600, &late, [466, 67, 67]);
        let downwards: Vec<u32> = each.iter().rev().copied().collect();
        check(600, &downwards, [200, 200, 200]);
        check(600, &[5; 40], [5, 0, 595]);
        check(600, &[], [600, 0, 0]);
        check(0, &[], [0, 0, 0]);
    }
}
