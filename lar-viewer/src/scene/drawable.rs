//! Drawables: named triangles, segments, dots or labels, with what they show and how they look.

use super::{Appearance, CellRef, GroupId, mean_curve_length, point3};
use crate::{Bounds, Label, Rgb, TextStyle, text};
use lar_core::TriangleMesh;

/// The geometry of a drawable.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    Mesh {
        mesh: TriangleMesh,
        lit: bool,
    },
    Lines {
        segments: Vec<[[f64; 3]; 2]>,
        width: f32,
        /// Of edges of cells, how long the curves are that they are part of.
        curve: Option<f64>,
    },
    Points {
        points: Vec<[f64; 3]>,
        size: f32,
    },
    Labels {
        labels: Vec<Label>,
        style: TextStyle,
        on_top: bool,
    },
}

impl Shape {
    /// Its points, some of them repeatedly; what a broken triangle lacks is left out.
    fn points_drawn(&self) -> Box<dyn Iterator<Item = [f64; 3]> + '_> {
        match self {
            Self::Mesh { mesh, .. } => {
                let corners = mesh.triangles.as_flattened().iter().map(|&v| v as usize);
                Box::new(corners.filter(|&v| v < mesh.points.len()).map(|v| point3(&mesh.points, v)))
            }
            Self::Lines { segments, .. } => Box::new(segments.as_flattened().iter().copied()),
            Self::Points { points, .. } => Box::new(points.iter().copied()),
            Self::Labels { labels, .. } => Box::new(labels.iter().map(|l| l.at)),
        }
    }
}

/// One named thing to draw: triangles, segments, points or labels in one colour.
///
/// ```
/// use lar_viewer::Drawable;
/// let diagonal = Drawable::lines("diagonal", [[[0.; 3], [1.; 3]]]).width(3.0).color([1., 0., 0.]);
/// assert_eq!(diagonal.name(), "diagonal");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Drawable {
    pub(crate) name: String,
    pub(crate) shape: Shape,
    pub(crate) appearance: Appearance,
    pub(crate) group: Option<GroupId>,
    pub(crate) cell: Option<CellRef>,
    pub(crate) element_cells: Vec<CellRef>,
    pub(crate) clipped: bool,
    /// The box around its points: they do not change.
    bounds: Option<Bounds>,
}

impl Drawable {
    /// Triangles, seen from both sides, flatly lit. Points of two coordinates lie in z = 0.
    #[must_use]
    pub fn mesh(name: impl Into<String>, mesh: TriangleMesh) -> Self {
        Self::new(name, Shape::Mesh { mesh, lit: true }, [1.0; 3])
    }

    /// Segments of constant width on the screen.
    #[doc(alias = "GLLines")]
    #[must_use]
    pub fn lines(name: impl Into<String>, segments: impl IntoIterator<Item = [[f64; 3]; 2]>) -> Self {
        let segments = segments.into_iter().collect();
        Self::new(name, Shape::Lines { segments, width: 1.8, curve: None }, crate::INK)
    }

    /// Segments that are the edges of cells: drawn as `lines`, hidden when the view shows no edges, and thinner where
    /// the cell is so small on the screen that its edges would cover it.
    #[must_use]
    pub fn edges(name: impl Into<String>, segments: impl IntoIterator<Item = [[f64; 3]; 2]>) -> Self {
        let segments: Vec<_> = segments.into_iter().collect();
        let curve = Some(mean_curve_length(&segments));
        Self::new(name, Shape::Lines { segments, width: 1.8, curve }, crate::INK)
    }

    /// Round dots of constant size on the screen.
    #[doc(alias = "GLPoints")]
    #[must_use]
    pub fn points(name: impl Into<String>, points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        Self::new(name, Shape::Points { points: points.into_iter().collect(), size: 6.0 }, crate::INK)
    }

