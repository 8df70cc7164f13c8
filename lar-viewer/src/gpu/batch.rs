//! Scenes as flat arrays for the graphics card.
//!
//! All meshes go into one array of vertices, all segments into one of instances, all points into one of instances,
//! what is opaque first, so that a scene of any number of drawables takes few draw calls. What the elements of a
//! drawable have in common (colour, opacity, group) is a part, which the shaders look up by its index. So the number of
//! groups is bounded by memory only, an explosion changes a few numbers of the frame, and a change of looks the table of
//! parts. A drawable is one part, or several where its elements do not fit into one buffer of the adapter.
//!
//! Coordinates are rounded to f32 relative to the centre and the radius of the scene. The three vertices of a
//! triangle are stored in order of position: triangles that two cells share then get bit-identical depths.

use super::cull::Ball;
use super::elements::{Dot, ELEMENT_BYTES, KINDS, LINES, Line, MESH, POINTS, STROKES, Stroke, Vertex};
use super::frame::Placement;
use crate::scene::{Drawable, Extents, Shape, point3};
use crate::{Label, Scene, TextStyle, text};
use glam::DVec3;
use lar_core::TriangleMesh;
use std::ops::Range;

/// Cell edges are no wider than this part of the mean curve that they make, so that a million cells are not a black heap.
const EDGE_WIDTH: f32 = 0.12;
/// Longer than anything in a scene, which has radius 1.
const UNLIMITED: f32 = 1e6;
/// Radii below this are taken for points; the scene then keeps world units.
const SMALLEST_RADIUS: f64 = 1e-90;

/// Most elements of a part: of a large drawable only the parts in the picture are drawn.
const PART: usize = 1 << 15;
/// Units of the ends of strokes in a pixel.
const STROKE_UNITS: f64 = 16.0;
/// Width of strokes, in parts of the height of capitals.
const STROKE_WIDTH: f32 = 0.15;
/// Strokes are at least this many pixels wide.
const THINNEST_STROKE: f32 = 1.2;

/// Where a part's elements are from and where they lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) drawable: u32,
    /// The first of its elements in the drawable.
    pub(crate) element: u32,
    pub(crate) kind: usize,
    /// The same element in the array of its kind.
    pub(crate) start: u32,
    pub(crate) n: u32,
}

/// A scene as arrays.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    pub(crate) placement: Placement,
    pub(crate) extents: Extents,
    /// One for each part.
    pub(crate) spans: Vec<Span>,
    /// Around the elements of each part.
    pub(crate) balls: Vec<Ball>,
    /// Elements of each kind that one buffer holds: each array is cut after every so many.
    pub(crate) capacity: [u32; KINDS],
    pub(crate) triangles: Vec<[Vertex; 3]>,
    pub(crate) lines: Vec<Line>,
    pub(crate) dots: Vec<Dot>,
    pub(crate) strokes: Vec<Stroke>,
}

impl Batch {
    /// The arrays of a scene, for buffers of this many bytes at most. Triangles without area become points, which are
    /// nowhere on the screen.
    pub(crate) fn new(scene: &Scene, buffer_bytes: u64) -> Self {
        let extents = Extents::new(scene);
        let radius = extents.bounds(&[1.0; 3].into()).map_or(0.0, |b| b.radius());
        let unit = if radius < SMALLEST_RADIUS { 1.0 } else { radius };
        Self::placed(scene, Placement { center: extents.center, unit }, extents, buffer_bytes)
    }

    /// The arrays of a scene that is drawn together with another, which is placed like this.
    #[cfg(feature = "window")]
    pub(crate) fn beside(scene: &Scene, placement: Placement, buffer_bytes: u64) -> Self {
        Self::placed(scene, placement, Extents::about(scene, Some(placement.center)), buffer_bytes)
    }

    fn placed(scene: &Scene, placement: Placement, extents: Extents, buffer_bytes: u64) -> Self {
        let capacity = |bytes: usize| (buffer_bytes / bytes as u64).clamp(1, u64::from(u32::MAX / 3)) as u32;
        let mut batch = Self {
            placement,
            extents,
            spans: Vec::new(),
            balls: Vec::new(),
            capacity: ELEMENT_BYTES.map(capacity),
            triangles: Vec::new(),
            lines: Vec::new(),
            dots: Vec::new(),
            strokes: Vec::new(),
        };
        let numbered = || scene.drawables().iter().enumerate();
        let is_opaque = |d: &Drawable| 1.0 <= d.appearance.opacity;
        numbered().filter(|(_, d)| is_opaque(d)).for_each(|(i, d)| batch.push(i, d));
        numbered().filter(|(_, d)| !is_opaque(d)).for_each(|(i, d)| batch.push(i, d));
        batch.balls = batch.spans.iter().map(|span| batch.ball(span)).collect();
        batch
    }

