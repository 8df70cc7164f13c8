//! Pages for browsers: the viewer as a page with an empty place, which a view fills.

use crate::CommandError;
use base64::{Engine, prelude::BASE64_STANDARD};
use flate2::{Compression, write::GzEncoder};
use lar_viewer::SharedView;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::{env, fs};

/// Where a page takes the view.
const VIEW: &str = "<!--lar:view-->";
/// Where a page takes its title.
const TITLE: &str = "<!--lar:title-->";
/// Name of the viewer's page.
const FILE: &str = "lar-viewer.html";
/// Names the viewer's page.
const VARIABLE: &str = "LAR_VIEWER_PAGE";

/// The viewer as a page, still without a view.
#[derive(Debug)]
pub(crate) struct ViewerPage {
    text: String,
}

impl ViewerPage {
    /// The page that was built by `lar-viewer/web/build.sh`: at `given`, at the path in `LAR_VIEWER_PAGE`, or near the
    /// program.
    pub(crate) fn find(given: Option<&Path>) -> Result<Self, CommandError> {
        let named = given.map(Path::to_owned).or_else(|| env::var_os(VARIABLE).map(PathBuf::from));
        let path = named.or_else(|| near_program().into_iter().find(|path| path.is_file()));
        Self::read(&path.ok_or(CommandError::NoViewerPage)?)
    }

    fn read(path: &Path) -> Result<Self, CommandError> {
        let text = fs::read_to_string(path)
            .map_err(|source| CommandError::Read { path: path.to_owned(), source })?;
        // The place for the viewer itself must have been filled.
        let has_viewer = text.contains("id=\"lar-viewer\"");
        if has_viewer && [VIEW, TITLE].iter().all(|mark| text.matches(mark).count() == 1) {
            Ok(Self { text })
        } else {
            Err(CommandError::NotAViewerPage { path: path.to_owned() })
        }
    }

    /// The page that shows a view.
    pub(crate) fn with_view(&self, view: &SharedView) -> Result<String, CommandError> {
        let packed = BASE64_STANDARD.encode(gzip(view.to_json()?.as_bytes())?);
        let block = format!("<script id=\"lar-view\" type=\"application/octet-stream\">{packed}</script>");
        // The view goes in last: what is in it is not looked at.
        Ok(self.text.replacen(TITLE, &escaped(&view.title), 1).replacen(VIEW, &block, 1))
    }
}

fn near_program() -> Vec<PathBuf> {
    let program = env::current_exe().unwrap_or_default();
    let beside = program.parent().unwrap_or(Path::new(""));
    ["", "..", "../share/lar"].map(|place| beside.join(place).join(FILE)).into()
}

/// A text between tags.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

fn gzip(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}
