//! Pictures and their files.

use crate::ViewerError;
use std::path::Path;

/// A picture of 8-bit RGBA pixels, row by row from the top.
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

impl std::fmt::Debug for Image {
    /// The size only: the bytes of a picture fill screens.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image({} × {})", self.width, self.height)
    }
}

impl Image {
    /// `pixels` has 4 × width × height bytes.
    pub(crate) fn new(width: u32, height: u32, pixels: Vec<u8>) -> Self {
        debug_assert_eq!(pixels.len() as u64, 4 * u64::from(width) * u64::from(height));
        Self { width, height, pixels }
    }

    /// The same from colours that are multiplied by their opacity.
    pub(crate) fn from_premultiplied(width: u32, height: u32, mut pixels: Vec<u8>) -> Self {
        for pixel in pixels.chunks_exact_mut(4).filter(|p| !matches!(p[3], 0 | 255)) {
            let opacity = u32::from(pixel[3]);
            let divided = |c: u8| ((255 * u32::from(c) + opacity / 2) / opacity).min(255) as u8;
            pixel[..3].iter_mut().for_each(|c| *c = divided(*c));
        }
        Self::new(width, height, pixels)
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All bytes: red, green, blue, alpha of the first pixel of the top row, then the next.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// Red, green, blue and alpha of the pixel in column `x` of row `y`; `None` outside the picture.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        let at = 4 * (y as usize * self.width as usize + x as usize);
        let inside = x < self.width && y < self.height;
        inside.then(|| std::array::from_fn(|k| self.pixels[at + k]))
    }

    /// Puts another picture over this one, its upper left corner at column `x` of row `y`; what reaches beyond is cut.
    /// O(pixels in front).
    ///
    pub fn overlay(&mut self, front: &Self, x: u32, y: u32) {
        for row in 0..front.height.min(self.height.saturating_sub(y)) {
            for column in 0..front.width.min(self.width.saturating_sub(x)) {
                let at = 4 * ((y + row) as usize * self.width as usize + (x + column) as usize);
                let from = 4 * (row as usize * front.width as usize + column as usize);
                let back: [u8; 4] = std::array::from_fn(|k| self.pixels[at + k]);
                let front: [u8; 4] = std::array::from_fn(|k| front.pixels[from + k]);
                self.pixels[at..at + 4].copy_from_slice(&over(front, back));
            }
        }
    }

    /// The picture as a PNG file's bytes. O(pixels).
    ///
    /// # Errors
    /// `Encode`.
    pub fn to_png(&self) -> Result<Vec<u8>, ViewerError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()?;
        Ok(bytes)
    }

    /// Writes a PNG file. An existing file is replaced only when the new one is complete.
    ///
    /// # Errors
    /// `Encode`, or `File` with the path.
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), ViewerError> {
        let bytes = self.to_png()?;
        Ok(lar_core::atomic_write(path, |file| file.write_all(&bytes))?)
    }
}

/// A colour over another; colours are not multiplied by their opacity.
fn over(front: [u8; 4], back: [u8; 4]) -> [u8; 4] {
    let [front_alpha, back_alpha] = [u32::from(front[3]), u32::from(back[3])];
    // In units of 1/255².
    let (of_front, of_back) = (255 * front_alpha, (255 - front_alpha) * back_alpha);
    let whole = (of_front + of_back).max(1);
    let mixed = |k: usize| {
        let sum = of_front * u32::from(front[k]) + of_back * u32::from(back[k]);
        ((sum + whole / 2) / whole) as u8
    };
    [mixed(0), mixed(1), mixed(2), ((whole + 127) / 255).min(255) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn checker() -> Image {
        let pixels = (0..6_u8).flat_map(|i| [i * 40, 255 - i * 40, i, 255]).collect();
        Image::new(3, 2, pixels)
    }

    #[test]
    fn png_round_trip() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("checker.png");
        checker().write_png(&path).unwrap();
        checker().write_png(&path).unwrap();
        let file = std::io::BufReader::new(fs::File::open(&path).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(pixels, checker().pixels);
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1, "no temporary file is left");
    }

    #[test]
    fn colours_do_not_depend_on_opacity() {
        let image =
            Image::from_premultiplied(4, 1, vec![50, 0, 100, 100, 0, 0, 0, 0, 9, 9, 9, 255, 9, 0, 0, 4]);
        assert_eq!(image.pixels(), [128, 0, 255, 100, 0, 0, 0, 0, 9, 9, 9, 255, 255, 0, 0, 4]);
    }

    #[test]
    fn pictures_lie_over_each_other() {
        assert_eq!(over([9, 8, 7, 255], [1, 2, 3, 255]), [9, 8, 7, 255]);
        assert_eq!(over([9, 8, 7, 0], [1, 2, 3, 255]), [1, 2, 3, 255]);
        assert_eq!(over([200, 0, 100, 51], [0, 100, 100, 255]), [40, 80, 100, 255]);
        assert_eq!(over([200, 0, 100, 51], [7, 7, 7, 0]), [200, 0, 100, 51]);
        let mut back = checker();
        back.overlay(&Image::new(2, 2, [1, 2, 3, 255].repeat(4)), 2, 1);
        assert_eq!(back.pixel(2, 1), Some([1, 2, 3, 255]));
        assert_eq!([back.pixel(1, 1), back.pixel(2, 0)], [checker().pixel(1, 1), checker().pixel(2, 0)]);
    }

    #[test]
    fn an_unwritable_path_is_named_and_leaves_nothing() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("missing").join("a.png");
        let error = checker().write_png(&path).unwrap_err().to_string();
        assert!(error.starts_with("cannot write ") && error.contains("a.png"), "{error}");
        assert!(matches!(checker().write_png(dir.path()), Err(ViewerError::File(_))), "a directory");
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
    }

    #[test]
    fn pixels_are_found_by_column_and_row() {
        assert_eq!(checker().pixel(2, 1), Some([200, 55, 5, 255]));
        assert_eq!(checker().pixel(3, 0), None);
        assert_eq!(checker().pixel(0, 2), None);
    }
}