    /// Texts that face the camera at constant size on the screen, with a dark or light rim. They are hidden by what lies
    /// before their anchors.
    #[doc(alias = "GLText")]
    #[must_use]
    pub fn labels(name: impl Into<String>, labels: impl IntoIterator<Item = Label>) -> Self {
        let labels = labels.into_iter().collect();
        Self::new(name, Shape::Labels { labels, style: TextStyle::default(), on_top: false }, crate::INK)
    }

    fn new(name: impl Into<String>, shape: Shape, color: Rgb) -> Self {
        Self {
            name: name.into(),
            bounds: Bounds::of(shape.points_drawn()),
            shape,
            appearance: Appearance::new(color),
            group: None,
            cell: None,
            element_cells: Vec::new(),
            clipped: true,
        }
    }

    /// With this colour.
    #[must_use]
    pub fn color(mut self, color: Rgb) -> Self {
        self.appearance.color = color;
        self
    }

    /// With this opacity, 0 invisible to 1 opaque.
    #[must_use]
    pub fn opacity(mut self, opacity: f32) -> Self {
        self.appearance.opacity = opacity;
        self
    }

    /// Looking like this.
    pub(crate) fn looking(self, appearance: Appearance) -> Self {
        Self { appearance, ..self }
    }

    /// Not drawn until it is shown.
    #[must_use]
    pub fn hidden(mut self) -> Self {
        self.appearance.visible = false;
        self
    }

    /// Moving with this group when the scene is exploded.
    #[must_use]
    pub fn group(self, group: GroupId) -> Self {
        Self { group: Some(group), ..self }
    }

    /// Showing this cell.
    #[must_use]
    pub fn cell(self, cell: CellRef) -> Self {
        Self { cell: Some(cell), ..self }
    }

    /// Its triangles, segments, dots or labels show these cells, one each: the faces, edges and vertices that bound the cell
    /// which the whole shows.
    #[must_use]
    pub fn element_cells(self, cells: impl IntoIterator<Item = CellRef>) -> Self {
        Self { element_cells: cells.into_iter().collect(), ..self }
    }

    /// Left whole by the clip plane of the view: axes, backgrounds.
    #[must_use]
    pub fn unclipped(self) -> Self {
        Self { clipped: false, ..self }
    }

    /// A mesh in its plain colour, without light. No effect on lines and points, which are never lit.
    #[must_use]
    pub fn unlit(mut self) -> Self {
        if let Shape::Mesh { lit, .. } = &mut self.shape {
            *lit = false;
        }
        self
    }

    /// Width of lines in pixels. No effect on other shapes.
    #[must_use]
    pub fn width(mut self, pixels: f32) -> Self {
        if let Shape::Lines { width, .. } = &mut self.shape {
            *width = pixels;
        }
        self
    }

    /// Edges that are drawn as wide as those of curves of this length: a piece of a longer curve. No effect on other shapes.
    #[must_use]
    pub(crate) fn of_curve(mut self, length: f64) -> Self {
        if let Shape::Lines { curve: Some(curve), .. } = &mut self.shape {
            *curve = length;
        }
        self
    }

    /// How long the curves are that its edges are part of; `None` when it shows no edges of cells.
    pub(crate) fn curve(&self) -> Option<f64> {
        match self.shape {
            Shape::Lines { curve, .. } => curve,
            Shape::Mesh { .. } | Shape::Points { .. } | Shape::Labels { .. } => None,
        }
    }

    /// Diameter of points in pixels. No effect on other shapes.
    #[must_use]
    pub fn size(mut self, pixels: f32) -> Self {
        if let Shape::Points { size, .. } = &mut self.shape {
            *size = pixels;
        }
        self
    }

    /// Attributes of the text of labels. No effect on other shapes.
    #[must_use]
    pub fn text_style(mut self, text_style: TextStyle) -> Self {
        if let Shape::Labels { style, .. } = &mut self.shape {
            *style = text_style;
        }
        self
    }

