//! Figures printed in the papers, or found by independent computation.

use crate::check::arranged;
use lar_arrangement::planar::{Dangling, Drawing, PlanarArrangement, PlanarArranger};
use lar_arrangement::{Expression, FillRule};
use lar_core::{FaceId, Points};
use std::f64::consts::{FRAC_PI_4, SQRT_2};
use std::num::NonZeroUsize;

/// Coordinates of some units move by up to 2^-41 of the drawing's extent when they are snapped to the grid.
const SNAPPED: f64 = 1e-10;

type Square = [[f64; 2]; 4];

/// The square of a side with its lower left corner in the origin, turned, then moved.
fn square(side: f64, angle: f64, [dx, dy]: [f64; 2]) -> Square {
    let (sin, cos) = angle.sin_cos();
    [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]
        .map(|[x, y]| [x * cos - y * sin + dx, x * sin + y * cos + dy])
}

fn regions(polygons: &[Square]) -> Drawing {
    let mut out = Drawing::new(Points::new(2));
    for (name, polygon) in ["A", "B", "C", "D"].into_iter().zip(polygons) {
        out.push_polygon(name, &[polygon.to_vec()]);
    }
    out
}

/// V, E, bounded faces, components, loops of bounded faces.
#[track_caller]
fn check(drawing: &Drawing, expected: [usize; 5], mut areas: Vec<f64>) -> PlanarArrangement {
    let a = arranged(drawing, Dangling::Drop);
    let found = [a.n_vertices(), a.n_edges(), a.n_faces(), a.n_components(), a.n_loops()];
    assert_eq!(found, expected);
    assert_eq!((a.euler(), a.complex().validate_with_exterior()), (0, Vec::new()));
    let mut found: Vec<f64> = (1..=a.n_faces() as u32).map(|f| a.area(FaceId(f))).collect();
    found.sort_by(f64::total_cmp);
    areas.sort_by(f64::total_cmp);
    crate::common::assert_close(&found, &areas, SNAPPED, "areas");
    a
}

#[track_caller]
fn check_boolean(a: &PlanarArrangement, expression: &str, area: f64) {
    let parsed = Expression::parse(expression, &["A", "B"]).expect("an expression");
    let result = a.boolean(&parsed, FillRule::NonZero).unwrap_or_else(|e| panic!("{e}"));
    assert!((result.area() - area).abs() < SNAPPED, "{expression}: {} instead of {area}", result.area());
}

#[test]
fn two_squares_moved() {
    let squares = regions(&[square(1.0, 0.0, [0.0; 2]), square(1.0, 0.0, [0.25; 2])]);
    let a = check(&squares, [10, 12, 3, 1, 3], vec![0.5625, 0.4375, 0.4375]);
    check_boolean(&a, "A & B", 0.5625);
    check_boolean(&a, "A | B", 1.4375);
}

#[test]
fn two_squares_turned() {
    // Struct([t, r, square]): turned first. The first square's upper corner and the second one's left one overlap.
    let shift = [-SQRT_2 / 4.0, -SQRT_2 / 2.0];
    let diamond = |dx: f64| square(1.0, FRAC_PI_4, [dx, shift[1]]);
    let a =
        check(&regions(&[diamond(shift[0]), diamond(-shift[0])]), [10, 12, 3, 1, 3], vec![0.25, 0.75, 0.75]);
    check_boolean(&a, "A & B", 0.25);
    check_boolean(&a, "A | B", 1.75);
    check_boolean(&a, "A ^ B", 1.5);
    check_boolean(&a, "A - B", 0.75);
}

#[test]
fn a_square_with_two_holes() {
    let squares =
        regions(&[square(1.0, 0.0, [0.0; 2]), square(0.25, 0.0, [0.175; 2]), square(0.25, 0.0, [0.575; 2])]);
    let a = check(&squares, [12, 12, 3, 3, 5], vec![0.875, 0.0625, 0.0625]);
    let outer = (1..=3).map(FaceId).find(|&f| a.face_vertices(f).len() == 3).expect("a face with two holes");
    assert!((a.area(outer) - 0.875).abs() < SNAPPED);
}

