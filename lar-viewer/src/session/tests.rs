//! Sessions without a window: what commands do, and what is drawn of it.

use super::*;
use crate::{Bounds, Provenance, Scene};
use lar_core::{Cells, ChainComplex, Model, Points, cuboid_grid};
use proptest::prelude::*;

/// Three unit cubes in a row and the exterior; the first is inside A, the second inside A and B, the third inside none.
fn session() -> Session {
    let bar = ChainComplex::from_model(&cuboid_grid(&[3, 1, 1])).unwrap().with_exterior().unwrap();
    let triangles = (0..bar.n_cells(2)).flat_map(|f| {
        let face = bar.face_loops(f).swap_remove(0);
        [[face[0], face[1], face[2]], [face[0], face[2], face[3]]]
    });
    let (triangles, offsets) = (triangles.collect(), (0..=bar.n_cells(2) as u32).map(|f| 2 * f).collect());
    let provenance = Provenance {
        solids: vec!["A".into(), "B".into()],
        parents_of_face: vec![],
        solids_of_cell: vec![vec![], vec![0], vec![0, 1], vec![]],
    };
    let data = CellData::new(bar).unwrap().with_triangles(triangles, offsets).unwrap();
    Session::new(data.with_exterior().with_provenance(provenance))
}

fn cell(dim: u8, index: u32) -> CellRef {
    CellRef { dim, index }
}

fn scene(session: &Session) -> Scene {
    Stage::new(session.data(), session.pieces()).unwrap().scene(session).unwrap()
}

/// Names and cells of what is visible of a kind, by the name of the drawables.
fn visible(session: &Session) -> Vec<(String, Option<CellRef>)> {
    let scene = scene(session);
    let shown = scene.drawables().iter().filter(|d| d.appearance().visible);
    shown.map(|d| (d.name().to_owned(), d.cell_ref())).collect()
}

fn meshes(session: &Session) -> Vec<String> {
    let names = visible(session).into_iter().map(|(name, _)| name);
    names.filter(|name| name.starts_with('c')).collect()
}

#[test]
fn what_is_inside_no_solid_is_hidden_at_first() {
    let mut session = session();
    assert_eq!(meshes(&session), ["c1", "c2"]);
    session.apply(Command::ShowAll);
    assert_eq!(meshes(&session), ["c1", "c2", "c3"]);
    session.apply(Command::SetExterior(Exterior::Shell));
    assert_eq!(meshes(&session), ["c0", "c1", "c2", "c3"]);
    session.apply(Command::Undo);
    session.apply(Command::Undo);
    session.apply(Command::Undo);
    assert_eq!((meshes(&session), session.can_undo_redo()), (vec!["c1".into(), "c2".into()], [false, true]));
    session.apply(Command::Redo);
    assert_eq!(meshes(&session), ["c1", "c2", "c3"]);
}

#[test]
fn layers_switch_dimensions() {
    let mut session = session();
    session.apply(Command::ToggleLayer(3));
    assert_eq!(meshes(&session), [] as [&str; 0]);
    assert_eq!(visible(&session).len(), 2, "the edges of two cells");
    session.apply(Command::ToggleLayer(0));
    session.apply(Command::ToggleLayer(1));
    let dots = visible(&session);
    assert!(dots.len() == 2 && dots.iter().all(|(name, _)| name == "vertices"), "{dots:?}");
    session.apply(Command::ToggleLayer(2));
    assert_eq!(session.pieces(), Pieces::Faces);
    assert_eq!(meshes(&session).len(), 12, "six faces of each of two cells");
    session.apply(Command::ToggleLayer(9));
}

