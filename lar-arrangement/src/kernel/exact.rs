//! The exact side of the predicates: the same arithmetic in the width that the operands need.

use super::geometry::{Geometry, Reach, Support, VertexDef};
use super::point::{HPointOf, Plane, PlaneOf};
use super::predicates::{Along, Direction, Midpoint};
use super::{Int, Sign};
use std::cmp::Ordering;

/// An operand of a predicate.
trait Operand {
    /// What exact arithmetic on it has to hold.
    fn reach(&self, geometry: &Geometry) -> Reach;
}

impl Operand for VertexDef {
    fn reach(&self, geometry: &Geometry) -> Reach {
        match *self {
            // Even a rational one is no larger than the point on three planes of the grid.
            VertexDef::Point(_) => Reach::Grid,
            VertexDef::EdgePlane { ends, support } => ends.reach(geometry).max(support.reach(geometry)),
            VertexDef::Facets(facets) => {
                facets.into_iter().map(|f| geometry.reach_of_facet(f)).max().unwrap_or_default()
            }
        }
    }
}

/// The ends of an edge.
impl Operand for [u32; 2] {
    fn reach(&self, geometry: &Geometry) -> Reach {
        geometry.reach_of_point(self[0]).max(geometry.reach_of_point(self[1]))
    }
}

impl Operand for Support {
    fn reach(&self, geometry: &Geometry) -> Reach {
        match self {
            Support::Facet(facet) => geometry.reach_of_facet(*facet),
            Support::Vertical { ends, .. } => ends.reach(geometry),
        }
    }
}

impl Operand for Direction {
    fn reach(&self, geometry: &Geometry) -> Reach {
        match &self.along {
            Along::Edge(ends) => ends.reach(geometry),
            Along::Facets([f, g]) => geometry.reach_of_facet(*f).max(geometry.reach_of_facet(*g)),
        }
    }
}

impl Operand for Midpoint {
    fn reach(&self, geometry: &Geometry) -> Reach {
        self.of[0].reach(geometry).max(self.of[1].reach(geometry))
    }
}

/// Methods that call an exact body in as many limbs as the operands after the bar need: on the grid, with canonical
/// planes, with planes through rational points. The numbers come from the table in the module's header.
macro_rules! in_the_width_needed {
    ($($name:ident => $body:ident[$grid:literal, $canonical:literal, $mixed:literal]
        ($($operand:ident: $kind:ty),* $(; $argument:ident: $type:ty)*) -> $result:ty;)*) => {
        impl Geometry {
            $(pub(super) fn $name(&self, $($operand: $kind,)* $($argument: $type),*) -> $result {
                let reach = match self.reach() {
                    Reach::Grid => Reach::Grid,
                    _ => Reach::Grid$(.max($operand.reach(self)))*,
                };
                match reach {
                    Reach::Grid => self.$body::<$grid>($($operand,)* $($argument),*),
                    Reach::Canonical => self.$body::<$canonical>($($operand,)* $($argument),*),
                    Reach::Mixed => self.$body::<$mixed>($($operand,)* $($argument),*),
                }
            })*
        }
    };
}

in_the_width_needed! {
    exactly_rounded => rounded_in[5, 12, 23](def: &VertexDef) -> [f64; 3];
    homogeneous => homogeneous_in[5, 12, 23](def: &VertexDef) -> [String; 4];
    moved_and_rounded => moved_and_rounded_in[6, 13, 24](def: &VertexDef; offset: [i128; 3]) -> [f64; 3];
    exact_side => side_in[6, 19, 30](def: &VertexDef, support: Support) -> Sign;
    exact_order => order_in[9, 23, 44](a: &VertexDef, b: &VertexDef; axis: usize) -> Ordering;
    exact_equality => equality_in[9, 23, 44](a: &VertexDef, b: &VertexDef) -> bool;
    exact_axis => axis_in[3, 5, 15](d: &Direction) -> (usize, Sign);
    exact_component => component_in[3, 5, 15](d: &Direction; axis: usize) -> Sign;
    exact_turn => turn_in[6, 10, 29](a: &Direction, b: &Direction; u: usize; v: usize) -> Sign;
    exact_turn_about => turn_about_in[6, 8, 29](f: Support, g: Support, d: &Direction) -> Sign;
    exact_orientation =>
        orientation_in[18, 46, 88](p: &VertexDef, q: &VertexDef, m: &Midpoint; u: usize; v: usize) -> Sign;
    exact_order_with_midpoint => order_with_midpoint_in[13, 34, 66](a: &VertexDef, m: &Midpoint; axis: usize) -> Ordering;
    exact_side_of_midpoint => side_of_midpoint_in[10, 25, 51](m: &Midpoint, facet: Support) -> Sign;
    exact_order_of_hits => order_of_hits_in[12, 26, 59](m: &Midpoint, f: Support, g: Support) -> Ordering;
}

