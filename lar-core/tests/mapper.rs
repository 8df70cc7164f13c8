//! The shapes of the mapper: counts, closedness, orientation and measures; laws of gluing and mapping.

use lar_core::mapper::{
    Ball, Circle, Crown, Cylinder, Disk, GluedGrid, Helicoid, Helix, HollowBall, HollowCylinder, MapError,
    Pizza, Ring, Rod, Side, Sphere, Toroidal, Torus, cuboid, map,
};
use lar_core::{ChainComplex, Model, Points, cuboid_grid};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// f-vector and Euler characteristic of the complex in space.
#[track_caller]
fn check_complex(model: &Model, f_vector: &[usize], euler: i64) -> ChainComplex {
    assert_eq!(model.validate(), []);
    let complex = ChainComplex::from_model(model).unwrap();
    assert_eq!(complex.validate(), []);
    assert_eq!(complex.f_vector(), f_vector);
    assert_eq!(complex.euler_characteristic(), euler);
    assert_eq!(complex.connected_components().n, 1);
    complex
}

/// A surface: V, E, F, χ, number of open edges, area within one part in `tolerance`.
#[track_caller]
fn check_surface(model: &Model, f_vector: &[usize; 3], euler: i64, open: usize, area: f64, tolerance: f64) {
    check_complex(model, f_vector, euler);
    let mesh = model.embedded(3).unwrap().to_triangle_mesh().unwrap();
    assert_eq!(mesh.is_closed(), open == 0);
    assert_eq!(model.embedded(3).unwrap().to_surface("s").unwrap().boundary_edges().len(), open);
    assert!((mesh.area() / area - 1.).abs() < tolerance, "area {} of {area}", mesh.area());
}

#[test]
fn curves() {
    let circle = Circle::default().model().unwrap();
    check_complex(&circle, &[36, 36], 0);
    assert!(circle.points().iter().all(|p| (p[0].hypot(p[1]) - 1.).abs() < 1e-15));
    assert_eq!(circle.points().point(9), [0., 1.]);
    check_complex(&Circle { radius: 2., angle: PI, shape: 5 }.model().unwrap(), &[6, 5], 1);
    let helix = Helix::default().model().unwrap();
    check_complex(&helix, &[73, 72], 1);
    assert_eq!(helix.points().point(72), [1., 0., 2.]);
}

#[test]
fn flat_surfaces_are_counter_clockwise() {
    let signed = |model: &Model| -> f64 {
        let p = |v: u32| model.points().point(v as usize);
        let doubled = |t: &[u32]| {
            let (a, b, c) = (p(t[0]), p(t[1]), p(t[2]));
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        assert!(model.cells(2).iter().all(|t| doubled(t) > 0.));
        model.cells(2).iter().map(doubled).sum::<f64>() / 2.
    };
    let disk = Disk::default().model().unwrap();
    check_surface(&disk, &[73, 180, 108], 1, 36, PI, 0.01);
    assert!((signed(&disk) - 18. * (PI / 18.).sin()).abs() < 1e-12);
    let ring = Ring::default().model().unwrap();
    check_surface(&ring, &[72, 144, 72], 0, 72, 3. * PI, 0.01);
    assert!((signed(&ring) - 54. * (PI / 18.).sin()).abs() < 1e-12);
    let slice = Disk { angle: 0.7, shape: [4, 3], ..Disk::default() }.model().unwrap();
    check_surface(&slice, &[16, 35, 20], 1, 10, 0.35, 0.01);
}

#[test]
fn open_surfaces() {
    check_surface(&Helicoid::default().model().unwrap(), &[219, 506, 288], 1, 148, 4.8212, 0.01);
    check_surface(&Cylinder::default().model().unwrap(), &[72, 144, 72], 0, 72, TAU, 0.01);
    let crown = Crown::default().model().unwrap();
    check_surface(&crown, &[468, 1332, 864], 0, 72, TAU * PI * 2. + 4. * PI, 0.01);
    let zone = Sphere { angle1: PI / 3., ..Sphere::default() }.model().unwrap();
    check_surface(&zone, &[19 * 36, 37 * 36 + 18 * 36, 36 * 36], 0, 72, TAU, 0.01);
    let lune = Sphere { angle2: PI, shape: [8, 8], ..Sphere::default() }.model().unwrap();
    check_surface(&lune, &[65, 176, 112], 1, 16, TAU, 0.06);
}

/// Normals of the outward triangles point away from the nearest point of the core.
#[track_caller]
fn check_outward(model: &Model, core: impl Fn([f64; 3]) -> [f64; 3]) {
    for t in model.cells(2).iter() {
        let [a, b, c] = [0, 1, 2].map(|k| model.points().xyz(t[k] as usize));
        let [u, v] = [[b, a], [c, a]].map(|[p, q]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]]);
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let middle = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.);
        let from = core(middle);
        let along: f64 = (0..3).map(|k| n[k] * (middle[k] - from[k])).sum();
        assert!(along > 0., "triangle {t:?} faces inward");
    }
}

