//! Many segments, in arrangements whose counts are known in closed form; a quadratic step would show.

use crate::check::arranged;
use lar_arrangement::planar::{Dangling, Drawing, PlanarArrangement, PlanarArranger};
use lar_core::{FaceId, Points};
use std::num::NonZeroUsize;

/// Vertices, edges, bounded faces, components.
#[track_caller]
fn check(a: &PlanarArrangement, expected: [usize; 4]) {
    assert_eq!([a.n_vertices(), a.n_edges(), a.n_faces(), a.n_components()], expected);
    assert_eq!((a.euler(), a.complex().validate_with_exterior()), (0, Vec::new()));
}

fn of(segments: &[[f64; 4]], dangling: Dangling) -> PlanarArrangement {
    arranged(&Drawing::from_segments(segments), dangling)
}

fn square([x, y]: [f64; 2], side: f64) -> [[f64; 4]; 4] {
    [
        [x, y, x + side, y],
        [x + side, y, x + side, y + side],
        [x + side, y + side, x, y + side],
        [x, y + side, x, y],
    ]
}

#[test]
fn ten_thousand_through_one_grid_point() {
    let n = 10_000;
    let star: Vec<[f64; 4]> =
        (0..n).map(|i| f64::from(i - n / 2)).map(|a| [-a, -10_007.0, a, 10_007.0]).collect();
    check(&of(&star, Dangling::Keep), [20_001, 20_000, 0, 1]);
    check(&of(&star, Dangling::Drop), [0; 4]);
}

/// Segments from a point at a quarter turn or less from each other, at slopes (k + 1) / n.
fn fan(n: i32, [x, y]: [f64; 2], reach: f64) -> impl Iterator<Item = [f64; 4]> {
    (1..=n).map(move |k| [x, y, x + reach, y + reach * f64::from(k) / f64::from(n)])
}

/// A number of pairs that grows like n log n, not like n².
#[track_caller]
fn check_pairs(a: &PlanarArrangement, n_segments: usize) {
    let pairs = a.stats().pairs_tested;
    assert!(pairs < 100 * n_segments as u64, "{pairs} pairs of {n_segments} segments");
}

#[test]
fn pairs_through_one_point_are_passed_over() {
    let n = 8192;
    let at = |k: i32| f64::from(k - n / 2) + 0.5;
    let star: Vec<[f64; 4]> = (0..n).map(at).map(|a| [-a, -10_007.0, a, 10_007.0]).collect();
    let a = of(&star, Dangling::Keep);
    check(&a, [2 * n as usize + 1, 2 * n as usize, 0, 1]);
    check_pairs(&a, star.len());

    let one_fan: Vec<[f64; 4]> = fan(n, [3.0, 5.0], 1024.0).collect();
    let a = of(&one_fan, Dangling::Keep);
    check(&a, [n as usize + 1, n as usize, 0, 1]);
    check_pairs(&a, one_fan.len());

    // A star and a fan in one point, and a square around them.
    let mixed: Vec<[f64; 4]> = star
        .iter()
        .copied()
        .chain(fan(n, [0.0; 2], 1024.0))
        .chain(square([-20_000.0; 2], 40_000.0))
        .collect();
    let a = of(&mixed, Dangling::Keep);
    check(&a, [3 * n as usize + 1 + 4, 3 * n as usize + 4, 1, 2]);
    check_pairs(&a, mixed.len());
}

#[test]
fn many_stars_far_apart() {
    let star = |i: i32| {
        let (x, y) = (f64::from(300 * (i % 20)), f64::from(300 * (i / 20)));
        (1..=99).map(f64::from).map(move |k| [x - 100.0, y - k, x + 100.0, y + k])
    };
    let all: Vec<[f64; 4]> = (0..400).flat_map(star).collect();
    check(&of(&all, Dangling::Keep), [400 * 199, 400 * 198, 0, 400]);
}

