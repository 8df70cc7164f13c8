//! `lar boolean`: Boolean expressions over the inputs, as surfaces.

mod alone;

use super::input::{Operands, operands};
use super::report::{Coplanarity, Json, Moves, Operand, Stages, Threads, arrange};
use super::result::{Counts, Surfaces};
use crate::CommandError;
use crate::bar::Bar;
use crate::output::{check_directory, check_distinct, check_file, write_directory};
use lar_arrangement::{Arrangement, Detail, Evaluator, Expression, FillRule, Stats};
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Boolean expressions over the inputs: the surfaces of the results.
#[derive(Debug, clap::Args)]
#[command(
    override_usage = "lar boolean [OPTIONS] -o OUT <EXPR> <INPUT>...\n       \
                      lar boolean [OPTIONS] -o DIR -e NAME=EXPR... <INPUT>...",
    after_help = "Examples:\n  \
                  lar boolean 'A - (B | C)' a.obj b.stl c.ply -o out.obj\n  \
                  lar boolean 'body - hole' body=plate.stl hole=rod.stl -o out.stl --json -\n  \
                  lar boolean 'A | B | C' a.obj b.obj c.obj -o out.obj --surface-only\n  \
                  lar boolean -e both='A & B' -e rest='A - B' a.obj b.obj -o results --format stl"
)]
pub(crate) struct Boolean {
    /// The expression, then the inputs; the inputs alone when expressions are given by -e. An expression is over the
    /// names of the inputs: `!` complement, `&` intersection, `-` difference, `^` symmetric difference, `|` union, from
    /// the tightest to the loosest, and parentheses. Inputs are OBJ, STL, PLY or OFF files, each one operand: named
    /// A, B, C, … in order, or NAME=PATH.
    #[arg(value_name = "EXPR> <INPUT", required = true)]
    arguments: Vec<PathBuf>,
    /// One of several expressions, all of them evaluated in one arrangement; its result is NAME in the directory OUT.
    #[arg(short, long = "expr", value_name = "NAME=EXPR", value_parser = named_expression)]
    expressions: Vec<(String, String)>,
    /// Result: triangles in the format of the extension (.obj, .stl, .ply, .off, .glb; OBJ for any other), or, when the
    /// name ends in `.json`, polygons with holes as a chain complex. With -e a new directory.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Extension of the results of -e.
    #[arg(long, value_enum, value_name = "EXT", default_value_t, requires = "expressions")]
    format: Extension,
    #[command(flatten)]
    json: Json,
    /// What winding number counts as inside.
    #[arg(long, value_enum, value_name = "RULE", default_value_t)]
    fill: Fill,
    /// Keep the faces as the inputs cut them, instead of merging those of one plane.
    #[arg(long)]
    keep_fragments: bool,
    /// Find the surface of one expression without the cells of the arrangement: the same surface, several times sooner
    /// where many inputs overlap.
    #[arg(long, conflicts_with = "expressions")]
    surface_only: bool,
    #[command(flatten)]
    coplanarity: Coplanarity,
    #[command(flatten)]
    threads: Threads,
}

#[derive(Clone, Copy, Debug, Default, clap::ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Fill {
    /// Odd winding numbers.
    EvenOdd,
    /// All but zero.
    #[default]
    Nonzero,
    /// Above zero.
    Positive,
}

