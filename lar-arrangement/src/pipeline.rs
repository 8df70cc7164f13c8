//! The driver: surfaces in, arrangement out, stage by stage.

use crate::arrangement::Arrangement;
use crate::assemble::{Operators, Shells, assemble};
use crate::canonical::{self, Report, Scan, Tolerance};
use crate::check;
use crate::coplanar::{self, Overlay};
use crate::crossing::{self, Contacts, Scratch};
use crate::dissolve::{self, Dissolved};
use crate::error::ArrangementError;
use crate::fragment::{Extent, Fragmenter, Fragments, Groups, Room};
use crate::meeting::Meeting;
use crate::nest::Nesting;
use crate::parallel::{self, Team};
use crate::progress::{Cancel, Cancelled, Control, Course, Plan, Progress};
use crate::rays::Rays;
use crate::skeleton::Skeleton;
use crate::soup::{Placed, Soup};
use crate::split::Cuts;
use crate::stats::Stats;
use crate::tiles::{self, Merge};
use crate::union_find::UnionFind;
use crate::vertices::Vertices;
use crate::wrap;
use lar_core::{Cells, Precision, Surface};
use std::mem::take;
use std::num::NonZeroUsize;

/// A face of the input, and then a pair of facets, count as so many things that a step handles: an operation of few takes
/// no longer on one thread. With debug assertions small ones are divided all the same, so that tests see it.
const WORK_A_FACE: usize = if cfg!(debug_assertions) { 1 << 15 } else { 128 };
const WORK_A_PAIR: usize = 32;

/// Pairs of facets a chunk of work.
const PAIRS_A_CHUNK: usize = 2048;
/// Groups of facets a chunk of work.
const GROUPS_A_CHUNK: usize = 64;

/// The stages, and their usual shares in the time.
const PLAN: &Plan = &[
    ("soup", 8),
    ("pairs", 16),
    ("planes", 24),
    ("contacts", 18),
    ("fragmentation", 14),
    ("congruence", 6),
    ("gift wrapping", 4),
    ("nesting", 2),
    ("membership", 4),
    ("complex", 4),
];

/// Whether the post-conditions of every stage are tested as it ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Checks {
    /// No tests; the algorithms do not need them.
    #[default]
    Off,
    /// All of them; a failure is an error that names the stage.
    EveryStage,
}

/// What becomes of facets that lie nearly, but not exactly, in one plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Planes {
    /// They are put into one plane where rounding explains the difference: half a grid step, or half a unit in the last
    /// place of the coordinates' source (`Surface::precision`).
    #[default]
    Canonical,
    /// The same, for coordinates that are off by up to this length.
    Within(f64),
    /// They stay where the grid has them.
    AsGiven,
}

/// Numbers of fewer digits, like 0.5, are taken to be meant exactly.
const SHORT: u32 = 6;

/// Options for an arrangement.
///
/// ```
/// use lar_arrangement::Arranger;
/// use lar_core::{cuboid_grid, t, Struct};
/// let cube = cuboid_grid(&[1, 1, 1]);
/// let scene = Struct::new("two cubes").with(cube.clone()).with(t(&[0.5, 0.5, 0.5])).with(cube);
/// let surfaces: Vec<_> = scene.eval_struct()?.iter().map(|m| m.to_surface()).collect::<Result<_, _>>()?;
/// let arrangement = Arranger::new().arrange(&surfaces)?;
/// assert_eq!((arrangement.n_vertices(), arrangement.n_edges()), (22, 36));
/// assert_eq!((arrangement.n_faces(), arrangement.n_cells()), (18, 4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Arranger<'a> {
    pub(crate) threads: Option<NonZeroUsize>,
    checks: Checks,
    planes: Planes,
    merge: Merge,
    pub(crate) control: Control<'a>,
}

/// The arrangement of some surfaces with the default options.
///
/// Input surfaces may cross, touch, overlap, repeat, be open, cross themselves. The result is exact for the input
/// snapped to a grid of 2^-40 of its half-extent, and the same for any number of threads.
///
/// # Errors
/// Points that are not three-dimensional or not finite, faces that name vertices that do not exist.
#[doc(alias("spatial_arrangement", "spaceindex", "frag_face"))]
#[doc(alias = "arrangement3D")]
pub fn arrange(surfaces: &[Surface]) -> Result<Arrangement, ArrangementError> {
    Arranger::new().arrange(surfaces)
}

