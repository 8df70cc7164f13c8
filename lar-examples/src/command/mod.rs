//! The command `lar`: arrangements and Booleans of surfaces and of drawings in the plane, pictures of them, facts about
//! files.
//!
//! ```text
//! lar arrange INPUT... [--json PATH|-] [--complex PATH [--exact]] [--obj DIR] [--stats] [--as-given | --tolerance LENGTH]
//!           [--merge-coplanar] [--threads N]
//! lar boolean EXPR INPUT... -o OUT [--json PATH|-] [--fill RULE] [--keep-fragments] [--as-given | --tolerance LENGTH]
//!           [--merge-coplanar] [--threads N]
//! lar boolean -e NAME=EXPR... INPUT... -o DIR [--format EXT] …
//! lar render INPUT... -o OUT.png|.svg [--size WxH] [camera] [look] [accent]
//! lar view INPUT... [camera] [look] [accent]
//! lar export-html INPUT... -o OUT.html [--title TEXT] [--viewer PAGE.html] [camera] [look]
//! lar info INPUT [--json PATH|-]
//! lar measure INPUT... [--density D | NAME=D]... [--json PATH|-] [--as-given | --tolerance LENGTH] [--threads N]
//! lar validate INPUT [--json PATH|-]
//! lar clean INPUT -o OUT [--rule outer|nonzero|positive|even-odd] [--json PATH|-] [--keep-fragments] …
//! lar convert IN OUT [--tolerance T] [--json PATH|-]
//! lar completions SHELL
//! lar man [--out DIR]
//! lar plane INPUT... [--keep-dangling] [--json PATH|-] [--complex PATH] [-o OUT.svg|.png] [--explode S] [--size WxH]
//!           [--tolerance T] [--threads N]
//! lar plane --boolean EXPR INPUT... [--fill RULE] [--json PATH|-] [-o OUT.svg|.png] [--explode S] …
//! ```
//!
//! *camera*: `--view SIDE`, `--azimuth A --elevation E`, or `--eye X,Y,Z --target X,Y,Z --up X,Y,Z`; `--fov F` or
//! `--ortho[=HEIGHT]`. *look*: `--explode S | SX,SY,SZ` `--by solids|cells|faces|edges`, `--levels S0,S1,S2,S3`, `--about`,
//! `--alpha`, `--alpha-of NAME=A,…`, `--cells all|solid`, `--hide CELL,…`, `--only CELL,…`, `--draw` and `--numbers
//! vertices,edges,faces,cells`, `--color`, `--exterior`, `--clip`, `--whole-cells`, `--background`; `lar help render`
//! explains them. *accent*: `--select CELL`, `--boundary CELL`, `--coboundary CELL`, `--where EXPR`,
//! `--wrapping CELL[:PICTURE]`, `--measure VERTEX,VERTEX[,VERTEX]`.
//!
//! Exit codes: 0 done, 1 `validate` found something wrong, 2 bad input or usage, 3 no graphics adapter or display, 130
//! interrupted. An error is one line on the error stream, which also shows a bar when it is a terminal and the work
//! takes a while; files are written whole or not at all, and nothing is computed for an output that cannot be written.

mod arrange;
mod boolean;
mod camera;
mod clean;
mod convert;
mod export_html;
mod info;
mod input;
mod measure;
mod picture;
mod plane;
mod report;
mod result;
mod shell;
mod stats;
mod validate;
mod view;

use crate::{CommandError, program};
use clap::{CommandFactory, Parser, Subcommand};
use std::ffi::OsString;
use std::io::Write;

/// Arrangements and Booleans of polygonal surfaces and of plane drawings, exactly.
#[derive(Debug, Parser)]
#[command(
    name = "lar",
    version,
    after_help = "Exit codes: 0 done, 1 validate found something wrong, 2 bad input or usage, 3 no graphics adapter or \
                  display, 130 interrupted. Reports (--json) are described in docs/formats.md.\n\n\
                  Examples:\n  \
                  lar boolean 'A - B' a.obj b.obj -o out.obj\n  \
                  lar help boolean"
)]
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
    ExportHtml(export_html::ExportHtml),
    Info(info::Info),
    Measure(measure::Measure),
    Validate(validate::Validate),
    Clean(clean::Clean),
    Convert(convert::Convert),
    Plane(plane::Plane),
    Completions(shell::Completions),
    Man(shell::Man),
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
        Command::ExportHtml(export) => export.run(out),
        Command::Info(info) => info.run(out),
        Command::Measure(measure) => measure.run(out),
        Command::Validate(validate) => validate.run(out),
        Command::Clean(clean) => clean.run(out),
        Command::Convert(convert) => convert.run(out),
        Command::Completions(completions) => completions.run(Arguments::command(), out),
        Command::Man(man) => man.run(Arguments::command(), out),
        Command::Plane(plane) => plane.run(out),
    }
}