    fn ball(&self, span: &Span) -> Ball {
        let range = span.start as usize..(span.start + span.n) as usize;
        match span.kind {
            MESH => Ball::around(self.triangles[range].iter().flatten().map(|v| v.position)),
            LINES => {
                let lines = &self.lines[range];
                Ball::around(lines.iter().flat_map(|l| [l.start, l.end]))
                    .of_widths(lines.iter().map(|l| l.width))
            }
            POINTS => {
                let dots = &self.dots[range];
                Ball::around(dots.iter().map(|d| d.center)).of_widths(dots.iter().map(|d| d.size))
            }
            _ => Ball::around(self.strokes[range].iter().map(|s| s.anchor)),
        }
    }

    fn push(&mut self, index: usize, drawable: &Drawable) {
        match &drawable.shape {
            Shape::Mesh { mesh, .. } => self.push_mesh(index, mesh),
            Shape::Lines { segments, width, curve } => {
                let place = |s: &[[f64; 3]; 2]| s.map(|p| self.place(p));
                let placed: Vec<[[f32; 3]; 2]> = segments.iter().map(place).collect();
                let most =
                    curve.map_or(UNLIMITED, |length| EDGE_WIDTH * (length / self.placement.unit) as f32);
                for (part, range) in self.new_parts(index, LINES, self.lines.len(), placed.len()) {
                    let line = |&[start, end]: &[[f32; 3]; 2]| Line { start, part, end, width: *width, most };
                    self.lines.extend(placed[range].iter().map(line));
                }
            }
            Shape::Points { points, size } => {
                for (part, range) in self.new_parts(index, POINTS, self.dots.len(), points.len()) {
                    for &p in &points[range] {
                        self.dots.push(Dot { center: self.place(p), part, size: *size });
                    }
                }
            }
            Shape::Labels { labels, style, on_top } => self.push_labels(index, labels, style, *on_top),
        }
    }

    fn push_labels(&mut self, index: usize, labels: &[Label], style: &TextStyle, on_top: bool) {
        let width = (STROKE_WIDTH * style.size as f32).max(THINNEST_STROKE);
        let width = if on_top { -width } else { width };
        let place = |label: &Label| {
            let anchor = self.place(label.at);
            let ends =
                |[a, b]: [[f64; 2]; 2]| [a[0], a[1], b[0], b[1]].map(|x| (x * STROKE_UNITS).round() as i16);
            let of_label = text::strokes(&label.text, style).into_iter();
            of_label.map(move |s| Stroke { anchor, part: 0, ends: ends(s), width })
        };
        let placed: Vec<Stroke> = labels.iter().flat_map(place).collect();
        for (part, range) in self.new_parts(index, STROKES, self.strokes.len(), placed.len()) {
            self.strokes.extend(placed[range].iter().map(|&stroke| Stroke { part, ..stroke }));
        }
    }

    fn push_mesh(&mut self, index: usize, mesh: &TriangleMesh) {
        let points = 0..mesh.points.len();
        let placed: Vec<[f32; 3]> = points.map(|i| self.place(point3(&mesh.points, i))).collect();
        for (part, range) in self.new_parts(index, MESH, self.triangles.len(), mesh.triangles.len()) {
            for triangle in &mesh.triangles[range] {
                let mut corners = triangle.map(|v| placed[v as usize]);
                corners.sort_by(|a, b| {
                    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
                });
                let normal = normal(corners).unwrap_or_else(|| {
                    corners = [corners[0]; 3];
                    [0; 4]
                });
                self.triangles.push(corners.map(|position| Vertex { position, part, normal }));
            }
        }
    }

