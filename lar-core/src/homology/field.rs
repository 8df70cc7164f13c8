//! Arithmetic modulo a prime below 2^32; elements are their remainders.

/// The integers modulo a prime.
#[derive(Clone, Copy)]
pub(super) struct Field {
    prime: u64,
}

impl Field {
    /// `None` when `modulus` is not prime.
    pub(super) fn new(modulus: u32) -> Option<Self> {
        let prime = u64::from(modulus);
        let has_divisor = || (2..).take_while(|k| k * k <= prime).any(|k| prime.is_multiple_of(k));
        (modulus >= 2 && !has_divisor()).then_some(Self { prime })
    }

    pub(super) fn element(self, x: i8) -> u32 {
        let size = u64::from(x.unsigned_abs()) % self.prime;
        self.remainder(if x < 0 { self.prime - size } else { size })
    }

    pub(super) fn mul(self, a: u32, b: u32) -> u32 {
        self.remainder(u64::from(a) * u64::from(b))
    }

    pub(super) fn add(self, a: u32, b: u32) -> u32 {
        self.remainder(u64::from(a) + u64::from(b))
    }

    pub(super) fn neg(self, a: u32) -> u32 {
        self.remainder(self.prime - u64::from(a))
    }

    /// The inverse of an element other than zero: a^(prime − 2). 1 and −1 are their own.
    pub(super) fn inverse(self, a: u32) -> u32 {
        if a == 1 || u64::from(a) + 1 == self.prime {
            return a;
        }
        let (mut power, mut base, mut exponent) = (1, a, self.prime - 2);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = self.mul(power, base);
            }
            base = self.mul(base, base);
            exponent >>= 1;
        }
        power
    }

    fn remainder(self, x: u64) -> u32 {
        u32::try_from(x % self.prime).expect("remainders are below the prime, which fits u32")
    }
}

#[cfg(test)]
mod tests {
    use super::Field;

    #[test]
    fn fields_are_those_of_primes() {
        let primes: Vec<u32> = (0..40).filter(|&n| Field::new(n).is_some()).collect();
        assert_eq!(primes, [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37]);
        assert!(Field::new(u32::MAX - 4).is_some() && Field::new(u32::MAX).is_none());
    }

    #[test]
    fn laws() {
        for prime in [2, 3, 7, 2_147_483_647, u32::MAX - 4] {
            let field = Field::new(prime).unwrap();
            for x in i8::MIN..=i8::MAX {
                let a = field.element(x);
                assert_eq!(field.add(a, field.neg(a)), 0);
                if a != 0 {
                    assert_eq!(field.mul(a, field.inverse(a)), 1, "{x} modulo {prime}");
                }
            }
            assert_eq!(field.add(field.element(-1), 1), 0);
        }
    }
}
