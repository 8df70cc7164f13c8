//! Line drawings without hidden lines; no graphics card needed.
mod support;

use glam::DVec3;
use lar_core::TriangleMesh;
use lar_viewer::{
    Camera, CellStyle, Clip, ColorBar, ColorMap, Drawable, InkArea, LineDrawing, Outline, Outlined,
    Projection, Rgb, Scene, View, push_cells,
};
use proptest::prelude::*;
use support::{cube_grid, cuboid};

const SIZE: [u32; 2] = [400, 300];

fn drawn(scene: &Scene, view: &View) -> LineDrawing {
    LineDrawing::new(scene, view, SIZE).unwrap()
}

fn cells(n: u32, opacity: f32) -> Scene {
    let mut scene = Scene::new();
    push_cells(&mut scene, cube_grid(n), &CellStyle { opacity, ..CellStyle::default() }).unwrap();
    scene
}

fn length(drawing: &LineDrawing) -> f64 {
    let length = |[a, b]: [[f64; 2]; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    drawing.lines().iter().map(|l| length(l.ends)).sum()
}

#[test]
fn a_cube_shows_nine_of_its_twelve_edges() {
    let scene = cells(1, 1.0);
    for orthographic in [false, true] {
        let mut view = View::fitted(&scene, [1.0; 3], 4.0 / 3.0);
        if orthographic {
            view.camera = view.camera.toggle_projection();
        }
        assert_eq!(drawn(&scene, &view).lines().len(), 9);
        assert_eq!(drawn(&cells(1, 0.3), &view).lines().len(), 12, "one sees through it");
        assert!(drawn(&scene, &View { edges: false, ..view }).lines().is_empty());
    }
}

#[test]
fn exploded_cells_hide_each_other() {
    let scene = cells(2, 1.0);
    let view = View::fitted(&scene, [1.5; 3], 4.0 / 3.0);
    let through = length(&drawn(&cells(2, 0.3), &view));
    let seen = length(&drawn(&scene, &view));
    assert!(0.4 * through < seen && seen < 0.75 * through, "{seen} of {through}");
}

#[test]
fn the_clip_plane_and_the_eye_cut_lines() {
    let scene = cells(1, 0.3);
    let view = View::fitted(&scene, [1.0; 3], 4.0 / 3.0);
    let clip = Clip::new([0.0, 0.0, 1.0], 0.5);
    assert_eq!(drawn(&scene, &View { clip: Some(clip), ..view }).lines().len(), 8);
    let gone = Clip { offset: 0.4, ..clip.whole_cells() };
    assert!(drawn(&scene, &View { clip: Some(gone), ..view }).lines().is_empty());
    let inside = Camera { target: [0.5; 3], distance: 1e-3, ..view.camera };
    let near = drawn(&scene, &View { camera: inside, ..view });
    assert!(near.lines().iter().flat_map(|l| l.ends).flatten().all(f64::is_finite));
}

#[test]
fn svg_has_one_path_for_each_style_and_each_shared_edge_once() {
    let scene = cells(2, 1.0);
    let view = View { background: [1.0, 0.5, 0.0], ..View::fitted(&scene, [1.0; 3], 4.0 / 3.0) };
    let svg = drawn(&scene, &view).to_svg();
    assert_eq!(svg.matches("<path").count(), 2, "{svg}");
    assert!(svg.contains("fill=\"#ff8000\"") && svg.contains("viewBox=\"-200 -150 400 300\""), "{svg}");
    // Three faces of two by two squares: each has twelve edges, and two faces share two of them.
    assert_eq!(svg.matches('M').count() - 1, 3 * 12 - 3 * 2, "{svg}");
    assert!(!drawn(&scene, &View { background_opacity: 0.0, ..view }).to_svg().contains("background"));
}

/// Whether a triangle crosses the way from a point to the eye, and how clearly: by the least of the numbers that decide.
fn blocked(point: DVec3, eye: DVec3, [a, b, c]: [DVec3; 3]) -> (bool, f64) {
    let way = eye - point;
    let normal = (b - a).cross(c - a).normalize();
    let t = normal.dot(a - point) / normal.dot(way);
    let hit = point + t * way;
    let inside = [(a, b), (b, c), (c, a)].map(|(p, q)| (q - p).normalize().cross(hit - p).dot(normal));
    let least = inside.into_iter().fold(f64::MAX, f64::min);
    let (high, way) = ((1.0 - t) * way.length(), t * way.length());
    let decides = least.min(way).min(high);
    if decides.is_nan() { (false, 0.0) } else { (0.0 < decides, least.abs().min(way.abs()).min(high.abs())) }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Pieces of edges are seen just where no triangle stands between them and the eye, by rays in space.
    #[test]
    fn what_is_seen_is_what_rays_reach(
        boxes in prop::collection::vec((prop::array::uniform3(-2.0..2.0_f64), prop::array::uniform3(0.2..1.5_f64)), 1..5),
        azimuth in -3.0..3.0_f64,
        elevation in -1.4..1.4_f64,
        orthographic in any::<bool>(),
    ) {
        let shapes: Vec<_> = (0..).zip(&boxes).map(|(i, (min, size))| {
            cuboid(i, *min, std::array::from_fn(|k| min[k] + size[k]))
        }).collect();
        let mut scene = Scene::new();
        push_cells(&mut scene, shapes.clone(), &CellStyle::default()).unwrap();
        let orientation = lar_viewer::Orientation::turntable(azimuth, elevation);
        let projection = if orthographic { Projection::Orthographic } else { Projection::Perspective };
        let view = View { camera: Camera { orientation, projection, ..Camera::default() }, ..View::default() };
        let view = view.fit(&scene, 4.0 / 3.0);
        let drawing = drawn(&scene, &view);
        let triangles: Vec<[DVec3; 3]> = shapes.iter().flat_map(|s| {
            s.mesh.triangles.iter().map(|t| t.map(|v| DVec3::from(s.mesh.points.xyz(v as usize))))
        }).collect();
        let back = DVec3::from(view.camera.axes()[2]);
        for &[a, b] in shapes.iter().flat_map(|s| &s.edges) {
            for i in 1..8 {
                let point = DVec3::from(a).lerp(b.into(), f64::from(i) / 8.0);
                let eye = if orthographic { point + 50.0 * back } else { view.camera.eye().into() };
                let found: Vec<(bool, f64)> = triangles.iter().map(|&t| blocked(point, eye, t)).collect();
                let is_hidden = found.iter().any(|f| f.0 && 0.02 < f.1);
                // Near a side of a triangle, or on one, the answer is a matter of rounding and of the piece's ends.
                let unclear = found.iter().any(|f| f.0 && f.1 <= 0.02);
                if unclear && !is_hidden {
                    continue;
                }
                let near_miss = found.iter().any(|f| !f.0 && 0.0 < f.1 && f.1 < 0.02);
                if near_miss && !is_hidden {
                    continue;
                }
                let [x, y] = view.camera.project(point.to_array(), 300.0).unwrap();
                let is_drawn = drawing.lines().iter().any(|l| distance([x, -y], l.ends) < 1e-3);
                // Another edge may be seen at the same place.
                prop_assert!(is_drawn != is_hidden || is_hidden && is_drawn && shares_place(&shapes, &view, point, [x, -y]),
                    "point {point} is hidden: {is_hidden}, drawn: {is_drawn}");
            }
        }
    }
}

/// Distance of a point from a segment.
fn distance(p: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (u, w) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let t = ((u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
    (w[0] - t * u[0]).hypot(w[1] - t * u[1])
}

/// Whether another edge appears where a point does.
fn shares_place(shapes: &[lar_viewer::CellShape], view: &View, point: DVec3, at: [f64; 2]) -> bool {
    shapes.iter().flat_map(|s| &s.edges).any(|&[a, b]| {
        let (a3, b3) = (DVec3::from(a), DVec3::from(b));
        let off = (point - a3).cross((b3 - a3).normalize()).length();
        let ends = [a, b].map(|p| view.camera.project(p, 300.0).map(|[x, y]| [x, -y]));
        let [Some(a), Some(b)] = ends else { return false };
        1e-6 < off && distance(at, [a, b]) < 0.01
    })
}

fn filled(scene: &Scene, view: &View) -> LineDrawing {
    LineDrawing::filled(scene, view, SIZE).unwrap()
}

#[test]
fn faces_are_filled_and_lines_behind_them_are_faint() {
    let scene = cells(1, 1.0);
    let view = View::fitted(&scene, [1.0; 3], 4.0 / 3.0);
    let drawing = filled(&scene, &view);
    assert_eq!(drawing.lines(), drawn(&scene, &view).lines(), "opaque faces hide lines, filled or not");
    assert_eq!(drawing.areas().len(), 6);
    assert!(drawing.areas().iter().all(|a| a.loops.len() == 1 && a.loops[0].len() == 4 && a.opacity == 1.0));
    let translucent = filled(&cells(1, 0.5), &view);
    // The edges at the hidden corner are behind one face, in pieces where they pass from one to another.
    let faint: Vec<f64> = translucent.lines().iter().map(|l| l.opacity).filter(|o| *o < 1.0).collect();
    assert!(3 <= faint.len() && faint.iter().all(|o| *o == 0.5), "{faint:?}");
    let svg = translucent.to_svg();
    assert_eq!(svg.matches(" opacity=\"0.5\"").count(), 6 + 1, "six faces, one path of lines: {svg}");
    assert!(filled(&scene, &View { clip: Some(Clip::new([0.0, 0.0, 1.0], 0.5)), ..view }).areas().len() == 5);
}

#[test]
fn outlines_are_where_a_solid_ends() {
    let scene = cells(1, 1.0);
    let view = View { edges: false, ..View::fitted(&scene, [1.0; 3], 4.0 / 3.0) };
    let outline = Some(Outline { of: Outlined::Model, ..Outline::default() });
    let contour = drawn(&scene, &View { outline, ..view });
    assert_eq!(contour.lines().len(), 6, "a cube seen from a corner is a hexagon");
    assert!(contour.lines().iter().all(|l| l.width == 4.0));
    let eight = cells(2, 1.0);
    let of = |of: Outlined, explode: f32| {
        let outline = Some(Outline { of, ..Outline::default() });
        let view = View { edges: false, outline, ..View::fitted(&eight, [explode; 3], 4.0 / 3.0) };
        drawn(&eight, &view).lines().len()
    };
    assert_eq!(of(Outlined::Model, 1.0), 12, "two edges on each side of the hexagon, none between cells");
    assert!(24 < of(Outlined::Cells, 2.0));
}

#[test]
fn a_legend_is_put_over_a_drawing() {
    let bar = ColorBar { map: ColorMap::Sequential, range: [0.0, 2.0], title: "volume".into() };
    let legend = bar.drawing(150).unwrap();
    assert_eq!(legend.areas().len(), 64);
    assert!(
        legend.areas().iter().all(|a| a.loops.len() == 1 && a.loops[0].len() == 4),
        "two triangles, one face"
    );
    let scene = cells(1, 1.0);
    let mut drawing = filled(&scene, &View::fitted(&scene, [1.0; 3], 4.0 / 3.0));
    drawing.overlay(&legend, [300.0, 10.0]);
    let placed = &drawing.areas()[6..];
    let corners = || placed.iter().flat_map(|a| a.loops.iter().flatten());
    assert!(
        placed.len() == 64
            && corners().all(|[x, y]| (100.0..200.0).contains(x) && (-20.0..140.0).contains(y))
    );
}

fn holds(area: &InkArea, [x, y]: [f64; 2]) -> bool {
    let sides = area.loops.iter().flat_map(|l| l.iter().zip(l.iter().cycle().skip(1)));
    let crossed = sides
        .filter(|(a, b)| (a[1] <= y) != (b[1] <= y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    crossed.count() % 2 == 1
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// What is on top at a pixel is what a ray meets first.
    #[test]
    fn the_nearest_face_is_on_top(
        boxes in prop::collection::vec((prop::array::uniform3(0.0..0.4_f64), prop::array::uniform3(0.2..0.6_f64)), 8),
        azimuth in -3.0..3.0_f64,
        elevation in -1.4..1.4_f64,
        pixels in prop::collection::vec(prop::array::uniform2(-150.0..150.0_f64), 40),
    ) {
        let mut scene = Scene::new();
        let mut faces: Vec<([[DVec3; 3]; 2], Rgb)> = Vec::new();
        for (i, (low, size)) in (0..).zip(&boxes) {
            let min: [f64; 3] = std::array::from_fn(|k| f64::from(i >> k & 1) + low[k]);
            let shape = cuboid(i, min, std::array::from_fn(|k| min[k] + size[k]));
            for pair in shape.mesh.triangles.chunks_exact(2) {
                let color = [0.1 * i as f32, 0.15 * (faces.len() % 6) as f32, 0.5];
                let mesh = TriangleMesh { points: shape.mesh.points.clone(), triangles: pair.to_vec() };
                scene.push(Drawable::mesh("face", mesh).color(color).unlit()).unwrap();
                let corner = |v: u32| DVec3::from(shape.mesh.points.xyz(v as usize));
                faces.push(([pair[0].map(corner), pair[1].map(corner)], color));
            }
        }
        let camera = Camera {
            orientation: lar_viewer::Orientation::turntable(azimuth, elevation),
            projection: Projection::Orthographic,
            ..Camera::default()
        };
        let view = View { camera, ..View::default() }.fit(&scene, 4.0 / 3.0);
        let drawing = filled(&scene, &view);
        let [right, up, back] = view.camera.axes().map(DVec3::from);
        for [x, y] in pixels {
            let unit = view.camera.world_per_pixel(300.0);
            let eye = DVec3::from(view.camera.target) + unit * (x * right + y * up) + 50.0 * back;
            let hits = faces.iter().flat_map(|(pair, color)| pair.iter().map(move |t| (t, color)));
            let hits = hits.map(|(t, color)| (blocked(eye - 200.0 * back, eye, *t), t, color));
            let hits: Vec<_> = hits.collect();
            // Near a side it is a matter of rounding.
            if hits.iter().any(|((_, clear), ..)| *clear < 0.02) {
                continue;
            }
            let height = |t: &[DVec3; 3]| {
                let normal = (t[1] - t[0]).cross(t[2] - t[0]);
                normal.dot(eye - t[0]) / normal.dot(back)
            };
            let nearest = hits.iter().filter(|((hit, _), ..)| *hit).min_by(|a, b| height(a.1).total_cmp(&height(b.1)));
            let on_top = drawing.areas().iter().rev().find(|area| holds(area, [x, y])).map(|area| area.color);
            prop_assert_eq!(on_top, nearest.map(|(_, _, color)| **color), "at {} {}", x, y);
        }
    }
}
