//! Scenes: named drawables with colour, opacity and an explode group.
//!
//! A scene is draw data only. It knows neither models nor chain complexes; a drawable may carry the dimension and
//! index of the cell that it shows, for whoever asks what is under the cursor. Everything is validated when it is
//! pushed, with the drawable's name in the error, so that drawing cannot meet NaN or a dangling index.
//!
//! *Explosion*: a group is a centroid, and all drawables of a group move rigidly together by
//! (s − 1) × (centroid − centre), per axis. Ungrouped drawables (axes, backgrounds) stay where they are. The centre
//! is the middle of the box around all grouped drawables.

use crate::{Bounds, Rgb, ViewerError};
use lar_core::{Points, TriangleMesh};

/// Largest magnitude of a coordinate: squares and sums of these stay finite in f64.
pub(crate) const COORDINATE_LIMIT: f64 = 1e100;

/// Largest line width and point size, in pixels.
const SIZE_LIMIT: f64 = 1000.0;

/// Names a group of one scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct GroupId(pub(crate) u32);

/// The cell that a drawable shows: its dimension and its index among the cells of that dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct CellRef {
    /// 0 vertex, 1 edge, 2 face, 3 solid cell.
    pub dim: u8,
    /// Index among the cells of this dimension.
    pub index: u32,
}

/// The geometry of a drawable.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    Mesh { mesh: TriangleMesh, lit: bool },
    Lines { segments: Vec<[[f64; 3]; 2]>, width: f32, cell_edges: bool },
    Points { points: Vec<[f64; 3]>, size: f32 },
}

/// One named thing to draw: triangles, segments or points in one colour.
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
    pub(crate) color: Rgb,
    pub(crate) opacity: f32,
    pub(crate) group: Option<GroupId>,
    pub(crate) cell: Option<CellRef>,
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
        Self::new(name, Shape::Lines { segments, width: 1.8, cell_edges: false }, crate::INK)
    }

    /// Segments that are the edges of cells: drawn as `lines`, hidden when the view shows no edges, and thinner where
    /// the cell is so small on the screen that its edges would cover it.
    #[must_use]
    pub fn edges(name: impl Into<String>, segments: impl IntoIterator<Item = [[f64; 3]; 2]>) -> Self {
        let segments = segments.into_iter().collect();
        Self::new(name, Shape::Lines { segments, width: 1.8, cell_edges: true }, crate::INK)
    }

    /// Round dots of constant size on the screen.
    #[doc(alias = "GLPoints")]
    #[must_use]
    pub fn points(name: impl Into<String>, points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        Self::new(name, Shape::Points { points: points.into_iter().collect(), size: 6.0 }, crate::INK)
    }

    fn new(name: impl Into<String>, shape: Shape, color: Rgb) -> Self {
        Self { name: name.into(), shape, color, opacity: 1.0, group: None, cell: None }
    }

    /// With this colour.
    #[must_use]
    pub fn color(self, color: Rgb) -> Self {
        Self { color, ..self }
    }

    /// With this opacity, 0 invisible to 1 opaque.
    #[must_use]
    pub fn opacity(self, opacity: f32) -> Self {
        Self { opacity, ..self }
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

    /// Diameter of points in pixels. No effect on other shapes.
    #[must_use]
    pub fn size(mut self, pixels: f32) -> Self {
        if let Shape::Points { size, .. } = &mut self.shape {
            *size = pixels;
        }
        self
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The cell it shows.
    #[must_use]
    pub fn cell_ref(&self) -> Option<CellRef> {
        self.cell
    }

    /// The box around it, not exploded; `None` when it has no points.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of(self.points_drawn())
    }

    /// The points that it draws, not exploded, some of them repeatedly.
    fn points_drawn(&self) -> Box<dyn Iterator<Item = [f64; 3]> + '_> {
        match &self.shape {
            Shape::Mesh { mesh, .. } => {
                let corners = mesh.triangles.as_flattened().iter();
                Box::new(corners.map(|&v| point3(&mesh.points, v as usize)))
            }
            Shape::Lines { segments, .. } => Box::new(segments.as_flattened().iter().copied()),
            Shape::Points { points, .. } => Box::new(points.iter().copied()),
        }
    }

    pub(crate) fn validate(&self) -> Result<(), ViewerError> {
        for channel in self.color {
            self.attribute("a colour channel", channel, 1.0)?;
        }
        self.attribute("the opacity", self.opacity, 1.0)?;
        match &self.shape {
            Shape::Mesh { mesh, .. } => self.validate_mesh(mesh),
            Shape::Lines { segments, width, .. } => {
                self.attribute("the line width", *width, SIZE_LIMIT)?;
                let mut ends = segments.iter().enumerate().flat_map(|(i, s)| s.map(|p| (i, p)));
                ends.try_for_each(|(i, p)| finite(&self.name, "segment", i, &p))
            }
            Shape::Points { points, size } => {
                self.attribute("the point size", *size, SIZE_LIMIT)?;
                points.iter().enumerate().try_for_each(|(i, p)| finite(&self.name, "point", i, p))
            }
        }
    }

    fn validate_mesh(&self, mesh: &TriangleMesh) -> Result<(), ViewerError> {
        let (dim, n_points) = (mesh.points.dim(), mesh.points.len());
        if !(2..=3).contains(&dim) {
            return Err(ViewerError::Dimension { drawable: self.name.clone(), dim });
        }
        mesh.points.iter().enumerate().try_for_each(|(i, p)| finite(&self.name, "point", i, p))?;
        let vertices = mesh.triangles.iter().enumerate().flat_map(|(t, v)| v.map(|v| (t, v)));
        match vertices.into_iter().find(|&(_, v)| v as usize >= n_points) {
            Some((triangle, point)) => {
                Err(ViewerError::PointOutOfRange { drawable: self.name.clone(), triangle, point, n_points })
            }
            None => Ok(()),
        }
    }

    fn attribute(&self, attribute: &'static str, value: f32, high: f64) -> Result<(), ViewerError> {
        let (value, low) = (f64::from(value), 0.0);
        if low <= value && value <= high {
            Ok(())
        } else {
            Err(ViewerError::Attribute { drawable: self.name.clone(), attribute, value, low, high })
        }
    }
}

