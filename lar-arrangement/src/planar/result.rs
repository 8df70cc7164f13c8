//! The driver and the result of a planar arrangement.

use crate::boxes::{Aabb, BoxTree};
use crate::error::ArrangementError;
use crate::grid::Grid;
use crate::parallel::{self, Team};
use crate::planar::assemble::assemble;
use crate::planar::bundles::sample_first;
use crate::planar::carriers::Carriers;
use crate::planar::chains::{Chains, VertexSource};
use crate::planar::crossings::{Crossings, crossings};
use crate::planar::edges::{Edges, NO_EDGE};
use crate::planar::faces::Embedding;
use crate::planar::input::Drawing;
use crate::planar::location::LocationIndex;
use crate::planar::positions::{lengths, positions};
use crate::progress::{Cancel, Control, Course, Plan, Progress};
use crate::stats::Stats;
use crate::subdivision::Cycles;
use crate::winding::Windings;
use lar_core::{Biconnected, Cells, ChainComplex, EdgeId, FaceId, Graph, VertexId};
use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::OnceLock;

/// The stages, and their usual shares in the time.
const PLAN: &Plan = &[
    ("carriers", 10),
    ("crossings", 30),
    ("chains", 22),
    ("cycles", 22),
    ("faces", 6),
    ("complex", 8),
    ("membership", 2),
];

/// What becomes of edges with the same face on both sides: ends that lead nowhere, and bridges between parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dangling {
    /// They are left out, as in the paper.
    #[default]
    Drop,
    /// They are kept.
    Keep,
}

/// Options for a planar arrangement.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlanarArranger<'a> {
    threads: Option<NonZeroUsize>,
    control: Control<'a>,
    pub(super) dangling: Dangling,
    pub(super) keep_isolated: bool,
}

/// The partition of the plane that some segments generate.
///
/// ∂1's columns hold −1 at the smaller vertex and +1 at the larger. Column 0 of ∂2 is the exterior face; a face's
/// column holds the edges of its loops, which keep it on their left (outer loops counter-clockwise, holes
/// clockwise), so every row has one +1 and one −1, or is empty when the edge dangles.
#[derive(Debug)]
pub struct PlanarArrangement {
    pub(super) complex: ChainComplex,
    pub(super) loops: Cells,
    pub(super) face_loops: Vec<u32>,
    pub(super) n_components: usize,
    pub(super) carriers: Carriers,
    pub(super) chains: Chains,
    /// What each vertex is.
    pub(super) sources: Vec<VertexSource>,
    pub(super) grid: Grid,
    pub(super) edge_at: Vec<u32>,
    /// The index for point location, built when it is first asked for.
    pub(super) index: OnceLock<LocationIndex>,
    /// Carrier of each edge: edges of one carrier lie on one line.
    pub(super) carrier_of: Vec<u32>,
    pub(super) regions: Vec<String>,
    pub(super) windings: Windings,
    pub(super) isolated: Vec<(VertexId, FaceId)>,
    pub(super) stats: Stats,
}

/// The arrangement of a drawing with the default options: dangling edges and bridges are left out.
///
/// ```
/// use lar_arrangement::planar::{Drawing, planar_arrangement};
/// let hash = Drawing::from_segments(&[[0., 1., 3., 1.], [0., 2., 3., 2.], [1., 0., 1., 3.], [2., 0., 2., 3.]]);
/// let a = planar_arrangement(&hash)?;
/// assert_eq!((a.n_vertices(), a.n_edges(), a.n_faces()), (4, 4, 1));
/// # Ok::<(), lar_arrangement::ArrangementError>(())
/// ```
///
/// # Errors
/// Points that are not two-dimensional or not finite, segments between points that do not exist.
#[doc(alias = "minimal_2cycles")]
pub fn planar_arrangement(drawing: &Drawing) -> Result<PlanarArrangement, ArrangementError> {
    PlanarArranger::new().arrange(drawing)
}

impl<'a> PlanarArranger<'a> {
    /// The default options: all processors, dangling edges left out.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Limits the number of threads. Without the feature `rayon` there is one.
    #[must_use]
    pub fn threads(mut self, threads: NonZeroUsize) -> Self {
        self.threads = Some(threads);
        self
    }