#[test]
fn threads_do_not_change_the_bytes_of_bundles() {
    let random = &mut crate::common::Random(5);
    let mut segments: Vec<[f64; 4]> =
        (0..3000).map(|_| [(); 4].map(|()| random.between(-500.0, 500.0))).collect();
    segments.extend(fan(1000, [0.0; 2], 300.0).chain(fan(1000, [-250.0, 125.0], -200.0)));
    segments.extend((1..1000).map(f64::from).map(|k| [-300.0, -0.3 * k, 300.0, 0.3 * k]));
    let drawing = Drawing::from_segments(&segments);
    let written = |threads: usize| {
        let threads = NonZeroUsize::new(threads).expect("at least one");
        let arranger = PlanarArranger::new().threads(threads).dangling(Dangling::Keep);
        let a = arranger.arrange(&drawing).expect("well formed");
        let faces: Vec<Vec<u32>> =
            (0..=a.n_faces() as u32).flat_map(|f| a.face_vertices(FaceId(f))).collect();
        let edges: Vec<_> = (0..segments.len()).flat_map(|i| a.edges_of(i)).collect();
        (a.complex().points().clone(), faces, edges)
    };
    let one = written(1);
    assert!(one.1.len() > 100_000, "{} faces", one.1.len());
    assert!([2, 5].into_iter().all(|threads| written(threads) == one));
}

#[test]
fn ten_thousand_through_one_point_between_grid_points() {
    // All pass through (1/3, 1/3), with a and b of the form 3k + 1.
    let b = 30_001.0;
    let star: Vec<[f64; 4]> = (-5000..5000)
        .map(|k| f64::from(3 * k + 1))
        .map(|a| [(1.0 - a) / 3.0, (1.0 - b) / 3.0, (1.0 + 2.0 * a) / 3.0, (1.0 + 2.0 * b) / 3.0])
        .collect();
    let a = of(&star, Dangling::Keep);
    check(&a, [20_001, 20_000, 0, 1]);
    let third = 1.0 / 3.0;
    assert_eq!(a.complex().points().iter().filter(|p| *p == [third, third]).count(), 1);
}

#[test]
fn twenty_stars_of_five_hundred() {
    // One above the other, too far apart to meet: nearly vertical rays of length 2.
    let star = |i: i32| {
        (0..500).map(move |k| {
            let (x, y) = (f64::from(k + 1) / 64.0, f64::from(40 * i));
            [-x, y - 1.0, x, y + 1.0]
        })
    };
    let all: Vec<[f64; 4]> = (0..20).flat_map(star).collect();
    check(&of(&all, Dangling::Keep), [20 * 1001, 20 * 1000, 0, 20]);
}

#[test]
fn ten_thousand_overlapping_on_a_line() {
    for [dx, dy] in [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [-3.0, 7.0]] {
        let at = |k: i32| [f64::from(k) * dx, f64::from(k) * dy];
        let segments: Vec<[f64; 4]> =
            (0..10_000).map(|k| (at(k), at(k + 5000))).map(|([x, y], [z, w])| [x, y, z, w]).collect();
        let a = of(&segments, Dangling::Keep);
        check(&a, [15_000, 14_999, 0, 1]);
        assert_eq!(a.edges_of(7777).count(), 5000);
    }
}

#[test]
fn four_hundred_lines_in_a_grid() {
    let line = |k: i32| [[f64::from(k), 0.0, f64::from(k), 201.0], [0.0, f64::from(k), 201.0, f64::from(k)]];
    let segments: Vec<[f64; 4]> = (1..=200).flat_map(line).collect();
    check(&of(&segments, Dangling::Keep), [200 * 200 + 800, 2 * 200 * 201, 199 * 199, 1]);
    let a = of(&segments, Dangling::Drop);
    check(&a, [200 * 200, 2 * 200 * 199, 199 * 199, 1]);
    assert!((1..=a.n_faces() as u32).all(|f| a.area(FaceId(f)) == 1.0));
}

#[test]
fn a_brick_wall_of_t_junctions() {
    let n = 100;
    let mut segments: Vec<[f64; 4]> = (0..=n).map(|y| [0.0, f64::from(y), 200.0, f64::from(y)]).collect();
    for y in 0..n {
        let joints = (0..=100).map(|x| f64::from(2 * x + y % 2)).filter(|&x| x <= 200.0);
        segments.extend(joints.map(|x| [x, f64::from(y), x, f64::from(y) + 1.0]));
    }
    for y in (0..n).filter(|y| y % 2 == 1) {
        segments.extend([0.0, 200.0].map(|x| [x, f64::from(y), x, f64::from(y) + 1.0]));
    }
    // An even row has 100 bricks, an odd one 99 and two halves. Inner lines have a joint at each integer.
    let n_vertices = 99 * 201 + 101 + 102;
    let n_edges = (99 * 200 + 100 + 101) + 50 * 101 + 50 * 102;
    check(&of(&segments, Dangling::Drop), [n_vertices, n_edges, 50 * 100 + 50 * 101, 1]);
}

