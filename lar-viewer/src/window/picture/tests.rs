//! A slider that is dragged in a window onto a hundred thousand cells, and what then goes to the graphics card.

use super::*;
use crate::gpu::context::Context;
use crate::session::{Command, Session};
use crate::window::controls::{Asked, Controls};
use crate::{Camera, CellData, Upload};
use egui::{Event, Modifiers, PointerButton, vec2};
use egui_kittest::{Harness, kittest::Queryable};
use lar_core::{ChainComplex, cuboid_grid};

/// Cubes along a side: 97,336 in all.
const SIDE: usize = 46;
/// So large that a cell is some pixels wide.
const SIZE: [u32; 2] = [480, 360];

struct State {
    controls: Controls,
    asked: Option<Asked>,
}

/// On the adapter of this machine; `None` with a message where it has none, unless one is required as in CI.
#[expect(clippy::print_stderr, reason = "a test that cannot run says so")]
fn renderer() -> Option<Renderer> {
    match Context::off_screen() {
        Ok(context) => Some(Renderer::new(context).unwrap()),
        Err(ViewerError::NoAdapter { found }) if std::env::var_os("LAR_REQUIRE_GPU").is_none() => {
            eprintln!("NOT TESTED: no graphics adapter ({found}); LAR_REQUIRE_GPU=1 makes this an error");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

fn cubes() -> Subject {
    let complex = ChainComplex::from_model(&cuboid_grid(&[SIDE; 3])).unwrap();
    let faces = 0..complex.n_cells(2);
    let triangles = faces.flat_map(|f| {
        let face = complex.face_loops(f).swap_remove(0);
        [[face[0], face[1], face[2]], [face[0], face[2], face[3]]]
    });
    let (triangles, offsets) = (triangles.collect(), (0..=complex.n_cells(2) as u32).map(|f| 2 * f));
    let data = CellData::new(complex).unwrap().with_triangles(triangles, offsets.collect()).unwrap();
    let mut session = Session::new(data);
    // Faces alone are drawn sooner; the edges are uploaded all the same.
    session.apply(Command::ToggleLayer(1));
    Subject::complex(session, Box::new(crate::NoQueries)).unwrap()
}

/// A window that shows a subject, so far away that it stays in the picture when it is exploded, after its first frame.
fn window(subject: Subject) -> Harness<'static, State> {
    let bounds = subject.scenes[1].bounds([2.0; 3]).unwrap();
    let view = View { camera: Camera::default().fit(&bounds, 4.0 / 3.0), ..View::default() };
    let state = State { controls: Controls::new(view, subject, "test".into(), false), asked: None };
    let show = |ui: &mut egui::Ui, state: &mut State| {
        state.asked = Some(state.controls.show(ui, egui::TextureId::User(0)));
    };
    let mut window = Harness::builder().with_size(vec2(1280.0, 900.0)).build_ui_state(show, state);
    window.step();
    window
}

/// The middle of the cube at the corner that is nearest to the eye.
const CORNER: [f64; 3] = [SIDE as f64 - 0.5, 0.5, SIDE as f64 - 0.5];

/// Where it is seen when all cubes are moved by a factor, in pixels from the upper left corner.
fn pixel_of_corner(camera: &Camera, factor: f32) -> [u32; 2] {
    let middle = 0.5 * SIDE as f64;
    let p = CORNER.map(|x| middle + f64::from(factor) * (x - middle));
    let [x, y] = camera.project(p, f64::from(SIZE[1])).unwrap();
    [(x + 0.5 * f64::from(SIZE[0])) as u32, (y + 0.5 * f64::from(SIZE[1])) as u32]
}

#[test]
fn a_slider_moves_a_hundred_thousand_cells_by_parameters_alone() {
    let Some(renderer) = renderer() else { return };
    let mut window = window(cubes());
    let mut picture = Picture::new(renderer, &window.state().controls.subject).unwrap();
    let uploaded = picture.renderer.context.traffic();
    assert!(100 << 20 < uploaded.geometry.bytes, "{uploaded:?}");
    let slider = window.get_by_role_and_label(egui::accesskit::Role::Slider, "all").rect();
    let start = slider.left_center() + vec2(4.0, 0.0);
    window.event(Event::PointerMoved(start));
    let (pos, button, modifiers) = (start, PointerButton::Primary, Modifiers::NONE);
    window.event(Event::PointerButton { pos, button, pressed: true, modifiers });
    let revisions = window.state().controls.subject.revisions;
    let mut seen = Vec::new();
    for x in [0.0, 15.0] {
        window.event(Event::PointerMoved(start + vec2(x, 0.0)));
        window.step();
        let Controls { subject, view, .. } = &window.state().controls;
        let before = picture.renderer.context.traffic();
        picture.follow(subject).unwrap();
        let (texture, _) = picture.draw(view, SIZE, true).unwrap();
        let frame = picture.renderer.context.traffic() - before;
        assert!(texture.is_some(), "a new picture");
        assert_eq!((frame.geometry, frame.tables), (Upload::default(), Upload::default()));
        // Of the pieces, and of what stands out of them.
        assert_eq!(frame.parameters, Upload { made: 2, bytes: 1024 });
        assert!(frame.draw_calls <= 4, "{} draw calls", frame.draw_calls);
        let factor = view.explode.factors[0][0];
        let at = pixel_of_corner(&view.camera, factor);
        let hit = picture.renderer.pick(&picture.buffers.each_ref(), view, SIZE, at, 0).unwrap().unwrap();
        let cube = subject.scenes[hit.scene].drawables()[hit.drawable].bounds().unwrap();
        assert_eq!(cube.center(), CORNER, "at the corner is the cube that should be there");
        seen.push((at, factor, picture.renderer.read_picture().unwrap()));
    }
    assert_eq!(window.state().controls.subject.revisions, revisions, "the scenes are the same");
    let [(at, one, still), (moved, factor, exploded)] = &seen[..] else { panic!("two pictures") };
    assert!(*one == 1.0 && 1.4 < *factor, "{one} {factor}");
    assert!(10 <= at[0].abs_diff(moved[0]) + at[1].abs_diff(moved[1]), "{at:?} {moved:?}");
    let pixels = still.pixels().chunks_exact(4).zip(exploded.pixels().chunks_exact(4));
    assert!(1000 < pixels.filter(|(a, b)| a != b).count(), "another picture");
}
