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

use crate::kernel::{CanonicalPoints, Geometry, Plane, RationalPoint, SharedPlane, Sign};
use crate::parallel;
use crate::soup::{Placed, PointIds, Soup};
use crate::union_find::UnionFind;
use lar_core::Cells;
use rustc_hash::{FxHashMap, FxHashSet};

/// Pairs of facets a chunk of work.
const PAIRS_A_CHUNK: usize = 1 << 14;

/// Coefficients of a canonical plane stay within ±2^40.
const COEFFICIENT: i128 = 1 << 40;

/// How far from each other, in grid steps, what was meant to be equal may lie in one surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tolerance {
    /// Error of a coordinate: half a step, or half a unit of the source's last digit.
    pub error: f64,
}

/// Coordinates that are off by more than this many grid steps, 2^-16 of the model's extent, are taken as they are:
/// what was meant to be equal can not be told from what was meant to be small.
const LARGEST_ERROR: f64 = (1 << 24) as f64;

impl Tolerance {
    /// For coordinates that are off by up to so many grid steps.
    pub(crate) fn new(error: f64) -> Self {
        Self { error: if error > LARGEST_ERROR { 0.5 } else { error } }
    }
    /// Two points that were one differ by two errors in a coordinate.
    fn points(self) -> f64 {
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

/// What is unified first, and what then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    Points,
    Planes,
}

/// Facets of a soup, the pairs of them whose boxes meet, and what the surfaces are worth.
pub(crate) struct Canonicaliser<'a> {
    pub soup: &'a Soup,
    pub pairs: &'a [[u32; 2]],
    /// For each surface.
    pub tolerances: &'a [Tolerance],
}

