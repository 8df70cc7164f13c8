//! The table of 3D arrangements with known counts.

use lar_arrangement::{Arrangement, Arranger, Checks};
use lar_core::{Model, Node, Struct, Surface, cuboid_grid, r, s, simplex, t, triangular_prism};

fn surfaces(scene: &Struct) -> Vec<Surface> {
    let models = scene.eval_struct().expect("the scene is well formed");
    models.iter().map(|m| m.to_surface().expect("the models have faces")).collect()
}

fn arranged(surfaces: &[Surface]) -> Arrangement {
    Arranger::new().checks(Checks::EveryStage).arrange(surfaces).expect("every stage holds")
}

#[track_caller]
fn check(name: &str, nodes: Vec<Node>, expected: [usize; 4]) -> Arrangement {
    let scene = Struct::from_nodes(name, nodes);
    let a = arranged(&surfaces(&scene));
    let found = [a.n_vertices(), a.n_edges(), a.n_faces(), a.n_cells()];
    println!(
        "{name}: {found:?} exact {} triangulated {}",
        a.stats().exact_fallbacks,
        a.stats().triangulated_polygons
    );
    assert_eq!(found, expected, "{name}");
    a
}

fn cube() -> Model {
    cuboid_grid(&[1, 1, 1])
}

const PI: f64 = std::f64::consts::PI;

#[test]
fn three_cubes() {
    check(
        "three cubes",
        vec![
            cube().into(),
            t(&[0.3, 0.4, 0.25]).into(),
            r([PI / 5.0, 0.0, 0.0]).into(),
            r([0.0, 0.0, PI / 12.0]).into(),
            cube().into(),
            t(&[-0.2, 0.4, -0.2]).into(),
            r([0.0, PI / 5.0, 0.0]).into(),
            r([0.0, PI / 12.0, 0.0]).into(),
            cube().into(),
        ],
        [49, 88, 47, 8],
    );
}

#[test]
fn rows() {
    check(
        "turned",
        vec![cube().into(), t(&[0.0, 0.0, 0.5]).into(), r([0.0, 0.0, PI / 3.0]).into(), cube().into()],
        [20, 34, 18, 4],
    );
    check("corner", vec![cube().into(), t(&[0.5, 0.5, 0.5]).into(), cube().into()], [22, 36, 18, 4]);
    check(
        "simplices",
        vec![simplex(3).into(), t(&[0.25, 0.25, 0.25]).into(), simplex(3).into()],
        [11, 18, 12, 4],
    );
    check(
        "skew",
        vec![
            cube().into(),
            t(&[0.3, 0.4, 0.5]).into(),
            r([PI / 5.0, 0.0, 0.0]).into(),
            r([0.0, 0.0, PI / 12.0]).into(),
            cube().into(),
        ],
        [22, 36, 18, 4],
    );
    check(
        "nested",
        vec![cube().into(), t(&[0.25; 3]).into(), s(&[0.5; 3]).into(), cube().into()],
        [16, 24, 12, 3],
    );
    check(
        "sharing a vertex",
        vec![simplex(3).into(), s(&[0.25; 3]).into(), simplex(3).into()],
        [7, 12, 8, 3],
    );
    check("sharing a face", vec![cube().into(), t(&[1.0, 0.0, 0.0]).into(), cube().into()], [12, 20, 11, 3]);
    check(
        "sharing half a face",
        vec![cube().into(), t(&[1.0, 0.5, 0.0]).into(), cube().into()],
        [16, 26, 13, 3],
    );
    check("overlapping", vec![cube().into(), t(&[0.5, 0.0, 0.0]).into(), cube().into()], [16, 28, 16, 4]);
    for (n, expected) in [(1, [8, 12, 6, 2]), (2, [27, 54, 36, 9]), (3, [64, 144, 108, 28])] {
        check("grid", vec![cuboid_grid(&[n, n, n]).into()], expected);
    }
    let prism = triangular_prism();
    check(
        "prisms",
        vec![
            prism.clone().into(),
            r([PI / 2.0, 0.0, 0.0]).into(),
            prism.clone().into(),
            r([0.0, PI / 2.0, 0.0]).into(),
            prism.into(),
        ],
        [32, 63, 39, 8],
    );
}
