//! Faces: closed forms, hard shapes, loops broken by rounding, garbage.

mod common;

use common::{Polygon, Random, check_combinatorial, check_proper, comb, radial, sieve, spiral};
use lar_core::{Points, VertexId};
use lar_triangle::{Quality, TriangulateError, check_laws, triangulate_face};
use proptest::prelude::*;

#[track_caller]
fn check(xy: &[[f64; 2]], expected: &[[u32; 3]]) {
    let polygon = Polygon::default().with(xy.iter().copied());
    assert_eq!(check_proper(&polygon), expected);
}

#[test]
fn three_and_four_corners() {
    check(&[[0., 0.], [1., 0.], [0., 1.]], &[[0, 1, 2]]);
    // Four corners on a circle: the diagonal at the smallest index.
    check(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]], &[[0, 1, 2], [0, 2, 3]]);
    // The short diagonal of a flat rhombus, whichever way it lies.
    check(&[[0., 0.], [2., -1.], [4., 0.], [2., 1.]], &[[0, 1, 3], [1, 2, 3]]);
    check(&[[2., -1.], [4., 0.], [2., 1.], [0., 0.]], &[[0, 1, 2], [0, 2, 3]]);
    // Not convex: the only diagonal.
    check(&[[0., 0.], [4., 0.], [1., 1.], [0., 4.]], &[[0, 1, 2], [0, 2, 3]]);
    check(&[[0., 4.], [0., 0.], [4., 0.], [1., 1.]], &[[0, 1, 3], [1, 2, 3]]);
    // A flat corner.
    check(&[[0., 0.], [1., 0.], [2., 0.], [0., 2.]], &[[0, 1, 3], [1, 2, 3]]);
}

#[test]
fn cocircular_corners_fan_from_the_smallest_index() {
    // Twelve points with integer coordinates on the circle of radius 5.
    let circle = [
        [5., 0.],
        [4., 3.],
        [3., 4.],
        [0., 5.],
        [-3., 4.],
        [-4., 3.],
        [-5., 0.],
        [-4., -3.],
        [-3., -4.],
        [0., -5.],
        [3., -4.],
        [4., -3.],
    ];
    let fan: Vec<[u32; 3]> = (1..11).map(|i| [0, i, i + 1]).collect();
    check(&circle, &fan);
}

#[test]
fn the_result_does_not_depend_on_where_the_loop_starts() {
    for polygon in [comb(5), spiral(2, 9), comb(40)] {
        let points = polygon.points();
        let expected = check_proper(&polygon);
        let mut cycle = polygon.loops[0].clone();
        for _ in 0..cycle.len() {
            cycle.rotate_left(1);
            assert_eq!(triangulate_face(&points, &[&cycle]).as_ref(), Ok(&expected));
        }
    }
}

#[test]
fn shapes() {
    for n in [5, 16, 64, 65, 200, 1001] {
        check_proper(&Polygon::default().with(radial(n, [0.0, 0.0], false, |_| 1.0)));
        check_proper(
            &Polygon::default().with(radial(
                2 * n,
                [3.0, -7.0],
                false,
                |i| if i % 2 == 0 { 9.0 } else { 1.0 },
            )),
        );
    }
    for teeth in [1, 3, 20, 21, 22, 500] {
        check_proper(&comb(teeth));
    }
    for turns in [1, 2, 5, 40] {
        check_proper(&spiral(turns, 12));
        check_proper(&spiral(turns, 57));
    }
}

#[test]
fn holes() {
    for k in [1, 2, 3, 17] {
        let triangles = check_proper(&sieve(k));
        assert_eq!(triangles.len(), 4 + 4 * k * k + 2 * k * k - 2);
    }
    let ring = Polygon::default().with(radial(50, [0.0, 0.0], false, |i| 4.0 + (i % 3) as f64)).with(radial(
        31,
        [0.0, 0.0],
        true,
        |i| 1.0 + (i % 2) as f64,
    ));
    assert_eq!(check_proper(&ring).len(), 81);
}

