//! What all programs share: parsing of arguments, one line for an error, exit codes.

use crate::CommandError;
use clap::{Parser, error::ErrorKind};
use std::env::ArgsOs;
use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

/// Keeps freed memory for what comes next: an arrangement fills and frees many large arrays, and getting fresh pages for
/// each from the system is a fifth of its time.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// As shells have it: 128 + the number of the signal that Ctrl-C sends.
const INTERRUPTED: i32 = 130;

/// The main function of a program: `run` is given the arguments, the standard output and the error stream, and returns
/// the exit code. Ctrl-C, or a request to end, removes unfinished outputs and exits with 130.
pub fn main(run: impl FnOnce(ArgsOs, &mut dyn Write, &mut dyn Write) -> u8) -> ExitCode {
    // When the parent process has interrupts ignored, they stay ignored.
    let _ = ctrlc::try_set_handler(|| {
        let _removed = lar_core::remove_temporaries();
        std::process::exit(INTERRUPTED);
    });
    // The error stream is not locked: progress is drawn there by the threads at work.
    run(std::env::args_os(), &mut io::stdout().lock(), &mut io::stderr()).into()
}

/// Parses the arguments, the program's name first, and runs the program. Results go to `out`; an error is one line
/// `name: …` on `err`. Returns the exit code.
pub(crate) fn run<P: Parser>(
    args: impl IntoIterator<Item = OsString>,
    out: &mut dyn Write,
    err: &mut dyn Write,
    program: impl FnOnce(P, &mut dyn Write) -> Result<(), CommandError>,
) -> u8 {
    let name = P::command().get_name().to_owned();
    let done = match P::try_parse_from(args) {
        Ok(parsed) => program(parsed, out).and_then(|()| Ok(out.flush()?)),
        Err(help) if matches!(help.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) => {
            write!(out, "{help}").and_then(|()| out.flush()).map_err(CommandError::Print)
        }
        Err(usage) => Err(CommandError::Usage(first_paragraph(&usage.to_string()))),
    };
    match done {
        Ok(()) => 0,
        // Whoever reads the output has seen enough.
        Err(CommandError::Print(error)) if error.kind() == io::ErrorKind::BrokenPipe => 0,
        Err(error) => {
            // When even the error stream is closed, the exit code still tells.
            let _ = writeln!(err, "{name}: {}", one_line(&error.to_string()));
            error.exit_code()
        }
    }
}

/// Shows a scene in a window until it is closed.
#[cfg(feature = "window")]
pub(crate) fn show(
    scene: lar_viewer::Scene,
    view: lar_viewer::View,
    title: &str,
) -> Result<(), CommandError> {
    Ok(lar_viewer::view(scene, view, title)?)
}

#[cfg(all(feature = "viewer", not(feature = "window")))]
pub(crate) fn show(_: lar_viewer::Scene, _: lar_viewer::View, _: &str) -> Result<(), CommandError> {
    Err(CommandError::NotBuilt { feature: "window" })
}

/// What clap says of a usage error, without usage and tips.
fn first_paragraph(text: &str) -> String {
    let paragraph = text.split("\n\n").next().unwrap_or(text);
    let lines: Vec<&str> = paragraph.lines().map(str::trim).collect();
    lines.join(" ").trim_start_matches("error: ").to_owned()
}

/// File names may hold line breaks; a message is one line all the same.
fn one_line(message: &str) -> String {
    message.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Parser)]
    #[command(name = "test", version = "1.2")]
    struct Arguments {
        /// A number.
        #[arg(long)]
        n: u32,
    }

    #[track_caller]
    fn check(args: &[&str], result: Result<(), CommandError>, expected: (u8, &str, &str)) {
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let args = ["test"].iter().chain(args).map(OsString::from);
        let code = run(args, &mut out, &mut err, |parsed: Arguments, out| {
            writeln!(out, "n = {}", parsed.n)?;
            result
        });
        let texts = [out, err].map(|bytes| String::from_utf8(bytes).unwrap());
        assert_eq!((code, texts[0].as_str(), texts[1].as_str()), expected);
    }

    #[test]
    fn codes_and_lines() {
        let usage = |text: &str| Err(CommandError::Usage(text.to_owned()));
        check(&["--n", "3"], Ok(()), (0, "n = 3\n", ""));
        check(&["--version"], Ok(()), (0, "test 1.2\n", ""));
        check(&["--n", "3"], usage("two\nlines"), (2, "n = 3\n", "test: two lines\n"));
        let message = "test: the following required arguments were not provided: --n <N>\n";
        check(&[], Ok(()), (2, "", message));
        let closed = Err(CommandError::Print(io::ErrorKind::BrokenPipe.into()));
        check(&["--n", "3"], closed, (0, "n = 3\n", ""));
        let full = Err(CommandError::Print(io::Error::other("disk full")));
        let message = "test: cannot write to the standard output: disk full\n";
        check(&["--n", "3"], full, (2, "n = 3\n", message));
    }
}