#[test]
fn closed_surfaces_are_closed_and_outward() {
    let on_axis = |p: [f64; 3]| [0., 0., p[2]];
    let on_core = |p: [f64; 3]| {
        let out = p[0].hypot(p[1]);
        [2. * p[0] / out, 2. * p[1] / out, 0.]
    };
    let sphere = Sphere::default().model().unwrap();
    check_surface(&sphere, &[614, 1836, 1224], 2, 0, 4. * PI, 0.01);
    check_outward(&sphere, |_| [0.; 3]);
    let volume = sphere.to_triangle_mesh().unwrap().signed_volume();
    assert!(volume > 0. && (volume / (4. / 3. * PI) - 1.).abs() < 0.02);
    let torus = Toroidal::default().model().unwrap();
    check_surface(&torus, &[864, 2592, 1728], 0, 0, 8. * PI * PI, 0.01);
    check_outward(&torus, on_core);
    let volume = torus.to_triangle_mesh().unwrap().signed_volume();
    assert!(volume > 0. && (volume / (4. * PI * PI) - 1.).abs() < 0.03);
    check_outward(&Crown::default().model().unwrap(), on_core);
    check_outward(&Cylinder::default().model().unwrap(), on_axis);
    check_outward(&Sphere { angle1: 2., angle2: 3., ..Sphere::default() }.model().unwrap(), |_| [0.; 3]);
}

/// A solid: f-vector, χ, boundary faces and parts, volume within one part in 50 of the smooth one.
#[track_caller]
fn check_solid(model: &Model, f_vector: &[usize; 4], euler: i64, shell: (usize, usize), volume: f64) {
    let complex = check_complex(model, f_vector, euler);
    assert!(complex.cell_volumes().iter().all(|&v| v > 0.));
    let total: f64 = complex.cell_volumes().iter().sum();
    assert!((total / volume - 1.).abs() < 0.02, "volume {total} of {volume}");
    let boundary = model.boundary_cells().unwrap();
    assert_eq!(boundary.len(), shell.0);
    let surface = model.to_surface("solid").unwrap();
    assert!(surface.boundary_edges().is_empty());
    let outer: Vec<u32> =
        (0..).zip(0..surface.n_faces()).filter(|f| surface.coefficient(f.1) == 1).map(|f| f.0).collect();
    assert_eq!(outer, boundary);
    let mesh = model.to_triangle_mesh().unwrap();
    assert!(mesh.is_closed());
    assert_eq!(mesh.n_components(), shell.1);
    assert!((mesh.signed_volume() / total - 1.).abs() < 1e-9, "{} {total}", mesh.signed_volume());
    assert!(model.boundary().unwrap().boundary_cells().unwrap().is_empty());
}