/// Named drawables and the groups in which they explode.
///
/// ```
/// use lar_core::{Points, TriangleMesh};
/// use lar_viewer::{Drawable, Scene};
/// let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]);
/// let mut scene = Scene::new();
/// let group = scene.push_group([0.3, 0.3, 0.0])?;
/// scene.push(Drawable::mesh("triangle", TriangleMesh { points, triangles: vec![[0, 1, 2]] }).group(group))?;
/// assert_eq!(scene.bounds([1.0; 3]).unwrap().max, [1.0, 1.0, 0.0]);
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    drawables: Vec<Drawable>,
    groups: Vec<[f64; 3]>,
}

impl Scene {
    /// A scene without drawables.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a group of drawables that explode together about this centroid.
    ///
    /// # Errors
    /// `Coordinate` when the centroid is not finite.
    ///
    /// # Panics
    /// When the scene has 2^32 groups.
    pub fn push_group(&mut self, centroid: [f64; 3]) -> Result<GroupId, ViewerError> {
        finite("group", "centroid", self.groups.len(), &centroid)?;
        let id = GroupId(u32::try_from(self.groups.len()).expect("memory ends before 2^32 groups"));
        self.groups.push(centroid);
        Ok(id)
    }

    /// Adds a drawable.
    ///
    /// # Errors
    /// `Coordinate`, `Attribute`, `PointOutOfRange`, `Dimension` or `GroupOutOfRange`, each with the drawable's name;
    /// the scene is then unchanged.
    pub fn push(&mut self, drawable: Drawable) -> Result<(), ViewerError> {
        drawable.validate()?;
        let n_groups = self.groups.len();
        if let Some(GroupId(group)) = drawable.group
            && group as usize >= n_groups
        {
            return Err(ViewerError::GroupOutOfRange { drawable: drawable.name, group, n_groups });
        }
        self.drawables.push(drawable);
        Ok(())
    }

    /// The drawables in the order in which they were pushed.
    #[must_use]
    pub fn drawables(&self) -> &[Drawable] {
        &self.drawables
    }

