//! `lar boolean --surface-only`: the surface of one expression, without the cells of the arrangement.

use super::{Boolean, Fill, Task};
use crate::CommandError;
use crate::bar::Bar;
use crate::command::input::Operands;
use crate::command::report::{Moves, Rounding, Stages, arranger};
use crate::command::result::{SurfaceCounts, Surfaces};
use lar_arrangement::{BooleanError, Detail};
use serde::Serialize;
use std::io::Write;
use std::iter;
use std::time::Instant;

#[derive(Debug, Serialize)]
struct Report {
    #[serde(flatten)]
    counts: SurfaceCounts,
    rounding: Rounding,
    expression: String,
    fill: Fill,
    inputs: Vec<Input>,
    grid_step: f64,
    moved: Moves,
    exact_fallbacks: u64,
    threads: usize,
    seconds: Seconds,
}

#[derive(Debug, Serialize)]
struct Input {
    name: String,
    file: String,
    faces: usize,
}

#[derive(Debug, Serialize)]
struct Seconds {
    read: f64,
    /// The surface as a complex.
    boolean: f64,
    triangulate: f64,
    /// The whole operation, without reading and writing.
    operation: f64,
    /// Until the report is complete.
    total: f64,
    stages: Stages,
}

impl Boolean {
    pub(super) fn run_alone(
        &self,
        task: &Task<'_>,
        operands: &Operands,
        start: Instant,
        out: &mut dyn Write,
    ) -> Result<(), CommandError> {
        let before = Instant::now();
        let bar = Bar::new();
        let show = |progress| bar.show(progress);
        let arranger = arranger(self.threads, self.coplanarity).progress(&show);
        let detail = if self.keep_fragments { Detail::Fragments } else { Detail::Simplified };
        let found = arranger.boolean(&operands.surfaces, &task.expression, self.fill.into(), detail);
        drop(bar);
        let (polygons, stats) = found.map_err(|source| match source {
            BooleanError::Arrangement(error) => error.into(),
            source => CommandError::Boolean { file: operands.file_of(&source), source },
        })?;
        let surfaces = Surfaces::of(polygons, before.elapsed())?;
        surfaces.write(&self.output)?;
        let is_bounded = !task.expression.evaluate(|_| false);
        let input = |(surface, file): (&lar_core::Surface, &std::path::PathBuf)| Input {
            name: surface.name.clone(),
            file: file.display().to_string(),
            faces: surface.n_faces(),
        };
        let report = Report {
            counts: SurfaceCounts::alone(&surfaces, is_bounded),
            rounding: surfaces.rounding(iter::empty()),
            expression: task.text.to_owned(),
            fill: self.fill,
            inputs: operands.surfaces.iter().zip(&operands.files).map(input).collect(),
            grid_step: stats.grid_step,
            moved: Moves::of(&stats),
            exact_fallbacks: stats.exact_fallbacks,
            threads: self.threads.count().get(),
            seconds: Seconds {
                read: operands.read.as_secs_f64(),
                boolean: surfaces.boolean.as_secs_f64(),
                triangulate: surfaces.triangulate.as_secs_f64(),
                operation: (surfaces.boolean + surfaces.triangulate).as_secs_f64(),
                total: start.elapsed().as_secs_f64(),
                stages: Stages::of(&stats),
            },
        };
        self.json.deliver("boolean-surface", &report, out, |out| {
            report.counts.print(task.text, out)?;
            report.rounding.line().map_or(Ok(()), |line| writeln!(out, "{line}"))?;
            let Seconds { read, operation, .. } = report.seconds;
            Ok(writeln!(out, "{read:.3} s to read, {operation:.3} s for the operation")?)
        })
    }
}
