//! Stage 1: surfaces → points on the integer grid, edges, and facets with exact planes and provenance.
//!
//! Equal grid points are one point; polygons with the same corners are one polygon with several parents. Holds
//! afterwards: each facet is exactly planar, its edges are in one table, and an edge is *soft* when it is only a
//! diagonal inside a polygon.

mod doubles;
mod parents;

use crate::boxes::Aabb;
use crate::canonical::Tolerance;
use crate::counting::offsets as offsets_of_lengths;
use crate::curve;
use crate::error::ArrangementError;
use crate::grid::Grid;
use crate::grid_points::{PointTable, Unified};
use crate::half_edges::{self, HalfEdges, MANY};
use crate::kernel::{Geometry, Sign};
use crate::parallel;
use crate::polygon::{Polygon, Shape};
use lar_core::{Cells, Surface};
use rustc_hash::FxHashMap;

pub use parents::Parent;
pub(crate) use parents::Parents;

/// Points a chunk of work.
const POINTS_A_CHUNK: usize = 1 << 12;

/// Surfaces are put in order when they are so many: fewer are large, and each is in some order of its own.
const MANY_SURFACES: usize = 1 << 10;
/// And when they have so many faces: what belongs to fewer fits into the caches of a processor, wherever it is.
const MANY_FACES: usize = 1 << 17;

/// The vertices of the input in their places.
#[derive(Debug)]
pub(crate) struct Placed {
    pub grid: Grid,
    pub geometry: Geometry,
    pub point_ids: PointTable,
    /// The point of each vertex of each surface.
    pub point_of: Vec<Vec<u32>>,
    /// How far each point may lie from where it was meant to be.
    pub tolerances: Vec<Tolerance>,
    /// The shared plane of each face of each surface; empty when there is none.
    pub plane_of_face: Vec<Vec<Option<u32>>>,
    /// The order in which the vertices and faces of the surfaces are numbered.
    pub order: Vec<u32>,
}

impl Placed {
    /// Snaps and unifies; refuses non-finite coordinates and indices out of range. `error` says by what length a
    /// coordinate of some magnitude may be off in a surface.
    pub(crate) fn snapped(
        surfaces: &[Surface],
        error: impl Fn(&Surface, f64) -> f64 + Sync + Send,
    ) -> Result<Self, ArrangementError> {
        let hulls = surfaces.iter().map(checked).collect::<Result<Vec<Aabb>, _>>()?;
        let all = hulls.iter().fold(Aabb::EMPTY, |all, hull| all.joined(hull));
        let grid = fitted_grid(&all);
        // The vertices of all surfaces are numbered one after the other.
        let order = order_of(surfaces, &hulls, &all);
        let nth = |i: usize| &surfaces[order[i] as usize];
        let begins = offsets_of_lengths((0..order.len()).map(|i| nth(i).points.len() as u32));
        let snapped = parallel::map_lists(&begins, |i, v| grid.snap(nth(i).points.xyz(v)));
        let Unified { table, points, number } = Unified::new(snapped);
        let (least, step) = (Tolerance::new(grid.coarseness() / 2.0), grid.step());
        let mut tolerances = parallel::map_lists(&begins, |i, v| {
            let size = nth(i).points.xyz(v).iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            least.max(Tolerance::new(error(nth(i), size) / step))
        });
        if !number.is_empty() {
            let mut of_points = vec![Tolerance::default(); points.len()];
            for (&id, own) in number.iter().zip(tolerances) {
                of_points[id as usize] = of_points[id as usize].max(own);
            }
            tolerances = of_points;
        }
        let mut point_of = vec![Vec::new(); surfaces.len()];
        for (range, &surface) in begins.windows(2).zip(&order) {
            point_of[surface as usize] = match number.get(range[0] as usize..range[1] as usize) {
                Some(of) => of.to_vec(),
                None => (range[0]..range[1]).collect(),
            };
        }
        Ok(Self {
            grid,
            geometry: Geometry::new(points),
            point_ids: table,
            point_of,
            tolerances,
            plane_of_face: Vec::new(),
            order,
        })
    }
}