impl Canonicaliser<'_> {
    fn geometry(&self) -> &Geometry {
        &self.soup.geometry
    }

    fn tolerance(&self, facet: u32) -> Tolerance {
        let of = |solid: u32| self.tolerances[solid as usize].error;
        let error = self.soup.parents(facet).iter().map(|p| of(p.solid)).fold(0.0, f64::max);
        Tolerance { error }
    }

    fn corners(&self, facet: u32) -> impl Iterator<Item = u32> + Clone + '_ {
        self.soup.facet_edges[facet as usize].iter().map(|&e| self.soup.directed(e)[0])
    }

    /// The vertices in their new places; `None` when they stay where they are.
    pub(crate) fn placed(&self, stage: Stage, report: &mut Report) -> Option<Placed> {
        match stage {
            Stage::Points => self.merged_points(report),
            Stage::Planes => self.on_planes(report),
        }
    }

    /// The vertices with points that are nearly one made one; `None` when there are none.
    fn merged_points(&self, report: &mut Report) -> Option<Placed> {
        let near = self.near_points();
        if near.is_empty() {
            return None;
        }
        // A point follows one that stays, never one that follows itself: nobody moves farther than the tolerance.
        let mut follows: Vec<u32> = (0..self.geometry().n_points() as u32).collect();
        for [p, q] in near {
            if follows[p as usize] == p && follows[q as usize] == q {
                follows[q as usize] = p;
                report.note(distance(self.geometry().position(p), self.geometry().position(q)));
            }
        }
        let mut staying = Vec::new();
        let mut new_id = vec![0; follows.len()];
        for (p, &follows) in follows.iter().enumerate() {
            new_id[p] = if follows as usize == p {
                staying.push(self.geometry().nearest_grid_point(p as u32));
                staying.len() as u32 - 1
            } else {
                new_id[follows as usize]
            };
        }
        let point_ids = staying.iter().copied().zip(0..).collect();
        Some(Placed {
            grid: self.soup.grid,
            geometry: Geometry::new(staying),
            point_ids,
            point_of: renumbered(&self.soup.point_of, &new_id),
            plane_of_face: Vec::new(),
        })
    }

    /// Pairs of points within the tolerance, ascending, of facets that meet.
    fn near_points(&self) -> Vec<[u32; 2]> {
        let (n_chunks, range) = parallel::chunks(self.pairs.len(), PAIRS_A_CHUNK);
        let mut near = parallel::map(n_chunks, |chunk| {
            let mut out = Vec::new();
            for &[f, g] in &self.pairs[range(chunk)] {
                let limit = self.tolerance(f).points().max(self.tolerance(g).points());
                // At most 64 corners each.
                for p in self.corners(f) {
                    let at = self.geometry().nearest_grid_point(p);
                    out.extend(self.corners(g).filter_map(|q| {
                        let other = self.geometry().nearest_grid_point(q);
                        let is_near = (0..3).all(|k| at[k].abs_diff(other[k]) as f64 <= limit);
                        (p != q && is_near).then(|| [p.min(q), p.max(q)])
                    }));
                }
            }
            out
        })
        .concat();
        near.sort_unstable();
        near.dedup();
        near
    }

    /// The vertices on canonical planes; `None` when all that should be coplanar is.
    fn on_planes(&self, report: &mut Report) -> Option<Placed> {
        let items = Items::new(self.soup);
        let mut clusters = self.clusters(&items);
        self.add_touching_corners(&items, &mut clusters);
        self.choose_planes(&mut clusters);
        clusters = registered(clusters, self.geometry().n_points());
        if clusters.is_empty() {
            return None;
        }
        let planes: Vec<SharedPlane> = clusters.iter().map(|c| c.plane.widened()).collect();
        report.planes = planes.len() as u64;
        let mut of_point = vec![Vec::new(); self.geometry().n_points()];
        for (cluster, id) in clusters.iter().zip(0..) {
            cluster.corners.iter().for_each(|&p| of_point[p as usize].push((id, true)));
            cluster.touching.iter().for_each(|&p| of_point[p as usize].push((id, false)));
        }
        let mut placement = Placement::default();
        for (p, candidates) in (0..).zip(&mut of_point) {
            candidates.sort_by_key(|&(c, is_own): &(u32, bool)| {
                let cluster = &clusters[c as usize];
                (!cluster.is_settled, !is_own, std::cmp::Reverse(cluster.corners.len()), c)
            });
            let at = self.geometry().nearest_grid_point(p);
            let (point, on) = placed(at, candidates, &clusters);
            report.note(distance(at.map(|x| x as f64), point.rounded()));
            placement.push(point, on);
        }
        Some(placement.finished(self.soup, planes, self.planes_of_faces(&items, &clusters)))
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

    /// Gives the clusters the corners of other facets that lie on them or nearly so: a corner that rests on a face.
    fn add_touching_corners(&self, items: &Items, clusters: &mut [Cluster]) {
        let mut cluster_of = vec![None; items.len()];
        for (cluster, id) in clusters.iter().zip(0u32..) {
            cluster.items.iter().for_each(|&item| cluster_of[item as usize] = Some(id));
        }
        let of_facet = |f: u32| items.of_facet(f).and_then(|item| cluster_of[item as usize]);
        let mut touching = Vec::new();
        for (f, g) in self.pairs.iter().flat_map(|&[f, g]| [(f, g), (g, f)]) {
            let (Some(id), other) = (of_facet(f), of_facet(g)) else { continue };
            if other != Some(id) {
                let cluster = &clusters[id as usize];
                let near = |&p: &u32| cluster.fit.distance(self.geometry(), p) <= cluster.tolerance;
                touching.extend(self.corners(g).filter(near).map(|p| (id, p)));
            }
        }
        touching.sort_unstable();
        touching.dedup();
        for (id, p) in touching {
            let cluster = &mut clusters[id as usize];
            if cluster.corners.binary_search(&p).is_err() {
                cluster.touching.push(p);
            }
        }
    }

    /// The plane of each face of each surface.
    fn planes_of_faces(&self, items: &Items, clusters: &[Cluster]) -> Vec<Vec<Option<u32>>> {
        let mut planes: Vec<Vec<Option<u32>>> =
            self.soup.coefficients.iter().map(|faces| vec![None; faces.len()]).collect();
        for (cluster, plane) in clusters.iter().zip(0..) {
            for &item in &cluster.items {
                for parent in self.soup.parents(items.facets(item)[0]) {
                    planes[parent.solid as usize][parent.face as usize] = Some(plane);
                }
            }
        }
        planes
    }

    /// Clusters of items in one plane, of more than one triangle.
    fn clusters(&self, items: &Items) -> Vec<Cluster> {
        let adjacent = self.nearly_coplanar(items);
        let mut sets = UnionFind::new(items.len());
        for &[a, b] in &adjacent {
            sets.union(a, b);
        }
        let (labels, n) = sets.labels();
        let mut members = vec![Vec::new(); n as usize];
        for (&label, item) in labels.iter().zip(0..) {
            members[label as usize].push(item);
        }
        let neighbours = Neighbours::new(items.len(), &adjacent);
        let mut out = Vec::new();
        for component in members {
            match self.cluster(items, component) {
                Ok(cluster) => out.extend(cluster),
                Err(component) => self.split(items, component, &neighbours, &mut out),
            }
        }
        out
    }

    /// Pairs of items that meet and whose corners lie nearly in one plane, the tolerance growing with the distance
    /// from the facet that the plane is taken from.
    fn nearly_coplanar(&self, items: &Items) -> Vec<[u32; 2]> {
        let shapes: Vec<Shape> = (0..self.soup.n_facets() as u32).map(|f| self.shape(f)).collect();
        let (n_chunks, range) = parallel::chunks(self.pairs.len(), PAIRS_A_CHUNK);
        let mut found = parallel::map(n_chunks, |chunk| {
            let mut out = Vec::new();
            for &[f, g] in &self.pairs[range(chunk)] {
                let (Some(a), Some(b)) = (items.of_facet(f), items.of_facet(g)) else { continue };
                if a != b && self.are_nearly_coplanar(f, g, &shapes) {
                    out.push([a.min(b), a.max(b)]);
                }
            }
            out
        })
        .concat();
        found.sort_unstable();
        found.dedup();
        found
    }

    fn shape(&self, facet: u32) -> Shape {
        let [a, b, c] = self.geometry().base(facet).map(|p| self.geometry().position(p));
        let normal = self.geometry().normal(facet);
        let length = dot(normal, normal).sqrt();
        let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
        Shape { unit: normal.map(|x| x / length), origin: a, width: length / longest }
    }

    fn are_nearly_coplanar(&self, f: u32, g: u32, shapes: &[Shape]) -> bool {
        let (wide, narrow) =
            if shapes[f as usize].width >= shapes[g as usize].width { (f, g) } else { (g, f) };
        let (shape, other) = (&shapes[wide as usize], &shapes[narrow as usize]);
        // Of two corners that are not shared one is farther from the wide facet's plane than this, unless the angle is small.
        let tolerance = self.tolerance(f).planes().max(self.tolerance(g).planes());
        let sine = dot(cross(shape.unit, other.unit), cross(shape.unit, other.unit)).sqrt();
        let reach = 1.0 + 4.0 * (distance(shape.origin, other.origin) + 2.0 * other.width) / shape.width;
        if sine * other.width > 8.0 * tolerance * reach {
            return false;
        }
        self.corners(narrow).all(|p| {
            let d = minus(self.geometry().position(p), shape.origin);
            dot(shape.unit, d).abs() <= tolerance * (1.0 + 2.0 * dot(d, d).sqrt() / shape.width)
        })
    }

    /// The cluster of some items: none when they are one triangle or have no plane; the items when they are not in
    /// one plane.
    fn cluster(&self, items: &Items, members: Vec<u32>) -> Result<Option<Cluster>, Vec<u32>> {
        if let &[item] = members.as_slice()
            && self.is_triangle(items, item)
        {
            return Ok(None);
        }
        let corners = self.corners_of(items, &members);
        let Some(fit) = Fit::new(self.geometry(), &corners) else { return Ok(None) };
        let tolerance = self.tolerance_of(items, &members);
        if fit.deviation > 2.0 * tolerance {
            return Err(members);
        }
        let cluster = Cluster {
            items: members,
            corners,
            touching: Vec::new(),
            fit,
            tolerance,
            plane: fit.plane,
            is_settled: false,
            moves_others: false,
        };
        Ok(Some(cluster))
    }

    fn is_triangle(&self, items: &Items, item: u32) -> bool {
        matches!(items.facets(item), &[f] if self.soup.facet_edges[f as usize].len() == 3)
    }

    fn corners_of(&self, items: &Items, members: &[u32]) -> Vec<u32> {
        let facets = members.iter().flat_map(|&item| items.facets(item));
        let mut corners: Vec<u32> = facets.flat_map(|&f| self.corners(f)).collect();
        corners.sort_unstable();
        corners.dedup();
        corners
    }

    fn tolerance_of(&self, items: &Items, members: &[u32]) -> f64 {
        members.iter().map(|&i| self.tolerance(items.facets(i)[0]).planes()).fold(0.0, f64::max)
    }

    /// Clusters grown from the widest items of a component that is not in one plane.
    fn split(&self, items: &Items, mut component: Vec<u32>, neighbours: &Neighbours, out: &mut Vec<Cluster>) {
        let width = |item: u32| {
            let shape = |&f: &u32| self.shape(f).width;
            items.facets(item).iter().map(shape).fold(0.0, f64::max)
        };
        let mut widths: FxHashMap<u32, f64> = component.iter().map(|&item| (item, width(item))).collect();
        component.sort_by(|a, b| widths[b].total_cmp(&widths[a]).then(a.cmp(b)));
        for &seed in &component {
            if widths.remove(&seed).is_none() {
                continue;
            }
            let grown = self.grown(items, seed, neighbours, &widths);
            for item in &grown {
                widths.remove(item);
            }
            if let Ok(Some(cluster)) = self.cluster(items, grown) {
                out.push(cluster);
            }
        }
    }

    /// The items around a seed that lie in its plane, which is fitted anew each time that their corners doubled.
    fn grown(
        &self,
        items: &Items,
        seed: u32,
        neighbours: &Neighbours,
        free: &FxHashMap<u32, f64>,
    ) -> Vec<u32> {
        let mut members = vec![seed];
        let mut seen: FxHashSet<u32> = members.iter().copied().collect();
        let Some(mut fit) = Fit::new(self.geometry(), &self.corners_of(items, &members)) else {
            return members;
        };
        let mut at_fit = 1;
        let mut next = 0;
        while next < members.len() {
            for &item in neighbours.of(members[next]) {
                if !free.contains_key(&item) || !seen.insert(item) {
                    continue;
                }
                let tolerance = self.tolerance_of(items, &[item]);
                if self
                    .corners_of(items, &[item])
                    .iter()
                    .all(|&p| fit.distance(self.geometry(), p) <= tolerance)
                {
                    members.push(item);
                }
            }
            next += 1;
            if members.len() >= 2 * at_fit {
                at_fit = members.len();
                fit = Fit::new(self.geometry(), &self.corners_of(items, &members)).unwrap_or(fit);
            }
        }
        let tolerance = self.tolerance_of(items, &members);
        members.retain(|&item| {
            let corners = self.corners_of(items, &[item]);
            item == seed || corners.iter().all(|&p| fit.distance(self.geometry(), p) <= tolerance)
        });
        members.sort_unstable();
        members
    }
}

