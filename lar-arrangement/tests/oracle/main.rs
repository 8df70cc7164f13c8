//! Random triangles, tetrahedra and frames with small integer corners against a second way of counting: all planes cut all of
//! space, in exact integers, and cells, faces, edges and vertices are put together from the pieces.
//!
//! `LAR_SCENES` sets the number of scenes, `LAR_SEED` the first of their seeds.

#[path = "../common/mod.rs"]
mod common;
mod expected;
mod pieces;

use common::{Random, arrange_checked, counts, each_seed, surface};
use expected::{Expected, Face, expected, plane_of};
use lar_core::{CellId, Surface};
use pieces::{Plane, corner, side};

/// Compares the arrangement of the surfaces with the pieces; `solids` are the convex ones among them, by number.
#[track_caller]
fn check(surfaces: &[Vec<Face>], solids: &[Vec<Plane>]) -> usize {
    let input: Vec<Surface> = surfaces.iter().map(|s| surface_of(s)).collect();
    let a = arrange_checked(&input).unwrap_or_else(|e| panic!("{e}: {surfaces:?}"));
    let expected = sorted(expected(&surfaces.concat(), solids));
    let inside = |c: usize| (0..solids.len()).map(|s| a.winding(CellId(c as u32), s) != 0).collect();
    let cells = a.volumes().iter().enumerate().skip(1).map(|(c, &v)| (v, inside(c))).collect();
    let found = sorted(Expected { counts: counts(&a), cells });
    assert_eq!(found.counts, expected.counts, "vertices, edges, faces, cells of {surfaces:?}");
    for (found, expected) in found.cells.iter().zip(&expected.cells) {
        assert!((found.0 - expected.0).abs() < 1e-9, "{found:?} instead of {expected:?}: {surfaces:?}");
        assert_eq!(found.1, expected.1, "{surfaces:?}");
    }
    expected.cells.len()
}

/// By volume up to rounding, then membership.
fn sorted(mut found: Expected) -> Expected {
    let key = |cell: &(f64, Vec<bool>)| ((cell.0 * 1e8).round() as i64, cell.1.clone());
    found.cells.sort_by_key(key);
    found
}

/// One surface, every face with its own points.
fn surface_of(faces: &[Face]) -> Surface {
    let points: Vec<[f64; 3]> = faces.iter().flatten().flatten().map(|p| p.map(f64::from)).collect();
    let mut out = surface(&points, &[]);
    let mut next = 0;
    for face in faces {
        let mut ids = |cycle: &Vec<[i32; 3]>| -> Vec<u32> {
            let begin = next;
            next += cycle.len() as u32;
            (begin..next).collect()
        };
        let loops: Vec<Vec<u32>> = face.iter().map(&mut ids).collect();
        out.push_face(loops.iter().map(Vec::as_slice), 1);
    }
    out
}

fn point(random: &mut Random, size: usize) -> [i32; 3] {
    [0; 3].map(|_| random.below(size) as i32)
}

/// A tetrahedron with its corners in one octant, and its planes, positive inside.
fn tetrahedron(random: &mut Random, size: usize) -> (Vec<Face>, Vec<Plane>) {
    loop {
        let mut p = [0; 4].map(|_| point(random, size));
        let Some(base) = plane_of(&p[..3]) else { continue };
        let top = side(&base, &corner(p[3]));
        if top == 0 {
            continue;
        }
        if top > 0 {
            p.swap(0, 1);
        }
        // Now the last corner is behind the first three, whose order is counter-clockwise from outside.
        let face = |f: [usize; 3]| vec![f.map(|i| p[i]).to_vec()];
        let faces = [[0, 1, 2], [1, 0, 3], [2, 1, 3], [0, 2, 3]].map(face);
        let inner = |f: &Face| plane_of(&f[0]).map(|plane| plane.map(|x| -x));
        return (faces.to_vec(), faces.iter().filter_map(inner).collect());
    }
}

fn triangle(random: &mut Random, size: usize) -> Face {
    vec![[0; 3].map(|_| point(random, size)).to_vec()]
}

/// A parallelogram with a parallelogram for a hole, or none.
fn frame(random: &mut Random) -> Face {
    let (p, a, b) = (point(random, 4), point(random, 3), point(random, 3));
    let at = |i: i32, j: i32| [0, 1, 2].map(|k| p[k] + i * (a[k] - 1) + j * (b[k] - 1));
    let quad = |lo: i32, hi: i32| vec![at(lo, lo), at(hi, lo), at(hi, hi), at(lo, hi)];
    let mut hole = quad(1, 2);
    hole.reverse();
    if random.below(4) == 0 { vec![quad(0, 3)] } else { vec![quad(0, 3), hole] }
}

#[test]
fn known_scenes() {
    let square = |lo: i32, hi: i32| vec![[lo, lo, 0], [hi, lo, 0], [hi, hi, 0], [lo, hi, 0]];
    let counts_of = |face: Face| {
        assert_eq!(check(&[vec![face.clone()]], &[]), 0);
        expected(&[face], &[]).counts
    };
    assert_eq!(counts_of(vec![square(0, 4)]), [4, 4, 1, 1]);
    let hole = square(1, 3).into_iter().rev().collect();
    assert_eq!(counts_of(vec![square(0, 4), hole]), [8, 8, 1, 1]);
    let (faces, planes) = tetrahedron(&mut Random(1), 5);
    assert_eq!(expected(&faces, &[]).counts, [4, 6, 4, 2]);
    assert_eq!(check(&[faces], &[planes]), 1);
}

#[test]
fn triangles_anywhere() {
    each_seed(250, |seed| {
        let random = &mut Random(seed);
        let (n, size) = (2 + random.below(4), 2 + random.below(4));
        check(&[(0..n).map(|_| triangle(random, size)).collect()], &[]);
    });
}

#[test]
fn tetrahedra_through_each_other() {
    each_seed(250, |seed| {
        let random = &mut Random(seed);
        let (n, size) = (2 + random.below(3), 2 + random.below(5));
        let (surfaces, planes): (Vec<_>, Vec<_>) = (0..n).map(|_| tetrahedron(random, size)).unzip();
        check(&surfaces, &planes);
    });
}

#[test]
fn tetrahedra_and_sheets() {
    each_seed(150, |seed| {
        let random = &mut Random(seed);
        let size = 3 + random.below(3);
        let (mut surfaces, planes): (Vec<_>, Vec<_>) = (0..2).map(|_| tetrahedron(random, size)).unzip();
        surfaces.push((0..1 + random.below(2)).map(|_| triangle(random, size)).collect());
        check(&surfaces, &planes);
    });
}

#[test]
fn frames_and_what_goes_through_them() {
    each_seed(100, |seed| {
        let random = &mut Random(seed);
        let frames = (0..1 + random.below(2)).map(|_| frame(random)).collect();
        let (solid, planes) = tetrahedron(random, 6);
        check(&[solid, frames, vec![triangle(random, 6)]], &[planes]);
    });
}