/// The input on the grid.
#[derive(Debug)]
pub(crate) struct Soup {
    pub geometry: Geometry,
    pub grid: Grid,
    /// Ends of each edge, the smaller first.
    pub edges: Vec<[u32; 2]>,
    /// Whether each edge is only a diagonal inside a nearly planar polygon; empty when none is.
    soft: Vec<bool>,
    /// Directed edges of each facet: 2 · edge + (1 when from the larger end to the smaller).
    pub facet_edges: Cells,
    /// For each edge the facet that runs along it and the one that runs against it, or `NONE` or `MANY`.
    pub facets_of_edge: Vec<[u32; 2]>,
    /// The polygon that each facet is (a piece of).
    pub facet_polygon: Vec<u32>,
    parents: Parents,
    /// Whether a polygon is planar, exactly or within the tolerance.
    pub polygon_flat: Vec<bool>,
    /// The shared plane that each polygon was meant to lie in, whether or not its corners could be put there; empty when
    /// there are none.
    pub polygon_plane: Vec<Option<u32>>,
    /// Grid points by their coordinates.
    pub point_ids: PointTable,
    /// The point of each vertex of each surface.
    pub point_of: Vec<Vec<u32>>,
    /// How far each point may lie from where it was meant to be.
    pub tolerances: Vec<Tolerance>,
    /// The order in which the vertices and faces of the surfaces were numbered.
    pub order: Vec<u32>,
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
        let Placed { grid, geometry, point_ids, point_of, tolerances, plane_of_face, order } = placed;
        let mut builder = Builder {
            geometry,
            tolerances: &tolerances,
            facets: Facets { offsets: vec![0], ..Facets::default() },
            polygon_flat: Vec::new(),
            polygon_plane: Vec::new(),
            first_parents: Vec::new(),
            other_parents: Vec::new(),
            polygon_ids: FxHashMap::default(),
            degenerate: 0,
            triangulated: 0,
            bend: 0.0,
            plane: None,
        };
        builder.reserve(surfaces.iter().map(Surface::n_faces).sum());
        for solid in order.iter().map(|&solid| solid as usize) {
            let (surface, point_of) = (&surfaces[solid], &point_of[solid]);
            let planes = plane_of_face.get(solid).map_or(&[][..], Vec::as_slice);
            match surface.triangles() {
                Some(corners) if builder.geometry.is_on_grid() => {
                    builder.push_triangles_of(solid, corners, point_of);
                }
                _ => builder.push_faces(solid, surface, point_of, planes),
            }
        }
        let coefficients_of =
            |surface: &Surface| parallel::map_light(surface.n_faces(), |f| surface.coefficient(f));
        let Builder { geometry, facets, polygon_flat, polygon_plane, .. } = builder;
        let Builder { first_parents, other_parents, degenerate, triangulated, bend, .. } = builder;
        let (edges, directed) = half_edges::edges(geometry.n_points(), facets.half_edges(&geometry));
        let soft = facets.soft_edges(edges.len(), &directed);
        let facet_edges = Cells::from_parts(facets.offsets, directed);
        let facets_of_edge = half_edges::facets_of_edges(edges.len(), &facet_edges);
        let soup = Self {
            geometry,
            grid,
            edges,
            soft,
            facet_edges,
            facets_of_edge,
            facet_polygon: facets.polygon,
            parents: Parents::with_others(first_parents, other_parents),
            polygon_flat,
            polygon_plane,
            point_ids,
            point_of,
            tolerances,
            order,
            coefficients: surfaces.iter().map(coefficients_of).collect(),
            degenerate,
            triangulated,
            bend,
        };
        let doubles = doubles::of(&soup);
        if doubles.is_empty() { soup } else { doubles::dropped(soup, &doubles) }
    }

    /// Whether an edge is only a diagonal inside a nearly planar polygon.
    pub(crate) fn is_soft(&self, edge: u32) -> bool {
        !self.soft.is_empty() && self.soft[edge as usize]
    }

    pub(crate) fn has_soft_edges(&self) -> bool {
        !self.soft.is_empty()
    }

    /// Makes an edge one that may disappear.
    pub(crate) fn soften(&mut self, edge: u32) {
        self.soft.resize(self.edges.len(), false);
        self.soft[edge as usize] = true;
    }

    /// Whether two facets were meant to lie in one plane: they do, or they are of one cluster.
    pub(crate) fn is_meant_coplanar(&self, f: u32, g: u32) -> bool {
        let plane =
            |f: u32| self.polygon_plane.get(self.facet_polygon[f as usize] as usize).copied().flatten();
        (plane(f).is_some() && plane(f) == plane(g)) || self.geometry.is_coplanar(f, g)
    }

    pub(crate) fn n_facets(&self) -> usize {
        self.facet_polygon.len()
    }

    /// Whether no facet has more than three edges.
    pub(crate) fn are_triangles(&self) -> bool {
        self.facet_edges.indices().len() == 3 * self.n_facets()
    }

    /// Whether a facet has three edges.
    pub(crate) fn is_triangle(&self, facet: u32) -> bool {
        self.facet_edges[facet as usize].len() == 3
    }

    /// Whether every polygon is a triangle.
    pub(crate) fn are_lone_triangles(&self) -> bool {
        self.are_triangles() && self.polygon_flat.len() == self.n_facets()
    }

    /// Where in a facet's list the edge stands that goes on where edge i ends.
    pub(crate) fn next_in_loop(&self, edges: &[u32], i: usize) -> usize {
        if edges.len() == 3 {
            return (i + 1) % 3;
        }
        let [_, head] = self.directed(edges[i]);
        let starts_there = |&e: &u32| self.directed(e)[0] == head;
        if edges.get(i + 1).is_some_and(starts_there) {
            return i + 1;
        }
        edges.iter().position(starts_there).expect("loops close within the facet's list")
    }

    /// First and last point of a directed edge.
    pub(crate) fn directed(&self, edge: u32) -> [u32; 2] {
        let [a, b] = self.edges[(edge / 2) as usize];
        if edge.is_multiple_of(2) { [a, b] } else { [b, a] }
    }

    /// The input edges with ends among the pairs in `wanted`, the smaller first. O(edges + pairs).
    pub(crate) fn edges_between(&self, wanted: impl Iterator<Item = [u32; 2]>) -> FxHashMap<[u32; 2], u32> {
        let mut is_wanted = vec![false; self.geometry.n_points()];
        let mut any = false;
        for [low, _] in wanted {
            is_wanted[low as usize] = true;
            any = true;
        }
        let edges = if any { self.edges.as_slice() } else { &[] };
        edges.iter().copied().zip(0..).filter(|([low, _], _)| is_wanted[*low as usize]).collect()
    }

    /// What crossing a face, from its front to its back, adds to the winding number of one of its parents' solid.
    pub(crate) fn jump(&self, parent: &Parent) -> i32 {
        i32::from(parent.sign) * i32::from(self.coefficients[parent.solid as usize][parent.face as usize])
    }

    /// Whether the facets of each of some solids, by their coefficients in its boundary, are a cycle: edge by edge. A
    /// surface whose edges only overlap may be closed all the same. O(n log m) for m edges between several solids.
    pub(crate) fn are_cycles(&self, solids: &[usize]) -> bool {
        let balanced = |&[along, against]: &[u32; 2]| {
            let sole = |facet: u32| match self.parents(facet) {
                [parent] => Some((parent.solid, self.jump(parent))),
                _ => None,
            };
            along < MANY && against < MANY && sole(along).is_some_and(|a| Some(a) == sole(against))
        };
        let is_open: Vec<bool> = self.facets_of_edge.iter().map(|users| !balanced(users)).collect();
        let mut uses: Vec<(u32, u32, i32)> = Vec::new();
        for (codes, facet) in self.facet_edges.iter().zip(0..) {
            for &code in codes.iter().filter(|&code| is_open[(code / 2) as usize]) {
                let way = if code % 2 == 0 { 1 } else { -1 };
                uses.extend(self.parents(facet).iter().map(|p| (code / 2, p.solid, way * self.jump(p))));
            }
        }
        uses.retain(|&(_, solid, _)| solids.binary_search(&(solid as usize)).is_ok());
        uses.sort_unstable();
        uses.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).all(|same| same.iter().map(|u| u.2).sum::<i32>() == 0)
    }

    /// A number that is equal for facets of one polygon that is meant to be planar.
    pub(crate) fn plane_class(&self, facet: u32) -> u32 {
        let polygon = self.facet_polygon[facet as usize];
        if self.polygon_flat[polygon as usize] { polygon } else { self.polygon_flat.len() as u32 + facet }
    }

    /// Lets go of what only stages 1 to 4 need: the edges, and how exact the points are.
    pub(crate) fn drop_edges(&mut self) {
        self.edges = Vec::new();
        self.facet_edges = Cells::new();
        self.facets_of_edge = Vec::new();
        self.point_of = Vec::new();
        self.tolerances = Vec::new();
        self.polygon_plane = Vec::new();
    }

    /// Parents of a facet.
    pub(crate) fn parents(&self, facet: u32) -> &[Parent] {
        self.polygon_parents(self.facet_polygon[facet as usize])
    }

    /// The parent of a facet, where all polygons have one.
    pub(crate) fn only_parent(&self, facet: u32) -> &Parent {
        debug_assert!(self.has_single_parents());
        &self.parents.of(self.facet_polygon[facet as usize] as usize)[0]
    }

    /// Whether all polygons have one parent.
    pub(crate) fn has_single_parents(&self) -> bool {
        self.parents.are_single()
    }

    /// Parents of a polygon.
    pub(crate) fn polygon_parents(&self, polygon: u32) -> &[Parent] {
        self.parents.of(polygon as usize)
    }
}