    /// Labels drawn over everything else. No effect on other shapes.
    #[must_use]
    pub fn on_top(mut self) -> Self {
        if let Shape::Labels { on_top, .. } = &mut self.shape {
            *on_top = true;
        }
        self
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How it looks when nothing else is asked for.
    #[must_use]
    pub fn appearance(&self) -> Appearance {
        self.appearance
    }

    /// The cell it shows.
    #[must_use]
    pub fn cell_ref(&self) -> Option<CellRef> {
        self.cell
    }

    /// The group it moves with.
    #[must_use]
    pub fn group_id(&self) -> Option<GroupId> {
        self.group
    }

    /// The cell that one of its triangles, segments, dots or labels shows: its own, or that of the whole.
    #[must_use]
    pub fn cell_of_element(&self, element: usize) -> Option<CellRef> {
        self.element_cells.get(element).copied().or(self.cell)
    }

    /// Number of its triangles, segments, dots or labels.
    #[must_use]
    pub fn n_elements(&self) -> usize {
        match &self.shape {
            Shape::Mesh { mesh, .. } => mesh.triangles.len(),
            Shape::Lines { segments, .. } => segments.len(),
            Shape::Points { points, .. } => points.len(),
            Shape::Labels { labels, .. } => labels.len(),
        }
    }

    /// The corners of one of its triangles (three), segments (two), dots or labels (one), not exploded; none beyond the last.
    #[must_use]
    pub fn corners_of_element(&self, element: usize) -> Vec<[f64; 3]> {
        match &self.shape {
            Shape::Mesh { mesh, .. } => {
                let corners = mesh.triangles.get(element).into_iter().flatten();
                corners.map(|&v| point3(&mesh.points, v as usize)).collect()
            }
            Shape::Lines { segments, .. } => segments.get(element).into_iter().flatten().copied().collect(),
            Shape::Points { points, .. } => points.get(element).into_iter().copied().collect(),
            Shape::Labels { labels, .. } => labels.get(element).into_iter().map(|l| l.at).collect(),
        }
    }

    /// The label that has this stroke, counted over all labels; `None` for other shapes.
    pub(crate) fn label_of_stroke(&self, stroke: usize) -> Option<usize> {
        let Shape::Labels { labels, style, .. } = &self.shape else { return None };
        let mut end = 0;
        labels.iter().position(|label| {
            end += text::strokes(&label.text, style).len();
            stroke < end
        })
    }

    /// The box around it, not exploded; `None` when it has no points.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds> {
        self.bounds
    }

    /// The points that it draws, not exploded, some of them repeatedly.
    pub(crate) fn points_drawn(&self) -> Box<dyn Iterator<Item = [f64; 3]> + '_> {
        self.shape.points_drawn()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lar_core::Points;

    #[test]
    fn plane_points_lie_at_height_zero() {
        let points = Points::from_columns(2, vec![0., 0., 1., 0., 0., 1.]);
        let mesh = TriangleMesh { points, triangles: vec![[0, 1, 2]] };
        let drawable = Drawable::mesh("flat", mesh);
        assert_eq!(drawable.bounds(), Some(Bounds { min: [0.; 3], max: [1., 1., 0.] }));
        assert_eq!(drawable.corners_of_element(0), [[0.; 3], [1., 0., 0.], [0., 1., 0.]]);
        assert!(drawable.corners_of_element(1).is_empty());
    }

    #[test]
    fn elements_show_their_own_cell_or_that_of_the_whole() {
        let dots = Drawable::points("dots", [[0.; 3], [1.; 3]]);
        assert_eq!(dots.cell_of_element(1), None);
        let of_cell = dots.cell(CellRef::new(3, 4));
        assert_eq!(of_cell.cell_of_element(1), Some(CellRef::new(3, 4)));
        let each = of_cell.element_cells([CellRef::new(0, 7), CellRef::new(0, 8)]);
        assert_eq!(each.cell_of_element(1), Some(CellRef::new(0, 8)));
        assert_eq!((each.cell_ref(), each.n_elements()), (Some(CellRef::new(3, 4)), 2));
    }
}
