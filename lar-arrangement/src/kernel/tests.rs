//! Every predicate against arbitrary-precision rationals, on random and on degenerate input.

use super::point::{HPointOf, PlaneOf};
use super::predicates::crossing_near;
use super::*;
use dashu_int::{IBig, ops::Abs};
use std::cmp::Ordering;

pub(super) const LIMIT: i64 = 1 << 40;

/// SplitMix64 (Steele, Lea, Flood 2014).
pub(super) struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(super) fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// Uniform in −reach..=reach.
    fn within(&mut self, reach: i64) -> i64 {
        (self.next() % (2 * reach as u64 + 1)) as i64 - reach
    }

    fn point(&mut self, reach: i64) -> [i64; 3] {
        std::array::from_fn(|_| self.within(reach))
    }

    /// `n` points of one of seven kinds, from general position to nearly collinear at the end of the range.
    fn points(&mut self, n: usize) -> Vec<[i64; 3]> {
        let (kind, origin, steps) =
            (self.below(7), self.point(LIMIT / 2), [self.point(LIMIT / 64), self.point(LIMIT / 64)]);
        (0..n)
            .map(|_| match kind {
                0 => self.point(LIMIT),
                1 => self.point(2),
                2 => self.point(1000),
                3 => std::array::from_fn(|_| [-LIMIT, LIMIT, LIMIT - 1, 0, 1][self.below(5)]),
                4 => origin.map(|x| x + self.within(3)),
                5 => self.near_lattice(origin, &steps),
                _ => self.near_lattice(origin, &steps[..1]),
            })
            .collect()
    }

    /// The origin plus small multiples of the steps, moved by one unit every fourth time.
    fn near_lattice(&mut self, origin: [i64; 3], steps: &[[i64; 3]]) -> [i64; 3] {
        let mut p = origin;
        for step in steps {
            let times = self.within(6);
            (0..3).for_each(|k| p[k] += times * step[k]);
        }
        if self.below(4) == 0 {
            p[self.below(3)] += [-1, 1][self.below(2)];
        }
        p
    }
}

type Big3 = [IBig; 3];

fn big(p: [i64; 3]) -> Big3 {
    p.map(IBig::from)
}

