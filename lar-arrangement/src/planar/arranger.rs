//! The driver of a planar arrangement, and its options.

use crate::boxes::{Aabb, BoxTree};
use crate::error::ArrangementError;
use crate::grid::Grid;
use crate::parallel::{self, Team};
use crate::planar::assemble::assemble;
use crate::planar::bundles::{Bundles, sample_first};
use crate::planar::carriers::Carriers;
use crate::planar::chains::Chains;
use crate::planar::crossings::{Crossings, crossings};
use crate::planar::edges::Edges;
use crate::planar::faces::Embedding;
use crate::planar::input::Drawing;
use crate::planar::points::unify;
use crate::planar::positions::positions;
use crate::planar::result::PlanarArrangement;
use crate::progress::{Cancel, Control, Course, Plan, Progress};
use crate::stats::Stats;
use crate::subdivision::Cycles;
use std::num::NonZeroUsize;
use std::ops::Range;

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

/// What becomes of points in which no segment with length ends (points of segments without length, or of no segment) and
/// that lie on no edge of the result. A point on an edge splits nothing, with or without a segment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Isolated {
    /// They are left out.
    #[default]
    Drop,
    /// They are vertices without edges.
    Keep,
}

/// Options for a planar arrangement.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlanarArranger<'a> {
    threads: Option<NonZeroUsize>,
    control: Control<'a>,
    pub(super) dangling: Dangling,
    pub(super) isolated: Isolated,
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

    /// Limits the number of threads. Those of the last operation that had more than one wait for the next one with the same
    /// number. Without the feature `rayon` there is one.
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

    /// Keeps or drops points without edges.
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, Isolated, PlanarArranger};
    /// let dots = Drawing::from_segments(&[[0., 0., 0., 0.], [1., 2., 1., 2.], [1., 2., 1., 2.]]);
    /// let a = PlanarArranger::new().isolated(Isolated::Keep).arrange(&dots)?;
    /// assert_eq!((a.n_vertices(), a.n_components(), a.isolated_vertices().len()), (2, 2, 2));
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    #[must_use]
    pub fn isolated(mut self, isolated: Isolated) -> Self {
        self.isolated = isolated;
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
        let tree = || BoxTree::over(sample_first(&Vec::from_iter(0..n as u32)), |c| carriers.box_of(c));
        let (tree, bundles) = team.work(n, || parallel::join(tree, || Bundles::of_fans(&carriers)))?;
        let found = crossings(&carriers, &tree, bundles, &course, &team)?;
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
        let (edges, cycles, component_of, positions) = self.cycles(&carriers, &chains);
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
        if self.isolated == Isolated::Keep {
            out.add_isolated(|_| true);
        }
        Ok(out)
    }

    /// The edges that are kept, the cycles round their faces, the component of each of their runs, and the positions of
    /// the vertices.
    fn cycles(&self, carriers: &Carriers, chains: &Chains) -> (Edges, Cycles, Vec<u32>, Vec<[f64; 2]>) {
        let n_vertices = chains.vertices.len();
        let edges = Edges::new(chains, |_| true);
        let (cycles, component_of, positions) =
            edges.cycles(carriers, n_vertices, || positions(carriers, chains));
        match self.dangling {
            Dangling::Drop => match edges.without_dangling(chains, &cycles) {
                Some(edges) => {
                    drop((cycles, component_of));
                    let (cycles, component_of, ()) = edges.cycles(carriers, n_vertices, || ());
                    (edges, cycles, component_of, positions)
                }
                None => (edges, cycles, component_of, positions),
            },
            Dangling::Keep => (edges, cycles, component_of, positions),
        }
    }
}

/// The grid, and the carriers on it.
fn on_grid(drawing: &Drawing) -> Result<(Grid, Carriers), ArrangementError> {
    let hull = hull(drawing)?;
    let corners = [hull.lo, hull.hi].map(|c| if hull.lo[0] <= hull.hi[0] { c } else { [0.0; 2] });
    let [lo, hi] = corners.map(|[x, y]| [x, y, 0.0]);
    let grid = Grid::fitted(lo, hi);
    let coordinates = drawing.points.coords();
    let at = |i: usize| [coordinates[2 * i], coordinates[2 * i + 1]];
    let (points, point_of) = unify(drawing.points.len(), |i| at(i) == at(i - 1), |i| grid.snap(at(i)));
    // What is left of another point stays left of it.
    let hull = Aabb::around(corners.map(|c| grid.snap(c).map(|x| x as f64)));
    Ok((grid, Carriers::new(drawing, points, &point_of, &hull)))
}

/// The box of the drawing's points, once they are known to be two-dimensional, finite, and all that segments name.
fn hull(drawing: &Drawing) -> Result<Aabb<2>, ArrangementError> {
    if drawing.points.dim() != 2 {
        return Err(ArrangementError::PlanarDimension { dim: drawing.points.dim() });
    }
    let n_vertices = drawing.points.len();
    let (n_chunks, range) = parallel::chunks(drawing.segments.len(), 1 << 14);
    let missing = parallel::map(n_chunks, |chunk| {
        range(chunk).find_map(|segment| {
            let vertex = drawing.segments[segment].into_iter().find(|&p| p as usize >= n_vertices);
            vertex.map(|vertex| (segment, vertex.into()))
        })
    });
    if let Some(&(segment, vertex)) = missing.iter().flatten().next() {
        return Err(ArrangementError::NoSuchPoint { segment, vertex, n_vertices });
    }
    let (n_chunks, range) = parallel::chunks(n_vertices, 1 << 14);
    let boxes = parallel::map(n_chunks, |chunk| finite_box(drawing, range(chunk)));
    boxes.into_iter().try_fold(Aabb::EMPTY, |hull, part| part.map(|part| hull.joined(&part)))
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
