//! Isolated vertices, restriction to a polygon, biconnected components.

use crate::check::{Key, arranged, compare, drawing, key, rounded};
use crate::common::Random;
use crate::fraction::{Fraction, Point, point};
use crate::inputs;
use crate::oracle::{Directed, Oracle, Segment, bridges, ends, is_on, winding};
use lar_arrangement::planar::{Dangling, Drawing, Isolated, Location, PlanarArranger};
use lar_core::{EdgeId, FaceId, Points};
use std::collections::BTreeSet;

const BOTH: [(Dangling, bool); 2] = [(Dangling::Keep, true), (Dangling::Drop, false)];

fn position(p: Point) -> Key {
    key(&p.map(Fraction::value))
}

/// Points that end no segment with length and lie on no edge.
fn expected_isolated(segments: &[Segment], points: &[[i64; 2]], oracle: &Oracle) -> BTreeSet<Point> {
    let (with_length, without): (Vec<Directed>, Vec<Directed>) =
        segments.iter().map(ends).partition(|[a, b]| a != b);
    let candidates = without.iter().map(|e| e[0]).chain(points.iter().map(|&[x, y]| point(x, y)));
    candidates
        .filter(|p| !with_length.as_flattened().contains(p) && !oracle.edges.iter().any(|&e| is_on(*p, e)))
        .collect()
}

fn check_isolated(segments: &[Segment], points: &[[i64; 2]]) {
    for (dangling, keep) in BOTH {
        let mut drawing = drawing(segments, 1.0);
        for p in points {
            drawing.push_point(p.map(|x| x as f64));
        }
        let a = PlanarArranger::new().dangling(dangling).isolated(Isolated::Keep).arrange(&drawing);
        let a = a.unwrap_or_else(|e| panic!("{e}"));
        let oracle = Oracle::new(segments, keep);
        let expected = expected_isolated(segments, points, &oracle);
        let at = |v: usize| key(a.complex().points().point(v));
        let found: BTreeSet<Key> = a.isolated_vertices().iter().map(|(v, _)| at(v.index())).collect();
        assert_eq!(found, expected.iter().map(|&p| position(p)).collect(), "{segments:?} {points:?}");
        assert_eq!(a.n_vertices(), oracle.vertices.len() + expected.len());
        assert_eq!(a.n_components(), oracle.n_components + expected.len());
        assert_eq!((a.euler(), a.complex().validate_with_exterior()), (0, Vec::new()));
        let without = arranged(&drawing, dangling);
        assert_eq!(without.complex().boundary(2), a.complex().boundary(2));
        for &(v, face) in a.isolated_vertices() {
            let p = a.complex().points().point(v.index());
            assert_eq!(without.locate([p[0], p[1]]), Location::Face(face), "{segments:?} {p:?}");
            assert_eq!(a.locate([p[0], p[1]]), Location::Vertex(v), "{segments:?} {p:?}");
        }
    }
}

#[test]
fn isolated_vertices_of_random_drawings() {
    let random = &mut Random(8);
    for _ in 0..1500 {
        let mut segments = inputs::segments(random);
        segments.truncate(6);
        let mut points = |n: usize| -> Vec<[i64; 2]> {
            (0..n).map(|_| [(); 2].map(|()| random.below(9) as i64 - 1)).collect()
        };
        segments.extend(points(3).into_iter().map(|[x, y]| [x, y, x, y]));
        check_isolated(&segments, &points(4));
    }
}

#[test]
fn isolated_vertices_far_from_the_origin() {
    check_isolated(&[[3_000_000, 0, 3_000_001, 0]], &[[3_000_001, 1], [3_000_001, 1], [2_999_999, -5]]);
    check_isolated(&[], &[[7, 7]]);
}

/// What the restriction to σ keeps: edges beside a face whose inner point lies in σ.
fn expected_within(segments: &[Segment], sigma: &[Segment], keep: bool) -> Oracle {
    let all: Vec<Segment> = segments.iter().chain(sigma).copied().collect();
    let whole = Oracle::new(&all, true);
    let outline: Vec<Directed> = sigma.iter().map(ends).collect();
    let inside: BTreeSet<Directed> = whole
        .faces
        .iter()
        .filter(|(edges, _)| winding(&outline, whole.inside(edges)) % 2 != 0)
        .flat_map(|(edges, _)| edges.iter().copied())
        .collect();
    Oracle::of_some(&all, keep, |[a, b]| inside.contains(&[a, b]) || inside.contains(&[b, a]))
}

