//! Times uploads and frames at 1280 × 720 of spheres of about 1,000, 100,000 and 1,000,000 triangles, opaque and
//! translucent, whole and seen from so near that most is beside the picture, and of 100,000 labels.
//! `cargo run --release -p lar-viewer --no-default-features --example frame_times [ROWS]`
#![expect(clippy::print_stdout, reason = "an example that reports")]

use lar_core::{Points, TriangleMesh};
use lar_viewer::{Drawable, Label, OffscreenRenderer, Scene, View, ViewerError};
use std::time::Instant;

/// Frames of one measurement.
const FRAMES: usize = 8;

fn main() -> Result<(), ViewerError> {
    let only: Option<u32> = std::env::args().nth(1).and_then(|n| n.parse().ok());
    let mut renderer = OffscreenRenderer::new()?;
    println!("{}", renderer.adapter_name());
    for rows in [16, 158, 500].into_iter().filter(|rows| only.is_none_or(|n| n == *rows)) {
        for opacity in [1.0, 0.5] {
            let mesh = sphere(rows);
            let what = format!("{} triangles, opacity {opacity}", mesh.triangles.len());
            let mut scene = Scene::new();
            scene.push(Drawable::mesh("sphere", mesh).color([0.9, 0.5, 0.3]).opacity(opacity))?;
            measure(&mut renderer, &scene, &what)?;
        }
    }
    if only.is_none() {
        let at = |i: u32| [f64::from(i % 400), 0.0, f64::from(i / 400)];
        let labels = (0..100_000).map(|i| Label::new(i.to_string(), at(i)));
        let mut scene = Scene::new();
        scene.push(Drawable::labels("labels", labels))?;
        measure(&mut renderer, &scene, "100000 labels")?;
    }
    Ok(())
}

fn measure(renderer: &mut OffscreenRenderer, scene: &Scene, what: &str) -> Result<(), ViewerError> {
    let start = Instant::now();
    let mut prepared = renderer.prepare(scene)?;
    println!("{what}: uploaded in {:.0} ms", 1e3 * start.elapsed().as_secs_f64());
    let whole = View::fitted(scene, [1.0; 3], 16.0 / 9.0);
    let mut near = whole;
    near.camera.distance *= 0.25;
    for (place, view) in [("whole", whole), ("near", near)] {
        for samples in [1, 3] {
            let mut view = View { samples, ..view };
            prepared.render(&view, 1280, 720)?;
            let start = Instant::now();
            for _ in 0..FRAMES {
                view.camera.orientation = view.camera.orientation.orbit([5.0, 0.0]);
                prepared.render(&view, 1280, 720)?;
            }
            let milliseconds = start.elapsed().as_secs_f64() * 1e3 / FRAMES as f64;
            println!("  {place:>5}, {samples}×{samples} samples: {milliseconds:>6.1} ms");
        }
    }
    Ok(())
}

/// A unit sphere of `rows` bands of latitude, 4 · rows · (rows − 1) triangles.
fn sphere(rows: u32) -> TriangleMesh {
    let columns = 2 * rows;
    let angle = |i: u32, n: u32| std::f64::consts::PI * f64::from(i) / f64::from(n);
    let point = |row, column| {
        let ((sin_p, cos_p), (sin_a, cos_a)) =
            (angle(row, rows).sin_cos(), angle(2 * column, columns).sin_cos());
        [sin_p * cos_a, sin_p * sin_a, cos_p]
    };
    let corners: Vec<_> = (0..=rows).flat_map(|r| (0..columns).map(move |c| point(r, c))).collect();
    let index = |row, column| row * columns + column % columns;
    let cells = (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c)));
    let triangles = cells.flat_map(|(r, c)| {
        let [a, b, d, e] = [index(r, c), index(r + 1, c), index(r + 1, c + 1), index(r, c + 1)];
        let (lower, upper) = ((r + 1 < rows).then_some([a, b, d]), (0 < r).then_some([a, d, e]));
        lower.into_iter().chain(upper)
    });
    TriangleMesh { points: Points::from_xyz(&corners), triangles: triangles.collect() }
}
