//! Where a long operation is, and how to stop it.
//!
//! A run of an operation is a [`Course`]: it goes through named stages, each with its usual share of the whole, measures
//! them, and gives up between two chunks of work when that was asked for. What is computed depends on none of it.

use crate::parallel;
use crate::stats::Stats;
use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// How far an operation is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// The stage at work, called as in [`Stats::stages`].
    pub stage: &'static str,
    /// Part of the whole operation that is done, from 0 to 1, by the usual cost of the stages. Never decreases.
    pub fraction: f64,
}

/// A request to stop, made by one thread and seen by the threads at work.
///
/// ```
/// use lar_arrangement::{ArrangementError, Arranger, Cancel};
/// let surface = lar_core::cuboid_grid(&[20, 20, 20]).to_surface("grid")?;
/// let cancel = Cancel::new();
/// // Here from within, on the first report; any thread may do it at any time.
/// let stop = |_| cancel.request();
/// let arranged = Arranger::new().progress(&stop).cancel(&cancel).arrange(&[surface]);
/// assert_eq!(arranged.unwrap_err(), ArrangementError::Cancelled);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Cancel {
    requested: AtomicBool,
}

impl Cancel {
    /// Nothing is asked for yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { requested: AtomicBool::new(false) }
    }

    /// Asks the operations that were given this to stop. They return an error within a chunk of work.
    pub fn request(&self) {
        self.requested.store(true, Ordering::Relaxed);
    }

    /// Whether that was asked for.
    #[must_use]
    pub fn is_requested(&self) -> bool {
        self.requested.load(Ordering::Relaxed)
    }
}

/// The operation was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cancelled;

/// Who is told, and who may stop it: an option of an operation.
#[derive(Clone, Copy, Default)]
pub(crate) struct Control<'a> {
    pub report: Option<&'a (dyn Fn(Progress) + Sync)>,
    pub cancel: Option<&'a Cancel>,
}

impl fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Control")
            .field("reports", &self.report.is_some())
            .field("cancel", &self.cancel)
            .finish()
    }
}

/// The stages of an operation in their order, and the usual share of each in its time, in percent.
pub(crate) type Plan = [(&'static str, u32)];

/// One run of an operation.
pub(crate) struct Course<'a> {
    control: Control<'a>,
    plan: &'static Plan,
    now: Mutex<Now>,
}

/// The stage at work.
struct Now {
    stage: &'static str,
    since: Instant,
    /// The part of the whole that it begins and ends at.
    span: [f64; 2],
    /// The part that was reported last.
    reported: f64,
}

impl<'a> Course<'a> {
    pub(crate) fn new(control: Control<'a>, plan: &'static Plan) -> Self {
        let now = Now { stage: "", since: Instant::now(), span: [0.0; 2], reported: 0.0 };
        Self { control, plan, now: Mutex::new(now) }
    }

    /// The same run without reports, for work inside of a chunk.
    pub(crate) fn quiet(&self) -> Self {
        Self::new(Control { report: None, ..self.control }, &[])
    }

    /// Ends the stage at work, if there is one, and begins another.
    pub(crate) fn begin(&self, stage: &'static str, stats: &mut Stats) -> Result<(), Cancelled> {
        self.lap(stats);
        let before: u32 = self.plan.iter().take_while(|s| s.0 != stage).map(|s| s.1).sum();
        let share = self.plan.iter().find(|s| s.0 == stage).map_or(0, |s| s.1);
        let mut now = self.now();
        now.stage = stage;
        now.span = [before, before + share].map(|percent| f64::from(percent) / 100.0);
        self.tell(&mut now, 0.0);
        drop(now);
        self.go_on()
    }

    /// Ends the last stage.
    pub(crate) fn finish(&self, stats: &mut Stats) {
        self.lap(stats);
        self.tell(&mut self.now(), 1.0);
    }

    fn lap(&self, stats: &mut Stats) {
        let mut now = self.now();
        let time = Instant::now();
        if !now.stage.is_empty() {
            stats.stages.push((now.stage, time - now.since));
        }
        now.since = time;
    }

    /// An error when the operation is to stop.
    pub(crate) fn go_on(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }

    /// Whether the operation is to stop: for loops inside a chunk of work, whose results nobody will look at then.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.control.cancel.is_some_and(Cancel::is_requested)
    }

    /// Applies `f` to the chunks 0..n of the stage's work and collects the results in order.
    pub(crate) fn map<R: Send>(
        &self,
        n: usize,
        f: impl Fn(usize) -> R + Sync + Send,
    ) -> Result<Vec<R>, Cancelled> {
        let done = AtomicUsize::new(0);
        let parts = parallel::map(n, |chunk| {
            let part = (!self.is_cancelled()).then(|| f(chunk))?;
            if self.control.report.is_some() {
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                // While another thread reports there is no need to.
                if let Ok(mut now) = self.now.try_lock() {
                    self.tell(&mut now, done as f64 / n as f64);
                }
            }
            Some(part)
        });
        self.go_on()?;
        parts.into_iter().collect::<Option<Vec<R>>>().ok_or(Cancelled)
    }

    /// Calls `f` with 0..n in turn on this thread; between chunks it reports, and stops when asked to.
    pub(crate) fn walk(&self, n: usize, chunk: usize, mut f: impl FnMut(usize)) -> Result<(), Cancelled> {
        for begin in (0..n).step_by(chunk) {
            let end = n.min(begin + chunk);
            (begin..end).for_each(&mut f);
            self.tell(&mut self.now(), end as f64 / n as f64);
            self.go_on()?;
        }
        Ok(())
    }

    fn tell(&self, now: &mut Now, part_of_stage: f64) {
        if let Some(report) = self.control.report {
            let [from, to] = now.span;
            now.reported = now.reported.max(from + part_of_stage * (to - from));
            report(Progress { stage: now.stage, fraction: now.reported });
        }
    }

    fn now(&self) -> MutexGuard<'_, Now> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
