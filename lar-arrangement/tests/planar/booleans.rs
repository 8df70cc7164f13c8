//! Winding numbers in all faces against exact ones at a point of each; Booleans as sums of faces.

use crate::check::{Key, arranged, directed_edges, rounded};
use crate::common::Random;
use crate::fraction::{Fraction, Point, point};
use crate::oracle::{Directed, Oracle, Segment, winding};
use lar_arrangement::planar::{Dangling, Drawing, PlanarArrangement, Polygons};
use lar_arrangement::{BooleanError, Closure, Expression, FillRule};
use lar_core::{FaceId, Points};
use std::collections::{BTreeMap, BTreeSet};

type Loop = Vec<[i64; 2]>;

const NAMES: [&str; 3] = ["A", "B", "C"];
const RULES: [FillRule; 3] = [FillRule::EvenOdd, FillRule::NonZero, FillRule::Positive];

/// Three regions of one to three loops: triangles to hexagons that may cross themselves.
fn random_regions(random: &mut Random) -> Vec<Vec<Loop>> {
    let side = 3 + random.below(4);
    (0..3)
        .map(|_| {
            (0..=random.below(3))
                .map(|_| {
                    (0..3 + random.below(4)).map(|_| [(); 2].map(|()| random.below(side) as i64)).collect()
                })
                .collect()
        })
        .collect()
}

fn sides(cycle: &Loop) -> impl Iterator<Item = Segment> + '_ {
    (0..cycle.len()).map(|i| {
        let ([a, b], [c, d]) = (cycle[i], cycle[(i + 1) % cycle.len()]);
        [a, b, c, d]
    })
}

fn drawing(regions: &[Vec<Loop>]) -> Drawing {
    let mut out = Drawing::new(Points::new(2));
    for (name, loops) in NAMES.iter().zip(regions) {
        let loops: Vec<Vec<[f64; 2]>> =
            loops.iter().map(|l| l.iter().map(|p| p.map(|x| x as f64)).collect()).collect();
        out.push_polygon(*name, &loops);
    }
    out
}

/// Each face with a point inside it, and the winding numbers of the regions there by definition.
struct Truth {
    a: PlanarArrangement,
    faces: Vec<(FaceId, Point, [i32; 3])>,
}

fn truth(regions: &[Vec<Loop>]) -> Truth {
    let a = arranged(&drawing(regions), Dangling::Drop);
    let segments: Vec<Segment> = regions.iter().flatten().flat_map(sides).collect();
    let oracle = Oracle::new(&segments, false);
    let by_edges: BTreeMap<BTreeSet<[Key; 2]>, FaceId> =
        (1..=a.n_faces() as u32).map(FaceId).map(|f| (directed_edges(&a, f), f)).collect();
    let of_region = |region: &Vec<Loop>, p| {
        let outline: Vec<Directed> =
            region.iter().flat_map(sides).map(|s| [point(s[0], s[1]), point(s[2], s[3])]).collect();
        winding(&outline, p)
    };
    let faces = oracle.faces.iter().map(|(edges, _)| {
        let p = oracle.inside(edges);
        let face = by_edges[&edges.iter().map(|e| rounded(e, 1.0)).collect::<BTreeSet<_>>()];
        (face, p, [0, 1, 2].map(|i| of_region(&regions[i], p)))
    });
    let faces = faces.collect();
    Truth { a, faces }
}

/// Twice the signed area of a loop.
fn twice_area(polygons: &Polygons, cycle: &[u32]) -> f64 {
    let at = |i: usize| polygons.points.point(cycle[i % cycle.len()] as usize);
    (0..cycle.len()).map(|i| at(i)[0] * at(i + 1)[1] - at(i)[1] * at(i + 1)[0]).sum()
}

/// Whether a point lies inside, by parity of all loops.
fn contains(polygons: &Polygons, p: [f64; 2]) -> bool {
    let mut inside = false;
    for cycle in polygons.polygons.iter().flatten() {
        for i in 0..cycle.len() {
            let [a, b] = [i, (i + 1) % cycle.len()].map(|i| polygons.points.point(cycle[i] as usize));
            if (a[1] > p[1]) != (b[1] > p[1]) {
                inside ^= p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            }
        }
    }
    inside
}

fn check(truth: &Truth, text: &str, rule: FillRule, holds: impl Fn([bool; 3]) -> bool) {
    let Truth { a, faces } = truth;
    let result = a.boolean(&Expression::parse(text, &NAMES).expect("an expression"), rule);
    let result = result.unwrap_or_else(|e| panic!("{e}"));
    let mut area = 0.0;
    for (face, p, windings) in faces {
        let inside = holds(windings.map(|w| rule.is_inside(w)));
        assert_eq!(contains(&result, p.map(Fraction::value)), inside, "{text} {rule:?} at {p:?}");
        area += if inside { a.area(*face) } else { 0.0 };
    }
    assert!((result.area() - area).abs() < 1e-9, "{text} {rule:?}: {} instead of {area}", result.area());
    for polygon in &result.polygons {
        let areas: Vec<f64> = polygon.iter().map(|l| twice_area(&result, l)).collect();
        assert!(areas[0] > 0.0 && areas[1..].iter().all(|&hole| hole < 0.0), "{text} {rule:?}: {areas:?}");
        assert!(areas.iter().sum::<f64>() > 0.0);
    }
}