impl Geometry {
    /// Homogeneous coordinates of an input point.
    pub(super) fn wide_point<const W: usize>(&self, p: u32) -> HPointOf<W> {
        match self.rational(p) {
            Some(point) => point.widened(),
            None => HPointOf::grid(self.nearest_grid_point(p)),
        }
    }

    fn corner_plane(&self, facet: u32) -> Plane {
        let [a, b, c] = self.base(facet).map(|p| self.nearest_grid_point(p));
        Plane::through(a, b, c)
    }

    /// The plane in integers of 128 bits, when it goes through grid points.
    pub(super) fn grid_plane(&self, support: Support) -> Option<Plane> {
        match support {
            Support::Facet(f) => self.shared_plane(f).is_none().then(|| self.corner_plane(f)),
            Support::Vertical { ends, axis } => {
                let [a, b] = ends.map(|p| self.grid_point(p));
                Some(Plane::vertical(a?, b?, axis as usize))
            }
        }
    }

    pub(super) fn wide_plane<const W: usize>(&self, support: Support) -> PlaneOf<W> {
        if let Some(plane) = self.grid_plane(support) {
            return plane.widened();
        }
        match support {
            Support::Facet(f) => {
                let (plane, flipped) = self.shared_plane(f).expect("all other facets have grid planes");
                let plane = self.shared(plane).widened::<W>();
                if flipped { plane.opposite() } else { plane }
            }
            Support::Vertical { ends, axis } => {
                let [a, b] = ends.map(|p| self.wide_point(p));
                PlaneOf::vertical(&a, &b, axis as usize)
            }
        }
    }

    /// Homogeneous coordinates from the definition.
    pub(super) fn exact_point<const W: usize>(&self, def: &VertexDef) -> HPointOf<W> {
        match *def {
            VertexDef::Point(p) => self.wide_point(p),
            VertexDef::EdgePlane { ends, support } => {
                let grid = (ends.map(|p| self.grid_point(p)), self.grid_plane(support));
                if let ([Some(p), Some(q)], Some(plane)) = grid {
                    return HPointOf::on_grid_edge(p, q, &plane);
                }
                let [p, q] = ends.map(|p| self.wide_point(p));
                HPointOf::on_edge(&p, &q, &self.wide_plane(support))
            }
            VertexDef::Facets(facets) => {
                let [a, b, c] = facets.map(|f| self.wide_plane(Support::Facet(f)));
                HPointOf::on_planes([&a, &b, &c])
                    .expect("vertices on three planes are made where the planes cross")
            }
        }
    }

    /// X, Y, Z, W in decimal digits.
    fn homogeneous_in<const W: usize>(&self, def: &VertexDef) -> [String; 4] {
        let point = self.exact_point::<W>(def);
        let [x, y, z] = point.x.map(Int::to_decimal);
        [x, y, z, point.w.to_decimal()]
    }

    fn rounded_in<const W: usize>(&self, def: &VertexDef) -> [f64; 3] {
        self.exact_point::<W>(def).rounded()
    }

    fn moved_and_rounded_in<const W: usize>(&self, def: &VertexDef, offset: [i128; 3]) -> [f64; 3] {
        self.exact_point::<W>(def).rounded_after(offset)
    }

    fn side_in<const W: usize>(&self, def: &VertexDef, support: Support) -> Sign {
        self.wide_plane::<W>(support).scaled_side(&self.exact_point(def)).sign()
    }

    fn order_in<const W: usize>(&self, a: &VertexDef, b: &VertexDef, axis: usize) -> Ordering {
        let ([x, v], [y, w]) = (self.exact_coordinate::<W>(a, axis), self.exact_coordinate::<W>(b, axis));
        (x * w).cmp(&(y * v))
    }

    /// One coordinate: numerator and positive denominator.
    fn exact_coordinate<const W: usize>(&self, def: &VertexDef, axis: usize) -> [Int<W>; 2] {
        if let VertexDef::EdgePlane { ends, support } = *def
            && let [Some(p), Some(q)] = ends.map(|p| self.grid_point(p))
            && let Some(plane) = self.grid_plane(support)
        {
            return HPointOf::coordinate_on_grid_edge([p[axis], q[axis]], [plane.side(p), plane.side(q)]);
        }
        let point = self.exact_point::<W>(def);
        [point.x[axis], point.w]
    }