    /// Centroids of the groups.
    #[must_use]
    pub fn groups(&self) -> &[[f64; 3]] {
        &self.groups
    }

    /// The fixed point of the explosion: the middle of the box around all grouped drawables, or around everything
    /// when nothing is grouped; the origin in an empty scene.
    #[must_use]
    pub fn center(&self) -> [f64; 3] {
        Extents::new(self).center
    }

    /// The box around the scene exploded by these factors, 1 meaning in place; `None` when nothing is to be drawn.
    /// Takes time linear in the size of the scene.
    #[must_use]
    pub fn bounds(&self, explode: [f32; 3]) -> Option<Bounds> {
        Extents::new(self).bounds(explode)
    }

    /// The points of all drawables, exploded by these factors.
    pub(crate) fn points(&self, explode: [f32; 3]) -> impl Iterator<Item = [f64; 3]> + '_ {
        let center = self.center();
        self.drawables.iter().flat_map(move |d| {
            let offset = d.group.map_or([0.0; 3], |g| difference(self.groups[g.0 as usize], center));
            let shift = shift(offset, explode);
            d.points_drawn().map(move |p| std::array::from_fn(|k| p[k] + shift[k]))
        })
    }
}

/// The boxes of a scene's drawables, for bounds of the exploded scene without reading its points again.
#[derive(Clone, Debug)]
pub(crate) struct Extents {
    pub(crate) center: [f64; 3],
    /// Box of a drawable, and centroid of its group relative to the centre.
    boxes: Vec<(Bounds, [f64; 3])>,
}

impl Extents {
    pub(crate) fn new(scene: &Scene) -> Self {
        let placed = |d: &Drawable| Some((d.bounds()?, d.group.map(|g| scene.groups[g.0 as usize])));
        let boxes: Vec<_> = scene.drawables.iter().filter_map(placed).collect();
        let around = |grouped: bool| {
            let chosen = boxes.iter().filter(|(_, g)| g.is_some() || !grouped);
            chosen.map(|(b, _)| *b).reduce(Bounds::union)
        };
        let center = around(true).or_else(|| around(false)).map_or([0.0; 3], |b| b.center());
        let offset = |centroid| difference(centroid, center);
        let boxes = boxes.iter().map(|&(b, group)| (b, group.map_or([0.0; 3], offset))).collect();
        Self { center, boxes }
    }

    /// The box around the scene exploded by these factors.
    pub(crate) fn bounds(&self, explode: [f32; 3]) -> Option<Bounds> {
        self.boxes.iter().map(|(b, offset)| b.moved(shift(*offset, explode))).reduce(Bounds::union)
    }
}

