//! The surface found alone is that of the arrangement, face by face.

use super::{PAIRS_WORTH_DIVIDING, Question};
use crate::{
    Arranger, BooleanError, Cancel, Checks, Detail, Evaluator, Expression, FillRule, Merge, Parent,
    SolidComplex, operand_names,
};
use lar_core::{FaceId, Points, Surface, TriangleMesh, cuboid_grid, icosphere, r, rotation, s, t};
use proptest::prelude::*;

/// Everything about the faces but their numbers: loops of coordinates, parents.
type Faces = Vec<(Vec<Vec<[u64; 3]>>, Vec<Parent>)>;

fn faces(surface: &SolidComplex) -> Faces {
    let bits = |v: u32| surface.complex.points().xyz(v as usize).map(f64::to_bits);
    let from_least = |l: &[u32]| {
        let mut l: Vec<[u64; 3]> = l.iter().map(|&v| bits(v)).collect();
        let least = (0..l.len()).min_by_key(|&i| (l[i], l[(i + 1) % l.len()])).unwrap_or(0);
        l.rotate_left(least);
        l
    };
    let face = |f: u32| {
        let mut loops: Vec<_> = surface.face_loops(FaceId(f)).map(from_least).collect();
        loops.sort_unstable();
        (loops, surface.parents(FaceId(f)).to_vec())
    };
    let mut all: Faces = (0..surface.n_faces() as u32).map(face).collect();
    all.sort_unstable();
    all
}

/// The result of an expression by itself, with space divided from so many pairs a facet on.
fn direct(
    arranger: Arranger<'_>,
    surfaces: &[Surface],
    expression: &Expression,
    (rule, detail, pairs_a_facet): (FillRule, Detail, usize),
) -> Result<SolidComplex, BooleanError> {
    let question = Question { expression, rule, detail, pairs_a_facet };
    arranger.solid_surface(surfaces, question).map(|(surface, _)| surface)
}

#[track_caller]
fn check(arranger: Arranger<'_>, surfaces: &[Surface], text: &str, rule: FillRule) {
    let expression = Expression::parse(text, &operand_names(surfaces.len())).expect("well formed");
    let arrangement = arranger.arrange(surfaces).expect("finite");
    for detail in [Detail::Simplified, Detail::Fragments] {
        let evaluator = Evaluator::new().fill(rule).detail(detail);
        let of_cells = evaluator.solid(&arrangement, &expression).and_then(|solid| evaluator.surface(&solid));
        let alone = direct(arranger, surfaces, &expression, (rule, detail, 0));
        match (alone, of_cells) {
            (Ok(alone), Ok(of_cells)) => {
                let [found, expected] = [&alone, &of_cells].map(faces);
                assert_eq!(found, expected, "{text}, {rule:?}, {detail:?}");
                assert_eq!(alone.complex.validate(), []);
                assert!(alone.is_closed());
            }
            (alone, of_cells) => assert_eq!(alone.err(), of_cells.err(), "{text}, {rule:?}"),
        }
    }
}

/// Several closed meshes as one surface.
fn joined(name: String, meshes: &[TriangleMesh]) -> Surface {
    let mut all = TriangleMesh { points: Points::from_columns(3, Vec::new()), triangles: Vec::new() };
    for mesh in meshes {
        let base = all.points.len() as u32;
        let coords = [all.points.coords(), mesh.points.coords()].concat();
        all.points = Points::from_columns(3, coords);
        all.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| v + base)));
    }
    Surface::from_triangles(name, &all)
}

/// A box at a place of a small grid, part of a solid; perhaps turned, moved by rounding, inside out.
#[derive(Clone, Debug)]
struct Part {
    at: [u8; 3],
    size: [u8; 3],
    solid: u8,
    angle: Option<f64>,
    noise: [u8; 3],
    is_flipped: bool,
}

const SOLIDS: usize = 4;

