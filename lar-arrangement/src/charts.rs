//! Stage 1e: charts, the parts of a mesh that are seen side by side along a coordinate axis: nothing in them meets but
//! at shared corners and edges.
//!
//! Triangles that look along the same axis most and are joined by edges all turn counter-clockwise when they are
//! projected along it. How many of them cover a point of the plane is the winding number of their boundary about it.
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

/// Facets a chunk of work.
const FACETS_A_CHUNK: usize = 1 << 12;

/// Smaller charts are not worth their boundaries.
const SMALL: usize = 16;

/// No direction that a facet looks in.
const NOWHERE: u8 = 6;

/// The charts of a soup.
#[derive(Debug)]
pub(crate) struct Charts {
    /// The chart of each facet, or `NO_GROUP`.
    of_facet: Vec<u32>,
    /// The facets in no chart, ascending.
    pub without: Vec<u32>,
    /// Directed edges of the charts' boundaries by chart: those on both sides of which there is not the same one.
    boundaries: Vec<Vec<[u32; 2]>>,
}

impl Charts {
    /// Finds them. Corners of one chart that are of no common triangle are farther apart than `distance`, in grid steps.
    /// O(n log n + b), where the boundaries have b pairs of edges with boxes that meet.
    pub(crate) fn new(soup: &Soup, distance: f64, course: &Course) -> Result<Self, Cancelled> {
        let n = soup.n_facets();
        if !soup.geometry.is_on_grid() || n < SMALL {
            return Ok(Self::none(n));
        }
        // Points within the distance along both axes are within √2 of it. Differences of coordinates are exact and have 41
        // bits; a product of them is off by a 2^-53rd of it, so a cross product over a length by less than one step: four
        // are more than enough.
        let margin = 2.0 * distance + 4.0;
        let looks = looks(soup, margin);
        let (mut of_facet, axes) = candidates(soup, &looks);
        let boundaries = boundaries(soup, &of_facet, axes.len());
        let quiet = course.quiet();
        let holds = course.map(axes.len(), |chart| {
            let outline =
                Outline { geometry: &soup.geometry, look: axes[chart], margin, edges: &boundaries[chart] };
            outline.is_once_around(&quiet)
        })?;
        parallel::each_chunk(&mut of_facet, |_, charts| {
            let is_none = |chart: &&mut u32| **chart != NO_GROUP && !holds[**chart as usize];
            charts.iter_mut().filter(is_none).for_each(|chart| *chart = NO_GROUP);
        });
        let without = parallel::select(n, |f| of_facet[f as usize] == NO_GROUP);
        Ok(Self { of_facet, without, boundaries })
    }

    /// No chart.
    pub(crate) fn none(n_facets: usize) -> Self {
        let without = (0..n_facets as u32).collect();
        Self { of_facet: vec![NO_GROUP; n_facets], without, boundaries: Vec::new() }
    }

    /// The chart of a facet, or `NO_GROUP`.
    pub(crate) fn of(&self, facet: u32) -> u32 {
        self.of_facet[facet as usize]
    }

    /// Whether both facets are in one chart.
    pub(crate) fn are_one(&self, f: u32, g: u32) -> bool {
        self.of(f) != NO_GROUP && self.of(f) == self.of(g)
    }

    /// Ends of edges between charts, or between one and other facets.
    pub(crate) fn boundary_points(&self) -> impl Iterator<Item = u32> + '_ {
        self.boundaries.iter().flatten().map(|edge| edge[0])
    }
}

/// For each facet the axis along which its normal is longest, twice, and 1 more when it points down; `NOWHERE` for those
/// that are no triangles, or thin as seen along the axis.
fn looks(soup: &Soup, margin: f64) -> Vec<u8> {
    let mut looks = parallel::map_light(soup.n_facets(), |f| look(soup, f as u32, margin));
    if !parallel::all(soup.edges.len(), |edge| !soup.facets_of_edge[edge].contains(&MANY)) {
        let has_many = |code: &u32| soup.facets_of_edge[(code / 2) as usize].contains(&MANY);
        for (look, edges) in looks.iter_mut().zip(soup.facet_edges.iter()) {
            if edges.iter().any(has_many) {
                *look = NOWHERE;
            }
        }
    }
    looks
}

fn look(soup: &Soup, facet: u32, margin: f64) -> u8 {
    if !soup.is_triangle(facet) {
        return NOWHERE;
    }
    let (axis, up) = soup.geometry.dominant_axis(facet);
    let [a, b, c] = soup.geometry.base(facet).map(|p| projected(&soup.geometry, 2 * axis as u8, p));
    let length = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).abs() + (p[1] - q[1]).abs();
    let longest = length(a, b).max(length(b, c)).max(length(c, a));
    // The component of the normal is twice the projected area: all heights of the projection are above the margin.
    let is_wide = soup.geometry.normal(facet)[axis].abs() > longest * margin;
    if is_wide { 2 * axis as u8 + u8::from(!up) } else { NOWHERE }
}