/// How far a group moves whose centroid lies at this offset from the centre.
fn shift(offset: [f64; 3], explode: [f32; 3]) -> [f64; 3] {
    std::array::from_fn(|k| (f64::from(explode[k]) - 1.0) * offset[k])
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// Point `i` of a set of two or three coordinates, in z = 0 when of two.
pub(crate) fn point3(points: &Points, i: usize) -> [f64; 3] {
    let p = points.point(i);
    [p[0], p[1], p.get(2).copied().unwrap_or(0.0)]
}

fn finite(drawable: &str, item: &'static str, index: usize, point: &[f64]) -> Result<(), ViewerError> {
    match point.iter().zip(['x', 'y', 'z']).find(|(x, _)| x.is_nan() || COORDINATE_LIMIT < x.abs()) {
        None => Ok(()),
        Some((&value, axis)) => Err(ViewerError::Coordinate {
            drawable: drawable.to_owned(),
            item,
            index,
            axis,
            value,
            limit: COORDINATE_LIMIT,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> TriangleMesh {
        let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
        TriangleMesh { points, triangles: vec![[0, 1, 2], [0, 2, 3]] }
    }

    #[track_caller]
    fn check_refused(drawable: Drawable, expected: &str) {
        let mut scene = Scene::new();
        assert_eq!(scene.push(drawable).unwrap_err().to_string(), expected);
        assert!(scene.drawables().is_empty());
    }

    #[test]
    fn errors_name_the_drawable_and_the_values() {
        let mut nan = square();
        nan.points.coords_mut()[4] = f64::NAN;
        check_refused(
            Drawable::mesh("roof", nan),
            "drawable \"roof\": coordinate y of point 1 is NaN; it must lie within ±1e100",
        );
        check_refused(
            Drawable::mesh("roof", TriangleMesh { triangles: vec![[0, 1, 2], [0, 4, 1]], ..square() }),
            "drawable \"roof\": triangle 1 names point 4, but there are 4 points",
        );
        check_refused(
            Drawable::mesh("solid", TriangleMesh { points: Points::new(4), triangles: vec![] }),
            "drawable \"solid\": points of 4 coordinates; 2 or 3 can be drawn",
        );
        check_refused(
            Drawable::lines("axis", [[[0.; 3]; 2], [[0.; 3], [0., 0., f64::INFINITY]]]),
            "drawable \"axis\": coordinate z of segment 1 is inf; it must lie within ±1e100",
        );
        check_refused(
            Drawable::points("dots", [[-1e200, 0., 0.]]),
            &format!("drawable \"dots\": coordinate x of point 0 is {}; it must lie within ±1e100", -1e200),
        );
        check_refused(
            Drawable::mesh("m", square()).opacity(f32::NAN),
            "drawable \"m\": the opacity is NaN; it must lie between 0 and 1",
        );
        check_refused(
            Drawable::mesh("m", square()).color([0.0, 1.5, 0.0]),
            "drawable \"m\": a colour channel is 1.5; it must lie between 0 and 1",
        );
        check_refused(
            Drawable::lines("l", []).width(-1.0),
            "drawable \"l\": the line width is -1; it must lie between 0 and 1000",
        );
        check_refused(
            Drawable::points("p", []).size(2000.0),
            "drawable \"p\": the point size is 2000; it must lie between 0 and 1000",
        );
        check_refused(
            Drawable::mesh("m", square()).group(GroupId(2)),
            "drawable \"m\": group 2 does not exist; the scene has 0 groups",
        );
        let centroid = Scene::new().push_group([0.0, f64::NAN, 0.0]).unwrap_err().to_string();
        assert_eq!(
            centroid,
            "drawable \"group\": coordinate y of centroid 0 is NaN; it must lie within ±1e100"
        );
    }

    #[track_caller]
    fn check_bounds(scene: &Scene, explode: [f32; 3], min: [f64; 3], max: [f64; 3]) {
        assert_eq!(scene.bounds(explode), Some(Bounds { min, max }));
    }

    #[test]
    fn groups_move_from_the_centre_of_the_grouped_and_the_rest_stays() {
        let mut scene = Scene::new();
        for x in [-2.0, 2.0] {
            let group = scene.push_group([x, 0.0, 0.0]).unwrap();
            scene
                .push(Drawable::lines("end", [[[x - 1.0, 0., 0.], [x + 1.0, 0., 0.]]]).group(group))
                .unwrap();
        }
        check_bounds(&scene, [1.0; 3], [-3., 0., 0.], [3., 0., 0.]);
        check_bounds(&scene, [2.0, 5.0, 1.0], [-5., 0., 0.], [5., 0., 0.]);
        scene.push(Drawable::points("fixed", [[0., 0., 9.]])).unwrap();
        assert_eq!(scene.center(), [0.0; 3], "what is not grouped has no say");
        check_bounds(&scene, [2.0; 3], [-5., 0., 0.], [5., 0., 9.]);
    }

    #[test]
    fn an_empty_scene_has_no_bounds() {
        assert_eq!(Scene::new().bounds([1.0; 3]), None);
        assert_eq!(Scene::new().center(), [0.0; 3]);
    }

    #[test]
    fn plane_points_lie_at_height_zero() {
        let points = Points::from_columns(2, vec![0., 0., 1., 0., 0., 1.]);
        let mesh = TriangleMesh { points, triangles: vec![[0, 1, 2]] };
        let drawable = Drawable::mesh("flat", mesh);
        assert_eq!(drawable.bounds(), Some(Bounds { min: [0.; 3], max: [1., 1., 0.] }));
    }
}
