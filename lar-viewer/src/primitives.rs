//! The elementary things to draw, as cells or as drawables: arrows, boxes, polygons, surfaces, groups.
//!
//! What needs a triangulation or a convex hull takes it finished: this crate knows neither.

use crate::{
    CellRef, CellShape, CellStyle, Coloring, Drawable, GroupId, Rgb, Scene, ViewerError, push_cells,
};
use lar_core::{Points, Surface, TriangleMesh};

/// Length of an arrow's head, and its radius, in parts of the arrow.
const HEAD: [f64; 2] = [0.09, 0.026];
/// Sides of an arrow head's cone.
const HEAD_SIDES: u32 = 32;

/// Adds an arrow: a line of 3 pixels and a cone. It does not move when the scene is exploded and is not clipped. An arrow
/// without length is a dot of a line.
///
/// ```
/// let mut scene = lar_viewer::Scene::new();
/// lar_viewer::push_arrow(&mut scene, "normal", [0.; 3], [0., 0., 1.], [0.9, 0.2, 0.2])?;
/// assert_eq!(scene.drawables().len(), 2);
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
///
/// # Errors
/// `Coordinate` when an end is not finite, `Attribute` when the colour is none.
#[doc(alias = "GLAxis")]
pub fn push_arrow(
    scene: &mut Scene,
    name: &str,
    from: [f64; 3],
    to: [f64; 3],
    color: Rgb,
) -> Result<(), ViewerError> {
    let neck = std::array::from_fn(|k| to[k] - HEAD[0] * (to[k] - from[k]));
    scene.push(Drawable::lines(name, [[from, neck]]).color(color).width(3.0).unclipped())?;
    scene.push(Drawable::mesh(name, arrow_head(from, to)).color(color).unclipped())
}

/// A cone with its tip at the end: tip, centre of the base, then the base's corners.
pub(crate) fn arrow_head(from: [f64; 3], to: [f64; 3]) -> TriangleMesh {
    let (tip, along) = (glam::DVec3::from(to), glam::DVec3::from(to) - glam::DVec3::from(from));
    let length = along.length();
    let (u, v) = along.try_normalize().unwrap_or(glam::DVec3::Z).any_orthonormal_pair();
    let base = tip - HEAD[0] * along;
    let corner = |i: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(HEAD_SIDES)).sin_cos();
        base + HEAD[1] * length * (cos * u + sin * v)
    };
    let corners = [tip, base].into_iter().chain((0..HEAD_SIDES).map(corner));
    let corners: Vec<[f64; 3]> = corners.map(|p| p.to_array()).collect();
    let sides = (0..HEAD_SIDES).flat_map(|i| {
        let (a, b) = (2 + i, 2 + (i + 1) % HEAD_SIDES);
        [[0, a, b], [1, b, a]]
    });
    TriangleMesh { points: Points::from_xyz(&corners), triangles: sides.collect() }
}

/// The box between two corners as a cell: 12 triangles turned outwards, 12 edges.
///
/// ```
/// use lar_viewer::{CellRef, cuboid_shape};
/// let cube = cuboid_shape(CellRef::new(3, 0), [0.; 3], [1.; 3]);
/// assert_eq!((cube.mesh.signed_volume(), cube.edges.len()), (1.0, 12));
/// ```
#[doc(alias = "GLCuboid")]
#[must_use]
pub fn cuboid_shape(cell: CellRef, min: [f64; 3], max: [f64; 3]) -> CellShape {
    let corner = |i: usize| std::array::from_fn(|k| if i >> k & 1 == 0 { min[k] } else { max[k] });
    let corners: Vec<[f64; 3]> = (0..8).map(corner).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let along =
        |k: usize| (0..8).filter(move |i| i >> k & 1 == 0).map(move |i| [corner(i), corner(i | 1 << k)]);
    CellShape {
        name: cell.to_string(),
        cell,
        mesh: TriangleMesh { points: Points::from_xyz(&corners), triangles },
        edges: (0..3).flat_map(along).collect(),
    }
}

