//! Predicates on vertices, planes and directions, each with an `f64` filter before the exact answer.

use super::point::{HPoint, HPointOf, Plane};
use super::{Int, Sign};
use std::cmp::Ordering;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// How often the `f64` filters could not decide and exact integers did.
#[derive(Debug, Default)]
pub(crate) struct Counters {
    exact: AtomicU64,
}

impl Counters {
    /// Number of predicates that were decided by exact integers.
    #[must_use]
    pub(crate) fn exact(&self) -> u64 {
        self.exact.load(Relaxed)
    }

    fn count(&self) {
        self.exact.fetch_add(1, Relaxed);
    }
}

/// A plane by reference: that of a facet, or the one through an input edge parallel to a coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Support {
    Facet(u32),
    Vertical { ends: [u32; 2], axis: u8 },
}

/// What a vertex is. Numbers of grid points and facets; never a measured position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum VertexDef {
    /// A point of the input.
    Grid(u32),
    /// The line through two input points meets a plane.
    EdgePlane { ends: [u32; 2], support: Support },
    /// Three facet planes.
    Facets([u32; 3]),
}

/// A vertex: its definition and its position in grid units, correctly rounded, so that equal points have equal
/// positions, and a coordinate that is smaller when rounded is smaller exactly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    pub at: [f64; 3],
    pub def: VertexDef,
}

/// A line's direction by definition: along an input edge, or along the line of two facet planes (n1 × n2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Along {
    Edge([u32; 2]),
    Facets([u32; 2]),
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
    pub(crate) fn opposite(self) -> Self {
        Self { reversed: !self.reversed, float: self.float.map(|x| -x), ..self }
    }

    /// The axis along which the approximation is longest.
    fn longest_axis(&self) -> usize {
        (1..3).fold(0, |best, k| if self.float[k].abs() > self.float[best].abs() { k } else { best })
    }
}

/// f64 image of a facet's plane: `normal` is the exact one rounded (relative error 2^-53 a component).
#[derive(Clone, Copy, Debug)]
struct FloatPlane {
    normal: [f64; 3],
    origin: [f64; 3],
}

/// Largest error of a rounded coordinate: half an ulp of 2^40.
const ROUNDING: f64 = 1.0 / 8192.0;

/// The input on the grid and the predicates over it.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    pub points: Vec<[i64; 3]>,
    bases: Vec<[u32; 3]>,
    planes: Vec<FloatPlane>,
    pub counters: Counters,
}

impl Geometry {
    pub(crate) fn new(points: Vec<[i64; 3]>) -> Self {
        Self { points, ..Self::default() }
    }

    /// Adds a facet by three of its vertices that are not collinear and turn counter-clockwise about its normal.
    pub(crate) fn push_facet(&mut self, base: [u32; 3]) {
        let plane = self.plane_of(base);
        self.bases.push(base);
        self.planes.push(FloatPlane {
            normal: plane.n.map(|x| x as f64),
            origin: self.points[base[0] as usize].map(|x| x as f64),
        });
    }

    fn plane_of(&self, base: [u32; 3]) -> Plane {
        let [a, b, c] = base.map(|p| self.points[p as usize]);
        Plane::through(a, b, c)
    }

    pub(crate) fn plane(&self, support: Support) -> Plane {
        match support {
            Support::Facet(f) => self.plane_of(self.bases[f as usize]),
            Support::Vertical { ends, axis } => {
                let [a, b] = ends.map(|p| self.points[p as usize]);
                Plane::vertical(a, b, axis as usize)
            }
        }
    }

    /// Whether a point is one of the three corners that define the facet's plane.
    pub(crate) fn is_base_corner(&self, facet: u32, p: u32) -> bool {
        self.bases[facet as usize].contains(&p)
    }

    /// The three corners that define the facet's plane.
    pub(crate) fn base(&self, facet: u32) -> [u32; 3] {
        self.bases[facet as usize]
    }

    /// The facet's normal, rounded.
    pub(crate) fn normal(&self, facet: u32) -> [f64; 3] {
        self.planes[facet as usize].normal
    }

    /// The axis along which the facet's normal is longest, and whether it points up that axis. The component is
    /// not zero: the largest of three integers, not all zero, does not round to zero.
    pub(crate) fn dominant_axis(&self, facet: u32) -> (usize, bool) {
        let n = self.normal(facet);
        let axis = (1..3).fold(0, |best, k| if n[k].abs() > n[best].abs() { k } else { best });
        (axis, n[axis] > 0.0)
    }

    pub(crate) fn grid_vertex(&self, p: u32) -> Vertex {
        Vertex { at: self.points[p as usize].map(|x| x as f64), def: VertexDef::Grid(p) }
    }

