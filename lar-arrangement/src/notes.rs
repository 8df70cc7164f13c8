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

/// 0..n in as many parts as there are threads.
pub(crate) struct Parts {
    begins: Vec<usize>,
}

impl Parts {
    pub(crate) fn new(n: usize) -> Self {
        let begins = (0..=parallel::n_threads()).map(|part| parallel::part_of(n, part).start);
        Self { begins: begins.collect() }
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
