//! The point of a polygon with holes that is farthest from its sides, by a search through ever smaller squares: a square
//! holds no better point than its middle's distance plus half its diagonal (the pole of inaccessibility; Garcia-Castellanos
//! and Lombardo, Scottish Geographical Journal 123(3), 2007, search circles in the same way).

use lar_core::{Location, locate_in_polygon};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

type Point = [f64; 2];

/// The origin will do when its distance is this part of the radius of a disc of the polygon's area, beyond which none is.
const ROUND_ENOUGH: f64 = 0.6;
/// The origin will do when its distance is this part of the best.
const NEARLY_BEST: f64 = 0.8;
/// The search ends when nothing can be better by more than this part of the polygon's extent.
const PRECISION: f64 = 0.01;
/// Squares that are looked at, at most: what bounds the time for polygons like combs.
const PROBES: usize = 500;

/// A point far from the sides of loops, about the best there is; the origin, to be chosen as the centroid, where that is
/// good enough.
pub(super) fn deep_point(loops: &[Vec<Point>]) -> Point {
    let corners = || loops.iter().flatten();
    let low = corners().copied().reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1])]);
    let high = corners().copied().reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])]);
    let (Some(low), Some(high)) = (low, high) else { return [0.0; 2] };
    let at_origin = clearance(loops, [0.0; 2]);
    if ROUND_ENOUGH * (area(loops) / std::f64::consts::PI).sqrt() <= at_origin {
        return [0.0; 2];
    }
    let (best, distance) = search(loops, low, high, at_origin);
    if NEARLY_BEST * distance <= at_origin { [0.0; 2] } else { best }
}

fn search(loops: &[Vec<Point>], low: Point, high: Point, at_origin: f64) -> (Point, f64) {
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
    let mut best = ([0.0; 2], at_origin);
    let mut open = BinaryHeap::from([Square::new(loops, middle, 0.5 * size)]);
    for _ in 0..PROBES {
        let Some(square) = open.pop() else { break };
        if best.1 < square.distance {
            best = (square.middle, square.distance);
        }
        if square.most() <= best.1 + PRECISION * size {
            break;
        }
        let half = 0.5 * square.half;
        for [x, y] in [[-half, -half], [half, -half], [-half, half], [half, half]] {
            open.push(Square::new(loops, [square.middle[0] + x, square.middle[1] + y], half));
        }
    }
    best
}

/// A square, ordered by the most that any of its points may be away from the sides.
#[derive(Clone, Copy, Debug)]
struct Square {
    middle: Point,
    half: f64,
    distance: f64,
}

impl Square {
    fn new(loops: &[Vec<Point>], middle: Point, half: f64) -> Self {
        Self { middle, half, distance: clearance(loops, middle) }
    }

    fn most(&self) -> f64 {
        self.distance + std::f64::consts::SQRT_2 * self.half
    }
}

impl PartialEq for Square {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Square {}

impl PartialOrd for Square {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Square {
    /// By the most; then by place, so that equal ones come in one order.
    fn cmp(&self, other: &Self) -> Ordering {
        let place = |s: &Self| s.middle;
        let ([x, y], [u, v]) = (place(self), place(other));
        self.most().total_cmp(&other.most()).then(x.total_cmp(&u)).then(y.total_cmp(&v))
    }
}

/// Distance from the sides, negative outside.
fn clearance(loops: &[Vec<Point>], p: Point) -> f64 {
    let sides = loops.iter().flat_map(|l| l.iter().zip(l.iter().cycle().skip(1)));
    let distance = sides.map(|(a, b)| distance_to_side(*a, *b, p)).fold(f64::INFINITY, f64::min);
    if locate_in_polygon(p, loops) == Location::Inside { distance } else { -distance }
}

fn distance_to_side(a: Point, b: Point, p: Point) -> f64 {
    let ([dx, dy], [px, py]) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let squared = dx * dx + dy * dy;
    let t = if 0.0 < squared { ((px * dx + py * dy) / squared).clamp(0.0, 1.0) } else { 0.0 };
    (px - t * dx).hypot(py - t * dy)
}

/// Area of outer loops less that of holes, which run the other way.
fn area(loops: &[Vec<Point>]) -> f64 {
    let sides = loops.iter().flat_map(|l| l.iter().zip(l.iter().cycle().skip(1)));
    0.5 * sides.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn rectangle(low: Point, high: Point) -> Vec<Point> {
        vec![low, [high[0], low[1]], high, [low[0], high[1]]]
    }

    #[track_caller]
    fn check(loops: &[Vec<Point>], least: f64) {
        let p = deep_point(loops);
        assert!(least <= clearance(loops, p), "{p:?} is {} from the sides", clearance(loops, p));
    }

    #[test]
    fn the_centroid_of_what_is_round_enough() {
        assert_eq!(deep_point(&[rectangle([-1.0, -1.0], [1.0, 1.0])]), [0.0; 2]);
        assert_eq!(deep_point(&[rectangle([-9.0, -1.0], [9.0, 1.0])]), [0.0; 2], "no other is much better");
        assert_eq!(deep_point(&[vec![[-1.0, -1.0], [2.0, -1.0], [-1.0, 2.0]]]), [0.0; 2]);
        assert_eq!(deep_point(&[]), [0.0; 2]);
    }

    /// ```text
    /// ┌─────────┐   ┌───┐
    /// │  ┌───┐  │   │   │
    /// │  └───┘  │   │   └───────┐
    /// └─────────┘   └───────────┘
    /// ```
    #[test]
    fn rings_and_bent_faces() {
        let hole = |low, high| rectangle(low, high).into_iter().rev().collect::<Vec<_>>();
        check(&[rectangle([-3.0, -3.0], [3.0, 3.0]), hole([-1.0, -1.0], [1.0, 1.0])], 1.1);
        check(&[rectangle([-3.0, -3.0], [3.0, 3.0]), hole([-2.9, -2.9], [2.9, 2.9])], 0.04);
        check(&[vec![[-1., -1.], [9., -1.], [9., 0.], [1., 0.], [1., 4.], [-1., 4.]]], 0.95);
    }

    proptest! {
        /// Never much worse than any point of a fine grid.
        #[test]
        fn no_place_is_much_better(
            radii in prop::collection::vec(0.1..4.0_f64, 3..14),
            offset in prop::array::uniform2(-3.0..3.0_f64),
        ) {
            let n = radii.len() as f64;
            let corner = |(i, r): (usize, &f64)| {
                let (sin, cos) = (i as f64 * std::f64::consts::TAU / n).sin_cos();
                [r * cos + offset[0], r * sin + offset[1]]
            };
            let star = [radii.iter().enumerate().map(corner).collect::<Vec<_>>()];
            let found = clearance(&star, deep_point(&star));
            let grid = (0..400).map(|i| [f64::from(i % 20), f64::from(i / 20)].map(|x| 0.4 * x - 4.0));
            let best = grid.map(|p| clearance(&star, [p[0] + offset[0], p[1] + offset[1]])).fold(0.0, f64::max);
            prop_assert!(0.0 < found && NEARLY_BEST * best - 0.09 <= found, "{} against {}", found, best);
        }
    }
}