/// The box around the points of a surface; refuses points that are not three-dimensional or not finite, and faces with
/// corners that do not exist.
fn checked(surface: &Surface) -> Result<Aabb, ArrangementError> {
    if surface.points.dim() != 3 {
        return Err(ArrangementError::Dimension { solid: surface.name.clone(), dim: surface.points.dim() });
    }
    let (all, n) = (hull(surface)?, surface.points.len());
    let are_known = |corners: &[u32]| parallel::all(corners.len(), |i| (corners[i] as usize) < n);
    if surface.triangles().is_some_and(are_known) {
        return Ok(all);
    }
    for face in 0..surface.n_faces() {
        if let Some(&vertex) = surface.face(face).flatten().find(|&&v| v as usize >= n) {
            return Err(ArrangementError::NoSuchVertex {
                solid: surface.name.clone(),
                face: (face as u32).into(),
                vertex: vertex.into(),
                n_vertices: n,
            });
        }
    }
    Ok(all)
}

fn fitted_grid(all: &Aabb) -> Grid {
    let is_empty = all.lo[0] > all.hi[0];
    if is_empty { Grid::fitted([0.0; 3], [0.0; 3]) } else { Grid::fitted(all.lo, all.hi) }
}

/// The order in which the vertices and faces of surfaces are numbered: that of the input, or where there are many that of a
/// space-filling curve. What is near each other in space then lies near each other in memory, too.
fn order_of(surfaces: &[Surface], hulls: &[Aabb], all: &Aabb) -> Vec<u32> {
    let n = surfaces.len();
    if n < MANY_SURFACES || surfaces.iter().map(Surface::n_faces).sum::<usize>() < MANY_FACES {
        return (0..n as u32).collect();
    }
    curve::z_order(all, n, |i| hulls[i as usize])
}