impl From<Fill> for FillRule {
    fn from(fill: Fill) -> Self {
        match fill {
            Fill::EvenOdd => Self::EvenOdd,
            Fill::Nonzero => Self::NonZero,
            Fill::Positive => Self::Positive,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
enum Extension {
    #[default]
    Obj,
    Stl,
    Ply,
    Off,
    Glb,
    /// Polygons with holes as a chain complex.
    Json,
}

/// A name that a file can have, and an expression.
fn named_expression(text: &str) -> Result<(String, String), &'static str> {
    let found = text.split_once('=').filter(|(name, _)| {
        let is_plain = |c: char| c.is_alphanumeric() || "_-.".contains(c);
        !name.is_empty() && !name.starts_with('.') && name.chars().all(is_plain)
    });
    let (name, expression) =
        found.ok_or("a named expression is NAME=EXPR, the name of letters, digits, _, - and .")?;
    Ok((name.to_owned(), expression.to_owned()))
}

/// The JSON of one expression.
#[derive(Debug, Serialize)]
struct Report {
    #[serde(flatten)]
    counts: Counts,
    expression: String,
    #[serde(flatten)]
    common: Common<Operand>,
}

/// The JSON of several.
#[derive(Debug, Serialize)]
struct BatchReport {
    results: Vec<Named>,
    #[serde(flatten)]
    common: Common<Operand>,
}

#[derive(Debug, Serialize)]
struct Named {
    name: String,
    file: String,
    expression: String,
    #[serde(flatten)]
    counts: Counts,
}

/// What every report says, with what is known of the inputs.
#[derive(Debug, Serialize)]
struct Common<I> {
    fill: Fill,
    inputs: Vec<I>,
    grid_step: f64,
    moved: Moves,
    exact_fallbacks: u64,
    threads: usize,
    seconds: Seconds,
}

#[derive(Debug, Serialize)]
struct Seconds {
    read: f64,
    /// Of an arrangement with all cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    arrange: Option<f64>,
    /// Surfaces as complexes; of all cells, after their choice.
    boolean: f64,
    triangulate: f64,
    /// The whole operation, without reading and writing.
    operation: f64,
    /// Until the report is complete.
    total: f64,
    stages: Stages,
}

/// Names and texts of expressions.
type Texts<'a> = Vec<(&'a str, &'a str)>;

/// An expression: its name, its text, itself.
struct Task<'a> {
    name: &'a str,
    text: &'a str,
    expression: Expression,
}

impl Boolean {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let start = Instant::now();
        check_distinct([Some(self.output.as_path()), self.json.path()])?;
        let is_batch = !self.expressions.is_empty();
        if is_batch {
            check_directory(&self.output)?;
        } else {
            check_file(&self.output)?;
        };
        self.json.check()?;
        let (texts, inputs) = self.split()?;
        let operands = operands(inputs)?;
        let names = operands.names();
        let task = |&(name, text)| Ok(Task { name, text, expression: Expression::parse(text, &names)? });
        let tasks: Vec<Task<'_>> = texts.iter().map(task).collect::<Result<_, CommandError>>()?;
        if self.surface_only {
            return self.run_alone(&tasks[0], &operands, start, out);
        }
        let (arrangement, time) = arrange(&operands.surfaces, self.threads, self.coplanarity)?;
        let mut results = self.results(&tasks, &arrangement, &operands)?;
        let surfaces = results.iter().map(|(_, surfaces)| surfaces);
        let inputs = Operand::all(&arrangement, &operands);
        let common = self.common(arrangement.stats(), inputs, surfaces, (operands.read, Some(time), start));
        if is_batch {
            self.write_batch(&tasks, results, common, out)
        } else {
            self.write_single(tasks[0].text, results.remove(0), common, out)
        }
    }

    /// Names and texts of the expressions, and the inputs.
    fn split(&self) -> Result<(Texts<'_>, &[PathBuf]), CommandError> {
        if !self.expressions.is_empty() {
            let mut names: Vec<&str> = self.expressions.iter().map(|(name, _)| name.as_str()).collect();
            names.sort_unstable();
            if let Some(w) = names.windows(2).find(|w| w[0] == w[1]) {
                return Err(CommandError::Usage(format!("two expressions are named {}", w[0])));
            }
            let texts = self.expressions.iter().map(|(name, text)| (name.as_str(), text.as_str()));
            return Ok((texts.collect(), &self.arguments));
        }
        match self.arguments.as_slice() {
            [_] | [] => {
                Err(CommandError::Usage("an expression and at least one input are needed".to_owned()))
            }
            [expression, inputs @ ..] => match expression.to_str() {
                Some(text) => Ok((vec![("", text)], inputs)),
                None => Err(CommandError::Usage("the expression is no Unicode text".to_owned())),
            },
        }
    }