fn cross(a: &Big3, b: &Big3) -> Big3 {
    let minor = |u: usize, v: usize| &a[u] * &b[v] - &a[v] * &b[u];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn dot(a: &Big3, b: &Big3) -> IBig {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn sign(x: &IBig) -> Sign {
    Sign::from(x.cmp(&IBig::ZERO))
}

/// A rational point x / w, w > 0.
#[derive(Clone, Debug)]
struct Exact {
    x: Big3,
    w: IBig,
}

impl Exact {
    fn new(x: Big3, w: IBig) -> Self {
        if w < IBig::ZERO { Self { x: x.map(|x| -x), w: -w } } else { Self { x, w } }
    }

    fn is_within_range(&self) -> bool {
        let bound = &self.w * IBig::from(LIMIT);
        self.x.iter().all(|x| -&bound <= *x && *x <= bound)
    }

    fn cmp(&self, other: &Self, axis: usize) -> Ordering {
        (&self.x[axis] * &other.w).cmp(&(&other.x[axis] * &self.w))
    }

    fn minus(&self, other: &Self) -> Self {
        let x = std::array::from_fn(|k| &self.x[k] * &other.w - &other.x[k] * &self.w);
        Self { x, w: &self.w * &other.w }
    }

    fn midpoint(&self, other: &Self) -> Self {
        let x = std::array::from_fn(|k| &self.x[k] * &other.w + &other.x[k] * &self.w);
        Self { x, w: &self.w * &other.w * IBig::from(2) }
    }
}

fn exact<const W: usize>(p: &HPointOf<W>) -> Exact {
    Exact::new(p.x.map(|x| to_big(&x)), to_big(&p.w))
}

/// The normal with the offset of the plane through a point, up to a positive factor.
fn with_offset(n: Big3, a: &Exact) -> (Big3, IBig) {
    let d = dot(&n, &a.x);
    (n.map(|n| n * &a.w), d)
}

/// Three planes with coefficients of 41 bits, and the points moved onto one, two or three of them or none.
fn canonical(points: &[[i64; 3]], random: &mut Random) -> CanonicalPoints {
    let planes: [Plane; 3] = std::array::from_fn(|_| {
        let reach = [3, LIMIT, LIMIT, LIMIT][random.below(4)];
        let mut n = random.point(reach).map(i128::from);
        n[random.below(3)] = i128::from(LIMIT);
        let through = points[random.below(points.len())];
        Plane { n, d: (0..3).map(|k| n[k] * i128::from(through[k])).sum() }
    });
    let mut out = CanonicalPoints::default();
    for p in points {
        let mut on: Vec<u32> = (0..3).filter(|_| random.below(2) == 0).collect();
        let axes = (0..3).map(|k| {
            let n = std::array::from_fn(|j| i128::from(j == k));
            Plane { n, d: i128::from(p[k]) }
        });
        let wide: Vec<PlaneOf<3>> =
            on.iter().map(|&i| planes[i as usize]).chain(axes).map(|plane| plane.widened()).collect();
        let rational = HPointOf::on_planes([&wide[0], &wide[1], &wide[2]])
            .filter(|point| exact(point).is_within_range() && !on.is_empty());
        if let Some(point) = rational {
            out.rational.push(point);
            out.positions.push(point.rounded());
            out.entry.push(out.rational.len() as u32);
        } else {
            on.clear();
            out.entry.push(0);
        }
        out.planes_of_point.push(&on);
    }
    out.planes = planes.to_vec();
    out
}

/// Points, facets and vertices of every kind, with what they are exactly.
struct Scene {
    geometry: Geometry,
    corners: Vec<Exact>,
    n_facets: u32,
    bases: Vec<[u32; 3]>,
    supports: Vec<Support>,
    vertices: Vec<(Vertex, Exact)>,
    directions: Vec<(Direction, Big3)>,
}

impl Scene {
    const POINTS: usize = 12;

    /// Every third scene has canonical planes; every second of these may have planes through rational points.
    fn new(seed: u64) -> Self {
        let random = &mut Random(seed);
        let points = random.points(Self::POINTS);
        let canonical = if seed.is_multiple_of(3) { canonical(&points, random) } else { Default::default() };
        let corner = |(p, entry): (&[i64; 3], u32)| match entry.checked_sub(1) {
            None => Exact { x: big(*p), w: IBig::ONE },
            Some(i) => exact(&canonical.rational[i as usize]),
        };
        let entries = canonical.entry.iter().copied().chain(std::iter::repeat(0));
        let corners = points.iter().zip(entries).map(corner).collect();
        let mut scene = Self {
            geometry: Geometry::canonical(points, canonical),
            corners,
            n_facets: 0,
            bases: Vec::new(),
            supports: Vec::new(),
            vertices: Vec::new(),
            directions: Vec::new(),
        };
        scene.push_supports(random, seed.is_multiple_of(6));
        scene.push_vertices(random);
        scene.push_directions(random);
        scene
    }

    fn push_supports(&mut self, random: &mut Random, mixed: bool) {
        for plane in 0..self.geometry.n_canonical_planes() {
            let corners = self.on_plane(plane);
            corners.windows(3).for_each(|base| self.push_facet([base[0], base[1], base[2]], mixed));
        }
        for _ in 0..20 {
            self.push_facet([0; 3].map(|_| random.below(Self::POINTS) as u32), mixed);
        }
        for _ in 0..4 {
            let ends = [0; 2].map(|_| random.below(Self::POINTS) as u32);
            let support = Support::Vertical { ends, axis: random.below(3) as u8 };
            if self.plane(support).0 != [IBig::ZERO; 3] {
                self.supports.push(support);
            }
        }
    }

    /// Adds a facet on a shared plane or on one of its own, unless there are enough or the corners do not allow for it.
    fn push_facet(&mut self, base: [u32; 3], mixed: bool) {
        let (n, _) = self.plane_through(base);
        let collinear = n == [IBig::ZERO; 3];
        assert_eq!(self.geometry.are_collinear(base), collinear);
        if self.n_facets >= 8 || collinear {
            return;
        }
        let holds_all = |&plane: &u32| base.iter().all(|&p| self.geometry.is_defined_on(p, plane));
        match (0..self.geometry.n_canonical_planes()).find(holds_all) {
            Some(plane) => {
                let (axis, up) = self.geometry.dominant_axis_of_plane(plane);
                self.geometry.push_facet_on(base, plane, (n[axis] > IBig::ZERO) != up);
            }
            None if mixed || base.iter().all(|&p| self.geometry.grid_point(p).is_some()) => {
                self.geometry.push_facet(base);
            }
            None => return,
        }
        self.bases.push(base);
        self.supports.push(Support::Facet(self.n_facets));
        self.n_facets += 1;
    }

    /// The points on a canonical plane.
    fn on_plane(&self, plane: u32) -> Vec<u32> {
        (0..Self::POINTS as u32).filter(|&p| self.geometry.is_defined_on(p, plane)).collect()
    }

    /// n and d of the plane n · x = d, from the definition of the support.
    fn plane(&self, support: Support) -> (Big3, IBig) {
        let (a, n) = match support {
            Support::Facet(f) => return self.plane_through(self.bases[f as usize]),
            Support::Vertical { ends, axis } => {
                let [a, b] = ends.map(|p| self.point(p));
                let up = std::array::from_fn(|k| IBig::from(i64::from(k == axis as usize)));
                let n = cross(&up, &b.minus(&a).x);
                (a, n)
            }
        };
        with_offset(n, &a)
    }

    fn plane_through(&self, base: [u32; 3]) -> (Big3, IBig) {
        let [a, b, c] = base.map(|p| self.point(p));
        with_offset(cross(&b.minus(&a).x, &c.minus(&a).x), &a)
    }

    fn side(&self, p: &Exact, support: Support) -> Sign {
        let (n, d) = self.plane(support);
        sign(&(dot(&n, &p.x) - d * &p.w))
    }

    fn point(&self, p: u32) -> Exact {
        self.corners[p as usize].clone()
    }

    fn push_vertices(&mut self, random: &mut Random) {
        for _ in 0..6 {
            let p = random.below(Self::POINTS) as u32;
            self.vertices.push((self.geometry.point_vertex(p), self.point(p)));
        }
        for _ in 0..24 {
            if let Some(&support) = self.supports.get(random.below(self.supports.len().max(1))) {
                self.push_edge_vertex([0; 2].map(|_| random.below(Self::POINTS) as u32), support);
            }
        }
        self.push_crossings();
        self.push_points_of_lines();
        for _ in 0..8 {
            if self.n_facets > 2 {
                self.push_facets_vertex([0; 3].map(|_| random.below(self.n_facets as usize) as u32));
            }
        }
    }

    /// Where two edges in one canonical plane cross.
    fn push_crossings(&mut self) {
        for plane in 0..self.geometry.n_canonical_planes() {
            let on_plane = self.on_plane(plane);
            let Some(facet) = self.geometry.first_on_plane(plane) else { continue };
            for (i, &b) in on_plane.iter().enumerate().skip(1) {
                let edge = [on_plane[i - 1], b];
                for other in on_plane[i + 1..].windows(2).map(|w| [w[0], w[1]]) {
                    self.push_crossing(edge, other, facet);
                }
            }
        }
    }

    /// Where edges on two canonical planes meet the planes of facets.
    fn push_points_of_lines(&mut self) {
        for (p, q) in (0..Self::POINTS as u32).flat_map(|q| (0..q).map(move |p| (p, q))) {
            if self.geometry.planes_of_edge([p, q]).count() > 1 {
                (0..self.n_facets).for_each(|f| self.push_edge_vertex([p, q], Support::Facet(f)));
            }
        }
    }

    fn push_crossing(&mut self, edge: [u32; 2], other: [u32; 2], facet: u32) {
        let (axis, _) = self.geometry.dominant_axis(facet);
        let upright = |ends: [u32; 2]| Support::Vertical { ends, axis: axis as u8 };
        let crosses = |ends: [u32; 2], support: Support| {
            let [a, b] = ends.map(|p| self.side(&self.point(p), support));
            a.times(b) == Sign::Negative
        };
        if crosses(edge, upright(other)) && crosses(other, upright(edge)) {
            let def = self.geometry.crossing_definition([edge, other], facet, axis);
            self.push_on_edge(edge, upright(other), vec![def]);
        }
    }

    fn push_edge_vertex(&mut self, ends: [u32; 2], support: Support) {
        let [p, q] = ends.map(|p| self.side(&self.point(p), support));
        if p.times(q) == Sign::Negative {
            let mut defs = vec![VertexDef::EdgePlane { ends, support }];
            if let Support::Facet(facet) = support {
                defs.push(self.geometry.edge_definition(ends, facet));
                defs.dedup();
            }
            self.push_on_edge(ends, support, defs);
        }
    }

    /// p + s (q − p), s = side(p) / (side(p) − side(q)).
    fn push_on_edge(&mut self, ends: [u32; 2], support: Support, defs: Vec<VertexDef>) {
        let [p, q] = ends.map(|p| self.point(p));
        let (n, d) = self.plane(support);
        let (at_p, at_q) = (dot(&n, &p.x) - &d * &p.w, dot(&n, &q.x) - &d * &q.w);
        let w = &at_p * &q.w - &at_q * &p.w;
        let x = std::array::from_fn(|k| &at_p * &q.x[k] - &at_q * &p.x[k]);
        let exact = Exact::new(x, w);
        self.vertices.extend(defs.into_iter().map(|def| (self.geometry.vertex_on_edge(def), exact.clone())));
    }

    /// Cramer's rule, column by column.
    fn push_facets_vertex(&mut self, facets: [u32; 3]) {
        let planes = facets.map(|f| self.plane(Support::Facet(f)));
        let det = |column: Option<usize>| {
            let rows = planes.clone().map(|(mut n, d)| {
                if let Some(k) = column {
                    n[k] = d;
                }
                n
            });
            dot(&rows[0], &cross(&rows[1], &rows[2]))
        };
        let w = det(None);
        if w != IBig::ZERO {
            let exact = Exact::new(std::array::from_fn(|k| det(Some(k))), w);
            // Vertices of an arrangement lie within the box of its input.
            if exact.is_within_range() {
                self.vertices.push((self.geometry.facets_vertex(facets), exact));
            }
        }
    }

    fn push_directions(&mut self, random: &mut Random) {
        for _ in 0..5 {
            let ends = [0; 2].map(|_| random.below(Self::POINTS) as u32);
            let exact = self.point(ends[1]).minus(&self.point(ends[0])).x;
            self.push_direction(Along::Edge(ends), exact, random);
        }
        for _ in 0..8 {
            if self.n_facets > 1 {
                let facets = [0; 2].map(|_| random.below(self.n_facets as usize) as u32);
                let [m, n] = facets.map(|f| self.plane(Support::Facet(f)).0);
                self.push_direction(Along::Facets(facets), cross(&m, &n), random);
            }
        }
    }

    fn push_direction(&mut self, along: Along, exact: Big3, random: &mut Random) {
        if exact != [IBig::ZERO; 3] {
            let direction = self.geometry.direction(along);
            self.directions.push(if random.below(2) == 0 {
                (direction, exact)
            } else {
                (direction.opposite(), exact.map(|x| -x))
            });
        }
    }
}

/// Runs `test` on `n` scenes and returns the number of comparisons that it reports.
fn on_scenes(n: u64, mut test: impl FnMut(&Scene, u64) -> usize) -> usize {
    (0..n).map(|seed| test(&Scene::new(seed), seed)).sum()
}

#[test]
fn definitions_give_the_exact_points_and_round_correctly() {
    let (mut n_on_planes, mut n_short) = (0, 0);
    let compared = on_scenes(50_000, |scene, seed| {
        for (vertex, exact) in &scene.vertices {
            let found = scene.geometry.exact_point::<23>(&vertex.def);
            let (x, w) = (found.x.map(|x| to_big(&x)), to_big(&found.w));
            assert!(w > IBig::ZERO, "seed {seed}: {:?} has the denominator {w}", vertex.def);
            for (k, x) in x.iter().enumerate() {
                assert_eq!(x * &exact.w, &exact.x[k] * &w, "seed {seed}: {:?}, axis {k}", vertex.def);
                check_rounding(&exact.x[k], &exact.w, vertex.at[k], seed);
                check_crossing(&scene.geometry, vertex, exact, k, seed);
                n_short += check_coordinate(&scene.geometry, vertex, exact, k, seed);
            }
            n_on_planes += usize::from(vertex.is_on_edge && matches!(vertex.def, VertexDef::Facets(_)));
        }
        scene.vertices.len()
    });
    assert!(n_on_planes > 5_000, "only {n_on_planes} vertices on edges are defined by canonical planes");
    assert!(n_short > 30_000, "only {n_short} coordinates are short quotients");
    assert!(compared > 500_000, "only {compared} vertices");
}

/// A coordinate that the definition gives is the exact one, and as short as it says. How many there are of edges: 0 or 1.
fn check_coordinate(geometry: &Geometry, vertex: &Vertex, exact: &Exact, axis: usize, seed: u64) -> usize {
    let Some([x, w]) = geometry.coordinate(&vertex.def, axis) else { return 0 };
    assert!(0 < w && w < 1 << 42 && x.abs() < 1 << 83, "seed {seed}: {x} / {w}, {:?}", vertex.def);
    let (left, right) = (IBig::from(x) * &exact.w, &exact.x[axis] * IBig::from(w));
    assert_eq!(left, right, "seed {seed}: {x} / {w}, {:?}, axis {axis}", vertex.def);
    usize::from(matches!(vertex.def, VertexDef::EdgePlane { .. }))
}

/// The quick coordinate of a crossing is as near to the exact one as it says.
fn check_crossing(geometry: &Geometry, vertex: &Vertex, exact: &Exact, axis: usize, seed: u64) {
    let VertexDef::EdgePlane { ends, support: Support::Facet(facet) } = vertex.def else { return };
    let (plane, [p, q]) = (geometry.seen_from(facet), ends.map(|p| geometry.spot(p)));
    let (at, error) = crossing_near([&p, &q], [&plane.side(&p), &plane.side(&q)], axis);
    if error.is_finite() {
        let gap = (scaled_float(at) * &exact.w - (&exact.x[axis] << 400)).abs();
        assert!(gap <= scaled_float(error) * &exact.w, "seed {seed}: {at} ± {error}, {:?}", vertex.def);
    }
}

#[test]
fn sides_of_planes() {
    let compared = on_scenes(15_000, |scene, seed| {
        for (vertex, exact) in &scene.vertices {
            for &support in &scene.supports {
                let found = scene.geometry.side(vertex, support);
                let expected = scene.side(exact, support);
                assert_eq!(found, expected, "seed {seed}: {:?} against {support:?}", vertex.def);
            }
        }
        for p in 0..Scene::POINTS as u32 {
            for f in 0..scene.n_facets {
                let expected = scene.side(&scene.point(p), Support::Facet(f));
                assert_eq!(scene.geometry.side_of_point(p, f), expected, "seed {seed}: {p} against {f}");
            }
        }
        scene.vertices.len() * scene.supports.len()
    });
    assert!(compared > 1_000_000, "only {compared} comparisons");
}

#[test]
fn order_and_equality_of_vertices() {
    let compared = on_scenes(8_000, |scene, seed| {
        for (a, exact_a) in &scene.vertices {
            for (b, exact_b) in &scene.vertices {
                let orders = [0, 1, 2].map(|axis| exact_a.cmp(exact_b, axis));
                for (axis, order) in orders.into_iter().enumerate() {
                    let found = scene.geometry.cmp_coordinate(a, b, axis);
                    assert_eq!(found, order, "seed {seed}: {:?} and {:?}, axis {axis}", a.def, b.def);
                }
                let equal = orders == [Ordering::Equal; 3];
                assert_eq!(scene.geometry.coincide(a, b), equal, "seed {seed}: {:?}, {:?}", a.def, b.def);
            }
        }
        scene.vertices.len().pow(2)
    });
    assert!(compared > 1_000_000, "only {compared} comparisons");
}

#[test]
fn directions_turn_as_they_do_exactly() {
    let compared = on_scenes(8_000, |scene, seed| {
        let geometry = &scene.geometry;
        for (d, exact) in &scene.directions {
            let (axis, up) = geometry.axis_of(d);
            assert_eq!(up, sign(&exact[axis]), "seed {seed}: axis {axis} of {:?}", d.along);
            assert_ne!(up, Sign::Zero, "seed {seed}: axis {axis} of {:?}", d.along);
            for (k, x) in exact.iter().enumerate() {
                assert_eq!(geometry.component(d, k), sign(x), "seed {seed}: {:?}, axis {k}", d.along);
            }
            for (e, other) in &scene.directions {
                for (u, v) in [(0, 1), (1, 2), (2, 0), (1, 0)] {
                    let expected = sign(&(&exact[u] * &other[v] - &exact[v] * &other[u]));
                    let found = geometry.turn(d, e, u, v);
                    assert_eq!(found, expected, "seed {seed}: {:?} to {:?}, axes {u} {v}", d.along, e.along);
                }
            }
        }
        scene.directions.len().pow(2) * 4
    });
    assert!(compared > 1_000_000, "only {compared} comparisons");
}

#[test]
fn normals_turn_about_directions() {
    let compared = on_scenes(5_000, |scene, seed| {
        let geometry = &scene.geometry;
        let normals: Vec<Big3> = (0..scene.n_facets).map(|f| scene.plane(Support::Facet(f)).0).collect();
        for (n, f) in normals.iter().zip(0..) {
            let (axis, up) = geometry.dominant_axis(f);
            assert_eq!(Sign::from(if up { 1i8 } else { -1 }), sign(&n[axis]), "seed {seed}: facet {f}");
            for (k, x) in n.iter().enumerate() {
                assert_eq!(geometry.normal_sign(f, k), sign(x), "seed {seed}: facet {f}, axis {k}");
            }
            for (m, g) in normals.iter().zip(0..) {
                let about = cross(n, m);
                if about == [IBig::ZERO; 3] {
                    let same = dot(n, m) > IBig::ZERO;
                    assert_eq!(geometry.same_way(f, g), same, "seed {seed}: facets {f}, {g}");
                }
                for (d, exact) in &scene.directions {
                    let found = geometry.turn_about(f, g, d);
                    assert_eq!(found, sign(&dot(&about, exact)), "seed {seed}: {f}, {g} about {:?}", d.along);
                }
            }
        }
        normals.len().pow(2) * scene.directions.len()
    });
    assert!(compared > 1_000_000, "only {compared} comparisons");
}

#[test]
fn midpoints_order_and_orient() {
    let compared = on_scenes(4_000, |scene, seed| {
        let random = &mut Random(!seed);
        let mut pick = || &scene.vertices[random.below(scene.vertices.len())];
        for round in 0..60 {
            let [(a, exact_a), (b, exact_b), (p, exact_p), (q, exact_q)] = std::array::from_fn(|_| pick());
            // Every third time the midpoint of a vertex with itself.
            let (b, exact_b) = if round % 3 == 0 { (a, exact_a) } else { (b, exact_b) };
            let (m, exact_m) = (scene.geometry.midpoint(a, b), exact_a.midpoint(exact_b));
            for axis in 0..3 {
                let found = scene.geometry.cmp_with_midpoint(p, &m, axis);
                let expected = exact_p.cmp(&exact_m, axis);
                assert_eq!(found, expected, "seed {seed}: {:?}, {:?} {:?}", p.def, a.def, b.def);
            }
            for (u, v) in [(0, 1), (1, 2), (0, 2)] {
                let found = scene.geometry.orientation(p, q, &m, u, v);
                let row = |e: &Exact| [e.x[u].clone(), e.x[v].clone(), e.w.clone()];
                let expected = sign(&dot(&row(exact_p), &cross(&row(exact_q), &row(&exact_m))));
                assert_eq!(found, expected, "seed {seed}: {:?} {:?}, {:?} {:?}", p.def, q.def, a.def, b.def);
            }
        }
        60 * 6
    });
    assert!(compared > 1_000_000, "only {compared} comparisons");
}

fn to_big<const N: usize>(x: &Int<N>) -> IBig {
    let magnitude = x.magnitude().iter().rev().fold(IBig::ZERO, |sum, &limb| (sum << 64) + IBig::from(limb));
    if x.sign() == Sign::Negative { -magnitude } else { magnitude }
}

/// x · 2^400 as an integer, for x a multiple of 2^-400.
fn scaled_float(x: f64) -> IBig {
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
    if exponent == 0 {
        return IBig::ZERO;
    }
    let shift = exponent - 1075 + 400;
    let magnitude = IBig::from(fraction | 1 << 52) << usize::try_from(shift).expect("not a tiny number");
    if x < 0.0 { -magnitude } else { magnitude }
}

/// The quotient lies between the midpoints to the neighbours of the rounded value; on a midpoint the value is even.
#[track_caller]
fn check_rounding(numerator: &IBig, denominator: &IBig, rounded: f64, seed: u64) {
    let twice = numerator << 401;
    let bound = |x: f64| (scaled_float(rounded) + scaled_float(x)) * denominator;
    if rounded == 0.0 {
        assert_eq!(*numerator, IBig::ZERO, "seed {seed}");
        return;
    }
    let (low, high) = (bound(rounded.next_down()), bound(rounded.next_up()));
    let even = rounded.to_bits() & 1 == 0;
    let holds = if even { low <= twice && twice <= high } else { low < twice && twice < high };
    assert!(holds, "seed {seed}: {numerator} / {denominator} became {rounded:e}");
}

/// An integer of up to 290 bits: random, all ones, or a power of two.
fn wide(random: &mut Random) -> Int<5> {
    let bits = 1 + random.below(290) as u32;
    let mut x = match random.below(3) {
        0 => Int::from(1i64),
        1 => Int::from(1i64).shifted(bits) - Int::from(1i64),
        _ => (0..5).fold(Int::ZERO, |sum: Int<5>, _| {
            // 58 bits a digit: five of them stay within 290.
            sum.shifted(58) + Int::from((random.next() >> 6) as i64)
        }),
    };
    if x.sign() == Sign::Zero {
        x = Int::from(1i64);
    }
    x
}

#[test]
fn quotients_round_to_nearest_even() {
    for seed in 0..100_000 {
        let random = &mut Random(seed);
        let w = match random.below(3) {
            0 => Int::from(1 + random.within(1 << 20).abs()),
            _ => wide(random),
        };
        // A tie between two doubles, or just beside one: an odd number of 54 bits times the denominator.
        let odd = Int::<5>::from((random.next() >> 10 | 1 << 53 | 1) as i64);
        let tie = |random: &mut Random| {
            if w.bits() + odd.bits() < 300 { w * odd + Int::from(random.within(1)) } else { wide(random) }
        };
        let x: [Int<5>; 3] = std::array::from_fn(|k| {
            let x = if k == 0 { wide(random) } else { tie(random) };
            if random.below(2) == 0 { -x } else { x }
        });
        let offset = [0; 3].map(|_| i128::from(random.within(i64::MAX / 2)) << random.below(30));
        let point = HPointOf { x, w };
        let (at, moved) = (point.rounded(), point.widened::<7>().rounded_after(offset));
        let (x, w) = (x.map(|x| to_big(&x)), to_big(&w));
        for k in 0..3 {
            check_rounding(&x[k], &w, at[k], seed);
            check_rounding(&(&x[k] + IBig::from(offset[k]) * &w), &w, moved[k], seed);
        }
    }
}
