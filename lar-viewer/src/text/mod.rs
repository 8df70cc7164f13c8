//! Text as segments, in the vector font of [`font`]: labels that face the camera and text that lies in the model.

mod font;
mod numbering;

pub use numbering::{NUMBER_COLORS, push_numbers};

use lar_core::{Cells, Model, Points};

/// Lines of a text are this far apart, in heights of capitals.
const LEADING: f64 = 1.7;

/// Where a text lies, relative to its anchor, from left to right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HorizontalAlign {
    /// It begins at the anchor.
    Left,
    /// The anchor is in its middle.
    #[default]
    Center,
    /// It ends at the anchor.
    Right,
}

/// Where a text lies, relative to its anchor, upwards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VerticalAlign {
    /// The last line stands on the anchor.
    Baseline,
    /// The anchor is in its middle.
    #[default]
    Middle,
    /// The capitals of the first line reach up to the anchor.
    Top,
}

/// Attributes of a text.
///
/// ```
/// use lar_viewer::{HorizontalAlign, TextStyle};
/// let style = TextStyle { horizontal: HorizontalAlign::Left, size: 20.0, ..TextStyle::default() };
/// assert_eq!(style.angle, 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStyle {
    /// Alignment from left to right.
    pub horizontal: HorizontalAlign,
    /// Alignment upwards.
    pub vertical: VerticalAlign,
    /// Direction of the lines, counter-clockwise from the horizontal, in radians.
    pub angle: f64,
    /// Height of capitals: in pixels for labels, in units of the plane for text that lies in the model.
    pub size: f64,
    /// Distance between characters, as a multiple of the usual one.
    pub spacing: f64,
}

impl Default for TextStyle {
    /// Centred, horizontal, capitals 10 high.
    fn default() -> Self {
        Self {
            horizontal: HorizontalAlign::default(),
            vertical: VerticalAlign::default(),
            angle: 0.0,
            size: 10.0,
            spacing: 1.0,
        }
    }
}

/// The strokes of a text in its plane, the anchor at the origin. `\n` begins a new line; characters outside of ASCII 32 to
/// 126 are boxes. Takes time linear in the number of characters.
pub(crate) fn strokes(text: &str, style: &TextStyle) -> Vec<[[f64; 2]; 2]> {
    let unit = style.size / f64::from(font::CAP_HEIGHT);
    let lines: Vec<&str> = text.split('\n').collect();
    let height = style.size * (1.0 + LEADING * (lines.len() - 1) as f64);
    let top = match style.vertical {
        VerticalAlign::Baseline => height,
        VerticalAlign::Middle => 0.5 * height,
        VerticalAlign::Top => 0.0,
    };
    let (sin, cos) = style.angle.sin_cos();
    let mut strokes = Vec::new();
    for (i, line) in lines.into_iter().enumerate() {
        let baseline = top - style.size * (1.0 + LEADING * i as f64);
        let (glyphs, width) = line_of_glyphs(line, style.spacing);
        let left = match style.horizontal {
            HorizontalAlign::Left => 0.0,
            HorizontalAlign::Center => -0.5 * width,
            HorizontalAlign::Right => -width,
        };
        for (x, glyph) in glyphs {
            let place = |p: [i16; 2]| {
                let [u, v] = [unit * (left + x + f64::from(p[0])), baseline + unit * f64::from(p[1])];
                [cos * u - sin * v, sin * u + cos * v]
            };
            strokes.extend(glyph.strokes.into_iter().map(|s| s.map(place)));
        }
    }
    strokes
}

/// The glyphs of a line with the columns at which they begin, and the width of all.
fn line_of_glyphs(line: &str, spacing: f64) -> (Vec<(f64, font::Glyph)>, f64) {
    let gap = spacing * f64::from(font::GAP);
    let mut x = 0.0;
    let place = |character| {
        let glyph = font::glyph(character);
        let at = x;
        x += f64::from(glyph.width) + gap;
        (at, glyph)
    };
    let glyphs: Vec<_> = line.chars().map(place).collect();
    let width = (x - gap).max(0.0);
    (glyphs, width)
}

