//! The legend of a colour map: a bar with ticks and numbers.

use crate::{
    Camera, ColorMap, Drawable, HorizontalAlign, INK, Image, Label, LineDrawing, OffscreenRenderer,
    Projection, Rgb, Scene, StandardView, TextStyle, View, ViewerError,
};
use lar_core::{Points, TriangleMesh};

/// Pieces of the bar.
const PIECES: u32 = 64;
/// Numbers along the bar.
const TICKS: u32 = 5;
/// Width of the bar and of the whole, in parts of the bar's height.
const WIDTHS: [f64; 2] = [0.09, 0.62];

/// What a colour map means: which number is which colour.
///
/// ```no_run
/// use lar_viewer::{ColorBar, ColorMap, OffscreenRenderer};
/// let bar = ColorBar { map: ColorMap::Sequential, range: [0.0, 2.5], title: "volume".into() };
/// bar.image(&mut OffscreenRenderer::new()?, 300)?.write_png("bar.png")?;
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ColorBar {
    /// The colours.
    pub map: ColorMap,
    /// The numbers that 0 and 1 stand for.
    pub range: [f64; 2],
    /// What is measured.
    pub title: String,
}

impl ColorBar {
    /// The bar, upright, with its numbers to the right and its title above, as a scene of height 1.
    ///
    /// # Errors
    /// `Coordinate` when the range is not finite.
    pub fn scene(&self, text: Rgb, size: f64) -> Result<Scene, ViewerError> {
        let mut scene = Scene::new();
        let part = |i: u32, n: u32| f64::from(i) / f64::from(n);
        for i in 0..PIECES {
            let color = self.map.color(part(2 * i + 1, 2 * PIECES));
            // Reaching into the next: side by side they would let the ground shine through where edges are smoothed.
            let top = part(2 * i + 3, 2 * PIECES).min(1.0);
            let piece = rectangle(WIDTHS[0], part(i, PIECES), top);
            scene.push(Drawable::mesh("colours", piece).color(color).unlit())?;
        }
        let style = TextStyle { size, horizontal: HorizontalAlign::Left, ..TextStyle::default() };
        let tick = |i: u32| {
            let y = part(i, TICKS - 1);
            let value = self.range[0] + y * (self.range[1] - self.range[0]);
            Label::new(short(value), [1.7 * WIDTHS[0], y, 0.0])
        };
        let title = Label::new(self.title.as_str(), [0.0, 1.09, 0.0]);
        let labels = (0..TICKS).map(tick).chain([title]);
        scene.push(Drawable::labels("numbers", labels).text_style(style).color(text).on_top())?;
        let mark =
            |i: u32| [[WIDTHS[0], part(i, TICKS - 1), 0.0], [1.4 * WIDTHS[0], part(i, TICKS - 1), 0.0]];
        scene.push(Drawable::lines("ticks", (0..TICKS).map(mark)).width(1.5).color(text))?;
        Ok(scene)
    }

    /// The bar on a transparent ground, in a picture of this height in pixels.
    ///
    /// # Errors
    /// Those of [`OffscreenRenderer::render`].
    pub fn image(&self, renderer: &mut OffscreenRenderer, height: u32) -> Result<Image, ViewerError> {
        let (scene, view, width) = self.shown(height)?;
        renderer.render(&scene, &view, width, height)
    }

    /// The bar as a drawing of this height in pixels.
    ///
    /// # Errors
    /// `Coordinate` when the range is not finite, `InvalidView` without height.
    pub fn drawing(&self, height: u32) -> Result<LineDrawing, ViewerError> {
        let (scene, view, width) = self.shown(height)?;
        LineDrawing::filled(&scene, &view, [width, height])
    }

    /// The scene, seen from above, and the width that it needs at this height.
    fn shown(&self, height: u32) -> Result<(Scene, View, u32), ViewerError> {
        let scene = self.scene(INK, (f64::from(height) / 26.0).clamp(6.0, 60.0))?;
        let orientation = StandardView::Top.orientation();
        let camera = Camera { orientation, projection: Projection::Orthographic, ..Camera::default() };
        let camera = Camera { target: [0.5 * WIDTHS[1] - 0.05, 0.52, 0.0], ..camera }.orthographic(1.25)?;
        let view = View { camera, background: [1.0; 3], background_opacity: 0.0, ..View::default() };
        let width = (f64::from(height) * WIDTHS[1] / 1.25).ceil().max(1.0) as u32;
        Ok((scene, view, width))
    }
}

fn rectangle(width: f64, low: f64, high: f64) -> TriangleMesh {
    let points = Points::from_columns(2, vec![0.0, low, width, low, width, high, 0.0, high]);
    TriangleMesh { points, triangles: vec![[0, 1, 2], [0, 2, 3]] }
}

/// Three significant digits.
fn short(value: f64) -> String {
    let digits = if value == 0.0 { 0 } else { 2 - value.abs().log10().floor() as i32 };
    match digits {
        -3..=8 => format!("{value:.*}", digits.max(0) as usize),
        _ => format!("{value:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let all = [0.0, 1.0, 0.25, 1234.5, -0.001234, 1e-12, 1e9].map(short);
        assert_eq!(all, ["0", "1.00", "0.250", "1234", "-0.00123", "1.00e-12", "1.00e9"]);
    }
}
