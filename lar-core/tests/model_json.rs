//! Models and hierarchies as JSON: round trips, sharing, refusals, hostile text.

use lar_core::{Affine, Cells, Model, Node, Points, Struct, cuboid_grid, r, s, t};
use proptest::prelude::*;
use std::sync::Arc;

fn chair() -> Struct {
    let leg = Arc::new(cuboid_grid(&[1, 1, 1]));
    let legs = Arc::new(Struct::new("legs").with(leg.clone()).with(t(&[0.1, 0., 0.])).with(("right", leg)));
    Struct::new("chair \"1\"")
        .with_category("furniture")
        .with(legs.clone())
        .with(s(&[-1., 1., 2.]))
        .with(legs)
}

#[test]
fn texts() {
    let triangle = Model::from_faces(
        Points::from_columns(2, vec![0., -0., 1e-300, 0.1, 2., 3.]),
        Cells::uniform(3, vec![0, 1, 2]),
    );
    let place = Struct::new("s").with(("a", triangle.clone())).with(r(0.)).with(Struct::new("empty"));
    insta::assert_snapshot!(format!("{}\n{}", triangle.to_json().unwrap(), place.to_json().unwrap()));
}

#[test]
fn what_is_shared_stays_shared() {
    let text = chair().to_json().unwrap();
    assert_eq!((text.matches("points").count(), text.matches("\"name\":\"legs\"").count()), (1, 1));
    let back = Struct::from_json(&text).unwrap();
    assert_eq!(back, chair());
    let [Node::Struct(a), _, Node::Struct(b)] = back.nodes() else { panic!("{back:?}") };
    assert!(Arc::ptr_eq(a, b));
    assert_eq!(back.to_json().unwrap(), text);
    assert_eq!(back.traversal().unwrap(), chair().traversal().unwrap());
}

#[test]
fn files() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.json");
    chair().write_json(&path).unwrap();
    assert_eq!(Struct::read_json(&path).unwrap(), chair());
    let refused = Model::read_json(&path).unwrap_err().to_string();
    assert!(refused.ends_with("a.json: format is \"lar-struct\", not \"lar-model\""), "{refused}");
    cuboid_grid(&[2]).write_json(&path).unwrap();
    assert_eq!(Model::read_json(&path).unwrap(), cuboid_grid(&[2]));
    assert!(Model::read_json(dir.path()).unwrap_err().to_string().starts_with("cannot read"));
}

/// Each container holds the one before twice: 2^40 cubes in 40 containers; and a chain 50 000 deep.
#[test]
fn depth_and_sharing_cost_nothing() {
    let mut twice = Arc::new(Struct::new("0").with(cuboid_grid(&[1])));
    for _ in 0..40 {
        twice = Arc::new(Struct::new("n").with(Arc::clone(&twice)).with(twice));
    }
    let text = twice.to_json().unwrap();
    assert_eq!(Struct::from_json(&text).unwrap().to_json().unwrap(), text);
    let mut deep = Struct::new("0").with(cuboid_grid(&[1]));
    for _ in 0..50_000 {
        deep = Struct::new("n").with(deep);
    }
    assert_eq!(Struct::from_json(&deep.to_json().unwrap()).unwrap(), deep);
}

#[track_caller]
fn check_model(from: &str, to: &str, message: &str) {
    let text = cuboid_grid(&[1, 1]).to_json().unwrap();
    assert!(text.contains(from), "{text}");
    let found = Model::from_json(&text.replacen(from, to, 1)).unwrap_err().to_string();
    assert!(found.contains(message), "{found}");
}

#[track_caller]
fn check_struct(from: &str, to: &str, message: &str) {
    let text = chair().to_json().unwrap();
    assert!(text.contains(from), "{text}");
    let found = Struct::from_json(&text.replacen(from, to, 1)).unwrap_err().to_string();
    assert!(found.contains(message), "{found}");
}

#[test]
fn refusals() {
    check_model("lar-model", "x", "format is \"x\", not \"lar-model\"");
    check_model("\"version\":1", "\"version\":9", "version 9 cannot be read, only version 1");
    check_model("[0.0,0.0]", "[0.0]", "point v0 of model 0 has 1 coordinates, not 2");
    check_model("[[0],", "[[7],", "model 0 is malformed: 0-cell 0 names vertex v7, but there are 4 vertices");
    check_model("[[0],", "[[-7],", "invalid value");
    check_model("0.0", "1e999", "number out of range");
    check_model("\"space\"", "\"extra\":1,\"space\"", "unknown field `extra`");
    check_struct("\"struct\":0", "\"struct\":1", "node 0 of container 1 names container 1 of 1");
    check_struct("\"index\":0", "\"index\":1", "node 0 of container 0 names model 1 of 1");
    check_struct("[1.0,0.0,0.0,0.1]", "[1.0,0.0,0.1]", "node 1 of container 0: row 0 has 3 entries, not 4");
    check_struct("[0.0,0.0,0.0,1.0]", "[0.0,0.5,0.0,1.0]", "node 1 of container 0: entry (3, 1) is 0.5");
    check_struct("\"category\":\"\",", "", "missing field `category`");
    let empty = "{\"format\":\"lar-struct\",\"version\":1,\"models\":[],\"structs\":[]}";
    assert_eq!(Struct::from_json(empty).unwrap_err().to_string(), "no container");
    let broken = Model::new(Points::from_columns(1, vec![f64::NAN]), vec![]);
    let message = "model 0 is malformed: coordinate 0 of vertex v0 is NaN";
    assert_eq!(broken.to_json().unwrap_err().to_string(), message);
    let far = Struct::new("s").with(t(&[f64::INFINITY]));
    assert_eq!(far.to_json().unwrap_err().to_string(), "node 0 of container 0: entry (0, 1) is inf");
}

proptest! {
    #[test]
    fn any_grid_and_map_read_back(shape in prop::collection::vec(0..3_usize, 1..4), bits in prop::collection::vec(any::<u64>(), 12)) {
        let d = shape.len();
        let number = |i: usize| Some(f64::from_bits(bits[i % 12])).filter(|x| x.is_finite()).unwrap_or(-0.);
        let (points, cells) = cuboid_grid(&shape).into_parts();
        let coords = (0..points.coords().len()).map(number).collect();
        let model = Model::new(Points::from_columns(d, coords), cells);
        prop_assert_eq!(&Model::from_json(&model.to_json().unwrap()).unwrap(), &model);
        let map: Affine = t(&(0..d).map(number).collect::<Vec<_>>());
        let scene = Struct::new("s").with(map).with(model);
        prop_assert_eq!(Struct::from_json(&scene.to_json().unwrap()).unwrap(), scene);
    }

    #[test]
    fn mutated_texts_do_not_panic(at in any::<prop::sample::Index>(), byte in 32..127_u8, cut in any::<prop::sample::Index>()) {
        let mut bytes = chair().to_json().unwrap().into_bytes();
        let at = at.index(bytes.len());
        bytes[at] = byte;
        let text = String::from_utf8(bytes).unwrap();
        let _ = Struct::from_json(&text);
        let _ = Model::from_json(&text);
        prop_assert!(Struct::from_json(&text[..cut.index(text.len())]).is_err());
    }
}