    /// The vertex where an edge meets a plane. Its ends must lie strictly on either side.
    pub(crate) fn edge_vertex(&self, ends: [u32; 2], support: Support) -> Vertex {
        let def = VertexDef::EdgePlane { ends, support };
        Vertex { at: self.exact_point(&def).rounded(), def }
    }

    /// The vertex on three facet planes that are known to meet in one point.
    pub(crate) fn facets_vertex(&self, facets: [u32; 3]) -> Vertex {
        let def = VertexDef::Facets(facets);
        Vertex { at: self.exact_point(&def).rounded(), def }
    }

    /// Homogeneous coordinates from the definition.
    pub(crate) fn exact_point(&self, def: &VertexDef) -> HPoint {
        match *def {
            VertexDef::Grid(p) => HPoint::grid(self.points[p as usize]),
            VertexDef::EdgePlane { ends, support } => {
                let [p, q] = ends.map(|p| self.points[p as usize]);
                HPoint::on_edge(p, q, &self.plane(support))
            }
            VertexDef::Facets(facets) => {
                let [a, b, c] = facets.map(|f| self.plane(Support::Facet(f)));
                HPoint::on_planes([&a, &b, &c])
                    .expect("vertices on three planes are made where the planes cross")
            }
        }
    }

    /// On which side of a facet's plane a grid point lies: positive on the side of the normal.
    ///
    /// Differences of grid coordinates are exact in f64 (41 bits); with three rounded normal components, three
    /// products and two sums the error is below 6 · 2^-53 of the sum of the products' magnitudes.
    pub(crate) fn side_of_point(&self, p: u32, facet: u32) -> Sign {
        let plane = &self.planes[facet as usize];
        let point = self.points[p as usize];
        let terms: [f64; 3] = std::array::from_fn(|k| plane.normal[k] * (point[k] as f64 - plane.origin[k]));
        let sum = terms[0] + terms[1] + terms[2];
        let magnitude = terms[0].abs() + terms[1].abs() + terms[2].abs();
        if sum.abs() > magnitude * 2f64.powi(-50) {
            return Sign::from(sum.signum() as i8);
        }
        self.counters.count();
        Sign::from(self.plane(Support::Facet(facet)).side(point))
    }

    /// On which side of a plane a vertex lies.
    ///
    /// A rounded coordinate is off by 2^-13, the difference by another 2^-12 of rounding: together below 2^-11.
    pub(crate) fn side(&self, v: &Vertex, support: Support) -> Sign {
        match (v.def, support) {
            (VertexDef::Grid(p), Support::Facet(f)) => return self.side_of_point(p, f),
            (VertexDef::Grid(p), Support::Vertical { .. }) => {
                return Sign::from(self.plane(support).side(self.points[p as usize]));
            }
            (_, Support::Facet(f)) => {
                let plane = &self.planes[f as usize];
                let terms: [f64; 3] = std::array::from_fn(|k| plane.normal[k] * (v.at[k] - plane.origin[k]));
                let sum = terms[0] + terms[1] + terms[2];
                let magnitude = terms[0].abs() + terms[1].abs() + terms[2].abs();
                let weight = plane.normal[0].abs() + plane.normal[1].abs() + plane.normal[2].abs();
                if sum.abs() > magnitude * 2f64.powi(-50) + weight * 2f64.powi(-11) {
                    return Sign::from(sum.signum() as i8);
                }
            }
            (_, Support::Vertical { .. }) => {}
        }
        self.counters.count();
        self.plane(support).side_of(&self.exact_point(&v.def))
    }

    /// Order of two vertices along a coordinate axis.
    pub(crate) fn cmp_coordinate(&self, a: &Vertex, b: &Vertex, axis: usize) -> Ordering {
        match a.at[axis].total_cmp(&(b.at[axis])) {
            _ if a.at[axis] == b.at[axis] => self.cmp_coordinate_exactly(a, b, axis),
            order => order,
        }
    }

    fn cmp_coordinate_exactly(&self, a: &Vertex, b: &Vertex, axis: usize) -> Ordering {
        match (a.def, b.def) {
            (VertexDef::Grid(p), VertexDef::Grid(q)) => {
                self.points[p as usize][axis].cmp(&self.points[q as usize][axis])
            }
            (p, q) if p == q => Ordering::Equal,
            (p, q) => {
                self.counters.count();
                self.exact_point(&p).cmp_coordinate(&self.exact_point(&q), axis)
            }
        }
    }

    /// Whether two vertices are the same point.
    pub(crate) fn coincide(&self, a: &Vertex, b: &Vertex) -> bool {
        a.at == b.at
            && (a.def == b.def || {
                self.counters.count();
                self.exact_point(&a.def).equals(&self.exact_point(&b.def))
            })
    }

