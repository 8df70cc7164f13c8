//! Parts that the reports of several commands share.

use crate::CommandError;
use crate::bar::Bar;
use crate::output::Sink;
use lar_arrangement::{Arrangement, ArrangementError, Arranger, Closure, Merge, Planes, Stats};
use lar_core::{CellId, ChainComplex, Surface};
use lar_triangle::{Defects, Triangulation, triangulate};
use serde::{Serialize, Serializer};
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Where the report of a command goes.
#[derive(Debug, clap::Args)]
pub(crate) struct Json {
    /// Write a report as JSON to a file, or with `-` to the standard output; docs/formats.md has its fields.
    #[arg(long = "json", value_name = "PATH")]
    json: Option<PathBuf>,
}

impl Json {
    pub(crate) fn path(&self) -> Option<&Path> {
        self.json.as_deref()
    }

    fn sink(&self) -> Option<Sink> {
        self.path().map(Sink::from)
    }

    /// Refuses a place that cannot be written.
    pub(crate) fn check(&self) -> Result<(), CommandError> {
        self.sink().as_ref().map_or(Ok(()), Sink::check)
    }

    /// Writes the report where it was asked for, and prints unless the standard output has the report.
    pub(crate) fn deliver(
        &self,
        name: &'static str,
        report: &impl Serialize,
        out: &mut dyn Write,
        print: impl FnOnce(&mut dyn Write) -> Result<(), CommandError>,
    ) -> Result<(), CommandError> {
        let sink = self.sink();
        if let Some(sink) = &sink {
            sink.write(name, report, out)?;
        }
        if matches!(sink, Some(Sink::Standard)) { Ok(()) } else { print(out) }
    }
}

/// How many threads a command uses.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Threads {
    /// Number of threads; all processors when not given. The result does not depend on it.
    #[arg(long = "threads", value_name = "N", value_parser = threads, allow_hyphen_values = true)]
    threads: Option<NonZeroUsize>,
}

impl Threads {
    pub(crate) fn count(self) -> NonZeroUsize {
        self.threads.unwrap_or_else(processors)
    }

    /// Triangulates the faces of a complex, by no more threads than there are processors.
    pub(crate) fn triangulate(self, complex: &ChainComplex) -> Result<Triangulation, CommandError> {
        if processors() <= self.count() {
            return Ok(triangulate(complex)?);
        }
        let threads = self.count().get();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|e| ArrangementError::Threads { threads, reason: e.to_string() })?;
        Ok(pool.install(|| triangulate(complex))?)
    }
}

fn processors() -> NonZeroUsize {
    std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

/// What becomes of faces that are nearly coplanar.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Coplanarity {
    /// Leave nearly coplanar faces and nearly equal vertices where they are. Without it they are unified as far as the
    /// rounding of the files explains.
    #[arg(long)]
    as_given: bool,
    /// Unify nearly coplanar faces of coordinates that are off by up to this length.
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, conflicts_with = "as_given", allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Make faces of one input that lie side by side in one plane one face: the triangles of a square, a square.
    #[arg(long)]
    merge_coplanar: bool,
}

impl Coplanarity {
    fn merge(self) -> Merge {
        if self.merge_coplanar { Merge::Coplanar } else { Merge::Nothing }
    }

    fn planes(self) -> Planes {
        match (self.as_given, self.tolerance) {
            (true, _) => Planes::AsGiven,
            (false, Some(length)) => Planes::Within(length),
            (false, None) => Planes::Canonical,
        }
    }
}

fn tolerance(text: &str) -> Result<f64, &'static str> {
    let length = text.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0);
    length.ok_or("a tolerance is a length of at least 0")
}

/// The arrangement of the surfaces, and the time it took.
pub(crate) fn arrange(
    surfaces: &[Surface],
    threads: Threads,
    coplanarity: Coplanarity,
) -> Result<(Arrangement, Duration), CommandError> {
    let start = Instant::now();
    let bar = Bar::new();
    let show = |progress| bar.show(progress);
    let arrangement = arranger(threads, coplanarity).progress(&show).arrange(surfaces)?;
    Ok((arrangement, start.elapsed()))
}

/// The options of a command.
pub(crate) fn arranger(threads: Threads, coplanarity: Coplanarity) -> Arranger<'static> {
    let arranger = Arranger::new().planes(coplanarity.planes()).merge(coplanarity.merge());
    arranger.threads(threads.count())
}

/// What was moved so that nearly coplanar faces are coplanar.
#[derive(Debug, Serialize)]
pub(crate) struct Moves {
    planes: u64,
    points: u64,
    /// The farthest move, in the files' unit.
    farthest: f64,
}

impl Moves {
    pub(crate) fn of(stats: &Stats) -> Self {
        Self { planes: stats.canonical_planes, points: stats.moved_points, farthest: stats.farthest_move }
    }

    /// A line about them, when there are any.
    pub(crate) fn line(&self) -> Option<String> {
        let points = counted(usize::try_from(self.points).unwrap_or(usize::MAX), "point");
        (self.points > 0).then(|| {
            format!("{points} moved by up to {:.1e}, onto {} common planes", self.farthest, self.planes)
        })
    }
}