/// The box around the points of a surface; refuses those that are not finite.
fn hull(surface: &Surface) -> Result<Aabb, ArrangementError> {
    let (n_chunks, range) = parallel::chunks(surface.points.len(), POINTS_A_CHUNK);
    let hulls = parallel::map(n_chunks, |chunk| {
        range(chunk).try_fold(Aabb::EMPTY, |all, v| {
            let at = surface.points.xyz(v);
            match at.iter().find(|x| !x.is_finite()) {
                Some(x) => Err((v, *x)),
                None => Ok(all.joined(&Aabb { lo: at, hi: at })),
            }
        })
    });
    let all = hulls.into_iter().try_fold(Aabb::EMPTY, |all, hull| hull.map(|hull| all.joined(&hull)));
    all.map_err(|(v, value)| ArrangementError::NotFinite {
        solid: surface.name.clone(),
        vertex: (v as u32).into(),
        value,
    })
}

/// Facets as they come.
#[derive(Default)]
struct Facets {
    /// The half-edges of facet f are `offsets[f]..offsets[f + 1]`.
    offsets: Vec<u32>,
    /// From where to where the half-edges lead; nothing as long as they are those of the bases.
    ends: Option<[Vec<u32>; 2]>,
    /// Half-edges that are diagonals inside a polygon, ascending.
    soft: Vec<u32>,
    polygon: Vec<u32>,
}

impl Facets {
    fn n_half_edges(&self) -> u32 {
        self.offsets.last().copied().unwrap_or(0)
    }

    fn half_edges<'a>(&'a self, geometry: &'a Geometry) -> HalfEdges<'a> {
        match &self.ends {
            Some([tails, heads]) => HalfEdges::Listed { tails, heads },
            None => HalfEdges::OfTriangles(geometry.bases()),
        }
    }

