//! Input that is refused, input at the ends of the range of `f64`, and polygons that are none.

mod common;

use common::{
    Random, all_counts, arrange_checked, arranged, counts, cuboid, flipped, mapped, prism, surface,
};
use lar_arrangement::ArrangementError;
use lar_core::{Points, Surface};

#[track_caller]
fn refused(input: &Surface) -> ArrangementError {
    arrange_checked(&[cuboid([0.0; 3], [1.0; 3]), input.clone()]).expect_err("the input is malformed")
}

#[test]
fn malformed_input_is_refused_by_name() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = refused(&surface(&[[0.0; 3], [1.0, bad, 0.0], [0.0, 1.0, 0.0]], &[&[0, 1, 2]]));
        assert!(matches!(error, ArrangementError::NotFinite { .. }), "{error}");
        assert!(error.to_string().contains("surface: vertex v1"), "{error}");
    }
    let error = refused(&surface(&[[0.0; 3], [1.0; 3]], &[&[0, 1, 2]]));
    assert_eq!(error.to_string(), "surface: face f0 names vertex v2, but there are 2 vertices");
    let mut flat = Surface::new("plan", Points::from_columns(2, vec![0.0, 0.0, 1.0, 0.0, 0.0, 1.0]));
    flat.push_face([&[0u32, 1, 2][..]], 1);
    assert_eq!(refused(&flat).to_string(), "plan: points of 2 coordinates, an arrangement in space needs 3");
}

/// Two cubes of any size anywhere: a size below the distance of neighbouring numbers collapses, others do not.
#[test]
fn cubes_at_the_ends_of_the_range() {
    let pair = [cuboid([0.0; 3], [2.0; 3]), cuboid([1.0; 3], [3.0; 3])];
    let scaled = |by: f64| pair.clone().map(|s| mapped(&s, |p| p.map(|x| x * by)));
    for by in [1e-280, 1e-150, 1e-30, 1e30, 1e150, 1e300, 5e307] {
        assert_eq!(counts(&arranged(&scaled(by))), [22, 36, 18, 4], "scaled by {by:e}");
    }
    for by in [1e3, 1e9, 1e12, 4e15] {
        let far = pair.clone().map(|s| mapped(&s, |[x, y, z]| [x + by, y, z - by]));
        assert_eq!(counts(&arranged(&far)), [22, 36, 18, 4], "moved by {by:e}");
    }
    let tiny = f64::from_bits(1);
    assert!(arrange_checked(&scaled(tiny)).is_ok());
    assert!(arrange_checked(&[pair[0].clone(), scaled(1e-30)[1].clone()]).is_ok());
    let wide = surface(&[[f64::MIN; 3], [f64::MAX, 0.0, 0.0], [0.0, f64::MAX, f64::MIN]], &[&[0, 1, 2]]);
    assert_eq!(arranged(&[wide]).n_faces(), 1);
}

#[test]
fn faces_without_an_inside_are_left_out() {
    let mut solid = cuboid([0.0; 3], [1.0; 3]);
    let none: [&[u32]; 0] = [];
    solid.push_face(none, 1);
    solid.push_face([&[][..]], 1);
    solid.push_face([&[0u32][..]], 1);
    solid.push_face([&[0u32, 1][..], &[2, 3]], 1);
    let a = arranged(&[solid]);
    assert_eq!((counts(&a), a.stats().degenerate_faces), ([8, 12, 6, 2], 4));
}

/// Polygons of more than 64 corners are cut into triangles and put together again.
#[test]
fn polygons_of_many_corners() {
    for n in [3, 64, 65, 200] {
        let size = n as usize;
        assert_eq!(
            counts(&arranged(&[prism(n, 1.0, 0.0, [0.0, 1.0])])),
            [2 * size, 3 * size, size + 2, 2],
            "{n}"
        );
        // A smaller one through it from below leaves a round hole in the lower face.
        let a = arranged(&[prism(n, 1.0, 0.0, [0.0, 1.0]), prism(n, 0.5, 0.0, [-1.0, 0.5])]);
        assert_eq!(counts(&a), [5 * size, 8 * size, 3 * size + 5, 4], "{n}");
    }
}

/// Loops of 4 to 9 random corners in one of a few planes, with one or two further loops as holes: they cross
/// themselves and each other, run back on themselves, repeat corners.
fn scribble(random: &mut Random) -> Surface {
    let (mut out, mut points) = (surface(&[], &[]), Vec::new());
    for _ in 0..6 + random.below(6) {
        let (axis, level, slope) = (random.below(3), random.below(3), random.below(2));
        let mut loops: Vec<Vec<u32>> = Vec::new();
        for _ in 0..1 + random.below(3) {
            let corners = 4 + random.below(6);
            loops.push((points.len() as u32..(points.len() + corners) as u32).collect());
            for _ in 0..corners {
                let (u, v) = (random.below(5), random.below(5));
                let mut p = [level + slope * u, u, v].map(|x| x as f64);
                p.rotate_right(axis);
                points.push(p);
            }
        }
        out.push_face(loops.iter().map(Vec::as_slice), 1);
    }
    out.points = Points::from_xyz(&points);
    out
}

#[test]
fn scribbles_keep_every_law() {
    let mut n_cells = 0;
    for seed in 0..200 {
        // Two walls' distance of 2: what is scribbled from wall to wall cuts the box.
        let input = [scribble(&mut Random(seed)), cuboid([0.0; 3], [3.0, 2.0, 2.0])];
        let a = arrange_checked(&input).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let turned = input.clone().map(|s| flipped(&s));
        let b = arrange_checked(&turned).unwrap_or_else(|e| panic!("seed {seed}, flipped: {e}"));
        assert_eq!(all_counts(&a), all_counts(&b), "seed {seed}");
        n_cells += a.n_cells() - 2;
    }
    assert!(n_cells > 100, "only {n_cells} cells");
}

/// A polygon of five corners, nearly planar, whose loop passes one point twice: its triangles fold over each other, and
/// one edge is a side of three of them (found by fuzzing).
#[test]
fn nearly_planar_polygons_that_fold() {
    let e = 2f64.powi(-37);
    let points =
        [[2.0 + e, 3.0, 6.0], [5.0, 0.0, 1.0], [2.0, 3.0, 2.0 + e], [5.0 + e, 0.0, 1.0], [3.0, 2.0, 2.0]];
    let folded = surface(&points, &[&[0, 1, 2, 3, 4]]);
    let a = arranged(std::slice::from_ref(&folded));
    assert_eq!(a.dangling_faces().count(), a.n_faces());
    assert_eq!(counts(&arranged(&[folded.clone(), flipped(&folded)])), counts(&a));
}
