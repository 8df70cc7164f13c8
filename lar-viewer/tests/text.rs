//! Text on the screen and in the model, numbering.
mod support;

use lar_core::Model;
use lar_viewer::{
    Camera, CellRef, CellStyle, Coloring, Drawable, HorizontalAlign, INK, Label, Projection, Scene,
    StandardView, TextStyle, View, WHITE, push_cells, push_numbers, text_model, text_segments,
};
use support::{check_picture, cube_grid, renderer};

/// From the front or from above, without perspective.
fn flat(scene: &Scene, from: StandardView, aspect: f64) -> View {
    let camera =
        Camera { orientation: from.orientation(), projection: Projection::Orthographic, ..Camera::default() };
    View { camera, background: WHITE, ..View::default() }.fit(scene, aspect)
}

/// Every glyph, as segments of its 1-complex.
#[test]
fn all_glyphs() {
    let Some(mut renderer) = renderer() else { return };
    let style = TextStyle { size: 1.0, ..TextStyle::default() };
    let mut scene = Scene::new();
    for (i, character) in (' '..='~').enumerate() {
        let model: Model = text_model(&character.to_string(), &style);
        let at = [1.5 * (i % 16) as f64, -2.2 * (i / 16) as f64];
        let point = |v: u32| {
            let p = model.points().point(v as usize);
            [p[0] + at[0], p[1] + at[1], 0.0]
        };
        let edges: Vec<&[u32]> = model.cells(1).iter().collect();
        let segments = edges.iter().map(|e| [point(e[0]), point(e[1])]);
        scene.push(Drawable::lines("glyph", segments).width(2.4)).unwrap();
        let dots = (0..model.points().len() as u32).filter(|v| !edges.iter().any(|e| e.contains(v)));
        scene.push(Drawable::points("dots", dots.map(point)).size(3.4)).unwrap();
    }
    let view = flat(&scene, StandardView::Top, 1.6);
    check_picture("glyphs", &renderer.render(&scene, &view, 640, 400).unwrap());
}

fn numbered_grid(on_top: bool) -> Scene {
    let mut scene = Scene::new();
    let cells = cube_grid(2);
    let style = CellStyle { opacity: 0.35, coloring: Coloring::Code(1), ..CellStyle::default() };
    let groups = push_cells(&mut scene, cells.clone(), &style).unwrap();
    let size = TextStyle { size: 12.0, ..TextStyle::default() };
    for (cell, group) in cells.iter().zip(groups) {
        let center = cell.mesh.points.iter().fold([0.0; 3], |s, p| [0, 1, 2].map(|k| s[k] + p[k] / 8.0));
        push_numbers(&mut scene, [(cell.cell, center, Some(group))], &size, on_top).unwrap();
        let corners = cell.mesh.points.iter().enumerate();
        let vertex = |(i, p): (usize, &[f64])| (CellRef::new(0, i as u32), [p[0], p[1], p[2]], Some(group));
        push_numbers(&mut scene, corners.map(vertex), &TextStyle { size: 8.0, ..size }, on_top).unwrap();
    }
    scene
}

#[test]
fn numbers_of_exploded_cells() {
    let Some(mut renderer) = renderer() else { return };
    let scene = numbered_grid(true);
    let view = View { background: WHITE, ..View::fitted(&scene, [1.7; 3], 4.0 / 3.0) };
    check_picture("numbers", &renderer.render(&scene, &view, 480, 360).unwrap());
}

#[test]
fn labels_keep_their_size_and_can_be_hidden_or_on_top() {
    let Some(mut renderer) = renderer() else { return };
    let mut ink = |distance: f64, wall: bool, on_top: bool| {
        let mut scene = Scene::new();
        let label = Drawable::labels("label", [Label::new("H", [0.0; 3])]);
        let style = TextStyle { size: 40.0, ..TextStyle::default() };
        let label = label.text_style(style).color([0.0; 3]);
        scene.push(if on_top { label.on_top() } else { label }).unwrap();
        let mut view = View { background: WHITE, ..View::default() };
        view.camera.distance = distance;
        let reach = 0.5 * distance;
        if wall {
            let [_, _, back] = view.camera.axes();
            let mut wall = support::cuboid(0, [-0.3; 3], [0.3; 3]).mesh;
            for p in wall.points.coords_mut().as_chunks_mut::<3>().0 {
                *p = std::array::from_fn(|k| p[k] * distance + reach * back[k]);
            }
            scene.push(Drawable::mesh("wall", wall).color([1.0, 0.0, 0.0]).unlit()).unwrap();
        }
        let image = renderer.render(&scene, &view, 100, 100).unwrap();
        let darkness = image.pixels().chunks_exact(4).map(|p| 1.0 - f64::from(p[0]) / 255.0);
        darkness.sum::<f64>()
    };
    let (near, far) = (ink(3.0, false, false), ink(30.0, false, false));
    // Two stems of 40 pixels and a bar, 6 pixels wide.
    assert!(500.0 < near && near < 800.0, "{near}");
    assert!((near - far).abs() < 0.01 * near, "{near} near, {far} far");
    assert_eq!(ink(6.0, true, false), 0.0, "hidden by the wall");
    let over = ink(6.0, true, true);
    assert!((over - near).abs() < 0.01 * near, "{over} on top");
}

