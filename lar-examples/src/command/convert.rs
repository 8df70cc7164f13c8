//! `lar convert`: a file in another format.

use super::input::{is_json, read};
use super::report::{Json, counted};
use crate::CommandError;
use crate::mesh::of_surface;
use crate::output::{check_distinct, check_file};
use crate::plane::extension;
use crate::scenes::SceneError;
use lar_core::{
    Cells, ChainComplex, MeshFormat, Model, Points, Struct, Surface, atomic_write, read_segments, read_svg,
    write_mesh,
};
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::path::{Path, PathBuf};

/// A file in another format, by the extensions of both.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Surfaces (.obj, .stl, .ply, .off) become surfaces (also .gltf, .glb) or chain complexes of their \
                        faces (.json); faces become triangles where the format has no others or where they have holes. \
                        A chain complex, model or hierarchy (.json) of dimension 3 becomes the surface of its bounded \
                        cells together, of dimension 2 its faces. Drawings (.svg, .seg) and complexes of the plane become \
                        .svg, .seg or .json.\n\n\
                        Examples:\n  \
                        lar convert part.stl part.obj\n  \
                        lar convert complex.json cells.glb\n  \
                        lar convert plan.svg plan.seg --tolerance 0.1"
)]
pub(crate) struct Convert {
    /// The file to be read.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The file to be written.
    #[arg(value_name = "OUT")]
    output: PathBuf,
    /// How far a curve of an SVG may be from the chords that it is replaced by, in the units of the drawing.
    #[arg(long, value_name = "T", default_value = "0.01", allow_hyphen_values = true)]
    tolerance: f64,
    #[command(flatten)]
    json: Json,
}

/// What is between reading and writing.
enum Content {
    Surface(Surface),
    Complex(ChainComplex),
}

#[derive(Debug, Serialize)]
struct Report {
    input: String,
    output: String,
    /// What was read: `surface` or `complex`.
    content: &'static str,
    /// Numbers of vertices and faces of a surface, of cells of each dimension of a complex, as read.
    counts: Vec<usize>,
}

impl Convert {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        check_distinct([Some(self.output.as_path()), self.json.path()])?;
        check_file(&self.output)?;
        self.json.check()?;
        let content = self.read()?;
        self.write(&content)?;
        let (kind, counts) = match &content {
            Content::Surface(surface) => ("surface", vec![surface.points.len(), surface.n_faces()]),
            Content::Complex(complex) => ("complex", complex.f_vector()),
        };
        let [input, output] = [&self.input, &self.output].map(|path| path.display().to_string());
        let report = Report { input, output, content: kind, counts };
        self.json.deliver("convert", &report, out, |out| {
            let counts: Vec<String> = match &content {
                Content::Surface(_) => {
                    ["vertex", "face"].iter().zip(&report.counts).map(|(w, &n)| counted(n, w)).collect()
                }
                Content::Complex(_) => {
                    report.counts.iter().enumerate().map(|(p, &n)| counted(n, &format!("{p}-cell"))).collect()
                }
            };
            writeln!(out, "{}: a {kind} of {}", report.output, counts.join(", "))?;
            Ok(())
        })
    }

    fn read(&self) -> Result<Content, CommandError> {
        match extension(&self.input).as_str() {
            "svg" => complex(&read_svg(&self.input, self.tolerance)?.to_model()),
            "seg" => complex(&model_of(&read_segments(&self.input)?)),
            _ if is_json(&self.input) => json(&self.input),
            _ => Ok(Content::Surface(read("", &self.input)?)),
        }
    }

    fn write(&self, content: &Content) -> Result<(), CommandError> {
        match (extension(&self.output).as_str(), content) {
            ("json", Content::Complex(complex)) => complex.write_json(&self.output)?,
            ("json", Content::Surface(surface)) => complex_of(surface)?.write_json(&self.output)?,
            ("svg", _) => self.planar(content)?.write_svg(&self.output)?,
            ("seg", _) => write_segments(self.planar(content)?, &self.output)?,
            (_, Content::Surface(surface)) => write_surface(surface, &self.output)?,
            (_, Content::Complex(complex)) => {
                write_surface(&surface_of(complex, &self.input)?, &self.output)?;
            }
        }
        Ok(())
    }

    fn planar<'a>(&self, content: &'a Content) -> Result<&'a ChainComplex, CommandError> {
        match content {
            Content::Complex(complex) if complex.points().dim() == 2 => Ok(complex),
            _ => Err(CommandError::NotPlanar { path: self.input.clone(), output: self.output.clone() }),
        }
    }
}

