//! Betti numbers of known spaces, of random subsets of grids against Euler's formula and components, and of
//! complexes that are none.

use lar_core::{
    Cells, ChainComplex, HomologyError, Model, Points, Struct, Surface, TriangleMesh, cuboid_grid, icosphere,
    t,
};
use proptest::prelude::*;

#[track_caller]
fn check(complex: &ChainComplex, expected: &[usize]) {
    let found = complex.betti_numbers().unwrap();
    assert_eq!(found, expected);
    assert_eq!(complex.betti_numbers_modulo(2).unwrap(), expected);
    assert_eq!(alternating(&found), complex.euler_characteristic());
}

fn alternating(numbers: &[usize]) -> i64 {
    numbers.iter().rev().fold(0, |sum, &n| n as i64 - sum)
}

fn complex(model: &Model) -> ChainComplex {
    ChainComplex::from_model(model).unwrap()
}

/// n × m quadrilaterals (i, j) with the vertex of (i, j) given.
fn quadrilaterals(n: u32, m: u32, vertex: impl Fn(u32, u32) -> u32, n_vertices: u32) -> ChainComplex {
    let points = Points::from_columns(3, (0..3 * n_vertices).map(f64::from).collect());
    let quad = |i, j| [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
    let faces = (0..n).flat_map(|i| (0..m).map(move |j| (i, j))).map(|(i, j)| quad(i, j)).collect();
    complex(&Model::from_faces(points, faces))
}

#[test]
fn grids_and_spheres() {
    check(&complex(&cuboid_grid(&[5])), &[1, 0]);
    check(&complex(&cuboid_grid(&[4, 3])), &[1, 0, 0]);
    check(&complex(&cuboid_grid(&[6, 5, 4])), &[1, 0, 0, 0]);
    check(&complex(&cuboid_grid(&[6, 5, 4])).with_exterior().unwrap(), &[1, 0, 0, 1]);
    check(&complex(&cuboid_grid(&[4, 3])).with_exterior().unwrap(), &[1, 0, 1]);
    let two =
        Struct::new("s").with(cuboid_grid(&[1, 1, 1])).with(t(&[3., 0., 0.])).with(cuboid_grid(&[2, 1, 1]));
    check(&complex(&two.struct2lar().unwrap()), &[2, 0, 0, 0]);
    let ball = Surface::from_triangles("ball", &icosphere(4));
    check(&ChainComplex::from_surface(&ball).unwrap(), &[1, 0, 1]);
    check(&ChainComplex::new(Points::from_columns(1, vec![1., 2.]), Vec::new()), &[2]);
    check(&complex(&Model::new(Points::new(3), Vec::new())), &[0]);
}

#[test]
fn skeletons_of_a_grid() {
    let grid = complex(&cuboid_grid(&[3, 3, 3]));
    let skeleton = |d: usize| {
        ChainComplex::new(grid.points().clone(), (1..=d).map(|p| grid.boundary(p).clone()).collect())
    };
    check(&skeleton(1), &[1, 144 - 64 + 1]);
    check(&skeleton(2), &[1, 0, 27]);
}

#[test]
fn torus_and_klein_bottle() {
    let torus = quadrilaterals(6, 5, |i, j| (i % 6) * 5 + j % 5, 30);
    check(&torus, &[1, 2, 1]);
    // (6, j) is glued to (0, -j).
    let klein = quadrilaterals(6, 5, |i, j| if i == 6 { (5 - j % 5) % 5 } else { i * 5 + j % 5 }, 30);
    assert_eq!(klein.betti_numbers().unwrap(), [1, 1, 0]);
    assert_eq!(klein.betti_numbers_modulo(2).unwrap(), [1, 2, 1]);
    assert_eq!(klein.betti_numbers_modulo(3).unwrap(), [1, 1, 0]);
}

/// A cubic grid without its middle cube, and without the middle column of cubes.
#[test]
fn cavity_and_handle() {
    let keep = |hole: &[usize]| (0..27).map(|c| !hole.contains(&c)).collect::<Vec<_>>();
    check(&complex(&some_cubes(&[3, 3, 3], &keep(&[13]))), &[1, 0, 1, 0]);
    check(&complex(&some_cubes(&[3, 3, 3], &keep(&[4, 13, 22]))), &[1, 1, 0, 0]);
}

#[test]
fn large_surfaces_take_almost_linear_time() {
    let (n, m) = (400, 300);
    let torus = quadrilaterals(n, m, |i, j| (i % n) * m + j % m, n * m);
    check(&torus, &[1, 2, 1]);
    let mesh: TriangleMesh = icosphere(6);
    check(&ChainComplex::from_surface(&Surface::from_triangles("ball", &mesh)).unwrap(), &[1, 0, 1]);
}

#[test]
fn refusals() {
    let grid = complex(&cuboid_grid(&[2, 1]));
    assert_eq!(grid.betti_numbers_modulo(6), Err(HomologyError::NotPrime { modulus: 6 }));
    let message = grid.betti_numbers_modulo(0).unwrap_err().to_string();
    assert_eq!(message, "the integers modulo 0 are no field: 0 is not a prime");
    let mut d2 = grid.boundary(2).clone();
    d2.data_mut()[0] *= -1;
    let broken = ChainComplex::new(grid.points().clone(), vec![grid.boundary(1).clone(), d2]);
    let message = broken.betti_numbers().unwrap_err().to_string();
    assert_eq!(message, "not a chain complex: ∂1·∂2 is -2 at (0, 0), not 0; ∂1·∂2 is 2 at (1, 0), not 0");
    let misfit = ChainComplex::new(Points::new(2), vec![grid.boundary(1).clone()]);
    assert!(matches!(misfit.betti_numbers(), Err(HomologyError::NotComplex(_))));
}

/// The grid without some of its d-cells; faces that bound nothing are left out.
fn some_cubes(shape: &[usize], keep: &[bool]) -> Model {
    let (points, mut cells) = cuboid_grid(shape).into_parts();
    let d = shape.len();
    cells[d] = cells[d].iter().zip(keep).filter(|e| *e.1).map(|e| e.0).collect();
    let top: Vec<&[u32]> = cells[d].iter().collect();
    let inside = |c: &[u32]| top.iter().any(|big| c.iter().all(|v| big.contains(v)));
    let below: Vec<Cells> = (1..d).map(|p| cells[p].iter().filter(|c| inside(c)).collect()).collect();
    let used: Vec<Vec<u32>> = (0..points.len() as u32).map(|v| vec![v]).filter(|v| inside(v)).collect();
    let new: Vec<Option<u32>> =
        (0..points.len() as u32).map(|v| used.binary_search(&vec![v]).ok().map(|i| i as u32)).collect();
    let renamed = |cells: &Cells| -> Cells {
        cells.iter().map(|c| c.iter().filter_map(|&v| new[v as usize]).collect::<Vec<_>>()).collect()
    };
    let kept = used.iter().flat_map(|v| points.point(v[0] as usize).to_vec()).collect();
    let singles = Cells::singletons(used.len());
    let levels = std::iter::once(singles).chain(below.iter().map(&renamed)).chain([renamed(&cells[d])]);
    Model::new(Points::from_columns(d, kept), levels.collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// β0 counts components, β3 of a solid is 0, β2 counts cavities: the components of the rest of space less
    /// one; the Euler characteristic fixes β1. With the exterior, the cell complex is closed.
    #[test]
    fn random_solids(keep in prop::collection::vec(any::<bool>(), 36)) {
        let shape = [4, 3, 3];
        let solid = complex(&some_cubes(&shape, &keep));
        let found = solid.betti_numbers().unwrap();
        prop_assert_eq!(found[0], solid.connected_components().n);
        prop_assert_eq!(found[0], solid.cell_components().n);
        prop_assert_eq!(found[3], 0);
        prop_assert_eq!(found[2], outside_components(&shape, &keep) - 1);
        prop_assert_eq!(alternating(&found), solid.euler_characteristic());
        for prime in [2, 3, 65_537] {
            prop_assert_eq!(&solid.betti_numbers_modulo(prime).unwrap(), &found);
        }
    }
}

/// The components of the cubes not kept, joined through faces, and the space around the grid.
fn outside_components(shape: &[usize; 3], keep: &[bool]) -> usize {
    let padded: Vec<usize> = shape.iter().map(|n| n + 2).collect();
    let whole = complex(&cuboid_grid(&padded));
    let kept = |c: usize| {
        let at = [c / (padded[1] * padded[2]), c / padded[2] % padded[1], c % padded[2]];
        let inside = (0..3).all(|k| (1..=shape[k]).contains(&at[k]));
        inside && keep[((at[0] - 1) * shape[1] + at[1] - 1) * shape[2] + at[2] - 1]
    };
    let free: Vec<u32> = (0..whole.n_cells(3)).filter(|&c| !kept(c)).map(|c| c as u32).collect();
    let cells = whole.relation(3, 3);
    let place = |c: u32| free.binary_search(&c).ok();
    let edges: Vec<[u32; 2]> = (0..)
        .zip(&free)
        .flat_map(|(i, &c)| {
            cells[c as usize].iter().filter_map(move |&o| place(o)).map(move |j| [i, j as u32])
        })
        .collect();
    let graph = lar_core::Graph::new(free.len(), &edges).unwrap();
    graph.depth_first_search().parent_edge.iter().filter(|edge| edge.is_none()).count()
}
