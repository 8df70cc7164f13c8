//! Degenerate input with known counts. Each scene is arranged again under quarter turns, mirrored and permuted
//! axes, integer translations, permuted solids, faces and points, and flipped faces: all counts must agree.

mod common;

use common::{
    all_counts, arranged, assert_close, counts, cuboid, exact_motions, flipped, mapped, relabelled,
    sorted_volumes, surface, surfaces,
};
use lar_arrangement::{Arrangement, Closure};
use lar_core::{CellId, Struct, Surface, cuboid_grid, r, t};

/// Vertices, edges, faces, cells; then all variants.
#[track_caller]
fn check(input: &[Surface], expected: [usize; 4]) -> Arrangement {
    let a = check_variants(input);
    assert_eq!(counts(&a), expected);
    a
}

/// All variants against the first arrangement, which is returned.
#[track_caller]
fn check_variants(input: &[Surface]) -> Arrangement {
    let a = arranged(input);
    let volumes = sorted_volumes(&a);
    let size = volumes.iter().fold(1.0, |m: f64, &v| m.max(v));
    for (name, variant) in variants(input) {
        let other = arranged(&variant);
        assert_eq!(all_counts(&other), all_counts(&a), "{name}");
        assert_close(&sorted_volumes(&other), &volumes, 1e-9 * size, name);
    }
    a
}

fn variants(input: &[Surface]) -> Vec<(&'static str, Vec<Surface>)> {
    let shifted = input.iter().map(|s| mapped(s, |[x, y, z]| [x + 1000.0, y - 7.0, z + 64.0])).collect();
    let mut variants = exact_motions(input);
    variants.extend(relabelled(input, 7));
    variants.push(("translated", shifted));
    variants
}

fn square_at(z: f64, lo: [f64; 2], hi: [f64; 2]) -> Surface {
    let points = [[lo[0], lo[1], z], [hi[0], lo[1], z], [hi[0], hi[1], z], [lo[0], hi[1], z]];
    surface(&points, &[&[0, 1, 2, 3]])
}

fn cube(lo: f64, hi: f64) -> Surface {
    cuboid([lo; 3], [hi; 3])
}

/// The faces of several surfaces as one.
fn together(parts: &[Surface]) -> Surface {
    let mut points = Vec::new();
    let mut faces: Vec<Vec<u32>> = Vec::new();
    for part in parts {
        let base = points.len() as u32;
        points.extend((0..part.points.len()).map(|i| part.points.xyz(i)));
        faces.extend(
            (0..part.n_faces()).flat_map(|f| part.face(f)).map(|l| l.iter().map(|v| v + base).collect()),
        );
    }
    surface(&points, &faces.iter().map(Vec::as_slice).collect::<Vec<_>>())
}

#[test]
fn nothing_and_next_to_nothing() {
    assert_eq!(counts(&arranged(&[])), [0, 0, 0, 1]);
    check(&[surface(&[], &[])], [0, 0, 0, 1]);
    check(&[surface(&[[1.0, 2.0, 3.0]], &[])], [0, 0, 0, 1]);
    check(&[surface(&[[0.0; 3], [3.0, 0.0, 0.0], [0.0, 5.0, 1.0]], &[&[0, 1, 2]])], [3, 3, 1, 1]);
    let line = surface(&[[0.0; 3], [1.0; 3], [2.0; 3], [5.0; 3]], &[&[0, 1, 2], &[0, 1, 3, 2]]);
    let a = check(&[line], [0, 0, 0, 1]);
    assert_eq!(a.stats().degenerate_faces, 2);
}

