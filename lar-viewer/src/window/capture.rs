//! What is saved: pictures, and full turns as frames or animation. Files get the first name that is free.

use super::host::Host;
use crate::{Animation, Image, View, ViewerError};

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
    pub(crate) fn frames(view: &View, size: [u32; 2], host: &dyn Host) -> Self {
        let turn = host.free(&|n| frame_name(n, 0));
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
    pub(crate) fn push(&mut self, image: &Image, host: &mut dyn Host) -> Result<(String, bool), ViewerError> {
        match &mut self.to {
            To::Frames(turn) => host.save(&frame_name(*turn, self.done), &image.to_png()?)?,
            To::Animation(animation) => animation.iter_mut().try_for_each(|a| a.push(image))?,
        }
        self.done += 1;
        let last = self.done == self.views.len();
        let message = match &mut self.to {
            _ if !last => format!("recording: {} of {FRAMES}", self.done),
            To::Frames(turn) => format!("saved {} and on", frame_name(*turn, 0)),
            To::Animation(animation) => {
                let bytes = animation.take().map_or(Ok(Vec::new()), |animation| animation.to_png())?;
                format!("saved {}", save_numbered(|n| format!("lar-turn-{n}.png"), &bytes, host)?)
            }
        };
        Ok((message, last))
    }
}

/// Saves a picture and returns its name.
pub(crate) fn screenshot(image: &Image, host: &mut dyn Host) -> Result<String, ViewerError> {
    save_numbered(|n| format!("lar-{n}.png"), &image.to_png()?, host)
}

/// Saves a file under the first name that is free, which is returned.
fn save_numbered(
    name: impl Fn(u32) -> String,
    bytes: &[u8],
    host: &mut dyn Host,
) -> Result<String, ViewerError> {
    let name = name(host.free(&name));
    host.save(&name, bytes)?;
    Ok(name)
}

fn frame_name(turn: u32, frame: usize) -> String {
    format!("lar-turn-{turn}-{frame:04}.png")
}

#[cfg(test)]
mod tests {
    use super::super::host::Desktop;
    use super::*;

    fn record(mut recording: Recording, host: &mut Desktop) -> String {
        let image = Image::new(2, 1, [9, 8, 7, 255].repeat(2));
        loop {
            let (_, size) = recording.next();
            assert_eq!(size, [2, 1]);
            let (message, last) = recording.push(&image, host).unwrap();
            if last {
                return message;
            }
        }
    }

    #[test]
    fn turns_get_names_that_are_free() {
        let dir = tempfile::tempdir().unwrap();
        let (mut host, view) = (Desktop::saving_in(dir.path()), View::default());
        let mut frames = || record(Recording::frames(&view, [2, 1], &host), &mut host);
        assert_eq!(frames(), "saved lar-turn-1-0000.png and on");
        assert_eq!(frames(), "saved lar-turn-2-0000.png and on");
        let mut animation = || record(Recording::animation(&view, [2, 1]).unwrap(), &mut host);
        assert_eq!(animation(), "saved lar-turn-1.png");
        assert_eq!(animation(), "saved lar-turn-2.png");
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 2 * FRAMES as usize + 2);
        let image = Image::new(1, 1, vec![0; 4]);
        let saved = [(); 2].map(|()| screenshot(&image, &mut host).unwrap());
        assert_eq!(saved, ["lar-1.png", "lar-2.png"]);
        assert!(dir.path().join("lar-2.png").exists());
    }

    #[test]
    fn a_turn_ends_where_it_began() {
        let view = View::default();
        let recording = Recording::animation(&view, [2, 1]).unwrap();
        let eyes: Vec<_> = recording.views.iter().map(|v| v.camera.eye()).collect();
        let step = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
        assert!(step(eyes[0], view.camera.eye()) < 1e-9);
        assert!((step(eyes[0], eyes[1]) - step(eyes[71], eyes[0])).abs() < 1e-9);
    }
}
