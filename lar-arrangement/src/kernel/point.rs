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
    // Coordinates have 41 bits. Products of what is known to fit 64 bits take one instruction.
    std::array::from_fn(|k| i128::from(a[k] - b[k]))
}

pub(super) fn cross(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn dot(n: [i128; 3], p: [i64; 3]) -> i128 {
    n[0] * i128::from(p[0]) + n[1] * i128::from(p[1]) + n[2] * i128::from(p[2])
}

/// The axis of the component that is largest, the first of equal ones.
pub(crate) fn dominant_axis(n: [i128; 3]) -> usize {
    (1..3).fold(0, |best, k| if n[k].abs() > n[best].abs() { k } else { best })
}

impl Plane {
    /// The plane through three points, its normal pointing to where they turn counter-clockwise.
    pub(crate) fn through(a: [i64; 3], b: [i64; 3], c: [i64; 3]) -> Self {
        let n = Self::normal_through(a, b, c);
        Self { n, d: dot(n, a) }
    }

    /// The normal of the plane through three points.
    pub(crate) fn normal_through(a: [i64; 3], b: [i64; 3], c: [i64; 3]) -> [i128; 3] {
        cross(wide_difference(b, a), wide_difference(c, a))
    }

    /// Six times the volume of the tetrahedron over a triangle: positive where its normal points. At most 125 bits.
    pub(crate) fn volume([a, b, c]: [[i64; 3]; 3], p: [i64; 3]) -> i128 {
        dot(Self::normal_through(a, b, c), std::array::from_fn(|k| p[k] - a[k]))
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

    /// The length of the normal, rounded.
    pub(crate) fn length(&self) -> f64 {
        self.n.map(|x| (x as f64).powi(2)).iter().sum::<f64>().sqrt()
    }

    /// n · p − d.
    pub(crate) fn side(&self, p: [i64; 3]) -> i128 {
        dot(self.n, p) - self.d
    }

    /// The same plane in another width.
    pub(crate) fn widened<const W: usize>(&self) -> PlaneOf<W> {
        PlaneOf { n: self.n.map(Int::from), d: Int::from(self.d) }
    }
}

/// A plane with coefficients of W limbs, every operation done in that width.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneOf<const W: usize> {
    pub n: [Int<W>; 3],
    pub d: Int<W>,
}

impl<const W: usize> PlaneOf<W> {
    /// The plane through three points, its normal pointing to where they turn counter-clockwise.
    pub(crate) fn through(a: &HPointOf<W>, b: &HPointOf<W>, c: &HPointOf<W>) -> Self {
        let [ab, bc, ca] = [wide_cross(&a.x, &b.x), wide_cross(&b.x, &c.x), wide_cross(&c.x, &a.x)];
        Self { n: std::array::from_fn(|k| ab[k] * c.w + bc[k] * a.w + ca[k] * b.w), d: wide_dot(&a.x, &bc) }
    }

    /// As `Plane::vertical`, up to a positive factor.
    pub(crate) fn vertical(a: &HPointOf<W>, b: &HPointOf<W>, axis: usize) -> Self {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let e = |k: usize| b.x[k] * a.w - a.x[k] * b.w;
        let (nu, nv) = (-e(v), e(u));
        let mut n = [Int::ZERO; 3];
        n[u] = nu * a.w;
        n[v] = nv * a.w;
        Self { n, d: nu * a.x[u] + nv * a.x[v] }
    }

    /// The plane that looks the other way.
    pub(crate) fn opposite(&self) -> Self {
        Self { n: self.n.map(|x| -x), d: -self.d }
    }

    /// (n · p − d) times the (positive) denominator of p.
    pub(crate) fn scaled_side(&self, p: &HPointOf<W>) -> Int<W> {
        wide_dot(&self.n, &p.x) - self.d * p.w
    }

    /// The direction of the line of two planes.
    pub(crate) fn direction_with(&self, other: &Self) -> [Int<W>; 3] {
        wide_cross(&self.n, &other.n)
    }

    pub(crate) fn widened<const M: usize>(&self) -> PlaneOf<M> {
        PlaneOf { n: self.n.map(|x| x.resize()), d: self.d.resize() }
    }
}

fn wide_cross<const W: usize>(a: &[Int<W>; 3], b: &[Int<W>; 3]) -> [Int<W>; 3] {
    let minor = |u: usize, v: usize| a[u] * b[v] - a[v] * b[u];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn wide_dot<const W: usize>(a: &[Int<W>; 3], b: &[Int<W>; 3]) -> Int<W> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A point with homogeneous integer coordinates: (x / w), w > 0, every operation done in the width of W limbs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HPointOf<const W: usize> {
    pub x: [Int<W>; 3],
    pub w: Int<W>,
}

impl<const W: usize> HPointOf<W> {
    pub(crate) fn grid(p: [i64; 3]) -> Self {
        Self { x: p.map(Int::from), w: Int::from(1i128) }
    }

    /// The point where the line through the grid points p and q meets the plane; they must not lie on the same side
    /// of it, nor both on it.
    pub(crate) fn on_grid_edge(p: [i64; 3], q: [i64; 3], plane: &Plane) -> Self {
        let sides = [plane.side(p), plane.side(q)];
        let coordinates: [_; 3] = std::array::from_fn(|k| Self::coordinate_on_grid_edge([p[k], q[k]], sides));
        Self { x: coordinates.map(|c| c[0]), w: coordinates[0][1] }
    }

    /// A coordinate of that point from those of the ends and the sides that they are on: numerator and denominator.
    pub(crate) fn coordinate_on_grid_edge([p, q]: [i64; 2], [sp, sq]: [i128; 2]) -> [Int<W>; 2] {
        let (x, w) = (Int::from(q) * Int::from(sp) - Int::from(p) * Int::from(sq), Int::from(sp - sq));
        if sp < sq { [-x, -w] } else { [x, w] }
    }

    /// As `on_grid_edge`, for any two points.
    pub(crate) fn on_edge(p: &Self, q: &Self, plane: &PlaneOf<W>) -> Self {
        let (sp, sq) = (plane.scaled_side(p), plane.scaled_side(q));
        Self { x: std::array::from_fn(|k| q.x[k] * sp - p.x[k] * sq), w: q.w * sp - p.w * sq }.normalised()
    }

    /// The point on three planes, `None` when they do not meet in one point.
    pub(crate) fn on_planes(planes: [&PlaneOf<W>; 3]) -> Option<Self> {
        let [a, b, c] = planes;
        let pairs = [b.direction_with(c), c.direction_with(a), a.direction_with(b)];
        let w = wide_dot(&c.n, &pairs[2]);
        if w.sign() == Sign::Zero {
            return None;
        }
        let x = std::array::from_fn(|k| a.d * pairs[0][k] + b.d * pairs[1][k] + c.d * pairs[2][k]);
        Some(Self { x, w }.normalised())
    }

    /// The point halfway between two.
    pub(crate) fn midpoint(&self, other: &Self) -> Self {
        let two = Int::from(2i128);
        Self {
            x: std::array::from_fn(|k| self.x[k] * other.w + other.x[k] * self.w),
            w: two * self.w * other.w,
        }
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
        std::array::from_fn(|k| rounded_quotient(&(self.x[k] + Int::from(offset[k]) * self.w), &self.w))
    }

    pub(crate) fn cmp_coordinate(&self, other: &Self, axis: usize) -> std::cmp::Ordering {
        (self.x[axis] * other.w).cmp(&(other.x[axis] * self.w))
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

/// Limbs that hold the widest numerator and denominator of a vertex, moved from the grid's origin and multiplied by
/// 54 bits.
const MIDPOINT: usize = 25;

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
    let (left, right) = (numerator.resize::<MIDPOINT>(), denominator.resize::<MIDPOINT>() * Int::from(sum));
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
