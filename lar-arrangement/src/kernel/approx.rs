//! Positions of vertices by double-double arithmetic with running error bounds: the filter before the exact quotient.
//!
//! Values carry about 106 bits, grid coordinates have 41, a rounded position keeps 53: all but one in a million
//! positions in general place are decided here.

use super::double::{Double, Fraction};
use super::geometry::{Geometry, Support, VertexDef};
use super::point::{self, HPointOf, Plane, PlaneOf};

/// A number within `error` of `value`. The errors are sums of positive terms, computed in `f64`: they are doubled
/// when they decide.
#[derive(Clone, Copy, Debug)]
struct Approx {
    value: Double,
    error: f64,
}

/// What underflow may lose in a product.
const UNDERFLOW: f64 = f64::MIN_POSITIVE * (1u64 << 60) as f64;

impl Approx {
    /// A value that was rounded once to a double-double, by a part of 2^-97 at most.
    fn rounded(value: Double) -> Self {
        Self { value, error: value.hi.abs() * 2f64.powi(-97) }
    }

    fn over(self, divisor: Self) -> Option<Self> {
        let least = divisor.value.hi.abs() * (1.0 - 2f64.powi(-50)) - 2.0 * divisor.error;
        if least <= 0.0 {
            return None;
        }
        let value = self.value.over(divisor.value);
        let error = (self.error + value.hi.abs() * divisor.error) / least + value.hi.abs() * 2f64.powi(-97);
        Some(Self { value, error: error * (1.0 + 2f64.powi(-40)) })
    }

    /// The nearest `f64`, when that is beyond doubt.
    fn nearest(self) -> Option<f64> {
        let Double { hi, lo } = self.value;
        let (least, most) = (hi + (lo - 2.0 * self.error), hi + (lo + 2.0 * self.error));
        (least == most).then_some(least)
    }
}

impl std::ops::Add for Approx {
    type Output = Self;

    /// The high parts are added exactly; three roundings of low parts are below 2^-104 of the terms each.
    fn add(self, other: Self) -> Self {
        let terms = self.value.hi.abs() + other.value.hi.abs();
        Self { value: self.value.sum(other.value), error: self.error + other.error + terms * 2f64.powi(-102) }
    }
}

impl std::ops::Sub for Approx {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        std::ops::Add::add(self, Self { value: other.value.negated(), ..other })
    }
}

impl std::ops::Mul for Approx {
    type Output = Self;

    /// The high parts are multiplied exactly; what is left out and the roundings of low parts stay below 2^-102 of the
    /// product.
    fn mul(self, other: Self) -> Self {
        let value = self.value.product(other.value);
        let from_factors =
            (self.value.hi.abs() + self.error) * other.error + other.value.hi.abs() * self.error;
        Self { value, error: from_factors + value.hi.abs() * 2f64.powi(-101) + UNDERFLOW }
    }
}

/// A plane n · x = d up to a factor, the largest component of n about 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct ApproxPlane {
    n: [Double; 3],
    d: Double,
}

impl ApproxPlane {
    pub(super) fn new<const W: usize>(plane: &PlaneOf<W>) -> Self {
        let bits = plane.n.iter().map(super::Int::bits).max().unwrap_or(0) as i32;
        let near = |x: &super::Int<W>| {
            let (double, skip) = Double::from_int(x);
            double.scaled(2f64.powi(64 * skip as i32 - bits))
        };
        Self { n: [near(&plane.n[0]), near(&plane.n[1]), near(&plane.n[2])], d: near(&plane.d) }
    }

    fn coefficients(&self) -> ([Approx; 3], Approx) {
        (self.n.map(Approx::rounded), Approx::rounded(self.d))
    }
}

/// The coordinates of a rational point.
pub(super) fn approx_point<const W: usize>(p: &HPointOf<W>) -> [Double; 3] {
    let (w, w_skip) = Double::from_int(&p.w);
    [0, 1, 2].map(|k| {
        let (x, skip) = Double::from_int(&p.x[k]);
        x.over(w).scaled(2f64.powi(64 * (skip as i32 - w_skip as i32)))
    })
}

