//! README and guide: every command in them runs, every link leads somewhere, every page is in the table of contents.
//! Their programs run as documentation tests (src/guide.rs).
#![cfg(unix)]

mod support;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use support::Place;

/// What the shell knows when it runs a page: the programs under the names that the pages use. `cargo run` runs what was
/// built with this test; other uses of cargo are this test's own caller. A window is asked for without a display, and
/// must say so. The viewer for browsers is a page without its code.
const PRELUDE: &str = r#"
set -eu
lar() {
    [ "$1" = view ] || { "$PROGRAMS/lar" "$@"; return; }
    code=0
    env -u DISPLAY -u WAYLAND_DISPLAY "$PROGRAMS/lar" "$@" || code=$?
    [ "$code" = 3 ]
}
cargo() {
    [ "$1 $2" = "run --release" ] || return 0
    shift 2
    program=lar
    if [ "$1" = --bin ]; then program=$2; shift 2; fi
    if [ "$1" = -- ]; then shift; fi
    # shellcheck disable=SC2086
    if [ "$program" = lar ]; then lar "$@"; else "$PROGRAMS/$program" "$@" ${SIZE-}; fi
}
"#;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()
        .expect("the workspace is above this crate")
}

/// Markdown files of a directory, by name.
fn pages(directory: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(workspace().join(directory)).expect("a directory");
    let mut found: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
    found.retain(|path| path.extension().is_some_and(|e| e == "md"));
    found.sort();
    found
}

/// Directories of the book.
const BOOK: [&str; 4] = ["docs", "docs/guide", "docs/figures", "docs/decisions"];

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The blocks of a language in a page.
fn blocks(text: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    text.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap_or_default().to_owned()).collect()
}

/// Runs the commands of a page in a directory with the files that pages speak of; pictures have a size if one is given.
#[track_caller]
fn run(page: &Path, size: &str) {
    let commands = blocks(&read(page), "sh").join("\n");
    if commands.is_empty() {
        return;
    }
    let place = Place::with_cubes();
    std::os::unix::fs::symlink(workspace().join("fixtures"), place.path("fixtures")).expect("a link");
    place.write("cross.seg", "0 0 2 2\n0 2 2 0\n");
    place.write("viewer.html", support::viewer_page());
    let programs = Path::new(env!("CARGO_BIN_EXE_lar")).parent().expect("a directory");
    let script = format!("{PRELUDE}{commands}");
    let mut shell = Command::new("sh");
    shell.args(["-c", &script]).env("PROGRAMS", programs).env("SIZE", size);
    let run = place.run(shell.env("LAR_VIEWER_PAGE", "viewer.html"));
    // Without a graphics adapter the pictures are left out, unless there must be one.
    let has_no_adapter = run.code == 3 && std::env::var_os("LAR_REQUIRE_GPU").is_none();
    assert!(run.code == 0 || has_no_adapter, "{}:\n{}\n{}", page.display(), run.out, run.err);
}

#[test]
fn commands_of_the_readme() {
    run(&workspace().join("README.md"), "");
}

#[test]
fn commands_of_the_guide() {
    run(&workspace().join("docs/README.md"), "");
    pages("docs/guide").iter().for_each(|page| run(page, ""));
}

/// Small: what they look like is tested in figures.rs.
#[test]
fn commands_of_the_figures() {
    for page in pages("docs/figures") {
        run(&page, if page.ends_with("README.md") { "--small --size 120x100" } else { "--size 120x100" });
    }
}

#[test]
fn links_lead_somewhere() {
    let mut broken = Vec::new();
    let docs = workspace().join("docs");
    let all = ["", BOOK[0], BOOK[1], BOOK[2], BOOK[3]].iter().flat_map(|d| pages(d));
    // The contents are checked below; mdbook follows their links itself.
    for page in all.filter(|page| !page.ends_with("SUMMARY.md")) {
        let text = read(&page);
        let prose: String = text.split("```").step_by(2).collect();
        for link in prose.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next()) {
            if link.is_empty() || link.contains("://") || link.starts_with("mailto:") {
                continue;
            }
            let target = page.parent().expect("a directory").join(link).canonicalize();
            // The book has what is in its own directory, nothing else, and calls README.md index.html.
            let in_book = |target: &Path| target.starts_with(&docs) && !target.ends_with("README.md");
            let is_found = |target: PathBuf| !page.starts_with(&docs) || in_book(&target);
            if !target.is_ok_and(is_found) {
                broken.push(format!("{}: {link}", page.display()));
            }
        }
    }
    assert_eq!(broken, [""; 0]);
}

#[test]
fn pages_are_in_the_contents_and_their_programs_are_run() {
    let root = workspace();
    let [contents, decisions] =
        ["SUMMARY.md", "decisions.md"].map(|file| read(&root.join("docs").join(file)));
    let tested = read(&root.join("lar-examples/src/guide.rs"));
    for page in BOOK.iter().flat_map(|d| pages(d)) {
        let path = page.strip_prefix(&root).expect("a page of the workspace").display().to_string();
        let entry = format!("({})", path.trim_start_matches("docs/"));
        assert!(contents.contains(&entry) || path == "docs/SUMMARY.md", "{path} is not in docs/SUMMARY.md");
        let is_decision = path.starts_with("docs/decisions/");
        assert!(!is_decision || decisions.contains(&entry), "{path} is not in docs/decisions.md");
        let has_programs = !blocks(&read(&page), "rust").is_empty();
        assert!(!has_programs || tested.contains(&path), "{path} has programs, but is not in src/guide.rs");
    }
}
