//! What pictures must hold, drawn off-screen; needs an adapter (see `support::renderer`).
mod support;

use lar_core::{Points, TriangleMesh};
use lar_viewer::{
    CellStyle, Coloring, Drawable, OffscreenRenderer, Orientation, Scene, StandardView, View, ViewerError,
    WHITE, palette_color, push_axes, push_cells,
};
use support::{check_picture, cube_grid, cuboid, differing, renderer};

const SIZE: [u32; 2] = [320, 240];
const ASPECT: f64 = 4.0 / 3.0;

/// The scene as exploded, drawn on white and compared with its committed picture.
#[track_caller]
fn check(name: &str, scene: &Scene, explode: [f32; 3]) {
    let Some(mut renderer) = renderer() else { return };
    let view = View { background: WHITE, ..View::fitted(scene, explode, ASPECT) };
    check_picture(name, &renderer.render(scene, &view, SIZE[0], SIZE[1]).unwrap());
}

fn grid(opacity: f32) -> Scene {
    let mut scene = Scene::new();
    push_cells(&mut scene, cube_grid(2), &CellStyle { opacity, ..CellStyle::default() }).unwrap();
    scene
}

#[test]
fn opaque_cells_exploded() {
    check("opaque", &grid(1.0), [1.6; 3]);
}

#[test]
fn translucent_cells_exploded() {
    check("translucent", &grid(0.35), [1.6; 3]);
}

#[test]
fn translucent_cells_in_place_with_axes() {
    let mut scene = grid(0.3);
    push_axes(&mut scene, 3.0).unwrap();
    check("axes", &scene, [1.0; 3]);
}

#[test]
fn points_lines_and_unlit_mesh() {
    let mut scene = Scene::new();
    let corners: Vec<_> = cuboid(0, [0.; 3], [1.; 3]).edges.into_iter().flatten().collect();
    let floor = Points::from_columns(2, vec![-0.5, -0.5, 1.5, -0.5, 1.5, 1.5, -0.5, 1.5]);
    let floor = TriangleMesh { points: floor, triangles: vec![[0, 1, 2], [0, 2, 3]] };
    scene.push(Drawable::mesh("floor", floor).color([0.9, 0.9, 0.85]).unlit()).unwrap();
    scene.push(Drawable::lines("cube", cuboid(0, [0.; 3], [1.; 3]).edges).width(2.5)).unwrap();
    scene.push(Drawable::points("corners", corners).color([0.9, 0.3, 0.2]).size(9.0)).unwrap();
    check("points", &scene, [1.0; 3]);
}

/// Scene, view and renderer for the tests of laws.
fn exploded_grid() -> (Scene, View) {
    let scene = grid(0.35);
    let view = View { background: WHITE, ..View::fitted(&scene, [1.7, 1.4, 2.0], ASPECT) };
    (scene, view)
}

fn draw(renderer: &mut OffscreenRenderer, scene: &Scene, view: &View) -> Vec<u8> {
    renderer.render(scene, view, SIZE[0], SIZE[1]).unwrap().pixels().to_vec()
}

#[test]
fn repeated_pictures_are_identical() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = exploded_grid();
    let first = draw(&mut renderer, &scene, &view);
    assert_eq!(draw(&mut renderer, &scene, &view), first);
    let mut other = OffscreenRenderer::new().unwrap();
    assert_eq!(draw(&mut other, &scene, &view), first, "from a new device");
    let all = other.render_all(&scene, &[view, view], SIZE[0], SIZE[1]).unwrap();
    assert!(all.iter().all(|image| image.pixels() == first), "uploaded once");
}

#[test]
fn transparency_does_not_depend_on_the_order_of_drawing() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = exploded_grid();
    let in_place = View { explode: [1.0; 3].into(), ..view };
    let permuted = permuted_grid();
    for view in [view, in_place] {
        assert_eq!(draw(&mut renderer, &scene, &view), draw(&mut renderer, &permuted, &view));
    }
}

