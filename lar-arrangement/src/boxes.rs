//! Broad phase: a tree of boxes over points in Z-order, eight children a node, built in bulk.

use crate::counting::sorted_numbers;
use crate::parallel;
use crate::progress::{Cancelled, Course};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::ops::Range;
use wide::f32x8;

/// An axis-aligned closed box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aabb<const D: usize = 3> {
    pub lo: [f64; D],
    pub hi: [f64; D],
}

impl<const D: usize> Aabb<D> {
    pub(crate) const EMPTY: Self = Self { lo: [f64::INFINITY; D], hi: [f64::NEG_INFINITY; D] };

    pub(crate) fn around(points: impl IntoIterator<Item = [f64; D]>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| b.joined(&Self { lo: p, hi: p }))
    }

    pub(crate) fn joined(&self, other: &Self) -> Self {
        Self {
            lo: std::array::from_fn(|k| self.lo[k].min(other.lo[k])),
            hi: std::array::from_fn(|k| self.hi[k].max(other.hi[k])),
        }
    }

    /// All comparisons are made: a branch for each would be predicted badly.
    pub(crate) fn meets(&self, other: &Self) -> bool {
        (0..D).fold(true, |meets, k| meets & (self.lo[k] <= other.hi[k]) & (other.lo[k] <= self.hi[k]))
    }
}

/// A node of the tree, ordered by how far right it reaches.
#[derive(PartialEq)]
struct Reach {
    x: f64,
    level: usize,
    i: usize,
}

impl Eq for Reach {}

impl Ord for Reach {
    fn cmp(&self, other: &Self) -> Ordering {
        self.x.total_cmp(&other.x).then_with(|| (self.level, self.i).cmp(&(other.level, other.i)))
    }
}

impl PartialOrd for Reach {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Bits of a place along an axis of the curve.
const BITS: usize = 20;

/// The order of n boxes along a Z-shaped space-filling curve through their middles.
pub(crate) fn z_order<const D: usize>(n: usize, box_of: impl Fn(u32) -> Aabb<D> + Sync + Send) -> Vec<u32> {
    let (n_chunks, range) = parallel::chunks(n, 1 << 14);
    let hulls = parallel::map(n_chunks, |chunk| {
        range(chunk).fold(Aabb::EMPTY, |all, i| all.joined(&box_of(i as u32)))
    });
    let all = hulls.iter().fold(Aabb::EMPTY, |all, hull| all.joined(hull));
    let scale: [f64; D] =
        std::array::from_fn(
            |k| {
                if all.hi[k] > all.lo[k] { 1_048_575.0 / (all.hi[k] - all.lo[k]) } else { 0.0 }
            },
        );
    let key = |i: u32| {
        let b = box_of(i);
        let cell = |k: usize| (((b.lo[k] - all.lo[k]) * 0.5 + (b.hi[k] - all.lo[k]) * 0.5) * scale[k]) as u64;
        (0..D).fold(0, |key, k| key | spread::<D>(cell(k)) << k)
    };
    // The upper half of the key and the number together; what is below decides for few.
    let upper = parallel::map_light(n, |i| (key(i as u32) >> (D * BITS - 32)) << 32 | i as u64);
    let settle = |sorted: &mut [u64]| {
        for same in sorted.chunk_by_mut(|a, b| a >> 32 == b >> 32).filter(|same| same.len() > 1) {
            same.sort_unstable_by_key(|&x| (key(x as u32), x));
        }
    };
    let sorted = sorted_numbers(&upper, 64, settle);
    parallel::map_light(n, |i| sorted[i] as u32)
}

/// Number of items in a block.
pub(crate) const WIDTH: usize = 8;

/// No group.
pub(crate) const NO_GROUP: u32 = u32::MAX;

/// Eight boxes in 32 bits, rounded outwards, side by side: one box is tested against all of them at once. What they
/// let through is tested again in 64 bits.
#[derive(Clone, Copy, Debug)]
struct Block<const D: usize> {
    lo: [f32x8; D],
    hi: [f32x8; D],
}

impl<const D: usize> Block<D> {
    fn new(boxes: &[Aabb<D>]) -> Self {
        let (mut lo, mut hi) = ([[f32::INFINITY; WIDTH]; D], [[f32::NEG_INFINITY; WIDTH]; D]);
        for (i, b) in boxes.iter().enumerate() {
            let near = Near::new(b);
            for k in 0..D {
                (lo[k][i], hi[k][i]) = (near.lo[k], near.hi[k]);
            }
        }
        Self { lo: lo.map(f32x8::from), hi: hi.map(f32x8::from) }
    }

