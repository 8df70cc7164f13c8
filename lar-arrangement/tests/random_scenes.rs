//! Random scenes by their seeds: what must not change, does not, and what must agree, agrees.
//!
//! `LAR_SCENES` sets the number of scenes of each test, `LAR_SEED` the first of their seeds.

mod common;

use common::{
    Random, all_counts, arranged, assert_close, cuboid, each_of, each_seed, exact_motions, mapped,
    random_cubes, relabelled, sorted_volumes, surface,
};
use lar_arrangement::{Arrangement, Arranger, Checks, Detail, Expression, FillRule, Merge, operand_names};
use lar_core::{CellId, FaceId, Points, Struct, Surface, cuboid_grid, r, rotation, s, t, triangular_prism};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use std::num::NonZeroUsize;

/// Relative to the size of the scene.
const ROUNDING: f64 = 1e-9;

fn corner(random: &mut Random, size: usize) -> [f64; 3] {
    [0; 3].map(|_| random.below(size) as f64)
}

fn tetrahedron(random: &mut Random, size: usize) -> Surface {
    let points = [0; 4].map(|_| corner(random, size));
    surface(&points, &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]])
}

fn block(random: &mut Random) -> Surface {
    let lo = corner(random, 4);
    let size = corner(random, 3);
    cuboid(lo, [0, 1, 2].map(|k| lo[k] + size[k] + 1.0))
}

/// A parallelogram with a hole, which a corner or an edge of others is likely to touch.
fn frame(random: &mut Random) -> Surface {
    let (p, a, b) = (corner(random, 4), corner(random, 3), corner(random, 3));
    let at = |i: f64, j: f64| [0, 1, 2].map(|k| p[k] + i * (a[k] - 1.0) + j * (b[k] - 1.0));
    let quad = |lo: f64, hi: f64| [at(lo, lo), at(hi, lo), at(hi, hi), at(lo, hi)];
    let mut out = surface(&[quad(0.0, 3.0), quad(1.0, 2.0)].concat(), &[]);
    out.push_face([&[0u32, 1, 2, 3][..], &[7, 6, 5, 4]], 1);
    out
}

fn sheet(random: &mut Random) -> Surface {
    surface(&[corner(random, 5), corner(random, 5), corner(random, 5)], &[&[0, 1, 2]])
}

fn mixed_scene(random: &mut Random) -> Vec<Surface> {
    (0..2 + random.below(3))
        .map(|_| match random.below(4) {
            0 => tetrahedron(random, 5),
            1 => block(random),
            2 => frame(random),
            _ => sheet(random),
        })
        .collect()
}

fn json(input: &[Surface], threads: usize) -> String {
    let threads = NonZeroUsize::new(threads).expect("at least one thread");
    let a = Arranger::new().threads(threads).arrange(input).expect("finite input");
    a.complex().to_json().expect("the complex is valid")
}

#[test]
fn names_orders_axes_and_threads_do_not_matter() {
    each_seed(40, |seed| {
        let random = &mut Random(seed);
        let input = mixed_scene(random);
        let a = arranged(&input);
        assert_eq!(json(&input, 1), json(&input, 3));
        for (name, variant) in exact_motions(&input).into_iter().chain(relabelled(&input, seed)) {
            let other = arranged(&variant);
            assert_eq!(all_counts(&other), all_counts(&a), "{name}");
            assert_close(&sorted_volumes(&other), &sorted_volumes(&a), ROUNDING, name);
        }
    });
}