#[test]
fn random_regions_against_winding_numbers_at_points() {
    let random = &mut Random(7);
    for _ in 0..700 {
        let regions = random_regions(random);
        let truth = truth(&regions);
        for (face, p, windings) in &truth.faces {
            let found = [0, 1, 2].map(|region| truth.a.winding(*face, region));
            assert_eq!(found, *windings, "{regions:?} at {p:?}");
        }
        for rule in RULES {
            check(&truth, "A & B", rule, |[a, b, _]| a && b);
            check(&truth, "A | B | C", rule, |[a, b, c]| a || b || c);
            check(&truth, "A - B", rule, |[a, b, _]| a && !b);
            check(&truth, "A ^ B ^ C", rule, |[a, b, c]| a ^ b ^ c);
            check(&truth, "!(!A | !B) - C", rule, |[a, b, c]| a && b && !c);
            check(&truth, "A - A", rule, |_| false);
        }
    }
}

#[test]
fn results_are_simplified() {
    // Two squares side by side become one rectangle of four corners; a ring has a hole.
    let square = |x: i64, y: i64, s: i64| vec![[x, y], [x + s, y], [x + s, y + s], [x, y + s]];
    let regions = vec![vec![square(0, 0, 2)], vec![square(2, 0, 2)], vec![square(1, 1, 1)]];
    let a = arranged(&drawing(&regions), Dangling::Drop);
    let sizes = |text: &str| -> Vec<Vec<usize>> {
        let expression = Expression::parse(text, &NAMES).expect("an expression");
        let result = a.boolean(&expression, FillRule::NonZero).expect("closed outlines");
        result.polygons.iter().map(|p| p.iter().map(Vec::len).collect()).collect()
    };
    assert_eq!(sizes("A | B"), [[4]]);
    assert_eq!(sizes("A - C"), [[6]]);
    assert_eq!(sizes("(A | B) - C"), [[8]]);
    assert_eq!(sizes("A & B"), [[0; 0]; 0]);
    let ring = vec![vec![square(0, 0, 6)], vec![square(2, 2, 2)], vec![square(9, 9, 1)]];
    let a = arranged(&drawing(&ring), Dangling::Drop);
    let result =
        a.boolean(&Expression::parse("A - B | C", &NAMES).expect("an expression"), FillRule::NonZero);
    let result = result.expect("closed outlines");
    let lengths: Vec<Vec<usize>> = result.polygons.iter().map(|p| p.iter().map(Vec::len).collect()).collect();
    assert_eq!(lengths, [vec![4, 4], vec![4]]);
    assert_eq!(result.area(), 33.0);
}

#[test]
fn what_bounds_nothing_is_refused() {
    let mut drawing = Drawing::new(Points::from_columns(2, vec![0., 0., 1., 0., 1., 1., 0., 1.]));
    drawing.push_region("A", [[0u32, 1, 2, 3].as_slice()]);
    let a = arranged(&drawing, Dangling::Drop);
    let no_such = Expression::parse("A | B", &NAMES).expect("an expression");
    let refused = a.boolean(&no_such, FillRule::NonZero);
    assert_eq!(refused, Err(BooleanError::NoSuchSolid { solid: 1, n_solids: 1 }));
}

/// What a single region of loose segments bounds, dangling edges kept, and its area by parity if it bounds any.
#[track_caller]
fn check_outline(segments: &[[f64; 4]], closure: Closure, area: Option<f64>) {
    let mut drawing = Drawing::new(Points::new(2));
    let region = drawing.push_region("A", []);
    for s in segments {
        let ends = [[s[0], s[1]], [s[2], s[3]]].map(|p| drawing.push_point(p));
        drawing.push_region_segment(region, ends);
    }
    let a = arranged(&drawing, Dangling::Keep);
    assert_eq!(a.closure(region), closure, "{segments:?}");
    let found = a.boolean(&Expression::solid(region), FillRule::EvenOdd);
    assert_eq!(found.ok().map(|polygons| polygons.area()), area, "{segments:?}");
}

#[test]
fn outlines_of_loose_segments() {
    let square = [[0., 0., 2., 0.], [2., 0., 2., 2.], [2., 2., 0., 2.], [0., 2., 0., 0.]];
    let turned = [square[0], [2., 2., 2., 0.], square[2], square[3]];
    check_outline(&square, Closure::Closed, Some(4.0));
    check_outline(&turned, Closure::Unoriented, Some(4.0));
    check_outline(&square[..3], Closure::Open, None);
    check_outline(&[square[0]], Closure::Open, None);
    check_outline(&[square[0], [2., 0., 0., 0.]], Closure::Closed, Some(0.0));
    let antenna = [square.as_slice(), &[[2., 2., 3., 3.]]].concat();
    check_outline(&antenna, Closure::Open, None);
    let crossed = [square.as_slice(), &square.map(|s| s.map(|x| x + 1.0))].concat();
    check_outline(&crossed, Closure::Closed, Some(6.0));
}

#[test]
fn unions_of_faces() {
    let square = |x: i64| vec![[x, 0], [x + 2, 0], [x + 2, 2], [x, 2]];
    let a = arranged(&drawing(&[vec![square(0)], vec![square(1)], vec![square(5)]]), Dangling::Drop);
    let all: Vec<FaceId> = (0..=a.n_faces() as u32).map(FaceId).collect();
    let union = a.polygons_of(&all);
    assert_eq!((union.polygons.len(), union.points.len(), union.area()), (2, 8, 10.0));
    assert!(a.polygons_of(&[]).polygons.is_empty());
    let windings: Vec<usize> = all.iter().map(|&face| a.windings(face).len()).collect();
    assert_eq!(windings.iter().sum::<usize>(), 5, "two faces in one region, one in two, one in another");
}
