//! Constrained Delaunay triangulation through spade, with every case excluded in which it could panic, loop or
//! depend on the order of a hash table.
//!
//! | what would go wrong | why it cannot happen |
//! |---|---|
//! | coordinates out of range, NaN | the caller scales by a power of two and replaces what is not finite |
//! | a duplicate point replaces its twin | points are checked to be distinct |
//! | points on one line are sorted again at each insertion | the first three inserted are not collinear |
//! | bulk loading: rounded angles of the hull, points skipped into a hash set | points are inserted one by one, which uses exact predicates only |
//! | a constraint crosses another, or a point lies on it | the constraint is walked first |
//!
//! Points are inserted in rounds, each of as many as all before it, drawn by a fixed generator and put along a Hilbert curve (Amenta,
//! Choi, Rote, "Incremental constructions con BRIO", 2003): each is looked for from the one before it, which is near and in the caches.
//! O(n log n) expected.

use crate::predicates::{Xy, orient};
use crate::steps::step;
use spade::handles::{FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{
    ConstrainedDelaunayTriangulation, Intersection, LastUsedVertexHintGenerator, LineIntersectionIterator,
    Point2, Triangulation as _,
};

/// The flag of an edge tells whether crossing it goes from inside to outside.
type Plane = ConstrainedDelaunayTriangulation<Point2<f64>, (), Wall, (), LastUsedVertexHintGenerator>;

#[derive(Clone, Copy, Debug, Default)]
struct Wall(bool);

/// A Delaunay triangulation of distinct points that takes constraints.
pub(crate) struct Cdt {
    plane: Plane,
    /// Caller's index of each vertex, and back.
    outside: Vec<u32>,
    handles: Vec<Option<FixedVertexHandle>>,
}

impl Cdt {
    /// The Delaunay triangulation of the points `used` of `xy`; `None` when two of them coincide or all are
    /// collinear.
    pub(crate) fn new(xy: &[Xy], mut used: Vec<u32>) -> Option<Self> {
        let at = |i: u32| xy[i as usize];
        used.sort_unstable_by(|&i, &j| {
            at(i)[0].total_cmp(&at(j)[0]).then(at(i)[1].total_cmp(&at(j)[1])).then(i.cmp(&j))
        });
        if used.windows(2).any(|w| at(w[0]) == at(w[1])) {
            return None;
        }
        put_in_rounds(xy, &mut used);
        let (&a, &b) = (used.first()?, used.get(1)?);
        let third = used.iter().position(|&c| orient(at(a), at(b), at(c)) != 0.0)?;
        used.swap(2, third);
        let mut plane = Plane::new();
        let mut handles = vec![None; xy.len()];
        for &i in &used {
            let handle = plane.insert(Point2::new(at(i)[0], at(i)[1])).ok()?;
            handles[i as usize] = Some(handle);
        }
        (plane.num_vertices() == used.len()).then_some(Self { plane, outside: used, handles })
    }

    /// Adds an edge as a wall; adding it again takes the wall away and leaves the edge. `None`, and nothing added, when
    /// it crosses another wall or passes through a point.
    pub(crate) fn add_wall(&mut self, from: u32, to: u32) -> Option<()> {
        let (from, to) = (self.handles[from as usize]?, self.handles[to as usize]?);
        if from == to || !self.is_free(from, to) {
            return None;
        }
        let added = self.plane.try_add_constraint(from, to);
        for edge in &added {
            let wall = self.plane.undirected_edge_data_mut(edge.as_undirected()).data_mut();
            wall.0 = !wall.0;
        }
        (added.len() == 1).then_some(())
    }

    fn is_free(&self, from: FixedVertexHandle, to: FixedVertexHandle) -> bool {
        let met = LineIntersectionIterator::new_from_handles(&self.plane, from, to);
        met.inspect(|_| step()).all(|met| match met {
            Intersection::EdgeIntersection(edge) => !edge.is_constraint_edge(),
            Intersection::VertexIntersection(v) => v.fix() == from || v.fix() == to,
            Intersection::EdgeOverlap(edge) => edge.from().fix() == from && edge.to().fix() == to,
        })
    }

    /// All triangles.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.plane.inner_faces().map(|face| self.vertices(face.fix()))
    }

    /// The triangles that are separated from the outside by an odd number of walls.
    pub(crate) fn inner_triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let inside = self.flood();
        self.plane
            .inner_faces()
            .filter(move |face| inside[face.index()] == Some(true))
            .map(|face| self.vertices(face.fix()))
    }

    /// For each face (0 is the outer one), the parity of the walls between it and the outside.
    fn flood(&self) -> Vec<Option<bool>> {
        let mut inside = vec![None; self.plane.num_all_faces()];
        inside[self.plane.outer_face().index()] = Some(false);
        let mut stack: Vec<_> = self.plane.convex_hull().map(|edge| (edge, false)).collect();
        while let Some((edge, parity)) = stack.pop() {
            // `parity` is that of the face left of the edge; the one to its right comes next.
            let across = edge.rev();
            let parity = parity ^ edge.as_undirected().data().data().0;
            let face = across.face();
            if inside[face.index()].is_none() {
                inside[face.index()] = Some(parity);
                stack.push((across.next(), parity));
                stack.push((across.prev(), parity));
            }
        }
        inside
    }

    fn vertices(&self, face: FixedFaceHandle<InnerTag>) -> [u32; 3] {
        self.plane.face(face).vertices().map(|v| self.outside[v.index()])
    }
}

