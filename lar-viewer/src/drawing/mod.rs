//! Drawings: a scene projected to the plane without its hidden lines, as segments, filled faces and SVG.
//!
//! Lines, dots and labels are cut where faces come to lie before them or end. Where faces are filled, those behind are drawn
//! first, and lines are as faint as the faces before them are opaque. Without filling, a face hides when it is visible and at
//! least half opaque; fainter ones are seen through.
//!
//! Each triangle is affine on the screen: with q = 1/depth (perspective) or −depth (parallel), q is an affine function of
//! the screen position on every triangle and along every segment, so a segment is hidden by a triangle on one interval,
//! found in closed form. Candidates come from a tree over the triangles' boxes on the screen. For n triangles, m segments
//! and k pairs that overlap on the screen, the triangle being nearer at some point, it takes O((n + m) log n + k log k).
//!
//! Comparisons allow for rounding (`SLACK`): a line on a face is not hidden by it. That is drawing, not topology: nothing
//! is decided by it but which pixels are inked.

mod contour;
mod fill;
mod order;
mod placed;
mod project;
mod svg;
mod tree;

pub use fill::InkArea;

use crate::{Drawable, Rgb, Scene, View, ViewerError};
use placed::Placed;
use project::{Projector, Seen};
use tree::Tree;

/// Opacity from which faces hide what is behind them.
const HIDING: f32 = 0.5;
/// A line counts as hidden when it is farther than a face by more than this part of its distance.
const SLACK: f64 = 1e-6;
/// Pieces of lines shorter than this are left out, in pixels.
const SHORTEST: f64 = 0.05;
/// Opacities of ink are multiples of this; there is none below.
const FAINTEST: f64 = 1.0 / 64.0;

/// A visible piece of a line, in pixels from the middle of the picture, y upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InkLine {
    /// Both ends; equal for dots.
    pub ends: [[f64; 2]; 2],
    /// Width in pixels.
    pub width: f64,
    /// Colour.
    pub color: Rgb,
    /// Opacity: less than 1 behind translucent faces.
    pub opacity: f64,
}

/// What of the lines, dots and labels of a scene is seen.
///
/// ```
/// use lar_viewer::{Drawable, LineDrawing, Scene, View};
/// let mut scene = Scene::new();
/// scene.push(Drawable::lines("diagonal", [[[0.; 3], [1.; 3]]]))?;
/// let drawing = LineDrawing::new(&scene, &View::fitted(&scene, [1.; 3], 1.5), [300, 200])?;
/// assert_eq!(drawing.lines().len(), 1);
/// assert!(drawing.to_svg().starts_with("<svg"));
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LineDrawing {
    /// Back to front.
    areas: Vec<InkArea>,
    lines: Vec<InkLine>,
    size: [u32; 2],
    background: Option<Rgb>,
}

impl LineDrawing {
    /// Projects the scene and removes hidden lines. Needs no graphics card.
    ///
    /// # Errors
    /// `InvalidView`, also when the picture has no pixels.
    pub fn new(scene: &Scene, view: &View, size: [u32; 2]) -> Result<Self, ViewerError> {
        Self::drawn(scene, view, size, false)
    }

    /// The same with faces filled, in the colours and the light of pictures. Faces are put in order by pairs that overlap on the
    /// screen, so that this takes time in proportion to those; where faces lie before each other in turn, or pierce each
    /// other, no order is right and the farther one is drawn first.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn filled(scene: &Scene, view: &View, size: [u32; 2]) -> Result<Self, ViewerError> {
        Self::drawn(scene, view, size, true)
    }

    fn drawn(scene: &Scene, view: &View, size: [u32; 2], filled: bool) -> Result<Self, ViewerError> {
        view.validate()?;
        if let Some(side) = size.into_iter().find(|&side| side == 0) {
            let parameter = "a side of the picture";
            return Err(ViewerError::InvalidView {
                parameter,
                value: f64::from(side),
                expected: "at least 1",
            });
        }
        let center = scene.center();
        let place = |drawable| Placed {
            drawable,
            view,
            projector: Projector::new(&view.camera, f64::from(size[1])),
            moved: scene.displacement(drawable, &view.explode, center),
            filled,
        };
        let visible = |d: &&Drawable| d.appearance.visible && 0.0 < d.appearance.opacity;
        let placed: Vec<Placed<'_>> =
            scene.drawables().iter().filter(visible).map(place).filter(|p| !p.is_removed(scene)).collect();
        let tree = Tree::new(placed.iter().flat_map(Placed::occluders).collect());
        let mut lines: Vec<InkLine> = placed.iter().flat_map(|p| p.ink(&tree)).collect();
        if let Some(outline) = &view.outline {
            lines.extend(contour::ink(scene, &placed, outline, &tree));
        }
        let faces = if filled { placed.iter().flat_map(fill::faces).collect() } else { Vec::new() };
        let background = (0.0 < view.background_opacity).then_some(view.background);
        Ok(Self { areas: order::back_to_front(faces), lines, size, background })
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The filled faces, back to front.
    #[must_use]
    pub fn areas(&self) -> &[InkArea] {
        &self.areas
    }

    /// Puts another drawing over this one, its upper left corner at `corner`, in pixels from the left and the top; its
    /// background is left out.
    pub fn overlay(&mut self, other: &Self, corner: [f64; 2]) {
        let half = |size: [u32; 2]| size.map(|side| 0.5 * f64::from(side));
        let ([w, h], [x, y]) = (half(self.size), half(other.size));
        let moved = |p: [f64; 2]| [p[0] + corner[0] + x - w, p[1] + h - corner[1] - y];
        self.areas.extend(other.areas.iter().map(|area| area.moved(moved)));
        self.lines.extend(other.lines.iter().map(|line| InkLine { ends: line.ends.map(moved), ..*line }));
    }

    /// The visible pieces, drawable by drawable.
    #[must_use]
    pub fn lines(&self) -> &[InkLine] {
        &self.lines
    }

    /// The drawing as the text of an SVG document, one unit a pixel, coordinates to a hundredth; equal pieces once.
    #[must_use]
    pub fn to_svg(&self) -> String {
        svg::document(&self.areas, &self.lines, self.size, self.background)
    }
}

