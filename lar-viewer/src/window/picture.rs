//! The picture of the scene: uploaded when it changes, drawn when anything does, asked what is at a pixel.

use super::subject::Subject;
use crate::gpu::renderer::Renderer;
use crate::gpu::scene::SceneBuffers;
use crate::{Appearance, Hit, Image, View, ViewerError};

/// Distance in pixels within which an edge or vertex is hit.
const REACH: u32 = 5;

/// A scene on the graphics card, and what was last drawn of it.
pub(crate) struct Picture {
    pub(crate) renderer: Renderer,
    buffers: SceneBuffers,
    revision: u64,
    looks: Vec<Appearance>,
    drawn: Option<(View, [u32; 2])>,
}

impl Picture {
    pub(crate) fn new(renderer: Renderer, subject: &Subject) -> Result<Self, ViewerError> {
        let buffers = SceneBuffers::new(&renderer.context, &subject.scene, u64::MAX)?;
        let mut picture =
            Self { renderer, buffers, revision: subject.revision, looks: Vec::new(), drawn: None };
        picture.follow(subject)?;
        Ok(picture)
    }

    /// Uploads what has changed: the scene, or only how it looks.
    pub(crate) fn follow(&mut self, subject: &Subject) -> Result<(), ViewerError> {
        let context = &self.renderer.context;
        let anew = self.revision != subject.revision;
        if anew {
            self.buffers = SceneBuffers::new(context, &subject.scene, u64::MAX)?;
            self.revision = subject.revision;
        }
        if anew || self.looks != subject.looks {
            self.buffers.set_appearances(context, &subject.scene, &subject.looks)?;
            self.looks.clone_from(&subject.looks);
            self.drawn = None;
        }
        Ok(())
    }

    /// Draws the scene when view, size or scene have changed. On a software driver a changing view is drawn with one
    /// sample per pixel, and finely once it rests. Returns the texture where it is new, and whether it is still to be
    /// drawn finely.
    pub(crate) fn draw(
        &mut self,
        view: &View,
        size: [u32; 2],
        dragging: bool,
    ) -> Result<(Option<wgpu::TextureView>, bool), ViewerError> {
        let fine = *view;
        let coarse = View { samples: 1, ..fine };
        let draft = self.renderer.context.is_software && fine != coarse;
        let same = |view: View| self.drawn == Some((view, size));
        let resting = same(coarse) && !dragging;
        let wanted = if draft && !same(fine) && !resting { coarse } else { fine };
        if same(wanted) {
            return Ok((None, wanted != fine));
        }
        let texture = self.renderer.draw(&self.buffers, &wanted, size[0], size[1])?.picture_view.clone();
        self.drawn = Some((wanted, size));
        Ok((Some(texture), wanted != fine))
    }

    /// The picture, finely sampled, as pixels.
    pub(crate) fn read(&mut self, view: &View, size: [u32; 2]) -> Result<Image, ViewerError> {
        self.renderer.draw(&self.buffers, view, size[0], size[1])?;
        // The texture on show holds this picture now.
        self.drawn = None;
        self.renderer.read_picture()
    }

    /// What is seen at a pixel.
    pub(crate) fn pick(
        &self,
        subject: &Subject,
        view: &View,
        size: [u32; 2],
        pixel: [u32; 2],
    ) -> Result<Option<Hit>, ViewerError> {
        let seen = self.renderer.pick(&self.buffers, view, size, pixel, REACH)?;
        Ok(seen.map(|seen| Hit::new(&subject.scene, view, size, seen)))
    }
}
