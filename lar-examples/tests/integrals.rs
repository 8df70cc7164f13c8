//! Integrals of lar-core over the cells of exact arrangements: two ways to the same volumes.

use lar_arrangement::{Arrangement, arrange};
use lar_core::{CellId, Struct, cuboid_grid, s, t};
use lar_examples::scenes;

fn volumes_agree(a: &Arrangement, tolerance: f64) {
    let integrals = a.complex().cell_integrals(3, [0, 0, 0]).expect("a valid complex");
    let masses = a.complex().mass_properties(3).expect("a valid complex");
    for (cell, expected) in a.volumes().into_iter().enumerate() {
        assert!(
            (integrals[cell] - expected).abs() < tolerance,
            "cell {cell}: {} {expected}",
            integrals[cell]
        );
        assert!(
            (masses[cell].mass() - expected).abs() < tolerance,
            "cell {cell}: {} {expected}",
            masses[cell].mass()
        );
    }
}

#[test]
fn volumes_of_general_scenes() {
    for seed in 0..20 {
        let surfaces = scenes::surfaces(&scenes::random_cubes(8, seed)).expect("well formed");
        volumes_agree(&arrange(&surfaces).expect("finite"), 1e-12);
    }
}

/// Boxes with integer corners: the integral of x y z over each cell, by counting unit cubes.
#[test]
fn moments_of_integer_boxes() {
    let boxes: [([f64; 3], [f64; 3]); 3] =
        [([0.0; 3], [3.0, 2.0, 2.0]), ([1.0, 1.0, 0.0], [3.0, 3.0, 1.0]), ([2.0, 0.0, 1.0], [2.0, 2.0, 3.0])];
    let mut scene = Struct::new("boxes");
    for (at, size) in boxes {
        scene.push(Struct::new("box").with(t(&at)).with(s(&size)).with(cuboid_grid(&[1, 1, 1])));
    }
    let surfaces: Vec<_> =
        scene.eval_struct().expect("well formed").iter().map(|m| m.to_surface().expect("faces")).collect();
    let a = arrange(&surfaces).expect("finite");
    volumes_agree(&a, 1e-12);
    let found = a.complex().cell_integrals(3, [1, 1, 1]).expect("a valid complex");
    let mut expected = std::collections::BTreeMap::<Vec<bool>, f64>::new();
    for cell in 0..6u32.pow(3) {
        let p = [cell % 6, cell / 6 % 6, cell / 36].map(f64::from);
        let inside: Vec<bool> =
            boxes.iter().map(|(at, size)| (0..3).all(|k| at[k] <= p[k] && p[k] < at[k] + size[k])).collect();
        if inside.contains(&true) {
            *expected.entry(inside).or_default() += p.iter().map(|x| x + 0.5).product::<f64>();
        }
    }
    let mut sums = std::collections::BTreeMap::<Vec<bool>, f64>::new();
    for (cell, integral) in (0..).map(CellId).zip(&found).skip(1) {
        let inside = (0..3).map(|solid| a.winding(cell, solid) != 0).collect();
        *sums.entry(inside).or_default() += integral;
    }
    assert_eq!(sums.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    for (inside, expected) in expected {
        assert!((sums[&inside] - expected).abs() < 1e-9, "{inside:?}: {} not {expected}", sums[&inside]);
    }
}
