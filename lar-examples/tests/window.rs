//! `lar view` in a real window, driven from outside: what needs an arrangement behind the window.
//!
//! Runs where `Xvfb`, `xdotool` and `import` are installed; with `LAR_REQUIRE_GPU=1`, as in CI, missing ones fail the test.
#![cfg(all(feature = "window", target_os = "linux"))]

#[path = "../../lar-viewer/tests/support/screen.rs"]
mod screen;

use screen::{Session, check_screen};
use std::path::{Path, PathBuf};

/// The window but for its lowest rows, which name the graphics card.
const SIZE: [usize; 2] = [900, 610];

const DIR: &str = env!("CARGO_MANIFEST_DIR");

/// The places that are clicked are those of a window of 900 × 640 with the three cubes.
#[test]
fn an_arrangement_is_asked_wrapped_measured_and_cut() {
    let cubes = ["a", "b", "c"].map(|name| format!("{DIR}/../fixtures/three_cubes_{name}.obj"));
    let inputs: Vec<&str> = ["view"].into_iter().chain(cubes.iter().map(String::as_str)).collect();
    let Some(session) = Session::start(Path::new(env!("CARGO_BIN_EXE_lar")), "lar", &inputs, &[]) else {
        return;
    };
    session.xdotool("search --name lar windowsize 900 640 mousemove 300 600");
    session.look();
    // The first fit may have been to another size.
    session.xdotool("key f");
    let picture = |name: &str| PathBuf::from(DIR).join("tests/screens").join(name);
    check_screen(&session, SIZE, &picture("view.png"));
    // Letters are shortcuts outside of the field: none of these may be taken for one.
    session.check_changes("a Boolean expression", 20_000, |s| {
        s.at_once(|s| {
            s.xdotool("mousemove 755 538 click 1");
            s.xdotool("type A&B-C");
        });
    });
    session.check_changes("no expression", 20_000, |s| {
        s.xdotool("key ctrl+a");
        s.xdotool("key BackSpace");
        s.at_once(|s| {
            s.xdotool("mousemove 300 600 click 1");
            s.xdotool("key p");
            s.xdotool("key p");
        });
    });
    check_screen(&session, SIZE, &picture("view.png"));
    session.check_changes("a cell of the tree", 1_000, |s| s.xdotool("mousemove 144 133 click 1"));
    session.check_changes("its gift wrapping", 20_000, |s| s.xdotool("mousemove 686 570 click 1"));
    session.check_changes("the next corolla", 2_000, |s| s.xdotool("mousemove 300 600 key period"));
    session.check_changes("the end of replay and selection", 20_000, |s| {
        s.at_once(|s| {
            s.xdotool("key Escape");
            s.xdotool("key Escape");
        });
    });
    check_screen(&session, SIZE, &picture("view.png"));
    session.check_changes("numbers of the cells, vertices", 1_000, |s| {
        s.at_once(|s| {
            ["696 313", "626 244"].iter().for_each(|at| s.xdotool(&format!("mousemove {at} click 1")));
        });
    });
    session.check_changes("an angle", 1_000, |s| {
        s.at_once(|s| {
            s.xdotool("mousemove 300 600 key m");
            for corner in ["311 152", "499 138", "543 257"] {
                s.xdotool(&format!("mousemove {corner} click 1"));
            }
        });
    });
    session.check_changes("a clip plane", 20_000, |s| {
        s.xdotool("mousemove 664 474 click 1");
        s.look();
        s.xdotool("mousemove 626 497 click 1");
    });
    session.check_changes("cells pulled apart", 20_000, |s| s.drag(1, [624, 106], [650, 106]));
    session.xdotool("mousemove 300 600");
    check_screen(&session, SIZE, &picture("cut.png"));
    session.check_changes("a small window", 20_000, |s| s.xdotool("search --name lar windowsize 700 420"));
    // Measuring is left, what was measured stays.
    session.at_once(|s| {
        s.xdotool("mousemove 400 300 key Escape");
        s.xdotool("key Escape");
    });
    session.check_closes();
}