#[test]
fn labels_are_picked_by_their_cell() {
    let Some(mut renderer) = renderer() else { return };
    let scene = numbered_grid(true);
    let view = View { background: WHITE, ..View::fitted(&scene, [1.7; 3], 4.0 / 3.0) };
    let prepared = renderer.prepare(&scene).unwrap();
    let center = scene.center();
    for drawable in scene.drawables().iter().filter(|d| d.name() == "cell numbers") {
        let moved = scene.displacement(drawable, &view.explode, center);
        let at = drawable.corners_of_element(0)[0];
        let p = std::array::from_fn(|k| at[k] + moved[k]);
        let [x, y] = view.camera.project(p, 360.0).unwrap();
        let hit = prepared.pick(&view, [480, 360], [(x + 240.0) as u32, (y + 180.0) as u32], 6).unwrap();
        assert_eq!(hit.and_then(|h| h.cell), drawable.cell_of_element(0));
    }
}

#[test]
fn text_lies_in_the_model_or_faces_the_camera() {
    let Some(mut renderer) = renderer() else { return };
    let mut scene = Scene::new();
    let style = CellStyle { coloring: Coloring::Code(5), ..CellStyle::default() };
    push_cells(&mut scene, cube_grid(1), &style).unwrap();
    let text = TextStyle { size: 0.22, ..TextStyle::default() };
    let front = text_segments("front", &text, [0.5, -0.002, 0.5], [1., 0., 0.], [0., 0., 1.]);
    scene.push(Drawable::lines("front", front).width(2.5)).unwrap();
    let turned = TextStyle { angle: 0.5, ..text };
    let right = text_segments("right", &turned, [1.002, 0.5, 0.5], [0., 1., 0.], [0., 0., 1.]);
    scene.push(Drawable::lines("right", right).width(2.5).color([0.7, 0.1, 0.1])).unwrap();
    let left = TextStyle { horizontal: HorizontalAlign::Left, ..TextStyle::default() };
    let label = Drawable::labels("label", [Label::new("two lines,\nfacing us", [1.0, 0.0, 1.0])]);
    scene.push(label.text_style(left).color(INK)).unwrap();
    let view = View { background: WHITE, ..View::fitted(&scene, [1.0; 3], 4.0 / 3.0) };
    let image = renderer.render(&scene, &view, 320, 240).unwrap();
    check_picture("texts", &image);
}

/// However many they are, labels are one draw call of one buffer.
#[test]
fn a_hundred_thousand_labels_take_one_draw_call() {
    let Some(mut renderer) = renderer() else { return };
    let labels = (0..100_000_u32).map(|i| {
        let at = [f64::from(i % 400), f64::from(i / 400), 0.0];
        Label::new((i % 10).to_string(), at)
    });
    let mut scene = Scene::new();
    scene.push(Drawable::labels("many", labels).on_top()).unwrap();
    let view = View { samples: 1, ..flat(&scene, StandardView::Top, 8.0 / 5.0) };
    let mut prepared = renderer.prepare(&scene).unwrap();
    let uploaded = prepared.traffic();
    assert_eq!(uploaded.geometry.made, 1, "one buffer");
    let image = prepared.render(&view, 320, 200).unwrap();
    let drawn = prepared.traffic() - uploaded;
    assert_eq!((drawn.draw_calls, drawn.geometry.bytes, drawn.tables.bytes), (1, 0, 0));
    let dark = image.pixels().chunks_exact(4).filter(|p| p[0] < 128).count();
    assert!(20_000 < dark, "{dark}");
    let last = prepared.pick(&view, [320, 200], [311, 6], 20).unwrap().unwrap();
    assert!(95_000 < last.element, "one of the last: {last:?}");
}
