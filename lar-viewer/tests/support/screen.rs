//! A virtual screen with a program's window on it: Xvfb is the screen, xdotool the hands, `import` the eyes.
#![allow(dead_code, reason = "each test program uses a part of it")]

use std::cell::RefCell;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{
    AtomEnum, CONFIGURE_NOTIFY_EVENT, ConfigureNotifyEvent, ConnectionExt, EventMask, GetGeometryReply,
    PropMode,
};
use x11rb::wrapper::ConnectionExt as _;

/// Long enough for the software driver to draw a frame in a debug build on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// Bytes in a row of the screen.
const ROW: usize = 3 * 1280;

/// More pixels than a cursor that blinks in a text field.
const CURSOR: usize = 40;

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
        Self::scaled(Some(1.0), program, title, arguments, files)
    }

    /// The same on a screen with this many pixels to a point, or as many as the screen's settings say.
    #[expect(clippy::print_stderr, reason = "a test that cannot run says so")]
    pub(crate) fn scaled(
        scale: Option<f32>,
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
        let mut window = Command::new(program);
        window
            .args(arguments)
            .current_dir(dir.path())
            .env("DISPLAY", &display)
            .env("XDG_RUNTIME_DIR", dir.path())
            .env_remove("WAYLAND_DISPLAY");
        match scale {
            Some(scale) => window.env("WINIT_X11_SCALE_FACTOR", scale.to_string()),
            None => window.env_remove("WINIT_X11_SCALE_FACTOR"),
        };
        let window = window.spawn().unwrap();
        let session = Self { screen, display, window, dir, seen: RefCell::default() };
        session.xdotool(&format!(
            "search --sync --onlyvisible --name {title} windowfocus windowmove 0 0 windowsize 1280 780"
        ));
        Some(session)
    }

    /// Moves the hands and waits a moment.
    pub(crate) fn xdotool(&self, arguments: &str) {
        run(Command::new("xdotool").args(arguments.split_whitespace()).env("DISPLAY", &self.display));
        sleep(Duration::from_millis(100));
    }

    /// Gives the screen this many dots per inch, 96 of which are one pixel to a point, and tells the window where it is, as window
    /// managers do: it is then on a screen of another scale.
    pub(crate) fn set_dpi(&self, title: &str, dpi: u32) {
        let (connection, screen) = x11rb::connect(Some(&self.display)).unwrap();
        let (root, window) = (connection.setup().roots[screen].root, self.window_id(title));
        let set = |of: u32, value: &str| {
            let (name, kind) = (AtomEnum::RESOURCE_MANAGER, AtomEnum::STRING);
            let set = connection.change_property8(PropMode::REPLACE, of, name, kind, value.as_bytes());
            set.unwrap().check().unwrap();
        };
        set(root, &format!("Xft.dpi: {dpi}"));
        // The settings of the screen are read again when this one of the window changes.
        set(window, "");
        sleep(Duration::from_secs(1));
        let GetGeometryReply { width, height, .. } =
            connection.get_geometry(window).unwrap().reply().unwrap();
        let placed = ConfigureNotifyEvent {
            response_type: CONFIGURE_NOTIFY_EVENT,
            event: window,
            window,
            width,
            height,
            ..ConfigureNotifyEvent::default()
        };
        connection.send_event(false, window, EventMask::STRUCTURE_NOTIFY, placed).unwrap().check().unwrap();
    }

    fn window_id(&self, title: &str) -> u32 {
        let search = ["search", "--name", title];
        let found = Command::new("xdotool").args(search).env("DISPLAY", &self.display).output().unwrap();
        String::from_utf8(found.stdout).unwrap().trim().parse().expect("one window of this name")
    }

    /// What is done reaches the program at once, as if it had been drawing one frame all the time.
    pub(crate) fn at_once(&self, act: impl FnOnce(&Self)) {
        let signal = |name: &str| run(Command::new("kill").arg(name).arg(self.window.id().to_string()));
        signal("-STOP");
        act(self);
        signal("-CONT");
    }

    /// Drags with a mouse button.
    pub(crate) fn drag(&self, button: u32, from: [i32; 2], to: [i32; 2]) {
        let middle = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
        self.xdotool(&format!("mousemove {} {} mousedown {button}", from[0], from[1]));
        self.xdotool(&format!("mousemove {} {}", middle[0], middle[1]));
        self.xdotool(&format!("mousemove {} {}", to[0], to[1]));
        self.xdotool(&format!("mouseup {button}"));
    }

    /// The whole screen, once something is on it, two looks at it agree and the program has nothing to do in between.
    pub(crate) fn look(&self) -> Vec<u8> {
        let start = Instant::now();
        let mut last = (self.screenshot(), self.processor_time());
        loop {
            sleep(Duration::from_millis(200));
            let next = (self.screenshot(), self.processor_time());
            let is_empty = next.0.chunks_exact(3).all(|pixel| pixel == &next.0[..3]);
            let rests = next.1 <= last.1 + 1 && n_changed(&last.0, &next.0, 0) <= CURSOR;
            if (rests && !is_empty) || PATIENCE < start.elapsed() {
                return next.0;
            }
            last = next;
        }
    }

    /// What the program has used of processors, in hundredths of a second.
    fn processor_time(&self) -> u64 {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.window.id())).unwrap_or_default();
        // Its name, in parentheses, is the second of the fields; times are the 14th and 15th.
        let fields = stat.rsplit_once(')').map_or("", |(_, fields)| fields).split_whitespace();
        fields.skip(11).take(2).filter_map(|ticks| ticks.parse::<u64>().ok()).sum()
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

    /// Looks until the screen is as it should be by this measure of how far it is from it; returns the last. What the screen
    /// is instead is left in `lar-window.png` in the system's directory of temporary files.
    fn await_screen(&self, mut distance: impl FnMut(&[u8]) -> usize) -> usize {
        let start = Instant::now();
        loop {
            let screen = self.look();
            let far = distance(&screen);
            self.seen.replace(Some(screen));
            if far == 0 {
                return 0;
            }
            if PATIENCE < start.elapsed() {
                let path = std::env::temp_dir().join("lar-window.png");
                run(Command::new("import").args(["-window", "root"]).arg(path).env("DISPLAY", &self.display));
                return far;
            }
        }
    }

    /// Does something and asserts that at least `least` pixels of the screen change.
    #[track_caller]
    pub(crate) fn check_changes(&self, what: &str, least: usize, act: impl FnOnce(&Self)) {
        assert!(CURSOR < least, "a blinking cursor would do");
        let before = self.seen.take().unwrap_or_else(|| self.look());
        act(self);
        let missing = self.await_screen(|after| least.saturating_sub(n_changed(&before, after, 0)));
        assert_eq!(missing, 0, "{what} should change at least {least} pixels; missing");
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

fn run(command: &mut Command) {
    let status = command.stdout(Stdio::null()).status().unwrap();
    assert!(status.success(), "{command:?}");
}

/// How many pixels differ by more than this in a channel.
fn n_changed(a: &[u8], b: &[u8], tolerance: u8) -> usize {
    let differs = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(x, y)| tolerance < x.abs_diff(*y));
    let of_row =
        |(a, b): (&[u8], &[u8])| a.chunks_exact(3).zip(b.chunks_exact(3)).filter(|&p| differs(p)).count();
    // Most rows are equal, which is found at once.
    let rows = a.chunks(ROW).zip(b.chunks(ROW));
    rows.filter(|(a, b)| a != b).map(of_row).sum()
}

/// Compares the upper left of the screen, this wide and high, with the committed picture: at most one pixel in a hundred may
/// differ by more than 16 of 255. `LAR_UPDATE_PICTURES=1` writes the picture.
#[track_caller]
pub(crate) fn check_screen(session: &Session, [width, height]: [usize; 2], path: &Path) {
    if std::env::var_os("LAR_UPDATE_PICTURES").is_some() {
        session.look();
        let crop = format!("{width}x{height}+0+0");
        let arguments = ["-window", "root", "-crop", &crop, "+repage", "-strip"];
        run(Command::new("import").args(arguments).arg(path).env("DISPLAY", &session.display));
    }
    let expected = Command::new("convert").arg(path).args(["-depth", "8", "rgb:-"]).output().unwrap().stdout;
    assert_eq!(expected.len(), 3 * width * height, "size of {}", path.display());
    let allowed = width * height / 100;
    let far = session.await_screen(|screen| {
        let rows = screen.chunks(ROW).zip(expected.chunks(3 * width));
        rows.map(|(seen, row)| n_changed(&seen[..row.len()], row, 16)).sum::<usize>().saturating_sub(allowed)
    });
    assert_eq!(far, 0, "pixels of {} that differ beyond those allowed", path.display());
}