/// Coplanar faces of triangles merged: the same cells with the same volumes and winding numbers.
#[test]
fn merged_faces_bound_the_same_cells() {
    // Four facets of one sliver, meant to be in one plane, close up.
    each_of([50_014_626], 40, |seed| {
        let random = &mut Random(seed);
        let triangles = |s: &Surface| match s.face(0).len() {
            1 => Surface::from_triangles("triangles", &common::triangle_mesh(s)),
            _ => s.clone(),
        };
        let mut input: Vec<Surface> = mixed_scene(random).iter().map(triangles).collect();
        if random.below(2) == 0 {
            let axis = [0; 3].map(|_| random.between(-1.0, 1.0));
            input = common::moved(&input, &rotation(axis, random.between(0.1, 6.0)).expect("an axis"));
        }
        let apart = arranged(&input);
        let arranger = Arranger::new().checks(Checks::EveryStage).merge(Merge::Coplanar);
        let merged = arranger.arrange(&input).unwrap_or_else(|e| panic!("{e}"));
        assert!(merged.n_faces() <= apart.n_faces());
        assert_eq!((merged.n_cells(), merged.n_shells()), (apart.n_cells(), apart.n_shells()));
        assert_close(&merged.volumes(), &apart.volumes(), ROUNDING, "volumes");
        for (cell, solid) in
            (0..apart.n_cells() as u32).flat_map(|c| (0..input.len()).map(move |s| (CellId(c), s)))
        {
            assert_eq!(merged.winding(cell, solid), apart.winding(cell, solid), "{cell}, solid {solid}");
        }
        for (solid, surface) in input.iter().enumerate() {
            assert_eq!(merged.closure(solid), apart.closure(solid), "{}", surface.name);
            let Ok(out) = merged.boolean(&Expression::solid(solid), FillRule::EvenOdd) else { continue };
            assert!(out.to_complex(Detail::Simplified).is_closed());
        }
    });
}

/// Integers are kept by snapping, and so is what lies one unit in the last place beside them.
#[test]
fn one_unit_in_the_last_place_changes_nothing() {
    each_seed(150, |seed| {
        let random = &mut Random(seed);
        let input = mixed_scene(random);
        let mut beside = |x: f64| match random.below(4) {
            0 => x.next_up(),
            1 => x.next_down(),
            _ => x,
        };
        let other: Vec<Surface> = input.iter().map(|s| with_coordinates(s, &mut beside)).collect();
        assert_eq!(all_counts(&arranged(&other)), all_counts(&arranged(&input)));
    });
}

fn with_coordinates(s: &Surface, map: &mut impl FnMut(f64) -> f64) -> Surface {
    let mut out = s.clone();
    out.points = Points::from_columns(3, s.points.coords().iter().map(|&x| map(x)).collect());
    out
}

/// Loops of corners in one plane, in any order, some twice, some beside the plane by a step or two of the grid.
fn bent_scribble(random: &mut Random) -> Surface {
    let (p, a, b) = (corner(random, 4), corner(random, 3), corner(random, 3));
    let mut points = Vec::new();
    let mut out = surface(&[], &[]);
    let mut loops: Vec<Vec<u32>> = Vec::new();
    for _ in 0..1 + random.below(2) {
        let first = points.len() as u32;
        for _ in 0..4 + random.below(4) {
            let [i, j] = [0; 2].map(|_| random.below(4) as f64);
            let bend = [0; 3].map(|_| [0.0, 0.0, 1.0, -1.0, 2.0][random.below(5)] * 2f64.powi(-36));
            points.push([0, 1, 2].map(|k| p[k] + i * (a[k] - 1.0) + j * (b[k] - 1.0) + bend[k]));
        }
        loops.push((first..points.len() as u32).collect());
    }
    out.points = Points::from_xyz(&points);
    out.push_face(loops.iter().map(Vec::as_slice), 1);
    out
}

/// Nearly planar polygons that cross themselves fold when they are cut into triangles.
#[test]
fn bent_scribbles_keep_every_law() {
    let found = [10_438, 579_238, 140_068_273];
    each_of(found, 200, |seed| {
        let random = &mut Random(seed);
        let mut input: Vec<Surface> = (0..1 + random.below(3)).map(|_| bent_scribble(random)).collect();
        if random.below(2) == 0 {
            input.push(block(random));
        }
        let a = arranged(&input);
        let flipped: Vec<Surface> = input.iter().map(common::flipped).collect();
        assert_eq!(all_counts(&arranged(&flipped)), all_counts(&a));
        for solid in 0..a.n_solids() {
            let expression = Expression::solid(solid);
            let Ok(solid) = a.boolean(&expression, FillRule::EvenOdd) else { continue };
            for detail in [Detail::Fragments, Detail::Simplified] {
                let out = solid.to_complex(detail);
                assert!(out.is_closed());
                assert_eq!(out.complex.validate(), [], "{detail:?}");
            }
        }
    });
}

