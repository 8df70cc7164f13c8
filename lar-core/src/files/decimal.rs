//! Numbers in decimal notation, read without rounding and then rounded once.

/// ± mantissa · 10^place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Decimal {
    is_negative: bool,
    /// Modulo 2^64.
    pub mantissa: u64,
    /// Digits of the mantissa, with some of the leading zeros as long as there are no more than make it exact.
    pub n_digits: usize,
    /// The place of the last digit, as a power of ten.
    pub place: i32,
}

impl Decimal {
    /// So many digits make a mantissa below 2^64.
    pub(super) const EXACT: usize = 19;

    /// The number at the beginning of a text, and its length; `None` where none stands in decimal notation.
    #[inline]
    pub(super) fn parse(text: &[u8]) -> Option<(Self, usize)> {
        let sign = text.first().copied().unwrap_or_default();
        let start = usize::from(sign == b'-' || sign == b'+');
        let (mut mantissa, mut end) = (0_u64, start);
        // Few, most of the time.
        while let Some(byte @ b'0'..=b'9') = text.get(end) {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
            end += 1;
        }
        let (before, mut decimals) = (end - start, 0);
        let zeros = if mantissa == 0 && before <= Self::EXACT { before } else { 0 };
        if text.get(end) == Some(&b'.') {
            let point = end + 1;
            end = digits(text, point, &mut mantissa);
            decimals = end - point;
        }
        let mut n_digits = before + decimals;
        if n_digits == 0 {
            return None;
        }
        // Those behind the point are counted only where it matters.
        let more = n_digits - zeros > Self::EXACT;
        n_digits -= if more { leading_zeros(&text[start..end]) } else { zeros };
        let mut place = i32::try_from(decimals).map_or(i32::MIN, |n| -n);
        if let Some(b'e' | b'E') = text.get(end) {
            let (exponent, length) = exponent_of(&text[end + 1..])?;
            place = place.saturating_add(exponent);
            end += 1 + length;
        }
        Some((Self { is_negative: sign == b'-', mantissa, n_digits, place }, end))
    }

    /// The number, correctly rounded, where the mantissa is exact and 128 bits of the power of ten decide.
    #[inline]
    pub(super) fn rounded(&self) -> Option<f64> {
        if self.n_digits > Self::EXACT {
            return None;
        }
        let x = if self.n_digits <= SHORT { short(self.mantissa, self.place) } else { None };
        let x = x.or_else(|| product(self.mantissa, self.place))?;
        Some(f64::from_bits(x.to_bits() | u64::from(self.is_negative) << 63))
    }
}

/// The zeros at the beginning of digits with a point somewhere.
fn leading_zeros(digits: &[u8]) -> usize {
    let zeros = digits.iter().take_while(|byte| matches!(byte, b'0' | b'.'));
    zeros.filter(|&&byte| byte == b'0').count()
}

/// Where the digits end that begin at a place of a text; they are appended to a number, modulo 2^64.
#[inline]
fn digits(text: &[u8], start: usize, number: &mut u64) -> usize {
    const POWERS: [u64; 8] = [1, 10, 100, 1000, 10_000, 100_000, 1_000_000, 10_000_000];
    let mut end = start;
    loop {
        let word = eight_bytes(&text[end..]) ^ 0x3030_3030_3030_3030;
        let n = leading_digits(word);
        if n < 8 {
            // The digits go to the upper bytes, and zeros come before them.
            let last = eight_digits(word << (56 - 8 * n) << 8);
            *number = number.wrapping_mul(POWERS[n]).wrapping_add(last);
            return end + n;
        }
        *number = number.wrapping_mul(100_000_000).wrapping_add(eight_digits(word));
        end += 8;
    }
}

/// The first eight bytes of a text, the first in the lowest bits; zeros where it is shorter.
#[inline]
fn eight_bytes(text: &[u8]) -> u64 {
    match text.first_chunk() {
        Some(&bytes) => u64::from_le_bytes(bytes),
        None => text.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte)),
    }
}

/// How many of the bytes of a word are below ten, from the lowest on up to the first that is not.
#[inline]
fn leading_digits(word: u64) -> usize {
    const LOWER: u64 = 0x7f7f_7f7f_7f7f_7f7f;
    // The highest bit of a byte tells; no sum runs over into the next byte.
    let others = (((word & LOWER) + 0x7676_7676_7676_7676) | word) & !LOWER;
    others.trailing_zeros() as usize / 8
}

