//! Triangles on the screen in a tree of boxes, asked which of them hide a segment, and where.

use super::SLACK;
use super::project::{Seen, clip_polygon};

/// Triangles of less area are seen edge-on and hide nothing, in square pixels.
const SMALLEST: f64 = 1e-9;
/// Two triangles overlap when they share more than this area, in square pixels.
const SHARED: f64 = 1e-3;
/// Triangles hide this far beyond their sides, in pixels, so that lines exactly behind the side between two triangles do
/// not show through.
const BORDER: f64 = 1e-6;
/// Triangles in a leaf.
const LEAF: usize = 8;

/// A triangle on the screen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Counter-clockwise.
    corners: [Seen; 3],
    /// q = plane · (x, y, 1).
    plane: [f64; 3],
    /// What part of the ink behind it is seen.
    through: f64,
}

impl Triangle {
    /// `None` when it is seen edge-on.
    pub(super) fn new([a, b, c]: [Seen; 3], through: f64) -> Option<Self> {
        let ([bx, by, bq], [cx, cy, cq]) = (difference(b, a), difference(c, a));
        let area = bx * cy - by * cx;
        if area.is_nan() || area.abs() < SMALLEST {
            return None;
        }
        let slope = [(bq * cy - cq * by) / area, (cq * bx - bq * cx) / area];
        let plane = [slope[0], slope[1], a.q - slope[0] * a.x - slope[1] * a.y];
        let corners = if 0.0 < area { [a, b, c] } else { [a, c, b] };
        Some(Self { corners, plane, through })
    }

    /// Counter-clockwise.
    pub(super) fn corners(&self) -> [[f64; 2]; 3] {
        self.corners.map(Seen::screen)
    }

    /// The nearness of its plane at a place on the screen.
    pub(super) fn nearness(&self, [x, y]: [f64; 2]) -> f64 {
        self.plane[0] * x + self.plane[1] * y + self.plane[2]
    }

    /// A place on the screen inside of both triangles; `None` where they share no area.
    pub(super) fn place_in_both(&self, other: &Self) -> Option<[f64; 2]> {
        let mut shared: Vec<[f64; 3]> = self.corners.iter().map(|s| [s.x, s.y, 0.0]).collect();
        for i in 0..3 {
            let (p, q) = (other.corners[i], other.corners[(i + 1) % 3]);
            shared = clip_polygon(&shared, |s| (q.y - p.y) * (s[0] - p.x) - (q.x - p.x) * (s[1] - p.y));
            if shared.len() < 3 {
                return None;
            }
        }
        let n = shared.len();
        let twice = |i: usize| {
            let (s, t) = (shared[i], shared[(i + 1) % n]);
            s[0] * t[1] - s[1] * t[0]
        };
        let area = 0.5 * (0..n).map(twice).sum::<f64>();
        let middle = |k: usize| shared.iter().map(|s| s[k]).sum::<f64>() / n as f64;
        (SHARED < area).then(|| [middle(0), middle(1)])
    }

    /// Where the segment from `a` to `b` is behind the triangle, as an interval of 0 to 1; for a point (`a` = `b`) the
    /// whole of it or nothing.
    fn hides(&self, a: Seen, b: Seen) -> Option<[f64; 2]> {
        let mut interval = [0.0, 1.0];
        for i in 0..3 {
            let (p, q) = (self.corners[i], self.corners[(i + 1) % 3]);
            let (dx, dy) = (q.x - p.x, q.y - p.y);
            let side = |s: Seen| dx * (s.y - p.y) - dy * (s.x - p.x) + BORDER * dx.hypot(dy);
            interval = above(interval, side(a), side(b))?;
        }
        let slack = SLACK * (1.0 + a.q.abs().max(b.q.abs()));
        let before = |s: Seen| self.plane[0] * s.x + self.plane[1] * s.y + self.plane[2] - s.q - slack;
        above(interval, before(a), before(b))
    }
}

fn difference(a: Seen, b: Seen) -> [f64; 3] {
    [a.x - b.x, a.y - b.y, a.q - b.q]
}

/// The part of an interval where the function that is `at_0` at 0 and `at_1` at 1, affine between, is positive.
fn above([from, to]: [f64; 2], at_0: f64, at_1: f64) -> Option<[f64; 2]> {
    let root = at_0 / (at_0 - at_1);
    let interval = match (0.0 < at_0, 0.0 < at_1) {
        (true, true) => [from, to],
        (false, false) => return None,
        (true, false) => [from, to.min(root)],
        (false, true) => [from.max(root), to],
    };
    (interval[0] < interval[1]).then_some(interval)
}

/// Lower and upper corner on the screen, and the greatest nearness.
#[derive(Clone, Copy, Debug)]
struct Reach {
    lo: [f64; 2],
    hi: [f64; 2],
    nearest: f64,
}

impl Reach {
    fn of(corners: &[Seen]) -> Self {
        let fold =
            |f: fn(f64, f64) -> f64, of: fn(&Seen) -> f64| corners.iter().map(of).fold(of(&corners[0]), f);
        Self {
            lo: [fold(f64::min, |s| s.x), fold(f64::min, |s| s.y)],
            hi: [fold(f64::max, |s| s.x), fold(f64::max, |s| s.y)],
            nearest: fold(f64::max, |s| s.q),
        }
    }

    fn union(self, other: Self) -> Self {
        Self {
            lo: [0, 1].map(|k| self.lo[k].min(other.lo[k])),
            hi: [0, 1].map(|k| self.hi[k].max(other.hi[k])),
            nearest: self.nearest.max(other.nearest),
        }
    }

