//! What the coordinates of a file are worth.
//!
//! A plane through three corners of a part that was printed with six digits is not the plane that was meant.
//! Whoever decides which facets were meant to be coplanar has to know how coarsely the coordinates were
//! rounded; the reader is the last to see it.

use super::decimal::Decimal;
use super::words::Words;

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
    /// The largest mantissa below 10^19.
    largest: u64,
    /// The most digits of those above, leading zeros not counted.
    longest: usize,
    last_place: Option<i32>,
}

impl Digits {
    /// The number that a word is, as `str::parse` reads it, or `None`; its digits are noted.
    pub(crate) fn number(&mut self, word: &str) -> Option<f64> {
        match Decimal::parse(word.as_bytes()) {
            Some((decimal, length)) if length == word.len() => self.value(&decimal, word),
            _ => word.parse().ok(),
        }
    }

    /// The number that the next word is; the word, which is empty when there is none, where it is no number.
    #[inline]
    pub(crate) fn next<'w>(&mut self, words: &mut Words<'w>) -> Result<f64, &'w str> {
        // In one pass over the text, if nothing but a number stands there.
        if let Some((decimal, word)) = words.decimal() {
            return self.value(&decimal, word).ok_or(word);
        }
        let word = words.next().unwrap_or("");
        self.number(word).ok_or(word)
    }

    fn value(&mut self, decimal: &Decimal, word: &str) -> Option<f64> {
        self.note(decimal);
        decimal.rounded().or_else(|| word.parse().ok())
    }

    #[inline]
    pub(super) fn note(&mut self, decimal: &Decimal) {
        self.last_place = Some(self.last_place.map_or(decimal.place, |least| least.min(decimal.place)));
        if decimal.n_digits <= Decimal::EXACT {
            self.largest = self.largest.max(decimal.mantissa);
        } else {
            self.longest = self.longest.max(decimal.n_digits);
        }
    }

    /// The precision of all numbers noted; text that has the digits of a 64-bit number is one.
    pub(crate) fn precision(self) -> Precision {
        let most = self.largest.checked_ilog10().map_or(0, |log| log + 1);
        let significant = most.max(u32::try_from(self.longest).unwrap_or(u32::MAX));
        match self.last_place {
            Some(last_place) if significant < 16 => Precision::Decimal { significant, last_place },
            _ => Precision::F64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(words: &[&str], significant: u32, last_place: i32) {
        let mut digits = Digits::default();
        for word in words {
            assert_eq!(digits.number(word), word.parse().ok());
        }
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
        let mut full = Digits::default();
        full.number("0.1234567890123456");
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

    #[test]
    fn numbers_are_those_of_the_standard_library() {
        let words = [
            "",
            "+",
            "-",
            ".",
            "e5",
            "1e",
            "1e+",
            "1e-",
            "1.2.3",
            "1e5e5",
            "1e5.",
            "--1",
            "0x10",
            "1_000",
            "1,5",
            "inf",
            "-infinity",
            "nan",
            "+2",
            ".5",
            "3.",
            "-0",
            "-.5e-3",
            "1E5",
            "1e+05",
            "0e999999999999",
            "1e999999999999",
            "9007199254740993",
            "9007199254740992e22",
            "123456789012345678901234567890",
            "1e23",
            "1e-23",
            "0.1e23",
            "00000000000000000000000000000001.5",
            "18446744073709551617",
            "18446744073709551616",
            "0.00000000000000000000000000000001",
            "-0.00009770726095507105",
            "4.9e-324",
            "1.7976931348623159e308",
        ];
        for word in words {
            let (found, expected) = (Digits::default().number(word), word.parse::<f64>().ok());
            assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{word}");
        }
    }

    #[track_caller]
    fn check_number(word: &str) {
        let (found, expected) = (Digits::default().number(word), word.parse::<f64>().ok());
        assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{word}");
    }

    proptest! {
        #[test]
        fn rounding(n_digits in 1_u32..=19, digits: u64, exponent in -60..60, zeros in 1..9_usize) {
            let mantissa = digits % 10_u64.pow(n_digits);
            check_number(&format!("{mantissa}e{exponent}"));
            check_number(&format!("0.{:0zeros$}{mantissa}", 0));
        }

        /// In the middle between two numbers, and one unit of the last digit beside it.
        #[test]
        fn ties(bits: u64, shift in 0_u32..9, halves in 0_u32..4) {
            let middle = bits >> 10 | 1 << 53 | 1;
            for beside in [-1, 0, 1] {
                check_number(&format!("{}", i128::from(middle << shift) + beside));
                let (n, d) = (i128::from((middle >> (3 * halves)) | 1) * 5_i128.pow(halves) + beside, 10_i128.pow(halves));
                check_number(&format!("{}.{:0w$}", n / d, n % d, w = halves as usize));
            }
        }

        #[test]
        fn any_number_reads_as_in_the_standard_library(word in "[+-]?[0-9]{0,20}[.]?[0-9]{0,20}([eE][+-]?[0-9]{1,3})?", bits: u64) {
            for word in [word, f64::from_bits(bits).to_string(), format!("{:e}", f64::from_bits(bits))] {
                let (found, expected) = (Digits::default().number(&word), word.parse::<f64>().ok());
                prop_assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{}", word);
            }
        }
    }
}
