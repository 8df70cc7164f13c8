//! The public API of the libraries as text, compared with tests/api: what is removed or changed there breaks users. To
//! accept: `INSTA_UPDATE=always cargo test -p lar-examples --test api`, and the version says so (CONTRIBUTING.md).
//!
//! The text is made from rustdoc's JSON, whose form goes with the compiler: the test runs with the minimum Rust version
//! of the workspace, and passes by with others.
#![cfg(unix)]

use public_api::{Builder, PublicApi};
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What paths may begin with anywhere.
const LANGUAGE: &str =
    "core alloc std bool char str f32 f64 i8 i16 i32 i64 i128 isize u8 u16 u32 u64 u128 usize";
const CRATES: [&str; 4] = ["lar-core", "lar-arrangement", "lar-triangle", "lar-viewer"];

fn output(command: &mut Command) -> String {
    let out = command.output().expect("the program starts");
    assert!(out.status.success(), "{command:?}: {}", String::from_utf8_lossy(&out.stderr));
    String::from_utf8(out.stdout).expect("UTF-8")
}

fn is_minimum_version() -> bool {
    let version = output(Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into())).arg("--version"));
    version.starts_with(concat!("rustc ", env!("CARGO_PKG_RUST_VERSION"), "."))
}

/// Writes rustdoc's JSON of all crates and returns its directory. Only rustdoc is told to take unstable options, so that
/// cargo finds all dependencies checked by earlier commands.
fn documented() -> PathBuf {
    let dir = tempfile::tempdir().expect("a temporary directory");
    let rustdoc = dir.path().join("rustdoc");
    fs::write(&rustdoc, "#!/bin/sh\nRUSTC_BOOTSTRAP=1 exec rustdoc \"$@\"\n").expect("a writable directory");
    fs::set_permissions(&rustdoc, fs::Permissions::from_mode(0o755)).expect("its own file");
    let cargo = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO"));
        command.args(arguments).current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
        command.env("RUSTDOC", &rustdoc).env("RUSTDOCFLAGS", "-Zunstable-options --output-format=json");
        output(&mut command)
    };
    cargo(&["doc", "--workspace", "--no-deps", "--lib", "--locked"]);
    let metadata = cargo(&["metadata", "--no-deps", "--format-version=1", "--locked"]);
    let metadata: serde_json::Value = serde_json::from_str(&metadata).expect("cargo writes JSON");
    Path::new(metadata["target_directory"].as_str().expect("cargo names it")).join("doc")
}

fn api(json: PathBuf) -> PublicApi {
    Builder::from_rustdoc_json(json)
        .omit_blanket_impls(true)
        .omit_auto_trait_impls(true)
        .omit_auto_derived_impls(true)
        .build()
        .unwrap_or_else(|e| panic!("{e}"))
}

/// The crates that paths of a text begin with.
fn named_crates(text: &str) -> BTreeSet<&str> {
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let paths = text.split(|c| !is_path(c)).filter(|w| w.contains("::") && !w.starts_with(':'));
    let first = paths.filter_map(|path| path.split("::").next());
    first.filter(|name| name.starts_with(char::is_lowercase)).collect()
}

#[test]
fn public_api() {
    if !is_minimum_version() {
        return;
    }
    let directory = documented();
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("api");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let mut reexported: BTreeSet<String> = LANGUAGE.split(' ').map(String::from).collect();
    for name in CRATES {
        let library = name.replace('-', "_");
        let text = api(directory.join(&library).with_extension("json")).to_string();
        reexported.insert(library);
        reexported.extend(
            text.lines().filter_map(|l| l.strip_prefix("pub use ")?.rsplit("::").next()).map(String::from),
        );
        let foreign: Vec<&str> =
            named_crates(&text).into_iter().filter(|c| !reexported.contains(*c)).collect();
        assert_eq!(foreign, [""; 0], "{name} has types in its signatures that users cannot name through it");
        settings.bind(|| insta::assert_snapshot!(name, text));
    }
}
