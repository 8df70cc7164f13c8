//! `lar arrange`: the partition of space that the inputs generate.

use super::input::{Inputs, Operands};
use super::report::{
    Coplanarity, Json, Moves, Operand, Rounding, Stages, Threads, arrange, counted, print_laws,
};
use super::stats::{Counters, Table, peak_memory};
use crate::checks::{boundary_squared_zero, parents_ok};
use crate::output::{check_directory, check_distinct, check_file, write_directory};
use crate::{CommandError, tables};
use lar_arrangement::Arrangement;
use lar_core::CellId;
use lar_triangle::Triangulation;
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Rows of the truth table that are printed.
const ROWS: usize = 40;

/// The partition of space that the inputs generate: counts, volumes, which cell is inside which input.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  \
                        lar arrange a.obj b.stl\n  \
                        lar arrange body=a.obj hole=b.obj --json report.json --complex complex.json --obj cells")]
pub(crate) struct Arrange {
    #[command(flatten)]
    inputs: Inputs,
    #[command(flatten)]
    json: Json,
    /// Write the chain complex as JSON.
    #[arg(long, value_name = "PATH")]
    complex: Option<PathBuf>,
    /// Write the exact positions of the vertices into the chain complex too, as quotients of integers on a grid.
    #[arg(long, requires = "complex")]
    exact: bool,
    /// Write each bounded cell as a triangulated OBJ file into a new directory.
    #[arg(long, value_name = "DIR")]
    obj: Option<PathBuf>,
    /// Print what it cost: seconds of each stage, pairs of faces, exact fallbacks, memory.
    #[arg(long)]
    stats: bool,
    #[command(flatten)]
    coplanarity: Coplanarity,
    #[command(flatten)]
    threads: Threads,
}

/// The JSON of an arrangement.
#[derive(Debug, Serialize)]
struct Report {
    vertices: usize,
    edges: usize,
    faces: usize,
    /// The exterior among them.
    cells: usize,
    shells: usize,
    components: usize,
    loops: usize,
    /// Index of the exterior cell.
    exterior: usize,
    boundary_squared_zero: bool,
    /// Euler's relation of a partition of space: 0 when it holds.
    euler: i64,
    euler_ok: bool,
    /// By cell; the exterior's is minus the sum of the others.
    volumes: Vec<f64>,
    /// By cell, by input: 1 where the winding number is not zero.
    inside: Vec<Vec<u8>>,
    parents_ok: bool,
    /// Faces with the same cell on both sides.
    dangling_faces: usize,
    inputs: Vec<Operand>,
    grid_step: f64,
    moved: Moves,
    rounding: Rounding,
    counters: Counters,
    /// Bytes, where the system tells.
    peak_memory: Option<u64>,
    threads: usize,
    seconds: Seconds,
}

#[derive(Debug, Serialize)]
struct Seconds {
    read: f64,
    /// The operation itself, without reading, checks, writing.
    arrange: f64,
    /// Until the report is complete.
    total: f64,
    stages: Stages,
}

