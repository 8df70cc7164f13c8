//! Stage 1a: the integer grid that input coordinates are snapped to, once.
//!
//! The grid's step is a power of two chosen so that every |coordinate| / step ≤ 2^40. Its origin is 0 unless the
//! model lies far from it, so that integers, dyadic fractions and 32-bit floats near the origin's scale are kept
//! exactly; everything else moves by at most half a step.

/// Coordinates on the grid stay within ±2^BITS.
pub(crate) const BITS: i32 = 40;

/// The grid's origin lies within 2^OFFSET_BITS steps of 0.
const OFFSET_BITS: i32 = 94;

/// A power-of-two grid fitted to a bounding box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    /// Exponent of the step.
    exponent: i32,
    /// A multiple of the step for each axis.
    origin: [f64; 3],
    /// Two factors that make steps of a length, and two that make a length of steps.
    down: [f64; 2],
    up: [f64; 2],
}

/// A model is recentred on an axis when the far end of its box is more than this many extents from 0: until then
/// the grid loses at most three of its forty bits to the distance.
const FAR: f64 = 8.0;

impl Grid {
    /// The finest grid that holds the box.
    pub(crate) fn fitted(lo: [f64; 3], hi: [f64; 3]) -> Self {
        let extent = (0..3).map(|k| hi[k] / 2.0 - lo[k] / 2.0).fold(0.0, f64::max);
        let mut origin = [0.0; 3];
        for k in 0..3 {
            if lo[k].abs().max(hi[k].abs()) / FAR > extent {
                origin[k] = lo[k] / 2.0 + hi[k] / 2.0;
            }
        }
        let reach =
            |o: [f64; 3]| (0..3).map(|k| (hi[k] - o[k]).abs().max((lo[k] - o[k]).abs())).fold(0.0, f64::max);
        // Neighbouring f64 are 2^-53 of their size apart: a finer step than 2^-40 of that has no use, and the origin
        // stays below 2^OFFSET_BITS steps.
        let finest = exponent_above(reach([0.0; 3])) - OFFSET_BITS;
        let exponent = (exponent_above(reach(origin)) - BITS).max(finest);
        let mut grid = Self { exponent, origin: [0.0; 3], down: factors(-exponent), up: factors(exponent) };
        for (at, o) in grid.origin.iter_mut().zip(origin) {
            *at = scaled(scaled(o, -exponent).round(), exponent);
        }
        grid
    }

    /// Distance of neighbouring grid points.
    pub(crate) fn step(&self) -> f64 {
        scaled(1.0, self.exponent)
    }

    /// The point of the input's space that has the coordinates 0 on the grid.
    pub(crate) fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// Exponent of the step.
    pub(crate) fn exponent(&self) -> i32 {
        self.exponent
    }

    /// The nearest grid point.
    pub(crate) fn snap<const N: usize>(&self, p: [f64; N]) -> [i64; N] {
        std::array::from_fn(|k| nearest((p[k] - self.origin[k]) * self.down[0] * self.down[1]))
    }

    /// The origin in steps; all zero for most models.
    pub(crate) fn offset(&self) -> [i128; 3] {
        self.origin.map(|o| scaled(o, -self.exponent) as i128)
    }

    /// The larger of a step and of what separates neighbouring `f64` at the model's distance from 0, in steps:
    /// far from 0 the input itself is coarser than the grid.
    pub(crate) fn coarseness(&self) -> f64 {
        let farthest = self.origin.map(|o| scaled(o.abs(), -self.exponent)).into_iter().fold(0.0, f64::max);
        (farthest * f64::EPSILON).max(1.0)
    }

    /// A coordinate in steps from 0 as a length. Exact unless the result is subnormal, or was rounded up beyond the
    /// largest number, which it then is.
    pub(crate) fn length(&self, steps: f64) -> f64 {
        (steps * self.up[0] * self.up[1]).clamp(f64::MIN, f64::MAX)
    }
}

/// The smallest e with |x| < 2^e − a grid step's worth, at least −1000 so that steps stay normal numbers.
fn exponent_above(x: f64) -> i32 {
    let bits = x.to_bits();
    let e = (bits >> 52 & 0x7ff) as i32 - 1022;
    // A fraction of all ones would round up to 2^e.
    let full = bits & 0x000f_ffff_ffff_ffff > 0x000f_ffff_ffff_ffff - (1 << 14);
    (e + i32::from(full)).max(-960)
}

/// x · 2^e in two steps, so that neither factor overflows.
fn scaled(x: f64, e: i32) -> f64 {
    let [a, b] = factors(e);
    x * a * b
}

/// Two factors of 2^e.
fn factors(e: i32) -> [f64; 2] {
    let half = e / 2;
    [2f64.powi(half), 2f64.powi(e - half)]
}

/// The nearest integer, of two the one farther from zero: `f64::round` without a call of a function. Adding almost one
/// half never rounds across an integer that is not reached.
fn nearest(x: f64) -> i64 {
    const ALMOST_HALF: f64 = 0.5 - f64::EPSILON / 4.0;
    (x + ALMOST_HALF.copysign(x)) as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(lo: [f64; 3], hi: [f64; 3]) -> Grid {
        let grid = Grid::fitted(lo, hi);
        for p in [lo, hi] {
            let snapped = grid.snap(p);
            for k in 0..3 {
                assert!(snapped[k].abs() <= 1 << BITS, "{lo:?} {hi:?}: {snapped:?} leaves the grid");
                let back = grid.length((i128::from(snapped[k]) + grid.offset()[k]) as f64);
                assert!((back - p[k]).abs() <= grid.step() / 2.0, "{} comes back as {back}", p[k]);
            }
        }
        grid
    }

    #[test]
    fn grids_hold_their_boxes() {
        check([0.0; 3], [1.0; 3]);
        check([-0.3, 0.1, 0.7], [1.3, 1.9, 1.0]);
        check([1e8, -1e8, 0.0], [1e8 + 1.0, -1e8 + 2.0, 1.0]);
        check([1e300; 3], [1.1e300; 3]);
        check([-1e308; 3], [1.7e308; 3]);
        check([1e-300; 3], [2e-300; 3]);
        check([0.0; 3], [0.0; 3]);
        check([5.0; 3], [5.0; 3]);
        check([f64::MIN_POSITIVE; 3], [f64::MIN_POSITIVE * 3.0; 3]);
    }

    #[test]
    fn far_from_zero_the_input_is_coarser_than_the_grid() {
        assert_eq!(check([-1.0; 3], [1.0; 3]).coarseness(), 1.0);
        let far = check([1e6, 0.0, 0.0], [1e6 + 2.0, 2.0, 2.0]);
        assert!(far.coarseness() * far.step() <= 1e6 * f64::EPSILON * 1.01);
        assert!(far.coarseness() > 50.0);
    }

    #[test]
    fn dyadic_coordinates_are_kept_exactly() {
        let grid = check([-3.0; 3], [5.0; 3]);
        let p = [0.25, -1.0 / 1024.0, 4.625];
        let back = grid.snap(p).map(|x| grid.length(x as f64));
        assert_eq!(back, p);
    }

    #[test]
    fn the_nearest_integer_is_that_of_the_standard_library() {
        for i in 0..4000 {
            let x = f64::from(i) / 8.0;
            let large = x + (1i64 << 50) as f64;
            for x in [x, x.next_up(), x.next_down(), large, large.next_up(), large.next_down()] {
                assert_eq!([nearest(x), nearest(-x)], [x.round() as i64, -x.round() as i64], "{x}");
            }
        }
    }
}