    /// Whether the segment meets the box and is not wholly before it.
    fn may_hide(&self, a: Seen, b: Seen) -> bool {
        if self.nearest <= a.q.min(b.q) {
            return false;
        }
        let mut interval = [0.0_f64, 1.0_f64];
        for (from, to, lo, hi) in [(a.x, b.x, self.lo[0], self.hi[0]), (a.y, b.y, self.lo[1], self.hi[1])] {
            let along = to - from;
            if along == 0.0 {
                if from < lo || hi < from {
                    return false;
                }
                continue;
            }
            let ends = [(lo - from) / along, (hi - from) / along];
            interval = [interval[0].max(ends[0].min(ends[1])), interval[1].min(ends[0].max(ends[1]))];
        }
        interval[0] <= interval[1]
    }
}

/// A node: a leaf has triangles, an inner node two children, the first right behind it.
#[derive(Clone, Copy, Debug)]
struct Node {
    reach: Reach,
    first: usize,
    n: usize,
    second_child: usize,
}

/// Triangles, halved again and again along the longer side of their boxes.
pub(super) struct Tree {
    triangles: Vec<Triangle>,
    nodes: Vec<Node>,
}

impl Tree {
    /// O(n log² n): each level is sorted.
    pub(super) fn new(triangles: Vec<Triangle>) -> Self {
        let mut tree = Self { triangles, nodes: Vec::new() };
        if !tree.triangles.is_empty() {
            tree.build(0, tree.triangles.len());
        }
        tree
    }

    fn build(&mut self, first: usize, n: usize) -> usize {
        let part = &mut self.triangles[first..first + n];
        let reach =
            part.iter().map(|t| Reach::of(&t.corners)).reduce(Reach::union).expect("parts are not empty");
        let index = self.nodes.len();
        self.nodes.push(Node { reach, first, n, second_child: 0 });
        if LEAF < n {
            let axis = usize::from(reach.hi[0] - reach.lo[0] < reach.hi[1] - reach.lo[1]);
            let middle = |t: &Triangle| t.corners.iter().map(|s| s.screen()[axis]).sum::<f64>();
            part.sort_by(|a, b| middle(a).total_cmp(&middle(b)));
            self.build(first, n / 2);
            self.nodes[index].second_child = self.build(first + n / 2, n - n / 2);
        }
        index
    }

    /// The intervals of the segment from `a` to `b` that triangles lie before, in no order, and what each lets through.
    pub(super) fn before(&self, a: Seen, b: Seen) -> Vec<([f64; 2], f64)> {
        let mut found = Vec::new();
        let mut stack: Vec<usize> = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(index) = stack.pop() {
            let node = self.nodes[index];
            if !node.reach.may_hide(a, b) {
                continue;
            }
            if node.n <= LEAF {
                let leaf = &self.triangles[node.first..node.first + node.n];
                found.extend(leaf.iter().filter_map(|t| Some((t.hides(a, b)?, t.through))));
            } else {
                stack.extend([index + 1, node.second_child]);
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn seen(x: f64, y: f64, q: f64) -> Seen {
        Seen { x, y, q }
    }

    #[track_caller]
    fn check(a: Seen, b: Seen, expected: Option<[f64; 2]>) {
        let triangle = Triangle::new([seen(0., 0., 1.), seen(4., 0., 1.), seen(0., 4., 1.)], 0.0).unwrap();
        let found = triangle.hides(a, b);
        let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).abs() < 1e-5 && (b - d).abs() < 1e-5;
        assert!(found.zip(expected).map_or(found == expected, |(f, e)| near(f, e)), "{found:?}");
    }

    #[test]
    fn a_triangle_hides_what_is_behind_it() {
        check(seen(-2., 1., 0.), seen(6., 1., 0.), Some([0.25, 0.625]));
        check(seen(-2., 1., 2.), seen(6., 1., 2.), None);
        check(seen(-2., 1., 1.), seen(6., 1., 1.), None);
        check(seen(1., 1., 2.), seen(2., 1., 0.), Some([0.5, 1.0]));
        check(seen(5., 5., 0.), seen(6., 1., 0.), None);
        check(seen(1., 1., 0.), seen(1., 1., 0.), Some([0.0, 1.0]));
        assert!(Triangle::new([seen(0., 0., 1.), seen(1., 1., 2.), seen(2., 2., 0.)], 0.0).is_none());
    }

    proptest! {
        /// The tree finds what all triangles, one by one, find.
        #[test]
        fn the_tree_misses_nothing(
            corners in prop::collection::vec(prop::array::uniform3(prop::array::uniform3(-9.0..9.0_f64)), 0..60),
            ends in prop::array::uniform2(prop::array::uniform3(-9.0..9.0_f64)),
        ) {
            let point = |[x, y, q]: [f64; 3]| seen(x, y, q);
            let triangles: Vec<Triangle> = corners.iter().filter_map(|c| Triangle::new(c.map(point), 0.5)).collect();
            let [a, b] = ends.map(point);
            let order = |mut found: Vec<([f64; 2], f64)>| {
                found.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
                found
            };
            let one_by_one = triangles.iter().filter_map(|t| Some((t.hides(a, b)?, 0.5))).collect();
            prop_assert_eq!(order(Tree::new(triangles.clone()).before(a, b)), order(one_by_one));
        }
    }
}
