//! What changes without an upload of geometry: looks, clip plane, nested explosion; picking; buffers of limited size.
mod support;

use lar_viewer::{
    Appearance, Camera, CellRef, CellStyle, Clip, Drawable, Explosion, Hit, OffscreenRenderer, Outline,
    Outlined, Prepared, Projection, Scene, StandardView, View, WHITE, push_cells,
};
use support::{cube_grid, cuboid, differing, renderer};

const SIZE: [u32; 2] = [160, 120];
const ASPECT: f64 = 4.0 / 3.0;

fn grid(opacity: f32) -> (Scene, View) {
    let mut scene = Scene::new();
    push_cells(&mut scene, cube_grid(2), &CellStyle { opacity, ..CellStyle::default() }).unwrap();
    let view = View { background: WHITE, samples: 2, ..View::fitted(&scene, [1.5; 3], ASPECT) };
    (scene, view)
}

fn draw(renderer: &mut OffscreenRenderer, scene: &Scene, view: &View) -> Vec<u8> {
    renderer.render(scene, view, SIZE[0], SIZE[1]).unwrap().pixels().to_vec()
}

/// Changing looks is the same as drawing the scene with these looks from the start.
#[test]
fn changed_looks_are_those_of_a_new_scene() {
    let Some(mut renderer) = renderer() else { return };
    let mut other = renderer_again();
    for opacity in [1.0, 0.4] {
        let (scene, view) = grid(opacity);
        let looks = |i: usize, look: Appearance| match i % 5 {
            0 => Appearance { visible: false, ..look },
            1 => Appearance { color: [0.1, 0.9, 0.2], ..look },
            2 => Appearance { opacity: 0.7, ..look },
            3 => Appearance { opacity: 1.0, ..look },
            _ => look,
        };
        let appearances: Vec<_> =
            scene.appearances().into_iter().enumerate().map(|(i, look)| looks(i, look)).collect();
        let mut changed = Scene::new();
        scene.groups().iter().for_each(|g| {
            changed.push_group(g.centroid).unwrap();
        });
        for (drawable, look) in scene.drawables().iter().zip(&appearances) {
            let drawable = drawable.clone().color(look.color).opacity(look.opacity);
            changed.push(if look.visible { drawable } else { drawable.hidden() }).unwrap();
        }
        let expected = draw(&mut other, &changed, &view);
        let before = draw(&mut other, &scene, &view);
        let mut prepared = renderer.prepare(&scene).unwrap();
        let mut draw = || prepared.render(&view, SIZE[0], SIZE[1]).unwrap().pixels().to_vec();
        assert_eq!(draw(), before);
        prepared.set_appearances(&appearances).unwrap();
        let after = prepared.render(&view, SIZE[0], SIZE[1]).unwrap();
        assert!(after.pixels() == expected, "opacity {opacity}");
        assert!(1000 < differing(&before, &expected, 8));
        prepared.set_appearances(&scene.appearances()).unwrap();
        assert!(prepared.render(&view, SIZE[0], SIZE[1]).unwrap().pixels() == before);
    }
}

fn renderer_again() -> OffscreenRenderer {
    renderer().expect("there was one before")
}

#[test]
fn highlighted_cells_stand_out_and_bad_looks_are_refused() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = grid(0.4);
    let mut looks = scene.appearances();
    looks.iter_mut().zip(scene.drawables()).for_each(|(look, d)| {
        look.highlighted = d.cell_ref() == Some(CellRef::new(3, 1));
    });
    let plain = draw(&mut renderer, &scene, &view);
    let mut prepared = renderer.prepare(&scene).unwrap();
    prepared.set_appearances(&looks).unwrap();
    let image = prepared.render(&view, SIZE[0], SIZE[1]).unwrap();
    let yellow = image.pixels().chunks_exact(4).filter(|p| 150 < p[0] && 130 < p[1] && p[2] < 90).count();
    assert!(300 < yellow, "{yellow} pixels in the highlight colour");
    looks[0].opacity = 2.0;
    let error = prepared.set_appearances(&looks).unwrap_err().to_string();
    assert_eq!(error, "drawable \"cuboid 0\": the opacity is 2; it must lie between 0 and 1");
    assert!(prepared.render(&view, SIZE[0], SIZE[1]).unwrap() == image && image.pixels() != plain);
}

