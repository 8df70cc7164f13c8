//! All figures; see [`lar_examples::figures`].

use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::main(|args, out, err| lar_examples::figures::run_figures(args, out, err))
}
