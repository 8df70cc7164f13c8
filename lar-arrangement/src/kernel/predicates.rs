//! Predicates on vertices, planes and directions, each with an `f64` filter before the exact answer.

use super::Sign;
use super::geometry::{FloatPlane, Geometry, ROUNDING, Support, Vertex, VertexDef};
use super::point::Plane;
use std::cmp::Ordering;

/// A line's direction by definition: along an input edge, or along the line of two facet planes (n1 × n2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Along {
    Edge([u32; 2]),
    Facets([u32; 2]),
}

/// A direction by definition: that of a line, or against it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Way {
    pub along: Along,
    pub reversed: bool,
}

impl Way {
    pub(crate) fn opposite(self) -> Self {
        Self { reversed: !self.reversed, ..self }
    }
}

/// A direction with its approximation: each component of `float` is within `error` of the exact one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Direction {
    pub along: Along,
    pub reversed: bool,
    float: [f64; 3],
    error: f64,
}

impl Direction {
    pub(crate) fn way(&self) -> Way {
        Way { along: self.along, reversed: self.reversed }
    }

    pub(crate) fn opposite(self) -> Self {
        Self { reversed: !self.reversed, float: self.float.map(|x| -x), ..self }
    }
}

impl Geometry {
    /// On which side of a facet's plane an input point lies: positive on the side of the normal.
    pub(crate) fn side_of_point(&self, p: u32, facet: u32) -> Sign {
        self.seen_from(facet).side(&self.spot(p)).sign
    }

    /// An input point and where it is.
    #[inline]
    pub(crate) fn spot(&self, p: u32) -> Spot {
        Spot { p, at: self.position(p), rounding: self.rounding_of(p) }
    }

