//! Integrals and mass properties: closed forms, the theorems of Gauss and Green under random affine maps,
//! additivity, refusals.

use lar_core::{
    Affine, Cells, ChainComplex, IntegrationError, Model, Points, Struct, Surface, TriangleMesh, cuboid_grid,
    icosphere, r, s, simplex, t, triangular_prism,
};
use proptest::prelude::*;

fn close(found: f64, expected: f64, scale: f64) -> bool {
    (found - expected).abs() <= 1e-11 * scale.max(expected.abs())
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    assert!(close(found, expected, 1e-300), "found {found:e}, expected {expected:e}");
}

fn complex(model: &Model) -> ChainComplex {
    ChainComplex::from_model(model).unwrap()
}

/// ∫ x^a y^b z^c over the box between two corners.
fn box_integral(lo: [f64; 3], hi: [f64; 3], degrees: [u32; 3]) -> f64 {
    let along = |k: usize| {
        let n = degrees[k] as i32 + 1;
        (hi[k].powi(n) - lo[k].powi(n)) / f64::from(n)
    };
    along(0) * along(1) * along(2)
}

#[test]
fn standard_tetrahedron() {
    let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
    for degrees in [[0; 3], [1, 0, 0], [2, 3, 1], [10, 10, 10], [0, 0, 40]] {
        let expected =
            degrees.map(factorial).iter().product::<f64>() / factorial(degrees.iter().sum::<u32>() + 3);
        assert_close(complex(&simplex(3)).cell_integrals(3, degrees).unwrap()[0], expected);
        let surface = simplex(3).to_surface("tetrahedron").unwrap();
        assert_close(surface.volume_integral(degrees).unwrap(), expected);
    }
    let tenth = complex(&simplex(3)).cell_integrals(3, [10; 3]).unwrap()[0];
    assert!((tenth / 5.503049403185398e-18 - 1.).abs() < 1e-13);
}

#[test]
fn unit_cube() {
    let cube = complex(&cuboid_grid(&[1, 1, 1]));
    assert_eq!(cube.cell_measures(3).unwrap(), [1.]);
    assert_eq!(cube.cell_measures(2).unwrap(), [1.; 6]);
    assert_eq!(cube.cell_measures(1).unwrap(), [1.; 12]);
    assert_eq!(cube.cell_measures(0).unwrap(), [1.; 8]);
    let body = cube.mass_properties(3).unwrap()[0];
    assert_eq!(body.centroid(), Some([0.5; 3]));
    for k in 0..3 {
        assert_close(body.first_moments()[k], 0.5);
        assert_close(body.second_moments()[k], 1. / 3.);
        assert_close(body.inertia_products()[k], 0.25);
        assert_close(body.inertia_moments()[k], 2. / 3.);
    }
    let shell = cuboid_grid(&[1, 1, 1]).to_surface("cube").unwrap().shell_mass_properties().unwrap();
    assert_eq!((shell.mass(), shell.centroid()), (6., Some([0.5; 3])));
    assert_close(shell.second_moments()[0], 1. + 4. / 3.);
}

#[test]
fn boxes_of_any_degree() {
    let (lo, hi) = ([-0.5, 1., 2.], [1.5, 2., 2.25]);
    let size = [hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]];
    let scene = Struct::new("box").with(t(&lo)).with(s(&size)).with(cuboid_grid(&[1, 1, 1]));
    let placed = complex(&scene.struct2lar().unwrap());
    for degrees in [[0, 0, 0], [3, 0, 1], [2, 7, 5], [20, 20, 20]] {
        assert_close(placed.cell_integrals(3, degrees).unwrap()[0], box_integral(lo, hi, degrees));
    }
}

/// A square plate of side 4 with a square hole of side 1 at (1, 1), extruded to height 2.
fn frame() -> Surface {
    let square =
        |x: f64, side: f64, z: f64| [[x, x, z], [x + side, x, z], [x + side, x + side, z], [x, x + side, z]];
    let points: Vec<[f64; 3]> =
        [square(0., 4., 0.), square(1., 1., 0.), square(0., 4., 2.), square(1., 1., 2.)].concat();
    let mut surface = Surface::new("frame", Points::from_xyz(&points));
    surface.push_face([&[3, 2, 1, 0][..], &[4, 5, 6, 7]], 1);
    surface.push_face([&[8, 9, 10, 11][..], &[15, 14, 13, 12]], 1);
    for (i, j) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
        surface.push_face([&[i, j, j + 8, i + 8][..]], 1);
        surface.push_face([&[j + 4, i + 4, i + 12, j + 12][..]], 1);
    }
    surface
}

