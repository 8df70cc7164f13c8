//! A virtual screen with a program's window on it: Xvfb is the screen, xdotool the hands, `import` the eyes.
#![allow(dead_code, reason = "each test program uses a part of it")]

use std::cell::RefCell;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Long enough for the software driver to draw a frame in a debug build on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// A virtual screen with a window on it; both end with it.
pub(crate) struct Session {
    screen: Child,
    pub(crate) display: String,
    window: Child,
    pub(crate) dir: tempfile::TempDir,
    /// The screen as it was last seen at rest.
    seen: RefCell<Option<Vec<u8>>>,
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
    /// Starts a program whose window has this title, in a directory with these files; `None` with a message where what is
    /// needed is not installed.
    pub(crate) fn start(
        program: &Path,
        title: &str,
        arguments: &[&str],
        files: &[(&str, &str)],
    ) -> Option<Self> {
        Self::scaled(1.0, program, title, arguments, files)
    }

    /// The same on a screen with this many pixels to a point.
    #[expect(clippy::print_stderr, reason = "a test that cannot run says so")]
    pub(crate) fn scaled(
        scale: f32,
        program: &Path,
        title: &str,
        arguments: &[&str],
        files: &[(&str, &str)],
    ) -> Option<Self> {
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
        files.iter().for_each(|(name, text)| std::fs::write(dir.path().join(name), text).unwrap());
        let window = Command::new(program)
            .args(arguments)
            .current_dir(dir.path())
            .env("DISPLAY", &display)
            .env("WINIT_X11_SCALE_FACTOR", scale.to_string())
            .env("XDG_RUNTIME_DIR", dir.path())
            .env_remove("WAYLAND_DISPLAY")
            .spawn()
            .unwrap();
        let session = Self { screen, display, window, dir, seen: RefCell::default() };
        session.xdotool(&format!(
            "search --sync --onlyvisible --name {title} windowfocus windowmove 0 0 windowsize 1280 780"
        ));
        Some(session)
    }

    /// Moves the hands and waits a moment.
    pub(crate) fn xdotool(&self, arguments: &str) {
        let status = Command::new("xdotool")
            .args(arguments.split_whitespace())
            .env("DISPLAY", &self.display)
            .stdout(Stdio::null())
            .status()
            .unwrap();
        assert!(status.success(), "xdotool {arguments}");
        sleep(Duration::from_millis(150));
    }

    /// Drags with a mouse button.
    pub(crate) fn drag(&self, button: u32, from: [i32; 2], to: [i32; 2]) {
        let middle = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
        self.xdotool(&format!("mousemove {} {} mousedown {button}", from[0], from[1]));
        self.xdotool(&format!("mousemove {} {}", middle[0], middle[1]));
        self.xdotool(&format!("mousemove {} {}", to[0], to[1]));
        self.xdotool(&format!("mouseup {button}"));
    }

    /// The whole screen, once something is on it and two looks at it agree.
    pub(crate) fn look(&self) -> Vec<u8> {
        let start = Instant::now();
        let mut last = self.screenshot();
        loop {
            sleep(Duration::from_millis(400));
            let next = self.screenshot();
            let is_empty = next.chunks_exact(3).all(|pixel| pixel == &next[..3]);
            if (next == last && !is_empty) || PATIENCE < start.elapsed() {
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
    pub(crate) fn check_changes(&self, what: &str, least: usize, act: impl FnOnce(&Self)) {
        let before = self.seen.take().unwrap_or_else(|| self.look());
        act(self);
        let start = Instant::now();
        let mut changed = 0;
        while changed < least && start.elapsed() < PATIENCE {
            let after = self.look();
            changed = before.chunks_exact(3).zip(after.chunks_exact(3)).filter(|(a, b)| a != b).count();
            self.seen.replace(Some(after));
        }
        assert!(least <= changed, "{what} changed only {changed} pixels");
    }

    /// Waits for the window's process to end by itself.
    #[track_caller]
    pub(crate) fn check_closes(mut self) {
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

/// Compares the screen, but for its lowest rows, with the committed picture: at most one pixel in a hundred may differ by
/// more than 16 of 255. `LAR_UPDATE_PICTURES=1` writes the picture.
#[track_caller]
pub(crate) fn check_screen(session: &Session, path: &Path) {
    let rows = 750;
    let screen = session.look();
    if std::env::var_os("LAR_UPDATE_PICTURES").is_some() {
        let arguments = ["-window", "root", "-crop", &format!("1280x{rows}+0+0"), "+repage", "-strip"];
        let status =
            Command::new("import").args(arguments).arg(path).env("DISPLAY", &session.display).status();
        assert!(status.unwrap().success());
    }
    let expected = Command::new("convert").arg(path).args(["-depth", "8", "rgb:-"]).output().unwrap().stdout;
    assert_eq!(expected.len(), 1280 * rows * 3, "size of {}", path.display());
    let pixels = screen.chunks_exact(3).zip(expected.chunks_exact(3));
    let differing = pixels.filter(|(a, b)| a.iter().zip(*b).any(|(x, y)| 16 < x.abs_diff(*y))).count();
    assert!(differing <= 1280 * rows / 100, "{differing} pixels of {} differ", path.display());
}
