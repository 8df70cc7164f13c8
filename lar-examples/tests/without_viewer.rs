//! A build without graphics: commands that draw say what is missing, all others work.
#![cfg(not(feature = "viewer"))]

mod support;

use support::Place;

#[test]
fn commands_that_draw_say_what_is_missing() {
    let place = Place::with_cubes();
    let before = place.files();
    let message = "lar: this build has no viewer; build it with `--features viewer`\n";
    let run = place.lar(&["render", "a.obj", "-o", "out.png"]);
    assert_eq!((run.code, run.err.as_str()), (2, message));
    let message = "lar: this build has no window; build it with `--features window`\n";
    let run = place.lar(&["view", "a.obj"]);
    assert_eq!((run.code, run.err.as_str()), (2, message));
    let run = place.three_cubes(&["--out", "pictures"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert!(run.out.contains("49 vertices"), "the numbers are printed all the same: {}", run.out);
    assert_eq!(place.files(), before);
    let message = "figure4: this build has no viewer; build it with `--features viewer`\n";
    let run = place.program(env!("CARGO_BIN_EXE_figure4"), &["--out", "pictures"]);
    assert_eq!((run.code, run.err.as_str()), (2, message));
    assert!(place.path("pictures/figure4d.svg").exists(), "SVGs are written all the same");
}

#[test]
fn commands_that_compute_work() {
    let place = Place::with_cubes();
    assert_eq!(place.lar(&["boolean", "A|B", "a.obj", "b.obj", "-o", "out.obj"]).code, 0);
    assert_eq!(place.three_cubes(&[]).code, 0);
    place.write("a.seg", "0 0 1 0\n1 0 0 1\n0 1 0 0\n");
    assert_eq!(place.lar(&["plane", "a.seg", "-o", "out.svg"]).code, 0);
}