/// ```text
/// 3-------2     A hole that hangs on a corner of the outer loop (n = 7, one loop in effect: 5 triangles),
/// | 5---4 |     given as a loop of its own, or as part of the outer loop.
/// |  \ /  |
/// 0---6---1
/// ```
#[test]
fn loops_that_touch_in_a_point() {
    let xy = vec![[0., 0.], [4., 0.], [4., 4.], [0., 4.], [3., 3.], [1., 3.], [2., 0.]];
    let two = Polygon { xy: xy.clone(), loops: vec![vec![0, 6, 1, 2, 3], vec![6, 5, 4]] };
    let one = Polygon { xy: xy.clone(), loops: vec![vec![0, 6, 5, 4, 6, 1, 2, 3]] };
    assert_eq!(check_proper(&two).len(), 6);
    assert_eq!(check_proper(&two), check_proper(&one));
    // Two holes that touch each other: they count as one.
    let xy = vec![[0., 0.], [9., 0.], [9., 9.], [0., 9.], [4., 4.], [2., 3.], [2., 5.], [6., 5.], [6., 3.]];
    let holes = Polygon { xy, loops: vec![vec![0, 1, 2, 3], vec![4, 5, 6], vec![4, 7, 8]] };
    assert_eq!(check_proper(&holes).len(), 10);
    // A slit, walked in both directions, is kept as an edge.
    let xy = vec![[0., 0.], [4., 0.], [4., 4.], [0., 4.], [1., 1.], [2., 2.]];
    let slit = Polygon { xy, loops: vec![vec![0, 4, 5, 4, 0, 1, 2, 3]] };
    let triangles = check_proper(&slit);
    assert!(triangles.iter().any(|t| t.contains(&4) && t.contains(&5)));
}

#[test]
fn extreme_magnitudes() {
    for scale in [1e-320, 1e-300, 1e-60, 1e60, 1e150, 1e300, f64::MAX / 100.0] {
        let mut polygon = sieve(2);
        polygon.xy.as_flattened_mut().iter_mut().for_each(|x| *x *= scale);
        // Below the smallest normal number the positions themselves are rounded, but still distinct.
        assert_eq!(
            check_combinatorial(&polygon.points(), &polygon.loop_slices()),
            Quality::Proper,
            "{scale:e}"
        );
    }
    let mixed =
        Polygon::default().with([[0., 0.], [1e-310, 0.], [1e300, 1e-310], [1e300, 1e300], [-1e-200, 1e250]]);
    check_combinatorial(&mixed.points(), &mixed.loop_slices());
}

#[test]
fn tilted_faces_have_the_triangles_of_the_plane() {
    for polygon in [comb(7), spiral(3, 20), sieve(3)] {
        for offset in [0.0, 1.0, 1e4] {
            let points = polygon.lifted(offset);
            assert_eq!(check_combinatorial(&points, &polygon.loop_slices()), Quality::Proper);
        }
        // Seen from behind, in the plane: clockwise loops stay clockwise.
        let mut mirrored = polygon.clone();
        mirrored.xy.iter_mut().for_each(|p| p[0] = -p[0]);
        assert_eq!(check_combinatorial(&mirrored.points(), &mirrored.loop_slices()), Quality::Proper);
    }
}

#[track_caller]
fn check_broken(xy: &[[f64; 2]], holes: &[&[u32]]) {
    let n = holes.iter().flat_map(|h| h.iter().copied()).min().unwrap_or(xy.len() as u32);
    let outer: Vec<u32> = (0..n).collect();
    let loops: Vec<&[u32]> = std::iter::once(&outer[..]).chain(holes.iter().copied()).collect();
    let points = Points::from_columns(2, xy.as_flattened().to_vec());
    assert_eq!(check_combinatorial(&points, &loops), Quality::Combinatorial);
}

