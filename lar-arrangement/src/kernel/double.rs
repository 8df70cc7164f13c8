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
            acc = Self { hi: -acc.hi, lo: -acc.lo };
        }
        (acc, skip)
    }

    fn scaled(self, power_of_two: f64) -> Self {
        Self { hi: self.hi * power_of_two, lo: self.lo * power_of_two }
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
