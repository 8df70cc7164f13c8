//! Where the corners of clusters go: onto one plane along an axis, onto the line of two, to the point of three.

use super::cluster::{Cluster, lists};
use super::{Report, carried, renumbered};
use crate::grid_points::PointTable;
use crate::kernel::{CanonicalPoints, Geometry, Plane, RationalPoint, Sign, dominant_axis};
use crate::parallel;
use crate::soup::{Placed, Soup};
use crate::vector::distance;
use lar_core::Cells;
use rustc_hash::{FxBuildHasher, FxHashMap};

/// The vertices of a soup with the corners of the clusters on their planes, and the plane of each face.
pub(super) fn on_planes(
    soup: &Soup,
    clusters: &[Cluster],
    plane_of_face: Vec<Vec<Option<u32>>>,
    report: &mut Report,
) -> Placed {
    let planes: Vec<Plane> = clusters.iter().map(|c| c.plane).collect();
    report.planes = planes.len() as u64;
    let n_points = soup.geometry.n_points();
    let of_point = clusters_at_points(clusters, n_points);
    let at = |p: u32| soup.geometry.nearest_grid_point(p);
    let concerned = parallel::select(n_points, |p| !of_point[p as usize].is_empty());
    let places = parallel::map(concerned.len(), |i| {
        let p = concerned[i];
        let is_own = |c: u32| clusters[c as usize].corners.binary_search(&p).is_ok();
        let mut candidates: Vec<(u32, bool)> = of_point[p as usize].iter().map(|&c| (c, is_own(c))).collect();
        candidates.sort_by_key(|&(c, is_own)| {
            let cluster = &clusters[c as usize];
            (!cluster.is_settled, !is_own, std::cmp::Reverse(cluster.corners.len()), c)
        });
        placed(at(p), &candidates, clusters)
    });
    let mut places = concerned.iter().zip(places).peekable();
    let mut placement = Placement::of(n_points);
    for p in 0..n_points as u32 {
        let moved = places.next_if(|place| *place.0 == p);
        let place = moved.map_or_else(|| Place::grid(at(p)), |place| place.1);
        report.note(distance(at(p).map(|x| x as f64), place.rounded));
        placement.push(place);
    }
    placement.finished(soup, planes, plane_of_face)
}

/// The clusters that matter: those that move corners, and those that share corners with them, directly or through
/// others. A settled one keeps its plane, so nothing goes on through it.
pub(super) fn registered(clusters: Vec<Cluster>, n_points: usize) -> Vec<Cluster> {
    if clusters.is_empty() {
        return clusters;
    }
    let of_point = clusters_at_points(&clusters, n_points);
    let mut is_passed = vec![false; n_points];
    let mut is_registered: Vec<bool> =
        clusters.iter().map(|c| c.fit.deviation > 0.0 || c.moves_others).collect();
    let mut stack: Vec<usize> = (0..clusters.len()).filter(|&c| is_registered[c]).collect();
    while let Some(id) = stack.pop() {
        for p in clusters[id].all_corners() {
            if std::mem::replace(&mut is_passed[p as usize], true) {
                continue;
            }
            for other in of_point[p as usize].iter().map(|&c| c as usize) {
                if !std::mem::replace(&mut is_registered[other], true) && !clusters[other].is_settled {
                    stack.push(other);
                }
            }
        }
    }
    clusters.into_iter().zip(is_registered).filter(|c| c.1).map(|c| c.0).collect()
}

/// The clusters with each point among their corners or those that touch them.
fn clusters_at_points(clusters: &[Cluster], n_points: usize) -> Cells {
    let entries =
        clusters.iter().zip(0..).flat_map(|(cluster, id)| cluster.all_corners().map(move |p| (p, id)));
    lists(n_points, entries)
}

/// A place of a point.
struct Place {
    point: RationalPoint,
    rounded: [f64; 3],
    /// The planes it lies on, ascending.
    on: Vec<u32>,
}

impl Place {
    fn grid(at: [i64; 3]) -> Self {
        Self { point: RationalPoint::grid(at), rounded: at.map(|x| x as f64), on: Vec::new() }
    }
}

