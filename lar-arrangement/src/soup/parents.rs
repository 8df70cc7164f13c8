//! Which faces of the input something is a piece of.

use crate::split::offsets;

/// A face of the input that a polygon stands for: `sign` is −1 when the polygon is turned the other way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Parent {
    /// Index of the input surface.
    pub solid: u32,
    /// Face of that surface.
    pub face: u32,
    /// +1 or −1: the same orientation or the opposite one.
    pub sign: i8,
}

impl Parent {
    /// As that of something that looks the same way (+1) or the other.
    pub(crate) fn turned(&self, sign: i8) -> Self {
        Self { sign: self.sign * sign, ..*self }
    }
}

/// The parents of polygons or faces, at least one each.
#[derive(Clone, Debug)]
pub(crate) struct Parents {
    list: Vec<Parent>,
    /// Those of i are `offsets[i]..offsets[i + 1]` of the list; empty when each has one, in its place.
    offsets: Vec<u32>,
}

impl Parents {
    /// One each.
    pub(crate) fn single(list: Vec<Parent>) -> Self {
        Self { list, offsets: Vec::new() }
    }

    /// The first of each, and others with what they are parents of.
    pub(crate) fn with_others(firsts: Vec<Parent>, others: Vec<(u32, Parent)>) -> Self {
        if others.is_empty() {
            return Self::single(firsts);
        }
        Self::sorted(firsts.len(), (0..).zip(firsts).chain(others).collect())
    }

    /// Those of i are `offsets[i]..offsets[i + 1]` of the list.
    pub(crate) fn listed(list: Vec<Parent>, offsets: Vec<u32>) -> Self {
        if offsets.len() == list.len() + 1 { Self::single(list) } else { Self { list, offsets } }
    }

    /// Those of n things, each with what it is a parent of: ascending. O(n log n).
    pub(crate) fn sorted(n: usize, mut all: Vec<(u32, Parent)>) -> Self {
        all.sort_unstable();
        all.dedup();
        let offsets = offsets(n, all.iter().map(|p| p.0));
        Self::listed(all.into_iter().map(|p| p.1).collect(), offsets)
    }

    pub(crate) fn of(&self, i: usize) -> &[Parent] {
        if self.are_single() {
            return std::slice::from_ref(&self.list[i]);
        }
        &self.list[self.offsets[i] as usize..self.offsets[i + 1] as usize]
    }

    /// Whether each has one.
    pub(crate) fn are_single(&self) -> bool {
        self.offsets.is_empty()
    }

    /// How many there are of all.
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }
}
