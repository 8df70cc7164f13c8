//! Planes with integer coefficients and points with rational coordinates.
//!
//! A point is never measured, it is defined: as an input point, as the intersection of an input edge with a
//! plane, or as that of three planes. Homogeneous integer coordinates follow from the definition and are made
//! when an exact answer needs them.

use super::double::Double;
use super::{Int, Sign};

/// Integer plane: the points x with n · x = d.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Plane {
    pub n: [i128; 3],
    pub d: i128,
}

fn wide_difference(a: [i64; 3], b: [i64; 3]) -> [i128; 3] {
    std::array::from_fn(|k| i128::from(a[k]) - i128::from(b[k]))
}

fn cross(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(n: [i128; 3], p: [i64; 3]) -> i128 {
    n[0] * i128::from(p[0]) + n[1] * i128::from(p[1]) + n[2] * i128::from(p[2])
}

impl Plane {
    /// The plane through three points, its normal pointing to where they turn counter-clockwise.
    pub(crate) fn through(a: [i64; 3], b: [i64; 3], c: [i64; 3]) -> Self {
        let n = cross(wide_difference(b, a), wide_difference(c, a));
        Self { n, d: dot(n, a) }
    }

    /// The plane through the edge a → b parallel to `axis`; seen along −axis its normal points to the left of
    /// the edge, that is, the projected triangle (a, b, x) is counter-clockwise where n · x > d.
    pub(crate) fn vertical(a: [i64; 3], b: [i64; 3], axis: usize) -> Self {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let e = wide_difference(b, a);
        let mut n = [0; 3];
        n[u] = -e[v];
        n[v] = e[u];
        Self { n, d: dot(n, a) }
    }

    /// n · p − d.
    pub(crate) fn side(&self, p: [i64; 3]) -> i128 {
        dot(self.n, p) - self.d
    }

    /// Sign of n · p − d for a rational point.
    pub(crate) fn side_of(&self, p: &HPoint) -> Sign {
        self.scaled_side(p).sign()
    }

    /// (n · p − d) times the (positive) denominator of p.
    pub(crate) fn scaled_side<const M: usize>(&self, p: &HPointOf<M>) -> Int<11>
    where
        Int<M>: Copy,
    {
        (0..3)
            .fold(-(Int::from(self.d) * p.w.resize()), |sum, k| sum + Int::from(self.n[k]) * p.x[k].resize())
    }

    /// The components of n that are not zero, exactly.
    pub(crate) fn direction_with(&self, other: &Self) -> [Int<3>; 3] {
        let [a, b] = [self, other].map(|p| p.n.map(Int::<3>::from));
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }
}

/// A point with homogeneous integer coordinates: (x / w), w > 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HPointOf<const M: usize> {
    pub x: [Int<M>; 3],
    pub w: Int<M>,
}

/// Wide enough for a point on three facet planes.
pub(crate) type HPoint = HPointOf<5>;

impl HPoint {
    pub(crate) fn grid(p: [i64; 3]) -> Self {
        Self { x: p.map(Int::from), w: Int::from(1i128) }
    }

    /// The point where the line through p and q meets the plane; p and q must not lie on the same side of it, nor
    /// both on it.
    pub(crate) fn on_edge(p: [i64; 3], q: [i64; 3], plane: &Plane) -> Self {
        let (sp, sq) = (plane.side(p), plane.side(q));
        let (fp, fq) = (Int::from(sp), Int::from(sq));
        let x = std::array::from_fn(|k| Int::from(q[k]) * fp - Int::from(p[k]) * fq);
        Self { x, w: Int::from(sp - sq) }.normalised()
    }

    /// The point on three planes, `None` when they do not meet in one point.
    pub(crate) fn on_planes(planes: [&Plane; 3]) -> Option<Self> {
        let [a, b, c] = planes;
        let pairs = [b.direction_with(c), c.direction_with(a), a.direction_with(b)]
            .map(|d| d.map(|x| x.resize::<5>()));
        let w = (0..3).fold(Int::ZERO, |sum, k| sum + Int::from(c.n[k]) * pairs[2][k]);
        if w.sign() == Sign::Zero {
            return None;
        }
        let x = std::array::from_fn(|k| {
            Int::from(a.d) * pairs[0][k] + Int::from(b.d) * pairs[1][k] + Int::from(c.d) * pairs[2][k]
        });
        Some(Self { x, w }.normalised())
    }

