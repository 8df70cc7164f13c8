//! Walls, openings and rooms of a floor plan; see [`lar_examples::plane::floor_plan`].

use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::main(|args, out, err| lar_examples::plane::floor_plan::run(args, out, err))
}
