//! Programs that draw the planar figures of Paoluzzi et al. 2019, §6.1: `figure4`, circles and regular polygons, and
//! `figure5`, rectangles, both at random.

use super::file::PictureFile;
use super::picture::Picture;
use super::scenes::{self, Outline};
use crate::size::Size;
use crate::{CommandError, program};
use clap::Parser;
use lar_arrangement::planar::{PlanarArrangement, planar_arrangement};
use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Circles of Figure 4, and polygons.
pub(crate) const CIRCLES: usize = 16;

/// Rectangles of Figure 5.
pub(crate) const RECTANGLES: usize = 40;

/// Seed of both figures.
pub(crate) const SEED: u64 = 4;

/// Factor of the exploded panels.
const EXPLODE: f64 = 1.35;

/// Factor by which the fragments of edges are moved: small, as there are many in a row.
const FRAGMENTS_EXPLODE: f64 = 1.25;

/// One panel of a figure.
#[derive(Clone, Debug)]
pub struct Panel {
    /// `a` … `d`.
    pub letter: char,
    /// What it shows.
    pub title: &'static str,
    /// The picture.
    pub picture: Picture,
}

/// The four panels of Figure 4: the outlines, the partition that they generate, the partition exploded, and the
/// boundary cycles of its faces, exploded.
#[must_use]
pub fn figure4(outlines: &[Outline], arrangement: &PlanarArrangement) -> Vec<Panel> {
    let panel = |letter, title, picture| Panel { letter, title, picture };
    vec![
        panel('a', "input", Picture::outlines(outlines.iter().cloned())),
        panel('b', "partition", Picture::partition(arrangement, 1.0)),
        panel('c', "partition, exploded", Picture::partition(arrangement, EXPLODE)),
        panel('d', "boundary cycles, exploded", Picture::cycles(arrangement, EXPLODE)),
    ]
}

/// The panels of Figure 5: the edges of the partition that the outlines generate, exploded, in the colours of their
/// outlines; the partition; the partition exploded.
#[must_use]
pub fn figure5(outlines: &[Outline], arrangement: &PlanarArrangement) -> Vec<Panel> {
    let sizes: Vec<usize> = outlines.iter().map(Vec::len).collect();
    let panel = |letter, title, picture| Panel { letter, title, picture };
    vec![
        panel('a', "fragments, exploded", Picture::fragments(arrangement, &sizes, FRAGMENTS_EXPLODE)),
        panel('b', "partition", Picture::partition(arrangement, 1.0)),
        panel('c', "partition, exploded", Picture::partition(arrangement, EXPLODE)),
    ]
}

/// What a program prints, and the pictures that it draws, by the names of their files.
pub(crate) struct Pictures {
    pub numbers: String,
    pub pictures: Vec<(String, &'static str, Picture)>,
}

/// Figure 4 with so many circles, and polygons.
pub(crate) fn circles_and_polygons(shapes: usize, seed: u64) -> Result<Pictures, CommandError> {
    pictures("figure4", &scenes::circles_and_polygons(shapes, seed), figure4)
}

/// Figure 5 with so many rectangles.
pub(crate) fn rectangles(shapes: usize, seed: u64) -> Result<Pictures, CommandError> {
    pictures("figure5", &scenes::rectangles(shapes, seed), figure5)
}

fn pictures(
    name: &str,
    outlines: &[Outline],
    panels: impl Fn(&[Outline], &PlanarArrangement) -> Vec<Panel>,
) -> Result<Pictures, CommandError> {
    let drawing = scenes::drawing(outlines);
    let arrangement = planar_arrangement(&drawing)?;
    let panels = panels(outlines, &arrangement).into_iter();
    Ok(Pictures {
        numbers: numbers(outlines.len(), drawing.n_segments(), &arrangement),
        pictures: panels.map(|p| (format!("{name}{}", p.letter), p.title, p.picture)).collect(),
    })
}

fn numbers(outlines: usize, segments: usize, arrangement: &PlanarArrangement) -> String {
    let [vertices, edges, faces] = [arrangement.n_vertices(), arrangement.n_edges(), arrangement.n_faces()];
    let (components, loops) = (arrangement.n_components(), arrangement.n_loops());
    let area = arrangement_area(arrangement);
    format!(
        "{outlines} outlines of {segments} segments\n\
         {vertices} vertices, {edges} edges, {faces} bounded faces\n\
         {components} components, {loops} loops, area {area:.6}\n"
    )
}

/// The partition of the plane that random circles and regular polygons generate.
#[derive(Debug, Parser)]
#[command(name = "figure4", version)]
struct Figure4 {
    /// Number of circles, and of polygons.
    #[arg(long, value_name = "N", default_value_t = CIRCLES)]
    shapes: usize,
    #[command(flatten)]
    options: Options,
}

/// The partition of the plane that random rectangles generate.
#[derive(Debug, Parser)]
#[command(name = "figure5", version)]
struct Figure5 {
    /// Number of rectangles.
    #[arg(long, value_name = "N", default_value_t = RECTANGLES)]
    shapes: usize,
    #[command(flatten)]
    options: Options,
}

#[derive(Debug, clap::Args)]
struct Options {
    /// Write each panel as SVG and PNG into this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Open a window on the last panel.
    #[arg(long)]
    view: bool,
    /// Another seed is another picture.
    #[arg(long, value_name = "N", default_value_t = SEED)]
    seed: u64,
    /// Width and height of the PNGs in pixels.
    #[arg(long, value_name = "WxH", default_value = "1000x1000")]
    size: Size,
}

/// Runs `figure4`: `args` begin with its name, the numbers go to `out`, an error is one line on `err`. Returns the exit
/// code: 0 done, 2 bad usage or an output that cannot be written, 3 no graphics adapter or display; then the numbers are
/// printed and the SVGs written all the same.
pub fn run_figure4(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |Figure4 { shapes, options }: Figure4, out| {
        options.run(circles_and_polygons(shapes, options.seed)?, out)
    })
}

