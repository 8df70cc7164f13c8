//! Disjoint sets of small integers; the representative is the smallest member, so results do not depend on the
//! order of the unions.

use crate::parallel;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Disjoint sets over 0..n.
#[derive(Clone, Debug)]
pub(crate) struct UnionFind {
    parent: Vec<u32>,
}

impl UnionFind {
    pub(crate) fn new(n: usize) -> Self {
        Self { parent: parallel::map_light(n, |x| x as u32) }
    }

    /// The sets that n lists of pairs join. Every thread takes its part of the lists and joins the pairs within its part
    /// of the elements; others are joined after. So early lists should be of early elements.
    pub(crate) fn of_pairs<I: Iterator<Item = (u32, u32)>>(
        n: usize,
        n_lists: usize,
        pairs: impl Fn(Range<usize>) -> I + Sync + Send,
    ) -> Self {
        let mut out = Self::new(n);
        if parallel::n_threads() == 1 {
            pairs(0..n_lists).for_each(|(x, y)| _ = out.union(x, y));
            return out;
        }
        let parts: Vec<Range<usize>> =
            (0..parallel::n_threads()).map(|part| parallel::part_of(n, part)).collect();
        let slices = parallel::cut(&mut out.parent, parts.iter().map(Range::len));
        let slices: Vec<Mutex<&mut [u32]>> = slices.into_iter().map(Mutex::new).collect();
        let across = parallel::map(parts.len(), |i| {
            let range = &parts[i];
            let mut parent = slices[i].lock().unwrap_or_else(PoisonError::into_inner);
            let mut part = Part { parent: &mut parent, begin: range.start as u32 };
            let mut across = Vec::new();
            for (x, y) in pairs(parallel::part_of(n_lists, i)) {
                if part.has(x) & part.has(y) {
                    part.union(x, y);
                } else {
                    across.push((x, y));
                }
            }
            across
        });
        drop(slices);
        across.into_iter().flatten().for_each(|(x, y)| _ = out.union(x, y));
        out
    }

    /// Smallest member of the set of x. Amortised O(log n) by path halving.
    pub(crate) fn find(&mut self, x: u32) -> u32 {
        self.whole().find(x)
    }

    fn whole(&mut self) -> Part<'_> {
        Part { parent: &mut self.parent, begin: 0 }
    }

    /// Smallest member of the set of x, without shortening the way to it.
    pub(crate) fn root(&self, mut x: u32) -> u32 {
        while self.parent[x as usize] != x {
            x = self.parent[x as usize];
        }
        x
    }

    /// Joins the sets of x and y; true when they were distinct.
    pub(crate) fn union(&mut self, x: u32, y: u32) -> bool {
        self.whole().union(x, y)
    }

    /// The elements that are not the smallest of their sets.
    pub(crate) fn joined(&self) -> Vec<u32> {
        parallel::select(self.parent.len(), |x| self.parent[x as usize] != x)
    }

    /// Number of each element's set; sets are numbered by their smallest members. Also the number of sets.
    pub(crate) fn labels(mut self) -> (Vec<u32>, u32) {
        let mut n = 0;
        // A parent is smaller than its children: it has its label before they look for it.
        for x in 0..self.parent.len() {
            let parent = self.parent[x] as usize;
            if parent == x {
                self.parent[x] = n;
                n += 1;
            } else {
                self.parent[x] = self.parent[parent];
            }
        }
        (self.parent, n)
    }
}

/// Consecutive elements whose sets have no others.
struct Part<'a> {
    parent: &'a mut [u32],
    /// The first of them.
    begin: u32,
}

impl Part<'_> {
    fn has(&self, x: u32) -> bool {
        (x.wrapping_sub(self.begin) as usize) < self.parent.len()
    }

    fn at(&mut self, x: u32) -> &mut u32 {
        &mut self.parent[(x - self.begin) as usize]
    }

    fn find(&mut self, mut x: u32) -> u32 {
        loop {
            let parent = *self.at(x);
            if parent == x {
                return x;
            }
            let grandparent = *self.at(parent);
            *self.at(x) = grandparent;
            x = grandparent;
        }
    }

    fn union(&mut self, x: u32, y: u32) -> bool {
        if *self.at(x) == *self.at(y) {
            return false;
        }
        let (x, y) = (self.find(x), self.find(y));
        *self.at(x.max(y)) = x.min(y);
        x != y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::num::NonZeroUsize;

    proptest! {
        #[test]
        fn sets_do_not_depend_on_the_threads(pairs in prop::collection::vec((0u32..60, 0u32..60), 0..60)) {
            let mut one_by_one = UnionFind::new(60);
            pairs.iter().for_each(|&(x, y)| _ = one_by_one.union(x, y));
            for threads in 1..=3 {
                let found = || UnionFind::of_pairs(60, pairs.len(), |range| pairs[range].iter().copied()).labels();
                let found = parallel::Team::new(NonZeroUsize::new(threads)).work(usize::MAX, found).unwrap();
                prop_assert_eq!(found, one_by_one.clone().labels());
            }
        }
    }
}
