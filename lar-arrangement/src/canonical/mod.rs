//! Stage 1c: facets that were meant to lie in one plane are put there.
//!
//! Coordinates are rounded, so two boxes stacked inside one rotated frame miss each other by a grid step, and the
//! corners of a rotated square span two planes. Facets that meet and whose corners lie within the tolerance of one
//! plane form a *cluster*. It gets one plane with coefficients of 41 bits, and its corners are put on it: along an
//! axis when they belong to one cluster, on the line of two, on the point of three. Such corners are rational. A corner
//! on more planes keeps those that it was put on; the facets that then do not pass through it are left with planes of
//! their own.
//!
//! A scene whose clusters are exactly planar on the grid stays as it is.

mod cluster;
mod fit;
mod near;
mod placement;
mod scan;

use crate::charts::Charts;
use crate::grid_points::PointTable;
use crate::half_edges::MANY;
use crate::kernel::Geometry;
use crate::parallel;
use crate::soup::{Placed, Soup};
use crate::stars::Stars;
use crate::vector::distance;
pub(crate) use scan::Scan;

/// How far, in grid steps, coordinates may lie from what was meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(crate) struct Tolerance {
    /// Error of a coordinate: half a step, or half a unit of the source's last digit.
    error: f64,
}

/// Coordinates that are off by more than this many grid steps, 2^-16 of the model's extent, are taken as they are:
/// what was meant to be equal cannot be told from what was meant to be small.
const LARGEST_ERROR: f64 = (1 << 24) as f64;

impl Tolerance {
    /// For coordinates that are off by up to so many grid steps.
    pub(crate) fn new(error: f64) -> Self {
        Self { error: if error > LARGEST_ERROR { 0.5 } else { error } }
    }

    pub(crate) fn max(self, other: Self) -> Self {
        Self { error: self.error.max(other.error) }
    }

    /// The largest of all points.
    pub(crate) fn largest(tolerances: &[Self]) -> Self {
        const LANES: usize = 4;
        let (n_chunks, range) = parallel::chunks(tolerances.len(), parallel::LIGHT_CHUNK);
        let of_chunks = parallel::map(n_chunks, |chunk| {
            // Several at a time: one after the other, each comparison would wait for the one before.
            let (several, rest) = tolerances[range(chunk)].as_chunks::<LANES>();
            let largest = several.iter().fold([Self::default(); LANES], |largest, several| {
                std::array::from_fn(|lane| largest[lane].max(several[lane]))
            });
            largest.iter().chain(rest).copied().fold(Self::default(), Self::max)
        });
        of_chunks.into_iter().fold(Self::default(), Self::max)
    }

    /// The largest of some points.
    pub(crate) fn of(tolerances: &[Self], points: impl Iterator<Item = u32>) -> Self {
        points.fold(Self::default(), |max, p| max.max(tolerances[p as usize]))
    }

    /// Two points that were one differ by two errors in a coordinate.
    pub(crate) fn points(self) -> f64 {
        3.0 * self.error
    }

    /// A corner lies √3 errors from its plane at most, and so do the three corners that the plane is guessed from.
    pub(crate) fn planes(self) -> f64 {
        8.0 * self.error
    }

    /// Corners of one polygon that was meant to be planar lie so near to the plane of three of them.
    pub(crate) fn flatness(self) -> f64 {
        4.0 * self.planes()
    }
}

/// What became of the input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Report {
    /// Planes that facets were put on.
    pub planes: u64,
    /// Points that moved.
    pub moved: u64,
    /// The farthest that a point moved, in grid steps.
    pub farthest: f64,
}

impl Report {
    fn note(&mut self, distance: f64) {
        if distance > 0.0 {
            self.moved += 1;
            self.farthest = self.farthest.max(distance);
        }
    }
}

/// Facets of a soup, and the pairs of them whose boxes meet but for those that a chart or a clean point settles.
pub(crate) struct Input<'a> {
    pub soup: &'a Soup,
    pub pairs: &'a [[u32; 2]],
    pub charts: &'a Charts,
    pub stars: &'a Stars,
}