/// A point as seen along an axis: what looks there turns counter-clockwise.
fn projected(geometry: &Geometry, look: u8, p: u32) -> [f64; 2] {
    let axis = (look / 2) as usize;
    let at = geometry.position(p);
    let [u, v] = [at[(axis + 1) % 3], at[(axis + 2) % 3]];
    if look.is_multiple_of(2) { [u, v] } else { [v, u] }
}

/// Sets of facets that look the same way and are joined by edges, and where each looks.
fn candidates(soup: &Soup, looks: &[u8]) -> (Vec<u32>, Vec<u8>) {
    let look_alike = |&(f, g): &(u32, u32)| {
        f < MANY && g < MANY && looks[f as usize] == looks[g as usize] && looks[f as usize] != NOWHERE
    };
    let users = &soup.facets_of_edge;
    let joined = |edges: Range<usize>| users[edges].iter().map(|&[f, g]| (f, g)).filter(look_alike);
    let (mut of_facet, n) = UnionFind::of_pairs(looks.len(), users.len(), joined).labels();
    // How many there are in each set, and where its first one looks.
    let mut sets = vec![(0, NOWHERE); n as usize];
    let mut begin = 0;
    for alike in of_facet.chunk_by(|a, b| a == b) {
        let (size, look) = &mut sets[alike[0] as usize];
        if *size == 0 {
            *look = looks[begin];
        }
        *size += alike.len();
        begin += alike.len();
    }
    let mut axes = Vec::new();
    let number = sets.into_iter().map(|(size, look)| {
        if size < SMALL {
            return NO_GROUP;
        }
        axes.push(look);
        axes.len() as u32 - 1
    });
    let number: Vec<u32> = number.collect();
    parallel::each_chunk(&mut of_facet, |_, sets| {
        sets.iter_mut().for_each(|set| *set = number[*set as usize]);
    });
    (of_facet, axes)
}

/// The directed edges of each set's boundary.
fn boundaries(soup: &Soup, of_facet: &[u32], n: usize) -> Vec<Vec<[u32; 2]>> {
    let chart = |f: u32| if f < MANY { of_facet[f as usize] } else { NO_GROUP };
    let (n_chunks, range) = parallel::chunks(soup.edges.len(), FACETS_A_CHUNK);
    let parts = parallel::map(n_chunks, |chunk| {
        let mut found = Vec::new();
        for edge in range(chunk) {
            let [along, against] = soup.facets_of_edge[edge].map(chart);
            if along != against {
                let [p, q] = soup.edges[edge];
                let sides = [(along, [p, q]), (against, [q, p])];
                found.extend(sides.into_iter().filter(|side| side.0 != NO_GROUP));
            }
        }
        found
    });
    let mut boundaries = vec![Vec::new(); n];
    for (chart, edge) in parts.into_iter().flatten() {
        boundaries[chart as usize].push(edge);
    }
    boundaries
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
    fn is_once_around(&self, course: &Course) -> bool {
        self.is_simple(course) && self.has_one_outer_loop()
    }

    /// Whether edges without a common end are farther apart than the margin, and others do not fold back.
    fn is_simple(&self, course: &Course) -> bool {
        let boxes: Vec<Aabb<2>> = self
            .edges
            .iter()
            .map(|ends| {
                let tight = Aabb::around(ends.map(|p| self.at(p)));
                Aabb { lo: tight.lo.map(|x| x - self.margin), hi: tight.hi.map(|x| x + self.margin) }
            })
            .collect();
        let tree = BoxTree::new(&boxes);
        // The first that fails ends the search: crossing boundaries may have many pairs.
        (0..tree.n_blocks()).all(|block| {
            let mut are_apart = !course.is_cancelled();
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
        let mut ends: Vec<(u32, bool, u32)> = Vec::with_capacity(2 * self.edges.len());
        for (&[tail, head], edge) in self.edges.iter().zip(0..) {
            ends.extend([(tail, true, edge), (head, false, edge)]);
        }
        ends.sort_unstable();
        let mut next = vec![0; self.edges.len()];
        for around in ends.chunk_by_mut(|a, b| a.0 == b.0) {
            if around.len() > 2 {
                // Edges that do not fold back differ in direction by far more than angles are rounded.
                around.sort_by(|a, b| self.angle(a).total_cmp(&self.angle(b)));
            }
            for (i, &(_, leaves, edge)) in around.iter().enumerate() {
                let before = around[(i + around.len() - 1) % around.len()];
                if !leaves {
                    next[edge as usize] = if before.1 { before.2 } else { return None };
                }
            }
        }
        Some(next)
    }

    /// The direction from a point to the other end of an edge that leaves it or arrives there.
    fn angle(&self, &(at, leaves, edge): &(u32, bool, u32)) -> f64 {
        let to = minus(self.at(self.edges[edge as usize][usize::from(leaves)]), self.at(at));
        to[1].atan2(to[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Control;
    use crate::soup::Placed;
    use lar_core::{Points, Surface};

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
            let charts = Charts::new(&soup, 1.5, &course).expect("nobody cancels");
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
