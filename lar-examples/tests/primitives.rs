//! Every primitive of the viewer, drawn in a small picture of its own.
#![cfg(feature = "viewer")]
mod support;

use lar_core::{Cells, Points, Surface, cuboid_grid, icosphere};
use lar_examples::primitives::{hull_shape, polygon_shape, polyhedron_shape, push_grid, push_model};
use lar_viewer::{
    CellRef, CellStyle, Coloring, Drawable, Label, OffscreenRenderer, Scene, TextStyle, View, ViewerError,
    WHITE, cuboid_shape, push_arrow, push_axes, push_cells, push_exploded_groups, push_numbers,
    push_plane_axes, text_segments,
};
use std::error::Error;
use std::path::PathBuf;

const SIZE: [u32; 2] = [160, 120];

type Draw = fn(&mut Scene) -> Result<(), Box<dyn Error>>;

/// Name of the picture, explosion, and what is drawn.
const PRIMITIVES: [(&str, f32, Draw); 20] = [
    ("GLFrame", 1.0, |s| Ok(push_axes(s, 1.0)?)),
    ("GLFrame2", 1.0, |s| Ok(push_plane_axes(s, 1.0)?)),
    ("GLAxis", 1.0, |s| Ok(push_arrow(s, "axis", [0.2, 0.1, 0.0], [1.0, 0.6, 0.8], [0.7, 0.2, 0.6])?)),
    ("GLCuboid", 1.0, |s| cells(s, [cuboid_shape(CellRef::new(3, 0), [0.0; 3], [2.0, 1.0, 0.5])])),
    ("GLHull", 1.0, |s| cells(s, [hull_shape(0, &cloud(40, 3))?])),
    ("GLHull2d", 1.0, |s| cells(s, [hull_shape(0, &cloud(12, 2))?])),
    ("GLHulls", 1.0, |s| {
        let moved = |x: f64| {
            let points: Vec<[f64; 3]> = cloud(14, 3).iter().map(|p| [p[0] + x, p[1], p[2]]).collect();
            hull_shape(x as u32, &Points::from_xyz(&points))
        };
        cells(s, [moved(0.0)?, moved(2.0)?, moved(4.0)?])
    }),
    ("GLPolygon", 1.0, |s| cells(s, [polygon_shape(0, &[ring(6, 1.0), ring(4, 0.4)])?])),
    ("GLPolygons", 1.6, |s| {
        let lifted = |i: u32| {
            let up = |r: Vec<[f64; 3]>| r.into_iter().map(|p| [p[0], p[1], 0.5 * f64::from(i)]).collect();
            polygon_shape(i, &[up(ring(3 + i, 1.0)), up(ring(3 + i, 0.5))])
        };
        cells(s, [lifted(0)?, lifted(1)?, lifted(2)?])
    }),
    ("GLPolyhedron", 1.0, |s| cells(s, [polyhedron_shape(0, &prism(5)?)?])),
    ("GLPolyhedrons", 1.4, |s| {
        let moved = |i: u32| {
            let prism = prism(3 + i).map_err(|e| e.to_string())?;
            let place = lar_core::t(&[2.2 * f64::from(i), 0.0, 0.0]);
            Ok::<_, Box<dyn Error>>(polyhedron_shape(i, &prism.transformed(&place)?)?)
        };
        cells(s, [moved(0)?, moved(1)?])
    }),
    ("GLLar2gl", 1.3, |s| Ok(push_model(s, &cuboid_grid(&[2, 2, 1]), &CellStyle::default())?)),
    ("GLPol", 1.0, |s| Ok(push_model(s, &lar_core::simplex(3), &CellStyle::default())?)),
    ("GLLines", 1.0, |s| {
        let edges = cuboid_shape(CellRef::new(3, 0), [0.0; 3], [1.0; 3]).edges;
        Ok(s.push(Drawable::lines("cube", edges).width(3.0).color([0.1, 0.4, 0.7]))?)
    }),
    ("GLPoints", 1.0, |s| {
        let points: Vec<[f64; 3]> = cloud(60, 3).iter().map(|p| [p[0], p[1], p[2]]).collect();
        Ok(s.push(Drawable::points("cloud", points).size(5.0).color([0.7, 0.2, 0.2]))?)
    }),
    ("GLGrid", 1.2, |s| {
        let points = Points::from_xyz(&[
            [0., 0., 0.],
            [1., 0., 0.],
            [1., 1., 0.],
            [0., 1., 0.],
            [0., 0., 1.],
            [2., 0., 0.],
            [2., 1., 0.],
            [2., 0., 1.],
            [3., 0.5, 0.],
            [3.5, 0.5, 1.],
            [1., 0., 1.],
            [1., 1., 1.],
            [0., 1., 1.],
        ]);
        let cells: [&[u32]; 5] = [&[8], &[8, 9], &[5, 6, 7], &[1, 2, 6, 5], &[0, 1, 2, 3, 4, 10, 11, 12]];
        let cells: Cells = cells.into_iter().collect();
        Ok(push_grid(s, &points, &cells, &CellStyle::default())?)
    }),
    ("GLExplode", 1.5, |s| {
        let cube = |i: u32| {
            let min = [f64::from(i % 4), f64::from(i / 4), 0.0];
            cuboid_shape(CellRef::new(3, i), min, min.map(|x| x + 1.0))
        };
        let groups = (0..4).map(|g| vec![cube(2 * g), cube(2 * g + 1)]).collect();
        push_exploded_groups(s, groups, 99, 0.6)?;
        Ok(())
    }),
    ("GLText", 1.0, |s| {
        let style = TextStyle { size: 0.3, ..TextStyle::default() };
        let text = text_segments("LAR", &style, [0.0; 3], [1., 0., 0.], [0., 0., 1.]);
        s.push(Drawable::lines("text", text).width(2.5))?;
        Ok(s.push(Drawable::labels("label", [Label::new("label", [0.0, 0.0, 0.35])]).color([0.8, 0.1, 0.1]))?)
    }),
    ("numbering", 1.4, |s| {
        let style = CellStyle { coloring: Coloring::Code(1), opacity: 0.4, ..CellStyle::default() };
        let shapes = (0..3)
            .map(|i| cuboid_shape(CellRef::new(3, i), [f64::from(i), 0., 0.], [f64::from(i) + 1., 1., 1.]));
        let groups = push_cells(s, shapes, &style)?;
        let middle = |i: u32| [f64::from(i) + 0.5, 0.5, 0.5];
        let numbers = (0..3).map(|i| (CellRef::new(3, 40 + i), middle(i), Some(groups[i as usize])));
        Ok(push_numbers(s, numbers, &TextStyle::default(), true)?)
    }),
    ("colors", 1.0, |s| {
        let cube = |i: u32| {
            let min = [f64::from(i % 4), 0.0, -f64::from(i / 4)];
            cuboid_shape(CellRef::new(3, i), min, min.map(|x| x + 0.8))
        };
        for i in 0..12 {
            push_cells(s, [cube(i)], &CellStyle { coloring: Coloring::Code(i + 1), ..CellStyle::default() })?;
        }
        Ok(())
    }),
];

