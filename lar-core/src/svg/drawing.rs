//! Drawings: polylines in the plane.

use crate::files::Corners;
use crate::{Cells, Model, Points};
use std::ops::Range;

/// A run of straight pieces, from one subpath of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// The `id` of its element, or of the nearest element around it that has one.
    pub id: Option<String>,
    /// Which shape of the drawing it belongs to, from 0 in document order: the subpaths of a shape share it.
    pub shape: usize,
    /// True when the shape's `fill-rule` is `evenodd`; SVG's own default is `nonzero`.
    pub even_odd: bool,
    /// 2 × n; the first point is not repeated at the end of a closed one.
    pub points: Points,
    /// True when the last point is joined to the first: a polygon.
    pub closed: bool,
}

/// The polylines of a drawing in document order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Open ones and closed ones.
    pub polylines: Vec<Polyline>,
    /// The elements that have an `id` and hold a shape, in document order, groups before what is in them. What `use`
    /// draws again stands here again.
    pub named: Vec<NamedShapes>,
}

/// The shapes of an element with an `id`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedShapes {
    /// The `id`.
    pub id: String,
    /// Numbers of its shapes: a group's are those of all elements in it.
    pub shapes: Range<usize>,
}

impl Drawing {
    /// The segments as a model of 0- and 1-cells in the plane, input of a planar arrangement. Equal points are
    /// one vertex; segments without length are left out. Expected O(n).
    ///
    /// # Panics
    /// When a polyline has points of other than two coordinates.
    ///
    /// ```
    /// use lar_core::{Drawing, Points, Polyline};
    /// let points = Points::from_columns(2, vec![0., 0., 1., 0., 1., 1.]);
    /// let triangle = Polyline { id: None, shape: 0, even_odd: false, points, closed: true };
    /// let model = Drawing { polylines: vec![triangle], named: Vec::new() }.to_model();
    /// assert_eq!(model.f_vector(), [3, 3]);
    /// ```
    #[doc(alias = "svg2lar")]
    #[must_use]
    pub fn to_model(&self) -> Model {
        let mut corners = Corners::<f64, 2>::new();
        // Minus zero is where zero is.
        let points = self.polylines.iter().flat_map(|polyline| polyline.points.iter());
        points.for_each(|p| corners.push([p[0] + 0., p[1] + 0.]));
        let (points, vertices) = corners.weld();
        let mut edges = Vec::new();
        let mut rest = &vertices[..];
        for polyline in &self.polylines {
            let (vertices, others) = rest.split_at(polyline.points.len());
            rest = others;
            let closing = if polyline.closed { vertices.first() } else { None };
            let ends = vertices.iter().skip(1).chain(closing);
            edges.extend(vertices.iter().zip(ends).filter(|(a, b)| a != b).flat_map(|(&a, &b)| [a, b]));
        }
        let cells = vec![Cells::singletons(points.len()), Cells::uniform(2, edges)];
        Model::new(points, cells)
    }

    /// The loops of the closed polylines, as [`locate_in_polygon`](crate::locate_in_polygon) takes them.
    #[must_use]
    pub fn loops(&self) -> Vec<Vec<[f64; 2]>> {
        let corners = |polyline: &Polyline| polyline.points.iter().map(|p| [p[0], p[1]]).collect();
        self.polylines.iter().filter(|polyline| polyline.closed).map(corners).collect()
    }
}
