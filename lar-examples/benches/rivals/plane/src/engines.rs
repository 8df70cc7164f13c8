//! The libraries, each as a function from segments to a way to count what it made of them: vertices, edges, faces with
//! the exterior, connected components; `None` where it does not tell.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::i_float::int::point::IntPoint;
use i_overlay::string::clip::ClipRule;
use i_overlay::string::overlay::StringOverlay;
use i_overlay::string::rule::StringRule;
use lar_arrangement::planar::{Dangling, Drawing, PlanarArranger};
use spade::handles::{FixedFaceHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::num::NonZeroUsize;

pub type Counts = [Option<usize>; 4];
pub type Count = Box<dyn FnOnce() -> Counts>;
pub type Engine = fn(&[[f64; 4]]) -> Result<Count, Box<dyn Error>>;

pub fn named(name: &str) -> Option<Engine> {
    match name {
        "lar" => Some(|segments| lar(segments, 1)),
        "lar-2" => Some(|segments| lar(segments, 2)),
        "i_overlay-pieces" => Some(pieces),
        "i_overlay-faces" => Some(faces),
        "spade" => Some(spade),
        _ => None,
    }
}

/// Segments to begin with: three, or enough to be worth a second thread.
pub fn warm_up(name: &str) -> Vec<[f64; 4]> {
    let mut segments = vec![[0.0, 0.0, 1.0, 1.0], [0.0, 1.0, 1.0, 0.0], [0.5, 0.0, 0.6, 1.0]];
    if name == "lar-2" {
        segments.extend((2..1 << 16).map(|i| [0.0, f64::from(i), 1.0, f64::from(i) + 0.5]));
    }
    segments
}

/// The chain complex with dangling edges kept.
fn lar(segments: &[[f64; 4]], threads: usize) -> Result<Count, Box<dyn Error>> {
    let threads = NonZeroUsize::new(threads).ok_or("no thread")?;
    let arranger = PlanarArranger::new().threads(threads).dangling(Dangling::Keep);
    let a = arranger.arrange(&Drawing::from_segments(segments))?;
    Ok(Box::new(move || [a.n_vertices(), a.n_edges(), a.n_faces() + 1, a.n_components()].map(Some)))
}

/// The segments on an integer grid as fine as ours, which rounds crossings to it.
fn on_grid(segments: &[[f64; 4]]) -> (StringOverlay<i64>, i64) {
    let largest = segments.as_flattened().iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let scale = 2f64.powi(40 - largest.log2().ceil() as i32);
    let point = |x: f64, y: f64| IntPoint::new((x * scale).round() as i64, (y * scale).round() as i64);
    let mut overlay = StringOverlay::new(segments.len());
    for &[x, y, z, w] in segments {
        overlay.add_string_line([point(x, y), point(z, w)]);
    }
    (overlay, 1 << 42)
}

/// Only the pieces that the segments cut each other into: all that lies outside of no shape.
fn pieces(segments: &[[f64; 4]]) -> Result<Count, Box<dyn Error>> {
    let (overlay, _) = on_grid(segments);
    let rule = ClipRule { invert: true, boundary_included: true };
    let paths = overlay.clip_string_lines(FillRule::NonZero, rule);
    Ok(Box::new(move || {
        let (mut vertices, mut edges) = (BTreeSet::new(), BTreeSet::new());
        for w in paths.iter().flat_map(|path| path.windows(2)) {
            let [a, b] = [w[0], w[1]].map(|p| (p.x, p.y));
            vertices.extend([a, b]);
            edges.insert((a.min(b), a.max(b)));
        }
        [Some(vertices.len()), Some(edges.len()), None, None]
    }))
}

/// The faces of a square around everything, sliced along the segments. What dangles bounds nothing.
fn faces(segments: &[[f64; 4]]) -> Result<Count, Box<dyn Error>> {
    let (mut overlay, side) = on_grid(segments);
    let corners = [(-side, -side), (side, -side), (side, side), (-side, side)];
    overlay.add_shape_contour(&corners.map(|(x, y)| IntPoint::new(x, y)));
    let graph = overlay.build_graph_view(FillRule::NonZero).ok_or("no segments")?;
    let shapes = graph.extract_shapes(StringRule::Slice);
    Ok(Box::new(move || [None, None, Some(shapes.len()), None]))
}

/// A constrained triangulation whose constraints split each other, and the face of each triangle.
fn spade(segments: &[[f64; 4]]) -> Result<Count, Box<dyn Error>> {
    let points: Vec<Point2<f64>> =
        segments.iter().flat_map(|&[x, y, z, w]| [Point2::new(x, y), Point2::new(z, w)]).collect();
    let mut cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::bulk_load_cdt(points.clone(), Vec::new())?;
    if cdt.num_vertices() == points.len() {
        let handles: Vec<_> = cdt.fixed_vertices().collect();
        for ends in handles.chunks_exact(2) {
            cdt.add_constraint_and_split(ends[0], ends[1], |p| p);
        }
    } else {
        // Equal points became one vertex, which inserting again finds.
        for ends in points.chunks_exact(2) {
            let (a, b) = (cdt.insert(ends[0])?, cdt.insert(ends[1])?);
            cdt.add_constraint_and_split(a, b, |p| p);
        }
    }
    let n_faces = label_faces(&cdt);
    Ok(Box::new(move || {
        let mut parent: BTreeMap<usize, usize> = BTreeMap::new();
        let mut n_components = cdt.num_vertices();
        for edge in cdt.undirected_edges().filter(|e| e.is_constraint_edge()) {
            let [a, b] = edge.vertices().map(|v| root(&mut parent, v.index()));
            if a != b {
                parent.insert(a, b);
                n_components -= 1;
            }
        }
        [cdt.num_vertices(), cdt.num_constraints(), n_faces, n_components].map(Some)
    }))
}

fn root(parent: &mut BTreeMap<usize, usize>, mut v: usize) -> usize {
    while let Some(&next) = parent.get(&v) {
        if let Some(&after) = parent.get(&next) {
            parent.insert(v, after);
        }
        v = next;
    }
    v
}

/// Floods triangles across edges that are no constraints; the number of faces.
fn label_faces(cdt: &ConstrainedDelaunayTriangulation<Point2<f64>>) -> usize {
    let mut label = vec![usize::MAX; cdt.num_all_faces()];
    let mut n_faces = 1;
    let mut stack: Vec<FixedFaceHandle<InnerTag>> = Vec::new();
    for edge in cdt.convex_hull().filter(|e| !e.is_constraint_edge()) {
        stack.extend(edge.rev().face().as_inner().map(|f| f.fix()));
    }
    flood(cdt, &mut label, stack, 0);
    for face in cdt.inner_faces() {
        if label[face.fix().index()] == usize::MAX {
            flood(cdt, &mut label, vec![face.fix()], n_faces);
            n_faces += 1;
        }
    }
    n_faces
}

fn flood(
    cdt: &ConstrainedDelaunayTriangulation<Point2<f64>>,
    label: &mut [usize],
    mut stack: Vec<FixedFaceHandle<InnerTag>>,
    number: usize,
) {
    while let Some(face) = stack.pop() {
        if label[face.index()] == usize::MAX {
            label[face.index()] = number;
            let open = cdt.face(face).adjacent_edges().into_iter().filter(|e| !e.is_constraint_edge());
            stack.extend(open.filter_map(|e| e.rev().face().as_inner()).map(|f| f.fix()));
        }
    }
}