/// Random triangles through each other, in one order and in another.
#[test]
fn random_triangles_blend_the_same_in_any_order() {
    let Some(renderer) = renderer() else { return };
    let renderer = std::cell::RefCell::new(renderer);
    let mut runner = proptest::test_runner::TestRunner::new(proptest::test_runner::Config::with_cases(12));
    let corner = || proptest::array::uniform3(-1.0..1.0_f64);
    let triangle = (proptest::array::uniform3(corner()), 0.05..1.0_f32, 0..12_u32);
    let triangles = proptest::collection::vec(triangle, 1..40);
    let result = runner.run(&(triangles, 0..39_usize), |(mut triangles, turn)| {
        let build = |triangles: &[([[f64; 3]; 3], f32, u32)]| {
            let mut scene = Scene::new();
            for (corners, opacity, code) in triangles {
                let mesh = TriangleMesh { points: Points::from_xyz(corners), triangles: vec![[0, 1, 2]] };
                let color = palette_color(*code);
                scene.push(Drawable::mesh("triangle", mesh).color(color).opacity(*opacity)).unwrap();
            }
            scene
        };
        let first = build(&triangles);
        let view = View { samples: 1, ..View::fitted(&first, [1.0; 3], ASPECT) };
        let n = triangles.len();
        triangles.rotate_left(turn % n);
        triangles.iter_mut().for_each(|t| t.0.rotate_right(1));
        let second = build(&triangles);
        let renderer = &mut *renderer.borrow_mut();
        assert!(draw(renderer, &first, &view) == draw(renderer, &second, &view));
        Ok(())
    });
    result.unwrap();
}

/// The same cells in the same colours, pushed backwards, with triangles and their vertices in another order.
fn permuted_grid() -> Scene {
    let mut scene = Scene::new();
    for (i, mut cell) in cube_grid(2).into_iter().enumerate().rev() {
        cell.mesh.triangles.reverse();
        cell.mesh.triangles.iter_mut().for_each(|t| t.rotate_left(1));
        let style = CellStyle {
            opacity: 0.35,
            coloring: Coloring::Fixed(Coloring::Cyclic.color(i)),
            ..CellStyle::default()
        };
        push_cells(&mut scene, [cell], &style).unwrap();
    }
    scene
}

#[test]
fn explosion_is_the_same_as_moving_the_cells() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = exploded_grid();
    let mut moved = Scene::new();
    let cells = cube_grid(2).into_iter().map(|mut cell| {
        let middle =
            cell.edges.iter().flatten().fold([0.0; 3], |sum, p| [0, 1, 2].map(|k| sum[k] + p[k] / 24.0));
        let shift = [0, 1, 2].map(|k| (f64::from(view.explode.factors[0][k]) - 1.0) * (middle[k] - 1.0));
        for p in
            cell.edges.as_flattened_mut().iter_mut().chain(cell.mesh.points.coords_mut().as_chunks_mut().0)
        {
            *p = [0, 1, 2].map(|k| p[k] + shift[k]);
        }
        cell
    });
    push_cells(&mut moved, cells, &CellStyle { opacity: 0.35, ..CellStyle::default() }).unwrap();
    let still = View { explode: [1.0; 3].into(), ..view };
    let [a, b] = [draw(&mut renderer, &scene, &view), draw(&mut renderer, &moved, &still)];
    assert!(differing(&a, &b, 8) <= a.len() / 4 / 1000, "{} pixels differ", differing(&a, &b, 8));
    assert!(1000 < differing(&a, &draw(&mut renderer, &scene, &still), 8), "the explosion is seen");
}

/// Squares of half opacity one behind the other, seen along y.
fn stack(colors: &[[f32; 3]], opacity: f32) -> (Scene, View) {
    let mut scene = Scene::new();
    for (i, color) in colors.iter().enumerate() {
        let y = 0.01 * i as f64;
        let corners = [[-1., y, -1.], [1., y, -1.], [1., y, 1.], [-1., y, 1.]];
        let mesh = TriangleMesh { points: Points::from_xyz(&corners), triangles: vec![[0, 1, 2], [0, 2, 3]] };
        scene
            .push(Drawable::mesh(format!("square {i}"), mesh).color(*color).opacity(opacity).unlit())
            .unwrap();
    }
    let mut view = View { background: [0.0; 3], ..View::default() };
    view.camera.orientation = StandardView::Front.orientation();
    let view = view.fit(&scene, 1.0);
    (scene, view)
}