impl<'a> Arranger<'a> {
    /// The default options: all processors, no checks.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Limits the number of threads: of a limit above the number of processors and 64, no more are started. Those of the
    /// last operation that had more than one wait for the next one with the same number. Without the feature `rayon` there
    /// is one.
    #[must_use]
    pub fn threads(mut self, threads: NonZeroUsize) -> Self {
        self.threads = Some(threads);
        self
    }

    /// Tests the post-conditions of the stages.
    #[must_use]
    pub fn checks(mut self, checks: Checks) -> Self {
        self.checks = checks;
        self
    }

    /// Decides about facets that are nearly coplanar.
    ///
    /// ```
    /// use lar_arrangement::{Arranger, Planes};
    /// use lar_core::{cuboid_grid, rotation, t, Struct};
    /// let cube = cuboid_grid(&[1, 1, 1]);
    /// let turn = rotation([1.0, 2.0, 3.0], 0.7)?;
    /// let stacked = Struct::new("stacked").with(turn).with(cube.clone()).with(t(&[1.0, 0.0, 0.0])).with(cube);
    /// let surfaces: Vec<_> = stacked.eval_struct()?.iter().map(|m| m.to_surface()).collect::<Result<_, _>>()?;
    /// let touching = Arranger::new().arrange(&surfaces)?;
    /// assert_eq!((touching.n_faces(), touching.n_cells()), (11, 3));
    /// assert!(touching.stats().farthest_move < 1e-11);
    /// let as_given = Arranger::new().planes(Planes::AsGiven).arrange(&surfaces)?;
    /// assert_eq!(as_given.stats().canonical_planes, 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn planes(mut self, planes: Planes) -> Self {
        self.planes = planes;
        self
    }

    /// Decides about faces of one surface that lie side by side in one plane.
    ///
    /// ```
    /// use lar_arrangement::{Arranger, Merge};
    /// let cube = lar_core::cuboid_grid(&[1, 1, 1]).to_triangle_mesh()?;
    /// let cube = lar_core::Surface::from_triangles("cube", &cube);
    /// let merged = Arranger::new().merge(Merge::Coplanar).arrange(&[cube])?;
    /// assert_eq!((merged.n_edges(), merged.n_faces()), (12, 6));
    /// assert_eq!(merged.parents(lar_core::FaceId(0)).len(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn merge(mut self, merge: Merge) -> Self {
        self.merge = merge;
        self
    }

    /// Calls `report` as the work goes on: from the threads at work, but never from two at once. The result does not
    /// depend on it.
    ///
    /// ```
    /// use lar_arrangement::{Arranger, Progress};
    /// let cube = lar_core::cuboid_grid(&[1, 1, 1]).to_surface("cube")?;
    /// let last = std::sync::Mutex::new(0.0);
    /// let report = |progress: Progress| *last.lock().unwrap() = progress.fraction;
    /// Arranger::new().progress(&report).arrange(&[cube])?;
    /// assert_eq!(*last.lock().unwrap(), 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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

    /// Computes the arrangement. O((n + k + m) log) time and O(n + k + m) memory for n facets, k pairs of facets
    /// that meet and m cells out.
    ///
    /// Vertices, edges and faces are numbered as they first occur: in the order of the surfaces, or, of 1,024 surfaces with
    /// 131,072 faces and more, along a space-filling curve through their boxes.
    ///
    /// # Errors
    /// Points that are not three-dimensional or not finite, faces that name vertices that do not exist; with
    /// checks, a post-condition that does not hold; when the threads cannot be started or the work was cancelled.
    pub fn arrange(&self, surfaces: &[Surface]) -> Result<Arrangement, ArrangementError> {
        self.with_pairs(surfaces, PLAN, |soup, meeting, stats, course| {
            let mut out = self.arranged(surfaces, soup, meeting, Operators::All, (stats, course))?;
            course.finish(&mut out.stats);
            self.check(|| check::arrangement(&out))?;
            Ok(out)
        })
    }

    /// Finds the facets and their pairs, and goes on with `rest`, on as many threads as they are worth.
    pub(crate) fn with_pairs<R: Send, E: From<ArrangementError> + Send>(
        &self,
        surfaces: &[Surface],
        plan: &'static Plan,
        rest: impl FnOnce(Soup, Meeting, Stats, &Course) -> Result<R, E> + Send,
    ) -> Result<R, E> {
        let team = Team::new(self.threads);
        let of_faces = WORK_A_FACE.saturating_mul(surfaces.iter().map(Surface::n_faces).sum());
        team.work(of_faces, || {
            let (mut stats, course) = (Stats::default(), Course::new(self.control, plan));
            let (soup, meeting) = self.soup_and_pairs(surfaces, &mut stats, &course)?;
            let of_pairs = WORK_A_PAIR.saturating_mul(meeting.pairs.len());
            team.work(of_faces.max(of_pairs), || rest(soup, meeting, stats, &course))?
        })?
    }

    /// Stages 2 to 6 for all cells.
    pub(crate) fn arranged(
        &self,
        surfaces: &[Surface],
        mut soup: Soup,
        meeting: Meeting,
        operators: Operators,
        (mut stats, course): (Stats, &Course),
    ) -> Result<Arrangement, ArrangementError> {
        let (mut skeleton, rings) =
            self.skeleton(&mut soup, (&meeting.pairs, Extent::Everywhere), &mut stats, course)?;
        let (shell_of_side, n_shells) = wrap::shells(&rings, skeleton.n_faces());
        self.check(|| check::shells(&skeleton, &shell_of_side))?;
        course.begin("nesting", &mut stats)?;
        let rays = Rays {
            skeleton: &skeleton,
            geometry: &soup.geometry,
            rings: &rings,
            boxes: meeting.boxes(&soup),
        };
        let nesting = Nesting { rays, shell_of_side: &shell_of_side, n_shells };
        let (cell_of_shell, n_cells) = nesting.cells(course)?;
        drop(meeting);
        course.begin("membership", &mut stats)?;
        let dissolved = self.dissolved(&mut skeleton, rings, &soup);
        let shells = Shells { of_side: &shell_of_side, n: n_shells, cell_of: &cell_of_shell, n_cells };
        Ok(assemble(surfaces, soup, skeleton, dissolved, &shells, operators, (stats, course))?)
    }

    /// Stages 2 to 4: the faces, and their order around the edges.
    pub(crate) fn skeleton(
        &self,
        soup: &mut Soup,
        (pairs, extent): (&[[u32; 2]], Extent),
        stats: &mut Stats,
        course: &Course,
    ) -> Result<(Skeleton, Cells), ArrangementError> {
        if self.merge == Merge::Coplanar {
            tiles::soften(soup);
        }
        course.begin("contacts", stats)?;
        let mut contacts = contacts(soup, pairs, course)?;
        stats.pairs_tested = pairs.len() as u64;
        stats.pairs_crossing = contacts.iter().map(|chunk| chunk.crossing_pairs).sum();
        let overlapping = overlapping(soup, &mut contacts, course)?;
        let mut vertices = Vertices::new(&soup.geometry, take(&mut soup.point_ids));
        let cuts = Cuts::new(soup, contacts, &mut vertices);
        let groups = Groups::new(soup, &cuts, overlapping);
        self.check(|| check::cuts(soup, &cuts, &vertices.list))?;
        stats.coplanar_groups = groups.n_overlapping();
        course.begin("fragmentation", stats)?;
        let fragmenter =
            Fragmenter { soup, cuts: &cuts, vertices: &vertices.list, extent, course: course.quiet() };
        let fragments = fragments(&fragmenter, &groups, course)?;
        course.begin("congruence", stats)?;
        let skeleton = Skeleton::new(fragments, &groups, vertices, soup, &cuts);
        self.check(|| check::skeleton(&skeleton, &soup.geometry))?;
        course.begin("gift wrapping", stats)?;
        let rings = wrap::rings(&skeleton, &soup.geometry);
        Ok((skeleton, rings))
    }

    pub(crate) fn dissolved(&self, skeleton: &mut Skeleton, rings: Cells, soup: &Soup) -> Dissolved {
        if skeleton.has_soft_edges() {
            dissolve::dissolve(skeleton, &rings, soup, self.merge)
        } else {
            dissolve::unchanged(skeleton, rings)
        }
    }

    /// Stage 1, and the pairs of facets whose boxes meet and that may have more in common than neighbours in a mesh.
    fn soup_and_pairs(
        &self,
        surfaces: &[Surface],
        stats: &mut Stats,
        course: &Course,
    ) -> Result<(Soup, Meeting), ArrangementError> {
        course.begin("soup", stats)?;
        let placed = Placed::snapped(surfaces, |surface, size| self.error(surface, size))?;
        let largest = Tolerance::largest(&placed.tolerances);
        let reach = if self.planes == Planes::AsGiven { 0.0 } else { largest.planes() };
        let distance = largest.points();
        let mut soup = Soup::new(surfaces, placed);
        course.begin("pairs", stats)?;
        let mut meeting = Meeting::new(&soup, distance, reach, course)?;
        if self.planes == Planes::AsGiven {
            return Ok((soup, meeting));
        }
        course.begin("planes", stats)?;
        let mut report = Report::default();
        let mut scan = Scan::new(&meeting.input(&soup), course)?;
        if let Some(placed) = canonical::merged_points(&meeting.input(&soup), &scan, &mut report) {
            soup = Soup::new(surfaces, placed);
            meeting = Meeting::new(&soup, distance, reach, course)?;
            scan = Scan::new(&meeting.input(&soup), course)?;
        }
        if let Some(placed) = canonical::on_planes(&meeting.input(&soup), &scan, &mut report) {
            soup = Soup::new(surfaces, placed);
            meeting = Meeting::new(&soup, distance, 0.0, course)?;
        }
        stats.canonical_planes = report.planes;
        stats.moved_points = report.moved;
        stats.farthest_move = report.farthest * soup.grid.step();
        Ok((soup, meeting))
    }

    /// By what length a coordinate of some magnitude may be off because of where it comes from.
    fn error(&self, surface: &Surface, size: f64) -> f64 {
        match (self.planes, surface.precision) {
            (Planes::AsGiven, _) => 0.0,
            (Planes::Within(length), _) => length,
            (Planes::Canonical, Precision::Decimal { significant, .. }) if significant < SHORT => 0.0,
            (Planes::Canonical, precision) => precision.rounding_error(size),
        }
    }

    fn check(&self, test: impl FnOnce() -> Result<(), check::Failure>) -> Result<(), ArrangementError> {
        match self.checks {
            Checks::Off => Ok(()),
            Checks::EveryStage => {
                test().map_err(|f| ArrangementError::PostCondition { stage: f.stage, what: f.what })
            }
        }
    }
}

