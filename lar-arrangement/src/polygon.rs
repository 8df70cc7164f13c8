//! Stage 1b: one input polygon on the grid → facets that are exactly planar.
//!
//! A triangle is a facet. A larger polygon is kept whole when its corners are exactly coplanar, its loops are simple and
//! all but the first are holes of it; otherwise it is triangulated with diagonals inside. What decides is exact. Only the
//! choice of three corners and of diagonals looks at the nearest grid points instead of rational corners: any choice is
//! right.

use crate::kernel::{Geometry, Plane, Sign, dominant_axis};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Polygons with more corners are triangulated even when planar, so that testing a pair of facets has bounded cost.
pub(crate) const MAX_CORNERS: usize = 64;

/// What becomes of a polygon.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Exactly planar: kept whole. Three corners that span its plane, counter-clockwise about the normal on the grid,
    /// and whether the loops turn counter-clockwise seen along the plane's dominant axis.
    Planar { base: [u32; 3], positive: bool },
    /// Cut into triangles, oriented like the polygon.
    Triangles(Vec<[u32; 3]>),
    /// All corners on one line: it has no inside.
    Degenerate,
}

/// A polygon: loops of points, the outer one first.
pub(crate) struct Polygon<'a> {
    pub geometry: &'a Geometry,
    pub loops: &'a [&'a [u32]],
    /// The shared plane that it was given.
    pub plane: Option<u32>,
}

