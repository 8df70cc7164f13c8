//! Scenes as flat arrays for the graphics card.
//!
//! All meshes go into one array of vertices, all segments into one of instances, all points into one of instances,
//! the opaque ones first, so that a scene of any number of drawables takes at most six draw calls. What a drawable
//! has in common (colour, opacity, centroid of its group) is a `Part`, which the shaders find by its index. So the
//! number of groups is bounded by memory only, and an explosion changes three numbers of the frame.
//!
//! Coordinates are rounded to f32 relative to the centre and the radius of the scene. The three vertices of a
//! triangle are stored in order of position: triangles that two cells share then get bit-identical depths.

use super::frame::Placement;
use crate::Scene;
use crate::scene::{Drawable, Extents, Shape, point3};
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};
use lar_core::TriangleMesh;

/// Flag of a part whose mesh is lit; `LIT` in `common.wgsl`.
const LIT: u32 = 1;
/// Flag of a part that is cell edges; `CELL_EDGE` in `common.wgsl`.
const CELL_EDGE: u32 = 2;
/// Cell edges are no wider than this part of the cell's mean edge, so that a million cells are not a black heap.
const EDGE_WIDTH: f32 = 0.12;
/// Longer than anything in a scene, which has radius 1.
const UNLIMITED: f32 = 1e6;
/// Centroids are taken for no farther than this from the centre, in radii of the scene.
const FARTHEST_CENTROID: f64 = 1e20;
/// Radii below this are taken for points; the scene then keeps world units.
const SMALLEST_RADIUS: f64 = 1e-90;

/// Mirror of `Part` in `common.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Part {
    pub(crate) color: [f32; 4],
    pub(crate) centroid: [f32; 3],
    pub(crate) flags: u32,
}

/// Vertex of a triangle; the normal is in units of 1/32767.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Vertex {
    pub(crate) position: [f32; 3],
    pub(crate) part: u32,
    pub(crate) normal: [i16; 4],
}

/// A segment.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Line {
    pub(crate) start: [f32; 3],
    pub(crate) part: u32,
    pub(crate) end: [f32; 3],
    pub(crate) width: f32,
    /// The most that the width may be, as a length in the scene.
    pub(crate) most: f32,
}

/// A dot.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Dot {
    pub(crate) center: [f32; 3],
    pub(crate) part: u32,
    pub(crate) size: f32,
}

/// Elements of which the first `n_opaque` are opaque.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sorted<T> {
    pub(crate) elements: Vec<T>,
    pub(crate) n_opaque: usize,
}

impl<T> Default for Sorted<T> {
    fn default() -> Self {
        Self { elements: Vec::new(), n_opaque: 0 }
    }
}

/// A scene as arrays.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    pub(crate) placement: Placement,
    pub(crate) extents: Extents,
    pub(crate) parts: Vec<Part>,
    pub(crate) vertices: Sorted<Vertex>,
    pub(crate) lines: Sorted<Line>,
    pub(crate) dots: Sorted<Dot>,
}

impl Batch {
    /// The arrays of a scene. Drawables of opacity 0 and triangles without area are left out.
    pub(crate) fn new(scene: &Scene) -> Self {
        let extents = Extents::new(scene);
        let radius = extents.bounds([1.0; 3]).map_or(0.0, |b| b.radius());
        let unit = if radius < SMALLEST_RADIUS { 1.0 } else { radius };
        let mut batch = Self {
            placement: Placement { center: extents.center, unit },
            extents,
            parts: Vec::new(),
            vertices: Sorted::default(),
            lines: Sorted::default(),
            dots: Sorted::default(),
        };
        let (opaque, rest): (Vec<_>, Vec<_>) = scene.drawables().iter().partition(|d| 1.0 <= d.opacity);
        opaque.into_iter().for_each(|d| batch.push(d, scene));
        batch.vertices.n_opaque = batch.vertices.elements.len();
        batch.lines.n_opaque = batch.lines.elements.len();
        batch.dots.n_opaque = batch.dots.elements.len();
        rest.into_iter().filter(|d| 0.0 < d.opacity).for_each(|d| batch.push(d, scene));
        batch
    }

    fn push(&mut self, drawable: &Drawable, scene: &Scene) {
        let part = u32::try_from(self.parts.len()).expect("memory ends before 2^32 drawables");
        let [r, g, b] = drawable.color;
        let centroid = drawable.group.map_or([0.0; 3], |g| self.place_centroid(scene.groups()[g.0 as usize]));
        let flags = match &drawable.shape {
            Shape::Mesh { lit: true, .. } => LIT,
            Shape::Lines { cell_edges: true, .. } => CELL_EDGE,
            Shape::Mesh { .. } | Shape::Lines { .. } | Shape::Points { .. } => 0,
        };
        self.parts.push(Part { color: [r, g, b, drawable.opacity], centroid, flags });
        match &drawable.shape {
            Shape::Mesh { mesh, .. } => self.push_mesh(part, mesh),
            Shape::Lines { segments, width, cell_edges } => {
                let segments = segments.iter().map(|s| s.map(|p| self.place(p)));
                let most = if *cell_edges { EDGE_WIDTH * mean_length(segments.clone()) } else { UNLIMITED };
                let lines = segments.map(|[start, end]| Line { start, part, end, width: *width, most });
                self.lines.elements.extend(lines.collect::<Vec<_>>());
            }
            Shape::Points { points, size } => {
                for &center in points {
                    self.dots.elements.push(Dot { center: self.place(center), part, size: *size });
                }
            }
        }
    }

