//! Clusters: polygons that meet and lie nearly in one plane.

use super::fit::Fit;
use super::scan::{Scan, Shape};
use super::{Input, Tolerance};
use crate::kernel::{Geometry, Plane};
use crate::soup::Soup;
use crate::split::offsets;
use crate::union_find::UnionFind;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

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
    pub(super) fn all_corners(&self) -> impl Iterator<Item = u32> + '_ {
        self.corners.iter().chain(&self.touching).copied()
    }
}

/// What the search for clusters reads.
struct Search<'a> {
    input: &'a Input<'a>,
    /// The facets of polygon p, which follow each other, are `first_facet[p]..first_facet[p + 1]`.
    first_facet: Vec<u32>,
    neighbours: Neighbours,
}

/// The clusters of more than one triangle, with what touches them and their canonical planes.
pub(super) fn clusters(input: &Input, scan: &Scan) -> Vec<Cluster> {
    let polygon = |f: u32| input.soup.facet_polygon[f as usize];
    let mut adjacent: Vec<[u32; 2]> = scan.coplanar.iter().map(|pair| pair.map(polygon)).collect();
    adjacent.iter_mut().for_each(|pair| pair.sort_unstable());
    adjacent.sort_unstable();
    adjacent.dedup();
    let n_polygons = input.soup.polygon_flat.len();
    let first_facet = offsets(n_polygons, input.soup.facet_polygon.iter().copied());
    let search = Search { input, first_facet, neighbours: Neighbours::new(n_polygons, &adjacent) };
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
            let is_lone_triangle = self.neighbours.of(p).is_empty() && self.is_triangle(p);
            self.input.soup.polygon_flat[p as usize] && !is_lone_triangle
        };
        let candidates = (0..n_polygons as u32).filter(is_candidate);
        let mut members: Vec<(u32, u32)> = candidates.map(|p| (labels[p as usize], p)).collect();
        members.sort_unstable();
        let mut out = Vec::new();
        for component in members.chunk_by(|a, b| a.0 == b.0) {
            match self.cluster(component.iter().map(|m| m.1).collect()) {
                Ok(cluster) => out.extend(cluster),
                Err(component) => self.split(component, &mut out),
            }
        }
        out
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
        facets.len() == 1 && self.input.soup.facet_edges[facets.start as usize].len() == 3
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
            for &polygon in self.neighbours.of(members[next]) {
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
        for cluster in clusters {
            let key = cluster.all_corners().max_by_key(|&p| (n_at[p as usize], std::cmp::Reverse(p)));
            let Some(key) = key else { continue };
            cluster.plane = cluster.fit.canonical(self.geometry(), &cluster.corners, cluster.tolerance, key);
            let is_on_plane = |p: &u32| cluster.plane.side(self.geometry().nearest_grid_point(*p)) == 0;
            cluster.is_settled = cluster.corners.iter().all(is_on_plane);
            cluster.moves_others = cluster.is_settled && !cluster.touching.iter().all(is_on_plane);
        }
    }

    /// The same for facets that share a corner with a facet of a cluster. O(facets · clusters at a point).
    fn add_touching_neighbours(
        &self,
        clusters: &[Cluster],
        cluster_of: impl Fn(u32) -> Option<u32>,
        touching: &mut Vec<(u32, u32)>,
    ) {
        let mut at_point: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for (cluster, id) in clusters.iter().zip(0..) {
            cluster.corners.iter().for_each(|&p| at_point.entry(p).or_default().push(id));
        }
        if at_point.is_empty() {
            return;
        }
        for facet in 0..self.input.soup.n_facets() as u32 {
            for p in self.input.corners(facet) {
                let others =
                    at_point.get(&p).into_iter().flatten().filter(|&&id| cluster_of(facet) != Some(id));
                for &id in others {
                    let cluster = &clusters[id as usize];
                    let near = |&q: &u32| cluster.fit.distance(self.geometry(), q) <= cluster.tolerance;
                    touching.extend(self.input.corners(facet).filter(near).map(|q| (id, q)));
                }
            }
        }
    }

    /// Gives the clusters the corners of other facets that lie on them or nearly so: a corner that rests on a face.
    fn add_touching_corners(&self, clusters: &mut [Cluster]) {
        let mut cluster_of = vec![None; self.input.soup.polygon_flat.len()];
        for (cluster, id) in clusters.iter().zip(0u32..) {
            cluster.polygons.iter().for_each(|&p| cluster_of[p as usize] = Some(id));
        }
        let of_facet = |f: u32| cluster_of[self.input.soup.facet_polygon[f as usize] as usize];
        let mut touching = Vec::new();
        for (f, g) in self.input.pairs.iter().flat_map(|&[f, g]| [(f, g), (g, f)]) {
            let (Some(id), other) = (of_facet(f), of_facet(g)) else { continue };
            if other != Some(id) {
                let cluster = &clusters[id as usize];
                let near = |&p: &u32| cluster.fit.distance(self.geometry(), p) <= cluster.tolerance;
                touching.extend(self.input.corners(g).filter(near).map(|p| (id, p)));
            }
        }
        self.add_touching_neighbours(clusters, of_facet, &mut touching);
        touching.sort_unstable();
        touching.dedup();
        for (id, p) in touching {
            let cluster = &mut clusters[id as usize];
            if cluster.corners.binary_search(&p).is_err() {
                cluster.touching.push(p);
            }
        }
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

/// The polygons that lie nearly in one plane with each polygon.
struct Neighbours {
    offsets: Vec<u32>,
    list: Vec<u32>,
}

impl Neighbours {
    fn new(n: usize, pairs: &[[u32; 2]]) -> Self {
        let mut directed: Vec<[u32; 2]> = pairs.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
        directed.sort_unstable();
        Self {
            offsets: offsets(n, directed.iter().map(|pair| pair[0])),
            list: directed.iter().map(|pair| pair[1]).collect(),
        }
    }

    fn of(&self, polygon: u32) -> &[u32] {
        let p = polygon as usize;
        &self.list[self.offsets[p] as usize..self.offsets[p + 1] as usize]
    }
}
