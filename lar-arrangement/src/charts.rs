//! Stage 1e: charts, the parts of a mesh that are seen side by side along a coordinate axis: nothing in them meets but
//! at shared corners and edges.
//!
//! Triangles that look along the same axis and are joined by edges all turn counter-clockwise when they are projected
//! along it. How many of them cover a point of the plane is the winding number of their boundary about it.
//! When the boundary does not meet itself and has only one loop that turns counter-clockwise, that number is 0 or 1: the
//! triangles are the graph of a function.
//!
//! ```text
//!     ╭───<───╮       +1 inside the loop that turns counter-clockwise,
//!     │  ╭>╮  │       −1 inside of every other:
//!     │  ╰<╯  ^       1 − 1 = 0 in the hole
//!     ╰───>───╯
//! ```
//!
//! (Volino and Magnenat-Thalmann found collisions of cloth with itself in this way, Computer Graphics Forum 13, 1994.)
//! A facet that looks between the axes is in the charts of several: charts overlap, and whatever is near a border of one is
//! well inside of another. Joined facets that look along the same axes are a *region*: but for the edges between regions,
//! the mesh is looked at once for all charts.
//!
//! The test is one of `f64` with a margin for all rounding: where it fails nothing is claimed. The margin also keeps
//! corners without a common triangle farther apart than points that are nearly one.

use crate::boxes::{Aabb, BoxTree, NO_GROUP};
use crate::half_edges::MANY;
use crate::kernel::Geometry;
use crate::parallel;
use crate::progress::{Cancelled, Course};
use crate::soup::Soup;
use crate::union_find::UnionFind;
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

/// Smaller charts are not worth their boundaries.
const SMALL: usize = 16;

/// Facets look along an axis when their normal has so much of its length there: up to 72 degrees away from it. Charts
/// then overlap by 17 degrees at least, as every normal is nearer than 55 to some axis. Where the mesh is rough such wide
/// charts cover themselves, and 66 degrees are tried.
const LOOKS: [f64; 2] = [0.3, 0.4];
/// Boundaries of so few edges are swept, without a tree.
const SHORT: usize = 256;
/// A chart of one facet in so many is large.
const LARGE: usize = 64;

/// The charts of a soup.
#[derive(Debug)]
pub(crate) struct Charts {
    /// The region of each facet: its facets are in the same charts.
    region: Vec<u32>,
    /// The charts of each region.
    of_region: Vec<Shared>,
    /// The facets in no chart, ascending.
    pub without: Vec<u32>,
    /// Points inside the mesh whose facets are in charts, but not all in one, ascending.
    pub between: Vec<u32>,
}

/// The charts that all of some facets are in: at most one along each axis, a number from 1 in a field of its own, or
/// `NONE`. All fields are 0 when there are no facets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Shared(u64);

/// Bits of a number.
const BITS: u32 = 20;
/// No chart along an axis.
const NONE: u64 = (1 << BITS) - 1;
/// Fields with a bit between them.
const FIELD: u32 = BITS + 1;
const ALL: u64 = 1 | 1 << FIELD | 1 << (2 * FIELD);

impl Shared {
    const NOTHING: Self = Self(NONE * ALL);

    fn new(charts: [u32; 3]) -> Self {
        let number = |k: usize| (u64::from(charts[k]) + 1).clamp(1, NONE);
        Self(number(0) | number(1) << FIELD | number(2) << (2 * FIELD))
    }

    /// Those that are shared with others, too. Without branches, and of operations that processors have for several numbers at
    /// once: voxels are many.
    pub(crate) fn with(self, other: Self) -> Self {
        // A field that is not zero carries into the bit above it.
        let carry = |fields: u64| fields + NONE * ALL;
        let differ = carry(self.0 ^ other.0) & carry(self.0) & carry(other.0) & (ALL << BITS);
        Self(self.0 | other.0 | (differ - (differ >> BITS)))
    }

    /// Whether there are facets that are not all in one chart.
    pub(crate) fn is_nothing(self) -> bool {
        self == Self::NOTHING
    }

    /// Some chart.
    fn any(self) -> u32 {
        let charts = [0, 1, 2].map(|k| self.0 >> (k * FIELD) & NONE);
        charts.into_iter().find(|&chart| chart != NONE).map_or(NO_GROUP, |chart| chart as u32 - 1)
    }
}

