//! Real processes stopped by signals, and one that runs on a terminal.
#![cfg(target_os = "linux")]

mod support;

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use support::Place;

/// Starts `lar` with signals as a terminal has them, whatever this test inherited.
fn started(place: &Place, args: &[&str]) -> Child {
    Command::new("env")
        .arg("--default-signal=INT,TERM,HUP")
        .arg(env!("CARGO_BIN_EXE_lar"))
        .args(args)
        .current_dir(place.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("env starts")
}

fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args(["-s", name, &child.id().to_string()]).status();
    assert!(sent.expect("kill starts").success());
}

/// Waits until something holds, for a minute at most.
#[track_caller]
fn wait_until(what: &str, mut holds: impl FnMut() -> bool) {
    let start = Instant::now();
    while !holds() {
        assert!(start.elapsed() < Duration::from_secs(60), "no {what} within a minute");
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// n³ separate cubes, or cubes that all meet each other when `spacing` is small.
fn cubes(n: usize, spacing: f64) -> String {
    let mut text = String::new();
    for (at, i) in (0..n * n * n).zip(0..) {
        let corner = [at / (n * n), at / n % n, at % n].map(|k| k as f64 * spacing);
        for c in 0..8u32 {
            let p = [0, 1, 2].map(|k| corner[k] + f64::from(c >> k & 1));
            writeln!(text, "v {} {} {}", p[0], p[1], p[2]).unwrap();
        }
        for face in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
            let [a, b, c, d] = face.map(|v| 8 * i + v + 1);
            writeln!(text, "f {a} {b} {c} {d}").unwrap();
        }
    }
    text
}

fn n_entries(dir: &Path) -> usize {
    std::fs::read_dir(dir).map_or(0, Iterator::count)
}

/// The hidden directory beside a name, if there is one.
fn hidden(place: &Place, name: &str) -> Option<std::path::PathBuf> {
    let entries = std::fs::read_dir(place.path("")).expect("a directory");
    let starts = format!(".{name}.");
    let names = entries.filter_map(|e| e.ok().map(|e| e.file_name().to_string_lossy().into_owned()));
    names.into_iter().find(|n| n.starts_with(&starts)).map(|n| place.path(&n))
}

#[track_caller]
fn check_interrupted(place: &Place, mut child: Child, name: &str) {
    let before = place.files().into_iter().filter(|p| !p.to_string_lossy().ends_with(".tmp"));
    let before: Vec<_> =
        before.filter(|p| !p.parent().unwrap().to_string_lossy().ends_with(".tmp")).collect();
    signal(&child, name);
    let status = child.wait().expect("the process ends");
    assert_eq!(status.code(), Some(130), "{status}");
    assert_eq!(place.files(), before, "nothing is left, nothing is missing");
}

#[test]
fn interrupted_while_it_computes() {
    for name in ["INT", "TERM"] {
        let place = Place::new();
        place.write("cubes.obj", cubes(12, 0.07));
        place.write("out.json", "old");
        let outputs = ["--json", "out.json", "--complex", "complex.json", "--obj", "cells"];
        let mut child = started(&place, &[&["arrange", "cubes.obj"][..], &outputs].concat());
        std::thread::sleep(Duration::from_millis(400));
        assert!(child.try_wait().unwrap().is_none(), "the scene is too small");
        check_interrupted(&place, child, name);
        assert_eq!(place.read("out.json"), "old");
    }
}

#[test]
fn interrupted_while_it_writes_a_directory() {
    let place = Place::new();
    place.write("cubes.obj", cubes(16, 1.5));
    let child = started(&place, &["arrange", "cubes.obj", "--obj", "cells"]);
    wait_until("cell", || hidden(&place, "cells").is_some_and(|dir| n_entries(&dir) > 3));
    check_interrupted(&place, child, "INT");
}

/// The JSON goes to a pipe that nobody reads: the process stands in the middle of its last output.
#[test]
fn interrupted_while_an_output_stands_still() {
    let place = Place::new();
    place.write("cubes.obj", cubes(2, 1.5));
    assert!(Command::new("mkfifo").arg(place.path("pipe")).status().expect("mkfifo starts").success());
    let child = started(&place, &["arrange", "cubes.obj", "--obj", "cells", "--json", "pipe"]);
    wait_until("directory", || place.path("cells").is_dir());
    check_interrupted(&place, child, "INT");
    assert_eq!(n_entries(&place.path("cells")), 8);
}

#[test]
fn a_bar_on_a_terminal_only() {
    let place = Place::new();
    place.write("cubes.obj", cubes(9, 0.3));
    let lar = env!("CARGO_BIN_EXE_lar");
    let command = format!("'{lar}' arrange cubes.obj --json report.json");
    let on_terminal =
        place.run(Command::new("script").args(["-qec", &command, "/dev/null"]).stdin(Stdio::null()));
    assert_eq!(on_terminal.code, 0);
    assert!(on_terminal.out.contains(" % "), "{}", on_terminal.out);
    let run = place.lar(&["arrange", "cubes.obj", "--json", "report.json"]);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    assert!(!run.out.contains(" % "));
}
