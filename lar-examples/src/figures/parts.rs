//! What a panel is made of: triangles, lines and dots in one colour that can still be moved.

use lar_core::{Points, TriangleMesh};
use lar_viewer::{CellRef, CellShape, Coloring, Drawable, INK, Rgb};

pub(crate) type Point = [f64; 3];
pub(crate) type Segment = [Point; 2];

/// Width of the edges of cells in pixels.
const EDGE_WIDTH: f32 = 1.5;

#[derive(Clone, Debug)]
pub(crate) enum Geometry {
    Mesh(TriangleMesh),
    /// Edges of cells, drawn thinner where cells are small.
    Edges(Vec<Segment>),
    /// Lines that keep their width.
    Lines(Vec<Segment>),
    Dots(Vec<Point>),
}

/// One thing in one colour.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub name: String,
    pub cell: Option<CellRef>,
    pub geometry: Geometry,
    pub color: Rgb,
    pub opacity: f32,
    /// Width of lines and diameter of dots in pixels.
    pub width: f32,
}

impl Part {
    pub(crate) fn lines(name: &str, lines: Vec<Segment>, color: Rgb, width: f32) -> Self {
        Self::new(name, Geometry::Lines(lines), color, width)
    }

    pub(crate) fn dots(name: &str, dots: Vec<Point>, color: Rgb, width: f32) -> Self {
        Self::new(name, Geometry::Dots(dots), color, width)
    }

    fn new(name: &str, geometry: Geometry, color: Rgb, width: f32) -> Self {
        Self { name: name.to_owned(), cell: None, geometry, color, opacity: 1.0, width }
    }

    /// The triangles and edges of a cell.
    pub(crate) fn of_cell(shape: CellShape, color: Rgb, opacity: f32) -> [Self; 2] {
        let part = |geometry, color, opacity| {
            let name = shape.name.clone();
            Self { name, cell: Some(shape.cell), geometry, color, opacity, width: EDGE_WIDTH }
        };
        [part(Geometry::Mesh(shape.mesh), color, opacity), part(Geometry::Edges(shape.edges), INK, 1.0)]
    }

    /// With lines or dots of this width in pixels.
    pub(crate) fn width(self, width: f32) -> Self {
        Self { width, ..self }
    }

    /// The edges of a cell as lines that keep their width.
    pub(crate) fn outline(shape: &CellShape, color: Rgb, width: f32) -> Self {
        Self { cell: Some(shape.cell), ..Self::lines(&shape.name, shape.edges.clone(), color, width) }
    }

    /// The same with each point moved by `f`.
    pub(crate) fn mapped(self, f: impl Fn(Point) -> Point) -> Self {
        let geometry = match self.geometry {
            Geometry::Mesh(mesh) => Geometry::Mesh(mapped(&mesh, &f)),
            Geometry::Edges(lines) => Geometry::Edges(lines.into_iter().map(|l| l.map(&f)).collect()),
            Geometry::Lines(lines) => Geometry::Lines(lines.into_iter().map(|l| l.map(&f)).collect()),
            Geometry::Dots(dots) => Geometry::Dots(dots.into_iter().map(f).collect()),
        };
        Self { geometry, ..self }
    }

    /// The points that it draws, some of them repeatedly.
    pub(crate) fn points(&self) -> Box<dyn Iterator<Item = Point> + '_> {
        match &self.geometry {
            Geometry::Mesh(mesh) => {
                Box::new(mesh.triangles.as_flattened().iter().map(|&v| point(&mesh.points, v)))
            }
            Geometry::Edges(lines) | Geometry::Lines(lines) => Box::new(lines.as_flattened().iter().copied()),
            Geometry::Dots(dots) => Box::new(dots.iter().copied()),
        }
    }

    pub(crate) fn drawable(self) -> Drawable {
        let drawable = match self.geometry {
            Geometry::Mesh(mesh) => Drawable::mesh(self.name, mesh),
            Geometry::Edges(lines) => Drawable::edges(self.name, lines).width(self.width),
            Geometry::Lines(lines) => Drawable::lines(self.name, lines).width(self.width),
            Geometry::Dots(dots) => Drawable::points(self.name, dots).size(self.width),
        };
        let drawable = drawable.color(self.color).opacity(self.opacity);
        match self.cell {
            Some(cell) => drawable.cell(cell),
            None => drawable,
        }
    }
}

fn point(points: &Points, v: u32) -> Point {
    let p = points.point(v as usize);
    [p[0], p[1], p.get(2).copied().unwrap_or(0.0)]
}

fn mapped(mesh: &TriangleMesh, f: impl Fn(Point) -> Point) -> TriangleMesh {
    let points: Vec<Point> = (0..mesh.points.len() as u32).map(|v| f(point(&mesh.points, v))).collect();
    TriangleMesh { points: Points::from_xyz(&points), triangles: mesh.triangles.clone() }
}

/// Cells in cyclic colours.
pub(crate) fn cyclic(shapes: impl IntoIterator<Item = CellShape>, opacity: f32) -> Vec<Part> {
    let shapes = shapes.into_iter().enumerate();
    shapes.flat_map(|(i, shape)| Part::of_cell(shape, Coloring::Cyclic.color(i), opacity)).collect()
}

/// Cells in one colour.
pub(crate) fn plain(
    shapes: impl IntoIterator<Item = CellShape>,
    color: Rgb,
    opacity: f32,
) -> impl Iterator<Item = Part> {
    shapes.into_iter().flat_map(move |shape| Part::of_cell(shape, color, opacity))
}

/// Each cell moved rigidly, the mean of its vertices to `factors` times its distance from the middle of the box around
/// all: what the viewer does to a whole scene, done to one panel.
pub(crate) fn exploded(shapes: Vec<CellShape>, factors: [f64; 3]) -> Vec<CellShape> {
    let Some(center) = lar_viewer::Bounds::of(shapes.iter().flat_map(corners)).map(|b| b.center()) else {
        return shapes;
    };
    let place = |shape: CellShape| {
        let mean = mean(corners(&shape).collect());
        let shift = [0, 1, 2].map(|k| (factors[k] - 1.0) * (mean[k] - center[k]));
        moved(shape, |p| [0, 1, 2].map(|k| p[k] + shift[k]))
    };
    shapes.into_iter().map(place).collect()
}

/// The shape with each point moved by `f`.
pub(crate) fn moved(shape: CellShape, f: impl Fn(Point) -> Point) -> CellShape {
    let mesh = mapped(&shape.mesh, &f);
    CellShape { mesh, edges: shape.edges.into_iter().map(|l| l.map(&f)).collect(), ..shape }
}

fn corners(shape: &CellShape) -> impl Iterator<Item = Point> + '_ {
    let of_mesh = shape.mesh.triangles.as_flattened().iter().map(|&v| point(&shape.mesh.points, v));
    of_mesh.chain(shape.edges.as_flattened().iter().copied())
}

/// Mean of the distinct points.
fn mean(mut points: Vec<Point>) -> Point {
    points.sort_unstable_by(|a, b| {
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
    });
    points.dedup();
    let n = points.len().max(1) as f64;
    points.iter().fold([0.0; 3], |sum, p| [0, 1, 2].map(|k| sum[k] + p[k] / n))
}
