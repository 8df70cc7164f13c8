//! `lar plane`: the partition of the plane that drawings generate, and Booleans of their regions.

use super::boolean::Fill;
use super::input::{named, split};
use super::picture::factor;
use super::report::{Json, Stages, Threads, counted, print_laws};
use crate::CommandError;
use crate::checks::boundary_squared_zero;
use crate::output::{check_distinct, check_file};
use crate::plane::{Boolean, BooleanOptions, Input, Picture, PictureFile, Shapes, Source, arranged};
use crate::size::Size;
use lar_arrangement::Expression;
use lar_arrangement::planar::{Dangling, PlanarArrangement, Polygons};
use lar_core::FaceId;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// The partition of the plane that drawings generate, or a Boolean expression over their regions.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  \
                        lar plane plan.svg -o faces.svg --json -\n  \
                        lar plane cross.seg --keep-dangling -o faces.png --explode 1.3\n  \
                        lar plane --boolean 'walls - (windows | doors)' apartment.svg -o walls.svg")]
pub(crate) struct Plane {
    /// SVG drawings (.svg) or segments (.seg: x1 y1 x2 y2 a line, # comments), together one drawing. For names of
    /// regions also NAME=PATH.
    #[arg(value_name = "INPUT", required = true)]
    inputs: Vec<PathBuf>,
    /// Expression over the regions. Of a single drawing these are its elements, called by their ids ('in quotes' when
    /// they have other characters than letters, digits, _ and .), a group being the union of what is in it; shapes
    /// without an id are A, B, C, … by their number. Of several drawings, each is a region, called as in `lar boolean`,
    /// and its elements are NAME.id. `!` complement, `&` intersection, `-` difference, `^` symmetric difference, `|`
    /// union, from the tightest to the loosest, and parentheses.
    #[arg(long, value_name = "EXPR")]
    boolean: Option<String>,
    /// What winding number counts as inside; when not given, as each SVG element says, odd ones for segments.
    #[arg(long, value_enum, value_name = "RULE", requires = "boolean")]
    fill: Option<Fill>,
    /// Keep edges that have the same face on both sides.
    #[arg(long, conflicts_with = "boolean")]
    keep_dangling: bool,
    #[command(flatten)]
    json: Json,
    /// Write the chain complex of the partition as JSON.
    #[arg(long, value_name = "PATH", conflicts_with = "boolean")]
    complex: Option<PathBuf>,
    /// A picture of the faces, or of the polygons that are the result of the expression: SVG or PNG by the extension.
    #[arg(short, long, value_name = "OUT.svg|.png")]
    output: Option<PathBuf>,
    /// Moves each face or polygon of the picture away from the middle by this factor; 1 leaves it in place.
    #[arg(long, value_name = "S", default_value = "1", value_parser = explode, allow_hyphen_values = true)]
    explode: f64,
    /// Width and height of a PNG in pixels; lines in an SVG are as wide as in this PNG.
    #[arg(long, value_name = "WxH", default_value = "1280x800")]
    size: Size,
    /// How far a curve may be from the chords that it is replaced by, in the units of the drawing.
    #[arg(long, value_name = "T", default_value = "0.01", allow_hyphen_values = true)]
    tolerance: f64,
    #[command(flatten)]
    threads: Threads,
}

fn explode(text: &str) -> Result<f64, &'static str> {
    factor(text).map(f64::from).ok_or("an explosion is one factor within ±1e6")
}

/// A drawing in a report.
#[derive(Debug, Serialize)]
struct Drawn {
    name: String,
    file: String,
    shapes: usize,
    segments: usize,
}

impl Drawn {
    fn all(shapes: &Shapes) -> Vec<Self> {
        let one = |input: &Input| Self {
            name: input.name.clone(),
            file: input.path.display().to_string(),
            shapes: input.shapes.len(),
            segments: input.segments.len(),
        };
        shapes.inputs.iter().map(one).collect()
    }
}

/// The JSON of a partition.
#[derive(Debug, Serialize)]
struct PartitionReport {
    vertices: usize,
    edges: usize,
    /// Without the exterior.
    faces: usize,
    components: usize,
    /// Of the bounded faces.
    loops: usize,
    /// Of the bounded faces together.
    area: f64,
    boundary_squared_zero: bool,
    /// V − E + F − components: 0 for every partition of the plane.
    euler: i64,
    euler_ok: bool,
    /// Edges with the same face on both sides.
    dangling_edges: usize,
    inputs: Vec<Drawn>,
    grid_step: f64,
    threads: usize,
    seconds: Seconds,
}

