//! From cells to drawables: exploded families of cells, and the axis frame.

use crate::{CellRef, Coloring, Drawable, GroupId, INK, Rgb, Scene, ViewerError, push_arrow, scene::point3};
use lar_core::TriangleMesh;

/// What is seen of one cell: the triangles of its boundary and its real edges, never those of the triangulation.
#[derive(Clone, Debug, PartialEq)]
pub struct CellShape {
    /// Name of its drawables, for messages.
    pub name: String,
    /// The cell itself.
    pub cell: CellRef,
    /// Triangles; none for a cell shown by its edges only.
    pub mesh: TriangleMesh,
    /// Pairs of end points.
    pub edges: Vec<[[f64; 3]; 2]>,
}

/// How a family of cells is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellStyle {
    /// Colours of the triangles.
    pub coloring: Coloring,
    /// Opacity of the triangles.
    pub opacity: f32,
    /// Colour of the edges.
    pub edge_color: Rgb,
    /// Width of the edges in pixels; 0 draws none.
    pub edge_width: f32,
}

impl Default for CellStyle {
    /// Opaque cells in cyclic colours with dark edges.
    fn default() -> Self {
        Self { coloring: Coloring::Cyclic, opacity: 1.0, edge_color: INK, edge_width: 1.8 }
    }
}

/// Adds a family of cells to a scene, each a group of its own: triangles and edges of a cell move rigidly together
/// when the scene is exploded, by the mean of the cell's vertices. Cell i gets colour i of the style's colouring.
/// Returns the groups, one a cell.
///
/// ```
/// use lar_core::{Points, TriangleMesh};
/// use lar_viewer::{CellRef, CellShape, CellStyle, Scene, push_cells};
/// let corner = [[0., 0., 0.], [3., 0., 0.], [0., 3., 0.]];
/// let face = CellShape {
///     name: "face".into(),
///     cell: CellRef { dim: 2, index: 0 },
///     mesh: TriangleMesh { points: Points::from_xyz(&corner), triangles: vec![[0, 1, 2]] },
///     edges: vec![[corner[0], corner[1]], [corner[1], corner[2]], [corner[2], corner[0]]],
/// };
/// let mut scene = Scene::new();
/// push_cells(&mut scene, [face], &CellStyle::default())?;
/// assert_eq!(scene.groups()[0].centroid, [1.0, 1.0, 0.0]);
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
///
/// # Errors
/// Those of [`Scene::push`], for the first cell that has one; the cells before it stay in the scene.
#[doc(alias = "GLExplode")]
pub fn push_cells(
    scene: &mut Scene,
    cells: impl IntoIterator<Item = CellShape>,
    style: &CellStyle,
) -> Result<Vec<GroupId>, ViewerError> {
    let cells = cells.into_iter().enumerate();
    cells.map(|(i, cell)| push_cell(scene, cell, style.coloring.color(i), style)).collect()
}

fn push_cell(
    scene: &mut Scene,
    cell: CellShape,
    color: Rgb,
    style: &CellStyle,
) -> Result<GroupId, ViewerError> {
    let centroid = vertex_mean(&cell);
    let mesh =
        Drawable::mesh(cell.name.as_str(), cell.mesh).color(color).opacity(style.opacity).cell(cell.cell);
    let edges = Drawable::edges(cell.name, cell.edges)
        .color(style.edge_color)
        .width(style.edge_width)
        .cell(cell.cell);
    mesh.validate()?;
    edges.validate()?;
    let group = scene.push_group(centroid)?;
    scene.push(mesh.group(group))?;
    if 0.0 < style.edge_width {
        scene.push(edges.group(group))?;
    }
    Ok(group)
}

/// Mean of the distinct end points of the edges or, without edges, of the distinct corners of the triangles.
fn vertex_mean(cell: &CellShape) -> [f64; 3] {
    let mut vertices: Vec<[f64; 3]> = cell.edges.as_flattened().to_vec();
    if vertices.is_empty() && (2..=3).contains(&cell.mesh.points.dim()) {
        let corners = cell.mesh.triangles.as_flattened().iter().map(|&v| v as usize);
        let known = corners.filter(|&v| v < cell.mesh.points.len());
        vertices = known.map(|v| point3(&cell.mesh.points, v)).collect();
    }
    vertices.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2])));
    vertices.dedup();
    let n = vertices.len().max(1) as f64;
    vertices.iter().fold([0.0; 3], |sum, v| std::array::from_fn(|k| sum[k] + v[k] / n))
}