    /// Makes ready for several points against one facet's plane.
    #[inline]
    pub(crate) fn seen_from(&self, facet: u32) -> FacetPlane<'_> {
        let is_on_grid = self.grid_point(self.base(facet)[0]).is_some();
        FacetPlane { geometry: self, facet, float: self.float(facet), is_on_grid }
    }

    #[cold]
    fn side_of_point_exactly(&self, p: u32, facet: u32) -> Sign {
        if self.lies_on(p, facet) {
            return Sign::Zero;
        }
        self.counters.count();
        match self.grid_point(p) {
            Some(point) if self.shared_plane(facet).is_none() => {
                let corners = self.base(facet).map(|p| self.nearest_grid_point(p));
                Sign::from(Plane::volume(corners, point))
            }
            _ => self.exact_side(&VertexDef::Point(p), Support::Facet(facet)),
        }
    }

    /// On which side of a plane a vertex lies.
    pub(crate) fn side(&self, v: &Vertex, support: Support) -> Sign {
        match (v.def, support) {
            (VertexDef::Point(p), Support::Facet(f)) => return self.side_of_point(p, f),
            (VertexDef::Point(p), Support::Vertical { ends, axis }) => {
                return self.turn_to(ends, p, axis.into());
            }
            (_, Support::Facet(f)) => {
                if let Some(sign) = self.float(f).side_of_rounded(v.at) {
                    return sign;
                }
                if self.is_made_on(&v.def, f) {
                    return Sign::Zero;
                }
            }
            (_, Support::Vertical { .. }) => {}
        }
        self.counters.count();
        self.exact_side(&v.def, support)
    }

    /// Whether the definition of a vertex puts it on the shared plane of a facet.
    fn is_made_on(&self, def: &VertexDef, facet: u32) -> bool {
        let Some((plane, _)) = self.shared_plane(facet) else { return false };
        let shares = |f: u32| self.shared_plane(f).is_some_and(|(other, _)| other == plane);
        match *def {
            VertexDef::Point(p) => self.is_defined_on(p, plane),
            VertexDef::EdgePlane { ends, support } => {
                matches!(support, Support::Facet(f) if shares(f))
                    || ends.iter().all(|&p| self.is_defined_on(p, plane))
            }
            VertexDef::Facets(facets) => facets.into_iter().any(shares),
        }
    }

    /// Order of two input points along a coordinate axis.
    pub(crate) fn cmp_points(&self, p: u32, q: u32, axis: usize) -> Ordering {
        self.cmp_coordinate(&self.point_vertex(p), &self.point_vertex(q), axis)
    }

    /// Order of two vertices along a coordinate axis.
    pub(crate) fn cmp_coordinate(&self, a: &Vertex, b: &Vertex, axis: usize) -> Ordering {
        match a.at[axis].total_cmp(&(b.at[axis])) {
            _ if a.at[axis] == b.at[axis] => self.cmp_coordinate_exactly(a, b, axis),
            order => order,
        }
    }

    fn cmp_coordinate_exactly(&self, a: &Vertex, b: &Vertex, axis: usize) -> Ordering {
        self.cmp_coordinate_by_definition([&a.def, &b.def], axis).unwrap_or_else(|| {
            self.counters.count();
            self.exact_order(&a.def, &b.def, axis)
        })
    }

    /// Order of two vertices along a coordinate axis, where their definitions are the same or [give](Self::coordinate) the
    /// coordinates.
    pub(crate) fn cmp_coordinate_by_definition(
        &self,
        [a, b]: [&VertexDef; 2],
        axis: usize,
    ) -> Option<Ordering> {
        if a == b {
            return Some(Ordering::Equal);
        }
        let ([x, v], [y, w]) = (self.coordinate(a, axis)?, self.coordinate(b, axis)?);
        // At most 83 bits times 42.
        Some((x * w).cmp(&(y * v)))
    }

    /// Whether two vertices are the same point.
    pub(crate) fn coincide(&self, a: &Vertex, b: &Vertex) -> bool {
        a.at == b.at
            && (a.def == b.def
                || self.coincide_by_definition([&a.def, &b.def]).unwrap_or_else(|| {
                    self.counters.count();
                    self.exact_equality(&a.def, &b.def)
                }))
    }

    /// Whether two vertices are the same point, where their definitions [give](Self::coordinate) the coordinates.
    fn coincide_by_definition(&self, defs: [&VertexDef; 2]) -> Option<bool> {
        for axis in 0..3 {
            if self.cmp_coordinate_by_definition(defs, axis)?.is_ne() {
                return Some(false);
            }
        }
        Some(true)
    }

    /// A direction with its approximation.
    pub(crate) fn direction(&self, along: Along) -> Direction {
        let (float, error) = match along {
            Along::Edge(ends) => self.difference(ends),
            Along::Facets(facets) => self.cross_product(facets),
        };
        Direction { along, reversed: false, float, error }
    }

    /// The direction of a way with its approximation.
    pub(crate) fn towards(&self, way: Way) -> Direction {
        let along = self.direction(way.along);
        if way.reversed { along.opposite() } else { along }
    }

    #[inline]
    fn difference(&self, ends: [u32; 2]) -> ([f64; 3], f64) {
        let [a, b] = ends.map(|p| self.position(p));
        let is_exact = ends.iter().all(|&p| self.grid_point(p).is_some());
        // Two rounded positions and the rounding of their difference.
        (std::array::from_fn(|k| b[k] - a[k]), if is_exact { 0.0 } else { 4.0 * ROUNDING })
    }

    #[inline]
    pub(super) fn cross_product(&self, facets: [u32; 2]) -> ([f64; 3], f64) {
        let [m, n] = facets.map(|f| self.normal(f));
        let largest = |v: [f64; 3]| v[0].abs().max(v[1].abs()).max(v[2].abs());
        let cross = [m[1] * n[2] - m[2] * n[1], m[2] * n[0] - m[0] * n[2], m[0] * n[1] - m[1] * n[0]];
        // Each of two products carries three roundings of 2^-53, their difference, which may be as large as
        // both together, one more: 8 · 2^-53 and terms of 2^-104, for which the bound is doubled.
        (cross, largest(m) * largest(n) * 2f64.powi(-49))
    }

    /// An axis along which the line of two facets' planes is not at right angles.
    pub(crate) fn axis_of_line(&self, facets: [u32; 2]) -> usize {
        let (float, error) = self.cross_product(facets);
        let axis = longest_axis(float);
        if float[axis].abs() > error { axis } else { self.axis_of(&self.direction(Along::Facets(facets))).0 }
    }

    /// An axis along which the direction is not zero, and the sign of that component.
    pub(crate) fn axis_of(&self, d: &Direction) -> (usize, Sign) {
        let axis = longest_axis(d.float);
        if d.float[axis].abs() > d.error {
            return (axis, Sign::from(d.float[axis].signum() as i8));
        }
        self.counters.count();
        self.exact_axis(d)
    }

    /// Sign of the cross product of two directions in the projection onto axes u, v.
    pub(crate) fn turn(&self, a: &Direction, b: &Direction, u: usize, v: usize) -> Sign {
        let (left, right) = (a.float[u] * b.float[v], a.float[v] * b.float[u]);
        let cross = left - right;
        let reach = |d: &Direction| d.float[u].abs() + d.float[v].abs();
        let error = a.error * (reach(b) + 2.0 * b.error) + b.error * reach(a);
        if cross.abs() > 2.0 * error + (left.abs() + right.abs()) * 2f64.powi(-50) {
            return Sign::from(cross.signum() as i8);
        }
        self.counters.count();
        self.exact_turn(a, b, u, v)
    }

    /// Sign of one component of a direction.
    pub(crate) fn component(&self, d: &Direction, axis: usize) -> Sign {
        if d.float[axis].abs() > d.error || d.error == 0.0 {
            return sign_of(d.float[axis]);
        }
        if self.is_made_upright(d, axis) {
            return Sign::Zero;
        }
        self.counters.count();
        self.exact_component(d, axis)
    }

    /// Whether a direction is at right angles to an axis by its definition: both ends of the edge lie on a plane that is, or
    /// both products of components of the normals are zero, which rounding keeps.
    fn is_made_upright(&self, d: &Direction, axis: usize) -> bool {
        match d.along {
            Along::Edge(ends) => self.coordinate_of_edge(ends, axis).is_some(),
            Along::Facets(facets) => {
                let ([m, n], u, v) = (facets.map(|f| self.normal(f)), (axis + 1) % 3, (axis + 2) % 3);
                (m[u] == 0.0 || n[v] == 0.0) && (m[v] == 0.0 || n[u] == 0.0)
            }
        }
    }

    /// Sign of det(n1, n2, d): positive when turning by less than half a turn about d leads from n1 to n2.
    pub(crate) fn turn_about(&self, f: u32, g: u32, d: &Direction) -> Sign {
        let (m, n) = (self.normal(f), self.normal(g));
        let products = [[m[1] * n[2], m[2] * n[1]], [m[2] * n[0], m[0] * n[2]], [m[0] * n[1], m[1] * n[0]]];
        let mut det = 0.0;
        let mut magnitude = 0.0;
        let mut reach = 0.0;
        for ([p, q], along) in products.into_iter().zip(d.float) {
            det += (p - q) * along;
            magnitude += (p.abs() + q.abs()) * along.abs();
            reach += p.abs() + q.abs();
        }
        if det.abs() > magnitude * 2f64.powi(-49) + reach * d.error * 1.5 {
            return Sign::from(det.signum() as i8);
        }
        // Normals along one axis: rounding keeps zeros.
        if reach == 0.0 {
            return Sign::Zero;
        }
        self.counters.count();
        self.exact_turn_about(Support::Facet(f), Support::Facet(g), d)
    }

    /// Whether two facets lie in one plane.
    pub(crate) fn is_coplanar(&self, f: u32, g: u32) -> bool {
        f == g
            || (!self.is_across(f, g) && self.base(g).iter().all(|&p| self.side_of_point(p, f) == Sign::Zero))
    }

    /// Whether the planes of two facets are not parallel beyond doubt.
    pub(super) fn is_across(&self, f: u32, g: u32) -> bool {
        let (line, error) = self.cross_product([f, g]);
        line.iter().any(|x| x.abs() > error)
    }

    /// For two facets with parallel planes: whether their normals point the same way.
    pub(crate) fn same_way(&self, f: u32, g: u32) -> bool {
        let (axis, up) = self.dominant_axis(f);
        up == (self.normal(g)[axis] > 0.0)
    }

    /// Sign of component `axis` of the facet's normal (exact: rounding keeps signs).
    pub(crate) fn normal_sign(&self, facet: u32, axis: usize) -> Sign {
        sign_of(self.normal(facet)[axis])
    }

    /// Orientation of three vertices in the projection onto axes u, v.
    pub(crate) fn orientation(&self, p: &Vertex, q: &Vertex, m: &Midpoint, u: usize, v: usize) -> Sign {
        let d = |a: f64, b: f64| a - b;
        let (pu, pv) = (d(p.at[u], m.at[u]), d(p.at[v], m.at[v]));
        let (qu, qv) = (d(q.at[u], m.at[u]), d(q.at[v], m.at[v]));
        let (left, right) = (pu * qv, pv * qu);
        let det = left - right;
        // Each difference is off by at most 2^-12 (positions) + 2^-12 (midpoint) + 2^-12 (rounding) < 2^-10.
        let slack = (pu.abs() + pv.abs() + qu.abs() + qv.abs() + 1.0) * 8.0 * ROUNDING;
        if det.abs() > slack + (left.abs() + right.abs()) * 2f64.powi(-50) {
            return sign_of(det);
        }
        self.counters.count();
        self.exact_orientation(&p.def, &q.def, m, u, v)
    }

    /// The point halfway between two vertices.
    pub(crate) fn midpoint(&self, a: &Vertex, b: &Vertex) -> Midpoint {
        Midpoint { at: std::array::from_fn(|k| (a.at[k] + b.at[k]) / 2.0), of: [a.def, b.def] }
    }

    /// Order of a vertex and a midpoint along an axis.
    pub(crate) fn cmp_with_midpoint(&self, a: &Vertex, m: &Midpoint, axis: usize) -> Ordering {
        let gap = a.at[axis] - m.at[axis];
        // The vertex is off by 2^-13, the midpoint by 2^-12, the difference by 2^-13.
        if gap.abs() > 8.0 * ROUNDING {
            return gap.total_cmp(&0.0);
        }
        self.counters.count();
        self.exact_order_with_midpoint(&a.def, m, axis)
    }

    /// On which side of a facet's plane a midpoint lies.
    pub(crate) fn side_of_midpoint(&self, m: &Midpoint, facet: u32) -> Sign {
        if let Some(sign) = self.float(facet).side_of_rounded(m.at) {
            return sign;
        }
        self.counters.count();
        self.exact_side_of_midpoint(m, Support::Facet(facet))
    }

    /// Order in which the ray from a midpoint towards −x meets the planes of two facets, neither of them parallel to
    /// it; in one point, as if the start were moved by (0, 1, ε).
    pub(crate) fn cmp_hits(&self, m: &Midpoint, facets: [u32; 2]) -> Ordering {
        let [(a, error_a), (b, error_b)] = facets.map(|f| self.float(f).distance(m.at));
        if (a - b).abs() > error_a + error_b {
            return a.total_cmp(&b);
        }
        self.counters.count();
        let [f, g] = facets.map(Support::Facet);
        self.exact_order_of_hits(m, f, g)
    }
}

