//! Boundary operators of models: the laws, the reference counts, the orientation of cells.

use lar_core::{Cells, ChainComplex, Model, Points, Struct, cuboid_grid, r, s, simplex, t, triangular_prism};
use proptest::prelude::*;

#[track_caller]
fn check_laws(model: &Model) -> ChainComplex {
    let complex = ChainComplex::from_model(model).unwrap();
    assert_eq!(complex.validate(), []);
    assert_eq!(complex.f_vector(), model.f_vector());
    for p in 1..complex.dim() {
        let product = complex.boundary(p) * complex.boundary(p + 1);
        assert!(product.data().iter().all(|&x| x == 0), "∂{p}∂{}", p + 1);
        let product = &complex.coboundary(p) * &complex.coboundary(p - 1);
        assert!(product.data().iter().all(|&x| x == 0), "δ{p}δ{}", p - 1);
    }
    complex
}

#[test]
fn laws_hold_on_every_grid() {
    for shape in [&[1][..], &[10], &[1, 1], &[3, 2], &[3, 10], &[20, 20], &[1, 1, 1], &[3, 2, 1], &[3, 3, 10]]
    {
        let complex = check_laws(&cuboid_grid(shape));
        assert_eq!(complex.euler_characteristic(), 1);
        assert_eq!(complex.connected_components().n, 1);
    }
    check_laws(&simplex(2));
    check_laws(&simplex(3));
    check_laws(&triangular_prism());
}

#[test]
fn boundary_of_a_whole_grid() {
    let grid = ChainComplex::from_model(&cuboid_grid(&[32, 32, 16])).unwrap();
    let all = grid.chain(3, (0..16384).map(|c| (c, 1))).unwrap();
    let shell = grid.boundary_of(&all).unwrap();
    assert_eq!(shell.entries().len(), 4096);
    assert!(shell.entries().iter().all(|e| e.1 == 1));
    assert!(grid.boundary_of(&shell).unwrap().is_zero());
}

#[test]
fn signs_of_the_unit_cube() {
    let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
    assert_eq!([1, 2, 3].map(|p| cube.boundary(p).nnz()), [24, 24, 6]);
    assert!(cube.boundary(3).data().iter().all(|&x| x == 1));
    let normals: Vec<[f64; 3]> = (0..6).map(|f| cube.face_normal(f).unwrap()).collect();
    let expected = [[-1., 0., 0.], [1., 0., 0.], [0., -1., 0.], [0., 1., 0.], [0., 0., -1.], [0., 0., 1.]];
    assert_eq!(normals, expected);
}

#[test]
fn plane_faces_are_counter_clockwise() {
    let mirrored = cuboid_grid(&[3, 2]).transformed(&s(&[-1., 1.])).unwrap();
    let complex = check_laws(&mirrored);
    assert!((0..6).all(|f| complex.face_area_vector(f) == [0., 0., 1.]));
}

#[test]
fn sides_of_cyclic_faces_become_edges() {
    let points = Points::from_columns(2, vec![0., 0., 1., 0., 1., 1., 0., 1.]);
    let faces = Cells::uniform(3, vec![0, 1, 2, 0, 2, 3]);
    let complex = ChainComplex::from_model(&Model::from_faces(points, faces)).unwrap();
    assert_eq!(complex.f_vector(), [4, 5, 2]);
    let ends: Vec<[u32; 2]> = (0..5).map(|e| complex.edge_ends(e).unwrap()).collect();
    assert_eq!(ends, [[0, 1], [1, 2], [0, 2], [2, 3], [0, 3]]);
    assert_eq!(complex.validate(), []);
}

#[track_caller]
fn check_error(model: &Model, message: &str) {
    assert_eq!(ChainComplex::from_model(model).unwrap_err().to_string(), message);
}

#[test]
fn refusals() {
    check_error(
        &cuboid_grid(&[1, 1, 1, 1]),
        "cells of dimension 4; chain complexes are built up to dimension 3",
    );
    let edge = Model::new(Points::new(2), vec![Cells::new(), Cells::uniform(2, vec![0, 1])]);
    check_error(
        &edge,
        "malformed model: 1-cell 0 names vertex v0, but there are 0 vertices; \
         1-cell 0 names vertex v1, but there are 0 vertices",
    );
    let (_, cells) = cuboid_grid(&[1, 1, 1]).into_parts();
    let flat = Points::from_columns(2, (0..16).map(f64::from).collect());
    check_error(&Model::new(flat, cells), "points of 2 coordinates where 3 are needed");
    let (points, mut cells) = simplex(3).into_parts();
    cells[3] = [[0, 1, 2, 3]; 3].into_iter().collect();
    check_error(&Model::new(points, cells), "2-cell f0 belongs to 3 3-cells; at most 2 can meet in a face");
}

#[test]
fn empty_models() {
    assert_eq!(ChainComplex::from_model(&Model::new(Points::new(3), Vec::new())).unwrap().f_vector(), [0]);
    assert_eq!(check_laws(&cuboid_grid(&[0, 3])).f_vector(), [4, 3, 0]);
    assert_eq!(check_laws(&cuboid_grid(&[0, 0, 0])).f_vector(), [1, 0, 0, 0]);
}

proptest! {
    #[test]
    fn placed_solids_are_outward(v in prop::array::uniform3(-3.0..3.0_f64), by in prop::array::uniform3(-5.0..5.0_f64)) {
        let scene = Struct::new("s")
            .with(t(&by))
            .with(r(v))
            .with(cuboid_grid(&[2, 1, 1]))
            .with(s(&[-1., 1., 2.]))
            .with(triangular_prism())
            .with(simplex(3));
        let complex = check_laws(&scene.struct2lar().unwrap());
        let volumes = complex.cell_volumes();
        for (found, expected) in volumes.iter().zip([1., 1., 1., 1. / 3.]) {
            prop_assert!((found - expected).abs() < 1e-12, "{} {}", found, expected);
        }
        prop_assert_eq!(complex.connected_components().n, 3);
        let area: f64 = (0..11).map(|f| complex.face_area(f)).sum();
        prop_assert!((area - 11.).abs() < 1e-12);
    }
}
