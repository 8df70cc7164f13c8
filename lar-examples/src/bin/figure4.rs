//! Figure 4 of the 2019 paper; see [`lar_examples::plane::figures`].

use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::main(|args, out, err| lar_examples::plane::figures::run_figure4(args, out, err))
}
