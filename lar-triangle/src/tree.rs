//! A balanced tree of tight boxes over fixed points, some of them active: "is any active point in this triangle?"
//!
//! A grid would do for well spread corners, but not for the long rows of collinear ones that combs leave: each ear
//! over such a row would look at all of it. Here a box is skipped as soon as a side separates it from the
//! triangle (decided exactly), or it has no active point.

use crate::predicates::{Xy, orient};

/// Points in a leaf.
const LEAF: usize = 8;

/// The tree; node 1 is the root, node i has the children 2i and 2i + 1, the leaves are `leaves..2 * leaves`.
#[derive(Debug, Default)]
pub(crate) struct Tree {
    leaves: usize,
    boxes: Vec<[Xy; 2]>,
    active: Vec<u32>,
    order: Vec<u32>,
    leaf_of: Vec<u32>,
    stack: Vec<usize>,
}

impl Tree {
    /// Builds the tree over points, none of them active; O(n log n).
    pub(crate) fn fill(&mut self, xy: &[Xy]) {
        let n = xy.len();
        self.leaves = n.div_ceil(LEAF).next_power_of_two();
        self.order.clear();
        self.order.extend((0u32..).take(n));
        self.boxes.clear();
        self.boxes.resize(2 * self.leaves, [[f64::MAX; 2], [f64::MIN; 2]]);
        self.active.clear();
        self.active.resize(2 * self.leaves, 0);
        self.leaf_of.clear();
        self.leaf_of.resize(n, 0);
        for node in 1..2 * self.leaves {
            let range = self.range(node, n);
            let part = &mut self.order[range.clone()];
            for &i in part.iter() {
                let ([low, high], p) = (&mut self.boxes[node], xy[i as usize]);
                *low = [low[0].min(p[0]), low[1].min(p[1])];
                *high = [high[0].max(p[0]), high[1].max(p[1])];
            }
            if node < self.leaves {
                let [low, high] = self.boxes[node];
                let axis = usize::from(high[0] - low[0] < high[1] - low[1]);
                let half = self.range(2 * node, n).len();
                if half < self.order[range.clone()].len() {
                    self.order[range].select_nth_unstable_by(half, |&i, &j| {
                        xy[i as usize][axis].total_cmp(&xy[j as usize][axis]).then(i.cmp(&j))
                    });
                }
            } else {
                for &i in part.iter() {
                    self.leaf_of[i as usize] = node as u32;
                }
            }
        }
    }

    /// Makes a point active or inactive; it must not have been so.
    pub(crate) fn set(&mut self, point: u32, active: bool) {
        let mut node = self.leaf_of[point as usize] as usize;
        while node > 0 {
            self.active[node] = if active { self.active[node] + 1 } else { self.active[node] - 1 };
            node /= 2;
        }
    }

    /// A point of a leaf that the counter-clockwise triangle may meet, for which `found` holds.
    pub(crate) fn find(&mut self, triangle: [Xy; 3], found: impl Fn(&u32) -> bool) -> Option<u32> {
        self.stack.clear();
        self.stack.push(1);
        while let Some(node) = self.stack.pop() {
            if self.active[node] == 0 || is_outside(triangle, self.boxes[node]) {
                continue;
            }
            if node < self.leaves {
                self.stack.extend([2 * node + 1, 2 * node]);
            } else {
                let range = self.range(node, self.leaf_of.len());
                if let Some(&point) = self.order[range].iter().find(|i| found(i)) {
                    return Some(point);
                }
            }
        }
        None
    }

    /// The places in `order` of the points below a node.
    fn range(&self, node: usize, n: usize) -> std::ops::Range<usize> {
        let level = node.ilog2();
        let width = self.leaves >> level;
        let first = (node - (1 << level)) * width;
        first * n / self.leaves..(first + width) * n / self.leaves
    }
}

/// True when the box and the counter-clockwise triangle have no common point: a side of one of them separates
/// them. Exact.
fn is_outside([a, b, c]: [Xy; 3], [low, high]: [Xy; 2]) -> bool {
    let beside = |k: usize| a[k].max(b[k]).max(c[k]) < low[k] || high[k] < a[k].min(b[k]).min(c[k]);
    beside(0)
        || beside(1)
        || [(a, b), (b, c), (c, a)].into_iter().any(|(s, t)| {
            // The corner of the box that lies furthest to the left of s–t.
            let x = if t[1] < s[1] { high[0] } else { low[0] };
            let y = if s[0] < t[0] { high[1] } else { low[1] };
            orient(s, t, [x, y]) < 0.0
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicates::in_closed_triangle;

    #[test]
    fn finds_what_a_search_of_all_points_finds() {
        let lattice = |i: u32| [f64::from(i * 37 % 23), f64::from(i * 11 % 19)];
        for n in [1, 7, 8, 9, 100, 437] {
            let xy: Vec<Xy> = (0..n).map(lattice).collect();
            let mut tree = Tree::default();
            tree.fill(&xy);
            let active: Vec<u32> = (0..n).filter(|i| i % 3 == 0).collect();
            active.iter().for_each(|&i| tree.set(i, true));
            for t in 0..200 {
                let mut triangle = [lattice(t), lattice(5 * t + 1), lattice(7 * t + 3)];
                if orient(triangle[0], triangle[1], triangle[2]) < 0.0 {
                    triangle.swap(0, 1);
                }
                let inside = |&i: &u32| i % 3 == 0 && in_closed_triangle(triangle, xy[i as usize]);
                let expected = active.iter().any(inside);
                assert_eq!(tree.find(triangle, inside).is_some(), expected, "{triangle:?} of {n}");
            }
            active.iter().for_each(|&i| tree.set(i, false));
            assert_eq!(tree.find([[-99., -99.], [99., -99.], [0., 99.]], |_| true), None);
        }
    }
}