fn parts() -> impl Strategy<Value = Vec<Part>> {
    let corner = prop::array::uniform3(0u8..5);
    let size = prop::array::uniform3(1u8..5);
    let angle = prop::option::weighted(0.4, -1.0f64..1.0);
    let noise = prop_oneof![3 => Just([0; 3]), 1 => prop::array::uniform3(0u8..3)];
    let part = (corner, size, 0..SOLIDS as u8, angle, noise, prop::bool::weighted(0.2));
    let part = part.prop_map(|(at, size, solid, angle, noise, is_flipped)| Part {
        at,
        size,
        solid,
        angle,
        noise,
        is_flipped,
    });
    prop::collection::vec(part, 2..9)
}

fn surfaces(parts: &[Part]) -> Vec<Surface> {
    let cube = cuboid_grid(&[1, 1, 1]).to_triangle_mesh().expect("a cube");
    let mesh = |part: &Part| {
        let noise: Vec<f64> =
            part.at.iter().zip(part.noise).map(|(&x, n)| f64::from(x) + f64::from(n) * 1e-12).collect();
        let mut map = t(&noise).compose(&s(&part.size.map(f64::from))).expect("of space");
        if let Some(angle) = part.angle {
            let turn = rotation([1.0, 2.0, -1.0], angle).expect("an axis");
            map = turn.compose(&map).expect("of space");
        }
        let mut mesh = TriangleMesh {
            points: map.apply(&cube.points).expect("of space"),
            triangles: cube.triangles.clone(),
        };
        if part.is_flipped {
            mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        mesh
    };
    let of_solid = |solid: usize| {
        let meshes: Vec<_> = parts.iter().filter(|p| p.solid as usize == solid).map(mesh).collect();
        joined(format!("solid {solid}"), &meshes)
    };
    (0..SOLIDS).map(of_solid).collect()
}

fn texts() -> impl Strategy<Value = String> {
    let operand = prop::sample::select(vec!["A", "B", "C", "D", "!A", "!C"]).prop_map(str::to_owned);
    operand.prop_recursive(3, 8, 2, |inner| {
        let operator = prop::sample::select(vec!["|", "&", "-", "^"]);
        (inner.clone(), operator, inner).prop_map(|(a, operator, b)| format!("({a} {operator} {b})"))
    })
}

/// More by hand: LAR_SCENES=100000.
fn n_scenes() -> u32 {
    std::env::var("LAR_SCENES").ok().and_then(|n| n.parse().ok()).unwrap_or(150)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(n_scenes()))]
    #[test]
    fn boxes_of_all_kinds(parts in parts(), text in texts(), rule in 0usize..3, merge in any::<bool>()) {
        let rule = [FillRule::NonZero, FillRule::EvenOdd, FillRule::Positive][rule];
        let merge = if merge { Merge::Coplanar } else { Merge::Nothing };
        check(Arranger::new().merge(merge).checks(Checks::Off), &surfaces(&parts), &text, rule);
        check(Arranger::new(), &surfaces(&parts), "A | B | C | D", rule);
    }
}

