//! Planar stage 2a: carriers through one point.
//!
//! Their pairs are quadratic in number, and none but the first few says anything new. Carriers that are known to
//! share a point are a *bundle*: its pairs are passed over, and where a bundle is large the tree of boxes is laid out
//! anew with the bundle in subtrees of its own, so that its pairs are not even visited.

use crate::boxes::{BoxTree, NO_GROUP, WIDTH};
use crate::planar::along::{Along, KEY_ERROR};
use crate::planar::carriers::Carriers;
use crate::planar::events::Event;
use rustc_hash::FxHashMap;

/// Carriers that meet another one in one point are a bundle from this number on.
pub(crate) const BUNDLE: usize = 8;

/// From this number on a bundle is worth a new layout of the tree.
const LARGE: u8 = 64;

/// One block in so many is searched first, to find out what bundles there are.
const SAMPLE: usize = 64;

/// Some carriers through one point.
#[derive(Clone, Debug)]
pub(crate) struct Bundle {
    /// The point, if it is a grid point.
    pub at: Option<u32>,
    pub carriers: Vec<u32>,
}

/// The bundle of each carrier: the first that was found.
#[derive(Debug)]
pub(crate) struct Bundles {
    of: Vec<u32>,
    n: u32,
    /// Bundles at grid points.
    at: FxHashMap<u32, u32>,
}

impl Bundles {
    /// The carriers that end in one point, where they are many.
    pub(crate) fn of_fans(carriers: &Carriers) -> Self {
        let mut out = Self { of: vec![NO_GROUP; carriers.ends.len()], n: 0, at: FxHashMap::default() };
        let count = |n: &mut u8| *n = n.saturating_add(1);
        let mut n_ends = vec![0u8; carriers.points.len()];
        // Members have no fewer ends than carriers, and theirs lie side by side in memory.
        carriers.members.iter().flat_map(|member| member.ends).for_each(|p| count(&mut n_ends[p as usize]));
        if n_ends.iter().all(|&n| n < LARGE) {
            return out;
        }
        n_ends.fill(0);
        carriers.ends.as_flattened().iter().for_each(|&p| count(&mut n_ends[p as usize]));
        for (ends, carrier) in carriers.ends.iter().zip(0..) {
            if let Some(&at) = ends.iter().find(|&&p| n_ends[p as usize] >= LARGE) {
                out.learn(&Bundle { at: Some(at), carriers: vec![carrier] });
            }
        }
        out
    }

    /// Whether there are any.
    pub(crate) fn is_empty(&self) -> bool {
        self.n == 0
    }

    pub(crate) fn of(&self, carrier: u32) -> u32 {
        self.of[carrier as usize]
    }

    /// Marks the carriers that are in no bundle yet; true when they are many.
    pub(crate) fn learn(&mut self, bundle: &Bundle) -> bool {
        let next = self.n;
        let number = bundle.at.map_or(next, |at| *self.at.entry(at).or_insert(next));
        self.n += u32::from(number == next);
        let mut new = 0;
        for &carrier in &bundle.carriers {
            let mark = &mut self.of[carrier as usize];
            if *mark == NO_GROUP {
                *mark = number;
                new += 1;
            }
        }
        new >= usize::from(LARGE)
    }

    /// A tree of some carriers with those of a bundle side by side, by slope.
    pub(crate) fn tree(&self, carriers: &Carriers, mut items: Vec<u32>) -> BoxTree<2> {
        items.sort_unstable();
        let mut first = vec![u32::MAX; self.n as usize];
        for &item in items.iter().rev().filter(|&&item| self.of(item) != NO_GROUP) {
            first[self.of(item) as usize] = item;
        }
        items.sort_by_cached_key(|&item| match self.of(item) {
            NO_GROUP => (item, NO_GROUP, 0),
            bundle => (first[bundle as usize], bundle, carriers.rank[item as usize]),
        });
        BoxTree::over(sample_first(&items), |c| carriers.box_of(c)).with_groups(|c| self.of(c))
    }
}

/// The same items with every 64th block before all others. A block holds what is near in the plane.
pub(crate) fn sample_first(items: &[u32]) -> Vec<u32> {
    let (blocks, rest) = items.as_chunks::<WIDTH>();
    let sample = || (SAMPLE / 2..blocks.len()).step_by(SAMPLE);
    let mut out = Vec::with_capacity(items.len());
    sample().for_each(|i| out.extend_from_slice(&blocks[i]));
    let mut begin = 0;
    for end in sample().chain([blocks.len()]) {
        out.extend_from_slice(blocks[begin..end].as_flattened());
        begin = end + 1;
    }
    out.extend_from_slice(rest);
    out
}

/// Number of blocks that `sample_first` puts first.
pub(crate) fn n_sampled(n_items: usize) -> usize {
    (n_items / WIDTH + SAMPLE / 2 - 1) / SAMPLE
}

/// Carriers that meet the pivot in one point become a bundle. `events` are those found in pairs with the pivot,
/// `crossings` the carriers of their crossings.
pub(crate) fn bundles_at(
    carriers: &Carriers,
    pivot: u32,
    events: &[Event],
    crossings: &[[u32; 2]],
) -> Vec<Bundle> {
    let other = |e: &Event| {
        e.crossing_of_lot().map(|number| {
            let [s, t] = crossings[number];
            if s == pivot { t } else { s }
        })
    };
    let along = |e: &Event| match other(e) {
        Some(other) => Along::crossing(carriers, pivot, other),
        None => Along::point(carriers, pivot, e.vertex),
    };
    let mut met: Vec<Event> = events.iter().filter(|e| e.carrier == pivot).copied().collect();
    met.sort_by(|a, b| a.key.total_cmp(&b.key));
    met.chunk_by(|a, b| b.key - a.key <= 2.0 * KEY_ERROR && along(a).cmp(&along(b)).is_eq())
        .filter(|same| same.len() >= BUNDLE)
        .map(|same| Bundle {
            at: same.iter().find(|e| other(e).is_none()).map(|e| e.vertex),
            carriers: same.iter().filter_map(other).chain([pivot]).collect(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_64th_block_comes_first() {
        for n in [0, 7, 255, 264, 511, 512, 4000] {
            let items: Vec<u32> = (0..n).collect();
            let mut found = sample_first(&items);
            let sampled = n_sampled(items.len());
            assert!(
                found[..sampled * WIDTH].chunks(WIDTH).all(|b| b[0] as usize / WIDTH % SAMPLE == SAMPLE / 2)
            );
            assert!(found[sampled * WIDTH..].is_sorted());
            found.sort_unstable();
            assert_eq!(found, items);
        }
    }
}
