//! Points along a carrier: their approximate and their exact places.

use crate::kernel::{Int, to_f64};
use crate::planar::carriers::{Carriers, cross};
use std::cmp::Ordering;

/// p + d · t with |p|, |d| ≤ 2^41, t a quotient of two rounded integers: relative error of t below 2^-51, so
/// 2^-10 for the product, and 2^-12 for its rounding and that of the sum.
pub(crate) const KEY_ERROR: f64 = 1.0 / 512.0;

pub(crate) fn long_axis(direction: [i64; 2]) -> usize {
    usize::from(direction[1].abs() > direction[0].abs())
}

/// Approximate coordinate of the point where a carrier's sides to another one's line change from a to b.
pub(crate) fn key(start: [i64; 2], direction: [i64; 2], a: i128, b: i128) -> f64 {
    let axis = long_axis(direction);
    let t = to_f64(a) / to_f64(a - b);
    start[axis] as f64 + direction[axis] as f64 * t
}

/// The exact place of a point along a carrier: a + d · num / den with den > 0, all along the carrier's longer axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Along {
    start: i64,
    direction: i64,
    num: i128,
    den: i128,
}

impl Along {
    /// A grid point on the carrier.
    pub(crate) fn point(carriers: &Carriers, carrier: u32, p: u32) -> Self {
        let axis = long_axis(carriers.direction(carrier));
        Self { start: carriers.points[p as usize][axis], direction: 0, num: 0, den: 1 }
    }

    /// The crossing with another carrier.
    pub(crate) fn crossing(carriers: &Carriers, carrier: u32, other: u32) -> Self {
        let direction = carriers.direction(carrier);
        let axis = long_axis(direction);
        let (num, den) = parameter(carriers, carrier, other);
        Self { start: carriers.at(carrier)[0][axis], direction: direction[axis], num, den }
    }

    /// Order of two points of one carrier. The coordinates differ by d · (num / den − num' / den') when both are
    /// crossings; a grid point's coordinate is an integer.
    pub(crate) fn cmp(&self, other: &Self) -> Ordering {
        match (self.direction, other.direction) {
            (0, 0) => self.start.cmp(&other.start),
            (0, _) => other.cmp(self).reverse(),
            (_, 0) => {
                // 41 + 84 bits.
                let offset = i128::from(other.start - self.start);
                (i128::from(self.direction) * self.num).cmp(&(offset * self.den))
            }
            (d, _) => {
                let product = |a: i128, b: i128| Int::<3>::from(a) * Int::from(b);
                let order = product(self.num, other.den).cmp(&product(other.num, self.den));
                if d < 0 { order.reverse() } else { order }
            }
        }
    }
}

/// Where a carrier crosses another's line, as a fraction num / den of its length, den > 0. At most 84 bits each.
pub(crate) fn parameter(carriers: &Carriers, carrier: u32, other: u32) -> (i128, i128) {
    let ([p, q], [r, _]) = (carriers.at(carrier), carriers.at(other));
    let direction = carriers.direction(other);
    let side = |x: [i64; 2]| cross(direction, [x[0] - r[0], x[1] - r[1]]);
    let (a, b) = (side(p), side(q));
    if a > b { (a, a - b) } else { (-a, b - a) }
}