    fn equality_in<const W: usize>(&self, a: &VertexDef, b: &VertexDef) -> bool {
        self.exact_point::<W>(a).equals(&self.exact_point(b))
    }

    /// The direction up to a positive factor.
    fn exact_direction<const W: usize>(&self, d: &Direction) -> [Int<W>; 3] {
        let vector = match d.along {
            Along::Edge(ends) => match ends.map(|p| self.grid_point(p)) {
                [Some(a), Some(b)] => std::array::from_fn(|k| Int::from(b[k] - a[k])),
                _ => {
                    let [a, b] = ends.map(|p| self.wide_point::<W>(p));
                    std::array::from_fn(|k| b.x[k] * a.w - a.x[k] * b.w)
                }
            },
            Along::Facets([f, g]) => {
                self.wide_plane::<W>(Support::Facet(f)).direction_with(&self.wide_plane(Support::Facet(g)))
            }
        };
        if d.reversed { vector.map(|x| -x) } else { vector }
    }

    fn axis_in<const W: usize>(&self, d: &Direction) -> (usize, Sign) {
        let exact = self.exact_direction::<W>(d);
        let axis = (0..3).max_by_key(|&k| exact[k].bits()).expect("three axes");
        (axis, exact[axis].sign())
    }

    fn component_in<const W: usize>(&self, d: &Direction, axis: usize) -> Sign {
        self.exact_direction::<W>(d)[axis].sign()
    }

    fn turn_in<const W: usize>(&self, a: &Direction, b: &Direction, u: usize, v: usize) -> Sign {
        let [a, b] = [a, b].map(|d| self.exact_direction::<W>(d));
        (a[u] * b[v]).cmp(&(a[v] * b[u])).into()
    }

    fn turn_about_in<const W: usize>(&self, f: Support, g: Support, d: &Direction) -> Sign {
        let exact = self.exact_direction::<W>(d);
        let normals = self.wide_plane::<W>(f).direction_with(&self.wide_plane(g));
        (0..3).fold(Int::ZERO, |sum, k| sum + normals[k] * exact[k]).sign()
    }

    fn exact_midpoint<const W: usize>(&self, m: &Midpoint) -> HPointOf<W> {
        let [a, b] = m.of;
        let point = self.exact_point::<W>(&a);
        if a == b { point } else { point.midpoint(&self.exact_point(&b)) }
    }

    /// All denominators are positive: the sign is that of the homogeneous determinant.
    fn orientation_in<const W: usize>(
        &self,
        p: &VertexDef,
        q: &VertexDef,
        m: &Midpoint,
        u: usize,
        v: usize,
    ) -> Sign {
        let [p, q] = [p, q].map(|def| self.exact_point::<W>(def));
        let m = self.exact_midpoint::<W>(m);
        let minor = |a: &HPointOf<W>, b: &HPointOf<W>| a.x[u] * b.x[v] - a.x[v] * b.x[u];
        (minor(&p, &q) * m.w + minor(&q, &m) * p.w + minor(&m, &p) * q.w).sign()
    }

    fn order_with_midpoint_in<const W: usize>(&self, a: &VertexDef, m: &Midpoint, axis: usize) -> Ordering {
        self.exact_point::<W>(a).cmp_coordinate(&self.exact_midpoint(m), axis)
    }

    fn side_of_midpoint_in<const W: usize>(&self, m: &Midpoint, facet: Support) -> Sign {
        self.wide_plane::<W>(facet).scaled_side(&self.exact_midpoint(m)).sign()
    }

    /// Order of side / normal[0], then of what the moved start adds to it: normal[1] / normal[0], normal[2] / normal[0].
    fn order_of_hits_in<const W: usize>(&self, m: &Midpoint, f: Support, g: Support) -> Ordering {
        let [f, g] = [f, g].map(|f| self.wide_plane::<W>(f));
        let m = self.exact_midpoint::<W>(m);
        let flip = f.n[0].sign().times(g.n[0].sign()) == Sign::Negative;
        let quotients = |a: &Int<W>, b: &Int<W>| {
            let order = (*a * g.n[0]).cmp(&(*b * f.n[0]));
            if flip { order.reverse() } else { order }
        };
        quotients(&f.scaled_side(&m), &g.scaled_side(&m))
            .then_with(|| quotients(&f.n[1], &g.n[1]))
            .then_with(|| quotients(&f.n[2], &g.n[2]))
    }
}
