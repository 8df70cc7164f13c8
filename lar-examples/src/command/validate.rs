//! `lar validate`: all that is wrong with one file.

use super::input::{is_json, read};
use super::report::{Json, counted};
use crate::CommandError;
use lar_arrangement::{Arranger, Closure};
use lar_core::{CellId, ChainComplex, JsonError, Surface, Violation};
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;

/// Violations that are printed.
const ROWS: usize = 40;

/// All that is wrong with a surface, or with a chain complex.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Exit code 0 when nothing is wrong, 1 when something is, 2 when the file cannot be read.\n\n\
                        A surface is checked for malformed faces, for edges where it is open or not oriented \
                        consistently, and for places that it winds around more than once or inside out. A chain complex \
                        is checked for every law.\n\n\
                        Examples:\n  \
                        lar validate part.stl\n  \
                        lar validate complex.json --json -"
)]
pub(crate) struct Validate {
    /// An OBJ, STL, PLY or OFF file, or a chain complex in a file whose name ends in `.json`.
    #[arg(value_name = "INPUT")]
    input: PathBuf,
    #[command(flatten)]
    json: Json,
}

#[derive(Debug, Serialize)]
struct Report {
    file: String,
    content: &'static str,
    valid: bool,
    violations: Vec<Found>,
}

/// One violation.
#[derive(Debug, Serialize)]
struct Found {
    /// Which check found it.
    check: &'static str,
    message: String,
}

impl Found {
    fn new(check: &'static str, message: String) -> Self {
        Self { check, message }
    }
}

impl Validate {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        self.json.check()?;
        let (content, violations) = if is_json(&self.input) {
            ("chain complex", complex(ChainComplex::read_json(&self.input))?)
        } else {
            ("surface", surface(&read("A", &self.input)?)?)
        };
        let file = self.input.display().to_string();
        let report = Report { file, content, valid: violations.is_empty(), violations };
        self.json.deliver("validate", &report, out, |out| print(&report, out))?;
        let n = report.violations.len();
        if n == 0 { Ok(()) } else { Err(CommandError::Invalid { path: self.input.clone(), violations: n }) }
    }
}

fn surface(surface: &Surface) -> Result<Vec<Found>, CommandError> {
    let mut found: Vec<Found> =
        surface.validate().into_iter().map(|v| Found::new("face", v.to_string())).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let at = |v: lar_core::VertexId| {
        let [x, y, z] = surface.points.xyz(v.index());
        format!("{v} ({x}, {y}, {z})")
    };
    let odd = surface.odd_boundary_edges();
    for edge in surface.boundary_edges() {
        let mut ends = edge.ends;
        ends.sort_unstable();
        let is_open = odd.binary_search(&ends).is_ok();
        let check = if is_open { "open edge" } else { "orientation" };
        let [from, to] = edge.ends.map(at);
        let uses = counted(usize::try_from(edge.surplus).unwrap_or(usize::MAX), "time");
        found.push(Found::new(check, format!("the edge from {from} to {to} is used {uses} more than back")));
    }
    if found.is_empty() {
        found.extend(windings(surface)?);
    }
    Ok(found)
}

/// The cells of a closed surface around which it does not wind once.
fn windings(surface: &Surface) -> Result<Vec<Found>, CommandError> {
    let arrangement = Arranger::new().arrange(std::slice::from_ref(surface))?;
    if arrangement.closure(0) != Closure::Closed {
        return Ok(Vec::new());
    }
    let volumes = arrangement.volumes();
    let cells = (1..).map(CellId).zip(volumes.iter().skip(1));
    let wound = cells.map(|(cell, volume)| (cell, volume, arrangement.winding(cell, 0)));
    let wrong = wound.filter(|(_, _, winding)| !(0..=1).contains(winding));
    let message = |(cell, volume, winding): (CellId, &f64, i32)| {
        Found::new("winding", format!("winding number {winding} in {cell}, of volume {volume}"))
    };
    Ok(wrong.map(message).collect())
}

/// The laws that the complex breaks. One that was read keeps them all: the reader has found what there is to find.
fn complex(read: Result<ChainComplex, JsonError>) -> Result<Vec<Found>, CommandError> {
    let check = |violation: &Violation| match violation {
        Violation::Shape { .. } | Violation::Storage { .. } => "shape",
        Violation::Entry { .. } => "entry",
        Violation::Edge { .. } => "edge",
        Violation::Square { .. } => "boundary of boundary",
        Violation::Sides { .. } | Violation::OneSided { .. } => "sides",
        Violation::NonFinite { .. } => "coordinate",
        _ => "law",
    };
    let source = match read {
        Ok(_) => return Ok(Vec::new()),
        Err(JsonError::In { path, source }) => match *source {
            JsonError::Invalid(violations) => {
                return Ok(violations.iter().map(|v| Found::new(check(v), v.to_string())).collect());
            }
            other => JsonError::In { path, source: Box::new(other) },
        },
        Err(other) => other,
    };
    Err(source.into())
}

fn print(report: &Report, out: &mut dyn Write) -> Result<(), CommandError> {
    if report.valid {
        writeln!(out, "{}: nothing is wrong with this {}", report.file, report.content)?;
        return Ok(());
    }
    for violation in report.violations.iter().take(ROWS) {
        writeln!(out, "{}: {}", violation.check, violation.message)?;
    }
    if ROWS < report.violations.len() {
        writeln!(out, "… and {} more", report.violations.len() - ROWS)?;
    }
    Ok(())
}
