//! Figure 3 of the 2019 paper; see [`lar_examples::figures`].

use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::main(|args, out, err| lar_examples::figures::run_figure3(args, out, err))
}
