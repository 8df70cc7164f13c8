//! Signed integers of at most N 64-bit limbs on the stack.
//!
//! Sign and magnitude with the number of limbs in use, so that a small value in a wide type costs what a small
//! value costs. The width of each use is chosen from the bit budget of the kernel, so overflow cannot happen; it
//! is an assertion all the same.

use super::Sign;
use super::double::Double;
use std::cmp::Ordering;

/// An integer of at most `64 · N` bits and a sign.
#[derive(Clone, Copy)]
pub(crate) struct Int<const N: usize> {
    negative: bool,
    len: usize,
    limbs: [u64; N],
}

impl<const N: usize> Int<N> {
    /// Zero.
    pub(crate) const ZERO: Self = Self { negative: false, len: 0, limbs: [0; N] };

    /// The same value in another width.
    ///
    /// # Panics
    /// When it does not fit.
    #[must_use]
    pub(crate) fn resize<const M: usize>(&self) -> Int<M> {
        let mut wide = Int::<M> { negative: self.negative, len: self.len, limbs: [0; M] };
        wide.limbs[..self.len].copy_from_slice(&self.limbs[..self.len]);
        wide
    }

    /// The sign.
    #[must_use]
    pub(crate) fn sign(&self) -> Sign {
        match (self.len, self.negative) {
            (0, _) => Sign::Zero,
            (_, true) => Sign::Negative,
            (_, false) => Sign::Positive,
        }
    }

    /// Number of bits of the magnitude.
    #[must_use]
    pub(crate) fn bits(&self) -> u32 {
        match self.len {
            0 => 0,
            n => 64 * n as u32 - self.limbs[n - 1].leading_zeros(),
        }
    }

    /// The limbs in use, least significant first.
    pub(super) fn magnitude(&self) -> &[u64] {
        &self.limbs[..self.len]
    }

    /// `self · 2^exponent`, rounded to the nearest `f64`; the result must be a normal number.
    #[must_use]
    pub(super) fn to_f64_scaled(self, exponent: i32) -> f64 {
        let (double, skip) = Double::from_int(&self);
        double.hi * 2f64.powi(64 * skip as i32 + exponent)
    }

    /// In decimal digits. O(N²).
    #[must_use]
    pub(super) fn to_decimal(self) -> String {
        // The largest power of ten in a limb, and its number of zeros.
        const CHUNK: (u64, usize) = (10_000_000_000_000_000_000, 19);
        let mut rest = self;
        let mut chunks = Vec::new();
        while rest.len > 0 {
            let mut remainder = 0u64;
            for limb in rest.limbs[..rest.len].iter_mut().rev() {
                let dividend = u128::from(remainder) << 64 | u128::from(*limb);
                *limb = (dividend / u128::from(CHUNK.0)) as u64;
                remainder = (dividend % u128::from(CHUNK.0)) as u64;
            }
            rest.trim(rest.len);
            chunks.push(remainder);
        }
        let sign = if self.negative { "-" } else { "" };
        let mut out = format!("{sign}{}", chunks.pop().unwrap_or(0));
        chunks.iter().rev().for_each(|chunk| out.push_str(&format!("{chunk:0width$}", width = CHUNK.1)));
        out
    }

    /// `self · 2^shift`.
    #[must_use]
    pub(crate) fn shifted(&self, shift: u32) -> Self {
        let (words, bits) = ((shift / 64) as usize, shift % 64);
        let mut out = Self { negative: self.negative, ..Self::ZERO };
        for (i, &limb) in self.magnitude().iter().enumerate() {
            out.limbs[i + words] |= limb << bits;
            let carry = if bits == 0 { 0 } else { limb >> (64 - bits) };
            if carry != 0 {
                out.limbs[i + words + 1] |= carry;
            }
        }
        out.trim((self.len + words + 1).min(N));
        out
    }

    fn trim(&mut self, mut len: usize) {
        while len > 0 && self.limbs[len - 1] == 0 {
            len -= 1;
        }
        self.len = len;
        self.negative &= len > 0;
    }

    fn cmp_magnitude(&self, other: &Self) -> Ordering {
        self.len
            .cmp(&other.len)
            .then_with(|| self.magnitude().iter().rev().cmp(other.magnitude().iter().rev()))
    }

    fn add_magnitude(&self, other: &Self) -> Self {
        let (long, short) = if self.len >= other.len { (self, other) } else { (other, self) };
        let mut out = Self { negative: self.negative, len: long.len, limbs: long.limbs };
        let mut carry = false;
        for i in 0..long.len {
            if i >= short.len && !carry {
                break;
            }
            let addend = if i < short.len { short.limbs[i] } else { 0 };
            (out.limbs[i], carry) = carrying_add(out.limbs[i], addend, carry);
        }
        if carry {
            out.limbs[long.len] = 1;
            out.len += 1;
        }
        out
    }

    /// |self| − |other| with the sign of self; |self| ≥ |other|.
    fn sub_magnitude(&self, other: &Self) -> Self {
        let mut out = *self;
        let mut borrow = false;
        for i in 0..self.len {
            if i >= other.len && !borrow {
                break;
            }
            let subtrahend = if i < other.len { other.limbs[i] } else { 0 };
            (out.limbs[i], borrow) = borrowing_sub(out.limbs[i], subtrahend, borrow);
        }
        out.trim(self.len);
        out
    }
}

