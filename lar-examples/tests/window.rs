//! `lar view` in a real window, driven from outside: what needs an arrangement behind the window.
//!
//! Runs where `Xvfb`, `xdotool` and `import` are installed; with `LAR_REQUIRE_GPU=1`, as in CI, missing ones fail the test.
#![cfg(all(feature = "window", target_os = "linux"))]

#[path = "../../lar-viewer/tests/support/screen.rs"]
mod screen;

use screen::Session;
use std::path::Path;
use std::time::{Duration, Instant};

const FIXTURES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../fixtures");

/// The places that are clicked are those of a window of 1280 × 780 with the three cubes.
#[test]
fn an_arrangement_is_asked_measured_cut_and_recorded() {
    let cubes = ["a", "b", "c"].map(|name| format!("{FIXTURES}/three_cubes_{name}.obj"));
    let inputs: Vec<&str> = ["view"].into_iter().chain(cubes.iter().map(String::as_str)).collect();
    let Some(session) = Session::start(Path::new(env!("CARGO_BIN_EXE_lar")), "lar", &inputs, &[]) else {
        return;
    };
    session.check_changes("a Boolean expression", 20_000, |s| {
        s.xdotool("mousemove 1135 515 click 1");
        s.xdotool("type A&B-C");
    });
    session.check_changes("no expression", 20_000, |s| s.xdotool("key ctrl+a key BackSpace"));
    session.check_changes("a cell of the tree", 1_000, |s| s.xdotool("mousemove 144 110 click 1"));
    session.check_changes("its gift wrapping", 20_000, |s| s.xdotool("mousemove 1066 547 click 1"));
    session.check_changes("the next corolla", 2_000, |s| s.xdotool("mousemove 600 745 key period"));
    session.check_changes("the end of the replay", 20_000, |s| s.xdotool("key Escape"));
    session.check_changes("nothing selected", 1_000, |s| s.xdotool("key Escape"));
    session.check_changes("numbers of the cells", 300, |s| s.xdotool("mousemove 1076 290 click 1"));
    session.check_changes("vertices", 300, |s| s.xdotool("mousemove 1006 221 click 1"));
    session.check_changes("an angle", 1_000, |s| {
        s.xdotool("mousemove 600 745 key m");
        for corner in ["437 77", "767 47", "919 227"] {
            s.xdotool(&format!("mousemove {corner} click 1"));
            // Each is looked up in a frame of its own.
            s.look();
        }
    });
    session.check_changes("no more measuring", 100, |s| s.xdotool("key Escape"));
    session.check_changes("the panel of the clip plane", 500, |s| s.xdotool("mousemove 1044 451 click 1"));
    session.check_changes("a clip plane", 20_000, |s| s.xdotool("mousemove 1006 474 click 1"));
    session.check_changes("another place of it", 5_000, |s| s.drag(1, [1048, 520], [1070, 520]));
    session.check_changes("the place undone", 5_000, |s| s.xdotool("mousemove 600 745 key ctrl+z"));
    session.check_changes("a small window", 20_000, |s| s.xdotool("search --name lar windowsize 900 420"));
    session.xdotool("mousemove 692 12 click 1");
    let turn = session.dir.path().join("lar-turn-1.png");
    let start = Instant::now();
    while !turn.exists() && start.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(200));
    }
    let bytes = std::fs::read(turn).expect("an animation");
    let frames = bytes.windows(4).filter(|tag| tag == b"fcTL").count();
    assert_eq!(frames, 72, "pictures of a full turn");
    session.xdotool("mousemove 400 300 key Escape");
    session.check_closes();
}