    /// The point halfway between two.
    pub(crate) fn midpoint(&self, other: &Self) -> HPointOf<9> {
        let [a, b] = [self, other].map(HPoint::widened::<9>);
        let two = Int::from(2i128);
        HPointOf { x: std::array::from_fn(|k| a.x[k] * b.w + b.x[k] * a.w), w: two * a.w * b.w }
    }

    pub(crate) fn widened<const M: usize>(&self) -> HPointOf<M> {
        HPointOf { x: self.x.map(|x| x.resize()), w: self.w.resize() }
    }

    fn normalised(self) -> Self {
        if self.w.sign() == Sign::Negative { Self { x: self.x.map(|x| -x), w: -self.w } } else { self }
    }

    /// The coordinates, correctly rounded.
    pub(crate) fn rounded(&self) -> [f64; 3] {
        self.x.map(|x| rounded_quotient(&x, &self.w))
    }

    /// The coordinates of the point moved by an integer vector, correctly rounded.
    pub(crate) fn rounded_after(&self, offset: [i128; 3]) -> [f64; 3] {
        let w = self.w.resize::<7>();
        std::array::from_fn(|k| rounded_quotient(&(self.x[k].resize() + Int::from(offset[k]) * w), &w))
    }

    pub(crate) fn cmp_coordinate(&self, other: &Self, axis: usize) -> std::cmp::Ordering {
        let (left, right) = (self.widened::<9>(), other.widened::<9>());
        (left.x[axis] * right.w).cmp(&(right.x[axis] * left.w))
    }

    pub(crate) fn equals(&self, other: &Self) -> bool {
        (0..3).all(|k| self.cmp_coordinate(other, k).is_eq())
    }
}

/// numerator / denominator rounded to the nearest `f64`, ties to even; the denominator is positive.
///
/// The double-double quotient is within 2^-97 of the true one; only when that leaves two candidates is the
/// numerator compared with the midpoint between them.
pub(crate) fn rounded_quotient<const N: usize>(numerator: &Int<N>, denominator: &Int<N>) -> f64 {
    if numerator.sign() == Sign::Zero {
        return 0.0;
    }
    let ((n, n_skip), (d, d_skip)) = (Double::from_int(numerator), Double::from_int(denominator));
    let q = n.over(d);
    let scale = 2f64.powi(64 * (n_skip as i32 - d_skip as i32));
    let error = q.hi.abs() * 2f64.powi(-97);
    let (low, high) = (q.hi + (q.lo - error), q.hi + (q.lo + error));
    if low == high {
        return low * scale;
    }
    match cmp_with_midpoint(numerator, denominator, low * scale, high * scale) {
        std::cmp::Ordering::Less => low * scale,
        std::cmp::Ordering::Greater => high * scale,
        std::cmp::Ordering::Equal if low.to_bits() & 1 == 0 => low * scale,
        std::cmp::Ordering::Equal => high * scale,
    }
}

/// Compares numerator / denominator with (low + high) / 2, low and high being neighbours among the `f64`.
fn cmp_with_midpoint<const N: usize>(
    numerator: &Int<N>,
    denominator: &Int<N>,
    low: f64,
    high: f64,
) -> std::cmp::Ordering {
    let ((a, ea), (b, eb)) = (mantissa(low), mantissa(high));
    let e = ea.min(eb);
    let sum = (a << (ea - e)) + (b << (eb - e));
    let (left, right) = (numerator.resize::<14>(), denominator.resize::<14>() * Int::from(sum));
    // value = sum · 2^(e − 1)
    match e - 1 {
        up if up >= 0 => left.cmp(&right.shifted(up as u32)),
        down => left.shifted(down.unsigned_abs()).cmp(&right),
    }
}

/// x = m · 2^e with an integer m.
fn mantissa(x: f64) -> (i128, i32) {
    let bits = x.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32;
    let fraction = i128::from(bits & ((1 << 52) - 1));
    let (m, e) = if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    (if x < 0.0 { -m } else { m }, e)
}
