//! Clusters: polygons that meet and lie nearly in one plane.

use super::fit::Fit;
use super::scan::{Scan, Shape};
use super::{Input, Tolerance};
use crate::kernel::{Geometry, Plane};
use crate::parallel;
use crate::soup::Soup;
use crate::split::offsets;
use crate::union_find::UnionFind;
use lar_core::Cells;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// Components of polygons a chunk of work.
const COMPONENTS_A_CHUNK: usize = 128;

/// Polygons in one plane.
#[derive(Debug)]
pub(super) struct Cluster {
    pub polygons: Vec<u32>,
    /// Their corners, ascending.
    pub corners: Vec<u32>,
    /// Corners of others that lie on it or nearly so.
    pub touching: Vec<u32>,
    pub fit: Fit,
    pub tolerance: f64,
    /// That of the fit, later the canonical one.
    pub plane: Plane,
    /// Whether the corners lie on the canonical plane already.
    pub is_settled: bool,
    /// Whether it is settled but corners that touch it are not on its plane.
    pub moves_others: bool,
}

impl Cluster {
    /// Its corners and those that touch it.
    pub(super) fn all_corners(&self) -> impl Iterator<Item = u32> + Clone + '_ {
        self.corners.iter().chain(&self.touching).copied()
    }
}

/// What the search for clusters reads.
struct Search<'a> {
    input: &'a Input<'a>,
    /// The facets of polygon p, which follow each other, are `first_facet[p]..first_facet[p + 1]`.
    first_facet: Vec<u32>,
    /// The polygons that lie nearly in one plane with each polygon, in any order and some more than once.
    neighbours: Cells,
}

/// The clusters of more than one triangle, with what touches them and their canonical planes.
pub(super) fn clusters(input: &Input, scan: &Scan) -> Vec<Cluster> {
    if scan.coplanar.is_empty() && input.soup.are_lone_triangles() {
        return Vec::new();
    }
    let polygon = |f: u32| input.soup.facet_polygon[f as usize];
    let adjacent: Vec<[u32; 2]> = scan.coplanar.iter().map(|pair| pair.map(polygon)).collect();
    let n_polygons = input.soup.polygon_flat.len();
    let first_facet = offsets(n_polygons, input.soup.facet_polygon.iter().copied());
    let search = Search { input, first_facet, neighbours: partners(n_polygons, &adjacent) };
    let mut clusters = search.clusters(&adjacent);
    if !clusters.is_empty() {
        search.add_touching_corners(&mut clusters);
        search.choose_planes(&mut clusters);
    }
    clusters
}