#[test]
fn isolated_cells_are_alone_and_hidden_ones_gone() {
    let mut session = session();
    session.apply(Command::Isolate(vec![cell(3, 3)]));
    assert_eq!(meshes(&session), ["c3"], "even what was hidden");
    session.apply(Command::Show(vec![cell(3, 1)]));
    assert_eq!(meshes(&session), ["c1", "c3"]);
    session.apply(Command::Hide(vec![cell(3, 3), cell(3, 99)]));
    assert_eq!(meshes(&session), ["c1"]);
    let face = session.data().boundary(cell(3, 1)).unwrap().entries()[0].0;
    session.apply(Command::Isolate(vec![cell(2, face)]));
    assert_eq!(session.pieces(), Pieces::Faces);
    let shown = meshes(&session);
    assert!(!shown.is_empty() && shown.len() <= 2, "one face, seen from its cells: {shown:?}");
    session.apply(Command::ShowAll);
    session.apply(Command::Hide(vec![cell(2, face)]));
    assert_eq!(
        meshes(&session).len(),
        18 - session.data().units_of(cell(2, face)).iter().filter(|u| u.index != 0).count()
    );
}

#[test]
fn a_vertex_alone_is_a_dot_whatever_layers_there_are() {
    let mut session = session();
    session.apply(Command::Isolate(vec![cell(0, 5)]));
    assert_eq!(session.pieces(), Pieces::Vertices);
    let shown: Vec<_> =
        scene(&session).drawables().iter().filter(|d| d.appearance().visible).cloned().collect();
    let at = session.data().position(5).unwrap();
    assert!(!shown.is_empty() && shown.iter().all(|d| d.name() == "vertices" && d.n_elements() == 1));
    assert!(shown.iter().all(|d| d.corners_of_element(0) == [at]), "{shown:?}");
    session.apply(Command::ToggleNumbers(0));
    let numbers: Vec<_> =
        scene(&session).drawables().iter().filter(|d| d.name() == "vertex numbers").cloned().collect();
    assert_eq!((numbers.len(), numbers[0].corners_of_element(0)), (1, vec![at]));
    session.apply(Command::Isolate(vec![cell(1, 3)]));
    let names: Vec<_> = visible(&session).into_iter().map(|(name, _)| name).collect();
    assert!(names.contains(&"edges".to_owned()) && !names.contains(&"vertices".to_owned()), "{names:?}");
    session.apply(Command::ToggleLayer(0));
    let ends = visible(&session).iter().filter(|(name, _)| name == "vertices").count();
    assert!(0 < ends, "with its ends, which are isolated with it");
    session.apply(Command::ShowAll);
    session.apply(Command::Hide(vec![cell(0, 5)]));
    let dots = visible(&session).iter().filter(|(name, _)| name == "vertices").count();
    // Each of the three cubes has each corner in three faces; vertex 5 is a corner of as many cubes as have it.
    let of_cells = session.data().cells_above(cell(0, 5), 3).iter().filter(|&&c| c != 0).count();
    assert_eq!(dots, 3 * 24 - 3 * of_cells);
}

/// A solid that is made transparent: its cells, not those that another contains first; it can be undone, and outlives a reload.
#[test]
fn solids_have_an_opacity_of_their_own() {
    let mut session = session();
    session.opacity = 0.8;
    session.forget_past();
    let opacities = |session: &Session| {
        let scene = scene(session);
        let cells = scene.drawables().iter().filter(|d| ["c1", "c2"].contains(&d.name()));
        cells.map(|d| d.appearance().opacity).collect::<Vec<_>>()
    };
    session.apply(Command::SetOpacity(1, 0.5));
    assert_eq!(opacities(&session), [0.8, 0.8], "both are in A first");
    session.settle();
    session.apply(Command::SetOpacity(0, 0.5));
    session.settle();
    assert_eq!(opacities(&session), [0.4, 0.4]);
    let again = session.with_data(session.data().clone());
    assert_eq!(again.visibility().opacity_of(0), 0.5);
    session.apply(Command::Undo);
    assert_eq!(opacities(&session), [0.8, 0.8]);
    session.apply(Command::SetOpacity(7, f32::NAN));
    assert_eq!(session.visibility().opacity_of(7), 1.0);
}

