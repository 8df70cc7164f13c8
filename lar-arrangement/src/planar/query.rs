//! Exact positions of query points on the grid, and their places relative to vertices and carriers.
//!
//! Any finite `f64` is compared without rounding. In grid steps its coordinates are a whole number and a fraction
//! m / 2^k with |m| < 2^53, where k may reach two thousand; but from a certain size on k no longer decides a sign,
//! and is cut there, so that everything fits 320 bits.

use crate::grid::Grid;
use crate::kernel::Int;
use crate::planar::carriers::{Carriers, cross};
use std::cmp::Ordering;

/// whole + mantissa / 2^shift grid steps.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Coordinate {
    whole: i64,
    /// Below 2^53, of the sign of the coordinate.
    mantissa: i64,
    shift: u32,
}

impl Coordinate {
    /// Exactly x, which lies within the box that the grid was fitted to.
    fn new(x: f64, exponent: i32, offset: i128) -> Self {
        let bits = x.to_bits();
        let biased = (bits >> 52 & 0x7ff) as i32;
        let fraction = (bits & 0x000f_ffff_ffff_ffff) as i128;
        // Subnormal numbers have the exponent of the smallest normal ones and no leading one.
        let magnitude = if biased == 0 { fraction } else { fraction | 1 << 52 };
        let mantissa = if x < 0.0 { -magnitude } else { magnitude };
        let shift = exponent - (biased.max(1) - 1075);
        if shift <= 0 {
            let whole = (mantissa << -shift) - offset;
            return Self { whole: whole as i64, mantissa: 0, shift: 0 };
        }
        let whole = if shift < 64 { mantissa / (1 << shift) } else { 0 };
        let rest = if shift < 64 { mantissa - (whole << shift) } else { mantissa };
        let shift = if rest == 0 { 0 } else { shift as u32 };
        Self { whole: (whole - offset) as i64, mantissa: rest as i64, shift }
    }
}

/// A point to be located, within the box of the drawing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Query {
    /// Rounded position in the drawing's unit.
    pub point: [f64; 2],
    exact: [Coordinate; 2],
}

impl Query {
    pub(super) fn new(point: [f64; 2], grid: &Grid) -> Self {
        let offset = grid.offset();
        let exact = [0, 1].map(|k| Coordinate::new(point[k], grid.exponent(), offset[k]));
        Self { point, exact }
    }

    /// A grid point.
    pub(super) fn on_grid(whole: [i64; 2], grid: &Grid) -> Self {
        let offset = grid.offset();
        let point = [0, 1].map(|k| grid.length((i128::from(whole[k]) + offset[k]) as f64));
        Self { point, exact: whole.map(|whole| Coordinate { whole, mantissa: 0, shift: 0 }) }
    }

    /// Order along an axis of the point and a vertex with coordinates position / w.
    pub(super) fn cmp_exactly(&self, (position, w): ([Int<3>; 2], i128), axis: usize) -> Ordering {
        let Coordinate { whole, mantissa, shift } = self.exact[axis];
        // |mantissa · w| < 2^137: beyond a shift of 140 only its sign counts.
        let shift = shift.min(140);
        let whole = Int::<5>::from(whole) * Int::from(w) - position[axis].resize();
        (whole.shifted(shift) + Int::from(mantissa) * Int::from(w)).cmp(&Int::ZERO)
    }

    /// `Greater` when the point lies left of a carrier's direction, `Less` when right of it, `Equal` on its line.
    pub(super) fn side_of(&self, carriers: &Carriers, carrier: u32) -> Ordering {
        let ([p, _], d) = (carriers.at(carrier), carriers.direction(carrier));
        let [x, y] = self.exact;
        let whole = cross(d, [x.whole - p[0], y.whole - p[1]]);
        if x.mantissa == 0 && y.mantissa == 0 {
            return whole.cmp(&0);
        }
        // Fractions below one step: they change the product by less than this.
        if whole.abs() > i128::from(d[0]) + i128::from(d[1].abs()) {
            return whole.cmp(&0);
        }
        let a = i128::from(d[0]) * i128::from(y.mantissa);
        let b = i128::from(d[1]) * i128::from(x.mantissa);
        let [ka, kb] = cut_shifts([(a, y.shift), (b, x.shift)]);
        let k = ka.max(kb);
        let sum =
            Int::<5>::from(whole).shifted(k) + Int::from(a).shifted(k - ka) - Int::from(b).shifted(k - kb);
        sum.cmp(&Int::ZERO)
    }
}

/// Shifts that leave the sign of an integer plus or minus a / 2^k plus or minus b / 2^l as it is, |a|, |b| < 2^95.
///
/// The integer with the larger term is a multiple of 2^-k: when l > k + 97 the other one is less than half of
/// that, so only its sign counts. When both are below a quarter only the sign of their sum counts.
fn cut_shifts(terms: [(i128, u32); 2]) -> [u32; 2] {
    let least = terms.iter().filter(|t| t.0 != 0).map(|t| t.1).min().unwrap_or(0);
    let excess = least.saturating_sub(97);
    terms.map(|(x, k)| if x == 0 { 0 } else { k.min(least + 97) - excess })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(x: f64, exponent: i32, offset: i128, expected: [i64; 3]) {
        let found = Coordinate::new(x, exponent, offset);
        assert_eq!([found.whole, found.mantissa, found.shift.into()], expected, "{x:e}");
    }

    #[test]
    fn coordinates_are_exact() {
        check(3.0, 0, 0, [3, 0, 0]);
        check(-3.0, -2, 5, [-17, 0, 0]);
        check(2.75, 0, 0, [2, 3 << 49, 51]);
        check(-2.75, 0, 1, [-3, -(3 << 49), 51]);
        check(f64::from_bits(1), 0, 0, [0, 1, 1074]);
        check(f64::from_bits(1), 900, 0, [0, 1, 1974]);
        check(-1.25 * 2f64.powi(990), 990, 0, [-1, -(1 << 50), 52]);
        check(-1.5 * 2f64.powi(992), 990, 1, [-7, 0, 0]);
        check(0.0, 3, 0, [0, 0, 0]);
    }

    /// Signs of w + a / 2^k − b / 2^l by shifts that are cut and by wide integers that are not.
    #[test]
    fn cut_shifts_keep_signs() {
        let values: [i128; 7] = [0, 1, -1, 1 << 94, -(1 << 94), (1 << 95) - 1, 1 - (1 << 95)];
        let shifts = [1, 50, 94, 95, 96, 97, 98, 150, 190, 191, 192, 193, 194, 195, 290, 400];
        for whole in [-1i128, 0, 1, 1 << 83] {
            for (a, b) in values.iter().flat_map(|&a| values.map(|b| (a, b))) {
                for (k, l) in shifts.iter().flat_map(|&k| shifts.map(|l| (k, l))) {
                    let sign = |[k, l]: [u32; 2]| {
                        let most = k.max(l);
                        let sum = Int::<10>::from(whole).shifted(most) + Int::from(a).shifted(most - k)
                            - Int::from(b).shifted(most - l);
                        sum.sign()
                    };
                    let cut = cut_shifts([(a, k), (b, l)]);
                    assert!(cut.iter().all(|&k| k <= 194));
                    assert_eq!(sign(cut), sign([k, l]), "{whole} {a} {k} {b} {l}");
                }
            }
        }
    }
}
