//! Numbers in decimal notation, read without rounding.

/// ± mantissa · 10^(exponent − decimals).
#[derive(Clone, Copy, Debug)]
pub(super) struct Decimal {
    is_negative: bool,
    /// Modulo 2^64.
    mantissa: u64,
    /// Digits of the mantissa, leading zeros not counted.
    pub significant: u32,
    /// Digits after the point.
    pub decimals: i32,
    pub exponent: i32,
}

impl Decimal {
    /// The number at the beginning of a text, and its length; `None` where none stands in decimal notation.
    pub(super) fn parse(text: &[u8]) -> Option<(Self, usize)> {
        let (is_negative, start) = match text.first() {
            Some(b'-') => (true, 1),
            Some(b'+') => (false, 1),
            _ => (false, 0),
        };
        let mut mantissa = 0;
        let mut end = digits(text, start, &mut mantissa);
        let (mut n_digits, mut decimals) = (end - start, 0);
        if text.get(end) == Some(&b'.') {
            let point = end + 1;
            end = digits(text, point, &mut mantissa);
            decimals = end - point;
            n_digits += decimals;
        }
        let leading = text[start..end].iter().take_while(|byte| matches!(byte, b'0' | b'.'));
        let significant = n_digits - leading.filter(|&&byte| byte == b'0').count();
        let mut exponent = 0;
        if let Some(b'e' | b'E') = text.get(end) {
            let (number, length) = exponent_of(&text[end + 1..])?;
            exponent = number;
            end += 1 + length;
        }
        let count = |n: usize| i32::try_from(n).unwrap_or(i32::MAX);
        let decimal = Self {
            is_negative,
            mantissa,
            significant: count(significant).unsigned_abs(),
            decimals: count(decimals),
            exponent,
        };
        (n_digits > 0).then_some((decimal, end))
    }

    /// The number, where the mantissa is exact and a power of ten that fits 64 bits, or that `f64` has exactly, is
    /// all that it takes.
    pub(super) fn exactly(&self) -> Option<f64> {
        const POWERS: [f64; 23] = [
            1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17,
            1e18, 1e19, 1e20, 1e21, 1e22,
        ];
        const DIGITS_OF_U64: u32 = 19;
        if self.significant > DIGITS_OF_U64 {
            return None;
        }
        let power = self.exponent.checked_sub(self.decimals)?;
        let x = if self.mantissa <= 1 << f64::MANTISSA_DIGITS {
            // One rounding.
            let (mantissa, of_ten) = (self.mantissa as f64, *POWERS.get(power.unsigned_abs() as usize)?);
            if power < 0 { mantissa / of_ten } else { mantissa * of_ten }
        } else if (-(DIGITS_OF_U64 as i32)..=0).contains(&power) {
            quotient(self.mantissa, 10_u64.pow(power.unsigned_abs()))
        } else {
            return None;
        };
        Some(if self.is_negative { -x } else { x })
    }
}

/// Where the digits end that begin at a place of a text; they are appended to a number, modulo 2^64.
fn digits(text: &[u8], start: usize, number: &mut u64) -> usize {
    let mut end = start;
    while let Some(eight) = text.get(end..end + 8).and_then(|bytes| eight_digits(bytes.try_into().ok()?)) {
        *number = number.wrapping_mul(100_000_000).wrapping_add(eight);
        end += 8;
    }
    while let Some(byte @ b'0'..=b'9') = text.get(end) {
        *number = number.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
        end += 1;
    }
    end
}

/// The number that eight digits make, if they are digits: neighbours are joined in pairs, fours, eights, all of them at
/// once in the bytes of one word.
fn eight_digits(bytes: [u8; 8]) -> Option<u64> {
    const UPPER: u64 = 0xf0f0_f0f0_f0f0_f0f0;
    const ZEROS: u64 = 0x3030_3030_3030_3030;
    let word = u64::from_le_bytes(bytes);
    // The upper half of a digit's byte is 3, and stays 3 when 6 is added.
    if word & UPPER != ZEROS || word.wrapping_add(0x0606_0606_0606_0606) & UPPER != ZEROS {
        return None;
    }
    let pairs = join(word - ZEROS, 10, 8, 0x00ff_00ff_00ff_00ff);
    let fours = join(pairs, 100, 16, 0x0000_ffff_0000_ffff);
    Some(join(fours, 10_000, 32, 0xffff_ffff))
}

/// Joins neighbouring numbers of so many bits, the first in the lower bits, into one each.
fn join(numbers: u64, base: u64, bits: u32, mask: u64) -> u64 {
    (numbers & mask) * base + (numbers >> bits & mask)
}

/// a / b, correctly rounded; neither is zero.
fn quotient(a: u64, b: u64) -> f64 {
    let (up_a, up_b) = (a.leading_zeros(), b.leading_zeros());
    // Between 2^62 and 2^64.
    let (dividend, divisor) = (u128::from(a << up_a) << 63, u128::from(b << up_b));
    let quotient = dividend / divisor;
    // What is lost is seen in the last bit, which is too low for an `f64` by nine places at least.
    let rest = u64::from(quotient * divisor != dividend);
    (quotient as u64 | rest) as f64 * 2_f64.powi(up_b as i32 - up_a as i32 - 63)
}

/// The exponent at the beginning of a text behind an `e`, and its length; `None` for one beyond `i32`, which makes
/// nothing but 0 or infinity.
fn exponent_of(text: &[u8]) -> Option<(i32, usize)> {
    let sign = usize::from(matches!(text.first(), Some(b'-' | b'+')));
    let length = sign + text[sign..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let exponent = str::from_utf8(&text[..length]).ok()?.parse().ok()?;
    Some((exponent, length))
}
