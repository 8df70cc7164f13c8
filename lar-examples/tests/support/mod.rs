//! Files, and the programs run on them.
#![allow(dead_code, reason = "each test program uses a part of this module")]

use serde_json::Value;
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
        self.program(env!("CARGO_BIN_EXE_three_cubes"), args)
    }

    /// Runs another of the programs in this directory.
    pub(crate) fn program(&self, program: &str, args: &[&str]) -> Run {
        self.run(Command::new(program).args(args))
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

/// The page of the viewer with something else in the place of its code.
pub(crate) fn viewer_page() -> String {
    let page = include_str!("../../../lar-viewer/web/page.html");
    let viewer = "<script id=\"lar-viewer\" type=\"application/octet-stream\">AAAA</script>";
    assert_eq!(page.matches("<!--lar:viewer-->").count(), 1);
    page.replace("<!--lar:viewer-->", viewer)
}

/// A file of the workspace's `fixtures`.
pub(crate) fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures").join(name)
}

/// Runs `lar` and expects success without a word on the error stream.
#[track_caller]
pub(crate) fn done<S: AsRef<std::ffi::OsStr>>(place: &Place, args: &[S]) -> Run {
    let run = place.lar(args);
    assert_eq!((run.code, run.err.as_str()), (0, ""), "{run:?}");
    run
}

pub(crate) fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

/// Numbers that differ from run to run or from machine to machine replaced by their kind.
pub(crate) fn redacted(json: &str) -> String {
    let mut value: Value = serde_json::from_str(json).expect("valid JSON");
    value["threads"] = "[threads]".into();
    redact(&mut value["seconds"]);
    if value.get("peak_memory").is_some_and(|bytes| bytes.is_null() || bytes.is_u64()) {
        value["peak_memory"] = "[bytes]".into();
    }
    round(&mut value);
    serde_json::to_string_pretty(&value).expect("a value")
}

fn redact(seconds: &mut Value) {
    match seconds {
        Value::Object(map) => map.values_mut().for_each(redact),
        Value::Number(time) if time.as_f64().is_some_and(|t| 0.0 <= t) => *seconds = "[seconds]".into(),
        other => panic!("{other} is no time"),
    }
}

/// Floating-point numbers to nine digits: the last bits depend on the machine's sine and cosine.
fn round(value: &mut Value) {
    match value {
        Value::Object(map) => map.values_mut().for_each(round),
        Value::Array(list) => list.iter_mut().for_each(round),
        Value::Number(n) if n.is_f64() => *value = format!("{:.8e}", n.as_f64().unwrap_or(f64::NAN)).into(),
        _ => {}
    }
}

/// Pixels that differ by more than 8 of 255 in a channel.
pub(crate) fn differing(a: &[u8], b: &[u8]) -> usize {
    let pixels = a.chunks_exact(4).zip(b.chunks_exact(4));
    pixels.filter(|(a, b)| a.iter().zip(*b).any(|(x, y)| 8 < x.abs_diff(*y))).count()
}

/// Size and pixels of a picture.
pub(crate) fn read_png(path: &Path) -> ([u32; 2], Vec<u8>) {
    let file = std::fs::File::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    ([info.width, info.height], pixels)
}
