//! Random triangles and tetrahedra with small integer corners against a second way of counting: all planes cut all of
//! space, in exact integers, and cells, faces, edges and vertices are put together from the pieces.
//!
//! `LAR_SCENES` sets the number of scenes, `LAR_SEED` the first of their seeds.

#[path = "../common/mod.rs"]
mod common;
mod expected;
mod pieces;

use common::{Random, arrange_checked, counts, each_seed, surface};
use expected::{Expected, Triangle, expected};
use lar_core::{CellId, Surface};
use pieces::{Plane, corner, plane_through, side};

/// Compares the arrangement of the surfaces with the pieces; `solids` are the convex ones among them, by number.
#[track_caller]
fn check(surfaces: &[Vec<Triangle>], solids: &[Vec<Plane>]) -> usize {
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

/// One surface, every triangle with its own points.
fn surface_of(triangles: &[Triangle]) -> Surface {
    let points: Vec<[f64; 3]> = triangles.iter().flatten().map(|p| p.map(f64::from)).collect();
    let faces: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    surface(&points, &faces.iter().map(|f| &f[..]).collect::<Vec<_>>())
}

fn point(random: &mut Random, size: usize) -> [i32; 3] {
    [0; 3].map(|_| random.below(size) as i32)
}

/// A tetrahedron with its corners in one octant, and its planes, positive inside.
fn tetrahedron(random: &mut Random, size: usize) -> (Vec<Triangle>, Vec<Plane>) {
    loop {
        let mut p = [0; 4].map(|_| point(random, size));
        let Some(base) = plane_through(p[0], p[1], p[2]) else { continue };
        let top = side(&base, &corner(p[3]));
        if top == 0 {
            continue;
        }
        if top > 0 {
            p.swap(0, 1);
        }
        // Now the last corner is behind the first three, whose order is counter-clockwise from outside.
        let faces = [[0, 1, 2], [1, 0, 3], [2, 1, 3], [0, 2, 3]].map(|f| f.map(|i: usize| p[i]));
        let inner = |t: &Triangle| plane_through(t[0], t[1], t[2]).map(|plane| plane.map(|x| -x));
        return (faces.to_vec(), faces.iter().filter_map(inner).collect());
    }
}

#[test]
fn known_scenes() {
    let square = |z: i32| vec![[[0, 0, z], [4, 0, z], [4, 4, z]], [[0, 0, z], [4, 4, z], [0, 4, z]]];
    assert_eq!(check(&[square(0)], &[]), 0);
    assert_eq!(check(&[square(0), square(1)], &[]), 0);
    let (faces, planes) = tetrahedron(&mut Random(1), 5);
    assert_eq!(check(&[faces.clone()], &[planes.clone()]), 1);
    assert_eq!(expected(&faces, &[planes]).counts, [4, 6, 4, 2]);
}

#[test]
fn triangles_anywhere() {
    each_seed(250, |seed| {
        let random = &mut Random(seed);
        let (n, size) = (2 + random.below(4), 2 + random.below(4));
        let triangles: Vec<Triangle> = (0..n).map(|_| [0; 3].map(|_| point(random, size))).collect();
        check(&[triangles], &[]);
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
        surfaces.push((0..1 + random.below(2)).map(|_| [0; 3].map(|_| point(random, size))).collect());
        check(&surfaces, &planes);
    });
}