/// Blocks on one plane, each on either side and counted with either sign, as one solid; their faces in the plane are one face
/// of many loops, in any order and whichever way they turn, or one face each.
fn blocks_on_a_plane(random: &mut Random) -> [Surface; 2] {
    let (mut joined, mut apart) = (surface(&[], &[]), surface(&[], &[]));
    let (mut points, mut loops) = (Vec::new(), Vec::new());
    for _ in 0..2 + random.below(3) {
        let (lo, size) = (corner(random, 5), corner(random, 4));
        let (above, inwards) = (random.below(2) == 0, random.below(3) == 0);
        let z = if above { [2.0, 3.0 + size[2]] } else { [1.0 - size[2], 2.0] };
        let first = points.len() as u32;
        points.extend((0..8).map(|i| {
            let at = |k: usize| lo[k] + f64::from(u32::from(i >> k & 1 == 1)) * (size[k] + 1.0);
            [at(0), at(1), z[i >> 2]]
        }));
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        for (i, side) in sides.into_iter().enumerate() {
            let mut cycle = side.map(|v: u32| first + v);
            if inwards {
                cycle.reverse();
            }
            apart.push_face([&cycle[..]], 1);
            if i == usize::from(!above) {
                loops.push(cycle);
            } else {
                joined.push_face([&cycle[..]], 1);
            }
        }
    }
    joined.push_face(loops.iter().map(|l| &l[..]), 1);
    (joined.points, apart.points) = (Points::from_xyz(&points), Points::from_xyz(&points));
    [joined, apart]
}

/// A face is the sum of its loops, also where they cross, touch, lie outside of each other or turn the wrong way.
#[test]
fn faces_are_the_sums_of_their_loops() {
    each_of([150_110_035], 60, |seed| {
        let random = &mut Random(seed);
        let [joined, apart] = blocks_on_a_plane(random);
        let others: Vec<Surface> = (0..1 + random.below(2)).map(|_| block(random)).collect();
        let turned = random.below(2) == 0;
        let turn = rotation([0; 3].map(|_| random.between(-1.0, 1.0)), 1.0).expect("an axis");
        let first = random.below(2) == 0;
        let volumes = |solid: &Surface| {
            let mut input = others.clone();
            input.insert(if first { 0 } else { others.len() }, solid.clone());
            let a = arranged(&if turned { common::moved(&input, &turn) } else { input });
            let mut out: BTreeMap<Vec<i32>, f64> = BTreeMap::new();
            for (cell, volume) in (0u32..).map(CellId).zip(a.volumes()).skip(1) {
                let windings = (0..a.n_solids()).map(|s| a.winding(cell, s)).collect();
                *out.entry(windings).or_default() += volume;
            }
            // Turned blocks may leave cells as thin as a step of rounding between them.
            out.retain(|windings, volume| *volume > ROUNDING && windings.iter().any(|&w| w != 0));
            out
        };
        let (one, many) = (volumes(&joined), volumes(&apart));
        assert_eq!(one.keys().collect::<Vec<_>>(), many.keys().collect::<Vec<_>>());
        let values = |v: &BTreeMap<Vec<i32>, f64>| v.values().copied().collect::<Vec<f64>>();
        assert_close(&values(&one), &values(&many), ROUNDING, "volumes");
    });
}

/// A row-major 3 × 4 matrix of integers.
type Exact = [[f64; 4]; 3];

fn compose(a: &Exact, b: &Exact) -> Exact {
    let entry = |i: usize, j: usize| {
        let sum: f64 = (0..3).map(|k| a[i][k] * b[k][j]).sum();
        sum + if j == 3 { a[i][3] } else { 0.0 }
    };
    [0, 1, 2].map(|i| [0, 1, 2, 3].map(|j| entry(i, j)))
}

