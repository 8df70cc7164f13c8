//! A session in a real window, driven from outside.
//!
//! Runs where these programs are installed (Debian: `xvfb xdotool imagemagick`); with `LAR_REQUIRE_GPU=1`, as in CI,
//! missing ones fail the test.
#![cfg(all(feature = "window", target_os = "linux"))]

#[path = "support/screen.rs"]
mod screen;

use screen::{Session, check_screen};
use std::path::{Path, PathBuf};
use std::process::Command;

/// An example, which cargo builds with the tests.
fn example(name: &str) -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let target = test.parent().and_then(Path::parent).unwrap();
    target.join("examples").join(name)
}

#[test]
fn a_complex_is_explored_with_mouse_and_keys() {
    let Some(session) = Session::start(&example("grid"), "grid", &["shape.txt"], &[("shape.txt", "2 1 1")])
    else {
        return;
    };
    let picture = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/pictures/window.png");
    check_screen(&session, [1280, 750], &picture);
    session.check_changes("selecting a cell", 2_000, |s| s.xdotool("mousemove 420 450 click 1"));
    session.check_changes("its boundary chain", 20_000, |s| s.xdotool("mousemove 600 700 key b"));
    session.check_changes("leaving the chain", 20_000, |s| s.xdotool("key Escape"));
    session.check_changes("hiding it", 20_000, |s| s.xdotool("key h"));
    session.check_changes("undo", 20_000, |s| s.xdotool("key ctrl+z"));
    session.check_changes("turning", 20_000, |s| s.drag(1, [500, 400], [620, 360]));
    session.check_changes("moving", 20_000, |s| s.drag(3, [500, 400], [550, 420]));
    session.check_changes("zooming", 20_000, |s| s.xdotool("mousemove 600 300 click 4 click 4"));
    session.check_changes("looking from the front", 20_000, |s| s.xdotool("key 1"));
    session.check_changes("fitting", 2_000, |s| s.xdotool("key f"));
    session.check_changes("projection", 2_000, |s| s.xdotool("key 7 key p"));
    session.check_changes("the help", 20_000, |s| s.xdotool("key F1"));
    session.check_changes("leaving the help", 20_000, |s| s.xdotool("key Escape"));
    session.check_changes("another shape", 20_000, |s| {
        std::fs::write(s.dir.path().join("shape.txt"), "3 3 1").unwrap();
    });
    session.check_changes("a shape that is none", 200, |s| {
        std::fs::write(s.dir.path().join("shape.txt"), "3 3").unwrap();
    });
    session.check_changes("saving", 50, |s| s.xdotool("mousemove 600 500 key s"));
    let saved = std::fs::read(session.dir.path().join("lar-1.png")).expect("a screenshot");
    assert!(saved.starts_with(b"\x89PNG"));
    session.check_changes("shrinking the window", 20_000, |s| {
        s.xdotool("search --name grid windowsize 900 500");
    });
    session.xdotool("search --name grid windowsize 1 1");
    session.check_changes("enlarging the window", 20_000, |s| {
        s.xdotool("search --name grid windowsize 1280 780");
    });
    session.xdotool("search --name grid windowfocus key Escape key Escape");
    session.check_closes();
}

#[test]
fn a_scene_is_shown_as_it_is() {
    let Some(session) = Session::start(&example("cubes"), "cubes", &[], &[]) else { return };
    session.check_changes("turning", 20_000, |s| s.drag(1, [500, 400], [620, 360]));
    session.check_changes("turning in one frame, after that of the press", 20_000, |s| {
        s.xdotool("mousemove 500 400 mousedown 1");
        s.look();
        s.at_once(|s| {
            s.xdotool("mousemove 620 360");
            s.xdotool("mouseup 1");
        });
    });
    session.check_changes("moving in one frame, press and all", 20_000, |s| {
        s.at_once(|s| s.drag(3, [500, 400], [550, 420]));
    });
    session.check_changes("exploding", 20_000, |s| s.drag(1, [1020, 81], [1050, 81]));
    session.xdotool("mousemove 600 500 key Escape");
    session.check_closes();
}

/// On a dense screen, taken off it and put back.
#[test]
fn windows_come_back_on_a_dense_screen() {
    let Some(session) = Session::scaled(Some(2.0), &example("cubes"), "cubes", &[], &[]) else { return };
    session.check_changes("turning", 20_000, |s| s.drag(1, [300, 400], [420, 360]));
    for act in ["windowunmap", "windowmap", "windowfocus windowmove 0 0"] {
        session.xdotool(&format!("search --name cubes {act}"));
    }
    // What is done before the window is drawn again would be lost.
    session.look();
    session.check_changes("turning again", 20_000, |s| s.drag(1, [300, 400], [200, 380]));
    session.xdotool("mousemove 300 500 key Escape");
    session.check_closes();
}

/// Everything grows with the scale of the screen, and is where it is seen.
#[test]
fn windows_follow_the_scale_of_the_screen() {
    let Some(session) = Session::scaled(None, &example("cubes"), "cubes", &[], &[]) else { return };
    session.check_changes("shrinking the window", 20_000, |s| {
        s.xdotool("search --name cubes windowsize 560 300");
    });
    session.check_changes("a finer screen", 20_000, |s| s.set_dpi("cubes", 144));
    let picture = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/pictures/scaled.png");
    check_screen(&session, [640, 300], &picture);
    session.check_changes("exploding", 5_000, |s| s.drag(1, [876, 121], [920, 121]));
    session.xdotool("mousemove 300 300 key Escape");
    session.check_closes();
}

/// Someone else destroys the window: its surface is lost before the window knows that it is gone.
#[test]
fn a_window_that_is_destroyed_ends_the_program_without_an_error() {
    let Some(session) = Session::start(&example("cubes"), "cubes", &[], &[]) else { return };
    session.look();
    session.xdotool("search --name cubes windowclose");
    session.check_closes();
}

#[test]
fn without_a_display_the_error_says_so() {
    let run = Command::new(example("cubes")).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output();
    let output = run.unwrap();
    assert!(!output.status.success());
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("NoDisplay"), "{message}");
}
