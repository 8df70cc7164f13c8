//! What a window shows and asks: a complex, questions about it, and where it comes from.

use crate::session::{Session, WrapStep};
use crate::{Camera, CellData};
use lar_core::Chain;
use std::path::PathBuf;

/// Questions that a chain complex alone does not answer.
pub trait Queries: Send {
    /// The cells of the highest dimension where a Boolean expression over the solids holds.
    ///
    /// # Errors
    /// What is wrong with the expression, in words.
    fn boolean(&self, expression: &str) -> Result<Chain, String>;

    /// The steps of gift wrapping a cell of the highest dimension.
    ///
    /// # Errors
    /// Why there are none, in words.
    fn wrapping(&self, cell: u32) -> Result<Vec<WrapStep>, String>;
}

/// No answers: for complexes that come from no arrangement.
#[derive(Clone, Copy, Debug)]
pub struct NoQueries;

impl Queries for NoQueries {
    fn boolean(&self, _: &str) -> Result<Chain, String> {
        Err("this complex has no solids to combine".to_owned())
    }

    fn wrapping(&self, _: u32) -> Result<Vec<WrapStep>, String> {
        Err("this complex was not made by gift wrapping".to_owned())
    }
}

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