    /// Keeps or drops edges with the same face on both sides.
    #[must_use]
    pub fn dangling(mut self, dangling: Dangling) -> Self {
        self.dangling = dangling;
        self
    }

    /// Makes vertices of points in which no segment with length ends (points of segments without length, or of no
    /// segment) and that lie on no edge of the result. They are left out by default. A point on an edge splits
    /// nothing, with or without a segment.
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, PlanarArranger};
    /// let dots = Drawing::from_segments(&[[0., 0., 0., 0.], [1., 2., 1., 2.], [1., 2., 1., 2.]]);
    /// let a = PlanarArranger::new().keep_isolated(true).arrange(&dots)?;
    /// assert_eq!((a.n_vertices(), a.n_components(), a.isolated_vertices().len()), (2, 2, 2));
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    #[must_use]
    pub fn keep_isolated(mut self, keep: bool) -> Self {
        self.keep_isolated = keep;
        self
    }

    /// Calls `report` as the work goes on: from the threads at work, but never from two at once. The result does not
    /// depend on it.
    #[must_use]
    pub fn progress(mut self, report: &'a (dyn Fn(Progress) + Sync)) -> Self {
        self.control.report = Some(report);
        self
    }

    /// Gives up with [`ArrangementError::Cancelled`] soon after `cancel` is asked for: within a chunk of work.
    #[must_use]
    pub fn cancel(mut self, cancel: &'a Cancel) -> Self {
        self.control.cancel = Some(cancel);
        self
    }

    /// Computes the arrangement. O((n + k) log n) time and O(n + k) memory for n segments whose boxes meet in k
    /// pairs; pairs through one common point cost no memory.
    ///
    /// # Errors
    /// Points that are not two-dimensional or not finite, segments between points that do not exist; when the
    /// threads cannot be started or the work was cancelled.
    pub fn arrange(&self, drawing: &Drawing) -> Result<PlanarArrangement, ArrangementError> {
        let mut stats = Stats::default();
        let team = Team::new(self.threads);
        let course = Course::new(self.control, PLAN);
        course.begin("carriers", &mut stats)?;
        let (grid, carriers) = team.work(drawing.n_segments(), || on_grid(drawing))??;
        course.begin("crossings", &mut stats)?;
        let n = carriers.ends.len();
        let tree = team
            .work(n, || BoxTree::over(sample_first(&Vec::from_iter(0..n as u32)), |c| carriers.box_of(c)))?;
        let found = crossings(&carriers, &tree, &course, &team)?;
        stats.pairs_tested = found.pairs_tested;
        stats.pairs_crossing = found.crossings.len() as u64;
        let n_edges = n + 2 * found.crossings.len();
        let mut out = team.work(n_edges, || {
            let out = self.complex(grid, carriers, tree, found, (&course, &mut stats))?;
            self.with_regions(out, drawing, (&course, &mut stats))
        })??;
        course.finish(&mut stats);
        out.stats = stats;
        Ok(out)
    }

    /// The complex, without regions and isolated vertices.
    fn complex(
        &self,
        grid: Grid,
        carriers: Carriers,
        tree: BoxTree<2>,
        found: Crossings,
        (course, stats): (&Course, &mut Stats),
    ) -> Result<PlanarArrangement, ArrangementError> {
        course.begin("chains", stats)?;
        let chains = Chains::new(&carriers, found, course)?;
        course.begin("cycles", stats)?;
        let (positions, (edges, cycles, component_of)) =
            parallel::join(|| positions(&carriers, &chains), || self.cycles(&carriers, &chains));
        course.begin("faces", stats)?;
        let embedding = Embedding {
            carriers: &carriers,
            chains: &chains,
            tree: &tree,
            edges: &edges,
            positions: &positions,
        };
        let subdivision = embedding.subdivision(cycles, &component_of, course)?;
        drop((tree, component_of));
        course.begin("complex", stats)?;
        stats.grid_step = grid.step();
        let positions = lengths(&grid, &carriers, &chains, positions);
        Ok(assemble(positions, edges, subdivision, chains, carriers, grid))
    }

    fn with_regions(
        &self,
        mut out: PlanarArrangement,
        drawing: &Drawing,
        (course, stats): (&Course, &mut Stats),
    ) -> Result<PlanarArrangement, ArrangementError> {
        course.begin("membership", stats)?;
        out.wind(drawing);
        if self.keep_isolated {
            out.add_isolated(|_| true);
        }
        Ok(out)
    }

    /// The edges that are kept, the cycles round their faces, and the component of each of their runs.
    fn cycles(&self, carriers: &Carriers, chains: &Chains) -> (Edges, Cycles, Vec<u32>) {
        let n_vertices = chains.vertices.len();
        let edges = Edges::new(chains, |_| true);
        let (cycles, component_of) = edges.cycles(carriers, n_vertices);
        match self.dangling {
            Dangling::Drop => match edges.without_dangling(chains, &cycles) {
                Some(edges) => {
                    drop((cycles, component_of));
                    let (cycles, component_of) = edges.cycles(carriers, n_vertices);
                    (edges, cycles, component_of)
                }
                None => (edges, cycles, component_of),
            },
            Dangling::Keep => (edges, cycles, component_of),
        }
    }
}

