//! `lar info`: facts about one file, a surface or a chain complex.

use super::input::{is_json, read};
use super::report::counted;
use crate::{CommandError, mesh};
use lar_core::{ChainComplex, Points, Surface};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Lines of a list that are printed.
const ROWS: usize = 40;

/// Facts about one file: an OBJ file, or a chain complex in JSON.
#[derive(Debug, clap::Args)]
pub(crate) struct Info {
    /// An OBJ file, or a chain complex in a file whose name ends in `.json`.
    #[arg(value_name = "INPUT")]
    input: PathBuf,
}

impl Info {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        if is_json(&self.input) {
            complex(&self.input, &ChainComplex::read_json(&self.input)?, out)
        } else {
            surface(&self.input, &read("", &self.input)?, out)
        }
    }
}

fn surface(path: &Path, surface: &Surface, out: &mut dyn Write) -> Result<(), CommandError> {
    let (vertices, faces) = (surface.points.len(), surface.n_faces());
    writeln!(
        out,
        "{}: a surface of {}, {}",
        path.display(),
        counted(vertices, "vertex"),
        counted(faces, "face")
    )?;
    let corners = |f| surface.face(f).next().map_or(0, <[u32]>::len);
    let mut sizes: Vec<usize> = (0..faces).map(corners).collect();
    sizes.sort_unstable();
    let of_size = |same: &[usize]| format!("{} of {}", same.len(), same[0]);
    let sizes: Vec<String> = sizes.chunk_by(|a, b| a == b).map(of_size).collect();
    writeln!(out, "faces by number of corners: {}", sizes.join(", "))?;
    bounds(&surface.points, out)?;
    for violation in surface.validate().iter().take(ROWS) {
        writeln!(out, "malformed: {violation}")?;
    }
    let mesh = mesh::of_surface(surface)?;
    writeln!(out, "{}, area {}", counted(mesh.n_components(), "component"), number(mesh.area()))?;
    let open = surface.boundary_edges();
    match open.first() {
        None => writeln!(out, "closed, volume {}", number(mesh.signed_volume()))?,
        Some(edge) => {
            let [from, to] = edge.ends.map(|v| surface.points.xyz(v.index()));
            let count = counted(open.len(), "boundary edge");
            writeln!(out, "open: {count}, one of them from {} to {}", point(&from), point(&to))?;
        }
    }
    Ok(())
}

fn complex(path: &Path, complex: &ChainComplex, out: &mut dyn Write) -> Result<(), CommandError> {
    let counts: Vec<String> =
        complex.f_vector().iter().enumerate().map(|(p, &n)| counted(n, &format!("{p}-cell"))).collect();
    writeln!(out, "{}: a chain complex of dimension {}", path.display(), complex.dim())?;
    writeln!(out, "{}", counts.join(", "))?;
    bounds(complex.points(), out)?;
    let (euler, components) = (complex.euler_characteristic(), complex.connected_components().n);
    writeln!(out, "Euler characteristic {euler}, {}", counted(components, "component"))?;
    if complex.dim() == 3 && complex.points().dim() == 3 {
        let with_exterior = complex.validate_with_exterior().is_empty();
        writeln!(out, "{} exterior cell", if with_exterior { "with its" } else { "without" })?;
        let volumes = complex.cell_volumes();
        for (cell, volume) in volumes.iter().enumerate().take(ROWS) {
            writeln!(out, "volume of c{cell}: {}", number(*volume))?;
        }
        if ROWS < volumes.len() {
            writeln!(out, "… and {} more cells", volumes.len() - ROWS)?;
        }
    }
    Ok(())
}

fn bounds(points: &Points, out: &mut dyn Write) -> Result<(), CommandError> {
    if let Some((min, max)) = points.bounds() {
        writeln!(out, "from {} to {}", point(&min), point(&max))?;
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
