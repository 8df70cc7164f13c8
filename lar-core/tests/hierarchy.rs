//! Hierarchies: depth without limit, categories, boxes, embedding, welding, sharing.

use lar_core::{Model, Node, Struct, cuboid_grid, r, s, t};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

const DEEP: usize = 100_000;

/// One square inside `DEEP` containers, each moving by one.
fn deep() -> Struct {
    let inmost = Struct::new("").with(("square", cuboid_grid(&[1, 1])));
    (1..DEEP).fold(inmost, |inner, _| Struct::new("").with(t(&[1., 0.])).with(inner))
}

#[test]
fn nesting_has_no_depth_limit() {
    let scene = deep();
    assert_eq!(scene, deep());
    let mut deepest = 0;
    scene.visit(|v| deepest = deepest.max(v.depth)).unwrap();
    assert_eq!(deepest, DEEP);
    let placed = scene.eval_struct().unwrap();
    assert_eq!((placed.len(), placed[0].name()), (1, "square"));
    assert_eq!(placed[0].model.points().point(0), [99_999., 0.]);
    assert_eq!(scene.bounds().unwrap(), Some((vec![99_999., 0.], vec![100_000., 1.])));
    let raised = scene.embedded(3).unwrap();
    assert_eq!(raised.struct2lar().unwrap().points().dim(), 3);
    assert!(format!("{scene:?}").len() < 1000);
    drop(scene.clone());
    drop(scene);
}

/// 2^DEPTH cubes from DEPTH + 1 containers and one model.
#[test]
fn instances_share_one_geometry() {
    let cube = Arc::new(cuboid_grid(&[1, 1, 1]));
    let mut tower = Arc::new(Struct::new("leaf").with(("cube", Arc::clone(&cube))));
    for level in 0..12 {
        let by = t(&[0., 0., f64::from(1 << level)]);
        tower = Arc::new(
            Struct::new(format!("{level}"))
                .with(Node::from(Arc::clone(&tower)))
                .with(by)
                .with(Node::from(Arc::clone(&tower))),
        );
    }
    let instances = tower.traversal().unwrap();
    assert_eq!(instances.len(), 4096);
    assert!(instances.iter().all(|i| Arc::ptr_eq(&i.model, &cube)));
    assert_eq!(Arc::strong_count(&cube), 2 + 4096);
    assert_eq!(tower.bounds().unwrap(), Some((vec![0.; 3], vec![1., 1., 4096.])));
    let heights: Vec<f64> = instances.iter().map(|i| i.world_from_local.matrix()[(2, 3)]).collect();
    assert!(heights.iter().zip(0..).all(|(&z, i)| z == f64::from(i)));
    drop(instances);
    let raised = tower.embedded(4).unwrap().traversal().unwrap();
    assert!(raised.iter().all(|i| Arc::ptr_eq(&i.model, &raised[0].model)));
    assert_eq!(raised[0].model.points().dim(), 4);
}

#[test]
fn visits_tell_paths_categories_and_matrices() {
    let chair = Struct::new("chair").with_category("seat").with(("leg", cuboid_grid(&[1, 1])));
    let room = Struct::new("room")
        .with(chair.clone())
        .with(t(&[4., 0.]))
        .with(("table", cuboid_grid(&[2, 1])))
        .with(chair);
    let mut lines = Vec::new();
    room.visit(|v| {
        let at = v.world_from_local.map(|map| map.matrix()[(0, 2)]);
        lines.push(format!("{} {} {:?} {:?}", v.path, v.depth, v.container.category(), at));
    })
    .unwrap();
    assert_eq!(
        lines,
        [
            "room/chair 1 \"\" None",
            "room/chair/leg 2 \"seat\" Some(0.0)",
            "room/1 1 \"\" None",
            "room/table 1 \"\" Some(4.0)",
            "room/chair 1 \"\" Some(4.0)",
            "room/chair/leg 2 \"seat\" Some(4.0)",
        ]
    );
}

