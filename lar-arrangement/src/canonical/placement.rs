//! Where the corners of clusters go: onto one plane along an axis, onto the line of two, to the point of three.

use super::cluster::Cluster;
use super::{Report, carried, renumbered};
use crate::grid_points::PointTable;
use crate::kernel::{CanonicalPoints, Geometry, Plane, RationalPoint, Sign, dominant_axis};
use crate::parallel;
use crate::soup::{Placed, Soup};
use crate::vector::distance;
use rustc_hash::FxHashMap;

/// The vertices of a soup with the corners of the clusters on their planes, and the plane of each face.
pub(super) fn on_planes(
    soup: &Soup,
    clusters: &[Cluster],
    plane_of_face: Vec<Vec<Option<u32>>>,
    report: &mut Report,
) -> Placed {
    let planes: Vec<Plane> = clusters.iter().map(|c| c.plane).collect();
    report.planes = planes.len() as u64;
    let mut of_point = vec![Vec::new(); soup.geometry.n_points()];
    for (cluster, id) in clusters.iter().zip(0..) {
        cluster.corners.iter().for_each(|&p| of_point[p as usize].push((id, true)));
        cluster.touching.iter().for_each(|&p| of_point[p as usize].push((id, false)));
    }
    let at = |p: u32| soup.geometry.nearest_grid_point(p);
    let concerned = parallel::select(of_point.len(), |p| !of_point[p as usize].is_empty());
    let places = parallel::map(concerned.len(), |i| {
        let mut candidates: Vec<(u32, bool)> = of_point[concerned[i] as usize].clone();
        candidates.sort_by_key(|&(c, is_own)| {
            let cluster = &clusters[c as usize];
            (!cluster.is_settled, !is_own, std::cmp::Reverse(cluster.corners.len()), c)
        });
        placed(at(concerned[i]), &candidates, clusters)
    });
    let mut places = concerned.iter().zip(places).peekable();
    let mut placement = Placement::default();
    for p in 0..of_point.len() as u32 {
        let moved = places.next_if(|place| *place.0 == p);
        let (point, on) = moved.map_or_else(|| (RationalPoint::grid(at(p)), Vec::new()), |place| place.1);
        report.note(distance(at(p).map(|x| x as f64), point.rounded()));
        placement.push(point, on);
    }
    placement.finished(soup, planes, plane_of_face)
}

/// The clusters that matter: those that move corners, and those that share corners with them, directly or through
/// others. A settled one keeps its plane, so nothing goes on through it.
pub(super) fn registered(clusters: Vec<Cluster>, n_points: usize) -> Vec<Cluster> {
    if clusters.is_empty() {
        return clusters;
    }
    let mut of_point = vec![Vec::new(); n_points];
    for (cluster, id) in clusters.iter().zip(0usize..) {
        cluster.all_corners().for_each(|p| of_point[p as usize].push(id));
    }
    let mut is_registered: Vec<bool> =
        clusters.iter().map(|c| c.fit.deviation > 0.0 || c.moves_others).collect();
    let mut stack: Vec<usize> = (0..clusters.len()).filter(|&c| is_registered[c]).collect();
    while let Some(id) = stack.pop() {
        for p in clusters[id].all_corners() {
            for other in std::mem::take(&mut of_point[p as usize]) {
                if !std::mem::replace(&mut is_registered[other], true) && !clusters[other].is_settled {
                    stack.push(other);
                }
            }
        }
    }
    clusters.into_iter().zip(is_registered).filter(|c| c.1).map(|c| c.0).collect()
}

/// Where a point goes, and the planes it then lies on: greedily as many of the candidates as do not take it far.
fn placed(at: [i64; 3], candidates: &[(u32, bool)], clusters: &[Cluster]) -> (RationalPoint, Vec<u32>) {
    let home = at.map(|x| x as f64);
    let (mut point, mut basis) = (RationalPoint::grid(at), Vec::new());
    for &(candidate, _) in candidates {
        let cluster = &clusters[candidate as usize];
        basis.push(&cluster.plane);
        match nearest_on(at, &basis) {
            Some(moved) if distance(home, moved.rounded()) <= cluster.tolerance => point = moved,
            _ => drop(basis.pop()),
        }
    }
    let is_on = |candidate: &u32| {
        let plane = &clusters[*candidate as usize].plane;
        plane.widened::<4>().scaled_side(&point.widened()).sign() == Sign::Zero
    };
    let on = candidates.iter().map(|c| c.0).filter(is_on).collect();
    (point, on)
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
#[derive(Default)]
struct Placement {
    /// New point of each old one.
    new_id: Vec<u32>,
    points: Vec<(RationalPoint, Vec<u32>)>,
    /// New points by their rounded positions.
    at: FxHashMap<[u64; 3], Vec<u32>>,
}

impl Placement {
    fn push(&mut self, point: RationalPoint, on: Vec<u32>) {
        let same_place = self.at.entry(point.rounded().map(|x| (x + 0.0).to_bits())).or_default();
        let equal = |&id: &u32| self.points[id as usize].0.widened::<5>().equals(&point.widened());
        let id = same_place.iter().copied().find(equal).unwrap_or_else(|| {
            self.points.push((point, Vec::new()));
            same_place.push(self.points.len() as u32 - 1);
            self.points.len() as u32 - 1
        });
        let planes = &mut self.points[id as usize].1;
        planes.extend(on);
        planes.sort_unstable();
        planes.dedup();
        self.new_id.push(id);
    }

    fn finished(self, soup: &Soup, planes: Vec<Plane>, plane_of_face: Vec<Vec<Option<u32>>>) -> Placed {
        let mut canonical = CanonicalPoints { planes, ..CanonicalPoints::default() };
        let n = self.points.len();
        let (mut points, mut point_ids) = (Vec::with_capacity(n), PointTable::with_capacity(n));
        for ((point, on), id) in self.points.iter().zip(0..) {
            let nearest = point.rounded().map(|x| x.round() as i64);
            points.push(nearest);
            canonical.planes_of_point.push(on);
            if RationalPoint::grid(nearest).widened::<5>().equals(&point.widened()) {
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