#[test]
fn solids() {
    let ball = Ball::default().model().unwrap();
    // On each of the 4 spheres about the centre: 18 · 36 quadrilaterals, 18 · 36 arcs of meridians and 17 · 36 of
    // parallels; below each vertex hangs an edge, below each arc a quadrilateral.
    let (n, parallels) = (18 * 36, 17 * 36);
    let f_vector = [1 + 4 * (parallels + 2), 4 * (n + 2 * parallels + 2), 4 * (2 * n + parallels), 4 * n];
    check_solid(&ball, &f_vector, 1, (n, 1), 4. / 3. * PI);
    let shell = HollowBall::default().model().unwrap();
    let (n, parallels) = (24 * 36, 23 * 36);
    let f_vector =
        [4 * (parallels + 2), 4 * (n + parallels) + 3 * (parallels + 2), 4 * n + 3 * (n + parallels), 3 * n];
    check_solid(&shell, &f_vector, 2, (2 * n, 2), 4. / 3. * PI * 7.);
    let pipe = HollowCylinder::default().model().unwrap();
    check_solid(&pipe, &[144, 288, 180, 36], 0, (144, 1), 18. * PI);
    let torus = Torus::default().model().unwrap();
    check_solid(&torus, &[5 * n, 14 * n, 13 * n, 4 * n], 0, (2 * n, 2), 4. * PI * PI * 0.75);
    let full = Torus { hole: 0., ..Torus::default() }.model().unwrap();
    check_solid(&full, &[4 * n + 36, 12 * n + 36, 12 * n, 4 * n], 0, (n, 1), 4. * PI * PI);
    check_solid(&Rod::default().model().unwrap(), &[72, 108, 38, 1], 1, (38, 1), 3. * PI);
    check_solid(&cuboid(&[1., 1., 1.], &[3., 2., 1.5]).unwrap(), &[8, 12, 6, 1], 1, (6, 1), 1.);
}

#[test]
fn parts_of_solids() {
    let half_disk = PI / 2. * 0.01;
    let half_slab = PI / 2. * 0.2 + PI * (half_disk + 2. / 3. * 0.001);
    let half = Pizza::default().model().unwrap();
    check_solid(&half, &[927, 1793, 868, 1], 1, (868, 1), half_slab);
    let whole = Pizza { angle: TAU, ..Pizza::default() }.model().unwrap();
    check_solid(&whole, &[900, 1764, 866, 1], 1, (866, 1), 2. * half_slab);
    let slice = Pizza { angle: 0.5, shape: [12, 6], ..Pizza::default() }.model().unwrap();
    check_solid(&slice, &[93, 167, 76, 1], 1, (76, 1), half_slab * 0.5 / PI);
    let segment = Rod { angle: PI, ..Rod::default() }.model().unwrap();
    check_solid(&segment, &[74, 111, 39, 1], 1, (39, 1), 1.5 * PI);
    let wedge = Ball { angle2: 1., shape: [16, 8, 2], ..Ball::default() }.model().unwrap();
    let (e, f) = (wedge.cells(1).len(), wedge.cells(2).len());
    check_solid(&wedge, &[1 + 2 * (15 * 9 + 2), e, f, 256], 1, (16 * 8 + 2 * 2 * 16, 1), 2. / 3.);
    let band = Ball { angle1: 1., shape: [6, 36, 2], ..Ball::default() }.model().unwrap();
    let (e, f) = (band.cells(1).len(), band.cells(2).len());
    check_solid(
        &band,
        &[1 + 2 * 7 * 36, e, f, 432],
        1,
        (6 * 36 + 2 * 2 * 36, 1),
        4. / 3. * PI * 0.5_f64.sin(),
    );
    let quarter = HollowCylinder { angle: PI / 2., ..HollowCylinder::default() }.model().unwrap();
    check_solid(&quarter, &[148, 292, 181, 36], 1, (146, 1), 4.5 * PI);
    let bend = Torus { angle2: PI, hole: 0., ..Torus::default() }.model().unwrap();
    let (e, f) = (bend.cells(1).len(), bend.cells(2).len());
    check_solid(&bend, &[37 * (4 * 24 + 1), e, f, 24 * 36 * 4], 1, (24 * 36 + 2 * 4 * 24, 1), 2. * PI * PI);
}

#[test]
fn poles_of_odd_shapes() {
    for shape in [[2, 3, 1], [2, 3, 2], [3, 3, 1], [2, 4, 3], [5, 3, 1]] {
        let ball = Ball { shape, ..Ball::default() }.model().unwrap();
        let complex = ChainComplex::from_model(&ball).unwrap();
        assert_eq!((complex.validate(), complex.euler_characteristic()), (vec![], 1), "{shape:?}");
        assert_eq!(ball.boundary_cells().unwrap().len(), shape[0] * shape[1]);
    }
    let tight = Torus { shape: [3, 3, 1], ..Torus::default() }.model().unwrap();
    assert_eq!(ChainComplex::from_model(&tight).unwrap().euler_characteristic(), 0);
    let tight = Toroidal { shape: [3, 3], ..Toroidal::default() }.model().unwrap();
    check_complex(&tight, &[9, 27, 18], 0);
}