/// ```text
///   ┌─────┐
///   │  ┌──┼──┐
///   └──┼──┘  │
///      └─────┘
/// ```
#[test]
fn coplanar_overlaps() {
    let (a, b) = (square_at(0.0, [0.0; 2], [2.0; 2]), square_at(0.0, [1.0; 2], [3.0; 2]));
    let both = check(&[a.clone(), b.clone()], [10, 12, 3, 1]);
    assert_eq!(both.dangling_faces().count(), 3);
    assert_eq!(both.closure(0), Closure::Open);
    check(&[a.clone(), b.clone(), a.clone()], [10, 12, 3, 1]);
    // A third square over the overlap, and one inside a square.
    check(&[a.clone(), b, square_at(0.0, [1.0; 2], [2.0; 2])], [10, 12, 3, 1]);
    let ring = check(&[a.clone(), square_at(0.0, [0.5; 2], [1.5; 2])], [8, 8, 2, 1]);
    assert_eq!(ring.n_loops(), 3);
    // A common edge, part of a common edge, a common corner.
    check(&[a.clone(), square_at(0.0, [2.0, 0.0], [4.0, 2.0])], [6, 7, 2, 1]);
    check(&[a.clone(), square_at(0.0, [2.0, 0.5], [4.0, 1.5])], [8, 9, 2, 1]);
    check(&[a, square_at(0.0, [2.0, 2.0], [4.0, 4.0])], [7, 8, 2, 1]);
}

#[test]
fn duplicates() {
    let square = square_at(0.0, [0.0; 2], [1.0; 2]);
    let a = check(&[square.clone(), flipped(&square)], [4, 4, 1, 1]);
    let signs: Vec<i8> = a.parents(lar_core::FaceId(0)).iter().map(|p| p.sign).collect();
    assert_eq!(signs, [1, -1]);
    let twice = check(&[cube(0.0, 1.0), cube(0.0, 1.0)], [8, 12, 6, 2]);
    assert_eq!([0, 1].map(|s| twice.winding(CellId(1), s)), [1, 1]);
    let inverted = check(&[cube(0.0, 1.0), flipped(&cube(0.0, 1.0))], [8, 12, 6, 2]);
    assert_eq!([0, 1].map(|s| inverted.winding(CellId(1), s)), [1, -1]);
    let one = check(&[together(&[cube(0.0, 1.0), cube(0.0, 1.0)])], [8, 12, 6, 2]);
    assert_eq!(one.winding(CellId(1), 0), 2);
    // Its faces cancel, so it bounds nothing, but they are there.
    let none = check(&[together(&[cube(0.0, 1.0), flipped(&cube(0.0, 1.0))])], [8, 12, 6, 2]);
    assert_eq!(none.winding(CellId(1), 0), 0);
}

#[test]
fn touching_solids() {
    let unit = cube(0.0, 1.0);
    let with = |lo: [f64; 3], hi: [f64; 3]| [unit.clone(), cuboid(lo, hi)];
    let vertex = check(&with([1.0; 3], [2.0; 3]), [15, 24, 12, 3]);
    assert_eq!(vertex.n_components(), 1);
    check(&with([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]), [14, 23, 12, 3]);
    check(&with([1.0, 1.0, 0.5], [2.0, 2.0, 2.0]), [16, 25, 12, 3]);
    check(&with([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]), [12, 20, 11, 3]);
    let inside = check(&with([1.0, 0.25, 0.25], [2.0, 0.75, 0.75]), [16, 24, 12, 3]);
    assert_eq!((inside.n_loops(), inside.n_components()), (13, 1));
}

/// A corner, then an edge, of a tetrahedron on the inside of a cube's face.
#[test]
fn tetrahedra_standing_on_a_face() {
    let tetrahedron =
        |points: [[f64; 3]; 4]| surface(&points, &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]]);
    let on_corner = tetrahedron([[2.0, 2.0, 4.0], [1.0, 1.0, 6.0], [3.0, 1.0, 6.0], [2.0, 3.0, 6.0]]);
    let a = check(&[cube(0.0, 4.0), on_corner], [12, 18, 10, 3]);
    assert_eq!((a.n_loops(), a.n_shells()), (10, 4));
    let on_edge = tetrahedron([[1.0, 1.0, 4.0], [3.0, 3.0, 4.0], [1.0, 3.0, 6.0], [3.0, 1.0, 6.0]]);
    let a = check(&[cube(0.0, 4.0), on_edge], [12, 18, 10, 3]);
    assert_eq!(a.n_loops(), 11, "the edge is a hole of its own");
    // The same edge, ending on the border of the face and running through it.
    let at_border = tetrahedron([[0.0, 1.0, 4.0], [3.0, 3.0, 4.0], [1.0, 3.0, 6.0], [3.0, 1.0, 6.0]]);
    assert_eq!(check(&[cube(0.0, 4.0), at_border], [12, 19, 10, 3]).n_loops(), 10);
    let across = tetrahedron([[-1.0, 1.0, 4.0], [5.0, 3.0, 4.0], [1.0, 3.0, 6.0], [3.0, 1.0, 6.0]]);
    check(&[cube(0.0, 4.0), across], [14, 22, 11, 3]);
}