impl Polygon<'_> {
    fn corners(&self) -> impl Iterator<Item = u32> + Clone + '_ {
        self.loops.iter().flat_map(|l| l.iter().copied())
    }

    fn edges(&self) -> impl Iterator<Item = [u32; 2]> + Clone + '_ {
        self.loops.iter().flat_map(|l| (0..l.len()).map(move |i| [l[i], l[(i + 1) % l.len()]]))
    }

    fn at(&self, p: u32) -> [i64; 3] {
        self.geometry.nearest_grid_point(p)
    }

    /// Decides the shape.
    pub(crate) fn shape(&self) -> Shape {
        let Some(base) = self.spanning_corners() else {
            return Shape::Degenerate;
        };
        let [a, b, c] = base;
        let plane = Plane::through(self.at(a), self.at(b), self.at(c));
        let axis = match self.plane {
            Some(shared) => self.geometry.dominant_axis_of_plane(shared).0,
            None => dominant_axis(plane.n),
        };
        let area = self.projected_area(axis);
        if self.is_planar(&plane)
            && area.unsigned_abs() > self.area_slack(axis)
            && self.corners().count() <= MAX_CORNERS
            && self.is_simple(axis)
            && self.is_one_region(axis, area > 0)
        {
            let agrees = (area > 0) == (plane.n[axis] > 0);
            return Shape::Planar { base: if agrees { base } else { [a, c, b] }, positive: area > 0 };
        }
        Shape::Triangles(self.triangles(axis, area >= 0))
    }

    /// Whether all corners lie on one plane, which is the given one, or that of three corners on the grid.
    fn is_planar(&self, plane: &Plane) -> bool {
        match self.plane {
            Some(shared) => self.corners().all(|p| self.geometry.is_defined_on(p, shared)),
            None => self.corners().all(|p| self.geometry.grid_point(p).is_some_and(|x| plane.side(x) == 0)),
        }
    }

    /// By how much the projected area may differ from that of the exact corners, which are less than a step from the
    /// nearest grid points: twice the area, so two steps times the sum of all sides.
    fn area_slack(&self, axis: usize) -> u128 {
        if self.corners().all(|p| self.geometry.grid_point(p).is_some()) {
            return 0;
        }
        let side = |[p, q]: [u32; 2]| {
            let ([pu, pv], [qu, qv]) = (self.projected(p, axis), self.projected(q, axis));
            u128::from(pu.abs_diff(qu)) + u128::from(pv.abs_diff(qv)) + 2
        };
        2 * self.edges().map(side).sum::<u128>()
    }

    /// How far, in grid steps, the corners lie from the plane of the three that span it.
    pub(crate) fn deviation(&self) -> f64 {
        let Some([a, b, c]) = self.spanning_corners() else { return 0.0 };
        let plane = Plane::through(self.at(a), self.at(b), self.at(c));
        let length = plane.length();
        self.corners().map(|p| (plane.side(self.at(p)) as f64 / length).abs()).fold(0.0, f64::max)
    }

    /// Three corners far from one line: that of lowest number, the farthest from it, and the farthest from their
    /// line. Ties go to the highest number, so that it does not matter where a loop starts or which way it turns.
    fn spanning_corners(&self) -> Option<[u32; 3]> {
        let mut corners: Vec<u32> = self.corners().collect();
        corners.sort_unstable();
        let a = *corners.first()?;
        let distance = |p: u32| {
            let (p, a) = (self.at(p), self.at(a));
            (0..3).map(|k| ((p[k] - a[k]) as f64).powi(2)).sum::<f64>()
        };
        let b = corners.iter().copied().max_by(|&p, &q| distance(p).total_cmp(&distance(q)))?;
        let area = |p: u32| {
            Plane::through(self.at(a), self.at(b), self.at(p))
                .n
                .map(|x| (x as f64).powi(2))
                .iter()
                .sum::<f64>()
        };
        let c = corners.iter().copied().max_by(|&p, &q| area(p).total_cmp(&area(q)))?;
        (area(c) > 0.0).then_some([a, b, c])
    }

    /// Twice the signed area of all loops in the projection along `axis`. Below 2^89 for 64 corners.
    fn projected_area(&self, axis: usize) -> i128 {
        self.edges()
            .map(|[p, q]| {
                let ([pu, pv], [qu, qv]) = (self.projected(p, axis), self.projected(q, axis));
                i128::from(pu) * i128::from(qv) - i128::from(pv) * i128::from(qu)
            })
            .sum()
    }

    fn projected(&self, p: u32, axis: usize) -> [i64; 2] {
        let x = self.at(p);
        [x[(axis + 1) % 3], x[(axis + 2) % 3]]
    }

    /// No corner is used twice, and no two edges meet except at a common corner.
    /// All pairs are tested: at most 64 corners.
    fn is_simple(&self, axis: usize) -> bool {
        let mut seen: Vec<u32> = self.corners().collect();
        seen.sort_unstable();
        let distinct = seen.windows(2).all(|w| w[0] != w[1]);
        let edges: Vec<[u32; 2]> = self.edges().collect();
        distinct
            && edges
                .iter()
                .enumerate()
                .all(|(i, &e)| edges[i + 1..].iter().all(|&f| !self.edges_meet(e, f, axis)))
    }

    /// Whether loops that do not meet bound one region: the first turns as it should, and the others are holes in it,
    /// side by side. At most 64 corners.
    fn is_one_region(&self, axis: usize, positive: bool) -> bool {
        let [outer, holes @ ..] = self.loops else { return false };
        let is_hole = |i: usize| {
            let inside = |cycle: &[u32]| self.is_inside(holes[i][0], cycle, axis);
            self.turns_left(holes[i], axis) != positive
                && inside(outer)
                && (0..holes.len()).all(|j| i == j || !inside(holes[j]))
        };
        holes.is_empty() || self.turns_left(outer, axis) == positive && (0..holes.len()).all(is_hole)
    }

    /// Whether a simple loop turns counter-clockwise in the projection: as it does at its least corner.
    fn turns_left(&self, cycle: &[u32], axis: usize) -> bool {
        let order = |p, q, k| self.geometry.cmp_points(p, q, (axis + k) % 3);
        let before =
            |&i: &usize, &j: &usize| order(cycle[i], cycle[j], 1).then_with(|| order(cycle[i], cycle[j], 2));
        let n = cycle.len();
        let least = (0..n).min_by(before).expect("loops have corners");
        let [previous, next] = [cycle[(least + n - 1) % n], cycle[(least + 1) % n]];
        self.geometry.turn_to([previous, cycle[least]], next, axis) == Sign::Positive
    }

    /// Whether a point that is not on a simple loop lies inside it, in the projection: an odd number of its edges
    /// is met by the ray from the point along the first of the other two axes.
    fn is_inside(&self, p: u32, cycle: &[u32], axis: usize) -> bool {
        let is_above = |q: u32| self.geometry.cmp_points(q, p, (axis + 2) % 3).is_gt();
        let meets = |&i: &usize| {
            let [a, b] = [cycle[i], cycle[(i + 1) % cycle.len()]];
            let left = if is_above(b) { Sign::Positive } else { Sign::Negative };
            is_above(a) != is_above(b) && self.geometry.turn_to([a, b], p, axis) == left
        };
        (0..cycle.len()).filter(meets).count() % 2 == 1
    }

    /// Whether two edges share a point other than a common end.
    fn edges_meet(&self, [a, b]: [u32; 2], [c, d]: [u32; 2], axis: usize) -> bool {
        let geometry = self.geometry;
        let turn = |p, q, r| geometry.turn_to([p, q], r, axis);
        let within = |p: u32, q: u32, r: u32| {
            [(axis + 1) % 3, (axis + 2) % 3].into_iter().all(|k| {
                let (from_p, to_q) = (geometry.cmp_points(p, r, k), geometry.cmp_points(r, q, k));
                from_p.is_eq() || to_q.is_eq() || from_p == to_q
            })
        };
        let shared = [a, b].into_iter().filter(|p| [c, d].contains(p)).count();
        if shared == 1 {
            let (near, far) = if a == c || a == d { (a, b) } else { (b, a) };
            let other = if near == c { d } else { c };
            return turn(near, far, other) == Sign::Zero
                && (within(near, far, other) || within(near, other, far));
        }
        let signs = [turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)];
        let crossing =
            signs[0].times(signs[1]) != Sign::Positive && signs[2].times(signs[3]) != Sign::Positive;
        crossing
            && (signs.iter().all(|&s| s != Sign::Zero)
                || [(a, b, c), (a, b, d), (c, d, a), (c, d, b)]
                    .iter()
                    .zip(signs)
                    .any(|(&(p, q, r), s)| s == Sign::Zero && within(p, q, r)))
    }

    /// Triangles whose signed boundaries add up to the loops, in an order that does not depend on where the loops
    /// start and which way they turn.
    fn triangles(&self, axis: usize, positive: bool) -> Vec<[u32; 3]> {
        let triangles = match self.loops {
            [[a, b, c, d]] => self.quadrilateral([*a, *b, *c, *d], axis),
            _ => self.delaunay(axis, positive).unwrap_or_else(|| self.fans()),
        };
        without_opposites(triangles)
    }

    /// The diagonal from the corner of lowest number, unless the triangles of the other one alone turn the same
    /// way: the choice depends neither on where the loop starts nor on its direction.
    fn quadrilateral(&self, corners: [u32; 4], axis: usize) -> Vec<[u32; 3]> {
        let first = (0..4).min_by_key(|&i| corners[i]).expect("four corners");
        let [a, b, c, d] = std::array::from_fn(|i| corners[(first + i) % 4]);
        let turn = |p, q, r| turn(self.projected(p, axis), self.projected(q, axis), self.projected(r, axis));
        let through_a = turn(a, b, c).times(turn(a, c, d)) == Sign::Positive;
        let through_b = turn(a, b, d).times(turn(b, c, d)) == Sign::Positive;
        if through_b && !through_a { vec![[a, b, d], [b, c, d]] } else { vec![[a, b, c], [a, c, d]] }
    }

    /// Constrained Delaunay triangles in the projection, `None` when the projected loops are not simple.
    fn delaunay(&self, axis: usize, positive: bool) -> Option<Vec<[u32; 3]>> {
        let mut corners: Vec<u32> = self.corners().collect();
        corners.sort_unstable();
        corners.dedup();
        let local = |p: u32| corners.binary_search(&p).expect("a corner of this polygon");
        let vertices = corners
            .iter()
            .map(|&p| {
                let [u, v] = self.projected(p, axis);
                Point2::new(u as f64, v as f64)
            })
            .collect();
        let edges: Vec<[usize; 2]> = self.edges().map(|[p, q]| [local(p), local(q)]).collect();
        let mut conflict = false;
        let cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
            vertices,
            edges.clone(),
            |_| {
                conflict = true;
            },
        )
        .ok()?;
        if conflict || cdt.num_vertices() != corners.len() || cdt.num_constraints() != edges.len() {
            return None;
        }
        let inside = faces_inside(&cdt);
        let triangles: Vec<[u32; 3]> = cdt
            .inner_faces()
            .filter(|f| inside[f.fix().index()])
            .map(|f| {
                let [a, b, c] = f.vertices().map(|v| corners[v.fix().index()]);
                if positive { [a, b, c] } else { [a, c, b] }
            })
            .collect();
        self.is_bounded_by_loops(&triangles).then_some(triangles)
    }

    /// Each loop as a fan about its corner of lowest number: always a chain with the right boundary, wherever the
    /// loop starts and whichever way it turns.
    fn fans(&self) -> Vec<[u32; 3]> {
        let mut out = Vec::new();
        for cycle in self.loops {
            let apex = *cycle.iter().min().expect("loops have corners");
            let edges = (0..cycle.len()).map(|i| [cycle[i], cycle[(i + 1) % cycle.len()]]);
            out.extend(edges.filter(|e| !e.contains(&apex)).map(|[p, q]| [apex, p, q]));
        }
        out
    }

    fn is_bounded_by_loops(&self, triangles: &[[u32; 3]]) -> bool {
        let undirected = |[p, q]: [u32; 2]| if p < q { ([p, q], 1i32) } else { ([q, p], -1) };
        let mut sides: Vec<([u32; 2], i32)> = self.edges().map(undirected).map(|(e, s)| (e, -s)).collect();
        for &[a, b, c] in triangles {
            sides.extend([[a, b], [b, c], [c, a]].map(undirected));
        }
        sides.sort_unstable();
        sides.chunk_by(|x, y| x.0 == y.0).all(|same| same.iter().map(|s| s.1).sum::<i32>() == 0)
    }
}