    /// Box i.
    fn at(&self, i: usize) -> Near<D> {
        let of = |side: &[f32x8; D]| std::array::from_fn(|k| side[k].as_array()[i]);
        Near { lo: of(&self.lo), hi: of(&self.hi) }
    }

    /// The boxes, as bits, that meet a box.
    fn meeting(&self, other: &Near<D>) -> u8 {
        let along = |k: usize| {
            let (lo, hi) = (f32x8::splat(other.lo[k]), f32x8::splat(other.hi[k]));
            self.lo[k].simd_le(hi) & lo.simd_le(self.hi[k])
        };
        (1..D).fold(along(0), |all, k| all & along(k)).to_bitmask() as u8
    }
}

/// A box in 32 bits, rounded outwards.
#[derive(Clone, Copy, Debug)]
struct Near<const D: usize> {
    lo: [f32; D],
    hi: [f32; D],
}

impl<const D: usize> Near<D> {
    fn new(b: &Aabb<D>) -> Self {
        Self { lo: b.lo.map(below), hi: b.hi.map(above) }
    }
}

/// An `f32` that is not above x: twice the error of rounding to nearest, and a tiny number, below it. Infinities stay,
/// or become no number when they make a box empty.
fn below(x: f64) -> f32 {
    let near = x as f32;
    near - near.abs() * f32::EPSILON - f32::MIN_POSITIVE
}

fn above(x: f64) -> f32 {
    -below(-x)
}

/// The numbers of the bits that are set, ascending.
fn bits_of(mut bits: u8) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let next = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        next
    })
}

/// Boxes in a tree.
#[derive(Debug)]
pub(crate) struct BoxTree<const D: usize = 3> {
    /// Item at each leaf.
    items: Vec<u32>,
    /// The boxes of each level by blocks of eight.
    blocks: Vec<Vec<Block<D>>>,
    /// Level 0 holds the leaves' boxes; a box of level k + 1 encloses eight of level k.
    levels: Vec<Vec<Aabb<D>>>,
    /// The group that everything under a node belongs to, or `NO_GROUP`; empty when there are no groups.
    groups: Vec<Vec<u32>>,
    /// Marks of each leaf; empty when there are none.
    marks: Vec<[u32; 3]>,
}

/// No mark.
pub(crate) const NO_MARK: u32 = u32::MAX;

fn share_a_mark(a: &[u32; 3], b: &[u32; 3]) -> bool {
    let is_among = |mark: u32| (mark == a[0]) | (mark == a[1]) | (mark == a[2]);
    b.iter().fold(false, |share, &mark| share | ((mark != NO_MARK) & is_among(mark)))
}

impl<const D: usize> BoxTree<D> {
    /// O(n log n).
    pub(crate) fn new(boxes: &[Aabb<D>]) -> Self {
        Self::over(z_order(boxes.len(), |i| boxes[i as usize]), |i| boxes[i as usize])
    }

    /// A tree with its leaves in a given order. O(n).
    pub(crate) fn over(items: Vec<u32>, box_of: impl Fn(u32) -> Aabb<D> + Sync + Send) -> Self {
        let mut levels = vec![parallel::map_light(items.len(), |i| box_of(items[i]))];
        while let Some(below) = levels.last().filter(|level| level.len() > 1) {
            let hull = |c: &[Aabb<D>]| c.iter().fold(Aabb::EMPTY, |a, b| a.joined(b));
            let level = parallel::map_light(below.len().div_ceil(WIDTH), |i| {
                hull(&below[i * WIDTH..((i + 1) * WIDTH).min(below.len())])
            });
            levels.push(level);
        }
        let blocks_of = |level: &Vec<Aabb<D>>| {
            parallel::map_light(level.len().div_ceil(WIDTH), |i| {
                Block::new(&level[i * WIDTH..((i + 1) * WIDTH).min(level.len())])
            })
        };
        let blocks = levels.iter().map(blocks_of).collect();
        Self { items, blocks, levels, groups: Vec::new(), marks: Vec::new() }
    }

    /// The tree with some items in groups: pairs of one group need not be visited, and whole subtrees of them are
    /// passed over.
    pub(crate) fn with_groups(mut self, group_of: impl Fn(u32) -> u32) -> Self {
        let same = |c: &[u32]| if c.iter().all(|&g| g == c[0]) { c[0] } else { NO_GROUP };
        self.groups = vec![self.items.iter().map(|&i| group_of(i)).collect()];
        for k in 1..self.levels.len() {
            let level = self.groups[k - 1].chunks(WIDTH).map(same).collect();
            self.groups.push(level);
        }
        self
    }