#[track_caller]
fn refused(found: Result<Model, MapError>, message: &str) {
    assert_eq!(found.unwrap_err().to_string(), message);
}

#[test]
fn refusals() {
    refused(
        Circle { radius: -1., ..Circle::default() }.model(),
        "radius is -1; it must be positive and finite",
    );
    refused(
        Circle { angle: 7., ..Circle::default() }.model(),
        "angle is 7; it must be above 0 and at most 2π",
    );
    refused(
        Sphere { angle1: f64::NAN, ..Sphere::default() }.model(),
        "angle1 is NaN; it must be above 0 and at most π",
    );
    refused(
        Ring { r: 2., ..Ring::default() }.model(),
        "r is 2; it must be positive and less than the outer radius",
    );
    refused(Helix { pitch: f64::INFINITY, ..Helix::default() }.model(), "pitch is inf; it must be finite");
    refused(
        Circle { shape: 2, ..Circle::default() }.model(),
        "2 divisions along axis 0; at least 3 are needed",
    );
    refused(
        Sphere { shape: [1, 9], ..Sphere::default() }.model(),
        "1 divisions along axis 0; at least 2 are needed",
    );
    refused(
        Rod { shape: 1, angle: 1., ..Rod::default() }.model(),
        "1 divisions along axis 0; at least 2 are needed",
    );
    refused(
        Rod { shape: usize::MAX, ..Rod::default() }.model(),
        &format!("a grid of shape [{}, 1] has 2^32 vertices, cells or entries of cells or more", usize::MAX),
    );
    refused(
        Ball { shape: [1 << 40; 3], ..Ball::default() }.model(),
        "a grid of shape [1099511627776, 1099511627776, 1099511627776] has 2^32 vertices, cells or entries of \
         cells or more",
    );
    refused(cuboid(&[0.], &[0., 1.]), "corners of 1 and of 2 coordinates");
    refused(cuboid(&[0., 1.], &[1., 1.]), "extent is 0; it must be finite and not 0");
    let grid = GluedGrid::new(&[4, 4]);
    refused(grid.clone().periodic(2).cuboids(|_| [0.]), "axis 2 of a grid of 2 axes");
    refused(
        grid.clone().collapsed(1, Side::Low, 1).cuboids(|_| [0.]),
        "a side that ends axis 1 has no extent along axis 1 to be collapsed",
    );
    refused(GluedGrid::new(&[4]).triangles(|_| [0.]), "a grid of 1 axes where 2 are needed");
    refused(grid.cuboids(|p| [1. / p[0]]), "coordinate 0 of the image of vertex v0 is inf");
    refused(map(&cuboid_grid(&[1]), |p| [1. / p[0]]), "coordinate 0 of the image of vertex v0 is inf");
}

#[test]
fn glued_sides_that_meet() {
    // Both sides that meet in the last corner collapse: they are one point.
    let grid = GluedGrid::new(&[2, 2]).collapsed(0, Side::High, 1).collapsed(1, Side::High, 0);
    assert_eq!(grid.cuboids(|p| [p[0], p[1]]).unwrap().points().len(), 5);
    let klein = GluedGrid::new(&[3, 4, 5]).periodic(0).periodic(1).periodic(2);
    let torus = klein.cuboids(|p| [p[0], p[1], p[2]]).unwrap();
    assert_eq!(torus.f_vector(), [60, 180, 180, 60]);
    assert!(torus.boundary_cells().unwrap().is_empty());
}