/// The triangles sorted by their corners; of those with the same corners only the surplus of one orientation.
fn without_opposites(triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    let mut signed: Vec<([u32; 3], i32)> = triangles.into_iter().map(ascending).collect();
    signed.sort_unstable();
    let mut out = Vec::with_capacity(signed.len());
    for same in signed.chunk_by(|x, y| x.0 == y.0) {
        let ([a, b, c], surplus) = (same[0].0, same.iter().map(|s| s.1).sum::<i32>());
        let triangle = if surplus > 0 { [a, b, c] } else { [a, c, b] };
        out.extend((0..surplus.unsigned_abs()).map(|_| triangle));
    }
    out
}

/// The corners in ascending order, and −1 when that turns the triangle round.
fn ascending([a, b, c]: [u32; 3]) -> ([u32; 3], i32) {
    let turned = [a > b, b > c, a > c].into_iter().filter(|&x| x).count() % 2 == 1;
    let mut sorted = [a, b, c];
    sorted.sort_unstable();
    (sorted, if turned { -1 } else { 1 })
}

/// Marks the faces that an odd number of constraint edges separates from the outside.
fn faces_inside(cdt: &ConstrainedDelaunayTriangulation<Point2<f64>>) -> Vec<bool> {
    let mut depth: Vec<Option<bool>> = vec![None; cdt.num_all_faces()];
    depth[cdt.outer_face().fix().index()] = Some(false);
    let mut stack = vec![cdt.outer_face().fix()];
    while let Some(face) = stack.pop() {
        let inside = depth[face.index()].expect("faces are marked before they are stacked");
        let around: Vec<_> = match cdt.face(face).as_inner() {
            Some(inner) => inner.adjacent_edges().to_vec(),
            None => cdt.convex_hull().collect(),
        };
        for edge in around {
            // The hull's edges come with the outer face on either side, depending on the iterator.
            let other = if edge.face().fix() == face { edge.rev().face() } else { edge.face() };
            let beyond = &mut depth[other.fix().index()];
            if beyond.is_none() {
                *beyond = Some(inside != edge.is_constraint_edge());
                stack.push(other.fix());
            }
        }
    }
    depth.into_iter().map(|d| d.unwrap_or(false)).collect()
}

fn turn(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> Sign {
    let d = |p: [i64; 2], k: usize| i128::from(p[k] - a[k]);
    Sign::from(d(b, 0) * d(c, 1) - d(b, 1) * d(c, 0))
}