/// What is put on a plane as one: a flat polygon with all its facets.
struct Items {
    item_of_facet: Vec<u32>,
    facets: Cells,
}

impl Items {
    const NONE: u32 = u32::MAX;

    fn new(soup: &Soup) -> Self {
        let mut item_of_facet = vec![Self::NONE; soup.n_facets()];
        let mut facets = Cells::new();
        let mut run: Vec<u32> = Vec::new();
        for facet in 0..soup.n_facets() as u32 {
            if !soup.is_flat(facet) {
                continue;
            }
            // The facets of a polygon follow each other.
            if let Some(&last) = run.last()
                && soup.plane_class(last) != soup.plane_class(facet)
            {
                facets.push(&run);
                run.clear();
            }
            item_of_facet[facet as usize] = facets.len() as u32;
            run.push(facet);
        }
        if !run.is_empty() {
            facets.push(&run);
        }
        Self { item_of_facet, facets }
    }

    fn len(&self) -> usize {
        self.facets.len()
    }

    fn of_facet(&self, facet: u32) -> Option<u32> {
        Some(self.item_of_facet[facet as usize]).filter(|&item| item != Self::NONE)
    }

    fn facets(&self, item: u32) -> &[u32] {
        &self.facets[item as usize]
    }
}

/// Adjacency lists of items.
struct Neighbours {
    offsets: Vec<u32>,
    list: Vec<u32>,
}

