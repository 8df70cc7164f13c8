//! Stage 1: surfaces → points on the integer grid, edges, and facets with exact planes and provenance.
//!
//! Equal grid points are one point; polygons with the same corners are one polygon with several parents. Holds
//! afterwards: each facet is exactly planar, its edges are in one table, and an edge is *soft* when it is only a
//! diagonal inside a polygon.

use crate::canonical::Tolerance;
use crate::error::ArrangementError;
use crate::grid::Grid;
use crate::kernel::{Geometry, Sign};
use crate::polygon::{Polygon, Shape};
use lar_core::{Cells, Surface};
use rustc_hash::FxHashMap;

/// A face of the input that a polygon stands for: `sign` is −1 when the polygon is turned the other way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Parent {
    /// Index of the input surface.
    pub solid: u32,
    /// Face of that surface.
    pub face: u32,
    /// +1 or −1: the same orientation or the opposite one.
    pub sign: i8,
}

/// Grid point by its coordinates.
pub(crate) type PointIds = FxHashMap<[i64; 3], u32>;

/// The vertices of the input in their places.
#[derive(Debug)]
pub(crate) struct Placed {
    pub grid: Grid,
    pub geometry: Geometry,
    pub point_ids: PointIds,
    /// The point of each vertex of each surface.
    pub point_of: Vec<Vec<u32>>,
    /// How far each point may lie from where it was meant to be.
    pub tolerances: Vec<Tolerance>,
    /// The shared plane of each face of each surface; empty when there is none.
    pub plane_of_face: Vec<Vec<Option<u32>>>,
}

impl Placed {
    /// Snaps and unifies; refuses non-finite coordinates and indices out of range. `error` says by what length a
    /// coordinate of some magnitude may be off in a surface.
    pub(crate) fn snapped(
        surfaces: &[Surface],
        error: impl Fn(&Surface, f64) -> f64,
    ) -> Result<Self, ArrangementError> {
        let grid = fitted_grid(surfaces)?;
        let (points, point_ids, point_of) = unified_points(surfaces, &grid);
        let mut tolerances = vec![Tolerance::new(grid.coarseness() / 2.0); points.len()];
        for (surface, of) in surfaces.iter().zip(&point_of) {
            for (p, &id) in surface.points.iter().zip(of) {
                let size = p.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
                let worth = Tolerance::new(error(surface, size) / grid.step());
                tolerances[id as usize] = tolerances[id as usize].max(worth);
            }
        }
        let geometry = Geometry::new(points);
        Ok(Self { grid, geometry, point_ids, point_of, tolerances, plane_of_face: Vec::new() })
    }
}

/// The input on the grid.
#[derive(Debug)]
pub(crate) struct Soup {
    pub geometry: Geometry,
    pub grid: Grid,
    /// Ends of each edge, the smaller first.
    pub edges: Vec<[u32; 2]>,
    /// Whether an edge is only a diagonal inside a nearly planar polygon.
    pub soft: Vec<bool>,
    /// Directed edges of each facet: 2 · edge + (1 when from the larger end to the smaller).
    pub facet_edges: Cells,
    /// The polygon that each facet is (a piece of).
    pub facet_polygon: Vec<u32>,
    parents: Vec<Parent>,
    /// The parents of polygon p are `parent_offsets[p]..parent_offsets[p + 1]`.
    parent_offsets: Vec<u32>,
    /// Whether a polygon is planar, exactly or within the tolerance.
    pub polygon_flat: Vec<bool>,
    /// Edge by its ends.
    edge_ids: FxHashMap<[u32; 2], u32>,
    /// Grid point by its coordinates.
    pub point_ids: PointIds,
    /// The point of each vertex of each surface.
    pub point_of: Vec<Vec<u32>>,
    /// How far each point may lie from where it was meant to be.
    pub tolerances: Vec<Tolerance>,
    /// Coefficient of each surface's faces in the boundary of its solid.
    pub coefficients: Vec<Vec<i8>>,
    /// Input faces without an inside (all corners on one line after snapping).
    pub degenerate: u32,
    /// Polygons that had to be triangulated.
    pub triangulated: u32,
    /// How far, in grid steps, the corners of those lie from a plane that are put together again.
    pub bend: f64,
}

