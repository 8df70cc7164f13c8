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

/// The partition of the plane that random circles and regular polygons generate.
#[derive(Debug, Parser)]
#[command(name = "figure4", version)]
struct Figure4 {
    /// Number of circles, and of polygons.
    #[arg(long, value_name = "N", default_value = "16")]
    shapes: usize,
    #[command(flatten)]
    options: Options,
}

/// The partition of the plane that random rectangles generate.
#[derive(Debug, Parser)]
#[command(name = "figure5", version)]
struct Figure5 {
    /// Number of rectangles.
    #[arg(long, value_name = "N", default_value = "40")]
    shapes: usize,
    #[command(flatten)]
    options: Options,
}

#[derive(Debug, clap::Args)]
struct Options {
    /// Write each panel as SVG and PNG into this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Another seed is another picture.
    #[arg(long, value_name = "N", default_value = "4")]
    seed: u64,
    /// Width and height of the PNGs in pixels.
    #[arg(long, value_name = "WxH", default_value = "1000x1000")]
    size: Size,
}

/// Runs `figure4`: `args` begin with its name, the numbers go to `out`, an error is one line on `err`. Returns the exit
/// code: 0 done, 2 bad usage or an output that cannot be written, 3 no graphics adapter; then the numbers are printed
/// and the SVGs written all the same.
pub fn run_figure4(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |Figure4 { shapes, options }: Figure4, out| {
        options.run("figure4", &scenes::circles_and_polygons(shapes, options.seed), figure4, out)
    })
}

/// Runs `figure5`, as [`run_figure4`].
pub fn run_figure5(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |Figure5 { shapes, options }: Figure5, out| {
        options.run("figure5", &scenes::rectangles(shapes, options.seed), figure5, out)
    })
}

impl Options {
    fn run(
        &self,
        name: &str,
        outlines: &[Outline],
        panels: impl Fn(&[Outline], &PlanarArrangement) -> Vec<Panel>,
        out: &mut dyn Write,
    ) -> Result<(), CommandError> {
        let drawing = scenes::drawing(outlines);
        let arrangement = planar_arrangement(&drawing)?;
        let [vertices, edges, faces] =
            [arrangement.n_vertices(), arrangement.n_edges(), arrangement.n_faces()];
        writeln!(out, "{} outlines of {} segments", outlines.len(), drawing.n_segments())?;
        writeln!(out, "{vertices} vertices, {edges} edges, {faces} bounded faces")?;
        let (components, loops) = (arrangement.n_components(), arrangement.n_loops());
        writeln!(out, "{components} components, {loops} loops, area {:.6}", arrangement_area(&arrangement))?;
        out.flush()?;
        let Some(dir) = &self.out else { return Ok(()) };
        let panels = panels(outlines, &arrangement);
        let pictures: Vec<(String, &str, &Picture)> =
            panels.iter().map(|p| (format!("{name}{}", p.letter), p.title, &p.picture)).collect();
        write_pictures(&pictures, dir, [self.size.width, self.size.height], out)
    }
}

/// Area of the bounded faces together.
fn arrangement_area(arrangement: &PlanarArrangement) -> f64 {
    0.0 - arrangement.area(lar_core::FaceId(0))
}

/// Writes pictures by their names as SVG and then as PNG into a directory, which is made when it is missing, and prints
/// a line for each file. The SVGs are there even when no PNG can be drawn.
pub(super) fn write_pictures(
    pictures: &[(String, &str, &Picture)],
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