    fn results(
        &self,
        tasks: &[Task<'_>],
        arrangement: &Arrangement,
        operands: &Operands,
    ) -> Result<Vec<(Counts, Surfaces)>, CommandError> {
        let detail = if self.keep_fragments { Detail::Fragments } else { Detail::Simplified };
        let bar = Bar::new();
        let show = |progress| bar.show(progress);
        let evaluator = Evaluator::new().fill(self.fill.into()).detail(detail).progress(&show);
        let volumes = arrangement.volumes();
        let result = |task: &Task<'_>| {
            let before = Instant::now();
            let solid = evaluator
                .solid(arrangement, &task.expression)
                .map_err(|source| CommandError::Boolean { file: operands.file_of(&source), source })?;
            let surfaces = Surfaces::new(&solid, &evaluator, before, self.threads)?;
            Ok((Counts::new(&volumes, &solid, &surfaces), surfaces))
        };
        tasks.iter().map(result).collect()
    }

    fn common<'a, I>(
        &self,
        stats: &Stats,
        inputs: Vec<I>,
        surfaces: impl Iterator<Item = &'a Surfaces> + Clone,
        (read, arrange, start): (Duration, Option<Duration>, Instant),
    ) -> Common<I> {
        let boolean: Duration = surfaces.clone().map(|s| s.boolean).sum();
        let triangulate: Duration = surfaces.map(|s| s.triangulate).sum();
        Common {
            fill: self.fill,
            inputs,
            grid_step: stats.grid_step,
            moved: Moves::of(stats),
            exact_fallbacks: stats.exact_fallbacks,
            threads: self.threads.count().get(),
            seconds: Seconds {
                read: read.as_secs_f64(),
                arrange: arrange.map(|time| time.as_secs_f64()),
                boolean: boolean.as_secs_f64(),
                triangulate: triangulate.as_secs_f64(),
                operation: (arrange.unwrap_or_default() + boolean + triangulate).as_secs_f64(),
                total: start.elapsed().as_secs_f64(),
                stages: Stages::of(stats),
            },
        }
    }

    fn write_single(
        &self,
        text: &str,
        (counts, surfaces): (Counts, Surfaces),
        common: Common<Operand>,
        out: &mut dyn Write,
    ) -> Result<(), CommandError> {
        surfaces.write(&self.output)?;
        let report = Report { counts, expression: text.to_owned(), common };
        self.json.deliver("boolean", &report, out, |out| {
            report.counts.print(text, out)?;
            report.common.seconds.print(out)
        })
    }

    fn write_batch(
        &self,
        tasks: &[Task<'_>],
        results: Vec<(Counts, Surfaces)>,
        common: Common<Operand>,
        out: &mut dyn Write,
    ) -> Result<(), CommandError> {
        let file = |task: &Task<'_>, dir: &Path| dir.join(format!("{}.{}", task.name, self.extension()));
        write_directory(&self.output, |dir| {
            tasks.iter().zip(&results).try_for_each(|(task, (_, surfaces))| surfaces.write(&file(task, dir)))
        })?;
        let named = |(task, (counts, _)): (&Task<'_>, (Counts, Surfaces))| Named {
            name: task.name.to_owned(),
            file: file(task, &self.output).display().to_string(),
            expression: task.text.to_owned(),
            counts,
        };
        let report = BatchReport { results: tasks.iter().zip(results).map(named).collect(), common };
        self.json.deliver("boolean-batch", &report, out, |out| {
            for result in &report.results {
                result.counts.print(&format!("{} = {}", result.name, result.expression), out)?;
            }
            report.common.seconds.print(out)
        })
    }

    fn extension(&self) -> &'static str {
        match self.format {
            Extension::Obj => "obj",
            Extension::Stl => "stl",
            Extension::Ply => "ply",
            Extension::Off => "off",
            Extension::Glb => "glb",
            Extension::Json => "json",
        }
    }
}

impl Seconds {
    fn print(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        writeln!(out, "{:.3} s to read, {:.3} s for the operation", self.read, self.operation)?;
        Ok(())
    }
}
