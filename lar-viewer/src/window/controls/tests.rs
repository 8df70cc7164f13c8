//! The interface without a window: egui's panels driven by role, label, mouse and keys.

use super::*;
use crate::session::{Queries, Session, WrapStep};
use crate::{Camera, CellData, CellRef, Drawable, Hit, Projection, Provenance, Scene, View};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2, vec2};
use egui_kittest::{Harness, kittest::Queryable};
use lar_core::{Chain, ChainComplex, cuboid_grid};

/// What is driven: the interface, and what it asked for last.
struct State {
    controls: Controls,
    asked: Option<Asked>,
}

type Window = Harness<'static, State>;

/// The cells of both cubes, or the first alone; wrapping in one step.
struct Answers {
    complex: ChainComplex,
}

impl Queries for Answers {
    fn boolean(&self, expression: &str) -> Result<Chain, String> {
        match expression.trim() {
            "A" => Ok(self.complex.chain(3, [(1, 1)]).unwrap()),
            "!A" => Ok(self.complex.chain(3, [(0, 1), (2, 1)]).unwrap()),
            other => Err(format!("{other}: not understood")),
        }
    }

    fn wrapping(&self, cell: u32) -> Result<Vec<WrapStep>, String> {
        let whole = self.complex.boundary_of(&self.complex.chain(3, [(cell, 1)]).unwrap()).unwrap();
        let first = self.complex.chain(2, whole.entries().iter().take(1).copied()).unwrap();
        let none = self.complex.chain(2, []).unwrap();
        let step = |chain: &Chain, corolla: &Chain| WrapStep {
            chain: chain.clone(),
            boundary: self.complex.boundary_of(chain).unwrap(),
            corolla: corolla.clone(),
        };
        Ok(vec![step(&first, &(&whole - &first)), step(&whole, &none)])
    }
}

fn bar() -> (ChainComplex, CellData) {
    let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap().with_exterior().unwrap();
    let triangles = (0..bar.n_cells(2)).flat_map(|f| {
        let face = bar.face_loops(f).swap_remove(0);
        [[face[0], face[1], face[2]], [face[0], face[2], face[3]]]
    });
    let (triangles, offsets) = (triangles.collect(), (0..=bar.n_cells(2) as u32).map(|f| 2 * f).collect());
    let provenance = Provenance {
        solids: vec!["A".into(), "B".into()],
        parents_of_face: vec![],
        solids_of_cell: vec![vec![], vec![0], vec![1]],
    };
    let data = CellData::new(bar.clone()).unwrap().with_triangles(triangles, offsets).unwrap();
    (bar, data.with_exterior().with_provenance(provenance))
}

fn window(subject: Subject) -> Window {
    let state = State { controls: Controls::new(View::default(), subject, "test".into(), true), asked: None };
    let show = |ui: &mut Ui, state: &mut State| {
        state.asked = Some(state.controls.show(ui, egui::TextureId::User(0)));
    };
    let mut window = Harness::builder().with_size(vec2(1280.0, 900.0)).build_ui_state(show, state);
    window.run_ok();
    window
}

fn complex_window() -> Window {
    let (complex, data) = bar();
    window(Subject::complex(Session::new(data), Box::new(Answers { complex })).unwrap())
}

fn scene_window() -> Window {
    let mut scene = Scene::new();
    scene.push(Drawable::lines("diagonal", [[[0.0; 3], [1.0, 2.0, 3.0]]])).unwrap();
    window(Subject::scene(scene))
}

fn session(window: &Window) -> &Session {
    &window.state().controls.subject.explored.as_ref().unwrap().session
}

fn camera(window: &Window) -> Camera {
    window.state().controls.view.camera
}

fn middle(window: &Window) -> Pos2 {
    window.state().asked.as_ref().unwrap().area.center()
}

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_ok();
}

fn key(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_ok();
}

fn text_field(window: &Window, label: &str) -> Pos2 {
    window.get_by_role_and_label(egui::accesskit::Role::TextInput, label).rect().center()
}

fn drag(window: &mut Window, button: PointerButton, from: Pos2, by: egui::Vec2) {
    let press = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE };
    let moves = [
        Event::PointerMoved(from),
        press(from, true),
        Event::PointerMoved(from + by),
        press(from + by, false),
    ];
    for event in moves {
        window.event(event);
        window.step();
    }
}

fn pick(window: &mut Window, cell: CellRef, owner: CellRef, point: [f64; 3]) {
    let scene = &window.state().controls.subject.scenes[1];
    let drawable = scene.drawables().iter().position(|d| d.cell_ref() == Some(owner)).unwrap();
    let (cell, owner, moved) = (Some(cell), Some(owner), [0.0; 3]);
    let hit = Hit { drawable, element: 0, cell, owner, point, moved, pixel: [0, 0] };
    let click = Click { at: [0.0; 2], double: false };
    window.state_mut().controls.clicked(click, Some(hit));
    window.run_ok();
}