    /// The tree with marks on its items: those that share one are no pair.
    pub(crate) fn with_marks(mut self, marks_of: impl Fn(u32) -> [u32; 3]) -> Self {
        self.marks = self.items.iter().map(|&i| marks_of(i)).collect();
        self
    }

    fn are_settled(&self, this: usize, other: usize) -> bool {
        !self.marks.is_empty() && share_a_mark(&self.marks[this], &self.marks[other])
    }

    /// Whether all leaves under a node are of one group.
    fn is_within(&self, group: u32, level: usize, i: usize) -> bool {
        group != NO_GROUP && self.groups[level][i] == group
    }

    /// The group that all leaves of a block belong to.
    fn group_of_block(&self, block: usize) -> u32 {
        self.groups.get(1).map_or(NO_GROUP, |level| level[block])
    }

    /// The items in the order of the leaves.
    pub(crate) fn items(&self) -> &[u32] {
        &self.items
    }

    /// Calls `visit` with each item whose box meets `target`.
    pub(crate) fn query(&self, target: &Aabb<D>, mut visit: impl FnMut(u32)) {
        self.leaves(target, 0, NO_GROUP, &mut |leaf| visit(self.items[leaf]));
    }

    /// Calls `visit` with items whose boxes meet `target`, those that reach farther right first. The call is given
    /// the current bound, `bound` at first, and returns a new one: boxes that end left of it are left out.
    ///
    /// Best first, not depth first: a subtree without anything of use must not be searched before the bound is
    /// known from another one.
    pub(crate) fn query_leftwards(
        &self,
        target: &Aabb<D>,
        mut bound: f64,
        mut visit: impl FnMut(u32, f64) -> f64,
    ) {
        let top = self.levels.len() - 1;
        let mut heap = BinaryHeap::new();
        let add = |heap: &mut BinaryHeap<Reach>, bound: f64, level: usize, nodes: Range<usize>| {
            for (node, i) in self.levels[level][nodes.clone()].iter().zip(nodes) {
                if node.hi[0] >= bound && node.meets(target) {
                    heap.push(Reach { x: node.hi[0], level, i });
                }
            }
        };
        add(&mut heap, bound, top, 0..self.levels[top].len());
        while let Some(Reach { x, level, i }) = heap.pop() {
            if x < bound {
                return;
            }
            if level == 0 {
                bound = visit(self.items[i], bound);
            } else {
                let end = ((i + 1) * WIDTH).min(self.levels[level - 1].len());
                add(&mut heap, bound, level - 1, i * WIDTH..end);
            }
        }
    }

    /// Calls `visit` with each leaf at or after `first` whose box meets `target` and that is not of a group.
    fn leaves(&self, target: &Aabb<D>, first: usize, group: u32, visit: &mut impl FnMut(usize)) {
        let near = Near::new(target);
        let is_wanted =
            |level: usize, i: usize| self.levels[level][i].meets(target) && !self.is_within(group, level, i);
        let top = self.levels.len() - 1;
        // At most seven nodes of each level wait while their sister is searched.
        let mut stack: Vec<(usize, usize)> = Vec::with_capacity(WIDTH * self.levels.len());
        stack.extend((0..self.levels[top].len()).filter(|&i| is_wanted(top, i)).map(|i| (top, i)));
        while let Some((level, i)) = stack.pop() {
            if level == 0 {
                visit(i);
                continue;
            }
            let below = level - 1;
            // A subtree whose last leaf comes before `first` is of no use.
            let from = first / WIDTH.pow(below as u32);
            let children = bits_of(self.blocks[below][i].meeting(&near)).map(|bit| i * WIDTH + bit);
            let wanted = children.filter(|&c| from <= c && is_wanted(below, c));
            if below == 0 {
                wanted.for_each(&mut *visit);
            } else {
                let pushed = stack.len();
                stack.extend(wanted.map(|c| (below, c)));
                stack[pushed..].reverse();
            }
        }
    }

    /// The items of a block and of all blocks after it.
    pub(crate) fn items_from(&self, block: usize) -> &[u32] {
        &self.items[block * WIDTH..]
    }

    /// Number of blocks of eight leaves.
    pub(crate) fn n_blocks(&self) -> usize {
        self.items.len().div_ceil(WIDTH)
    }

    /// The first item of a block.
    pub(crate) fn first_of_block(&self, block: usize) -> u32 {
        self.items[block * WIDTH]
    }