/// Numbering: the lowest index of each vertex, row-major; the seam closes, the centre is vertex 0.
#[test]
fn numbering_of_glued_grids() {
    let disk = Disk { shape: [3, 2], ..Disk::default() }.model().unwrap();
    let expected: [[u32; 3]; 9] =
        [[1, 2, 0], [2, 3, 0], [3, 1, 0], [1, 4, 2], [4, 5, 2], [2, 5, 3], [5, 6, 3], [3, 6, 1], [6, 4, 1]];
    assert_eq!(disk.cells(2).indices(), expected.as_flattened());
    let ball = Ball { shape: [2, 3, 1], ..Ball::default() }.model().unwrap();
    let cells: [[u32; 4]; 6] =
        [[0, 1, 2, 3], [0, 1, 3, 4], [0, 1, 4, 2], [0, 2, 3, 5], [0, 3, 4, 5], [0, 4, 2, 5]];
    let sorted: Vec<Vec<u32>> = ball
        .cells(3)
        .iter()
        .map(|cell| {
            let mut cell = cell.to_vec();
            cell.sort_unstable();
            cell
        })
        .collect();
    let expected = cells.map(|mut cell| {
        cell.sort_unstable();
        cell.to_vec()
    });
    assert_eq!(sorted, expected);
    assert_eq!(ball.f_vector(), [6, 14, 15, 6]);
}

#[test]
fn maps_of_models() {
    // The top of a prism pinched to a point.
    let pyramid = map(&cuboid_grid(&[1, 1, 1]), |p| [p[0] * (1. - p[2]), p[1] * (1. - p[2]), p[2]]).unwrap();
    assert_eq!(pyramid.f_vector(), [5, 8, 5, 1]);
    assert_eq!(ChainComplex::from_model(&pyramid).unwrap().cell_volumes(), [1. / 3.]);
    // Flattened along an axis: the cells that lose dimension are gone, front and back are one.
    let shadow = map(&cuboid_grid(&[2, 1, 1]), |p| [p[0], p[1]]).unwrap();
    assert_eq!(shadow.f_vector(), [6, 7, 2, 0]);
    let triangles = Model::from_faces(
        Points::from_columns(2, vec![0., 0., 1., 0., 1., 1., 0., 1.]),
        [&[0, 1, 2, 3][..], &[2, 1, 0]].into_iter().collect(),
    );
    let folded = map(&triangles, |p| [p[0], p[0] * p[1]]).unwrap();
    assert_eq!(folded.cells(2), &[&[0, 1, 2][..], &[2, 1, 0]].into_iter().collect());
}

proptest! {
    #[test]
    fn welding_is_idempotent_and_ignores_the_sign_of_zero(
        shape in prop::collection::vec(1..4_usize, 1..4),
        modulus in 1..4_u32,
    ) {
        let grid = cuboid_grid(&shape);
        let wrapped = map(&grid, |p| [p[0] % f64::from(modulus), -0. * p[0]]).unwrap();
        prop_assert_eq!(wrapped.validate(), []);
        prop_assert_eq!(wrapped.points().len(), (shape[0] + 1).min(modulus as usize));
        prop_assert_eq!(wrapped.welded().unwrap(), wrapped);
        let same = map(&grid, |p| [p[0], *p.last().unwrap(), p[p.len() / 2]]).unwrap();
        prop_assert_eq!(same.f_vector(), grid.f_vector());
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn every_solid_is_closed(
        shape in prop::array::uniform3(2..7_usize),
        part in 0.1..1.0_f64,
        full in any::<[bool; 2]>(),
    ) {
        let shape = shape.map(|n| n + 1);
        let angle1 = if full[0] { PI } else { part * PI };
        let angle2 = if full[1] { TAU } else { part * TAU };
        let [out, around, height] = shape;
        let models = [
            Ball { angle1, angle2, shape, ..Ball::default() }.model(),
            HollowBall { angle1, angle2, shape, ..HollowBall::default() }.model(),
            HollowCylinder { angle: angle2, shape: [around, out, height], ..HollowCylinder::default() }.model(),
            Torus { angle1: 2. * angle1, angle2, shape, ..Torus::default() }.model(),
            Torus { angle1: 2. * angle1, angle2, hole: 0., shape, ..Torus::default() }.model(),
            Rod { angle: angle2, shape: around, ..Rod::default() }.model(),
            Pizza { angle: angle2, shape: [out, around], ..Pizza::default() }.model(),
        ];
        for model in models {
            let model = model.unwrap();
            let complex = ChainComplex::from_model(&model).unwrap();
            prop_assert_eq!(complex.validate(), []);
            prop_assert!(complex.cell_volumes().iter().all(|&v| v > 0.));
            let mesh = model.to_triangle_mesh().unwrap();
            prop_assert!(mesh.is_closed() && mesh.signed_volume() > 0.);
        }
    }
}