fn complex(model: &Model) -> Result<Content, CommandError> {
    let welded = model.welded().map_err(SceneError::from)?;
    Ok(Content::Complex(ChainComplex::from_model(&welded).map_err(SceneError::from)?))
}

/// Two vertices and an edge for each segment.
fn model_of(segments: &[[f64; 4]]) -> Model {
    let n = 2 * segments.len() as u32;
    let points = Points::from_columns(2, segments.iter().flatten().copied().collect());
    Model::new(points, vec![Cells::singletons(n as usize), Cells::uniform(2, (0..n).collect())])
}

/// A chain complex, model or hierarchy, as its `format` says.
fn json(path: &Path) -> Result<Content, CommandError> {
    let text = std::fs::read(path).map_err(|source| CommandError::Read { path: path.to_owned(), source })?;
    let header: Header = serde_json::from_slice(&text).unwrap_or_default();
    match header.format.as_str() {
        "lar-model" => of_model(&Model::read_json(path)?),
        "lar-struct" => of_model(&Struct::read_json(path)?.struct2lar().map_err(SceneError::from)?),
        // Whatever is wrong with any other file, the reader of chain complexes says.
        _ => Ok(Content::Complex(ChainComplex::read_json(path)?)),
    }
}

#[derive(Default, Deserialize)]
struct Header {
    #[serde(default)]
    format: String,
}

/// A surface where there are faces in space.
fn of_model(model: &Model) -> Result<Content, CommandError> {
    if model.dim() >= 2 && model.points().dim() == 3 {
        return Ok(Content::Surface(model.to_surface("").map_err(SceneError::from)?));
    }
    complex(model)
}

fn complex_of(surface: &Surface) -> Result<ChainComplex, CommandError> {
    Ok(ChainComplex::from_surface(surface).map_err(SceneError::from)?)
}

/// The faces of a complex of dimension 2, the boundary of all bounded cells of one of dimension 3.
fn surface_of(complex: &ChainComplex, path: &Path) -> Result<Surface, CommandError> {
    if complex.dim() < 2 {
        return Err(CommandError::NoFaces { path: path.to_owned() });
    }
    let points = complex.points().embedded(3).map_err(SceneError::from)?;
    let mut surface = Surface::new("", points);
    for (mut loops, sign) in complex.all_face_loops().into_iter().zip(face_signs(complex)) {
        if sign < 0 {
            loops.iter_mut().for_each(|cycle| cycle.reverse());
        }
        if sign != 0 {
            surface.push_face(loops.iter().map(Vec::as_slice), 1);
        }
    }
    Ok(surface)
}

/// By face: +1 or −1 where it bounds the sum of the bounded cells, 0 where it does not; +1 without 3-cells.
fn face_signs(complex: &ChainComplex) -> Vec<i32> {
    if complex.dim() < 3 {
        return vec![1; complex.n_cells(2)];
    }
    let has_exterior = complex.validate_with_exterior().is_empty();
    let mut sums = vec![0; complex.n_cells(2)];
    for column in complex.boundary(3).outer_iterator().skip(usize::from(has_exterior)) {
        column.iter().for_each(|(face, &sign)| sums[face] += i32::from(sign));
    }
    sums
}

/// As polygons where the format has them and no face has a hole, else as triangles.
fn write_surface(surface: &Surface, path: &Path) -> Result<(), CommandError> {
    let has_holes =
        || (0..surface.n_faces()).any(|f| surface.face(f).len() > 1 || surface.coefficient(f) != 1);
    let only_triangles = MeshFormat::of_path(path).is_some_and(MeshFormat::is_triangular);
    if only_triangles || has_holes() {
        write_mesh(path, &of_surface(surface)?)?;
    } else {
        write_mesh(path, surface)?;
    }
    Ok(())
}

/// A line `x1 y1 x2 y2` for each edge.
fn write_segments(complex: &ChainComplex, path: &Path) -> Result<(), CommandError> {
    atomic_write(path, |file| {
        for [a, b] in (0..complex.n_cells(1)).filter_map(|e| complex.edge_ends(e)) {
            let [a, b] = [a, b].map(|v| complex.points().point(v as usize));
            writeln!(file, "{} {} {} {}", a[0], a[1], b[0], b[1])?;
        }
        Ok(())
    })?;
    Ok(())
}