/// The polygons of a surface as one cell: finished triangles over the surface's points, and the sides of its loops, holes
/// too, each once. Faces of coefficient 0 bound nothing and have none. O(n log n) for n sides.
///
/// ```
/// use lar_core::{Points, Surface, TriangleMesh};
/// use lar_viewer::{CellRef, surface_shape};
/// let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
/// let mut square = Surface::new("square", points.clone());
/// square.push_face([&[0, 1, 2, 3][..]], 1);
/// let mesh = TriangleMesh { points, triangles: vec![[0, 1, 2], [0, 2, 3]] };
/// assert_eq!(surface_shape(&square, mesh, CellRef::new(2, 0)).edges.len(), 4);
/// ```
#[doc(alias("GLPolygon", "GLPolygons", "GLPolyhedron", "GLPolyhedrons", "GLLar2gl", "GLPol"))]
#[must_use]
pub fn surface_shape(surface: &Surface, mesh: TriangleMesh, cell: CellRef) -> CellShape {
    let sides = |cycle: &[u32]| -> Vec<[u32; 2]> {
        let next = cycle.iter().skip(1).chain(cycle.first());
        cycle.iter().zip(next).map(|(&a, &b)| if a < b { [a, b] } else { [b, a] }).collect()
    };
    let bounding = (0..surface.n_faces()).filter(|&f| surface.coefficient(f) != 0);
    let mut edges: Vec<[u32; 2]> =
        bounding.flat_map(|f| surface.face(f).flat_map(sides).collect::<Vec<_>>()).collect();
    edges.sort_unstable();
    edges.dedup();
    let known = |ends: &[u32; 2]| ends.iter().all(|&v| (v as usize) < surface.points.len());
    CellShape {
        name: surface.name.clone(),
        cell,
        mesh,
        edges: edges
            .into_iter()
            .filter(known)
            .map(|ends| ends.map(|v| crate::scene::point3(&surface.points, v as usize)))
            .collect(),
    }
}

/// Adds groups of cells that explode group by group: all cells of group i get colour i of the code's colouring (1 to 12
/// name a colour for all, any other code cycles) and this opacity, and move rigidly by the mean of the group's centroids;
/// by how much is chosen by the [`View`](crate::View). An empty group is a group without cells. O(size of the cells).
///
/// ```
/// use lar_viewer::{CellRef, Scene, cuboid_shape, push_exploded_groups};
/// let cube = |i: u32, x: f64| cuboid_shape(CellRef::new(3, i), [x, 0., 0.], [x + 1., 1., 1.]);
/// let mut scene = Scene::new();
/// push_exploded_groups(&mut scene, vec![vec![cube(0, 0.), cube(1, 1.)], vec![cube(2, 2.)]], 99, 0.5)?;
/// assert_eq!(scene.groups()[0].centroid, [1.0, 0.5, 0.5]);
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
///
/// # Errors
/// Those of [`Scene::push`]; what was added before stays.
#[doc(alias = "GLExplode")]
pub fn push_exploded_groups(
    scene: &mut Scene,
    groups: Vec<Vec<CellShape>>,
    code: u32,
    opacity: f32,
) -> Result<Vec<GroupId>, ViewerError> {
    let coloring = Coloring::from_code(code);
    let push_group = |(i, cells): (usize, Vec<CellShape>)| {
        let mut own = Scene::new();
        let style =
            CellStyle { coloring: Coloring::Fixed(coloring.color(i)), opacity, ..CellStyle::default() };
        let parts = push_cells(&mut own, cells, &style)?;
        let n = parts.len().max(1) as f64;
        let mean = own.groups().iter().fold([0.0; 3], |m, g| [0, 1, 2].map(|k| m[k] + g.centroid[k] / n));
        let group = scene.push_group(mean)?;
        own.drawables().iter().try_for_each(|d| scene.push(d.clone().group(group)))?;
        Ok(group)
    };
    groups.into_iter().enumerate().map(push_group).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrow_heads_are_closed_and_end_at_the_tip() {
        for to in [[2.0, 0.0, 0.0], [0.0, -1.0, 3.0], [1.0, 1.0, 1.0]] {
            let head = arrow_head([0.0; 3], to);
            assert_eq!(head.points.xyz(0), to);
            assert!(head.is_closed() && 0.0 < head.signed_volume());
        }
    }

    #[test]
    fn groups_move_as_one_and_share_a_colour() {
        let cube =
            |i: u32| cuboid_shape(CellRef::new(3, i), [f64::from(i), 0., 0.], [f64::from(i) + 1., 1., 1.]);
        let mut scene = Scene::new();
        let groups = vec![vec![cube(0), cube(1)], vec![], vec![cube(2)]];
        let ids = push_exploded_groups(&mut scene, groups, 0, 0.4).unwrap();
        assert_eq!((ids.len(), scene.groups().len()), (3, 3));
        let of = |i: usize| scene.drawables().iter().filter(|d| d.group_id() == Some(ids[i])).count();
        assert_eq!([of(0), of(1), of(2)], [4, 0, 2]);
        assert_eq!(scene.drawables()[0].appearance().color, scene.drawables()[2].appearance().color);
        assert_eq!(scene.drawables()[4].appearance().color, Coloring::Cyclic.color(2));
        assert_eq!(scene.groups()[1].centroid, [0.0; 3]);
    }
}