    /// The ends of the half-edges, to be added to.
    fn listed(&mut self, geometry: &Geometry) -> &mut [Vec<u32>; 2] {
        self.ends.get_or_insert_with(|| {
            let mut ends = Default::default();
            push_ends(&mut ends, &geometry.bases()[..self.polygon.len()]);
            ends
        })
    }

    /// Adds the newest facets of a geometry, n triangles, each a polygon of its own.
    fn push_triangles(&mut self, n: usize, geometry: &Geometry, first_polygon: u32) {
        let begin = self.n_half_edges();
        u32::try_from(begin as usize + 3 * n).expect("fewer than 2^32 half-edges");
        if let Some(ends) = &mut self.ends {
            push_ends(ends, &geometry.bases()[self.polygon.len()..]);
        }
        let n = n as u32;
        let (offsets, polygon) = (&mut self.offsets, &mut self.polygon);
        parallel::join(
            || offsets.extend((1..=n).map(|i| begin + 3 * i)),
            || polygon.extend(first_polygon..first_polygon + n),
        );
    }

    /// Adds a facet, which the geometry has or is given next, and returns its half-edges.
    fn push(
        &mut self,
        half_edges: impl Iterator<Item = [u32; 2]>,
        geometry: &Geometry,
        polygon: u32,
    ) -> std::ops::Range<u32> {
        let first = self.n_half_edges();
        let [tails, heads] = self.listed(geometry);
        for [p, q] in half_edges {
            tails.push(p);
            heads.push(q);
        }
        let end = u32::try_from(tails.len()).expect("fewer than 2^32 half-edges");
        self.offsets.push(end);
        self.polygon.push(polygon);
        first..end
    }

    /// Whether each edge is a diagonal in all its facets.
    fn soft_edges(&self, n_edges: usize, directed: &[u32]) -> Vec<bool> {
        if self.soft.is_empty() {
            return Vec::new();
        }
        let mut soft = vec![true; n_edges];
        let mut rest = self.soft.as_slice();
        for (&code, h) in directed.iter().zip(0u32..) {
            match rest.split_first() {
                Some((&first, after)) if first == h => rest = after,
                _ => soft[(code / 2) as usize] = false,
            }
        }
        soft
    }
}

/// Adds the tails and the heads of the half-edges of triangles.
fn push_ends([tails, heads]: &mut [Vec<u32>; 2], corners: &[[u32; 3]]) {
    tails.extend_from_slice(corners.as_flattened());
    heads.extend(corners.iter().flat_map(|&[a, b, c]| [b, c, a]));
}

struct Builder<'a> {
    geometry: Geometry,
    tolerances: &'a [Tolerance],
    facets: Facets,
    polygon_flat: Vec<bool>,
    polygon_plane: Vec<Option<u32>>,
    /// The face that each polygon was made for.
    first_parents: Vec<Parent>,
    /// Faces with the corners of one before, each with its polygon.
    other_parents: Vec<(u32, Parent)>,
    polygon_ids: FxHashMap<Vec<u32>, (u32, bool)>,
    degenerate: u32,
    triangulated: u32,
    bend: f64,
    /// The shared plane of the face at hand.
    plane: Option<u32>,
}

