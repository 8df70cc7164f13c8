//! What is saved: pictures, and full turns as frames or animation. Files get the first name that is free.

use crate::{Animation, Image, View, ViewerError};
use std::path::{Path, PathBuf};

/// Pictures of a full turn.
const FRAMES: u32 = 72;
/// Pictures in a second.
const RATE: u16 = 24;

/// A full turn while it is drawn, one picture in each frame of the window.
pub(crate) struct Recording {
    views: Vec<View>,
    done: usize,
    size: [u32; 2],
    to: To,
}

enum To {
    /// Number of the turn in the names of its pictures.
    Frames(u32),
    Animation(Option<Box<Animation>>),
}

impl Recording {
    /// A turn as numbered pictures.
    pub(crate) fn frames(view: &View, size: [u32; 2]) -> Self {
        let turn = free(|n| frame_name(n, 0));
        Self { views: view.turntable(FRAMES), done: 0, size, to: To::Frames(turn) }
    }

    /// A turn as one animated picture.
    pub(crate) fn animation(view: &View, size: [u32; 2]) -> Result<Self, ViewerError> {
        let to = To::Animation(Some(Box::new(Animation::new(size, FRAMES, RATE)?)));
        Ok(Self { views: view.turntable(FRAMES), done: 0, size, to })
    }

    /// The next view to be drawn, and the size of its picture.
    pub(crate) fn next(&self) -> (View, [u32; 2]) {
        (self.views[self.done], self.size)
    }

    /// Takes the next picture; returns what to say, and whether this was the last.
    pub(crate) fn push(&mut self, image: &Image) -> Result<(String, bool), ViewerError> {
        match &mut self.to {
            To::Frames(turn) => image.write_png(frame_name(*turn, self.done))?,
            To::Animation(animation) => animation.iter_mut().try_for_each(|a| a.push(image))?,
        }
        self.done += 1;
        let last = self.done == self.views.len();
        let message = match &mut self.to {
            _ if !last => format!("recording: {} of {FRAMES}", self.done),
            To::Frames(turn) => format!("saved {} and on", frame_name(*turn, 0)),
            To::Animation(animation) => {
                let name = |n| format!("lar-turn-{n}.png");
                let path = name(free(name));
                animation.take().map_or(Ok(()), |animation| animation.write_png(&path))?;
                format!("saved {path}")
            }
        };
        Ok((message, last))
    }
}

/// Writes a picture under the first free name, which is returned.
pub(crate) fn screenshot(image: &Image) -> Result<PathBuf, ViewerError> {
    let name = |n| format!("lar-{n}.png");
    let path = PathBuf::from(name(free(name)));
    image.write_png(&path)?;
    Ok(path)
}

fn frame_name(turn: u32, frame: usize) -> String {
    format!("lar-turn-{turn}-{frame:04}.png")
}

/// The first number whose name is not taken.
fn free(name: impl Fn(u32) -> String) -> u32 {
    (1..u32::MAX).find(|&n| !Path::new(&name(n)).exists()).unwrap_or(0)
}