#[test]
fn loops_broken_by_rounding() {
    // A spike: out and back along one line.
    check_broken(&[[0., 0.], [4., 0.], [8., 0.], [4., 0.], [4., 4.]], &[]);
    // All on one line; all in one point.
    check_broken(&[[0., 0.], [1., 0.], [2., 0.], [3., 0.], [1., 0.]], &[]);
    check_broken(&[[0., 0.]; 4], &[]);
    check_broken(&[[0., 0.]; 9], &[&[6, 7, 8]]);
    // A crossing: a corner has moved through the opposite edge.
    check_broken(&[[0., 0.], [4., 0.], [4., 2.], [2., -1e-9], [0., 2.]], &[]);
    // A corner on the opposite edge.
    check_broken(&[[0., 0.], [4., 0.], [4., 2.], [2., 0.], [0., 2.]], &[]);
    // A hole that sticks out by one rounding; a hole on the border; a hole outside.
    let square = [[0., 0.], [4., 0.], [4., 4.], [0., 4.]];
    check_broken(&[&square[..], &[[4.000_000_1, 1.], [3., 1.], [3., 2.]]].concat(), &[&[4, 5, 6]]);
    check_broken(&[&square[..], &[[4., 1.], [3., 1.], [3., 2.]]].concat(), &[&[4, 5, 6]]);
    check_broken(&[&square[..], &[[7., 1.], [6., 1.], [6., 2.]]].concat(), &[&[4, 5, 6]]);
    // Two holes that overlap.
    let two = [[1., 1.], [1., 3.], [2., 2.], [1.5, 1.], [1.5, 3.], [3., 2.]];
    check_broken(&[&square[..], &two].concat(), &[&[4, 5, 6], &[7, 8, 9]]);
}

#[test]
fn not_finite_positions_are_no_obstacle() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut polygon = sieve(2);
        polygon.xy[1][0] = bad;
        polygon.xy[7][1] = bad;
        check_combinatorial(&polygon.points(), &polygon.loop_slices());
    }
}

#[test]
fn malformed_loops() {
    let points = sieve(1).points();
    let refused = |loops: &[&[u32]]| triangulate_face(&points, loops).expect_err("malformed");
    assert_eq!(refused(&[&[0, 1, 8]]), TriangulateError::NoSuchVertex { vertex: VertexId(8), points: 8 });
    assert_eq!(refused(&[&[0, 1, 2], &[4, 5]]), TriangulateError::ShortLoop { index: 1, corners: 2 });
    assert_eq!(refused(&[&[]]), TriangulateError::ShortLoop { index: 0, corners: 0 });
    assert_eq!(triangulate_face(&points, &[]), Ok(Vec::new()));
    let line = Points::from_columns(1, vec![0.0, 1.0, 2.0]);
    let error = triangulate_face(&line, &[&[0, 1, 2]]).expect_err("one coordinate");
    assert_eq!(error.to_string(), "points have 1 coordinates, the triangulation takes 2 or 3");
}

/// A random star-shaped polygon around the origin with holes that are smaller copies of stars inside it.
fn star_with_holes() -> impl Strategy<Value = Polygon> {
    (3usize..40, 0usize..5, any::<u64>()).prop_map(|(n, holes, seed)| {
        let mut random = Random(seed | 1);
        let radii: Vec<f64> = (0..n).map(|_| 2.0 + 3.0 * random.next()).collect();
        let mut polygon = Polygon::default().with(radial(n, [0.0, 0.0], false, |i| radii[i]));
        let inner = 0.9 * 2.0 * (std::f64::consts::PI / n as f64).cos();
        for h in 0..holes {
            let corners = 3 + (random.next() * 9.0) as usize;
            let angle = std::f64::consts::TAU * h as f64 / holes as f64;
            let centre = [inner * 0.6 * angle.cos(), inner * 0.6 * angle.sin()];
            let size = inner * 0.3;
            let radii: Vec<f64> = (0..corners).map(|_| size * (0.3 + 0.7 * random.next())).collect();
            polygon = polygon.with(radial(corners, centre, true, |i| radii[i]));
        }
        polygon
    })
}

/// Sizes of loops, small or large enough for every way to triangulate.
fn sizes() -> impl Strategy<Value = Vec<usize>> {
    prop::collection::vec(prop_oneof![9 => 3usize..9, 1 => 50usize..100], 1..5)
}

/// Loops over points of a coarse grid, so that coincidences and collinearities abound, or of a fine one, so that edges cross.
fn garbage() -> impl Strategy<Value = (Vec<[f64; 3]>, Vec<usize>)> {
    (sizes(), prop_oneof![0i32..6, Just(10_000)]).prop_flat_map(|(sizes, spread)| {
        let x = (-spread..=spread).prop_map(f64::from);
        (prop::collection::vec(prop::array::uniform3(x), sizes.iter().sum::<usize>()), Just(sizes))
    })
}

