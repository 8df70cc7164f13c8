//! A progress bar on the error stream, when that is a terminal and the work takes a while.

use indicatif::{ProgressBar, ProgressStyle};
use lar_arrangement::Progress;
use std::time::{Duration, Instant};

/// Removed when dropped.
pub(crate) struct Bar {
    bar: ProgressBar,
    start: Instant,
}

/// What is done by then needs no bar.
const PATIENCE: Duration = Duration::from_millis(400);
const STEPS: u64 = 1000;

impl Bar {
    pub(crate) fn new() -> Self {
        let style = ProgressStyle::with_template("{bar:40} {percent:>3} % {msg}");
        let bar = ProgressBar::new(STEPS).with_style(style.expect("the template is well formed"));
        Self { bar, start: Instant::now() }
    }

    /// Shows a report of an arrangement. Nothing is drawn when the error stream is no terminal.
    pub(crate) fn show(&self, progress: Progress) {
        if PATIENCE < self.start.elapsed() {
            self.bar.set_message(progress.stage);
            self.bar.set_position((progress.fraction * STEPS as f64) as u64);
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
