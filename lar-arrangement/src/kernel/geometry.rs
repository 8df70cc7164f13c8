//! The input on the grid: points, planes of facets, and the vertices that are defined by them.
//!
//! Most points are grid points and most planes go through three of them. Where facets were made coplanar, corners
//! are rational points on planes with small coefficients, and a facet between such corners that is on none of these
//! planes has one with large coefficients. Exact arithmetic takes its width from the worst that the scene holds.

use super::approx::{ApproxPlane, approx_point};
use super::double::Double;
use super::point::{HPointOf, Plane, PlaneOf};
use super::predicates::longest_axis;
use super::{Int, Sign};
use crate::parallel;
use lar_core::Cells;
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

    pub(super) fn count(&self) {
        self.exact.fetch_add(1, Relaxed);
    }
}

/// A plane by reference: that of a facet, or the one through an input edge parallel to a coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Support {
    Facet(u32),
    Vertical { ends: [u32; 2], axis: u8 },
}

/// What a vertex is. Numbers of input points and facets; never a measured position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum VertexDef {
    /// A point of the input.
    Point(u32),
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
    /// Whether it was found where an edge of the input meets a plane.
    pub is_on_edge: bool,
}

/// f64 image of a facet's plane: the rounded normal, `origin` a point on it, rounded, and `slack` bounds what that
/// rounding does to a side.
#[derive(Clone, Copy, Debug)]
pub(super) struct FloatPlane {
    pub normal: [f64; 3],
    pub origin: [f64; 3],
    pub slack: f64,
}

/// What exact arithmetic has to hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reach {
    /// Points of the grid and planes through them.
    #[default]
    Grid,
    /// Also points on planes of small coefficients.
    Canonical,
    /// Also planes through such points.
    Mixed,
}

/// Limbs of a plane through three rational points.
pub(super) const PLANE_LIMBS: usize = 8;

/// A plane that facets share.
pub(crate) type SharedPlane = PlaneOf<PLANE_LIMBS>;

/// An input point on up to three planes of small coefficients.
pub(crate) type RationalPoint = HPointOf<3>;

/// The points of the input, some of them rational, and the planes that facets share.
#[derive(Debug, Default)]
pub(crate) struct CanonicalPoints {
    /// For each point 0, or the number of its entry in `rational`, counted from 1; empty when there is none.
    pub entry: Vec<u32>,
    pub rational: Vec<RationalPoint>,
    /// The positions of the rational points, correctly rounded.
    pub positions: Vec<[f64; 3]>,
    /// Planes with coefficients of 41 bits and offsets of 83.
    pub planes: Vec<Plane>,
    /// The shared planes that each point lies on, ascending; empty when there is none.
    pub planes_of_point: Cells,
}

/// The input on the grid and the predicates over it.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    /// Grid points; of a rational point the nearest one.
    points: Vec<[i64; 3]>,
    canonical: CanonicalPoints,
    /// The positions of the rational points in about 106 bits.
    close_positions: Vec<[Double; 3]>,
    /// The canonical planes, then others that facets share.
    shared_planes: Vec<SharedPlane>,
    /// The shared planes in about 106 bits.
    close_planes: Vec<ApproxPlane>,
    /// Of each facet three corners that are not collinear and turn counter-clockwise about its normal.
    bases: Vec<[u32; 3]>,
    /// The exact normals rounded: relative error below 2^-52 a component, and a positive factor.
    normals: Vec<[f64; 3]>,
    /// For each facet 0, or 1 + 2 · shared plane, + 1 when it looks the other way; empty in a scene without any.
    plane_codes: Vec<u32>,
    /// The first facet on each shared plane.
    first_on_plane: Vec<u32>,
    reach: Reach,
    pub counters: Counters,
}

/// Largest error of a rounded coordinate: half an ulp of 2^40.
pub(super) const ROUNDING: f64 = 1.0 / 8192.0;

impl Geometry {
    pub(crate) fn new(points: Vec<[i64; 3]>) -> Self {
        Self::canonical(points, CanonicalPoints::default())
    }