#[test]
fn faces_with_holes() {
    assert_close(frame().surface_integral([0; 3]).unwrap(), 2. * 15. + 4. * 8. + 4. * 2.);
    for degrees in [[0; 3], [1, 0, 0], [2, 1, 3], [9, 4, 6]] {
        let expected =
            box_integral([0.; 3], [4., 4., 2.], degrees) - box_integral([1., 1., 0.], [2., 2., 2.], degrees);
        assert_close(frame().volume_integral(degrees).unwrap(), expected);
    }
    let body = frame().solid_mass_properties().unwrap();
    assert_close(body.mass(), 30.);
    assert_close(body.centroid().unwrap()[0], (32. * 2. - 2. * 1.5) / 30.);
}

#[test]
fn signs_are_kept_where_asked() {
    let points = Points::from_columns(2, vec![0., 0., 0., 1., 1., 1., 1., 0.]);
    let clockwise = complex(&Model::from_faces(points, Cells::uniform(4, vec![0, 1, 2, 3])));
    assert_eq!(clockwise.cell_measures(2).unwrap(), [-1.]);
    let chain = clockwise.chain(2, [(0, -2)]).unwrap();
    assert_eq!(clockwise.chain_areas(std::slice::from_ref(&chain)).unwrap(), [2.]);
    assert_close(clockwise.chain_integral(&chain, [1, 0, 0]).unwrap(), 1.);
    let mut inward = icosphere(4);
    inward.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    assert!(inward.volume_integral([2, 0, 0]).unwrap() < 0.);
    assert!(inward.surface_integral([2, 0, 0]).unwrap() > 0.);
    let whole = complex(&cuboid_grid(&[2, 1, 1])).with_exterior().unwrap();
    let bodies = whole.mass_properties(3).unwrap();
    for (body, expected) in bodies.iter().zip([-2., 1., 1.]) {
        assert_close(body.mass(), expected);
    }
    assert_close(bodies[0].centroid().unwrap()[0], 1.);
}

#[test]
fn far_away_bodies_keep_their_digits() {
    let far = cuboid_grid(&[1, 1, 1]).transformed(&t(&[1e6, -2e6, 3e6])).unwrap();
    let body = complex(&far).mass_properties(3).unwrap()[0];
    assert!((body.mass() - 1.).abs() < 1e-9);
    let tensor = body.inertia_about(body.centroid().unwrap());
    assert!((tensor[0][0] - 1. / 6.).abs() < 1e-9, "{tensor:?}");
}

#[test]
fn refusals() {
    let cube = complex(&cuboid_grid(&[1, 1, 1]));
    let message = |found: IntegrationError| found.to_string();
    assert_eq!(cube.cell_integrals(3, [129, 0, 0]), Err(IntegrationError::Degree { degree: 129 }));
    assert_eq!(cube.cell_measures(4), Err(IntegrationError::CellDimension { p: 4 }));
    let square = complex(&cuboid_grid(&[1, 1]));
    let expected = "points of 2 coordinates; integrals are taken in 3-space and, over chains, below it";
    assert_eq!(message(square.mass_properties(3).unwrap_err()), expected);
    let edge = cube.chain(1, [(0, 1)]).unwrap();
    let expected = "a 1-chain on 12 cells where a 2-chain on 6 cells is needed";
    assert_eq!(message(cube.chain_areas(&[edge]).unwrap_err()), expected);
    let few = ChainComplex::new(Points::new(3), vec![cube.boundary(1).clone()]);
    let expected = "not a chain complex: ∂1 has 8 rows, but there are 0 0-cells";
    assert_eq!(message(few.cell_measures(1).unwrap_err()), expected);
    let mut mesh = icosphere(1);
    mesh.triangles[3][2] = 99;
    let expected = "face f3 names vertex v99, but there are 42 vertices";
    assert_eq!(message(mesh.volume_integral([0; 3]).unwrap_err()), expected);
    let empty = TriangleMesh { points: Points::new(3), triangles: Vec::new() };
    let body = empty.solid_mass_properties().unwrap();
    assert_eq!((body.mass(), body.centroid(), body.principal_axes()), (0., None, None));
    let infinite = cuboid_grid(&[1, 1, 1]).into_parts().0;
    let infinite = Points::from_columns(3, infinite.coords().iter().map(|x| x * f64::MAX).collect());
    let boundaries = (1..=3).map(|p| cube.boundary(p).clone()).collect();
    let body = ChainComplex::new(infinite, boundaries).mass_properties(3).unwrap()[0];
    assert_eq!(body.principal_axes(), None);
}