impl Charts {
    /// Finds them. Corners of one chart that are of no common triangle are farther apart than `distance`, in grid steps.
    /// O(n log n + b), where the boundaries have b pairs of edges with boxes that meet. Some of it keeps one thread busy:
    /// `beside` is called meanwhile by another.
    pub(crate) fn new(
        soup: &Soup,
        distance: f64,
        course: &Course,
        beside: impl FnOnce() + Send,
    ) -> Result<Self, Cancelled> {
        let n = soup.n_facets();
        if !soup.geometry.is_on_grid() || n < SMALL {
            beside();
            return Ok(Self::none(n));
        }
        // Points within the distance along both axes are within √2 of it. Differences of coordinates are exact and have 41
        // bits; a product of them is off by a 2^-53rd of it, so a cross product over a length by less than one step: four
        // are more than enough.
        let margin = 2.0 * distance + 4.0;
        let [wide, narrow] = LOOKS;
        match Self::of_looks(soup, wide, margin, n / LARGE, course, beside)? {
            Some(charts) => Ok(charts),
            None => {
                let charts = Self::of_looks(soup, narrow, margin, n, course, || ())?;
                Ok(charts.unwrap_or_else(|| Self::none(n)))
            }
        }
    }

    /// The charts of facets that look along an axis with so much of their normals; none when one of more than so many facets
    /// would cover itself.
    fn of_looks(
        soup: &Soup,
        share: f64,
        margin: f64,
        most: usize,
        course: &Course,
        beside: impl FnOnce() + Send,
    ) -> Result<Option<Self>, Cancelled> {
        let looks = looks(soup, share, margin);
        let alike = Regions::sets(soup, &looks);
        let candidates = || {
            let regions = Regions::new(soup, &looks, alike);
            let (of_region, charts) = regions.candidates();
            let boundaries = regions.boundaries(soup, &of_region, charts.len());
            (regions, of_region, charts, boundaries)
        };
        let ((regions, mut of_region, charts, boundaries), ()) = parallel::join(candidates, beside);
        let (quiet, is_given_up) = (course.quiet(), AtomicBool::new(false));
        let holds = course.map(charts.len(), |i| {
            let Chart { look, size } = charts[i];
            let outline = Outline { geometry: &soup.geometry, look, margin, edges: &boundaries[i] };
            let holds = outline.is_once_around(&|| quiet.is_cancelled() || is_given_up.load(Relaxed));
            if !holds && size > most {
                is_given_up.store(true, Relaxed);
            }
            holds
        })?;
        if is_given_up.into_inner() {
            return Ok(None);
        }
        for chart in of_region.as_flattened_mut() {
            if *chart != NO_GROUP && !holds[*chart as usize] {
                *chart = NO_GROUP;
            }
        }
        let of_region: Vec<Shared> = of_region.into_iter().map(Shared::new).collect();
        let region_of = |f: u32| regions.of_facet[f as usize] as usize;
        let (between, without) = parallel::join(
            || regions.between(soup, &of_region),
            || parallel::select(soup.n_facets(), |f| of_region[region_of(f)].is_nothing()),
        );
        Ok(Some(Self { region: regions.of_facet, of_region, without, between }))
    }

    /// No chart.
    pub(crate) fn none(n_facets: usize) -> Self {
        let without = (0..n_facets as u32).collect();
        Self { region: vec![0; n_facets], of_region: vec![Shared::NOTHING], without, between: Vec::new() }
    }

    /// All charts of a facet.
    pub(crate) fn all(&self, facet: u32) -> Shared {
        self.of_region[self.region[facet as usize] as usize]
    }

    /// One of the charts of a facet, or `NO_GROUP`.
    pub(crate) fn of(&self, facet: u32) -> u32 {
        self.all(facet).any()
    }

    /// Whether both facets are in one chart.
    pub(crate) fn are_one(&self, f: u32, g: u32) -> bool {
        let [at_f, at_g] = [f, g].map(|f| self.region[f as usize]);
        let all = self.of_region[at_f as usize];
        // Most neighbours are of one region.
        let shared = if at_f == at_g { all } else { all.with(self.of_region[at_g as usize]) };
        !shared.is_nothing()
    }
}

