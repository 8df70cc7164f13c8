//! The workflow of the 2019 paper on three cubes; see [`lar_examples::three_cubes`].

use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::main(|args, out, err| lar_examples::three_cubes::run(args, out, err))
}
