//! A thread that loads files and watches them: the window never waits for either.

use super::exhibit::{Exhibit, Source};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, SystemTime};

/// Time between two looks at the files.
const INTERVAL: Duration = Duration::from_millis(500);

/// What a load gave: the files, and their complex or what is wrong with them.
pub(crate) type Loaded = (Vec<PathBuf>, Result<Exhibit, String>);

/// What tells one version of a file from the next.
type Stamp = Option<(SystemTime, u64)>;

/// The thread's end of the line.
#[derive(Debug)]
pub(crate) struct Loader {
    requests: Sender<Vec<PathBuf>>,
}

impl Loader {
    /// Starts the thread, watching `files`; `done` is called there with each result. It ends with the loader.
    pub(crate) fn start(
        source: Box<dyn Source>,
        files: Vec<PathBuf>,
        done: impl Fn(Loaded) + Send + 'static,
    ) -> Self {
        let (requests, asked) = channel();
        // Now, not when the thread gets to it: what changes in between is news.
        let loaded = stamps(&files);
        std::thread::spawn(move || watch(&*source, (files, loaded), &asked, done));
        Self { requests }
    }

    /// Loads other files from now on.
    pub(crate) fn load(&self, files: Vec<PathBuf>) {
        // The thread ends only with this sender.
        let _ = self.requests.send(files);
    }
}

fn watch(
    source: &dyn Source,
    (mut files, mut loaded): (Vec<PathBuf>, Vec<Stamp>),
    asked: &Receiver<Vec<PathBuf>>,
    done: impl Fn(Loaded),
) {
    let mut seen = loaded.clone();
    loop {
        match asked.recv_timeout(INTERVAL) {
            Ok(others) => {
                files = others;
                loaded = stamps(&files);
                seen.clone_from(&loaded);
                done((files.clone(), load(source, &files)));
            }
            Err(RecvTimeoutError::Timeout) => {
                let now = stamps(&files);
                // Only what has been at rest for one interval: a file half written is no news.
                if now != loaded && now == seen && now.iter().all(Option::is_some) {
                    loaded.clone_from(&now);
                    done((files.clone(), load(source, &files)));
                }
                seen = now;
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// A panic while loading is a fault of the loader that must not end the session.
fn load(source: &dyn Source, files: &[PathBuf]) -> Result<Exhibit, String> {
    let loaded = catch_unwind(AssertUnwindSafe(|| source.load(files)));
    loaded.unwrap_or_else(|_| Err("loading ended in an internal error; the view is unchanged".to_owned()))
}

fn stamps(files: &[PathBuf]) -> Vec<Stamp> {
    let stamp = |file: &PathBuf| {
        let about = std::fs::metadata(file).ok()?;
        Some((about.modified().ok()?, about.len()))
    };
    files.iter().map(stamp).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CellData;
    use crate::session::NoQueries;
    use lar_core::{ChainComplex, cuboid_grid};

    /// Reads the number of cubes in a row; "panic" panics.
    struct Counting;

    impl Source for Counting {
        fn load(&self, files: &[PathBuf]) -> Result<Exhibit, String> {
            let text = std::fs::read_to_string(&files[0]).map_err(|e| e.to_string())?;
            let n = text.trim().parse().map_err(|_| format!("{text:?} is no number"))?;
            assert!(n != 0, "nothing to count");
            let complex = ChainComplex::from_model(&cuboid_grid(&[n])).map_err(|e| e.to_string())?;
            Ok(Exhibit {
                data: CellData::new(complex).map_err(|e| e.to_string())?,
                queries: Box::new(NoQueries),
            })
        }
    }

    #[test]
    fn files_are_loaded_when_asked_for_and_when_they_change() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("count");
        std::fs::write(&file, "3").unwrap();
        let (send, results) = channel();
        let loader =
            Loader::start(Box::new(Counting), vec![file.clone()], move |loaded| send.send(loaded).unwrap());
        let next = || {
            let (files, result) = results.recv_timeout(Duration::from_secs(20)).unwrap();
            assert_eq!(files, [file.as_path()]);
            result.map(|exhibit| exhibit.data.n_cells(1))
        };
        std::fs::write(&file, "12").unwrap();
        assert_eq!(next(), Ok(12), "a change");
        std::fs::write(&file, "many").unwrap();
        assert_eq!(next(), Err("\"many\" is no number".to_owned()));
        std::fs::write(&file, "00000").unwrap();
        assert_eq!(next(), Err("loading ended in an internal error; the view is unchanged".to_owned()));
        std::fs::write(&file, "7").unwrap();
        assert_eq!(next(), Ok(7));
        loader.load(vec![file.clone()]);
        assert_eq!(next(), Ok(7), "asked for");
        drop(loader);
        assert!(results.recv_timeout(Duration::from_secs(20)).is_err(), "the thread has ended");
    }
}