/// For each facet the axes along which it looks, 1 << 2 · axis, twice that when it looks down; 0 for those that are no
/// triangles, and nothing along axes where they are thin.
fn looks(soup: &Soup, share: f64, margin: f64) -> Vec<u8> {
    let are_triangles = soup.are_triangles();
    let mut looks = parallel::map_light(soup.n_facets(), |f| {
        let is_triangle = are_triangles || soup.is_triangle(f as u32);
        if is_triangle { look(soup, f as u32, share, margin) } else { 0 }
    });
    if !parallel::all(soup.edges.len(), |edge| !soup.facets_of_edge[edge].contains(&MANY)) {
        let has_many = |code: &u32| soup.facets_of_edge[(code / 2) as usize].contains(&MANY);
        for (look, edges) in looks.iter_mut().zip(soup.facet_edges.iter()) {
            if edges.iter().any(has_many) {
                *look = 0;
            }
        }
    }
    looks
}

/// Where a triangle looks.
fn look(soup: &Soup, facet: u32, share: f64, margin: f64) -> u8 {
    let [a, b, c] = soup.geometry.base(facet).map(|p| soup.geometry.position(p));
    let length = |p: [f64; 3], q: [f64; 3]| (0..3).map(|k| (p[k] - q[k]).abs()).sum::<f64>();
    let longest = length(a, b).max(length(b, c)).max(length(c, a));
    let normal = soup.geometry.normal(facet);
    let size = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    // A component of the normal is twice the projected area: all heights of the projection are above the margin.
    let limit = (share * size).max(longest * margin);
    (0..3).fold(0, |looks, k| {
        looks | u8::from(normal[k] > limit) << (2 * k) | u8::from(normal[k] < -limit) << (2 * k + 1)
    })
}

/// A point as seen along an axis: what looks there turns counter-clockwise.
fn projected(geometry: &Geometry, look: u8, p: u32) -> [f64; 2] {
    let axis = (look / 2) as usize;
    let at = geometry.position(p);
    let [u, v] = [at[(axis + 1) % 3], at[(axis + 2) % 3]];
    if look.is_multiple_of(2) { [u, v] } else { [v, u] }
}

/// What may be a chart: where its facets look, and how many they are.
struct Chart {
    look: u8,
    size: usize,
}

/// Sets of facets that look the same ways and are joined by edges.
struct Regions {
    of_facet: Vec<u32>,
    /// Where the facets of each look.
    looks: Vec<u8>,
    /// The number of facets of each.
    sizes: Vec<usize>,
    borders: Vec<Border>,
}

/// An edge on both sides of which there is not the same region.
struct Border {
    edge: u32,
    /// The region that runs along it and the one that runs against it, or `MANY` or more for none.
    sides: [u32; 2],
}

impl Border {
    /// The regions on both sides.
    fn beside(&self) -> [Option<usize>; 2] {
        self.sides.map(|region| (region < MANY).then_some(region as usize))
    }
}

impl Regions {
    /// The facets that look the same ways and are joined by edges.
    fn sets(soup: &Soup, looks: &[u8]) -> UnionFind {
        let users = &soup.facets_of_edge;
        let look_alike = |&(f, g): &(u32, u32)| {
            f < MANY && g < MANY && looks[f as usize] == looks[g as usize] && looks[f as usize] != 0
        };
        let joined = |edges: Range<usize>| users[edges].iter().map(|&[f, g]| (f, g)).filter(look_alike);
        UnionFind::of_pairs(looks.len(), users.len(), joined)
    }

    fn new(soup: &Soup, looks: &[u8], sets: UnionFind) -> Self {
        let users = &soup.facets_of_edge;
        let (of_facet, n) = sets.labels();
        let (mut sizes, mut looks_of) = (vec![0; n as usize], vec![0; n as usize]);
        let mut begin = 0;
        for alike in of_facet.chunk_by(|a, b| a == b) {
            sizes[alike[0] as usize] += alike.len();
            looks_of[alike[0] as usize] = looks[begin];
            begin += alike.len();
        }
        let at = |f: u32| if f < MANY { of_facet[f as usize] } else { f };
        let edges = parallel::select(users.len(), |edge| {
            let [along, against] = users[edge as usize].map(at);
            along != against
        });
        let borders = parallel::map_light(edges.len(), |i| {
            let edge = edges[i];
            Border { edge, sides: users[edge as usize].map(at) }
        });
        Self { of_facet, looks: looks_of, sizes, borders }
    }