/// Everything that says what is visible, one step each; a slider that moves for a while is one step.
#[test]
fn all_of_what_is_visible_can_be_undone() {
    let mut session = session();
    session.opacity = 0.7;
    session.forget_past();
    session.apply(Command::ToggleNumbers(3));
    for position in [0.1, 0.2, 0.3] {
        session.section = Section { on: true, position, ..Section::default() };
    }
    session.settle();
    session.settle();
    session.opacity = 0.4;
    session.apply(Command::ToggleLayer(0));
    session.outline = Some(Outlined::Cells);
    let step = |session: &mut Session| {
        session.apply(Command::Undo);
        let shown = (session.outline, session.visibility().layers[0], session.opacity, session.section.on);
        (shown, session.numbers()[3])
    };
    assert_eq!(step(&mut session), ((None, true, 0.4, true), true));
    assert_eq!(step(&mut session), ((None, false, 0.4, true), true));
    assert_eq!(step(&mut session), ((None, false, 0.7, true), true));
    assert_eq!(step(&mut session), ((None, false, 0.7, false), true));
    assert_eq!(step(&mut session), ((None, false, 0.7, false), false));
    assert_eq!(session.can_undo_redo(), [false, true]);
    (0..5).for_each(|_| session.apply(Command::Redo));
    assert_eq!((session.outline, session.section.position), (Some(Outlined::Cells), 0.3));
}

#[test]
fn the_exterior_can_be_isolated_and_has_its_number_beside_it() {
    let mut session = session();
    session.apply(Command::Isolate(vec![cell(3, 0)]));
    assert_eq!(session.visibility().exterior, Exterior::Shell);
    assert_eq!(meshes(&session), ["c0"]);
    (0..4).for_each(|dim| session.apply(Command::ToggleNumbers(dim)));
    let drawn = scene(&session);
    let numbered = |name: &str| -> Vec<[f64; 3]> {
        let labels = drawn.drawables().iter().filter(|d| d.name() == name);
        labels.flat_map(|d| (0..d.n_elements()).flat_map(|i| d.corners_of_element(i))).collect()
    };
    let counts = ["vertex numbers", "edge numbers", "face numbers"].map(|name| numbered(name).len());
    assert_eq!(counts, [16, 28, 14], "what bounds the exterior; two faces lie between cells");
    let at = numbered("cell numbers");
    assert!(at.len() == 1 && 3.0 < at[0][0] && 1.0 < at[0][1] && 1.0 < at[0][2], "{at:?}");
    session.apply(Command::Hide(vec![cell(3, 0)]));
    assert_eq!(session.visibility().exterior, Exterior::Hidden);
}

#[test]
fn walking_leaves_a_trail() {
    let mut session = session();
    let trail = [cell(3, 1), cell(2, 0), cell(1, 3)];
    trail.iter().for_each(|&c| session.apply(Command::Select(Some(c))));
    session.apply(Command::Select(Some(cell(1, 3))));
    session.apply(Command::Back);
    assert_eq!(session.selected(), Some(trail[1]));
    session.apply(Command::Back);
    session.apply(Command::Back);
    assert_eq!((session.selected(), session.can_go_back()), (Some(trail[0]), false));
    session.apply(Command::Select(Some(cell(3, 77))));
    assert_eq!(session.selected(), None, "no such cell");
}