/// The number that eight bytes below ten make: neighbours are joined in pairs, fours, eights, all of them at once.
#[inline]
fn eight_digits(word: u64) -> u64 {
    let pairs = join(word, 10, 8, 0x00ff_00ff_00ff_00ff);
    let fours = join(pairs, 100, 16, 0x0000_ffff_0000_ffff);
    join(fours, 10_000, 32, 0xffff_ffff)
}

/// Joins neighbouring numbers of so many bits, the first in the lower bits, into one each.
#[inline]
fn join(numbers: u64, base: u64, bits: u32, mask: u64) -> u64 {
    (numbers & mask) * base + (numbers >> bits & mask)
}

/// The exponent at the beginning of a text behind an `e`, and its length; `None` for one beyond `i32`, which makes
/// nothing but 0 or infinity. Not inlined: numbers without an exponent are read in two thirds of the time then.
#[inline(never)]
fn exponent_of(text: &[u8]) -> Option<(i32, usize)> {
    let sign = text.first().copied().unwrap_or_default();
    let start = usize::from(sign == b'-' || sign == b'+');
    let (mut exponent, mut end) = (0_i32, start);
    while let Some(byte @ b'0'..=b'9') = text.get(end) {
        exponent = exponent.checked_mul(10)?.checked_add(i32::from(byte - b'0'))?;
        end += 1;
    }
    (end > start).then_some((if sign == b'-' { -exponent } else { exponent }, end))
}

/// So many digits make a mantissa that `f64` has exactly.
const SHORT: usize = 15;

/// mantissa · 10^place where `f64` has both, the power or its inverse, exactly: one rounding.
#[inline]
fn short(mantissa: u64, place: i32) -> Option<f64> {
    const POWERS: [f64; 23] = [
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17,
        1e18, 1e19, 1e20, 1e21, 1e22,
    ];
    let power = *POWERS.get(place.unsigned_abs() as usize)?;
    Some(if place < 0 { mantissa as f64 / power } else { mantissa as f64 * power })
}

/// mantissa · 10^place, correctly rounded, from a product with the upper 128 bits of the power of five; `None` when these
/// do not decide, or the power is not in the table.
///
/// Reference: D. Lemire, "Number parsing at a gigabyte per second", Software: Practice and Experience 51, 2021. There the
/// cases near the middle of two numbers are told apart; here they are left to the standard library.
#[inline]
fn product(mantissa: u64, place: i32) -> Option<f64> {
    const DROPPED: u32 = u128::BITS - f64::MANTISSA_DIGITS;
    const HALF: u128 = 1 << (DROPPED - 1);
    let power = *POWERS_OF_FIVE.get(usize::try_from(place.checked_add(LARGEST)?).ok()?)?;
    if mantissa == 0 {
        return Some(0.);
    }
    let up = mantissa.leading_zeros();
    let factor = u128::from(mantissa << up);
    // The upper 128 of 192 bits. What is lost, here and behind the 128 bits of the power, is less than two units.
    let upper = factor * (power >> 64) + ((factor * u128::from(power as u64)) >> 64);
    let more = upper.leading_zeros();
    let bits = upper << more;
    let rest = bits & (2 * HALF - 1);
    // Two units, shifted by one place at most.
    if HALF.wrapping_sub(rest) < 4 {
        return None;
    }
    let rounded = (bits >> DROPPED) as u64 + u64::from(rest > HALF);
    // Of the lowest bit of `rounded`; ⌊log2 10^place⌋ is that of the power.
    let exponent = ((217_706 * place) >> 16) + 12 - (up + more) as i32;
    // No number here is subnormal or overflows. The highest bit of `rounded` adds one to the exponent.
    Some(f64::from_bits((((exponent + 1074) as u64) << 52) + rounded))
}

/// The greatest power in the table: any coordinate that is not absurd.
const LARGEST: i32 = 54;

/// Of each 5^k from k = −[`LARGEST`] on the upper 128 bits, the highest of which is set.
static POWERS_OF_FIVE: [u128; 2 * LARGEST as usize + 1] = {
    let mut table = [0; 2 * LARGEST as usize + 1];
    let (mut k, mut power) = (0, 1_u128);
    while k <= LARGEST as usize {
        table[LARGEST as usize + k] = power << power.leading_zeros();
        table[LARGEST as usize - k] = inverse(power);
        power *= 5;
        k += 1;
    }
    table
};

/// The first 128 bits of 1 / n, n < 2^127.
const fn inverse(n: u128) -> u128 {
    let mut rest = 1;
    while rest < n {
        rest *= 2;
    }
    let (mut quotient, mut bits) = (0, 0);
    while bits < u128::BITS {
        let bit = rest >= n;
        quotient = quotient << 1 | bit as u128;
        rest = (if bit { rest - n } else { rest }) * 2;
        bits += 1;
    }
    quotient
}
