//! Files and directories under hidden names beside the place that they are meant for. All that are there are known, so
//! that an interrupted program can remove them before it ends.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A new file or directory with a hidden name of its own beside `target`. Dropped, it is removed with all that is in it.
///
/// ```
/// use lar_core::Temporary;
/// let target = std::env::temp_dir().join(format!("lar-temporary-{}", std::process::id()));
/// let directory = Temporary::directory(&target)?;
/// std::fs::write(directory.path().join("a"), "whole")?;
/// assert!(!target.exists());
/// directory.replace()?;
/// assert_eq!(std::fs::read(target.join("a"))?, b"whole");
/// # std::fs::remove_dir_all(&target)?;
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct Temporary {
    path: PathBuf,
    target: PathBuf,
}

/// File systems allow names of 255 bytes; a longer hidden name does not hold its target's.
const LONG: usize = 200;

/// What is there now. Whoever makes, removes or renames a temporary holds this lock meanwhile.
static PRESENT: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn present() -> MutexGuard<'static, Vec<PathBuf>> {
    PRESENT.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Temporary {
    /// A new file, open for writing.
    ///
    /// # Errors
    /// When it cannot be made: the directory of `target` is missing or not writable, or `target` has no name.
    pub fn file(target: &Path) -> io::Result<(File, Self)> {
        Self::made(target, |path| OpenOptions::new().write(true).create_new(true).open(path))
    }

    /// A new empty directory.
    ///
    /// # Errors
    /// As [`file`](Self::file).
    pub fn directory(target: &Path) -> io::Result<Self> {
        Ok(Self::made(target, |path| fs::create_dir(path))?.1)
    }

    fn made<T>(target: &Path, make: impl Fn(&Path) -> io::Result<T>) -> io::Result<(T, Self)> {
        static COUNTER: AtomicU32 = AtomicU32::new(0);
        let no_name = || io::Error::new(io::ErrorKind::InvalidInput, "no file name");
        let name = target.file_name().ok_or_else(no_name)?;
        let name = if name.len() <= LONG { name } else { "lar".as_ref() };
        let mut present = present();
        loop {
            let mut hidden = std::ffi::OsString::from(".");
            hidden.push(name);
            hidden.push(format!(".{}-{}.tmp", std::process::id(), COUNTER.fetch_add(1, Ordering::Relaxed)));
            let path = target.with_file_name(hidden);
            match make(&path) {
                Ok(made) => {
                    present.push(path.clone());
                    return Ok((made, Self { path, target: target.to_owned() }));
                }
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
                Err(e) => return Err(e),
            }
        }
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Renames it onto its target.
    ///
    /// # Errors
    /// When the system refuses; it is removed then.
    pub fn replace(self) -> io::Result<()> {
        let present = present();
        let renamed = fs::rename(&self.path, &self.target);
        // Dropping takes the lock.
        drop(present);
        renamed
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let mut present = present();
        remove(&self.path);
        present.retain(|path| *path != self.path);
    }
}

/// An error that comes before is the one to report; what cannot be removed changes nothing about it.
fn remove(path: &Path) {
    if fs::remove_file(path).is_err() {
        let _ = fs::remove_dir_all(path);
    }
}

/// Proof that no temporary is there, and that none is made or renamed while this lives.
#[derive(Debug)]
pub struct NoTemporaries {
    _lock: MutexGuard<'static, Vec<PathBuf>>,
}

/// Removes all temporaries of the program, and makes threads wait that want to make or rename one: for a program that was
/// interrupted and is about to exit, so that all its outputs are whole or absent.
///
/// ```
/// use lar_core::{Temporary, remove_temporaries};
/// let target = std::env::temp_dir().join(format!("lar-removed-{}", std::process::id()));
/// let (_file, temporary) = Temporary::file(&target)?;
/// let path = temporary.path().to_owned();
/// drop(remove_temporaries());
/// assert!(!path.exists());
/// # Ok::<(), std::io::Error>(())
/// ```
#[must_use]
pub fn remove_temporaries() -> NoTemporaries {
    let mut present = present();
    present.drain(..).for_each(|path| remove(&path));
    NoTemporaries { _lock: present }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn removed_when_dropped_and_kept_when_renamed() {
        let dir = tempfile::tempdir().unwrap();
        let n_entries = || fs::read_dir(dir.path()).unwrap().count();
        let target = dir.path().join("target");
        let temporaries = [Temporary::file(&target).unwrap().1, Temporary::directory(&target).unwrap()];
        fs::write(temporaries[1].path().join("inner"), "x").unwrap();
        assert_eq!(n_entries(), 2);
        drop(temporaries);
        assert_eq!(n_entries(), 0);
        Temporary::file(&target).unwrap().1.replace().unwrap();
        assert_eq!((n_entries(), target.is_file()), (1, true));
        // A file cannot be renamed onto a directory that is not empty.
        let full = dir.path().join("full");
        fs::create_dir_all(full.join("inner")).unwrap();
        assert!(Temporary::file(&full).unwrap().1.replace().is_err());
        assert_eq!(n_entries(), 2);
    }

    #[test]
    fn names_as_long_as_the_system_allows() {
        let dir = tempfile::tempdir().unwrap();
        for n in [LONG, LONG + 1, 255] {
            let target = dir.path().join("x".repeat(n));
            Temporary::file(&target).unwrap().1.replace().unwrap();
            assert!(target.is_file(), "{n}");
        }
        assert!(Temporary::file(Path::new("/")).is_err());
    }
}
