//! The command `lar`: arrangements and Booleans of surfaces and of drawings in the plane, pictures of them, facts about
//! files.
//!
//! ```text
//! lar arrange INPUT... [--json PATH|-] [--complex PATH] [--obj DIR] [--stats] [--as-given | --tolerance LENGTH]
//!           [--merge-coplanar] [--threads N]
//! lar boolean EXPR INPUT... -o OUT [--json PATH|-] [--fill RULE] [--keep-fragments] [--as-given | --tolerance LENGTH]
//!           [--merge-coplanar] [--threads N]
//! lar render INPUT... -o OUT.png|.svg [--size WxH] [camera] [look]
//! lar view INPUT... [camera] [look]
//! lar info INPUT
//! lar plane INPUT... [--keep-dangling] [--json PATH|-] [--complex PATH] [-o OUT.svg|.png] [--explode S] [--size WxH]
//!           [--tolerance T] [--threads N]
//! lar plane --boolean EXPR INPUT... [--fill RULE] [--json PATH|-] [-o OUT.svg|.png] [--explode S] …
//! ```
//!
//! *camera*: `--view SIDE`, `--azimuth A --elevation E`, or `--eye X,Y,Z --target X,Y,Z --up X,Y,Z`; `--fov F` or
//! `--ortho[=HEIGHT]`. *look*: `--explode S | SX,SY,SZ` `--by solids|cells|faces|edges`, `--levels S0,S1,S2,S3`, `--about`,
//! `--alpha`, `--cells all|solid`, `--draw` and `--numbers vertices,edges,faces,cells`, `--color`, `--exterior`, `--clip`,
//! `--whole-cells`, `--background`; `lar help render` explains them.
//!
//! Exit codes: 0 done, 2 bad input or usage, 3 no graphics adapter or display, 130 interrupted. An error is one line on
//! the error stream, which also shows a bar when it is a terminal and the work takes a while; files are written whole
//! or not at all, and nothing is computed for an output that cannot be written.

mod arrange;
mod boolean;
mod camera;
mod info;
mod input;
mod picture;
mod plane;
mod report;
mod stats;
mod view;

use crate::{CommandError, program};
use clap::{Parser, Subcommand};
use std::ffi::OsString;
use std::io::Write;

/// Arrangements and Booleans of polygonal surfaces and of plane drawings, exactly.
#[derive(Debug, Parser)]
#[command(name = "lar", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Arrange(arrange::Arrange),
    Boolean(boolean::Boolean),
    Render(picture::Render),
    View(view::Window),
    Info(info::Info),
    Plane(plane::Plane),
}

/// Runs the command: `args` begin with the program's name, results go to `out`, an error is one line on `err`.
/// Returns the exit code.
///
/// ```
/// let (mut out, mut err) = (Vec::new(), Vec::new());
/// let code = lar_examples::command::run(["lar", "info", "no.obj"].map(Into::into), &mut out, &mut err);
/// assert_eq!(code, 2);
/// assert!(String::from_utf8(err)?.starts_with("lar: cannot read no.obj: "));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, dispatch)
}

fn dispatch(arguments: Arguments, out: &mut dyn Write) -> Result<(), CommandError> {
    match arguments.command {
        Command::Arrange(arrange) => arrange.run(out),
        Command::Boolean(boolean) => boolean.run(out),
        Command::Render(render) => render.run(out),
        Command::View(window) => window.run(),
        Command::Info(info) => info.run(out),
        Command::Plane(plane) => plane.run(out),
    }
}