    fn push_mesh(&mut self, part: u32, mesh: &TriangleMesh) {
        for triangle in &mesh.triangles {
            let mut corners = triangle
                .map(|v| self.placement.scene_from_world(point3(&mesh.points, v as usize)).map(|x| x as f32));
            corners.sort_by(|a, b| {
                a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
            });
            if let Some(normal) = normal(corners) {
                self.vertices.elements.extend(corners.map(|position| Vertex { position, part, normal }));
            }
        }
    }

    /// A centroid may lie anywhere, whatever the size of the scene, but its product with any explosion is to be finite.
    fn place_centroid(&self, p: [f64; 3]) -> [f32; 3] {
        self.placement.scene_from_world(p).map(|x| x.clamp(-FARTHEST_CENTROID, FARTHEST_CENTROID) as f32)
    }

    fn place(&self, p: [f64; 3]) -> [f32; 3] {
        self.placement.scene_from_world(p).map(|x| x as f32)
    }
}

fn mean_length(segments: impl ExactSizeIterator<Item = [[f32; 3]; 2]>) -> f32 {
    let n = segments.len().max(1) as f32;
    segments.map(|[a, b]| Vec3::from(a).distance(Vec3::from(b))).sum::<f32>() / n
}

/// The unit normal in units of 1/32767; `None` when the triangle has no area.
fn normal(corners: [[f32; 3]; 3]) -> Option<[i16; 4]> {
    let [a, b, c] = corners.map(|p| DVec3::from(p.map(f64::from)));
    let n = (b - a).cross(c - a).try_normalize()?;
    let [x, y, z] = n.to_array().map(|x| (x * 32767.0).round() as i16);
    Some([x, y, z, 0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use lar_core::Points;
    use proptest::prelude::*;

    fn triangle(z: f64) -> TriangleMesh {
        let points = Points::from_xyz(&[[0., 0., z], [2., 0., z], [0., 2., z], [1., 0., z]]);
        TriangleMesh { points, triangles: vec![[0, 1, 2], [0, 1, 3]] }
    }

    #[test]
    fn opaque_comes_first_and_nothing_invisible_is_kept() {
        let mut scene = Scene::new();
        scene.push(Drawable::mesh("clear", triangle(0.0)).opacity(0.5)).unwrap();
        scene.push(Drawable::mesh("gone", triangle(1.0)).opacity(0.0)).unwrap();
        scene.push(Drawable::mesh("solid", triangle(2.0))).unwrap();
        scene.push(Drawable::points("dot", [[0.0; 3]])).unwrap();
        let batch = Batch::new(&scene);
        assert_eq!(
            (batch.vertices.elements.len(), batch.vertices.n_opaque),
            (6, 3),
            "flat triangles are dropped"
        );
        assert_eq!(batch.parts.iter().map(|p| p.color[3]).collect::<Vec<_>>(), [1.0, 1.0, 0.5]);
        assert_eq!(batch.vertices.elements[3].part, 2);
        assert_eq!(batch.dots.n_opaque, 1);
    }

    /// A coordinate of any size that a scene takes.
    fn coordinate() -> impl Strategy<Value = f64> {
        (-1.0..=1.0_f64, -120..=100_i32).prop_map(|(x, e)| x * 10_f64.powi(e))
    }

    proptest! {
        #[test]
        fn all_numbers_are_finite_and_of_the_size_of_the_scene(
            points in prop::collection::vec(prop::array::uniform3(coordinate()), 3..12),
            centroid in prop::array::uniform3(coordinate()),
        ) {
            let mut scene = Scene::new();
            let group = scene.push_group(centroid).unwrap();
            let triangles = (2..points.len() as u32).map(|i| [0, i - 1, i]).collect();
            let mesh = TriangleMesh { points: Points::from_xyz(&points), triangles };
            scene.push(Drawable::mesh("mesh", mesh).group(group)).unwrap();
            scene.push(Drawable::edges("edges", points.windows(2).map(|w| [w[0], w[1]])).group(group)).unwrap();
            scene.push(Drawable::points("points", points)).unwrap();
            let batch = Batch::new(&scene);
            let lines = batch.lines.elements.iter().flat_map(|l| [l.start, l.end]);
            let positions = batch.vertices.elements.iter().map(|v| v.position).chain(lines);
            for x in positions.chain(batch.dots.elements.iter().map(|d| d.center)).flatten() {
                prop_assert!(x.abs() <= 1.01, "{x}");
            }
            for x in batch.parts.iter().flat_map(|p| p.centroid) {
                prop_assert!((1e6 * x).is_finite(), "{x}");
            }
        }
    }

    #[test]
    fn a_scene_far_from_the_origin_keeps_its_shape() {
        let mut scene = Scene::new();
        scene.push(Drawable::lines("far", [[[1e9, 0., 0.], [1e9 + 2.0, 0., 0.]]])).unwrap();
        let line = Batch::new(&scene).lines.elements[0];
        assert_eq!((line.start, line.end), ([-1., 0., 0.], [1., 0., 0.]));
    }

    #[test]
    fn the_same_triangle_is_stored_the_same_way_whatever_its_first_vertex() {
        let vertices = |triangles: Vec<[u32; 3]>| {
            let mut scene = Scene::new();
            scene.push(Drawable::mesh("t", TriangleMesh { triangles, ..triangle(0.0) })).unwrap();
            Batch::new(&scene).vertices.elements.iter().map(|v| v.position).collect::<Vec<_>>()
        };
        assert_eq!(vertices(vec![[0, 1, 2]]), vertices(vec![[2, 0, 1]]));
        assert_eq!(vertices(vec![[0, 1, 2]]), vertices(vec![[0, 2, 1]]));
    }
}
