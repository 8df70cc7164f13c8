//! The programs `figures`, `figure1`, `figure2`, `figure3`.

use super::collection::{COLLECTION, Drawn, Entry, Request};
use super::write_figures;
use crate::size::Size;
use crate::{CommandError, program};
use clap::Parser;
use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
struct Options {
    /// Write the pictures as PNG, those of the plane also as SVG, into this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Open a window on the last picture.
    #[arg(long)]
    view: bool,
    /// For random scenes: another seed is another picture.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Width and height of the pictures in pixels, instead of their own.
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,
}

/// All figures of the paper and the classic scenes: their numbers, their pictures.
#[derive(Debug, Parser)]
#[command(name = "figures", version)]
struct All {
    /// Only this figure; may be given several times.
    #[arg(long, value_name = "NAME", value_parser = entry)]
    only: Vec<Entry>,
    /// Print the names and what they show.
    #[arg(long)]
    list: bool,
    /// Fewer shapes in the scenes that have many.
    #[arg(long)]
    small: bool,
    #[command(flatten)]
    options: Options,
}

/// The 3-cells of the arrangement of five random cubes, each fitted into a square.
#[derive(Debug, Parser)]
#[command(name = "figure1", version)]
struct Figure1 {
    #[command(flatten)]
    options: Options,
}

/// Gift wrapping of one 3-cell of five random cubes, step by step.
#[derive(Debug, Parser)]
#[command(name = "figure2", version)]
struct Figure2 {
    #[command(flatten)]
    options: Options,
}

/// The pipeline from two solids to the chain complex, in eight panels.
#[derive(Debug, Parser)]
#[command(name = "figure3", version)]
struct Figure3 {
    #[command(flatten)]
    options: Options,
}

fn entry(name: &str) -> Result<Entry, String> {
    let found = COLLECTION.iter().find(|entry| entry.name == name);
    let names = || COLLECTION.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", ");
    found.copied().ok_or_else(|| format!("the figures are {}", names()))
}

/// Runs `figures`: `args` begin with its name, the numbers go to `out`, an error is one line on `err`. Returns the exit
/// code: 0 done, 2 bad usage or an output that cannot be written, 3 no graphics adapter or display; then the numbers are
/// printed all the same.
pub fn run_figures(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |All { only, list, small, options }: All, out| {
        let entries = if only.is_empty() { COLLECTION } else { &only };
        if list {
            return entries.iter().try_for_each(|e| Ok(writeln!(out, "{:<18}{}", e.name, e.title)?));
        }
        options.run(entries, small, out)
    })
}

/// Runs `figure1`, as [`run_figures`].
pub fn run_figure1(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |Figure1 { options }: Figure1, out| {
        options.run(&COLLECTION[..1], false, out)
    })
}

/// Runs `figure2`, as [`run_figures`].
pub fn run_figure2(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |Figure2 { options }: Figure2, out| {
        options.run(&COLLECTION[1..2], false, out)
    })
}

/// Runs `figure3`, as [`run_figures`].
pub fn run_figure3(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |Figure3 { options }: Figure3, out| {
        options.run(&COLLECTION[2..3], false, out)
    })
}

impl Options {
    fn run(&self, entries: &[Entry], small: bool, out: &mut dyn Write) -> Result<(), CommandError> {
        let size = self.size.map(|size| [size.width, size.height]);
        let request = Request { seed: self.seed, size, small };
        let mut last = None;
        for entry in entries {
            if entries.len() > 1 {
                writeln!(out, "\n{}: {}", entry.name, entry.title)?;
            }
            let Drawn { numbers, mut figures } = entry.draw(&request)?;
            write!(out, "{numbers}")?;
            out.flush()?;
            if let Some(dir) = &self.out {
                let adapter = write_figures(&figures, dir)?;
                for figure in &figures {
                    let path = dir.join(format!("{}.png", figure.name));
                    writeln!(out, "{}  {}, drawn by {adapter}", path.display(), figure.title)?;
                }
                out.flush()?;
            }
            last = figures.pop().or(last);
        }
        match last {
            Some(figure) if self.view => program::show(figure.scene, figure.view, &figure.name),
            _ => Ok(()),
        }
    }
}