/// The plane of a facet, for tests of several points.
pub(crate) struct FacetPlane<'a> {
    geometry: &'a Geometry,
    facet: u32,
    float: FloatPlane,
    /// Whether its origin is a point of the grid.
    is_on_grid: bool,
}

impl FacetPlane<'_> {
    /// On which side an input point lies.
    ///
    /// Differences of grid coordinates are exact in f64 (41 bits), those of others within the slack; with three
    /// normal components off by 1.5 · 2^-53, three products and two sums the error is below 7 · 2^-53 of the sum of the
    /// products' magnitudes. Differences and components round to zero only when they are zero, and products do not
    /// underflow.
    ///
    /// A call, which returns three values by memory, would take longer than the rest.
    #[inline(always)]
    pub(crate) fn side(&self, point: &Spot) -> Side {
        let (height, magnitude) = self.float.sum(point.at);
        let is_exact = self.is_on_grid && point.rounding == 0.0;
        let slack = if is_exact { 0.0 } else { self.float.slack };
        let error = magnitude * 2f64.powi(-50) + slack;
        let sign = sign_within(height, error)
            .unwrap_or_else(|| self.geometry.side_of_point_exactly(point.p, self.facet));
        Side { sign, height, error }
    }
}

/// An input point and where it is, for tests against several planes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub p: u32,
    /// Its position, correctly rounded.
    pub at: [f64; 3],
    /// How far that may be off: 0 for a point of the grid.
    pub rounding: f64,
}