#[test]
fn drags_turn_and_move_by_the_pixels_dragged() {
    let mut window = scene_window();
    let (before, at) = (camera(&window), middle(&window));
    drag(&mut window, PointerButton::Primary, at, vec2(40.0, -20.0));
    let turned = camera(&window);
    assert_eq!(turned, Camera { orientation: before.orientation.orbit([40.0, -20.0]), ..before });
    let height = f64::from(window.state().asked.as_ref().unwrap().area.height());
    drag(&mut window, PointerButton::Secondary, at, vec2(40.0, -20.0));
    assert_eq!(camera(&window), turned.pan([40.0, -20.0], height));
    let panel = pos2(1200.0, 800.0);
    drag(&mut window, PointerButton::Primary, panel, vec2(-50.0, 50.0));
    assert_eq!(camera(&window), turned.pan([40.0, -20.0], height), "in the panel nothing turns");
}

#[test]
fn the_wheel_zooms_to_the_cursor() {
    let mut window = scene_window();
    let before = camera(&window);
    let at = middle(&window) - vec2(150.0, 100.0);
    window.hover_at(at);
    window.step();
    window.event(Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: vec2(0.0, 2.0),
        phase: egui::TouchPhase::Move,
        modifiers: Modifiers::NONE,
        source: egui::MouseWheelSource::Wheel,
    });
    window.run_steps(40);
    assert!(camera(&window).distance < 0.9 * before.distance);
    assert_ne!(camera(&window).target, before.target);
}

#[test]
fn keys_look_along_the_axes_fit_and_close() {
    let mut window = scene_window();
    for (i, digit) in
        [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7].into_iter().enumerate()
    {
        key(&mut window, Modifiers::NONE, digit);
        assert_eq!(camera(&window).orientation, StandardView::ALL[i].orientation());
    }
    let fitted = camera(&window);
    let at = middle(&window);
    drag(&mut window, PointerButton::Middle, at, vec2(300.0, 200.0));
    key(&mut window, Modifiers::NONE, Key::F);
    assert!((camera(&window).target[0] - fitted.target[0]).abs() < 1.0, "back in the middle");
    key(&mut window, Modifiers::NONE, Key::P);
    assert_eq!(camera(&window).projection, Projection::Orthographic);
    key(&mut window, Modifiers::NONE, Key::F1);
    assert!(window.query_by_label("Mouse and keys").is_some());
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Mouse and keys").is_none());
    assert!(!window.state().asked.as_ref().unwrap().close);
    window.key_down(Key::Escape);
    window.step();
    assert!(window.state().asked.as_ref().unwrap().close);
}

#[test]
fn keys_of_one_frame_count_each_and_in_their_order() {
    let mut window = complex_window();
    window.key_press(Key::V);
    window.key_press(Key::V);
    window.key_press(Key::Num1);
    window.key_press(Key::Num4);
    window.key_press(Key::G);
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    window.step();
    assert_eq!(session(&window).visibility().layers, [false, true, true, true]);
    assert_eq!(camera(&window).orientation, StandardView::Left.orientation());
}

#[test]
fn cells_are_selected_walked_and_highlighted() {
    let mut window = complex_window();
    click(&mut window, "c1");
    assert_eq!(session(&window).selected(), Some(CellRef::new(3, 1)));
    assert!(window.query_by_label("volume 1").is_some() && window.query_by_label("inside A").is_some());
    window.get_all_by_label("Highlight").next().unwrap().click();
    window.run_ok();
    assert_eq!(session(&window).highlight().unwrap().label, "∂ c1");
    let face = session(&window).data().boundary(CellRef::new(3, 1)).unwrap().entries()[0];
    let name = format!("{}f{}", if face.1 < 0 { "−" } else { "+" }, face.0);
    click(&mut window, &name);
    assert_eq!(session(&window).selected(), Some(CellRef::new(2, face.0)));
    assert!(window.query_by_label("area 1").is_some());
    key(&mut window, Modifiers::NONE, Key::K);
    assert_eq!(session(&window).highlight().unwrap().chain.dim(), 3);
    click(&mut window, "Back");
    assert_eq!(session(&window).selected(), Some(CellRef::new(3, 1)));
}

