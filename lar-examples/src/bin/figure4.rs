//! Figure 4 of the 2019 paper; see [`lar_examples::plane::figures`].

use std::io::{stderr, stdout};
use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::plane::figures::run_figure4(std::env::args_os(), &mut stdout().lock(), &mut stderr().lock())
        .into()
}
