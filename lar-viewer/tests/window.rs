//! A session in a real window: Xvfb is the screen, xdotool the hands, `import` the eyes.
//!
//! Runs where these programs are installed (Debian: `xvfb xdotool imagemagick`); with `LAR_REQUIRE_GPU=1`, as in CI,
//! missing ones fail the test.
#![cfg(all(feature = "window", target_os = "linux"))]

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Long enough for the software driver to draw a frame in a debug build on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// A virtual screen with the example's window on it; both end with it.
struct Session {
    screen: Child,
    display: String,
    window: Child,
    dir: tempfile::TempDir,
}

impl Drop for Session {
    fn drop(&mut self) {
        for child in [&mut self.window, &mut self.screen] {
            // Either may have ended by itself.
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

impl Session {
    #[expect(clippy::print_stderr, reason = "a test that cannot run says so")]
    fn start() -> Option<Self> {
        let missing = ["Xvfb", "xdotool", "import"].into_iter().find(|program| !is_installed(program));
        if let Some(program) = missing {
            assert!(std::env::var_os("LAR_REQUIRE_GPU").is_none(), "{program} is not installed");
            eprintln!("NOT TESTED: {program} is not installed; LAR_REQUIRE_GPU=1 makes this an error");
            return None;
        }
        let mut screen = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x800x24"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut number = String::new();
        BufReader::new(screen.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let display = format!(":{}", number.trim());
        let dir = tempfile::tempdir().unwrap();
        let window = Command::new(example())
            .current_dir(dir.path())
            .env("DISPLAY", &display)
            .env("XDG_RUNTIME_DIR", dir.path())
            .env_remove("WAYLAND_DISPLAY")
            .spawn()
            .unwrap();
        let session = Self { screen, display, window, dir };
        session.xdotool(
            "search --sync --onlyvisible --name cubes windowfocus windowmove 0 0 windowsize 1200 760",
        );
        Some(session)
    }

    fn xdotool(&self, arguments: &str) {
        let status = Command::new("xdotool")
            .args(arguments.split_whitespace())
            .env("DISPLAY", &self.display)
            .stdout(Stdio::null())
            .status()
            .unwrap();
        assert!(status.success(), "xdotool {arguments}");
        sleep(Duration::from_millis(150));
    }

    fn drag(&self, button: u32, from: [i32; 2], to: [i32; 2]) {
        let middle = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
        self.xdotool(&format!("mousemove {} {} mousedown {button}", from[0], from[1]));
        self.xdotool(&format!("mousemove {} {}", middle[0], middle[1]));
        self.xdotool(&format!("mousemove {} {}", to[0], to[1]));
        self.xdotool(&format!("mouseup {button}"));
    }

    /// The whole screen, once two looks at it agree.
    fn look(&self) -> Vec<u8> {
        let start = Instant::now();
        let mut last = self.screenshot();
        loop {
            sleep(Duration::from_millis(400));
            let next = self.screenshot();
            if next == last || PATIENCE < start.elapsed() {
                return next;
            }
            last = next;
        }
    }

    fn screenshot(&self) -> Vec<u8> {
        let output = Command::new("import")
            .args(["-window", "root", "-depth", "8", "rgb:-"])
            .env("DISPLAY", &self.display)
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        output.stdout
    }

    /// Does something and asserts that at least `least` pixels of the screen change.
    #[track_caller]
    fn check_changes(&self, what: &str, least: usize, act: impl FnOnce(&Self)) {
        let before = self.look();
        act(self);
        let start = Instant::now();
        let mut changed = 0;
        while changed < least && start.elapsed() < PATIENCE {
            let after = self.look();
            changed = before.chunks_exact(3).zip(after.chunks_exact(3)).filter(|(a, b)| a != b).count();
        }
        assert!(least <= changed, "{what} changed only {changed} pixels");
    }

    /// Waits for the window's process to end by itself.
    #[track_caller]
    fn check_closes(mut self) {
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            if let Some(status) = self.window.try_wait().unwrap() {
                assert!(status.success(), "{status}");
                return;
            }
            sleep(Duration::from_millis(100));
        }
        panic!("Esc does not close the window");
    }
}

fn is_installed(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|dir| dir.join(program).is_file())
}

/// The `cubes` example, which cargo builds with the tests.
fn example() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let target = test.parent().and_then(Path::parent).unwrap();
    target.join("examples/cubes")
}

#[test]
fn a_session_with_mouse_and_keys() {
    let Some(session) = Session::start() else { return };
    session.check_changes("the first picture", 0, |_| {});
    session.check_changes("turning", 20_000, |s| s.drag(1, [400, 400], [520, 360]));
    session.check_changes("moving", 20_000, |s| s.drag(3, [400, 400], [450, 420]));
    session.check_changes("moving with shift", 20_000, |s| {
        s.xdotool("keydown shift");
        s.drag(1, [450, 420], [400, 400]);
        s.xdotool("keyup shift");
    });
    session.check_changes("zooming", 20_000, |s| s.xdotool("mousemove 300 300 click 4 click 4"));
    session.check_changes("exploding", 20_000, |s| s.drag(1, [975, 42], [1005, 42]));
    session.check_changes("projection", 10_000, |s| s.xdotool("mousemove 500 500 key p"));
    session.check_changes("fitting", 20_000, |s| s.xdotool("key f"));
    session.check_changes("shrinking the window", 20_000, |s| {
        s.xdotool("search --name cubes windowsize 700 500");
    });
    session.xdotool("search --name cubes windowsize 1 1");
    session.check_changes("enlarging the window", 20_000, |s| {
        s.xdotool("search --name cubes windowsize 1200 760");
    });
    session.check_changes("saving", 50, |s| s.xdotool("mousemove 1000 301 click 1"));
    let saved = std::fs::read(session.dir.path().join("lar-1.png")).expect("a screenshot");
    assert!(saved.starts_with(b"\x89PNG"));
    session.xdotool("search --name cubes windowfocus key Escape");
    session.check_closes();
}

#[test]
fn without_a_display_the_error_says_so() {
    let output =
        Command::new(example()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap();
    assert!(!output.status.success());
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("NoDisplay"), "{message}");
}