/// A scene split over many buffers is drawn and picked as in one.
#[test]
fn buffers_of_any_size_give_the_same_picture() {
    let Some(mut whole) = renderer() else { return };
    for opacity in [1.0, 0.4] {
        let (scene, view) = grid(opacity);
        let expected = draw(&mut whole, &scene, &view);
        let hits = picked(&mut whole, &scene, &view);
        for bytes in [100, 1000, 3000] {
            let mut split = renderer_again().buffer_memory(bytes);
            assert!(draw(&mut split, &scene, &view) == expected, "{bytes} bytes a buffer, opacity {opacity}");
            assert_eq!(picked(&mut split, &scene, &view), hits, "{bytes} bytes a buffer");
        }
    }
}

/// What is seen at pixels all over the picture.
fn picked(renderer: &mut OffscreenRenderer, scene: &Scene, view: &View) -> Vec<Option<Hit>> {
    let prepared = renderer.prepare(scene).unwrap();
    let pixels = (0..SIZE[1]).step_by(13).flat_map(|y| (0..SIZE[0]).step_by(13).map(move |x| [x, y]));
    pixels.map(|pixel| prepared.pick(view, SIZE, pixel, 0).unwrap()).collect()
}

/// Every cell has a colour of its own, so what is picked can be compared with what is seen.
#[test]
fn what_is_picked_is_what_is_seen() {
    let Some(mut renderer) = renderer() else { return };
    let mut scene = Scene::new();
    for (i, cell) in cube_grid(2).into_iter().enumerate() {
        let group = scene.push_group(cell.edges[0][0]).unwrap();
        let color = [0.1 * (i + 1) as f32, 0.5, 0.9 - 0.1 * i as f32];
        let mesh = Drawable::mesh(cell.name, cell.mesh).color(color).unlit().cell(cell.cell).group(group);
        scene.push(mesh).unwrap();
    }
    for explode in [[1.0; 3], [1.6, 1.3, 2.0]] {
        let view = View { background: WHITE, samples: 1, ..View::fitted(&scene, explode, ASPECT) };
        let image = renderer.render(&scene, &view, SIZE[0], SIZE[1]).unwrap();
        let mut n_hit = 0;
        for hit in picked(&mut renderer, &scene, &view).into_iter().flatten() {
            let color = scene.drawables()[hit.drawable].appearance().color;
            let seen = image.pixel(hit.pixel[0], hit.pixel[1]).unwrap();
            let near = (0..3).all(|k| (255.0 * color[k] - f32::from(seen[k])).abs() <= 1.0);
            assert!(near, "{hit:?} is {color:?}, but {seen:?} is seen");
            assert_eq!(hit.owner, hit.cell);
            assert_on_screen(&scene, &view, &hit);
            n_hit += 1;
        }
        assert!(15 < n_hit, "{n_hit} hits");
    }
}

/// The point of a hit, exploded with its drawable, is projected into the picked pixel.
#[track_caller]
fn assert_on_screen(scene: &Scene, view: &View, hit: &Hit) {
    let moved = scene.displacement(&scene.drawables()[hit.drawable], &view.explode, scene.center());
    let p = std::array::from_fn(|k| hit.point[k] + moved[k]);
    let [x, y] = view.camera.project(p, f64::from(SIZE[1])).unwrap();
    let [dx, dy] = [x + 80.0 - f64::from(hit.pixel[0]) - 0.5, y + 60.0 - f64::from(hit.pixel[1]) - 0.5];
    assert!(dx.abs() < 1e-6 && dy.abs() < 1e-6, "{hit:?} appears {dx}, {dy} beside its pixel");
}