impl Soup {
    /// Makes facets of the faces.
    ///
    /// Polygons whose corners deviate from a plane by more than their tolerance are not treated as planar: their
    /// diagonals become edges of the result.
    pub(crate) fn new(surfaces: &[Surface], placed: Placed) -> Self {
        let Placed { grid, geometry, point_ids, point_of, tolerances, plane_of_face } = placed;
        let mut builder = Builder {
            soup: Self {
                geometry,
                grid,
                edges: Vec::new(),
                soft: Vec::new(),
                facet_edges: Cells::new(),
                facet_polygon: Vec::new(),
                parents: Vec::new(),
                parent_offsets: Vec::new(),
                polygon_flat: Vec::new(),
                edge_ids: FxHashMap::default(),
                point_ids,
                point_of: Vec::new(),
                tolerances,
                coefficients: Vec::new(),
                degenerate: 0,
                triangulated: 0,
                bend: 0.0,
            },
            triangle_ids: FxHashMap::default(),
            polygon_ids: FxHashMap::default(),
            parents: Vec::new(),
            directed: Vec::new(),

            plane: None,
        };
        let n_faces = surfaces.iter().map(Surface::n_faces).sum();
        builder.parents.reserve(n_faces);
        builder.triangle_ids.reserve(n_faces);
        builder.soup.edge_ids.reserve(n_faces * 3 / 2);
        for (solid, (surface, point_of)) in surfaces.iter().zip(&point_of).enumerate() {
            for face in 0..surface.n_faces() {
                builder.plane = plane_of_face.get(solid).and_then(|planes| planes[face]);
                builder.push_face(solid, surface, face, point_of);
            }
            builder.soup.coefficients.push((0..surface.n_faces()).map(|f| surface.coefficient(f)).collect());
        }
        builder.soup.point_of = point_of;
        builder.finished()
    }

    pub(crate) fn n_facets(&self) -> usize {
        self.facet_polygon.len()
    }

    /// First and last point of a directed edge.
    pub(crate) fn directed(&self, edge: u32) -> [u32; 2] {
        let [a, b] = self.edges[(edge / 2) as usize];
        if edge.is_multiple_of(2) { [a, b] } else { [b, a] }
    }

    /// The input edge with these ends, the smaller first.
    pub(crate) fn edge_between(&self, ends: [u32; 2]) -> Option<u32> {
        self.edge_ids.get(&ends).copied()
    }

    /// A number that is equal for facets of one polygon that is meant to be planar.
    pub(crate) fn plane_class(&self, facet: u32) -> u32 {
        let polygon = self.facet_polygon[facet as usize];
        if self.polygon_flat[polygon as usize] { polygon } else { self.polygon_flat.len() as u32 + facet }
    }

    /// Parents of a facet.
    pub(crate) fn parents(&self, facet: u32) -> &[Parent] {
        self.polygon_parents(self.facet_polygon[facet as usize])
    }

    /// Parents of a polygon.
    pub(crate) fn polygon_parents(&self, polygon: u32) -> &[Parent] {
        let p = polygon as usize;
        &self.parents[self.parent_offsets[p] as usize..self.parent_offsets[p + 1] as usize]
    }
}