fn cells<const N: usize>(
    scene: &mut Scene,
    shapes: [lar_viewer::CellShape; N],
) -> Result<(), Box<dyn Error>> {
    push_cells(scene, shapes, &CellStyle { opacity: 0.8, ..CellStyle::default() })?;
    Ok(())
}

/// Scattered points about the origin, the same each time.
fn cloud(n: u32, dim: usize) -> Points {
    let mut points = Points::new(dim);
    let at = |i: u32, k: u32| (f64::from(i) * [0.754877, 0.569840, 0.819173][k as usize]).fract() * 1.6 - 0.8;
    (0..n).for_each(|i| points.push(&(0..dim as u32).map(|k| at(i + 1, k)).collect::<Vec<_>>()));
    points
}

fn ring(n: u32, radius: f64) -> Vec<[f64; 3]> {
    let corner = |i: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(n)).sin_cos();
        [radius * cos, radius * sin, 0.0]
    };
    (0..n).map(corner).collect()
}

/// A prism over a ring.
fn prism(n: u32) -> Result<Surface, Box<dyn Error>> {
    let lower = ring(n, 1.0);
    let upper = lower.iter().map(|p| [p[0], p[1], 1.2]);
    let points: Vec<[f64; 3]> = lower.iter().copied().chain(upper).collect();
    let mut surface = Surface::new("prism", Points::from_xyz(&points));
    let (bottom, top): (Vec<u32>, Vec<u32>) = ((0..n).rev().collect(), (n..2 * n).collect());
    surface.push_face([bottom.as_slice()], 1);
    surface.push_face([top.as_slice()], 1);
    for i in 0..n {
        let j = (i + 1) % n;
        surface.push_face([&[i, j, n + j, n + i][..]], 1);
    }
    Ok(surface)
}

fn renderer() -> Option<OffscreenRenderer> {
    match OffscreenRenderer::new() {
        Ok(renderer) => Some(renderer),
        Err(ViewerError::NoAdapter { .. }) if std::env::var_os("LAR_REQUIRE_GPU").is_none() => None,
        Err(error) => panic!("{error}"),
    }
}

/// All pictures on one sheet, five in a row; `LAR_UPDATE_PICTURES=1` writes it.
#[test]
fn each_primitive_has_its_picture() {
    let Some(mut renderer) = renderer() else { return };
    let [width, height] = SIZE;
    let (columns, rows) = (5, 4);
    let ground = View { background: WHITE, samples: 1, ..View::default() };
    let mut sheet = renderer.render(&Scene::new(), &ground, columns * width, rows * height).unwrap();
    for (i, (name, explode, draw)) in (0..).zip(PRIMITIVES) {
        let mut scene = Scene::new();
        draw(&mut scene).unwrap_or_else(|e| panic!("{name}: {e}"));
        let view = View {
            background: WHITE,
            ..View::fitted(&scene, [explode; 3], f64::from(width) / f64::from(height))
        };
        let image = renderer.render(&scene, &view, width, height).unwrap();
        let inked = image.pixels().chunks_exact(4).filter(|p| p[..3] != [255; 3]).count();
        assert!(300 < inked, "{name}: {inked} pixels are drawn");
        sheet.overlay(&image, width * (i % columns), height * (i / columns));
    }
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/gallery/primitives.png");
    if std::env::var_os("LAR_UPDATE_PICTURES").is_some() {
        sheet.write_png(&path).unwrap();
    }
    let (size, expected) = support::read_png(&path);
    assert_eq!(size, [sheet.width(), sheet.height()]);
    let differing = support::differing(sheet.pixels(), &expected);
    assert!(differing <= expected.len() / 4 / 1000, "{differing} pixels differ");
}

/// The hull of a sphere's points is the sphere.
#[test]
fn hulls_of_many_points() {
    let sphere = icosphere(4);
    let hull = lar_triangle::convex_hull(&sphere.points).unwrap();
    assert_eq!(hull.triangles.len(), sphere.triangles.len());
    assert!((hull.mesh(&sphere.points).signed_volume() - sphere.signed_volume()).abs() < 1e-9);
}