/// On which side of a facet's plane an input point lies: positive on the side of the normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub sign: Sign,
    /// The height over the plane, up to a positive factor, within `error`.
    height: f64,
    error: f64,
}

/// A coordinate of the point where an edge passes through a plane, and a bound on its error, from the sides of the ends.
pub(crate) fn crossing_near([p, q]: [&Spot; 2], [of_p, of_q]: [&Side; 2], axis: usize) -> (f64, f64) {
    let (whole, step) = (of_p.height - of_q.height, q.at[axis] - p.at[axis]);
    let of_sides = of_p.error + of_q.error;
    if 4.0 * of_sides >= whole.abs() {
        return (p.at[axis], f64::INFINITY);
    }
    // The part of the way is at most 1: it is off by little more than twice the sides' error over the whole.
    let of_part = 3.0 * of_sides / whole.abs() + 2f64.powi(-50);
    let of_ends = 4.0 * (p.rounding + q.rounding);
    let error = step.abs() * of_part + p.at[axis].abs() * 2f64.powi(-51) + of_ends;
    (p.at[axis] + step * (of_p.height / whole), error)
}

impl FloatPlane {
    /// n · (p − o), and the sum of the products' magnitudes.
    #[inline]
    fn sum(&self, p: [f64; 3]) -> (f64, f64) {
        let terms: [f64; 3] = std::array::from_fn(|k| self.normal[k] * (p[k] - self.origin[k]));
        (terms[0] + terms[1] + terms[2], terms[0].abs() + terms[1].abs() + terms[2].abs())
    }

