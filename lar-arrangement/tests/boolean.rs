//! Boolean results: volumes, counts, closedness, simplification, refusals.

use lar_arrangement::{
    Arrangement, BooleanError, Detail, Expression, FaceSide, FillRule, Solid, arrange, operand_names,
};
use lar_core::{FaceId, Model, Node, Points, Struct, Surface, cuboid_grid, icosphere, r, s, t};
use proptest::prelude::*;
use std::f64::consts::PI;

fn surfaces(nodes: Vec<Node>) -> Vec<Surface> {
    let models = Struct::from_nodes("scene", nodes).eval_struct().expect("the scene is well formed");
    models.iter().map(|m| m.to_surface().expect("the models have faces")).collect()
}

fn cube() -> Model {
    cuboid_grid(&[1, 1, 1])
}

fn three_cubes() -> Arrangement {
    let surfaces = surfaces(vec![
        cube().into(),
        t(&[0.3, 0.4, 0.25]).into(),
        r([PI / 5.0, 0.0, 0.0]).into(),
        r([0.0, 0.0, PI / 12.0]).into(),
        cube().into(),
        t(&[-0.2, 0.4, -0.2]).into(),
        r([0.0, PI / 5.0, 0.0]).into(),
        r([0.0, PI / 12.0, 0.0]).into(),
        cube().into(),
    ]);
    arrange(&surfaces).expect("finite input")
}

fn evaluated<'a>(a: &'a Arrangement, text: &str) -> Solid<'a> {
    let expression =
        Expression::parse(text, &operand_names(a.n_solids())).expect("the expression is well formed");
    a.boolean(&expression, FillRule::NonZero).expect("the operands are closed")
}

#[track_caller]
fn check(a: &Arrangement, text: &str, volume: f64, fragments: usize, simplified: [usize; 3]) {
    let solid = evaluated(a, text);
    assert!((solid.volume() - volume).abs() < 1e-6, "{text}: volume {}", solid.volume());
    let full = solid.to_complex(Detail::Fragments);
    assert_eq!(full.n_faces(), fragments, "{text}: faces");
    let simple = solid.to_complex(Detail::Simplified);
    for (name, surface) in [("fragments", &full), ("simplified", &simple)] {
        assert!(surface.is_closed(), "{text}: {name} is open");
        assert_eq!(surface.complex.validate(), [], "{text}: {name}");
        let area = surface.area();
        assert!((area - solid.area()).abs() < 1e-9, "{text}: {name} has area {area}, not {}", solid.area());
        let volume = surface.volume();
        assert!((volume - solid.volume()).abs() < 1e-9, "{text}: {name} has volume {volume}");
    }
    let counts = [simple.complex.n_cells(0), simple.complex.n_cells(1), simple.n_faces()];
    assert_eq!(counts, simplified, "{text}: simplified");
    assert_eq!(full.euler(), simple.euler(), "{text}: simplification keeps the topology");
}

#[test]
fn three_cubes_of_the_paper() {
    let a = three_cubes();
    check(&a, "A | B | C", 2.484154, 21, [38, 57, 21]);
    check(&a, "A & B & C", 0.059034, 7, [10, 15, 7]);
    check(&a, "A - B - C", 0.597214, 14, [24, 36, 14]);
    check(&a, "A ^ A", 0.0, 0, [0, 0, 0]);
    check(&a, "A", 1.0, 19, [8, 12, 6]);
    check(&a, "A & (A | B)", 1.0, 19, [8, 12, 6]);
}

#[test]
fn coplanar_faces_of_different_solids_are_merged() {
    let a =
        arrange(&surfaces(vec![cube().into(), t(&[1.0, 0.0, 0.0]).into(), cube().into()])).expect("finite");
    check(&a, "A | B", 2.0, 10, [8, 12, 6]);
    let a =
        arrange(&surfaces(vec![cube().into(), t(&[0.5, 0.0, 0.0]).into(), cube().into()])).expect("finite");
    check(&a, "A | B", 1.5, 14, [8, 12, 6]);
    check(&a, "A ^ B", 1.0, 12, [16, 24, 12]);
    let merged = evaluated(&a, "A | B").to_complex(Detail::Simplified);
    let solids_of = |f: u32| {
        let mut solids: Vec<u32> = merged.parents(FaceId(f)).iter().map(|p| p.solid).collect();
        solids.dedup();
        solids
    };
    assert_eq!((0..6).filter(|&f| solids_of(f) == [0, 1]).count(), 4, "the long faces come from both cubes");
}

