//! Lines in the form that programs write them, read in one pass over the bytes: ASCII words parted by spaces or tabs,
//! numbers in decimal notation, a line end.
//!
//! Every step gives `None` at anything else. The line is then read the general way, which knows all forms of the format and
//! words the errors; what is read here it reads the same.

use super::decimal::Decimal;
use super::precision::Digits;

/// The rest of a text, from within a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scan<'t> {
    rest: &'t [u8],
    /// Line ends read.
    pub(super) lines: u64,
}

impl<'t> Scan<'t> {
    pub(crate) fn new(text: &'t [u8]) -> Self {
        Self { rest: text, lines: 0 }
    }

    /// What has not been read.
    pub(crate) fn rest(&self) -> &'t [u8] {
        self.rest
    }

    /// This word, in either case.
    #[inline]
    pub(crate) fn keyword(&mut self, word: &str) -> Option<()> {
        self.blanks();
        let found = self.rest.get(..word.len())?;
        if found.eq_ignore_ascii_case(word.as_bytes()) { self.end_word(word.len()) } else { None }
    }

    /// A finite number; its digits are noted.
    #[inline]
    pub(crate) fn number(&mut self, digits: &mut Digits) -> Option<f64> {
        let decimal = self.decimal()?;
        digits.note(&decimal);
        decimal.rounded()
    }

    /// A number that does not matter.
    #[inline]
    pub(crate) fn skip_number(&mut self) -> Option<()> {
        self.decimal().map(|_| ())
    }

    #[inline]
    fn decimal(&mut self) -> Option<Decimal> {
        self.blanks();
        let (decimal, length) = Decimal::parse(self.rest)?;
        self.end_word(length)?;
        Some(decimal)
    }

    /// Finite numbers; their digits are noted.
    #[inline]
    pub(crate) fn numbers<const N: usize>(&mut self, digits: &mut Digits) -> Option<[f64; N]> {
        let mut numbers = [0.; N];
        for number in &mut numbers {
            *number = self.number(digits)?;
        }
        Some(numbers)
    }

    /// The rest of a line: coordinates, whose digits are noted.
    #[inline]
    pub(crate) fn coordinates<const N: usize>(&mut self, digits: &mut Digits) -> Option<[f64; N]> {
        let numbers = self.numbers(digits)?;
        self.end_line()?;
        // Minus zero is where zero is.
        Some(numbers.map(|x| x + 0.))
    }

    /// The rest of a line: the number of corners of a polygon, three at least, and the corners.
    #[inline]
    pub(crate) fn polygon(&mut self, n_vertices: usize, polygon: &mut Vec<u32>) -> Option<()> {
        polygon.clear();
        let n = self.count()?;
        for _ in 0..n {
            let vertex = self.count()?;
            if vertex >= n_vertices as u64 {
                return None;
            }
            polygon.push(u32::try_from(vertex).ok()?);
        }
        if n < 3 { None } else { self.end_line() }
    }

    fn count(&mut self) -> Option<u64> {
        self.blanks();
        let (n, length) = whole(self.rest)?;
        self.end_word(length)?;
        Some(n)
    }

    /// A corner of a face in OBJ: v, v/vt, v//vn or v/vt/vn, and a slash with none behind it. `None` where the line ends.
    #[inline]
    pub(crate) fn corner(&mut self) -> Option<i64> {
        self.blanks();
        let (vertex, mut length) = integer(self.rest)?;
        for _ in 0..2 {
            if self.rest.get(length) == Some(&b'/') {
                length += 1;
                length += integer(&self.rest[length..]).map_or(0, |(_, length)| length);
            }
        }
        self.end_word(length)?;
        Some(vertex)
    }

    /// The end of the line.
    #[inline]
    pub(crate) fn end_line(&mut self) -> Option<()> {
        self.blanks();
        let rest = self.rest.strip_prefix(b"\r").unwrap_or(self.rest);
        self.rest = rest.strip_prefix(b"\n")?;
        self.lines += 1;
        Some(())
    }

    fn blanks(&mut self) {
        while let [b' ' | b'\t', rest @ ..] = self.rest {
            self.rest = rest;
        }
    }

    /// Goes on to the end of a word, if that is one.
    fn end_word(&mut self, length: usize) -> Option<()> {
        self.rest = &self.rest[length..];
        matches!(self.rest.first(), Some(b' ' | b'\t' | b'\r' | b'\n')).then_some(())
    }
}

/// The whole number at the beginning of a text, and its length.
#[inline]
fn integer(text: &[u8]) -> Option<(i64, usize)> {
    let sign = usize::from(text.first() == Some(&b'-'));
    let (n, length) = whole(&text[sign..])?;
    let n = n.cast_signed();
    Some((if sign > 0 { -n } else { n }, sign + length))
}

/// The digits at the beginning of a text and their number: from one to eighteen, which `i64` holds.
#[inline]
fn whole(text: &[u8]) -> Option<(u64, usize)> {
    const MOST: usize = 18;
    let (mut n, mut length) = (0, 0);
    while let Some(byte @ b'0'..=b'9') = text.get(length) {
        n = n * 10 + u64::from(byte - b'0');
        length += 1;
        if length > MOST {
            return None;
        }
    }
    (length > 0).then_some((n, length))
}