    /// New parts for `n` elements of a drawable that are appended to an array of length `start`; the elements of each.
    fn new_parts(&mut self, index: usize, kind: usize, start: usize, n: usize) -> Vec<(u32, Range<usize>)> {
        let id = |i: usize| u32::try_from(i).expect("memory ends before 2^32 drawables or elements");
        let capacity = self.capacity[kind] as usize;
        let mut done = 0;
        let mut parts = Vec::new();
        while done < n {
            let here = (n - done).min(capacity - (start + done) % capacity).min(PART);
            parts.push((id(self.spans.len()), done..done + here));
            let [drawable, element, start] = [index, done, start + done].map(id);
            self.spans.push(Span { drawable, element, kind, start, n: id(here) });
            done += here;
        }
        parts
    }

    fn place(&self, p: [f64; 3]) -> [f32; 3] {
        DVec3::from(self.placement.scene_from_world(p)).as_vec3().to_array()
    }
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

    const LARGE: u64 = 1 << 28;

    #[test]
    fn opaque_comes_first_and_each_part_knows_where_it_is_from() {
        let mut scene = Scene::new();
        scene.push(Drawable::mesh("clear", triangle(0.0)).opacity(0.5)).unwrap();
        scene.push(Drawable::mesh("solid", triangle(2.0))).unwrap();
        scene.push(Drawable::points("dot", [[0.0; 3]])).unwrap();
        let batch = Batch::new(&scene, LARGE);
        let span = |drawable, kind, start, n| Span { drawable, element: 0, kind, start, n };
        assert_eq!(batch.spans, [span(1, MESH, 0, 2), span(2, POINTS, 0, 1), span(0, MESH, 2, 2)]);
        let flat = batch.triangles[1].map(|v| v.position);
        assert_eq!(flat, [flat[0]; 3], "a triangle without area is a point");
        assert_eq!(batch.triangles[3][0].part, 2);
    }

    #[test]
    fn parts_end_where_a_buffer_is_full() {
        let mut scene = Scene::new();
        let dots = |n: usize| Drawable::points("dots", (0..n).map(|i| [i as f64; 3]));
        [2, 5, 0, 1].into_iter().for_each(|n| scene.push(dots(n)).unwrap());
        let batch = Batch::new(&scene, 3 * size_of::<Dot>() as u64);
        assert_eq!(batch.capacity[POINTS], 3);
        let spans: Vec<_> = batch.spans.iter().map(|s| (s.drawable, s.element, s.start, s.n)).collect();
        assert_eq!(spans, [(0, 0, 0, 2), (1, 0, 2, 1), (1, 1, 3, 3), (1, 4, 6, 1), (3, 0, 7, 1)]);
        let parts: Vec<_> = batch.dots.iter().map(|d| d.part).collect();
        assert_eq!(parts, [0, 0, 1, 2, 2, 2, 3, 4]);
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
            let batch = Batch::new(&scene, LARGE);
            let lines = batch.lines.iter().flat_map(|l| [l.start, l.end]);
            let positions = batch.triangles.iter().flatten().map(|v| v.position).chain(lines);
            for x in positions.chain(batch.dots.iter().map(|d| d.center)).flatten() {
                prop_assert!(x.abs() <= 1.01, "{x}");
            }
            let groups = crate::gpu::parts::group_offsets(&scene, &batch.placement);
            for x in groups.iter().flat_map(|g| g.0).flatten() {
                prop_assert!((1e6 * x).is_finite(), "{x}");
            }
        }
    }

    #[test]
    fn a_scene_far_from_the_origin_keeps_its_shape() {
        let mut scene = Scene::new();
        scene.push(Drawable::lines("far", [[[1e9, 0., 0.], [1e9 + 2.0, 0., 0.]]])).unwrap();
        let line = Batch::new(&scene, LARGE).lines[0];
        assert_eq!((line.start, line.end), ([-1., 0., 0.], [1., 0., 0.]));
    }

    #[test]
    fn the_same_triangle_is_stored_the_same_way_whatever_its_first_vertex() {
        let vertices = |triangles: Vec<[u32; 3]>| {
            let mut scene = Scene::new();
            scene.push(Drawable::mesh("t", TriangleMesh { triangles, ..triangle(0.0) })).unwrap();
            Batch::new(&scene, LARGE).triangles.iter().flatten().map(|v| v.position).collect::<Vec<_>>()
        };
        assert_eq!(vertices(vec![[0, 1, 2]]), vertices(vec![[2, 0, 1]]));
        assert_eq!(vertices(vec![[0, 1, 2]]), vertices(vec![[0, 2, 1]]));
    }
}
