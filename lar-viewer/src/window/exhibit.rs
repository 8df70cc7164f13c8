//! What a window shows and asks: a complex, questions about it, and where it comes from.

use crate::session::{Queries, Session};
use crate::{Camera, CellData};
use std::path::PathBuf;

/// A complex to show.
pub struct Exhibit {
    /// The complex, its triangles, and what is known of its cells.
    pub data: CellData,
    /// Further questions.
    pub queries: Box<dyn Queries>,
}

impl std::fmt::Debug for Exhibit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Exhibit").field("data", &self.data).finish_non_exhaustive()
    }
}

/// Makes a complex from files: called in a thread of its own, when files are dropped on the window or change.
pub trait Source: Send + 'static {
    /// The complex of these files together.
    ///
    /// # Errors
    /// What is wrong with the files, in words.
    fn load(&self, files: &[PathBuf]) -> Result<Exhibit, String>;
}

/// Everything that [`explore`](crate::explore()) shows.
pub struct Exploration {
    /// The complex and how it is shown at first.
    pub session: Session,
    /// Further questions about it.
    pub queries: Box<dyn Queries>,
    /// Where complexes come from.
    pub source: Box<dyn Source>,
    /// The files of the first one, watched for changes.
    pub files: Vec<PathBuf>,
    /// Where it is seen from; fitted to it when `None`.
    pub camera: Option<Camera>,
    /// Title of the window.
    pub title: String,
}

impl std::fmt::Debug for Exploration {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Exploration")
            .field("title", &self.title)
            .field("files", &self.files)
            .finish_non_exhaustive()
    }
}