impl Search<'_> {
    fn geometry(&self) -> &Geometry {
        &self.input.soup.geometry
    }

    fn facets(&self, polygon: u32) -> Range<u32> {
        self.first_facet[polygon as usize]..self.first_facet[polygon as usize + 1]
    }

    fn clusters(&self, adjacent: &[[u32; 2]]) -> Vec<Cluster> {
        let n_polygons = self.input.soup.polygon_flat.len();
        let mut sets = UnionFind::new(n_polygons);
        for &[a, b] in adjacent {
            sets.union(a, b);
        }
        let (labels, _) = sets.labels();
        let is_candidate = |&p: &u32| {
            let is_lone_triangle = self.neighbours[p as usize].is_empty() && self.is_triangle(p);
            self.input.soup.polygon_flat[p as usize] && !is_lone_triangle
        };
        let candidates = (0..n_polygons as u32).filter(is_candidate);
        let mut members: Vec<(u32, u32)> = candidates.map(|p| (labels[p as usize], p)).collect();
        members.sort_unstable();
        let components: Vec<&[(u32, u32)]> = members.chunk_by(|a, b| a.0 == b.0).collect();
        let (n_chunks, range) = parallel::chunks(components.len(), COMPONENTS_A_CHUNK);
        let parts = parallel::map(n_chunks, |chunk| {
            let mut out = Vec::new();
            for component in &components[range(chunk)] {
                match self.cluster(component.iter().map(|m| m.1).collect()) {
                    Ok(cluster) => out.extend(cluster),
                    Err(component) => self.split(component, &mut out),
                }
            }
            out
        });
        let mut all = Vec::with_capacity(parts.iter().map(Vec::len).sum());
        parts.into_iter().for_each(|part| all.extend(part));
        all
    }

    /// The cluster of some polygons: none when they are one triangle or have no plane; the polygons when they are not
    /// in one plane.
    fn cluster(&self, polygons: Vec<u32>) -> Result<Option<Cluster>, Vec<u32>> {
        if polygons.len() == 1 && self.is_triangle(polygons[0]) {
            return Ok(None);
        }
        let corners = self.corners(&polygons);
        let Some(fit) = Fit::new(self.geometry(), &corners) else { return Ok(None) };
        let tolerance = self.tolerance(&corners);
        if fit.deviation > tolerance {
            return Err(polygons);
        }
        Ok(Some(Cluster {
            polygons,
            corners,
            touching: Vec::new(),
            fit,
            tolerance,
            plane: fit.plane,
            is_settled: false,
            moves_others: false,
        }))
    }

    fn is_triangle(&self, polygon: u32) -> bool {
        let facets = self.facets(polygon);
        facets.len() == 1 && self.input.soup.is_triangle(facets.start)
    }

    /// The corners of some polygons, ascending.
    fn corners(&self, polygons: &[u32]) -> Vec<u32> {
        let facets = polygons.iter().flat_map(|&p| self.facets(p));
        let mut corners: Vec<u32> = facets.flat_map(|f| self.input.corners(f)).collect();
        corners.sort_unstable();
        corners.dedup();
        corners
    }

    fn tolerance(&self, corners: &[u32]) -> f64 {
        Tolerance::of(&self.input.soup.tolerances, corners.iter().copied()).planes()
    }

    /// Clusters grown from the widest polygons of a component that is not in one plane.
    fn split(&self, mut component: Vec<u32>, out: &mut Vec<Cluster>) {
        let width = |polygon: u32| {
            let of = |f: u32| Shape::of(self.input, f).width;
            self.facets(polygon).map(of).fold(0.0, f64::max)
        };
        let mut free: FxHashMap<u32, f64> = component.iter().map(|&p| (p, width(p))).collect();
        component.sort_by(|a, b| free[b].total_cmp(&free[a]).then(a.cmp(b)));
        for &seed in &component {
            if free.remove(&seed).is_none() {
                continue;
            }
            let grown = self.grown(seed, &free);
            for polygon in &grown {
                free.remove(polygon);
            }
            if let Ok(Some(cluster)) = self.cluster(grown) {
                out.push(cluster);
            }
        }
    }

    /// The free polygons around a seed that lie in its plane, which is fitted anew each time that they doubled.
    fn grown(&self, seed: u32, free: &FxHashMap<u32, f64>) -> Vec<u32> {
        let mut members = vec![seed];
        let mut seen: FxHashSet<u32> = members.iter().copied().collect();
        let Some(mut fit) = Fit::new(self.geometry(), &self.corners(&members)) else { return members };
        let lies_near = |fit: &Fit, polygon: u32| {
            let corners = self.corners(&[polygon]);
            let tolerance = self.tolerance(&corners);
            corners.iter().all(|&p| fit.distance(self.geometry(), p) <= tolerance)
        };
        let (mut n_fitted, mut next) = (1, 0);
        while next < members.len() {
            let mut around = self.neighbours[members[next] as usize].to_vec();
            around.sort_unstable();
            for polygon in around {
                if free.contains_key(&polygon) && seen.insert(polygon) && lies_near(&fit, polygon) {
                    members.push(polygon);
                }
            }
            next += 1;
            if members.len() >= 2 * n_fitted {
                n_fitted = members.len();
                fit = Fit::new(self.geometry(), &self.corners(&members)).unwrap_or(fit);
            }
        }
        members.retain(|&polygon| polygon == seed || lies_near(&fit, polygon));
        members.sort_unstable();
        members
    }

    /// Gives each cluster its plane, through the corner where it meets most others: planes that were meant to share a
    /// line or a point in this way mostly do.
    fn choose_planes(&self, clusters: &mut [Cluster]) {
        let mut n_at = vec![0u32; self.geometry().n_points()];
        clusters.iter().flat_map(Cluster::all_corners).for_each(|p| n_at[p as usize] += 1);
        parallel::each(clusters.iter_mut().collect(), |cluster| {
            let key = cluster.all_corners().max_by_key(|&p| (n_at[p as usize], std::cmp::Reverse(p)));
            let Some(key) = key else { return };
            cluster.plane = cluster.fit.canonical(self.geometry(), &cluster.corners, cluster.tolerance, key);
            let is_on_plane = |p: &u32| cluster.plane.side(self.geometry().nearest_grid_point(*p)) == 0;
            cluster.is_settled = cluster.corners.iter().all(is_on_plane);
            cluster.moves_others = cluster.is_settled && !cluster.touching.iter().all(is_on_plane);
        });
    }

    /// Gives the clusters the corners of other facets that lie on them or nearly so: a corner that rests on a face. These
    /// facets are in a pair with one of the cluster, or have a corner in common with it. O(pairs + facets · clusters at a
    /// point).
    fn add_touching_corners(&self, clusters: &mut [Cluster]) {
        let (n_facets, n_points) = (self.input.soup.n_facets(), self.geometry().n_points());
        let (paired, at_corner) =
            parallel::join(|| partners(n_facets, self.input.pairs), || self.facets_at_corners(clusters));
        parallel::map_parts(clusters, |_, clusters| {
            // The last cluster that a facet and a point were looked at for.
            let (mut facet_seen, mut point_seen) = (vec![u32::MAX; n_facets], vec![u32::MAX; n_points]);
            for (cluster, id) in clusters.iter_mut().zip(0..) {
                let own = cluster.polygons.iter().flat_map(|&polygon| self.facets(polygon));
                own.clone().for_each(|f| facet_seen[f as usize] = id);
                cluster.corners.iter().for_each(|&p| point_seen[p as usize] = id);
                let others = own.flat_map(|f| &paired[f as usize]);
                for &facet in others.chain(cluster.corners.iter().flat_map(|&p| &at_corner[p as usize])) {
                    if std::mem::replace(&mut facet_seen[facet as usize], id) == id {
                        continue;
                    }
                    let new = self
                        .input
                        .corners(facet)
                        .filter(|&p| std::mem::replace(&mut point_seen[p as usize], id) != id);
                    let near = new.filter(|&p| cluster.fit.is_near(self.geometry(), p, cluster.tolerance));
                    cluster.touching.extend(near);
                }
                cluster.touching.sort_unstable();
            }
        });
    }

    /// The facets at each point that is a corner of a cluster.
    fn facets_at_corners(&self, clusters: &[Cluster]) -> Cells {
        let n_points = self.geometry().n_points();
        let mut is_corner = vec![false; n_points];
        clusters.iter().flat_map(|c| &c.corners).for_each(|&p| is_corner[p as usize] = true);
        let facets = 0..self.input.soup.n_facets() as u32;
        let entries = facets.flat_map(|f| self.input.corners(f).map(move |p| (p, f)));
        lists(n_points, entries.filter(|(p, _)| is_corner[*p as usize]))
    }
}

