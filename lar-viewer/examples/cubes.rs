//! A grid of translucent cubes, exploded: in a window, or off-screen as a PNG file.
//!
//! `cargo run --release -p lar-viewer --example cubes -- [OUT.png] [CUBES PER SIDE]`

use lar_core::{Points, TriangleMesh};
use lar_viewer::{
    CellRef, CellShape, CellStyle, OffscreenRenderer, Scene, View, ViewerError, push_axes, push_cells,
};

fn main() -> Result<(), ViewerError> {
    let mut arguments = std::env::args().skip(1).peekable();
    let out = arguments.next_if(|a| a.ends_with(".png"));
    let n = arguments.next().and_then(|n| n.parse().ok()).unwrap_or(2);
    let scene = scene(n)?;
    let view = View::fitted(&scene, [1.5; 3], 16.0 / 9.0);
    match out {
        Some(path) => OffscreenRenderer::new()?.render(&scene, &view, 1280, 720)?.write_png(path),
        None => lar_viewer::view(scene, view, "cubes"),
    }
}

fn scene(n: u32) -> Result<Scene, ViewerError> {
    let mut scene = Scene::new();
    let style = CellStyle { opacity: 0.4, ..CellStyle::default() };
    push_cells(&mut scene, (0..n * n * n).map(|i| cube(i, [i % n, i / n % n, i / (n * n)])), &style)?;
    push_axes(&mut scene, f64::from(n) + 1.0)?;
    Ok(scene)
}

/// The unit cube with this corner: two triangles a face, and its twelve edges.
fn cube(index: u32, corner: [u32; 3]) -> CellShape {
    let vertex = |i: usize| std::array::from_fn(|k| f64::from(corner[k]) + (i >> k & 1) as f64);
    let vertices: Vec<[f64; 3]> = (0..8).map(vertex).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let along =
        |k: usize| (0..8).filter(move |i| i >> k & 1 == 0).map(move |i| [vertex(i), vertex(i | 1 << k)]);
    CellShape {
        name: format!("cube {index}"),
        cell: CellRef { dim: 3, index },
        mesh: TriangleMesh { points: Points::from_xyz(&vertices), triangles },
        edges: (0..3).flat_map(along).collect(),
    }
}
