//! Points and polygons.

use super::{Location, Point2, on_segment, side};

/// Where a point lies with respect to a polygon with holes, given by its loops in any order and orientation:
/// inside when a ray crosses the loops an odd number of times, on the boundary when it lies on an edge. Loops
/// may touch and cross; the same edge twice divides nothing but is boundary. Coordinates must be finite;
/// exact while products of their differences neither overflow nor underflow. O(n).
///
/// ```
/// use lar_core::{Location, locate_in_polygon};
/// let square = vec![[0., 0.], [4., 0.], [4., 4.], [0., 4.]];
/// let hole = vec![[1., 1.], [1., 3.], [3., 2.]];
/// let at = |p| locate_in_polygon(p, [&square, &hole]);
/// assert_eq!(at([0.5, 1.]), Location::Inside);
/// assert_eq!(at([1., 2.]), Location::Boundary);
/// assert_eq!(at([2., 2.]), Location::Outside);
/// ```
#[doc(alias = "pointInPolygonClassification")]
#[doc(alias = "pointInPolygon")]
#[must_use]
pub fn locate_in_polygon<L: AsRef<[Point2]>>(point: Point2, loops: impl IntoIterator<Item = L>) -> Location {
    let mut inside = false;
    for cycle in loops {
        let cycle = cycle.as_ref();
        let Some(&last) = cycle.last() else { continue };
        let mut from = last;
        for &to in cycle {
            if on_segment(from, to, point) {
                return Location::Boundary;
            }
            inside ^= crosses_above(from, to, point);
            from = to;
        }
    }
    if inside { Location::Inside } else { Location::Outside }
}

/// True when the segment passes above the point moved by (ε, ε²): its ends lie on different sides of the
/// vertical line through it, one end on the line counting as left of it.
fn crosses_above(a: Point2, b: Point2, p: Point2) -> bool {
    let (a_left, b_left) = (a[0] <= p[0], b[0] <= p[0]);
    match (a_left, b_left) {
        (true, false) => side(a, b, p) < 0,
        (false, true) => side(b, a, p) < 0,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(loops: &[&[Point2]], point: Point2, expected: Location) {
        assert_eq!(locate_in_polygon(point, loops), expected);
        for (turned, p) in [(quarter as fn(Point2) -> Point2, quarter(point)), (mirror, mirror(point))] {
            let moved: Vec<Vec<Point2>> =
                loops.iter().map(|l| l.iter().rev().map(|&q| turned(q)).collect()).collect();
            assert_eq!(locate_in_polygon(p, &moved), expected);
        }
    }

    fn quarter([x, y]: Point2) -> Point2 {
        [-y, x]
    }

    fn mirror([x, y]: Point2) -> Point2 {
        [-x, y]
    }

    /// ```text
    ///   4 +-------------+
    ///     |  +---+      |      the ray up from (2, ·) runs along an edge of the hole,
    ///     |  |   |   /\ |      the one from (5, ·) meets only the tip
    ///   1 |  +---+  /--\|
    ///   0 +-------------+
    ///     0  1   2  4   6
    /// ```
    #[test]
    fn rays_through_vertices_and_along_edges() {
        let outer = [[0., 0.], [6., 0.], [6., 4.], [0., 4.]];
        let hole = [[1., 1.], [1., 3.], [2., 3.], [2., 1.]];
        let tip = [[4., 1.], [5., 2.], [6., 1.]];
        let loops: [&[Point2]; 3] = [&outer, &hole, &tip];
        check(&loops, [2., 0.5], Location::Inside);
        check(&loops, [2., 3.5], Location::Inside);
        check(&loops, [2., 2.], Location::Boundary);
        check(&loops, [1.5, 2.], Location::Outside);
        check(&loops, [5., 0.5], Location::Inside);
        check(&loops, [5., 1.5], Location::Outside);
        check(&loops, [5., 2.], Location::Boundary);
        check(&loops, [6., 1.], Location::Boundary);
        check(&loops, [6., 5.], Location::Outside);
        check(&loops, [0., -1.], Location::Outside);
        check(&loops, [-1., 0.], Location::Outside);
        check(&loops, [3., 1.], Location::Inside);
        check(&loops, [0., 0.], Location::Boundary);
    }

    #[test]
    fn degenerate_loops() {
        check(&[], [0., 0.], Location::Outside);
        check(&[&[]], [0., 0.], Location::Outside);
        check(&[&[[0., 0.]]], [0., 0.], Location::Boundary);
        check(&[&[[0., 0.], [2., 2.]]], [1., 1.], Location::Boundary);
        check(&[&[[0., 0.], [2., 2.]]], [1., 0.5], Location::Outside);
        let spike = [[0., 0.], [2., 0.], [2., 2.], [2., 5.], [2., 2.], [0., 2.]];
        check(&[&spike], [1., 1.], Location::Inside);
        check(&[&spike], [2., 4.], Location::Boundary);
        check(&[&spike], [1., 4.], Location::Outside);
    }

    #[test]
    fn one_unit_in_the_last_place_decides() {
        let third = 1. / 3_f64;
        let triangle = [[0., 0.], [3., 1.], [0., 1.]];
        let above = third.next_up();
        check(&[&triangle], [1., above], Location::Inside);
        // The nearest number to 1/3 lies below it.
        check(&[&triangle], [1., third], Location::Outside);
        let exact = [[0., 0.], [4., 1.], [0., 1.]];
        check(&[&exact], [1., 0.25], Location::Boundary);
        check(&[&exact], [1., 0.25_f64.next_down()], Location::Outside);
        check(&[&exact], [1., 0.25_f64.next_up()], Location::Inside);
    }

    proptest! {
        /// Small integers: most points are degenerate. Checked against integer arithmetic on a ray upward from
        /// half a step to the right, on coordinates scaled so that nothing meets it.
        #[test]
        fn agrees_with_integers(
            corners in prop::collection::vec((0..5_i64, 0..5_i64), 1..9),
            (px, py) in (0..5_i64, 0..5_i64),
        ) {
            let ends = || corners.iter().zip(corners.iter().cycle().skip(1));
            let turn = |a: &(i64, i64), b: &(i64, i64), x: i64, y: i64| (b.0 - a.0) * (y - a.1) - (b.1 - a.1) * (x - a.0);
            let on = ends().any(|(a, b)| turn(a, b, px, py) == 0
                && a.0.min(b.0) <= px && px <= a.0.max(b.0) && a.1.min(b.1) <= py && py <= a.1.max(b.1));
            const K: i64 = 1000;
            let (x, y) = (K * px + 20, K * py + 1);
            let scaled = |a: &(i64, i64)| (K * a.0, K * a.1);
            let crossings = ends().filter(|&(a, b)| {
                let (a, b) = (scaled(a), scaled(b));
                let (l, r) = if a.0 < b.0 { (a, b) } else { (b, a) };
                l.0 < x && x < r.0 && turn(&l, &r, x, y) < 0
            });
            let expected = if on { Location::Boundary } else if crossings.count() % 2 == 1 { Location::Inside } else { Location::Outside };
            let polygon: Vec<Point2> = corners.iter().map(|&(x, y)| [x as f64, y as f64]).collect();
            prop_assert_eq!(locate_in_polygon([px as f64, py as f64], [polygon]), expected);
        }
    }
}