/// The JSON of a Boolean. The counts are those of the result's polygons.
#[derive(Debug, Serialize)]
struct BooleanReport {
    vertices: usize,
    edges: usize,
    polygons: usize,
    holes: usize,
    loops: usize,
    area: f64,
    expression: String,
    /// `null` when each shape has its own.
    fill: Option<Fill>,
    /// Number of the shapes that the expression is about.
    shapes: usize,
    /// Number of the faces of their arrangement that make up the result.
    faces: usize,
    inputs: Vec<Drawn>,
    grid_step: f64,
    threads: usize,
    seconds: Seconds,
}

#[derive(Debug, Serialize)]
struct Seconds {
    read: f64,
    /// The operation itself, without reading, checks, writing.
    arrange: f64,
    /// Choice of the faces, and their union.
    #[serde(skip_serializing_if = "Option::is_none")]
    boolean: Option<f64>,
    /// Until the report is complete.
    total: f64,
    stages: Stages,
}

/// What a run found, for files and for readers.
trait Report: Serialize {
    fn print(&self, out: &mut dyn Write) -> Result<(), CommandError>;
}

/// The drawings, and the times so far.
struct Job {
    shapes: Shapes,
    as_wholes: bool,
    start: Instant,
    read: Duration,
}

impl Plane {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let start = Instant::now();
        check_distinct([self.json.path(), self.complex.as_deref(), self.output.as_deref()])?;
        self.json.check()?;
        self.complex.as_deref().map_or(Ok(()), check_file)?;
        let size = [self.size.width, self.size.height];
        let mut file = self.output.as_deref().map(|path| PictureFile::new(path, size)).transpose()?;
        let job = self.read(start)?;
        match &self.boolean {
            None => self.partition(&job, file.as_mut(), out),
            Some(text) => self.polygons(text, &job, file.as_mut(), out),
        }
    }

    fn read(&self, start: Instant) -> Result<Job, CommandError> {
        let as_wholes = 1 < self.inputs.len() || self.inputs.iter().any(|input| split(input).is_some());
        let source = |(name, path)| Source { name, path };
        let sources = named(&self.inputs)?.into_iter().map(source).collect();
        let before = Instant::now();
        let shapes = Shapes::read(sources, self.tolerance)?;
        Ok(Job { shapes, as_wholes, start, read: before.elapsed() })
    }

    fn partition(
        &self,
        job: &Job,
        file: Option<&mut PictureFile>,
        out: &mut dyn Write,
    ) -> Result<(), CommandError> {
        let before = Instant::now();
        let drawing = job.shapes.drawing();
        let dangling = if self.keep_dangling { Dangling::Keep } else { Dangling::Drop };
        let arrangement = arranged(&drawing, self.threads.count(), dangling)?;
        let arrange = before.elapsed();
        let report = self.partition_report(job, &arrangement, arrange);
        let picture = || Picture::partition(&arrangement, self.explode);
        let drawn_by = file.map_or(Ok(None), |file| file.write(&picture()))?;
        if let Some(path) = &self.complex {
            arrangement.complex().write_json(path)?;
        }
        self.deliver("plane", &report, drawn_by, out)
    }

    fn partition_report(&self, job: &Job, a: &PlanarArrangement, arrange: Duration) -> PartitionReport {
        let bounded = (1..).map(FaceId).take(a.n_faces());
        let mut report = PartitionReport {
            vertices: a.n_vertices(),
            edges: a.n_edges(),
            faces: a.n_faces(),
            components: a.n_components(),
            loops: a.n_loops(),
            area: bounded.map(|face| a.area(face)).fold(0.0, |sum, area| sum + area),
            boundary_squared_zero: boundary_squared_zero(a.complex()),
            euler: a.euler(),
            euler_ok: a.euler() == 0,
            dangling_edges: a.n_edges() - a.complex().boundary(2).nnz() / 2,
            inputs: Drawn::all(&job.shapes),
            grid_step: a.stats().grid_step,
            threads: self.threads.count().get(),
            seconds: job.seconds(a, arrange, None),
        };
        report.seconds.total = job.start.elapsed().as_secs_f64();
        report
    }

    fn polygons(
        &self,
        text: &str,
        job: &Job,
        file: Option<&mut PictureFile>,
        out: &mut dyn Write,
    ) -> Result<(), CommandError> {
        let regions = job.shapes.regions(job.as_wholes)?;
        let expression = Expression::parse(text, &regions.names)?;
        let options = BooleanOptions { rule: self.fill.map(Into::into), threads: self.threads.count() };
        let before = Instant::now();
        let boolean = regions.boolean(&job.shapes, &expression, options)?;
        if boolean.is_unbounded {
            return Err(CommandError::Unbounded { expression: text.to_owned() });
        }
        let polygons = boolean.polygons();
        let report = self.boolean_report(text, job, &boolean, &polygons, before.elapsed());
        let picture = || Picture::polygons(&polygons, self.explode);
        let drawn_by = file.map_or(Ok(None), |file| file.write(&picture()))?;
        self.deliver("plane-boolean", &report, drawn_by, out)
    }

    fn boolean_report(
        &self,
        text: &str,
        job: &Job,
        boolean: &Boolean,
        result: &Polygons,
        operation: Duration,
    ) -> BooleanReport {
        let loops: usize = result.polygons.iter().map(Vec::len).sum();
        let arrange = boolean.arrangement.stats().total();
        let mut report = BooleanReport {
            vertices: result.points.len(),
            edges: result.polygons.iter().flatten().map(Vec::len).sum(),
            polygons: result.polygons.len(),
            holes: loops - result.polygons.len(),
            loops,
            area: result.area(),
            expression: text.to_owned(),
            fill: self.fill,
            shapes: boolean.n_shapes,
            faces: boolean.faces.len(),
            inputs: Drawn::all(&job.shapes),
            grid_step: boolean.arrangement.stats().grid_step,
            threads: self.threads.count().get(),
            seconds: job.seconds(&boolean.arrangement, arrange, Some(operation.saturating_sub(arrange))),
        };
        report.seconds.total = job.start.elapsed().as_secs_f64();
        report
    }

    /// Writes the report where it was asked for, and prints it unless the standard output has it already.
    fn deliver(
        &self,
        name: &'static str,
        report: &impl Report,
        drawn_by: Option<String>,
        out: &mut dyn Write,
    ) -> Result<(), CommandError> {
        self.json.deliver(name, report, out, |out| {
            report.print(out)?;
            self.print_picture(drawn_by, out)
        })
    }

    fn print_picture(&self, drawn_by: Option<String>, out: &mut dyn Write) -> Result<(), CommandError> {
        if let (Some(path), Some(adapter)) = (&self.output, drawn_by) {
            let Size { width, height } = self.size;
            writeln!(out, "{}: {width} × {height}, drawn by {adapter}", path.display())?;
        }
        Ok(())
    }
}