    /// A bound on the error of `sum` for a rounded position: it, the origin and a midpoint are off by 2^-12 at most,
    /// the difference by another 2^-12.
    fn error(&self, magnitude: f64) -> f64 {
        let weight = self.normal[0].abs() + self.normal[1].abs() + self.normal[2].abs();
        magnitude * 2f64.powi(-50) + weight * 8.0 * ROUNDING
    }

    /// The side of a vertex or a midpoint, when it is beyond doubt.
    fn side_of_rounded(&self, at: [f64; 3]) -> Option<Sign> {
        let (sum, magnitude) = self.sum(at);
        (sum.abs() > self.error(magnitude)).then(|| sign_of(sum))
    }

    /// How far from a rounded position the ray towards −x meets the plane, and a bound on the error.
    fn distance(&self, at: [f64; 3]) -> (f64, f64) {
        let (sum, magnitude) = self.sum(at);
        let distance = sum / self.normal[0];
        (distance, 2.0 * self.error(magnitude) / self.normal[0].abs() + distance.abs() * 2f64.powi(-50))
    }
}

/// The point halfway between two vertices: the inside of an edge, where rays start.
#[derive(Clone, Debug)]
pub(crate) struct Midpoint {
    pub at: [f64; 3],
    pub of: [VertexDef; 2],
}

/// The axis along which a vector is longest, the first of equal ones.
pub(crate) fn longest_axis(v: [f64; 3]) -> usize {
    (1..3).fold(0, |best, k| if v[k].abs() > v[best].abs() { k } else { best })
}

/// The sign of a number that is within `error` of x, when it is beyond doubt. Nothing here is a branch, which would be predicted
/// badly.
#[inline(always)]
pub(super) fn sign_within(x: f64, error: f64) -> Option<Sign> {
    let sign = Sign::from(i8::from(x > error) - i8::from(x < -error));
    ((sign != Sign::Zero) | (error == 0.0)).then_some(sign)
}

pub(super) fn sign_of(x: f64) -> Sign {
    if x > 0.0 {
        Sign::Positive
    } else if x < 0.0 {
        Sign::Negative
    } else {
        Sign::Zero
    }
}
