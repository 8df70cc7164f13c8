//! The renderer held to WebGL 2: opaque scenes are the same, one layer is exact, several are close.
mod support;

use lar_core::{Points, TriangleMesh};
use lar_viewer::{CellStyle, Drawable, Image, Label, OffscreenRenderer, Scene, View, WHITE, push_cells};
use support::{check_picture, cube_grid, differing, renderer};

const SIZE: [u32; 2] = [320, 240];

fn both() -> Option<[OffscreenRenderer; 2]> {
    let sorted = renderer()?;
    Some([sorted, OffscreenRenderer::portable().unwrap()])
}

fn grid(opacity: f32) -> (Scene, View) {
    let mut scene = Scene::new();
    push_cells(&mut scene, cube_grid(2), &CellStyle { opacity, ..CellStyle::default() }).unwrap();
    scene.push(Drawable::labels("label", [Label::new("eight", [1.0, 1.0, 2.5])]).on_top()).unwrap();
    scene.push(Drawable::points("dots", [[0.0; 3], [2.0; 3]])).unwrap();
    let view = View { background: WHITE, ..View::fitted(&scene, [1.6; 3], 4.0 / 3.0) };
    (scene, view)
}

fn draw(renderers: &mut [OffscreenRenderer; 2], scene: &Scene, view: &View) -> [Image; 2] {
    renderers.each_mut().map(|r| r.render(scene, view, SIZE[0], SIZE[1]).unwrap())
}

#[test]
fn opaque_scenes_are_the_same() {
    let Some(mut renderers) = both() else { return };
    let (scene, view) = grid(1.0);
    let [sorted, portable] = draw(&mut renderers, &scene, &view);
    assert!(sorted == portable);
}

#[test]
fn one_layer_is_exact() {
    let Some(mut renderers) = both() else { return };
    let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [0., 0., 1.]]);
    let mut scene = Scene::new();
    let mesh = TriangleMesh { points, triangles: vec![[0, 1, 2]] };
    scene.push(Drawable::mesh("triangle", mesh).color([0.9, 0.2, 0.1]).opacity(0.4)).unwrap();
    let [sorted, portable] = draw(&mut renderers, &scene, &View::fitted(&scene, [1.0; 3], 4.0 / 3.0));
    assert_eq!(differing(sorted.pixels(), portable.pixels(), 3), 0);
}

#[test]
fn several_layers_are_close_and_behind_what_is_opaque() {
    let Some(mut renderers) = both() else { return };
    let (scene, view) = grid(0.35);
    let [sorted, portable] = draw(&mut renderers, &scene, &view);
    let apart = differing(sorted.pixels(), portable.pixels(), 60);
    assert!(apart < 2000, "{apart} pixels are far apart");
    check_picture("portable", &portable);
    let again = renderers[1].render(&scene, &view, SIZE[0], SIZE[1]).unwrap();
    assert!(again == portable, "the same bytes again");
    let prepared = renderers[1].prepare(&scene).unwrap();
    let hit = prepared.pick(&view, SIZE, [160, 120], 2).unwrap();
    let [sorted, _] = &mut renderers;
    assert_eq!(sorted.prepare(&scene).unwrap().pick(&view, SIZE, [160, 120], 2).unwrap(), hit);
}
