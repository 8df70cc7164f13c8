//! `lar clean`: the arrangement of one surface with itself, and what of it is to stay.

use super::boolean::Fill;
use super::input::operands;
use super::report::{Coplanarity, Json, Moves, Operand, Stages, Threads, arrange};
use super::result::{Counts, Surfaces};
use crate::CommandError;
use crate::bar::Bar;
use crate::output::{check_distinct, check_file};
use lar_arrangement::{Arrangement, Detail, Evaluator, Expression, Solid};
use lar_core::CellId;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

/// A surface that crosses itself, overlaps itself or has loose faces, made into one that bounds a solid.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "The arrangement of the surface with itself is computed, and the cells that the rule takes as \
                        inside are kept; faces with the same cell on both sides go. The rule `outer` needs no \
                        orientation and no closed surface, but it fills cavities; the others need a closed surface, \
                        `nonzero` and `positive` an oriented one.\n\n\
                        Examples:\n  \
                        lar clean scan.stl -o solid.stl\n  \
                        lar clean shell.obj -o solid.obj --rule positive --json -"
)]
pub(crate) struct Clean {
    /// An OBJ, STL, PLY or OFF file.
    #[arg(value_name = "INPUT")]
    input: PathBuf,
    /// Result: triangles in the format of the extension (.obj, .stl, .ply, .off, .glb; OBJ for any other), or, when the
    /// name ends in `.json`, polygons with holes as a chain complex.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// What stays.
    #[arg(long, value_enum, value_name = "RULE", default_value_t)]
    rule: Rule,
    /// Keep the faces as they cut each other, instead of merging those of one plane.
    #[arg(long)]
    keep_fragments: bool,
    #[command(flatten)]
    json: Json,
    #[command(flatten)]
    coplanarity: Coplanarity,
    #[command(flatten)]
    threads: Threads,
}

#[derive(Clone, Copy, Debug, Default, clap::ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Rule {
    /// All that cannot be reached from outside.
    #[default]
    Outer,
    /// Odd winding numbers.
    EvenOdd,
    /// All winding numbers but zero.
    Nonzero,
    /// Winding numbers above zero.
    Positive,
}

impl Rule {
    fn fill(self) -> Option<Fill> {
        match self {
            Self::Outer => None,
            Self::EvenOdd => Some(Fill::EvenOdd),
            Self::Nonzero => Some(Fill::Nonzero),
            Self::Positive => Some(Fill::Positive),
        }
    }
}

#[derive(Debug, Serialize)]
struct Report {
    #[serde(flatten)]
    counts: Counts,
    rule: Rule,
    input: Operand,
    /// Faces of the arrangement with the same cell on both sides; they are not part of the result.
    dangling_faces: usize,
    /// Bounded cells of the arrangement; 1 when the surface neither crosses itself nor has cavities or parts.
    bounded_cells: usize,
    grid_step: f64,
    moved: Moves,
    threads: usize,
    seconds: Seconds,
}

#[derive(Debug, Serialize)]
struct Seconds {
    read: f64,
    /// The whole operation, without reading and writing.
    operation: f64,
    stages: Stages,
}

impl Clean {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        check_distinct([Some(self.output.as_path()), self.json.path()])?;
        check_file(&self.output)?;
        self.json.check()?;
        let operands = operands(std::slice::from_ref(&self.input))?;
        let start = Instant::now();
        let (arrangement, _) = arrange(&operands.surfaces, self.threads, self.coplanarity)?;
        let before = Instant::now();
        let bar = Bar::new();
        let show = |progress| bar.show(progress);
        let detail = if self.keep_fragments { Detail::Fragments } else { Detail::Simplified };
        let evaluator = Evaluator::new().detail(detail).progress(&show);
        let solid = self.solid(&arrangement)?;
        if solid.cells().is_empty() {
            return Err(CommandError::EnclosesNothing { path: self.input.clone() });
        }
        let surfaces = Surfaces::new(&solid, &evaluator, before, self.threads)?;
        drop(bar);
        let operation = start.elapsed();
        surfaces.write(&self.output)?;
        let Some(input) = Operand::all(&arrangement, &operands).pop() else { return Ok(()) };
        let report = Report {
            counts: Counts::new(&arrangement.volumes(), &solid, &surfaces),
            rule: self.rule,
            input,
            dangling_faces: arrangement.dangling_faces().count(),
            bounded_cells: arrangement.n_cells().saturating_sub(1),
            grid_step: arrangement.stats().grid_step,
            moved: Moves::of(arrangement.stats()),
            threads: self.threads.count().get(),
            seconds: Seconds {
                read: operands.read.as_secs_f64(),
                operation: operation.as_secs_f64(),
                stages: Stages::of(arrangement.stats()),
            },
        };
        self.json.deliver("clean", &report, out, |out| {
            writeln!(out, "{}", report.input.facts())?;
            report.counts.print(&self.output.display().to_string(), out)
        })
    }

    fn solid<'a>(&self, arrangement: &'a Arrangement) -> Result<Solid<'a>, CommandError> {
        let Some(fill) = self.rule.fill() else {
            let bounded = (1..).map(CellId).take(arrangement.n_cells().saturating_sub(1));
            return Ok(arrangement.union_of_cells(bounded));
        };
        let expression = Expression::parse("A", &["A"])?;
        let solid = arrangement.boolean(&expression, fill.into());
        solid.map_err(|source| CommandError::Boolean { file: Some(self.input.clone()), source })
    }
}
