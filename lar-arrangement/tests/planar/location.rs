//! Point location against a look at every vertex, edge and face.

use crate::check::{Key, arranged, drawing, key, rounded};
use crate::common::Random;
use crate::fraction::{Fraction, Point};
use crate::inputs;
use crate::oracle::{Oracle, Segment, is_on, winding};
use lar_arrangement::planar::{Dangling, Drawing, Location, PlanarArrangement};
use lar_core::FaceId;
use std::collections::BTreeMap;

/// A location by positions: of a vertex, of the ends of an edge, of a directed edge of a face.
#[derive(Debug, PartialEq)]
enum Found {
    Vertex(Key),
    Edge([Key; 2]),
    Face(Option<[Key; 2]>),
}

/// By trying everything.
fn expected(oracle: &Oracle, p: Point) -> Found {
    if oracle.vertices.contains(&p) {
        return Found::Vertex(key(&p.map(Fraction::value)));
    }
    if let Some(edge) = oracle.edges.iter().find(|&&e| is_on(p, e)) {
        let [a, b] = rounded(edge, 1.0);
        return Found::Edge([a.min(b), a.max(b)]);
    }
    let around = oracle.faces.iter().find(|(edges, _)| winding(edges, p) == 1);
    Found::Face(
        around.map(|(edges, _)| edges.iter().map(|e| rounded(e, 1.0)).min().expect("faces have edges")),
    )
}

struct Index<'a> {
    a: &'a PlanarArrangement,
    names: BTreeMap<u32, [Key; 2]>,
}

impl<'a> Index<'a> {
    fn new(a: &'a PlanarArrangement) -> Self {
        let least =
            |f| crate::check::directed_edges(a, FaceId(f)).into_iter().next().expect("faces have edges");
        Self { a, names: (1..=a.n_faces() as u32).map(|f| (f, least(f))).collect() }
    }

    fn found(&self, location: Location) -> Found {
        let at = |v: u32| key(self.a.complex().points().point(v as usize));
        match location {
            Location::Vertex(v) => Found::Vertex(at(v.0)),
            Location::Edge(e) => {
                let ends = &self.a.complex().boundary(1).indices()[2 * e.index()..][..2];
                let [a, b] = [at(ends[0]), at(ends[1])];
                Found::Edge([a.min(b), a.max(b)])
            }
            Location::Face(f) => Found::Face(self.names.get(&f.0).copied()),
        }
    }
}

/// Grid points and points between them, each also moved by almost nothing.
fn check_all(segments: &[Segment]) {
    for (dangling, keep) in [(Dangling::Keep, true), (Dangling::Drop, false)] {
        let a = arranged(&drawing(segments, 1.0), dangling);
        let oracle = Oracle::new(segments, keep);
        let index = Index::new(&a);
        for (x, y) in (-1..=26).flat_map(|x| (-1..=26).map(move |y| (x, y))) {
            let p = [Fraction::from(x), Fraction::from(y)].map(|c| c.half().half());
            let found = index.found(a.locate(p.map(Fraction::value)));
            assert_eq!(found, expected(&oracle, p), "{segments:?} {dangling:?} {p:?}");
        }
        for p in &oracle.vertices {
            let at = p.map(Fraction::value);
            if at.iter().all(|x| x * 64.0 == (x * 64.0).trunc()) {
                assert_eq!(index.found(a.locate(at)), Found::Vertex(key(&at)), "{segments:?} {p:?}");
            }
        }
    }
}

#[test]
fn every_quarter_step_of_random_drawings() {
    let random = &mut Random(5);
    for _ in 0..400 {
        check_all(&inputs::segments(random));
    }
}

fn triangle() -> PlanarArrangement {
    // The slope of the first side is 1/3: no point of it but those with x a multiple of 3 is a dyadic number.
    let mut drawing = Drawing::new(lar_core::Points::new(2));
    drawing.push_polygon("A", &[vec![[0.0, 0.0], [3.0, 1.0], [0.0, 1.0]]]);
    arranged(&drawing, Dangling::Drop)
}

const OUTSIDE: Location = Location::Face(FaceId(0));
const INSIDE: Location = Location::Face(FaceId(1));