fn fitted_grid(surfaces: &[Surface]) -> Result<Grid, ArrangementError> {
    let (mut lo, mut hi) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for surface in surfaces {
        if surface.points.dim() != 3 {
            return Err(ArrangementError::Dimension {
                solid: surface.name.clone(),
                dim: surface.points.dim(),
            });
        }
        for (v, p) in surface.points.iter().enumerate() {
            for k in 0..3 {
                if !p[k].is_finite() {
                    return Err(ArrangementError::NotFinite {
                        solid: surface.name.clone(),
                        vertex: (v as u32).into(),
                        value: p[k],
                    });
                }
                lo[k] = lo[k].min(p[k]);
                hi[k] = hi[k].max(p[k]);
            }
        }
        for face in 0..surface.n_faces() {
            if let Some(&vertex) = surface.face(face).flatten().find(|&&v| v as usize >= surface.points.len())
            {
                return Err(ArrangementError::NoSuchVertex {
                    solid: surface.name.clone(),
                    face: (face as u32).into(),
                    vertex: vertex.into(),
                    n_vertices: surface.points.len(),
                });
            }
        }
    }
    Ok(if lo[0] <= hi[0] { Grid::fitted(lo, hi) } else { Grid::fitted([0.0; 3], [0.0; 3]) })
}

/// Distinct grid points in first-seen order, their numbers, and for each surface the grid point of each of its
/// vertices.
fn unified_points(surfaces: &[Surface], grid: &Grid) -> (Vec<[i64; 3]>, PointIds, Vec<Vec<u32>>) {
    let mut points = Vec::new();
    let mut ids = PointIds::default();
    ids.reserve(surfaces.iter().map(|s| s.points.len()).sum());
    let of = surfaces
        .iter()
        .map(|surface| {
            surface
                .points
                .iter()
                .map(|p| {
                    let snapped = grid.snap([p[0], p[1], p[2]]);
                    *ids.entry(snapped).or_insert_with(|| {
                        points.push(snapped);
                        points.len() as u32 - 1
                    })
                })
                .collect()
        })
        .collect();
    (points, ids, of)
}

struct Builder {
    soup: Soup,
    triangle_ids: FxHashMap<[u32; 3], (u32, bool)>,
    polygon_ids: FxHashMap<Vec<u32>, (u32, bool)>,
    /// Polygon and parent, in the order of the input.
    parents: Vec<(u32, Parent)>,
    /// Buffer for the edges of one facet.
    directed: Vec<u32>,

    /// The shared plane of the face at hand.
    plane: Option<u32>,
}

impl Builder {
    fn push_face(&mut self, solid: usize, surface: &Surface, face: usize, point_of: &[u32]) {
        let mut loops = surface.face(face);
        if let (1, Some(&[a, b, c])) = (loops.len(), loops.next()) {
            self.push_triangle(solid, face, [a, b, c].map(|v| point_of[v as usize]));
        } else {
            self.push_general_face(solid, surface, face, point_of);
        }
    }

    fn push_triangle(&mut self, solid: usize, face: usize, [a, b, c]: [u32; 3]) {
        if a == b || b == c || c == a {
            self.soup.degenerate += 1;
            return;
        }
        let mut key = [a, b, c];
        key.sort_unstable();
        let reversed = is_reversed(&[a, b, c]);
        if let Some(&(polygon, first_reversed)) = self.triangle_ids.get(&key) {
            self.push_parent(polygon, solid, face, reversed == first_reversed);
            return;
        }
        let polygon = self.soup.polygon_flat.len() as u32;
        if !self.push_triangle_facet([a, b, c], polygon, |_| false) {
            self.soup.degenerate += 1;
            return;
        }
        self.soup.polygon_flat.push(true);
        self.push_parent(polygon, solid, face, true);
        self.triangle_ids.insert(key, (polygon, reversed));
    }

