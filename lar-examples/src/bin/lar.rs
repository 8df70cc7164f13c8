//! The command `lar`; see [`lar_examples::command`].

use std::io::{stderr, stdout};
use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::command::run(std::env::args_os(), &mut stdout().lock(), &mut stderr().lock()).into()
}
