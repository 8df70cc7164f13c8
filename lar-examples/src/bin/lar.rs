//! The command `lar`; see [`lar_examples::command`].

use std::process::ExitCode;

fn main() -> ExitCode {
    lar_examples::main(|args, out, err| lar_examples::command::run(args, out, err))
}
