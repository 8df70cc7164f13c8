//! Exact fractions in lowest terms: slow, small, and nothing in common with the library's arithmetic.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Sub};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fraction {
    num: i128,
    /// Positive.
    den: i128,
}

impl Fraction {
    pub(crate) const ZERO: Self = Self { num: 0, den: 1 };

    fn new(num: i128, den: i128) -> Self {
        let divisor = gcd(num.abs(), den.abs()) * den.signum();
        Self { num: num / divisor, den: den / divisor }
    }

    /// Correctly rounded while numerator and denominator stay below 2^53.
    pub(crate) fn value(self) -> f64 {
        self.num as f64 / self.den as f64
    }

    pub(crate) fn sign(self) -> i128 {
        self.num.signum()
    }

    pub(crate) fn half(self) -> Self {
        Self::new(self.num, 2 * self.den)
    }
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a } else { gcd(b, a % b) }
}

impl From<i64> for Fraction {
    fn from(x: i64) -> Self {
        Self { num: x.into(), den: 1 }
    }
}

impl Add for Fraction {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let common = gcd(self.den, other.den);
        let (a, b) = (other.den / common, self.den / common);
        Self::new(self.num * a + other.num * b, self.den * a)
    }
}

impl Sub for Fraction {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        let common = gcd(self.den, other.den);
        let (a, b) = (other.den / common, self.den / common);
        Self::new(self.num * a - other.num * b, self.den * a)
    }
}

impl Mul for Fraction {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (a, b) = (Self::new(self.num, other.den), Self::new(other.num, self.den));
        Self { num: a.num * b.num, den: a.den * b.den }
    }
}

impl Div for Fraction {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Mul::mul(self, Self::new(other.den, other.num))
    }
}

impl Ord for Fraction {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.num * other.den).cmp(&(other.num * self.den))
    }
}

impl PartialOrd for Fraction {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// A point or a vector.
pub(crate) type Point = [Fraction; 2];

pub(crate) fn point(x: i64, y: i64) -> Point {
    [x.into(), y.into()]
}

pub(crate) fn minus(p: Point, q: Point) -> Point {
    [p[0] - q[0], p[1] - q[1]]
}

pub(crate) fn plus(p: Point, q: Point) -> Point {
    [p[0] + q[0], p[1] + q[1]]
}

pub(crate) fn times(p: Point, t: Fraction) -> Point {
    [p[0] * t, p[1] * t]
}

pub(crate) fn cross(a: Point, b: Point) -> Fraction {
    a[0] * b[1] - a[1] * b[0]
}

/// Positive when a, b, c turn left.
pub(crate) fn turn(a: Point, b: Point, c: Point) -> i128 {
    cross(minus(b, a), minus(c, a)).sign()
}
