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
    /// Of what stands out and of the pieces.
    buffers: [SceneBuffers; 2],
    revisions: [u64; 2],
    looks: Vec<Appearance>,
    drawn: Option<(View, [u32; 2])>,
}

impl Picture {
    pub(crate) fn new(renderer: Renderer, subject: &Subject) -> Result<Self, ViewerError> {
        let pieces = SceneBuffers::new(&renderer.context, &subject.scenes[1], u64::MAX)?;
        let standing_out = pieces.beside(&renderer.context, &subject.scenes[0])?;
        let (buffers, revisions) = ([standing_out, pieces], subject.revisions);
        let mut picture = Self { renderer, buffers, revisions, looks: Vec::new(), drawn: None };
        picture.follow(subject)?;
        Ok(picture)
    }

    /// Uploads what has changed: the pieces, what stands out of them, or only how they look.
    pub(crate) fn follow(&mut self, subject: &Subject) -> Result<(), ViewerError> {
        let context = &self.renderer.context;
        let [beside, anew] = [0, 1].map(|i| self.revisions[i] != subject.revisions[i]);
        if anew {
            self.buffers[1] = SceneBuffers::new(context, &subject.scenes[1], u64::MAX)?;
        }
        if anew || beside {
            self.buffers[0] = self.buffers[1].beside(context, &subject.scenes[0])?;
            self.revisions = subject.revisions;
            self.drawn = None;
        }
        if anew || self.looks != subject.looks {
            self.buffers[1].set_appearances(context, &subject.scenes[1], &subject.looks)?;
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
        let texture =
            self.renderer.draw(&self.buffers.each_ref(), &wanted, size[0], size[1])?.picture_view.clone();
        self.drawn = Some((wanted, size));
        Ok((Some(texture), wanted != fine))
    }

    /// The picture, finely sampled, as pixels.
    pub(crate) fn read(&mut self, view: &View, size: [u32; 2]) -> Result<Image, ViewerError> {
        self.renderer.draw(&self.buffers.each_ref(), view, size[0], size[1])?;
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
        let seen = self.renderer.pick(&self.buffers.each_ref(), view, size, pixel, REACH)?;
        let center = self.buffers[1].placement.center;
        Ok(seen.map(|seen| Hit::new(&subject.scenes[seen.scene], center, view, size, seen)))
    }
}

#[cfg(test)]
mod tests;