/// What random scenes found: overlapping facets that were not all cut alike, and edges lying over each other that were
/// split where only one of them ends, both far from the result.
#[test]
fn facets_that_overlap_are_cut_alike() {
    let part = |(at, size, solid, angle)| Part { at, size, solid, angle, noise: [0; 3], is_flipped: false };
    let scenes = [
        vec![
            ([1, 2, 1], [1, 3, 1], 0, Some(-0.494_059_945_458_656_45)),
            ([1, 0, 4], [1, 3, 1], 0, Some(0.217_167_020_663_721_82)),
            ([2, 1, 2], [1, 2, 2], 0, None),
            ([1, 1, 2], [2, 1, 2], 0, None),
            ([2, 0, 2], [1, 3, 3], 1, None),
            ([2, 4, 4], [2, 2, 1], 0, Some(0.863_240_378_826_643_5)),
        ],
        vec![
            ([4, 4, 0], [2, 1, 1], 0, None),
            ([3, 1, 0], [2, 3, 1], 0, Some(-0.371_658_091_030_982_5)),
            ([0, 0, 0], [1, 1, 1], 0, None),
            ([2, 1, 1], [4, 3, 1], 0, None),
            ([4, 1, 0], [3, 4, 4], 1, None),
            ([0, 0, 0], [1, 1, 1], 0, Some(0.215_606_506_966_220_2)),
            ([1, 2, 1], [4, 3, 1], 0, None),
        ],
        vec![
            ([3, 4, 4], [2, 1, 4], 0, Some(-0.906_782_254_183_602_1)),
            ([0, 0, 0], [1, 1, 1], 0, None),
            ([2, 3, 4], [4, 2, 4], 0, None),
            ([2, 2, 4], [2, 2, 1], 1, None),
            ([3, 4, 2], [1, 1, 3], 1, None),
            ([2, 3, 3], [2, 2, 2], 2, Some(0.014_904_863_693_158_72)),
        ],
    ];
    for scene in scenes {
        let surfaces = surfaces(&scene.into_iter().map(part).collect::<Vec<_>>());
        for rule in [FillRule::NonZero, FillRule::EvenOdd] {
            check(Arranger::new(), &surfaces, "A | B | C | D", rule);
        }
    }
}

/// Squares of cubes all over each other.
fn heap(n: u32) -> Vec<Surface> {
    let cube = cuboid_grid(&[1, 1, 1]);
    let one = |i: u32| {
        let [x, y, z] = [0.37, 0.71, 0.59].map(|step| (f64::from(i) * step).fract());
        let map = t(&[x, y, z]).compose(&r([x + 0.1, 2.0 * y, 3.0 * z])).expect("of space");
        cube.to_surface(format!("cube {i}")).expect("a cube").transformed(&map).expect("of space")
    };
    (0..n).map(one).collect()
}

#[test]
fn heaps_of_cubes() {
    let names = operand_names(24);
    let [first, second] = [names[..12].join(" | "), names[12..].join(" | ")];
    for text in [
        names.join(" | "),
        names.join(" & "),
        names.join(" ^ "),
        format!("({first}) - ({second})"),
        "!(A | C) & F".to_owned(),
    ] {
        check(Arranger::new(), &heap(24), &text, FillRule::NonZero);
    }
}

/// Where planes cross everywhere nothing much is dead: the division ends before boxes are small, and facets meet more
/// boxes than are compared.
#[test]
fn crossing_walls() {
    let cube = cuboid_grid(&[1, 1, 1]);
    let wall = |i: u32, is_along: bool| {
        let at = f64::from(i) + if is_along { 0.25 } else { 0.3 };
        let (low, size) = match is_along {
            true => ([at, 0.0, 0.0], [0.25, 14.0, 10.0]),
            false => ([0.0, at, 3.0], [14.0, 0.3, 10.0]),
        };
        let map = t(&low).compose(&s(&size)).expect("of space");
        cube.to_surface(format!("{i} {is_along}")).expect("a cube").transformed(&map).expect("of space")
    };
    let walls: Vec<Surface> = (0..14).flat_map(|i| [wall(i, true), wall(i, false)]).collect();
    for operator in [" | ", " ^ "] {
        check(Arranger::new(), &walls, &operand_names(28).join(operator), FillRule::NonZero);
    }
}

#[test]
fn shells_and_spheres() {
    let sphere = |radius: f64, at: f64| {
        let mesh = icosphere(3);
        let map = t(&[at, 0.1, 0.2]).compose(&s(&[radius; 3])).expect("of space");
        TriangleMesh { points: map.apply(&mesh.points).expect("of space"), ..mesh }
    };
    let inside_out = |mut mesh: TriangleMesh| {
        mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        mesh
    };
    let ring = joined("hollow".to_owned(), &[sphere(2.0, 0.0), inside_out(sphere(1.0, 0.0))]);
    let core = joined("core".to_owned(), &[sphere(0.5, 0.1)]);
    let far = joined("far".to_owned(), &[sphere(1.5, 2.0)]);
    for text in ["A | B | C", "A - C", "C - A", "A ^ B ^ C", "A & C", "B - C", "!A"] {
        check(Arranger::new(), &[ring.clone(), core.clone(), far.clone()], text, FillRule::NonZero);
    }
}