    /// For each region what may be its chart along each axis: facets that look the same way and are joined by edges. Also
    /// all of these.
    fn candidates(&self) -> (Vec<[u32; 3]>, Vec<Chart>) {
        let n = self.looks.len();
        let mut sets = UnionFind::new(3 * n);
        for border in &self.borders {
            let [Some(a), Some(b)] = border.beside() else { continue };
            let alike = self.looks[a] & self.looks[b];
            for k in (0..3).filter(|k| alike >> (2 * k) & 3 != 0) {
                sets.union((3 * a + k) as u32, (3 * b + k) as u32);
            }
        }
        let (set_of, n_sets) = sets.labels();
        let mut sizes = vec![0; n_sets as usize];
        for (i, &set) in set_of.iter().enumerate() {
            sizes[set as usize] += self.sizes[i / 3];
        }
        let mut number = vec![NO_GROUP; n_sets as usize];
        let mut charts = Vec::new();
        let chart = |(i, &set): (usize, &u32)| {
            let look = self.looks[i / 3] >> (2 * (i % 3)) & 3;
            if look == 0 || sizes[set as usize] < SMALL {
                return NO_GROUP;
            }
            let number = &mut number[set as usize];
            if *number == NO_GROUP {
                *number = charts.len() as u32;
                charts.push(Chart { look: 2 * (i % 3) as u8 + (look >> 1), size: sizes[set as usize] });
            }
            *number
        };
        let of_region: Vec<u32> = set_of.iter().enumerate().map(chart).collect();
        (of_region.as_chunks().0.to_vec(), charts)
    }

    /// The directed edges of each chart's boundary.
    fn boundaries(&self, soup: &Soup, charts: &[[u32; 3]], n: usize) -> Vec<Vec<[u32; 2]>> {
        let mut boundaries = vec![Vec::new(); n];
        for border in &self.borders {
            let [along, against] =
                border.beside().map(|region| region.map_or([NO_GROUP; 3], |region| charts[region]));
            let [p, q] = soup.edges[border.edge as usize];
            for k in (0..3).filter(|&k| along[k] != against[k]) {
                for (chart, edge) in [(along[k], [p, q]), (against[k], [q, p])] {
                    if chart != NO_GROUP {
                        boundaries[chart as usize].push(edge);
                    }
                }
            }
        }
        boundaries
    }

    /// The points inside the mesh whose facets are in charts, but not all in one, ascending.
    fn between(&self, soup: &Soup, of_region: &[Shared]) -> Vec<u32> {
        let mut around: Vec<Shared> = parallel::zeros(soup.geometry.n_points());
        for border in &self.borders {
            if let [Some(a), Some(b)] = border.beside() {
                let shared = of_region[a].with(of_region[b]);
                for p in soup.edges[border.edge as usize] {
                    let around = &mut around[p as usize];
                    *around = around.with(shared);
                }
            }
        }
        parallel::select(around.len(), |p| around[p as usize].is_nothing())
    }
}

/// The boundary of facets that look the same way.
struct Outline<'a> {
    geometry: &'a Geometry,
    look: u8,
    margin: f64,
    edges: &'a [[u32; 2]],
}

type Vector = [f64; 2];

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Not shorter than the vector.
fn size(a: Vector) -> f64 {
    a[0].abs() + a[1].abs()
}

