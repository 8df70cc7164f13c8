//! Rules about the workspace itself: which crate may depend on which, what the geometry may pull in, licences.

use serde_json::Value;
use std::collections::BTreeSet;
use std::process::Command;

fn cargo(arguments: &[&str]) -> String {
    let out = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
        .output()
        .expect("cargo runs");
    assert!(out.status.success(), "cargo {arguments:?}: {}", String::from_utf8_lossy(&out.stderr));
    String::from_utf8(out.stdout).expect("cargo writes UTF-8")
}

/// Names of all crates that a crate is built with, itself left out.
fn tree(package: &str, options: &[&str]) -> BTreeSet<String> {
    let mut arguments =
        vec!["tree", "--locked", "-p", package, "-e", "normal", "--prefix", "none", "--format", "{lib}"];
    arguments.extend(options);
    cargo(&arguments)
        .lines()
        .map(|line| line.trim_end_matches(" (*)").replace('_', "-"))
        .filter(|n| n != package)
        .collect()
}

const OURS: [&str; 5] = ["lar-core", "lar-arrangement", "lar-triangle", "lar-viewer", "lar-examples"];
const GRAPHICS: [&str; 5] = ["wgpu", "winit", "egui", "egui-wgpu", "egui-winit"];

#[track_caller]
fn check(package: &str, options: &[&str], ours: &[&str], forbidden: &[&str]) {
    let tree = tree(package, options);
    let found: Vec<&str> = OURS.into_iter().filter(|name| tree.contains(*name)).collect();
    assert_eq!(found, ours, "{package} {options:?} depends on other crates of the workspace than it may");
    let present: Vec<&&str> = forbidden.iter().filter(|name| tree.contains(**name)).collect();
    assert!(present.is_empty(), "{package} {options:?} pulls in {present:?}");
}

#[test]
fn crates_meet_only_in_lar_core() {
    let no_threads: Vec<&str> = GRAPHICS.into_iter().chain(["rayon", "spade"]).collect();
    check("lar-core", &[], &[], &no_threads);
    check("lar-arrangement", &[], &["lar-core"], &GRAPHICS);
    check("lar-arrangement", &["--no-default-features"], &["lar-core"], &["rayon"]);
    check("lar-triangle", &[], &["lar-core"], &GRAPHICS);
    check("lar-triangle", &["--no-default-features"], &["lar-core"], &["rayon"]);
    check("lar-viewer", &[], &["lar-core"], &["rayon", "spade"]);
    check("lar-viewer", &["--no-default-features"], &["lar-core"], &["winit", "egui", "egui-winit"]);
}

#[test]
fn the_command_builds_without_graphics() {
    let all_but_viewer = ["lar-core", "lar-arrangement", "lar-triangle"];
    check("lar-examples", &["--no-default-features"], &all_but_viewer, &GRAPHICS);
}

/// The same list as in deny.toml.
const LICENCES: [&str; 10] = [
    "MIT",
    "MIT-0",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "ISC",
    "Unicode-3.0",
    "Zlib",
];

/// An SPDX expression without nested parentheses: some alternative has only licences of the list.
fn is_allowed(expression: &str) -> bool {
    let term = |t: &str| LICENCES.contains(&t.trim());
    let any = |group: &str| group.replace('/', " OR ").split(" OR ").any(term);
    expression.replace(") AND (", ")&(").replace(") AND ", ")&").replace(" AND (", "&(").split('&').all(
        |part| match part.strip_prefix('(').and_then(|p| p.strip_suffix(')')) {
            Some(group) => any(group),
            None if part.contains(" AND ") => part.split(" AND ").all(any),
            None => any(part),
        },
    )
}

/// The line below its title.
#[test]
fn the_readme_states_rust_version_and_licence() {
    let text = cargo(&["metadata", "--format-version", "1", "--locked", "--no-deps"]);
    let metadata: Value = serde_json::from_str(&text).expect("cargo metadata is JSON");
    let line = include_str!("../../README.md").lines().nth(2).expect("a line below the title");
    for package in metadata["packages"].as_array().expect("a list of packages") {
        let version = package["rust_version"].as_str().expect("a Rust version");
        assert!(line.contains(&format!("Rust {version} or newer")), "{}: {version}", package["name"]);
        assert_eq!(package["license"], "MIT OR Apache-2.0", "{}", package["name"]);
    }
    assert!(line.contains("[MIT](LICENSE-MIT) or [Apache-2.0](LICENSE-APACHE)"), "{line}");
}

#[test]
fn licences_are_permissive() {
    let text = cargo(&["metadata", "--format-version", "1", "--locked", "--all-features"]);
    let metadata: Value = serde_json::from_str(&text).expect("cargo metadata is JSON");
    let packages = metadata["packages"].as_array().expect("a list of packages");
    assert!(packages.len() > 50, "the list is complete");
    for package in packages {
        let name = package["name"].as_str().unwrap_or("?");
        let licence = package["license"].as_str().unwrap_or("none");
        // Its code is MIT OR Apache-2.0; the fonts inside are under OFL-1.1 and the Ubuntu font licence.
        let is_font = name == "epaint_default_fonts";
        assert!(is_font || is_allowed(licence), "{name}: licence {licence}");
    }
}

/// Crates that the programs hold in two versions, because crates of others ask for both. A new one should be known.
#[test]
#[cfg(target_os = "linux")]
fn duplicates_are_known() {
    let arguments =
        ["tree", "--locked", "--workspace", "-d", "-e", "normal", "--depth", "0", "--prefix", "none"];
    let text = cargo(&arguments);
    let crates: BTreeSet<(&str, &str)> = text
        .lines()
        .filter_map(|line| line.split_once(' '))
        .map(|(n, v)| (n, v.trim_end_matches(" (*)")))
        .collect();
    let names: Vec<&str> = crates.iter().map(|(name, _)| *name).collect();
    let twice: Vec<&str> = names.windows(2).filter(|w| w[0] == w[1]).map(|w| w[0]).collect();
    let known = [
        "hashbrown",
        "linux-raw-sys",
        "miniz_oxide",
        "rustc-hash",
        "rustix",
        "syn",
        "thiserror",
        "thiserror-impl",
    ];
    assert_eq!(twice, known);
}