#[test]
fn chains_of_a_cell_stand_out() {
    let mut session = session();
    session.apply(Command::Highlight(cell(3, 1), Relation::Boundary));
    let highlight = session.highlight().unwrap().clone();
    assert_eq!((highlight.label.as_str(), highlight.chain.entries().len()), ("∂ c1", 6));
    let drawn = scene(&session);
    let colors = drawn.drawables()[..6].iter().map(|d| d.appearance().color);
    let orange = colors.filter(|color| color[2] < color[0]).count();
    assert_eq!(
        orange,
        highlight.chain.entries().iter().filter(|e| 0 < e.1).count(),
        "positive cells are orange"
    );
    let ghost = drawn.drawables().iter().find(|d| d.name() == "c2").unwrap().appearance();
    assert!(ghost.opacity < 0.5);
    session.apply(Command::Highlight(cell(1, 0), Relation::Coboundary));
    assert_eq!(session.highlight().unwrap().label, "δ e0");
    session.apply(Command::ClearHighlight);
    assert_eq!(session.highlight(), None);
    session.apply(Command::Select(Some(cell(3, 2))));
    let selected = |d: &&crate::Drawable| d.appearance().highlighted;
    assert_eq!(scene(&session).drawables().iter().filter(selected).count(), 1);
}

#[test]
fn a_replay_shows_chain_boundary_and_corolla() {
    let mut session = session();
    let data = session.data().complex().clone();
    let whole = session.data().boundary(cell(3, 1)).unwrap();
    let first = data.chain(2, [whole.entries()[0]]).unwrap();
    let rest = data.chain(2, whole.entries()[1..].iter().copied()).unwrap();
    let step = |chain: &Chain, corolla: Chain| WrapStep {
        boundary: data.boundary_of(chain).unwrap(),
        chain: chain.clone(),
        corolla,
    };
    let steps = vec![step(&first, rest), step(&whole, data.chain(2, []).unwrap())];
    session.apply(Command::StartReplay(cell(3, 1), steps));
    let base = scene(&session).drawables().len() - 5;
    session.apply(Command::GoTo(1));
    assert_eq!(scene(&session).drawables().len(), base + 10);
    session.apply(Command::GoTo(2));
    assert_eq!(scene(&session).drawables().len(), base + 6, "six faces, no boundary");
    session.apply(Command::ClearHighlight);
    assert_eq!(session.replay(), None);
}

#[test]
fn reloads_keep_the_settings_and_drop_what_is_gone() {
    let mut session = session();
    session.apply(Command::ToggleNumbers(2));
    session.apply(Command::ToggleLayer(0));
    session.apply(Command::Select(Some(cell(3, 3))));
    session.explode = Explode::cells([2.0; 3]);
    let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
    let next = session.with_data(CellData::new(cube).unwrap());
    assert_eq!((next.selected(), next.numbers(), next.explode), (None, session.numbers(), session.explode));
    assert_eq!(next.visibility().layers, session.visibility().layers);
    let kinds: Vec<String> = visible(&next).into_iter().map(|(name, _)| name).collect();
    assert_eq!(kinds, ["face numbers", "edges", "vertices"], "of a cube without triangles");
}

#[test]
fn everything_can_be_drawn_at_every_fineness() {
    for by in ExplodeBy::ALL {
        let mut session = session();
        session.apply(Command::ShowAll);
        session.explode = Explode { by, factors: [2.0; 3], levels: [1.5; 4], center: Center::Model };
        let scene = scene(&session);
        let bounds = scene.bounds(session.explode.explosion()).unwrap();
        let still = Bounds { min: [0.0; 3], max: [3.0, 1.0, 1.0] };
        assert!(still.max[0] - still.min[0] < bounds.max[0] - bounds.min[0], "{by:?} moves: {bounds:?}");
    }
}

