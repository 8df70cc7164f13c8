//! Models become oriented surfaces: cubes and grids, moved and mirrored, with and without 3-cells.

use lar_core::{Affine, Cells, Model, ModelError, Points, Struct, Surface, cuboid_grid, r, s, t};
use proptest::prelude::*;

/// Volume of the solid that the surface bounds, by cones from the origin.
fn volume(surface: &Surface) -> f64 {
    let mut six = 0.;
    for f in 0..surface.n_faces() {
        for cycle in surface.face(f) {
            let p: Vec<[f64; 3]> = cycle.iter().map(|&v| surface.points.xyz(v as usize)).collect();
            for w in p[1..].windows(2) {
                let [a, b, c] = [p[0], w[0], w[1]];
                let det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]);
                six += f64::from(surface.coefficient(f)) * det;
            }
        }
    }
    six / 6.
}

/// The model with cells up to dimension `d` only.
fn skeleton(model: &Model, d: usize) -> Model {
    let (points, mut cells) = model.clone().into_parts();
    cells.truncate(d + 1);
    Model::new(points, cells)
}

#[track_caller]
fn check_closed(model: &Model, faces: usize, walls: usize, expected: f64) {
    let surface = model.to_surface("s").unwrap();
    assert_eq!(surface.validate(), []);
    assert_eq!(surface.n_faces(), faces);
    assert_eq!((0..faces).filter(|&f| surface.coefficient(f) == 0).count(), walls);
    assert_eq!(surface.boundary_edges(), []);
    assert!((volume(&surface) - expected).abs() < 1e-9 * expected.abs(), "{} ≠ {expected}", volume(&surface));
}

#[test]
fn grids() {
    check_closed(&cuboid_grid(&[1, 1, 1]), 6, 0, 1.);
    check_closed(&skeleton(&cuboid_grid(&[1, 1, 1]), 2), 6, 0, 1.);
    check_closed(&cuboid_grid(&[2, 2, 2]), 36, 12, 8.);
    check_closed(&cuboid_grid(&[3, 2, 1]), 29, 7, 6.);
    let surface = cuboid_grid(&[32, 32, 16]).to_surface("grid").unwrap();
    assert_eq!((0..surface.n_faces()).filter(|&f| surface.coefficient(f) == 1).count(), 4096);
}

#[test]
fn unit_cube_faces() {
    let cube = cuboid_grid(&[1, 1, 1]).to_surface("cube").unwrap();
    let loops: Vec<Vec<u32>> = (0..6).flat_map(|f| cube.face(f).map(<[u32]>::to_vec)).collect();
    assert_eq!(loops, [[0, 1, 3, 2], [6, 7, 5, 4], [4, 5, 1, 0], [2, 3, 7, 6], [0, 2, 6, 4], [5, 7, 3, 1]]);
}

#[test]
fn disjoint_shells_are_each_outward() {
    let cube = cuboid_grid(&[1, 1, 1]);
    let scene = Struct::new("s").with(cube.clone()).with(t(&[5., 0., 0.])).with(s(&[-1., 1., 1.])).with(cube);
    let flat = scene.struct2lar().unwrap();
    check_closed(&flat, 12, 0, 2.);
    check_closed(&skeleton(&flat, 2), 12, 0, 2.);
}

/// A square grid lifted to z = height · x · y.
fn saddle(height: f64) -> Surface {
    let (flat, cells) = cuboid_grid(&[3, 3]).into_parts();
    let lifted = flat.iter().flat_map(|p| [p[0], p[1], height * p[0] * p[1]]).collect();
    Model::new(Points::from_columns(3, lifted), cells).to_surface("sheet").unwrap()
}

#[test]
fn open_sheets_are_coherent_and_keep_their_first_face() {
    for height in [1., -1.] {
        let surface = saddle(height);
        let boundary = surface.boundary_edges();
        assert_eq!(boundary.len(), 12);
        assert!(boundary.iter().all(|e| e.surplus == 1));
        assert_eq!(surface.odd_boundary_edges().len(), 12);
        assert_eq!(surface.face(0).next().unwrap(), [0, 1, 5, 4]);
    }
}

#[test]
fn cyclic_faces_keep_their_orientation() {
    let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
    let model = Model::from_faces(points, Cells::uniform(4, vec![3, 2, 1, 0]));
    let surface = model.to_surface("s").unwrap();
    assert_eq!(surface.face(0).next().unwrap(), [3, 2, 1, 0]);
}

#[track_caller]
fn check_error(model: &Model, message: &str) {
    assert_eq!(model.to_surface("s").unwrap_err().to_string(), message);
}

fn square_with_edges(edges: &[u32]) -> Model {
    let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
    let faces = Cells::uniform(4, vec![0, 1, 2, 3]);
    Model::new(points, vec![Cells::singletons(4), Cells::uniform(2, edges.to_vec()), faces])
}

