//! Scenes, the adapter, and comparison of pictures for the tests that draw.
#![allow(dead_code, reason = "each test program uses a part of it")]

use lar_core::{Points, TriangleMesh};
use lar_viewer::{CellRef, CellShape, Image, OffscreenRenderer, ViewerError};
use std::path::PathBuf;

/// The renderer, or `None` with a message when this machine has no adapter. With `LAR_REQUIRE_GPU=1`, as in CI, a
/// missing adapter fails the test.
#[expect(clippy::print_stderr, reason = "a test that cannot run says so")]
pub(crate) fn renderer() -> Option<OffscreenRenderer> {
    match OffscreenRenderer::new() {
        Ok(renderer) => Some(renderer),
        Err(ViewerError::NoAdapter { found }) if std::env::var_os("LAR_REQUIRE_GPU").is_none() => {
            eprintln!("NOT TESTED: no graphics adapter ({found}); LAR_REQUIRE_GPU=1 makes this an error");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

/// A box from `min` to `max` as the cell with this index: 12 triangles, 12 edges.
pub(crate) fn cuboid(index: u32, min: [f64; 3], max: [f64; 3]) -> CellShape {
    let corner = |i: usize| std::array::from_fn(|k| if i >> k & 1 == 0 { min[k] } else { max[k] });
    let corners: Vec<[f64; 3]> = (0..8).map(corner).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let along =
        |k: usize| (0..8).filter(move |i| i >> k & 1 == 0).map(move |i| [corner(i), corner(i | 1 << k)]);
    CellShape {
        name: format!("cuboid {index}"),
        cell: CellRef { dim: 3, index },
        mesh: TriangleMesh { points: Points::from_xyz(&corners), triangles },
        edges: (0..3).flat_map(along).collect(),
    }
}

/// n × n × n unit cubes.
pub(crate) fn cube_grid(n: u32) -> Vec<CellShape> {
    let cells = (0..n * n * n).map(|i| {
        let min = [i % n, i / n % n, i / (n * n)].map(f64::from);
        cuboid(i, min, min.map(|x| x + 1.0))
    });
    cells.collect()
}

/// Compares with the committed picture `tests/pictures/NAME.png`: at most one pixel in a thousand may differ by more
/// than 8 of 255, which is what other processors and drivers need. `LAR_UPDATE_PICTURES=1` writes the picture.
#[track_caller]
pub(crate) fn check_picture(name: &str, image: &Image) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/pictures/{name}.png"));
    if std::env::var_os("LAR_UPDATE_PICTURES").is_some() {
        image.write_png(&path).unwrap();
    }
    let (size, expected) = read_png(&path);
    assert_eq!(size, [image.width(), image.height()], "size of {name}");
    let pixels = image.pixels().chunks_exact(4).zip(expected.chunks_exact(4));
    let differing = pixels.filter(|(a, b)| a.iter().zip(*b).any(|(x, y)| 8 < x.abs_diff(*y))).count();
    let allowed = expected.len() / 4 / 1000;
    if allowed < differing {
        let actual = std::env::temp_dir().join(format!("lar-viewer-{name}-actual.png"));
        image.write_png(&actual).unwrap();
        panic!("{name}: {differing} pixels differ, {allowed} may; see {}", actual.display());
    }
}

/// Pixels that differ by more than `tolerance` in a channel.
pub(crate) fn differing(a: &[u8], b: &[u8], tolerance: u8) -> usize {
    let pixels = a.chunks_exact(4).zip(b.chunks_exact(4));
    pixels.filter(|(a, b)| a.iter().zip(*b).any(|(x, y)| tolerance < x.abs_diff(*y))).count()
}

fn read_png(path: &std::path::Path) -> ([u32; 2], Vec<u8>) {
    let file = std::fs::File::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    ([info.width, info.height], pixels)
}