/// The colour near the middle of a picture of the scene, to one step.
#[track_caller]
fn check_middle(renderer: &mut OffscreenRenderer, scene: &Scene, view: &View, expected: [u8; 4]) {
    let middle = renderer.render(scene, view, 32, 32).unwrap().pixel(16, 10).unwrap();
    assert_eq!(differing(&middle, &expected, 1), 0, "{middle:?} is not {expected:?}");
}

#[track_caller]
fn check_stack(colors: &[[f32; 3]], opacity: f32) {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = stack(colors, opacity);
    let middle = renderer.render(&scene, &view, 32, 32).unwrap().pixel(16, 10).unwrap();
    let over = |back: f32, front: f32| opacity * front + (1.0 - opacity) * back;
    for k in 0..3 {
        let expected = 255.0 * colors.iter().rev().fold(0.0, |back, color| over(back, color[k]));
        let error = (f32::from(middle[k]) - expected).abs();
        assert!(error <= 2.0, "channel {k} of {middle:?} is not {expected}");
    }
}

#[test]
fn layers_blend_front_to_back_however_many_they_are() {
    let (red, green, blue) = ([1., 0., 0.], [0., 1., 0.], [0., 0., 1.]);
    check_stack(&[red], 0.5);
    check_stack(&[red, green, blue], 0.5);
    check_stack(&[blue, green, red], 0.3);
    let many: Vec<_> = (0..70).map(|i| [red, green, blue][i % 3]).collect();
    check_stack(&many, 0.04);
}

#[test]
fn the_opaque_hides_what_is_behind_it_and_only_that() {
    let Some(mut renderer) = renderer() else { return };
    let (mut scene, view) = stack(&[[1., 0., 0.]], 0.5);
    let wall = |y: f64| {
        let corners = [[-1., y, -1.], [1., y, -1.], [1., y, 1.], [-1., y, 1.]];
        let mesh = TriangleMesh { points: Points::from_xyz(&corners), triangles: vec![[0, 1, 2], [0, 2, 3]] };
        Drawable::mesh("wall", mesh).color([0., 0., 1.]).unlit()
    };
    scene.push(wall(0.5)).unwrap();
    check_middle(&mut renderer, &scene, &view, [128, 0, 128, 255]);
    scene.push(wall(-0.5)).unwrap();
    check_middle(&mut renderer, &scene, &view, [0, 0, 255, 255]);
}

#[test]
fn opacity_of_the_view_makes_opaque_meshes_transparent() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = stack(&[[1., 0., 0.], [0., 1., 0.]], 1.0);
    let view = View { opacity: 0.5, ..view };
    check_middle(&mut renderer, &scene, &view, [128, 64, 0, 255]);
}

#[test]
fn hidden_edges_leave_faces_and_other_lines() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = exploded_grid();
    let without = View { edges: false, ..view };
    let mut bare = Scene::new();
    let style = CellStyle { opacity: 0.35, edge_width: 0.0, ..CellStyle::default() };
    push_cells(&mut bare, cube_grid(2), &style).unwrap();
    assert_eq!(draw(&mut renderer, &scene, &without), draw(&mut renderer, &bare, &view));
}

/// Width in pixels of a vertical black line on white, measured as the darkness of the middle row.
#[track_caller]
fn check_width(line: Drawable, zoom: f64, scale: f32, expected: f64) {
    let Some(mut renderer) = renderer() else { return };
    let mut scene = Scene::new();
    scene.push(line.color([0.0; 3])).unwrap();
    let mut view = View { background: WHITE, scale, samples: 4, ..View::default() };
    view.camera.orientation = Orientation::turntable(0.3, 0.0);
    for _ in 0..2 {
        view.camera = view.camera.fit(&scene.bounds([1.0; 3]).unwrap(), 1.0);
        view.camera.distance /= zoom;
        let image = renderer.render(&scene, &view, 64, 64).unwrap();
        let darkness = |x| 1.0 - f64::from(image.pixel(x, 32).unwrap()[0]) / 255.0;
        let width: f64 = (0..64).map(darkness).sum();
        assert!((width - expected).abs() < 0.3, "{width} is not {expected} in {:?}", view.camera.projection);
        view.camera = view.camera.toggle_projection();
    }
}