/// Colours of the axes x, y, z: red, green, blue.
const AXIS_COLORS: [Rgb; 3] = [[0.90, 0.25, 0.22], [0.25, 0.68, 0.30], [0.22, 0.42, 0.92]];
/// Adds the axes of the coordinate frame, arrows of this length at the origin: x red, y green, z blue. They do not
/// move when the scene is exploded.
///
/// ```
/// let mut scene = lar_viewer::Scene::new();
/// lar_viewer::push_axes(&mut scene, 1.5)?;
/// assert_eq!(scene.drawables().len(), 6);
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
///
/// # Errors
/// `Coordinate` when the length is not finite.
#[doc(alias = "GLFrame")]
pub fn push_axes(scene: &mut Scene, length: f64) -> Result<(), ViewerError> {
    (0..3).try_for_each(|k| push_axis(scene, k, length))
}

/// Adds the axes x and y of the plane, as [`push_axes`] does.
///
/// ```
/// let mut scene = lar_viewer::Scene::new();
/// lar_viewer::push_plane_axes(&mut scene, 1.5)?;
/// assert_eq!(scene.drawables().len(), 4);
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
///
/// # Errors
/// `Coordinate` when the length is not finite.
#[doc(alias = "GLFrame2")]
pub fn push_plane_axes(scene: &mut Scene, length: f64) -> Result<(), ViewerError> {
    (0..2).try_for_each(|k| push_axis(scene, k, length))
}

fn push_axis(scene: &mut Scene, k: usize, length: f64) -> Result<(), ViewerError> {
    let tip = std::array::from_fn(|i| if i == k { length } else { 0.0 });
    push_arrow(scene, ["x axis", "y axis", "z axis"][k], [0.0; 3], tip, AXIS_COLORS[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use lar_core::Points;

    fn segment_cell(edges: &[[[f64; 3]; 2]]) -> CellShape {
        CellShape {
            name: "cell".into(),
            cell: CellRef { dim: 2, index: 7 },
            mesh: TriangleMesh { points: Points::new(3), triangles: vec![] },
            edges: edges.to_vec(),
        }
    }

    #[test]
    fn centroids_count_each_vertex_once() {
        let [a, b, c] = [[0.; 3], [3., 0., 0.], [0., 3., 6.]];
        assert_eq!(vertex_mean(&segment_cell(&[[a, b], [b, c], [c, a], [a, c]])), [1., 1., 2.]);
        let points = Points::from_xyz(&[a, b, c, b, [99.; 3]]);
        let mesh = TriangleMesh { points, triangles: vec![[0, 1, 2], [0, 3, 2]] };
        assert_eq!(vertex_mean(&CellShape { mesh, ..segment_cell(&[]) }), [1., 1., 2.]);
        assert_eq!(vertex_mean(&segment_cell(&[])), [0.; 3]);
    }

    #[test]
    fn a_refused_cell_is_named_and_adds_nothing() {
        let mut scene = Scene::new();
        let points = Points::from_xyz(&[[0.; 3]]);
        let bad = TriangleMesh { points, triangles: vec![[0, 0, 1]] };
        let cell = CellShape { mesh: bad, ..segment_cell(&[]) };
        let error = push_cells(&mut scene, [cell], &CellStyle::default()).unwrap_err().to_string();
        assert_eq!(error, "drawable \"cell\": triangle 0 names point 1, but there are 1 points");
        assert_eq!(scene, Scene::new());
    }

    #[test]
    fn each_cell_gets_its_group_color_and_edges() {
        let mut scene = Scene::new();
        let cell = segment_cell(&[[[0.; 3], [1.; 3]]]);
        let style = CellStyle { opacity: 0.5, ..CellStyle::default() };
        let groups = push_cells(&mut scene, [cell.clone(), cell], &style).unwrap();
        assert_eq!(groups, [GroupId(0), GroupId(1)]);
        let colors: Vec<_> =
            scene.drawables().iter().map(|d| (d.appearance.color, d.appearance.opacity)).collect();
        let [first, second] = [0, 1].map(|i| (Coloring::Cyclic.color(i), 0.5));
        assert_eq!(colors, [first, (INK, 1.0), second, (INK, 1.0)]);
        assert_eq!(scene.drawables()[3].cell_ref(), Some(CellRef { dim: 2, index: 7 }));
    }
}
