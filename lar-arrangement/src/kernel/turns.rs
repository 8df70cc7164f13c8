//! Three points seen along an axis: which way they turn, and whether one is between the others.

use super::Sign;
use super::geometry::{Geometry, ROUNDING};
use super::point::HPointOf;
use super::predicates::{Along, sign_within};

/// An input point seen along a coordinate axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub p: u32,
    at: [f64; 2],
    /// Whether that is exact, as of a point of the grid.
    is_exact: bool,
}

impl Seen {
    /// Orientation of a → b → c, where it is beyond doubt.
    #[inline(always)]
    fn turn([a, b, c]: [&Self; 3]) -> Option<Sign> {
        let d = [b.at[0] - a.at[0], b.at[1] - a.at[1], c.at[0] - a.at[0], c.at[1] - a.at[1]];
        let (left, right) = (d[0] * d[3], d[1] * d[2]);
        let magnitude = left.abs() + right.abs();
        let slack = if a.is_exact && b.is_exact && c.is_exact {
            // Differences of 42 bits are exact, and a product is zero only with a factor.
            0.0
        } else {
            // Each difference is off by two positions and its own rounding, at most 2^-11.
            (d.iter().map(|x| x.abs()).sum::<f64>() + 1.0) * 4.0 * ROUNDING
        };
        sign_within(left - right, slack + magnitude * 2f64.powi(-50))
    }

    /// For a point on the line of an edge, whose ends are seen in two places: whether it lies strictly between them, where that
    /// is beyond doubt.
    fn is_inside(&self, [a, b]: [&Self; 2]) -> Option<bool> {
        let bounds = |k: usize| (a.at[k].min(b.at[k]), a.at[k].max(b.at[k]));
        // Rounding is monotone: a point outside of the rounded box is outside of the exact one.
        let is_beyond = |k: usize| self.at[k] < bounds(k).0 || bounds(k).1 < self.at[k];
        if is_beyond(0) || is_beyond(1) {
            return Some(false);
        }
        // So does a place strictly between others.
        let k = usize::from((b.at[1] - a.at[1]).abs() > (b.at[0] - a.at[0]).abs());
        if bounds(k).0 < self.at[k] && self.at[k] < bounds(k).1 {
            return Some(true);
        }
        // In the place of an end.
        (a.is_exact && b.is_exact && self.is_exact).then_some(false)
    }
}

impl Geometry {
    /// A point as it is seen along an axis.
    #[inline]
    pub(crate) fn seen_along(&self, p: u32, axis: usize) -> Seen {
        let position = self.position(p);
        let at = [position[(axis + 1) % 3], position[(axis + 2) % 3]];
        Seen { p, at, is_exact: self.grid_point(p).is_some() }
    }

    /// Orientation of a → b → p seen along −axis.
    pub(crate) fn turn_to(&self, ends: [u32; 2], p: u32, axis: usize) -> Sign {
        let ([a, b], c) = (ends.map(|p| self.seen_along(p, axis)), self.seen_along(p, axis));
        Seen::turn([&a, &b, &c]).unwrap_or_else(|| self.turn_exactly(ends, p, axis))
    }

    /// Orientation of a → b → p, all in the plane of a facet, seen along −axis.
    #[inline(always)]
    pub(crate) fn turn_in_plane(&self, facet: u32, [a, b, c]: [&Seen; 3], axis: usize) -> Sign {
        Seen::turn([a, b, c]).unwrap_or_else(|| self.turn_in_plane_exactly(facet, [a.p, b.p], c.p, axis))
    }

    fn turn_in_plane_exactly(&self, facet: u32, ends: [u32; 2], p: u32, axis: usize) -> Sign {
        if ends.contains(&p) {
            return Sign::Zero;
        }
        // On another shared plane through both ends.
        let is_beside = |plane: u32| {
            let other = self.first_on_plane(plane);
            self.is_defined_on(p, plane) && other.is_some_and(|other| self.is_across(other, facet))
        };
        let is_on_edge = self.planes_of_edge(ends).any(is_beside);
        if is_on_edge { Sign::Zero } else { self.turn_exactly(ends, p, axis) }
    }

    /// For a point on the line of an edge, all in a plane that is not parallel to the axis: whether it lies inside the edge.
    pub(crate) fn is_inside_edge(&self, [a, b]: [&Seen; 2], point: &Seen) -> bool {
        let (ends, p) = ([a.p, b.p], point.p);
        !ends.contains(&p) && point.is_inside([a, b]).unwrap_or_else(|| self.is_inside_exactly(ends, p))
    }

    fn is_inside_exactly(&self, ends: [u32; 2], p: u32) -> bool {
        let (axis, sign) = self.axis_of(&self.direction(Along::Edge(ends)));
        let [low, high] = if sign == Sign::Positive { ends } else { [ends[1], ends[0]] };
        self.cmp_points(low, p, axis).is_lt() && self.cmp_points(p, high, axis).is_lt()
    }

    fn turn_exactly(&self, ends: [u32; 2], p: u32, axis: usize) -> Sign {
        self.counters.count();
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        if let ([Some(a), Some(b)], Some(p)) = (ends.map(|p| self.grid_point(p)), self.grid_point(p)) {
            // Products of two differences of 42 bits.
            let product = |x: i64, y: i64| i128::from(x) * i128::from(y);
            let left = product(b[u] - a[u], p[v] - a[v]);
            return left.cmp(&product(b[v] - a[v], p[u] - a[u])).into();
        }
        // Coordinates of 166 bits, denominators of 124.
        let ([a, b], c) = (ends.map(|p| self.wide_point::<8>(p)), self.wide_point::<8>(p));
        let minor = |p: &HPointOf<8>, q: &HPointOf<8>| p.x[u] * q.x[v] - p.x[v] * q.x[u];
        (minor(&a, &b) * c.w + minor(&b, &c) * a.w + minor(&c, &a) * b.w).sign()
    }
}
