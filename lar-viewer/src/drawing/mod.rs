//! Line drawings: a scene projected to the plane without its hidden lines, as segments and as SVG.
//!
//! Lines, dots and labels are cut where faces come to lie before them or end. A face hides when it is visible and at least
//! half opaque; fainter ones are seen through. Faces are not filled.
//!
//! Each triangle is affine on the screen: with q = 1/depth (perspective) or −depth (parallel), q is an affine function of
//! the screen position on every triangle and along every segment, so a segment is hidden by a triangle on one interval,
//! found in closed form. Candidates come from a tree over the triangles' boxes on the screen. For n triangles, m segments
//! and k pairs that overlap on the screen, the triangle being nearer at some point, it takes O((n + m) log n + k log k).
//!
//! Comparisons allow for rounding (`SLACK`): a line on a face is not hidden by it. That is drawing, not topology: nothing
//! is decided by it but which pixels are inked.

mod project;
mod svg;
mod tree;

use crate::scene::Shape;
use crate::{Drawable, Rgb, Scene, View, ViewerError, text};
use project::{Projector, Seen, clip_polygon};
use tree::{Tree, Triangle};

/// Opacity from which faces hide what is behind them.
const HIDING: f32 = 0.5;
/// A line counts as hidden when it is farther than a face by more than this part of its distance.
const SLACK: f64 = 1e-6;
/// Pieces of lines shorter than this are left out, in pixels.
const SHORTEST: f64 = 0.05;

/// A visible piece of a line, in pixels from the middle of the picture, y upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InkLine {
    /// Both ends; equal for dots.
    pub ends: [[f64; 2]; 2],
    /// Width in pixels.
    pub width: f64,
    /// Colour.
    pub color: Rgb,
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
        };
        let visible = |d: &&Drawable| d.appearance.visible && 0.0 < d.appearance.opacity;
        let placed: Vec<Placed<'_>> =
            scene.drawables().iter().filter(visible).map(place).filter(|p| !p.is_removed(scene)).collect();
        let tree = Tree::new(placed.iter().flat_map(Placed::occluders).collect());
        let lines = placed.iter().flat_map(|p| p.ink(&tree)).collect();
        let background = (0.0 < view.background_opacity).then_some(view.background);
        Ok(Self { lines, size, background })
    }

    /// The visible pieces, drawable by drawable.
    #[must_use]
    pub fn lines(&self) -> &[InkLine] {
        &self.lines
    }

    /// The drawing as the text of an SVG document, one unit a pixel, coordinates to a hundredth; equal pieces once.
    #[must_use]
    pub fn to_svg(&self) -> String {
        svg::document(&self.lines, self.size, self.background)
    }
}

/// A drawable, where it is seen.
struct Placed<'a> {
    drawable: &'a Drawable,
    view: &'a View,
    projector: Projector,
    moved: [f64; 3],
}