impl Outline<'_> {
    fn at(&self, p: u32) -> Vector {
        projected(self.geometry, self.look, p)
    }

    /// Whether the boundary, projected, does not meet itself and winds about every point once or not at all.
    fn is_once_around(&self, gives_up: &dyn Fn() -> bool) -> bool {
        self.is_simple(gives_up) && self.has_one_outer_loop()
    }

    /// Whether edges without a common end are farther apart than the margin, and others do not fold back.
    fn is_simple(&self, gives_up: &dyn Fn() -> bool) -> bool {
        let mut boxes: Vec<(Aabb<2>, u32)> = self
            .edges
            .iter()
            .zip(0..)
            .map(|(ends, edge)| (Aabb::around(ends.map(|p| self.at(p))).larger(self.margin), edge))
            .collect();
        // The first that fails ends the search: crossing boundaries may have many pairs.
        if boxes.len() <= SHORT {
            // Each has so many others at most.
            boxes.sort_unstable_by(|a, b| a.0.lo[0].total_cmp(&b.0.lo[0]));
            return boxes.iter().enumerate().all(|(i, (a, edge))| {
                let mut beside = boxes[i + 1..].iter().take_while(|(b, _)| b.lo[0] <= a.hi[0]);
                beside.all(|(b, other)| !a.meets(b) || self.are_apart(*edge, *other))
            });
        }
        let boxes: Vec<Aabb<2>> = boxes.into_iter().map(|(b, _)| b).collect();
        let tree = BoxTree::new(&boxes);
        (0..tree.n_blocks()).all(|block| {
            let mut are_apart = !gives_up();
            tree.pairs_of_block(block, |i, j| are_apart = are_apart && self.are_apart(i, j));
            are_apart
        })
    }

    fn are_apart(&self, i: u32, j: u32) -> bool {
        let (e, f) = (self.edges[i as usize], self.edges[j as usize]);
        match (f.contains(&e[0]), f.contains(&e[1])) {
            (true, true) => false,
            (false, false) => self.is_beside(e, f) || self.is_beside(f, e),
            (first, _) => {
                let [shared, p] = if first { e } else { [e[1], e[0]] };
                let q = if f[0] == shared { f[1] } else { f[0] };
                let (a, b) = (minus(self.at(p), self.at(shared)), minus(self.at(q), self.at(shared)));
                dot(a, b) <= 0.0 || cross(a, b).abs() > self.margin * size(a).max(size(b))
            }
        }
    }

    /// Whether an edge is on one side of the line of another.
    fn is_beside(&self, e: [u32; 2], line: [u32; 2]) -> bool {
        let from = self.at(line[0]);
        let along = minus(self.at(line[1]), from);
        let [a, b] = e.map(|p| cross(along, minus(self.at(p), from)));
        let limit = self.margin * size(along);
        (a > limit && b > limit) || (a < -limit && b < -limit)
    }

    /// For a boundary that does not meet itself: whether one loop turns counter-clockwise and all others clockwise. Loops
    /// are those around the inside, as seen in the plane.
    fn has_one_outer_loop(&self) -> bool {
        let Some(next) = self.next_around() else { return false };
        let mut seen = vec![false; self.edges.len()];
        let mut n_outer = 0;
        for start in 0..self.edges.len() {
            if seen[start] {
                continue;
            }
            let origin = self.at(self.edges[start][0]);
            let (mut area, mut terms, mut at) = (0.0, 0.0, start);
            while !std::mem::replace(&mut seen[at], true) {
                let [a, b] = self.edges[at].map(|p| minus(self.at(p), origin));
                area += cross(a, b);
                terms += size(a) * size(b);
                at = next[at] as usize;
            }
            // Each product and each sum is rounded by 2^-53 of the terms at most.
            if area.abs() <= terms * self.edges.len() as f64 * 2f64.powi(-50) {
                return false;
            }
            n_outer += u32::from(area > 0.0);
        }
        n_outer == 1
    }

    /// The edge after each one around the inside: the first one clockwise from it at its head.
    fn next_around(&self) -> Option<Vec<u32>> {
        let mut ends: Vec<End> = Vec::with_capacity(2 * self.edges.len());
        for (&[tail, head], edge) in self.edges.iter().zip(0..) {
            ends.extend([End::new(tail, edge, true), End::new(head, edge, false)]);
        }
        ends.sort_unstable();
        let mut next = vec![0; self.edges.len()];
        for around in ends.chunk_by_mut(|a, b| a.point() == b.point()) {
            if around.len() > 2 {
                // Edges that do not fold back differ in direction by far more than angles are rounded.
                around.sort_by(|&a, &b| self.angle(a).total_cmp(&self.angle(b)));
            }
            for (i, end) in around.iter().enumerate() {
                let before = around[(i + around.len() - 1) % around.len()];
                if !end.leaves() {
                    next[end.edge()] = if before.leaves() { before.edge() as u32 } else { return None };
                }
            }
        }
        Some(next)
    }

    /// The direction from the point of an end to the other end of the edge.
    fn angle(&self, end: End) -> f64 {
        let to = minus(self.at(self.edges[end.edge()][usize::from(end.leaves())]), self.at(end.point()));
        to[1].atan2(to[0])
    }
}

