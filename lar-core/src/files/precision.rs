//! What the coordinates of a file are worth.
//!
//! A plane through three corners of a part that was printed with six digits is not the plane that was meant.
//! Whoever decides which facets were meant to be coplanar has to know how coarsely the coordinates were
//! rounded; the reader is the last to see it.

/// How coordinates were written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Precision {
    /// 32-bit numbers, 24 significant bits.
    F32,
    /// 64-bit numbers, or text of 16 digits or more.
    F64,
    /// Decimal text.
    Decimal {
        /// The most digits that any coordinate was printed with, leading zeros not counted.
        significant: u32,
        /// The place of the finest digit printed, as a power of ten: −6 for 0.123456, 0 for 12.
        last_place: i32,
    },
}

impl Precision {
    /// How far a coordinate may lie from what was meant: half a unit in the last place of a coordinate of
    /// magnitude `size`. For text it is a bound, reached when all coordinates were cut to that many digits; a
    /// file of few short numbers, like 0.5, may well mean them exactly.
    ///
    /// ```
    /// use lar_core::Precision;
    /// assert_eq!(Precision::F32.rounding_error(1.), 2_f64.powi(-24));
    /// let text = Precision::Decimal { significant: 6, last_place: -4 };
    /// assert!((text.rounding_error(10.) - 5e-5).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn rounding_error(self, size: f64) -> f64 {
        let size = size.abs();
        match self {
            Self::F32 => size * 2_f64.powi(-24),
            Self::F64 => size * 2_f64.powi(-53),
            Self::Decimal { significant, last_place } => {
                let leading = if size > 0. { size.log10().floor() } else { f64::from(last_place) };
                let place = (leading + 1. - f64::from(significant)).max(f64::from(last_place));
                0.5 * 10_f64.powf(place)
            }
        }
    }
}

/// Collects the digits of the coordinates of a text.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Digits {
    significant: u32,
    last_place: Option<i32>,
}

impl Digits {
    /// Notes a number in decimal notation.
    pub(crate) fn note(&mut self, word: &str) {
        let (mantissa, exponent) = word.split_once(['e', 'E']).unwrap_or((word, "0"));
        let exponent: i32 = exponent.parse().unwrap_or(0);
        let (mut significant, mut decimals, mut after_point) = (0_u32, 0_i32, false);
        for byte in mantissa.bytes() {
            match byte {
                b'.' => after_point = true,
                b'0'..=b'9' => {
                    decimals = decimals.saturating_add(i32::from(after_point));
                    significant += u32::from(significant > 0 || byte != b'0');
                }
                _ => {}
            }
        }
        let place = exponent.saturating_sub(decimals);
        self.significant = self.significant.max(significant);
        self.last_place = Some(self.last_place.map_or(place, |least| least.min(place)));
    }

    /// The precision of all numbers noted; text that has the digits of a 64-bit number is one.
    pub(crate) fn precision(self) -> Precision {
        match self.last_place {
            Some(last_place) if self.significant < 16 => {
                Precision::Decimal { significant: self.significant, last_place }
            }
            _ => Precision::F64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(words: &[&str], significant: u32, last_place: i32) {
        let mut digits = Digits::default();
        words.iter().for_each(|word| digits.note(word));
        assert_eq!(digits.precision(), Precision::Decimal { significant, last_place });
    }

    #[test]
    fn digits() {
        check(&["0", "-12"], 2, 0);
        check(&["0.000", "1.5"], 2, -3);
        check(&["-1.50e-3"], 3, -5);
        check(&["1.25E+2", "300"], 3, 0);
        check(&["0.00012"], 2, -5);
        check(&[".5", "5."], 1, -1);
        check(&["1e99999999999"], 1, 0);
        let mut full = Digits::default();
        full.note("0.1234567890123456");
        assert_eq!(full.precision(), Precision::F64);
        assert_eq!(Digits::default().precision(), Precision::F64);
    }

    #[track_caller]
    fn check_error(precision: Precision, size: f64, expected: f64) {
        let found = precision.rounding_error(size);
        assert!((found - expected).abs() <= 1e-12 * expected, "{found} ≠ {expected}");
    }

    #[test]
    fn errors() {
        let six = Precision::Decimal { significant: 6, last_place: -9 };
        check_error(six, 123.456, 5e-4);
        check_error(six, -0.00123456, 5e-9);
        check_error(six, 1e-20, 5e-10);
        check_error(six, 0., 5e-10);
        check_error(Precision::F64, 2., 2_f64.powi(-52));
        check_error(Precision::F32, -8., 2_f64.powi(-21));
    }
}
