//! A drawable on the screen.

use super::project::{Projector, Seen, clip_polygon};
use super::tree::{Tree, Triangle};
use super::{HIDING, InkLine, parts, visible_pieces};
use crate::scene::Shape;
use crate::{Drawable, Scene, View, text};

/// A drawable, where it is seen.
pub(super) struct Placed<'a> {
    pub(super) drawable: &'a Drawable,
    pub(super) view: &'a View,
    pub(super) projector: Projector,
    pub(super) moved: [f64; 3],
    /// Faces are filled.
    pub(super) filled: bool,
}

impl Placed<'_> {
    /// Whether the clip plane takes its group, or the view hides edges.
    pub(super) fn is_removed(&self, scene: &Scene) -> bool {
        let hidden_edges = self.drawable.curve().is_some() && !self.view.edges;
        let centroid = self.drawable.group.map(|g| scene.groups()[g.0 as usize].centroid);
        let whole = self.view.clip.filter(|c| c.whole_cells && self.drawable.clipped);
        hidden_edges || whole.zip(centroid).is_some_and(|(clip, c)| clip.removes(c))
    }

    /// The corners of a polygon or segment that are left by the clip plane and the eye, on the screen.
    fn seen(&self, corners: &[[f64; 3]]) -> Vec<Seen> {
        self.kept(corners).into_iter().map(|p| self.projector.seen(p)).collect()
    }

    /// The same in the exploded scene.
    pub(super) fn kept(&self, corners: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let by_group = self.view.clip.is_some_and(|c| c.whole_cells) && self.drawable.group.is_some();
        let clip = self.view.clip.filter(|_| self.drawable.clipped && !by_group);
        let kept = match clip {
            Some(clip) => clip_polygon(corners, |p| clip.height(p)),
            None => corners.to_vec(),
        };
        let moved: Vec<[f64; 3]> =
            kept.into_iter().map(|p| std::array::from_fn(|k| p[k] + self.moved[k])).collect();
        clip_polygon(&moved, |p| self.projector.behind(p))
    }

    /// Opacity of its faces.
    pub(super) fn opacity(&self) -> f64 {
        f64::from(self.drawable.appearance.opacity * self.view.opacity)
    }

    /// What part of the ink behind its faces is seen: as they are filled, or all or nothing.
    fn through(&self) -> f64 {
        match self.opacity() {
            opacity if self.filled => 1.0 - opacity,
            opacity if f64::from(HIDING) <= opacity => 0.0,
            _ => 1.0,
        }
    }

    /// A triangle as it is seen: cut by the clip plane and the eye, it is several or none.
    pub(super) fn seen_triangles(&self, element: usize) -> Vec<Triangle> {
        let polygon = self.seen(&self.drawable.corners_of_element(element));
        let fan = polygon.windows(2).skip(1);
        fan.filter_map(|w| Triangle::new([polygon[0], w[0], w[1]], self.through())).collect()
    }

    /// The triangles that hide what is behind them.
    pub(super) fn occluders(&self) -> Vec<Triangle> {
        if !matches!(self.drawable.shape, Shape::Mesh { .. }) || self.through() == 1.0 {
            return Vec::new();
        }
        (0..self.drawable.n_elements()).flat_map(|t| self.seen_triangles(t)).collect()
    }

    /// What is seen of its lines, dots and labels.
    pub(super) fn ink(&self, tree: &Tree) -> Vec<InkLine> {
        let scale = f64::from(self.view.scale);
        let elements = 0..self.drawable.n_elements();
        let color = self.drawable.appearance.color;
        match &self.drawable.shape {
            Shape::Mesh { .. } => Vec::new(),
            Shape::Lines { width, .. } => {
                let width = scale * f64::from(*width);
                let pieces = elements.flat_map(|i| self.visible(tree, i));
                pieces.map(|(ends, opacity)| InkLine { ends, width, color, opacity }).collect()
            }
            Shape::Points { size, .. } => {
                let width = scale * f64::from(*size);
                let dots = elements.filter_map(|i| self.visible_point(tree, i));
                dots.map(|(p, opacity)| InkLine { ends: [p, p], width, color, opacity }).collect()
            }
            Shape::Labels { labels, style, on_top } => {
                let width = scale * (0.15 * style.size).max(1.2);
                let mut found = Vec::new();
                for (i, label) in labels.iter().enumerate() {
                    let anchor = if *on_top {
                        self.point(i).map(|p| (p.screen(), 1.0))
                    } else {
                        self.visible_point(tree, i)
                    };
                    let Some(([x, y], opacity)) = anchor else { continue };
                    let place = |p: [f64; 2]| [x + scale * p[0], y + scale * p[1]];
                    let strokes = text::strokes(&label.text, style).into_iter();
                    found.extend(strokes.map(|s| InkLine { ends: s.map(place), width, color, opacity }));
                }
                found
            }
        }
    }

    fn point(&self, element: usize) -> Option<Seen> {
        self.seen(&self.drawable.corners_of_element(element)).first().copied()
    }

    fn visible_point(&self, tree: &Tree, element: usize) -> Option<([f64; 2], f64)> {
        let point = self.point(element)?;
        let opacity = parts(&tree.before(point, point)).first()?.1;
        Some((point.screen(), opacity))
    }

    /// The pieces of a segment that are seen, and their opacity.
    fn visible(&self, tree: &Tree, element: usize) -> Vec<([[f64; 2]; 2], f64)> {
        match *self.seen(&self.drawable.corners_of_element(element)).as_slice() {
            [a, b] => visible_pieces(tree, a, b),
            _ => Vec::new(),
        }
    }
}