/// Runs `figure5`, as [`run_figure4`].
pub fn run_figure5(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |Figure5 { shapes, options }: Figure5, out| {
        options.run(rectangles(shapes, options.seed)?, out)
    })
}

impl Options {
    fn run(&self, Pictures { numbers, pictures }: Pictures, out: &mut dyn Write) -> Result<(), CommandError> {
        let size = [self.size.width, self.size.height];
        write!(out, "{numbers}")?;
        deliver(pictures, self.out.as_deref(), self.view, size, out)
    }
}

/// Writes the pictures into a directory, and shows the last in a window, where that was asked for.
pub(super) fn deliver(
    pictures: Vec<(String, &'static str, Picture)>,
    dir: Option<&Path>,
    view: bool,
    size: [u32; 2],
    out: &mut dyn Write,
) -> Result<(), CommandError> {
    out.flush()?;
    if let Some(dir) = dir {
        write_pictures(&pictures, dir, size, out)?;
    }
    match pictures.into_iter().next_back() {
        Some((name, _, picture)) if view => show(&name, &picture, size),
        _ => Ok(()),
    }
}

#[cfg(feature = "viewer")]
fn show(name: &str, picture: &Picture, size: [u32; 2]) -> Result<(), CommandError> {
    let (scene, view) = picture.scene(size)?;
    program::show(scene, view, name)
}

#[cfg(not(feature = "viewer"))]
fn show(_: &str, _: &Picture, _: [u32; 2]) -> Result<(), CommandError> {
    Err(CommandError::NotBuilt { feature: "window" })
}

/// Area of the bounded faces together.
fn arrangement_area(arrangement: &PlanarArrangement) -> f64 {
    0.0 - arrangement.area(lar_core::FaceId(0))
}

/// Writes pictures by their names as SVG and then as PNG into a directory, which is made when it is missing, and prints
/// a line for each file. The SVGs are there even when no PNG can be drawn.
fn write_pictures(
    pictures: &[(String, &str, Picture)],
    dir: &Path,
    size: [u32; 2],
    out: &mut dyn Write,
) -> Result<(), CommandError> {
    std::fs::create_dir_all(dir).map_err(|source| CommandError::Write { path: dir.to_owned(), source })?;
    for extension in ["svg", "png"] {
        for (name, title, picture) in pictures {
            let path = dir.join(format!("{name}.{extension}"));
            let drawn_by = PictureFile::new(&path, size)?.write(picture)?;
            let drawn_by = drawn_by.map_or_else(String::new, |adapter| format!(", drawn by {adapter}"));
            writeln!(out, "{}  {title}{drawn_by}", path.display())?;
        }
        out.flush()?;
    }
    Ok(())
}