#[test]
fn vertices_win_over_edges_and_edges_over_faces() {
    let Some(mut renderer) = renderer() else { return };
    let mut scene = Scene::new();
    let cell = cuboid(0, [0.; 3], [1.; 3]);
    let corners: Vec<_> = cell.edges.iter().flatten().copied().collect();
    let edge = |i| CellRef::new(1, i);
    scene.push(Drawable::mesh("cube", cell.mesh).cell(cell.cell)).unwrap();
    scene
        .push(Drawable::edges("edges", cell.edges).cell(cell.cell).element_cells((0..12).map(edge)))
        .unwrap();
    let vertex = |i| CellRef::new(0, i);
    scene.push(Drawable::points("vertices", corners.clone()).element_cells((0..24).map(vertex))).unwrap();
    let view = View::fitted(&scene, [1.0; 3], ASPECT);
    let at = |p: [f64; 3]| {
        let [x, y] = view.camera.project(p, f64::from(SIZE[1])).unwrap();
        [(x + 80.0) as u32, (y + 60.0) as u32]
    };
    let prepared = renderer.prepare(&scene).unwrap();
    let check = |p, radius, expected: Option<u8>| {
        let hit = prepared.pick(&view, SIZE, at(p), radius).unwrap();
        assert_eq!(hit.and_then(|h| h.cell).map(|c| c.dim), expected, "{hit:?}");
        hit
    };
    // The corner towards the eye is (1, 0, 1).
    let hit = check([1.0, 0.0, 1.0], 3, Some(0)).unwrap();
    assert_eq!((hit.point, hit.owner), ([1.0, 0.0, 1.0], None));
    let hit = check([1.0, 0.0, 0.5], 3, Some(1)).unwrap();
    assert_eq!(hit.owner, Some(CellRef::new(3, 0)));
    check([1.0, 0.12, 0.5], 0, Some(3));
    check([1.0, 0.03, 0.5], 5, Some(1));
    assert!(prepared.pick(&view, SIZE, [0, 0], 3).unwrap().is_none());
    let error = prepared.pick(&view, SIZE, [160, 0], 3).unwrap_err().to_string();
    assert!(error.contains("picked pixel is 160"), "{error}");
}

#[test]
fn what_is_wide_is_picked_far_from_what_it_marks() {
    let Some(mut renderer) = renderer() else { return };
    let mut scene = Scene::new();
    scene.push(Drawable::points("dot", [[0.; 3]]).size(60.0)).unwrap();
    scene.push(Drawable::lines("line", [[[-1., 0., 1.], [1., 0., 1.]]]).width(40.0)).unwrap();
    let camera = Camera { orientation: StandardView::Front.orientation(), ..Camera::default() };
    let view = View { camera: camera.toggle_projection(), ..View::default() };
    let line = view.camera.project([0.0, 0.0, 1.0], f64::from(SIZE[1])).unwrap()[1];
    let mut prepared = renderer.prepare(&scene).unwrap();
    let check = |prepared: &Prepared<'_>, [x, y]: [f64; 2], expected: Option<usize>| {
        let pixel = [(x + 80.0) as u32, (y + 60.0) as u32];
        let hit = prepared.pick(&view, SIZE, pixel, 0).unwrap();
        assert_eq!(hit.map(|h| h.drawable), expected, "{pixel:?}");
    };
    check(&prepared, [28.0, 0.0], Some(0));
    check(&prepared, [0.0, 28.0], Some(0));
    check(&prepared, [35.0, line + 18.0], Some(1));
    check(&prepared, [46.0, 0.0], None);
    let highlighted: Vec<_> =
        scene.appearances().into_iter().map(|a| Appearance { highlighted: true, ..a }).collect();
    prepared.set_appearances(&highlighted).unwrap();
    check(&prepared, [46.0, 0.0], Some(0));
    check(&prepared, [0.0, 46.0], Some(0));
}