#[test]
fn embedding_names_what_does_not_fit() {
    let inner = Struct::new("inner").with(cuboid_grid(&[1])).with(("solid", cuboid_grid(&[1, 1, 1])));
    let scene = Struct::new("s").with(cuboid_grid(&[1, 1])).with(inner);
    let message = scene.embedded(2).unwrap_err().to_string();
    assert_eq!(message, "s/inner/solid: a map of 3-space where one of 2-space is needed");
    assert_eq!(scene.embedded(4).unwrap().struct2lar().unwrap().f_vector(), [14, 17, 7, 1]);
    assert!(scene.struct2lar().is_err());
}

#[test]
fn equality_looks_into_shared_and_copied_parts() {
    let scene = |by: f64| Struct::new("a").with(Struct::new("b").with(t(&[by])).with(cuboid_grid(&[2])));
    assert_eq!(scene(1.), scene(1.));
    assert_ne!(scene(1.), scene(2.));
    assert_ne!(scene(1.), scene(1.).with_category("c"));
    assert_ne!(Struct::new("a").with(t(&[1.])), Struct::new("a").with(cuboid_grid(&[1])));
    assert_eq!(Node::from(scene(1.)), Node::from(scene(1.)));
}

#[test]
fn welding_a_wall_of_cubes() {
    let cube = Arc::new(cuboid_grid(&[1, 1, 1]));
    let row = Struct::from_nodes(
        "row",
        (0..4).flat_map(|_| [Node::from(Arc::clone(&cube)), t(&[1., 0., 0.]).into()]),
    );
    let wall = Struct::new("wall").with(row.clone()).with(t(&[0., 0., 1.])).with(row);
    let flat = wall.struct2lar().unwrap();
    assert_eq!(flat.f_vector(), [64, 96, 48, 8]);
    let welded = flat.welded().unwrap();
    assert_eq!(welded.f_vector(), cuboid_grid(&[4, 1, 2]).f_vector());
    assert_eq!(welded.boundary_cells().unwrap().len(), 28);
    let apart = Struct::new("apart").with(cube.clone()).with(t(&[1. + 1e-15, 0., 0.])).with(cube);
    assert_eq!(apart.struct2lar().unwrap().welded().unwrap().f_vector(), [16, 24, 12, 2]);
    assert_eq!(Struct::new("empty").bounds().unwrap(), None);
}

#[test]
fn matrices_left_of_a_mirror() {
    let quarter = Struct::new("q").with(r(FRAC_PI_2)).with(s(&[2., 1.])).with(cuboid_grid(&[1, 1]));
    let (lo, hi) = quarter.bounds().unwrap().unwrap();
    assert!((lo[0] + 1.).abs() < 1e-15 && (hi[1] - 2.).abs() < 1e-15);
}

fn boxes(model: &Model) -> (Vec<f64>, Vec<f64>) {
    model.points().bounds().unwrap()
}

proptest! {
    #[test]
    fn boxes_and_embedding_agree_with_flattening(
        moves in prop::collection::vec((-5.0..5.0_f64, -5.0..5.0_f64, -3.0..3.0_f64, any::<bool>()), 1..8),
    ) {
        let mut scene = Struct::new("s").with(cuboid_grid(&[1, 2]));
        for (x, y, angle, nest) in moves {
            scene.push(t(&[x, y]));
            scene.push(r(angle));
            scene.push(cuboid_grid(&[1, 1]));
            if nest {
                scene = Struct::new("outer").with(s(&[0.5, -1.5])).with(scene);
            }
        }
        let flat = scene.struct2lar().unwrap();
        prop_assert_eq!(scene.bounds().unwrap().unwrap(), boxes(&flat));
        prop_assert_eq!(scene.embedded(3).unwrap().struct2lar().unwrap(), flat.embedded(3).unwrap());
        let n: usize = scene.traversal().unwrap().iter().map(|i| i.model.points().len()).sum();
        prop_assert_eq!(n, flat.points().len());
    }
}