/// Where a point goes, and the planes it then lies on: greedily as many of the candidates as do not take it far.
fn placed(at: [i64; 3], candidates: &[(u32, bool)], clusters: &[Cluster]) -> Place {
    let mut place = Place::grid(at);
    let (home, mut basis) = (place.rounded, Vec::new());
    for &(candidate, _) in candidates {
        let cluster = &clusters[candidate as usize];
        basis.push(&cluster.plane);
        let moved = nearest_on(at, &basis).map(|point| (point, point.rounded()));
        match moved.filter(|&(_, rounded)| distance(home, rounded) <= cluster.tolerance) {
            Some((point, rounded)) => (place.point, place.rounded) = (point, rounded),
            None => drop(basis.pop()),
        }
    }
    let is_on = |candidate: &u32| {
        let plane = &clusters[*candidate as usize].plane;
        plane.widened::<4>().scaled_side(&place.point.widened()).sign() == Sign::Zero
    };
    place.on = candidates.iter().map(|c| c.0).filter(is_on).collect();
    place.on.sort_unstable();
    place
}

/// The point on one, two or three planes that has the other coordinates of a grid point; `None` when their normals
/// depend on each other.
fn nearest_on(at: [i64; 3], planes: &[&Plane]) -> Option<RationalPoint> {
    let coordinate =
        |k: usize| Plane { n: std::array::from_fn(|j| i128::from(j == k)), d: i128::from(at[k]) };

    let three = match *planes {
        [p] => {
            let axis = dominant_axis(p.n);
            [*p, coordinate((axis + 1) % 3), coordinate((axis + 2) % 3)]
        }
        [p, q] => {
            let minor = |u: usize, v: usize| p.n[u] * q.n[v] - p.n[v] * q.n[u];
            [*p, *q, coordinate(dominant_axis([minor(1, 2), minor(2, 0), minor(0, 1)]))]
        }
        [p, q, r] => [*p, *q, *r],
        _ => return None,
    };
    let [a, b, c] = three.map(|plane| plane.widened());
    RationalPoint::on_planes([&a, &b, &c])
}

/// The points in their new places, equal ones unified.
struct Placement {
    /// New point of each old one.
    new_id: Vec<u32>,
    places: Vec<Place>,
    /// The last new point with a rounded position, and the one before each; itself when there is none.
    last_at: FxHashMap<[u64; 3], u32>,
    before: Vec<u32>,
}

impl Placement {
    /// Room for so many points.
    fn of(n: usize) -> Self {
        Self {
            new_id: Vec::with_capacity(n),
            places: Vec::with_capacity(n),
            last_at: FxHashMap::with_capacity_and_hasher(n, FxBuildHasher),
            before: Vec::with_capacity(n),
        }
    }

    fn push(&mut self, place: Place) {
        let new = self.places.len() as u32;
        let last = self.last_at.entry(place.rounded.map(|x| (x + 0.0).to_bits())).or_insert(new);
        let mut id = *last;
        while id != new && !self.places[id as usize].point.widened::<5>().equals(&place.point.widened()) {
            let before = self.before[id as usize];
            id = if before == id { new } else { before };
        }
        if id == new {
            self.before.push(std::mem::replace(last, new));
            self.places.push(place);
        } else {
            let planes = &mut self.places[id as usize].on;
            planes.extend(place.on);
            planes.sort_unstable();
            planes.dedup();
        }
        self.new_id.push(id);
    }

    fn finished(self, soup: &Soup, planes: Vec<Plane>, plane_of_face: Vec<Vec<Option<u32>>>) -> Placed {
        let mut canonical = CanonicalPoints { planes, ..CanonicalPoints::default() };
        let n = self.places.len();
        let (mut points, mut point_ids) = (Vec::with_capacity(n), PointTable::with_capacity(n));
        for (Place { point, rounded, on }, id) in self.places.iter().zip(0..) {
            let nearest = rounded.map(|x| x.round() as i64);
            points.push(nearest);
            debug_assert!(on.is_sorted(), "planes are looked for by bisection");
            canonical.planes_of_point.push(on);
            if nearest.map(|x| x as f64) == *rounded
                && RationalPoint::grid(nearest).widened::<5>().equals(&point.widened())
            {
                point_ids.insert(nearest, id, |id| points[id as usize]);
                canonical.entry.push(0);
            } else {
                canonical.rational.push(*point);
                canonical.entry.push(canonical.rational.len() as u32);
            }
        }
        Placed {
            grid: soup.grid,
            geometry: Geometry::canonical(points, canonical),
            point_ids,
            point_of: renumbered(&soup.point_of, &self.new_id),
            tolerances: carried(&soup.tolerances, &self.new_id),
            plane_of_face,
        }
    }
}