#[test]
fn refusals() {
    check_error(
        &square_with_edges(&[0, 1, 1, 2, 2, 3, 3, 0, 0, 2, 1, 3]),
        "3 edges of 2-cell f0 meet at its vertex v0 where 2 are needed: it has a chord",
    );
    check_error(
        &square_with_edges(&[0, 1, 1, 2, 2, 3]),
        "1 edges of 2-cell f0 meet at its vertex v0 where 2 are needed: an edge is missing",
    );
    check_error(
        &square_with_edges(&[0, 1, 1, 2, 2, 9]),
        "malformed model: 1-cell 2 names vertex v9, but there are 4 vertices",
    );
    check_error(&cuboid_grid(&[1, 1]), "points of 2 coordinates where 3 are needed");
    check_error(&skeleton(&cuboid_grid(&[1, 1, 1]), 1), "the model has no 2-cells");
    let (points, mut cells) = cuboid_grid(&[1, 1, 1]).into_parts();
    cells[2] = cells[2].iter().skip(1).collect();
    check_error(&Model::new(points, cells), "edge v0-v1 has 1 faces in 3-cell c0 where 2 are needed");
}

/// A plate with a square hole, extruded: one 3-cell, two faces of two loops, given as sets of vertices.
fn frame() -> Model {
    let xy = [[0., 0.], [4., 0.], [4., 4.], [0., 4.], [1., 1.], [3., 1.], [3., 3.], [1., 3.]];
    let points: Vec<[f64; 3]> = [0., 2.].iter().flat_map(|&z| xy.map(|[x, y]| [x, y, z])).collect();
    let ring = |base: u32| (0..4).map(move |i| [base + i, base + (i + 1) % 4]);
    let posts = (0..8).map(|v| [v, v + 8]);
    let edges: Cells = [0, 4, 8, 12].into_iter().flat_map(ring).chain(posts).collect();
    let walls = [0, 4].into_iter().flat_map(ring).map(|[a, b]| vec![a, b, a + 8, b + 8]);
    let faces: Cells = [(0..8).collect(), (8..16).collect()].into_iter().chain(walls).collect();
    let cells = vec![Cells::singletons(16), edges, faces, Cells::uniform(16, (0..16).collect())];
    Model::new(Points::from_xyz(&points), cells)
}

#[test]
fn faces_with_holes() {
    check_closed(&frame(), 10, 0, 24.);
    check_closed(&skeleton(&frame(), 2), 10, 0, 24.);
    let turned = frame().transformed(&(&r([0.3, -0.4, 1.]) * &s(&[-1., 1., 1.]))).unwrap();
    check_closed(&turned, 10, 0, 24.);
    let complex = lar_core::ChainComplex::from_model(&frame()).unwrap();
    assert_eq!(complex.validate(), []);
    assert!((complex.cell_volumes()[0] - 24.).abs() < 1e-14);
    assert_eq!((complex.face_area(0), complex.boundary(2).outer_view(0).unwrap().nnz()), (12., 8));
    let shell = lar_core::ChainComplex::from_surface(&frame().to_surface("frame").unwrap()).unwrap();
    assert_eq!((shell.f_vector(), shell.validate()), (vec![16, 24, 10], vec![]));
}

#[test]
fn two_cycles_in_one_face() {
    let points =
        Points::from_xyz(&[[0.; 3], [1., 0., 0.], [0., 1., 0.], [5., 0., 0.], [6., 0., 0.], [5., 1., 0.]]);
    let edges = Cells::uniform(2, vec![0, 1, 1, 2, 2, 0, 3, 4, 4, 5, 5, 3]);
    let faces = Cells::uniform(6, (0..6).collect());
    let model = Model::new(points, vec![Cells::singletons(6), edges, faces]);
    let expected = ModelError::FaceManyLoops { face: 0.into(), vertex: 3.into() };
    assert_eq!(model.to_surface("s"), Err(expected));
}

fn affine() -> impl Strategy<Value = Affine> {
    let scale = prop_oneof![-3.0..-0.1_f64, 0.1..3.0_f64];
    (prop::array::uniform3(-4.0..4.0_f64), prop::array::uniform3(scale), prop::array::uniform3(-9.0..9.0_f64))
        .prop_map(|(a, b, c)| &(&r(a) * &t(&c)) * &s(&b))
}

proptest! {
    #[test]
    fn any_affine_image_is_outward(map in affine(), shape in prop::array::uniform3(1..4_usize)) {
        let grid = cuboid_grid(&shape);
        let moved = grid.transformed(&map).unwrap();
        let walls = grid.cells(2).len() - 2 * (shape[0] * shape[1] + shape[1] * shape[2] + shape[2] * shape[0]);
        let expected = map.determinant().abs() * shape.iter().product::<usize>() as f64;
        check_closed(&moved, grid.cells(2).len(), walls, expected);
        let surface = grid.to_surface("s").unwrap().transformed(&map).unwrap();
        prop_assert_eq!(surface.boundary_edges(), []);
        prop_assert!((volume(&surface) / expected - 1.).abs() < 1e-9);
        let shell = skeleton(&cuboid_grid(&[1, 1, 1]), 2).transformed(&map).unwrap();
        check_closed(&shell, 6, 0, map.determinant().abs());
    }
}