    /// Points that may be rational, and planes that facets will share.
    pub(crate) fn canonical(points: Vec<[i64; 3]>, canonical: CanonicalPoints) -> Self {
        let CanonicalPoints { rational, planes, .. } = &canonical;
        let shared_planes: Vec<SharedPlane> = parallel::map_light(planes.len(), |i| planes[i].widened());
        Self {
            points,
            close_positions: parallel::map_light(rational.len(), |i| approx_point(&rational[i])),
            close_planes: parallel::map_light(planes.len(), |i| ApproxPlane::new(&shared_planes[i])),
            shared_planes,
            reach: if canonical.rational.is_empty() { Reach::Grid } else { Reach::Canonical },
            first_on_plane: vec![u32::MAX; canonical.planes.len()],
            canonical,
            ..Self::default()
        }
    }

    pub(crate) fn n_points(&self) -> usize {
        self.points.len()
    }

    pub(crate) fn reach(&self) -> Reach {
        self.reach
    }

    /// What a point takes.
    pub(super) fn reach_of_point(&self, p: u32) -> Reach {
        if self.rational_entry(p).is_some() { Reach::Canonical } else { Reach::Grid }
    }

    /// What the plane of a facet takes: small coefficients are smaller than those of planes through grid points.
    pub(super) fn reach_of_facet(&self, facet: u32) -> Reach {
        match self.shared_plane(facet) {
            Some((plane, _)) if self.canonical_plane(plane).is_none() => Reach::Mixed,
            _ => Reach::Grid,
        }
    }

    fn rational_entry(&self, p: u32) -> Option<usize> {
        match self.canonical.entry.get(p as usize) {
            None | Some(0) => None,
            Some(&entry) => Some(entry as usize - 1),
        }
    }

    pub(super) fn rational(&self, p: u32) -> Option<&RationalPoint> {
        self.rational_entry(p).map(|entry| &self.canonical.rational[entry])
    }

    /// The point's integer coordinates, when it has such.
    pub(crate) fn grid_point(&self, p: u32) -> Option<[i64; 3]> {
        self.rational_entry(p).is_none().then(|| self.points[p as usize])
    }

    /// The grid point nearest to a point: itself, unless it is rational.
    pub(crate) fn nearest_grid_point(&self, p: u32) -> [i64; 3] {
        self.points[p as usize]
    }

    /// The point's position, correctly rounded.
    #[inline]
    pub(crate) fn position(&self, p: u32) -> [f64; 3] {
        match self.rational_entry(p) {
            None => self.points[p as usize].map(|x| x as f64),
            Some(entry) => self.canonical.positions[entry],
        }
    }

    /// Whether the corners of a triangle lie on one line.
    pub(crate) fn are_collinear(&self, corners: [u32; 3]) -> bool {
        match corners.map(|p| self.grid_point(p)) {
            [Some(a), Some(b), Some(c)] => Plane::through(a, b, c).n == [0; 3],
            _ => self.plane_through(corners).n.iter().all(|n| n.sign() == Sign::Zero),
        }
    }

    fn plane_through(&self, corners: [u32; 3]) -> SharedPlane {
        let [a, b, c] = corners.map(|p| self.wide_point(p));
        PlaneOf::through(&a, &b, &c)
    }

    /// Adds a facet by three of its vertices that are not collinear and turn counter-clockwise about its normal.
    pub(crate) fn push_facet(&mut self, base: [u32; 3]) {
        if self.reach == Reach::Grid || base.iter().all(|&p| self.rational_entry(p).is_none()) {
            self.push_facet_with(base, self.grid_normal(base), 0);
            return;
        }
        self.reach = Reach::Mixed;
        let plane = self.plane_through(base);
        self.first_on_plane.push(u32::MAX);
        self.shared_planes.push(plane);
        self.close_planes.push(ApproxPlane::new(&plane));
        let code = 2 * self.shared_planes.len() as u32 - 1;
        self.push_facet_with(base, rounded_normal(&plane), code);
    }

    /// The normal of a triangle of grid points, rounded; zero when they are collinear.
    pub(crate) fn grid_normal(&self, base: [u32; 3]) -> [f64; 3] {
        let [a, b, c] = base.map(|p| self.points[p as usize]);
        Plane::normal_through(a, b, c).map(to_f64)
    }

    /// Whether all points and planes are those of the grid.
    pub(crate) fn is_on_grid(&self) -> bool {
        self.reach == Reach::Grid && self.shared_planes.is_empty()
    }

    /// Makes room for so many facets.
    pub(crate) fn reserve_facets(&mut self, n: usize) {
        self.bases.reserve(n);
        self.normals.reserve(n);
    }