fn check_within(segments: &[Segment], regions: &[Vec<[i64; 2]>], sigma: &[Vec<[i64; 2]>]) {
    let to_f64 = |l: &Vec<[i64; 2]>| -> Vec<[f64; 2]> { l.iter().map(|p| p.map(|x| x as f64)).collect() };
    let sides = |l: &Vec<[i64; 2]>| -> Vec<Segment> {
        (0..l.len()).map(|i| [l[i], l[(i + 1) % l.len()]]).map(|[[a, b], [c, d]]| [a, b, c, d]).collect()
    };
    let mut input = drawing(segments, 1.0);
    let mut all = segments.to_vec();
    for region in regions {
        input.push_polygon("region", &[to_f64(region)]);
        all.extend(sides(region));
    }
    let loops: Vec<Vec<[f64; 2]>> = sigma.iter().map(to_f64).collect();
    let outline: Vec<Segment> = sigma.iter().flat_map(sides).collect();
    for (dangling, keep) in BOTH {
        let a = PlanarArranger::new().dangling(dangling).arrange_within(&input, &loops);
        let a = a.unwrap_or_else(|e| panic!("{e}"));
        let oracle = expected_within(&all, &outline, keep);
        compare(&a, &oracle, 1.0).unwrap_or_else(|e| panic!("{all:?} within {sigma:?}: {dangling:?}: {e}"));
        for (edges, _) in &oracle.faces {
            let p = oracle.inside(edges);
            let around = |l: &[Segment]| winding(&l.iter().map(ends).collect::<Vec<_>>(), p);
            let is_inside = around(&outline) % 2 != 0;
            let least = edges.iter().map(|e| rounded(e, 1.0)).min();
            let face = (1..=a.n_faces() as u32)
                .map(FaceId)
                .find(|&f| crate::check::directed_edges(&a, f).first() == least.as_ref())
                .expect("faces are equal");
            assert_eq!(a.winding(face, regions.len()) % 2 != 0, is_inside);
            for (region, cycle) in regions.iter().enumerate() {
                let expected = if is_inside { around(&sides(cycle)) } else { 0 };
                assert_eq!(a.winding(face, region), expected, "{regions:?} within {sigma:?} at {p:?}");
            }
        }
    }
}

#[test]
fn random_drawings_within_random_polygons() {
    let random = &mut Random(9);
    for _ in 0..600 {
        let mut segments = inputs::segments(random);
        segments.truncate(8);
        let mut cycle = |n: usize| -> Vec<[i64; 2]> {
            (0..n).map(|_| [(); 2].map(|()| random.below(7) as i64)).collect()
        };
        let (regions, sigma) = (vec![cycle(4)], vec![cycle(5), cycle(3)]);
        check_within(&segments, &regions, &sigma);
    }
}

#[test]
fn a_hole_of_sigma_stays_empty() {
    let square = |x: i64, s: i64| vec![[x, x], [x + s, x], [x + s, x + s], [x, x + s]];
    let lines = [[-1, 4, 9, 4], [4, -1, 4, 9]];
    check_within(&lines, &[square(1, 2), square(3, 2)], &[square(0, 8), square(2, 4)]);
    let drawing = drawing(&lines, 1.0);
    let to_f64 = |l: Vec<[i64; 2]>| l.iter().map(|p| p.map(|x| x as f64)).collect();
    let sigma: Vec<Vec<[f64; 2]>> = vec![to_f64(square(0, 8)), to_f64(square(2, 4))];
    let a = PlanarArranger::new().arrange_within(&drawing, &sigma).expect("well formed");
    // Four corner pieces and the hole.
    assert_eq!(
        (
            a.n_faces(),
            a.faces_where(&lar_arrangement::Expression::solid(0), Default::default()).unwrap().len()
        ),
        (5, 4)
    );
    let points = PlanarArranger::new().isolated(Isolated::Keep);
    let mut dots = Drawing::new(Points::from_columns(2, vec![1., 1., 4., 4., 9., 9., 0., 4.]));
    dots.push_segment([0, 0]);
    let a = points.arrange_within(&dots, &sigma).expect("well formed");
    let found: Vec<&[f64]> =
        a.isolated_vertices().iter().map(|(v, _)| a.complex().points().point(v.index())).collect();
    assert_eq!(found, [[1.0, 1.0]]);
}

#[test]
fn sigma_without_a_drawing_and_a_drawing_without_sigma() {
    check_within(&[], &[], &[vec![[0, 0], [4, 0], [0, 4]]]);
    check_within(&[[0, 0, 5, 5]], &[], &[]);
    check_within(&[[0, 0, 5, 5]], &[], &[vec![[1, 1]], vec![[2, 2], [3, 3]]]);
    let three = Drawing::new(Points::new(3));
    let refused = PlanarArranger::new().arrange_within(&three, &[vec![[0.0, 0.0]]]);
    assert_eq!(
        refused.expect_err("three coordinates").to_string(),
        "points of 3 coordinates, a planar arrangement needs 2"
    );
    let empty = Drawing::new(Points::new(2));
    let refused = PlanarArranger::new().arrange_within(&empty, &[vec![[0.0, f64::NAN]]]);
    assert_eq!(refused.expect_err("not a number").to_string(), "drawing: vertex v0 has the coordinate NaN");
}

#[test]
fn bridges_and_biconnected_components() {
    let random = &mut Random(10);
    for _ in 0..800 {
        let segments = inputs::segments(random);
        let a = arranged(&drawing(&segments, 1.0), Dangling::Keep);
        let found = a.biconnected_components();
        let at = |v: u32| key(a.complex().points().point(v as usize));
        let ends = |e: u32| {
            let ends = &a.complex().boundary(1).indices()[2 * EdgeId(e).index()..][..2];
            let [p, q] = [at(ends[0]), at(ends[1])];
            [p.min(q), p.max(q)]
        };
        let of_oracle: BTreeSet<[Key; 2]> = bridges(&Oracle::new(&segments, true).edges)
            .iter()
            .map(|e| rounded(e, 1.0))
            .map(|[p, q]| [p.min(q), p.max(q)])
            .collect();
        assert_eq!(found.bridges.iter().map(|&e| ends(e)).collect::<BTreeSet<_>>(), of_oracle);
        assert_eq!(found.components.iter().map(<[u32]>::len).sum::<usize>(), a.n_edges());
        let dropped = arranged(&drawing(&segments, 1.0), Dangling::Drop);
        assert!(dropped.biconnected_components().bridges.is_empty());
    }
}