/// The grid, and the carriers on it.
fn on_grid(drawing: &Drawing) -> Result<(Grid, Carriers), ArrangementError> {
    let grid = fitted_grid(drawing)?;
    let points = drawing.points.coords();
    let snapped = parallel::map(drawing.points.len(), |i| grid.snap([points[2 * i], points[2 * i + 1]]));
    Ok((grid, Carriers::new(drawing, snapped)))
}

fn fitted_grid(drawing: &Drawing) -> Result<Grid, ArrangementError> {
    if drawing.points.dim() != 2 {
        return Err(ArrangementError::PlanarDimension { dim: drawing.points.dim() });
    }
    let n_vertices = drawing.points.len();
    for (segment, ends) in drawing.segments.iter().enumerate() {
        if let Some(&vertex) = ends.iter().find(|&&p| p as usize >= n_vertices) {
            return Err(ArrangementError::NoSuchPoint { segment, vertex: vertex.into(), n_vertices });
        }
    }
    let (n_chunks, range) = parallel::chunks(n_vertices, 1 << 14);
    let boxes = parallel::map(n_chunks, |chunk| finite_box(drawing, range(chunk)));
    let hull = boxes.into_iter().try_fold(Aabb::EMPTY, |hull, part| part.map(|part| hull.joined(&part)))?;
    let Aabb { lo, hi } = hull;
    let corner = |c: [f64; 2]| if lo[0] <= hi[0] { [c[0], c[1], 0.0] } else { [0.0; 3] };
    Ok(Grid::fitted(corner(lo), corner(hi)))
}

/// The box of some points, which must be finite.
fn finite_box(drawing: &Drawing, range: Range<usize>) -> Result<Aabb<2>, ArrangementError> {
    let mut hull = Aabb::EMPTY;
    for v in range {
        let p = drawing.points.point(v);
        if let Some(&value) = p.iter().find(|x| !x.is_finite()) {
            let solid = "drawing".to_owned();
            return Err(ArrangementError::NotFinite { solid, vertex: (v as u32).into(), value });
        }
        hull = hull.joined(&Aabb { lo: [p[0], p[1]], hi: [p[0], p[1]] });
    }
    Ok(hull)
}

impl PlanarArrangement {
    /// Vertices and the operators ∂1, ∂2.
    #[must_use]
    pub fn complex(&self) -> &ChainComplex {
        &self.complex
    }

    /// Number of vertices.
    #[must_use]
    pub fn n_vertices(&self) -> usize {
        self.complex.n_cells(0)
    }

    /// Number of edges.
    #[must_use]
    pub fn n_edges(&self) -> usize {
        self.complex.n_cells(1)
    }

    /// Number of bounded faces.
    #[must_use]
    pub fn n_faces(&self) -> usize {
        self.complex.n_cells(2) - 1
    }

