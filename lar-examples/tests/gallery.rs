//! docs/gallery.md tells the truth: the tests that it names exist, and its commands draw its pictures.

mod support;

use std::path::{Path, PathBuf};
use std::process::Command;
use support::{Place, differing, fixture, read_png};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn gallery() -> String {
    std::fs::read_to_string(root().join("docs/gallery.md")).unwrap()
}

#[test]
fn each_feature_has_its_test() {
    let text = gallery();
    let rows = text.lines().filter(|line| line.starts_with('|') && line.contains(".rs` `"));
    let mut n = 0;
    for row in rows {
        let [.., file, test] =
            row.split('`').filter(|s| !s.trim_matches([' ', '|']).is_empty()).collect::<Vec<_>>()[..]
        else {
            panic!("no test in {row}");
        };
        let source = std::fs::read_to_string(root().join(file)).unwrap_or_else(|e| panic!("{file}: {e}"));
        assert!(source.contains(&format!("fn {test}(")), "{file} has no test {test}");
        n += 1;
    }
    assert_eq!(n, 27);
}

/// The cells of a row of a table.
fn cells(row: &str) -> Vec<&str> {
    row.trim_matches('|').split('|').map(str::trim).collect()
}

/// How many of the eleven programs have a feature is what the table of all of them says, and nothing is left open there.
#[test]
fn programs_are_counted() {
    let text = gallery();
    let rows: Vec<Vec<&str>> = text.lines().filter(|line| line.starts_with('|')).map(cells).collect();
    let mut n = 0;
    for row in rows.iter().filter(|row| row.len() == 13 && !["feature", "---"].contains(&row[0])) {
        let programs = &row[1..12];
        assert!(
            programs.iter().all(|p| ["yes", "no", "partly"].iter().any(|word| p.starts_with(word))),
            "{row:?}"
        );
        assert_eq!(row[12], "yes", "{row:?}");
        let count = |word: &str| programs.iter().filter(|p| p.starts_with(word)).count();
        let said = match count("partly") {
            0 => count("yes").to_string(),
            some => format!("{} + {some}", count("yes")),
        };
        let found = rows.iter().find(|r| r.len() == 4 && r[0] == row[0]);
        assert_eq!(found.map(|r| r[1]), Some(said.as_str()), "{}", row[0]);
        n += 1;
    }
    assert_eq!(n, 14);
}

/// The commands of the first table, and the pictures beside them.
fn commands(text: &str) -> Vec<&str> {
    text.split('`').filter(|code| code.starts_with("lar render ")).collect()
}

#[test]
#[cfg(all(unix, feature = "viewer"))]
fn each_picture_is_what_its_command_draws() {
    let text = gallery();
    let place = Place::new();
    for file in ["three_cubes_a.obj", "three_cubes_b.obj", "three_cubes_c.obj", "plan.svg"] {
        place.write(file, std::fs::read(fixture(file)).unwrap());
    }
    let cubes = text.split("`C=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("the cubes");
    let commands = commands(&text);
    assert_eq!(commands.len(), 9);
    for command in commands {
        let name = command.split(" -o ").nth(1).and_then(|rest| rest.split(' ').next()).expect("an output");
        let script = format!("\"$LAR\" {}", command.trim_start_matches("lar "));
        let mut shell = Command::new("sh");
        shell.args(["-c", &script]).env("C", cubes).env("LAR", env!("CARGO_BIN_EXE_lar"));
        let run = place.run(&mut shell);
        if run.code == 3 && std::env::var_os("LAR_REQUIRE_GPU").is_none() {
            return;
        }
        assert_eq!(run.code, 0, "{command}: {run:?}");
        let committed = root().join("docs/gallery").join(name);
        if name.ends_with(".svg") {
            assert_eq!(place.read(name), std::fs::read_to_string(committed).unwrap(), "{command}");
            continue;
        }
        let (size, pixels) = read_png(&place.path(name));
        let (expected_size, expected) = read_png(&committed);
        assert_eq!(size, expected_size, "{command}");
        let differing = differing(&pixels, &expected);
        assert!(differing <= expected.len() / 4 / 1000, "{command}: {differing} pixels differ");
    }
}

#[test]
fn each_picture_is_there() {
    let text = gallery();
    let pictures = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let mut n = 0;
    for picture in pictures.filter(|link| !link.ends_with(".md")) {
        assert!(root().join("docs").join(picture).is_file(), "{picture}");
        n += 1;
    }
    assert_eq!(n, 11);
}