#[test]
fn holes_and_cavities_survive() {
    let inner = [t(&[0.25; 3]).into(), s(&[0.5; 3]).into(), cube().into()];
    let a = arrange(&surfaces([cube().into()].into_iter().chain(inner).collect())).expect("finite");
    check(&a, "A - B", 0.875, 12, [16, 24, 12]);
    assert_eq!(evaluated(&a, "A - B").to_complex(Detail::Simplified).n_components(), 2);
    // A square shaft through the cube: two faces with a hole.
    let shaft = [t(&[0.25, 0.25, -1.0]).into(), s(&[0.5, 0.5, 3.0]).into(), cube().into()];
    let a = arrange(&surfaces([cube().into()].into_iter().chain(shaft).collect())).expect("finite");
    check(&a, "A - B", 0.75, 10, [16, 24, 10]);
    let drilled = evaluated(&a, "A - B").to_complex(Detail::Simplified);
    assert_eq!((drilled.n_loops(), drilled.euler()), (12, 0));
}

#[test]
fn the_complement_is_unbounded() {
    let a = three_cubes();
    let outside = evaluated(&a, "!A");
    assert!(!outside.is_bounded());
    assert_eq!(outside.volume(), f64::INFINITY);
    assert!(outside.to_complex(Detail::Simplified).is_closed());
    assert_eq!(outside.to_complex(Detail::Simplified).n_faces(), 6);
}

#[test]
fn fill_rules_read_winding_numbers() {
    let mut twice = surfaces(vec![cube().into(), t(&[0.5, 0.0, 0.0]).into(), cube().into()]);
    let (a, b) = (twice.remove(0), twice.remove(0));
    let mut both = a.clone();
    let offset = both.points.len() as u32;
    for p in b.points.iter() {
        both.points.push(p);
    }
    for f in 0..b.n_faces() {
        let loops: Vec<Vec<u32>> = b.face(f).map(|l| l.iter().map(|v| v + offset).collect()).collect();
        both.push_face(loops.iter().map(Vec::as_slice), 1);
    }
    let arrangement = arrange(&[both]).expect("finite");
    let volume = |rule| arrangement.boolean(&Expression::solid(0), rule).expect("closed").volume();
    assert!((volume(FillRule::NonZero) - 1.5).abs() < 1e-12);
    assert!((volume(FillRule::Positive) - 1.5).abs() < 1e-12);
    assert!((volume(FillRule::EvenOdd) - 1.0).abs() < 1e-12);
}

/// A unit cube without some of its faces, or with some of them turned.
fn damaged_cube(drop: &[usize], turn: &[usize]) -> Surface {
    let whole = surfaces(vec![cube().into()]).remove(0);
    let mut out = Surface::new("damaged", whole.points.clone());
    for f in (0..6).filter(|f| !drop.contains(f)) {
        let loops: Vec<Vec<u32>> = whole
            .face(f)
            .map(|l| if turn.contains(&f) { l.iter().rev().copied().collect() } else { l.to_vec() })
            .collect();
        out.push_face(loops.iter().map(Vec::as_slice), 1);
    }
    out
}

#[test]
fn operands_that_bound_nothing_are_refused() {
    let open = arrange(&[damaged_cube(&[2], &[])]).expect("open surfaces divide space too");
    let error = open.boolean(&Expression::solid(0), FillRule::EvenOdd).expect_err("open");
    assert!(matches!(&error, BooleanError::Open { solid, n_edges: 4, .. } if solid == "damaged"), "{error}");
    assert!(error.to_string().starts_with("damaged: the surface is open"), "{error}");
    let turned = arrange(&[damaged_cube(&[], &[3])]).expect("finite");
    let error = turned.boolean(&Expression::solid(0), FillRule::NonZero).expect_err("not oriented");
    assert!(matches!(error, BooleanError::Unoriented { .. }));
    let even_odd = turned.boolean(&Expression::solid(0), FillRule::EvenOdd).expect("parity is enough");
    assert_eq!(even_odd.volume(), 1.0);
    let missing = turned.boolean(&Expression::solid(1), FillRule::EvenOdd).expect_err("there is one solid");
    assert_eq!(missing, BooleanError::NoSuchSolid { solid: 1, n_solids: 1 });
}

