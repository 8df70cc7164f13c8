//! `lar boolean`: a Boolean expression over the inputs, as a surface.

use super::input::{Inputs, Operands, is_json};
use super::report::{Coplanarity, Moves, Operand, Stages, Threads, arrange, counted};
use crate::CommandError;
use crate::output::{Sink, check_distinct, check_file};
use lar_arrangement::{Arrangement, Detail, Expression, FillRule, Solid, SolidComplex};
use lar_core::{FaceId, MeshFormat, TriangleMesh, write_mesh};
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// A Boolean expression over the inputs: the surface of the result.
#[derive(Debug, clap::Args)]
pub(crate) struct Boolean {
    /// Expression over the names of the inputs: `!` complement, `&` intersection, `-` difference, `^` symmetric
    /// difference, `|` union, from the tightest to the loosest, and parentheses.
    #[arg(value_name = "EXPR")]
    expression: String,
    #[command(flatten)]
    inputs: Inputs,
    /// Result: triangles in the format of the extension (.obj, .stl, .ply, .off, .glb; OBJ for any other), or, when the
    /// name ends in `.json`, polygons with holes as a chain complex.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Write a report as JSON to a file, or with `-` to the standard output.
    #[arg(long, value_name = "PATH")]
    json: Option<PathBuf>,
    /// What winding number counts as inside.
    #[arg(long, value_enum, value_name = "RULE", default_value_t)]
    fill: Fill,
    /// Keep the faces as the inputs cut them, instead of merging those of one plane.
    #[arg(long)]
    keep_fragments: bool,
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

/// The JSON of a Boolean. The counts are those of the result's polygons, but for `triangles`.
#[derive(Debug, Serialize)]
struct Report {
    vertices: usize,
    edges: usize,
    faces: usize,
    triangles: usize,
    components: usize,
    loops: usize,
    /// `null` when the result is unbounded.
    volume: Option<f64>,
    area: f64,
    /// Each edge is used as often in one direction as in the other.
    closed: bool,
    bounded: bool,
    /// V − E + Σ over faces of (2 − loops).
    euler: i64,
    expression: String,
    fill: Fill,
    /// The cells of the arrangement that make up the result.
    cells: Vec<u32>,
    inputs: Vec<Operand>,
    grid_step: f64,
    moved: Moves,
    exact_fallbacks: u64,
    threads: usize,
    seconds: Seconds,
}

#[derive(Debug, Serialize)]
struct Seconds {
    read: f64,
    arrange: f64,
    /// Choice of the cells, and their surface as a complex.
    boolean: f64,
    triangulate: f64,
    /// The whole operation, without reading and writing.
    operation: f64,
    /// Until the report is complete.
    total: f64,
    stages: Stages,
}

/// The result in both forms.
struct Surfaces {
    polygons: SolidComplex,
    triangles: TriangleMesh,
    boolean: Duration,
    triangulate: Duration,
}

impl Boolean {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let start = Instant::now();
        let sink = self.json.as_deref().map(Sink::from);
        check_distinct([Some(self.output.as_path()), self.json.as_deref()])?;
        check_file(&self.output)?;
        sink.as_ref().map_or(Ok(()), Sink::check)?;
        let operands = self.inputs.read()?;
        let expression = Expression::parse(&self.expression, &operands.names())?;
        let (arrangement, time) = arrange(&operands.surfaces, self.threads, self.coplanarity)?;
        let before = Instant::now();
        let solid = arrangement
            .boolean(&expression, self.fill.into())
            .map_err(|source| CommandError::Boolean { file: operands.file_of(&source), source })?;
        let surfaces = self.surfaces(&solid, before)?;
        let report = self.report(&arrangement, &operands, &solid, &surfaces, (time, start));
        if is_json(&self.output) {
            surfaces.polygons.complex.write_json(&self.output)?;
        } else if MeshFormat::of_path(&self.output).is_some() {
            write_mesh(&self.output, &surfaces.triangles)?;
        } else {
            surfaces.triangles.write_obj(&self.output)?;
        }
        if let Some(sink) = &sink {
            sink.write(&report, out)?;
        }
        if !matches!(sink, Some(Sink::Standard)) {
            self.print(&report, out)?;
        }
        Ok(())
    }

    fn surfaces(&self, solid: &Solid<'_>, before: Instant) -> Result<Surfaces, CommandError> {
        let detail = if self.keep_fragments { Detail::Fragments } else { Detail::Simplified };
        let polygons = solid.to_complex(detail);
        let boolean = before.elapsed();
        let before = Instant::now();
        let faces = (0..).map(|f| (FaceId(f), 1)).take(polygons.n_faces());
        let triangles =
            lar_triangle::triangulate(&polygons.complex)?.mesh_of_faces(polygons.complex.points(), faces)?;
        Ok(Surfaces { polygons, triangles, boolean, triangulate: before.elapsed() })
    }

    fn report(
        &self,
        arrangement: &Arrangement,
        operands: &Operands,
        solid: &Solid<'_>,
        surfaces: &Surfaces,
        (arrange, start): (Duration, Instant),
    ) -> Report {
        let polygons = &surfaces.polygons;
        let operation = arrange + surfaces.boolean + surfaces.triangulate;
        let mut report = Report {
            vertices: polygons.complex.n_cells(0),
            edges: polygons.complex.n_cells(1),
            faces: polygons.n_faces(),
            triangles: surfaces.triangles.triangles.len(),
            components: polygons.n_components(),
            loops: polygons.n_loops(),
            volume: solid.is_bounded().then(|| solid.volume()),
            area: solid.area(),
            closed: polygons.is_closed() && surfaces.triangles.is_closed(),
            bounded: solid.is_bounded(),
            euler: polygons.euler(),
            expression: self.expression.clone(),
            fill: self.fill,
            cells: solid.cells().iter().map(|c| c.0).collect(),
            inputs: Operand::all(arrangement, operands),
            grid_step: arrangement.stats().grid_step,
            moved: Moves::of(arrangement.stats()),
            exact_fallbacks: arrangement.stats().exact_fallbacks,
            threads: self.threads.count().get(),
            seconds: Seconds {
                read: operands.read.as_secs_f64(),
                arrange: arrange.as_secs_f64(),
                boolean: surfaces.boolean.as_secs_f64(),
                triangulate: surfaces.triangulate.as_secs_f64(),
                operation: operation.as_secs_f64(),
                total: 0.0,
                stages: Stages::of(arrangement.stats()),
            },
        };
        report.seconds.total = start.elapsed().as_secs_f64();
        report
    }

    fn print(&self, report: &Report, out: &mut dyn Write) -> Result<(), CommandError> {
        let counts = [
            counted(report.vertices, "vertex"),
            counted(report.edges, "edge"),
            counted(report.faces, "face"),
            counted(report.triangles, "triangle"),
            counted(report.components, "component"),
        ];
        writeln!(out, "{}: {}", self.expression, counts.join(", "))?;
        let volume = report.volume.map_or("unbounded".to_owned(), |v| format!("volume {v}"));
        let closed = if report.closed { "closed" } else { "NOT CLOSED" };
        writeln!(out, "{volume}, area {}, {closed}, Euler characteristic {}", report.area, report.euler)?;
        let seconds = &report.seconds;
        writeln!(out, "{:.3} s to read, {:.3} s for the operation", seconds.read, seconds.operation)?;
        Ok(())
    }
}