impl Builder<'_> {
    /// Makes room for so many faces: what grows is copied, and touches memory anew.
    fn reserve(&mut self, n: usize) {
        self.geometry.reserve_facets(n);
        self.facets.offsets.reserve(n);
        self.facets.polygon.reserve(n);
        self.polygon_flat.reserve(n);
        self.first_parents.reserve(n);
    }

    /// The faces of a surface of triangles on the grid.
    fn push_triangles_of(&mut self, solid: usize, corners: &[u32], point_of: &[u32]) {
        let n = corners.len() / 3;
        let point = |corner: usize| point_of[corners[corner] as usize];
        let proper = self.geometry.push_grid_facets(n, |i| [0, 1, 2].map(|k| point(3 * i + k)));
        let n_proper = proper.as_ref().map_or(n, Vec::len);
        self.degenerate += (n - n_proper) as u32;
        let polygon = self.polygon_flat.len() as u32;
        self.facets.push_triangles(n_proper, &self.geometry, polygon);
        parallel::extend_light(&mut self.first_parents, n_proper, |i| {
            let face = proper.as_ref().map_or(i as u32, |faces| faces[i]);
            Parent { solid: solid as u32, face, sign: 1 }
        });
        self.polygon_flat.resize(polygon as usize + n_proper, true);
    }

    fn push_faces(&mut self, solid: usize, surface: &Surface, point_of: &[u32], planes: &[Option<u32>]) {
        for face in 0..surface.n_faces() {
            self.plane = planes.get(face).copied().flatten();
            let mut loops = surface.face(face);
            if let (1, Some(&[a, b, c])) = (loops.len(), loops.next()) {
                self.push_triangle(solid, face, [a, b, c].map(|v| point_of[v as usize]));
            } else {
                self.push_general_face(solid, surface, face, point_of);
            }
        }
    }

    fn push_triangle(&mut self, solid: usize, face: usize, corners: [u32; 3]) {
        let [a, b, c] = corners;
        let polygon = self.polygon_flat.len() as u32;
        if a == b || b == c || c == a || !self.push_triangle_facet(corners, polygon, |_| false) {
            self.degenerate += 1;
            return;
        }
        self.polygon_flat.push(true);
        self.push_meant_plane();
        self.first_parents.push(parent_of(solid, face, true));
    }

    /// Notes the plane that the newest polygon was meant to lie in.
    fn push_meant_plane(&mut self) {
        if !self.geometry.is_on_grid() {
            self.polygon_plane.push(self.plane);
        }
    }

    fn push_general_face(&mut self, solid: usize, surface: &Surface, face: usize, point_of: &[u32]) {
        let mut loops: Vec<Vec<u32>> =
            surface.face(face).map(|l| without_repetition(l.iter().map(|&v| point_of[v as usize]))).collect();
        loops.retain(|l| l.len() >= 3);
        if loops.is_empty() {
            self.degenerate += 1;
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
            self.other_parents.push((polygon, parent_of(solid, face, reversed == first_reversed)));
            return;
        }
        let polygon = self.polygon_flat.len() as u32;
        let Some(flat) = self.push_polygon(&loops, polygon) else {
            self.degenerate += 1;
            return;
        };
        self.polygon_flat.push(flat);
        self.push_meant_plane();
        self.first_parents.push(parent_of(solid, face, true));
        self.polygon_ids.insert(key, (polygon, reversed));
    }

    /// Adds the facets of a polygon, and tells whether it counts as planar; `None` when it has no inside.
    fn push_polygon(&mut self, loops: &[Vec<u32>], polygon: u32) -> Option<bool> {
        let views: Vec<&[u32]> = loops.iter().map(Vec::as_slice).collect();
        let shape = Polygon { geometry: &self.geometry, loops: &views, plane: self.plane };
        match shape.shape() {
            Shape::Planar { base, positive } => {
                let edges = loops.iter().flat_map(|l| (0..l.len()).map(|i| [l[i], l[(i + 1) % l.len()]]));
                self.push_edges(edges, polygon, |_| false);
                let geometry = &mut self.geometry;
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
                let flat = deviation <= Tolerance::of(self.tolerances, corners.copied()).flatness();
                if flat {
                    self.bend = self.bend.max(deviation);
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
        let before = self.facets.polygon.len();
        for &[a, b, c] in triangles {
            self.push_triangle_facet([a, b, c], polygon, |e| flat && sides.binary_search(&e).is_err());
        }
        self.triangulated += 1;
        self.facets.polygon.len() > before
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
        let geometry = &mut self.geometry;
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
        let mut diagonals = Vec::new();
        let noted = edges.enumerate().inspect(|&(i, ends)| {
            if is_soft(ascending(ends)) {
                diagonals.push(i as u32);
            }
        });
        let pushed = self.facets.push(noted.map(|(_, ends)| ends), &self.geometry, polygon);
        self.facets.soft.extend(diagonals.into_iter().map(|i| pushed.start + i));
    }
}

fn parent_of(solid: usize, face: usize, same_way: bool) -> Parent {
    Parent { solid: solid as u32, face: face as u32, sign: if same_way { 1 } else { -1 } }
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

/// A key that is equal for polygons with the same loops or their opposites, wherever these start.
fn canonical(loops: &[Vec<u32>]) -> Vec<u32> {
    let key = |l: &Vec<u32>| {
        let mut key = canonical_cycle(l);
        key.extend([u32::MAX, u32::from(is_reversed(l) == is_reversed(&loops[0]))]);
        key
    };
    let mut keys: Vec<Vec<u32>> = loops.iter().map(key).collect();
    keys[1..].sort_unstable();
    keys.concat()
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
