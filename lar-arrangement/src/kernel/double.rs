//! Double-double numbers: an unevaluated sum of two `f64`, about 106 bits, for correctly rounded quotients.

use super::Int;

/// hi + lo with |lo| ≤ ulp(hi) / 2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Double {
    pub hi: f64,
    pub lo: f64,
}

fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

fn two_product(a: f64, b: f64) -> (f64, f64) {
    // Veltkamp's splitting: exact as long as a · (2^27 + 1) does not overflow.
    let split = |x: f64| {
        let t = x * 134_217_729.0;
        let hi = t - (t - x);
        (hi, x - hi)
    };
    let product = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (product, ((ah * bh - product) + ah * bl + al * bh) + al * bl)
}

impl Double {
    /// The integer divided by 2^(64·skip), where skip leaves the three highest limbs: relative error below 2^-104.
    pub(super) fn from_int<const N: usize>(x: &Int<N>) -> (Self, usize) {
        let limbs = x.magnitude();
        let skip = limbs.len().saturating_sub(3);
        let mut acc = Self { hi: 0.0, lo: 0.0 };
        for &limb in limbs[skip..].iter().rev() {
            acc = acc.scaled(18_446_744_073_709_551_616.0);
            acc = acc.plus((limb >> 32) as f64 * 4_294_967_296.0).plus((limb & 0xffff_ffff) as f64);
        }
        if x.sign() == super::Sign::Negative {
            acc = acc.negated();
        }
        (acc, skip)
    }

    /// Exact below 2^106, where two halves are, beyond with a relative error below 2^-104.
    pub(super) fn from_i128(x: i128) -> Self {
        const HALF: u32 = 53;
        let m = x.unsigned_abs();
        if m >> (2 * HALF) == 0 {
            let (high, low) = ((x >> HALF) as i64, x as i64 & ((1 << HALF) - 1));
            let (hi, lo) = quick_two_sum(high as f64 * (1i64 << HALF) as f64, low as f64);
            return Self { hi, lo };
        }
        let part = |shift: u32| f64::from((m >> shift) as u32) * 2f64.powi(shift as i32);
        let acc = Self { hi: part(96), lo: 0.0 }.plus(part(64)).plus(part(32)).plus(part(0));
        if x < 0 { acc.negated() } else { acc }
    }

    /// The sum of three products of factors below 2^83, with a relative error below 2^-103.
    pub(super) fn from_products(products: [(i128, i128); 3]) -> Self {
        const HALF: u32 = 42;
        let split = |x: i128| [(x >> HALF) as i64, x as i64 & ((1 << HALF) - 1)];
        let product = |x: i64, y: i64| i128::from(x) * i128::from(y);
        // In units of 2^84, 2^42 and 1: sums of products of 84 bits.
        let (mut high, mut middle, mut low) = (0, 0, 0);
        for (x, y) in products {
            let ([x, x_low], [y, y_low]) = (split(x), split(y));
            high += product(x, y);
            middle += product(x, y_low) + product(x_low, y);
            low += product(x_low, y_low);
        }
        // Only what is above 2^84 keeps a sign.
        middle += low >> HALF;
        high += middle >> HALF;
        let low = (middle & ((1 << HALF) - 1)) << HALF | low & ((1 << HALF) - 1);
        if high.abs() >> 40 == 0 {
            return Self::from_i128((high << (2 * HALF)) + low);
        }
        Self::from_i128(high).scaled(2f64.powi(2 * HALF as i32)).sum(Self::from_i128(low))
    }

    pub(super) fn negated(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }

    pub(super) fn scaled(self, power_of_two: f64) -> Self {
        Self { hi: self.hi * power_of_two, lo: self.lo * power_of_two }
    }

    /// The sum, off by less than 2^-103 of the terms' magnitudes.
    pub(super) fn sum(self, other: Self) -> Self {
        let (sum, error) = two_sum(self.hi, other.hi);
        let (hi, lo) = quick_two_sum(sum, error + (self.lo + other.lo));
        Self { hi, lo }
    }

    /// The product, off by less than 2^-102 of it.
    pub(super) fn product(self, other: Self) -> Self {
        let (product, error) = two_product(self.hi, other.hi);
        let (hi, lo) = quick_two_sum(product, error + (self.hi * other.lo + self.lo * other.hi));
        Self { hi, lo }
    }

