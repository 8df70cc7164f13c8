//! Faces of planar arrangements as triangles: areas add up, and every triangle is located in its face.

use lar_arrangement::planar::{Dangling, Drawing, Location, PlanarArrangement, PlanarArranger};
use lar_core::{FaceId, Points};

/// Pseudo-random numbers in 0..1 (a linear congruential generator, Knuth's constants).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn polygon(n: u32, radius: f64, [x, y]: [f64; 2]) -> Vec<[f64; 2]> {
    let angle = |k: u32| f64::from(k) * std::f64::consts::TAU / f64::from(n);
    (0..n).map(|k| [x + radius * angle(k).cos(), y + radius * angle(k).sin()]).collect()
}

fn polygons(polygons: impl IntoIterator<Item = Vec<[f64; 2]>>) -> Drawing {
    let mut out = Drawing::new(Points::new(2));
    polygons.into_iter().for_each(|p| {
        out.push_polygon("polygon", &[p]);
    });
    out
}

fn area(a: &PlanarArrangement, triangle: [u32; 3]) -> f64 {
    let [p, q, r] = triangle.map(|v| a.complex().points().point(v as usize));
    ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2.0
}

/// Triangles of every bounded face: face f of the arrangement is face f − 1 of the complex without the exterior.
#[track_caller]
fn check(drawing: &Drawing, dangling: Dangling, n_faces: usize) {
    let a = PlanarArranger::new().dangling(dangling).arrange(drawing).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(a.n_faces(), n_faces);
    let bounded = a.complex().without_exterior();
    let all = lar_triangle::triangulate(&bounded).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((all.n_faces(), all.fallbacks), (n_faces, 0));
    let locator = a.locator();
    for f in 1..=n_faces as u32 {
        let triangles = all.face_triangles(FaceId(f - 1));
        let areas: Vec<f64> = triangles.iter().map(|&t| area(&a, t)).collect();
        assert!(areas.iter().all(|&area| area >= 0.0), "face {f}: {areas:?}");
        let (sum, expected) = (areas.iter().sum::<f64>(), a.area(FaceId(f)));
        assert!((sum - expected).abs() < 1e-12 * (1.0 + expected), "face {f}: {sum} instead of {expected}");
        for (t, _) in triangles.iter().zip(&areas).filter(|(_, area)| **area > 1e-9) {
            let [p, q, r] = t.map(|v| a.complex().points().point(v as usize));
            let centre = [0, 1].map(|k| (p[k] + q[k] + r[k]) / 3.0);
            assert_eq!(locator.locate(centre), Location::Face(FaceId(f)));
        }
    }
}

#[test]
fn holes_in_any_number_and_depth() {
    let rings = (0..12).map(|k| polygon(6, 1.0 + f64::from(k), [0.0, 0.0]));
    let dots = (0..20).map(|k| f64::from(k) * 0.6).map(|t| polygon(3, 0.2, [6.5 * t.cos(), 6.5 * t.sin()]));
    check(&polygons(rings), Dangling::Drop, 12);
    let around = [polygon(4, 30.0, [0.0, 0.0])];
    check(&polygons(dots.chain(around)), Dangling::Drop, 21);
}

#[test]
fn faces_that_touch_themselves() {
    // Diamonds in a square that meet its sides and each other in their corners.
    let diamond = |x: f64, y: f64| vec![[x - 1.0, y], [x, y - 1.0], [x + 1.0, y], [x, y + 1.0]];
    let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let all = [diamond(1.0, 1.0), diamond(3.0, 1.0), diamond(1.0, 3.0), diamond(3.0, 3.0), square];
    // Four corners, four gaps at the sides, one in the middle, and the diamonds.
    check(&polygons(all), Dangling::Drop, 13);
    let one = [diamond(1.0, 2.0), vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]];
    check(&polygons(one), Dangling::Drop, 2);
}

#[test]
fn dangling_edges_are_no_boundary() {
    let mut drawing = polygons([polygon(4, 2.0, [0.0, 0.0]), polygon(4, 0.5, [0.0, 0.0])]);
    let ends = [[0.5, 0.0], [2.0, 0.0], [-1.0, 0.0], [-5.0, 0.25]].map(|p| drawing.push_point(p));
    drawing.push_segment([ends[0], ends[1]]);
    drawing.push_segment([ends[2], ends[3]]);
    check(&drawing, Dangling::Keep, 2);
    check(&drawing, Dangling::Drop, 2);
}

#[test]
fn random_segments_and_circles() {
    let mut random = Random(11);
    let mut number = || random.next();
    let segments: Vec<[f64; 4]> = (0..150).map(|_| [number(), number(), number(), number()]).collect();
    let lines = Drawing::from_segments(&segments);
    let n_faces = |d: &Drawing| PlanarArranger::new().arrange(d).map_or(0, |a| a.n_faces());
    check(&lines, Dangling::Drop, n_faces(&lines));
    check(&lines, Dangling::Keep, n_faces(&lines));
    let circles = polygons((0..60).map(|_| polygon(24, 0.2 * number(), [number(), number()])));
    check(&circles, Dangling::Drop, n_faces(&circles));
}
