//! Animations: pictures one after the other in one animated PNG file, which browsers and most viewers of pictures play.

use crate::{Image, ViewerError};
use std::cell::RefCell;
use std::io::Write;
use std::path::Path;
use std::rc::Rc;

/// An animated PNG in the making. Pictures are compressed as they come, so that a long turn takes little memory.
///
/// ```no_run
/// use lar_viewer::{Animation, OffscreenRenderer, Scene, View};
/// let scene = Scene::new();
/// let turn = View::default().turntable(72);
/// let mut animation = Animation::new([640, 480], 72, 24)?;
/// for image in OffscreenRenderer::new()?.render_all(&scene, &turn, 640, 480)? {
///     animation.push(&image)?;
/// }
/// animation.write_png("turn.png")?;
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
pub struct Animation {
    encoder: png::Writer<Shared>,
    bytes: Shared,
    size: [u32; 2],
}

/// The bytes written so far, which the encoder does not give back.
#[derive(Clone, Default)]
struct Shared(Rc<RefCell<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl std::fmt::Debug for Animation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Animation({} × {})", self.size[0], self.size[1])
    }
}

impl Animation {
    /// An animation of `n` pictures of this width and height that runs for ever, `rate` pictures in a second.
    ///
    /// # Errors
    /// `Encode` when the size or the number is 0.
    pub fn new(size: [u32; 2], n: u32, rate: u16) -> Result<Self, ViewerError> {
        let bytes = Shared::default();
        let mut encoder = png::Encoder::new(bytes.clone(), size[0], size[1]);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_animated(n, 0)?;
        encoder.set_frame_delay(1, rate)?;
        encoder.validate_sequence(true);
        Ok(Self { encoder: encoder.write_header()?, bytes, size })
    }

    /// Adds the next picture.
    ///
    /// # Errors
    /// `Encode` when it is of another size, or one too many.
    pub fn push(&mut self, image: &Image) -> Result<(), ViewerError> {
        Ok(self.encoder.write_image_data(image.pixels())?)
    }

    /// The animation as a PNG file's bytes.
    ///
    /// # Errors
    /// `Encode` when pictures are missing.
    pub fn to_png(self) -> Result<Vec<u8>, ViewerError> {
        self.encoder.finish()?;
        Ok(self.bytes.0.take())
    }

    /// Writes the file. An existing file is replaced only when the new one is complete.
    ///
    /// # Errors
    /// `Encode` when pictures are missing, or `File` with the path.
    pub fn write_png(self, path: impl AsRef<Path>) -> Result<(), ViewerError> {
        let bytes = self.to_png()?;
        Ok(lar_core::atomic_write(path, |file| file.write_all(&bytes))?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(shade: u8) -> Image {
        Image::new(3, 2, [shade, 0, 255 - shade, 255].repeat(6))
    }

    #[test]
    fn all_pictures_are_in_the_file() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("turn.png");
        let mut animation = Animation::new([3, 2], 3, 24).unwrap();
        let shades = [10, 20, 30];
        shades.iter().for_each(|&s| animation.push(&image(s)).unwrap());
        assert!(animation.push(&image(40)).is_err(), "one too many");
        animation.write_png(&path).unwrap();
        let file = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let control = reader.info().animation_control.unwrap();
        assert_eq!((control.num_frames, control.num_plays), (3, 0));
        for shade in shades {
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut pixels).unwrap();
            assert_eq!(pixels, image(shade).pixels());
        }
    }

    #[test]
    fn pictures_that_do_not_fit_are_refused() {
        let dir = tempfile::tempdir().unwrap();
        assert!(Animation::new([0, 2], 3, 24).is_err());
        assert!(Animation::new([3, 2], 0, 24).is_err());
        let mut animation = Animation::new([3, 3], 2, 24).unwrap();
        assert!(animation.push(&image(1)).is_err());
        let mut animation = Animation::new([3, 2], 2, 24).unwrap();
        animation.push(&image(1)).unwrap();
        assert!(animation.write_png(dir.path().join("half.png")).is_err(), "one is missing");
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 0);
    }
}