/// An end of an edge, fewer than 2^31 of them: the point above the edge above whether the edge leaves it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct End(u64);

impl End {
    fn new(point: u32, edge: u32, leaves: bool) -> Self {
        Self(u64::from(point) << 32 | u64::from(edge) << 1 | u64::from(leaves))
    }

    fn point(self) -> u32 {
        (self.0 >> 32) as u32
    }

    fn edge(self) -> usize {
        (self.0 as u32 >> 1) as usize
    }

    fn leaves(self) -> bool {
        self.0 & 1 != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Control;
    use crate::soup::Placed;
    use lar_core::{Points, Surface, icosphere};

    /// A sheet of n × m squares, each of two triangles, without some; `at` places its points.
    fn sheet(
        [n, m]: [u32; 2],
        is_square: impl Fn(u32, u32) -> bool,
        at: impl Fn(f64, f64) -> [f64; 3],
    ) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let points =
            (0..(n + 1) * (m + 1)).map(|i| at(f64::from(i % (n + 1)), f64::from(i / (n + 1)))).collect();
        let squares = (0..n * m).map(|i| (i % n, i / n)).filter(|&(x, y)| is_square(x, y));
        let triangles = squares.flat_map(|(x, y)| {
            let p = y * (n + 1) + x;
            [[p, p + 1, p + n + 2], [p, p + n + 2, p + n + 1]]
        });
        (points, triangles.collect())
    }

    /// Checks how many triangles are in charts, for the mesh and for the mesh turned over.
    #[track_caller]
    fn check((points, mut triangles): (Vec<[f64; 3]>, Vec<[u32; 3]>), expected: usize) {
        for turned in ["as it is", "turned over"] {
            let mut surface = Surface::new("sheet", Points::from_xyz(&points));
            triangles.iter().for_each(|t| _ = surface.push_face([&t[..]], 1));
            let surfaces = [surface];
            let placed = Placed::snapped(&surfaces, |_, _| 0.0).expect("the points are finite");
            let soup = Soup::new(&surfaces, placed);
            let course = Course::new(Control::default(), &[]);
            let charts = Charts::new(&soup, 1.5, &course, || ()).expect("nobody cancels");
            let found = (0..soup.n_facets() as u32).filter(|&f| charts.of(f) != NO_GROUP).count();
            assert_eq!(found, expected, "{turned}");
            triangles.iter_mut().for_each(|t| t.reverse());
        }
    }

    /// A strip three squares wide that winds about the axis so many times and rises.
    fn ramp(turns: f64, rise: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        sheet(
            [3, 60],
            |_, _| true,
            |x, y| {
                let angle = std::f64::consts::TAU * turns * y / 60.0;
                [(4.0 + x) * angle.cos(), (4.0 + x) * angle.sin(), -rise * y]
            },
        )
    }

    #[test]
    fn graphs_of_functions_are_charts() {
        check(sheet([9, 7], |_, _| true, |x, y| [x, y, 0.3 * (x + 2.0 * y).sin()]), 126);
        check(sheet([9, 7], |_, _| true, |x, y| [0.3 * (x + 2.0 * y).sin(), y, x]), 126);
        check(ramp(0.9, 0.01), 360);
    }

    #[test]
    fn holes_and_corners_that_touch() {
        check(sheet([9, 7], |x, y| (x, y) != (3, 3), |x, y| [x, y, 0.0]), 124);
        check(sheet([9, 7], |x, y| (x, y) != (3, 3) && (x, y) != (6, 2), |x, y| [x, y, 0.0]), 122);
        // Two squares without a common edge are missing, or two that are at the border.
        check(sheet([9, 7], |x, y| (x, y) != (3, 3) && (x, y) != (4, 4), |x, y| [x, y, 0.0]), 122);
        check(sheet([9, 7], |x, y| (x, y) != (0, 3) && (x, y) != (1, 4), |x, y| [x, y, 0.0]), 122);
    }

