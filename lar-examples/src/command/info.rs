//! `lar info`: facts about one file, a surface or a chain complex.

use super::input::{is_json, read};
use super::report::{Json, counted};
use crate::{CommandError, mesh};
use lar_core::{ChainComplex, Points, Surface};
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Lines of a list that are printed.
const ROWS: usize = 40;

/// Facts about one file: a surface, or a chain complex in JSON.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  lar info part.stl\n  lar info complex.json --json -")]
pub(crate) struct Info {
    /// An OBJ, STL, PLY or OFF file, or a chain complex in a file whose name ends in `.json`.
    #[arg(value_name = "INPUT")]
    input: PathBuf,
    #[command(flatten)]
    json: Json,
}

impl Info {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        self.json.check()?;
        if is_json(&self.input) {
            let facts = ComplexFacts::new(&self.input, &ChainComplex::read_json(&self.input)?);
            self.json.deliver("info-complex", &facts, out, |out| facts.print(out))
        } else {
            let facts = SurfaceFacts::new(&self.input, &read("", &self.input)?)?;
            self.json.deliver("info", &facts, out, |out| facts.print(out))
        }
    }
}

/// The JSON of a surface.
#[derive(Debug, Serialize)]
struct SurfaceFacts {
    file: String,
    vertices: usize,
    faces: usize,
    /// Numbers of faces by number of corners of their outer loop: corners, faces.
    corners: Vec<[usize; 2]>,
    /// Lower and upper corner of the box around the vertices.
    bounds: Option<[Vec<f64>; 2]>,
    malformed: Vec<String>,
    components: usize,
    area: f64,
    closed: bool,
    /// `null` when the surface is open.
    volume: Option<f64>,
    boundary_edges: usize,
    /// From and to.
    a_boundary_edge: Option<[[f64; 3]; 2]>,
}

impl SurfaceFacts {
    fn new(path: &Path, surface: &Surface) -> Result<Self, CommandError> {
        let corners = |f| surface.face(f).next().map_or(0, <[u32]>::len);
        let mut sizes: Vec<usize> = (0..surface.n_faces()).map(corners).collect();
        sizes.sort_unstable();
        let mesh = mesh::of_surface(surface)?;
        let open = surface.boundary_edges();
        Ok(Self {
            file: path.display().to_string(),
            vertices: surface.points.len(),
            faces: surface.n_faces(),
            corners: sizes.chunk_by(|a, b| a == b).map(|same| [same[0], same.len()]).collect(),
            bounds: bounds(&surface.points),
            malformed: surface.validate().iter().map(ToString::to_string).collect(),
            components: mesh.n_components(),
            area: mesh.area(),
            closed: open.is_empty(),
            volume: open.is_empty().then(|| mesh.signed_volume()),
            boundary_edges: open.len(),
            a_boundary_edge: open.first().map(|edge| edge.ends.map(|v| surface.points.xyz(v.index()))),
        })
    }

    fn print(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let [vertices, faces] = [counted(self.vertices, "vertex"), counted(self.faces, "face")];
        writeln!(out, "{}: a surface of {vertices}, {faces}", self.file)?;
        let sizes: Vec<String> = self.corners.iter().map(|[size, n]| format!("{n} of {size}")).collect();
        writeln!(out, "faces by number of corners: {}", sizes.join(", "))?;
        print_bounds(self.bounds.as_ref(), out)?;
        for violation in self.malformed.iter().take(ROWS) {
            writeln!(out, "malformed: {violation}")?;
        }
        writeln!(out, "{}, area {}", counted(self.components, "component"), number(self.area))?;
        if let Some(volume) = self.volume {
            writeln!(out, "closed, volume {}", number(volume))?;
        }
        if let Some([from, to]) = &self.a_boundary_edge {
            let count = counted(self.boundary_edges, "boundary edge");
            writeln!(out, "open: {count}, one of them from {} to {}", point(from), point(to))?;
        }
        Ok(())
    }
}

/// The JSON of a chain complex.
#[derive(Debug, Serialize)]
struct ComplexFacts {
    file: String,
    dim: usize,
    /// Numbers of cells by dimension.
    cells: Vec<usize>,
    bounds: Option<[Vec<f64>; 2]>,
    euler: i64,
    components: usize,
    /// Whether cell 0 is the exterior; `null` for other complexes than those of 3-cells in space.
    with_exterior: Option<bool>,
    /// Of the 3-cells in space.
    volumes: Vec<f64>,
}

impl ComplexFacts {
    fn new(path: &Path, complex: &ChainComplex) -> Self {
        let is_solid = complex.dim() == 3 && complex.points().dim() == 3;
        Self {
            file: path.display().to_string(),
            dim: complex.dim(),
            cells: complex.f_vector(),
            bounds: bounds(complex.points()),
            euler: complex.euler_characteristic(),
            components: complex.connected_components().n,
            with_exterior: is_solid.then(|| complex.validate_with_exterior().is_empty()),
            volumes: if is_solid { complex.cell_volumes() } else { Vec::new() },
        }
    }

    fn print(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let counts = self.cells.iter().enumerate().map(|(p, &n)| counted(n, &format!("{p}-cell")));
        writeln!(out, "{}: a chain complex of dimension {}", self.file, self.dim)?;
        writeln!(out, "{}", counts.collect::<Vec<_>>().join(", "))?;
        print_bounds(self.bounds.as_ref(), out)?;
        writeln!(out, "Euler characteristic {}, {}", self.euler, counted(self.components, "component"))?;
        if let Some(with_exterior) = self.with_exterior {
            writeln!(out, "{} exterior cell", if with_exterior { "with its" } else { "without" })?;
        }
        for (cell, volume) in self.volumes.iter().enumerate().take(ROWS) {
            writeln!(out, "volume of c{cell}: {}", number(*volume))?;
        }
        if ROWS < self.volumes.len() {
            writeln!(out, "… and {} more cells", self.volumes.len() - ROWS)?;
        }
        Ok(())
    }
}

fn bounds(points: &Points) -> Option<[Vec<f64>; 2]> {
    points.bounds().map(|(lo, hi)| [lo.to_vec(), hi.to_vec()])
}

fn print_bounds(bounds: Option<&[Vec<f64>; 2]>, out: &mut dyn Write) -> Result<(), CommandError> {
    if let Some([lo, hi]) = bounds {
        writeln!(out, "from {} to {}", point(lo), point(hi))?;
    }
    Ok(())
}

fn point(coordinates: &[f64]) -> String {
    let texts: Vec<String> = coordinates.iter().copied().map(number).collect();
    format!("({})", texts.join(", "))
}

/// The shortest text that reads back as the same number; with an exponent where digits would run long.
fn number(x: f64) -> String {
    if x == 0.0 || (1e-5..1e15).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}