/// Loops over coordinates of very different magnitude, many of them almost equal.
fn wild() -> impl Strategy<Value = (Vec<[f64; 3]>, Vec<usize>)> {
    let values = vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        1.0 + f64::EPSILON,
        1.0 - f64::EPSILON,
        0.1 + 0.2,
        0.3,
        1e-16,
        -1e-16,
        1e-43,
        2e-43,
        1e-60,
        -1e-300,
        1e60,
        1e300,
        f64::MAX,
        f64::MIN,
        f64::MIN_POSITIVE,
        5e-324,
        f64::NAN,
        f64::INFINITY,
    ];
    // The first values are tame; the more are used, the wilder.
    (sizes(), 1..=values.len()).prop_flat_map(move |(sizes, used)| {
        let x = prop::sample::select(values[..used].to_vec());
        (prop::collection::vec(prop::array::uniform3(x), sizes.iter().sum::<usize>()), Just(sizes))
    })
}

#[track_caller]
fn check_garbage(xyz: &[[f64; 3]], sizes: &[usize]) {
    let mut cycles: Vec<Vec<u32>> = Vec::new();
    let mut first = 0;
    for &size in sizes {
        cycles.push((first..first + size as u32).collect());
        first += size as u32;
    }
    let loops: Vec<&[u32]> = cycles.iter().map(Vec::as_slice).collect();
    check_combinatorial(&Points::from_xyz(xyz), &loops);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_polygons_with_holes(polygon in star_with_holes()) {
        check_proper(&polygon);
        prop_assert_eq!(check_combinatorial(&polygon.lifted(1.0), &polygon.loop_slices()), Quality::Proper);
    }

    #[test]
    fn garbage_obeys_the_laws((xyz, sizes) in garbage()) {
        check_garbage(&xyz, &sizes);
    }

    #[test]
    fn wild_magnitudes_obey_the_laws((xyz, sizes) in wild()) {
        check_garbage(&xyz, &sizes);
    }

    #[test]
    fn loops_that_repeat_points_keep_their_boundary(
        xy in prop::collection::vec((0..4, 0..4), 6),
        cycles in prop::collection::vec(prop::collection::vec(0u32..6, 3..8), 1..4),
    ) {
        let points = Points::from_columns(2, xy.iter().flat_map(|&(x, y)| [f64::from(x), f64::from(y)]).collect());
        let loops: Vec<&[u32]> = cycles.iter().map(Vec::as_slice).collect();
        let triangles = triangulate_face(&points, &loops).expect("well-formed");
        prop_assert_eq!(boundary(triangles.iter().map(|t| &t[..])), boundary(loops.iter().copied()));
    }
}

/// The 1-chain of some cycles: coefficient of each edge from a smaller to a larger index.
fn boundary<'a>(cycles: impl Iterator<Item = &'a [u32]>) -> Vec<((u32, u32), i32)> {
    let mut chain = std::collections::BTreeMap::new();
    for cycle in cycles {
        for (i, &from) in cycle.iter().enumerate() {
            let to = cycle[(i + 1) % cycle.len()];
            *chain.entry((from.min(to), from.max(to))).or_insert(0) += if from < to { 1 } else { -1 };
        }
    }
    chain.into_iter().filter(|&((a, b), c)| a != b && c != 0).collect()
}

#[test]
fn the_laws_can_fail() {
    let loops: [&[u32]; 2] = [&[0, 1, 2, 3], &[4, 5, 6]];
    let polygon = Polygon {
        xy: vec![[0., 0.], [9., 0.], [9., 9.], [0., 9.], [3., 3.], [3., 5.], [5., 3.]],
        loops: loops.iter().map(|l| l.to_vec()).collect(),
    };
    let triangles = check_proper(&polygon);
    assert!(check_laws(loops, &triangles[1..]).is_err());
    let mut turned = triangles.clone();
    turned[0].swap(0, 1);
    insta::assert_snapshot!(check_laws(loops, &turned).expect_err("turned over"));
    let mut doubled = triangles;
    doubled[0] = doubled[1];
    insta::assert_snapshot!(check_laws(loops, &doubled).expect_err("twice the same"));
}