/// The pieces of a segment on the screen that are seen, and their opacity.
fn visible_pieces(tree: &Tree, a: Seen, b: Seen) -> Vec<([[f64; 2]; 2], f64)> {
    let (start, end) = (a.screen(), b.screen());
    let length = (end[0] - start[0]).hypot(end[1] - start[1]);
    let at = |t: f64| [start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])];
    let seen = parts(&tree.before(a, b)).into_iter().filter(|([s, t], _)| SHORTEST < (t - s) * length);
    seen.map(|(part, opacity)| (part.map(at), opacity)).collect()
}

/// The parts of 0 to 1 behind intervals of which each lets through a part of the ink, with what is left of it; those where
/// nothing is left are left out. O(k log k) for k intervals.
fn parts(intervals: &[([f64; 2], f64)]) -> Vec<([f64; 2], f64)> {
    let ends = intervals.iter().flat_map(|&([from, to], through)| [(from, through, 1), (to, through, -1)]);
    let mut ends: Vec<(f64, f64, i32)> = ends.collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)).then(a.1.total_cmp(&b.1)));
    let (mut parts, mut from): (Vec<([f64; 2], f64)>, f64) = (Vec::new(), 0.0);
    // Opaque faces before the place, translucent ones, and the logarithm of what these let through together.
    let (mut opaque, mut translucent, mut logarithm) = (0, 0, 0.0_f64);
    for (at, through, step) in ends.into_iter().chain([(1.0, 1.0, 0)]) {
        let left = if opaque == 0 { (logarithm.exp() / FAINTEST).round() * FAINTEST } else { 0.0 };
        if from < at && 0.0 < left {
            match parts.last_mut() {
                Some(([_, to], opacity)) if *to == from && *opacity == left => *to = at,
                _ => parts.push(([from, at], left)),
            }
        }
        from = from.max(at);
        if through <= 0.0 {
            opaque += step;
        } else {
            translucent += step;
            logarithm = if translucent == 0 { 0.0 } else { logarithm + f64::from(step) * through.ln() };
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_what_is_left() {
        let hidden = |intervals: &[[f64; 2]]| {
            let opaque: Vec<_> = intervals.iter().map(|&i| (i, 0.0)).collect();
            parts(&opaque).into_iter().map(|(part, opacity)| (part, opacity == 1.0)).collect::<Vec<_>>()
        };
        assert_eq!(hidden(&[]), [([0.0, 1.0], true)]);
        assert_eq!(hidden(&[[0.5, 0.7], [0.2, 0.6]]), [([0.0, 0.2], true), ([0.7, 1.0], true)]);
        assert_eq!(hidden(&[[0.0, 0.4], [0.4, 1.0]]), []);
        assert_eq!(hidden(&[[0.1, 0.9], [0.2, 0.3]]), [([0.0, 0.1], true), ([0.9, 1.0], true)]);
        let faint = parts(&[([0.2, 0.6], 0.5), ([0.4, 0.8], 0.5), ([0.7, 1.0], 0.0)]);
        let expected = [([0.0, 0.2], 1.0), ([0.2, 0.4], 0.5), ([0.4, 0.6], 0.25), ([0.6, 0.7], 0.5)];
        assert_eq!(faint, expected);
        assert_eq!(parts(&[([0.0, 1.0], 0.001)]), [], "fainter than any ink");
    }
}
