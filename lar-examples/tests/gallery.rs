//! docs/gallery.md tells the truth: its pictures and the tests that it names exist.

use std::path::{Path, PathBuf};

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
    assert_eq!(n, 18);
}

#[test]
fn each_picture_is_there() {
    let text = gallery();
    let pictures = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let mut n = 0;
    for picture in pictures {
        assert!(root().join("docs").join(picture).is_file(), "{picture}");
        n += 1;
    }
    assert_eq!(n, 10);
}