    fn plus(self, x: f64) -> Self {
        let (sum, error) = two_sum(self.hi, x);
        let (hi, lo) = quick_two_sum(sum, error + self.lo);
        Self { hi, lo }
    }

    /// The quotient, relative error below 2^-98.
    pub(super) fn over(self, divisor: Self) -> Self {
        let first = self.hi / divisor.hi;
        let remainder = self.minus_product(first, divisor);
        let second = remainder.hi / divisor.hi;
        let remainder = remainder.minus_product(second, divisor);
        let third = remainder.hi / divisor.hi;
        let (hi, lo) = quick_two_sum(first, second);
        let (hi, lo) = quick_two_sum(hi, lo + third);
        Self { hi, lo }
    }

    fn minus_product(self, factor: f64, divisor: Self) -> Self {
        let (product, error) = two_product(factor, divisor.hi);
        let (sum, low) = two_sum(self.hi, -product);
        let low = low + self.lo - error - factor * divisor.lo;
        let (hi, lo) = quick_two_sum(sum, low);
        Self { hi, lo }
    }
}

/// A quotient of two integers between 0 and 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fraction(Double);

impl Fraction {
    /// 0 ≤ numerator ≤ denominator, denominator > 0. Relative error below 2^-97.
    pub(crate) fn new(numerator: i128, denominator: i128) -> Self {
        Self(Double::from_i128(numerator).over(Double::from_i128(denominator)))
    }

    /// start + direction · self rounded to the nearest `f64`, unless that is too close to call. Magnitudes of at most
    /// 2^41.
    ///
    /// The product with the high part is exact, and so is its sum with the start, as sums of two numbers; the low
    /// parts are below 2^-52 of |start| + |direction|, and so their roundings below 2^-103. With the quotient's error
    /// the whole is off by less than 2^-96 of that; the bound is 2^-93.
    pub(crate) fn between(&self, start: i64, direction: i64) -> Option<f64> {
        let (start, direction) = (start as f64, direction as f64);
        let (product, low) = two_product(direction, self.0.hi);
        let (hi, lo) = two_sum(start, product);
        let lo = lo + (low + direction * self.0.lo);
        let error = (start.abs() + direction.abs()) * 2f64.powi(-93);
        let (least, most) = (hi + (lo - error), hi + (lo + error));
        (least == most).then_some(least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::rounded_quotient;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sums_of_products_are_close(
            factors in prop::array::uniform6((-1i128 << 83) + 1..1 << 83),
            shifts in prop::array::uniform6(0u32..84),
            cancels: bool,
        ) {
            let mut x: [i128; 6] = std::array::from_fn(|k| factors[k] >> shifts[k]);
            if cancels {
                (x[2], x[3], x[4]) = (-x[0], x[1], x[4] >> 60);
            }
            let products = [(x[0], x[1]), (x[2], x[3]), (x[4], x[5])];
            let exact = products.iter().fold(Int::<4>::ZERO, |sum, &(x, y)| sum + Int::from(x) * Int::from(y));
            let found = Double::from_products(products);
            // Both parts are integers of less than 2^170, and multiples of 2^60 above 2^113.
            let part = |x: f64| {
                let (high, bits) = if x.abs() < 1e34 { (x, 0) } else { (x * 2f64.powi(-60), 60) };
                Int::<4>::from(high as i128).shifted(bits)
            };
            let off = part(found.hi) + part(found.lo) - exact;
            prop_assert!(off.bits() + 103 <= exact.bits().max(103), "{:?} for {:?}", found, exact);
        }

        #[test]
        fn points_between_are_correctly_rounded(
            (start, direction) in ((-1i64 << 40)..1 << 40, (-1i64 << 41)..1 << 41),
            (a, b, shift) in (0i128..1 << 83, 1i128..1 << 83, 0u32..84),
        ) {
            let (numerator, denominator) = (a >> shift, (a + b) >> shift);
            prop_assume!(denominator > 0);
            let exact = Int::<3>::from(start) * Int::from(denominator) + Int::from(direction) * Int::from(numerator);
            let exact = rounded_quotient(&exact, &denominator.into());
            if let Some(found) = Fraction::new(numerator, denominator).between(start, direction) {
                prop_assert_eq!(found, exact);
            } else {
                // Small quotients are often exact, or halfway between two numbers; others are nearly always decided.
                prop_assert!(shift > 20, "{} {} {} {}", start, direction, numerator, denominator);
            }
        }
    }
}