fn carrying_add(a: u64, b: u64, carry: bool) -> (u64, bool) {
    let (sum, c1) = a.overflowing_add(b);
    let (sum, c2) = sum.overflowing_add(u64::from(carry));
    (sum, c1 || c2)
}

fn borrowing_sub(a: u64, b: u64, borrow: bool) -> (u64, bool) {
    let (difference, b1) = a.overflowing_sub(b);
    let (difference, b2) = difference.overflowing_sub(u64::from(borrow));
    (difference, b1 || b2)
}

impl<const N: usize> From<i128> for Int<N> {
    fn from(x: i128) -> Self {
        let magnitude = x.unsigned_abs();
        let mut out = Self { negative: x < 0, ..Self::ZERO };
        out.limbs[0] = magnitude as u64;
        let high = (magnitude >> 64) as u64;
        if high != 0 {
            out.limbs[1] = high;
        }
        out.trim(N.min(2));
        out
    }
}

impl<const N: usize> From<i64> for Int<N> {
    fn from(x: i64) -> Self {
        Self::from(i128::from(x))
    }
}

impl<const N: usize> std::ops::Neg for Int<N> {
    type Output = Self;

    fn neg(mut self) -> Self {
        self.negative = !self.negative && self.len > 0;
        self
    }
}

impl<const N: usize> std::ops::Add for Int<N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.negative == other.negative {
            return self.add_magnitude(&other);
        }
        match self.cmp_magnitude(&other) {
            Ordering::Less => other.sub_magnitude(&self),
            Ordering::Equal => Self::ZERO,
            Ordering::Greater => self.sub_magnitude(&other),
        }
    }
}

impl<const N: usize> std::ops::Sub for Int<N> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const N: usize> std::ops::Mul for Int<N> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let mut out = Self { negative: self.negative != other.negative, ..Self::ZERO };
        for (i, &a) in self.magnitude().iter().enumerate() {
            let mut carry = 0u64;
            for (j, &b) in other.magnitude().iter().enumerate() {
                let at = i + j;
                // The product of the top limbs may reach one limb beyond N only as a zero carry.
                let t = u128::from(a) * u128::from(b) + u128::from(out.limbs[at]) + u128::from(carry);
                out.limbs[at] = t as u64;
                carry = (t >> 64) as u64;
            }
            if carry != 0 {
                out.limbs[i + other.len] = carry;
            }
        }
        out.trim((self.len + other.len).min(N));
        out
    }
}

impl<const N: usize> PartialEq for Int<N> {
    fn eq(&self, other: &Self) -> bool {
        self.negative == other.negative && self.magnitude() == other.magnitude()
    }
}

impl<const N: usize> Eq for Int<N> {}

impl<const N: usize> Ord for Int<N> {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self.negative, other.negative) {
            (false, true) => Ordering::Greater,
            (true, false) => Ordering::Less,
            (false, false) => self.cmp_magnitude(other),
            (true, true) => other.cmp_magnitude(self),
        }
    }
}

impl<const N: usize> PartialOrd for Int<N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<const N: usize> std::fmt::Debug for Int<N> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}0x", if self.negative { "-" } else { "" })?;
        for limb in self.magnitude().iter().rev() {
            write!(f, "{limb:016x}")?;
        }
        if self.len == 0 { write!(f, "0") } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_int::IBig;
    use proptest::prelude::*;

    fn to_big<const N: usize>(x: &Int<N>) -> IBig {
        let magnitude =
            x.magnitude().iter().rev().fold(IBig::ZERO, |acc, &limb| (acc << 64) + IBig::from(limb));
        if x.sign() == Sign::Negative { -magnitude } else { magnitude }
    }

    fn from_digits(digits: &[u64], negative: bool) -> Int<8> {
        let magnitude =
            digits.iter().fold(Int::ZERO, |acc: Int<8>, &d| acc.shifted(64) + Int::from(i128::from(d)));
        if negative { -magnitude } else { magnitude }
    }

    /// Up to four limbs, with many zeros and ones among them so that carries and borrows run through.
    fn operand() -> impl Strategy<Value = Int<8>> {
        let digit = prop_oneof![Just(0u64), Just(1), Just(u64::MAX), any::<u64>()];
        (prop::collection::vec(digit, 0..4), any::<bool>()).prop_map(|(d, n)| from_digits(&d, n))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]
        #[test]
        fn agrees_with_arbitrary_precision(a in operand(), b in operand(), shift in 0u32..200) {
            let (x, y) = (to_big(&a), to_big(&b));
            prop_assert_eq!(to_big(&(a + b)), &x + &y);
            prop_assert_eq!(to_big(&(a - b)), &x - &y);
            prop_assert_eq!(to_big(&(a * b)), &x * &y);
            prop_assert_eq!(to_big(&a.shifted(shift)), &x << shift as usize);
            prop_assert_eq!(a.cmp(&b), x.cmp(&y));
            prop_assert_eq!((a * b).to_decimal(), (&x * &y).to_string());
            prop_assert_eq!(to_big(&a.resize::<5>()), x);
        }
    }

    #[test]
    fn extremes_of_i128_convert() {
        for x in [i128::MIN, i128::MAX, -1, 0, 1, 1 << 64, -(1 << 64)] {
            assert_eq!(to_big(&Int::<2>::from(x)), IBig::from(x));
        }
    }
}