#[test]
fn open_sheets() {
    let solid = cuboid([0.0; 3], [2.0; 3]);
    let through = check(&[solid.clone(), square_at(1.0, [-1.0; 2], [3.0; 2])], [16, 24, 12, 3]);
    assert_eq!(through.dangling_faces().count(), 1);
    let ending = check(&[solid.clone(), square_at(1.0, [-1.0; 2], [1.0, 3.0])], [16, 23, 9, 2]);
    assert_eq!((ending.dangling_faces().count(), ending.n_loops()), (2, 9));
    let floating = check(&[solid.clone(), square_at(1.0, [0.5; 2], [1.5; 2])], [12, 16, 7, 2]);
    assert_eq!((floating.dangling_faces().count(), floating.n_shells()), (1, 3));
    let in_face = check(&[solid.clone(), square_at(0.0, [0.5; 2], [1.5; 2])], [12, 16, 7, 2]);
    assert_eq!((in_face.dangling_faces().count(), in_face.n_loops()), (0, 8));
    let around_face = check(&[solid.clone(), square_at(0.0, [-1.0; 2], [3.0; 2])], [12, 16, 7, 2]);
    assert_eq!(around_face.dangling_faces().count(), 1);
    check(&[solid, square_at(0.0, [0.0; 2], [2.0; 2])], [8, 12, 6, 2]);
}

/// U-shaped sheets hooked into each other: the ray of each one's first edge towards −x hits the other.
///
/// ```text
///         ┌────────┐  A        z
///    │    │   │    │           │
///    │    │   │    │           └── x
///  B └────────┘
/// ```
#[test]
fn hooked_sheets() {
    let wall = |x: f64, z: [f64; 2]| {
        let points = [[x, 0.0, z[0]], [x, 4.0, z[0]], [x, 4.0, z[1]], [x, 0.0, z[1]]];
        surface(&points, &[&[0, 1, 2, 3]])
    };
    let floor = |x: [f64; 2], z: f64| square_at(z, [x[0], 0.0], [x[1], 4.0]);
    let down = together(&[wall(10.0, [0.0, 4.0]), floor([0.0, 10.0], 4.0), wall(0.0, [0.0, 4.0])]);
    let up = together(&[wall(5.0, [3.0, -9.0]), floor([-5.0, 5.0], -9.0), wall(-5.0, [-9.0, 3.0])]);
    let a = check(&[down, up], [16, 20, 6, 1]);
    assert_eq!((a.n_shells(), a.n_components()), (2, 2));
}

/// A square frame: outer side 6, hole of side 4, height 1, its plane normal to z.
fn frame(center: [f64; 3]) -> Surface {
    let ring = |half: f64, z: f64| [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]];
    let points: Vec<[f64; 3]> = [ring(3.0, -0.5), ring(2.0, -0.5), ring(3.0, 0.5), ring(2.0, 0.5)]
        .concat()
        .into_iter()
        .map(|p| [0, 1, 2].map(|k| p[k] + center[k]))
        .collect();
    let mut out = surface(&points, &[]);
    out.push_face([&[3u32, 2, 1, 0][..], &[4, 5, 6, 7]], 1);
    out.push_face([&[8u32, 9, 10, 11][..], &[15, 14, 13, 12]], 1);
    for i in 0..4 {
        let j = (i + 1) % 4;
        out.push_face([&[i, j, 8 + j, 8 + i][..]], 1);
        out.push_face([&[4 + j, 4 + i, 12 + i, 12 + j][..]], 1);
    }
    out
}