/// A stroke of a drawing in many short segments, and the edges of cells for themselves: each is drawn as wide as the curve it
/// is part of allows; what stands out is never thinner than it should be.
#[test]
fn edges_are_as_wide_as_their_curves_allow() {
    let points: Vec<[f64; 3]> = (0..=20).map(|i| [0.05 * f64::from(i), 0.0, 0.0]).collect();
    let cells = vec![Cells::singletons(21), (0..20).map(|i| [i, i + 1]).collect()];
    let stroke = ChainComplex::from_model(&Model::new(Points::from_xyz(&points), cells)).unwrap();
    let curves = |session: &Session, pieces: Pieces| {
        let stage = Stage::new(session.data(), pieces).unwrap();
        stage.pieces().drawables().iter().filter_map(crate::Drawable::curve).collect::<Vec<_>>()
    };
    let mut stroke = Session::new(CellData::new(stroke).unwrap());
    let found = curves(&stroke, Pieces::Cells);
    assert!(found.len() == 20 && found.iter().all(|x| (x - 1.0).abs() < 1e-12), "{found:?}");
    assert_eq!(curves(&stroke, Pieces::Edges), found);
    let cubes = curves(&session(), Pieces::Edges);
    // Each edge of each face: around a face goes one curve.
    let n = 3 * 24 + 14 * 4;
    assert!(cubes.len() == n && cubes.iter().all(|x| [4.0, 8.0].contains(x)), "{cubes:?}");
    let mut cubes = session();
    cubes.apply(Command::Select(Some(cell(1, 3))));
    let selected = scene(&cubes).drawables()[0].clone();
    assert_eq!((selected.n_elements(), selected.curve()), (1, None));
    stroke.apply(Command::Select(Some(cell(1, 3))));
    let drawn = scene(&stroke);
    let highlighted = drawn.drawables().iter().filter(|d| d.appearance().highlighted);
    assert_eq!(
        highlighted.map(crate::Drawable::cell_ref).collect::<Vec<_>>(),
        [Some(cell(1, 3))],
        "a lone edge"
    );
}

#[test]
fn measured_points_are_drawn() {
    let mut session = session();
    session.apply(Command::Measure([0.0; 3]));
    session.apply(Command::Measure([3.0, 0.0, 0.0]));
    assert_eq!(session.measuring().distances(), [3.0]);
    assert_eq!(visible(&session).iter().filter(|(name, _)| name == "measured").count(), 2);
    session.apply(Command::ClearMeasuring);
    assert!(visible(&session).iter().all(|(name, _)| name != "measured"));
}

#[test]
fn empty_complexes_are_shown_as_nothing() {
    let empty = ChainComplex::new(Points::new(3), vec![]);
    let session = Session::new(CellData::new(empty).unwrap());
    assert_eq!(scene(&session).drawables().len(), 0);
}

fn command() -> impl Strategy<Value = Command> {
    let any_cell = (0..5_u8, 0..30_u32).prop_map(|(dim, index)| CellRef { dim, index });
    let cells = prop::collection::vec(any_cell.clone(), 0..4);
    prop_oneof![
        (0..6_u8).prop_map(Command::ToggleLayer),
        (0..3_usize).prop_map(|i| Command::SetExterior(Exterior::ALL[i])),
        cells.clone().prop_map(Command::Hide),
        cells.clone().prop_map(Command::Show),
        cells.prop_map(Command::Isolate),
        Just(Command::ShowAll),
        any_cell.clone().prop_map(|c| Command::Select(Some(c))),
        Just(Command::Back),
        any_cell.clone().prop_map(|c| Command::Highlight(c, Relation::Boundary)),
        any_cell.prop_map(|c| Command::Highlight(c, Relation::Coboundary)),
        Just(Command::Undo),
        Just(Command::Redo),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn undo_leads_back_to_the_beginning(commands in prop::collection::vec(command(), 0..25)) {
        let mut session = session();
        let first = session.visibility().clone();
        commands.into_iter().for_each(|c| session.apply(c));
        let last = session.visibility().clone();
        scene(&session);
        let mut steps = 0;
        while session.can_undo_redo()[0] {
            session.apply(Command::Undo);
            steps += 1;
        }
        prop_assert_eq!(session.visibility(), &first);
        (0..steps).for_each(|_| session.apply(Command::Redo));
        prop_assert_eq!(session.visibility(), &last);
    }
}
