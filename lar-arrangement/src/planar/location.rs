//! Point location: which vertex, edge or face of a planar arrangement a point lies in.
//!
//! A tree of the edges' boxes is searched from the point leftwards, the boxes that reach farthest right first,
//! until what is left cannot be nearer than the nearest edge found. Answers are exact for the arrangement as it is
//! *defined*: input points on the grid, crossings as the fractions that they are. Rounded positions only decide
//! where they differ, as rounding keeps order.

use crate::boxes::{Aabb, BoxTree};
use crate::kernel::Int;
use crate::parallel;
use crate::planar::along::long_axis;
use crate::planar::carriers::cross;
use crate::planar::faces::{exact_vertex, side_of_carrier};
use crate::planar::query::Query;
use crate::planar::result::PlanarArrangement;
use lar_core::{EdgeId, FaceId, VertexId};
use std::cmp::Ordering;

/// Where a point lies. Faces and edges are open: without the vertices and edges that bound them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Location {
    /// It is a vertex.
    Vertex(VertexId),
    /// It lies on an edge, between its ends.
    Edge(EdgeId),
    /// It lies inside a face; face 0 is the exterior.
    Face(FaceId),
}

/// What point location needs beside the arrangement.
#[derive(Debug)]
pub(super) struct LocationIndex {
    /// Over the rounded boxes of the edges, in local coordinates.
    tree: BoxTree<2>,
    /// Box of everything.
    bounds: Aabb<2>,
    local: Local,
    /// Ends of each edge in the direction of its carrier.
    ends: Vec<[u32; 2]>,
    /// The faces on the right and on the left of each edge, from its smaller vertex to the larger.
    faces: Vec<[u32; 2]>,
    /// Vertices without edges, by rounded position.
    isolated: Vec<u32>,
}

/// Locates points in an arrangement.
#[derive(Clone, Copy, Debug)]
pub struct Locator<'a> {
    arrangement: &'a PlanarArrangement,
    index: &'a LocationIndex,
}

impl PlanarArrangement {
    /// The index for point location; it is built once, in O(n log n), and kept.
    #[must_use]
    pub fn locator(&self) -> Locator<'_> {
        let index = self.index.get_or_init(|| LocationIndex::new(self));
        Locator { arrangement: self, index }
    }

    /// Where a point lies: [`Locator::locate`].
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, Location, planar_arrangement};
    /// use lar_core::{FaceId, Points};
    /// let mut drawing = Drawing::new(Points::new(2));
    /// drawing.push_polygon("A", &[vec![[0., 0.], [2., 0.], [2., 2.], [0., 2.]]]);
    /// let a = planar_arrangement(&drawing)?;
    /// assert_eq!(a.locate([0.1, 0.1]), Location::Face(FaceId(1)));
    /// assert_eq!(a.locate([-1.0, 1.0]), Location::Face(FaceId(0)));
    /// assert!(matches!(a.locate([2.0, 0.3]), Location::Edge(_)));
    /// assert!(matches!(a.locate([2.0, 2.0]), Location::Vertex(_)));
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    #[must_use]
    pub fn locate(&self, point: [f64; 2]) -> Location {
        self.locator().locate(point)
    }

    fn end_positions(&self, [a, b]: [u32; 2]) -> [&[f64]; 2] {
        let points = self.complex().points();
        [points.point(a as usize), points.point(b as usize)]
    }

    fn exact(&self, vertex: u32) -> ([Int<3>; 2], i128) {
        exact_vertex(&self.carriers, self.sources[vertex as usize].into())
    }

    /// Order of two vertices along an axis.
    fn cmp_vertices(&self, a: u32, b: u32, axis: usize) -> Ordering {
        let [p, q] = self.end_positions([a, b]).map(|p| p[axis]);
        if p != q {
            return p.total_cmp(&q);
        }
        let ((p, v), (q, w)) = (self.exact(a), self.exact(b));
        (p[axis].resize::<4>() * Int::from(w)).cmp(&(q[axis].resize::<4>() * Int::from(v)))
    }
}

/// Coordinates in which everything is near 0 and about as large as 1: the tree's boxes have 32 bits. The order of
/// coordinates along an axis is kept.
#[derive(Clone, Copy, Debug)]
struct Local {
    /// Half of the least coordinates.
    origin: [f64; 2],
    scale: f64,
}

impl Local {
    fn of(bounds: &Aabb<2>) -> Self {
        let origin = bounds.lo.map(|x| x / 2.0);
        let extent = (0..2).map(|k| bounds.hi[k] / 2.0 - origin[k]).fold(f64::MIN_POSITIVE, f64::max);
        Self { origin, scale: 2f64.powi(-(extent.log2().floor() as i32)) }
    }

    fn along(&self, axis: usize, x: f64) -> f64 {
        (x / 2.0 - self.origin[axis]) * self.scale
    }

    fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.along(0, x), self.along(1, y)]
    }
}

impl LocationIndex {
    fn new(a: &PlanarArrangement) -> Self {
        let along_carrier = |(edge, e): (usize, [u32; 2])| {
            let direction = a.carriers.direction(a.carrier_of[edge]);
            let axis = long_axis(direction);
            let rises = a.cmp_vertices(e[0], e[1], axis).is_lt();
            if rises == (direction[axis] > 0) { e } else { [e[1], e[0]] }
        };
        let ends: Vec<[u32; 2]> = a.edges().into_iter().enumerate().map(along_carrier).collect();
        let flat = |p: &[f64]| [p[0], p[1]];
        let points = a.complex().points();
        let bounds = Aabb::around(points.iter().map(flat));
        let local = Local::of(&bounds);
        let box_of = |&ends| Aabb::around(a.end_positions(ends).map(|p| local.point(flat(p))));
        let boxes: Vec<Aabb<2>> = ends.iter().map(box_of).collect();
        let mut has_edge = vec![false; a.n_vertices()];
        ends.as_flattened().iter().for_each(|&v| has_edge[v as usize] = true);
        let mut isolated: Vec<u32> = (0..a.n_vertices() as u32).filter(|&v| !has_edge[v as usize]).collect();
        isolated.sort_by(|&v, &w| cmp_points(points.point(v as usize), points.point(w as usize)));
        Self { tree: BoxTree::new(&boxes), bounds, local, ends, faces: a.faces_of_edges(), isolated }
    }
}

fn cmp_points(p: &[f64], q: &[f64]) -> Ordering {
    p.partial_cmp(q).expect("positions are numbers")
}