#[test]
fn faces_with_holes() {
    let mut plate = surface(&[], &[]);
    plate.points = frame([0.0; 3]).points;
    plate.push_face([&[0u32, 1, 2, 3][..], &[7, 6, 5, 4]], 1);
    let a = check(&[plate], [8, 8, 1, 1]);
    assert_eq!(a.n_loops(), 2);
    let one = check(&[frame([0.0; 3])], [16, 24, 10, 2]);
    assert_close(&sorted_volumes(&one), &[20.0], 1e-12, "frame");
    // A bolt that fills the hole, one that leaves a gap, one that covers the border of the hole.
    let bolt = |half: f64| cuboid([-half, -half, -2.0], [half, half, 2.0]);
    check(&[frame([0.0; 3]), bolt(2.0)], [24, 40, 20, 3]);
    let gap = check(&[frame([0.0; 3]), bolt(0.5)], [24, 36, 16, 3]);
    assert_eq!(gap.n_components(), 2);
    check(&[frame([0.0; 3]), bolt(2.5)], [32, 52, 26, 4]);
}

/// Links of a chain.
#[test]
fn linked_frames() {
    let upright = mapped(&frame([0.0, 3.5, 0.0]), |[x, y, z]| [z, y, -x]);
    let a = check(&[frame([0.0; 3]), upright.clone()], [32, 48, 20, 3]);
    assert_eq!((a.n_shells(), a.n_components()), (4, 2));
    let third = frame([0.0, 7.0, 0.0]);
    check(&[frame([0.0; 3]), upright, third], [48, 72, 30, 4]);
}

#[test]
fn crossing_cubes_as_one_surface() {
    let a = check(&[together(&[cube(0.0, 2.0), cube(1.0, 3.0)])], [22, 36, 18, 4]);
    let mut windings: Vec<i32> = (0..4).map(|c| a.winding(CellId(c), 0)).collect();
    windings.sort_unstable();
    assert_eq!(windings, [0, 1, 1, 2]);
    assert_close(&sorted_volumes(&a), &[1.0, 7.0, 7.0], 1e-12, "volumes");
}

#[test]
fn nested_shells_and_many_components() {
    let shells: Vec<Surface> = (0..5).map(|k| cube(f64::from(k), 10.0 - f64::from(k))).collect();
    let a = check(&shells, [40, 60, 30, 6]);
    assert_eq!((a.n_shells(), a.n_components()), (10, 5));
    let one = check(&[together(&shells)], [40, 60, 30, 6]);
    let mut windings: Vec<i32> = (0..6).map(|c| one.winding(CellId(c), 0)).collect();
    windings.sort_unstable();
    assert_eq!(windings, [0, 1, 2, 3, 4, 5]);
    let mut crowd = vec![cube(0.0, 16.0)];
    for i in 0..27 {
        let at = [i % 3, i / 3 % 3, i / 9].map(|k| 1.0 + 5.0 * f64::from(k));
        crowd.push(cuboid(at, at.map(|x| x + 3.0)));
    }
    crowd.push(cuboid([2.0; 3], [3.0; 3]));
    let a = check(&crowd, [29 * 8, 29 * 12, 29 * 6, 30]);
    assert_eq!(a.n_shells(), 58);
}

/// Tetrahedra between an axis and an octagon around it, all eight or every second one.
#[test]
fn fans_around_an_edge() {
    let ring = [[4, 0], [3, 3], [0, 4], [-3, 3], [-4, 0], [-3, -3], [0, -4], [3, -3]];
    let tetrahedron = |i: usize| {
        let corner = |[x, y]: [i32; 2]| [f64::from(x), f64::from(y), 2.0];
        let points = [[0.0; 3], [0.0, 0.0, 4.0], corner(ring[i]), corner(ring[(i + 1) % 8])];
        surface(&points, &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]])
    };
    check(&(0..8).map(tetrahedron).collect::<Vec<_>>(), [10, 25, 24, 9]);
    let half: Vec<Surface> = (0..4).map(|i| tetrahedron(2 * i)).collect();
    check(&half, [10, 21, 16, 5]);
}