    fn push_general_face(&mut self, solid: usize, surface: &Surface, face: usize, point_of: &[u32]) {
        let mut loops: Vec<Vec<u32>> =
            surface.face(face).map(|l| without_repetition(l.iter().map(|&v| point_of[v as usize]))).collect();
        loops.retain(|l| l.len() >= 3);
        if loops.is_empty() {
            self.soup.degenerate += 1;
            return;
        }
        if let [cycle] = loops.as_slice()
            && let &[a, b, c] = cycle.as_slice()
        {
            self.push_triangle(solid, face, [a, b, c]);
            return;
        }
        let (key, reversed) = (canonical(&loops), is_reversed(&loops[0]));
        if let Some(&(polygon, first_reversed)) = self.polygon_ids.get(&key) {
            self.push_parent(polygon, solid, face, reversed == first_reversed);
            return;
        }
        let polygon = self.soup.polygon_flat.len() as u32;
        let Some(flat) = self.push_polygon(&loops, polygon) else {
            self.soup.degenerate += 1;
            return;
        };
        self.soup.polygon_flat.push(flat);
        self.push_parent(polygon, solid, face, true);
        self.polygon_ids.insert(key, (polygon, reversed));
    }

    fn push_parent(&mut self, polygon: u32, solid: usize, face: usize, same_way: bool) {
        let sign = if same_way { 1 } else { -1 };
        self.parents.push((polygon, Parent { solid: solid as u32, face: face as u32, sign }));
    }

    /// Sorts the parents by polygon; each polygon's stay in the order of the input.
    fn finished(self) -> Soup {
        let mut soup = self.soup;
        let mut offsets = vec![0u32; soup.polygon_flat.len() + 1];
        for (polygon, _) in &self.parents {
            offsets[*polygon as usize + 1] += 1;
        }
        for p in 1..offsets.len() {
            offsets[p] += offsets[p - 1];
        }
        let mut fill = offsets.clone();
        soup.parents = vec![Parent { solid: 0, face: 0, sign: 1 }; self.parents.len()];
        for (polygon, parent) in self.parents {
            let at = &mut fill[polygon as usize];
            soup.parents[*at as usize] = parent;
            *at += 1;
        }
        soup.parent_offsets = offsets;
        soup
    }

    /// Adds the facets of a polygon, and tells whether it counts as planar; `None` when it has no inside.
    fn push_polygon(&mut self, loops: &[Vec<u32>], polygon: u32) -> Option<bool> {
        let views: Vec<&[u32]> = loops.iter().map(Vec::as_slice).collect();
        let shape = Polygon { geometry: &self.soup.geometry, loops: &views, plane: self.plane };
        match shape.shape() {
            Shape::Planar { base, positive } => {
                let edges = loops.iter().flat_map(|l| (0..l.len()).map(|i| [l[i], l[(i + 1) % l.len()]]));
                self.push_edges(edges, polygon, |_| false);
                let geometry = &mut self.soup.geometry;
                match self.plane {
                    Some(plane) => {
                        let (_, up) = geometry.dominant_axis_of_plane(plane);
                        geometry.push_facet_on(base, plane, positive != up);
                    }
                    None => geometry.push_facet(base),
                }
                Some(true)
            }
            Shape::Triangles(triangles) => {
                let deviation = shape.deviation();
                let corners = loops.iter().flatten();
                let flat = deviation <= Tolerance::of(&self.soup.tolerances, corners.copied()).flatness();
                if flat {
                    self.soup.bend = self.soup.bend.max(deviation);
                }
                self.push_triangles(loops, &triangles, polygon, flat).then_some(flat)
            }
            Shape::Degenerate => None,
        }
    }

    fn push_triangles(
        &mut self,
        loops: &[Vec<u32>],
        triangles: &[[u32; 3]],
        polygon: u32,
        flat: bool,
    ) -> bool {
        let mut sides: Vec<[u32; 2]> = loops
            .iter()
            .flat_map(|l| (0..l.len()).map(|i| ascending([l[i], l[(i + 1) % l.len()]])))
            .collect();
        sides.sort_unstable();
        let before = self.soup.n_facets();
        for &[a, b, c] in triangles {
            self.push_triangle_facet([a, b, c], polygon, |e| flat && sides.binary_search(&e).is_err());
        }
        self.soup.triangulated += 1;
        self.soup.n_facets() > before
    }