    /// A direction with its approximation.
    pub(crate) fn direction(&self, along: Along) -> Direction {
        let (float, error) = match along {
            Along::Edge([a, b]) => {
                let [a, b] = [a, b].map(|p| self.points[p as usize]);
                (std::array::from_fn(|k| (b[k] - a[k]) as f64), 0.0)
            }
            Along::Facets([f, g]) => {
                let (m, n) = (self.normal(f), self.normal(g));
                let largest = |v: [f64; 3]| v[0].abs().max(v[1].abs()).max(v[2].abs());
                let cross = [m[1] * n[2] - m[2] * n[1], m[2] * n[0] - m[0] * n[2], m[0] * n[1] - m[1] * n[0]];
                // Each of two products carries three roundings of 2^-53, their difference, which may be as large as
                // both together, one more: 8 · 2^-53 and terms of 2^-104, for which the bound is doubled.
                (cross, largest(m) * largest(n) * 2f64.powi(-49))
            }
        };
        Direction { along, reversed: false, float, error }
    }

    fn exact_direction(&self, d: &Direction) -> [Int<3>; 3] {
        let vector = match d.along {
            Along::Edge([a, b]) => {
                let [a, b] = [a, b].map(|p| self.points[p as usize]);
                std::array::from_fn(|k| Int::from(b[k] - a[k]))
            }
            Along::Facets([f, g]) => {
                self.plane(Support::Facet(f)).direction_with(&self.plane(Support::Facet(g)))
            }
        };
        if d.reversed { vector.map(|x| -x) } else { vector }
    }

    /// An axis along which the direction is not zero, and the sign of that component.
    pub(crate) fn axis_of(&self, d: &Direction) -> (usize, Sign) {
        let axis = d.longest_axis();
        if d.float[axis].abs() > d.error {
            return (axis, Sign::from(d.float[axis].signum() as i8));
        }
        self.counters.count();
        let exact = self.exact_direction(d);
        let axis = (0..3).max_by_key(|&k| exact[k].bits()).expect("three axes");
        (axis, exact[axis].sign())
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
        let [a, b] = [a, b].map(|d| self.exact_direction(d).map(|x| x.resize::<6>()));
        (a[u] * b[v] - a[v] * b[u]).sign()
    }

    /// Sign of one component of a direction.
    pub(crate) fn component(&self, d: &Direction, axis: usize) -> Sign {
        if d.float[axis].abs() > d.error || d.error == 0.0 {
            return sign_of(d.float[axis]);
        }
        self.counters.count();
        self.exact_direction(d)[axis].sign()
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
        self.counters.count();
        let exact = self.exact_direction(d).map(|x| x.resize::<6>());
        let normals = self
            .plane(Support::Facet(f))
            .direction_with(&self.plane(Support::Facet(g)))
            .map(|x| x.resize::<6>());
        (0..3).fold(Int::ZERO, |sum, k| sum + normals[k] * exact[k]).sign()
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
        let [p, q] = [p, q].map(|v| self.exact_point(&v.def).widened::<18>());
        let m = HPointOf::<18> { x: m.exact.x.map(|x| x.resize()), w: m.exact.w.resize() };
        let minor = |a: &HPointOf<18>, b: &HPointOf<18>| a.x[u] * b.x[v] - a.x[v] * b.x[u];
        // All denominators are positive: the sign is that of the homogeneous determinant.
        (minor(&p, &q) * m.w + minor(&q, &m) * p.w + minor(&m, &p) * q.w).sign()
    }

    /// The point halfway between two vertices.
    pub(crate) fn midpoint(&self, a: &Vertex, b: &Vertex) -> Midpoint {
        let exact = self.exact_point(&a.def).midpoint(&self.exact_point(&b.def));
        Midpoint { at: std::array::from_fn(|k| (a.at[k] + b.at[k]) / 2.0), exact }
    }

    /// Order of a vertex and a midpoint along an axis.
    pub(crate) fn cmp_with_midpoint(&self, a: &Vertex, m: &Midpoint, axis: usize) -> Ordering {
        let gap = a.at[axis] - m.at[axis];
        // The vertex is off by 2^-13, the midpoint by 2^-12, the difference by 2^-13.
        if gap.abs() > 8.0 * ROUNDING {
            return gap.total_cmp(&0.0);
        }
        self.counters.count();
        let a = self.exact_point(&a.def).widened::<14>();
        (a.x[axis] * m.exact.w.resize()).cmp(&(m.exact.x[axis].resize() * a.w))
    }
}

/// The point halfway between two vertices: the inside of an edge, where rays start.
#[derive(Clone, Debug)]
pub(crate) struct Midpoint {
    pub at: [f64; 3],
    pub exact: HPointOf<9>,
}

fn sign_of(x: f64) -> Sign {
    if x > 0.0 {
        Sign::Positive
    } else if x < 0.0 {
        Sign::Negative
    } else {
        Sign::Zero
    }
}