#[test]
fn the_last_bit_decides() {
    let a = triangle();
    let third = 1.0f64 / 3.0;
    // 1/3 is rounded down: the point is below the line.
    assert_eq!(a.locate([1.0, third]), OUTSIDE);
    assert_eq!(a.locate([1.0, third.next_up()]), INSIDE);
    assert_eq!(a.locate([1.5, 0.5]), a.locate([0.75, 0.25]));
    assert!(matches!(a.locate([1.5, 0.5]), Location::Edge(_)));
    assert_eq!([a.locate([1.5, 0.5f64.next_up()]), a.locate([1.5, 0.5f64.next_down()])], [INSIDE, OUTSIDE]);
    let tiny = f64::from_bits(1);
    // On the line y = x / 3, by three of the smallest numbers, and beside it.
    assert!(matches!(a.locate([3.0 * tiny, tiny]), Location::Edge(_)));
    assert_eq!(a.locate([2.0 * tiny, tiny]), INSIDE);
    assert_eq!(a.locate([4.0 * tiny, tiny]), OUTSIDE);
    assert_eq!(a.locate([-tiny, tiny]), OUTSIDE);
    assert_eq!(a.locate([tiny, 0.5]), INSIDE);
    assert!(matches!(a.locate([0.0, tiny]), Location::Edge(_)));
    assert!(matches!(a.locate([-0.0, -0.0]), Location::Vertex(_)));
    assert_eq!(a.locate([0.5, 1.0f64.next_down()]), INSIDE);
    assert_eq!(a.locate([0.5, 1.0f64.next_up()]), OUTSIDE);
}

#[test]
fn what_is_not_finite_is_in_the_exterior() {
    let a = triangle();
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX] {
        assert_eq!([a.locate([x, 0.5]), a.locate([0.5, x]), a.locate([x, x])], [OUTSIDE; 3]);
    }
    let empty = arranged(&Drawing::from_segments(&[]), Dangling::Keep);
    assert_eq!([empty.locate([0.0, 0.0]), empty.locate([f64::NAN, 1.0])], [OUTSIDE; 2]);
}

#[test]
fn far_from_the_origin_and_at_any_scale() {
    for (scale, offset) in [(1.0, [1e8, -3e9]), (2f64.powi(-1000), [0.0; 2]), (2f64.powi(1000), [0.0; 2])] {
        let at = |p: [f64; 2]| [0, 1].map(|k| p[k] * scale + offset[k]);
        let mut drawing = Drawing::new(lar_core::Points::new(2));
        drawing.push_polygon("A", &[[[0.0, 0.0], [3.0, 1.0], [0.0, 1.0]].map(at).to_vec()]);
        let a = arranged(&drawing, Dangling::Drop);
        assert_eq!(a.locate(at([1.0, 0.5])), INSIDE, "{scale:e}");
        assert_eq!(a.locate(at([1.0, 0.25])), OUTSIDE, "{scale:e}");
        assert!(matches!(a.locate(at([1.5, 0.5])), Location::Edge(_)), "{scale:e}");
        assert!(matches!(a.locate(at([3.0, 1.0])), Location::Vertex(_)), "{scale:e}");
    }
}

#[test]
fn many_points_in_many_faces() {
    let random = &mut Random(6);
    let segments: Vec<[f64; 4]> = (0..600).map(|_| [(); 4].map(|()| random.between(0.0, 1.0))).collect();
    let a = arranged(&Drawing::from_segments(&segments), Dangling::Drop);
    let points: Vec<[f64; 2]> = (0..100_000).map(|_| [(); 2].map(|()| random.between(-0.1, 1.1))).collect();
    let found = a.locator().locate_all(&points);
    let mut count = vec![0u32; a.n_faces() + 1];
    for location in &found {
        let Location::Face(f) = location else { panic!("{location:?}: no random point hits an edge") };
        count[f.index()] += 1;
    }
    // Half of them would be in a part of area a with a probability of 1.44 a: five standard deviations.
    for f in (1..=a.n_faces() as u32).map(FaceId).filter(|&f| a.area(f) > 1e-4) {
        let mean = a.area(f) / 1.44 * points.len() as f64;
        let off = (f64::from(count[f.index()]) - mean).abs();
        assert!(off < 6.0 * mean.sqrt() + 1.0, "face {f}: {} points, not {mean}", count[f.index()]);
    }
    assert!(points.iter().zip(&found).take(200).all(|(&p, &found)| a.locate(p) == found));
}

#[test]
fn long_rows_take_no_quadratic_time() {
    // Nothing but horizontal edges, and one vertical far to the left of all queries.
    let mut segments: Vec<[f64; 4]> =
        (0..50_000).map(f64::from).map(|k| [2.0 * k, 0.0, 2.0 * k + 1.0, 0.0]).collect();
    segments.extend((0..50_000).map(f64::from).map(|k| [2.0 * k, 1.0, 2.0 * k, -1.0]));
    let a = arranged(&Drawing::from_segments(&segments), Dangling::Keep);
    let points: Vec<[f64; 2]> = (0..50_000).map(|k| [2.0 * f64::from(k) + 1.5, 0.0]).collect();
    assert!(a.locator().locate_all(&points).iter().all(|&l| l == OUTSIDE));
    let points: Vec<[f64; 2]> = (0..50_000).map(|k| [2.0 * f64::from(k), 0.0]).collect();
    assert!(a.locator().locate_all(&points).iter().all(|l| matches!(l, Location::Vertex(_))));
}