#[test]
fn spheres_obey_inclusion_and_exclusion() {
    let sphere = icosphere(4);
    let moved = sphere.points.iter().map(|p| [p[0] + 0.3, p[1] + 0.15, p[2] + 0.07]).collect::<Vec<_>>();
    let other =
        lar_core::TriangleMesh { points: Points::from_xyz(&moved), triangles: sphere.triangles.clone() };
    let a = arrange(&[Surface::from_triangles("a", &sphere), Surface::from_triangles("b", &other)])
        .expect("finite");
    assert_eq!(a.n_cells(), 4);
    let v = |text: &str| evaluated(&a, text).volume();
    let whole = sphere.signed_volume();
    assert!((v("A") - whole).abs() < 1e-9 * whole && (v("B") - whole).abs() < 1e-9 * whole);
    assert!((v("A|B") + v("A&B") - 2.0 * whole).abs() < 1e-9 * whole);
    assert!((v("A-B") + v("A&B") - whole).abs() < 1e-9 * whole);
    assert!((v("A^B") - v("A|B") + v("A&B")).abs() < 1e-9 * whole);
    assert!(evaluated(&a, "A-B").to_complex(Detail::Simplified).is_closed());
}

#[test]
fn the_traced_form_finds_the_same_shells() {
    let a = three_cubes();
    for face in (0..a.n_faces() as u32).map(FaceId) {
        for back in [false, true] {
            let steps = a.wrap(FaceSide { face, back });
            let last = steps.last().expect("there is a first step");
            assert_eq!(last.boundary, []);
            let shell = a.shells_of_face(face)[usize::from(back)];
            let mut expected: Vec<(FaceId, i8)> = (0..a.n_faces() as u32)
                .map(FaceId)
                .flat_map(|f| a.shells_of_face(f).into_iter().zip([-1, 1]).map(move |(s, sign)| (f, s, sign)))
                .filter(|&(_, s, _)| s == shell)
                .map(|(f, _, sign)| (f, sign))
                .collect();
            expected.sort_unstable();
            let mut found = last.chain.clone();
            found.sort_unstable();
            assert_eq!(found, expected);
            for pair in steps.windows(2) {
                assert!(!pair[0].boundary.is_empty() && pair[0].chain.len() < pair[1].chain.len());
            }
        }
    }
}

/// Boxes with corners on a small integer grid: coplanar faces everywhere, volumes exact by counting unit cubes.
fn boxes() -> impl Strategy<Value = Vec<([i32; 3], [i32; 3])>> {
    let one = (prop::array::uniform3(0i32..4), prop::array::uniform3(1i32..4));
    prop::collection::vec(one, 3)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]
    #[test]
    fn identities_hold_on_random_boxes(boxes in boxes()) {
        let nodes = boxes.iter().map(|(at, size)| {
            let part: Vec<Node> = vec![
                t(&at.map(f64::from)).into(),
                s(&size.map(f64::from)).into(),
                cube().into(),
            ];
            Struct::from_nodes("box", part).into()
        }).collect();
        let a = arrange(&surfaces(nodes)).expect("finite");
        let contains = |k: usize, p: [i32; 3]| {
            let (at, size) = boxes[k];
            (0..3).all(|d| at[d] <= p[d] && p[d] < at[d] + size[d])
        };
        for text in ["A|B|C", "A&B&C", "A-B", "A^B^C", "(A-B)|C", "A&!B", "(A|B)-(B&C)"] {
            let expression = Expression::parse(text, &operand_names(3)).expect("well formed");
            let mut count = 0;
            for x in 0..8 { for y in 0..8 { for z in 0..8 {
                count += i32::from(expression.evaluate(|k| contains(k, [x, y, z])));
            }}}
            let solid = evaluated(&a, text);
            prop_assert!((solid.volume() - f64::from(count)).abs() < 1e-9, "{text}: {} not {count}", solid.volume());
            let simple = solid.to_complex(Detail::Simplified);
            prop_assert!(simple.is_closed());
            prop_assert_eq!(simple.complex.validate(), []);
            prop_assert_eq!(simple.euler(), solid.to_complex(Detail::Fragments).euler());
        }
        let cells = |text: &str| evaluated(&a, text).cells().to_vec();
        prop_assert_eq!(cells("A-B"), cells("A&!B"));
        prop_assert_eq!(cells("!(A|B)"), cells("!A&!B"));
        prop_assert_eq!(cells("A^B"), cells("(A|B)-(A&B)"));
    }
}
