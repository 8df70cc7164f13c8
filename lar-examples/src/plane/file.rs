//! Pictures of the plane as files, SVG or PNG.

use super::input::extension;
use super::picture::Picture;
use crate::CommandError;
use crate::output::check_file;
use lar_core::atomic_write;
use std::path::{Path, PathBuf};

/// A place for a picture, known to be writable.
#[derive(Debug)]
pub(crate) struct PictureFile {
    path: PathBuf,
    size: [u32; 2],
    painter: Painter,
}

#[derive(Debug)]
enum Painter {
    Svg,
    #[cfg(feature = "viewer")]
    Png(Box<lar_viewer::OffscreenRenderer>),
}

impl PictureFile {
    /// The place for an SVG or a PNG of `size` pixels, as the extension says. What is needed for it is there
    /// afterwards: nothing is computed for a picture that cannot be drawn.
    pub(crate) fn new(path: &Path, size: [u32; 2]) -> Result<Self, CommandError> {
        let is_png = match extension(path).as_str() {
            "svg" => false,
            "png" => true,
            _ => return Err(CommandError::PictureFormat { path: path.to_owned() }),
        };
        check_file(path)?;
        let painter = if is_png { png()? } else { Painter::Svg };
        Ok(Self { path: path.to_owned(), size, painter })
    }

    /// Draws the picture and writes it, whole or not at all. Returns what drew it, for PNG.
    pub(crate) fn write(&mut self, picture: &Picture) -> Result<Option<String>, CommandError> {
        match &mut self.painter {
            Painter::Svg => {
                let text = picture.to_svg(self.size);
                atomic_write(&self.path, |file| file.write_all(text.as_bytes()))?;
                Ok(None)
            }
            #[cfg(feature = "viewer")]
            Painter::Png(renderer) => {
                picture.render(renderer, self.size)?.write_png(&self.path)?;
                Ok(Some(renderer.adapter_name().to_owned()))
            }
        }
    }
}

#[cfg(feature = "viewer")]
fn png() -> Result<Painter, CommandError> {
    Ok(Painter::Png(Box::new(lar_viewer::OffscreenRenderer::new()?)))
}

#[cfg(not(feature = "viewer"))]
fn png() -> Result<Painter, CommandError> {
    Err(CommandError::NotBuilt { feature: "viewer" })
}