#[test]
fn lines_have_their_width_at_any_distance() {
    let line = |width| Drawable::lines("line", [[[0.0; 3], [0., 0., 1.]]]).width(width);
    for zoom in [0.3, 1.0, 20.0] {
        check_width(line(2.0), zoom, 1.0, 2.0);
        check_width(line(5.0), zoom, 1.0, 5.0);
        check_width(line(2.0), zoom, 3.0, 6.0);
    }
}

#[test]
fn points_have_their_size_at_any_distance() {
    for zoom in [0.3, 1.0, 20.0] {
        check_width(Drawable::points("point", [[0.0; 3]]).size(8.0), zoom, 1.0, 8.0);
    }
}

#[test]
fn edges_keep_their_width_until_the_cell_is_small() {
    let edge = || Drawable::edges("edge", [[[0.0; 3], [0., 0., 1.]]]).width(2.0);
    check_width(edge(), 1.0, 1.0, 2.0);
    check_width(edge(), 0.3, 1.0, 2.0);
    check_width(edge(), 0.05, 1.0, 0.12 * 0.94 * 64.0 * 0.05);
}

#[test]
fn pictures_drawn_in_bands_are_the_same() {
    let Some(mut whole) = renderer() else { return };
    let (scene, view) = exploded_grid();
    let expected = draw(&mut whole, &scene, &view);
    for bytes in [1 << 20, 200_000, 60_000] {
        let mut banded = renderer().expect("there was one before").layer_memory(bytes);
        assert!(draw(&mut banded, &scene, &view) == expected, "with {bytes} bytes for layers");
    }
    let error = whole.layer_memory(1000).render(&scene, &view, SIZE[0], SIZE[1]).unwrap_err();
    assert!(matches!(error, ViewerError::TooManyLayers { limit: 83, .. }), "{error}");
}

#[test]
fn an_empty_scene_is_background() {
    let Some(mut renderer) = renderer() else { return };
    let image = renderer.render(&Scene::new(), &View::default(), 3, 2).unwrap();
    let slate = [77, 102, 128, 255].repeat(6);
    assert_eq!(differing(image.pixels(), &slate, 1), 0, "{:?}", image.pixels());
}

#[test]
fn sizes_that_cannot_be_drawn_are_refused() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = exploded_grid();
    for (width, height) in [(0, 10), (10, 0), (u32::MAX, 10), (10, 1 << 20)] {
        let error = renderer.render(&scene, &view, width, height).unwrap_err();
        assert!(matches!(error, ViewerError::ImageSize { .. }), "{error}");
    }
    let bad = View { explode: [f32::NAN; 3].into(), ..view };
    assert!(matches!(renderer.render(&scene, &bad, 9, 9), Err(ViewerError::InvalidView { .. })));
}

#[test]
fn a_camera_inside_the_scene_or_beyond_it_still_draws() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = exploded_grid();
    for distance in [1e-90, 1e-6, 0.3, 1e6, 1e110] {
        let mut view = view;
        view.camera.distance = distance;
        renderer.render(&scene, &view, 64, 48).unwrap();
        view.camera = view.camera.toggle_projection();
        renderer.render(&scene, &view, 64, 48).unwrap();
    }
}

#[test]
fn many_groups_take_one_picture() {
    let Some(mut renderer) = renderer() else { return };
    let mut scene = Scene::new();
    push_cells(&mut scene, cube_grid(20), &CellStyle { opacity: 0.3, ..CellStyle::default() }).unwrap();
    let view = View { background: WHITE, samples: 1, ..View::fitted(&scene, [1.5; 3], ASPECT) };
    let first = draw(&mut renderer, &scene, &view);
    assert_eq!(draw(&mut renderer, &scene, &view), first, "also after the layer buffers have grown");
}