#[test]
fn a_hundred_thousand_short_ones() {
    let random = &mut crate::common::Random(4);
    let segments: Vec<[f64; 4]> = (0..100_000)
        .map(|_| {
            let (x, y) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
            [x, y, x + random.between(-0.005, 0.005), y + random.between(-0.005, 0.005)]
        })
        .collect();
    let kept = of(&segments, Dangling::Keep);
    assert_eq!((kept.euler(), kept.complex().validate_with_exterior()), (0, Vec::new()));
    // Every crossing adds a vertex and two edges.
    assert_eq!(kept.n_edges() - 100_000, 2 * (kept.n_vertices() - 200_000));
    let dropped = of(&segments, Dangling::Drop);
    assert_eq!(dropped.n_faces(), kept.n_faces());
    let areas = |a: &PlanarArrangement| (1..=a.n_faces() as u32).map(|f| a.area(FaceId(f))).sum::<f64>();
    assert!((areas(&kept) - areas(&dropped)).abs() < 1e-9);
}

#[test]
fn a_thousand_nested_squares() {
    let at = |k: i32| f64::from(k);
    let segments: Vec<[f64; 4]> =
        (0..1000).flat_map(|k| square([at(k), at(k)], at(2 * (1000 - k)))).collect();
    let a = of(&segments, Dangling::Drop);
    check(&a, [4000, 4000, 1000, 1000]);
    assert_eq!(a.n_loops(), 1999);
    let mut areas: Vec<f64> = (1..=1000).map(|f| a.area(FaceId(f))).collect();
    areas.sort_by(f64::total_cmp);
    // Rings between squares of sides 2m and 2m − 2.
    assert!(areas.iter().zip(1..).all(|(&area, m)| area == f64::from(4 * (2 * m - 1))));
}

/// n unit squares in one row, a gap of one between neighbours.
fn row(n: i32) -> Drawing {
    let mut out = Drawing::new(Points::new(2));
    for k in 0..n {
        let corners = square([f64::from(2 * k), 0.0], 1.0).map(|s| [s[0], s[1]]);
        out.push_polygon(format!("square {k}"), &[corners.to_vec()]);
    }
    out
}

// Regression 1: locating a component looked at all horizontal edges to its left, 72 seconds.
#[test]
fn a_hundred_thousand_disjoint_squares_in_one_row() {
    let a = arranged(&row(100_000), Dangling::Drop);
    check(&a, [400_000, 400_000, 100_000, 100_000]);
}

// Regression 2: the edges of a segment were searched for along its whole line, 14 seconds.
#[test]
fn a_hundred_thousand_touching_regions_in_one_row() {
    let mut drawing = Drawing::new(Points::new(2));
    for k in 0..100_000 {
        let corners = square([f64::from(k), 0.0], 1.0).map(|s| [s[0], s[1]]);
        drawing.push_polygon("square", &[corners.to_vec()]);
    }
    let a = arranged(&drawing, Dangling::Drop);
    check(&a, [200_002, 300_001, 100_000, 1]);
    assert_eq!(a.edges_of(4 * 77_777).count(), 1);
    assert!((1..=100_000).all(|f| a.area(FaceId(f)) == 1.0));
}

#[test]
fn far_from_the_origin_and_at_any_scale() {
    let grid = |offset: [f64; 2], step: f64| -> Vec<[f64; 4]> {
        (0..10)
            .flat_map(|x| (0..10).map(move |y| (x, y)))
            .flat_map(|(x, y)| {
                square([offset[0] + f64::from(x) * step, offset[1] + f64::from(y) * step], step)
            })
            .collect()
    };
    for (offset, step) in [
        ([1e8, -1e8], 1.0),
        ([1e8, 1e8], 2f64.powi(-20)),
        ([0.0, 2f64.powi(50)], 1.0),
        ([0.0; 2], 1e-300),
        ([0.0; 2], 1e150),
        ([0.0; 2], 1e300),
        ([-1e300, 0.0], 2e299),
    ] {
        let a = of(&grid(offset, step), Dangling::Drop);
        check(&a, [121, 220, 100, 1]);
        if step.is_normal() && (step * step).is_normal() {
            let sum: f64 = (1..=100).map(|f| a.area(FaceId(f))).sum();
            assert!((sum / (step * step) - 100.0).abs() < 1e-6, "{offset:?} {step:e}: {sum:e}");
        }
    }
}