/// Fewer points are no round of their own: they are near each other anyway. Not tuned.
const LEAST_ROUND: usize = 64;

/// Puts distinct points, given by x and then y, in the order in which they are inserted. O(n log n).
fn put_in_rounds(xy: &[Xy], used: &mut [u32]) {
    let along = along_curve(xy, used);
    shuffle(used);
    let mut rest = used;
    while rest.len() > LEAST_ROUND {
        let (before, round) = rest.split_at_mut(rest.len() / 2);
        round.sort_unstable_by_key(|&i| along[i as usize]);
        rest = before;
    }
}

/// How far along a Hilbert curve each point is, given by x and then y. Its place is how many points lie before it in x, and how many in y:
/// points that crowd together are as far apart as others.
fn along_curve(xy: &[Xy], by_x: &[u32]) -> Vec<u64> {
    let mut by_y = by_x.to_vec();
    by_y.sort_by(|&i, &j| xy[i as usize][1].total_cmp(&xy[j as usize][1]));
    let mut places = vec![[0u32; 2]; xy.len()];
    for (order, axis) in [(by_x, 0), (&by_y, 1)] {
        order.iter().zip(0..).for_each(|(&i, place)| places[i as usize][axis] = place);
    }
    let bits = u32::BITS - (by_x.len() as u32).leading_zeros();
    places.into_iter().map(|place| hilbert(place, bits)).collect()
}

/// How far along a Hilbert curve a cell is of a square of 2^bits × 2^bits.
fn hilbert([mut x, mut y]: [u32; 2], bits: u32) -> u64 {
    let mut along = 0;
    for bit in (0..bits).rev() {
        let [right, upper] = [x, y].map(|c| u64::from(c >> bit & 1));
        along = along << 2 | ((3 * right) ^ upper);
        if upper == 0 {
            if right == 1 {
                (x, y) = (!x, !y);
            }
            (x, y) = (y, x);
        }
    }
    along
}

/// Mixes a list by a fixed sequence (Fisher–Yates over a xorshift generator), the same on every run.
fn shuffle(list: &mut [u32]) {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    for i in (1..list.len()).rev() {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        list.swap(i, (state % (i as u64 + 1)) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_the_square() {
        let mut cells: Vec<[u32; 2]> = (0..8).flat_map(|x| (0..8).map(move |y| [x, y])).collect();
        cells.sort_by_key(|&cell| hilbert(cell, 3));
        for w in cells.windows(2) {
            let apart: u32 = (0..2).map(|k| w[0][k].abs_diff(w[1][k])).sum();
            assert_eq!(apart, 1, "{w:?}");
        }
    }

    #[test]
    fn rounds_have_all_points_once() {
        for n in [0, 1, 2, 63, 64, 65, 1000] {
            let xy: Vec<Xy> = (0..n).map(|i| [f64::from(i / 37), f64::from(i % 37)]).collect();
            let mut used: Vec<u32> = (0..n as u32).collect();
            put_in_rounds(&xy, &mut used);
            used.sort_unstable();
            assert!(used.into_iter().eq(0..n as u32));
        }
    }

    #[test]
    fn points_that_crowd_together_are_apart_on_the_curve() {
        // On an arc, mixed, so small that beside the last point all of it is one place.
        let n = 5000u32;
        let at = |i: u32| {
            let t = f64::from(i * 7919 % n) / f64::from(n);
            [1e-12 * t, 1e-12 * t * t]
        };
        let xy: Vec<Xy> = (0..n).map(at).chain([[1.0, 0.5]]).collect();
        let mut by_x: Vec<u32> = (0..=n).collect();
        by_x.sort_by(|&i, &j| xy[i as usize][0].total_cmp(&xy[j as usize][0]));
        let mut along = along_curve(&xy, &by_x);
        along.sort_unstable();
        assert!(along.windows(2).all(|w| w[0] < w[1]));
    }
}
