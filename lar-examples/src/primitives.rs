//! Primitives of the viewer that need a triangulation or a convex hull: polygons with holes, polyhedra, hulls, grids.

use crate::mesh;
use lar_core::{Cells, Model, Points, Surface};
use lar_triangle::{TriangulateError, convex_hull};
use lar_viewer::{CellRef, CellShape, CellStyle, Drawable, Scene, push_cells, surface_shape};

/// A polygon with holes as a face: the outer loop first, each loop a list of corners in either order.
///
/// ```
/// let square = |a: f64, b: f64| vec![[a, a, 0.], [b, a, 0.], [b, b, 0.], [a, b, 0.]];
/// let ring = lar_examples::primitives::polygon_shape(0, &[square(0., 3.), square(1., 2.)])?;
/// assert_eq!((ring.mesh.area(), ring.edges.len()), (8.0, 8));
/// # Ok::<(), lar_triangle::TriangulateError>(())
/// ```
///
/// # Errors
/// When a loop has fewer than three corners.
#[doc(alias("GLPolygon", "GLPolygons"))]
pub fn polygon_shape(index: u32, loops: &[Vec<[f64; 3]>]) -> Result<CellShape, TriangulateError> {
    let mut surface = Surface::new(format!("polygon {index}"), Points::from_xyz(&loops.concat()));
    let outward = loops.first().map_or([0.0; 3], |outer| vector_area(outer));
    let (mut numbered, mut first) = (Vec::new(), 0);
    for corners in loops {
        let next = first + corners.len() as u32;
        let mut cycle: Vec<u32> = (first..next).collect();
        let with_outer = (0..3).map(|k| vector_area(corners)[k] * outward[k]).sum::<f64>();
        // Holes run the other way round.
        if 0 < first && 0.0 < with_outer {
            cycle.reverse();
        }
        numbered.push(cycle);
        first = next;
    }
    surface.push_face(numbered.iter().map(Vec::as_slice), 1);
    Ok(surface_shape(&surface, mesh::of_surface(&surface)?, CellRef::new(2, index)))
}

/// The area of a loop along its normal (Newell's sum).
fn vector_area(corners: &[[f64; 3]]) -> [f64; 3] {
    let next = corners.iter().skip(1).chain(corners.first());
    corners.iter().zip(next).fold([0.0; 3], |sum, (a, b)| {
        let cross = |i: usize, j: usize| 0.5 * (a[i] * b[j] - a[j] * b[i]);
        [sum[0] + cross(1, 2), sum[1] + cross(2, 0), sum[2] + cross(0, 1)]
    })
}

/// A polyhedron, or any polygonal surface, as a cell.
///
/// # Errors
/// When a face cannot be triangulated.
#[doc(alias("GLPolyhedron", "GLPolyhedrons", "GLLar2gl"))]
pub fn polyhedron_shape(index: u32, surface: &Surface) -> Result<CellShape, TriangulateError> {
    crate::shapes::surface(surface, index)
}

/// The convex hull of points as a cell of the dimension that they span; a single point has neither triangles nor edges.
///
/// ```
/// use lar_core::Points;
/// let corners = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0.1, 0.1, 0.1]]);
/// let hull = lar_examples::primitives::hull_shape(0, &corners)?;
/// assert_eq!((hull.cell.dim, hull.mesh.triangles.len(), hull.edges.len()), (3, 4, 6));
/// # Ok::<(), lar_triangle::TriangulateError>(())
/// ```
///
/// # Errors
/// When the points have other than two or three coordinates, or one is not finite.
#[doc(alias("GLHull", "GLHull2d", "GLHulls", "GLPol"))]
pub fn hull_shape(index: u32, points: &Points) -> Result<CellShape, TriangulateError> {
    let hull = convex_hull(points)?;
    let corner = |v: u32| {
        let p = points.point(v as usize);
        [p[0], p[1], p.get(2).copied().unwrap_or(0.0)]
    };
    Ok(CellShape {
        name: format!("hull {index}"),
        cell: CellRef::new(hull.dim.unwrap_or(0) as u8, index),
        mesh: hull.mesh(points),
        edges: hull.edges.iter().map(|e| e.map(corner)).collect(),
    })
}

/// Adds cells of any number of vertices, each as the convex hull of its vertices: points, segments, polygons, polyhedra.
/// Each is a group of its own.
///
/// # Errors
/// When a cell names a point that does not exist, or a coordinate is not finite.
#[doc(alias = "GLGrid")]
pub fn push_grid(
    scene: &mut Scene,
    points: &Points,
    cells: &Cells,
    style: &CellStyle,
) -> Result<(), crate::CommandError> {
    for (i, cell) in cells.iter().enumerate() {
        let mut corners = Points::new(points.dim());
        for &v in cell {
            let vertex = lar_core::VertexId(v);
            let refused = TriangulateError::NoSuchVertex { vertex, points: points.len() };
            let known = (v as usize) < points.len();
            known.then(|| corners.push(points.point(v as usize))).ok_or(refused)?;
        }
        let shape = hull_shape(i as u32, &corners)?;
        let dots = if shape.cell.dim == 0 { shape.mesh.points.clone() } else { Points::new(points.dim()) };
        let colored = CellStyle { coloring: lar_viewer::Coloring::Fixed(style.coloring.color(i)), ..*style };
        let (name, cell) = (shape.name.clone(), shape.cell);
        let group = push_cells(scene, [shape], &colored)?;
        let at = |p: &[f64]| [p[0], p[1], p.get(2).copied().unwrap_or(0.0)];
        let dots = Drawable::points(name, dots.iter().take(1).map(at)).color(style.coloring.color(i));
        scene.push(dots.cell(cell).group(group[0]))?;
    }
    Ok(())
}

/// Adds the cells of a model, those of its own dimension, as [`push_grid`] does: its cells are convex.
///
/// # Errors
/// As [`push_grid`].
#[doc(alias("GLLar2gl", "GLPol"))]
pub fn push_model(scene: &mut Scene, model: &Model, style: &CellStyle) -> Result<(), crate::CommandError> {
    push_grid(scene, model.points(), model.cells(model.dim()), style)
}