#[test]
fn picking_means_the_cell_or_what_is_asked_for() {
    let mut window = complex_window();
    let (face, cell) = (CellRef::new(2, 0), CellRef::new(3, 1));
    pick(&mut window, face, cell, [0.0; 3]);
    assert_eq!(session(&window).selected(), Some(cell));
    window.state_mut().controls.pick_as = PickAs::Dimension(2);
    pick(&mut window, face, cell, [0.0; 3]);
    assert_eq!(session(&window).selected(), Some(face));
    window.state_mut().controls.pick_as = PickAs::Dimension(1);
    pick(&mut window, face, cell, [0.0; 3]);
    assert_eq!(session(&window).selected(), None);
    window.state_mut().controls.pick_as = PickAs::Seen;
    pick(&mut window, CellRef::new(1, 4), cell, [0.0; 3]);
    assert_eq!(session(&window).selected(), Some(CellRef::new(1, 4)));
}

#[test]
fn points_are_measured_at_vertices() {
    let mut window = complex_window();
    click(&mut window, "Measure");
    let cell = CellRef::new(3, 1);
    let far = session(&window).data().position(11).unwrap();
    pick(&mut window, CellRef::new(0, 11), cell, [0.1, 0.2, 0.3]);
    pick(&mut window, CellRef::new(2, 0), cell, [far[0], far[1], far[2] - 0.25]);
    assert_eq!(session(&window).measuring().points()[0], far, "the vertex, not the point beside it");
    assert!(window.query_by_label("distance 0.25").is_some());
    click(&mut window, "Forget points");
    assert!(session(&window).measuring().points().is_empty());
}