    /// A ball whose points lie nearer to its middle or farther away.
    fn ball(subdivisions: u32, radius: impl Fn(usize) -> f64) -> Soup {
        let mut mesh = icosphere(subdivisions);
        let points: Vec<[f64; 3]> =
            (0..mesh.points.len()).map(|i| mesh.points.xyz(i).map(|x| x * radius(i))).collect();
        mesh.points = Points::from_xyz(&points);
        let surfaces = [Surface::from_triangles("ball", &mesh)];
        Soup::new(&surfaces, Placed::snapped(&surfaces, |_, _| 0.0).expect("the points are finite"))
    }

    #[test]
    fn charts_of_a_ball_overlap() {
        let soup = ball(4, |_| 1.0);
        let charts =
            Charts::new(&soup, 1.5, &Course::new(Control::default(), &[]), || ()).expect("nobody cancels");
        assert!(charts.without.is_empty() && charts.between.is_empty());
        assert!(soup.facets_of_edge.iter().all(|&[f, g]| charts.are_one(f, g)));
        let unit = |f: u32| {
            let n = soup.geometry.normal(f);
            let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
            n.map(|x| x / length)
        };
        let is_opposite = |&f: &u32| (0..3).map(|k| unit(0)[k] * unit(f)[k]).sum::<f64>() < -0.98;
        let opposite: Vec<u32> = (0..soup.n_facets() as u32).filter(is_opposite).collect();
        assert!(opposite.len() > 20 && !opposite.iter().any(|&f| charts.are_one(0, f)));
    }

    #[test]
    fn rough_meshes_have_narrow_charts() {
        let course = Course::new(Control::default(), &[]);
        for (height, are_narrow, n_without) in [(0.02, true, 0), (0.044, true, 0), (0.058, false, 992)] {
            let soup = ball(4, |i| 1.0 + height * (i * i % 7) as f64 / 7.0);
            let found = |share| {
                Charts::of_looks(&soup, share, 7.0, soup.n_facets() / LARGE, &course, || ())
                    .expect("nobody cancels")
            };
            assert_eq!(found(LOOKS[0]).is_some(), height < 0.03);
            assert_eq!(found(LOOKS[1]).is_some(), are_narrow);
            let charts = Charts::new(&soup, 1.5, &course, || ()).expect("nobody cancels");
            assert_eq!(charts.without.len(), n_without, "{height}");
        }
    }

    #[test]
    fn what_is_shared() {
        let one = Shared::new([0, 5, NO_GROUP]);
        assert_eq!(Shared::default().with(one), one);
        assert_eq!(one.with(one), one);
        assert_eq!(one.with(Shared::new([1, 5, 7])), Shared::new([NO_GROUP, 5, NO_GROUP]));
        assert!(one.with(Shared::new([1, 4, NO_GROUP])).is_nothing());
        assert!(Shared::new([u32::MAX - 1, 1 << BITS, (1 << BITS) - 2]).is_nothing());
        assert_eq!(one.any(), 0);
        assert_eq!(Shared::NOTHING.any(), NO_GROUP);
    }

    #[test]
    fn what_covers_itself_is_none() {
        check(ramp(1.1, 0.01), 0);
        check(ramp(2.0, 0.01), 0);
    }

    #[test]
    fn what_nearly_touches_itself_is_none() {
        // The two ends of a ring are not joined, and apart by less than rounding explains, or by more.
        check(ramp(1.0 - 1e-13, 0.0), 0);
        check(ramp(1.0 - 1e-9, 0.0), 360);
    }

    #[test]
    fn thin_triangles_are_in_no_chart() {
        let (points, mut triangles) = sheet([9, 7], |_, _| true, |x, y| [x, y, 0.0]);
        let mut points = points;
        points.push([0.5, -1e-12, 0.0]);
        triangles.push([0, 80, 1]);
        check((points, triangles), 126);
    }
}
