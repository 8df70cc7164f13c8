//! Delaunay triangulations of points and of closed drawings.

mod common;

use common::{Polygon, Random, comb, radial, sieve, spiral, triangle_area};
use lar_core::{EdgeId, Points, VertexId};
use lar_triangle::{TriangulateError, delaunay, triangulate_face, triangulate2d};
use proptest::prelude::*;

#[track_caller]
fn check(xy: &[[f64; 2]], expected: &[[u32; 3]]) {
    let points = Points::from_columns(2, xy.as_flattened().to_vec());
    assert_eq!(delaunay(&points).as_deref(), Ok(expected));
}

#[test]
fn few_points() {
    check(&[], &[]);
    check(&[[1., 1.]; 5], &[]);
    check(&[[0., 0.], [1., 1.], [2., 2.], [5., 5.]], &[]);
    check(&[[0., 0.], [1., 0.], [0., 1.]], &[[0, 1, 2]]);
    check(&[[0., 1.], [1., 0.], [0., 0.]], &[[0, 2, 1]]);
    // Duplicates (and −0) give way to the smallest index.
    check(&[[0., 0.], [1., 0.], [-0.0, 0.], [0., 1.], [1., 0.]], &[[0, 1, 3]]);
    check(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]], &[[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn a_grid_of_points_takes_every_diagonal_at_the_smallest_index() {
    let (rows, columns) = (30u32, 40u32);
    let xy = (0..rows).flat_map(|y| (0..columns).map(move |x| [f64::from(x), f64::from(y)]));
    let points = Points::from_columns(2, xy.flatten().collect());
    let mut expected = Vec::new();
    for y in 0..rows - 1 {
        for x in 0..columns - 1 {
            let i = y * columns + x;
            expected.extend([[i, i + 1, i + columns + 1], [i, i + columns + 1, i + columns]]);
        }
    }
    expected.sort_unstable();
    assert_eq!(delaunay(&points), Ok(expected));
}

#[test]
fn not_finite_or_not_planar_points_are_refused() {
    let points = Points::from_columns(2, vec![0., 0., 1., f64::INFINITY]);
    let error = TriangulateError::NotFinite { vertex: VertexId(1), value: f64::INFINITY };
    assert_eq!(delaunay(&points), Err(error));
    let space = Points::from_xyz(&[[0.; 3]]);
    assert_eq!(delaunay(&space), Err(TriangulateError::Dimension { found: 3, expected: "2" }));
}

/// The edges of a polygon, each in either direction.
fn edges(polygon: &Polygon) -> Vec<[u32; 2]> {
    let mut random = Random(7);
    let of_loop = |l: &Vec<u32>| (0..l.len()).map(|i| [l[i], l[(i + 1) % l.len()]]).collect::<Vec<_>>();
    let all = polygon.loops.iter().flat_map(of_loop);
    all.map(|[a, b]| if random.next() < 0.5 { [a, b] } else { [b, a] }).collect()
}

#[test]
fn drawings_have_the_triangles_of_the_face_that_they_bound() {
    let star = Polygon::default().with(radial(30, [0.0, 0.0], false, |i| if i % 2 == 0 { 4.0 } else { 1.5 }));
    for polygon in [comb(4), comb(60), spiral(2, 11), sieve(1), sieve(8), star] {
        let points = polygon.points();
        let expected = triangulate_face(&points, &polygon.loop_slices());
        assert_eq!(triangulate2d(&points, &edges(&polygon)), expected);
    }
}

#[test]
fn drawings_that_are_refused() {
    let points = Points::from_columns(2, vec![0., 0., 2., 0., 2., 2., 0., 2., 1., 0.]);
    let refused = |edges: &[[u32; 2]]| triangulate2d(&points, edges).expect_err("malformed");
    let crossing = |edge, from, to| TriangulateError::CrossingEdge {
        edge: EdgeId(edge),
        from: VertexId(from),
        to: VertexId(to),
    };
    assert_eq!(refused(&[[0, 2], [2, 1], [1, 3], [3, 0]]), crossing(2, 1, 3));
    assert_eq!(refused(&[[0, 1], [1, 2], [2, 3], [3, 0]]), crossing(0, 0, 1));
    assert_eq!(refused(&[[0, 4], [4, 2]]), TriangulateError::OpenBoundary { vertex: VertexId(0), degree: 1 });
    assert_eq!(refused(&[[0, 5]]), TriangulateError::NoSuchVertex { vertex: VertexId(5), points: 5 });
    assert_eq!(triangulate2d(&points, &[]), Ok(Vec::new()));
}

/// Small integers, and now and then numbers of extreme or almost equal magnitude.
fn coordinate() -> impl Strategy<Value = f64> {
    let extreme = vec![1e-43, -2e-43, 1e-16, 1.0 + f64::EPSILON, 1e-300, 1e300, -1e60, f64::MAX, 5e-324];
    prop_oneof![9 => (-4i32..5).prop_map(f64::from), 1 => prop::sample::select(extreme)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    /// Any drawing is triangulated or refused; the triangles of the accepted ones turn counter-clockwise.
    #[test]
    fn any_drawing_is_triangulated_or_refused(
        xy in prop::collection::vec(prop::array::uniform2(coordinate()), 3..30),
        cycles in prop::collection::vec(prop::collection::vec(0u32..30, 2..6), 0..4),
    ) {
        let points = Points::from_columns(2, xy.as_flattened().to_vec());
        let edges = |l: &Vec<u32>| (0..l.len()).map(|i| [l[i], l[(i + 1) % l.len()]]).collect::<Vec<_>>();
        let edges: Vec<[u32; 2]> = cycles.iter().flat_map(edges).collect();
        for result in [delaunay(&points), triangulate2d(&points, &edges)] {
            for t in result.unwrap_or_default() {
                prop_assert!(t.iter().all(|&i| (i as usize) < xy.len()));
                // Far apart magnitudes may underflow here, not in the predicates.
                prop_assert!(triangle_area(&points, t) >= 0.0 || xy.as_flattened().iter().any(|x| x.abs() > 1e9));
            }
        }
    }

    /// The circle through the corners of each triangle is empty, and the triangles tile the convex hull.
    #[test]
    fn circles_are_empty(raw in prop::collection::vec((-20i32..20, -20i32..20), 3..60)) {
        let points = Points::from_columns(2, raw.iter().flat_map(|&(x, y)| [f64::from(x), f64::from(y)]).collect());
        let triangles = delaunay(&points).expect("finite");
        for &t in &triangles {
            for &p in &raw {
                prop_assert!(incircle(t.map(|i| raw[i as usize]), p) <= 0);
            }
        }
        let area: f64 = triangles.iter().map(|&t| triangle_area(&points, t)).sum();
        prop_assert_eq!(area, hull_area(&raw));
        prop_assert!(triangles.iter().all(|&t| triangle_area(&points, t) > 0.0));
    }
}

fn incircle(t: [(i32, i32); 3], p: (i32, i32)) -> i64 {
    let [a, b, c] = t.map(|q| {
        let (x, y) = (i64::from(q.0 - p.0), i64::from(q.1 - p.1));
        [x, y, x * x + y * y]
    });
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Area of the convex hull, by a monotone chain.
fn hull_area(raw: &[(i32, i32)]) -> f64 {
    let mut sorted = raw.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    let cross =
        |o: (i32, i32), a: (i32, i32), b: (i32, i32)| (a.0 - o.0) * (b.1 - o.1) - (a.1 - o.1) * (b.0 - o.0);
    let half = |points: &mut dyn Iterator<Item = (i32, i32)>| {
        let mut chain: Vec<(i32, i32)> = Vec::new();
        for p in points {
            while chain.len() >= 2 && cross(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0 {
                chain.pop();
            }
            chain.push(p);
        }
        chain.windows(2).map(|w| w[0].0 * w[1].1 - w[0].1 * w[1].0).sum::<i32>()
    };
    f64::from(half(&mut sorted.iter().copied()) + half(&mut sorted.iter().rev().copied())) / 2.0
}