    /// Adds those of n triangles of grid points, in a scene on the grid, whose points are not collinear, and returns which
    /// these are; `None` for all.
    pub(crate) fn push_grid_facets(
        &mut self,
        n: usize,
        base: impl Fn(usize) -> [u32; 3] + Sync + Send,
    ) -> Option<Vec<u32>> {
        let first = self.bases.len();
        parallel::extend_light(&mut self.bases, n, base);
        let mut normals = std::mem::take(&mut self.normals);
        parallel::extend_light(&mut normals, n, |i| self.grid_normal(self.bases[first + i]));
        self.normals = normals;
        let is_proper = |normal: &[f64; 3]| *normal != [0.0; 3];
        if parallel::all(n, |i| is_proper(&self.normals[first + i])) {
            return None;
        }
        let proper: Vec<u32> =
            (0..n as u32).filter(|&i| is_proper(&self.normals[first + i as usize])).collect();
        for (to, &from) in (first..).zip(&proper) {
            self.bases[to] = self.bases[first + from as usize];
            self.normals[to] = self.normals[first + from as usize];
        }
        self.bases.truncate(first + proper.len());
        self.normals.truncate(first + proper.len());
        Some(proper)
    }

    /// Keeps the facets for which `keep` holds, by their numbers, and numbers them anew.
    pub(crate) fn retain_facets(&mut self, keep: impl Fn(u32) -> bool) {
        let kept = |f: &u32| keep(*f);
        if !self.plane_codes.is_empty() {
            self.plane_codes.resize(self.bases.len(), 0);
            self.plane_codes =
                (0..self.bases.len() as u32).filter(kept).map(|f| self.plane_codes[f as usize]).collect();
            self.first_on_plane.fill(u32::MAX);
            for (&code, facet) in self.plane_codes.iter().zip(0..) {
                if let Some(plane) = code.checked_sub(1) {
                    let first = &mut self.first_on_plane[plane as usize / 2];
                    *first = (*first).min(facet);
                }
            }
        }
        let n = self.bases.len() as u32;
        self.bases = (0..n).filter(kept).map(|f| self.bases[f as usize]).collect();
        self.normals = (0..n).filter(kept).map(|f| self.normals[f as usize]).collect();
    }

    /// Adds a facet on a shared plane by three of its vertices that are not collinear; `flipped` when these turn
    /// clockwise about the plane's normal.
    pub(crate) fn push_facet_on(&mut self, base: [u32; 3], plane: u32, flipped: bool) {
        let normal = rounded_normal(&self.shared_planes[plane as usize]);
        let oriented = if flipped { normal.map(|n| -n) } else { normal };
        self.push_facet_with(base, oriented, 1 + 2 * plane + u32::from(flipped));
    }

    fn push_facet_with(&mut self, base: [u32; 3], normal: [f64; 3], code: u32) {
        let facet = self.bases.len();
        if code != 0 || !self.plane_codes.is_empty() {
            self.plane_codes.resize(facet, 0);
            self.plane_codes.push(code);
        }
        if let Some(plane) = code.checked_sub(1) {
            let first = &mut self.first_on_plane[plane as usize / 2];
            *first = (*first).min(facet as u32);
        }
        self.bases.push(base);
        self.normals.push(normal);
    }

    /// The plane of a facet. A call, which returns seven numbers by memory, would take longer than the rest.
    #[inline(always)]
    pub(super) fn float(&self, facet: u32) -> FloatPlane {
        let (base, normal) = (self.base(facet), self.normal(facet));
        // A rounded origin and a rounded position are off by 2^-13 each, their difference by 2^-12 more.
        let weight = if self.reach == Reach::Grid { 0.0 } else { normal.iter().map(|n| n.abs()).sum() };
        FloatPlane { normal, origin: self.position(base[0]), slack: weight * 4.0 * ROUNDING }
    }

    /// The shared plane of a facet, and whether the facet looks the other way.
    pub(super) fn shared_plane(&self, facet: u32) -> Option<(u32, bool)> {
        let code = self.plane_codes.get(facet as usize)?.checked_sub(1)?;
        Some((code / 2, code % 2 == 1))
    }

    pub(super) fn shared(&self, plane: u32) -> &SharedPlane {
        &self.shared_planes[plane as usize]
    }

    pub(super) fn close_plane(&self, plane: u32) -> &ApproxPlane {
        &self.close_planes[plane as usize]
    }

    #[cfg(test)]
    pub(super) fn n_canonical_planes(&self) -> u32 {
        self.canonical.planes.len() as u32
    }

