//! Which way three points turn, seen along an axis.

use super::Sign;
use super::geometry::{Geometry, ROUNDING};
use super::point::HPointOf;
use super::predicates::sign_of;

/// An input point seen along a coordinate axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    p: u32,
    at: [f64; 2],
    /// Whether that is exact, as of a point of the grid.
    is_exact: bool,
}

impl Seen {
    /// Orientation of a → b → c, where it is beyond doubt.
    #[inline]
    fn turn([a, b, c]: [&Self; 3]) -> Option<Sign> {
        let d = [b.at[0] - a.at[0], b.at[1] - a.at[1], c.at[0] - a.at[0], c.at[1] - a.at[1]];
        let (left, right) = (d[0] * d[3], d[1] * d[2]);
        let magnitude = left.abs() + right.abs();
        let slack = if a.is_exact && b.is_exact && c.is_exact {
            // Differences of 42 bits are exact, and a product is zero only with a factor.
            if magnitude == 0.0 {
                return Some(Sign::Zero);
            }
            0.0
        } else {
            // Each difference is off by two positions and its own rounding, at most 2^-11.
            (d.iter().map(|x| x.abs()).sum::<f64>() + 1.0) * 4.0 * ROUNDING
        };
        let decides = (left - right).abs() > slack + magnitude * 2f64.powi(-50);
        decides.then(|| sign_of(left - right))
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
    #[inline]
    pub(crate) fn turn_in_plane(&self, facet: u32, [a, b, c]: [&Seen; 3], axis: usize) -> Sign {
        Seen::turn([a, b, c]).unwrap_or_else(|| self.turn_in_plane_exactly(facet, [a.p, b.p], c.p, axis))
    }

    fn turn_in_plane_exactly(&self, facet: u32, ends: [u32; 2], p: u32, axis: usize) -> Sign {
        // On another shared plane through both ends.
        let is_beside = |plane: u32| {
            let other = self.first_on_plane(plane);
            self.is_defined_on(p, plane) && other.is_some_and(|other| self.is_across(other, facet))
        };
        let is_on_edge = self.planes_of_edge(ends).any(is_beside);
        if is_on_edge { Sign::Zero } else { self.turn_exactly(ends, p, axis) }
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
