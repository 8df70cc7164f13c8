//! Where the corners of clusters go: onto one plane along an axis, onto the line of two, to the point of three.

use super::cluster::{Cluster, lists};
use super::{Report, carried, renumbered};
use crate::grid_points::PointTable;
use crate::kernel::{CanonicalPoints, Geometry, Plane, RationalPoint, Sign, dominant_axis};
use crate::parallel;
use crate::positions::firsts;
use crate::soup::{Placed, Soup};
use crate::vector::distance;
use lar_core::Cells;

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
    for (&p, place) in concerned.iter().zip(&places) {
        report.note(distance(at(p).map(|x| x as f64), place.rounded));
    }
    Placement::new(soup, &concerned, places).finished(planes, plane_of_face)
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

/// The points in their new places.
struct Placement<'a> {
    soup: &'a Soup,
    /// Those of points that clusters are at.
    places: Vec<Place>,
    /// For each point the number of its place, counted from 1, or 0: it stays on the grid.
    place_of: Vec<u32>,
}

impl<'a> Placement<'a> {
    fn new(soup: &'a Soup, concerned: &[u32], places: Vec<Place>) -> Self {
        let mut place_of = vec![0; soup.geometry.n_points()];
        concerned.iter().zip(1..).for_each(|(&p, place)| place_of[p as usize] = place);
        Self { soup, places, place_of }
    }

    fn place(&self, p: u32) -> Option<&Place> {
        self.place_of[p as usize].checked_sub(1).map(|place| &self.places[place as usize])
    }

    fn rounded(&self, p: u32) -> [f64; 3] {
        let on_grid = || self.soup.geometry.nearest_grid_point(p).map(|x| x as f64);
        self.place(p).map_or_else(on_grid, |place| place.rounded)
    }

    fn point(&self, p: u32) -> RationalPoint {
        let on_grid = || RationalPoint::grid(self.soup.geometry.nearest_grid_point(p));
        self.place(p).map_or_else(on_grid, |place| place.point)
    }

    fn are_same(&self, p: u32, q: u32) -> bool {
        self.rounded(p) == self.rounded(q) && self.point(p).widened::<5>().equals(&self.point(q).widened())
    }

    fn is_on_grid(&self, p: u32) -> bool {
        let nearest = self.nearest(p);
        let is_there = |place: &Place| {
            nearest.map(|x| x as f64) == place.rounded
                && RationalPoint::grid(nearest).widened::<5>().equals(&place.point.widened())
        };
        self.place(p).is_none_or(is_there)
    }

    fn nearest(&self, p: u32) -> [i64; 3] {
        self.rounded(p).map(|x| x.round() as i64)
    }

    /// The planes of each of some points: those that it was put on, and those of the points that are one with it.
    fn planes_of(&self, distinct: &[u32], first: &[u32]) -> Cells {
        let on = |p: u32| self.place(p).map_or(&[][..], |place| &place.on);
        let repeated = parallel::select(first.len(), |p| first[p as usize] != p);
        let of_others =
            repeated.iter().flat_map(|&p| on(p).iter().map(move |&plane| (first[p as usize], plane)));
        let mut of_others: Vec<(u32, u32)> = of_others.collect();
        of_others.sort_unstable();
        let mut rest = &of_others[..];
        let mut planes = Cells::with_capacity(distinct.len(), self.places.len());
        for &p in distinct {
            let (others, after) = rest.split_at(rest.partition_point(|other| other.0 <= p));
            rest = after;
            debug_assert!(on(p).is_sorted(), "planes are looked for by bisection");
            if others.is_empty() {
                planes.push(on(p));
            } else {
                let mut all: Vec<u32> =
                    on(p).iter().copied().chain(others.iter().map(|other| other.1)).collect();
                all.sort_unstable();
                all.dedup();
                planes.push(&all);
            }
        }
        planes
    }

    /// Equal points unified. O(n) expected.
    fn finished(self, planes: Vec<Plane>, plane_of_face: Vec<Vec<Option<u32>>>) -> Placed {
        let n_points = self.place_of.len();
        let first = firsts(n_points, |p| self.rounded(p), |p, q| self.are_same(p, q));
        let distinct = parallel::select(n_points, |p| first[p as usize] == p);
        let mut number = vec![0; n_points];
        distinct.iter().zip(0..).for_each(|(&p, id)| number[p as usize] = id);
        let new_id = parallel::map_light(n_points, |p| number[first[p] as usize]);
        let points = parallel::map_light(distinct.len(), |id| self.nearest(distinct[id]));
        let on_grid = parallel::map_light(distinct.len(), |id| self.is_on_grid(distinct[id]));
        let rational = parallel::select(distinct.len(), |id| !on_grid[id as usize]);
        let mut entry = vec![0; distinct.len()];
        rational.iter().zip(1..).for_each(|(&id, number)| entry[id as usize] = number);
        let mut point_ids = PointTable::with_capacity(distinct.len() - rational.len());
        for id in (0..distinct.len() as u32).filter(|&id| on_grid[id as usize]) {
            point_ids.insert(points[id as usize], id, |id| points[id as usize]);
        }
        let canonical = CanonicalPoints {
            entry,
            rational: parallel::map_light(rational.len(), |i| self.point(distinct[rational[i] as usize])),
            positions: parallel::map_light(rational.len(), |i| self.rounded(distinct[rational[i] as usize])),
            planes,
            planes_of_point: self.planes_of(&distinct, &first),
        };
        Placed {
            grid: self.soup.grid,
            geometry: Geometry::canonical(points, canonical),
            point_ids,
            point_of: renumbered(&self.soup.point_of, &new_id),
            tolerances: carried(&self.soup.tolerances, &new_id),
            plane_of_face,
            order: self.soup.order.clone(),
        }
    }
}
