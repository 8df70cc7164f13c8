//! `lar completions` and `lar man`: what a package of the command brings along.

use crate::CommandError;
use crate::output::write_directory;
use clap::Command;
use clap_complete::Shell;
use lar_core::atomic_write;
use std::io::{self, Write};
use std::path::PathBuf;

/// Completions of this command for a shell, on the standard output.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  \
                        lar completions bash > /usr/share/bash-completion/completions/lar\n  \
                        lar completions zsh > ~/.zfunc/_lar")]
pub(crate) struct Completions {
    /// The shell.
    #[arg(value_enum, value_name = "SHELL")]
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(&self, mut command: Command, out: &mut dyn Write) -> Result<(), CommandError> {
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut command, "lar", &mut text);
        Ok(out.write_all(&text)?)
    }
}

/// Manual pages of this command: that of `lar` on the standard output, or all in a directory.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  lar man | man -l -\n  lar man --out man1")]
pub(crate) struct Man {
    /// Write lar.1 and a page for each subcommand, lar-arrange.1 and so on, into this new directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Man {
    pub(crate) fn run(&self, mut command: Command, out: &mut dyn Write) -> Result<(), CommandError> {
        command.build();
        let Some(dir) = &self.out else {
            return Ok(out.write_all(&page(command)?)?);
        };
        let subcommands = command.get_subcommands().filter(|c| c.get_name() != "help");
        let named = subcommands.map(|c| (format!("lar-{}", c.get_name()), c.clone()));
        let pages: Vec<(String, Command)> = named.chain([("lar".to_owned(), command.clone())]).collect();
        write_directory(dir, |dir| {
            for (name, command) in pages {
                let page = page(command)?;
                atomic_write(dir.join(format!("{name}.1")), |file| file.write_all(&page))?;
            }
            Ok(())
        })
    }
}

fn page(command: Command) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    clap_mangen::Man::new(command).render(&mut text)?;
    Ok(text)
}