    /// Biconnected components of the edges, articulation points and bridges. Without dangling edges every component
    /// is a union of cycles, and there are no bridges. O(n log n).
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, planar_arrangement};
    /// let mut drawing = Drawing::new(lar_core::Points::new(2));
    /// drawing.push_polygon("A", &[vec![[0., 0.], [1., 0.], [1., 1.]]]);
    /// drawing.push_polygon("B", &[vec![[1., 1.], [2., 1.], [2., 2.]]]);
    /// let found = planar_arrangement(&drawing)?.biconnected_components();
    /// assert_eq!((found.components.len(), found.articulation_points.len()), (2, 1));
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    #[doc(alias = "biconnectedComponent")]
    #[must_use]
    pub fn biconnected_components(&self) -> Biconnected {
        let graph = Graph::of_complex(&self.complex).expect("edges have two of the vertices as ends");
        graph.biconnected_components()
    }

    /// Number of connected components of the edges, and of isolated vertices.
    #[must_use]
    pub fn n_components(&self) -> usize {
        self.n_components
    }

    /// Number of loops of the bounded faces.
    #[must_use]
    pub fn n_loops(&self) -> usize {
        self.loops.len() - self.face_loops[1] as usize
    }

    /// The loops of a face as half-edges (2 · edge, + 1 from the larger vertex to the smaller).
    pub(super) fn loops_of(&self, face: FaceId) -> impl ExactSizeIterator<Item = &[u32]> + '_ {
        let range = self.face_loops[face.index()] as usize..self.face_loops[face.index() + 1] as usize;
        range.map(|l| &self.loops[l])
    }

    pub(super) fn half_edges(&self, face: FaceId) -> impl Iterator<Item = u32> + '_ {
        self.loops_of(face).flat_map(|cycle| cycle.iter().copied())
    }

    /// The loops of a face, its outer one first (the exterior face 0 has only holes), as vertices.
    pub fn face_vertices(&self, face: FaceId) -> impl ExactSizeIterator<Item = Vec<u32>> + '_ {
        let ends = self.complex.boundary(1).indices();
        self.loops_of(face).map(|cycle| cycle.iter().map(|&h| ends[h as usize]).collect())
    }

    /// Signed area of a face; that of the exterior is minus the sum of the others.
    #[must_use]
    pub fn area(&self, face: FaceId) -> f64 {
        let points = self.complex.points();
        let mut twice = 0.0;
        for cycle in self.face_vertices(face) {
            let o = points.point(cycle[0] as usize);
            for (i, &v) in cycle.iter().enumerate() {
                let (p, q) = (points.point(v as usize), points.point(cycle[(i + 1) % cycle.len()] as usize));
                twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
            }
        }
        twice / 2.0
    }

    /// The edges that an input segment became, in its direction, with the sign of that direction relative to the
    /// edge's; without those that were dropped. Segments without length have none.
    pub fn edges_of(&self, segment: usize) -> impl Iterator<Item = (EdgeId, i8)> + '_ {
        let at = self.carriers.members.binary_search_by_key(&(segment as u32), |m| m.input);
        at.ok().into_iter().flat_map(|i| self.stretch(i))
    }

    fn stretch(&self, member: usize) -> Vec<(EdgeId, i8)> {
        let [from, to] = self.chains.stretches[member].map(|place| place as usize);
        let chain = &self.chains.chain;
        let mut found: Vec<(EdgeId, i8)> = (from..to)
            .filter(|&i| self.edge_at[i] != NO_EDGE)
            .map(|i| (EdgeId(self.edge_at[i]), if chain[i] < chain[i + 1] { 1 } else { -1 }))
            .collect();
        if self.carriers.members[member].reversed {
            found.reverse();
            found.iter_mut().for_each(|(_, sign)| *sign = -*sign);
        }
        found
    }

    /// V − E + F − (1 + components) with the exterior face counted: 0 for every partition of the plane.
    #[must_use]
    pub fn euler(&self) -> i64 {
        self.n_vertices() as i64 - self.n_edges() as i64 + self.n_faces() as i64 - self.n_components as i64
    }

    /// Counts and times of the computation.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        &self.stats
    }
}