impl Locator<'_> {
    /// Where a point lies, exactly: relative to the input as it was snapped to the grid (which keeps coordinates
    /// with few enough bits) and to crossings as fractions, not to their rounded positions. So a rounded position
    /// of a crossing need not be located at its vertex. What is infinite, or not a number, is in the exterior.
    ///
    /// Expected O(log n) where boxes of edges overlap little; at worst linear in the edges to the left of the point.
    #[must_use]
    pub fn locate(&self, point: [f64; 2]) -> Location {
        let Aabb { lo, hi } = self.index.bounds;
        if (0..2).all(|k| lo[k] <= point[k] && point[k] <= hi[k]) {
            self.search(&Query::new(point, &self.arrangement.grid))
        } else {
            Location::Face(FaceId(0))
        }
    }

    /// Where many points lie, in parallel (with the feature `rayon`), in their order.
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, Location, planar_arrangement};
    /// let triangle = [[0., 0., 4., 0.], [4., 0., 0., 4.], [0., 4., 0., 0.]];
    /// let a = planar_arrangement(&Drawing::from_segments(&triangle))?;
    /// let found = a.locator().locate_all(&[[1., 1.], [2., 2.], [3., 3.]]);
    /// assert!(matches!(found[..], [Location::Face(_), Location::Edge(_), Location::Face(lar_core::FaceId(0))]));
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    #[must_use]
    pub fn locate_all(&self, points: &[[f64; 2]]) -> Vec<Location> {
        let (n_chunks, range) = parallel::chunks(points.len(), 256);
        let chunk = |i| points[range(i)].iter().map(|&p| self.locate(p)).collect::<Vec<_>>();
        parallel::map(n_chunks, chunk).concat()
    }

    /// Where a grid point lies.
    pub(super) fn locate_on_grid(&self, point: [i64; 2]) -> Location {
        self.search(&Query::on_grid(point, &self.arrangement.grid))
    }

    /// Rounded position of a grid point.
    pub(super) fn rounded(&self, point: [i64; 2]) -> [f64; 2] {
        Query::on_grid(point, &self.arrangement.grid).point
    }

    fn search(&self, query: &Query) -> Location {
        if let Some(vertex) = self.isolated_at(query) {
            return Location::Vertex(VertexId(vertex));
        }
        let local = &self.index.local;
        let [x, y] = local.point(query.point);
        let beam = Aabb { lo: [f64::NEG_INFINITY, y], hi: [x, y] };
        let (mut hit, mut nearest) = (None, None);
        self.index.tree.query_leftwards(&beam, f64::NEG_INFINITY, |edge, bound| {
            match self.place(query, edge) {
                Place::On(location) => {
                    hit = Some(location);
                    f64::INFINITY
                }
                Place::Left if nearest.is_none_or(|best| self.is_right_of(edge, best)) => {
                    nearest = Some(edge);
                    bound.max(local.along(0, self.reach(edge, query.point[1])))
                }
                Place::Left | Place::Elsewhere => bound,
            }
        });
        hit.unwrap_or_else(|| Location::Face(FaceId(nearest.map_or(0, |edge| self.face_right_of(edge)))))
    }

    fn isolated_at(&self, query: &Query) -> Option<u32> {
        let points = self.arrangement.complex().points();
        let order = |&v: &u32| cmp_points(points.point(v as usize), &query.point);
        let isolated = &self.index.isolated;
        let first = isolated.partition_point(|v| order(v).is_lt());
        let same = isolated[first..].iter().take_while(|v| order(v).is_eq());
        same.copied().find(|&v| (0..2).all(|axis| self.cmp(query, v, axis).is_eq()))
    }

    /// Order of the query and a vertex along an axis.
    fn cmp(&self, query: &Query, vertex: u32, axis: usize) -> Ordering {
        let at = self.arrangement.complex().points().point(vertex as usize)[axis];
        if query.point[axis] < at {
            Ordering::Less
        } else if query.point[axis] > at {
            Ordering::Greater
        } else {
            query.cmp_exactly(self.arrangement.exact(vertex), axis)
        }
    }

    fn direction(&self, edge: u32) -> [i64; 2] {
        self.arrangement.carriers.direction(self.arrangement.carrier_of[edge as usize])
    }

    /// Ends of an edge that is not horizontal, the lower first.
    fn upwards(&self, edge: u32) -> [u32; 2] {
        let [a, b] = self.index.ends[edge as usize];
        if self.direction(edge)[1] > 0 { [a, b] } else { [b, a] }
    }

    /// Where an edge is, seen from the query: an edge is left of it when it crosses the horizontal line an
    /// infinitesimal above it there.
    fn place(&self, query: &Query, edge: u32) -> Place {
        let direction = self.direction(edge);
        let axis = usize::from(direction[1] != 0);
        let [low, high] = if axis == 1 { self.upwards(edge) } else { self.index.ends[edge as usize] };
        let (from_low, from_high) = (self.cmp(query, low, axis), self.cmp(query, high, axis));
        if from_low.is_lt() || from_high.is_gt() {
            return Place::Elsewhere;
        }
        let carrier = self.arrangement.carrier_of[edge as usize];
        let side = query.side_of(&self.arrangement.carriers, carrier);
        match (side, axis) {
            (Ordering::Equal, _) if from_low.is_eq() => Place::On(Location::Vertex(VertexId(low))),
            (Ordering::Equal, _) if from_high.is_eq() => Place::On(Location::Vertex(VertexId(high))),
            (Ordering::Equal, _) => Place::On(Location::Edge(EdgeId(edge))),
            (side, 1) if from_high.is_lt() && side.is_lt() == (direction[1] > 0) => Place::Left,
            _ => Place::Elsewhere,
        }
    }

    /// Whether an edge is right of another one on the line that crosses both. They do not cross each other, so the
    /// higher one of their lower ends tells; when both are one vertex, the directions do.
    fn is_right_of(&self, edge: u32, other: u32) -> bool {
        let a = self.arrangement;
        let (low, other_low) = (self.upwards(edge)[0], self.upwards(other)[0]);
        let up = |edge: u32| {
            let d = self.direction(edge);
            if d[1] > 0 { d } else { [-d[0], -d[1]] }
        };
        if low == other_low {
            return cross(up(other), up(edge)) < 0;
        }
        let side = |edge: u32, vertex: u32| {
            let side = side_of_carrier(&a.carriers, a.carrier_of[edge as usize], a.exact(vertex));
            if self.direction(edge)[1] > 0 { side } else { side.reverse() }
        };
        if a.cmp_vertices(low, other_low, 1).is_ge() {
            side(other, low).is_lt()
        } else {
            side(edge, other_low).is_gt()
        }
    }

    /// A number that the edge's crossing of the horizontal line at y is not left of.
    ///
    /// Ends are off by 2^-53 of their size and so are sums: t by 4 · 2^-53 · |y| / height, the product by that times
    /// the width, and by 4 · 2^-53 · |x| from the rest; the bounds are twice that.
    fn reach(&self, edge: u32, y: f64) -> f64 {
        let [low, high] = self.arrangement.end_positions(self.upwards(edge));
        let size = |k: usize| low[k].abs().max(high[k].abs());
        let t = (y - low[1]) / (high[1] - low[1]);
        let width = high[0] - low[0];
        let error = 4.0 * f64::EPSILON * (size(0) + width.abs() * size(1) / (high[1] - low[1]) + width.abs());
        // Not a number when the ends round to one height: then the box tells.
        (low[0] + t * width - error).max(low[0].min(high[0]))
    }

    /// The face on the right of an edge, seen upwards.
    fn face_right_of(&self, edge: u32) -> u32 {
        let [low, high] = self.upwards(edge);
        self.index.faces[edge as usize][usize::from(low > high)]
    }
}

/// Where an edge is relative to a query.
enum Place {
    On(Location),
    Left,
    Elsewhere,
}
