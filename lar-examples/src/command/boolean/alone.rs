//! `lar boolean --surface-only`: the surface of one expression, without the cells of the arrangement.

use super::{Boolean, Common, Task};
use crate::CommandError;
use crate::bar::Bar;
use crate::command::input::Operands;
use crate::command::report::{Rounding, arranger};
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
    #[serde(flatten)]
    common: Common<Input>,
}

#[derive(Debug, Serialize)]
struct Input {
    name: String,
    file: String,
    faces: usize,
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
        let surfaces = Surfaces::of(polygons, before.elapsed(), self.threads)?;
        surfaces.write(&self.output)?;
        let is_bounded = !task.expression.evaluate(|_| false);
        let input = |(surface, file): (&lar_core::Surface, &std::path::PathBuf)| Input {
            name: surface.name.clone(),
            file: file.display().to_string(),
            faces: surface.n_faces(),
        };
        let inputs = operands.surfaces.iter().zip(&operands.files).map(input).collect();
        let report = Report {
            counts: SurfaceCounts::alone(&surfaces, is_bounded),
            rounding: surfaces.rounding(iter::empty()),
            expression: task.text.to_owned(),
            common: self.common(&stats, inputs, iter::once(&surfaces), (operands.read, None, start)),
        };
        self.json.deliver("boolean-surface", &report, out, |out| {
            report.counts.print(task.text, out)?;
            report.rounding.line().map_or(Ok(()), |line| writeln!(out, "{line}"))?;
            report.common.seconds.print(out)
        })
    }
}