/// A text as a model in the plane: its vertices, and its strokes as edges; a dot is a vertex without an edge. The anchor
/// lies at the origin. O(n log n) for n strokes.
///
/// ```
/// use lar_viewer::{TextStyle, text_model};
/// let model = text_model("LAR", &TextStyle::default());
/// assert_eq!((model.points().dim(), model.dim()), (2, 1));
/// ```
#[doc(alias = "GLText")]
#[must_use]
pub fn text_model(text: &str, style: &TextStyle) -> Model {
    let strokes = strokes(text, style);
    let mut vertices: Vec<[f64; 2]> = strokes.iter().flatten().copied().collect();
    let order = |a: &[f64; 2], b: &[f64; 2]| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
    vertices.sort_by(order);
    vertices.dedup();
    let index =
        |p: [f64; 2]| vertices.binary_search_by(|v| order(v, &p)).expect("a vertex of the list") as u32;
    let mut edges: Vec<[u32; 2]> = strokes.iter().map(|s| s.map(index)).filter(|[a, b]| a != b).collect();
    edges.iter_mut().for_each(|e| e.sort_unstable());
    edges.sort_unstable();
    edges.dedup();
    let points = Points::from_columns(2, vertices.as_flattened().to_vec());
    let vertex_cells: Cells = (0..vertices.len() as u32).map(|v| [v]).collect();
    Model::new(points, vec![vertex_cells, edges.into_iter().collect()])
}

/// A text that lies in the model: its strokes as segments in the plane of `right` and `up` through `anchor`. `size` of the
/// style is a multiple of the lengths of these two, which make it upright and undistorted when they are orthonormal.
///
/// ```
/// use lar_viewer::{Drawable, TextStyle, text_segments};
/// let style = TextStyle { size: 0.2, ..TextStyle::default() };
/// let segments = text_segments("front", &style, [0.5, 0.0, 0.5], [1., 0., 0.], [0., 0., 1.]);
/// let drawable = Drawable::lines("title", segments).width(2.0);
/// # let _ = drawable;
/// ```
#[doc(alias = "GLText")]
#[must_use]
pub fn text_segments(
    text: &str,
    style: &TextStyle,
    anchor: [f64; 3],
    right: [f64; 3],
    up: [f64; 3],
) -> Vec<[[f64; 3]; 2]> {
    let place = |[u, v]: [f64; 2]| std::array::from_fn(|k| anchor[k] + u * right[k] + v * up[k]);
    strokes(text, style).into_iter().map(|s| s.map(place)).collect()
}

/// A text and the point of the scene that it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The text, several lines with `\n` between.
    pub text: String,
    /// Where it is.
    pub at: [f64; 3],
}

impl Label {
    /// This text at this point.
    #[must_use]
    pub fn new(text: impl Into<String>, at: [f64; 3]) -> Self {
        Self { text: text.into(), at }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extent(text: &str, style: TextStyle) -> [[f64; 2]; 2] {
        let points: Vec<_> = strokes(text, &style).into_iter().flatten().collect();
        let fold = |f: fn(f64, f64) -> f64, k: usize| points.iter().map(|p| p[k]).reduce(f).unwrap();
        [[fold(f64::min, 0), fold(f64::min, 1)], [fold(f64::max, 0), fold(f64::max, 1)]]
    }

    #[track_caller]
    fn check(text: &str, style: TextStyle, lo: [f64; 2], hi: [f64; 2]) {
        let found = extent(text, style);
        let near =
            found.as_flattened().iter().zip([lo, hi].as_flattened()).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(near, "{found:?} is not {lo:?}, {hi:?}");
    }

    #[test]
    fn alignment_size_spacing_angle_and_lines() {
        let base = TextStyle { size: 6.0, ..TextStyle::default() };
        check("H", base, [-2.0, -3.0], [2.0, 3.0]);
        check("HH", base, [-5.0, -3.0], [5.0, 3.0]);
        check("HH", TextStyle { spacing: 2.0, ..base }, [-6.0, -3.0], [6.0, 3.0]);
        check("HH", TextStyle { size: 12.0, ..base }, [-10.0, -6.0], [10.0, 6.0]);
        check("HH", TextStyle { horizontal: HorizontalAlign::Left, ..base }, [0.0, -3.0], [10.0, 3.0]);
        check("HH", TextStyle { horizontal: HorizontalAlign::Right, ..base }, [-10.0, -3.0], [0.0, 3.0]);
        check("H", TextStyle { vertical: VerticalAlign::Baseline, ..base }, [-2.0, 0.0], [2.0, 6.0]);
        check("H", TextStyle { vertical: VerticalAlign::Top, ..base }, [-2.0, -6.0], [2.0, 0.0]);
        check("H", TextStyle { angle: std::f64::consts::FRAC_PI_2, ..base }, [-3.0, -2.0], [3.0, 2.0]);
        check("H\nHH", TextStyle { vertical: VerticalAlign::Baseline, ..base }, [-5.0, 0.0], [5.0, 16.2]);
    }

    #[test]
    fn texts_are_one_complexes() {
        let model = text_model("Ai 8", &TextStyle::default());
        assert!(model.validate().is_empty(), "{:?}", model.validate());
        assert_eq!(
            model.f_vector()[1],
            strokes("Ai 8", &TextStyle::default()).len() - 1,
            "the dot is no edge"
        );
        assert!(text_model("", &TextStyle::default()).points().is_empty());
    }
}