#[test]
fn octants_around_a_vertex() {
    let octant = |i: u32| {
        let s = [0, 1, 2].map(|k| if i >> k & 1 == 0 { 2.0 } else { -2.0 });
        let points = [[0.0; 3], [s[0], 0.0, 0.0], [0.0, s[1], 0.0], [0.0, 0.0, s[2]]];
        surface(&points, &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]])
    };
    check(&(0..8).map(octant).collect::<Vec<_>>(), [7, 18, 20, 9]);
    // Four that meet two by two in edges, and two that meet in the vertex only.
    check(&[0, 3, 5, 6].map(octant), [7, 18, 16, 5]);
    check(&[0, 7].map(octant), [7, 12, 8, 3]);
}

/// ```text
///   ├───────┤  one edge above,
///   ├───┬───┤  two below
/// ```
#[test]
fn t_junctions() {
    let at = |x: f64, y: f64| [x, y, 0.0];
    let points = [at(0.0, 0.0), at(4.0, 0.0), at(0.0, 4.0), at(2.0, 0.0), at(1.0, -2.0), at(3.0, -2.0)];
    check(&[surface(&points, &[&[0, 1, 2], &[0, 4, 3], &[3, 5, 1]])], [6, 8, 3, 1]);
    // A box whose lid is two polygons while its front is one.
    let mut lid: Vec<[f64; 3]> =
        (0..8).map(|i| [0, 1, 2].map(|k| if i >> k & 1 == 0 { 0.0 } else { 2.0 })).collect();
    lid.extend([[1.0, 0.0, 2.0], [1.0, 2.0, 2.0]]);
    let faces: [&[u32]; 7] = [
        &[0, 4, 6, 2],
        &[1, 3, 7, 5],
        &[0, 1, 5, 4],
        &[2, 6, 7, 3],
        &[0, 2, 3, 1],
        &[4, 8, 9, 6],
        &[8, 5, 7, 9],
    ];
    let a = check(&[surface(&lid, &faces)], [10, 15, 7, 2]);
    assert_eq!(a.closure(0), Closure::Closed);
}

