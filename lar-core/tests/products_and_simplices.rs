//! Grids, products and simplicial complexes: reference counts, numberings, and the laws of each.

use lar_core::{
    Cells, ChainComplex, Model, Points, cuboid_grid, extrude_simplicial, grid_0, grid_1, grid_1d,
    grid_1d_repeated, orient_simplices, product, product_all, product_cells, product_points,
    quads_to_triangles, simplex, simplex_boundary, simplex_facets, simplex_grid, simplicial_boundary,
    simplicial_complex, t,
};
use proptest::prelude::*;

fn one_based(cells: &Cells) -> Vec<Vec<u32>> {
    cells.iter().map(|cell| cell.iter().map(|v| v + 1).collect()).collect()
}

fn euler(f_vector: &[usize]) -> i64 {
    f_vector.iter().rev().fold(0, |sum, &n| i64::try_from(n).unwrap() - sum)
}

/// The coefficients of the product of two polynomials.
fn convolved(a: &[usize], b: &[usize]) -> Vec<usize> {
    let mut product = vec![0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

#[test]
fn products_of_eleven_points_and_nine_edges() {
    let steps: Vec<f64> = (0..10).map(|i| if i == 4 { -1. } else { 1. }).collect();
    let nine = grid_1d(&steps).unwrap();
    let two = grid_1(2).unwrap();
    assert_eq!((nine.f_vector(), two.f_vector()), (vec![11, 9], vec![3, 2]));
    let once = product(&nine, &two).unwrap();
    assert_eq!((once.points().len(), once.cells(2).len()), (33, 18));
    let twice = product(&once, &two).unwrap();
    assert_eq!((twice.points().len(), twice.cells(3).len()), (99, 36));
}

#[test]
fn cube_of_a_grid_with_gaps() {
    let line = grid_1d_repeated(5, &[0.1, -0.1]).unwrap();
    let cubes = product_all([&line; 3]).unwrap();
    assert_eq!((cubes.points().len(), cubes.cells(3).len()), (1331, 125));
    assert_eq!(one_based(cubes.cells(3))[0], [1, 2, 12, 13, 122, 123, 133, 134]);
    let complex = ChainComplex::from_model(&cubes).unwrap();
    assert_eq!(complex.validate(), []);
    assert_eq!(cubes.boundary_cells().unwrap().len(), 6 * 125);
}

/// Equal up to the order of vertices and cells: the points of each cell, sorted.
fn as_sets(model: &Model, swap: impl Fn(&[f64]) -> Vec<f64>) -> Vec<Vec<Vec<Vec<u64>>>> {
    let place = |&v: &u32| -> Vec<u64> {
        swap(model.points().point(v as usize)).iter().map(|x| x.to_bits()).collect()
    };
    let cell_set = |cell: &[u32]| {
        let mut places: Vec<Vec<u64>> = cell.iter().map(place).collect();
        places.sort();
        places
    };
    let skeleton = |p: usize| {
        let mut cells: Vec<_> = model.cells(p).iter().map(cell_set).collect();
        cells.sort();
        cells
    };
    (0..=model.dim()).map(skeleton).collect()
}

#[test]
fn square_times_segment_is_segment_times_square() {
    let (square, segment) = (cuboid_grid(&[1, 1]), grid_1(1).unwrap());
    let one = product(&square, &segment).unwrap();
    let other = product(&segment, &square).unwrap();
    assert_eq!(as_sets(&one, <[f64]>::to_vec), as_sets(&other, <[f64]>::to_vec));
    let lopsided = grid_1d(&[2., -1., 3.]).unwrap();
    let one = product(&square, &lopsided).unwrap();
    let other = product(&lopsided, &square).unwrap();
    assert_eq!(as_sets(&one, <[f64]>::to_vec), as_sets(&other, |p| vec![p[1], p[2], p[0]]));
}

#[test]
fn zero_dimensional_factors_embed() {
    let square = cuboid_grid(&[1, 1]);
    for at in 0..=3 {
        let mut factors = vec![grid_1(1).unwrap(); 3];
        factors.insert(at, grid_0(2).unwrap());
        let copies = product_all(&factors).unwrap();
        assert_eq!((copies.points().dim(), copies.dim()), (4, 3));
        assert_eq!(copies.f_vector(), [24, 36, 18, 3]);
        assert_eq!(copies.validate(), []);
    }
    let flat = product(&square, &grid_0(0).unwrap()).unwrap();
    assert_eq!(flat, square.embedded(3).unwrap());
    assert!(flat.to_surface("flat").is_ok());
}

#[test]
fn parts_of_products() {
    let line = Points::from_columns(1, vec![0., 5.]);
    let plane = product_points(&line, &line).unwrap();
    assert_eq!(plane.coords(), [0., 0., 0., 5., 5., 0., 5., 5.]);
    let edges = Cells::uniform(2, vec![0, 1, 1, 2]);
    let squares = product_cells(&edges, &edges, 3).unwrap();
    assert_eq!(one_based(&squares), [[1, 2, 4, 5], [2, 3, 5, 6], [4, 5, 7, 8], [5, 6, 8, 9]]);
    assert_eq!(product_all([]).unwrap(), cuboid_grid(&[]));
    let cyclic = Model::from_faces(
        Points::from_columns(2, vec![0., 0., 1., 0., 0., 1.]),
        Cells::uniform(3, vec![0, 1, 2]),
    );
    assert_eq!(product(&cyclic, &grid_1(1).unwrap()).unwrap().f_vector(), [6, 9, 5, 1]);
}

#[test]
fn products_refuse() {
    let broken = Model::new(Points::new(1), vec![Cells::singletons(1)]);
    let message = product(&broken, &simplex(1)).unwrap_err().to_string();
    assert_eq!(message, "malformed model: 0-cell 0 names vertex v0, but there are 0 vertices");
    let many = grid_0(99_999).unwrap();
    let message = product(&many, &many).unwrap_err().to_string();
    assert_eq!(
        message,
        "a product with 10000000000 vertices or entries of 0-cells; fewer than 2^32 can be numbered"
    );
    let cell = Cells::uniform(1, vec![u32::MAX]);
    assert!(product_cells(&cell, &cell, 2).is_err());
}

#[track_caller]
fn check_grid(shape: &[usize], n_vertices: usize, n_simplices: usize) -> Model {
    let grid = simplex_grid(shape).unwrap();
    assert_eq!(grid.validate(), []);
    assert_eq!((grid.points().len(), grid.cells(shape.len()).len()), (n_vertices, n_simplices), "{shape:?}");
    assert_eq!(euler(&grid.f_vector()), 1, "{shape:?}");
    grid
}

#[test]
fn simplex_grids() {
    let square = check_grid(&[1, 1], 4, 2);
    assert_eq!(square.points().coords(), [0., 0., 1., 0., 0., 1., 1., 1.]);
    assert_eq!(one_based(square.cells(2)), [[1, 2, 3], [2, 3, 4]]);
    let cube = check_grid(&[1, 1, 1], 8, 6);
    let expected = [[1, 2, 3, 5], [2, 3, 5, 6], [3, 5, 6, 7], [2, 3, 4, 6], [3, 4, 6, 7], [4, 6, 7, 8]];
    assert_eq!(one_based(cube.cells(3)), expected);
    assert_eq!(cube.f_vector(), [8, 19, 18, 6]);
    check_grid(&[5, 1], 12, 10);
    check_grid(&[3, 4], 20, 24);
    check_grid(&[2, 3, 4], 60, 144);
    check_grid(&[20, 20], 441, 800);
    let slab = check_grid(&[10, 10, 1], 242, 600);
    assert_eq!(one_based(slab.cells(3))[6], [2, 3, 13, 123]);
    check_grid(&[20, 20, 20], 9261, 48000);
    check_grid(&[1, 1, 1, 1], 16, 24);
    assert_eq!(simplex_grid(&[]).unwrap(), cuboid_grid(&[]));
    assert_eq!(simplex_grid(&[2, 0]).unwrap().f_vector(), [3, 0, 0]);
}

#[test]
fn extrusion_with_gaps() {
    let base = Model::new(
        Points::from_columns(2, vec![0., 0., 1., 0., 2., 0., 0., 1., 1., 1., 2., 1., 0., 2., 1., 2., 2., 2.]),
        vec![
            Cells::singletons(9),
            Cells::new(),
            Cells::uniform(3, vec![0, 1, 3, 1, 2, 4, 2, 4, 5, 3, 4, 6, 4, 6, 7, 5, 7, 8]),
        ],
    );
    let pattern = [1., 2., -3.].repeat(4);
    let tower = extrude_simplicial(&base, &pattern).unwrap();
    assert_eq!((tower.points().len(), tower.cells(3).len()), (117, 144));
    assert_eq!(tower.points().bounds().unwrap().1[2], 24.);
    assert_eq!(tower.validate(), []);
    assert_eq!(extrude_simplicial(&base, &[]).unwrap().f_vector(), [9, 0, 0, 0]);
}

#[test]
fn extruding_a_point_gives_the_grid() {
    let points = Model::new(Points::from_columns(1, vec![7.]), vec![Cells::singletons(1)]);
    let line = extrude_simplicial(&points, &[1., 1.]).unwrap();
    assert_eq!(
        (line.points().coords(), line.cells(1).indices()),
        (&[7., 0., 7., 1., 7., 2.][..], &[0, 1, 1, 2][..])
    );
    let grid = extrude_simplicial(&simplex_grid(&[3, 2]).unwrap(), &[1.; 4]).unwrap();
    assert_eq!(grid, simplex_grid(&[3, 2, 4]).unwrap());
}

#[track_caller]
fn refused<T: std::fmt::Debug>(found: Result<T, lar_core::SimplexError>, message: &str) {
    assert_eq!(found.unwrap_err().to_string(), message);
}

#[test]
fn simplices_refuse() {
    refused(extrude_simplicial(&cuboid_grid(&[1, 1]), &[1.]), "cell 0 has 4 vertices, not 3");
    refused(
        extrude_simplicial(&simplex(2), &[1., 0.]),
        "step 1 is 0: steps are finite, not zero, and have a finite sum",
    );
    refused(simplex_facets(&[&[0, 1, 2][..], &[1, 2]].into_iter().collect()), "cell 1 has 2 vertices, not 3");
    refused(simplex_facets(&Cells::uniform(3, vec![0, 1, 0])), "cell 0 names vertex v0 more than once");
    let three = Points::from_columns(2, vec![0.; 6]);
    let wild = Cells::uniform(3, vec![0, 1, 9]);
    refused(orient_simplices(&three, &wild), "cell 0 names vertex v9, but there are 3 vertices");
    refused(simplicial_complex(three, wild), "cell 0 names vertex v9, but there are 3 vertices");
    refused(quads_to_triangles(&Cells::uniform(3, vec![0, 1, 2])), "cell 0 has 3 vertices, not 4");
    refused(
        simplex_grid(&[99_999, 99_999]),
        "59998800006 vertices or cell entries; fewer than 2^32 can be numbered",
    );
    refused(
        simplex_grid(&[99_999, 99_999, 0]),
        "59998800006 vertices or cell entries; fewer than 2^32 can be numbered",
    );
    refused(simplex_grid(&[1; 40]), "6227020800 vertices or cell entries; fewer than 2^32 can be numbered");
    // A Möbius strip of five triangles.
    let strip = Cells::uniform(3, vec![0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 0, 4, 0, 1]);
    let flat = Points::from_columns(3, vec![0.; 15]);
    refused(
        orient_simplices(&flat, &strip),
        "no coherent orientation: cells 2 and 3 disagree across a facet",
    );
}

#[test]
fn facets_and_boundaries() {
    let cube = simplex_grid(&[1, 1, 1]).unwrap();
    let triangles = simplex_facets(cube.cells(3)).unwrap();
    assert_eq!((triangles.len(), simplex_facets(&triangles).unwrap().len()), (18, 19));
    let oriented = orient_simplices(cube.points(), cube.cells(3)).unwrap();
    let shell = simplex_boundary(&oriented).unwrap();
    assert_eq!(shell.len(), 12);
    let mesh = lar_core::TriangleMesh {
        points: cube.points().clone(),
        triangles: shell.iter().map(|t| [t[0], t[1], t[2]]).collect(),
    };
    assert!(mesh.is_closed());
    assert!((mesh.signed_volume() - 1.).abs() < 1e-15);
    assert_eq!(simplex_boundary(&Cells::uniform(2, vec![0, 1, 1, 2])).unwrap().indices(), [0, 2]);
    assert_eq!(simplex_facets(&Cells::singletons(3)).unwrap(), Cells::new());
    assert_eq!(simplex_boundary(&Cells::new()).unwrap(), Cells::new());
}

#[test]
fn triangles_of_quads_are_counter_clockwise() {
    let grid = cuboid_grid(&[3, 2]);
    let triangles = quads_to_triangles(grid.cells(2)).unwrap();
    assert_eq!(orient_simplices(grid.points(), &triangles).unwrap(), triangles);
    assert_eq!(simplex_boundary(&triangles).unwrap().len(), 10);
}

#[test]
fn boundaries_of_models() {
    let check = |model: &Model, f_vector: &[usize]| {
        let shell = model.boundary().unwrap();
        assert_eq!(shell.f_vector(), f_vector);
        assert_eq!(shell.validate(), []);
    };
    check(&cuboid_grid(&[32, 32, 16]), &[4098, 8192, 4096]);
    check(&simplex_grid(&[3, 3, 3]).unwrap(), &[56, 162, 108]);
    check(&cuboid_grid(&[2, 2, 2, 2]), &[80, 208, 192, 64]);
    check(&cuboid_grid(&[5]), &[2]);
    check(&simplex(2), &[3, 3]);
    let square = Points::from_columns(2, vec![0., 0., 1., 0., 0., 1., 1., 1.]);
    check(&Model::from_faces(square, Cells::uniform(3, vec![0, 1, 2, 2, 1, 3])), &[4, 4]);
    check(&Model::new(Points::new(2), Vec::new()), &[]);
}

proptest! {
    #[test]
    fn f_vectors_of_products_multiply(
        a in prop::collection::vec(0..4_usize, 1..3),
        b in prop::collection::vec(0..3_usize, 1..3),
        d in 1..4_usize,
    ) {
        let (a, b) = (cuboid_grid(&a), cuboid_grid(&b));
        let ab = product(&a, &b).unwrap();
        prop_assert_eq!(ab.f_vector(), convolved(&a.f_vector(), &b.f_vector()));
        prop_assert_eq!(ab.validate(), []);
        let with_simplex = product(&simplex(d), &a).unwrap();
        prop_assert_eq!(with_simplex.f_vector(), convolved(&simplex(d).f_vector(), &a.f_vector()));
        prop_assert_eq!(euler(&with_simplex.f_vector()), 1);
    }

    #[test]
    fn grids_are_products_of_lines(shape in prop::collection::vec(0..5_usize, 1..5)) {
        let lines: Vec<Model> = shape.iter().map(|&n| grid_1(n).unwrap()).collect();
        let (found, grid) = (product_all(&lines).unwrap(), cuboid_grid(&shape));
        prop_assert_eq!(as_sets(&found, <[f64]>::to_vec), as_sets(&grid, <[f64]>::to_vec));
        if shape.len() <= 3 {
            prop_assert_eq!(found, grid);
        }
    }

    #[test]
    fn products_in_space_are_complexes(
        a in prop::collection::vec(prop::sample::select(vec![1., -1., 0.5, -2.]), 1..5),
        b in prop::collection::vec(prop::sample::select(vec![1., -0.25, 3.]), 1..4),
    ) {
        let flat = product(&grid_1d(&a).unwrap(), &grid_1d(&b).unwrap()).unwrap();
        let solid = product(&flat, &grid_1d(&[2., 1.]).unwrap()).unwrap();
        let complex = ChainComplex::from_model(&solid).unwrap();
        prop_assert_eq!(complex.validate(), []);
        prop_assert_eq!(complex.f_vector(), solid.f_vector());
        let lengths = |steps: &[f64]| steps.iter().filter(|&&x| x > 0.).sum::<f64>();
        let volume: f64 = complex.cell_volumes().iter().sum();
        prop_assert!((volume - 3. * lengths(&a) * lengths(&b)).abs() < 1e-9);
    }

    #[test]
    fn simplicial_boundaries_square_to_zero(
        shape in prop::collection::vec(1..3_usize, 2..5),
        by in -9.0..9.0_f64,
    ) {
        let grid = simplex_grid(&shape).unwrap();
        let d = shape.len();
        prop_assert_eq!(euler(&grid.f_vector()), 1);
        let mut higher = simplicial_boundary(grid.cells(d)).unwrap();
        for p in (1..d).rev() {
            let lower = simplicial_boundary(&higher.0).unwrap();
            prop_assert!((&lower.1 * &higher.1).data().iter().all(|&x| x == 0));
            prop_assert_eq!(lower.0.len(), grid.cells(p - 1).len());
            higher = lower;
        }
        let moved = grid.transformed(&t(&vec![by; d])).unwrap();
        let oriented = orient_simplices(moved.points(), moved.cells(d)).unwrap();
        let shell = simplex_boundary(&oriented).unwrap();
        prop_assert_eq!(shell.len(), grid.boundary_cells().unwrap().len());
        prop_assert_eq!(simplex_boundary(&shell).unwrap().len(), 0);
        let (_, on_shell) = simplicial_boundary(&shell).unwrap();
        prop_assert!(on_shell.to_csr().outer_iterator().all(|row| row.data().iter().sum::<i8>() == 0));
    }
}
