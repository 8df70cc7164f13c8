//! What a scene refuses: everything is checked when it is pushed, so that drawing cannot meet NaN or a dangling index.

use super::appearance::attribute;
use super::drawable::{Drawable, Shape};
use crate::{TextStyle, ViewerError};
use lar_core::TriangleMesh;

/// Largest magnitude of a coordinate: squares and sums of these stay finite in f64.
pub(crate) const COORDINATE_LIMIT: f64 = 1e100;

/// Largest line width and point size, in pixels.
const SIZE_LIMIT: f64 = 1000.0;

/// Largest height of capitals in pixels, and largest factor of their spacing.
const TEXT_LIMIT: f64 = 200.0;

impl Drawable {
    pub(crate) fn validate(&self) -> Result<(), ViewerError> {
        self.appearance.validate(&self.name)?;
        let (n_cells, n_elements) = (self.element_cells.len(), self.n_elements());
        if 0 < n_cells && n_cells != n_elements {
            return Err(ViewerError::ElementCells { drawable: self.name.clone(), n_cells, n_elements });
        }
        match &self.shape {
            Shape::Mesh { mesh, .. } => self.validate_mesh(mesh),
            Shape::Lines { segments, width, .. } => {
                attribute(&self.name, "the line width", *width, SIZE_LIMIT)?;
                let mut ends = segments.iter().enumerate().flat_map(|(i, s)| s.map(|p| (i, p)));
                ends.try_for_each(|(i, p)| finite(&self.name, "segment", i, &p))
            }
            Shape::Points { points, size } => {
                attribute(&self.name, "the point size", *size, SIZE_LIMIT)?;
                points.iter().enumerate().try_for_each(|(i, p)| finite(&self.name, "point", i, p))
            }
            Shape::Labels { labels, style, .. } => {
                self.validate_text(style)?;
                labels.iter().enumerate().try_for_each(|(i, l)| finite(&self.name, "label", i, &l.at))
            }
        }
    }

    fn validate_text(&self, style: &TextStyle) -> Result<(), ViewerError> {
        attribute(&self.name, "the size of the text", style.size as f32, TEXT_LIMIT)?;
        attribute(&self.name, "the spacing of the text", style.spacing as f32, TEXT_LIMIT)?;
        let turn = style.angle.abs() as f32;
        attribute(&self.name, "the magnitude of the angle of the text", turn, f64::from(f32::MAX))
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
}

pub(crate) fn finite(
    drawable: &str,
    item: &'static str,
    index: usize,
    point: &[f64],
) -> Result<(), ViewerError> {
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
    use crate::{GroupId, Scene};
    use lar_core::Points;

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
        check_refused(
            Drawable::labels("t", []).text_style(TextStyle { size: -1.0, ..TextStyle::default() }),
            "drawable \"t\": the size of the text is -1; it must lie between 0 and 200",
        );
        check_refused(
            Drawable::labels("t", [crate::Label::new("?", [0., 0., f64::NAN])]),
            "drawable \"t\": coordinate z of label 0 is NaN; it must lie within ±1e100",
        );
        check_refused(
            Drawable::points("p", [[0.; 3]; 2]).element_cells([crate::CellRef::new(0, 1)]),
            "drawable \"p\": 1 cells are given for 2 elements",
        );
        let centroid = Scene::new().push_group([0.0, f64::NAN, 0.0]).unwrap_err().to_string();
        assert_eq!(
            centroid,
            "drawable \"group\": coordinate y of centroid 0 is NaN; it must lie within ±1e100"
        );
    }
}
