//! Views as text and back.

use super::*;
use crate::session::{ColorBy, Command, Explode, Normal, Section, WrapStep};
use crate::{CellRef, Orientation};
use lar_core::{Chain, cuboid_grid};

fn data() -> CellData {
    let grid = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap().with_exterior().unwrap();
    let provenance = Provenance {
        solids: vec!["A".into(), "lid \"B\"".into()],
        parents_of_face: vec![vec![FaceParent { solid: 1, face: 7, sign: -1 }], vec![]],
        solids_of_cell: vec![vec![], vec![0], vec![0, 1]],
    };
    let data = CellData::new(grid).unwrap().with_exterior().with_provenance(provenance);
    data.with_triangles(vec![[0, 1, 2], [1, 2, 3]], vec![0, 1, 2]).unwrap()
}

fn view() -> SharedView {
    let mut session = Session::new(data());
    session.apply(Command::Hide(vec![CellRef::new(3, 1), CellRef::new(2, 4)]));
    session.apply(Command::Isolate(vec![CellRef::new(3, 2)]));
    session.apply(Command::ToggleNumbers(1));
    session.explode = Explode { levels: [1.0, 0.1, 2.0, 1.0], ..Explode::cells([1.5, 1.0, 2.0]) };
    let normal = Normal::Free { azimuth: 0.1, elevation: -0.2 };
    session.section = Section { on: true, normal, position: 0.3, flipped: true, whole_cells: true };
    (session.coloring, session.opacity, session.background) = (ColorBy::Class, 0.7, [0.1, 0.2, 0.3]);
    let camera = Camera { orientation: Orientation::turntable(0.3, 0.2), distance: 7.0, ..Camera::default() };
    let wrappings = vec![vec![], vec![vec![vec![(0, 1)], vec![(1, -1), (2, 1)]], vec![vec![(3, 1)]]], vec![]];
    let answers = Answers { refusals: vec![None, Some("B is open".into())], wrappings };
    SharedView { title: "two & two".into(), session, camera, is_fitted: true, answers }
}

#[test]
fn views_are_read_back() {
    let view = view();
    let read = SharedView::from_json(&view.to_json().unwrap()).unwrap();
    assert_eq!(read.session.settings(), view.session.settings());
    let [a, b] = [&read, &view].map(|v| v.session.data());
    assert_eq!((a.complex(), a.provenance()), (b.complex(), b.provenance()));
    assert_eq!((a.all_triangles(), a.has_exterior()), (b.all_triangles(), true));
    assert_eq!((&read.title, &read.answers, read.is_fitted), (&view.title, &view.answers, true));
    for p in [[0.0; 3], [1.0, 2.0, -0.5]] {
        let [a, b] = [read.camera, view.camera].map(|c| c.project(p, 700.0).unwrap());
        assert!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-9, "{a:?} {b:?}");
    }
}

#[track_caller]
fn check(from: &str, to: &str, message: &str) {
    let text = view().to_json().unwrap();
    assert!(text.contains(from), "{from} in {text}");
    let found = SharedView::from_json(&text.replacen(from, to, 1)).unwrap_err().to_string();
    assert!(found.contains(message), "{found}");
}

#[test]
fn texts_that_are_no_views_are_refused() {
    check("lar-view", "lar-song", "format is \"lar-song\" of version 1, not \"lar-view\" of version 1");
    check("\"version\":1", "\"version\":2", "format is \"lar-view\" of version 2");
    check("\"title\"", "\"name\"", "unknown field `name`");
    check("lar-chain-complex", "obj", "format is \"obj\", not \"lar-chain-complex\"");
    check("[1,2,3]", "[1,2,12]", "triangle 1 names point 12, but there are 12 points");
    check("\"fov\":0.45", "\"fov\":4.5", "the field of view is 4.5");
    check("\"coloring\":\"class\"", "\"coloring\":\"mood\"", "unknown variant `mood`");
    check("\"fitted\":true}}", "", "EOF");
}

#[test]
fn cells_where_an_expression_holds() {
    let (data, answers) = (data(), view().answers);
    type Holds = dyn Fn(&dyn Fn(usize) -> bool) -> bool;
    let cells = |operands: &[usize], holds: &Holds| {
        let chain = answers.cells_where(&data, operands, holds)?;
        Ok::<_, String>(chain.entries().iter().map(|entry| entry.0).collect::<Vec<_>>())
    };
    assert_eq!(cells(&[0], &|inside| inside(0)), Ok(vec![1, 2]));
    assert_eq!(cells(&[0], &|inside| !inside(0)), Ok(vec![0]));
    assert_eq!(cells(&[0, 1], &|inside| inside(1)), Err("B is open".to_owned()));
}

/// Both sides of face 1 belong to the cell: in the chain it is gone.
#[test]
fn wrapping_with_a_flap_and_two_shells_is_what_was_recorded() {
    let data = data();
    let step = |chain: &[(u32, i32)], corolla: &[(u32, i32)]| {
        let of = |terms: &[(u32, i32)]| Chain::new(2, data.n_cells(2), terms.iter().copied()).unwrap();
        let boundary = data.boundary_of(&of(chain)).unwrap();
        WrapStep { chain: of(chain), boundary, corolla: of(corolla) }
    };
    let steps = vec![
        step(&[(0, 1)], &[(1, 1), (2, -1)]),
        step(&[(0, 1), (1, 1), (2, -1)], &[(1, -1), (3, 1)]),
        step(&[(0, 1), (2, -1), (3, 1)], &[]),
        step(&[(0, 1), (2, -1), (3, 1), (4, 1)], &[]),
    ];
    let wrapping = Answers::recorded(&steps);
    assert_eq!(wrapping.iter().map(Vec::len).collect::<Vec<_>>(), [3, 1]);
    let answers = Answers { wrappings: vec![vec![], wrapping], ..Answers::default() };
    assert_eq!(answers.wrapping(&data, 1), Ok(steps));
    let missing = |cell| answers.wrapping(&data, cell).unwrap_err();
    assert_eq!(missing(0), "the gift wrapping of c0 is not written down here");
    assert_eq!(missing(7), "the gift wrapping of c7 is not written down here");
    assert_eq!(Answers::default().wrapping(&data, 0).unwrap_err(), crate::session::NOT_WRAPPED);
}
