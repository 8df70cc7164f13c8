//! Files, and the programs run on them.
#![allow(dead_code, reason = "each test program uses a part of this module")]

use std::path::{Path, PathBuf};
use std::process::Command;

/// What a program did.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// A temporary directory in which the command `lar` is run.
#[derive(Debug)]
pub(crate) struct Place {
    dir: tempfile::TempDir,
}

impl Place {
    pub(crate) fn new() -> Self {
        Self { dir: tempfile::tempdir().expect("a temporary directory") }
    }

    /// With the three cubes as `a.obj`, `b.obj`, `c.obj`.
    pub(crate) fn with_cubes() -> Self {
        let place = Self::new();
        for name in ["a", "b", "c"] {
            let text = std::fs::read(fixture(&format!("three_cubes_{name}.obj"))).expect("a fixture");
            place.write(&format!("{name}.obj"), text);
        }
        place
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), bytes).expect("a writable directory");
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Paths of all files, sorted.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let mut found = Vec::new();
        let mut open = vec![self.dir.path().to_owned()];
        while let Some(dir) = open.pop() {
            for entry in std::fs::read_dir(dir).expect("a directory") {
                let path = entry.expect("an entry").path();
                if path.is_dir() {
                    open.push(path.clone());
                }
                found.push(path);
            }
        }
        found.sort();
        found
    }

    /// Runs `lar` in this directory.
    pub(crate) fn lar<S: AsRef<std::ffi::OsStr>>(&self, args: &[S]) -> Run {
        self.run(Command::new(env!("CARGO_BIN_EXE_lar")).args(args))
    }

    /// Runs `three_cubes` in this directory.
    pub(crate) fn three_cubes(&self, args: &[&str]) -> Run {
        self.run(Command::new(env!("CARGO_BIN_EXE_three_cubes")).args(args))
    }

    pub(crate) fn run(&self, command: &mut Command) -> Run {
        let output = command.current_dir(self.dir.path()).output().expect("the program starts");
        let text = |bytes| String::from_utf8(bytes).expect("programs print UTF-8");
        Run {
            code: output.status.code().expect("the program ends by itself"),
            out: text(output.stdout),
            err: text(output.stderr),
        }
    }
}

/// A file of the workspace's `fixtures`.
pub(crate) fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures").join(name)
}
