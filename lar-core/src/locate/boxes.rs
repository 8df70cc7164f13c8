//! Boxes in the plane by the points that they hold.

/// Lower and upper corner.
pub(super) type Box2 = [[f64; 2]; 2];

/// A balanced tree over boxes: a range of boxes is split at the median along its longer side, and `bounds`
/// keeps the box around each range, in the order in which the ranges are split.
pub(super) struct BoxTree {
    /// Indices of the boxes, ordered so that each node owns a range.
    order: Vec<u32>,
    boxes: Vec<Box2>,
    nodes: Vec<Tree>,
}

struct Tree {
    around: Box2,
    start: u32,
    end: u32,
    /// The second child, the first stands right behind its parent; 0 for a leaf.
    second: u32,
}

const LEAF: usize = 8;

impl BoxTree {
    /// O(n log n).
    pub(super) fn new(boxes: Vec<Box2>) -> Self {
        let n = u32::try_from(boxes.len()).expect("fewer than 2^32 boxes");
        let mut tree = Self { order: (0..n).collect(), boxes, nodes: Vec::new() };
        if n > 0 {
            tree.split(0, n as usize);
        }
        tree
    }

    /// Calls `found` with the index of each box that holds the point. O(log n + found) for boxes that overlap
    /// little.
    pub(super) fn holding(&self, point: [f64; 2], mut found: impl FnMut(usize)) {
        let mut stack = if self.nodes.is_empty() { vec![] } else { vec![0] };
        while let Some(at) = stack.pop() {
            let node: &Tree = &self.nodes[at];
            if !holds(&node.around, point) {
                continue;
            }
            if node.second == 0 {
                let range = &self.order[node.start as usize..node.end as usize];
                let holding = range.iter().map(|&i| i as usize).filter(|&i| holds(&self.boxes[i], point));
                holding.for_each(&mut found);
            } else {
                stack.extend([node.second as usize, at + 1]);
            }
        }
    }

    /// The depth is the logarithm of the number of boxes: each split halves.
    fn split(&mut self, start: usize, end: usize) {
        let around = self.around(start, end);
        let node = self.nodes.len();
        self.nodes.push(Tree { around, start: start as u32, end: end as u32, second: 0 });
        if end - start <= LEAF {
            return;
        }
        let axis = usize::from(around[1][1] - around[0][1] > around[1][0] - around[0][0]);
        let middle = usize::midpoint(start, end);
        let boxes = &self.boxes;
        let centre = |&i: &u32| boxes[i as usize][0][axis] / 2. + boxes[i as usize][1][axis] / 2.;
        self.order[start..end]
            .select_nth_unstable_by(middle - start, |a, b| centre(a).total_cmp(&centre(b)).then(a.cmp(b)));
        self.split(start, middle);
        self.nodes[node].second = self.nodes.len() as u32;
        self.split(middle, end);
    }

    fn around(&self, start: usize, end: usize) -> Box2 {
        let mut around = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for &i in &self.order[start..end] {
            let [lo, hi] = self.boxes[i as usize];
            for k in 0..2 {
                around[0][k] = around[0][k].min(lo[k]);
                around[1][k] = around[1][k].max(hi[k]);
            }
        }
        around
    }
}

fn holds([lo, hi]: &Box2, p: [f64; 2]) -> bool {
    lo[0] <= p[0] && p[0] <= hi[0] && lo[1] <= p[1] && p[1] <= hi[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn finds_what_brute_force_finds(
            corners in prop::collection::vec(prop::array::uniform4(0..9_u8), 0..60),
            point in prop::array::uniform2(0..9_u8),
        ) {
            let boxes: Vec<Box2> = corners.iter().map(|c| {
                let [a, b, c, d] = c.map(f64::from);
                [[a.min(c), b.min(d)], [a.max(c), b.max(d)]]
            }).collect();
            let point = point.map(f64::from);
            let expected: Vec<usize> = (0..boxes.len()).filter(|&i| holds(&boxes[i], point)).collect();
            let mut found = Vec::new();
            BoxTree::new(boxes).holding(point, |i| found.push(i));
            found.sort_unstable();
            prop_assert_eq!(found, expected);
        }
    }
}