    /// Calls `visit` with each pair of items whose boxes meet, one in the block, the other after it in the tree's
    /// order. Over all blocks every pair comes once, but for pairs with a mark in common; pairs of one group may be left
    /// out.
    pub(crate) fn pairs_of_block(&self, block: usize, mut visit: impl FnMut(u32, u32)) {
        let leaves = &self.levels[0];
        let (from, to) = (block * WIDTH, ((block + 1) * WIDTH).min(leaves.len()));
        let hull = leaves[from..to].iter().fold(Aabb::EMPTY, |a, b| a.joined(b));
        self.leaves(&hull, from, self.group_of_block(block), &mut |other| {
            let near = self.blocks[0][other / WIDTH].at(other % WIDTH);
            let before = if other < to { (1 << (other - from)) - 1 } else { u8::MAX };
            for this in bits_of(self.blocks[0][block].meeting(&near) & before).map(|bit| from + bit) {
                if !self.are_settled(this, other) && leaves[this].meets(&leaves[other]) {
                    visit(self.items[this], self.items[other]);
                }
            }
        });
    }

    /// All pairs of items whose boxes meet, each once, the smaller first. O(n log n + pairs).
    pub(crate) fn pairs(&self, course: &Course) -> Result<Vec<[u32; 2]>, Cancelled> {
        let (n_chunks, range) = parallel::chunks(self.n_blocks(), 64);
        let parts = course.map(n_chunks, |chunk| {
            let mut found = Vec::new();
            for block in range(chunk).take_while(|_| !course.is_cancelled()) {
                self.pairs_of_block(block, |i, j| found.push([i.min(j), i.max(j)]));
            }
            found
        })?;
        Ok(parts.concat())
    }
}

/// The low 20 bits, each with D − 1 zeros before it, in the plane or in space.
fn spread<const D: usize>(x: u64) -> u64 {
    let halved = |x: u64, shift: u32, mask: u64| (x | x << shift) & mask;
    if D == 2 {
        let x = halved(x, 16, 0x0000_ffff_0000_ffff);
        let x = halved(x, 8, 0x00ff_00ff_00ff_00ff);
        let x = halved(x, 4, 0x0f0f_0f0f_0f0f_0f0f);
        let x = halved(x, 2, 0x3333_3333_3333_3333);
        halved(x, 1, 0x5555_5555_5555_5555)
    } else {
        let x = halved(x, 32, 0x001f_0000_0000_ffff);
        let x = halved(x, 16, 0x001f_0000_ff00_00ff);
        let x = halved(x, 8, 0x100f_00f0_0f00_f00f);
        let x = halved(x, 4, 0x10c3_0c30_c30c_30c3);
        halved(x, 2, 0x1249_2492_4924_9249)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Control;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pairs_and_queries_agree_with_brute_force(
            corners in prop::collection::vec((prop::array::uniform3(0i32..40), prop::array::uniform3(0i32..9)), 0..300)
        ) {
            let boxes: Vec<Aabb> = corners.iter().map(|(lo, size)| Aabb {
                lo: lo.map(f64::from),
                hi: std::array::from_fn(|k| f64::from(lo[k] + size[k])),
            }).collect();
            let mut expected = Vec::new();
            for j in 0..boxes.len() as u32 {
                for i in 0..j {
                    if boxes[i as usize].meets(&boxes[j as usize]) {
                        expected.push([i, j]);
                    }
                }
            }
            expected.sort_unstable();
            let tree = BoxTree::new(&boxes);
            let mut found = tree.pairs(&Course::new(Control::default(), &[])).unwrap();
            found.sort_unstable();
            prop_assert_eq!(found, expected);
            if let Some(target) = boxes.first() {
                let mut found = Vec::new();
                tree.query(target, |i| found.push(i));
                found.sort_unstable();
                let expected: Vec<u32> = (0..boxes.len() as u32).filter(|&i| boxes[i as usize].meets(target)).collect();
                prop_assert_eq!(found, &expected[..]);
                let mut found = Vec::new();
                tree.query_leftwards(target, f64::NEG_INFINITY, |i, bound| {
                    found.push(i);
                    bound
                });
                prop_assert!(found.is_sorted_by(|&i, &j| boxes[i as usize].hi[0] >= boxes[j as usize].hi[0]));
                found.sort_unstable();
                prop_assert_eq!(&found, &expected);
                // With the middle of the target as a bound from the first visit on.
                let (mut found, middle) = (Vec::new(), (target.lo[0] + target.hi[0]) / 2.0);
                tree.query_leftwards(target, f64::NEG_INFINITY, |i, _| {
                    found.push(i);
                    middle
                });
                found.sort_unstable();
                let expected: Vec<u32> = expected.into_iter().filter(|&i| boxes[i as usize].hi[0] >= middle).collect();
                prop_assert_eq!(found, expected);
            }
        }
    }
}