    /// Adds a triangle; false when its corners are on one line.
    fn push_triangle_facet(
        &mut self,
        [a, b, c]: [u32; 3],
        polygon: u32,
        is_soft: impl Fn([u32; 2]) -> bool,
    ) -> bool {
        if !self.push_plane([a, b, c]) {
            return false;
        }
        self.push_edges([[a, b], [b, c], [c, a]].into_iter(), polygon, is_soft);
        true
    }

    /// Adds the plane of a facet by three corners that turn about its normal: the shared one of the face at hand, when
    /// all three are on it. False, and nothing is added, when they are on one line.
    fn push_plane(&mut self, base: [u32; 3]) -> bool {
        let geometry = &mut self.soup.geometry;
        let plane = self.plane.filter(|&plane| base.iter().all(|&p| geometry.is_defined_on(p, plane)));
        if let Some(plane) = plane {
            let (axis, up) = geometry.dominant_axis_of_plane(plane);
            match geometry.turn_to([base[0], base[1]], base[2], axis) {
                Sign::Zero => return false,
                turn => geometry.push_facet_on(base, plane, (turn == Sign::Positive) != up),
            }
        } else if geometry.are_collinear(base) {
            return false;
        } else {
            geometry.push_facet(base);
        }
        true
    }

    /// Adds the edges of a facet.
    fn push_edges(
        &mut self,
        edges: impl Iterator<Item = [u32; 2]>,
        polygon: u32,
        is_soft: impl Fn([u32; 2]) -> bool,
    ) {
        let mut directed = std::mem::take(&mut self.directed);
        directed.clear();
        directed.extend(edges.map(|[p, q]| {
            let ends = ascending([p, q]);
            let soft = is_soft(ends);
            2 * self.edge(ends, soft) + u32::from(p > q)
        }));
        self.soup.facet_edges.push(&directed);
        self.directed = directed;
        self.soup.facet_polygon.push(polygon);
    }

    fn edge(&mut self, ends: [u32; 2], soft: bool) -> u32 {
        let soup = &mut self.soup;
        let id = *soup.edge_ids.entry(ends).or_insert_with(|| {
            soup.edges.push(ends);
            soup.soft.push(true);
            soup.edges.len() as u32 - 1
        });
        soup.soft[id as usize] &= soft;
        id
    }
}

fn ascending([p, q]: [u32; 2]) -> [u32; 2] {
    [p.min(q), p.max(q)]
}

/// The cyclic list without equal neighbours.
fn without_repetition(cycle: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut out: Vec<u32> = cycle.collect();
    out.dedup();
    while out.len() > 1 && out.first() == out.last() {
        out.pop();
    }
    out
}

/// A key that is equal for polygons with the same loops, wherever these start and whichever way they turn.
fn canonical(loops: &[Vec<u32>]) -> Vec<u32> {
    let mut keys: Vec<Vec<u32>> = loops.iter().map(|l| canonical_cycle(l)).collect();
    keys[1..].sort_unstable();
    keys.join(&u32::MAX)
}

/// The cycle from its smallest entry towards the smaller of that entry's neighbours.
fn canonical_cycle(cycle: &[u32]) -> Vec<u32> {
    let n = cycle.len();
    let start = (0..n).min_by_key(|&i| cycle[i]).expect("loops have corners");
    let reversed = is_reversed(cycle);
    (0..n).map(|i| cycle[if reversed { (start + n - i) % n } else { (start + i) % n }]).collect()
}

/// Whether the canonical form of the cycle runs against it.
fn is_reversed(cycle: &[u32]) -> bool {
    let n = cycle.len();
    let start = (0..n).min_by_key(|&i| cycle[i]).expect("loops have corners");
    cycle[(start + n - 1) % n] < cycle[(start + 1) % n]
}