/// A surface that only edges lying over each other close, an open one, and none at all.
#[test]
fn operands_that_are_not_closed_edge_by_edge() {
    let grid = |n: usize| cuboid_grid(&[n, 1, 1]).to_surface("grid").expect("a grid");
    let cube = heap(1).remove(0);
    // Squares against halves of them.
    let mut halves = Surface::new("halves", Points::from_columns(3, [grid(2).points.coords()].concat()));
    let two = grid(2);
    for f in 0..two.n_faces() {
        let x = |v: &u32| two.points.xyz(*v as usize)[0];
        let loops: Vec<Vec<u32>> = two.face(f).map(<[u32]>::to_vec).collect();
        if two.coefficient(f) != 0 && loops.iter().flatten().any(|v| x(v) != 1.0) {
            halves.push_face(loops.iter().map(Vec::as_slice), two.coefficient(f));
        }
    }
    check(Arranger::new(), &[halves.clone(), cube.clone()], "A | B", FillRule::NonZero);
    let mut open = cube.clone();
    open = Surface::from_polygons("open", open.points.clone(), {
        let mut kept = lar_core::Cells::with_capacity(5, 20);
        (0..5).for_each(|f| cube.face(f).for_each(|l| kept.push(l)));
        kept
    });
    check(Arranger::new(), &[open.clone(), cube.clone()], "A | B", FillRule::NonZero);
    // It is no matter when the expression does not name it.
    check(Arranger::new(), &[open, cube, halves], "B & C", FillRule::NonZero);
    let none =
        direct(Arranger::new(), &[], &Expression::solid(0), (FillRule::NonZero, Detail::Simplified, 0));
    assert_eq!(none.err(), Some(BooleanError::NoSuchSolid { solid: 0, n_solids: 0 }));
}

#[test]
fn it_can_be_stopped_at_any_report() {
    let (scene, union) = (heap(16), Expression::union_of(16));
    let n_reports = std::sync::atomic::AtomicUsize::new(0);
    let count = |_| _ = n_reports.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    let options = (FillRule::NonZero, Detail::Simplified, 0);
    let whole = direct(Arranger::new().progress(&count), &scene, &union, options).expect("closed");
    for stop in (0..n_reports.into_inner()).step_by(3) {
        let (cancel, seen) = (Cancel::new(), std::sync::atomic::AtomicUsize::new(0));
        let report = |_| {
            if seen.fetch_add(1, std::sync::atomic::Ordering::Relaxed) == stop {
                cancel.request();
            }
        };
        match direct(Arranger::new().progress(&report).cancel(&cancel), &scene, &union, options) {
            Err(error) => assert_eq!(error, BooleanError::Cancelled),
            Ok(surface) => assert_eq!(faces(&surface), faces(&whole), "asked too late"),
        }
    }
}

/// The public entry takes both ways.
#[test]
fn few_and_many_overlaps() {
    for n in [3, 60] {
        let (scene, union) = (heap(n), Expression::union_of(n as usize));
        let (surface, stats) =
            Arranger::new().boolean(&scene, &union, FillRule::NonZero, Detail::Simplified).expect("closed");
        let arrangement = Arranger::new().arrange(&scene).expect("finite");
        let is_divided = stats.stages.iter().any(|stage| stage.0 == "live boxes");
        assert_eq!(
            is_divided,
            arrangement.stats().pairs_tested > (PAIRS_WORTH_DIVIDING as u64) * stats.facets
        );
        assert_eq!(is_divided, n == 60);
        let of_cells = arrangement.boolean(&union, FillRule::NonZero).expect("closed");
        assert_eq!(faces(&surface), faces(&of_cells.to_complex(Detail::Simplified)));
    }
}