impl Job {
    fn seconds(&self, a: &PlanarArrangement, arrange: Duration, boolean: Option<Duration>) -> Seconds {
        Seconds {
            read: self.read.as_secs_f64(),
            arrange: arrange.as_secs_f64(),
            boolean: boolean.map(|time| time.as_secs_f64()),
            total: 0.0,
            stages: Stages::of(a.stats()),
        }
    }
}

impl Report for PartitionReport {
    fn print(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let counts = [
            counted(self.vertices, "vertex"),
            counted(self.edges, "edge"),
            counted(self.faces, "bounded face"),
            counted(self.components, "component"),
            counted(self.loops, "loop"),
        ];
        writeln!(out, "{}", counts.join(", "))?;
        let laws = [
            ("the boundary of each boundary is zero", self.boundary_squared_zero),
            ("Euler's relation holds", self.euler_ok),
        ];
        print_laws(&laws, out)?;
        if 0 < self.dangling_edges {
            writeln!(out, "{} with the same face on both sides", counted(self.dangling_edges, "edge"))?;
        }
        writeln!(out, "area {}", self.area)?;
        writeln!(out, "{:.3} s to read, {:.3} s to arrange", self.seconds.read, self.seconds.arrange)?;
        Ok(())
    }
}

impl Report for BooleanReport {
    fn print(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let counts = [
            counted(self.polygons, "polygon"),
            counted(self.holes, "hole"),
            counted(self.vertices, "vertex"),
            counted(self.edges, "edge"),
        ];
        writeln!(out, "{}: {}", self.expression, counts.join(", "))?;
        writeln!(out, "area {}", self.area)?;
        let operation = self.seconds.arrange + self.seconds.boolean.unwrap_or(0.0);
        writeln!(out, "{:.3} s to read, {operation:.3} s for the operation", self.seconds.read)?;
        Ok(())
    }
}