impl Arrange {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let start = Instant::now();
        self.check_outputs()?;
        let operands = self.inputs.read()?;
        let (arrangement, time) = arrange(&operands.surfaces, self.threads, self.coplanarity)?;
        let triangles = self.threads.triangulate(arrangement.complex())?;
        let report = self.report(&arrangement, &triangles, &operands, (time, start));
        if let Some(dir) = &self.obj {
            write_cells(&arrangement, &triangles, dir)?;
        }
        if let Some(path) = &self.complex {
            match self.exact {
                true => arrangement.complex().write_json_exact(path, arrangement.exact_points())?,
                false => arrangement.complex().write_json(path)?,
            }
        }
        self.json.deliver("arrange", &report, out, |out| {
            print(&arrangement, &report, out)?;
            if self.stats {
                let stages = &arrangement.stats().stages;
                let (counters, peak_memory) = (&report.counters, report.peak_memory);
                write!(out, "{}", Table { stages, counters, peak_memory })?;
            }
            Ok(())
        })
    }

    fn check_outputs(&self) -> Result<(), CommandError> {
        check_distinct([self.json.path(), self.complex.as_deref(), self.obj.as_deref()])?;
        self.json.check()?;
        self.complex.as_deref().map_or(Ok(()), check_file)?;
        self.obj.as_deref().map_or(Ok(()), check_directory)
    }

    fn report(
        &self,
        a: &Arrangement,
        triangles: &Triangulation,
        operands: &Operands,
        (time, start): (Duration, Instant),
    ) -> Report {
        let volumes = a.volumes();
        let defects = triangles.defects(a.complex().points(), |face| a.normal(face));
        let mut report = Report {
            vertices: a.n_vertices(),
            edges: a.n_edges(),
            faces: a.n_faces(),
            cells: a.n_cells(),
            shells: a.n_shells(),
            components: a.n_components(),
            loops: a.n_loops(),
            exterior: 0,
            boundary_squared_zero: boundary_squared_zero(a.complex()),
            euler: a.euler(),
            euler_ok: a.euler() == 0,
            rounding: Rounding::new(triangles, defects, volumes[1..].iter().copied()),
            volumes,
            inside: (0..a.n_cells()).map(|cell| tables::inside(a, cell).collect()).collect(),
            parents_ok: parents_ok(a, &operands.surfaces),
            dangling_faces: a.dangling_faces().count(),
            inputs: Operand::all(a, operands),
            grid_step: a.stats().grid_step,
            moved: Moves::of(a.stats()),
            counters: Counters::of(a.stats()),
            peak_memory: peak_memory(),
            threads: self.threads.count().get(),
            seconds: Seconds {
                read: operands.read.as_secs_f64(),
                arrange: time.as_secs_f64(),
                total: 0.0,
                stages: Stages::of(a.stats()),
            },
        };
        report.seconds.total = start.elapsed().as_secs_f64();
        report
    }
}

/// `cell_001.obj` … : each bounded cell, its triangles outward.
fn write_cells(arrangement: &Arrangement, triangles: &Triangulation, dir: &Path) -> Result<(), CommandError> {
    let cells = 1..u32::try_from(arrangement.n_cells()).unwrap_or(u32::MAX);
    let digits = cells.end.saturating_sub(1).to_string().len().max(3);
    write_directory(dir, |dir| {
        for cell in cells {
            let mesh = triangles.cell_mesh(arrangement.complex(), CellId(cell))?;
            mesh.write_obj(dir.join(format!("cell_{cell:0digits$}.obj")))?;
        }
        Ok(())
    })
}

fn print(arrangement: &Arrangement, report: &Report, out: &mut dyn Write) -> Result<(), CommandError> {
    let counts = [
        counted(report.vertices, "vertex"),
        counted(report.edges, "edge"),
        counted(report.faces, "face"),
        counted(report.cells, "cell"),
        counted(report.shells, "shell"),
        counted(report.components, "component"),
    ];
    writeln!(out, "{} (cell c0 is the exterior)", counts.join(", "))?;
    let laws = [
        ("the boundary of each boundary is zero", report.boundary_squared_zero),
        ("Euler's relation holds", report.euler_ok),
        ("the pieces of each input face add up", report.parents_ok),
    ];
    print_laws(&laws, out)?;
    if 0 < report.dangling_faces {
        writeln!(out, "{} with the same cell on both sides", counted(report.dangling_faces, "face"))?;
    }
    if let Some(moved) = report.moved.line() {
        writeln!(out, "{moved}")?;
    }
    if let Some(rounding) = report.rounding.line() {
        writeln!(out, "{rounding}")?;
    }
    for open in report.inputs.iter().filter_map(Operand::warning) {
        writeln!(out, "{open}")?;
    }
    write!(out, "{}", tables::truth_table(arrangement, ROWS))?;
    let seconds = &report.seconds;
    writeln!(out, "{:.3} s to read, {:.3} s to arrange", seconds.read, seconds.arrange)?;
    Ok(())
}
