//! `lar export-html`: one page with the inputs' arrangement and the window that shows it, for any browser.

use super::input::Inputs;
#[cfg(feature = "viewer")]
use super::picture::{Cut, Look, Pose};
#[cfg(not(feature = "viewer"))]
use crate::CommandError;
use std::path::PathBuf;

/// One page that shows the inputs' arrangement in any browser, as `lar view` does in a window: cells picked, exploded, hidden,
/// cut, measured. It holds scene and viewer and loads nothing, so it can be mailed, or opened without a network. Inputs are
/// surfaces in space or drawings in the plane (.svg, .seg).
#[derive(Debug, clap::Args)]
pub(crate) struct ExportHtml {
    #[command(flatten)]
    inputs: Inputs,
    /// The page.
    #[arg(short, long, value_name = "OUT.html")]
    output: PathBuf,
    /// Title of the page.
    #[arg(long, value_name = "TEXT", default_value = "lar")]
    title: String,
    /// The viewer for browsers, which lar-viewer/web/build.sh makes; looked for in the environment variable LAR_VIEWER_PAGE,
    /// then as lar-viewer.html beside this program, in the directory above, and in ../share/lar.
    #[arg(long, value_name = "PAGE.html")]
    viewer: Option<PathBuf>,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    pose: Pose,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    look: Look,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    cut: Cut,
}

#[cfg(not(feature = "viewer"))]
impl ExportHtml {
    #[expect(clippy::unused_self, reason = "the same call with and without the viewer")]
    pub(crate) fn run(&self, _: &mut dyn std::io::Write) -> Result<(), CommandError> {
        Err(CommandError::NotBuilt { feature: "viewer" })
    }
}

#[cfg(feature = "viewer")]
mod with_viewer {
    use super::ExportHtml;
    use crate::command::picture::{Background, cells};
    use crate::exploration::answers;
    use crate::output::check_file;
    use crate::page::ViewerPage;
    use crate::{CommandError, exploration::Explored};
    use lar_core::atomic_write;
    use lar_viewer::session::{Section, Session, Stage};
    use lar_viewer::{SharedView, View};
    use std::io::Write;

    /// Width by height of the picture in a window of usual size; elsewhere the page fits it anew.
    const ASPECT: f64 = 1.2;

    impl ExportHtml {
        pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
            check_file(&self.output)?;
            // What cannot be put into a page is not computed.
            let viewer = ViewerPage::find(self.viewer.as_deref())?;
            let (data, answers) = cells(&self.inputs, |arrangement| answers(&Explored::new(arrangement)))?;
            let session = self.look.session(data)?;
            let shared = self.shared(session, answers.unwrap_or_default())?;
            let page = viewer.with_view(&shared)?;
            atomic_write(&self.output, |file| file.write_all(page.as_bytes()))?;
            let megabytes = page.len() as f64 / 1e6;
            writeln!(out, "{}: a page of {megabytes:.1} MB", self.output.display())?;
            Ok(())
        }

        /// What the page shows at first.
        fn shared(
            &self,
            mut session: Session,
            answers: lar_viewer::Answers,
        ) -> Result<SharedView, CommandError> {
            let scene = Stage::new(session.data(), session.pieces())?.scene(&session)?;
            let bounds = scene.bounds([1.0; 3]);
            if let Some((clip, bounds)) = self.cut.clip().zip(bounds) {
                session.section = Section::at(&clip, &bounds);
            }
            let Background(background, _) = self.look.background();
            let explode = self.look.explosion().explosion();
            let view = View { explode, background, ..View::default() };
            let camera = self.pose.camera(&view, &scene, ASPECT)?;
            let (title, is_fitted) = (self.title.clone(), !self.pose.is_sized());
            Ok(SharedView { title, session, camera, is_fitted, answers })
        }
    }
}
