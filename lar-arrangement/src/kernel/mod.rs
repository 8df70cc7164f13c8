//! The exact kernel: fixed-width integers, planes, homogeneous points, filtered predicates.
//!
//! Every predicate is first tried in `f64` with a bound on its error; what the bound cannot decide goes at once to
//! fixed-width integers. Nothing here has an epsilon: constants are error bounds, derived where they stand.
//!
//! Bit budget, for grid coordinates |x| ≤ 2^40 (b = 40). Every quantity is affine in each single coordinate of the
//! input, so the first eight of the grid are largest at the corners of the cube |x| ≤ 2^40, where a test finds these
//! maxima; the others are bounded by sums of their products. *Canonical* operands are also planes with coefficients of
//! 41 bits and edges between points on three of them, *mixed* ones also planes through such points. Such a point alone
//! is smaller than one on three planes of the grid.
//!
//! | quantity | grid | canonical | mixed |
//! |---|---|---|---|
//! | difference of coordinates, times denominators | 42 | 291 | 291 |
//! | input point: coordinates, denominator | 41, 1 | 166, 124 | 166, 124 |
//! | component of a facet's normal | 83 | 83 | 459 |
//! | offset of a facet's plane, side of a grid point | 125 | 125 | 501 |
//! | plane through an edge along an axis: normal, offset | 42, 83 | 415, 458 | 415, 458 |
//! | line ∩ plane: coordinates, denominator | 165, 125 | 751, 709 | 794, 752 |
//! | direction of the line of two facet planes | 166 | 166 | 919 |
//! | three planes: coordinates, denominator | 289, 249 | 289, 249 | 1422, 1380 |
//! | side of such a point against a plane | 373 | 1169 | 1883 |
//! | order of two of them along an axis | 538 | 1460 | 2802 |
//! | orientation of three of them in a projection | 827 | 2214 | 4227 |
//! | the same with the midpoint of two of them | 1076 | 2924 | 5608 |
//! | two of them, order of hits of a ray from their midpoint | 708 | 1629 | 3723 |

mod approx;
#[cfg(test)]
mod budget;
mod definition;
mod double;
mod exact;
mod geometry;
mod int;
mod point;
mod predicates;
#[cfg(test)]
mod tests;
mod turns;

pub(crate) use double::Fraction;
pub(crate) use geometry::{CanonicalPoints, Geometry, RationalPoint, Support, Vertex, VertexDef, to_f64};
pub(crate) use int::Int;
pub(crate) use point::{Plane, dominant_axis, rounded_quotient};
pub(crate) use predicates::{Along, Direction, Midpoint, Side, Spot, Way, crossing_near};
pub(crate) use turns::Seen;

/// The sign of an exact quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(i8)]
pub(crate) enum Sign {
    /// Below zero.
    Negative = -1,
    /// Exactly zero.
    Zero = 0,
    /// Above zero.
    Positive = 1,
}

impl Sign {
    /// The sign of the product.
    #[must_use]
    pub(crate) fn times(self, other: Sign) -> Sign {
        Sign::from(self as i8 * other as i8)
    }
}

impl From<i8> for Sign {
    fn from(x: i8) -> Self {
        match x.cmp(&0) {
            std::cmp::Ordering::Less => Sign::Negative,
            std::cmp::Ordering::Equal => Sign::Zero,
            std::cmp::Ordering::Greater => Sign::Positive,
        }
    }
}

impl From<i128> for Sign {
    fn from(x: i128) -> Self {
        Sign::from(x.signum() as i8)
    }
}

impl From<std::cmp::Ordering> for Sign {
    fn from(order: std::cmp::Ordering) -> Self {
        Sign::from(order as i8)
    }
}

impl std::ops::Neg for Sign {
    type Output = Sign;

    fn neg(self) -> Sign {
        Sign::from(-(self as i8))
    }
}