impl Placed<'_> {
    /// Whether the clip plane takes its group, or the view hides edges.
    fn is_removed(&self, scene: &Scene) -> bool {
        let hidden_edges =
            matches!(self.drawable.shape, Shape::Lines { cell_edges: true, .. }) && !self.view.edges;
        let centroid = self.drawable.group.map(|g| scene.groups()[g.0 as usize].centroid);
        let whole = self.view.clip.filter(|c| c.whole_cells && self.drawable.clipped);
        hidden_edges || whole.zip(centroid).is_some_and(|(clip, c)| clip.removes(c))
    }

    /// The corners of a polygon or segment that are left by the clip plane and the eye, on the screen.
    fn seen(&self, corners: &[[f64; 3]]) -> Vec<Seen> {
        let by_group = self.view.clip.is_some_and(|c| c.whole_cells) && self.drawable.group.is_some();
        let clip = self.view.clip.filter(|_| self.drawable.clipped && !by_group);
        let kept = match clip {
            Some(clip) => clip_polygon(corners, |p| clip.height(p)),
            None => corners.to_vec(),
        };
        let moved: Vec<[f64; 3]> =
            kept.into_iter().map(|p| std::array::from_fn(|k| p[k] + self.moved[k])).collect();
        let before = clip_polygon(&moved, |p| self.projector.behind(p));
        before.into_iter().map(|p| self.projector.seen(p)).collect()
    }

    /// The triangles that hide what is behind them.
    fn occluders(&self) -> Vec<Triangle> {
        let opacity = self.drawable.appearance.opacity * self.view.opacity;
        if !matches!(self.drawable.shape, Shape::Mesh { .. }) || opacity < HIDING {
            return Vec::new();
        }
        let triangles = (0..self.drawable.n_elements()).flat_map(|t| {
            let polygon = self.seen(&self.drawable.corners_of_element(t));
            let fan: Vec<Triangle> =
                polygon.windows(2).skip(1).filter_map(|w| Triangle::new([polygon[0], w[0], w[1]])).collect();
            fan
        });
        triangles.collect()
    }

    /// What is seen of its lines, dots and labels.
    fn ink(&self, tree: &Tree) -> Vec<InkLine> {
        let scale = f64::from(self.view.scale);
        let elements = 0..self.drawable.n_elements();
        let color = self.drawable.appearance.color;
        match &self.drawable.shape {
            Shape::Mesh { .. } => Vec::new(),
            Shape::Lines { width, .. } => {
                let width = scale * f64::from(*width);
                let pieces = elements.flat_map(|i| self.visible(tree, i));
                pieces.map(|ends| InkLine { ends, width, color }).collect()
            }
            Shape::Points { size, .. } => {
                let width = scale * f64::from(*size);
                let dots = elements.filter_map(|i| self.visible_point(tree, i));
                dots.map(|p| InkLine { ends: [p, p], width, color }).collect()
            }
            Shape::Labels { labels, style, on_top } => {
                let width = scale * (0.15 * style.size).max(1.2);
                let mut found = Vec::new();
                for (i, label) in labels.iter().enumerate() {
                    let anchor =
                        if *on_top { self.point(i).map(Seen::screen) } else { self.visible_point(tree, i) };
                    let Some([x, y]) = anchor else { continue };
                    let place = |p: [f64; 2]| [x + scale * p[0], y + scale * p[1]];
                    let strokes = text::strokes(&label.text, style).into_iter();
                    found.extend(strokes.map(|s| InkLine { ends: s.map(place), width, color }));
                }
                found
            }
        }
    }

    fn point(&self, element: usize) -> Option<Seen> {
        self.seen(&self.drawable.corners_of_element(element)).first().copied()
    }

    fn visible_point(&self, tree: &Tree, element: usize) -> Option<[f64; 2]> {
        let point = self.point(element)?;
        tree.hidden(point, point).is_empty().then(|| point.screen())
    }

    /// The pieces of a segment that nothing hides.
    fn visible(&self, tree: &Tree, element: usize) -> Vec<[[f64; 2]; 2]> {
        let [a, b] = *self.seen(&self.drawable.corners_of_element(element)).as_slice() else {
            return Vec::new();
        };
        let (start, end) = (a.screen(), b.screen());
        let length = (end[0] - start[0]).hypot(end[1] - start[1]);
        let at = |t: f64| [start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])];
        let gaps = gaps(tree.hidden(a, b));
        gaps.into_iter().filter(|[s, t]| SHORTEST < (t - s) * length).map(|g| g.map(at)).collect()
    }
}

/// What intervals leave of 0 to 1.
fn gaps(mut intervals: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    intervals.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut from = 0.0;
    let mut gaps = Vec::new();
    for [start, end] in intervals {
        if from < start {
            gaps.push([from, start]);
        }
        from = end.max(from);
    }
    if from < 1.0 {
        gaps.push([from, 1.0]);
    }
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_what_is_left() {
        assert_eq!(gaps(vec![]), [[0.0, 1.0]]);
        assert_eq!(gaps(vec![[0.5, 0.7], [0.2, 0.6]]), [[0.0, 0.2], [0.7, 1.0]]);
        assert_eq!(gaps(vec![[0.0, 0.4], [0.4, 1.0]]), [[0.0; 2]; 0]);
        assert_eq!(gaps(vec![[0.1, 0.9], [0.2, 0.3]]), [[0.0, 0.1], [0.9, 1.0]]);
    }
}
