//! Outputs: each file or directory is written whole or not at all, and a place that cannot be written is refused
//! before anything is computed.

use crate::CommandError;
use lar_core::{Temporary, atomic_write};
use serde::Serialize;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// What all reports begin with.
const FORMAT: &str = "lar-report";

/// Raised when a field of a report goes or changes its meaning; new fields leave it.
const VERSION: u32 = 1;

/// A report with what says which one it is.
#[derive(Serialize)]
struct Envelope<'a, R> {
    format: &'static str,
    version: u32,
    report: &'static str,
    #[serde(flatten)]
    content: &'a R,
}

/// Where a report goes: a file, or the standard output for `-`.
#[derive(Clone, Debug)]
pub(crate) enum Sink {
    Standard,
    File(PathBuf),
}

impl From<&Path> for Sink {
    fn from(path: &Path) -> Self {
        if path == Path::new("-") { Self::Standard } else { Self::File(path.to_owned()) }
    }
}

impl Sink {
    /// Refuses a file that could not be written.
    pub(crate) fn check(&self) -> Result<(), CommandError> {
        match self {
            Self::Standard => Ok(()),
            Self::File(path) => check_file(path),
        }
    }

    /// Writes the report of this name as indented JSON.
    pub(crate) fn write(
        &self,
        name: &'static str,
        report: &impl Serialize,
        out: &mut dyn Write,
    ) -> Result<(), CommandError> {
        let envelope = Envelope { format: FORMAT, version: VERSION, report: name, content: report };
        let mut text = serde_json::to_string_pretty(&envelope)?;
        text.push('\n');
        match self {
            Self::Standard => out.write_all(text.as_bytes())?,
            Self::File(path) => atomic_write(path, |file| file.write_all(text.as_bytes()))?,
        }
        Ok(())
    }
}

/// Refuses outputs of one command that would overwrite each other.
pub(crate) fn check_distinct<'a>(
    outputs: impl IntoIterator<Item = Option<&'a Path>>,
) -> Result<(), CommandError> {
    let whole = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut paths: Vec<PathBuf> = outputs.into_iter().flatten().map(whole).collect();
    paths.sort_unstable();
    match paths.windows(2).find(|w| w[0] == w[1]) {
        Some(w) => Err(CommandError::SameOutput { path: w[0].file_name().unwrap_or_default().into() }),
        None => Ok(()),
    }
}

/// Refuses a path at which no file could be written, by writing an empty one beside it.
pub(crate) fn check_file(path: &Path) -> Result<(), CommandError> {
    let tried = match fs::metadata(path) {
        Ok(data) if data.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(data) if !data.is_file() => Ok(()),
        _ => Temporary::file(path).map(drop),
    };
    tried.map_err(|source| CommandError::Write { path: path.to_owned(), source })
}

/// Refuses a path at which no new directory could be made; an empty directory may be there.
pub(crate) fn check_directory(path: &Path) -> Result<(), CommandError> {
    match fs::read_dir(path).map(Iterator::count) {
        Ok(n) if 0 < n => Err(CommandError::NotEmpty { path: path.to_owned() }),
        Ok(_) => Ok(()),
        Err(missing) if missing.kind() == io::ErrorKind::NotFound => {
            let probe = Temporary::directory(path).map(drop);
            probe.map_err(|source| CommandError::Write { path: path.to_owned(), source })
        }
        Err(source) => Err(CommandError::Write { path: path.to_owned(), source }),
    }
}

/// Fills a directory beside `path` and renames it onto `path`, which must not exist or be empty: the directory
/// appears with all its files or not at all.
pub(crate) fn write_directory(
    path: &Path,
    fill: impl FnOnce(&Path) -> Result<(), CommandError>,
) -> Result<(), CommandError> {
    check_directory(path)?;
    let failed = |source| CommandError::Write { path: path.to_owned(), source };
    let temporary = Temporary::directory(path).map_err(failed)?;
    fill(temporary.path())?;
    replace_empty(temporary, path).map_err(failed)
}

fn replace_empty(from: Temporary, to: &Path) -> io::Result<()> {
    match fs::remove_dir(to) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => from.replace(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(dir: &Path) -> Vec<String> {
        let entries = fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = entries.collect();
        names.sort();
        names
    }

    fn fill(dir: &Path) -> Result<(), CommandError> {
        Ok(atomic_write(dir.join("a"), |file| file.write_all(b"a"))?)
    }

    #[test]
    fn directories_are_whole_or_absent() {
        let dir = tempfile::tempdir().unwrap();
        let cells = dir.path().join("cells");
        let failed = write_directory(&cells, |temporary| {
            fill(temporary)?;
            Err(CommandError::Usage("stop".to_owned()))
        });
        assert_eq!(failed.unwrap_err().to_string(), "stop");
        assert!(names(dir.path()).is_empty());
        fs::create_dir(&cells).unwrap();
        write_directory(&cells, fill).unwrap();
        assert_eq!((names(dir.path()), names(&cells)), (vec!["cells".to_owned()], vec!["a".to_owned()]));
        let refused = write_directory(&cells, fill).unwrap_err();
        assert!(matches!(refused, CommandError::NotEmpty { .. }), "{refused}");
    }

    #[track_caller]
    fn check_refused(tried: Result<(), CommandError>) {
        let message = tried.unwrap_err().to_string();
        assert!(message.starts_with("cannot write "), "{message}");
    }

    #[test]
    fn places_that_cannot_be_written() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("file");
        fs::write(&file, b"old").unwrap();
        check_file(&file).unwrap();
        check_file(&dir.path().join("new")).unwrap();
        check_directory(&dir.path().join("new")).unwrap();
        check_refused(check_file(dir.path()));
        check_refused(check_file(&file.join("below")));
        check_refused(check_file(&dir.path().join("no/such")));
        check_refused(check_file(Path::new("")));
        check_refused(check_directory(&file));
        check_refused(check_directory(&dir.path().join("no/such")));
        assert_eq!((names(dir.path()), fs::read(&file).unwrap()), (vec!["file".to_owned()], b"old".to_vec()));
    }
}