#[test]
fn the_clip_plane_cuts_or_takes_whole_cells() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = grid(1.0);
    let in_place = View { explode: [1.0; 3].into(), ..view };
    let upper = Clip::new([0.0, 0.0, 2.0], 2.5);
    let shown = |keep: &dyn Fn(u32) -> bool| {
        let mut kept = Scene::new();
        scene.groups().iter().for_each(|g| {
            kept.push_group(g.centroid).unwrap();
        });
        for drawable in scene.drawables() {
            let keep = keep(drawable.cell_ref().unwrap().index);
            let drawable = drawable.clone();
            kept.push(if keep { drawable } else { drawable.hidden() }).unwrap();
        }
        kept
    };
    for view in [view, in_place] {
        let whole = View { clip: Some(upper.whole_cells()), ..view };
        let expected = draw(&mut renderer, &shown(&|i| i < 4), &view);
        assert!(draw(&mut renderer, &scene, &whole) == expected, "the upper four cubes vanish");
        let far = View { clip: Some(Clip::new([0.0, 0.0, 1.0], 9.0)), ..view };
        assert!(draw(&mut renderer, &scene, &far) == draw(&mut renderer, &scene, &view));
        let all = View { clip: Some(Clip::new([0.0, 0.0, 1.0], -9.0)), ..view };
        assert!(draw(&mut renderer, &scene, &all) == draw(&mut renderer, &Scene::new(), &view));
    }
    // A cut cube is, seen from outside, a lower one and what is seen into it: compared where the walls are in front.
    let mut cube = Scene::new();
    push_cells(&mut cube, [cuboid(0, [0.; 3], [1.; 3])], &CellStyle::default()).unwrap();
    let mut lower = Scene::new();
    let mut open = cuboid(0, [0.; 3], [1., 1., 0.5]);
    open.mesh.triangles.drain(2..4);
    open.edges.retain(|e| e.iter().any(|p| p[2] == 0.0));
    push_cells(&mut lower, [open], &CellStyle::default()).unwrap();
    let view = View { background: WHITE, samples: 2, ..View::fitted(&cube, [1.0; 3], ASPECT) };
    let cut = View { clip: Some(Clip::new([0.0, 0.0, 1.0], 0.5)), ..view };
    let [a, b] = [draw(&mut renderer, &cube, &cut), draw(&mut renderer, &lower, &view)];
    assert!(differing(&a, &b, 16) < 60, "{} pixels differ", differing(&a, &b, 16));
    assert!(1000 < differing(&a, &draw(&mut renderer, &cube, &view), 16));
    let prepared = renderer.prepare(&cube).unwrap();
    let up = prepared.pick(&cut, SIZE, [80, 20], 0).unwrap();
    assert!(up.is_none_or(|hit| hit.point[2] <= 0.5 + 1e-6), "what is cut away cannot be picked: {up:?}");
}

/// Nested groups draw what moving the points by the same sums draws.
#[test]
fn nested_explosion_is_the_same_as_moving_the_points() {
    let Some(mut renderer) = renderer() else { return };
    let explosion = Explosion::from([1.6, 1.2, 1.4]).level(1, [1.5, 2.0, 1.0]).about([0.2, 0.0, -0.5]);
    let cells: Vec<_> =
        (0..4).map(|i| cuboid(i, [f64::from(i), 0., 0.], [f64::from(i) + 1., 1., 1.])).collect();
    let (mut nested, mut moved) = (Scene::new(), Scene::new());
    for pair in cells.chunks(2) {
        let x = f64::from(pair[0].cell.index) + 1.0;
        let outer = nested.push_group([x, 0.5, 0.5]).unwrap();
        for cell in pair {
            let inner = nested.push_subgroup(outer, [f64::from(cell.cell.index) + 0.5, 0.0, 0.0]).unwrap();
            nested.push(Drawable::mesh("cell", cell.mesh.clone()).group(inner)).unwrap();
        }
    }
    let center = nested.center();
    for drawable in nested.drawables() {
        let d = nested.displacement(drawable, &explosion, center);
        let mut mesh = cells[moved.drawables().len()].mesh.clone();
        for p in mesh.points.coords_mut().as_chunks_mut::<3>().0 {
            *p = std::array::from_fn(|k| p[k] + d[k]);
        }
        moved.push(Drawable::mesh("cell", mesh)).unwrap();
    }
    assert_eq!(nested.bounds(explosion), moved.bounds([1.0; 3]));
    let view = View { background: WHITE, ..View::fitted(&nested, explosion, ASPECT) };
    let still = View { explode: Explosion::default(), ..view };
    let [a, b] = [draw(&mut renderer, &nested, &view), draw(&mut renderer, &moved, &still)];
    assert!(differing(&a, &b, 8) <= 20, "{} pixels differ", differing(&a, &b, 8));
}

