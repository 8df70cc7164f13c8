//! A balanced tree of tight boxes over fixed points, some of them active: "is any active point in this triangle?"
//!
//! A grid would do for well spread corners, but not for the long rows of collinear ones that combs leave: each ear
//! over such a row would look at all of it. Here a box is skipped as soon as it lies outside one side of the
//! triangle (decided exactly), or has no active point.

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

/// True when the box lies strictly on the outer side of one edge of the triangle.
fn is_outside([a, b, c]: [Xy; 3], [low, high]: [Xy; 2]) -> bool {
    [(a, b), (b, c), (c, a)].into_iter().any(|(s, t)| {
        // The corner of the box that lies furthest to the left of s–t.
        let x = if t[1] < s[1] { high[0] } else { low[0] };
        let y = if s[0] < t[0] { high[1] } else { low[1] };
        orient(s, t, [x, y]) < 0.0
    })
}