/// The shared plane of each face of each surface.
pub(super) fn planes_of_faces(soup: &Soup, clusters: &[Cluster]) -> Vec<Vec<Option<u32>>> {
    let mut planes: Vec<Vec<Option<u32>>> =
        soup.coefficients.iter().map(|faces| vec![None; faces.len()]).collect();
    for (cluster, plane) in clusters.iter().zip(0..) {
        for &polygon in &cluster.polygons {
            for parent in soup.polygon_parents(polygon) {
                planes[parent.solid as usize][parent.face as usize] = Some(plane);
            }
        }
    }
    planes
}

/// A list for each of 0..n, of entries (whose list, item) in their order. These are gone through twice.
pub(super) fn lists(n: usize, entries: impl Iterator<Item = (u32, u32)> + Clone) -> Cells {
    let offsets = offsets(n, entries.clone().map(|(list, _)| list));
    let mut items = vec![0; offsets[n] as usize];
    let mut fill = offsets.clone();
    for (list, item) in entries {
        let at = &mut fill[list as usize];
        items[*at as usize] = item;
        *at += 1;
    }
    Cells::from_parts(offsets, items)
}

/// The partners of each of 0..n.
fn partners(n: usize, pairs: &[[u32; 2]]) -> Cells {
    lists(n, pairs.iter().flat_map(|&[a, b]| [(a, b), (b, a)]))
}
