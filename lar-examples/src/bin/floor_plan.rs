//! Walls, openings and rooms of a floor plan; see [`lar_examples::plane::floor_plan`].

use std::io::{stderr, stdout};
use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::plane::floor_plan::run(std::env::args_os(), &mut stdout().lock(), &mut stderr().lock())
        .into()
}