/// What rounding of exact positions to 64 bits did: all zero when the rounded complex is embedded as the exact one is.
#[derive(Debug, Serialize)]
pub(crate) struct Rounding {
    /// Faces whose rounded loops fold, touch or have no area: they have triangles, but no planar triangulation.
    folded_faces: usize,
    /// Triangles that look against the exact normal of their face.
    inverted_triangles: usize,
    /// Triangles without area.
    degenerate_triangles: usize,
    /// Bounded cells without a positive volume.
    flat_cells: usize,
}

impl Rounding {
    pub(crate) fn new(
        triangulation: &Triangulation,
        defects: Defects,
        volumes: impl Iterator<Item = f64>,
    ) -> Self {
        Self {
            folded_faces: triangulation.fallbacks,
            inverted_triangles: defects.inverted,
            degenerate_triangles: defects.degenerate,
            flat_cells: volumes.filter(|volume| *volume <= 0.0).count(),
        }
    }

    /// A line about it, when there is anything.
    pub(crate) fn line(&self) -> Option<String> {
        let triangles = self.inverted_triangles + self.degenerate_triangles;
        (self.folded_faces + triangles + self.flat_cells > 0).then(|| {
            let counts = [
                counted(self.folded_faces, "folded face"),
                counted(self.inverted_triangles, "inverted triangle"),
                counted(self.degenerate_triangles, "degenerate triangle"),
                counted(self.flat_cells, "flat cell"),
            ];
            format!("after rounding: {}", counts.join(", "))
        })
    }
}

fn threads(text: &str) -> Result<NonZeroUsize, &'static str> {
    text.parse().map_err(|_| "a number of threads is a whole number of at least 1")
}

/// An operand in a report.
#[derive(Debug, Serialize)]
pub(crate) struct Operand {
    name: String,
    file: String,
    faces: usize,
    closure: &'static str,
    /// Edges of the arrangement where an open surface ends.
    open_edges: usize,
    /// Least and greatest winding number in a cell: 0 and 1 when the surface is closed, does not cross itself and its
    /// faces look outwards.
    windings: [i32; 2],
    /// Sum over the cells of winding number times volume: what the divergence theorem gives for the input itself.
    signed_volume: f64,
}

impl Operand {
    pub(crate) fn all(arrangement: &Arrangement, operands: &super::input::Operands) -> Vec<Self> {
        let volumes = arrangement.volumes();
        let one = |(solid, (surface, file)): (usize, (&Surface, &PathBuf))| {
            let windings = || (0..).map(CellId).take(volumes.len()).map(|c| arrangement.winding(c, solid));
            Self {
                name: surface.name.clone(),
                file: file.display().to_string(),
                faces: surface.n_faces(),
                closure: match arrangement.closure(solid) {
                    Closure::Closed => "closed",
                    Closure::Unoriented => "unoriented",
                    Closure::Open => "open",
                },
                open_edges: match arrangement.closure(solid) {
                    Closure::Open => arrangement.open_edges(solid).len(),
                    Closure::Closed | Closure::Unoriented => 0,
                },
                windings: windings().fold([0, 0], |[lo, hi], w| [lo.min(w), hi.max(w)]),
                signed_volume: windings().zip(&volumes).map(|(w, volume)| f64::from(w) * volume).sum(),
            }
        };
        operands.surfaces.iter().zip(&operands.files).enumerate().map(one).collect()
    }

    /// A line about the operand.
    pub(crate) fn facts(&self) -> String {
        let [lo, hi] = self.windings;
        let faces = counted(self.faces, "face");
        format!("{}: {faces}, {}, winding numbers {lo} to {hi}", self.file, self.closure)
    }

    /// What a reader should know of an operand that is not a proper solid.
    pub(crate) fn warning(&self) -> Option<String> {
        match self.closure {
            "open" => {
                let edges = counted(self.open_edges, "boundary edge");
                Some(format!("{} ({}) is open, it has {edges}: no cell is inside it", self.name, self.file))
            }
            "unoriented" => Some(format!("{} ({}) is not oriented consistently", self.name, self.file)),
            _ => None,
        }
    }
}

/// Seconds of each stage of an arrangement, in their order.
#[derive(Debug)]
pub(crate) struct Stages(Vec<(&'static str, Duration)>);

impl Stages {
    pub(crate) fn of(stats: &Stats) -> Self {
        Self(stats.stages.clone())
    }
}

impl Serialize for Stages {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, time)| (name, time.as_secs_f64())))
    }
}

/// A line for each law, and whether it holds.
pub(crate) fn print_laws(laws: &[(&str, bool)], out: &mut dyn Write) -> Result<(), CommandError> {
    for (law, holds) in laws {
        writeln!(out, "{law}: {}", if *holds { "yes" } else { "NO" })?;
    }
    Ok(())
}

/// `1 face`, `2 faces`.
pub(crate) fn counted(n: usize, noun: &str) -> String {
    let ending = if n == 1 { "" } else { "s" };
    match noun.strip_suffix("ex") {
        Some(stem) if n != 1 => format!("{n} {stem}ices"),
        _ => format!("{n} {noun}{ending}"),
    }
}

#[cfg(test)]
mod tests {
    use super::counted;

    #[test]
    fn plurals() {
        let texts = [counted(1, "vertex"), counted(2, "vertex"), counted(1, "face"), counted(0, "face")];
        assert_eq!(texts, ["1 vertex", "2 vertices", "1 face", "0 faces"]);
    }
}