impl Neighbours {
    fn new(n: usize, pairs: &[[u32; 2]]) -> Self {
        let mut offsets = vec![0; n + 1];
        pairs.iter().flatten().for_each(|&i| offsets[i as usize + 1] += 1);
        for i in 0..n {
            offsets[i + 1] += offsets[i];
        }
        let mut fill = offsets.clone();
        let mut list = vec![0; 2 * pairs.len()];
        for &[a, b] in pairs {
            for (from, to) in [(a, b), (b, a)] {
                list[fill[from as usize] as usize] = to;
                fill[from as usize] += 1;
            }
        }
        Self { offsets, list }
    }

    fn of(&self, item: u32) -> &[u32] {
        &self.list[self.offsets[item as usize] as usize..self.offsets[item as usize + 1] as usize]
    }
}

/// A facet seen as a plane: unit normal, a point, and twice its area over its longest side.
struct Shape {
    unit: [f64; 3],
    origin: [f64; 3],
    width: f64,
}

/// The plane of three points far from each other among some.
#[derive(Clone, Copy, Debug)]
struct Fit {
    plane: Plane,
    length: f64,
    /// How far the farthest of the points lies from it.
    deviation: f64,
}

impl Fit {
    /// `None` when all points lie on one line.
    fn new(geometry: &Geometry, corners: &[u32]) -> Option<Self> {
        let at = |p: u32| geometry.nearest_grid_point(p);
        let float = |p: u32| geometry.position(p);
        let a = *corners.first()?;
        let farthest = |value: &dyn Fn(u32) -> f64| {
            corners.iter().copied().max_by(|&p, &q| value(p).total_cmp(&value(q)).then(q.cmp(&p)))
        };
        let b = farthest(&|p| distance(float(a), float(p)))?;
        let along = minus(float(b), float(a));
        let c = farthest(&|p| {
            let n = cross(along, minus(float(p), float(a)));
            dot(n, n)
        })?;
        let plane = Plane::through(at(a), at(b), at(c));
        let length = plane.n.map(|n| (n as f64).powi(2)).iter().sum::<f64>().sqrt();
        if length == 0.0 {
            return None;
        }
        let farthest = corners.iter().map(|&p| plane.side(at(p)).unsigned_abs()).max().unwrap_or(0);
        Some(Self { plane, length, deviation: farthest as f64 / length })
    }