#[test]
fn repeated_points_and_degenerate_faces() {
    let mut solid = cuboid([0.0; 3], [2.0; 3]);
    solid.push_face([&[0u32, 1, 1][..]], 1);
    solid.push_face([&[0u32, 0, 0, 0][..]], 1);
    solid.push_face([&[3u32, 3, 7][..]], 1);
    let a = check(&[solid], [8, 12, 6, 2]);
    assert_eq!(a.stats().degenerate_faces, 3);
    // The points of every face are its own, and the first face repeats some.
    let square = square_at(0.0, [0.0; 2], [1.0; 2]);
    let repeated = surface(
        &[[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        &[&[0, 1, 2, 3, 4, 5]],
    );
    check(&[repeated, square], [4, 4, 1, 1]);
}

/// A floor with boxes standing on it and boxes piercing it in turn.
#[test]
fn a_floor_cut_by_hundreds_of_boxes() {
    let n = 20;
    let mut input = vec![square_at(0.0, [0.0; 2], [200.0; 2])];
    for i in 0..n * n {
        let at = [i % n, i / n].map(|k| 10.0 * f64::from(k) + 3.0);
        let depth = if i % 2 == 0 { 0.0 } else { -2.0 };
        input.push(cuboid([at[0], at[1], depth], [at[0] + 4.0, at[1] + 4.0, 3.0]));
    }
    let a = check(&input, [4 + 200 * (8 + 12), 4 + 200 * (12 + 20), 1 + 200 * (6 + 11), 1 + 200 * 3]);
    assert_eq!(a.n_components(), 1);
    let mut floor = (0..a.n_faces() as u32).map(|f| a.face_loops(lar_core::FaceId(f)).len());
    assert_eq!(floor.clone().max(), Some(401));
    assert_eq!(floor.find(|&n| n > 1), Some(401));
}

/// Rounding bends the faces of rotated boxes; their diagonals must disappear again.
#[test]
fn nearly_planar_quadrilaterals() {
    let box_ = || cuboid_grid(&[1, 1, 1]);
    let turned = Struct::new("turned").with(r([0.3, -0.7, 0.2])).with(box_());
    check(&surfaces(&turned), [8, 12, 6, 2]);
    let crossing = turned.with(t(&[0.5; 3])).with(box_());
    check(&surfaces(&crossing), [22, 36, 18, 4]);
    let bars = Struct::new("bars")
        .with(r([0.3, -0.7, 0.2]))
        .with(lar_core::s(&[4.0, 1.0, 1.0]))
        .with(t(&[-0.5; 3]))
        .with(box_())
        .with(t(&[0.5; 3]))
        .with(lar_core::s(&[0.125, 4.0, 0.5]))
        .with(t(&[-0.5; 3]))
        .with(box_());
    check(&surfaces(&bars), [24, 40, 22, 5]);
}

/// A cube with one corner pulled out: three of its faces are no polygons, their diagonals stay. Which diagonals
/// depends on the numbers of the points, and with them the volume; nothing else does.
#[test]
fn skew_quadrilaterals() {
    let pulled = mapped(&cube(0.0, 1.0), |p| if p == [1.0; 3] { [2.0; 3] } else { p });
    for (name, variant) in variants(std::slice::from_ref(&pulled)) {
        let a = arranged(&variant);
        assert_eq!(counts(&a), [8, 15, 9, 2], "{name}");
        assert_eq!(a.stats().triangulated_polygons, 3, "{name}");
    }
    // Loops that start elsewhere, and the other way round: the same diagonals.
    let by_start: Vec<Vec<f64>> = (0..8)
        .map(|seed| sorted_volumes(&arranged(&[common::shuffled(&pulled, &mut common::Random(seed))])))
        .collect();
    by_start.iter().for_each(|v| assert_close(v, &by_start[0], 1e-12, "another start"));
    assert_eq!(counts(&arranged(&[pulled.clone(), flipped(&pulled)])), [8, 15, 9, 2]);
}

/// Two needles of aspect 2^20 through each other, and a fan of them with a common tip.
#[test]
fn slivers() {
    let long = f64::from(1 << 20);
    let needle = |y: f64, z: f64| {
        let points = [[0.0, y, z], [long, 0.0, 0.0], [long, 1.0, 0.0], [long, 0.0, 1.0]];
        surface(&points, &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]])
    };
    let turned = mapped(&needle(0.0, 0.0), |[x, y, z]| [long - x, z, 0.75 - y]);
    let a = check_variants(&[needle(0.0, 0.0), turned]);
    assert!(a.n_cells() >= 4);
    check_variants(&(0..6).map(|i| needle(f64::from(i), f64::from(i * i))).collect::<Vec<_>>());
}

/// The figure-eight immersion of the Klein bottle: closed, crossing itself, without an inside and an outside.
#[test]
fn klein_bottle() {
    let (n, m) = (16u32, 14u32);
    let point = |i: u32, j: u32| {
        let turn = std::f64::consts::TAU;
        let (u, v) = (turn * f64::from(i) / f64::from(n), turn * (f64::from(j) + 0.5) / f64::from(m));
        let radius = 2.0 + (u / 2.0).cos() * v.sin() - (u / 2.0).sin() * (2.0 * v).sin();
        let p = [
            radius * u.cos(),
            radius * u.sin(),
            (u / 2.0).sin() * v.sin() + (u / 2.0).cos() * (2.0 * v).sin(),
        ];
        p.map(|x| (x * 4096.0).round() / 4096.0)
    };
    // One strip more than needed: the seam of the bottle is closed by equal positions, v reversed.
    let points: Vec<[f64; 3]> = (0..n).flat_map(|i| (0..m).map(move |j| point(i, j))).collect();
    let seam: Vec<[f64; 3]> = (0..m).map(|j| point(n, j)).collect();
    let points = [points, seam].concat();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
        let id = |i: u32, j: u32| i * m + j % m;
        triangles.push([id(i, j), id(i + 1, j), id(i + 1, j + 1)]);
        triangles.push([id(i, j), id(i + 1, j + 1), id(i, j + 1)]);
    }
    let bottle = surface(&points, &triangles.iter().map(|t| &t[..]).collect::<Vec<_>>());
    let a = check_variants(&[bottle]);
    // The two lobes of the eight change places on the way round: one cell, inside by parity.
    assert_eq!((a.n_cells(), a.closure(0), a.winding(CellId(1), 0)), (2, Closure::Unoriented, 1));
}