#[test]
fn visibility_is_hidden_isolated_and_undone() {
    let mut window = complex_window();
    let [first, second] = [1, 2].map(|i| CellRef::new(3, i));
    click(&mut window, "c1");
    key(&mut window, Modifiers::NONE, Key::H);
    assert!(!session(&window).visibility().shows(first));
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(session(&window).visibility().shows(first));
    key(&mut window, Modifiers::NONE, Key::I);
    assert!(session(&window).visibility().shows(first) && !session(&window).visibility().shows(second));
    key(&mut window, Modifiers::NONE, Key::A);
    assert!(session(&window).visibility().shows_all());
    click(&mut window, "vertices");
    assert!(session(&window).visibility().layers[0]);
    click(&mut window, "Undo");
    assert!(!session(&window).visibility().layers[0]);
    key(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert!(session(&window).visibility().layers[0]);
}

#[test]
fn one_solid_is_made_transparent() {
    let mut window = complex_window();
    click(&mut window, "Opacity of solids");
    let slider = window.get_by_role_and_label(egui::accesskit::Role::Slider, "opacity of B").rect();
    drag(&mut window, PointerButton::Primary, slider.right_center() - vec2(6.0, 0.0), vec2(-40.0, 0.0));
    window.run_ok();
    let opacity = |window: &Window| [0, 1].map(|solid| session(window).visibility().opacity_of(solid));
    let [a, b] = opacity(&window);
    assert!(a == 1.0 && (0.3..0.8).contains(&b), "{a} {b}");
    click(&mut window, "Undo");
    assert_eq!(opacity(&window), [1.0; 2]);
}

/// A slider that is dragged makes one step of it, and so does a choice in a list.
#[test]
fn clip_plane_opacity_and_outline_are_undone_too() {
    let mut window = complex_window();
    click(&mut window, "Clip plane");
    click(&mut window, "cut");
    // The sliders of the explosion are named like the axes, and come first.
    window.get_all_by_label("z").last().unwrap().click();
    window.run_ok();
    let position = window.get_by_role_and_label(egui::accesskit::Role::Slider, "position").rect().center();
    drag(&mut window, PointerButton::Primary, position, vec2(30.0, 0.0));
    window.run_ok();
    let moved = session(&window).section.position;
    assert!(moved != 0.5 && window.state().controls.view.clip.is_some(), "{moved}");
    window.state_mut().controls.subject.explored.as_mut().unwrap().session.outline =
        Some(crate::Outlined::Cells);
    window.run_ok();
    assert_eq!(window.state().controls.view.outline.map(|o| o.of), Some(crate::Outlined::Cells));
    let state = |window: &Window| {
        let session = session(window);
        (
            session.outline.is_some(),
            session.section.position == moved,
            session.section.normal,
            session.section.on,
        )
    };
    let [x, z] = [0, 2].map(crate::session::Normal::Axis);
    assert_eq!(state(&window), (true, true, z, true));
    for expected in
        [(false, true, z, true), (false, false, z, true), (false, false, x, true), (false, false, x, false)]
    {
        click(&mut window, "Undo");
        assert_eq!(state(&window), expected);
    }
    assert!(window.state().controls.view.clip.is_none());
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &std::path::Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

#[test]
fn files_that_are_dropped_are_asked_for() {
    let mut window = complex_window();
    let file = PathBuf::from("/tmp/a.obj");
    window.input_mut().dropped_files.push(std::sync::Arc::new(Dropped(file.clone())));
    window.step();
    assert_eq!(window.state().asked.as_ref().unwrap().load, [file]);
    window.step();
    assert!(window.state().asked.as_ref().unwrap().load.is_empty(), "once");
}

#[test]
fn expressions_make_their_cells_stand_out_at_once() {
    let mut window = complex_window();
    let at = text_field(&window, "Boolean expression: ! & - ^ |");
    drag(&mut window, PointerButton::Primary, at, vec2(0.0, 0.0));
    window.event(Event::Text("!A".into()));
    window.run_ok();
    assert_eq!(session(&window).highlight().unwrap().chain.entries(), [(0, 1), (2, 1)]);
    assert!(window.query_by_label("2 cells, volume unbounded").is_some());
    assert!(session(&window).visibility().layers[3], "keys belong to the field");
    window.event(Event::Text("?".into()));
    window.run_ok();
    assert!(window.query_by_label("!A?: not understood").is_some());
}

#[test]
fn a_cell_is_wrapped_step_by_step() {
    let mut window = complex_window();
    click(&mut window, "c2");
    click(&mut window, "Replay gift wrapping");
    assert!(window.query_by_label("(a) value 0 of c: 1 faces, ∂c has 4 edges").is_some());
    click(&mut window, "Next");
    assert!(session(&window).replay().unwrap().shows_corolla());
    key(&mut window, Modifiers::NONE, Key::Period);
    assert!(window.query_by_label("(c) value 1 of c: 6 faces, ∂c = 0, closed").is_some());
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(session(&window).replay(), None);
}

#[test]
fn cells_are_found_by_number() {
    let mut window = complex_window();
    let search = |window: &mut Window, text: &str| {
        let at = text_field(window, "find a cell");
        drag(window, PointerButton::Primary, at, vec2(0.0, 0.0));
        window.state_mut().controls.texts.search.clear();
        window.event(Event::Text(text.into()));
        window.step();
        key(window, Modifiers::NONE, Key::Enter);
    };
    search(&mut window, "e3");
    assert_eq!(session(&window).selected(), Some(CellRef::new(1, 3)));
    search(&mut window, "c9");
    assert!(window.query_by_label("there is no c9; there are 3 of that dimension").is_some());
}

#[test]
fn loaded_files_replace_the_complex_and_errors_are_said() {
    let mut window = complex_window();
    let files = [PathBuf::from("a.obj")];
    window.state_mut().controls.loaded(&files, Err("a.obj: line 3 is no vertex".into()));
    window.run_ok();
    assert!(window.query_by_label("a.obj: line 3 is no vertex").is_some());
    assert_eq!(session(&window).data().n_cells(3), 3, "what was there stays");
    let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
    let exhibit = Exhibit { data: CellData::new(cube).unwrap(), queries: Box::new(crate::NoQueries) };
    window.state_mut().controls.loaded(&files, Ok(exhibit));
    window.run_ok();
    assert!(window.query_by_label("loaded a.obj").is_some());
    assert_eq!(session(&window).data().n_cells(3), 1);
}

#[test]
fn the_camera_is_copied_as_arguments() {
    let mut window = scene_window();
    window.get_by_label("Copy camera").click();
    window.step();
    window.step();
    let copied = window.state().controls.message.clone();
    assert_eq!(copied, format!("copied: {}", camera(&window).arguments()));
}

#[test]
fn drawings_are_seen_from_above() {
    let square = ChainComplex::from_model(&cuboid_grid(&[2, 1])).unwrap();
    let session = Session::new(CellData::new(square).unwrap());
    let window = window(Subject::complex(session, Box::new(crate::NoQueries)).unwrap());
    assert_eq!(camera(&window).orientation, StandardView::Top.orientation());
    assert_eq!(camera(&window).projection, Projection::Orthographic);
    let area = window.state().asked.as_ref().unwrap().area;
    let height = f64::from(area.height());
    let corners = [[0.0; 3], [2.0, 1.0, 0.0]].map(|p| camera(&window).project(p, height).unwrap());
    let part = (corners[1][0] - corners[0][0]) / f64::from(area.width());
    assert!((0.9..1.0).contains(&part), "the drawing fills {part} of the width");
}

#[test]
fn empty_complexes_can_be_shown() {
    let empty = ChainComplex::new(lar_core::Points::new(3), vec![]);
    let session = Session::new(CellData::new(empty).unwrap());
    let mut window = window(Subject::complex(session, Box::new(crate::NoQueries)).unwrap());
    key(&mut window, Modifiers::NONE, Key::F);
    camera(&window).validate().unwrap();
}