impl Input<'_> {
    fn tolerance(&self, facet: u32) -> Tolerance {
        Tolerance::of(&self.soup.tolerances, self.corners(facet))
    }

    /// The two facets at an edge that are not among the pairs: those of one chart, or at a clean end of the edge.
    fn neighbours_at(&self, edge: u32) -> Option<[u32; 2]> {
        let [f, g] = self.soup.facets_of_edge[edge as usize];
        let is_clean = |&p: &u32| self.stars.is_clean(p);
        let are_two = f < MANY && g < MANY;
        let is_settled = || self.charts.are_one(f, g) || self.soup.edges[edge as usize].iter().any(is_clean);
        (are_two && is_settled()).then_some([f, g])
    }

    /// Whether the corners of a facet in no chart are known to be apart: it is a triangle with two clean corners, which are
    /// on all its sides.
    fn has_corners_apart(&self, facet: u32) -> bool {
        let is_clean = |p: &&u32| self.stars.is_clean(**p);
        self.soup.geometry.base(facet).iter().filter(is_clean).count() >= 2
    }

    fn corners(&self, facet: u32) -> impl Iterator<Item = u32> + Clone + '_ {
        self.soup.facet_edges[facet as usize].iter().map(|&e| self.soup.directed(e)[0])
    }
}

/// The vertices with points that are nearly one made one; `None` when there are none.
pub(crate) fn merged_points(input: &Input, scan: &Scan, report: &mut Report) -> Option<Placed> {
    if scan.near.is_empty() {
        return None;
    }
    let geometry = &input.soup.geometry;
    // A point follows one that stays, never one that follows itself: nobody moves farther than the tolerance.
    let mut follows: Vec<u32> = (0..geometry.n_points() as u32).collect();
    for &[p, q] in &scan.near {
        if follows[p as usize] == p && follows[q as usize] == q {
            follows[q as usize] = p;
            report.note(distance(geometry.position(p), geometry.position(q)));
        }
    }
    let mut staying = Vec::new();
    let mut new_id = vec![0; follows.len()];
    for (&follows, p) in follows.iter().zip(0..) {
        new_id[p as usize] = if follows == p {
            staying.push(geometry.nearest_grid_point(p));
            staying.len() as u32 - 1
        } else {
            new_id[follows as usize]
        };
    }
    let mut point_ids = PointTable::with_capacity(staying.len());
    staying.iter().zip(0..).for_each(|(&at, id)| point_ids.insert(at, id, |id| staying[id as usize]));
    Some(Placed {
        grid: input.soup.grid,
        geometry: Geometry::new(staying),
        point_ids,
        point_of: renumbered(&input.soup.point_of, &new_id),
        tolerances: carried(&input.soup.tolerances, &new_id),
        plane_of_face: Vec::new(),
        order: input.soup.order.clone(),
    })
}

/// The vertices on canonical planes; `None` when all that should be coplanar is.
pub(crate) fn on_planes(input: &Input, scan: &Scan, report: &mut Report) -> Option<Placed> {
    let clusters = cluster::clusters(input, scan);
    let clusters = placement::registered(clusters, input.soup.geometry.n_points());
    if clusters.is_empty() {
        return None;
    }
    let plane_of_face = cluster::planes_of_faces(input.soup, &clusters);
    Some(placement::on_planes(input.soup, &clusters, plane_of_face, report))
}

fn renumbered(point_of: &[Vec<u32>], new_id: &[u32]) -> Vec<Vec<u32>> {
    parallel::map(point_of.len(), |surface| point_of[surface].iter().map(|&p| new_id[p as usize]).collect())
}

/// The tolerances of points with new numbers.
fn carried(tolerances: &[Tolerance], new_id: &[u32]) -> Vec<Tolerance> {
    let n = new_id.iter().max().map_or(0, |&last| last as usize + 1);
    let mut out = vec![Tolerance::default(); n];
    for (&tolerance, &id) in tolerances.iter().zip(new_id) {
        out[id as usize] = out[id as usize].max(tolerance);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::Tolerance;

    #[test]
    fn the_largest_tolerance_is_found_wherever_it_is() {
        assert_eq!(Tolerance::largest(&[]), Tolerance::default());
        for n in [1, 3, 4, 5, 4095, 4096, 4097, 9000] {
            for at in [0, n / 2, n - 1] {
                let mut tolerances = vec![Tolerance::new(1.5); n];
                tolerances[at] = Tolerance::new(2.5);
                assert_eq!(Tolerance::largest(&tolerances), Tolerance::new(2.5));
            }
        }
    }
}