/// Chunk by chunk.
fn contacts(soup: &Soup, pairs: &[[u32; 2]], course: &Course) -> Result<Vec<Contacts>, Cancelled> {
    let (n_chunks, range) = parallel::chunks(pairs.len(), PAIRS_A_CHUNK);
    course.map(n_chunks, |chunk| {
        let (mut out, mut scratch) = (Contacts::default(), Scratch::default());
        for &[f, g] in &pairs[range(chunk)] {
            crossing::meet(soup, f, g, &mut scratch, &mut out);
        }
        out.close();
        out
    })
}

/// The sets of facets that overlap in one plane. What these have in common besides is added to the contacts.
fn overlapping(soup: &Soup, contacts: &mut Vec<Contacts>, course: &Course) -> Result<UnionFind, Cancelled> {
    let pairs: Vec<[u32; 2]> = contacts.iter_mut().flat_map(|chunk| take(&mut chunk.coplanar)).collect();
    let (n_chunks, range) = parallel::chunks(pairs.len(), PAIRS_A_CHUNK);
    let parts = course.map(n_chunks, |chunk| {
        let (mut out, mut overlay) = (Contacts::default(), Overlay::default());
        let overlapping =
            pairs[range(chunk)].iter().filter(|pair| coplanar::meet(soup, **pair, &mut overlay, &mut out));
        let overlapping: Vec<[u32; 2]> = overlapping.copied().collect();
        out.close();
        (overlapping, out)
    })?;
    let mut sets = UnionFind::new(soup.n_facets());
    for (overlapping, part) in parts {
        contacts.push(part);
        overlapping.into_iter().for_each(|[f, g]| _ = sets.union(f, g));
    }
    Ok(sets)
}

fn fragments(
    fragmenter: &Fragmenter<'_>,
    groups: &Groups,
    course: &Course,
) -> Result<Vec<Fragments>, Cancelled> {
    let (n_chunks, range) = parallel::chunks(groups.members.len(), GROUPS_A_CHUNK);
    course.map(n_chunks, |chunk| {
        let (mut out, mut room) = (fragmenter.room_for(&groups.members, range(chunk)), Room::default());
        // Groups after one that was cancelled change nothing: the whole stage is.
        let _ = range(chunk)
            .try_for_each(|group| fragmenter.fragment(&groups.members[group], &mut room, &mut out));
        out
    })
}