#[test]
fn a_square_crossed_by_two_lines_around_a_free_square() {
    // Two lines through σ that do not meet inside it cut it in three; the free square lies in the middle part.
    let mut drawing = regions(&[square(4.0, 0.0, [0.0; 2]), square(1.0, 0.0, [1.5; 2])]);
    for [x, y] in [[1.0, -1.0], [1.0, 5.0], [3.0, -1.0], [3.0, 5.0]] {
        drawing.push_point([x, y]);
    }
    drawing.push_segment([8, 9]);
    drawing.push_segment([10, 11]);
    check(&drawing, [12, 14, 4, 2, 5], vec![4.0, 7.0, 4.0, 1.0]);
}

#[test]
fn one_square_is_one_face_and_nothing_is_the_exterior() {
    check(&regions(&[square(2.0, 0.3, [5.0, 7.0])]), [4, 4, 1, 1, 1], vec![4.0]);
    check(&Drawing::new(Points::new(2)), [0; 5], Vec::new());
    check(&Drawing::from_segments(&[[1.0, 1.0, 1.0, 1.0]]), [0; 5], Vec::new());
    check(&Drawing::from_segments(&[[0.0, 0.0, 1.0, 1.0]]), [0; 5], Vec::new());
}

#[test]
fn threads_do_not_change_the_bytes() {
    let random = &mut crate::common::Random(3);
    let segments: Vec<[f64; 4]> = (0..400).map(|_| [(); 4].map(|()| random.between(0.0, 1.0))).collect();
    let drawing = Drawing::from_segments(&segments);
    let json = |threads: usize, dangling| {
        let threads = NonZeroUsize::new(threads).expect("at least one");
        let a =
            PlanarArranger::new().threads(threads).dangling(dangling).arrange(&drawing).expect("well formed");
        a.complex().to_json().expect("a complex")
    };
    for dangling in [Dangling::Drop, Dangling::Keep] {
        let one = json(1, dangling);
        assert!(one.len() > 100_000);
        assert!([2, 7].into_iter().all(|threads| json(threads, dangling) == one));
    }
}

#[track_caller]
fn check_refused(drawing: &Drawing, message: &str) {
    let refused = PlanarArranger::new().arrange(drawing).expect_err(message);
    assert_eq!(refused.to_string(), message);
}

#[test]
fn malformed_drawings_are_refused() {
    let mut far = Drawing::from_segments(&[[0.0, 0.0, 1.0, 1.0]]);
    far.push_segment([1, 2]);
    check_refused(&far, "segment 1 names point v2, but there are 2 points");
    for (x, name) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf"), (f64::NEG_INFINITY, "-inf")] {
        let drawing = Drawing::from_segments(&[[0.0, 0.0, 1.0, x]]);
        check_refused(&drawing, &format!("drawing: vertex v1 has the coordinate {name}"));
    }
    for dim in [0, 1, 3] {
        let mut drawing = Drawing::new(Points::new(dim));
        drawing.push_polygon("A", &[vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], Vec::new()]);
        let message = format!("points of {dim} coordinates, a planar arrangement needs 2");
        check_refused(&drawing, &message);
        let within = PlanarArranger::new().arrange_within(&drawing, &[Vec::new()]);
        assert_eq!(within.expect_err("not planar").to_string(), message);
    }
}

#[test]
fn polygons_without_an_inside_bound_nothing() {
    let mut drawing = Drawing::new(Points::new(2));
    drawing.push_polygon("A", &[vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], vec![[5.0, 5.0]], Vec::new()]);
    drawing.push_polygon("B", &[]);
    let a = check(&drawing, [0; 5], Vec::new());
    check_boolean(&a, "A | B", 0.0);
}