    fn distance(&self, geometry: &Geometry, p: u32) -> f64 {
        (self.plane.side(geometry.nearest_grid_point(p)) as f64 / self.length).abs()
    }

    /// A plane with small coefficients near the points: the same one where it has such; else the nearest with 2^40 for
    /// its largest component, the others zero where the tolerance allows; through `key`, where that lies near enough.
    fn canonical(&self, geometry: &Geometry, corners: &[u32], tolerance: f64, key: u32) -> Plane {
        let n = self.plane.n;
        let axis = (1..3).fold(0, |best, k| if n[k].abs() > n[best].abs() { k } else { best });
        if self.deviation == 0.0 {
            let divisor = n.iter().fold(0, |g, &x| gcd(g, x.unsigned_abs())) as i128;
            if n[axis].abs() / divisor <= COEFFICIENT {
                return Plane { n: n.map(|x| x / divisor), d: self.plane.d / divisor };
            }
        }
        let small = n.map(|x| rounded_division(x * COEFFICIENT, n[axis]));
        let minor =
            if small[(axis + 1) % 3].abs() < small[(axis + 2) % 3].abs() { axis + 1 } else { axis + 2 } % 3;
        let along_axis = std::array::from_fn(|k| i128::from(k == axis));
        let without_minor = std::array::from_fn(|k| if k == minor { 0 } else { small[k] });
        let near = |n: [i128; 3], within: f64| {
            let length = n.iter().map(|&x| (x as f64).powi(2)).sum::<f64>().sqrt();
            let through_key = Plane { n, d: Plane { n, d: 0 }.side(geometry.nearest_grid_point(key)) };
            [through_key, centred(geometry, corners, n)]
                .into_iter()
                .find(|plane| spread(geometry, corners, plane) as f64 <= within * length)
        };
        near(along_axis, tolerance)
            .or_else(|| near(without_minor, tolerance))
            .or_else(|| near(small, 2.0 * tolerance))
            .unwrap_or_else(|| centred(geometry, corners, small))
    }
}

