//! Times frames of spheres of about 1,000 and 100,000 triangles at 1280 × 720, opaque and translucent, per number of
//! samples. `cargo run --release -p lar-viewer --no-default-features --example frame_times`
#![expect(clippy::print_stdout, reason = "an example that reports")]

use lar_core::{Points, TriangleMesh};
use lar_viewer::{Drawable, OffscreenRenderer, Scene, View, ViewerError};
use std::time::Instant;

/// Frames of one measurement.
const FRAMES: usize = 8;

fn main() -> Result<(), ViewerError> {
    let mut renderer = OffscreenRenderer::new()?;
    println!("{}", renderer.adapter_name());
    for rows in [16, 158] {
        for opacity in [1.0, 0.5] {
            let mesh = sphere(rows);
            let n = mesh.triangles.len();
            let mut scene = Scene::new();
            scene.push(Drawable::mesh("sphere", mesh).color([0.9, 0.5, 0.3]).opacity(opacity))?;
            for samples in 1..=3 {
                let mut view = View { samples, ..View::fitted(&scene, [1.0; 3], 16.0 / 9.0) };
                let views: Vec<View> = std::iter::repeat_with(|| {
                    view.camera.orientation = view.camera.orientation.orbit([5.0, 0.0]);
                    view
                })
                .take(FRAMES)
                .collect();
                renderer.render(&scene, &view, 1280, 720)?;
                let start = Instant::now();
                renderer.render_all(&scene, &views, 1280, 720)?;
                let milliseconds = start.elapsed().as_secs_f64() * 1e3 / FRAMES as f64;
                println!(
                    "{n:>7} triangles, opacity {opacity}, {samples}×{samples} samples: {milliseconds:>6.1} ms"
                );
            }
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
