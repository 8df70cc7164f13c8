//! Broad phase: a tree of boxes over points in Z-order, eight children a node, built in bulk.

use crate::counting::{sorted_by_place, sorted_numbers};
use crate::curve::{Curve, hull};
use crate::parallel;
use crate::progress::{Cancelled, Course};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
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

    /// Coordinates are numbers: `f64::min` and `max` would take three times as long to see to those that are not.
    pub(crate) fn joined(&self, other: &Self) -> Self {
        Self {
            lo: std::array::from_fn(|k| if other.lo[k] < self.lo[k] { other.lo[k] } else { self.lo[k] }),
            hi: std::array::from_fn(|k| if other.hi[k] > self.hi[k] { other.hi[k] } else { self.hi[k] }),
        }
    }

    /// Larger by so much on all sides.
    pub(crate) fn larger(&self, by: f64) -> Self {
        Self { lo: self.lo.map(|x| x - by), hi: self.hi.map(|x| x + by) }
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

/// Number of items in a block.
pub(crate) const WIDTH: usize = 8;

/// A box so many times as large as another, by the sums of their sides, is large beside it.
pub(crate) const LARGE: f32 = 4.0;

/// No group.
pub(crate) const NO_GROUP: u32 = u32::MAX;

/// Eight boxes in 32 bits, rounded outwards: coordinates should not be far from 0 beside the boxes' sizes. They lie
/// side by side: one box is tested against all of them at once.
#[derive(Clone, Copy, Debug)]
struct Block<const D: usize> {
    lo: [f32x8; D],
    hi: [f32x8; D],
}

impl<const D: usize> Block<D> {
    /// Up to eight boxes; the others are empty.
    fn of(boxes: impl Iterator<Item = Near<D>>) -> Self {
        let (mut lo, mut hi) = ([[f32::INFINITY; WIDTH]; D], [[f32::NEG_INFINITY; WIDTH]; D]);
        for (i, b) in boxes.take(WIDTH).enumerate() {
            for k in 0..D {
                (lo[k][i], hi[k][i]) = (b.lo[k], b.hi[k]);
            }
        }
        Self { lo: lo.map(f32x8::from), hi: hi.map(f32x8::from) }
    }

    /// The box around all eight.
    fn hull(&self) -> Near<D> {
        let least = |x: &f32x8| x.as_array().iter().fold(f32::INFINITY, |a, &b| a.min(b));
        let most = |x: &f32x8| x.as_array().iter().fold(f32::NEG_INFINITY, |a, &b| a.max(b));
        Near {
            lo: std::array::from_fn(|k| least(&self.lo[k])),
            hi: std::array::from_fn(|k| most(&self.hi[k])),
        }
    }

    /// The sums of the sides of the boxes; 0 for those that are empty.
    fn sizes(&self) -> f32x8 {
        (1..D).fold(self.hi[0] - self.lo[0], |sum, k| sum + (self.hi[k] - self.lo[k])).max(f32x8::ZERO)
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
pub(crate) struct Near<const D: usize> {
    pub lo: [f32; D],
    pub hi: [f32; D],
}

impl<const D: usize> Near<D> {
    pub(crate) fn new(b: &Aabb<D>) -> Self {
        Self { lo: b.lo.map(below), hi: b.hi.map(above) }
    }

    /// The sum of the sides.
    fn size(&self) -> f32 {
        (0..D).map(|k| self.hi[k] - self.lo[k]).sum()
    }
}

/// An `f32` that is not above x, and x itself where it is one. Without a branch: half of all numbers are rounded up.
fn below(x: f64) -> f32 {
    let near = x as f32;
    let lower = near - near.abs() * f32::EPSILON - f32::MIN_POSITIVE;
    if f64::from(near) > x { lower.min(f32::MAX) } else { near }
}

fn above(x: f64) -> f32 {
    -below(-x)
}

/// The numbers of the bits that are set, ascending.
pub(crate) fn bits_of(bits: impl Into<u64>) -> impl Iterator<Item = usize> {
    let mut bits = bits.into();
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
    /// The boxes of each level by blocks of eight. Level 0 holds the leaves'; a box of level k + 1 encloses a block of
    /// level k.
    blocks: Vec<Vec<Block<D>>>,
    /// The group that everything under a node belongs to, or `NO_GROUP`; empty when there are no groups.
    groups: Vec<Vec<u32>>,
    /// The order along the curve, when it is not that of the leaves.
    order: Option<CurveOrder>,
}

/// The order of items along a curve.
#[derive(Debug)]
struct CurveOrder {
    /// The place of each item.
    ranks: Vec<u32>,
    /// The item at each place.
    items: Vec<u32>,
}

impl CurveOrder {
    /// Pairs of items in the order of their first one, then the other; each with the smaller item first.
    fn sorted(&self, pairs: &[[u32; 2]]) -> Vec<[u32; 2]> {
        let bits = usize::BITS - self.items.len().leading_zeros();
        let numbers = parallel::map_light(pairs.len(), |i| {
            let [a, b] = pairs[i].map(|item| u64::from(self.ranks[item as usize]));
            a.min(b) << bits | a.max(b)
        });
        let sorted = sorted_numbers(&numbers, 2 * bits, |_| ());
        parallel::map_light(sorted.len(), |i| {
            let places = [sorted[i] >> bits, sorted[i] & ((1 << bits) - 1)];
            let [a, b] = places.map(|place| self.items[place as usize]);
            [a.min(b), a.max(b)]
        })
    }
}

/// The order of boxes along a curve through another one, and the boxes in 32 bits.
fn along_curve<const D: usize>(
    all: &Aabb<D>,
    n: usize,
    box_of: impl Fn(u32) -> Aabb<D> + Sync + Send,
) -> (Vec<u32>, Vec<Near<D>>) {
    let curve = Curve::through(all);
    let (upper, near): (Vec<u64>, Vec<Near<D>>) = parallel::unzip_light(n, |i| {
        let b = box_of(i as u32);
        (curve.upper(&b, i as u32), Near::new(&b))
    });
    (curve.sorted(&upper, box_of), near)
}

/// Items in the given order, but each group where its first item is, and the order that they had; none when there are no
/// groups. O(n).
fn side_by_side(
    items: Vec<u32>,
    group_of: impl Fn(u32) -> u32 + Sync + Send,
) -> (Vec<u32>, Option<CurveOrder>) {
    let groups = parallel::map_light(items.len(), |i| group_of(items[i]));
    let Some(&last) = groups.iter().filter(|&&group| group != NO_GROUP).max() else {
        return (items, None);
    };
    let ranks = || {
        let mut ranks = vec![0; items.len()];
        items.iter().zip(0..).for_each(|(&item, rank)| ranks[item as usize] = rank);
        ranks
    };
    let layout = || {
        let mut place_of_group = vec![None; last as usize + 1];
        let mut n = 0;
        let placed = items.iter().zip(&groups).map(|(&item, &group)| {
            let known = if group == NO_GROUP { &mut None } else { &mut place_of_group[group as usize] };
            let place = *known.get_or_insert(n);
            n += u32::from(place == n);
            (place, item)
        });
        let placed: Vec<(u32, u32)> = placed.collect();
        let (_, sorted) = sorted_by_place(n as usize, &placed, |placed| placed.0 as usize);
        parallel::map_light(sorted.len(), |i| sorted[i].1)
    };
    let (layout, ranks) = parallel::join(layout, ranks);
    (layout, Some(CurveOrder { ranks, items }))
}

/// A node: its level, and its number there.
type Node = (usize, usize);

impl<const D: usize> BoxTree<D> {
    /// O(n log n).
    pub(crate) fn new(boxes: &[Aabb<D>]) -> Self {
        Self::within(&hull(boxes.len(), |i| boxes[i as usize]), boxes.len(), |i| boxes[i as usize])
    }

    /// A tree of n boxes that all lie in another one. O(n log n).
    pub(crate) fn within(all: &Aabb<D>, n: usize, box_of: impl Fn(u32) -> Aabb<D> + Sync + Send) -> Self {
        let (items, near) = along_curve(all, n, box_of);
        Self::of_near(items, |i| near[i as usize])
    }

    /// The same with some items in groups: those of one are side by side, and no pairs.
    pub(crate) fn grouped(
        all: &Aabb<D>,
        n: usize,
        box_of: impl Fn(u32) -> Aabb<D> + Sync + Send,
        group_of: impl Fn(u32) -> u32 + Sync + Send,
    ) -> Self {
        let (items, near) = along_curve(all, n, box_of);
        let (layout, order) = side_by_side(items, &group_of);
        Self { order, ..Self::of_near(layout, |i| near[i as usize]).with_groups(group_of) }
    }

    /// A tree with its leaves in a given order. O(n).
    pub(crate) fn over(items: Vec<u32>, box_of: impl Fn(u32) -> Aabb<D> + Sync + Send) -> Self {
        Self::of_near(items, |i| Near::new(&box_of(i)))
    }

    fn of_near(items: Vec<u32>, box_of: impl Fn(u32) -> Near<D> + Sync + Send) -> Self {
        let leaves = parallel::map_light(items.len().div_ceil(WIDTH), |i| {
            Block::of(items[i * WIDTH..].iter().map(|&item| box_of(item)))
        });
        let mut blocks = vec![leaves];
        while let Some(below) = blocks.last().filter(|level| level.len() > 1) {
            let level = parallel::map_light(below.len().div_ceil(WIDTH), |i| {
                Block::of(below[i * WIDTH..].iter().map(Block::hull))
            });
            blocks.push(level);
        }
        Self { items, blocks, groups: Vec::new(), order: None }
    }

    /// The tree with some items in groups: pairs of one group need not be visited, and whole subtrees of them are
    /// passed over.
    pub(crate) fn with_groups(mut self, group_of: impl Fn(u32) -> u32 + Sync + Send) -> Self {
        let same = |c: &[u32]| if c.iter().all(|&g| g == c[0]) { c[0] } else { NO_GROUP };
        self.groups = vec![parallel::map_light(self.items.len(), |leaf| group_of(self.items[leaf]))];
        for k in 1..=self.blocks.len() {
            let below = &self.groups[k - 1];
            let (n_nodes, range) = parallel::chunks(below.len(), WIDTH);
            let level = parallel::map_light(n_nodes, |node| same(&below[range(node)]));
            self.groups.push(level);
        }
        self
    }

    /// The number of nodes of a level; level 0 are the leaves.
    fn n_nodes(&self, level: usize) -> usize {
        if level == 0 { self.items.len() } else { self.blocks[level - 1].len() }
    }

    /// The box of a node.
    fn near(&self, (level, i): Node) -> Near<D> {
        self.blocks
            .get(level)
            .map_or_else(|| self.blocks[level - 1][i].hull(), |b| b[i / WIDTH].at(i % WIDTH))
    }

    /// Whether all leaves under a node are of one group.
    fn is_within(&self, group: u32, level: usize, i: usize) -> bool {
        group != NO_GROUP && self.groups[level][i] == group
    }

    /// The group that all leaves under a node belong to.
    fn group_of(&self, level: usize, i: usize) -> u32 {
        self.groups.get(level).map_or(NO_GROUP, |level| level[i])
    }

    /// The items in the order of the leaves.
    pub(crate) fn items(&self) -> &[u32] {
        &self.items
    }

    /// Calls `visit` with each item whose box meets `target` up to rounding.
    pub(crate) fn query(&self, target: &Aabb<D>, mut visit: impl FnMut(u32)) {
        self.leaves(&Near::new(target), 0, NO_GROUP, &mut |leaf| visit(self.items[leaf]));
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
        let near = Near::new(target);
        let mut heap = BinaryHeap::new();
        let add = |heap: &mut BinaryHeap<Reach>, bound: f64, level: usize, block: usize| {
            let children = &self.blocks[level][block];
            for bit in bits_of(children.meeting(&near)) {
                let x = f64::from(children.hi[0].as_array()[bit]);
                if x >= bound {
                    heap.push(Reach { x, level, i: block * WIDTH + bit });
                }
            }
        };
        let top = self.blocks.len() - 1;
        if !self.items.is_empty() {
            add(&mut heap, bound, top, 0);
        }
        while let Some(Reach { x, level, i }) = heap.pop() {
            if x < bound {
                return;
            }
            if level == 0 {
                bound = visit(self.items[i], bound);
            } else {
                add(&mut heap, bound, level - 1, i);
            }
        }
    }

    /// Calls `visit` with each leaf at or after `first` whose box meets `near` and that is not of a group.
    fn leaves(&self, near: &Near<D>, first: usize, group: u32, visit: &mut impl FnMut(usize)) {
        if self.items.is_empty() {
            return;
        }
        // At most seven nodes of each level wait while their sister is searched.
        let mut stack: Vec<Node> = Vec::with_capacity(WIDTH * self.blocks.len());
        stack.push((self.blocks.len(), 0));
        while let Some((level, i)) = stack.pop() {
            let below = level - 1;
            // A subtree whose last leaf comes before `first` is of no use.
            let from = first / WIDTH.pow(below as u32);
            let children = bits_of(self.blocks[below][i].meeting(near)).map(|bit| i * WIDTH + bit);
            let wanted = children.filter(|&c| from <= c && !self.is_within(group, below, c));
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

    /// Calls `visit` with each pair of items whose boxes meet up to rounding, one in the block, the other after it in
    /// the tree's order. Over all blocks every pair comes once; pairs of one group may be left out.
    pub(crate) fn pairs_of_block(&self, block: usize, mut visit: impl FnMut(u32, u32)) {
        let hull = self.near((1, block));
        self.leaves(&hull, block * WIDTH, self.group_of(1, block), &mut |other| {
            self.pairs_with(block, u8::MAX, other, &mut |[a, b]| visit(self.items[a], self.items[b]));
        });
    }

    /// The pairs of a leaf with some of a block, as bits, that come before it, as leaves.
    fn pairs_with(&self, block: usize, of: u8, other: usize, visit: &mut impl FnMut([usize; 2])) {
        let from = block * WIDTH;
        let before = if other < from + WIDTH { (1 << (other - from)) - 1 } else { u8::MAX };
        for bit in bits_of(self.blocks[0][block].meeting(&self.near((0, other))) & before & of) {
            visit([from + bit, other]);
        }
    }

    /// All pairs of items whose boxes meet up to rounding and for which `is_wanted` holds, each once, the smaller first;
    /// pairs of one group may be left out. `is_wanted` is told the items and, of each, how large it is; `keeps_off` is asked
    /// whether an item that is [large](LARGE) beside a box is in no wanted pair with what is in that. O(n log n + pairs).
    pub(crate) fn pairs(
        &self,
        course: &Course,
        is_wanted: impl Fn([u32; 2], [f32; 2]) -> bool + Sync + Send,
        keeps_off: impl Fn(u32, &Near<D>) -> bool + Sync + Send,
    ) -> Result<Vec<[u32; 2]>, Cancelled> {
        let giants = self.giants();
        // Of each of two blocks the giants that keep off all of the other.
        let kept_off = |blocks: [usize; 2]| {
            [0, 1].map(|i| {
                let target = self.near((1, blocks[1 - i]));
                let is_off = |bit: &usize| {
                    let leaf = blocks[i] * WIDTH + bit;
                    self.near((0, leaf)).size() > LARGE * target.size()
                        && keeps_off(self.items[leaf], &target)
                };
                bits_of(giants[blocks[i]]).filter(is_off).fold(0, |bits, bit| bits | 1 << bit)
            })
        };
        // Nodes that hold some hundred leaves, or fewer in a small tree.
        let level = (self.blocks.len() - 1).clamp(1, 3);
        let parts = course.map(self.n_nodes(level), |i| {
            let mut blocks = Vec::new();
            self.meeting_blocks((level, i), (self.blocks.len(), 0), &mut blocks);
            if self.order.is_none() {
                blocks.sort_unstable();
            }
            let mut found = Vec::new();
            for [this, other] in blocks.into_iter().take_while(|_| !course.is_cancelled()) {
                let blocks = [this as usize, other as usize];
                let off = if giants.is_empty() { [0; 2] } else { kept_off(blocks) };
                self.pairs_of_blocks(blocks, off, &mut |pair| {
                    let [i, j] = pair.map(|leaf| self.items[leaf]);
                    if is_wanted([i, j], pair.map(|leaf| self.near((0, leaf)).size())) {
                        found.push([i.min(j), i.max(j)]);
                    }
                });
            }
            found
        })?;
        let pairs = parallel::concat(&parts);
        // What is found of groups, and which items are there besides, shows in no result.
        Ok(match &self.order {
            Some(order) => order.sorted(&pairs),
            None => pairs,
        })
    }

    /// The pairs of two blocks, or of one, as leaves; `off` are those of each, as bits, that need not be looked at.
    fn pairs_of_blocks(&self, [block, other]: [usize; 2], off: [u8; 2], visit: &mut impl FnMut([usize; 2])) {
        let hull = self.near((1, block));
        let group = self.group_of(1, block);
        for bit in bits_of(self.blocks[0][other].meeting(&hull) & !off[1]) {
            let leaf = other * WIDTH + bit;
            if !self.is_within(group, 0, leaf) {
                self.pairs_with(block, !off[0], leaf, visit);
            }
        }
    }

    /// The leaves of each block, as bits, that are large beside what is large beside the mean, as only few can be; empty when there are none. O(n).
    fn giants(&self) -> Vec<u8> {
        let sizes = parallel::map_light(self.blocks[0].len(), |block| self.blocks[0][block].sizes());
        let mean = sizes.iter().map(|sizes| sizes.reduce_add()).sum::<f32>() / self.items.len() as f32;
        let limit = f32x8::splat(LARGE * LARGE * mean);
        let giants = parallel::map_light(sizes.len(), |block| sizes[block].simd_gt(limit).to_bitmask() as u8);
        if giants.iter().all(|&bits| bits == 0) { Vec::new() } else { giants }
    }

    /// The pairs of a block under `this` with itself or one after it under `other` that are not of one group: `other` is
    /// above `this`, or as high and not before it.
    fn meeting_blocks(&self, this: Node, other: Node, found: &mut Vec<[u32; 2]>) {
        let group = self.group_of(this.0, this.1);
        if self.is_within(group, other.0, other.1) {
            return;
        }
        if this.0 < other.0 {
            let below = other.0 - 1;
            let near = self.near(this);
            // What ends before `this` begins has been paired with it.
            let from = this.1 / WIDTH.pow((below - this.0) as u32);
            for bit in bits_of(self.blocks[below][other.1].meeting(&near)) {
                let child = other.1 * WIDTH + bit;
                if child >= from {
                    self.meeting_blocks(this, (below, child), found);
                }
            }
        } else if this.0 <= 1 {
            found.push([this.1 as u32, other.1 as u32]);
        } else {
            let below = this.0 - 1;
            let children = this.1 * WIDTH..((this.1 + 1) * WIDTH).min(self.n_nodes(below));
            let wanted = self.blocks[below][this.1].meeting(&self.near(other));
            for child in bits_of(wanted).map(|bit| children.start + bit) {
                self.meeting_blocks((below, child), other, found);
            }
        }
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
            let mut found = tree.pairs(&Course::new(Control::default(), &[]), |_, _| true, |_, _| false).unwrap();
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