fn dot(a: &[Approx; 3], b: &[Approx; 3]) -> Approx {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &[Approx; 3], b: &[Approx; 3]) -> [Approx; 3] {
    let minor = |u: usize, v: usize| a[u] * b[v] - a[v] * b[u];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// The point on three planes with coefficients of 41 bits and offsets of 83, when its roundings are beyond doubt.
///
/// Minors have 82 bits and the determinant 124. The numerators have 166 and become double-doubles with a relative error
/// below 2^-103; so the quotients' is below 2^-97.
fn on_canonical_planes([a, b, c]: [&Plane; 3]) -> Option<[f64; 3]> {
    // Known to fit 64 bits, so that products take one instruction.
    let [l, m, n] = [a, b, c].map(|plane| plane.n.map(|x| x as i64));
    let cross = |a: [i64; 3], b: [i64; 3]| point::cross(a.map(i128::from), b.map(i128::from));
    let pairs = [cross(m, n), cross(n, l), cross(l, m)];
    let w = point::dot(pairs[2], n);
    let by = Double::from_i128(w);
    let coordinate = |k: usize| {
        let x = Double::from_products([(a.d, pairs[0][k]), (b.d, pairs[1][k]), (c.d, pairs[2][k])]);
        let value = x.over(by);
        Approx { value, error: value.hi.abs() * 2f64.powi(-97) }.nearest()
    };
    // Adding zero makes −0 and 0 one.
    Some([coordinate(0)? + 0.0, coordinate(1)? + 0.0, coordinate(2)? + 0.0])
}

impl Geometry {
    /// The correctly rounded position of a vertex.
    pub(super) fn rounded(&self, def: &VertexDef) -> [f64; 3] {
        self.nearly_rounded(def).unwrap_or_else(|| self.exactly_rounded(def))
    }

    fn nearly_rounded(&self, def: &VertexDef) -> Option<[f64; 3]> {
        match *def {
            VertexDef::Point(p) => Some(self.position(p)),
            VertexDef::EdgePlane { ends, support } => match self.on_grid_edge(ends, support) {
                Some(decided) => decided,
                None => self.on_edge(ends, support),
            },
            VertexDef::Facets(facets) => match facets.map(|f| self.canonical_plane_of(f)) {
                [Some(a), Some(b), Some(c)] => on_canonical_planes([a, b, c]),
                _ => self.on_facets(facets),
            },
        }
    }

    /// For an edge and a plane of the grid: the point where they meet, when its roundings are beyond doubt.
    fn on_grid_edge(&self, ends: [u32; 2], support: Support) -> Option<Option<[f64; 3]>> {
        let [p, q] = ends.map(|p| self.grid_point(p));
        let (p, q, plane) = (p?, q?, self.grid_plane(support)?);
        let (sp, sq) = (plane.side(p), plane.side(q));
        let along = Fraction::new(sp.abs(), (sp - sq).abs());
        let coordinate = |k: usize| along.between(p[k], q[k] - p[k]);
        Some((|| Some([coordinate(0)?, coordinate(1)?, coordinate(2)?]))())
    }

    fn on_edge(&self, ends: [u32; 2], support: Support) -> Option<[f64; 3]> {
        let [p, q] = ends.map(|p| self.approx_point(p));
        let (n, d) = self.approx_plane(support)?.coefficients();
        let (sp, sq) = (dot(&n, &p) - d, dot(&n, &q) - d);
        let along = sp.over(sp - sq)?;
        let coordinate = |k: usize| (p[k] + (q[k] - p[k]) * along).nearest();
        Some([coordinate(0)?, coordinate(1)?, coordinate(2)?])
    }

    fn on_facets(&self, facets: [u32; 3]) -> Option<[f64; 3]> {
        let [a, b, c] = facets.map(|f| self.approx_plane(Support::Facet(f)));
        let ((l, d), (m, e), (n, f)) = (a?.coefficients(), b?.coefficients(), c?.coefficients());
        let [mn, nl, lm] = [cross(&m, &n), cross(&n, &l), cross(&l, &m)];
        let w = dot(&n, &lm);
        let coordinate = |k: usize| (d * mn[k] + e * nl[k] + f * lm[k]).over(w)?.nearest();
        Some([coordinate(0)?, coordinate(1)?, coordinate(2)?])
    }

    fn canonical_plane_of(&self, facet: u32) -> Option<&Plane> {
        let (plane, _) = self.shared_plane(facet)?;
        self.canonical_plane(plane)
    }

    fn approx_point(&self, p: u32) -> [Approx; 3] {
        match self.close_position(p) {
            Some(position) => position.map(Approx::rounded),
            None => self.position(p).map(|x| Approx { value: Double { hi: x, lo: 0.0 }, error: 0.0 }),
        }
    }

    /// The plane of a facet; none for planes through edges along an axis.
    fn approx_plane(&self, support: Support) -> Option<ApproxPlane> {
        let Support::Facet(facet) = support else { return None };
        match self.shared_plane(facet) {
            Some((plane, _)) => Some(*self.close_plane(plane)),
            None => self.grid_plane(support).map(|plane| ApproxPlane::new(&plane.widened::<2>())),
        }
    }
}