#[test]
fn a_transparent_background_is_transparent_and_colours_stay() {
    let Some(mut renderer) = renderer() else { return };
    let (scene, view) = grid(0.4);
    let clear = View { background_opacity: 0.0, ..view };
    let image = renderer.render(&scene, &clear, SIZE[0], SIZE[1]).unwrap();
    assert_eq!(image.pixel(0, 0), Some([0, 0, 0, 0]));
    let over_white: Vec<u8> = image
        .pixels()
        .chunks_exact(4)
        .flat_map(|p| {
            let a = f32::from(p[3]) / 255.0;
            [0, 1, 2]
                .map(|k| (a * f32::from(p[k]) + (1.0 - a) * 255.0).round() as u8)
                .into_iter()
                .chain([255])
        })
        .collect();
    let expected = draw(&mut renderer, &scene, &view);
    assert_eq!(differing(&over_white, &expected, 3), 0);
}

/// The dark pixels that an outline adds in a picture without edges.
fn inked(renderer: &mut OffscreenRenderer, scene: &Scene, view: &View, of: Outlined) -> usize {
    let outline = Some(Outline { of, width: 3.0, color: [0.0, 0.0, 1.0] });
    let outlined = draw(renderer, scene, &View { outline, ..*view });
    outlined.chunks_exact(4).filter(|p| p[2] > 200 && p[0] < 60 && p[1] < 60).count()
}

/// Two solids, each of two cubes side by side: around everything, around each solid, around each cube there is ever more ink,
/// and none of it where a cube is seen through another.
#[test]
fn outlines_are_around_the_model_its_solids_or_its_cells() {
    let Some(mut renderer) = renderer() else { return };
    let mut scene = Scene::new();
    for x in [0.0, 2.0] {
        let solid = scene.push_group([x + 1.0, 0.5, 0.5]).unwrap();
        for dx in [0.0, 1.0] {
            let cell = scene.push_subgroup(solid, [x + dx + 0.5, 0.5, 0.5]).unwrap();
            let shape = cuboid(0, [x + dx, 0.0, 0.0], [x + dx + 1.0, 1.0, 1.0]);
            scene.push(Drawable::mesh("cube", shape.mesh).group(cell).opacity(0.6)).unwrap();
        }
    }
    let front = Camera {
        orientation: StandardView::Front.orientation(),
        projection: Projection::Orthographic,
        ..Camera::default()
    };
    let view = View { camera: front, background: WHITE, samples: 2, ..View::default() }.fit(&scene, ASPECT);
    let [model, solids, cells] = [Outlined::Model, Outlined::Solids, Outlined::Cells]
        .map(|of| inked(&mut renderer, &scene, &view, of));
    // A row of four squares: ten sides around everything, one between the solids, two more between cells; a line of three
    // pixels has two or three that are all ink, as it lies.
    let side = model as f64 / 10.0;
    let [between_solids, between_cells] = [solids - model, cells - solids].map(|n| n as f64 / side);
    let shares = (0.8..1.2).contains(&between_solids) && (1.7..3.1).contains(&between_cells);
    assert!(500 < model && shares, "{model} {solids} {cells}");
    let apart = View { explode: Explosion::default().level(1, [1.2; 3]), ..view };
    assert!(
        solids + 20 < inked(&mut renderer, &scene, &apart, Outlined::Solids),
        "pulled apart, all against the background"
    );
    let plain = draw(&mut renderer, &scene, &view);
    let mut portable = OffscreenRenderer::portable().unwrap();
    assert!(
        cells.abs_diff(inked(&mut portable, &scene, &view, Outlined::Cells)) < 20,
        "the same without storage buffers"
    );
    assert!(draw(&mut renderer, &scene, &view) == plain, "no ink is left");
}