fn affine() -> impl Strategy<Value = Affine> {
    (
        prop::array::uniform3(-3.0..3.0_f64),
        prop::array::uniform3(0.2..2.0_f64),
        prop::array::uniform3(-2.0..2.0_f64),
    )
        .prop_map(|(turn, scale, by)| &(&t(&by) * &r(turn)) * &(&s(&scale) * &r([turn[1], turn[2], turn[0]])))
}

fn solids() -> Model {
    let scene = Struct::new("solids").with(cuboid_grid(&[2, 1, 1])).with(t(&[3., 0., 0.]));
    scene.with(triangular_prism()).with(t(&[0., 2., 0.])).with(simplex(3)).struct2lar().unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// (a + 1) ∫ x^a y^b z^c dV = ∫ x^(a+1) y^b z^c n_x dS for each 3-cell.
    #[test]
    fn gauss(map in affine(), degrees in prop::array::uniform3(0..5_u32)) {
        let solids = complex(&solids().transformed(&map).unwrap());
        let volumes = solids.cell_integrals(3, degrees).unwrap();
        let [a, b, c] = degrees;
        let faces = solids.cell_integrals(2, [a + 1, b, c]).unwrap();
        for (column, volume) in solids.boundary(3).outer_iterator().zip(volumes) {
            let flux: Vec<f64> = column
                .iter()
                .map(|(f, &sign)| f64::from(sign) * solids.face_normal(f).unwrap()[0] * faces[f])
                .collect();
            let scale = flux.iter().map(|x| x.abs()).sum::<f64>();
            prop_assert!(close(f64::from(a + 1) * volume, flux.iter().sum(), scale), "{} {:?}", volume, flux);
        }
    }

    /// (a + 1) ∫ x^a y^b dA = ∮ x^(a+1) y^b dy for each face in the plane.
    #[test]
    fn green(k in prop::array::uniform4(-2.0..2.0_f64), a in 0..6_u32, b in 0..6_u32) {
        let (points, cells) = cuboid_grid(&[3, 2]).into_parts();
        let moved = points.iter().flat_map(|p| [k[0] * p[0] + k[1] * p[1], k[2] * p[0] + k[3] * p[1] + 1.]);
        let plane = complex(&Model::new(Points::from_columns(2, moved.collect()), cells));
        let areas = plane.cell_integrals(2, [a, b, 0]).unwrap();
        let edges = plane.cell_integrals(1, [a + 1, b, 0]).unwrap();
        for (column, area) in plane.boundary(2).outer_iterator().zip(areas) {
            let terms: Vec<f64> = column.iter().map(|(e, &sign)| {
                let [from, to] = plane.edge_ends(e).unwrap().map(|v| plane.points().point(v as usize));
                let length = (to[0] - from[0]).hypot(to[1] - from[1]);
                f64::from(sign) * edges[e] * (to[1] - from[1]) / length.max(f64::MIN_POSITIVE)
            }).collect();
            let scale = terms.iter().map(|x| x.abs()).sum::<f64>();
            prop_assert!(close(f64::from(a + 1) * area, terms.iter().sum(), scale));
        }
    }

    /// m' = |A| m, c' = A c + b, and the second moments about the centroid become |A| A S Aᵀ.
    #[test]
    fn mass_properties_follow_affine_maps(map in affine()) {
        let (still, moved) = (complex(&solids()), complex(&solids().transformed(&map).unwrap()));
        let (before, after) = (still.mass_properties(3).unwrap(), moved.mass_properties(3).unwrap());
        let linear = map.matrix().fixed_view::<3, 3>(0, 0).into_owned();
        let factor = linear.determinant().abs();
        for (before, after) in before.iter().zip(after) {
            prop_assert!(close(after.mass(), factor * before.mass(), 0.));
            let centroid = Points::from_xyz(&[before.centroid().unwrap()]);
            let expected = map.apply(&centroid).unwrap().xyz(0);
            let found = after.centroid().unwrap();
            prop_assert!((0..3).all(|k| close(found[k], expected[k], 1.)));
            let second = |body: &lar_core::MassProperties| {
                let tensor = nalgebra::Matrix3::from(body.inertia_about(body.centroid().unwrap()));
                nalgebra::Matrix3::identity() * (tensor.trace() / 2.) - tensor
            };
            let expected = linear * second(before) * linear.transpose() * factor;
            prop_assert!((second(&after) - expected).norm() <= 1e-11 * expected.norm());
        }
    }

    /// The axes of a turned box are its turned sides; the frame is orthonormal and right-handed.
    #[test]
    fn principal_axes_turn_with_the_body(turn in prop::array::uniform3(-3.0..3.0_f64), by in prop::array::uniform3(-9.0..9.0_f64)) {
        let map = &(&t(&by) * &r(turn)) * &s(&[3., 2., 1.]);
        let body = complex(&cuboid_grid(&[1, 1, 1]).transformed(&map).unwrap()).mass_properties(3).unwrap()[0];
        let found = body.principal_axes().unwrap();
        let expected = [6. * 5. / 12., 6. * 10. / 12., 6. * 13. / 12.];
        prop_assert!((0..3).all(|k| close(found.moments[k], expected[k], 1.)));
        let axes = nalgebra::Matrix3::from(found.axes);
        prop_assert!((axes.determinant() - 1.).abs() < 1e-12);
        let sides = r(turn).matrix().fixed_view::<3, 3>(0, 0).into_owned();
        prop_assert!((0..3).all(|k| (sides.column(k).dot(&axes.column(k)).abs() - 1.).abs() < 1e-9));
    }

    /// The cells of a complex, its boundary surface and its mesh agree.
    #[test]
    fn parts_add_up(map in affine(), degrees in prop::array::uniform3(0..4_u32)) {
        let model = cuboid_grid(&[2, 2, 1]).transformed(&map).unwrap();
        let (cells, surface) = (complex(&model), model.to_surface("grid").unwrap());
        let parts = cells.cell_integrals(3, degrees).unwrap();
        let scale = parts.iter().map(|x| x.abs()).sum::<f64>() + 1e-3;
        prop_assert!(close(surface.volume_integral(degrees).unwrap(), parts.iter().sum(), scale));
        let all = cells.chain(3, (0..4).map(|c| (c, 1))).unwrap();
        prop_assert!(close(cells.chain_integral(&all, degrees).unwrap(), parts.iter().sum(), scale));
        let triangles: Vec<[u32; 3]> = (0..surface.n_faces())
            .filter(|&f| surface.coefficient(f) == 1)
            .flat_map(|f| surface.face(f).map(|l| [[l[0], l[1], l[2]], [l[0], l[2], l[3]]]).collect::<Vec<_>>())
            .flatten()
            .collect();
        let mesh = TriangleMesh { points: surface.points.clone(), triangles };
        prop_assert!(close(mesh.volume_integral(degrees).unwrap(), parts.iter().sum(), scale));
        let (one, other) = (mesh.solid_mass_properties().unwrap(), cells.chain_mass_properties(&all).unwrap());
        let (one, other) = (one.inertia_about([1., 2., 3.]), other.inertia_about([1., 2., 3.]));
        prop_assert!((0..3).all(|i| (0..3).all(|j| close(one[i][j], other[i][j], 1e2))));
        let shell = mesh.shell_mass_properties().unwrap();
        prop_assert!(close(shell.mass(), mesh.area(), 0.));
        prop_assert!(close(shell.first_moments()[1], mesh.surface_integral([0, 1, 0]).unwrap(), 1e2));
    }
}
