//! The workflow of the 2019 paper on three cubes; see [`lar_examples::three_cubes`].

use std::io::{stderr, stdout};
use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::three_cubes::run(std::env::args_os(), &mut stdout().lock(), &mut stderr().lock()).into()
}