/// The plane with the normal n in the middle of the points.
fn centred(geometry: &Geometry, corners: &[u32], n: [i128; 3]) -> Plane {
    let through_origin = Plane { n, d: 0 };
    let heights = corners.iter().map(|&p| through_origin.side(geometry.nearest_grid_point(p)));
    let (low, high) = heights.fold((i128::MAX, i128::MIN), |(lo, hi), h| (lo.min(h), hi.max(h)));
    Plane { n, d: low + (high - low) / 2 }
}

/// How far the point that is farthest from a plane lies from it, times the length of the normal.
fn spread(geometry: &Geometry, corners: &[u32], plane: &Plane) -> u128 {
    corners.iter().map(|&p| plane.side(geometry.nearest_grid_point(p)).unsigned_abs()).max().unwrap_or(0)
}

fn rounded_division(x: i128, divisor: i128) -> i128 {
    let (quotient, remainder) = (x.div_euclid(divisor), x.rem_euclid(divisor));
    quotient + i128::from(2 * remainder >= divisor.abs()) * divisor.signum()
}

fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// Items in one plane.
#[derive(Debug)]
struct Cluster {
    items: Vec<u32>,
    /// Their corners, ascending.
    corners: Vec<u32>,
    /// Corners of others that lie on it or nearly so.
    touching: Vec<u32>,
    fit: Fit,
    tolerance: f64,
    /// That of the fit, later the canonical one.
    plane: Plane,
    /// Whether the corners lie on the canonical plane already.
    is_settled: bool,
    /// Whether it is settled but corners that touch it are not on its plane.
    moves_others: bool,
}

impl Cluster {
    /// Its corners and those that touch it.
    fn all_corners(&self) -> impl Iterator<Item = u32> + '_ {
        self.corners.iter().chain(&self.touching).copied()
    }
}

/// The clusters that matter: those that move corners, and those that share corners with them, directly or through
/// others. A settled one keeps its plane, so nothing goes on through it.
fn registered(clusters: Vec<Cluster>, n_points: usize) -> Vec<Cluster> {
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
            Some(moved) if distance(home, moved.rounded()) <= 2.0 * cluster.tolerance => point = moved,
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
    let longest = |v: [i128; 3]| (1..3).fold(0, |best, k| if v[k].abs() > v[best].abs() { k } else { best });
    let three = match *planes {
        [p] => {
            let axis = longest(p.n);
            [*p, coordinate((axis + 1) % 3), coordinate((axis + 2) % 3)]
        }
        [p, q] => {
            let minor = |u: usize, v: usize| p.n[u] * q.n[v] - p.n[v] * q.n[u];
            [*p, *q, coordinate(longest([minor(1, 2), minor(2, 0), minor(0, 1)]))]
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

    fn finished(self, soup: &Soup, planes: Vec<SharedPlane>, plane_of_face: Vec<Vec<Option<u32>>>) -> Placed {
        let mut canonical = CanonicalPoints { planes, ..CanonicalPoints::default() };
        let (mut points, mut point_ids) = (Vec::with_capacity(self.points.len()), PointIds::default());
        for ((point, on), id) in self.points.iter().zip(0..) {
            let nearest = point.rounded().map(|x| x.round() as i64);
            points.push(nearest);
            canonical.planes_of_point.push(on);
            if RationalPoint::grid(nearest).widened::<5>().equals(&point.widened()) {
                point_ids.insert(nearest, id);
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
            plane_of_face,
        }
    }
}

fn renumbered(point_of: &[Vec<u32>], new_id: &[u32]) -> Vec<Vec<u32>> {
    point_of.iter().map(|of| of.iter().map(|&p| new_id[p as usize]).collect()).collect()
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let minor = |u: usize, v: usize| a[u] * b[v] - a[v] * b[u];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    dot(minus(a, b), minus(a, b)).sqrt()
}
