//! More surfaces than are numbered in the order of the input: volumes, parents, and the same for any number of threads.

mod common;

use common::Random;
use lar_arrangement::{Arrangement, Arranger};
use lar_core::{CellId, FaceId, Points, Surface, icosphere, rotation, s, t};
use std::num::NonZeroUsize;

/// Pairs of a ball and a smaller one that crosses it, on a lattice, in a random order, and one of them a second time.
fn pairs_of_balls() -> Vec<Surface> {
    let random = &mut Random(1);
    let (large, small) = (icosphere(2), icosphere(0));
    let mut balls: Vec<Surface> = random
        .permutation(1024)
        .into_iter()
        .map(|i| {
            let (pair, is_small) = (i / 2, i % 2 == 1);
            let at = [pair % 8, pair / 8 % 8, pair / 64].map(|x| 3.0 * x as f64);
            let (mesh, radius, off) = if is_small { (&small, 0.5, 0.9) } else { (&large, 1.0, 0.0) };
            let turned = rotation([1.0, 2.0, 3.0], pair as f64).expect("an axis");
            let map = t(&[at[0] + off, at[1], at[2]]).compose(&s(&[radius; 3])).expect("maps of space");
            let ball = Surface::from_triangles(format!("ball {i}"), mesh);
            ball.transformed(&map.compose(&turned).expect("maps of space")).expect("a map of space")
        })
        .collect();
    balls.push(balls[100].clone());
    balls
}

/// The volume inside of a surface's triangles.
fn volume(surface: &Surface) -> f64 {
    let of_face = |face: usize| {
        let corners: Vec<&[f64]> =
            surface.face(face).flatten().map(|&v| surface.points.point(v as usize)).collect();
        let [a, b, c] = corners[..] else { panic!("face {face} is no triangle") };
        (a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))
            / 6.0
    };
    (0..surface.n_faces()).map(of_face).sum()
}

fn minus(a: &[f64], b: &[f64]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

/// Every solid has its volume, and every face lies on the face of the input that it is said to be of, turned as is said.
fn check(a: &Arrangement, input: &[Surface]) {
    let mut volumes = vec![0.0; input.len()];
    let of_cells = a.volumes();
    for (cell, of_cell) in of_cells.iter().enumerate().skip(1) {
        for (solid, volume) in volumes.iter_mut().enumerate() {
            *volume += f64::from(a.winding(CellId(cell as u32), solid)) * of_cell;
        }
    }
    for (solid, surface) in input.iter().enumerate() {
        let expected = volume(surface);
        assert!((volumes[solid] - expected).abs() < 1e-9, "solid {solid}: {} not {expected}", volumes[solid]);
    }
    let points: &Points = a.complex().points();
    for face in (0..a.n_faces() as u32).map(FaceId) {
        let normal = a.normal(face);
        let parents = a.parents(face);
        assert!(parents.is_sorted(), "{face:?}: {parents:?}");
        for parent in parents {
            let surface = &input[parent.solid as usize];
            let corner = |i: usize| {
                let v = surface.face(parent.face as usize).flatten().nth(i).expect("a triangle");
                surface.points.point(*v as usize)
            };
            let (u, v) = (minus(corner(1), corner(0)), minus(corner(2), corner(0)));
            let own: [f64; 3] = [0, 1, 2].map(|k| {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                f64::from(parent.sign) * (u[i] * v[j] - u[j] * v[i])
            });
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            assert!(dot(own, normal) > 0.999 * dot(own, own).sqrt(), "{face:?} of {parent:?}: {normal:?}");
            for vertex in a.face_vertices(face).flatten() {
                let off = dot(normal, minus(points.point(vertex as usize), corner(0)));
                assert!(off.abs() < 1e-9, "{face:?} of {parent:?}: vertex {vertex} is off by {off}");
            }
        }
    }
}

#[test]
fn many_surfaces_keep_their_volumes_and_faces() {
    let input = pairs_of_balls();
    let n_faces: usize = input.iter().map(Surface::n_faces).sum();
    assert!(input.len() > 1 << 10 && n_faces > 1 << 17);
    let arranged = |threads: usize, input: &[Surface]| {
        let threads = NonZeroUsize::new(threads).expect("at least one thread");
        Arranger::new().threads(threads).arrange(input).expect("the input is well formed")
    };
    let a = arranged(1, &input);
    // The exterior, and three cells of each pair: only in the one, only in the other, in both.
    assert_eq!([a.n_cells(), a.n_shells() - a.n_cells()], [1 + 3 * 512, 511]);
    assert_eq!(a.complex().validate(), []);
    check(&a, &input);
    let b = arranged(2, &input);
    assert!(
        a.complex() == b.complex()
            && (0..a.n_faces() as u32).map(FaceId).all(|f| a.parents(f) == b.parents(f))
    );
    // The other way round.
    let counts = |a: &Arrangement| [a.n_vertices(), a.n_edges(), a.n_faces(), a.n_cells()];
    let mut turned = input.clone();
    turned.reverse();
    let c = arranged(2, &turned);
    assert_eq!(counts(&c), counts(&a));
    check(&c, &turned);
}