/// A hierarchy of moved, doubled, mirrored and quarter-turned blocks and prisms, and its leaves placed by integers.
fn assembly(random: &mut Random, depth: usize, world: &Exact, leaves: &mut Vec<Surface>) -> Struct {
    let mut node = Struct::new(format!("level {depth}"));
    let mut at = *world;
    for _ in 0..1 + random.below(3) {
        let (map, exact) = integer_map(random);
        node.push(map);
        at = compose(&at, &exact);
        if depth > 0 && random.below(2) == 0 {
            node.push(assembly(random, depth - 1, &at, leaves));
            continue;
        }
        let model = if random.below(3) == 0 { triangular_prism() } else { cuboid_grid(&[1, 1, 1]) };
        let place = |p: [f64; 3]| [0, 1, 2].map(|i| (0..3).map(|k| at[i][k] * p[k]).sum::<f64>() + at[i][3]);
        leaves.push(mapped(&model.to_surface("leaf").expect("the model has faces"), place));
        node.push(model);
    }
    node
}

fn integer_map(random: &mut Random) -> (lar_core::Affine, Exact) {
    let mut exact: Exact = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    match random.below(3) {
        0 => {
            let by = corner(random, 3);
            (0..3).for_each(|i| exact[i][3] = by[i]);
            (t(&by), exact)
        }
        1 => {
            let by = [0; 3].map(|_| [1.0, -1.0, 2.0][random.below(3)]);
            (0..3).for_each(|i| exact[i][i] = by[i]);
            (s(&by), exact)
        }
        _ => {
            let (axis, quarters) = (random.below(3), 1 + random.below(3));
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let (cos, sin) = [(0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][quarters - 1];
            (exact[u][u], exact[u][v], exact[v][u], exact[v][v]) = (cos, -sin, sin, cos);
            let mut angles = [0.0; 3];
            angles[axis] = quarters as f64 * FRAC_PI_2;
            (r(angles), exact)
        }
    }
}

/// The sine of a quarter turn is not exact in floating point; the snapped assembly is.
#[test]
fn assemblies_of_quarter_turns_are_exact() {
    each_seed(40, |seed| {
        let random = &mut Random(seed);
        let identity = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        let mut leaves = Vec::new();
        let scene = assembly(random, 3, &identity, &mut leaves);
        let (placed, exact) = (arranged(&common::surfaces(&scene)), arranged(&leaves));
        assert_eq!(all_counts(&placed), all_counts(&exact));
        let volumes = sorted_volumes(&exact);
        let size = volumes.iter().sum::<f64>();
        assert_close(&sorted_volumes(&placed), &volumes, ROUNDING * size, "volumes");
    });
}

/// The value where the solids hold that the bits say.
type Value = Box<dyn Fn(&[bool]) -> bool>;

/// An expression as text, and its value.
struct Formula {
    text: String,
    value: Value,
}

fn formula(random: &mut Random, n: usize, depth: usize) -> Formula {
    if depth == 0 || random.below(4) == 0 {
        let solid = random.below(n);
        return Formula { text: operand_names(n)[solid].clone(), value: Box::new(move |x| x[solid]) };
    }
    let a = formula(random, n, depth - 1);
    let kind = random.below(5);
    if kind == 4 {
        return Formula { text: format!("!({})", a.text), value: Box::new(move |x| !(a.value)(x)) };
    }
    let b = formula(random, n, depth - 1);
    let operators: [fn(bool, bool) -> bool; 4] =
        [|a, b| a || b, |a, b| a && b, |a, b| a && !b, |a, b| a != b];
    let apply = operators[kind];
    let text = format!("({}) {} ({})", a.text, ['|', '&', '-', '^'][kind], b.text);
    Formula { text, value: Box::new(move |x| apply((a.value)(x), (b.value)(x))) }
}

fn closed_scene(random: &mut Random) -> Vec<Surface> {
    match random.below(3) {
        0 => random_cubes(2 + random.below(3), random).0,
        1 => (0..2 + random.below(3)).map(|_| block(random)).collect(),
        _ => (0..2 + random.below(3)).map(|_| tetrahedron(random, 5)).collect(),
    }
}

fn cells(a: &Arrangement, text: &str) -> Vec<CellId> {
    let names = operand_names(a.n_solids());
    let expression = Expression::parse(text, &names).expect("the formula is well formed");
    a.boolean(&expression, FillRule::NonZero).expect("the solids are closed").cells().to_vec()
}

#[test]
fn expressions_hold_where_their_formulas_do() {
    each_seed(100, |seed| {
        let random = &mut Random(seed);
        let a = arranged(&closed_scene(random));
        for _ in 0..3 {
            let f = formula(random, a.n_solids(), 4);
            let inside =
                |cell: CellId| -> Vec<bool> { (0..a.n_solids()).map(|s| a.winding(cell, s) != 0).collect() };
            let expected: Vec<CellId> =
                (0..a.n_cells() as u32).map(CellId).filter(|&c| (f.value)(&inside(c))).collect();
            assert_eq!(cells(&a, &f.text), expected, "{}", f.text);
            check_surface(&a, &f.text);
        }
        let same = [
            ("A - B", "A & !B"),
            ("!(A | B)", "!A & !B"),
            ("!(A & B)", "!A | !B"),
            ("A ^ B", "(A | B) - (A & B)"),
            ("A | A", "A"),
            ("A & A", "A"),
            ("A - A", "B ^ B"),
            ("A & (A | B)", "A"),
            ("A - (A - B)", "A & B"),
            ("!!A", "A"),
        ];
        same.iter().for_each(|(x, y)| assert_eq!(cells(&a, x), cells(&a, y), "{x} = {y}"));
    });
}

/// The surface of a solid, as it was cut and simplified: closed, with the volume and area of the cells.
fn check_surface(a: &Arrangement, text: &str) {
    let expression = Expression::parse(text, &operand_names(a.n_solids())).expect("well formed");
    let solid = a.boolean(&expression, FillRule::NonZero).expect("closed");
    let size: f64 = a.volumes()[1..].iter().sum();
    let volume = if solid.is_bounded() { solid.volume() } else { -cut_off(a, solid.cells()) };
    for detail in [Detail::Fragments, Detail::Simplified] {
        let out = solid.to_complex(detail);
        assert!(out.is_closed(), "{text}: {detail:?}");
        assert_eq!(out.complex.validate(), [], "{text}: {detail:?}");
        let found = out.volume();
        assert!((found - volume).abs() <= ROUNDING * size, "{text}, {detail:?}: {found}, not {volume}");
        let area = out.area();
        assert!((area - solid.area()).abs() <= ROUNDING * area, "{text}, {detail:?}: area {area}");
    }
}

/// Volume of the bounded cells that are not among these.
fn cut_off(a: &Arrangement, cells: &[CellId]) -> f64 {
    let all = (1..a.n_cells() as u32).map(CellId);
    all.filter(|c| cells.binary_search(c).is_err()).map(|c| a.volumes()[c.index()]).sum()
}

fn result(input: &[Surface], text: &str) -> (f64, Surface) {
    let a = arranged(input);
    let expression = Expression::parse(text, &operand_names(input.len())).expect("well formed");
    let solid = a.boolean(&expression, FillRule::NonZero).expect("closed");
    let complex = solid.to_complex(Detail::Simplified);
    let mut out = Surface::new(text, complex.complex.points().clone());
    for f in 0..complex.n_faces() as u32 {
        out.push_face(complex.face_loops(FaceId(f)), 1);
    }
    (solid.volume(), out)
}

/// One after the other, each result rounded and arranged again, against all at once.
#[test]
fn chains_of_booleans_agree_with_one() {
    each_seed(40, |seed| {
        let random = &mut Random(seed);
        let mut input = closed_scene(random);
        input.truncate(3);
        input.resize_with(3, || block(random));
        let size: f64 = arranged(&input).volumes()[1..].iter().sum();
        for [first, then, at_once] in [
            ["A | B", "A | B", "A | B | C"],
            ["A & B", "A & B", "A & B & C"],
            ["A - B", "A - B", "A - (B | C)"],
            ["A ^ B", "A ^ B", "A ^ B ^ C"],
            ["B - A", "B - A", "C - (B - A)"],
        ] {
            let (_, step) = result(&input[..2], first);
            let (volume, _) = result(&[step, input[2].clone()], then);
            let (expected, _) = result(&input, at_once);
            let difference = (volume - expected).abs();
            assert!(difference <= ROUNDING * size, "{at_once}: {volume} in steps, {expected} at once");
        }
    });
}