    /// Coordinates of a rational point in about 106 bits.
    pub(super) fn close_position(&self, p: u32) -> Option<&[Double; 3]> {
        self.rational_entry(p).map(|entry| &self.close_positions[entry])
    }

    /// Whether a point lies on a shared plane by definition.
    pub(crate) fn is_defined_on(&self, p: u32, plane: u32) -> bool {
        (p as usize) < self.canonical.planes_of_point.len()
            && self.canonical.planes_of_point[p as usize].binary_search(&plane).is_ok()
    }

    /// The shared planes that a point lies on by definition, ascending.
    pub(super) fn planes_of_point(&self, p: u32) -> &[u32] {
        if self.canonical.planes_of_point.is_empty() {
            return &[];
        }
        &self.canonical.planes_of_point[p as usize]
    }

    /// The first facet on a shared plane, if one is.
    pub(super) fn first_on_plane(&self, plane: u32) -> Option<u32> {
        let first = self.first_on_plane[plane as usize];
        (first != u32::MAX).then_some(first)
    }

    /// A shared plane, when it is canonical: one with small coefficients.
    pub(super) fn canonical_plane(&self, plane: u32) -> Option<&Plane> {
        self.canonical.planes.get(plane as usize)
    }

    /// Whether a point lies on the facet's plane by definition: as one of the corners that define it, or because it
    /// was put there.
    pub(crate) fn lies_on(&self, p: u32, facet: u32) -> bool {
        self.base(facet).contains(&p)
            || self.shared_plane(facet).is_some_and(|(plane, _)| self.is_defined_on(p, plane))
    }

    /// The component of a shared plane's normal that is largest, and whether it is positive.
    pub(crate) fn dominant_axis_of_plane(&self, plane: u32) -> (usize, bool) {
        let n = &self.shared_planes[plane as usize].n;
        let axis = (1..3).fold(0, |best, k| if n[k].bits() > n[best].bits() { k } else { best });
        (axis, n[axis].sign() == Sign::Positive)
    }

    /// The three corners that define the facet's plane.
    pub(crate) fn base(&self, facet: u32) -> [u32; 3] {
        self.bases[facet as usize]
    }

    /// The corners that define the facets' planes, facet after facet.
    pub(crate) fn bases(&self) -> &[[u32; 3]] {
        &self.bases
    }

    /// The facet's normal, rounded, up to a positive factor.
    pub(crate) fn normal(&self, facet: u32) -> [f64; 3] {
        self.normals[facet as usize]
    }

    /// The axis along which the facet's normal is longest, and whether it points up that axis. The component is
    /// not zero: the largest of three integers, not all zero, does not round to zero.
    pub(crate) fn dominant_axis(&self, facet: u32) -> (usize, bool) {
        let n = self.normal(facet);
        let axis = longest_axis(n);
        (axis, n[axis] > 0.0)
    }

    /// How far the position of a point may be off.
    pub(crate) fn rounding_of(&self, p: u32) -> f64 {
        if self.rational_entry(p).is_some() { ROUNDING } else { 0.0 }
    }

    pub(crate) fn point_vertex(&self, p: u32) -> Vertex {
        Vertex { at: self.position(p), def: VertexDef::Point(p), is_on_edge: false }
    }

    /// Homogeneous coordinates X, Y, Z, W in grid steps, integers in decimal digits; W is positive.
    pub(crate) fn homogeneous_point(&self, v: &Vertex) -> [String; 4] {
        self.homogeneous(&v.def)
    }

    /// The position of a vertex after a move by whole steps, correctly rounded.
    pub(crate) fn rounded_after(&self, v: &Vertex, offset: [i128; 3]) -> [f64; 3] {
        self.moved_and_rounded(&v.def, offset)
    }
}

/// The number, below 2^93, correctly rounded: both parts are exact, and only their sum is rounded.
pub(crate) fn to_f64(x: i128) -> f64 {
    const LOW: u32 = 40;
    let (high, low) = ((x >> LOW) as i64, x as i64 & ((1 << LOW) - 1));
    high as f64 * (1i64 << LOW) as f64 + low as f64
}

/// The normal in `f64`, its largest component brought below 2^128, so that products of several stay finite.
fn rounded_normal(plane: &SharedPlane) -> [f64; 3] {
    let bits = plane.n.iter().map(Int::bits).max().unwrap_or(0) as i32;
    plane.n.map(|n| n.to_f64_scaled(-i32::max(bits - 128, 0)))
}
